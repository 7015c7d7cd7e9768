//! The loader's check: for every fault an image that has it, right in all else, and the fault is
//! named.

use plc_isa::{DATA_END, HEADER_LEN, Header, ImageFault, LINE_ROOM, Op, verify};
use tests::image::sign;

/// A program that has something in every table.
const PROGRAM: &str = "\
//# name \"tables\"
//# retain VB0-VB1, C3
NETWORK 1
LD     I0.0
LDN    V20.1
ALD
=      Q0.0
NETWORK 2
LD     SM0.0
TON    T37, 10
TON    T40, VW0
MOVW   VW0, VW30
S      M3.0, 9
NETWORK 3
LD     I0.1
EU
LD     I0.2
CTU    C3, 5
LD     I0.3
LD     I0.4
CTU    C7, 5
NETWORK 4
LD     I0.5
JMP    1
LD     SM0.0
FOR    MW10, 1, 3
INCW   MW12
NEXT
LBL    1
LD     M0.0
JMP    2
LBL    2
LD     M0.0
=      Q0.1
";

fn image() -> (Vec<u8>, Header) {
    let image = tests::image::image(PROGRAM);
    let header = Header::read(&image).unwrap();
    (image, header)
}

/// What the check says about an image with these bytes at this offset.
fn fault_with(at: u16, bytes: &[u8]) -> Option<ImageFault> {
    fault_in(image().0, at, bytes)
}

fn fault_in(mut image: Vec<u8>, at: u16, bytes: &[u8]) -> Option<ImageFault> {
    let at = usize::from(at);
    image[at..at + bytes.len()].copy_from_slice(bytes);
    sign(&mut image);
    verify(image).err().map(|error| error.fault)
}

/// Offset of the first of these bytes in the code.
fn code_offset(bytes: &[u8]) -> u16 {
    let (image, header) = image();
    let code = &image[usize::from(header.code_at())..usize::from(header.code_end())];
    let at = code
        .windows(bytes.len())
        .position(|window| window == bytes)
        .expect("the code has these bytes");
    header.code_at() + at as u16
}

#[test]
fn the_image_itself_is_sound() {
    let (image, header) = image();
    assert!(verify(image).is_ok());
    assert_eq!((header.v_ranges, header.timers, header.counters, header.labels), (3, 2, 2, 2));
    assert_eq!((header.edges, header.retained), (1, 2));
}

#[test]
fn faults_of_the_header() {
    assert_eq!(fault_with(0, b"X"), Some(ImageFault::Magic));
    assert_eq!(fault_with(4, &[2]), Some(ImageFault::Version), "before modules with a state");
    assert_eq!(
        fault_with(4, &[3]),
        Some(ImageFault::Version),
        "before settings of the serial line"
    );
    assert_eq!(fault_with(4, &[4]), Some(ImageFault::Version), "with lengths of V ranges");
    assert_eq!(fault_with(4, &[5]), Some(ImageFault::Version), "without looks for status windows");
    assert_eq!(fault_with(4, &[6]), Some(ImageFault::Version), "without a profile");
    assert_eq!(fault_with(4, &[8]), Some(ImageFault::Version));
    assert_eq!(fault_with(4, &[0xF7]), Some(ImageFault::Version), "for a board that there is not");
    assert_eq!(fault_with(5, &[1]), Some(ImageFault::Interface), "machine code, on the host");
    assert_eq!(fault_with(29, &[7]), Some(ImageFault::Settings));
    assert_eq!(
        fault_with(8, &[0xFF, 0xFF]),
        Some(ImageFault::Length),
        "code longer than the image"
    );
    assert_eq!(fault_with(18, &[0xFF, 0xFF]), Some(ImageFault::Length), "more timers than bytes");
    assert_eq!(fault_with(10, &[1]), Some(ImageFault::Plan), "another arena than the tables need");
    assert_eq!(fault_with(12, &[0x01, 0x01]), Some(ImageFault::Plan), "257 edges");
    assert_eq!(fault_with(22, &[0, 0]), Some(ImageFault::Settings), "no watchdog");
    assert_eq!(fault_with(26, &[0x40]), Some(ImageFault::Settings), "pull-up of I0.6");
    for (address, line, fault) in [
        (1, 0, None),
        (247, 0x27, None),
        (5, 0x13, None),
        (0, 0, Some(ImageFault::Settings)),
        (248, 0, Some(ImageFault::Settings)),
        (1, 0x08, Some(ImageFault::Settings)),
        (1, 0x30, Some(ImageFault::Settings)),
        (1, 0x80, Some(ImageFault::Settings)),
    ] {
        assert_eq!(fault_with(30, &[address, line]), fault, "address {address}, line {line:02X}");
    }
    assert_eq!(fault_with(HEADER_LEN, &[7]), Some(ImageFault::Name));

    let (image, _) = image();
    let fault = |image: &[u8]| verify(image).map(|_| ()).map_err(|error| error.fault);
    assert_eq!(fault(&image[..20]), Err(ImageFault::Length));
    assert_eq!(fault(&image[..image.len() - 1]), Err(ImageFault::Length));
    assert_eq!(fault(&[]), Err(ImageFault::Length));
    let mut flipped = image.clone();
    flipped[42] ^= 1;
    assert_eq!(fault(&flipped), Err(ImageFault::Crc));
}

#[test]
fn faults_of_the_tables() {
    let (_, header) = image();
    assert_eq!(
        fault_with(header.v_ranges_at() + 4, &[1, 0]),
        Some(ImageFault::VRanges),
        "overlaps the first"
    );
    assert_eq!(
        fault_with(header.v_ranges_at() + 8, &[0xFF, 0x27, 5, 0]),
        Some(ImageFault::VRanges),
        "VB10240"
    );
    assert_eq!(
        fault_with(header.v_ranges_at() + 6, &[2]),
        Some(ImageFault::VRanges),
        "ends where the first does"
    );
    assert_eq!(
        fault_with(header.v_ranges_at() + 6, &[1]),
        Some(ImageFault::VRanges),
        "ends before the first"
    );
    assert_eq!(
        fault_with(header.v_ranges_at() + 6, &[4]),
        Some(ImageFault::Operand),
        "VB20, VB21 and then only VB30"
    );
    assert_eq!(fault_with(header.timers_at() + 2, &[37]), Some(ImageFault::Timers), "T37 twice");
    assert_eq!(fault_with(header.timers_at() + 1, &[2]), Some(ImageFault::Timers), "T37 by TONR");
    assert_eq!(
        fault_with(header.timers_at() + 1, &[9]),
        Some(ImageFault::Timers),
        "an unknown kind"
    );
    assert_eq!(fault_with(header.counters_at(), &[7, 3]), Some(ImageFault::Counters), "descending");
    assert_eq!(
        fault_with(header.retained_at(), &[4]),
        Some(ImageFault::Retained),
        "an unknown area"
    );
    assert_eq!(
        fault_with(header.retained_at() + 1, &[100]),
        Some(ImageFault::Retained),
        "VB100 is not planned"
    );
    assert_eq!(
        fault_with(header.retained_at() + 5, &[2, 37, 0]),
        Some(ImageFault::Retained),
        "T37 is no TONR"
    );
    let first_label = header.labels_at();
    assert_eq!(fault_with(first_label, &(header.code_at()).to_le_bytes()), Some(ImageFault::Label));
}

#[test]
fn faults_of_the_code() {
    let (_, header) = image();
    let start = header.code_at();
    assert_eq!(fault_with(start, &[0xFF]), Some(ImageFault::UndefinedToken));
    assert_eq!(
        fault_with(start, &[0xFE, 0xFF]),
        Some(ImageFault::UndefinedToken),
        "after the prefix"
    );
    assert_eq!(fault_with(header.code_end() - 1, &[0x66]), Some(ImageFault::Truncated), "no end");
    assert_eq!(fault_with(start, &[0x77]), Some(ImageFault::Truncated), "code after the end");
    assert_eq!(fault_with(start, &[0x10]), Some(ImageFault::StackUnderflow), "A without a value");
    assert_eq!(
        fault_with(code_offset(&[0x30, 0x10]), &[0x30, 0x00]),
        None,
        "= I0.0: the process image can be written"
    );
    assert_eq!(
        fault_with(code_offset(&[0x30, 0x10]), &[0x30, 0x40]),
        Some(ImageFault::ReadOnly),
        "= SM0.0"
    );
}

/// MOVW between words that the plan does not have, and across the end of an area.
#[test]
fn faults_of_addresses() {
    let moved = code_offset(&[0x7A]);
    assert_eq!(fault_with(moved + 1, &[0x00, 0x05]), Some(ImageFault::Operand), "after the plan");
    assert_eq!(
        fault_with(moved + 3, &[0x3F, 0x01]),
        Some(ImageFault::Operand),
        "MW31 ends in SMB0"
    );
    assert_eq!(fault_with(moved + 3, &[0x00, 0x02]), Some(ImageFault::ReadOnly), "AIW0");
    assert_eq!(
        fault_with(moved + 3, &[0x18, 0x02]),
        Some(ImageFault::Operand),
        "the upper half of AC0"
    );
    assert_eq!(fault_with(moved + 3, &[0x34, 0x02]), Some(ImageFault::Operand), "ENO");
    assert_eq!(fault_with(moved + 3, &[0x3E, 0x02]), Some(ImageFault::Operand), "reserved memory");
    // S M3.0, 9 as far as M32.0.
    let set = code_offset(&[0x4F]);
    assert_eq!(fault_with(set + 3, &[255]), Some(ImageFault::Operand), "bits after M31.7");
    assert_eq!(fault_with(set + 3, &[0]), Some(ImageFault::Operand), "a count of 0");
}

#[test]
fn faults_of_numbers() {
    assert_eq!(
        fault_with(code_offset(&[0x91]) + 1, &[2]),
        Some(ImageFault::Operand),
        "a timer slot too many"
    );
    assert_eq!(
        fault_with(code_offset(&[0x91]), &[0x93]),
        Some(ImageFault::Operand),
        "TOF on a slot of TON"
    );
    assert_eq!(
        fault_with(code_offset(&[0x99]) + 1, &[2]),
        Some(ImageFault::Operand),
        "a counter slot too many"
    );
    assert_eq!(
        fault_with(code_offset(&[0x61]) + 1, &[1]),
        Some(ImageFault::Operand),
        "an edge too many"
    );
    assert_eq!(
        fault_with(code_offset(&[0x70, 0x00]) + 1, &[2]),
        Some(ImageFault::Operand),
        "a label too many"
    );
    assert_eq!(
        fault_with(code_offset(&[0x71, 0x01]), &[0x63]),
        Some(ImageFault::Label),
        "NOP where a label is listed"
    );
}

#[test]
fn faults_of_loops() {
    let (_, header) = image();
    let start = header.code_at();
    let for_at = code_offset(&[0x72]);
    assert_eq!(
        fault_with(for_at + 3, &[2]),
        Some(ImageFault::Malformed),
        "an unknown mode of INIT"
    );
    assert_eq!(
        fault_with(for_at + 9, &start.to_le_bytes()),
        Some(ImageFault::Loop),
        "FOR leads elsewhere"
    );
    let next_at = code_offset(&[0x73]);
    assert_eq!(
        fault_with(next_at + 1, &start.to_le_bytes()),
        Some(ImageFault::Loop),
        "NEXT of no FOR"
    );
    assert_eq!(fault_with(next_at, &[0x63, 0, 0x60]), Some(ImageFault::Loop), "FOR without NEXT");
}

/// A program with units, events, initial values, and an instruction of a module.
const UNITS: &str = "\
DATA_BLOCK
VB0 1, 2
END_DATA_BLOCK
ORGANIZATION_BLOCK MAIN:OB1
BEGIN
NETWORK 1
LD     SM0.1
ATCH   INT0, 10
ATCH   INT0, 11
NETWORK 2
LD     I0.0
CALL   SBR0
CALL   SBR1, VW0
MOVD   70000, VD4
END_ORGANIZATION_BLOCK
SUBROUTINE_BLOCK A:SBR0
BEGIN
NETWORK 1
LD     I0.1
CRET
END_SUBROUTINE_BLOCK
SUBROUTINE_BLOCK B:SBR1
VAR_INPUT
n:INT;
END_VAR
BEGIN
NETWORK 1
LD     I0.2
INCW   #n
END_SUBROUTINE_BLOCK
INTERRUPT_BLOCK C:INT0
BEGIN
NETWORK 1
LD     I0.3
CRETI
END_INTERRUPT_BLOCK
";

/// What the check says about the units with these bytes at this offset.
fn fault_of_units(at: u16, bytes: &[u8]) -> Option<ImageFault> {
    fault_in(tests::image::image(UNITS), at, bytes)
}

/// Offset of the token of an instruction: the `number`th of its kind.
fn token_of(op: Op, number: usize) -> u16 {
    let places = tests::forms::places(&tests::image::image(UNITS));
    let found = places.iter().filter(|place| place.row.instruction.op == op).nth(number);
    found.expect("the program has it").token_at as u16
}

#[test]
fn faults_of_units() {
    let units = tests::image::image(UNITS);
    let header = Header::read(&units).unwrap();
    assert!(verify(units).is_ok());
    assert_eq!(
        fault_of_units(header.routines_at(), &[0, 1]),
        Some(ImageFault::Routine),
        "begins elsewhere"
    );
    assert_eq!(
        fault_of_units(header.events_at(), &[11, 10]),
        Some(ImageFault::Event),
        "descending"
    );
    assert_eq!(fault_of_units(header.events_at(), &[10, 10]), Some(ImageFault::Event), "twice");
    assert_eq!(
        fault_of_units(header.initial_at(), &[0, 5]),
        Some(ImageFault::Initial),
        "VB1280 is not planned"
    );
    assert_eq!(
        fault_of_units(header.initial_at() + 2, &[0]),
        Some(ImageFault::Initial),
        "no values"
    );
    assert_eq!(
        fault_of_units(header.initial_at() + 2, &[9]),
        Some(ImageFault::Initial),
        "values after the table"
    );
    assert_eq!(
        fault_of_units(token_of(Op::Call, 0) + 1, &[3]),
        Some(ImageFault::Operand),
        "no such routine"
    );
    assert_eq!(
        fault_of_units(token_of(Op::Atch, 0) + 2, &[2]),
        Some(ImageFault::Operand),
        "no such event"
    );
    assert_eq!(
        fault_of_units(token_of(Op::MainEnd, 0), &[0x5F]),
        Some(ImageFault::Routine),
        "the main program returns"
    );
    assert_eq!(
        fault_of_units(token_of(Op::Ret, 0), &[0x77]),
        Some(ImageFault::Routine),
        "two main programs"
    );
    assert_eq!(
        fault_of_units(token_of(Op::Cret, 0), &[0x74]),
        Some(ImageFault::Routine),
        "END in a subroutine"
    );
    let begin = token_of(Op::CallBegin, 0);
    assert_eq!(
        fault_of_units(begin + 1, &begin.to_le_bytes()),
        Some(ImageFault::Routine),
        "a call that ends before it"
    );
    assert_eq!(
        fault_of_units(begin + 1, &(begin + 4).to_le_bytes()),
        Some(ImageFault::Routine),
        "ends in an instruction"
    );
}

#[test]
fn faults_of_references() {
    let units = tests::image::image(UNITS);
    let header = Header::read(&units).unwrap();
    let moved = token_of(Op::Movd, 0);
    let (input, out) = (moved + 1, moved + 3);
    let with = |at: u16, reference: u16| fault_of_units(at, &reference.to_le_bytes());
    assert_eq!(
        fault_of_units(moved, &[0x7F]),
        Some(ImageFault::UndefinedToken),
        "no such routine of the module"
    );
    assert_eq!(with(input, 0x0050), Some(ImageFault::Malformed), "below data memory");
    assert_eq!(with(input, 0x0600), Some(ImageFault::Malformed), "after data memory");
    assert_eq!(with(input, 0x013E), Some(ImageFault::Operand), "MD30 ends in SMB1");
    assert_eq!(with(input, 0x8218), Some(ImageFault::Operand), "*AC0");
    assert_eq!(with(input, 0x8120), Some(ImageFault::Operand), "*MD0");
    assert_eq!(
        with(input, 0xE000 | (header.constants_at() + 1)),
        Some(ImageFault::Operand),
        "after the constants"
    );
    assert_eq!(with(input, 0xE000), Some(ImageFault::Operand), "the header as a constant");
    assert_eq!(with(out, 0xC005), Some(ImageFault::Operand), "a constant is written");
    assert_eq!(with(out, 0x0100), None, "ID0");
    assert_eq!(with(out, 0x0140), Some(ImageFault::ReadOnly), "SMD0");
    assert_eq!(with(out, 0x0228), Some(ImageFault::ReadOnly), "HC0");
    for legal in [0x021C, 0x821C, 0x0100, 0xC000, 0xDFFF] {
        assert_eq!(with(input, legal), None, "{legal:04X}");
    }
}

/// Programs leave 64 bytes free after their memory and the copy of what is retained.
#[test]
fn the_serial_line_has_its_room() {
    let of_ranges = |ranges: &str| {
        let text = format!("//# memory VB0-VB{ranges}\nLD SM0.0\n= Q0.0\n");
        tests::image::image(&text)
    };
    let image = of_ranges("895");
    let program = verify(image.as_slice()).unwrap();
    assert_eq!(program.plan().end() + LINE_ROOM, DATA_END);
    // VB0 to VB896, and an arena that is a byte longer.
    let header = Header::read(&image).unwrap();
    let mut longer = image.clone();
    longer[10..12].copy_from_slice(&897u16.to_le_bytes());
    assert_eq!(
        fault_in(longer, header.v_ranges_at() + 2, &897u16.to_le_bytes()),
        Some(ImageFault::Plan)
    );
    // What is retained needs its copy.
    let image = of_ranges("447\n//# retain VB0-VB447");
    assert!(verify(image.as_slice()).is_ok());
    let header = Header::read(&image).unwrap();
    assert_eq!(fault_in(image.clone(), header.retained_at() + 3, &447u16.to_le_bytes()), None);
    let mut longer = image;
    longer[10..12].copy_from_slice(&449u16.to_le_bytes());
    assert_eq!(
        fault_in(longer, header.v_ranges_at() + 2, &449u16.to_le_bytes()),
        Some(ImageFault::Retained)
    );
}

/// The last number is not one too many.
#[test]
fn all_counters_can_be_used_in_one_program() {
    let text: String =
        (0..=255).map(|number| format!("LD SM0.0\nMOVW {number}, C{number}\n")).collect();
    let image = tests::image::image(&text);
    let program = plc_isa::verify(image.as_slice()).unwrap();
    assert_eq!(program.plan().counters().count(), 256);
    assert_eq!(program.plan().counter_slot(255).map(|slot| slot.number), Some(255));
}
