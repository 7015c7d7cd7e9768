//! Retained values on a board whose power is cut: after every byte of flash that is erased or
//! written, the values of the last complete record come back, never a mixture.

mod desk;

use desk::{Desk, Flash, SECTORS, image, on, scans, word};
use fastrand::Rng;
use plc_isa::Area;
use plc_vm::Mode;
use runtime::Controller;

/// Counts in eight words that are retained; M0.0 tells that values were lost.
const COUNTING: &str = "//# retain VB0-VB15\nLD SM0.2\n= M0.0\nLD I0.0\n\
    INCW VW0\nINCW VW2\nINCW VW4\nINCW VW6\nINCW VW8\nINCW VW10\nINCW VW12\nINCW VW14\n";
/// As many as there can be: a record is a sector.
const LARGE: &str = "//# retain VB0-VB489\nLD SM0.2\n= M0.0\nLD I0.0\n\
    INCW VW0\nINCW VW100\nINCW VW200\nINCW VW300\nINCW VW400\nINCW VW488\n";
/// Other values.
const OTHER: &str = "//# retain VB0-VB9\nLD SM0.2\n= M0.0\nLD SM0.0\nINCW VW0\n";
/// Longer than between two records of any length.
const INTERVAL_US: u32 = 800_000_000;

struct Plc(Box<Controller<Desk>>);

impl Plc {
    /// Power comes to a board with this in its flash.
    fn on(text: &str, flash: Flash) -> Plc {
        let mut desk = Desk::new(Some(image(text)));
        desk.flash = flash;
        Plc(on(desk))
    }

    fn scan(&mut self, input: bool) {
        self.0.board().levels = input.into();
        scans(&mut self.0, 1, 1);
    }

    /// So many scans without a change: what has to be saved is.
    fn rest(&mut self, scans: u32) {
        (0..scans).for_each(|_| self.scan(false));
    }

    fn later(&mut self) {
        self.0.board().now_us = self.0.board().now_us.wrapping_add(INTERVAL_US);
    }

    fn words_at(&self, places: &[u16]) -> Vec<u16> {
        places.iter().map(|byte| word(&self.0, *byte)).collect()
    }

    fn words(&self) -> Vec<u16> {
        self.words_at(&[0, 2, 4, 6, 8, 10, 12, 14])
    }

    fn was_lost(&self) -> bool {
        let plan = self.0.plc().program().unwrap().plan();
        self.0.memory().byte(plan.byte_address(Area::M, 0).unwrap()) & 1 != 0
    }

    /// The power is gone: what is left.
    fn off(mut self) -> Flash {
        let flash = self.0.board().flash.clone();
        Flash { power: usize::MAX, erased: Vec::new(), ..flash }
    }
}

#[test]
fn values_come_back_and_what_belongs_to_others_does_not() {
    let mut plc = Plc::on(COUNTING, Flash::new());
    plc.scan(true);
    assert!(plc.was_lost());
    plc.rest(20);
    let mut plc = Plc::on(COUNTING, plc.off());
    plc.scan(true);
    assert_eq!((plc.words(), plc.was_lost()), (vec![2; 8], false));
    // The first change is saved at once, the next one after a time.
    plc.rest(20);
    plc.scan(true);
    plc.rest(20);
    let mut soon = Plc::on(COUNTING, plc.off());
    soon.scan(false);
    assert_eq!(soon.words(), [2; 8]);
    soon.scan(true);
    soon.rest(20);
    soon.scan(true);
    soon.later();
    soon.rest(20);
    let mut later = Plc::on(COUNTING, soon.off());
    later.scan(false);
    assert_eq!(later.words(), [4; 8]);
    let mut other = Plc::on(OTHER, later.off());
    other.scan(false);
    assert!(other.was_lost());
    other.rest(20);
    let mut again = Plc::on(COUNTING, other.off());
    again.scan(false);
    assert_eq!((again.words(), again.was_lost()), (vec![4; 8], false), "they are there still");
}

#[test]
fn in_stop_a_change_is_saved_at_once() {
    let text = COUNTING.to_owned() + "LD I0.1\nSTOP\n";
    let mut plc = Plc::on(&text, Flash::new());
    plc.scan(true);
    plc.rest(20);
    plc.scan(true);
    plc.rest(20);
    plc.0.board().levels = 3;
    scans(&mut plc.0, 1, 1);
    assert_eq!(plc.0.plc().mode(), Mode::Stop);
    plc.rest(20);
    let mut again = Plc::on(&text, plc.off());
    again.scan(false);
    assert_eq!(again.words(), [3; 8]);
}

#[test]
fn in_stop_what_could_not_be_saved_is_tried_again() {
    let text = COUNTING.to_owned() + "LD I0.1\nSTOP\n";
    let mut plc = Plc::on(&text, Flash::new());
    plc.scan(true);
    plc.rest(20);
    plc.0.board().levels = 3;
    plc.0.board().flash.power = 5;
    scans(&mut plc.0, 1, 1);
    assert_eq!(plc.0.plc().mode(), Mode::Stop);
    plc.rest(20);
    plc.0.board().flash.power = usize::MAX;
    plc.rest(1100);
    let mut again = Plc::on(&text, plc.off());
    again.scan(false);
    assert_eq!((again.words(), again.was_lost()), (vec![2; 8], false));
}

#[test]
fn sectors_wear_alike() {
    let mut flash = Flash::new();
    let mut erased = [0; SECTORS];
    for round in 0..500 {
        let mut plc = Plc::on(COUNTING, flash);
        plc.scan(true);
        plc.rest(20);
        assert_eq!(plc.words(), [round + 1; 8]);
        for sector in plc.0.board().flash.erased.drain(..) {
            erased[sector as usize] += 1;
        }
        flash = plc.off();
    }
    let (least, most) = (erased.iter().min().unwrap(), erased.iter().max().unwrap());
    assert!(*least > 5 && most - least <= 1, "{erased:?}");
}

/// Starts again and again, with so much power for the flash each time, and counts on in each.
fn assert_no_cut_loses_a_complete_record(text: &str, places: &[u16], power: usize) {
    let mut rng = Rng::with_seed(1);
    let (mut flash, mut saved, mut cuts) = (Flash::new(), 0, 0);
    for _ in 0..3_000 {
        let mut plc = Plc::on(text, flash);
        plc.0.board().flash.power = rng.usize(0..power);
        plc.scan(false);
        let words = plc.words_at(places);
        assert!(words.iter().all(|word| *word == words[0]), "a mixture: {words:?}");
        assert_eq!(words[0], saved, "values of the last complete record");
        assert!(!plc.was_lost() || saved == 0);
        plc.scan(true);
        plc.rest(50);
        plc.later();
        plc.rest(50);
        let is_cut = plc.0.board().flash.power == 0;
        cuts += u32::from(is_cut);
        flash = plc.off();
        let mut check = Plc::on(text, flash.clone());
        check.scan(false);
        let found = check.words_at(places)[0];
        // A record that lacks nothing but what fills it up is complete.
        assert!(found == saved || found == saved + 1, "{found} after {saved}");
        assert!(is_cut || found == saved + 1, "what was written is there");
        saved = found;
    }
    println!("{cuts} cuts, {saved} saved");
    assert!(cuts > 300 && saved > 300);
}

#[test]
fn power_cuts_at_any_byte_leave_the_last_complete_record() {
    let places: Vec<u16> = (0..8).map(|word| 2 * word).collect();
    assert_no_cut_loses_a_complete_record(COUNTING, &places, 700);
}

#[test]
fn records_that_cuts_have_torn_never_cost_the_complete_one() {
    assert_no_cut_loses_a_complete_record(LARGE, &[0, 100, 200, 300, 400, 488], 1_600);
}

#[test]
fn a_sector_that_fails_is_left_out() {
    let mut plc = Plc::on(COUNTING, Flash::new());
    plc.0.board().flash.power = 0;
    plc.scan(true);
    plc.rest(20);
    plc.0.board().flash.power = usize::MAX;
    plc.later();
    plc.rest(20);
    let mut again = Plc::on(COUNTING, plc.off());
    again.scan(false);
    assert_eq!((again.words(), again.was_lost()), (vec![1; 8], false));
}
