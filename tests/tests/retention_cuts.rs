//! Power cuts: at any cycle, also while the board starts, again and again. What comes back is
//! always of one scan.
//!
//! `POWER_CUTS=2000 cargo test --package tests --features uno --test retention_cuts` cuts more
//! often, `RANDOM_SEED` starts elsewhere. A failure names its seed.
#![cfg(feature = "uno")]

use std::ops::AddAssign;

use fastrand::Rng;
use plc_isa::RETENTION_LEN;
use tests::effort::effort;
use tests::power::{Bench, Board, EEPROM_LEN, ERASED, MS};
use tests::retained::{generation, generation_programs, retained_addresses};

/// Longer than a byte of the EEPROM is busy.
const BUSY_MAX: u64 = 4 * MS;
/// Longer than a board takes to its first scan.
const START_MAX: u64 = 60 * MS;
/// Far beyond the time between two copies.
const LONG_MS: u32 = 2_000_000;

/// Generations by what can be in the EEPROM. `None`: values are lost.
#[derive(Debug, Default)]
struct Saved {
    complete: Option<u16>,
    /// The snapshot after it, with the cycle at which it was taken.
    next: Option<(u16, u64)>,
}

impl Saved {
    fn allows(&self, found: Option<u16>) -> bool {
        found == self.complete || (found.is_some() && found == self.next.map(|(next, _)| next))
    }

    /// Takes note of the snapshot there is, 0 before the first. One that is older than
    /// `saving_max`, or not the last, has been saved.
    fn observe(&mut self, snapshot: u16, now: u64, saving_max: u64) {
        if let Some((next, since)) = self.next
            && (next != snapshot || now - since > saving_max)
        {
            *self = Saved { complete: Some(next), next: None };
        }
        let is_new = self.complete != Some(snapshot) && (self.complete.is_some() || snapshot != 0);
        if is_new && self.next.is_none() {
            self.next = Some((snapshot, now));
        }
    }
}

/// What was found after the cuts.
#[derive(Debug, Default)]
struct Counts {
    back: u64,
    lost: u64,
    /// While the board started.
    in_start: u64,
    /// In the middle of a byte.
    torn: u64,
}

impl AddAssign for Counts {
    fn add_assign(&mut self, other: Counts) {
        self.back += other.back;
        self.lost += other.lost;
        self.in_start += other.in_start;
        self.torn += other.torn;
    }
}

/// A board whose power is cut again and again.
struct Victim {
    bench: Bench,
    retained: Vec<u16>,
    /// Where the snapshot is.
    copies: Vec<u16>,
    /// Longest time from one byte in the EEPROM to the next, and from a snapshot to its complete
    /// copy.
    byte_max: u64,
    saving_max: u64,
    eeprom: Vec<u8>,
    saved: Saved,
    counts: Counts,
    rng: Rng,
}

fn garbage(rng: &mut Rng) -> Vec<u8> {
    (0..EEPROM_LEN).map(|_| rng.u8(..)).collect()
}

fn scan_len(bench: &Bench) -> u64 {
    let mut board = bench.start(&ERASED);
    board.scan();
    let start = board.avr().cycles();
    board.scan();
    board.avr().cycles() - start
}

impl Victim {
    fn new(text: &str, seed: u64) -> Victim {
        let bench = Bench::new(text);
        let retained = retained_addresses(bench.plan());
        let copies = (bench.plan().end()..).take(retained.len()).collect();
        let byte_max = BUSY_MAX + 2 * scan_len(&bench);
        let saving_max = byte_max * (retained.len() as u64 + 10);
        let mut rng = Rng::with_seed(seed);
        let (eeprom, saved, counts) = (garbage(&mut rng), Saved::default(), Counts::default());
        Victim { bench, retained, copies, byte_max, saving_max, eeprom, saved, counts, rng }
    }

    /// Switches the board on and off again.
    fn cut(&mut self, place: &str) {
        if self.rng.u8(..50) == 0 {
            (self.eeprom, self.saved) = (garbage(&mut self.rng), Saved::default());
        }
        let mut board = self.bench.switch_on(&self.eeprom);
        if self.rng.u8(..5) == 0 {
            board.start_for(self.rng.u64(..START_MAX));
            assert_eq!(board.avr().eeprom_writing(), None, "{place}");
            self.counts.in_start += 1;
        } else {
            board.scan_start();
            self.check(&mut board, place);
            self.run(&mut board);
        }
        self.counts.torn += u64::from(board.avr().eeprom_writing().is_some());
        self.eeprom = board.cut(&mut self.rng);
    }

    /// What has come back is of one scan, and of the right one. Ends after the first scan.
    fn check(&mut self, board: &mut Board, place: &str) {
        let bytes = board.bytes(&self.retained);
        let found = generation(&bytes).unwrap_or_else(|| panic!("{place}: a mixture {bytes:?}"));
        board.scan();
        let found = (!board.says_lost()).then_some(found);
        assert!(
            found.is_some() || bytes.iter().all(|&byte| byte == 0),
            "{place}: lost, but {bytes:?}"
        );
        assert!(self.saved.allows(found), "{place}: {found:?} after {:?}", self.saved);
        match found {
            Some(_) => self.counts.back += 1,
            None => self.counts.lost += 1,
        }
        self.saved = Saved { complete: found, next: None };
    }

    /// Runs about as long as what is to be saved takes, and to any cycle.
    fn run(&mut self, board: &mut Board) {
        // What others have left is erased before the first copy.
        let erasing_max = if self.saved.complete.is_none() {
            self.byte_max * u64::from(RETENTION_LEN)
        } else {
            0
        };
        let len = self.rng.u64(..(self.saving_max + erasing_max) * 5 / 4);
        let end = board.avr().cycles() + len;
        let mut jump = Some(board.avr().cycles() + self.rng.u64(..2 * self.saving_max));
        self.observe(board);
        while board.avr().cycles() + 2 * self.byte_max < end {
            board.scan();
            self.observe(board);
            if jump.is_some_and(|jump| board.avr().cycles() > jump) {
                board.pass(LONG_MS);
                jump = None;
            }
        }
        // In the last scans a snapshot may be half taken; what is written then is still the one
        // before.
        board.run_for(self.rng.u64(..2 * self.byte_max));
        self.observe(board);
    }

    fn observe(&mut self, board: &Board) {
        if let Some(snapshot) = generation(&board.bytes(&self.copies)) {
            self.saved.observe(snapshot, board.avr().cycles(), self.saving_max);
        }
    }
}

#[test]
fn a_cut_at_any_cycle_leaves_old_or_new_values() {
    let cuts = effort("POWER_CUTS", 300);
    let [small, mixed, large] = generation_programs();
    let mut sum = Counts::default();
    let shares = [(small, cuts * 3 / 10), (mixed, cuts * 6 / 10), (large, cuts / 10)];
    for (seed, (text, cuts)) in (effort("RANDOM_SEED", 1)..).zip(shares) {
        let mut victim = Victim::new(&text, seed);
        for cut in 0..cuts {
            victim.cut(&format!("seed {seed}, cut {cut}"));
        }
        println!("seed {seed}: {cuts} cuts, {:?}", victim.counts);
        sum += victim.counts;
    }
    let has_tested =
        sum.back > cuts / 3 && sum.lost > 3 && sum.in_start > cuts / 20 && sum.torn > cuts / 5;
    assert!(has_tested, "{sum:?}: hardly anything was tested");
}
