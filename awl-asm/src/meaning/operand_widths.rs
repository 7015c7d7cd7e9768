//! What is behind operands that are wider or narrower than an instruction takes: the same
//! instruction for their width, or what makes one width of another. That they are wrong is known
//! already.

use plc_isa::Area;

use crate::meaning::quoted::Quoted;
use crate::text::address::Address;
use crate::text::ast::Value;
use crate::text::foreign::width::Width;

/// An address among the operands, and how it is written.
struct Place {
    address: Address,
    width: Width,
    written: String,
}

/// The same instruction for operands of another width, or what makes one width of another.
pub(super) fn way_of_width(quoted: Quoted<'_>) -> Option<String> {
    let name = quoted.source.mnemonic();
    let places = places(quoted);
    let width = places.first()?.width;
    if let Some(way) = real_beside(quoted, &places) {
        return Some(way);
    }
    if places.iter().all(|other| other.width == width) {
        if let Some(wider) = wider(quoted, width) {
            return Some(wider);
        }
        let sibling = width.sibling(name).filter(|sibling| *sibling != name)?;
        let relation = quoted.source.relation.map_or("", |relation| relation.symbol());
        return Some(format!("{} are taken by `{sibling}{relation}`", width.plural()));
    }
    let [from, to] = places.as_slice() else { return None };
    if !name.starts_with("MOV") {
        return made_alike(quoted, from, to);
    }
    if let Some(part) = same_byte(from.address, to.address) {
        return Some(part);
    }
    let lines = conversion(from.width, &from.written, to.width, &to.written)?;
    let (from_words, to_words) = (from.width.singular(), to.width.singular());
    let made = format!(
        "{} {} a {to_words} of a {from_words}",
        listed(&lines),
        match lines.len() {
            1 => "makes",
            _ => "make",
        }
    );
    Some(match (from.width, to.width) {
        (Width::Word, Width::Double) => {
            let to = &to.written;
            format!("{made}; for a real number `DTR {to}, {to}` follows")
        }
        _ => made,
    })
}

fn listed(lines: &[String]) -> String {
    lines.iter().map(|line| format!("`{line}`")).collect::<Vec<_>>().join(", ")
}

/// The operands that are addresses with a width. What an instruction of reals has in a double word
/// is one.
fn places(quoted: Quoted<'_>) -> Vec<Place> {
    let is_real = is_of_reals(quoted.source.mnemonic());
    let all = quoted.source.operands.iter().enumerate();
    all.filter_map(|(index, operand)| {
        let Value::Address(address) = operand.value else { return None };
        let width = match quoted.width(index)? {
            Width::Bit => return None,
            Width::Double if is_real => Width::Real,
            width => width,
        };
        Some(Place { address, width, written: quoted.operand(index)? })
    })
    .collect()
}

/// Whether an instruction works on real numbers, in all of its operands.
fn is_of_reals(name: &str) -> bool {
    matches!(name, "MOVR" | "LDR" | "AR" | "OR" | "+R" | "-R" | "*R" | "/R")
}

/// A whole number where an instruction of reals has its operand, beside a constant.
fn real_beside(quoted: Quoted<'_>, places: &[Place]) -> Option<String> {
    let (name, [place]) = (quoted.source.mnemonic(), places) else { return None };
    let constant = quoted.source.operands.iter().find_map(|one| match one.value {
        Value::Real(bits) => Some(f32::from_bits(bits)),
        Value::Constant(constant) => Some(constant.value as f32),
        _ => None,
    })?;
    if !is_of_reals(name) || !matches!(place.width, Width::Byte | Width::Word) {
        return None;
    }
    match quoted.source.relation {
        Some(_) => compared_with_real(quoted, constant),
        None => Some("a real number is in a double word, such as VD0".to_owned()),
    }
}

/// A whole number that is compared with a real one.
pub(super) fn compared_with_real(quoted: Quoted<'_>, constant: f32) -> Option<String> {
    let (name, places) = (quoted.source.mnemonic(), places(quoted));
    let [place] = places.as_slice() else { return None };
    let (written, kind) = (&place.written, place.width.singular());
    let relation = quoted.source.relation?.symbol();
    let sibling = place.width.sibling(name)?;
    let reals = Width::Real.sibling(name)?;
    let whole = if constant.fract() == 0.0 { constant } else { constant.round() };
    let made = conversion(place.width, written, Width::Real, "AC0")?;
    Some(format!(
        "{written} is a {kind}, a whole number: `{sibling}{relation} {written}, {whole}` compares \
         it, or {} make a real number of it for `{reals}{relation} AC0, {constant:?}`",
        listed(&made)
    ))
}

/// A constant that is too large for the width of the address beside it.
fn wider(quoted: Quoted<'_>, width: Width) -> Option<String> {
    let (most, target) = match width {
        Width::Byte => (0xFF, "VW0"),
        Width::Word => (0xFFFF, "VD0"),
        Width::Bit | Width::Double | Width::Real => return None,
    };
    let name = quoted.source.mnemonic();
    let constant = quoted.source.operands.iter().find_map(|operand| match operand.value {
        Value::Constant(constant) if constant.value > most || constant.value < -0x8000 => {
            Some(constant.value)
        }
        _ => None,
    })?;
    Some(format!("{constant} does not fit a {}: `{name} {constant}, {target}`", width.singular()))
}

/// The instructions that make one width of another; what is between them is in AC0.
fn conversion(from: Width, source: &str, to: Width, target: &str) -> Option<Vec<String>> {
    let steps: &[&str] = match (from, to) {
        (Width::Byte, Width::Word) => &["BTI"],
        (Width::Byte, Width::Double) => &["BTI", "ITD"],
        (Width::Byte, Width::Real) => &["BTI", "ITD", "DTR"],
        (Width::Word, Width::Byte) => &["ITB"],
        (Width::Word, Width::Double) => &["ITD"],
        (Width::Word, Width::Real) => &["ITD", "DTR"],
        (Width::Double, Width::Byte) => &["DTI", "ITB"],
        (Width::Double, Width::Word) => &["DTI"],
        (Width::Double, Width::Real) => &["DTR"],
        (Width::Real, Width::Byte) => &["ROUND", "DTI", "ITB"],
        (Width::Real, Width::Word) => &["ROUND", "DTI"],
        (Width::Real, Width::Double) => &["ROUND"],
        _ => return None,
    };
    let last = steps.len() - 1;
    let place = |index: usize| if index == last { target } else { "AC0" };
    let line = |(index, step): (usize, &&str)| {
        let from = if index == 0 { source } else { "AC0" };
        format!("{step} {from}, {}", place(index))
    };
    Some(steps.iter().enumerate().map(line).collect())
}

/// An operand as wide as the other, for an instruction whose operands are alike.
fn made_alike(quoted: Quoted<'_>, from: &Place, to: &Place) -> Option<String> {
    let name = quoted.source.mnemonic();
    let is_alike = quoted.source.relation.is_some()
        || name.starts_with(['+', '-', '*', '/'])
        || ["AND", "OR", "XOR"].iter().any(|start| name.starts_with(start));
    // Only the first operand of a calculation can be another.
    let is_wider = to.width as usize > from.width as usize;
    if !is_alike || !is_wider && quoted.source.relation.is_none() {
        return None;
    }
    let (narrow, wide) = if is_wider { (from, to) } else { (to, from) };
    let lines = conversion(narrow.width, &narrow.written, wide.width, "AC0")?;
    let sibling = wide.width.sibling(name)?;
    let relation = quoted.source.relation.map_or("", |relation| relation.symbol());
    let operands = match is_wider {
        true => format!("AC0, {}", to.written),
        false => format!("{}, AC0", from.written),
    };
    Some(format!(
        "both operands are {}: {}, then `{sibling}{relation} {operands}`",
        wide.width.plural(),
        listed(&lines)
    ))
}

/// A copy between inputs or outputs of which one is a byte and the other a word: all are meant to
/// be of one width, and no number is converted.
fn same_byte(from: Address, to: Address) -> Option<String> {
    let parts = |address| match address {
        Address::Byte { area, byte } | Address::Word { area, byte } => Some((area, byte)),
        _ => None,
    };
    let ((from_area, from_byte), (to_area, to_byte)) = (parts(from)?, parts(to)?);
    let is_point = |area| matches!(area, Area::I | Area::Q);
    (is_point(from_area) && is_point(to_area)).then(|| {
        let from = Address::Byte { area: from_area, byte: from_byte };
        let to = Address::Byte { area: to_area, byte: to_byte };
        format!("one byte is copied by `MOVB {from}, {to}`")
    })
}
