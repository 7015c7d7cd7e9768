// A port of this computer as the rest of the page sees it, wherever it is reached from.

export type Parity = "none" | "even" | "odd";

/** How a serial line is set, 8 bits and one stop bit. */
export interface Line {
  baud: number;
  parity: Parity;
}

/** What a port tells. */
export interface Listener {
  received(bytes: Uint8Array): void;
  /** It is gone: why. Nothing comes after this. */
  lost(message: string): void;
}

/** A port that was chosen. Opening it again closes it before. */
export interface Port {
  /** Whether it is a connection of the network: Modbus TCP, and nothing to be flashed. */
  readonly isNetwork: boolean;
  open(line: Line, listener: Listener): Promise<void>;
  send(bytes: Uint8Array): Promise<void>;
  /** Switches DTR and RTS, both. */
  lines(on: boolean): Promise<void>;
  close(): Promise<void>;
}
