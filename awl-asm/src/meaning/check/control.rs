//! Jumps, labels and loops: whether they pair, and which instructions a scan can skip or repeat.
//! Each unit has its own.

use std::collections::{BTreeMap, HashMap};
use std::ops::Range;

use plc_isa::{LOOPS_MAX, Op, Profile};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::quoted::told;
use crate::meaning::selected::{Argument, Selected, operand_span, span_of};
use crate::meaning::units::Units;
use crate::text::address::Address;
use crate::text::ast::{Program, Span};

/// The control structure of a program; indices are those of the selected instructions.
#[derive(Debug, Default)]
pub struct Control {
    /// The labels: the LBL instructions of each unit, then the ends of the segments that CSCRE
    /// leaves.
    pub labels: Vec<usize>,
    /// Pairs of FOR and NEXT.
    pub loops: Vec<(usize, usize)>,
    /// For each instruction the FOR of the innermost loop whose body it is in.
    innermost: Vec<Option<usize>>,
    /// The pairs that are in no other loop.
    outermost: Vec<(usize, usize)>,
    /// Pairs of JMP or CSCRE and LBL.
    pub jumps: Vec<(usize, usize)>,
}

impl Control {
    /// The labels of the units of the image.
    pub fn labels_in_image<'a>(&'a self, units: &'a Units) -> impl Iterator<Item = usize> + 'a {
        let is_in_image = |label: &usize| units.in_image().any(|part| part.code.contains(label));
        self.labels.iter().copied().filter(is_in_image)
    }
}

/// Finds the control structure and reports what is wrong with it.
pub fn control(
    program: &Program,
    code: &[Selected],
    units: &Units,
    diagnostics: &mut Vec<Diagnostic>,
) -> Control {
    let mut control = Control { innermost: vec![None; code.len()], ..Control::default() };
    for part in &units.parts {
        let labels = find_labels(program, code, part.code.clone(), diagnostics);
        find_loops(program, code, part.code.clone(), &mut control, diagnostics);
        find_jumps(program, code, part.code.clone(), &labels, &mut control, diagnostics);
        control.labels.extend(labels.values());
        find_segment_ends(code, part.code.clone(), &mut control);
    }
    timers_not_every_scan(program, code, &control, diagnostics);
    control
}

/// Reports the first label that an image for a board cannot have: because of its number, or because
/// there are too many.
pub fn labels(
    program: &Program,
    code: &[Selected],
    units: &Units,
    control: &Control,
    profile: &Profile,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let (most, last) = (profile.labels_max(), profile.label_number_max());
    let high = control.labels_in_image(units).find_map(|index| {
        let selected = code.get(index)?;
        number(selected).filter(|&number| number > last).map(|number| (selected, number))
    });
    if let Some((selected, number)) = high {
        let message = format!("label {number}: {} has the labels 0 to {last}", profile.title);
        let span = operand_span(program, selected, 0);
        diagnostics.push(Diagnostic::new(Code::ConstantRange, span, message));
    }
    let one_too_many = control.labels_in_image(units).nth(usize::from(most));
    if let Some(selected) = one_too_many.and_then(|index| code.get(index)) {
        let message =
            format!("this is one label too many: a program can have {most} in all its units");
        diagnostics.push(Diagnostic::new(Code::TooMany, span_of(program, selected), message));
    }
}

/// The label of a jump, or of the place where it leads.
fn number(selected: &Selected) -> Option<u16> {
    match selected.arguments[0] {
        Argument::Label(number) => Some(number),
        _ => None,
    }
}

/// The instructions of a unit with their indices.
fn in_range(code: &[Selected], range: Range<usize>) -> impl Iterator<Item = (usize, &Selected)> {
    code.iter().enumerate().take(range.end).skip(range.start)
}

/// For each label number the instruction LBL.
fn find_labels(
    program: &Program,
    code: &[Selected],
    range: Range<usize>,
    diagnostics: &mut Vec<Diagnostic>,
) -> BTreeMap<u16, usize> {
    let mut labels = BTreeMap::new();
    let is_label = |selected: &Selected| selected.op == Op::Lbl && selected.parameter.is_none();
    for (index, selected) in in_range(code, range).filter(|(_, selected)| is_label(selected)) {
        let Some(label) = number(selected) else { continue };
        match labels.get(&label) {
            Some(&first) => diagnostics.push(
                Diagnostic::new(
                    Code::DuplicateLabel,
                    operand_span(program, selected, 0),
                    format!("label {label} is here a second time"),
                )
                .related(span_of(program, &code[first]), "first here")
                .help("another number for one of them, and for the jumps to it"),
            ),
            None => {
                labels.insert(label, index);
            }
        }
    }
    labels
}

fn find_loops(
    program: &Program,
    code: &[Selected],
    range: Range<usize>,
    control: &mut Control,
    diagnostics: &mut Vec<Diagnostic>,
) {
    let mut open: Vec<usize> = Vec::new();
    for (index, selected) in in_range(code, range) {
        control.innermost[index] = open.last().copied();
        match selected.op {
            Op::For => {
                if open.len() == LOOPS_MAX {
                    let message = format!("FOR is nested more than {LOOPS_MAX} deep");
                    diagnostics.push(Diagnostic::new(
                        Code::LoopPairing,
                        span_of(program, selected),
                        message,
                    ));
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
                None => diagnostics.push(
                    Diagnostic::new(
                        Code::LoopPairing,
                        span_of(program, selected),
                        "NEXT without FOR",
                    )
                    .help("the loop begins with `LD SM0.0`, `FOR VW0, 1, 10`"),
                ),
            },
            _ => {}
        }
    }
    for start in open {
        let message = "FOR without NEXT";
        diagnostics.push(
            Diagnostic::new(Code::LoopPairing, span_of(program, &code[start]), message)
                .help("`NEXT` is after the last instruction that is repeated, in the same unit"),
        );
    }
}

fn find_jumps(
    program: &Program,
    code: &[Selected],
    range: Range<usize>,
    labels: &BTreeMap<u16, usize>,
    control: &mut Control,
    diagnostics: &mut Vec<Diagnostic>,
) {
    // A label whose number was wrong may have been the one.
    let is_unknown = |selected: &Selected| selected.op == Op::Lbl && number(selected).is_none();
    let has_unknown_label = in_range(code, range.clone()).any(|(_, selected)| is_unknown(selected));
    let known = known_labels(labels);
    // A FOR without NEXT reaches to the end.
    let ends: HashMap<usize, usize> = control.loops.iter().copied().collect();
    let end_of = |start: usize| ends.get(&start).copied().unwrap_or(usize::MAX);
    for (index, selected) in in_range(code, range).filter(|(_, selected)| selected.op == Op::Jmp) {
        let Some(label) = number(selected) else { continue };
        let span = operand_span(program, selected, 0);
        let Some(&target) = labels.get(&label) else {
            if !has_unknown_label {
                diagnostics.push(missing_label(label, span, &known));
            }
            continue;
        };
        control.jumps.push((index, target));
        if let Some(start) =
            control.innermost[target].filter(|&start| !(start..=end_of(start)).contains(&index))
        {
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

/// Finds where each CSCRE goes: the hidden label before the next SCRE.
fn find_segment_ends(code: &[Selected], range: Range<usize>, control: &mut Control) {
    let mut leaving = Vec::new();
    for (index, selected) in in_range(code, range) {
        match selected.op {
            Op::Cscre => leaving.push(index),
            Op::Lbl if selected.parameter.is_some() => {
                control.labels.push(index);
                control.jumps.extend(leaving.drain(..).map(|leaves| (leaves, index)));
            }
            _ => {}
        }
    }
}

/// Most labels that a message lists.
const LABELS_SHOWN: usize = 10;

fn known_labels(labels: &BTreeMap<u16, usize>) -> Vec<String> {
    labels.keys().take(LABELS_SHOWN + 1).map(u16::to_string).collect()
}

fn missing_label(label: u16, span: Span, known: &[String]) -> Diagnostic {
    let diagnostic =
        Diagnostic::new(Code::MissingLabel, span, format!("there is no label {label}"));
    match known {
        [] => diagnostic.help(format!("put `LBL {label}` where the jump shall go")),
        [one] => diagnostic.suggest(one.clone()),
        some if some.len() > LABELS_SHOWN => diagnostic
            .help(format!("the program has the labels {}, ...", some[..LABELS_SHOWN].join(", "))),
        some => diagnostic.help(format!("the program has the labels {}", some.join(", "))),
    }
}

/// 100 ms timers count when they execute: they must do so exactly once a scan (docs/s7-200.md 2.3).
fn timers_not_every_scan(
    program: &Program,
    code: &[Selected],
    control: &Control,
    diagnostics: &mut Vec<Diagnostic>,
) {
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
        let (Some((by, words)), Argument::Timer(number)) = (by, selected.arguments[0]) else {
            continue;
        };
        let is_started = plc_isa::TimerKind::started_by(selected.op).is_some();
        if is_started && plc_isa::timer_resolution(number) == plc_isa::TimerResolution::Ms100 {
            let span = operand_span(program, selected, 0);
            let name = told(program, span, Address::Timer(number));
            diagnostics.push(
                Diagnostic::new(
                    Code::TimerNotEveryScan,
                    span,
                    format!("{name} counts in 100 ms and is not executed exactly once a scan"),
                )
                .related(span_of(program, &code[*by]), *words)
                .help("it loses time when it is skipped and gains time when it is repeated"),
            );
        }
    }
}

/// Of the jumps to one label only the widest covers new ground, so that marking stays linear.
fn widest(jumps: &[(usize, usize)]) -> Vec<(usize, usize)> {
    let mut widest: std::collections::BTreeMap<(usize, bool), usize> =
        std::collections::BTreeMap::new();
    for &(jump, target) in jumps {
        let forward = jump < target;
        let place = widest.entry((target, forward)).or_insert(jump);
        *place = if forward { (*place).min(jump) } else { (*place).max(jump) };
    }
    widest.into_iter().map(|((target, _), jump)| (jump, target)).collect()
}
