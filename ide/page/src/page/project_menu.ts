// The menu of the project: open, save, share.
import { words } from "../ports/outside";
import { example, exampleNames, keptProject, linkTo, BLINK } from "../project/begin";
import type { Disk } from "../project/disk";
import { canOpenFolders, choose, Folder, save } from "../project/files";
import type { Open } from "../project/opening";
import { LINK_MAX, linkPart, zipped } from "../project/pack";
import { checked, Unfit, type Project } from "../project/project";
import { allKept, forget, freshId } from "../project/storage";
import { t } from "../text/language";
import { ask, confirm, dialog, pick } from "./dialog";
import { h } from "./dom";
import { openMenu } from "./menu";
import { notice } from "./notices";
import { unfitWords } from "./unfit";

export class ProjectMenu {
  private folder: Folder | null = null;

  constructor(
    private project: Project,
    private open: Open,
    /** The project that is open: where it is kept and what it is called. */
    private current: () => { id: string; title: string },
    /** The folder that `uno200 ide` was given, if it was given one. */
    private disk: () => Disk | null,
  ) {}

  /** Shows the menu. */
  show(at: Element): void {
    const does = (act: () => Promise<void>) => () => void this.guard(act);
    const { id } = this.current();
    const isExample = id.startsWith("example:");
    const disk = this.disk();
    openMenu(at, [
      disk
        ? [
            {
              text: t("folderOfBridge", disk.name),
              checked: disk.isProject,
              act: does(() => this.open(disk.open())),
            },
          ]
        : [],
      [
        { text: t("newProject"), act: does(() => this.begin()) },
        { text: t("openExample"), act: does(() => this.openExample()) },
        { text: t("openKept"), act: does(() => this.openKept()) },
        { text: t("openFiles2"), act: does(() => this.openFiles()) },
        { text: t("openFolder"), act: does(() => this.openFolder()), disabled: !canOpenFolders() },
      ],
      [
        { text: t("saveZip"), act: does(() => this.saveZip()) },
        { text: t("saveFolder"), act: does(() => this.saveFolder()), disabled: !canOpenFolders() },
        { text: t("copyLink"), act: does(() => this.copyLink()) },
      ],
      isExample ? [{ text: t("exampleAnew"), act: does(() => this.exampleAnew(id)) }] : [],
    ]);
  }

  /** Does something and tells why it could not be done. */
  private async guard(act: () => Promise<void>): Promise<void> {
    try {
      await act();
    } catch (error) {
      notice(error instanceof Unfit ? unfitWords(error) : words(error), true);
    }
  }

  private async begin(): Promise<void> {
    const title = await ask(t("newProject"), "projectName", t("newProjectName"), "create");
    if (title === null) return;
    this.folder = null;
    await this.open({ id: freshId(), title, content: BLINK });
  }

  private async openExample(): Promise<void> {
    const names = await exampleNames();
    if (names.length === 0) throw new Unfit("empty", "examples");
    const name = await pick(
      t("openExample"),
      names.map((name) => ({ text: name, value: name })),
    );
    if (name === null) return;
    this.folder = null;
    await this.open(keptProject(`example:${name}`) ?? example(name));
  }

  private async exampleAnew(id: string): Promise<void> {
    if (!(await confirm("exampleAnew", "exampleAnewAsk", "beginAnew"))) return;
    await this.open(example(id.replace("example:", "")));
  }

  private async openKept(): Promise<void> {
    const all = allKept().filter(({ id }) => id !== this.current().id);
    const entries = all.map(({ id, title, changed }) => ({
      text: title,
      hint: new Date(changed).toLocaleString(),
      value: id,
      forget: () => forget(id),
    }));
    const id = await pick(t("openKept"), entries);
    const opened = id === null ? null : keptProject(id);
    if (opened) await this.open(opened);
  }

  private async openFiles(): Promise<void> {
    const { title, files } = await choose();
    const content = checked({ files, main: null, plant: null, view: null }, title);
    this.folder = null;
    await this.open({ id: freshId(), title, content });
  }

  private async openFolder(): Promise<void> {
    const folder = await Folder.choose();
    if (!folder) return;
    const files = await folder.read();
    const content = checked({ files, main: null, plant: null, view: null }, folder.name);
    this.folder = folder;
    await this.open({ id: freshId(), title: folder.name, content });
  }

  private async saveZip(): Promise<void> {
    save(`${this.current().title}.zip`, zipped(this.project.files()), "application/zip");
  }

  private async saveFolder(): Promise<void> {
    const folder = this.folder ?? (await Folder.choose());
    if (!folder) return;
    await folder.write(this.project.files());
    this.folder = folder;
    notice(t("savedIn", folder.name));
  }

  /** Ctrl+S: into the folder, where there is one; the browser has it anyway. */
  async save(): Promise<void> {
    const disk = this.disk();
    if (disk?.isProject)
      await this.guard(async () => {
        await disk.save();
        notice(t("savedIn", disk.name));
      });
    else if (this.folder) await this.guard(() => this.saveFolder());
    else notice(t("keptInBrowser"));
  }

  private async copyLink(): Promise<void> {
    const part = linkPart(this.project.content());
    if (part.length > LINK_MAX) throw new Unfit("tooLarge", t("linkTooLong"));
    const link = linkTo(part);
    try {
      await navigator.clipboard.writeText(link);
      notice(t("linkCopied"));
    } catch {
      // The browser does not let it be copied: then it is shown for copying by hand.
      const field = h("input", {
        label: "copyLink",
        attributes: { readonly: true },
        set: { value: link },
      });
      await dialog({ title: t("copyLink"), body: [field] });
    }
  }
}
