//! Native translation as a library and from the command line: the image, its bounds, what is said.
//! That the machine code does what it must is tested where there is a chip to run it.

use std::path::Path;
use std::process::{Command, Output};

use awl_asm::assemble::assemble;
use awl_asm::native::{Options, TranslateError, Translated, translate, translate_with};
use awl_asm::source::Source;
use plc_isa::{
    CRC_LEN, ENTRY_LEN, FORMAT_VERSION, Header, ImageError, ImageFault, NATIVE_INTERFACE, Op,
    Operand, ProgramMemory, SLOT_LEN, decode, verify,
};

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
TON    T32, VW0
*I     VW0, VW30
S      M3.0, 200
LD     I0.1
EU
LD     I0.2
CTU    C3, 5
NETWORK 3
LD     I0.5
JMP    1
LD     SM0.0
FOR    MW10, 1, VW0
INCW   MW12
NEXT
LD     I0.4
END
LBL    1
LD     M0.0
STOP
";

/// The board's view of an image.
struct Board<'a>(&'a [u8]);

impl ProgramMemory for Board<'_> {
    const NATIVE_INTERFACE: u8 = NATIVE_INTERFACE;
    fn len(&self) -> u16 {
        self.0.len() as u16
    }
    fn byte(&self, offset: u16) -> u8 {
        self.0.byte(offset)
    }
}

fn assembled(text: &str) -> Vec<u8> {
    let assembly = assemble(&Source::new("native", text).unwrap(), Vec::new());
    assembly.image.unwrap_or_else(|| panic!("{:?}", assembly.diagnostics))
}

fn translated(text: &str) -> Translated {
    translate(&assembled(text)).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn a_native_image_is_for_the_board_alone() {
    let native = translated(PROGRAM).image;
    let program = verify(Board(&native)).unwrap();
    let header = program.plan().header;
    let entry = program.entry().unwrap();
    assert_eq!((header.interface, header.labels), (NATIVE_INTERFACE, 0));
    assert!(
        entry.is_multiple_of(2)
            && entry >= program.code_at() + ENTRY_LEN
            && entry < header.code_end()
    );
    let error = verify(native.as_slice()).unwrap_err();
    assert_eq!(error, ImageError { fault: ImageFault::Interface, at: 5 });
}

#[test]
fn the_tables_and_the_plan_stay() {
    let bytecode = assembled(PROGRAM);
    let native = translated(PROGRAM).image;
    let (before, after) = (verify(&bytecode).unwrap(), verify(Board(&native)).unwrap());
    let (before, after) = (before.plan(), after.plan());
    assert!(before.header.labels > 0);
    assert!(before.name().eq(after.name()) && before.v_ranges().eq(after.v_ranges()));
    assert!(before.timers().eq(after.timers()) && before.counters().eq(after.counters()));
    assert!(before.retained().eq(after.retained()));
    assert_eq!((before.header.settings, before.end()), (after.header.settings, after.end()));
    assert_eq!(before.retained_identity().value(), after.retained_identity().value());
}

#[test]
fn every_instruction_has_its_place_and_its_cycles() {
    let bytecode = assembled(PROGRAM);
    let program = verify(&bytecode).unwrap();
    for pins in [true, false] {
        let native = translate_with(&bytecode, Options { pins }).unwrap();
        assert_eq!(native.pinned.is_empty(), !pins);
        let (mut at, mut end) = (program.code_at(), native.instructions[0].native.start);
        for instruction in &native.instructions {
            let decoded = decode(&bytecode, at).unwrap();
            assert_eq!((instruction.at, instruction.native.start), (at, end));
            let leads_away = matches!(
                decoded.op,
                Op::Jmp | Op::For | Op::Next | Op::End | Op::Stop | Op::MainEnd
            );
            assert_eq!(instruction.taken.is_some(), leads_away, "{:?}", decoded.op);
            assert_eq!(
                instruction.not_taken.is_some(),
                decoded.op != Op::MainEnd,
                "{:?}",
                decoded.op
            );
            let is_free = matches!(decoded.op, Op::Nop | Op::Lbl);
            assert_eq!(instruction.cycles.max == 0, is_free, "{:?}", decoded.op);
            assert!(instruction.cycles.min <= instruction.cycles.max);
            (at, end) = (at + decoded.len, instruction.native.end);
        }
        assert_eq!(at, program.plan().header.code_end());
        assert!(usize::from(end) <= native.image.len() - usize::from(CRC_LEN));
    }
}

#[test]
fn entries_outside_the_code_are_refused() {
    let native = translated(PROGRAM).image;
    let header = Header::read(&Board(&native)).unwrap();
    let fault_with = |at: u16, bytes: &[u8]| {
        let mut image = native.clone();
        image[usize::from(at)..usize::from(at) + bytes.len()].copy_from_slice(bytes);
        let end = image.len() - usize::from(CRC_LEN);
        let crc = plc_isa::Crc32::of(&image[..end]);
        image[end..].copy_from_slice(&crc.to_le_bytes());
        verify(Board(&image)).err()
    };
    let code_at = header.code_at();
    let refused = Some(ImageError { fault: ImageFault::Interface, at: code_at });
    assert_eq!(
        fault_with(code_at, &verify(Board(&native)).unwrap().entry().unwrap().to_le_bytes()),
        None
    );
    for entry in [0, code_at, code_at + 1, header.code_end(), header.code_end() | 1, 0xFFFE] {
        assert_eq!(fault_with(code_at, &entry.to_le_bytes()), refused, "entry {entry:#06x}");
    }
    let odd = (code_at + ENTRY_LEN) | 1;
    assert_eq!(fault_with(code_at, &odd.to_le_bytes()), refused, "an odd entry");
    assert_eq!(fault_with(5, &[2]), Some(ImageError { fault: ImageFault::Interface, at: 5 }));
}

#[test]
fn a_bad_image_is_not_translated() {
    let mut image = assembled(PROGRAM);
    image[40] ^= 1;
    assert!(matches!(
        translate(&image),
        Err(TranslateError::Invalid(error)) if error.fault == ImageFault::Crc
    ));
    let native = translated(PROGRAM).image;
    assert!(matches!(
        translate(&native),
        Err(TranslateError::Invalid(error)) if error.fault == ImageFault::Interface
    ));
}

/// Instructions that take much more room translated.
fn long_program() -> String {
    (0..700)
        .map(|index| {
            format!("LD M{}.{}\n+I VW{}, VW{}\n", index % 32, index % 8, index % 90, index % 50)
        })
        .collect()
}

#[test]
fn a_program_that_does_not_fit_is_refused_with_its_numbers() {
    let bytecode = assembled(&long_program());
    let Err(TranslateError::TooLarge { total_len, bytecode_len, at }) = translate(&bytecode) else {
        panic!("it fits");
    };
    assert!(total_len > usize::from(SLOT_LEN) && bytecode_len == bytecode.len());
    assert!(usize::from(at) < bytecode_len && decode(&bytecode, at).is_ok());
}

/// More machine code than the addresses of the chip reach.
#[test]
fn a_program_far_too_large_is_refused_too() {
    let lines: String =
        (0..1_450).map(|index| format!("+I VW{}, VW{}\n", index % 90, index % 50)).collect();
    let text = format!("LD I0.0\nJMP 1\nLBL 2\nLD I0.1\n{lines}JMP 2\nLBL 1\n");
    let bytecode = assembled(&text);
    let Err(TranslateError::TooLarge { total_len, .. }) = translate(&bytecode) else {
        panic!("it fits")
    };
    assert!(total_len > 60_000, "{total_len}");
}

fn awl_asm(directory: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_awl-asm"))
        .args(arguments)
        .current_dir(directory)
        .output()
        .unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn the_command_writes_native_images() {
    let directory = tempfile::tempdir().unwrap();
    let at = |name: &str| directory.path().join(name);
    std::fs::write(at("p.awl"), PROGRAM).unwrap();
    let output = awl_asm(directory.path(), &["p.awl", "--native"]);
    assert!(output.status.success(), "{}", stderr(&output));
    let image = std::fs::read(at("p.bin")).unwrap();
    assert_eq!(image, translated(PROGRAM).image);
    let summary = stderr(&output);
    let is_said = summary.contains("p.bin: translated: 24 instructions, ")
        && summary.contains(&format!(" {} of 7680 bytes", image.len()));
    assert!(is_said, "{summary}");
    let output = awl_asm(directory.path(), &["p.awl", "--native", "-o", "p.hex"]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(
        std::fs::read_to_string(at("p.hex"))
            .unwrap()
            .starts_with(&format!(":1060000055323030{FORMAT_VERSION:02X}01"))
    );
    let output = awl_asm(directory.path(), &["--disassemble", "p.bin"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(stderr(&output).contains("translated to machine code"), "{}", stderr(&output));
}

#[test]
fn the_command_says_that_bytecode_would_fit() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("long.awl"), long_program()).unwrap();
    for check in [true, false] {
        let mut arguments = vec!["long.awl", "--native"];
        arguments.extend(check.then_some("--check"));
        let output = awl_asm(directory.path(), &arguments);
        assert_eq!(output.status.code(), Some(1));
        let text = stderr(&output);
        assert!(text.contains("E0018") && text.contains("the program slot has 7680"), "{text}");
        assert!(text.contains("without --native the program fits"), "{text}");
        assert!(!directory.path().join("long.bin").exists());
    }
    let output = awl_asm(directory.path(), &["long.awl", "--check"]);
    assert!(output.status.success(), "{}", stderr(&output));
}

/// A main program with units of all kinds: `Work` is called by both, `Alone` by nobody.
const UNITS: &str = "\
ORGANIZATION_BLOCK MAIN:OB1
BEGIN
LBL 1
LD SM0.1
ATCH Timed, 10
MOVB 20, SMB34
ENI
NETWORK 2
LSCR S0.0
LD I0.0
SCRT S0.1
SCRE
LD I0.1
CALL Work, 5, VD10
LDR> VD10, 2.5
AENO
JMP 1
END_ORGANIZATION_BLOCK
INTERRUPT_BLOCK Timed:INT0
BEGIN
LD SM0.0
CALL Work, 7, VD20
JMP 2
INCW VW0
LBL 2
MOVR 1.25, VD14
END_INTERRUPT_BLOCK
SUBROUTINE_BLOCK Work:SBR0
VAR_INPUT
n:INT;
END_VAR
VAR_OUTPUT
sum:DINT;
END_VAR
BEGIN
LD SM0.0
MOVD 1000000, #sum
FOR VW2, 1, #n
INCD #sum
NEXT
LD I0.5
CRET
INCW VW4
END_SUBROUTINE_BLOCK
SUBROUTINE_BLOCK Alone:SBR1
BEGIN
LD SM0.0
INCW VW6
END_SUBROUTINE_BLOCK
";

/// The instructions of a unit from an offset on, to its end.
fn unit<P: ProgramMemory>(memory: &P, mut at: u16) -> Vec<Op> {
    let mut ops = Vec::new();
    while !matches!(ops.last(), Some(Op::Ret | Op::MainEnd)) {
        let decoded = decode(memory, at).unwrap();
        ops.push(decoded.op);
        at += decoded.len;
    }
    ops
}

#[test]
fn what_interrupts_execute_stays_bytecode() {
    let bytecode = assembled(UNITS);
    let native = translated(UNITS);
    let (before, after) = (verify(&bytecode).unwrap(), verify(Board(&native.image)).unwrap());
    let (before, after) = (before.plan(), after.plan());
    let named = |wanted| {
        (0..before.header.routines).find(|&index| before.routine_name(index) == wanted).unwrap()
    };
    let (work, timed) = (named((false, 0)), named((true, 0)));
    for routine in [work, timed] {
        let ops = unit(&Board(&native.image), after.routine(routine));
        assert_eq!(ops, unit(&bytecode, before.routine(routine)));
    }
    // Labels lead to where their routine has moved to: that of the main program is not needed.
    let ops = unit(&Board(&native.image), after.label(1));
    assert_eq!((before.header.labels, after.header.labels, ops[0]), (2, 2, Op::Lbl));
    // Machine code: the main program and what it calls.
    let translated =
        native.instructions.iter().map(|instruction| decode(&bytecode, instruction.at).unwrap().op);
    let (main, work) = (unit(&bytecode, before.code_at()), unit(&bytecode, before.routine(work)));
    assert_eq!(translated.collect::<Vec<_>>(), [main, work].concat());
    let follow =
        native.instructions.windows(2).all(|pair| pair[0].native.end == pair[1].native.start);
    assert!(follow, "one after the other");
}

/// The assembler does not allow it, the loader does; the board would say so in SM4.3.
#[test]
fn calls_that_are_nested_too_deep_are_not_translated() {
    let chain = |first: u8, last: u8| {
        let routine = |number: u8| {
            let next = if number < last {
                format!("CALL SBR{}", number + 1)
            } else {
                "INCW VW0".to_string()
            };
            format!(
                "SUBROUTINE_BLOCK S{number}:SBR{number}\nBEGIN\nLD SM0.0\n{next}\n\
                 END_SUBROUTINE_BLOCK\n"
            )
        };
        (first..=last).map(routine).collect::<String>()
    };
    let main = "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\nLD SM0.0\nCALL SBR0\nCALL SBR20\n\
        END_ORGANIZATION_BLOCK\n";
    let mut image = assembled(&format!("{main}{}{}", chain(0, 7), chain(20, 21)));
    translate(&image).unwrap();
    // The last but one of the long chain calls the first of the short one.
    let call = |routine| {
        Op::Call
            .instruction()
            .encode(&[Operand::Number(routine)], &plc_isa::UNO)
            .unwrap()
            .bytes()
            .to_vec()
    };
    let at = image.windows(2).position(|bytes| bytes == call(7)).unwrap();
    image[at..at + 2].copy_from_slice(&call(8));
    let end = image.len() - usize::from(CRC_LEN);
    let crc = plc_isa::Crc32::of(&image[..end]);
    image[end..].copy_from_slice(&crc.to_le_bytes());
    let Err(error @ TranslateError::Missing { .. }) = translate(&image) else {
        panic!("it is translated")
    };
    assert!(error.to_string().contains("nested so deep"), "{error}");
}
