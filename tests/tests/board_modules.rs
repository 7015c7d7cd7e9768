//! Images whose modules are not what they seem: a checksum that is right does not make them run.
//! And what is taken back from modules when RUN ends.
#![cfg(feature = "uno")]

use plc_isa::{
    DIRECTORY_AT, EVENTS_MODULE, HEADER_LEN, ImageFault, MODULES, OPERANDS_MODULE, REAL_MODULE,
    SLOT_START,
};
use plc_vm::Fault;
use tests::bench_board::{BenchBoard, MS};
use tests::image::{image, signed};
use tests::link;

/// In the header: the length of the image, the length of the modules.
const LENGTHS: [usize; 2] = [6, 32];
/// Registers: external interrupts, pin changes, the compare outputs of Timer1.
const EIMSK: usize = 0x3D;
const PCICR: usize = 0x68;
const TCCR1A: usize = 0x80;
/// The current value of HSC0: its last byte.
const COUNT: usize = 0x22B;

fn word(image: &[u8], at: usize) -> u16 {
    u16::from_le_bytes([image[at], image[at + 1]])
}

fn put(image: &mut [u8], at: usize, value: u16) {
    image[at..at + 2].copy_from_slice(&value.to_le_bytes());
}

fn directory_entry(module: u8) -> usize {
    usize::from(DIRECTORY_AT) + 2 * usize::from(module)
}

/// The board must refuse it as a bad module, and drive nothing.
fn is_refused(image: Vec<u8>) {
    let mut board = BenchBoard::new();
    board.insert(&signed(image));
    board.power_up();
    board.scans(20);
    let fault = board.fault();
    assert!(
        matches!(fault, Some(Fault::BadImage(error)) if error.fault == ImageFault::Module),
        "{fault:?}"
    );
    assert!(!board.runs() && board.is_released());
}

#[test]
fn a_jump_table_that_is_not_the_modules_own_is_refused() {
    let mut image = image("//# memory VB0-VB7\nLD SM0.0\n= Q0.0\n+D 5, VD0\n");
    let is_there =
        |&module: &u8| module != OPERANDS_MODULE && word(&image, directory_entry(module)) != 0;
    let module = (0..MODULES as u8).find(is_there).unwrap();
    let table = usize::from(word(&image, directory_entry(module))) * 2 - usize::from(SLOT_START);
    let routines = usize::from(image[table - 1]);
    let start = table - usize::from(word(&image, table - 4));
    // After the modules a copy of its head, a table and code that would write to the firmware's
    // memory.
    let at = usize::from(HEADER_LEN) + usize::from(word(&image, LENGTHS[1]));
    let mut block = image[table - 6 - routines..table].to_vec();
    if !(at + block.len()).is_multiple_of(2) {
        block.insert(0, 0);
    }
    let head_end = block.len();
    let forged = at + head_end;
    put(&mut block, head_end - 4, (forged - start) as u16);
    block.extend(vec![0; 2 * routines]);
    block.extend([0x85, 0xE5, 0x80, 0x93, 0x00, 0x07, 0x0C, 0x94, 0x3E, 0x00]);
    for at in LENGTHS {
        let len = word(&image, at) + block.len() as u16;
        put(&mut image, at, len);
    }
    image.splice(at..at, block);
    put(&mut image, directory_entry(module), ((forged + usize::from(SLOT_START)) / 2) as u16);
    is_refused(image);
}

#[test]
fn modules_that_others_call_must_be_there() {
    for (text, module) in [
        ("LD SM0.0\n= Q0.0\nINCD VD0\n", OPERANDS_MODULE),
        ("LD SM0.0\n= Q0.0\nSIN VD0, VD4\n", REAL_MODULE),
        ("LD SM0.0\n= Q0.0\nPID VB0, 0\n", REAL_MODULE),
    ] {
        let mut image = image(&format!("//# memory VB0-VB39\n{text}"));
        assert_ne!(word(&image, directory_entry(module)), 0, "{text}");
        put(&mut image, directory_entry(module), 0);
        is_refused(image);
    }
}

#[test]
fn a_directory_entry_that_wraps_is_none() {
    let text = "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\nLD SM0.1\nATCH I0, 0\nENI\n\
        END_ORGANIZATION_BLOCK\n\
                INTERRUPT_BLOCK I0:INT0\nBEGIN\nLD SM0.0\n= Q0.1\nEND_INTERRUPT_BLOCK\n";
    let mut image = image(text);
    put(&mut image, directory_entry(EVENTS_MODULE), 0x8000);
    is_refused(image);
}

#[test]
fn a_counter_does_not_go_on_in_stop() {
    // HSC0 with its reset input, which holds.
    let prepare = || {
        let text = "//# memory VB0-VB31\nLD SM0.1\nMOVB 16#C8, SMB37\nHDEF 0, 1\nHSC 0\n";
        let mut board = BenchBoard::new();
        board.insert(&image(text));
        board.drive_inputs(0);
        board.power_up();
        board.scans(5);
        board.drive_inputs(1 << 2);
        board.scans(5);
        board.say(&link::frame(link::UNIT, &link::Command::Stop.pdu()));
        board
    };
    let mut board = prepare();
    let cycles = board.run_until(1, 100 * MS, |board| board.avr.data()[PCICR] == 0);
    // The reset ends while RUN does.
    for earlier in 0..14 {
        let mut board = prepare();
        let end = board.avr.cycles() + cycles - earlier;
        while board.avr.cycles() < end {
            board.run_on(1);
        }
        board.drive_inputs(0);
        board.scans(20);
        let before = board.avr.data()[COUNT];
        for level in [0, 1, 0, 1, 0, 1, 0] {
            board.drive_inputs(level);
            board.scans(2);
        }
        assert!(!board.runs());
        assert_eq!(
            (board.avr.data()[EIMSK], board.avr.data()[COUNT]),
            (0, before),
            "{earlier} cycles before"
        );
    }
}

#[test]
fn a_block_reaches_both_analog_outputs() {
    for text in ["FILL 16000, AQW0, 2", "BMW VW0, AQW0, 2"] {
        let mut board = BenchBoard::running(&format!(
            "//# memory VB0-VB31\nLD SM0.0\nMOVW 8000, VW0\nMOVW 8000, VW2\n{text}\n"
        ));
        board.scans(4);
        assert_eq!(
            board.avr.data()[TCCR1A] & 0xF0,
            0xF0,
            "{text}: both pins are driven by the timer"
        );
    }
}
