//! The deepest stack of the firmware: every case and every example, and the longest program that
//! fits, on the board with its free SRAM painted; interpreted, and translated.
#![cfg(feature = "uno")]

use awl_asm::assemble::assemble;
use awl_asm::native::translate;
use awl_asm::source::Source;
use awl_sim::machine::uno::{Code, Uno};
use awl_sim::machine::{Machine, Mode};
use plc_isa::SLOT_LEN;
use tests::case::Case;
use tests::lockstep::board;

/// Bytes that no program may make the stack use: for interrupts that come at the worst moment, and
/// for what later versions need.
const SPARE_MIN: usize = 128;
/// Scans of each program.
const SCANS: u64 = 30;

/// Bytes that variables and stack never used while a program ran.
fn spare(uno: &mut Uno, image: Vec<u8>) -> usize {
    uno.load(image).unwrap_or_else(|error| panic!("{error}"));
    // A second of the board for endless loops, which the watchdog ends.
    uno.hold_clock_for(16_000_000);
    for scan in 0..SCANS {
        // Longer than any fixed period of the programs here.
        uno.scan(scan * 110);
    }
    assert_eq!(uno.broken(), None);
    uno.unused_stack()
}

/// All kinds of instructions until the slot is full of bytecode, or of machine code.
fn longest_program(code: Code) -> Vec<u8> {
    let network = |number: usize| {
        format!(
            "LD I0.0\nEU\nLD I0.1\nCTU C{0}, 9\nLDW>= MW0, 5\nLPS\nA I0.2\nTON T{1}, 30\nLPP\n\
                /I 3, VW{0}\n= Q0.0\n",
            number % 20,
            101 + number % 20,
        )
    };
    let image = |networks: usize| {
        let text: String = (0..networks).map(network).collect();
        let text = format!(
            "//# board uno\n//# retain VB0-VB19, C0-C9\nLD SM0.0\nFOR MW2, 1, 3\n{text}NEXT\n"
        );
        let image = assemble(&Source::new("longest", text).unwrap(), Vec::new()).image?;
        let in_board =
            if code == Code::Native { translate(&image).ok()?.image } else { image.clone() };
        Some((image, in_board.len()))
    };
    let (longest, len) = (1..256).map_while(image).last().expect("a few networks fit");
    assert!(len > usize::from(SLOT_LEN) * 9 / 10, "{len} bytes are not long");
    longest
}

fn assert_the_stack_stays_away(code: Code) {
    let mut uno = board(code);
    let mut least = (usize::MAX, String::new());
    let programs =
        Case::all().into_iter().chain(Case::examples()).map(|case| case.prepare().unwrap());
    // Not everything is translated.
    let runs = |image: &[u8]| code == Code::Bytecode || translate(image).is_ok();
    let programs =
        programs.map(|case| (case.case.file.clone(), case.image)).filter(|(_, image)| runs(image));
    for (name, image) in
        programs.chain([("the longest program".to_string(), longest_program(code))])
    {
        least = least.min((spare(&mut uno, image), name));
    }
    let (spare, name) = least;
    println!("stack, {code:?}: {spare} bytes to spare at the deepest, in {name}");
    assert!(spare >= SPARE_MIN, "only {spare} bytes to spare in {name}");
    assert_eq!(uno.mode(), Mode::Run, "the longest program runs");
}

#[test]
fn the_stack_stays_away_from_the_variables() {
    assert_the_stack_stays_away(Code::Bytecode);
}

#[test]
fn the_stack_of_machine_code_stays_away_from_the_variables() {
    assert_the_stack_stays_away(Code::Native);
}
