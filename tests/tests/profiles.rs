//! Boards as values: a program that the Uno is too small for, and a board that there is not.

use std::fmt::Write;

use awl_asm::assemble::{Assembly, assemble, assemble_for, assemble_with};
use awl_asm::diagnostic::Code;
use awl_asm::disassemble::disassemble;
use awl_asm::source::Source;
use plc_isa::{FORMAT_AT, HOST, ImageFault, Op, PICO, Profile, UNO, decode, verify};
use plc_vm::{Environment, Inputs, Memory, Plc};

/// An Uno with fewer pins.
static SMALL: Profile = Profile {
    name: "small",
    title: "the small board",
    input_pins: &["1", "2", "3", "4"],
    output_pins: &["5", "6", "7", "8"],
    slot_len: 1000,
    ..UNO
};

const LABELS: u16 = 1000;
/// Passes of the loop at the end, each of which moves a bit.
const PASSES: u16 = 100;

fn source(text: &str) -> Source {
    Source::new("large.awl".to_string(), text.to_string()).unwrap()
}

fn errors(assembly: &Assembly) -> Vec<&str> {
    assembly.diagnostics.iter().map(|diagnostic| diagnostic.code.text()).collect()
}

/// 1,000 labels that each jump passes, bits and words up to the last byte of V, constants from one
/// end of the image to the other, and a loop after all of it.
fn large_program() -> String {
    let mut text = String::from("//# memory VB0-VB10239\nLD SM0.1\nS V10239.6, 1\n");
    for number in 0..LABELS {
        let (byte, bit) = (8191 + number * 2, number % 8);
        write!(
            text,
            "LD V{byte}.{bit}\nJMP {label}\nLD SM0.0\nMOVD {value}, VD4\n= V{byte}.{bit}\n\
             LBL {label}\n",
            label = 60_000 + number,
            value = 1_000_000 + u32::from(number),
        )
        .unwrap();
    }
    write!(
        text,
        "LD SM0.0\nMOVD 123456789, VD10232\nMOVR 1.5, VD10228\n\
         FOR VW0, 1, {PASSES}\nLD SM0.0\nINCW VW2\nNEXT\nLD V10239.6\n= V10239.7\nEND\n"
    )
    .unwrap();
    text
}

/// The time stands still.
struct Still;

impl Environment for Still {
    fn now_ms(&mut self) -> u32 {
        0
    }
    fn is_overdue(&mut self, _bytes: u16) -> bool {
        false
    }
    fn retrigger_watchdog(&mut self) {}
}

#[test]
fn a_large_program_runs_on_the_host_and_comes_back_from_its_image() {
    let assembly = assemble(&source(&large_program()), Vec::new());
    assert_eq!(errors(&assembly), ["W0033"], "{:?}", assembly.diagnostics);
    let image = assembly.image.clone().unwrap();
    assert!(image.len() > 20_000, "{}", image.len());
    assert_eq!((image[usize::from(FORMAT_AT)], assembly.profile()), (0x17, &HOST));

    let program = verify(image.as_slice()).unwrap();
    assert_eq!(program.plan().header.labels, LABELS);
    assert_eq!(program.plan().profile(), &HOST);
    let last = program.plan().v_address(10239).unwrap();

    let (mut plc, mut memory) = (Plc::new(), Memory::new());
    plc.load(&mut memory, image.as_slice()).unwrap();
    assert!(plc.run());
    for _ in 0..2 {
        plc.scan(&mut memory, &Inputs::default(), &mut Still);
        assert_eq!(plc.fault(), None);
    }
    assert_eq!(memory.byte(last) >> 6, 0b11);
    let double = |byte: u16| {
        let at = program.plan().v_address(byte).unwrap();
        u32::from(memory.word(at)) << 16 | u32::from(memory.word(at + 2))
    };
    assert_eq!(memory.word(program.plan().v_address(2).unwrap()), 2 * PASSES);
    assert_eq!(double(10228), 1.5_f32.to_bits());
    // Each bit was 0 in the first scan and is 1 in the second, where nothing is written any more.
    assert_eq!(double(4), 1_000_000 + u32::from(LABELS) - 1);

    let text = disassemble(&image).unwrap();
    let again = assemble(&source(&text), Vec::new());
    assert_eq!(again.image.as_ref(), Some(&image), "{:?}", again.diagnostics);
}

#[test]
fn the_board_that_is_named_binds() {
    let text = large_program();
    let mut assembly = assemble(&source(&text), Vec::new());
    assembly.require_board();
    assert_eq!(assembly.image, None);
    assert!(errors(&assembly).contains(&Code::DataTooLarge.text()), "{:?}", errors(&assembly));
    let named = assemble(&source(&format!("//# board uno\n{text}")), Vec::new());
    assert_eq!((named.image, named.misfit.len()), (None, 0));
    let host = assemble(&source("//# board host\nLD I0.0\n= Q0.0\n"), Vec::new());
    assert_eq!(host.image.unwrap()[usize::from(FORMAT_AT)], HOST.format());
    let uno = assemble(&source("LD I0.0\n= Q0.0\n"), Vec::new());
    assert_eq!(uno.image.unwrap()[usize::from(FORMAT_AT)], UNO.format());
    let unknown = assemble(&source("//# board due\nLD I0.0\n= Q0.0\n"), Vec::new());
    assert_eq!(errors(&unknown), ["E0020"]);
}

#[test]
fn images_of_the_format_before_are_to_be_assembled_again() {
    let mut image = assemble(&source("LD I0.0\n= Q0.0\n"), Vec::new()).image.unwrap();
    for format in [6, 0x26, 0x18] {
        image[usize::from(FORMAT_AT)] = format;
        let fault = verify(image.as_slice()).unwrap_err().fault;
        assert_eq!(fault, ImageFault::Version, "{format:#x}");
        assert!(fault.message().contains("assemble it again"));
    }
}

#[test]
fn modules_are_in_images_of_boards_that_take_them() {
    let text = "LD SM0.0\nMOVR 2.0, VD0\nSQRT VD0, VD4\n";
    let uno = assemble(&source(text), Vec::new()).image.unwrap();
    let host = assemble(&source(&format!("//# board host\n{text}")), Vec::new()).image.unwrap();
    let (uno, host) = (verify(uno).unwrap(), verify(host).unwrap());
    assert!(uno.plan().header.modules_len > 1000 && host.plan().header.modules_len == 0);
    let ops = |at: u16, memory: &Vec<u8>| decode(memory, at).unwrap().op;
    assert_eq!(ops(uno.code_at(), uno.memory()), Op::Ld);
    assert_eq!(ops(host.code_at(), host.memory()), Op::Ld);
}

#[test]
fn another_board_is_another_value() {
    let codes = |text: &str, profile: &'static Profile| {
        let assembly = assemble_for(&source(text), Vec::new(), &[], profile);
        errors(&assembly).join(" ")
    };
    for (text, on_small) in [
        ("LDI I0.4\n= Q0.0\n", "W0033"),
        ("LD I0.0\n=I Q0.4\n", "W0033"),
        ("//# pullup I0.4\nLD I0.0\n= Q0.0\n", "E0020"),
        ("LD I0.4\n= Q0.0\n", "W0005"),
        ("LD I0.0\n= Q0.4\n", "W0005"),
    ] {
        assert_eq!((codes(text, &UNO).as_str(), codes(text, &SMALL).as_str()), ("", on_small));
    }
    let long = "LD I0.0\n= Q0.0\n".repeat(300);
    assert_eq!(
        (codes(&long, &UNO).contains("W0033"), codes(&long, &SMALL).contains("W0033")),
        (false, true)
    );
    let assembly = assemble_for(&source(&long), Vec::new(), &[], &SMALL);
    assert!(assembly.misfit[0].message.contains("the program slot has 1000"));
}

fn with_board(text: &str, board: &'static Profile) -> Assembly {
    assemble_with(&source(text), Vec::new(), &[], Some(board))
}

/// The help of the first message with this code, in one line.
fn help(assembly: &Assembly, code: &str) -> String {
    let told = assembly.diagnostics.iter().find(|told| told.code.text() == code);
    told.unwrap_or_else(|| panic!("no {code}: {:?}", assembly.diagnostics)).help.join("; ")
}

#[test]
fn a_board_can_be_asked_for_beside_the_text() {
    let text = "LD I0.7\n= Q0.7\n";
    let asked = with_board(text, &PICO);
    assert_eq!((errors(&asked), asked.profile()), (vec![], &PICO));
    let named = assemble(&source(&format!("//# board pico\n{text}")), Vec::new());
    assert_eq!(asked.image, named.image);
    assert_eq!(asked.image.unwrap()[usize::from(FORMAT_AT)], 0x27);
    // It binds as if the text named it.
    assert!(errors(&with_board(&large_program(), &UNO)).contains(&"E0019"));
    assert_eq!(errors(&with_board(&large_program(), &PICO)), [""; 0]);
    let other = with_board(&format!("//# board uno\n{text}"), &PICO);
    assert!(errors(&other).contains(&"E0020"), "{:?}", errors(&other));
    let message = &other.diagnostics.iter().find(|one| one.code.text() == "E0020").unwrap().message;
    assert_eq!(message, "the program is for the Uno, and is asked for the Pico");
}

#[test]
fn a_program_for_another_board_is_not_for_the_uno() {
    let mut assembly = with_board("LD I0.0\n= Q0.0\n", &PICO);
    assembly.require_board();
    assert_eq!((assembly.image.is_none(), errors(&assembly)), (true, vec!["E0020"]));
    let message = &assembly.diagnostics[0].message;
    assert_eq!(message, "the program is for the Pico, not for the Uno");
}

#[test]
fn what_a_board_lacks_is_said_with_the_board_that_would_do() {
    let to_pico = "the Pico would do: `//# board pico`";
    let to_uno = "the Uno would do: `//# board uno`";
    let event = "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\nLD SM0.1\nMOVB 5, SMB34\nATCH Tick, 10\nENI\n\
                 END_ORGANIZATION_BLOCK\nINTERRUPT_BLOCK Tick:INT0\nBEGIN\nLD I0.0\n= Q0.0\n\
                 END_INTERRUPT_BLOCK\n";
    for (text, board, code, way) in [
        ("//# memory VB0-VB5000\nLD SM0.0\nINCB VB0\n", &UNO, "E0019", to_pico),
        ("LDI I0.6\n= Q0.0\n", &UNO, "E0084", to_pico),
        ("//# pullup I0.6\nLD I0.6\n= Q0.0\n", &UNO, "E0020", to_pico),
        ("LD I0.6\n= Q0.0\n", &UNO, "W0005", to_pico),
        (event, &PICO, "E0084", to_uno),
        ("LD SM0.1\nPLS 1\n", &PICO, "E0084", to_uno),
        ("LD SM0.1\nHDEF 0, 0\nHSC 0\n", &PICO, "E0084", to_uno),
        ("LDD>= HC0, 5\n= Q0.0\n", &PICO, "E0084", to_uno),
        // Neither has it.
        ("LDI I1.0\n= Q0.0\n", &UNO, "E0084", ""),
    ] {
        let assembly = with_board(text, board);
        let help = help(&assembly, code);
        assert!(help.contains(way), "{text}: {help}");
        assert_eq!(help.contains("would do"), !way.is_empty(), "{text}");
    }
    // Where no board is named it is a warning, and says the same.
    let large = assemble(&source("//# memory VB0-VB5000\nLD SM0.0\nINCB VB0\n"), Vec::new());
    assert_eq!((errors(&large), help(&large, "W0033").contains(to_pico)), (vec!["W0033"], true));
}

#[test]
fn twenty_thousand_instructions_are_for_the_pico() {
    let text = "LD I0.0\n= Q0.0\n".repeat(10_000);
    assert!(help(&with_board(&text, &UNO), "E0018").contains("the Pico would do"));
    let image = with_board(&text, &PICO).image.unwrap();
    assert!(verify(image.as_slice()).is_ok() && image.len() > 40_000, "{}", image.len());
}
