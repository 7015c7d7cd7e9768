//! The page of the IDE with its core and its examples, as the files that a web server gives away:
//! it is put together here, from what is committed. No server, and nothing of what the page does.

mod examples;
mod exercises;
mod files;

pub use examples::plant_of;

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};

/// In the built page the folder of everything that belongs to a version; its name here is the
/// version.
const VERSION: &str = "version/";
/// What the page fetches to keep itself in the browser: which files its version has.
const LIST: &str = "files.json";

/// The modules of WebAssembly that the page loads: the core, and what draws and edits charts, which
/// it loads when it needs it.
pub const MODULES: [&str; 2] = ["ide_core", "ide_drawings"];

/// The modules, as wasm-bindgen gives them: files by their names.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Modules(pub BTreeMap<String, Vec<u8>>);

impl Modules {
    /// The names of their files: a script and WebAssembly for each.
    pub fn names() -> impl Iterator<Item = String> {
        MODULES.iter().flat_map(|name| [format!("{name}.js"), format!("{name}_bg.wasm")])
    }

    /// Those that are committed.
    pub fn kept() -> Modules {
        let file = |name: String| {
            let (_, bytes) = files::CORE.iter().find(|(file, _)| *file == name)?;
            Some((name, bytes.to_vec()))
        };
        Modules(Modules::names().filter_map(file).collect())
    }
}

/// The files by their paths, `/` between parts; `index.html` is the page. All but that and the
/// script that keeps the page in the browser are in a folder whose name is another one whenever
/// anything in it is: what belongs together comes together, whatever a browser has kept.
pub fn files(modules: &Modules) -> BTreeMap<String, Vec<u8>> {
    let mut inner = BTreeMap::new();
    let mut outer = BTreeMap::new();
    for (path, bytes) in files::PAGE {
        match path.strip_prefix(VERSION) {
            Some(path) => inner.insert(path.to_owned(), bytes.to_vec()),
            None => outer.insert((*path).to_owned(), bytes.to_vec()),
        };
    }
    inner.extend(modules.0.clone());
    for (name, project) in examples::projects() {
        inner.insert(format!("examples/{name}.json"), project.into_bytes());
    }
    for (name, page) in files::ERRORS {
        inner.insert(format!("errors/{name}"), page.to_vec());
    }
    let version = version_of(&inner);
    let paths: Vec<String> = inner.keys().map(|path| format!("{version}/{path}")).collect();
    inner.insert(LIST.to_owned(), serde_json::json!(paths).to_string().into_bytes());
    for bytes in outer.values_mut() {
        *bytes =
            String::from_utf8_lossy(bytes).replace(VERSION, &format!("{version}/")).into_bytes();
    }
    let inner = inner.into_iter().map(|(path, bytes)| (format!("{version}/{path}"), bytes));
    inner.chain(outer).collect()
}

/// Tells versions apart; protects nothing.
fn version_of(files: &BTreeMap<String, Vec<u8>>) -> String {
    let mut hasher = DefaultHasher::new();
    files.hash(&mut hasher);
    format!("{:016x}", hasher.finish())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn modules(byte: u8) -> Modules {
        Modules(Modules::names().map(|name| (name, vec![byte])).collect())
    }

    #[test]
    fn everything_is_in_the_folder_of_its_version() {
        let files = files(&modules(1));
        let inner = |name: &str| files.keys().find(|path| path.ends_with(&format!("/{name}")));
        let version = inner("page.js").unwrap().split('/').next().unwrap();
        let others = ["examples/station1.json", "errors/E0205.md"];
        let names = ["page.css", "worker.js"].into_iter().chain(others).map(str::to_owned);
        for name in names.chain(Modules::names()) {
            assert_eq!(*inner(&name).unwrap(), format!("{version}/{name}"));
        }
        let outer: Vec<_> = files.keys().filter(|path| !path.starts_with(version)).collect();
        assert_eq!(outer, ["index.html", "sw.js"]);
        for path in outer {
            let text = String::from_utf8_lossy(&files[path]).into_owned();
            assert!(text.contains(&format!("{version}/")) && !text.contains(VERSION), "{path}");
        }
        let list: Vec<String> = serde_json::from_slice(&files[inner(LIST).unwrap()]).unwrap();
        assert!(list.iter().all(|path| files.contains_key(path)) && list.len() == files.len() - 3);
    }

    #[test]
    fn another_core_is_another_version() {
        let paths = |byte| files(&modules(byte)).into_keys().collect::<Vec<_>>();
        assert_eq!(paths(1), paths(1));
        assert_ne!(paths(1), paths(2));
    }

    #[test]
    fn the_modules_are_there() {
        let Modules(kept) = Modules::kept();
        for name in MODULES {
            let module = format!("{name}_bg.wasm");
            assert!(kept[&module].starts_with(b"\0asm"));
            assert!(String::from_utf8_lossy(&kept[&format!("{name}.js")]).contains(&module));
        }
    }
}
