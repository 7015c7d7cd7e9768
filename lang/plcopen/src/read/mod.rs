//! From XML to a text: Structured Text with charts, as a person would write it, and where in the
//! file everything in it was read. [`types`] and [`variables`] write declarations, [`body`] what a
//! unit does, [`network`] and [`chart`] make a chart of a drawing.

mod body;
mod chart;
mod condition;
mod diagram;
mod drawn;
mod formatted;
mod il;
mod macro_step;
mod network;
mod operand;
mod reader;
mod types;
mod units;
mod variables;

use ::chart::Chart;
use diagnostics::traced::Traced;
use diagnostics::xml::{self, Node, attribute, elements, tag};
use diagnostics::{Severity, Source, Span};

use crate::diagnostic::{Code, Diagnostic};
use reader::Reader;

/// Most bytes of a file.
const BYTES_MAX: usize = 16_000_000;

/// What is in a file.
#[derive(Debug, Default)]
pub struct Imported {
    /// The project as a text: Structured Text, with charts as `.sfc` has them. It is empty where
    /// there are errors.
    pub text: Traced,
    /// Its charts, those of actions inside of them.
    pub charts: Vec<Chart>,
    /// Errors and warnings.
    pub diagnostics: Vec<Diagnostic>,
}

/// Whether a file in XML is for [`read`]: a project of PLCopen, one unit of such a project, or none
/// that is known, but no chart of SFCEdit. A file that is no XML is not.
pub fn is_project(source: &Source) -> bool {
    xml::parse(&source.text).is_ok_and(|document| {
        let root = document.root_element();
        kind(root).is_some() || !root.tag_name().name().eq_ignore_ascii_case("project")
    })
}

/// What the first element of a file of PLCopen is.
enum Root {
    Project,
    Unit,
}

fn kind(root: Node) -> Option<Root> {
    let is_of_plcopen =
        root.tag_name().namespace().is_some_and(|name| name.contains("plcopen.org/xml/tc6"));
    let has = |name: &str| elements(root).any(|child| child.tag_name().name() == name);
    match root.tag_name().name() {
        "project" if is_of_plcopen || has("types") || has("fileHeader") => Some(Root::Project),
        "pou" if is_of_plcopen || attribute(root, "pouType").is_some() => Some(Root::Unit),
        _ => None,
    }
}

/// Reads a file. All that is wrong comes in one run.
pub fn read(source: &Source) -> Imported {
    read_with(source, Reader::new(&source.text))
}

/// The same for a text with diagrams: statements of bodies in FBD have the places at which they are
/// drawn.
pub fn read_diagrams(source: &Source) -> Imported {
    let mut reader = Reader::new(&source.text);
    reader.has_places = true;
    read_with(source, reader)
}

fn read_with(source: &Source, mut reader: Reader) -> Imported {
    let mut out = Traced::default();
    let mut charts = Vec::new();
    if source.text.len() > BYTES_MAX {
        let message = format!("a file of more than {} MB", BYTES_MAX / 1_000_000);
        let error = Diagnostic::new(Code::BrokenXml, Span::new(0, 0), message);
        reader.report(error.help("export fewer units at a time"));
    } else {
        match xml::parse(&source.text) {
            Ok(document) => charts = root(&mut reader, document.root_element(), &mut out),
            Err(broken) => {
                reader.report(Diagnostic::new(Code::BrokenXml, broken.span, broken.message));
            }
        }
    }
    let mut diagnostics = reader.diagnostics;
    diagnostics.sort_by_key(|one| one.span);
    if diagnostics.iter().any(|one| one.severity() == Severity::Error) {
        return Imported { diagnostics, ..Imported::default() };
    }
    Imported { text: out, charts, diagnostics }
}

fn root(reader: &mut Reader, node: Node, out: &mut Traced) -> Vec<Chart> {
    match kind(node) {
        Some(Root::Project) => units::project(reader, node, out),
        Some(Root::Unit) => units::unit(reader, node, out).into_iter().collect(),
        None => {
            let name = node.tag_name().name();
            let message = format!("{name}: this is no project of PLCopen");
            let error = Diagnostic::new(Code::OtherFile, tag(node), message);
            reader.report(error.help(match name {
                "project" if elements(node).any(|one| one.tag_name().name() == "grafcet") => {
                    "`uno200 convert chart.xml -o chart.st` makes Structured Text of a chart of SFCEdit"
                }
                "Project" => "IEC 61131-10 is another format: export as PLCopen XML, version 2.01",
                "TcPlcObject" => "this is a file of TwinCAT itself: export it as PLCopen XML",
                _ => "it begins with <project xmlns=\"http://www.plcopen.org/xml/tc6_0201\">",
            }));
            Vec::new()
        }
    }
}
