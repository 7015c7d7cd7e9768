// The worker that the core runs in: passes requests and bytes on to it, lets its time go by, posts
// its events. The virtual Uno is here, too: nothing is between it and the core.
import { VirtualUno } from "../board/virtual_uno";
import init, { Ide } from "./ide_core.js";
import type { Event } from "./protocol";

/** From tick to tick while something runs, and otherwise, in milliseconds. */
const BUSY_MS = 10;
const IDLE_MS = 50;
/** A tick should not take longer, or requests wait. */
const TICK_MS_MAX = 25;
const SCANS_MIN = 100;
const SCANS_MAX = 1_000_000;

/** From look to look whether the EEPROM of the virtual Uno is another one. */
const EEPROM_MS = 500;

/** What comes from the page: requests, bytes of a line, and first the EEPROM that it kept. */
type Message = string | Uint8Array | { eeprom: Uint8Array };

/** What is used of a worker's surroundings; the page's types have another `self`. */
interface Surroundings {
  onmessage: ((message: MessageEvent<Message>) => void) | null;
  postMessage(message: Event[] | { broken: string } | { eeprom: Uint8Array }): void;
}
const surroundings = self as unknown as Surroundings;

let ide: Ide | undefined;
const uno = new VirtualUno();
let isBusy = false;
let scansMax = 1000;
const early: (string | Uint8Array)[] = [];

/** Posts events of the core, apart from those that are for the virtual Uno. */
function post(ide: Ide, json: string): void {
  const events = (JSON.parse(json) as Event[]).filter((event) => !uno.take(event, ide));
  for (const event of events) if (event.is === "status") isBusy = event.status.mode === "RUN";
  if (events.length > 0) surroundings.postMessage(events);
}

function take(ide: Ide, message: string | Uint8Array): void {
  const now = performance.now();
  post(ide, typeof message === "string" ? ide.request(message, now) : ide.receive(message, now));
}

function tick(ide: Ide): void {
  const began = performance.now();
  post(ide, ide.tick(began, scansMax));
  uno.goOn(ide, began + TICK_MS_MAX, (bytes) => post(ide, ide.receive(bytes, performance.now())));
  const took = performance.now() - began;
  // Only a tick that was cut off says how many scans fit into one.
  if (took > TICK_MS_MAX) scansMax = Math.max(SCANS_MIN, scansMax >> 1);
  else if (!ide.isBehind()) return;
  else if (took > TICK_MS_MAX / 2) scansMax = Math.min(SCANS_MAX, scansMax + (scansMax >> 3));
  else scansMax = Math.min(SCANS_MAX, scansMax * 2);
}

/** What the core does not survive ends it: its state cannot be trusted any more. */
function guard(action: () => void): boolean {
  try {
    action();
    return true;
  } catch (error) {
    ide = undefined;
    surroundings.postMessage({ broken: String(error) });
    return false;
  }
}

function goOn(): void {
  const core = ide;
  const began = performance.now();
  if (!core || !guard(() => tick(core))) return;
  const took = performance.now() - began;
  setTimeout(goOn, Math.max(0, (isBusy || uno.isOn ? BUSY_MS : IDLE_MS) - took));
}

setInterval(() => {
  const eeprom = uno.newEeprom();
  if (eeprom) surroundings.postMessage({ eeprom });
}, EEPROM_MS);

surroundings.onmessage = ({ data }) => {
  const core = ide;
  if (typeof data === "object" && "eeprom" in data) uno.setEeprom(data.eeprom);
  else if (core) guard(() => take(core, data));
  else early.push(data);
};

init({ module_or_path: new URL("ide_core_bg.wasm", import.meta.url) }).then(
  () => {
    const core = new Ide();
    ide = core;
    if (guard(() => early.splice(0).forEach((message) => take(core, message)))) goOn();
  },
  (error: unknown) => surroundings.postMessage({ broken: String(error) }),
);
