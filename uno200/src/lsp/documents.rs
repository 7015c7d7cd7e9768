//! The texts that the editor has open, and those in files that belong to them.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use analysis::{Language, Project};
use awl_asm::files::read_source;
use lsp_types::{
    DidChangeTextDocumentParams, DidChangeWatchedFilesParams, DidCloseTextDocumentParams,
    DidOpenTextDocumentParams, DidSaveTextDocumentParams, InitializeParams, Uri,
};

use super::names::{name_of, name_of_path, path_of, uri_of};

/// Larger files are no programs.
const FILE_LEN_MAX: u64 = 4 << 20;
/// So many folders below that of the editor are looked into,
const DEPTH_MAX: usize = 6;
/// and so many files and folders at most.
const ENTRIES_MAX: usize = 5_000;

/// Texts by name.
#[derive(Default)]
pub(super) struct Documents {
    pub(super) project: Project,
    /// Whether the editor knows texts with holes.
    pub(super) has_snippets: bool,
    open: BTreeMap<String, Open>,
}

/// What the editor has open.
struct Open {
    /// As the editor writes it.
    uri: Uri,
    version: i32,
}

impl Documents {
    /// What the editor is, and the texts in its folders.
    pub(super) fn initialize(&mut self, params: &InitializeParams) {
        let about = params.capabilities.text_document.as_ref();
        let item = about
            .and_then(|about| about.completion.as_ref())
            .and_then(|completion| completion.completion_item.as_ref());
        self.has_snippets = item.is_some_and(|item| item.snippet_support == Some(true));
        let folders = params.workspace_folders.iter().flatten().map(|folder| &folder.uri);
        let mut left = ENTRIES_MAX;
        for folder in folders {
            self.add_folder(&path_of(&name_of(folder)), DEPTH_MAX, &mut left);
        }
    }

    /// The editor's text is what counts from now on.
    pub(super) fn open(&mut self, params: DidOpenTextDocumentParams) -> Option<String> {
        let document = params.text_document;
        let name = name_of(&document.uri);
        let language = Language::of_name(&name).or_else(|| language_of(&document.language_id))?;
        let open = Open { uri: document.uri, version: document.version };
        self.open.insert(name.clone(), open);
        self.project.set_as(&name, language, document.text).ok()?;
        self.add_beside(&name);
        Some(name)
    }

    /// The editor sends all of the text.
    pub(super) fn change(&mut self, params: DidChangeTextDocumentParams) -> Option<String> {
        let name = name_of(&params.text_document.uri);
        let open = self.open.get_mut(&name)?;
        open.version = params.text_document.version;
        let text = params.content_changes.into_iter().next_back()?.text;
        self.project.change(&name, text).ok()?;
        Some(name)
    }

    pub(super) fn save(&mut self, params: DidSaveTextDocumentParams) -> Option<String> {
        let name = name_of(&params.text_document.uri);
        self.add_beside(&name);
        Some(name)
    }

    /// The file is what counts again.
    pub(super) fn close(&mut self, params: DidCloseTextDocumentParams) -> Option<String> {
        let name = name_of(&params.text_document.uri);
        self.open.remove(&name)?;
        let related = self.project.related(&name).into_iter().find(|other| *other != name);
        self.add_file(&path_of(&name), true);
        related
    }

    /// Reads files that have changed.
    pub(super) fn look_again(&mut self, params: DidChangeWatchedFilesParams) {
        for change in params.changes {
            self.add_file(&path_of(&name_of(&change.uri)), true);
        }
    }

    pub(super) fn open_names(&self) -> Vec<String> {
        self.open.keys().cloned().collect()
    }

    /// URI and version of a text that is open.
    pub(super) fn version(&self, name: &str) -> Option<(Uri, i32)> {
        self.open.get(name).map(|open| (open.uri.clone(), open.version))
    }

    /// The URI of a text.
    pub(super) fn uri(&self, name: &str) -> Option<Uri> {
        self.open.get(name).map(|open| open.uri.clone()).or_else(|| uri_of(name))
    }

    /// Takes in what belongs to a text: the files of its folder, and of that of its program.
    fn add_beside(&mut self, name: &str) {
        let named = self.project.named_program(name);
        for name in [vec![name.to_owned()], named].concat() {
            if let Some(folder) = path_of(&name).parent() {
                self.add_folder(folder, 0, &mut ENTRIES_MAX.clone());
            }
        }
    }

    /// Takes the texts in a folder in, and in those below it. Programs come first: they say which
    /// tables are wanted.
    fn add_folder(&mut self, folder: &Path, depth: usize, left: &mut usize) {
        // What cannot be read has nothing to say.
        let entries = fs::read_dir(folder).into_iter().flatten().flatten();
        let mut paths: Vec<_> = entries.map(|entry| entry.path()).take(*left).collect();
        *left -= paths.len();
        let is_program = |path: &PathBuf| {
            let language = path.to_str().and_then(Language::of_name);
            language.is_some_and(Language::is_program)
        };
        paths.sort_by_key(|path| (!is_program(path), path.clone()));
        for path in paths {
            if path.is_dir() && depth > 0 && !is_left_out(&path) {
                self.add_folder(&path, depth - 1, left);
            } else {
                self.add_file(&path, false);
            }
        }
    }

    /// Takes a file in that is not open; forgets it if it is gone.
    fn add_file(&mut self, path: &Path, forgets: bool) {
        let Some(name) = name_of_path(path).filter(|name| !self.open.contains_key(name)) else {
            return;
        };
        let is_wanted = match Language::of_name(&name) {
            None => false,
            Some(Language::Symbols) => self.project.is_table(&name),
            Some(_) => true,
        };
        let is_file =
            fs::metadata(path).is_ok_and(|about| about.is_file() && about.len() <= FILE_LEN_MAX);
        match read_source(path).ok().filter(|_| is_wanted && is_file) {
            // Too long a text is none.
            Some(source) => drop(self.project.set(&name, source.text)),
            None if forgets => self.project.remove(&name),
            None => {}
        }
    }
}

/// Where no programs are.
fn is_left_out(folder: &Path) -> bool {
    let name = folder.file_name().unwrap_or_default().to_string_lossy();
    name.starts_with('.') || ["target", "node_modules"].contains(&&*name) || folder.is_symlink()
}

/// The language of a text whose name does not tell.
fn language_of(id: &str) -> Option<Language> {
    match id {
        "awl" => Some(Language::Awl),
        "st" | "structured-text" | "iecst" => Some(Language::StructuredText),
        "uno200-scenario" | "scn" => Some(Language::Scenario),
        "uno200-symbols" => Some(Language::Symbols),
        "uno200-plant" | "plant" => Some(Language::Plant),
        _ => None,
    }
}
