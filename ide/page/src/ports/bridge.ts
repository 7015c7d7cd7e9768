// Ports and the folder that `uno200 ide` reaches, through its WebSocket; what is said there is written in
// uno200/src/ide/bridge/protocol.rs.
import type { Line, Listener, Port } from "./port";

type Wish =
  | { do: "hello"; token?: string; session?: string }
  | { do: "ports" }
  | ({ do: "open"; name: string } & Line)
  | { do: "lines"; on: boolean }
  | { do: "close" }
  | { do: "folder" }
  | { do: "read"; file: string }
  | { do: "save"; file: string; text: string; base: string | null }
  | { do: "remove"; file: string; base: string };

type Told =
  | { is: "welcome"; session: string; folder: boolean }
  | { is: "ports"; ports: BridgePort[] }
  | { is: "done" }
  | ({ is: "folder" } & BridgeFolder)
  | { is: "file"; text: string; version: string }
  | Written
  | { is: "refused"; message: string }
  | { is: "lost"; message: string };

/** What can be opened. */
export interface BridgePort {
  name: string;
  kind: "serial" | "tcp";
}

/** What is in the folder of the project. */
export interface BridgeFolder {
  id: string;
  name: string;
  files: { name: string; version: string }[];
  leftOut: { name: string; why: string }[];
}

/** What came of saving or removing a file. */
export type Written =
  { is: "saved"; version: string; note: string | null } | { is: "changed"; version: string | null };

/** The bridge has refused something, and says why. */
export class BridgeRefusal extends Error {}

/** The key of the session, which a reload survives; another tab has its own. */
const KEY = "bridge";

export class Bridge {
  /** Whether there is a folder to work in; known when it is connected. */
  hasFolder = false;
  private socket: WebSocket | undefined;
  private connected: Promise<void> | undefined;
  private waiting: { told(told: Told): void; failed(error: Error): void }[] = [];
  private listener: Listener | undefined;

  private constructor(private hello: { token?: string; session?: string }) {}

  /** The bridge of the server that this page comes from; null where it has none. The token is taken
   * out of the address at once. */
  static fromAddress(): Bridge | null {
    const search = new URLSearchParams(location.search);
    const token = search.get("token");
    const session = sessionStorage.getItem(KEY);
    if (token !== null) {
      search.delete("token");
      const rest = search.size > 0 ? `?${search}` : "";
      history.replaceState(history.state, "", location.pathname + rest + location.hash);
      return new Bridge({ token });
    }
    return session === null ? null : new Bridge({ session });
  }

  /** Whether it has a token that is to be exchanged. */
  get isNew(): boolean {
    return this.hello.token !== undefined;
  }

  /** Whether it is connected. */
  get isUp(): boolean {
    return this.socket?.readyState === WebSocket.OPEN;
  }

  /** Says who this is. The token is good for once: a reload comes back with the key. */
  connect(): Promise<void> {
    this.connected ??= this.begin();
    return this.connected;
  }

  private async begin(): Promise<void> {
    const socket = new WebSocket(`ws://${location.host}/bridge`);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    socket.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) => this.take(data);
    await new Promise<void>((resolve) => {
      socket.onopen = () => resolve();
      socket.onclose = () => (this.gone(), resolve());
    });
    const told = await this.ask({ do: "hello", ...this.hello });
    if (told.is !== "welcome") return;
    this.hello = { session: told.session };
    this.hasFolder = told.folder;
    sessionStorage.setItem(KEY, told.session);
  }

  /** What can be opened now. */
  async ports(): Promise<BridgePort[]> {
    return (await this.answer({ do: "ports" }, "ports")).ports;
  }

  /** What is in the folder now. */
  folder(): Promise<BridgeFolder> {
    return this.answer({ do: "folder" }, "folder");
  }

  /** A file of it. */
  read(file: string): Promise<{ text: string; version: string }> {
    return this.answer({ do: "read", file }, "file");
  }

  /** Writes a file in place of the version `base`, or a new one. */
  save(file: string, text: string, base: string | null): Promise<Written> {
    return this.answer({ do: "save", file, text, base }, "saved", "changed");
  }

  /** Removes a file of this version. */
  remove(file: string, base: string): Promise<Written> {
    return this.answer({ do: "remove", file, base }, "saved", "changed");
  }

  /** Asks, and takes nothing but these answers. */
  private async answer<K extends Told["is"]>(
    wish: Wish,
    ...kinds: K[]
  ): Promise<Extract<Told, { is: K }>> {
    await this.connect();
    const told = await this.ask(wish);
    if ((kinds as string[]).includes(told.is)) return told as Extract<Told, { is: K }>;
    throw new BridgeRefusal(`${wish.do}: ${told.is}`);
  }

  /** The port with a name. */
  port({ name, kind }: BridgePort): Port {
    return {
      isNetwork: kind === "tcp",
      open: async (line, listener) => {
        await this.connect();
        this.listener = undefined;
        await this.ask({ do: "open", name, ...line });
        this.listener = listener;
      },
      send: (bytes) => {
        this.socket?.send(bytes.slice());
        return Promise.resolve();
      },
      lines: async (on) => {
        await this.ask({ do: "lines", on });
      },
      close: async () => {
        this.listener = undefined;
        if (this.socket) await this.ask({ do: "close" });
      },
    };
  }

  private ask(wish: Wish): Promise<Told> {
    return new Promise((told, failed) => {
      if (this.socket?.readyState !== WebSocket.OPEN) return failed(new BridgeRefusal(""));
      this.waiting.push({ told, failed });
      this.socket.send(JSON.stringify(wish));
    });
  }

  private take(data: string | ArrayBuffer): void {
    if (typeof data !== "string") return this.listener?.received(new Uint8Array(data));
    const told = JSON.parse(data) as Told;
    if (told.is === "lost") return this.lost(told.message);
    const waiting = this.waiting.shift();
    if (told.is === "refused") waiting?.failed(new BridgeRefusal(told.message));
    else waiting?.told(told);
  }

  private lost(message: string): void {
    const { listener } = this;
    this.listener = undefined;
    listener?.lost(message);
  }

  private gone(): void {
    this.socket = this.connected = undefined;
    for (const { failed } of this.waiting.splice(0)) failed(new BridgeRefusal(""));
    this.lost("");
  }
}
