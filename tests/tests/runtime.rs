//! The runtime of other boards, on a board on the desk, and the host side by side: every case, and
//! random programs, equal after every scan.
//!
//! `RANDOM_PROGRAMS=20000 cargo test --package tests --features uno --test runtime` runs longer.
#![cfg(feature = "uno")]

#[path = "../../runtime/tests/desk/mod.rs"]
mod desk;

use std::collections::VecDeque;

use awl_sim::action::Action;
use awl_sim::machine::host::Host;
use awl_sim::machine::{Machine, MachineError, Mode};
use awl_sim::operand::Operand;
use awl_sim::plant::Outputs;
use desk::Desk;
use plc_isa::{DATA_START, Program};
use plc_vm::{Fault, Inputs};
use runtime::Controller;
use tests::case::{Case, Prepared, host};
use tests::effort::effort;
use tests::lockstep::{Programs, random_image, random_scans};

/// Host and runtime with the same program. As a machine it is the host; the runtime must be the
/// same.
struct Pair {
    host: Host,
    board: Box<Controller<Desk>>,
    /// One past the last data address that is compared: after its plan the board keeps a copy of
    /// what is retained.
    compared_end: u16,
    /// Characters on the line, and when they come in.
    incoming: VecDeque<(u64, u8)>,
    scans: u64,
    difference: Option<String>,
}

impl Pair {
    fn new(image: &[u8]) -> Pair {
        let board = desk::on(Desk::new(Some(image.to_vec())));
        let plan = board.plc().program().map(Program::plan);
        let retaining = plan.filter(|plan| plan.header.retained > 0);
        let compared_end = retaining.map_or(u16::MAX, |plan| plan.end());
        let (host, incoming) = (host(image), VecDeque::new());
        Pair { host, board, compared_end, incoming, scans: 0, difference: None }
    }

    fn must_be<T: PartialEq + std::fmt::Debug>(&mut self, what: &str, board: T, host: T) {
        if board != host && self.difference.is_none() {
            let scan = self.scans;
            self.difference =
                Some(format!("after scan {scan}: {what} is {board:?}, should be {host:?}"));
        }
    }

    fn compare(&mut self) {
        let runs = self.host.mode() == Mode::Run;
        self.must_be("RUN", self.board.plc().mode() == plc_vm::Mode::Run, runs);
        let is_watchdog = matches!(self.host.fault_kind(), Some(Fault::Watchdog { .. }));
        if is_watchdog {
            // How far an endless loop came is a matter of speed.
            return;
        }
        self.must_be("the fault", self.board.plc().fault(), self.host.fault_kind());
        let levels = self.host.pin_levels();
        let outputs = self.board.board().outputs;
        self.must_be("what the pins are driven to", outputs, runs.then_some(levels));
        let host = self.host.memory().bytes().iter();
        let bytes = (DATA_START..).zip(self.board.memory().bytes().iter().zip(host));
        let different = bytes
            .into_iter()
            .find(|(address, (board, host))| board != host && *address < self.compared_end);
        if let Some((address, (&board, &host))) = different {
            self.must_be(&format!("the byte at {address:#06x}"), board, host);
        }
    }
}

impl Machine for Pair {
    fn write(&mut self, operand: Operand, value: i32) -> Result<(), MachineError> {
        let before = self.host.memory().clone();
        self.host.write(operand, value)?;
        let changes = (DATA_START..).zip(before.bytes().iter().zip(self.host.memory().bytes()));
        for (address, (_, &byte)) in changes.filter(|(_, (before, after))| before != after) {
            self.board.memory_mut().set_byte(address, byte);
        }
        Ok(())
    }

    fn read(&mut self, operand: Operand) -> Result<i32, MachineError> {
        self.host.read(operand)
    }

    fn act(&mut self, action: &Action) -> Result<(), MachineError> {
        if let Action::Receive { at_ms, bytes } = action {
            self.incoming.extend((*at_ms..).zip(bytes.iter().copied()));
        }
        self.host.act(action)
    }

    fn take_sent(&mut self) -> Result<Vec<u8>, MachineError> {
        let sent = std::mem::take(&mut self.board.board().wire.outgoing);
        let host = self.host.take_sent()?;
        self.must_be("what was sent", sent, host.clone());
        Ok(host)
    }

    fn scan(&mut self, now_ms: u64) {
        self.host.scan(now_ms);
        let inputs = *self.host.inputs();
        let inverted = self.board.plc().program();
        let inverted = inverted.map_or(0, |one| one.plan().header.settings.invert_inputs);
        let desk = self.board.board();
        desk.now_us = (now_ms as u32).wrapping_mul(1000);
        desk.levels = inputs.digital[0] ^ inverted;
        desk.readings = readings(&inputs);
        while let Some(&(_, character)) = self.incoming.front().filter(|(at, _)| *at <= now_ms) {
            self.incoming.pop_front();
            desk.wire.incoming.push_back(character);
        }
        // An endless loop is one for a clock that goes on.
        let is_endless = matches!(self.host.fault_kind(), Some(Fault::Watchdog { .. }));
        desk.look_us = if is_endless { 1000 } else { 0 };
        desk.marks.clear();
        self.board.scan();
        let marks = [runtime::Mark::ScanStart, runtime::Mark::ScanEnd];
        assert_eq!(self.board.board().marks, marks, "a scan is a scan");
        self.scans += 1;
        self.compare();
    }

    fn mode(&self) -> Mode {
        self.host.mode()
    }

    fn fault(&self) -> Option<String> {
        self.host.fault()
    }

    fn pin_levels(&mut self) -> u8 {
        self.host.pin_levels()
    }

    fn output_pins(&mut self) -> Outputs {
        self.host.output_pins()
    }

    fn drive_pin(&mut self, input: u8, high: bool) {
        self.host.drive_pin(input, high);
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
    let mut pair = Pair::new(&case.image);
    let mut failures = case.failures(&mut pair);
    let difference = pair.difference.take();
    failures.extend(difference.map(|text| format!("{}: {text}", case.case.file)));
    failures
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
        scans += random_scans(
            &mut Pair::new(&image),
            &mut rng,
            |pair| pair.difference.as_deref(),
            place,
        );
    }
    println!("{count} programs, {scans} scans, all equal");
    assert!(scans >= 2 * count, "the programs hardly ran");
}
