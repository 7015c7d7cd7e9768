// What wasm-bindgen makes of ide/charts; it is beside the worker when the page is served.
export default function init(options: { module_or_path: URL }): Promise<unknown>;

export class Charts {
  constructor();
  request(json: string): string;
}
