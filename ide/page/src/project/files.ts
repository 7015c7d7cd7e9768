// Files of this computer: chosen ones are read, made ones are saved; folders where the browser can.
import type { File as ProjectFile } from "../core/protocol";
import { BYTES_MAX, ENDINGS, FILES_MAX, isName, Unfit } from "./project";
import { textOf, unzipped } from "./pack";

interface FileHandle {
  kind: "file";
  name: string;
  getFile(): Promise<File>;
  createWritable(): Promise<{ write(text: string): Promise<void>; close(): Promise<void> }>;
}

interface FolderHandle {
  kind: "directory";
  name: string;
  values(): AsyncIterable<FileHandle | FolderHandle>;
  getDirectoryHandle(name: string, options: { create: boolean }): Promise<FolderHandle>;
  getFileHandle(name: string, options: { create: boolean }): Promise<FileHandle>;
  removeEntry(name: string): Promise<void>;
}

interface Picker {
  showDirectoryPicker?: (options: { mode: "readwrite"; id: string }) => Promise<FolderHandle>;
}

/** Folders in folders that are looked into. */
const DEPTH_MAX = 4;

/** Saves as the browser saves downloads. */
export function save(name: string, data: BlobPart, type: string): void {
  const address = URL.createObjectURL(new Blob([data], { type }));
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  // The download has begun by then.
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

/** Lets files be chosen: those of a project, or a .zip with them. */
export function choose(): Promise<{ title: string; files: ProjectFile[] }> {
  return new Promise((resolve, reject) => {
    const input = document.createElement("input");
    input.type = "file";
    input.multiple = true;
    input.accept = [...ENDINGS, ".zip"].join(",");
    input.addEventListener("change", () => {
      read([...(input.files ?? [])]).then(resolve, reject);
    });
    input.click();
  });
}

async function read(chosen: File[]): Promise<{ title: string; files: ProjectFile[] }> {
  const files: ProjectFile[] = [];
  for (const file of chosen) {
    if (file.size > BYTES_MAX) throw new Unfit("tooLarge", file.name);
    const bytes = new Uint8Array(await file.arrayBuffer());
    if (/\.zip$/i.test(file.name)) files.push(...unzipped(bytes));
    else files.push({ name: file.name, text: textOf(bytes) });
  }
  return { title: (chosen[0]?.name ?? "").replace(/\.[^.]*$/, ""), files };
}

/** Whether this browser opens folders. */
export function canOpenFolders(): boolean {
  return "showDirectoryPicker" in window;
}

/** A folder of this computer. */
export class Folder {
  private written = new Set<string>();

  private constructor(private handle: FolderHandle) {}

  get name(): string {
    return this.handle.name;
  }

  /** Lets a folder be chosen; null where nobody did. */
  static async choose(): Promise<Folder | null> {
    try {
      const pick = (window as Picker).showDirectoryPicker;
      const handle = await pick?.call(window, { mode: "readwrite", id: "uno200" });
      return handle ? new Folder(handle) : null;
    } catch (error) {
      if (error instanceof DOMException && error.name === "AbortError") return null;
      throw error;
    }
  }

  /** Its files with known endings; folders whose names begin with a dot are left out. */
  async read(): Promise<ProjectFile[]> {
    const files: ProjectFile[] = [];
    await this.readInto(files, this.handle, "", DEPTH_MAX);
    this.written = new Set(files.map((file) => file.name));
    return files;
  }

  private async readInto(
    files: ProjectFile[],
    folder: FolderHandle,
    path: string,
    depth: number,
  ): Promise<void> {
    for await (const entry of folder.values()) {
      const name = path + entry.name;
      if (entry.kind === "directory") {
        if (depth > 0 && !entry.name.startsWith("."))
          await this.readInto(files, entry, `${name}/`, depth - 1);
      } else if (isName(name)) {
        if (files.length === FILES_MAX) throw new Unfit("tooMany", String(FILES_MAX));
        const file = await entry.getFile();
        if (file.size > BYTES_MAX) throw new Unfit("tooLarge", name);
        files.push({ name, text: textOf(new Uint8Array(await file.arrayBuffer())) });
      }
    }
  }

  /** Writes the files, and removes those that it read and that are gone. */
  async write(files: ProjectFile[]): Promise<void> {
    for (const file of files) {
      const stream = await (await this.entry(file.name)).createWritable();
      await stream.write(file.text);
      await stream.close();
    }
    const names = new Set(files.map((file) => file.name));
    for (const gone of [...this.written].filter((name) => !names.has(name)))
      await this.remove(gone);
    this.written = names;
  }

  private async folderOf(name: string): Promise<[FolderHandle, string]> {
    const parts = name.split("/");
    const last = parts.pop() ?? name;
    let folder = this.handle;
    for (const part of parts) folder = await folder.getDirectoryHandle(part, { create: true });
    return [folder, last];
  }

  private async entry(name: string): Promise<FileHandle> {
    const [folder, last] = await this.folderOf(name);
    return folder.getFileHandle(last, { create: true });
  }

  private async remove(name: string): Promise<void> {
    const [folder, last] = await this.folderOf(name);
    await folder.removeEntry(last);
  }
}
