//! What a program may use although nothing on an Uno is after it: special memory of missing
//! hardware, DLED. Assembled, and said once for each.

use std::collections::BTreeSet;
use std::ops::RangeInclusive;

use plc_isa::{Area, Op};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::selected::{Argument, Selected, operand_span, span_of};
use crate::text::address::Address;
use crate::text::ast::Program;

/// Special memory without effect.
struct Missing {
    /// The bytes.
    bytes: RangeInclusive<u16>,
    /// Whether it is read in vain, not written.
    is_read: bool,
    /// What it is of, or what it does.
    what: &'static str,
    /// The nearest way.
    way: &'static str,
}

const fn written(bytes: RangeInclusive<u16>, what: &'static str, way: &'static str) -> Missing {
    Missing { bytes, is_read: false, what, way }
}

const COUNTERS: &str = "use HSC0 with SMB36 to SMB45, or HSC3 with SMB136 to SMB145";
const PULSES: &str = "use pulse output 1 with SMB76 to SMB85: Q0.1 is pin D9";
const PORT: &str = "use port 0 with SMB30 and SMB86 to SMB94";
const RETAIN: &str = "`//# retain VB0-VB9` keeps V memory without power; SM31.7 stays as it is";

const MISSING: [Missing; 11] = [
    Missing {
        bytes: 28..=29,
        is_read: true,
        what: "the analog potentiometers",
        way: "a potentiometer at pin A0 is AIW0, 0 to 32000",
    },
    written(31..=33, "the write command of the EEPROM", RETAIN),
    written(46..=55, "HSC1", COUNTERS),
    written(56..=65, "HSC2", COUNTERS),
    written(66..=75, "pulse output 0", PULSES),
    written(130..=130, "port 1", PORT),
    written(146..=155, "HSC4", COUNTERS),
    written(156..=165, "HSC5", COUNTERS),
    written(166..=175, "pulse output 0", PULSES),
    written(186..=194, "port 1", PORT),
    written(200..=549, "intelligent modules", "an Uno has its own inputs and outputs only"),
];

/// Warnings of what has no effect, each where it is first.
pub(crate) fn without_effect(program: &Program, code: &[Selected]) -> Vec<Diagnostic> {
    let mut seen = BTreeSet::new();
    let mut diagnostics = Vec::new();
    for selected in code {
        if selected.op == Op::Dled && seen.insert("DLED") {
            let message = "DLED: the Uno has no diagnosis LED";
            let diagnostic = Diagnostic::new(Code::NoEffect, span_of(program, selected), message);
            diagnostics.push(
                diagnostic.help("the LED marked L on the board is at pin D13, which is Q0.5"),
            );
        }
        for (index, (argument, is_written)) in selected.arguments().enumerate() {
            let (Argument::Bit(address) | Argument::Memory(address)) = argument else { continue };
            let Some(first) = special_byte(address) else { continue };
            for missing in MISSING.iter().filter(|missing| missing.is_read != is_written) {
                if missing.bytes.contains(&first) && seen.insert(missing.what) {
                    let effect = if missing.is_read {
                        "it always reads 0"
                    } else {
                        "writing it does nothing"
                    };
                    let message =
                        format!("{address} is for {}, which the Uno lacks: {effect}", missing.what);
                    let span = operand_span(program, selected, index);
                    diagnostics
                        .push(Diagnostic::new(Code::NoEffect, span, message).help(missing.way));
                }
            }
        }
    }
    diagnostics
}

/// The number of the first byte of an address in special memory.
fn special_byte(address: Address) -> Option<u16> {
    match address {
        Address::Bit { area: Area::Sm, byte, .. }
        | Address::Byte { area: Area::Sm, byte }
        | Address::Word { area: Area::Sm, byte }
        | Address::Double { area: Area::Sm, byte } => Some(byte),
        _ => None,
    }
}
