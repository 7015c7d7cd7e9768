// What wasm-bindgen makes of ide/drawings; it is beside the worker when the page is served.
export default function init(options: { module_or_path: URL }): Promise<unknown>;

export class Drawings {
  constructor();
  request(json: string): string;
}
