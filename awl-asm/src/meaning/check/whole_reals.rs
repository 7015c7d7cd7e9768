//! Whole numbers in a double word that the program computes with as a real number: what is stored
//! are other bits.

use std::collections::BTreeMap;

use plc_isa::{Area, Op, Role, Type};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::quoted::told;
use crate::meaning::selected::{Argument, Selected, operand_span};
use crate::text::address::Address;
use crate::text::ast::Program;

/// Below this number the bits of a whole number are no real number that anybody writes.
const REALS_MIN: i32 = 0x0080_0000;

/// What a program does with a double word.
#[derive(Default)]
struct Uses<'c> {
    /// Where it is read as a real number first.
    real: Option<(&'c Selected, usize)>,
    /// Where it is given a whole number first.
    whole: Option<(&'c Selected, i32)>,
    /// Something else may give it a value.
    has_other: bool,
}

/// Warns of each double word that is given whole numbers alone, by the program or by its data
/// block, and read as a real number.
pub fn whole_reals(program: &Program, code: &[Selected], diagnostics: &mut Vec<Diagnostic>) {
    let Some(all) = uses(code) else { return };
    for (&address, uses) in all.iter().filter(|(_, uses)| !uses.has_other) {
        let Some((reader, index)) = uses.real else { continue };
        let read = operand_span(program, reader, index);
        let name = told(program, read, address);
        let mnemonic = reader.op.instruction().mnemonic();
        if let Some((writer, value)) = uses.whole {
            let span = operand_span(program, writer, 0);
            let message = format!("{value} is a whole number, and {name} is read as a real one");
            diagnostics.push(
                Diagnostic::new(Code::WholeReal, span, message)
                    .related(read, format!("by {mnemonic} here"))
                    .help(format!(
                        "a real number has a point and its own move: `MOVR {value}.0, {name}`"
                    )),
            );
        } else if let Some(value) = of_data(program, address) {
            let message = format!(
                "{name} is read as a real number, and the data block gives it the whole number \
                 {value}"
            );
            diagnostics.push(Diagnostic::new(Code::WholeReal, read, message).help(format!(
                "a real number has a decimal point, `{name} {value}.0`; a comma begins the next value"
            )));
        }
    }
}

/// The uses of double words; `None` where values come and go in other ways, too.
fn uses(code: &[Selected]) -> Option<BTreeMap<Address, Uses<'_>>> {
    let mut all: BTreeMap<Address, Uses> = BTreeMap::new();
    for selected in code {
        let kinds = selected.written_kinds().map(|kind| kind.value_type());
        for ((index, (argument, writes)), of) in selected.arguments().enumerate().zip(kinds) {
            let address = match argument {
                Argument::Pointer(_) | Argument::Indirect(_) => return None,
                Argument::Memory(address) => address,
                _ => continue,
            };
            let Address::Double { area: Area::V | Area::M, .. } = address else {
                // Part of a double word that is made of others.
                if writes {
                    parts(address).for_each(|whole| all.entry(whole).or_default().has_other = true);
                }
                continue;
            };
            let uses = all.entry(address).or_default();
            let reads = selected.role(index).is_none_or(Role::reads) || !writes;
            match whole_number(selected) {
                Some(value) if writes => _ = uses.whole.get_or_insert((selected, value)),
                _ => uses.has_other |= writes && !reads,
            }
            if reads && of == Some(Type::Real) {
                uses.real.get_or_insert((selected, index));
            }
        }
    }
    Some(all)
}

/// The double words that a byte or word can be part of.
fn parts(address: Address) -> impl Iterator<Item = Address> {
    let place = match address {
        Address::Byte { area, byte } | Address::Word { area, byte } => Some((area, byte)),
        _ => None,
    };
    place.into_iter().flat_map(|(area, byte)| {
        (byte.saturating_sub(3)..=byte + 1).map(move |byte| Address::Double { area, byte })
    })
}

/// The constant of a move that is certainly no pattern of a real number.
fn whole_number(selected: &Selected) -> Option<i32> {
    let value = match selected.arguments[0] {
        Argument::Literal(value) => value,
        Argument::Constant(value) => i32::from(value as i16),
        _ => return None,
    };
    (selected.op == Op::Movd && is_no_real(value)).then_some(value)
}

fn is_no_real(value: i32) -> bool {
    value != 0 && value.unsigned_abs() < REALS_MIN.unsigned_abs()
}

/// The whole number that the data block has there.
fn of_data(program: &Program, address: Address) -> Option<i32> {
    let Address::Double { area: Area::V, byte } = address else { return None };
    let line = program.data.iter().find(|line| {
        let first = line.first_byte;
        first <= byte && usize::from(byte - first) + 4 <= line.bytes.len()
    })?;
    let at = usize::from(byte - line.first_byte);
    let bytes = line.bytes.get(at..at + 4)?.try_into().ok()?;
    Some(i32::from_be_bytes(bytes)).filter(|value| is_no_real(*value))
}
