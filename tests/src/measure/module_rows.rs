//! The rows of instructions that come in modules, of routines, of sequence control and of
//! interrupts: the program an instruction is in, the values that it finds, and what the S7-200
//! takes (docs/s7-200.md 5.2). Nothing is measured here.
//!
//! Operands are in V memory, counts are constants, unless the row says something else.

use super::rows::{Chapter, Row};
use super::s7_200::{each, fixed};
use super::values::Content::{
    Bcd, Bits, Byte, Characters, Count, Double, Real, Share, String, Table, Text, Word,
};
use super::values::Item;

/// Memory for tables, blocks and strings.
const MEMORY: &str = "//# memory VB0-VB299\n";
/// A box after a contact.
const BOX: &str = "LD M30.0\n{}";
/// The same with a pointer to VB100, and with one for a count of 8 at VB290.
const POINTER: &str = "LD SM0.0\nMOVD &VB100, AC1\nLD M30.0\n{}";
/// The same with a pointer to the last of some counters.
const BY_POINTER_TO_COUNTER: &str = "LD M30.0\nLD M30.1\nCTU C1, 5\nLD M30.0\nLD M30.1\nCTU C2, 5\n\
    LD M30.0\nLD M30.1\nCTU C3, 5\nLD M30.0\nLD M30.1\nCTU C4, 5\nLD SM0.0\nMOVD &C4, AC1\n\
    LD M30.0\n{}";
const COUNTED: &str = "LD SM0.0\nMOVD &VB290, AC1\nLD M30.0\n{}";
const COUNT: &[Item] = &[(290, Count)];
/// A contact that loads, and one after another.
const LOADS: &str = "{}\n= M31.7";
const BEHIND: &str = "LD M30.0\n{}\n= M31.7";
const LOADS_BY_POINTER: &str = "LD SM0.0\nMOVD &VB100, AC1\n{}\n= M31.7";
const BEHIND_BY_POINTER: &str = "LD SM0.0\nMOVD &VB100, AC1\nLD M30.0\n{}\n= M31.7";

const fn row(awl: &'static str) -> Row {
    Row::new(awl, MEMORY, BOX)
}

const fn by_pointer(awl: &'static str) -> Row {
    Row::new(awl, MEMORY, POINTER)
}

const fn loads(awl: &'static str) -> Row {
    Row::new(awl, MEMORY, LOADS)
}

const fn behind(awl: &'static str) -> Row {
    Row::new(awl, MEMORY, BEHIND)
}

/// Without settings: V memory is what is named.
const fn in_frame(awl: &'static str, frame: &'static str) -> Row {
    Row::new(awl, "", frame)
}

/// Divisors as they are usual.
const DIVISOR: &[Item] = &[(4, Word(-1000, 1000))];
const DOUBLES: &[Item] = &[(4, Double(-100_000, 100_000)), (8, Double(-10_000_000, 10_000_000))];
const WORDS_AT_POINTER: &[Item] = &[(100, Word(-1000, 1000))];

const ARITHMETIC: &[Row] = &[
    by_pointer("+I *AC1, VW6").quoted(fixed(25.0 + 14.0)),
    by_pointer("-I *AC1, VW6").quoted(fixed(25.0 + 14.0)),
    by_pointer("*I *AC1, VW6").quoted(fixed(37.0 + 14.0)),
    by_pointer("/I *AC1, VW6").with(WORDS_AT_POINTER).quoted(fixed(64.0 + 14.0)),
    by_pointer("INCW *AC1").quoted(fixed(20.0 + 14.0)),
    by_pointer("DECW *AC1").quoted(fixed(20.0 + 14.0)),
    row("+D VD4, VD8").quoted(fixed(29.0)),
    row("+D 100000, VD8").quoted(fixed(29.0)),
    row("-D VD4, VD8").quoted(fixed(29.0)),
    row("*D VD4, VD8").with(DOUBLES).quoted(fixed(47.0)),
    row("/D VD4, VD8").with(DOUBLES).quoted(fixed(250.0)),
    row("MUL VW4, VD8").quoted(fixed(37.0)),
    row("DIV VW4, VD8").with(DIVISOR).quoted(fixed(67.0)),
    row("INCB VB4").quoted(fixed(15.0)),
    row("DECB VB4").quoted(fixed(16.0)),
    row("INCD VD4").quoted(fixed(22.0)),
    row("DECD VD4").quoted(fixed(22.0)),
];

const REALS_OF_USE: &[Item] = &[(4, Real(-1000.0, 1000.0)), (8, Real(-1000.0, 1000.0))];
const ANGLE: &[Item] = &[(4, Real(-6.3, 6.3))];
const EXPONENT: &[Item] = &[(4, Real(-10.0, 10.0))];
const POSITIVE: &[Item] = &[(4, Real(0.001, 1000.0))];
/// PV, SP, M, gain, sample time, integral and derivative time, bias, PV before: one loop of a
/// controller.
const LOOP: &[Item] = &[
    (0, Share(0.3, 0.7)),
    (4, Share(0.4, 0.6)),
    (8, Share(0.1, 0.9)),
    (12, Share(0.5, 2.0)),
    (16, Share(0.1, 1.0)),
    (20, Share(1.0, 30.0)),
    (24, Share(0.0, 0.5)),
    (28, Share(0.1, 0.9)),
    (32, Share(0.3, 0.7)),
];

const REALS: &[Row] = &[
    row("+R VD4, VD8").with(REALS_OF_USE).quoted(fixed(71.0)),
    row("-R VD4, VD8").with(REALS_OF_USE).quoted(fixed(72.0)),
    row("*R VD4, VD8").with(REALS_OF_USE).quoted(fixed(56.0)),
    row("/R VD4, VD8").with(REALS_OF_USE).quoted(fixed(177.0)),
    row("SQRT VD4, VD8").with(POSITIVE).quoted(fixed(460.0)),
    row("SIN VD4, VD8").with(ANGLE).quoted(fixed(900.0)),
    row("COS VD4, VD8").with(ANGLE).quoted(fixed(900.0)),
    row("TAN VD4, VD8").with(ANGLE).quoted(fixed(1080.0)),
    row("LN VD4, VD8").with(POSITIVE).quoted(fixed(680.0)),
    row("EXP VD4, VD8").with(EXPONENT).quoted(fixed(720.0)),
    row("PID VB0, 0").with(LOOP).quoted(fixed(400.0)),
    row("DTR VD4, VD8").with(&[(4, Bits)]).quoted(fixed(35.0)),
    row("ROUND VD4, VD8").with(REALS_OF_USE).quoted(fixed(56.0)),
    row("TRUNC VD4, VD8").with(REALS_OF_USE).quoted(fixed(53.0)),
];

const LOGIC: &[Row] = &[
    row("INVB VB4").quoted(fixed(16.0)),
    row("INVW VW4").quoted(fixed(20.0)),
    row("INVD VD4").quoted(fixed(22.0)),
    row("ANDB VB4, VB8").quoted(fixed(19.0)),
    row("ANDW VW4, VW8").quoted(fixed(25.0)),
    row("ANDD VD4, VD8").quoted(fixed(30.0)),
    row("ORB VB4, VB8").quoted(fixed(19.0)),
    row("ORW VW4, VW8").quoted(fixed(25.0)),
    row("ORD VD4, VD8").quoted(fixed(29.0)),
    row("XORB VB4, VB8").quoted(fixed(19.0)),
    row("XORW VW4, VW8").quoted(fixed(25.0)),
    row("XORD VD4, VD8").quoted(fixed(29.0)),
    row("SLB VB4, {n}").count("bit", 4, 8).quoted(each(23.0, 0.2)),
    row("SLW VW4, {n}").count("bit", 4, 16).quoted(each(27.0, 0.6)),
    row("SLD VD4, {n}").count("bit", 4, 32).quoted(each(29.0, 1.1)),
    row("SRB VB4, {n}").count("bit", 4, 8).quoted(each(22.0, 0.6)),
    row("SRW VW4, {n}").count("bit", 4, 16).quoted(each(27.0, 1.0)),
    row("SRD VD4, {n}").count("bit", 4, 32).quoted(each(28.0, 1.5)),
    row("RLB VB4, {n}").count("bit", 3, 7).quoted(each(23.0, 0.2)),
    row("RLW VW4, {n}").count("bit", 4, 15).quoted(each(27.0, 0.9)),
    row("RLD VD4, {n}").count("bit", 4, 31).quoted(each(28.0, 1.4)),
    row("RRB VB4, {n}").count("bit", 3, 7).quoted(each(22.0, 0.5)),
    row("RRW VW4, {n}").count("bit", 4, 15).quoted(each(26.0, 1.2)),
    row("RRD VD4, {n}").count("bit", 4, 31).quoted(each(28.0, 1.7)),
    row("SHRB M31.0, V10.0, {n}").count("bit", 16, 64).quoted(each(48.0, 1.0)),
    Row::new("S V100.0, *AC1", MEMORY, COUNTED)
        .with(COUNT)
        .count("bit", 8, 128)
        .quoted(each(14.0 + 14.0, 0.5)),
    Row::new("R V100.0, *AC1", MEMORY, COUNTED)
        .with(COUNT)
        .count("bit", 8, 128)
        .quoted(each(14.0 + 14.0, 0.5)),
];

const MOVES: &[Row] = &[
    by_pointer("MOVB *AC1, VB4").quoted(fixed(15.0 + 14.0)),
    by_pointer("MOVW *AC1, VW4").quoted(fixed(18.0 + 14.0)),
    in_frame("MOVW *AC1, VW4 // a counter", BY_POINTER_TO_COUNTER),
    row("MOVD VD4, VD8").quoted(fixed(20.0)),
    row("MOVD 5, VD8").quoted(fixed(20.0)),
    row("MOVD 100000, VD8").quoted(fixed(20.0)),
    row("MOVD &VB100, VD8").quoted(fixed(20.0)),
    by_pointer("MOVD *AC1, VD8").quoted(fixed(20.0 + 14.0)),
    by_pointer("MOVD VD8, *AC1").quoted(fixed(20.0 + 14.0)),
    row("MOVR VD4, VD8").quoted(fixed(20.0)),
    row("SWAP VW4").quoted(fixed(17.0)),
    row("BTI VB4, VW8").quoted(fixed(16.0)),
    row("ITB VW4, VB8").with(&[(4, Word(0, 255))]).quoted(fixed(17.0)),
    row("ITD VW4, VD8").quoted(fixed(20.0)),
    row("DTI VD4, VW8").with(&[(4, Double(-32768, 32767))]).quoted(fixed(21.0)),
    row("BCDI VW4").with(&[(4, Bcd)]).quoted(fixed(35.0)),
    row("IBCD VW4").with(&[(4, Word(0, 9999))]).quoted(fixed(52.0)),
    row("DECO VB4, VW8").quoted(fixed(19.0)),
    row("ENCO VW4, VB8").quoted(fixed(24.0)),
    row("SEG VB4, VB8").quoted(fixed(15.0)),
];

const STRINGS_OF_SAME: &[Item] = &[(0, Text("conveyor")), (100, Text("conveyor"))];

const COMPARISONS: &[Row] = &[
    Row::new("LDB{x} *AC1, VB4", MEMORY, LOADS_BY_POINTER).quoted(fixed(18.0 + 14.0)),
    Row::new("AB{x} *AC1, VB4", MEMORY, BEHIND_BY_POINTER).quoted(fixed(18.0 + 14.0)),
    Row::new("OB{x} *AC1, VB4", MEMORY, BEHIND_BY_POINTER).quoted(fixed(18.0 + 14.0)),
    Row::new("LDW{x} *AC1, VW4", MEMORY, LOADS_BY_POINTER).quoted(fixed(24.0 + 14.0)),
    Row::new("AW{x} *AC1, VW4", MEMORY, BEHIND_BY_POINTER).quoted(fixed(23.0 + 14.0)),
    Row::new("OW{x} *AC1, VW4", MEMORY, BEHIND_BY_POINTER).quoted(fixed(24.0 + 14.0)),
    loads("LDD{x} VD4, VD8").quoted(fixed(27.0)),
    behind("AD{x} VD4, VD8").quoted(fixed(27.0)),
    behind("OD{x} VD4, VD8").quoted(fixed(26.0)),
    loads("LDR{x} VD4, VD8").with(REALS_OF_USE).quoted(fixed(29.0)),
    behind("AR{x} VD4, VD8").with(REALS_OF_USE).quoted(fixed(29.0)),
    behind("OR{x} VD4, VD8").with(REALS_OF_USE).quoted(fixed(29.0)),
    loads("LDS= VB0, VB100")
        .with(STRINGS_OF_SAME)
        .count("character", 8, 40)
        .quoted(each(33.0, 6.3)),
    behind("AS= VB0, VB100")
        .with(STRINGS_OF_SAME)
        .count("character", 8, 40)
        .quoted(each(33.0, 6.3)),
    behind("OS= VB0, VB100")
        .with(STRINGS_OF_SAME)
        .count("character", 8, 40)
        .quoted(each(33.0, 6.3)),
];

const TABLE: &[Item] = &[(0, Table)];
/// A pattern that is not in the table.
const SEARCHED: &[Item] = &[(0, Table), (260, Word(-5, -5)), (262, Word(0, 0))];

const TABLES: &[Row] = &[
    row("ATT VW260, VW0").with(&[(0, Table)]).count("entry", 8, 40).quoted(fixed(36.0)),
    row("FIFO VW0, VW260").with(TABLE).count("entry", 8, 40).quoted(each(30.0, 7.0)),
    row("LIFO VW0, VW260").with(TABLE).count("entry", 8, 40).quoted(fixed(37.0)),
    row("FND= VW2, VW260, VW262").with(SEARCHED).count("entry", 8, 40).quoted(each(39.0, 6.5)),
    row("FILL VW0, VW100, {n}").count("word", 8, 60).quoted(each(15.0, 3.2)),
    row("BMB VB0, VB100, {n}").count("byte", 8, 90).quoted(each(10.0, 5.7)),
    row("BMW VW0, VW100, {n}").count("word", 8, 45).quoted(each(10.0, 8.6)),
    row("BMD VD0, VD100, {n}").count("double word", 8, 24).quoted(each(11.0, 10.6)),
];

const STRINGS: &[Row] = &[
    row("SLEN VB0, VB260")
        .with(&[(0, Text("conveyor"))])
        .count("character", 8, 40)
        .quoted(fixed(21.0)),
    row("SCPY VB0, VB100")
        .with(&[(0, Text("conveyor"))])
        .count("character", 8, 40)
        .quoted(each(27.0, 4.6)),
    row("SCAT VB0, VB100").with(STRINGS_OF_SAME).count("character", 8, 40).quoted(each(30.0, 5.3)),
    row("SSCPY VB0, 1, {n}, VB100").with(&[(0, Text("conveyor"))]).count("character", 8, 40),
    // Found at the end, or nowhere.
    row("SFND VB0, VB100, VB260")
        .with(&[(0, Text("conveyor")), (100, String("xzq")), (260, Byte(1, 1))])
        .count("character", 8, 40),
    row("CFND VB0, VB100, VB260")
        .with(&[(0, Text("conveyor")), (100, String("xzq")), (260, Byte(1, 1))])
        .count("character", 8, 40),
    row("ATH VB0, VB100, {n}")
        .with(&[(0, Characters("3EA90F17"))])
        .count("digit", 8, 40)
        .quoted(each(23.0, 10.2)),
    row("HTA VB0, VB100, {n}").count("digit", 8, 40).quoted(each(20.0, 5.2)),
    row("ITA VW4, VB100, 2").quoted(fixed(136.0)),
    row("DTA VD4, VB100, 2").quoted(fixed(302.0)),
    row("RTA VD4, VB100, 16#A2").with(&[(4, Real(-9999.0, 9999.0))]),
    row("ITS VW4, 2, VB100"),
    row("DTS VD4, 2, VB100"),
    row("RTS VD4, 16#A2, VB100").with(&[(4, Real(-9999.0, 9999.0))]),
    row("STI VB100, 1, VW4").with(&[(100, String("-12345"))]),
    row("STD VB100, 1, VD4").with(&[(100, String("-123456789"))]),
    row("STR VB100, 1, VD4").with(&[(100, String("-123.456"))]),
];

/// What an analog output is given, and what is cut off.
const ANALOG: &[Item] = &[(4, Word(-1000, i16::MAX))];

const POINTS: &[Row] = &[
    loads("LDI I0.1").quoted(fixed(15.0)),
    loads("LDNI I0.1").quoted(fixed(15.0)),
    behind("AI I0.1").quoted(fixed(15.0)),
    behind("ANI I0.1").quoted(fixed(15.0)),
    behind("OI I0.1").quoted(fixed(15.0)),
    behind("ONI I0.1").quoted(fixed(15.0)),
    row("=I Q0.1").quoted(fixed(16.0)),
    row("SI Q0.0, {n}").count("point", 1, 6),
    row("RI Q0.0, {n}").count("point", 1, 6),
    row("BIR IB0, VB4").quoted(fixed(23.0)),
    row("BIW VB4, QB0").quoted(fixed(24.0)),
    row("DLED VB4"),
    // With the hidden instruction after it, which hands the value to the timer.
    row("MOVW VW4, AQW0").with(ANALOG),
    Row::new("MOVW VW4, AQW2 // with AQW0", MEMORY, "LD M30.0\nMOVW VW4, AQW0\n{}").with(ANALOG),
    in_frame("HDEF 0, 0", BOX).once().quoted(fixed(18.0)),
    in_frame("HSC 0", "LD SM0.1\nHDEF 0, 0\nLD SM0.0\nMOVB 16#F8, SMB37\nLD M30.0\n{}")
        .quoted(fixed(30.0)),
    in_frame("PLS 1", "LD SM0.0\nMOVB 16#CB, SMB77\nMOVW 100, SMW78\nMOVW 25, SMW80\nLD M30.0\n{}")
        .quoted(fixed(31.0)),
];

/// A time of day in BCD.
const TIME: &[Item] = &[
    (0, Byte(0x24, 0x26)),
    (1, Byte(1, 9)),
    (2, Byte(1, 9)),
    (3, Byte(0, 9)),
    (4, Byte(0, 9)),
    (5, Byte(0, 9)),
    (6, Byte(0, 0)),
    (7, Byte(1, 7)),
];
/// The serial line as freeport.
const SEND: &str = "LD SM0.1\nMOVB 9, SMB30\nLD M30.0\n{}";
const RECEIVE: &str = "LD SM0.1\nMOVB 9, SMB30\nLD SM0.0\nMOVB 16#90, SMB87\nMOVW 5, SMW90\n\
    MOVB 10, SMB94\nLD M30.0\n{}";

const CLOCK: &[Row] = &[
    Row::new("TODR VB10", MEMORY, "LD SM0.0\nTODW VB0\nLD M30.0\n{}")
        .with(TIME)
        .quoted(fixed(331.0)),
    row("TODW VB0").with(TIME).quoted(fixed(436.0)),
    row("BITIM VD4").quoted(fixed(16.0)),
    row("CITIM VD4, VD8").quoted(fixed(23.0)),
    Row::new("XMT VB0, 0", MEMORY, SEND).with(&[(0, String("pallet 12"))]).quoted(fixed(42.0)),
    Row::new("RCV VB0, 0", MEMORY, RECEIVE).quoted(fixed(51.0)),
];

/// A program of blocks.
const MAIN: &str = "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\n";
/// A box in it, beside a routine.
const CALLER: &str = "LD M30.0\n{}\nEND_ORGANIZATION_BLOCK\n\
    SUBROUTINE_BLOCK Part:SBR0\nBEGIN\nLD SM0.0\n= M31.6\nEND_SUBROUTINE_BLOCK";
/// A box beside a routine for an event that does not occur.
const ATTACHED: &str = "LD M30.0\n{}\nEND_ORGANIZATION_BLOCK\n\
    INTERRUPT_BLOCK Edge:INT0\nBEGIN\nLD SM0.0\n= M31.6\nEND_INTERRUPT_BLOCK";
/// The same where another instruction attaches it.
const OTHERS: &str = "LD SM0.1\nATCH Edge, 2\nLD M30.0\n{}\nEND_ORGANIZATION_BLOCK\n\
    INTERRUPT_BLOCK Edge:INT0\nBEGIN\nLD SM0.0\n= M31.6\nEND_INTERRUPT_BLOCK";

const ROUTINES: &[Row] = &[
    Row::new("CALL Part", MAIN, CALLER).quoted(fixed(9.0)),
    in_frame("LSCR S0.1", "{}\nLD M30.0\n= M31.7\nSCRE").quoted(fixed(7.3)),
    in_frame("SCRT S0.2", "LD SM0.0\nS S0.1, 1\nLSCR S0.1\nLD M30.0\n{}\nSCRE").quoted(fixed(10.0)),
    in_frame("SCRE", "LSCR S0.1\nLD M30.0\n= M31.7\n{}").quoted(fixed(0.24)),
    in_frame("CSCRE", "LD SM0.0\nS S0.1, 1\nLSCR S0.1\nLD M30.0\n{}\nSCRE").quoted(fixed(3.1)),
    Row::new("ATCH Edge, 0", MAIN, ATTACHED).quoted(fixed(12.0)),
    Row::new("DTCH 0", MAIN, OTHERS).quoted(fixed(12.0)),
    Row::new("CEVNT 0", MAIN, OTHERS),
    Row::new("ENI", MAIN, OTHERS).quoted(fixed(11.0)),
    Row::new("DISI", MAIN, OTHERS).quoted(fixed(9.0)),
    in_frame("AENO", "LD M30.0\n+I VW4, VW6\n{}\n= M31.7").quoted(fixed(0.4)),
];

/// All rows.
pub const MODULE_CHAPTERS: [Chapter; 10] = [
    Chapter { title: "Arithmetic of modules", rows: ARITHMETIC },
    Chapter { title: "Reals", rows: REALS },
    Chapter { title: "Logic and shifts", rows: LOGIC },
    Chapter { title: "Moves and conversions", rows: MOVES },
    Chapter { title: "Comparisons of modules", rows: COMPARISONS },
    Chapter { title: "Tables and blocks", rows: TABLES },
    Chapter { title: "Strings and numerals", rows: STRINGS },
    Chapter { title: "Points and counters and pulses", rows: POINTS },
    Chapter { title: "Clock and serial line", rows: CLOCK },
    Chapter { title: "Routines and sequence control and interrupts", rows: ROUTINES },
];
