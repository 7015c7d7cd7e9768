//! Cycles of the interpreter on the board, for each form of an instruction. Measured on the simulated board:
//! `cargo run -p tests --features tests/uno --bin measure -- table` prints the table as it stands here.

use plc_isa::Kind::{
    AnyByte, AnyInt, Byte, ByteConst, ByteOut, Count, CounterNumber, CounterSlot, Edge, FarBit, FarBitOut, FarBitReset,
    Here, IntConst, LabelIndex, LabelNumber, Level, LoopEnd, LoopStart, Number, One, PageBit, PageBitOut, PageBitReset,
    Relation, TimerNumber, TimerSlot, Word, WordConst, WordOut,
};
use plc_isa::{Decoded, Kind, Op, Operand, Plan, PowerFlow, ProgramMemory, TimerResolution, decode, timer_resolution};

use super::Ways;
use crate::native::Cycles;

/// From entering the engine to the first instruction; the way out belongs to what leaves the program.
pub const START: u32 = 37;

/// When a millisecond has passed, the next jump back asks the watchdog and the next timer of 1 ms advances all of them,
/// which looks at each timer of the program.
pub const EACH_MS: u32 = 400;
/// See [`EACH_MS`].
pub const EACH_MS_AND_TIMER: u32 = 250;

/// Fewest and most cycles; none for a way that there is not.
type Range = [u16; 2];

/// A form: to the next instruction without and with power flow, and to elsewhere. What operands add is in [`more`].
type Entry = (Op, &'static [Kind], Range, Range, Range);

/// What the form of an instruction costs, with its operands. `count` is what S or R reads for a count in the scan, if
/// that is known.
pub fn ways<P: ProgramMemory>(decoded: &Decoded, plan: &Plan<P>, image: &[u8], count: Option<u32>) -> Ways {
    let kinds: Vec<Kind> = decoded.operands().map(|(kind, _)| kind).collect();
    let entry = TABLE.iter().find(|(op, of, ..)| *op == decoded.op && *of == kinds);
    let Some(&(.., off, on, away)) = entry else { return Ways::default() };
    let more = more(decoded, plan, image, count);
    let way = |[min, max]: Range, more: u32| {
        (max > 0).then(|| Cycles { min: u32::from(min) + more, max: u32::from(max) + more })
    };
    // A box without power flow does not look at its operands.
    let is_box = decoded.op.instruction().power_flow == PowerFlow::Needed;
    Ways { off: way(off, if is_box { 0 } else { more }), on: way(on, more), away: way(away, more) }
}

/// The most bits that S and R write, and how many timers and counters there are.
const COUNT_MAX: u32 = 255;
const NUMBERS: u32 = 256;
/// For each bit of a range, and for each time the range goes on in another byte.
const BIT: u32 = 6;
const BYTE: u32 = 17;
/// For each byte of a range whose length is read in the scan: plc-vm writes that.
const COUNTED_BYTE: u32 = 89;
/// R of timers and counters, and for each of the program's that R looks at.
const RESET: u32 = 58;
const RESET_SLOT: u32 = 27;
/// For each level that LDS reaches down.
const LEVEL: u32 = 6;
/// A timer of 1 ms is brought up to date when it is executed.
const FAST_TIMER: u32 = 217;
/// FOR and NEXT read INIT and FINAL: a word takes longer than a constant.
const LOOP_WORD: u32 = 6;

/// What the operands of an instruction add to its form's cycles.
pub fn more<P: ProgramMemory>(decoded: &Decoded, plan: &Plan<P>, image: &[u8], count: Option<u32>) -> u32 {
    let operands: Vec<(Kind, Operand)> = decoded.operands().collect();
    let number = |index: usize| match operands.get(index) {
        Some((_, Operand::Number(number))) => u32::from(*number),
        Some((_, Operand::Constant(value))) => u32::from(*value),
        _ => count.unwrap_or(COUNT_MAX),
    };
    match (decoded.op, operands.as_slice()) {
        (Op::Lds, _) => LEVEL * number(0),
        (Op::Set | Op::Reset, [(_, Operand::Bit(bit)), (Byte, _)]) => {
            COUNTED_BYTE * (u32::from(bit.bit) + number(1)).div_ceil(8)
        }
        (Op::Set | Op::Reset, [(_, Operand::Bit(bit)), (kind, _)]) if *kind != One => bits(bit.bit.into(), number(1)),
        (Op::ResetTimers, _) => numbers(number(0), number(1), count, plan.header.timers),
        (Op::ResetCounters, _) => numbers(number(0), number(1), count, plan.header.counters),
        (Op::Ton | Op::Tof | Op::Tonr, [(_, Operand::Number(slot)), _])
            if timer_resolution(plan.timer(*slot).number) == TimerResolution::Ms1 =>
        {
            FAST_TIMER
        }
        (Op::For, [_, init, last, _]) => words(&[*init, *last]),
        (Op::Next, [(_, Operand::Offset(start)), _]) => {
            let head = decode(&image, *start).map(|head| head.operands().skip(1).take(2).collect::<Vec<_>>());
            head.map_or(0, |operands| words(&operands))
        }
        _ => 0,
    }
}

/// R of timers and counters: nothing when a count that is read is 0 or leads past the last one.
fn numbers(first: u32, n: u32, count: Option<u32>, slots: u16) -> u32 {
    match count {
        Some(count) if count == 0 || first + count > NUMBERS => 0,
        _ => RESET + bits(first % 8, n.min(NUMBERS - first)) + RESET_SLOT * u32::from(slots),
    }
}

fn bits(first: u32, count: u32) -> u32 {
    BIT * count + BYTE * ((first + count.saturating_sub(1)) / 8)
}

fn words(operands: &[(Kind, Operand)]) -> u32 {
    operands.iter().map(|(_, operand)| if matches!(operand, Operand::Memory(_)) { LOOP_WORD } else { 0 }).sum()
}

const TABLE: &[Entry] = &[
    (Op::Ld, &[FarBit], [60, 60], [60, 60], [0, 0]),
    (Op::Ld, &[PageBit], [19, 19], [19, 19], [0, 0]),
    (Op::Ldn, &[FarBit], [59, 59], [59, 59], [0, 0]),
    (Op::Ldn, &[PageBit], [22, 22], [22, 22], [0, 0]),
    (Op::A, &[FarBit], [57, 57], [57, 57], [0, 0]),
    (Op::A, &[PageBit], [18, 18], [18, 18], [0, 0]),
    (Op::An, &[FarBit], [56, 56], [56, 56], [0, 0]),
    (Op::An, &[PageBit], [18, 18], [18, 18], [0, 0]),
    (Op::O, &[FarBit], [57, 57], [57, 57], [0, 0]),
    (Op::O, &[PageBit], [20, 20], [20, 20], [0, 0]),
    (Op::On, &[FarBit], [56, 56], [56, 56], [0, 0]),
    (Op::On, &[PageBit], [20, 20], [20, 20], [0, 0]),
    (Op::Not, &[], [17, 17], [17, 17], [0, 0]),
    (Op::Eu, &[Edge], [77, 77], [77, 77], [0, 0]),
    (Op::Ed, &[Edge], [78, 79], [78, 78], [0, 0]),
    (Op::Assign, &[FarBitOut], [57, 57], [57, 57], [0, 0]),
    (Op::Assign, &[PageBitOut], [19, 19], [19, 19], [0, 0]),
    (Op::Set, &[FarBitOut, Byte], [902, 909], [0, 1107], [0, 0]),
    (Op::Set, &[FarBitOut, Count], [20, 20], [67, 67], [0, 0]),
    (Op::Set, &[PageBitOut, One], [16, 16], [22, 22], [0, 0]),
    (Op::Reset, &[FarBitReset, Byte], [901, 908], [348, 1136], [0, 0]),
    (Op::Reset, &[FarBitReset, Count], [20, 20], [67, 67], [0, 0]),
    (Op::Reset, &[PageBitReset, One], [16, 16], [22, 22], [0, 0]),
    (Op::ResetTimers, &[TimerNumber, Byte], [20, 20], [0, 50], [0, 0]),
    (Op::ResetTimers, &[TimerNumber, Count], [22, 22], [0, 43], [0, 0]),
    (Op::ResetCounters, &[CounterNumber, Byte], [20, 20], [0, 46], [0, 0]),
    (Op::ResetCounters, &[CounterNumber, Count], [22, 22], [0, 39], [0, 0]),
    (Op::Nop, &[Number], [14, 14], [14, 14], [0, 0]),
    (Op::Ald, &[], [17, 17], [17, 17], [0, 0]),
    (Op::Old, &[], [17, 17], [17, 17], [0, 0]),
    (Op::Lps, &[], [16, 16], [16, 16], [0, 0]),
    (Op::Lrd, &[], [15, 15], [15, 15], [0, 0]),
    (Op::Lpp, &[], [16, 16], [16, 16], [0, 0]),
    (Op::Lds, &[Level], [27, 27], [27, 27], [0, 0]),
    (Op::Ldw, &[Relation, AnyInt, AnyInt], [97, 110], [97, 110], [0, 0]),
    (Op::Ldw, &[Relation, Word, IntConst], [45, 45], [45, 45], [0, 0]),
    (Op::Ldw, &[Relation, Word, Word], [51, 51], [51, 51], [0, 0]),
    (Op::Aw, &[Relation, AnyInt, AnyInt], [106, 118], [105, 118], [0, 0]),
    (Op::Aw, &[Relation, Word, IntConst], [42, 42], [42, 42], [0, 0]),
    (Op::Aw, &[Relation, Word, Word], [48, 48], [48, 48], [0, 0]),
    (Op::Ow, &[Relation, AnyInt, AnyInt], [112, 125], [112, 125], [0, 0]),
    (Op::Ow, &[Relation, Word, IntConst], [42, 42], [42, 42], [0, 0]),
    (Op::Ow, &[Relation, Word, Word], [48, 48], [48, 48], [0, 0]),
    (Op::Ldb, &[Relation, AnyByte, AnyByte], [96, 108], [96, 108], [0, 0]),
    (Op::Ldb, &[Relation, Byte, ByteConst], [57, 63], [57, 63], [0, 0]),
    (Op::Ldb, &[Relation, Byte, Byte], [65, 71], [65, 71], [0, 0]),
    (Op::Ab, &[Relation, AnyByte, AnyByte], [104, 116], [104, 116], [0, 0]),
    (Op::Ab, &[Relation, Byte, ByteConst], [65, 71], [65, 71], [0, 0]),
    (Op::Ab, &[Relation, Byte, Byte], [73, 79], [73, 79], [0, 0]),
    (Op::Ob, &[Relation, AnyByte, AnyByte], [111, 123], [111, 123], [0, 0]),
    (Op::Ob, &[Relation, Byte, ByteConst], [72, 78], [72, 78], [0, 0]),
    (Op::Ob, &[Relation, Byte, Byte], [80, 86], [80, 86], [0, 0]),
    (Op::Movb, &[Byte, ByteOut], [22, 22], [45, 45], [0, 0]),
    (Op::Movb, &[ByteConst, ByteOut], [20, 20], [38, 38], [0, 0]),
    (Op::Movw, &[Word, WordOut], [18, 18], [41, 41], [0, 0]),
    (Op::Movw, &[WordConst, WordOut], [18, 18], [34, 34], [0, 0]),
    (Op::AddInt, &[IntConst, WordOut], [22, 22], [50, 55], [0, 0]),
    (Op::AddInt, &[Word, WordOut], [22, 22], [54, 59], [0, 0]),
    (Op::SubInt, &[IntConst, WordOut], [22, 22], [50, 55], [0, 0]),
    (Op::SubInt, &[Word, WordOut], [22, 22], [54, 59], [0, 0]),
    (Op::MulInt, &[IntConst, WordOut], [22, 22], [87, 98], [0, 0]),
    (Op::MulInt, &[Word, WordOut], [22, 22], [91, 102], [0, 0]),
    (Op::DivInt, &[IntConst, WordOut], [22, 22], [58, 346], [0, 0]),
    (Op::DivInt, &[Word, WordOut], [22, 22], [62, 347], [0, 0]),
    (Op::Incw, &[WordOut], [22, 22], [49, 51], [0, 0]),
    (Op::Decw, &[WordOut], [22, 22], [49, 51], [0, 0]),
    (Op::Ton, &[TimerSlot, IntConst], [102, 107], [117, 143], [0, 0]),
    (Op::Ton, &[TimerSlot, Word], [111, 116], [126, 152], [0, 0]),
    (Op::Tof, &[TimerSlot, IntConst], [96, 150], [104, 109], [0, 0]),
    (Op::Tof, &[TimerSlot, Word], [105, 159], [113, 118], [0, 0]),
    (Op::Tonr, &[TimerSlot, IntConst], [92, 95], [125, 140], [0, 0]),
    (Op::Tonr, &[TimerSlot, Word], [101, 104], [134, 149], [0, 0]),
    (Op::Ctu, &[CounterSlot, IntConst], [118, 123], [109, 109], [0, 0]),
    (Op::Ctu, &[CounterSlot, Word], [127, 132], [118, 118], [0, 0]),
    (Op::Ctd, &[CounterSlot, IntConst], [122, 125], [110, 110], [0, 0]),
    (Op::Ctd, &[CounterSlot, Word], [131, 134], [119, 119], [0, 0]),
    (Op::Ctud, &[CounterSlot, IntConst], [125, 127], [111, 111], [0, 0]),
    (Op::Ctud, &[CounterSlot, Word], [134, 136], [120, 120], [0, 0]),
    (Op::For, &[WordOut, AnyInt, AnyInt, LoopEnd], [0, 0], [79, 81], [29, 88]),
    (Op::Next, &[LoopStart, Here], [75, 82], [75, 82], [81, 88]),
    (Op::Jmp, &[LabelIndex, Here], [17, 17], [36, 36], [36, 43]),
    (Op::Lbl, &[LabelNumber], [14, 14], [14, 14], [0, 0]),
    (Op::End, &[], [15, 15], [0, 0], [21, 21]),
    (Op::Stop, &[], [15, 15], [0, 0], [35, 35]),
    (Op::Wdr, &[], [20, 20], [73, 73], [0, 0]),
    (Op::Refresh, &[], [211, 211], [211, 211], [0, 0]),
    (Op::MainEnd, &[], [0, 0], [0, 0], [19, 19]),
];
