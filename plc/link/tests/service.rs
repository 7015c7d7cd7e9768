//! The service functions: every action, every area, every refusal.

mod machine;

use machine::{Machine, PROGRAM};
use plc_isa::{AC_START, AQW_START, I_START, M_START, Q_START, S_START, SM_START};
use plc_link::Command;

/// Size of a reference.
const BYTE: u8 = 8;
const WORD: u8 = 9;
const DOUBLE: u8 = 10;
/// V memory as an area of a reference.
const V: u8 = 8;

fn reference(area: u8, size: u8, number: u16) -> [u8; 3] {
    let [high, low] = number.to_be_bytes();
    [area << 4 | size, high, low]
}

fn watch(references: &[[u8; 3]]) -> Vec<u8> {
    [&[67, references.len() as u8][..], references.concat().as_slice()].concat()
}

fn force(action: u8, reference: [u8; 3], value: u32) -> Vec<u8> {
    [&[68, action][..], &reference, &value.to_be_bytes()].concat()
}

fn v_address(machine: &Machine, byte: u16) -> u16 {
    machine.plc.program().unwrap().plan().v_address(byte).unwrap()
}

#[test]
fn identify_tells_everything_in_a_fixed_length() {
    let mut machine = Machine::new();
    let answer = machine.ask(&[65]);
    assert_eq!(answer.len(), 40);
    assert_eq!(answer[..4], [65, 1, 7, 3]);
    assert_eq!(answer[12..14], [0, 250]);
    assert_eq!(answer[14..18], [0, 0, 3, 232]);
    assert_eq!(answer[26..30], [0, 0, 0, 1]);
    assert_eq!(answer[32..34], [0, 252]);
    let len = machine.image.len();
    assert_eq!(answer[34..36], (len as u16).to_be_bytes());
    let crc: Vec<u8> = machine.image[len - 4..].iter().rev().copied().collect();
    assert_eq!(answer[36..], crc);
    machine.ask(&force(1, reference(1, 0, 2), 1));
    machine.plc.stop();
    machine.scans_left = 1;
    assert_eq!(machine.ask(&[65])[3], 0b1_0110);
    assert_eq!(Machine::empty_with_line().ask(&[65])[3], 0);
    assert_eq!(machine.ask(&[65, 0]), [0xC1, 3]);
}

#[test]
fn control_passes_commands_on_that_can_be_obeyed() {
    let mut machine = Machine::new();
    assert_eq!(machine.ask(&[66, 0, 0, 0]), [66, 0, 0, 0]);
    assert_eq!(machine.ask(&[66, 3, 0, 1]), [0xC2, 4]);
    machine.plc.stop();
    assert_eq!(machine.ask(&[66, 3, 1, 2]), [66, 3, 1, 2]);
    assert_eq!(machine.ask(&[66, 3, 0, 0]), [0xC2, 3]);
    machine.ask(&[66, 1, 0, 0]);
    machine.ask(&[66, 2, 0, 0]);
    assert_eq!(
        machine.commands,
        [Command::Stop, Command::Scans(258), Command::Run, Command::ClearFault]
    );
    assert_eq!(machine.ask(&[66, 4, 0, 0]), [0xC2, 3]);
    assert_eq!(machine.ask(&[66, 1, 0]), [0xC2, 3]);
    let mut empty = Machine::empty_with_line();
    assert_eq!(empty.ask(&[66, 1, 0, 0]), [0xC2, 4]);
    assert_eq!(empty.ask(&[66, 3, 0, 1]), [0xC2, 4]);
    assert_eq!(empty.ask(&[66, 0, 0, 0]), [66, 0, 0, 0]);
}

#[test]
fn watch_reads_every_area_in_every_size() {
    let mut machine = Machine::new();
    let v100 = v_address(&machine, 100);
    let (timer, counter) = {
        let plan = machine.plc.program().unwrap().plan();
        (plan.timer_slot(37).unwrap().address, plan.counter_slot(7).unwrap().address)
    };
    let memory = &mut machine.memory;
    for (address, value) in [
        (I_START + 1, 0x8101),
        (Q_START + 14, 0x2233),
        (M_START + 28, 0x4455),
        (M_START + 30, 0x6677),
    ] {
        memory.set_word(address, value);
    }
    for (address, value) in [
        (timer, 0x1122),
        (counter, 0x3344),
        (v100, 0xABCD),
        (AC_START + 4, 0xDEAD),
        (AC_START + 6, 0xBEEF),
    ] {
        memory.set_word(address, value);
    }
    memory.set_byte(0x01A0, 0x80);
    machine.plc.stop();
    let references = [
        reference(0, 7, 1),
        reference(0, BYTE, 2),
        reference(1, WORD, 14),
        reference(2, DOUBLE, 28),
        reference(5, WORD, 37),
        reference(6, WORD, 7),
        reference(6, 0, 7),
        reference(8, WORD, 100),
        reference(9, DOUBLE, 28),
        reference(3, 0, 0),
    ];
    let answer = machine.ask(&watch(&references));
    let values = [
        &[1, 1][..],
        &[0x22, 0x33, 0x44, 0x55, 0x66, 0x77],
        &[0x11, 0x22, 0x33, 0x44, 1, 0xAB, 0xCD],
        &[0xDE, 0xAD, 0xBE, 0xEF, 1],
    ];
    assert_eq!(answer[3..], values.concat());
}

#[test]
fn references_to_nothing_are_refused() {
    let mut machine = Machine::new();
    let wrong = [
        reference(0, BYTE, 16),
        reference(0, WORD, 15),
        reference(2, DOUBLE, 29),
        reference(2, 11, 0),
        reference(3, BYTE, 32),
        reference(3, WORD, 34),
        reference(5, WORD, 1),
        reference(5, 1, 1),
        reference(5, BYTE, 37),
        reference(5, 0, 256),
        reference(6, WORD, 6),
        reference(7, BYTE, 64),
        reference(8, WORD, 10),
        reference(8, BYTE, 0x8022),
        reference(9, BYTE, 0),
        reference(9, WORD, 1),
        reference(9, WORD, 24),
        reference(9, DOUBLE, 26),
        reference(9, WORD, 52),
        reference(10, BYTE, 0),
        [0xFF, 0, 0],
    ];
    for wrong in wrong {
        assert_eq!(machine.ask(&watch(&[wrong])), [0xC3, 2], "{wrong:02X?}");
    }
    let right = [
        reference(3, BYTE, 34),
        reference(7, WORD, 62),
        reference(9, WORD, 50),
        reference(8, DOUBLE, 1004),
    ];
    assert_eq!(machine.ask(&watch(&right)).len(), 3 + 1 + 2 + 2 + 4);
    // Without a program there are the areas of fixed size.
    let mut empty = Machine::empty_with_line();
    assert_eq!(empty.ask(&watch(&[reference(8, BYTE, 10)])), [0xC3, 2]);
    assert_eq!(empty.ask(&watch(&[reference(2, BYTE, 10)])), [67, 0, 0, 0]);
}

#[test]
fn a_watch_takes_1_to_32_and_as_much_room_as_there_is() {
    let mut machine = Machine::new();
    for (index, address) in (M_START..).take(32).enumerate() {
        machine.memory.set_byte(address, index as u8);
    }
    let references: Vec<_> = (0..32)
        .map(|number| reference(2, if number < 29 { DOUBLE } else { BYTE }, number))
        .collect();
    machine.patience = 3;
    let (answer, scans) = machine.ask_for_scans(&watch(&references));
    assert_eq!(answer.len(), 3 + 29 * 4 + 3);
    assert_eq!(answer[3..7], [0, 1, 2, 3]);
    assert_eq!(answer[3 + 28 * 4..], [28, 29, 30, 31, 29, 30, 31]);
    assert_eq!(scans, 10);
    let too_many: Vec<_> = (0..33).map(|_| reference(2, 0, 0)).collect();
    assert_eq!(machine.ask(&watch(&too_many)), [0xC3, 3]);
    assert_eq!(machine.ask(&[67, 0]), [0xC3, 3]);
    assert_eq!(machine.ask(&[67, 2, 0x28, 0, 0]), [0xC3, 3]);
    let mut small = Machine::with_room(PROGRAM, 62);
    assert_eq!(small.ask(&watch(&references[..14])).len(), 59);
    assert_eq!(small.ask(&watch(&references[..15])), [0xC3, 3]);
}

#[test]
fn values_of_a_watch_are_of_one_moment() {
    let mut machine = Machine::new();
    machine.patience = 1;
    let references = [reference(3, 6, 0); 8];
    // SM0.6 is another in each scan.
    let (answer, scans) = machine.ask_for_scans(&watch(&references));
    assert_eq!(scans, 8);
    assert!(answer[3..] == [0; 8] || answer[3..] == [1; 8], "{answer:?}");
    assert_eq!(answer[1..3], (machine.times.scans as u16).to_be_bytes());
}

#[test]
fn forces_hold_until_they_end() {
    let mut machine = Machine::new();
    let (i7, q0, vw) = (reference(0, 7, 0), reference(1, BYTE, 0), reference(8, WORD, 100));
    assert_eq!(machine.ask(&[68, 0]), [68, 0]);
    let mut table = machine.ask(&force(1, i7, 1));
    assert_eq!(table, [&[68, 1][..], &i7, &[0, 0, 0, 1]].concat());
    machine.ask(&force(1, vw, 0x1_2345));
    table = machine.ask(&force(1, reference(1, 1, 0), 1));
    assert_eq!(table.len(), 2 + 3 * 7);
    machine.scan();
    // I0.7 is written to Q0.0 by the program.
    assert_eq!(machine.memory.byte(Q_START), 0b11);
    assert_eq!(machine.memory.word(v_address(&machine, 100)), 0x2345);
    assert_eq!(machine.memory.byte(SM_START + 4) & 0x80, 0x80);
    // The same operand again: another value, no other entry.
    assert_eq!(machine.ask(&force(1, i7, 0)).len(), 2 + 3 * 7);
    machine.scan();
    assert_eq!(machine.memory.byte(Q_START), 0b10);
    // The last takes the place of the one that ends.
    assert_eq!(machine.ask(&force(2, i7, 0))[2..5], reference(1, 1, 0));
    assert_eq!(machine.ask(&force(2, q0, 0)).len(), 2 + 2 * 7);
    assert_eq!(machine.ask(&[68, 3]), [68, 0]);
    assert_eq!(machine.memory.byte(SM_START + 4) & 0x80, 0);
    assert!(machine.link.forces.is_empty());
}

#[test]
fn sixteen_operands_can_be_forced_and_inputs_that_are_not_there_come_back() {
    let mut machine = Machine::new();
    for byte in 0..16 {
        assert_eq!(machine.ask(&force(1, reference(0, BYTE, byte), 0xFF))[1], byte as u8 + 1);
    }
    assert_eq!(machine.ask(&force(1, reference(2, 0, 0), 1)), [0xC4, 4]);
    machine.scan();
    assert_eq!(machine.memory.byte(I_START + 15), 0xFF);
    assert_eq!(machine.ask(&force(2, reference(0, BYTE, 15), 0))[1], 15);
    machine.scan();
    assert_eq!(machine.memory.byte(I_START + 15), 0);
    assert_eq!(machine.memory.byte(I_START + 14), 0xFF);
    let mut small = Machine::with_room(PROGRAM, 62);
    let lens: Vec<usize> =
        (0..10).map(|byte| small.ask(&force(1, reference(2, BYTE, byte), 0)).len()).collect();
    assert_eq!(lens[7..], [58, 58, 58]);
    assert_eq!(small.ask(&[68, 0])[1], 10);
}

#[test]
fn what_cannot_be_forced_or_set_is_refused() {
    let mut machine = Machine::new();
    let (forceable, settable) = (1, 2);
    let operands = [
        (reference(0, 0, 0), forceable),
        (reference(1, WORD, 0), forceable | settable),
        (reference(2, DOUBLE, 0), forceable | settable),
        (reference(3, BYTE, 31), 0),
        (reference(3, BYTE, 34), 0),
        (reference(4, BYTE, 0), settable),
        (reference(5, 0, 37), 0),
        (reference(5, WORD, 37), settable),
        (reference(6, 0, 7), 0),
        (reference(6, WORD, 7), settable),
        (reference(7, BYTE, 0), 0),
        (reference(8, BYTE, 10), forceable | settable),
        (reference(9, WORD, 10), forceable),
        (reference(9, WORD, 12), 0),
        (reference(9, DOUBLE, 36), settable),
        (reference(9, DOUBLE, 40), 0),
        (reference(9, WORD, 48), forceable | settable),
    ];
    for (operand, can) in operands {
        let refused = machine.ask(&force(1, operand, 0)) == [0xC4, 2];
        assert_eq!(refused, can & forceable == 0, "{operand:02X?}");
        let width = [1, 2, 4][usize::from((operand[0] & 15).saturating_sub(8))];
        let request = [&[72, 1][..], &operand, &vec![0; width]].concat();
        let answer = machine.ask(&request);
        assert_eq!(
            answer,
            if can & settable == 0 { vec![0xC8, 2] } else { vec![72, 1] },
            "{operand:02X?}"
        );
        machine.ask(&[68, 3]);
    }
    for wrong in [&[68, 4][..], &[68], &[68, 0, 0], &[68, 1, 0x20, 0, 0], &[68, 3, 0]] {
        assert_eq!(machine.ask(wrong), [0xC4, 3]);
    }
}

#[test]
fn set_is_all_or_nothing() {
    let mut machine = Machine::new();
    let mut request =
        [&[72, 3][..], &reference(2, 3, 0), &[1], &reference(8, WORD, 100), &[0xAB, 0xCD]].concat();
    request.extend([&reference(9, DOUBLE, 24)[..], &[1, 2, 3, 4]].concat());
    machine.patience = 1;
    let (answer, scans) = machine.ask_for_scans(&request);
    assert_eq!((answer, scans), (vec![72, 3], 3));
    assert_eq!(machine.memory.byte(M_START), 1 << 3);
    assert_eq!(machine.memory.word(v_address(&machine, 100)), 0xABCD);
    assert_eq!(
        (machine.memory.word(AC_START), machine.memory.word(AC_START + 2)),
        (0x0102, 0x0304)
    );
    let before = machine.memory.clone();
    let half =
        [&[72, 2][..], &reference(4, BYTE, 0), &[0xFF], &reference(3, BYTE, 0), &[1]].concat();
    assert_eq!(machine.ask(&half), [0xC8, 2]);
    assert_eq!(machine.memory.byte(S_START), before.byte(S_START));
    let short = [&[72, 2][..], &reference(4, BYTE, 0), &[0xFF], &reference(4, BYTE, 1)].concat();
    assert_eq!(machine.ask(&short), [0xC8, 3]);
    let long = [&[72, 1][..], &reference(4, BYTE, 0), &[0xFF, 0]].concat();
    assert_eq!(machine.ask(&long), [0xC8, 3]);
    assert_eq!(machine.memory.byte(S_START), before.byte(S_START));
    let many =
        [&[72, 17][..], &[reference(4, BYTE, 0); 17].map(|r| [r[0], r[1], r[2], 0]).concat()]
            .concat();
    assert_eq!(machine.ask(&many), [0xC8, 3]);
    assert_eq!(machine.ask(&[72, 0]), [0xC8, 3]);
    assert_eq!(machine.memory.word(AQW_START), 0);
}

#[test]
fn blocks_of_the_slot_can_be_read_to_its_end() {
    let mut machine = Machine::new();
    assert_eq!(machine.ask(&[71, 0, 0, 0, 4]), [71, 4, b'U', b'2', b'0', b'0']);
    assert_eq!(machine.ask(&[71, 0, 0x1D, 0xFF, 1]), [71, 1, 0xFF]);
    assert_eq!(machine.ask(&[71, 0, 0x1D, 0xFF, 2]), [0xC7, 2]);
    assert_eq!(machine.ask(&[71, 0, 0xFF, 0xFF, 1]), [0xC7, 2]);
    assert_eq!(machine.ask(&[71, 1, 0xFF, 0xFF, 1]), [0xC7, 2]);
    assert_eq!(machine.ask(&[71, 2, 0, 0, 1]), [0xC7, 2]);
    assert_eq!(machine.ask(&[71, 0, 0, 0, 0]), [0xC7, 3]);
    assert_eq!(machine.ask(&[71, 0, 0, 0, 65]), [0xC7, 3]);
    assert_eq!(machine.ask(&[71, 0, 0, 0, 64]).len(), 66);
    let mut small = Machine::with_room(PROGRAM, 62);
    assert_eq!(small.ask(&[71, 0, 0, 0, 61]), [0xC7, 3]);
    assert_eq!(small.ask(&[71, 0, 0, 0, 60]).len(), 62);
}

/// Data memory that the Uno does not have: addresses of more than 12 bits.
#[test]
fn far_operands_are_reached() {
    let program = "//# board host\n//# memory VB0-VB10239\nLD SM0.0\nMOVW VW10000, VW10100\n";
    let mut machine = Machine::with_room(program, 252);
    let (near, far) = (reference(V, WORD, 100), reference(V, WORD, 10_000));
    let (copy, bit) = (reference(V, WORD, 10_100), reference(V, 3, 10_239));
    assert!(v_address(&machine, 10_239) > 0x2000);
    let set = [&[72, 3][..], &near, &[0x11, 0x22], &far, &[0x33, 0x44], &bit, &[1]].concat();
    assert_eq!(machine.ask(&set), [72, 3]);
    machine.scan();
    let many = [[near, far, copy, bit].as_slice(), &[copy; 28]].concat();
    let answer = machine.ask(&watch(&many));
    assert_eq!(answer[3..10], [0x11, 0x22, 0x33, 0x44, 0x33, 0x44, 1]);
    assert_eq!(answer[10..], [0x33, 0x44].repeat(28));
    // Other bytes are as they were.
    assert_eq!(machine.memory.word(v_address(&machine, 10_000 - 0x1000)), 0);

    machine.ask(&force(1, far, 0x5566));
    machine.scan();
    assert_eq!(machine.ask(&watch(&[copy]))[3..], [0x55, 0x66]);
    assert_eq!(machine.memory.word(v_address(&machine, 10_000)), 0x5566);

    let at = machine.plc.program().unwrap().code_at();
    let status = [&[69, 1][..], &at.to_be_bytes(), &far].concat();
    let answer = machine.ask(&status);
    assert_eq!((answer[3] >> 7, &answer[5..]), (1, &[0, 0, 0x55, 0x66][..]));

    let trace = [&[70, 1, 0, 1, 0, 0, 1], &bit[..], &[2], &far[..], &copy[..]].concat();
    machine.ask(&[&[72, 1][..], &bit, &[0]].concat());
    assert_eq!(machine.ask(&trace), [70, 2]);
    machine.scan();
    assert_eq!(machine.ask(&[70, 0]), [70, 2]);
    machine.ask(&[&[72, 1][..], &bit, &[1]].concat());
    machine.scan();
    assert_eq!(machine.ask(&[70, 0]), [70, 3]);
    let head = machine.ask(&[71, 1, 0, 0, 25]);
    let first = u16::from_be_bytes([head[2 + 21], head[2 + 22]]) - machine.link.frame() - 252;
    let sample = machine.ask(&[&[71, 1][..], &first.to_be_bytes(), &[4]].concat());
    assert_eq!(sample[2..], [0x55, 0x66, 0x55, 0x66]);
}
