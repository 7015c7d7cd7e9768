// Which elements are chosen, and the one among them that keys go to. All are of one diagram.
import type { Item } from "./sheets";

export class Selection {
  /** Tab leads to it; it need not be chosen. */
  focus: Item | undefined;
  private keys = new Set<string>();
  private items: Item[] = [];

  /** Another drawing: what is still there stays chosen. */
  take(items: Item[]): void {
    const key = this.focus?.key;
    this.items = items;
    this.keys = new Set(items.filter((item) => this.has(item)).map((item) => item.key));
    this.focus = items.find((item) => item.key === key) ?? this.chosen[0] ?? items[0];
  }

  has({ key }: Item): boolean {
    return this.keys.has(key);
  }

  /** In the order of the text. */
  get chosen(): Item[] {
    return this.items.filter((item) => this.has(item));
  }

  only(item: Item | undefined): void {
    this.keys = new Set(item ? [item.key] : []);
    this.focus = item ?? this.focus;
  }

  /** With one more of the same diagram, or without it. */
  toggle(item: Item): void {
    if (this.chosen.some(({ sheet }) => sheet !== item.sheet)) return this.only(item);
    if (!this.keys.delete(item.key)) this.keys.add(item.key);
    this.focus = item;
  }

  /** What is called like an element has another name in the next drawing. */
  renamed({ sheet, element }: Item, name: string): void {
    const [before, after] = [element.id, name].map((one) => `${sheet}:${one.toUpperCase()}`);
    if (before === undefined || after === undefined) return;
    for (const item of this.items) {
      if (item.key !== before) continue;
      if (this.keys.delete(before)) this.keys.add(after);
      item.key = after;
    }
  }

  all(items: Item[]): void {
    this.keys = new Set(items.map(({ key }) => key));
    if (items[0] && !(this.focus && this.has(this.focus))) this.focus = items[0];
  }
}
