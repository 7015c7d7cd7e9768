//! Instruction lists, IL, as statements of Structured Text: what is stored becomes an assignment,
//! what is computed before it an expression. Jumps forward become IF; others are not read.
//! [`instructions`] reads lines, [`value`] is the accumulator, [`flow`] follows the ways through.

mod flow;
mod instructions;
mod value;

use chart::model::{Code, Origin};
use diagnostics::xml::Node;
use st::names::is_same;

use super::formatted::formatted;
use super::reader::Reader;
use flow::Translator;
use instructions::List;

/// The statements of an instruction list; `None`: it is another language. What is not read is
/// reported.
pub(super) fn statements(reader: &mut Reader, node: Node) -> Option<Vec<Code>> {
    if node.tag_name().name() != "IL" {
        return None;
    }
    let text = formatted(node);
    let list = List::of(&text.text);
    let mut translator = Translator::new(reader, &list, &text);
    translator.all();
    Some(translator.codes)
}

/// The value of an instruction list that computes one alone; the condition `name` may be stored at
/// its end. `None`: it does something else, or is another language.
pub(super) fn value(reader: &mut Reader, node: Node, name: &str) -> Option<Code> {
    if node.tag_name().name() != "IL" {
        return None;
    }
    let text = formatted(node);
    let mut list = List::of(&text.text);
    let is_result =
        |one: &instructions::Instruction| one.operator == "ST" && is_same(&one.operand, name);
    if list.instructions.last().is_some_and(is_result) {
        list.instructions.pop();
    }
    list.comments.clear();
    let told = reader.diagnostics.len();
    let mut translator = Translator::new(reader, &list, &text);
    let value = translator.value();
    let is_plain = translator.codes.is_empty();
    if reader.diagnostics.len() > told {
        return Some(Code::default());
    }
    let value = value.filter(|_| is_plain)?;
    Some(Code { text: value.text, origin: Origin(text.span) })
}
