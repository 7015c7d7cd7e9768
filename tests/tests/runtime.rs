//! The runtime of other boards, on a board on the desk, and the host side by side: every case, and
//! random programs, equal after every scan.
//!
//! `RANDOM_PROGRAMS=20000 cargo test --package tests --features uno --test runtime` runs longer.
#![cfg(feature = "uno")]

#[path = "../../runtime/tests/desk/mod.rs"]
mod desk;

use std::collections::VecDeque;

use desk::Desk;
use plc_vm::{Fault, Inputs};
use runtime::Controller;
use tests::beside::{Board, Pair};
use tests::case::{Case, Prepared};
use tests::effort::effort;
use tests::random_runs::{Programs, random_image, random_scans};

/// The runtime on the desk.
struct OnDesk {
    board: Box<Controller<Desk>>,
    /// Characters on the line, and when they come in.
    incoming: VecDeque<(u64, u8)>,
    /// The levels of its outputs after the last scan, if they are driven.
    outputs: Option<u8>,
}

/// Host and runtime with the same program.
fn pair(image: &[u8]) -> Pair<OnDesk> {
    let board = desk::on(Desk::new(Some(image.to_vec())));
    Pair::new(OnDesk { board, incoming: VecDeque::new(), outputs: None }, image)
}

impl Board for OnDesk {
    fn set_byte(&mut self, address: u16, byte: u8) {
        self.board.memory_mut().set_byte(address, byte);
    }

    fn receive(&mut self, at_ms: u64, characters: &[u8]) {
        self.incoming.extend((at_ms..).zip(characters.iter().copied()));
    }

    fn scan(&mut self, now_ms: u64, inputs: &Inputs, is_endless: bool) {
        let inverted = self.board.plc().program();
        let inverted = inverted.map_or(0, |one| one.plan().header.settings.invert_inputs);
        let desk = self.board.board();
        desk.now_us = (now_ms as u32).wrapping_mul(1000);
        desk.levels = inputs.digital[0] ^ inverted;
        desk.readings = readings(inputs);
        while let Some(&(_, character)) = self.incoming.front().filter(|(at, _)| *at <= now_ms) {
            self.incoming.pop_front();
            desk.wire.incoming.push_back(character);
        }
        desk.look_us = if is_endless { 1000 } else { 0 };
        desk.marks.clear();
        self.board.scan();
        let marks = [runtime::Mark::ScanStart, runtime::Mark::ScanEnd];
        assert_eq!(self.board.board().marks, marks, "a scan is a scan");
        self.outputs = self.board.board().outputs;
    }

    fn runs(&self) -> bool {
        self.board.plc().mode() == plc_vm::Mode::Run
    }

    fn fault(&self) -> Option<Fault> {
        self.board.plc().fault()
    }

    fn outputs(&self) -> Option<u8> {
        self.outputs
    }

    fn memory(&self) -> &[u8] {
        self.board.memory().bytes()
    }

    fn take_sent(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.board.board().wire.outgoing)
    }
}

/// What a converter gives for these values: where one was given that raw counts do not have, for
/// that.
fn readings(inputs: &Inputs) -> [u16; 6] {
    const FULL: u32 = u16::MAX as u32;
    let part = |reading: u16, most: u32| (u32::from(reading) * most + FULL / 2) / FULL;
    std::array::from_fn(|channel| {
        let (raw, scaled): (u32, u32) = (inputs.raw[channel].into(), inputs.scaled[channel].into());
        let first = (scaled * FULL / 32_000) as u16;
        let near = (0..4).map(|more| first.saturating_add(more));
        let mut fitting = near.filter(|reading| part(*reading, 32_000) == scaled);
        let any = fitting.clone().next();
        let both = fitting.find(|reading| part(*reading, 1023) == raw);
        both.or(any).expect("readings are finer than both scales")
    })
}

fn failures(case: &Prepared) -> Vec<String> {
    pair(&case.image).failures(case)
}

#[test]
fn cases_are_the_same() {
    let cases = [Case::all(), Case::examples(), Case::structured()].concat();
    let prepare = |case: Case| case.prepare().unwrap_or_else(|errors| panic!("{errors}"));
    let all: Vec<Prepared> = cases.into_iter().map(prepare).collect();
    // What happens between two scans comes with interrupts, which this board has none of.
    let (left_out, compared): (Vec<_>, Vec<_>) = all.iter().partition(|case| case.has_actions());
    println!("{} cases compared, {} left out", compared.len(), left_out.len());
    assert!(compared.len() > 20 * left_out.len());
    let found: Vec<String> = compared.into_iter().flat_map(failures).collect();
    assert!(found.is_empty(), "{} failures\n{}", found.len(), found.join("\n"));
}

#[test]
fn random_programs_are_the_same() {
    let (first, count) = (effort("RANDOM_SEED", 1), effort("RANDOM_PROGRAMS", 1_000));
    let mut scans = 0;
    for seed in first..first + count {
        let (image, text, mut rng) = random_image(seed, Programs::Everything);
        let place = |scan| format!("seed {seed}, scan {scan}\n{text}");
        scans += random_scans(&mut pair(&image), &mut rng, Pair::difference, place);
    }
    println!("{count} programs, {scans} scans, all equal");
    assert!(scans >= 2 * count, "the programs hardly ran");
}
