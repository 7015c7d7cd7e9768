//! What a block has on its outside: inputs and outputs as its text declares them. What it does is
//! not known here.

use std::sync::OnceLock;

use crate::comments;
use diagnostics::Source;
use st::library::BLOCKS;
use st::tree::{Declaration, File, SectionKind, Unit, UnitKind};
use st::{parser, standard};

/// Where a block comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// The library of signal blocks.
    Library,
    /// IEC 61131-3.
    Standard,
    /// The project.
    Project,
}

/// A block from outside.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Interface {
    /// Its name.
    pub name: String,
    /// Where it comes from.
    pub origin: Origin,
    /// What it is, in a line; may be empty.
    pub summary: String,
    /// VAR_INPUT and VAR_IN_OUT, in their order.
    pub inputs: Vec<Variable>,
    /// VAR_OUTPUT.
    pub outputs: Vec<Variable>,
}

/// An input or output.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Its type, as written.
    pub of_type: String,
    /// Its initial value, as written.
    pub initial: Option<String>,
    /// What is said about it beside its declaration.
    pub comment: String,
    /// Whether it is one of VAR_IN_OUT.
    pub is_in_out: bool,
}

/// The blocks that there are: those of the language, and those of a project.
#[derive(Debug, Clone, Default)]
pub struct Interfaces(Vec<Interface>);

impl Interfaces {
    /// With these blocks of a project.
    pub fn with(blocks: Vec<Interface>) -> Interfaces {
        Interfaces(blocks)
    }

    /// With the blocks that a text declares itself.
    pub fn and_of(&self, text: &str, file: &File) -> Interfaces {
        let own = file.units.iter().filter_map(|unit| Interface::of(unit, text, Origin::Project));
        Interfaces(own.chain(self.0.iter().cloned()).collect())
    }

    /// The block of a name, in any letter case; one of the project hides one of the language.
    pub fn find(&self, name: &str) -> Option<&Interface> {
        self.all().find(|one| one.name.eq_ignore_ascii_case(name))
    }

    /// All of them, those of the project first.
    pub fn all(&self) -> impl Iterator<Item = &Interface> {
        self.0.iter().chain(of_language())
    }
}

/// The blocks that every program knows: the library, then the standard blocks.
fn of_language() -> &'static [Interface] {
    static BLOCKS_OF_LANGUAGE: OnceLock<Vec<Interface>> = OnceLock::new();
    BLOCKS_OF_LANGUAGE.get_or_init(|| {
        let library = BLOCKS.iter().flat_map(|block| {
            let mut found = of_text(block.text, Origin::Library);
            let summary = block.comment().lines().next().unwrap_or_default().to_owned();
            found.iter_mut().for_each(|one| one.summary.clone_from(&summary));
            found
        });
        library.chain(of_text(standard::BLOCKS, Origin::Standard)).collect()
    })
}

/// The function blocks of a text in Structured Text.
pub fn of_text(text: &str, origin: Origin) -> Vec<Interface> {
    let Ok(source) = Source::new("blocks.st", text) else { return Vec::new() };
    let (file, _) = parser::parse(&source);
    file.units.iter().filter_map(|unit| Interface::of(unit, text, origin)).collect()
}

impl Interface {
    /// A unit from outside; of what is no FUNCTION_BLOCK nothing.
    pub fn of(unit: &Unit, text: &str, origin: Origin) -> Option<Interface> {
        if !matches!(unit.kind, UnitKind::Block) {
            return None;
        }
        let variables = |wanted: &[SectionKind]| {
            let sections = unit.sections.iter().filter(|one| wanted.contains(&one.kind));
            let declared = |kind: SectionKind, one| variables(one, text, kind);
            let all = sections
                .flat_map(|one| one.declarations.iter().flat_map(move |it| declared(one.kind, it)));
            all.collect()
        };
        Some(Interface {
            name: unit.name.text.clone(),
            origin,
            summary: String::new(),
            inputs: variables(&[SectionKind::Input, SectionKind::InOut]),
            outputs: variables(&[SectionKind::Output]),
        })
    }
}

fn variables(one: &Declaration, text: &str, kind: SectionKind) -> Vec<Variable> {
    let initial = one.initial.as_ref().map(|value| value.span.text(text).to_owned());
    let comment = comments::after(text, one.span().end).text(text);
    let variable = |name: &st::tree::Name| Variable {
        name: name.text.clone(),
        of_type: one.of_type.span.text(text).to_owned(),
        initial: initial.clone(),
        comment: comment.to_owned(),
        is_in_out: kind == SectionKind::InOut,
    };
    one.names.iter().map(variable).collect()
}
