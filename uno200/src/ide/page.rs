//! The files of the page: which are given away, as what, and what a browser may do with them.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Component, Path, PathBuf};

use ide_site::Modules;

/// What is given away, by its ending.
pub const ENDINGS: &[(&str, &str)] = &[
    ("html", "text/html; charset=utf-8"),
    ("js", "text/javascript; charset=utf-8"),
    ("css", "text/css; charset=utf-8"),
    ("json", "application/json; charset=utf-8"),
    ("wasm", "application/wasm"),
    ("svg", "image/svg+xml"),
    ("png", "image/png"),
    ("txt", "text/plain; charset=utf-8"),
    ("md", "text/markdown; charset=utf-8"),
];

/// What a browser may do with the page at a host: nothing but what is served here, in no frame of
/// others, and no address given away. That a page's own WebSockets are of its site is no news to
/// all browsers yet.
pub fn headers(host: &str) -> Vec<(&'static str, String)> {
    let policy = format!(
        "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; \
         img-src 'self' data: blob:; connect-src 'self' ws://{host}; worker-src 'self'; \
         object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    );
    let others = [
        ("X-Content-Type-Options", "nosniff"),
        ("Referrer-Policy", "no-referrer"),
        ("Cross-Origin-Opener-Policy", "same-origin"),
        ("Cross-Origin-Resource-Policy", "same-origin"),
        ("Cache-Control", "no-cache"),
    ];
    let others = others.map(|(name, value)| (name, value.to_owned()));
    [("Content-Security-Policy", policy)].into_iter().chain(others).collect()
}

/// The page.
#[derive(Debug)]
pub enum Page {
    /// The one that is part of this program: its files by their paths.
    Own(BTreeMap<String, Vec<u8>>),
    /// One in a folder, whose path has no links.
    In(PathBuf),
}

impl Page {
    /// The one that is part of this program.
    pub fn own() -> Page {
        Page::Own(ide_site::files(&Modules::kept()))
    }

    /// The file of an address's path, with its type; `/` is the page itself.
    pub fn file(&self, path: &str) -> Option<(Vec<u8>, &'static str)> {
        let path = path.trim_start_matches('/');
        let path = Path::new(if path.is_empty() { "index.html" } else { path });
        let is_plain = |part: Component<'_>| match part {
            Component::Normal(name) => !name.to_string_lossy().starts_with('.'),
            _ => false,
        };
        if !path.components().all(is_plain) {
            return None;
        }
        let ending = path.extension()?.to_str()?;
        let (_, kind) = ENDINGS.iter().find(|(known, _)| *known == ending)?;
        let bytes = match self {
            Page::Own(files) => files.get(path.to_str()?)?.clone(),
            Page::In(folder) => {
                // A link may lead out of the folder.
                let file = fs::canonicalize(folder.join(path)).ok()?;
                fs::read(file.starts_with(folder).then_some(file)?).ok()?
            }
        };
        Some((bytes, kind))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_but_the_page_is_given_away() {
        let outer = tempfile::tempdir().unwrap();
        let folder = outer.path().join("page");
        fs::create_dir_all(folder.join("examples")).unwrap();
        fs::create_dir_all(folder.join(".git")).unwrap();
        for (name, text) in [
            ("page/index.html", "<p>"),
            ("page/examples/a.json", "{}"),
            ("page/notes.zip", "x"),
            ("page/.git/a.json", "x"),
            ("secret.json", "x"),
        ] {
            fs::write(outer.path().join(name), text).unwrap();
        }
        #[cfg(unix)]
        std::os::unix::fs::symlink(outer.path().join("secret.json"), folder.join("link.json"))
            .unwrap();
        let page = Page::In(fs::canonicalize(&folder).unwrap());
        assert_eq!(page.file("/").unwrap().0, b"<p>");
        assert_eq!(page.file("/examples/a.json").unwrap().1, ENDINGS[3].1);
        for url in [
            "/notes.zip",
            "/../secret.json",
            "/examples/../../secret.json",
            "/.git/a.json",
            "/link.json",
            "/nothing.html",
            "//etc/passwd",
            "/examples",
        ] {
            assert!(page.file(url).is_none(), "{url}");
        }
    }

    #[test]
    fn the_page_is_part_of_the_program() {
        let page = Page::own();
        let (index, _) = page.file("/").unwrap();
        let index = String::from_utf8(index).unwrap();
        let (_, script) = index.split_once("src=\"").unwrap();
        let script = script.split('"').next().unwrap();
        assert_eq!(page.file(&format!("/{script}")).unwrap().1, ENDINGS[1].1);
        for module in ide_site::MODULES {
            let module = script.replace("page.js", &format!("{module}_bg.wasm"));
            assert!(page.file(&module).unwrap().0.starts_with(b"\0asm"));
        }
        assert!(page.file("/Cargo.toml").is_none() && page.file("/..").is_none());
    }
}
