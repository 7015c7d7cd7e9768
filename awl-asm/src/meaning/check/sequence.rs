//! Sequence control: segments from LSCR to SCRE, what may be in them, and that each has an S bit
//! of its own.

use std::collections::HashMap;

use plc_isa::Op;

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::check::Control;
use crate::meaning::check::inactive::inactive_outputs;
use crate::meaning::selected::{Argument, Selected, operand_span, span_of};
use crate::meaning::units::Units;
use crate::text::ast::Program;

/// Reports what is wrong with the segments of a program.
pub fn sequence(
    program: &Program,
    code: &[Selected],
    units: &Units,
    control: &Control,
    diagnostics: &mut Vec<Diagnostic>,
) {
    if !code
        .iter()
        .any(|selected| matches!(selected.op, Op::Lscr | Op::Scre | Op::Scrt | Op::Cscre))
    {
        return;
    }
    // For each instruction the LSCR of its segment.
    let mut segments: Vec<Option<usize>> = vec![None; code.len()];
    for part in &units.parts {
        let mut open: Option<usize> = None;
        for index in part.code.clone() {
            let selected = &code[index];
            let span = span_of(program, selected);
            let mut pairing = |message: &str, help: &str| {
                diagnostics.push(Diagnostic::new(Code::ScrPairing, span, message).help(help));
            };
            match (selected.op, open) {
                (Op::Lscr, Some(_)) => {
                    pairing(
                        "LSCR: the segment before it is not ended",
                        "put SCRE before this LSCR",
                    );
                    open = Some(index);
                }
                (Op::Lscr, None) => open = Some(index),
                (Op::Scre, Some(_)) => {
                    segments[index] = open.take();
                    continue;
                }
                (Op::Scre, None) => pairing("SCRE without LSCR", "a segment begins with LSCR"),
                (Op::Scrt | Op::Cscre, None) => {
                    let name = selected.op.instruction().mnemonic();
                    pairing(
                        &format!("{name} is outside of a segment"),
                        "a segment begins with LSCR",
                    );
                }
                (Op::For | Op::Next | Op::End, Some(start)) => {
                    let name = selected.op.instruction().mnemonic();
                    let message = format!("{name} cannot be in a segment");
                    let diagnostic = Diagnostic::new(Code::ScrContent, span, message);
                    diagnostics.push(
                        diagnostic
                            .related(span_of(program, &code[start]), "the segment begins here"),
                    );
                }
                _ => {}
            }
            segments[index] = open;
        }
        if let Some(start) = open {
            let diagnostic = Diagnostic::new(
                Code::ScrPairing,
                span_of(program, &code[start]),
                "LSCR without SCRE",
            );
            diagnostics.push(diagnostic.help("end the segment with SCRE"));
        }
    }
    jumps(program, code, control, &segments, diagnostics);
    inactive_outputs(program, code, units, diagnostics);
    bits(program, code, diagnostics);
}

fn jumps(
    program: &Program,
    code: &[Selected],
    control: &Control,
    segments: &[Option<usize>],
    diagnostics: &mut Vec<Diagnostic>,
) {
    for &(jump, target) in &control.jumps {
        if segments[jump] == segments[target] {
            continue;
        }
        let way = if segments[target].is_some() { "into" } else { "out of" };
        let message = format!("this jump leads {way} a segment");
        let diagnostic =
            Diagnostic::new(Code::ScrContent, operand_span(program, &code[jump], 0), message);
        diagnostics.push(diagnostic.related(span_of(program, &code[target]), "its label"));
    }
}

fn bits(program: &Program, code: &[Selected], diagnostics: &mut Vec<Diagnostic>) {
    let mut first_of: HashMap<_, usize> = HashMap::new();
    for (index, selected) in code.iter().enumerate().filter(|(_, selected)| selected.op == Op::Lscr)
    {
        let Argument::Bit(address) = selected.arguments[0] else { continue };
        match first_of.get(&address) {
            Some(&first) => {
                let message = format!("{address} begins a second segment");
                let diagnostic =
                    Diagnostic::new(Code::ScrBit, operand_span(program, selected, 0), message);
                let diagnostic =
                    diagnostic.related(span_of(program, &code[first]), "the first one").help(
                        "a step has one segment: give this one its own bit, or put both into one",
                    );
                diagnostics.push(diagnostic);
            }
            None => {
                first_of.insert(address, index);
            }
        }
    }
}
