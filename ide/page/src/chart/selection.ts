// Which elements are selected, in the order in which they were, and the one that has the focus. All
// of them are of one chart.
import type { Drawn, Item } from "./drawn";
import type { ElementId } from "./protocol";

export class Selection {
  sheet = 0;
  ids: ElementId[] = [];
  focus: ElementId | null = null;
  /** The number of an action in the block of the step that has the focus. */
  action: number | null = null;
  private listeners: (() => void)[] = [];

  /** Is told when something else is selected. */
  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  only(item: Item, action: number | null = null): void {
    this.set(item.sheet, [item.id], item.id, action);
  }

  /** Adds an element, or takes it out. */
  toggle(item: Item): void {
    if (item.sheet !== this.sheet) return this.only(item);
    const isIn = this.ids.includes(item.id);
    const ids = this.ids.filter((id) => id !== item.id);
    this.set(item.sheet, isIn ? ids : [...ids, item.id], item.id);
  }

  /** Adds elements of a chart. */
  add(items: Item[]): void {
    const [first] = items;
    if (!first) return;
    const before = first.sheet === this.sheet ? this.ids : [];
    const added = items.filter((item) => item.sheet === first.sheet).map(({ id }) => id);
    const ids = [...new Set([...before, ...added])];
    this.set(first.sheet, ids, ids.at(-1) ?? null);
  }

  set(
    sheet: number,
    ids: ElementId[],
    focus: ElementId | null = ids[0] ?? null,
    action: number | null = null,
  ): void {
    Object.assign(this, { sheet, ids, focus, action });
    for (const listener of this.listeners) listener();
  }

  /** What has the focus keeps it. */
  clear(): void {
    this.set(this.sheet, [], this.focus);
  }

  /** What is left of it in another drawing; `find` says what an element is there. */
  follow(before: Drawn, now: Drawn, find: (item: Item) => Item | undefined): void {
    const old = this.focus && before.at(this.sheet, this.focus);
    const moved = (id: ElementId) => {
      const item = before.at(this.sheet, id);
      return (item && find(item)?.id) ?? [];
    };
    const focus = old && (find(old) ?? now.nearest(this.sheet, old.middle));
    const ids = this.ids.flatMap(moved);
    const action = old && find(old) ? this.action : null;
    this.set(
      this.sheet,
      ids.length === 0 && focus ? [focus.id] : ids,
      focus ? focus.id : null,
      action,
    );
  }

  items(drawn: Drawn): Item[] {
    return this.ids.flatMap((id) => drawn.at(this.sheet, id) ?? []);
  }
}
