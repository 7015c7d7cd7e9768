//! Status of instructions and trace: what the program did in one scan, and in many.

mod machine;

use machine::{Machine, PROGRAM};
use plc_isa::{DATA_END, M_START, decode};
use plc_vm::Mode;

/// Offsets of the instructions of the main program.
fn offsets(machine: &Machine) -> Vec<u16> {
    let program = machine.plc.program().unwrap();
    let (mut at, mut offsets) = (program.plan().code_at(), Vec::new());
    let end = program.plan().header.total_len - 4;
    while at < end {
        offsets.push(at);
        at += decode(program.memory(), at).unwrap().len;
    }
    offsets
}

fn status(entries: &[(u16, [u8; 3])]) -> Vec<u8> {
    let mut request = vec![69, entries.len() as u8];
    for (offset, reference) in entries {
        request.extend(offset.to_be_bytes());
        request.extend(reference);
    }
    request
}

const NO_OPERAND: [u8; 3] = [0xFF, 0, 0];

/// Contacts and what they drive: I0.0 and I0.1 in a row, then a jump over a coil.
const RUNGS: &str =
    "LD I0.0\nA I0.1\n= M0.0\nLD I0.0\nJMP 1\nLD SM0.0\n= M0.1\nLBL 1\nLD SM0.0\nINCW VW0\n";

#[test]
fn status_shows_stack_and_operand_right_after_each_instruction() {
    let mut machine = Machine::with_room(RUNGS, 252);
    let at = offsets(&machine);
    machine.inputs = 0b01;
    let entries = [
        (at[0], NO_OPERAND),
        (at[1], [0x01, 0, 0]),
        (at[2], [0x20, 0, 0]),
        (at[6], [0x21, 0, 0]),
        (at[9], [0x89, 0, 0]),
    ];
    machine.scan();
    machine.scan();
    let (answer, scans) = machine.ask_for_scans(&status(&entries));
    assert_eq!(scans, 1);
    let words: Vec<(u16, u32)> = answer[3..]
        .chunks(6)
        .map(|e| (u16::from_be_bytes([e[0], e[1]]), u32::from_be_bytes([e[2], e[3], e[4], e[5]])))
        .collect();
    // The increment was executed four times: in the first scan, in two, and in the one that was
    // watched.
    assert_eq!(words, [(0x8001, 0), (0x8000, 0), (0x8000, 0), (0, 0), (0x8003, 4)]);
    machine.inputs = 0b10;
    let answer = machine.ask(&status(&entries));
    assert_eq!(answer[3..9], [0x80, 0, 0, 0, 0, 0]);
    assert_eq!(answer[9..15], [0x80, 0, 0, 0, 0, 1]);
    assert_eq!(answer[21..27], [0x80, 1, 0, 0, 0, 1]);
}

#[test]
fn status_in_stop_is_of_nothing_executed() {
    let mut machine = Machine::with_room(RUNGS, 252);
    let at = offsets(&machine);
    machine.plc.stop();
    let answer = machine.ask(&status(&[(at[0], NO_OPERAND), (at[9], [0x89, 0, 0])]));
    assert_eq!(answer[3..], [0; 12]);
}

#[test]
fn a_single_scan_tells_what_it_did() {
    let mut machine = Machine::with_room(RUNGS, 252);
    let at = offsets(&machine);
    let mut request = status(&[(at[0], NO_OPERAND), (at[6], [0x21, 0, 0]), (at[9], [0x89, 0, 0])]);
    request[0] = 100;
    assert_eq!(machine.ask(&request), [0xE4, 4], "in RUN");
    machine.plc.stop();
    machine.inputs = 1;
    for executed in 1..4 {
        let scans = machine.times.scans;
        let (answer, _) = machine.ask_for_scans(&request);
        assert_eq!(machine.times.scans, scans + 1);
        assert_eq!((machine.plc.mode(), answer[0]), (Mode::Stop, 100));
        assert_eq!(answer[1..3], (machine.times.scans as u16).to_be_bytes());
        assert_eq!(answer[3..9], [0x80, 1, 0, 0, 0, 0]);
        assert_eq!(answer[9..15], [0; 6], "jumped over");
        assert_eq!(answer[15..], [0x80, 3, 0, 0, 0, 1 + executed]);
        for _ in 0..3 {
            machine.scan();
        }
    }
    let scans = machine.times.scans;
    for wrong in [&request[..request.len() - 1], &[100, 0], &[100, 1, 0x1E, 0, 0xFF, 0, 0]] {
        assert_eq!(machine.ask(wrong), [0xE4, 3]);
    }
    assert!(machine.commands.is_empty(), "nothing was executed for it");
    assert_eq!(machine.times.scans, scans);
    assert_eq!(Machine::empty_with_line().ask(&request), [0xE4, 4]);
}

#[test]
fn status_refuses_what_it_cannot_show() {
    let mut machine = Machine::with_room(RUNGS, 252);
    let entries: Vec<_> = (100..124).map(|offset| (offset, NO_OPERAND)).collect();
    assert_eq!(machine.ask(&status(&entries)).len(), 3 + 24 * 6);
    let too_many: Vec<_> = (100..125).map(|offset| (offset, NO_OPERAND)).collect();
    assert_eq!(machine.ask(&status(&too_many)), [0xC5, 3]);
    assert_eq!(machine.ask(&status(&[])), [0xC5, 3]);
    assert_eq!(machine.ask(&status(&[(100, NO_OPERAND), (100, NO_OPERAND)])), [0xC5, 3]);
    assert_eq!(machine.ask(&status(&[(100, [0x29, 0, 31])])), [0xC5, 2]);
    assert_eq!(machine.ask(&[69, 1, 0, 100, 0xFF, 0]), [0xC5, 3]);
    assert_eq!(Machine::empty_with_line().ask(&status(&[(100, NO_OPERAND)])), [0xC5, 4]);
    let mut small = Machine::with_room(RUNGS, 62);
    assert_eq!(small.ask(&status(&entries[..5])).len(), 33);
    assert_eq!(small.ask(&status(&entries[..6])), [0xC5, 3]);
}

struct Trace {
    every: u16,
    before: u16,
    kind: u8,
    trigger: [u8; 3],
}

fn start(trace: Trace, references: &[[u8; 3]]) -> Vec<u8> {
    let Trace { every, before, kind, trigger } = trace;
    let count = references.len() as u8;
    [
        &[70, 1][..],
        &every.to_be_bytes(),
        &before.to_be_bytes(),
        &[kind],
        &trigger,
        &[count],
        &references.concat(),
    ]
    .concat()
}

fn word(answer: &[u8], at: usize) -> u16 {
    u16::from_be_bytes([answer[at], answer[at + 1]])
}

/// How far the trace has come.
const DONE: u8 = 1;
const WAITING: u8 = 2;
const FILLING: u8 = 3;

fn phase(machine: &mut Machine) -> u8 {
    machine.ask(&[70, 0])[1]
}

/// What the memory of the trace begins with, as docs/protocol.md has it.
struct Head {
    values: u16,
    sample_len: u8,
    capacity: u16,
    samples: u16,
    triggered_at: u16,
    last_scan: u16,
    first: u16,
    next: u16,
}

fn head(machine: &mut Machine) -> Head {
    let answer = machine.ask(&[71, 1, 0, 0, 25]);
    assert_eq!(answer[..2], [71, 25]);
    let memory = &answer[2..];
    Head {
        values: memory[8].into(),
        sample_len: memory[10],
        capacity: word(memory, 13),
        samples: word(memory, 15),
        triggered_at: word(memory, 17),
        last_scan: word(memory, 19),
        first: word(memory, 21),
        next: word(memory, 23),
    }
}

/// The samples in their order, each a word.
fn samples(machine: &mut Machine) -> Vec<u16> {
    let head = head(machine);
    let end = (head.next - head.first) / 2;
    (0..head.samples)
        .map(|index| {
            let place = (end + head.capacity - head.samples + index) % head.capacity;
            let [high, low] = (25 + 2 * head.values + 2 * place).to_be_bytes();
            let answer = machine.ask(&[71, 1, high, low, 2]);
            word(&answer, 2)
        })
        .collect()
}

#[test]
fn a_trace_keeps_what_was_before_the_trigger() {
    let mut machine = Machine::with_room(RUNGS, 252);
    let answer = machine.ask(&start(
        Trace { every: 1, before: 10, kind: 1, trigger: [0x02, 0, 0] },
        &[[0x89, 0, 0]],
    ));
    assert_eq!(answer, [70, WAITING]);
    let Head { sample_len, capacity, triggered_at, .. } = head(&mut machine);
    assert_eq!((sample_len, triggered_at), (2, 0xFFFF));
    let room = DATA_END - machine.link.frame() - 252;
    assert_eq!(capacity, (room - 25 - 2) / 2);
    // The ring goes round once before the trigger.
    for _ in 0..capacity + 5 {
        machine.scan();
    }
    assert_eq!((phase(&mut machine), head(&mut machine).samples), (WAITING, capacity));
    machine.inputs = 0b100;
    machine.scan();
    let triggered_in = machine.times.scans as u16;
    let trigger_value =
        machine.memory.word(machine.plc.program().unwrap().plan().v_address(0).unwrap());
    for _ in 0..2 * capacity {
        machine.scan();
    }
    assert_eq!(phase(&mut machine), DONE);
    let Head { samples: count, triggered_at, last_scan, .. } = head(&mut machine);
    assert_eq!((count, triggered_at), (capacity, 10));
    assert_eq!(last_scan - (capacity - 1), triggered_in - 10);
    let expected: Vec<u16> = (trigger_value - 10..).take(capacity.into()).collect();
    assert_eq!(samples(&mut machine), expected);
}

#[test]
fn a_trace_takes_every_nth_scan_and_stops() {
    let mut machine = Machine::with_room(RUNGS, 252);
    assert_eq!(machine.ask(&[70, 2]), [70, 0], "there is none to stop");
    machine.ask(&start(Trace { every: 3, before: 0, kind: 0, trigger: [0; 3] }, &[[0x89, 0, 0]]));
    for _ in 0..10 {
        machine.scan();
    }
    assert_eq!(machine.ask(&[70, 2]), [70, DONE]);
    let Head { samples: count, triggered_at, last_scan, .. } = head(&mut machine);
    assert_eq!((count, triggered_at), (4, 0));
    let taken = samples(&mut machine);
    assert_eq!(taken, [taken[0], taken[0] + 3, taken[0] + 6, taken[0] + 9]);
    assert_eq!(last_scan, machine.times.scans as u16);
    machine.scan();
    assert_eq!(samples(&mut machine), taken);
}

#[test]
fn every_kind_of_trigger_fires_when_it_should() {
    // (kind, bit in each scan, index of the scan that triggers)
    let cases = [
        (1, [true, false, true, true], Some(2)),
        (2, [false, true, false, true], Some(2)),
        (2, [false, false, false, false], None),
        (3, [false, true, true, true], Some(1)),
        (4, [true, true, true, false], Some(3)),
        (0, [false, false, false, false], Some(0)),
    ];
    for (kind, levels, triggers) in cases {
        let mut machine = Machine::with_room(RUNGS, 252);
        machine.ask(&start(
            Trace { every: 1, before: 20, kind, trigger: [0x02, 0, 0] },
            &[[0x28, 0, 5], [0x02, 0, 0]],
        ));
        for (index, level) in levels.into_iter().enumerate() {
            machine.inputs = u8::from(level) << 2;
            machine.scan();
            let is_triggered = triggers.is_some_and(|at| index >= at);
            let expected = if is_triggered { FILLING } else { WAITING };
            assert_eq!(phase(&mut machine), expected, "kind {kind}, scan {index}");
            let expected = if is_triggered { triggers.unwrap() as u16 } else { 0xFFFF };
            assert_eq!(head(&mut machine).triggered_at, expected);
        }
    }
}

#[test]
fn a_trace_that_cannot_be_is_refused_and_the_one_before_is_gone() {
    let mut machine = Machine::with_room(RUNGS, 252);
    let m = [0x28, 0, 0];
    let good = || start(Trace { every: 1, before: 0, kind: 0, trigger: [0; 3] }, &[m]);
    assert_eq!(machine.ask(&[71, 1, 0, 0, 1]), [71, 1, 0], "memory, whatever there is");
    assert_eq!(machine.ask(&good())[1], WAITING);
    let capacity = head(&mut machine).capacity;
    assert_eq!(
        machine.ask(&start(Trace { every: 0, before: 0, kind: 0, trigger: [0; 3] }, &[m])),
        [0xC6, 3]
    );
    assert_eq!(
        machine.ask(&start(Trace { every: 1, before: 0, kind: 5, trigger: [0; 3] }, &[m])),
        [0xC6, 3]
    );
    assert_eq!(
        machine.ask(&start(Trace { every: 1, before: 0, kind: 1, trigger: m }, &[m])),
        [0xC6, 2]
    );
    assert_eq!(
        machine.ask(&start(Trace { every: 1, before: 0, kind: 0, trigger: [0; 3] }, &[])),
        [0xC6, 3]
    );
    assert_eq!(
        machine.ask(&start(Trace { every: 1, before: 0, kind: 0, trigger: [0; 3] }, &[m; 9])),
        [0xC6, 3]
    );
    assert_eq!(machine.ask(&[70, 3]), [0xC6, 3]);
    assert_eq!(phase(&mut machine), WAITING);
    let too_early = Trace { every: 1, before: capacity, kind: 0, trigger: [0; 3] };
    assert_eq!(machine.ask(&start(too_early, &[m])), [0xC6, 4]);
    assert_eq!(machine.ask(&[70, 0]), [70, 0]);
    let mut full = Machine::with_room(PROGRAM, 252);
    full.link.place(full.link.frame(), 252, DATA_END, DATA_END);
    assert_eq!(full.ask(&good()), [0xC6, 4]);
    assert_eq!(full.ask(&[71, 1, 0, 0, 1]), [0xC7, 2]);
    assert_eq!(full.memory.byte(M_START), 0);
}
