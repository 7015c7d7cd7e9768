//! Jumps, labels and loops: whether they pair, and which instructions a scan can skip or repeat.

use plc_isa::{LOOPS_MAX, Op};

use crate::ast::{Program, Span};
use crate::check::{operand_span, span_of};
use crate::diagnostic::{Code, Diagnostic};
use crate::select::{Argument, Selected};

/// The control structure of a program; indices are those of the selected instructions.
#[derive(Debug, Default)]
pub struct Control {
    /// For each label number the instruction LBL, in the order of their numbers.
    pub labels: Vec<Option<usize>>,
    /// Pairs of FOR and NEXT.
    pub loops: Vec<(usize, usize)>,
    /// For each instruction the FOR of the innermost loop whose body it is in.
    innermost: Vec<Option<usize>>,
    /// The pairs that are in no other loop.
    outermost: Vec<(usize, usize)>,
    /// Pairs of JMP and LBL.
    pub jumps: Vec<(usize, usize)>,
}

/// Finds the control structure and reports what is wrong with it.
pub fn control(program: &Program, code: &[Selected], diagnostics: &mut Vec<Diagnostic>) -> Control {
    let mut control = Control { labels: vec![None; 256], ..Control::default() };
    find_labels(program, code, &mut control, diagnostics);
    find_loops(program, code, &mut control, diagnostics);
    find_jumps(program, code, &mut control, diagnostics);
    timers_not_every_scan(program, code, &control, diagnostics);
    control
}

fn number(selected: &Selected) -> Option<u8> {
    match selected.arguments[0] {
        Argument::Number(number) => Some(number),
        _ => None,
    }
}

fn find_labels(program: &Program, code: &[Selected], control: &mut Control, diagnostics: &mut Vec<Diagnostic>) {
    for (index, selected) in code.iter().enumerate().filter(|(_, selected)| selected.op == Op::Lbl) {
        let Some(label) = number(selected) else { continue };
        match control.labels[usize::from(label)] {
            Some(first) => diagnostics.push(
                Diagnostic::new(
                    Code::DuplicateLabel,
                    operand_span(program, selected, 0),
                    format!("label {label} stands here a second time"),
                )
                .related(span_of(program, &code[first]), "first here"),
            ),
            None => control.labels[usize::from(label)] = Some(index),
        }
    }
}

fn find_loops(program: &Program, code: &[Selected], control: &mut Control, diagnostics: &mut Vec<Diagnostic>) {
    let mut open: Vec<usize> = Vec::new();
    control.innermost = Vec::with_capacity(code.len());
    for (index, selected) in code.iter().enumerate() {
        control.innermost.push(open.last().copied());
        match selected.op {
            Op::For => {
                if open.len() == LOOPS_MAX {
                    let message = format!("FOR is nested more than {LOOPS_MAX} deep");
                    diagnostics.push(Diagnostic::new(Code::LoopPairing, span_of(program, selected), message));
                }
                open.push(index);
            }
            Op::Next => match open.pop() {
                Some(start) => {
                    control.loops.push((start, index));
                    if open.is_empty() {
                        control.outermost.push((start, index));
                    }
                }
                None => {
                    diagnostics.push(Diagnostic::new(Code::LoopPairing, span_of(program, selected), "NEXT without FOR"))
                }
            },
            _ => {}
        }
    }
    for start in open {
        let message = "FOR without NEXT";
        diagnostics.push(Diagnostic::new(Code::LoopPairing, span_of(program, &code[start]), message));
    }
}

fn find_jumps(program: &Program, code: &[Selected], control: &mut Control, diagnostics: &mut Vec<Diagnostic>) {
    // A label whose number was wrong may have been the one.
    let has_unknown_label = code.iter().any(|selected| selected.op == Op::Lbl && number(selected).is_none());
    let known = known_labels(&control.labels);
    // A FOR without NEXT reaches to the end.
    let mut ends = vec![usize::MAX; code.len()];
    for &(start, end) in &control.loops {
        ends[start] = end;
    }
    for (index, selected) in code.iter().enumerate().filter(|(_, selected)| selected.op == Op::Jmp) {
        let Some(label) = number(selected) else { continue };
        let span = operand_span(program, selected, 0);
        let Some(target) = control.labels[usize::from(label)] else {
            if !has_unknown_label {
                diagnostics.push(missing_label(label, span, &known));
            }
            continue;
        };
        control.jumps.push((index, target));
        if let Some(start) = control.innermost[target].filter(|&start| !(start..=ends[start]).contains(&index)) {
            diagnostics.push(
                Diagnostic::new(
                    Code::JumpIntoLoop,
                    span,
                    format!("label {label} is inside a loop that this jump is not in"),
                )
                .related(span_of(program, &code[start]), "the loop begins here")
                .help("NEXT will then use whatever the loop's index holds"),
            );
        }
    }
}

/// Most labels that a message lists.
const LABELS_SHOWN: usize = 10;

fn known_labels(labels: &[Option<usize>]) -> Vec<String> {
    let numbers = labels.iter().enumerate().filter(|(_, place)| place.is_some());
    numbers.take(LABELS_SHOWN + 1).map(|(number, _)| number.to_string()).collect()
}

fn missing_label(label: u8, span: Span, known: &[String]) -> Diagnostic {
    let diagnostic = Diagnostic::new(Code::MissingLabel, span, format!("there is no label {label}"));
    match known {
        [] => diagnostic.help(format!("put `LBL {label}` where the jump shall go")),
        [one] => diagnostic.suggest(one.clone()),
        some if some.len() > LABELS_SHOWN => {
            diagnostic.help(format!("the program has the labels {}, ...", some[..LABELS_SHOWN].join(", ")))
        }
        some => diagnostic.help(format!("the program has the labels {}", some.join(", "))),
    }
}

/// 100 ms timers count when they execute: they must do so exactly once a scan (reference 2.3).
fn timers_not_every_scan(program: &Program, code: &[Selected], control: &Control, diagnostics: &mut Vec<Diagnostic>) {
    let mut covered: Vec<Option<(usize, &str)>> = vec![None; code.len()];
    let mut cover = |range: std::ops::Range<usize>, by: usize, words: &'static str| {
        for place in covered.get_mut(range).into_iter().flatten() {
            place.get_or_insert((by, words));
        }
    };
    for &(start, end) in &control.outermost {
        cover(start..end, start, "this loop repeats it");
    }
    for (jump, target) in widest(&control.jumps) {
        if jump < target {
            cover(jump..target, jump, "this jump skips it");
        } else {
            cover(target..jump, jump, "this jump repeats it");
        }
    }
    for (selected, by) in code.iter().zip(&covered) {
        let (Some((by, words)), Argument::Timer(number)) = (by, selected.arguments[0]) else { continue };
        let is_started = plc_isa::TimerKind::started_by(selected.op).is_some();
        if is_started && plc_isa::timer_resolution(number) == plc_isa::TimerResolution::Ms100 {
            diagnostics.push(
                Diagnostic::new(
                    Code::TimerNotEveryScan,
                    operand_span(program, selected, 0),
                    format!("T{number} counts in 100 ms and is not executed exactly once a scan"),
                )
                .related(span_of(program, &code[*by]), *words)
                .help("it loses time when it is skipped and gains time when it is repeated"),
            );
        }
    }
}

/// Of the jumps to one label only the widest covers new ground, so that marking stays linear.
fn widest(jumps: &[(usize, usize)]) -> Vec<(usize, usize)> {
    let mut widest: std::collections::BTreeMap<(usize, bool), usize> = std::collections::BTreeMap::new();
    for &(jump, target) in jumps {
        let forward = jump < target;
        let place = widest.entry((target, forward)).or_insert(jump);
        *place = if forward { (*place).min(jump) } else { (*place).max(jump) };
    }
    widest.into_iter().map(|((target, _), jump)| (jump, target)).collect()
}
