// Projects are opened one after the other, and what is done to the target meanwhile waits: a Run that
// is pressed before an example has arrived is for the example.
import type { Opened } from "./begin";

/** Opens a project in the place of the one that is open, as soon as it is there. */
export type Open = (opened: Opened | Promise<Opened>) => Promise<void>;

export class Opening {
  private last: Promise<unknown> = Promise.resolve();

  constructor(private take: (opened: Opened) => Promise<void>) {}

  /** Fails as its project does; the next one is opened all the same. */
  readonly open: Open = (opened) => {
    const done = Promise.all([opened, this.last]).then(([opened]) => this.take(opened));
    this.last = done.catch(() => undefined);
    return done;
  };

  /** Does something when nothing is being opened any more. */
  afterwards(act: () => void): void {
    const { last } = this;
    void last.then(() => (last === this.last ? act() : this.afterwards(act)));
  }
}
