//! All of a project, and its programs, functions and function blocks.

use std::collections::HashMap;

use chart::Chart;
use diagnostics::Span;
use diagnostics::traced::Traced;
use diagnostics::xml::{Node, elements, tag};

use super::body::{Surroundings, body};
use super::formatted::documentation;
use super::reader::{Reader, child};
use super::types::{declared, of};
use super::variables::section;
use crate::diagnostic::{Code, Diagnostic};

/// What a project has, in the order in which it is written.
#[derive(Default)]
struct Parts<'a, 'i> {
    types: Vec<Node<'a, 'i>>,
    globals: Vec<Node<'a, 'i>>,
    units: Vec<Node<'a, 'i>>,
}

/// All of a project.
pub(super) fn project(reader: &mut Reader, root: Node, out: &mut Traced) -> Vec<Chart> {
    let mut parts = Parts::default();
    for part in elements(root) {
        match part.tag_name().name() {
            "fileHeader" => {}
            "contentHeader" => settings(part, out),
            "types" => parts.types(reader, part),
            "instances" => parts.instances(reader, part),
            "addData" => parts.added(reader, part),
            _ => reader.ignore(part, "a project"),
        }
    }
    for line in documentation(root).lines() {
        out.push(&format!("// {}\n", line.trim()), tag(root));
    }
    if !parts.types.is_empty() {
        out.push("TYPE\n", tag(root));
        parts.types.iter().for_each(|one| declared(reader, *one, out));
        out.push("END_TYPE\n\n", tag(root));
    }
    for list in &parts.globals {
        section(reader, *list, out);
        out.push("\n", tag(*list));
    }
    once(reader, &parts.types, &parts.units);
    let units = parts.units.iter().enumerate();
    let charts = units.filter_map(|(at, node)| {
        out.push(if at > 0 { "\n" } else { "" }, tag(*node));
        unit(reader, *node, out)
    });
    charts.collect()
}

/// Settings of a program stand in the comment of its project.
fn settings(header: Node, out: &mut Traced) {
    let Some(comment) = child(header, "Comment") else { return };
    let lines = comment.text().unwrap_or("").lines().map(str::trim);
    for line in lines.filter(|line| line.starts_with("//#")) {
        out.push(&format!("{line}\n"), tag(comment));
    }
}

/// Reports types and units whose name another one has.
fn once(reader: &mut Reader, types: &[Node], units: &[Node]) {
    let mut seen: HashMap<String, Span> = HashMap::new();
    for node in types.iter().chain(units) {
        let Some(name) = super::reader::optional(*node, "name") else { continue };
        if let Some(first) = seen.insert(name.text.to_uppercase(), name.span) {
            let message = format!("{}: another type or unit has this name", name.text);
            let twice = Diagnostic::new(Code::Twice, name.span, message);
            reader.report(twice.related(first, "this one").help("letter case does not matter"));
        }
    }
}

impl<'a, 'i> Parts<'a, 'i> {
    fn types(&mut self, reader: &mut Reader, node: Node<'a, 'i>) {
        for list in elements(node) {
            match list.tag_name().name() {
                "dataTypes" | "pous" => self.list(reader, list),
                _ => reader.ignore(list, "types"),
            }
        }
    }

    fn list(&mut self, reader: &mut Reader, list: Node<'a, 'i>) {
        for one in elements(list) {
            match one.tag_name().name() {
                "dataType" => self.types.push(one),
                "pou" => self.units.push(one),
                "globalVars" => self.globals.push(one),
                "addData" => self.added(reader, one),
                _ => reader.ignore(one, "a list of types and units"),
            }
        }
    }

    /// Variables of configurations and resources are for all here.
    fn instances(&mut self, reader: &mut Reader, node: Node<'a, 'i>) {
        let lists = elements(node).flat_map(elements);
        for part in lists.flat_map(elements) {
            match part.tag_name().name() {
                "globalVars" => self.globals.push(part),
                "resource" => self.resource(reader, part),
                "addData" => self.added(reader, part),
                _ => reader.ignore(part, "a configuration"),
            }
        }
    }

    fn resource(&mut self, reader: &mut Reader, node: Node<'a, 'i>) {
        for part in elements(node) {
            match part.tag_name().name() {
                "globalVars" => self.globals.push(part),
                "addData" => self.added(reader, part),
                // Every program is executed once a scan.
                "pouInstance" => {}
                "task" => {
                    let message = "a task is left out: each program is executed once a scan";
                    reader.report(Diagnostic::new(Code::Ignored, tag(part), message));
                }
                _ => reader.ignore(part, "a resource"),
            }
        }
    }

    /// Vendors put units, types and variables into additional data, too.
    fn added(&mut self, reader: &mut Reader, node: Node<'a, 'i>) {
        for data in elements(node) {
            let known: Vec<Node> = elements(data)
                .filter(|one| matches!(one.tag_name().name(), "dataType" | "pou" | "globalVars"))
                .collect();
            match known.is_empty() {
                true => reader.data(data),
                false => self.list(reader, data),
            }
        }
    }
}

/// A program, function or function block; returns its chart.
pub(super) fn unit(reader: &mut Reader, node: Node, out: &mut Traced) -> Option<Chart> {
    let (name, kind) = (reader.name(node, "name")?, reader.needed(node, "pouType")?);
    let word = match kind.text.as_str() {
        "program" => "PROGRAM",
        "function" => "FUNCTION",
        "functionBlock" => "FUNCTION_BLOCK",
        other => {
            let message = format!("{other}: no kind of unit");
            let help = "kinds are program, function and functionBlock";
            reader.error(Code::Incomplete, kind.span, message, help);
            return None;
        }
    };
    for line in documentation(node).lines() {
        out.push(&format!("// {}\n", line.trim()), name.span);
    }
    out.push(&format!("{word} "), name.span);
    out.push(&name.text, name.span);
    let interface = child(node, "interface");
    if let Some(result) = interface.and_then(|one| child(one, "returnType")) {
        out.push(" : ", name.span);
        of(reader, result, out, 0);
    } else if word == "FUNCTION" {
        let message = format!("{}: there is no returnType", name.text);
        let help = "a function has a result: <returnType><BOOL/></returnType> in its interface";
        reader.error(Code::Incomplete, tag(node), message, help);
    }
    out.push("\n", name.span);
    for list in interface.into_iter().flat_map(elements) {
        if list.tag_name().name() != "returnType" && !section(reader, list, out) {
            reader.ignore(list, "an interface");
        }
    }
    let around = Surroundings { unit: &name.text, node };
    let chart = body(reader, &around, out);
    for part in elements(node) {
        if !["interface", "actions", "transitions", "body"].contains(&part.tag_name().name()) {
            reader.ignore(part, "a unit");
        }
    }
    out.push(&format!("END_{word}\n"), name.span);
    chart
}
