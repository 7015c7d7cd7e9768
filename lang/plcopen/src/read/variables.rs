//! Lists of variables as sections of Structured Text.

use diagnostics::traced::Traced;
use diagnostics::xml::{Node, elements, tag};

use super::formatted::documentation;
use super::reader::{Reader, child, is_true, optional};
use super::types::{initial, of, rest};
use crate::diagnostic::Code;

/// The lists of an interface, and the words that begin their sections.
const LISTS: [(&str, &str); 7] = [
    ("localVars", "VAR"),
    ("tempVars", "VAR_TEMP"),
    ("inputVars", "VAR_INPUT"),
    ("outputVars", "VAR_OUTPUT"),
    ("inOutVars", "VAR_IN_OUT"),
    ("externalVars", "VAR_EXTERNAL"),
    ("globalVars", "VAR_GLOBAL"),
];

/// The section of a list; nothing where the element is none.
pub(super) fn section(reader: &mut Reader, list: Node, out: &mut Traced) -> bool {
    let name = list.tag_name().name();
    let Some((_, word)) = LISTS.iter().find(|(list, _)| *list == name) else { return false };
    if elements(list).all(|one| one.tag_name().name() != "variable") {
        rest(reader, list, &[], "a list of variables");
        return true;
    }
    let place = tag(list);
    let is_retained = is_true(list, "retain") || is_true(list, "persistent");
    let constant = if is_true(list, "constant") { " CONSTANT" } else { "" };
    let retain = if is_retained { " RETAIN" } else { "" };
    let title = optional(list, "name").filter(|_| *word == "VAR_GLOBAL");
    let title = title.map_or_else(String::new, |title| format!(" // {}", title.text));
    out.push(&format!("{word}{constant}{retain}{title}\n"), place);
    for one in elements(list) {
        match one.tag_name().name() {
            "variable" => variable(reader, one, out, 0),
            _ => reader.ignore(one, "a list of variables"),
        }
    }
    out.push("END_VAR\n", place);
    true
}

/// A line that declares a variable. `depth`: in how many types it is.
pub(super) fn variable(reader: &mut Reader, node: Node, out: &mut Traced, depth: usize) {
    let Some(name) = reader.name(node, "name") else { return };
    out.push(&"    ".repeat(depth + 1), name.span);
    out.push(&name.text, name.span);
    if let Some(address) = optional(node, "address") {
        out.push(&format!(" AT {}", address.text), address.span);
    }
    out.push(" : ", name.span);
    match child(node, "type") {
        Some(of_type) => of(reader, of_type, out, depth),
        None => {
            let message = format!("{}: there is no type", name.text);
            let help = "such as <type><BOOL/></type>";
            reader.error(Code::Incomplete, tag(node), message, help);
        }
    }
    initial(reader, node, out);
    out.push(&format!(";{}\n", comment_behind(node)), name.span);
    rest(reader, node, &["type", "initialValue"], "a variable");
}

/// What an element says about itself, as a comment at the end of its line.
pub(super) fn comment_behind(node: Node) -> String {
    let comment = documentation(node).lines().map(str::trim).collect::<Vec<_>>().join(" ");
    if comment.is_empty() { comment } else { format!(" // {comment}") }
}
