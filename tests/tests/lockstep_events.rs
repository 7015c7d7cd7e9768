//! Random programs with interrupt routines, host and board side by side: what each scan executes
//! for the events since the last one, in which order, and what the routines leave as it was. Many
//! events at a time, more than queues hold.
//!
//! `RANDOM_PROGRAMS=10000 cargo test --release --package tests --features uno --test
//! lockstep_events` runs longer, `RANDOM_SEED` starts elsewhere. A failure names its seed.
#![cfg(feature = "uno")]

use awl_asm::Address;
use awl_sim::machine::Machine;
use awl_sim::machine::uno::Code;
use awl_sim::operand::Operand;
use fastrand::Rng;
use plc_isa::Area;
use plc_vm::Fault;
use tests::case::host;
use tests::effort::effort;
use tests::image::image;
use tests::lockstep::{Pair, board};
use tests::random::random_interrupts;

/// IB0 changes often, of IB1 now and then a bit is set.
fn random_levels(rng: &mut Rng) -> [u8; 2] {
    [rng.u8(..64), if rng.u8(..4) == 0 { 1 << rng.u8(..8) } else { 0 }]
}

#[test]
fn random_interrupts_are_the_same_on_the_board() {
    assert_interrupts_are_the_same(Code::Bytecode);
}

#[test]
fn random_interrupts_are_the_same_translated() {
    assert_interrupts_are_the_same(Code::Native);
}

fn assert_interrupts_are_the_same(code: Code) {
    let (first, count) = (effort("RANDOM_SEED", 1), effort("RANDOM_PROGRAMS", 300));
    let mut uno = board(code);
    let (mut executed, mut lost) = (0, [0; 3]);
    for seed in first..first + count {
        let mut rng = Rng::with_seed(seed);
        let text = random_interrupts(&mut rng);
        let mut pair = Pair::new(&mut uno, &image(&text), rng.u32(..)).unwrap();
        let mut now_ms = 0;
        for scan in 1..=rng.u32(10..60) {
            for (byte, levels) in (0..).zip(random_levels(&mut rng)) {
                pair.write(Operand::At(Address::Byte { area: Area::I, byte }), levels.into())
                    .unwrap();
            }
            pair.scan(now_ms);
            assert_eq!(pair.difference(), None, "seed {seed}, scan {scan}\n{text}");
            now_ms += random_step_ms(&mut rng);
            let status = pair.read(Operand::At(Address::Byte { area: Area::M, byte: 7 })).unwrap();
            (0..).zip(&mut lost).for_each(|(bit, lost)| *lost += status >> bit & 1);
        }
        executed += pair.read(Operand::At(Address::Word { area: Area::M, byte: 8 })).unwrap();
    }
    println!(
        "{count} programs, {executed} routines, scans with queues that were too short: {lost:?}"
    );
    assert!(executed as u64 > 10 * count && lost[1] > 0 && lost[2] > 0, "too little happened");
}

/// The poll sees only the low byte of the clock: a step of 256 ms it takes for none.
fn random_step_ms(rng: &mut Rng) -> u64 {
    match rng.u32(..20) {
        0 => 0,
        1 => rng.u64(100..256),
        2 => rng.u64(257..512),
        _ => rng.u64(1..20),
    }
}

/// Each time T32 comes twice between two looks of the board, which sees nothing; the host sees an
/// event that causes itself.
#[test]
fn endless_routines_end_on_the_host() {
    let main = "LD SM0.1\nATCH I0, 21\nENI\nLD I0.0\nTON T32, 0";
    let routine = "LDN SM0.0\nTON T32, 0\nLD SM0.0\nTON T32, 0";
    let text = format!(
        "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\n{main}\nEND_ORGANIZATION_BLOCK\n\
         INTERRUPT_BLOCK I0:INT0\nBEGIN\n{routine}\nEND_INTERRUPT_BLOCK\n"
    );
    let mut host = host(&image(&text));
    host.scan(0);
    assert_eq!(host.fault_kind(), None);
    host.write(Operand::At(Address::Byte { area: Area::I, byte: 0 }), 1).unwrap();
    host.scan(1);
    host.scan(2);
    assert!(matches!(host.fault_kind(), Some(Fault::Watchdog { .. })), "{:?}", host.fault_kind());
}
