// Serial ports by Web Serial, which asks people which one it may be.
import type { Line, Listener, Port } from "./port";

/** As much of Web Serial as is used here. */
interface SerialPort {
  readonly readable: ReadableStream<Uint8Array> | null;
  readonly writable: WritableStream<Uint8Array> | null;
  open(options: { baudRate: number; parity: string; bufferSize: number }): Promise<void>;
  close(): Promise<void>;
  setSignals(signals: { dataTerminalReady: boolean; requestToSend: boolean }): Promise<void>;
}
interface Serial {
  requestPort(): Promise<SerialPort>;
}

/** More than comes while the page is busy. */
const BUFFER_SIZE = 16 * 1024;

function serial(): Serial | undefined {
  return (navigator as Navigator & { serial?: Serial }).serial;
}

/** Whether this browser has Web Serial. */
export function hasSerial(): boolean {
  return serial() !== undefined;
}

/** Has a port chosen; null where nobody chose one. */
export async function requestUsb(): Promise<Port | null> {
  try {
    const port = await serial()?.requestPort();
    return port ? new Usb(port) : null;
  } catch (error) {
    if (error instanceof DOMException && error.name === "NotFoundError") return null;
    throw error;
  }
}

class Usb implements Port {
  readonly isNetwork = false;
  private reader: ReadableStreamDefaultReader<Uint8Array> | undefined;
  private writer: WritableStreamDefaultWriter<Uint8Array> | undefined;
  private reading: Promise<void> = Promise.resolve();

  constructor(private port: SerialPort) {}

  async open({ baud, parity }: Line, listener: Listener): Promise<void> {
    await this.close();
    await this.port.open({ baudRate: baud, parity, bufferSize: BUFFER_SIZE });
    this.writer = this.port.writable?.getWriter();
    this.reading = this.read(listener);
  }

  async send(bytes: Uint8Array): Promise<void> {
    await this.writer?.write(bytes);
  }

  async lines(on: boolean): Promise<void> {
    await this.port.setSignals({ dataTerminalReady: on, requestToSend: on });
  }

  async close(): Promise<void> {
    const { reader, writer } = this;
    if (!reader || !writer) return;
    this.reader = this.writer = undefined;
    // A port that is gone cannot be closed any more, and need not be.
    await reader.cancel().catch(() => {});
    await this.reading;
    await writer.close().catch(() => {});
    await this.port.close().catch(() => {});
  }

  /** Reads until the port is closed or gone. A byte that was damaged on the line ends a stream, and
   * the port has another one. */
  private async read(listener: Listener): Promise<void> {
    let why = "";
    while (this.port.readable) {
      const reader = this.port.readable.getReader();
      this.reader = reader;
      try {
        for (;;) {
          const { value, done } = await reader.read();
          if (done) return;
          listener.received(value);
        }
      } catch (error) {
        why = error instanceof Error ? error.message : String(error);
      } finally {
        reader.releaseLock();
      }
    }
    // Of a port that was closed on purpose nobody wants to hear.
    if (this.writer) listener.lost(why);
  }
}
