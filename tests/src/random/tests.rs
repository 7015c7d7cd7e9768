//! What random programs promise: validity, an end, and that nothing is missing.

use std::collections::BTreeSet;

use awl_asm::Address;
use awl_asm::ast::{Program, Statement, Value};
use plc_isa::{Area, Group, PowerFlow, Relation, STACK_LEVELS};

use super::*;
use crate::forms::Row;
use crate::naive::{Fault, INSTRUCTIONS_MAX, Mode, Naive, parse};

/// What an operand is, as far as a form cares.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Class {
    Bit(Area),
    Byte(Area),
    Word(Area),
    Timer,
    Counter,
    Scaled,
    Raw,
    Constant,
}

type Classified = (Class, i64);

fn classify(value: &Value) -> Classified {
    match value {
        Value::Constant(constant) => (Class::Constant, constant.value),
        Value::Address(Address::Bit { area, .. }) => (Class::Bit(*area), 0),
        Value::Address(Address::Byte { area, .. }) => (Class::Byte(*area), 0),
        Value::Address(Address::Word { area, .. }) => (Class::Word(*area), 0),
        Value::Address(Address::Timer(_)) => (Class::Timer, 0),
        Value::Address(Address::Counter(_)) => (Class::Counter, 0),
        Value::Address(Address::Analog(AnalogInput::Scaled(_))) => (Class::Scaled, 0),
        Value::Address(Address::Analog(AnalogInput::Raw(_))) => (Class::Raw, 0),
        other => panic!("{other:?} is no operand"),
    }
}

fn is_bit(class: Class) -> bool {
    matches!(class, Class::Bit(_) | Class::Timer | Class::Counter)
}

fn is_byte(class: Class) -> bool {
    matches!(class, Class::Byte(_))
}

fn is_word(class: Class) -> bool {
    matches!(class, Class::Word(_) | Class::Timer | Class::Counter | Class::Scaled | Class::Raw)
}

/// Of special memory only SMB31: SMB30 belongs to the serial line.
fn is_writable(class: Class) -> bool {
    !matches!(class, Class::Word(Area::Sm) | Class::Scaled | Class::Raw)
}

/// Whether a form with this kind takes such an operand.
fn takes_class(kind: Kind, (class, value): Classified) -> bool {
    let constant_in =
        |range: std::ops::RangeInclusive<i64>| class == Class::Constant && range.contains(&value);
    let in_page = class != Class::Bit(Area::V);
    match kind {
        Kind::PageBit => is_bit(class) && in_page,
        Kind::PageBitOut => is_bit(class) && in_page && is_writable(class),
        Kind::PageBitReset => matches!(class, Class::Bit(_)) && in_page && is_writable(class),
        Kind::FarBit => is_bit(class),
        Kind::FarBitOut => is_bit(class) && is_writable(class),
        Kind::FarBitReset => matches!(class, Class::Bit(_)) && is_writable(class),
        Kind::Byte => is_byte(class),
        Kind::ByteOut => is_byte(class) && is_writable(class),
        Kind::AnyByte => is_byte(class) || constant_in(0..=255),
        Kind::Word => is_word(class),
        Kind::WordOut => is_word(class) && is_writable(class),
        Kind::AnyInt => is_word(class) || constant_in(-32768..=65535),
        Kind::WordConst | Kind::IntConst => constant_in(-32768..=65535),
        Kind::One => constant_in(1..=1),
        Kind::Count => constant_in(1..=255),
        Kind::Level => constant_in(0..=8),
        Kind::ByteConst | Kind::Number | Kind::LabelIndex | Kind::LabelNumber => {
            constant_in(0..=255)
        }
        Kind::TimerSlot | Kind::TimerNumber => class == Class::Timer,
        Kind::CounterSlot | Kind::CounterNumber => class == Class::Counter,
        _ => false,
    }
}

/// An instruction in a form, with the class of one of its operands.
type Usage = (Op, usize, usize, Class);

/// The form in which an instruction would be encoded, the way the assembler looks for it.
fn form_of(mnemonic: &str, operands: &[Classified]) -> Option<(Op, usize)> {
    let rows = core_rows().filter(|row| row.mnemonics.first() == Some(&mnemonic));
    rows.flat_map(|row| {
        row.forms.iter().enumerate().map(move |(index, form)| (row.op, index, form))
    })
    .find(|(_, _, form)| {
        let kinds: Vec<_> = form.kinds.iter().filter(|kind| kind.is_written()).collect();
        kinds.len() == operands.len()
            && kinds.iter().zip(operands).all(|(kind, operand)| takes_class(**kind, *operand))
    })
    .map(|(op, index, _)| (op, index))
}

fn usages(mnemonic: &str, operands: &[Classified]) -> Vec<Usage> {
    let Some((op, form)) = form_of(mnemonic, operands) else { return Vec::new() };
    operands.iter().enumerate().map(|(index, operand)| (op, form, index, operand.0)).collect()
}

/// An operand of every class, and the constants that choose a form.
fn samples() -> Vec<Classified> {
    let areas = [Area::I, Area::Q, Area::V, Area::M, Area::Sm, Area::S];
    let classes =
        areas.into_iter().flat_map(|area| [Class::Bit(area), Class::Byte(area), Class::Word(area)]);
    let others = [Class::Timer, Class::Counter, Class::Scaled, Class::Raw].into_iter();
    let constants = [1, 2].map(|value| (Class::Constant, value));
    classes.chain(others).map(|class| (class, 0)).chain(constants).collect()
}

/// What programs of the core consist of.
fn core_rows() -> impl Iterator<Item = &'static Instruction> {
    let is_apart =
        |group| matches!(group, Group::Hidden | Group::Call | Group::Sequence | Group::Interrupt);
    INSTRUCTIONS
        .iter()
        .filter(move |row| row.module().is_none() && row.op != Op::Aeno && !is_apart(row.group))
}

/// Every usage that the instruction table allows.
fn possible_usages() -> BTreeSet<Usage> {
    let samples = samples();
    let mut possible = BTreeSet::new();
    for row in core_rows() {
        for form in row.forms {
            let written = form.kinds.iter().filter(|kind| kind.is_written()).count();
            for choice in 0..samples.len().pow(written as u32) {
                let digit = |place: usize| {
                    samples[choice / samples.len().pow(place as u32) % samples.len()]
                };
                let operands: Vec<Classified> = (0..written).map(digit).collect();
                possible.extend(usages(row.mnemonic(), &operands));
            }
        }
    }
    possible
}

fn instructions(program: &Program) -> impl Iterator<Item = &awl_asm::ast::Instruction> {
    program.statements.iter().filter_map(|statement| match statement {
        Statement::Instruction(instruction) => Some(instruction),
        Statement::Network(_) | Statement::Unit(_) => None,
    })
}

fn programs() -> impl Iterator<Item = String> {
    (0..400).map(|seed| random_program(&mut Rng::with_seed(seed), 20 + 2 * seed as usize))
}

#[test]
fn programs_use_everything_the_table_offers() {
    let mut used = BTreeSet::new();
    let mut names = BTreeSet::new();
    for text in programs() {
        names.extend(
            text.lines().filter_map(|line| line.split_whitespace().next().map(str::to_string)),
        );
        for instruction in instructions(&parse(&text)) {
            let operands: Vec<Classified> =
                instruction.operands.iter().map(|o| classify(&o.value)).collect();
            let found = usages(instruction.mnemonic(), &operands);
            let is_known = operands.is_empty() || !found.is_empty();
            assert!(is_known, "no form for {instruction:?}");
            used.extend(found);
        }
    }
    let missing: Vec<_> = possible_usages().difference(&used).copied().collect();
    assert!(missing.is_empty(), "{} usages never occur: {missing:?}", missing.len());
    assert_names(core_rows(), &names);
}

/// Every mnemonic of the rows is among the names, with all its relations.
fn assert_names(rows: impl Iterator<Item = &'static Instruction>, names: &BTreeSet<String>) {
    for row in rows {
        let relations = Row { instruction: row, form: &row.forms[0] }.relations();
        for (mnemonic, relation) in
            row.mnemonics.iter().flat_map(|name| relations.iter().map(move |one| (name, one)))
        {
            let name = format!("{mnemonic}{}", relation.map_or("", Relation::symbol));
            assert!(names.contains(&name), "{name} never occurs");
        }
    }
}

/// Programs of everything.
fn large_programs() -> impl Iterator<Item = String> {
    (0..600).map(|seed| {
        let mut rng = Rng::with_seed(seed);
        let offer = Offer::everything(&mut rng);
        random_program_of(&mut rng, 20 + seed as usize / 2, offer)
    })
}

#[test]
fn programs_of_everything_have_every_instruction() {
    let mut names = BTreeSet::new();
    let mut text = String::new();
    for program in large_programs() {
        names.extend(
            program.lines().filter_map(|line| line.split_whitespace().next().map(str::to_string)),
        );
        text += &program;
    }
    let offer = Offer::whole();
    let units = [Op::Call, Op::Cret, Op::Lscr, Op::Scrt, Op::Scre, Op::Cscre, Op::Aeno];
    assert_names(
        INSTRUCTIONS.iter().filter(|row| offer.is_plain(row) || units.contains(&row.op)),
        &names,
    );
    for part in [
        "*AC1",
        "*AC2",
        "*AC3",
        "*VD164",
        "AC0",
        "&T",
        "&C",
        "&AIW",
        "#p",
        "SBR2",
        "\"Motor\"",
        "S0.7",
        "1e10",
    ] {
        assert!(text.contains(part), "{part} never occurs");
    }
}

/// A box that never does anything but fail compares nothing.
#[test]
fn programs_of_everything_end_their_scans_and_succeed() {
    let (mut faults, mut succeeded) = (0, BTreeSet::new());
    for (seed, text) in large_programs().enumerate() {
        let mut rng = Rng::with_seed(seed as u64);
        let mut plc = Naive::new(parse(&text));
        let (mut inputs, mut now_ms) = (Inputs::default(), rng.u32(..));
        for _ in 0..50 {
            plc.scan(now_ms, &inputs);
            inputs = random_inputs(&mut rng, &inputs);
            now_ms = now_ms.wrapping_add(random_step_ms(&mut rng));
        }
        assert_ne!(
            plc.fault(),
            Some(Fault::Watchdog),
            "more than {INSTRUCTIONS_MAX} instructions:\n{text}"
        );
        faults += u32::from(plc.fault().is_some());
        succeeded.extend(plc.succeeded().iter().copied());
    }
    assert!(faults < 60, "{faults} of 600 programs end in a fault");
    let offer = Offer::whole();
    let boxes = INSTRUCTIONS
        .iter()
        .filter(|row| row.power_flow == PowerFlow::Needed && offer.is_plain(row));
    let timeless = boxes.map(Instruction::mnemonic).filter(|name| *name != "WDR");
    let failing: Vec<&str> = timeless.filter(|name| !succeeded.contains(name)).collect();
    assert!(failing.is_empty(), "never executed without error: {failing:?}");
}

#[test]
fn programs_end_their_scans() {
    let mut stopped = 0;
    for (seed, text) in programs().enumerate() {
        let mut rng = Rng::with_seed(seed as u64);
        let mut plc = Naive::new(parse(&text));
        let (mut inputs, mut now_ms) = (Inputs::default(), rng.u32(..));
        for _ in 0..100 {
            plc.scan(now_ms, &inputs);
            inputs = random_inputs(&mut rng, &inputs);
            now_ms = now_ms.wrapping_add(random_step_ms(&mut rng));
        }
        assert_eq!(plc.fault(), None, "more than {INSTRUCTIONS_MAX} instructions:\n{text}");
        stopped += u32::from(plc.mode() == Mode::Stop);
    }
    assert!((1..80).contains(&stopped), "{stopped} of 400 programs stopped");
}

#[test]
fn stack_and_structure_are_sound() {
    for text in programs() {
        let (mut depth, mut loops) = (0, 0);
        for instruction in instructions(&parse(&text)) {
            let row = INSTRUCTIONS
                .iter()
                .find(|row| row.mnemonic() == instruction.mnemonic())
                .expect("a row");
            let level = match (row.op, instruction.operands.first().map(|operand| &operand.value)) {
                (Op::Lds, Some(Value::Constant(constant))) => constant.value as u8,
                _ => 0,
            };
            assert!(depth >= row.stack.needs + level, "{instruction:?}");
            depth = match row.op {
                Op::Lbl | Op::For | Op::Next => 1,
                _ => depth.saturating_add_signed(row.stack.adds).min(STACK_LEVELS),
            };
            loops += i32::from(row.op == Op::For) - i32::from(row.op == Op::Next);
            assert!((0..=LOOPS_MAX as i32).contains(&loops));
        }
        assert_eq!(loops, 0);
    }
}

#[test]
fn networks_begin_as_they_must() {
    let starters = ["LD", "LDN", "LDW", "LDB", "LBL", "NEXT", "NOP"];
    for text in programs().filter(|text| text.contains("NETWORK")) {
        let lines: Vec<&str> = text.lines().collect();
        assert!(lines[0].starts_with("NETWORK"));
        for pair in lines.windows(2).filter(|pair| pair[0].starts_with("NETWORK")) {
            let name =
                pair[1].split_whitespace().next().unwrap_or("").trim_end_matches(['<', '>', '=']);
            assert!(starters.contains(&name), "a network begins with {}", pair[1]);
        }
    }
}

#[test]
fn programs_reach_the_bottom_of_the_stack_and_respect_sizes() {
    let mut deepest_run = 0;
    for text in programs() {
        let program = parse(&text);
        let edges = instructions(&program).filter(|i| matches!(i.mnemonic(), "EU" | "ED")).count();
        assert!(edges <= 256);
        let mut run = 0;
        for instruction in instructions(&program) {
            let row = INSTRUCTIONS
                .iter()
                .find(|row| row.mnemonic() == instruction.mnemonic())
                .expect("a row");
            run = if row.stack.adds > 0 { run + 1 } else { 0 };
            deepest_run = deepest_run.max(run);
        }
    }
    assert!(deepest_run > STACK_LEVELS, "{deepest_run} pushes in a row");
}

#[test]
fn inputs_keep_the_promises_that_loops_rely_on() {
    let mut rng = Rng::with_seed(7);
    let (mut inputs, mut toggled) = (Inputs::default(), [0u8; 16]);
    for _ in 0..2000 {
        let next = random_inputs(&mut rng, &inputs);
        for (toggled, (next, before)) in
            toggled.iter_mut().zip(next.digital.iter().zip(inputs.digital))
        {
            *toggled |= next ^ before;
        }
        assert!(next.ain.iter().all(|&raw| raw <= 1023) && next.ain[5] <= 1);
        inputs = next;
    }
    assert_eq!((toggled[0], toggled[10], toggled[11]), (0xFF, 0, 0));
}
