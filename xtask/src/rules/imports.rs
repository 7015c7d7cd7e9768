//! Which file of a crate uses which: no knots of files that use each other, and folders in one
//! order.
//!
//! Read from the text. A use is a path that begins with `crate::`, `super::`, `self::` or the name
//! of a module below the file; it leads through `use` lines on its way to the file that has the
//! item. What does not count: tests, comments, and the `pub use` lines by which a module
//! re-exports what is below it.

use std::collections::{BTreeMap, BTreeSet};

use super::paths::{Use, paths};

/// Files that may use each other in a ring. More are a knot: none of them can be understood, tested
/// or moved alone.
const KNOT_MAX: usize = 3;

/// Folders and files of the assembler from the first to the last: none uses a later one.
const ORDERS: &[(&str, &[&str])] = &[(
    "awl-asm/src/",
    &[
        "diagnostic",
        "text",
        "meaning",
        "plan",
        "image",
        "assemble",
        "output",
        "host",
        "lib",
        "main",
    ],
)];

/// What breaks the rules in the files of the repository, given with their texts.
pub(super) fn breaches(files: &[(String, String)]) -> Vec<String> {
    let mut breaches = Vec::new();
    for (root, crate_files) in crates(files) {
        let tree = Tree::new(root, &crate_files);
        let uses = tree.uses();
        for knot in knots(&uses).iter().filter(|knot| knot.len() > KNOT_MAX) {
            let names: Vec<&str> = knot.iter().map(|&file| tree.names[file]).collect();
            breaches.push(format!(
                "{root}: {} files use each other: {}",
                knot.len(),
                names.join(", ")
            ));
        }
        if let Some((_, order)) = ORDERS.iter().find(|(name, _)| *name == root) {
            breaches.extend(out_of_order(&tree, &uses, order));
        }
    }
    breaches
}

/// The files of each crate by its source folder, without tests.
fn crates(files: &[(String, String)]) -> BTreeMap<&str, Vec<(&str, &str)>> {
    let mut crates: BTreeMap<&str, Vec<(&str, &str)>> = BTreeMap::new();
    for (file, text) in files.iter().filter(|(file, _)| file.ends_with(".rs")) {
        let Some(at) = file.find("src/") else { continue };
        let (root, name) = file.split_at(at + "src/".len());
        let is_test = name.ends_with("_tests.rs") || name.ends_with("/tests.rs");
        if !is_test && !name.starts_with("bin/") {
            crates.entry(root).or_default().push((name, text));
        }
    }
    crates
}

fn out_of_order(tree: &Tree<'_>, uses: &[BTreeSet<usize>], order: &[&str]) -> Vec<String> {
    let rank = |file: usize| {
        let top = tree.names[file].split(['/', '.']).next().unwrap_or_default();
        order.iter().position(|name| *name == top)
    };
    let mut breaches = Vec::new();
    for (file, used) in uses.iter().enumerate() {
        let Some(own) = rank(file) else {
            breaches
                .push(format!("{}{}: not in the order of folders", tree.root, tree.names[file]));
            continue;
        };
        let later = used.iter().filter(|&&used| rank(used).is_some_and(|rank| rank > own));
        breaches.extend(later.map(|&used| {
            let (name, used) = (tree.names[file], tree.names[used]);
            format!("{}{name}: uses {used}, which comes after it", tree.root)
        }));
    }
    breaches
}

/// Sets of files that all reach each other.
fn knots(uses: &[BTreeSet<usize>]) -> Vec<BTreeSet<usize>> {
    let reached: Vec<BTreeSet<usize>> = (0..uses.len()).map(|start| reach(uses, start)).collect();
    let knot = |file: usize| -> BTreeSet<usize> {
        reached[file].iter().copied().filter(|&other| reached[other].contains(&file)).collect()
    };
    let all: BTreeSet<BTreeSet<usize>> = (0..uses.len()).map(knot).collect();
    all.into_iter().filter(|knot| knot.len() > 1).collect()
}

fn reach(uses: &[BTreeSet<usize>], start: usize) -> BTreeSet<usize> {
    let mut reached = BTreeSet::new();
    let mut open = vec![start];
    while let Some(file) = open.pop() {
        open.extend(uses[file].iter().copied().filter(|&used| reached.insert(used)));
    }
    reached
}

/// The modules of a crate.
struct Tree<'t> {
    root: &'t str,
    /// The names of the files below the root.
    names: Vec<&'t str>,
    /// The path of each file's module; both roots of a crate with two have the empty one.
    modules: Vec<Vec<&'t str>>,
    paths: Vec<Vec<Use>>,
}

impl<'t> Tree<'t> {
    fn new(root: &'t str, files: &[(&'t str, &'t str)]) -> Tree<'t> {
        let modules: Vec<Vec<&str>> = files.iter().map(|(name, _)| module(name)).collect();
        let paths = files.iter().zip(&modules).map(|((_, text), own)| {
            let below = modules.iter().filter(|other| other.len() == own.len() + 1);
            let below =
                below.filter(|other| other.starts_with(own)).filter_map(|other| other.last());
            paths(text, &below.copied().collect::<Vec<_>>())
        });
        let paths = paths.collect();
        Tree { root, names: files.iter().map(|(name, _)| *name).collect(), modules, paths }
    }

    /// The files that each file uses.
    fn uses(&self) -> Vec<BTreeSet<usize>> {
        let of = |file: usize| {
            let own = &self.modules[file];
            let used = self.paths[file].iter().filter_map(move |path| {
                let used = self.resolve(own, &path.path, 0)?;
                let is_below = self.modules[used].starts_with(own);
                (used != file && !(path.is_public && is_below)).then_some(used)
            });
            used.collect()
        };
        (0..self.names.len()).map(of).collect()
    }

    /// The files of a module: two for the root of a crate that is a library and a command.
    fn files(&self, module: &[&str]) -> impl Iterator<Item = usize> + '_ {
        let module: Vec<String> = module.iter().map(|part| (*part).to_owned()).collect();
        (0..self.names.len()).filter(move |&file| self.modules[file] == *module)
    }

    /// The file that has the item to which a path in a module leads; `None` outside the crate.
    fn resolve(&self, from: &[&str], path: &[String], depth: usize) -> Option<usize> {
        const DEPTH_MAX: usize = 16;
        if depth > DEPTH_MAX {
            return None;
        }
        let mut module: Vec<&str> = from.to_vec();
        for (index, part) in path.iter().enumerate() {
            match part.as_str() {
                "crate" => module.clear(),
                "self" => {}
                "super" => {
                    module.pop();
                }
                name => {
                    let below = [module.as_slice(), &[name]].concat();
                    if self.files(&below).next().is_some() {
                        module.push(name);
                        continue;
                    }
                    return match self.alias(&module, name) {
                        Some(alias) => {
                            let rest = path.get(index + 1..).unwrap_or(&[]);
                            let path = [alias.as_slice(), rest].concat();
                            self.resolve(&module, &path, depth + 1)
                        }
                        None if index == 0 => None,
                        None => self.files(&module).next(),
                    };
                }
            }
        }
        self.files(&module).next()
    }

    /// What a `use` line of a module says about a name.
    fn alias(&self, module: &[&str], name: &str) -> Option<&Vec<String>> {
        let lines = self.files(module).flat_map(|file| &self.paths[file]);
        lines.filter(|line| line.name.as_deref() == Some(name)).map(|line| &line.path).next()
    }
}

/// `text/format/mod.rs` is `text::format`.
fn module(name: &str) -> Vec<&str> {
    let name = name.trim_end_matches(".rs");
    let name = name.strip_suffix("/mod").unwrap_or(name);
    if matches!(name, "lib" | "main") { Vec::new() } else { name.split('/').collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(files: &[(&str, &str)]) -> Vec<String> {
        let owned = files.iter().map(|(name, text)| (format!("x/src/{name}"), (*text).to_owned()));
        breaches(&owned.collect::<Vec<_>>())
    }

    #[test]
    fn a_ring_of_four_is_a_knot_and_one_of_three_is_none() {
        let ring = |last: &'static str| {
            [
                ("lib.rs", "mod a;\nmod b;\nmod c;\nmod d;\npub use d::D;"),
                ("a.rs", "use crate::b::{self, B};"),
                ("b/mod.rs", "//! [`x`](crate::a)\nuse super::c::C;"),
                ("c.rs", "fn f() { crate::D::new(); }"),
                ("d.rs", last),
            ]
        };
        let text = "x/src/: 4 files use each other: a.rs, b/mod.rs, c.rs, d.rs";
        assert_eq!(found(&ring("use crate::a::A;")), [text]);
        assert_eq!(found(&ring("use crate::b::B;")), [""; 0]);
        assert_eq!(found(&ring("#[cfg(test)]\nmod tests {\n    use crate::a::A;\n}")), [""; 0]);
    }

    #[test]
    fn a_parent_that_reexports_uses_nothing() {
        let files = |head: &'static str| {
            [
                ("lib.rs", "mod p;"),
                ("p/mod.rs", head),
                ("p/a.rs", "use super::b::B;\nuse super::P;"),
                ("p/b.rs", "use crate::p::c::C;"),
                ("p/c.rs", "pub struct C;"),
            ]
        };
        assert_eq!(found(&files("mod a;\npub use a::A;\npub struct P;")), [""; 0]);
        let tree = files("mod a;\nfn f() { a::f() }\npub struct P;");
        let (_, files) = (0, tree.map(|(name, text)| (name, text)));
        let uses = Tree::new("x/src/", &files).uses();
        assert!(uses[1].contains(&2), "a path in the body is a use");
        assert_eq!(knots(&uses).len(), 1);
    }

    #[test]
    fn folders_have_an_order() {
        let files = [
            ("awl-asm/src/lib.rs", "mod text;\nmod image;"),
            ("awl-asm/src/text/mod.rs", "pub mod lexer;"),
            ("awl-asm/src/text/lexer.rs", "use crate::image::encode;"),
            ("awl-asm/src/image/mod.rs", "pub mod encode;"),
            ("awl-asm/src/image/encode.rs", "use crate::text::lexer::Lexer;"),
        ];
        let files = files.map(|(name, text)| (name.to_owned(), text.to_owned()));
        let text = "awl-asm/src/text/lexer.rs: uses image/encode.rs, which comes after it";
        assert_eq!(breaches(&files), [text]);
    }
}
