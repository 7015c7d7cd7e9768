// The way to a target outside: opens the port that the core wants, has people choose it, and carries
// bytes both ways. What they mean the core knows.
import type { Core } from "../core/core";
import type { EventOf, TargetKind } from "../core/protocol";
import { confirm, dialog } from "../page/dialog";
import { h, newId } from "../page/dom";
import { t } from "../text/language";
import { BridgeRefusal, type Bridge, type BridgePort } from "./bridge";
import type { Port } from "./port";
import { hasSerial, requestUsb } from "./usb";

/** DTR is off so long when a board is reset. */
const RESET_MS = 100;

/** Nobody wanted it after all. */
class Cancelled extends Error {}

export class Outside {
  private port: Port | undefined;
  /** What is done with the port is done in its order. */
  private queue: Promise<void> = Promise.resolve();

  constructor(
    private core: Core,
    private bridge: Bridge | null,
  ) {
    core.on("openPort", (line) => this.then(() => this.open(line)));
    core.on("closePort", () => this.then(() => this.close()));
    core.on("send", ({ bytes }) => this.then(() => this.port?.send(Uint8Array.from(bytes))));
    core.on("lines", ({ on }) => this.then(() => this.port?.lines(on)));
    core.on("resetBoard", () => this.then(() => this.reset()));
    core.on("askFirmware", () => void this.askFirmware());
  }

  private then(action: () => Promise<void> | undefined): void {
    this.queue = this.queue.then(action).catch((error: unknown) => {
      this.port = undefined;
      this.core.tell({ do: "unplugged", why: error instanceof Cancelled ? "" : words(error) });
    });
  }

  private async open({ kind, baud, parity }: EventOf<"openPort">): Promise<void> {
    this.port ??= await this.choose(kind);
    const { port } = this;
    const lost = (message: string) => {
      if (this.port !== port) return;
      this.port = undefined;
      this.core.tell({ do: "unplugged", why: message || t("portGone") });
    };
    await port.open({ baud, parity }, { received: (bytes) => this.core.receive(bytes), lost });
    this.core.tell({ do: "plugged", network: port.isNetwork });
  }

  private async close(): Promise<void> {
    const { port } = this;
    this.port = undefined;
    await port?.close();
  }

  private async reset(): Promise<void> {
    await this.port?.lines(false);
    await new Promise((resolve) => setTimeout(resolve, RESET_MS));
    await this.port?.lines(true);
  }

  private async choose(kind: TargetKind): Promise<Port> {
    const port = kind === "usb" ? await chooseUsb() : await this.chooseOfBridge();
    if (!port) throw new Cancelled();
    return port;
  }

  private async chooseOfBridge(): Promise<Port | null> {
    if (!this.bridge) throw new Error(t("noBridge"));
    const ports = await this.bridge.ports();
    if (ports.length === 0) throw new Error(t("noPorts"));
    const chosen = await chooseFrom(ports);
    return chosen && this.bridge.port(chosen);
  }

  private async askFirmware(): Promise<void> {
    if (await confirm("otherFirmware", "writeFirmware", "writeBoth"))
      this.core.tell({ do: "downloadFirmware" });
  }
}

async function chooseUsb(): Promise<Port | null> {
  if (!hasSerial()) throw new Error(t("noWebSerial"));
  // What the dialog is agreed to with is what the browser wants to see before it asks itself.
  return (await confirm("choosePort", "openingResets", "goOn")) ? requestUsb() : null;
}

/** Has one of several ports chosen; null where nobody chose one. */
async function chooseFrom(ports: BridgePort[]): Promise<BridgePort | null> {
  const id = newId();
  const list = h("select", { attributes: { id } });
  for (const { name } of ports) list.append(h("option", { set: { value: name } }, name));
  const body = [
    h("label", { text: "portOfBridge", attributes: { for: id } }),
    list,
    h("p", { text: "openingResets" }),
  ];
  const isChosen = await dialog({ title: t("choosePort"), body, agree: "goOn" });
  return (isChosen && ports.find(({ name }) => name === list.value)) || null;
}

/** What went wrong, in words. */
export function words(error: unknown): string {
  if (error instanceof BridgeRefusal) return error.message || t("bridgeGone");
  return error instanceof Error ? error.message : String(error);
}
