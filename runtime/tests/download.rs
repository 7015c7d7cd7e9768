//! Programs that come over the line while another one runs: the old one or the new one is in force,
//! wherever the power is cut.

mod desk;

use desk::{Desk, Flash, WRITE_LEN, ask, ask_second, image, on, scans, word};
use fastrand::Rng;
use plc_isa::ImageFault;
use plc_vm::Mode;
use runtime::Controller;

const FOLLOW: &str = "//# name follow\nLD I0.0\n= Q0.0\n";
const INVERT: &str = "//# name invert\nLDN I0.0\n= Q0.0\n";
const BLOCK: usize = 240;
/// So many cuts are in the record, the others anywhere.
const RECORDS: usize = 48;
const GOOD: [u8; 6] = [101, 3, 0, 0, 0, 0];

/// A program with a constant that nobody else has, of some sectors.
fn numbered(number: u16) -> Vec<u8> {
    let moves = "LD SM0.0\nMOVW 7, VW2\n".repeat(200);
    image(&format!("//# name n{number}\nLD SM0.0\nMOVW {number}, VW0\n{moves}"))
}

fn begin(plc: &mut Controller<Desk>, len: usize) -> Vec<u8> {
    let [high, low] = (len as u16).to_be_bytes();
    ask(plc, &[101, 1, high, low])
}

fn send(plc: &mut Controller<Desk>, offset: usize, bytes: &[u8]) -> Vec<u8> {
    let [high, low] = (offset as u16).to_be_bytes();
    ask(plc, &[&[101, 2, high, low, bytes.len() as u8], bytes].concat())
}

fn end(plc: &mut Controller<Desk>) -> Vec<u8> {
    ask(plc, &[101, 3])
}

fn received(count: usize) -> Vec<u8> {
    [&[101, 2][..], &(count as u16).to_be_bytes()].concat()
}

/// All of it; what the end is answered with, or what went wrong before it.
fn download(plc: &mut Controller<Desk>, image: &[u8]) -> Vec<u8> {
    if begin(plc, image.len()) != [101, 1, 0, 0] {
        return Vec::new();
    }
    let mut sent = 0;
    for block in image.chunks(BLOCK) {
        let answer = send(plc, sent, block);
        sent += block.len();
        if answer != received(sent) {
            return answer;
        }
    }
    end(plc)
}

fn name(plc: &mut Controller<Desk>) -> String {
    name_in(&ask(plc, &[43, 14, 4, 6]))
}

fn name_by_second(plc: &mut Controller<Desk>) -> String {
    name_in(&ask_second(plc, &[43, 14, 4, 6]))
}

fn name_in(answer: &[u8]) -> String {
    match answer {
        [0xAB, _] => String::new(),
        answer => String::from_utf8(answer[9..].to_vec()).unwrap(),
    }
}

/// What the output does when the input is 0 and 1.
fn behaviour(plc: &mut Controller<Desk>) -> [Option<u8>; 2] {
    [0, 1].map(|level| {
        plc.board().levels = level;
        scans(plc, 2, 1);
        plc.board().outputs
    })
}

/// The power is cut and comes again.
fn again(plc: &mut Controller<Desk>) -> Box<Controller<Desk>> {
    let mut desk = Desk::new(None);
    desk.flash = plc.board().flash.after_cut();
    desk.programs = plc.board().programs.after_cut();
    on(desk)
}

#[test]
fn the_old_program_runs_until_the_new_one_is_complete() {
    let mut plc = desk::with(FOLLOW);
    assert_eq!(ask(&mut plc, &[65])[2] & 8, 8, "programs come over this line");
    let new = image(INVERT);
    assert_eq!(begin(&mut plc, new.len()), [101, 1, 0, 0]);
    for (index, byte) in new.iter().enumerate() {
        assert_eq!(behaviour(&mut plc), [Some(0), Some(1)]);
        assert_eq!(send(&mut plc, index, &[*byte]), received(index + 1));
    }
    assert_eq!(name(&mut plc), "follow");
    assert_eq!(end(&mut plc), GOOD);
    assert_eq!((behaviour(&mut plc), &*name(&mut plc)), ([Some(1), Some(0)], "invert"));
    // It is that of the next power-up; and the other slot is the next one that is written.
    let mut plc = again(&mut plc);
    assert_eq!(behaviour(&mut plc), [Some(1), Some(0)]);
    for number in 1..=5 {
        assert_eq!(download(&mut plc, &numbered(number)), GOOD);
        assert_eq!((word(&plc, 0), plc.plc().mode()), (number, Mode::Run));
        plc = again(&mut plc);
        scans(&mut plc, 1, 1);
        assert_eq!(word(&plc, 0), number);
    }
}

#[test]
fn in_stop_it_is_loaded_and_does_not_run() {
    let mut plc = on(Desk::new(None));
    assert_eq!((download(&mut plc, &image(FOLLOW)), plc.plc().mode()), (GOOD.into(), Mode::Stop));
    assert_eq!((behaviour(&mut plc), &*name(&mut plc)), ([None; 2], "follow"));
    assert_eq!(ask(&mut plc, &[66, 1, 0, 0]), [66, 1, 0, 0]);
    assert_eq!(behaviour(&mut plc), [Some(0), Some(1)]);
    // Forces and faults were the other program's.
    assert_eq!(ask(&mut plc, &[68, 1, 0x10, 0, 0, 0, 0, 0, 1])[1], 1);
    assert_eq!(download(&mut plc, &image(INVERT)), GOOD);
    assert_eq!((behaviour(&mut plc), ask(&mut plc, &[68, 0])), ([Some(1), Some(0)], vec![68, 0]));
}

/// The computer at one line is slow to take the last answer, and the one at the other commands.
#[test]
fn whatever_the_other_line_asks_the_new_program_is_loaded() {
    for (command, mode) in [(0, Mode::Stop), (1, Mode::Run)] {
        let mut plc = desk::with(FOLLOW);
        let new = image(INVERT);
        begin(&mut plc, new.len());
        send(&mut plc, 0, &new);
        plc.board().wire.takes = 2;
        plc.board().wire.incoming.extend(desk::frame(1, &[101, 3]));
        scans(&mut plc, 10, 1);
        assert_eq!(plc.board().wire.outgoing.len(), 2, "the answer is on its way");
        assert_eq!(ask_second(&mut plc, &[66, command, 0, 0]), [66, command, 0, 0]);
        plc.board().wire.takes = usize::MAX;
        scans(&mut plc, 3, 1);
        assert_eq!((&*name_by_second(&mut plc), plc.plc().mode()), ("invert", mode));
    }
}

#[test]
fn what_is_out_of_order_is_refused() {
    let mut plc = desk::with(FOLLOW);
    let new = image(INVERT);
    let refused = |exception: u8| vec![101 | 0x80, exception];
    assert_eq!(send(&mut plc, 0, &new[..4]), refused(4));
    assert_eq!(end(&mut plc), refused(4));
    for len in [0, usize::from(desk::DESK.slot_len) + 1] {
        assert_eq!(begin(&mut plc, len), refused(3));
    }
    assert_eq!(ask(&mut plc, &[101, 1, 0]), refused(3));
    assert_eq!(ask(&mut plc, &[101, 9]), refused(3));
    assert_eq!(begin(&mut plc, new.len()), [101, 1, 0, 0]);
    assert_eq!(send(&mut plc, 1, &new[1..4]), refused(2), "a gap");
    assert_eq!(ask(&mut plc, &[101, 2, 0, 0, 2, 1]), refused(3), "a block of another length");
    assert_eq!(send(&mut plc, 0, &[]), refused(3));
    assert_eq!(send(&mut plc, 0, &new[..10]), received(10));
    assert_eq!(send(&mut plc, 0, &new[..10]), received(10), "its answer was lost");
    assert_eq!(send(&mut plc, 2, &new[2..9]), refused(2), "neither the next one nor the last");
    assert_eq!(send(&mut plc, 10, &[0; BLOCK]), refused(2), "more than was announced");
    // What was missing does not come after the end.
    assert_eq!(end(&mut plc), refused(4));
    assert_eq!(send(&mut plc, 10, &new[10..]), refused(4));
    assert_eq!((behaviour(&mut plc), &*name(&mut plc)), ([Some(0), Some(1)], "follow"));
}

#[test]
fn a_program_that_would_not_load_is_told_why_and_changes_nothing() {
    let mut plc = desk::with(FOLLOW);
    let (mut spoiled, mut version) = (image(INVERT), image(INVERT));
    let last = spoiled.len() - 1;
    spoiled[last] ^= 0x10;
    version[4] = 0xF7;
    let blank = vec![0xFF; 300];
    for (bad, reason) in
        [(&spoiled, ImageFault::Crc), (&version, ImageFault::Version), (&blank, ImageFault::Magic)]
    {
        let answer = download(&mut plc, bad);
        assert_eq!(answer[..4], [101, 3, 1, reason as u8], "a bad image, and why: {answer:?}");
        assert_eq!((behaviour(&mut plc), &*name(&mut plc)), ([Some(0), Some(1)], "follow"));
        plc = again(&mut plc);
        assert_eq!(behaviour(&mut plc), [Some(0), Some(1)]);
    }
    assert_eq!(download(&mut plc, &image(INVERT)), GOOD);
}

#[test]
fn retained_values_stay_where_they_belong_to_both() {
    let counting = |name: &str| {
        image(&format!("//# name {name}\n//# retain VW0\nLD SM0.2\n= M0.0\nLD I0.0\nINCW VW0\n"))
    };
    let mut plc = on(Desk::new(Some(counting("old"))));
    plc.board().levels = 1;
    scans(&mut plc, 40, 1);
    plc.board().levels = 0;
    let counted = word(&plc, 0);
    assert_eq!(download(&mut plc, &counting("new")), GOOD);
    assert_eq!((word(&plc, 0), &*name(&mut plc)), (counted, "new"));
}

#[test]
fn wherever_the_power_is_cut_a_whole_program_is_in_force() {
    let (old, new, other) = (numbered(1), numbered(2), numbered(3));
    let programs = |cuts: u32| {
        // Some boards have had programs over the line before.
        let mut plc = on(Desk::new(Some(if cuts == 0 { old.clone() } else { other.clone() })));
        for _ in 1..cuts {
            assert_eq!(download(&mut plc, &other), GOOD);
        }
        if cuts > 0 {
            assert_eq!(download(&mut plc, &old), GOOD);
        }
        plc.board().programs.after_cut()
    };
    let boards: Vec<Flash> = (0..3).map(programs).collect();
    let whole = |flash: &Flash, power: usize| {
        let mut desk = Desk::new(None);
        desk.programs = Flash { power, ..flash.clone() };
        let mut plc = on(desk);
        let answer = download(&mut plc, &new);
        (plc, answer)
    };
    let (mut spare, _) = whole(&boards[0], usize::MAX / 2);
    let work = usize::MAX / 2 - spare.board().programs.power;
    let (mut rng, mut found) = (Rng::with_seed(1), [0_u32; 2]);
    for cut in 0..2_000 {
        // The last that is written is the record: its bytes, and blank ones.
        let power = if cut < RECORDS { work - 1 - cut % WRITE_LEN } else { rng.usize(..work) };
        let (mut plc, answer) = whole(&boards[cut % 3], power);
        assert_ne!(answer, GOOD, "the power was cut");
        // Again and again while it is loaded: nothing is written then.
        for _ in 0..2 {
            plc = again(&mut plc);
            scans(&mut plc, 1, 1);
        }
        let number = word(&plc, 0);
        assert!((1..=2).contains(&number) && plc.plc().mode() == Mode::Run, "cut {cut}: {number}");
        found[usize::from(number) - 1] += 1;
        if cut % 20 == 0 {
            assert_eq!(download(&mut plc, &numbered(4)), GOOD);
            assert_eq!(word(&plc, 0), 4);
        }
    }
    println!("old and new program after a cut: {found:?}");
    assert!(found.into_iter().all(|count| count >= 10));
}
