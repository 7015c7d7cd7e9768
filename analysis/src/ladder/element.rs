//! What an instruction looks like: the instruction table says it.

use awl_asm::ast::{self, Instruction, Section, Value};
use awl_asm::select::operand_name;
use plc_isa::{Group, Op, Role, Rung as Part, Written};

use super::picture::{Element, Operand, Pin, Power, Shape, Side, Through};
use super::sheet::Sheet;

/// In a contact that is closed where its bit is 0.
const INVERTED: &str = "/";

/// The element of a contact, coil or box.
pub(super) fn element(sheet: Sheet<'_>, one: &Instruction, line: usize) -> Element {
    let shape = shape(one);
    let written = one.mnemonic_span.text(&sheet.source.text).to_uppercase();
    let symbol = match shape {
        Shape::Contact => contact(one),
        Shape::Coil => written.strip_prefix('=').unwrap_or(&written).to_owned(),
        Shape::Box => routine(sheet, one).unwrap_or_else(|| written.clone()),
    };
    let through = if shape == Shape::Contact { Through::And } else { Through::Ends };
    let pins = pins(sheet, one, shape);
    make(one, line, (shape, through), symbol, written, pins)
}

/// The element of what works on the power flow in a wire and has no contact of its own; `None` for
/// other instructions.
pub(super) fn inline(sheet: Sheet<'_>, one: &Instruction, line: usize) -> Option<Element> {
    let written = one.mnemonic_span.text(&sheet.source.text).to_uppercase();
    let (symbol, through) = match one.entry.op {
        Op::Not => ("NOT", Through::Inverted),
        Op::Eu => ("P", Through::Edge),
        Op::Ed => ("N", Through::Edge),
        Op::Nop => ("NOP", Through::All),
        _ => return None,
    };
    let pins = pins(sheet, one, Shape::Contact);
    Some(make(one, line, (Shape::Contact, through), symbol.to_owned(), written, pins))
}

fn make(
    one: &Instruction,
    line: usize,
    (shape, through): (Shape, Through),
    symbol: String,
    mnemonic: String,
    pins: Vec<Pin>,
) -> Element {
    let powers = powers(one, shape);
    Element {
        shape,
        through,
        is_load: one.entry.rung == Part::Loads,
        is_inverted: shape == Shape::Contact && symbol.contains(INVERTED),
        relation: one.relation,
        symbol,
        mnemonic,
        line,
        eno: None,
        pins,
        powers,
        output: None,
        column: 0,
        row: 0,
        columns: 1,
        rows: 1,
    }
}

/// A coil writes a bit, or does something without data; the rest are boxes.
fn shape(one: &Instruction) -> Shape {
    let entry = one.entry;
    if entry.rung.is_contact() {
        return Shape::Contact;
    }
    let first = entry.forms.first().and_then(|form| form.kinds.first());
    let is_bit = first.is_some_and(|kind| kind.value_type() == Some(plc_isa::Type::Bit));
    let writes_bit = is_bit && entry.roles.first().is_some_and(|role| role.writes());
    let takes = |wanted: Written| {
        let mut kinds = entry.forms.iter().flat_map(|form| form.kinds);
        kinds.any(|kind| kind.written() == wanted)
    };
    let has_data = || entry.written_roles().any(Role::reads) || takes(Written::Routine);
    let is_plain = || !entry.op.has_eno() && !has_data();
    if entry.group == Group::Coil || writes_bit || is_plain() { Shape::Coil } else { Shape::Box }
}

/// What is written in a contact: the end of its mnemonic says it. `/` for an inverted one, `I` for
/// one beside the process image, a comparison with the type of its values.
fn contact(one: &Instruction) -> String {
    let begin = match one.entry.rung {
        Part::Loads => "LD",
        Part::Ands => "A",
        _ => "O",
    };
    let end = one.mnemonic().strip_prefix(begin).unwrap_or_default();
    match one.relation {
        Some(relation) => {
            let sign = if relation.symbol() == "=" { "==" } else { relation.symbol() };
            // Words are compared as integers.
            format!("{sign}{}", if end == "W" { "I" } else { end })
        }
        None => end.replace('N', INVERTED),
    }
}

/// The name of the routine that is called.
fn routine(sheet: Sheet<'_>, one: &Instruction) -> Option<String> {
    let operand = one.operands.first().filter(|_| one.entry.op == Op::Call)?;
    Some(operand.span.text(&sheet.source.text).trim_matches('"').to_owned())
}

fn pins(sheet: Sheet<'_>, one: &Instruction, shape: Shape) -> Vec<Pin> {
    if one.entry.op == Op::Call {
        return parameters(sheet, one);
    }
    let kinds = one.entry.forms.first().map_or(&[][..], |form| form.kinds);
    let columns = kinds.iter().zip(one.entry.roles).zip(one.entry.operand_names);
    let columns = columns.filter(|((kind, _), _)| kind.is_written());
    let mut pins = Vec::new();
    for (operand, ((kind, role), name)) in one.operands.iter().zip(columns) {
        let is_numbered = matches!(kind.written(), Written::Timer | Written::Counter);
        let (side, name) = match (shape, pins.len()) {
            (Shape::Contact | Shape::Coil, 0) => (Side::Above, String::new()),
            (Shape::Contact | Shape::Coil, _) => (Side::Below, String::new()),
            (Shape::Box, 0) if is_numbered => (Side::Above, String::new()),
            (Shape::Box, _) if role.writes() => (Side::Right, operand_name(name)),
            (Shape::Box, _) => (Side::Left, operand_name(name)),
        };
        pins.push(Pin { name, side, operand: operand_of(sheet, operand) });
    }
    pins
}

/// What a call hands over, with the names that the routine has for it.
fn parameters(sheet: Sheet<'_>, one: &Instruction) -> Vec<Pin> {
    let Some((first, given)) = one.operands.split_first() else { return Vec::new() };
    let mut units = sheet.assembly.program.units();
    let unit = units.find(|(_, unit)| first.value == Value::Unit(unit.id)).map(|(_, unit)| unit);
    let variables = unit.map_or(&[][..], |unit| &unit.variables);
    let mut declared = variables.iter().filter(|variable| variable.section != Section::Temp);
    let mut pins = Vec::new();
    for operand in given {
        let variable = declared.next();
        let side = match variable.map(|variable| variable.section) {
            Some(Section::Out) => Side::Right,
            _ => Side::Left,
        };
        let name = variable.map(|variable| variable.name.clone()).unwrap_or_default();
        pins.push(Pin { name, side, operand: operand_of(sheet, operand) });
    }
    pins
}

fn operand_of(sheet: Sheet<'_>, operand: &ast::Operand) -> Operand {
    let text = operand.span.text(&sheet.source.text);
    let program = &sheet.assembly.program;
    let inside = |name: &ast::Name| name.span.is_in(operand.span);
    let at = program.names.partition_point(|name| name.span.start < operand.span.start);
    let is_named = program.names.get(at).is_some_and(inside);
    let symbol = program.symbols.iter().find(|symbol| match operand.value {
        Value::Address(_) => symbol.value == operand.value,
        _ => false,
    });
    let other = match operand.value {
        Value::Address(address) if is_named => Some(address.to_string()),
        Value::Address(_) => symbol.map(|symbol| symbol.name.clone()),
        _ => None,
    };
    let number = match operand.value {
        // What a pattern is as a number, its type says.
        Value::Constant(constant) if !constant.is_pattern => Some(constant.value as f64),
        Value::Real(bits) => Some(f64::from(f32::from_bits(bits))),
        _ => None,
    };
    Operand {
        number,
        text: text.to_owned(),
        other,
        comment: symbol.map(|symbol| symbol.comment.clone()).unwrap_or_default(),
    }
}

/// The inputs of power flow of an element, without their places.
fn powers(one: &Instruction, shape: Shape) -> Vec<Power> {
    let power = |name| Power { name, row: 0, net: 0 };
    match (shape, one.entry.inputs) {
        (Shape::Box, []) if one.entry.stack.needs > 0 => vec![power("EN")],
        (Shape::Box, inputs) => inputs.iter().map(|&name| power(name)).collect(),
        (Shape::Contact | Shape::Coil, _) => vec![power("")],
    }
}
