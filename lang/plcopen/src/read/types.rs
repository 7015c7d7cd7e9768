//! Types of data and initial values, as Structured Text writes them.

use diagnostics::traced::Traced;
use diagnostics::xml::{Node, elements, tag};

use super::reader::{Reader, child, optional};
use super::variables::{comment_behind, variable};
use crate::diagnostic::Code;

/// Types and values in each other at most.
const DEPTH_MAX: usize = 20;

/// A named type, in TYPE.
pub(super) fn declared(reader: &mut Reader, node: Node, out: &mut Traced) {
    let Some(name) = reader.name(node, "name") else { return };
    out.push(&format!("    {} : ", name.text), name.span);
    match child(node, "baseType") {
        Some(base) => of(reader, base, out, 0),
        None => {
            let message = format!("{}: there is no baseType", name.text);
            let help = "what the type stands for is in <baseType>";
            reader.error(Code::Incomplete, tag(node), message, help);
        }
    }
    initial(reader, node, out);
    out.push(&format!(";{}\n", comment_behind(node)), name.span);
    rest(reader, node, &["baseType", "initialValue"], "a type");
}

/// Tells what else is in an element.
pub(super) fn rest(reader: &mut Reader, node: Node, known: &[&str], of: &str) {
    for other in elements(node).filter(|one| !known.contains(&one.tag_name().name())) {
        reader.ignore(other, of);
    }
}

/// ` := value`, if there is an initial value.
pub(super) fn initial(reader: &mut Reader, node: Node, out: &mut Traced) {
    let Some(initial) = child(node, "initialValue") else { return };
    if elements(initial).next().is_some_and(|one| !says_nothing(one)) {
        out.push(" := ", tag(initial));
        value(reader, initial, out, 0);
    }
}

fn says_nothing(value: Node) -> bool {
    value.tag_name().name() == "simpleValue" && optional(value, "value").is_none()
}

fn is_too_deep(reader: &mut Reader, node: Node, depth: usize) -> bool {
    if depth > DEPTH_MAX {
        let message = format!("more than {DEPTH_MAX} in each other");
        reader.error(
            Code::Incomplete,
            tag(node),
            message,
            "give the inner ones names of their own",
        );
    }
    depth > DEPTH_MAX
}

/// The value in an element.
fn value(reader: &mut Reader, node: Node, out: &mut Traced, depth: usize) {
    if is_too_deep(reader, node, depth) {
        return;
    }
    let Some(one) = elements(node).next() else {
        return reader.error(
            Code::Incomplete,
            tag(node),
            "a value without a value",
            "leave it out",
        );
    };
    match one.tag_name().name() {
        "simpleValue" => {
            if let Some(text) = reader.needed(one, "value") {
                out.push(&text.text, text.span);
            }
        }
        "arrayValue" => {
            out.push("[", tag(one));
            for (at, element) in elements(one).enumerate() {
                out.push(if at > 0 { ", " } else { "" }, tag(element));
                let times = optional(element, "repetitionValue").filter(|times| times.text != "1");
                if let Some(times) = &times {
                    out.push(&format!("{}(", times.text), times.span);
                }
                value(reader, element, out, depth + 1);
                out.push(if times.is_some() { ")" } else { "" }, tag(element));
            }
            out.push("]", tag(one));
        }
        "structValue" => {
            out.push("(", tag(one));
            for (at, member) in elements(one).enumerate() {
                out.push(if at > 0 { ", " } else { "" }, tag(member));
                if let Some(name) = reader.name(member, "member") {
                    out.push(&format!("{} := ", name.text), name.span);
                }
                value(reader, member, out, depth + 1);
            }
            out.push(")", tag(one));
        }
        other => {
            let message = format!("{other}: no value");
            let help = "values are simpleValue, arrayValue and structValue";
            reader.error(Code::Incomplete, tag(one), message, help);
        }
    }
}

/// The type in an element such as `type` or `baseType`.
pub(super) fn of(reader: &mut Reader, node: Node, out: &mut Traced, depth: usize) {
    if is_too_deep(reader, node, depth) {
        return;
    }
    let Some(one) = elements(node).next() else {
        let help = "such as <type><BOOL/></type>";
        return reader.error(Code::Incomplete, tag(node), "there is no type", help);
    };
    let place = tag(one);
    match one.tag_name().name() {
        "derived" => {
            if let Some(name) = reader.name(one, "name") {
                out.push(&name.text, name.span);
            }
        }
        "array" => array(reader, one, out, depth),
        "subrangeSigned" | "subrangeUnsigned" => {
            base(reader, one, out, depth);
            if let Some((low, high)) = child(one, "range").and_then(|range| bounds(reader, range)) {
                out.push(&format!(" ({low}..{high})"), place);
            }
        }
        "enum" => enumeration(reader, one, out),
        "struct" => {
            out.push("STRUCT\n", place);
            for member in elements(one) {
                match member.tag_name().name() {
                    "variable" => variable(reader, member, out, depth + 1),
                    _ => reader.ignore(member, "a structure"),
                }
            }
            out.push("    END_STRUCT", place);
        }
        "string" | "wstring" => {
            let length = optional(one, "length").map(|length| format!("[{}]", length.text));
            let name = one.tag_name().name().to_uppercase();
            out.push(&format!("{name}{}", length.unwrap_or_default()), place);
        }
        "pointer" => {
            let help = "variables of blocks take its place: VAR_IN_OUT";
            reader.error(Code::OtherLanguage, place, "there are no pointers", help);
        }
        name if name.chars().all(|c| c.is_ascii_uppercase() || c == '_') => out.push(name, place),
        other => {
            let message = format!("{other}: no type of data");
            reader.error(
                Code::Incomplete,
                place,
                message,
                "types are such as <BOOL/>, <derived name=\"...\"/>",
            );
        }
    }
}

fn base(reader: &mut Reader, node: Node, out: &mut Traced, depth: usize) {
    match child(node, "baseType") {
        Some(base) => of(reader, base, out, depth + 1),
        None => {
            let message = format!("{} has no baseType", node.tag_name().name());
            reader.error(
                Code::Incomplete,
                tag(node),
                message,
                "such as <baseType><INT/></baseType>",
            );
        }
    }
}

fn bounds(reader: &mut Reader, range: Node) -> Option<(String, String)> {
    let (low, high) = (reader.needed(range, "lower"), reader.needed(range, "upper"));
    Some((low?.text, high?.text))
}

fn array(reader: &mut Reader, node: Node, out: &mut Traced, depth: usize) {
    let mut all = Vec::new();
    for dimension in elements(node).filter(|one| one.tag_name().name() == "dimension") {
        let bounds = bounds(reader, dimension);
        all.extend(bounds.map(|(low, high)| format!("{low}..{high}")));
    }
    out.push(&format!("ARRAY[{}] OF ", all.join(", ")), tag(node));
    base(reader, node, out, depth);
}

fn enumeration(reader: &mut Reader, node: Node, out: &mut Traced) {
    out.push("(", tag(node));
    let values = child(node, "values").into_iter().flat_map(elements);
    for (at, value) in values.enumerate() {
        out.push(if at > 0 { ", " } else { "" }, tag(value));
        let Some(name) = reader.name(value, "name") else { continue };
        let number = optional(value, "value").map(|number| format!(" := {}", number.text));
        out.push(&format!("{}{}", name.text, number.unwrap_or_default()), name.span);
    }
    out.push(")", tag(node));
}
