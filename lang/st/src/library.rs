//! The library of signal blocks (`lang/st/blocks`): controllers, filters, generators and models of
//! plants in Structured Text, one file a block. A program that names one gets it; the other files
//! are not parsed. The standard blocks, TON and its like, are elsewhere: every program knows them.

use std::collections::HashSet;
use std::sync::OnceLock;

use diagnostics::Source;

use crate::parser;
use crate::tree::{Declaration, File, TypeText, TypeTextKind};

/// A block of the library.
#[derive(Debug)]
pub struct Block {
    /// Its name.
    pub name: &'static str,
    /// Its file: a comment that says what it is, then a FUNCTION_BLOCK of its name.
    pub text: &'static str,
    tree: OnceLock<File>,
}

/// An input or output of a block, as its file declares it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Parameter {
    /// Its name.
    pub name: &'static str,
    /// Its type and, after `:=`, what it is where no call has given it.
    pub declared: &'static str,
    /// What it means, with its unit and range; may be empty.
    pub comment: &'static str,
    /// Whether it is an output.
    pub is_output: bool,
}

include!(concat!(env!("OUT_DIR"), "/blocks.rs"));

impl Block {
    const fn new(name: &'static str, text: &'static str) -> Block {
        Block { name, text, tree: OnceLock::new() }
    }

    /// The block of a name, in any letter case.
    pub fn find(name: &str) -> Option<&'static Block> {
        BLOCKS.iter().find(|block| block.name.eq_ignore_ascii_case(name))
    }

    /// What the comment at the beginning of its file says, in Markdown: first what the block is, in
    /// one line.
    pub fn comment(&self) -> String {
        let lines = self.text.lines().map_while(|line| line.strip_prefix("//"));
        let bare: Vec<&str> = lines.map(|line| line.strip_prefix(' ').unwrap_or(line)).collect();
        bare.join("\n")
    }

    /// Its inputs, then its outputs. Its file has each on a line of its own.
    pub fn parameters(&self) -> Vec<Parameter> {
        let mut found = Vec::new();
        let mut section = "";
        for line in self.text.lines() {
            let (code, comment) = line.split_once("//").unwrap_or((line, ""));
            let declared = code.trim().strip_suffix(';').and_then(|code| code.split_once(" : "));
            match declared {
                Some((name, declared)) if ["VAR_INPUT", "VAR_OUTPUT"].contains(&section) => {
                    let (comment, is_output) = (comment.trim(), section == "VAR_OUTPUT");
                    found.push(Parameter { name, declared, comment, is_output });
                }
                Some(_) => {}
                None if code.trim().is_empty() => {}
                None => section = code.trim(),
            }
        }
        found
    }

    /// Its syntax tree, read once.
    fn tree(&self) -> &File {
        self.tree.get_or_init(|| {
            let source = Source::new(self.name, self.text).ok();
            source.map(|source| parser::parse(&source).0).unwrap_or_default()
        })
    }
}

/// The trees of the blocks that files use and do not declare, and of those that these use.
pub(crate) fn used(files: &[File]) -> Vec<&'static File> {
    let mut seen: HashSet<String> = files.iter().flat_map(declared).collect();
    let mut found: Vec<&'static File> = Vec::new();
    let mut open: Vec<&File> = files.iter().collect();
    while let Some(file) = open.pop() {
        each_type_name(file, &mut |name| {
            if let Some(block) = Block::find(name)
                && seen.insert(name.to_uppercase())
            {
                found.push(block.tree());
                open.push(block.tree());
            }
        });
    }
    found
}

/// What a file declares that can be a type, in capitals.
fn declared(file: &File) -> impl Iterator<Item = String> {
    let units = file.units.iter().map(|unit| &unit.name);
    units.chain(file.types.iter().map(|one| &one.name)).map(|name| name.text.to_uppercase())
}

/// Calls `found` with each name that stands for a type.
fn each_type_name(file: &File, found: &mut dyn FnMut(&str)) {
    for declared in &file.types {
        in_type(&declared.of_type, found);
    }
    let sections = file.units.iter().flat_map(|unit| &unit.sections).chain(&file.globals);
    in_declarations(sections.flat_map(|section| &section.declarations), found);
}

fn in_declarations<'t>(
    list: impl IntoIterator<Item = &'t Declaration>,
    found: &mut dyn FnMut(&str),
) {
    list.into_iter().for_each(|declared| in_type(&declared.of_type, found));
}

fn in_type(text: &TypeText, found: &mut dyn FnMut(&str)) {
    match &text.kind {
        TypeTextKind::Named(name) => found(name),
        TypeTextKind::Array(_, of) => in_type(of, found),
        TypeTextKind::Struct(members) => in_declarations(members, found),
        TypeTextKind::Range(..)
        | TypeTextKind::Text(_)
        | TypeTextKind::Enumeration(_)
        | TypeTextKind::Missing => {}
    }
}
