//! From a text to XML: Structured Text with charts, or diagrams of blocks, as a project of PLCopen
//! TC6, version 2.01. [`types`] writes declarations, [`units`] programs and blocks, [`chart`] and
//! [`diagram`] drawings. What has no place in such a project is refused; comments find one
//! ([`comments`]).

mod chart;
mod comments;
mod diagram;
mod types;
mod units;

use std::collections::HashSet;

use ::chart::set_reset::plcopen_head;
use ::chart::text::{self, Reading};
use ::diagram::drawing::{Sheet, TooLarge, draw};
use ::diagram::interfaces::Interfaces;
use diagnostics::xml::Writer;
use diagnostics::{Severity, Source, Span};
use st::tree::{File, Section};

use crate::diagnostic::{Code, Diagnostic};
use comments::Comments;

const NAMESPACES: [(&str, &str); 2] = [
    ("xmlns", "http://www.plcopen.org/xml/tc6_0201"),
    ("xmlns:xhtml", "http://www.w3.org/1999/xhtml"),
];

/// A text as a project.
#[derive(Debug)]
pub struct Exported {
    /// The file; empty where there are errors.
    pub text: String,
    /// What has no place in a project.
    pub diagnostics: Vec<Diagnostic>,
}

/// Writes a text with charts as a project. It has no errors: [`::chart::translate`] says so.
pub fn write(source: &Source) -> Exported {
    let reading = text::read(source);
    let file = ::chart::frame(source, &reading, &mut HashSet::new());
    project(source, &file, &reading, &[])
}

/// Writes a text with diagrams as a project: their bodies in FBD. It has no errors:
/// [`::diagram::read`] says so.
///
/// # Errors
/// A diagram with more elements than are drawn.
pub fn write_diagrams(source: &Source) -> Result<Exported, TooLarge> {
    let (file, _) = st::parser::parse(source);
    let sheets = draw(source, &file, &Interfaces::default())?.sheets;
    // There are no charts in it.
    let (document, regions, diagnostics) = Default::default();
    let reading = Reading { document, regions, diagnostics };
    Ok(project(source, &file, &reading, &sheets))
}

fn project(source: &Source, file: &File, reading: &Reading, sheets: &[Sheet]) -> Exported {
    let interfaces = Interfaces::default().and_of(&source.text, file);
    let out = Writer::default();
    let mut project = Project { source, found: Vec::new(), sheets, interfaces, out };
    project.all(file, reading);
    let Project { out, found: mut diagnostics, .. } = project;
    diagnostics.sort_by_key(|one| one.span);
    if diagnostics.iter().any(|one| one.severity() == Severity::Error) {
        return Exported { text: String::new(), diagnostics };
    }
    Exported { text: out.finish(), diagnostics }
}

/// A project that is being written.
struct Project<'s> {
    source: &'s Source,
    found: Vec<Diagnostic>,
    /// The units that are diagrams, as they are drawn, in the order of the text.
    sheets: &'s [Sheet],
    /// The blocks that they know.
    interfaces: Interfaces,
    out: Writer,
}

impl Project<'_> {
    fn text(&self, span: Span) -> &str {
        span.text(&self.source.text)
    }

    fn refuse(&mut self, span: Span, message: impl Into<String>, help: &str) {
        self.found.push(Diagnostic::new(Code::NoPlace, span, message).help(help));
    }

    /// `{coarse}`, which is lost.
    fn refuse_coarse(&mut self, pragma: Span) {
        let help = "without it the time is exact";
        self.refuse(pragma, "{coarse}: a project of PLCopen has no pragmas", help);
    }

    /// The upper left corner of an element.
    fn corner(&mut self, x: i32, y: i32) {
        self.out.empty("position", &[("x", &x.to_string()), ("y", &y.to_string())]);
    }

    fn open(&mut self, name: &str, attributes: &[(&str, &str)]) {
        self.out.begin(name, attributes);
    }

    fn close(&mut self) {
        self.out.end();
    }

    /// What an element says about itself.
    fn documentation(&mut self, text: &str) {
        if !text.is_empty() {
            self.open("documentation", &[]);
            self.out.text("xhtml:p", &[], text);
            self.close();
        }
    }

    fn all(&mut self, file: &File, reading: &Reading) {
        let comments = &Comments::of(self.source, file, reading);
        let units = units::units(file, reading);
        let settings = file.settings.iter().map(|span| self.text(*span));
        let settings = settings.collect::<Vec<_>>().join("\n");
        self.open("project", &NAMESPACES);
        plcopen_head(&mut self.out, &text::program_name(&self.source.name), &settings);
        self.open("types", &[]);
        self.open("dataTypes", &[]);
        file.types.iter().for_each(|one| self.declared(one, comments));
        self.close();
        self.open("pous", &[]);
        units.iter().for_each(|one| self.unit(one, comments));
        self.close();
        self.close();
        self.configuration(file, &units, comments);
        self.documentation(comments.of_file());
        self.close();
    }

    /// The global variables, and the programs, which are executed once a scan.
    fn configuration(&mut self, file: &File, units: &[units::Written], comments: &Comments) {
        self.open("instances", &[]);
        self.open("configurations", &[]);
        self.open("configuration", &[("name", "Configuration")]);
        self.open("resource", &[("name", "Resource")]);
        for unit in units.iter().filter(|unit| unit.is_program()) {
            let name = unit.name();
            self.out.empty("pouInstance", &[("name", name), ("typeName", name)]);
        }
        self.close();
        file.globals.iter().for_each(|list| self.section("globalVars", list, comments));
        self.close();
        self.close();
        self.close();
    }

    /// A list of variables.
    fn section(&mut self, name: &str, section: &Section, comments: &Comments) {
        let mut head = Vec::new();
        head.extend(section.is_constant.then_some(("constant", "true")));
        head.extend(section.is_retained.then_some(("retain", "true")));
        self.open(name, &head);
        section.declarations.iter().for_each(|one| self.variables(one, comments));
        self.close();
    }
}
