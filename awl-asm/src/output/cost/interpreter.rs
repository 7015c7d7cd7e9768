//! Cycles of the interpreter on the board, for each form of an instruction. Measured on the
//! simulated board: `cargo run -p tests --features tests/uno --bin measure -- table` prints such
//! lines. A form that is new gets its line from there; others differ by a cycle or two from run to
//! run and stay.

use plc_isa::Kind::{
    AnyByte, AnyInt, Byte, ByteConst, ByteOut, CallEnd, Count, CounterNumber, CounterSlot, Edge,
    ErrorMask, Event, FarBit, FarBitOut, FarBitReset, Here, IntConst, LabelIndex, LabelNumber,
    Level, LoopEnd, LoopStart, Number, One, PageBit, PageBitOut, PageBitReset, Relation, Routine,
    ScrBit, SegmentEnd, TimerNumber, TimerSlot, Word, WordConst, WordOut,
};
use plc_isa::{Decoded, Kind, Op, Operand, Plan, PowerFlow, ProgramMemory, decode};

use super::typical;
use super::ways::{Ways, is_fast};
use crate::output::cycles::Cycles;

/// From entering the engine to the first instruction; the way out belongs to what leaves the
/// program.
pub const START: u32 = 43;

/// When a millisecond has passed, the next jump back asks the watchdog and the next timer of 1 ms
/// advances all of them, which looks at each timer of the program.
pub const EACH_MS: u32 = 300;
/// See [`EACH_MS`].
pub const EACH_MS_AND_TIMER: u32 = 700;

/// What looks for interrupt events takes for each millisecond since the last look, and for each
/// event: 300 to find it, 220 for the return from its routine.
pub const EACH_MS_LOOKING: u32 = 150;
/// See [`EACH_MS_LOOKING`].
pub const EVENT: u32 = 520;

/// Fewest and most cycles; none for a way that there is not.
type Range = [u16; 2];

/// A form: to the next instruction without and with power flow, and to elsewhere. What operands add
/// is in [`more`].
type Entry = (Op, &'static [Kind], Range, Range, Range);

/// What the form of an instruction costs, with its operands. `count` is what S or R reads for a
/// count in the scan, if that is known.
pub fn ways<P: ProgramMemory>(
    decoded: &Decoded,
    plan: &Plan<P>,
    image: &[u8],
    count: Option<u32>,
) -> Ways {
    let kinds: Vec<Kind> = decoded.operands().map(|(kind, _)| kind).collect();
    let entry = TABLE.iter().find(|(op, of, ..)| *op == decoded.op && *of == kinds);
    let Some(&(.., off, on, away)) = entry else { return typical::ways(decoded, image) };
    let more = more(decoded, plan, image, count);
    let way = |[min, max]: Range, more: u32| {
        (max > 0).then(|| Cycles { min: u32::from(min) + more, max: u32::from(max) + more })
    };
    // A box without power flow does not look at its operands.
    let is_box = decoded.op.instruction().power_flow == PowerFlow::Needed;
    Ways { off: way(off, if is_box { 0 } else { more }), on: way(on, more), away: way(away, more) }
}

/// Fewest and most cycles of a form with power flow, without what its operands add; `None` where
/// nothing was measured.
pub fn of_form(op: Op, kinds: &[Kind]) -> Option<[u16; 2]> {
    let &(.., on, _) = TABLE.iter().find(|(of, with, ..)| *of == op && *with == kinds)?;
    (on[1] > 0).then_some(on)
}

/// The most bits that S and R write, and how many timers and counters there are.
const COUNT_MAX: u32 = 255;
const NUMBERS: u32 = 256;
/// For each bit of a range, and for each time the range goes on in another byte.
const BIT: u32 = 6;
const BYTE: u32 = 18;
/// For each byte of a range whose length is read in the scan: plc-vm writes that.
const COUNTED_BYTE: u32 = 89;
/// It looks for the end of the area, through the ranges of V memory that the program has.
const COUNTED_V_RANGE: u32 = 40;
/// R of timers and counters, and for each of the program's that R looks at.
const RESET: u32 = 59;
const RESET_SLOT: u32 = 27;
/// For each level that LDS reaches down.
const LEVEL: u32 = 6;
/// A timer of 1 ms is brought up to date when it is executed.
const FAST_TIMER: u32 = 74;
/// FOR and NEXT read INIT and FINAL: a word takes longer than a constant.
const LOOP_WORD: u32 = 6;

/// What the operands of an instruction add to its form's cycles.
pub fn more<P: ProgramMemory>(
    decoded: &Decoded,
    plan: &Plan<P>,
    image: &[u8],
    count: Option<u32>,
) -> u32 {
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
                + COUNTED_V_RANGE * u32::from(plan.header.v_ranges)
        }
        (Op::Set | Op::Reset, [(_, Operand::Bit(bit)), (kind, _)]) if *kind != One => {
            bits(bit.bit.into(), number(1))
        }
        (Op::ResetTimers, _) => numbers(number(0), number(1), count, plan.header.timers),
        (Op::ResetCounters, _) => numbers(number(0), number(1), count, plan.header.counters),
        _ if is_fast(plan, decoded) => FAST_TIMER,
        (Op::For, [_, init, last, _]) => words(&[*init, *last]),
        (Op::Next, [(_, Operand::Offset(start)), _]) => {
            let head = decode(&image, *start)
                .map(|head| head.operands().skip(1).take(2).collect::<Vec<_>>());
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
    operands
        .iter()
        .map(|(_, operand)| if matches!(operand, Operand::Memory(_)) { LOOP_WORD } else { 0 })
        .sum()
}

const TABLE: &[Entry] = &[
    (Op::Ld, &[FarBit], [59, 59], [59, 59], [0, 0]),
    (Op::Ld, &[PageBit], [18, 18], [18, 18], [0, 0]),
    (Op::Ldn, &[FarBit], [58, 58], [58, 58], [0, 0]),
    (Op::Ldn, &[PageBit], [19, 19], [19, 19], [0, 0]),
    (Op::A, &[FarBit], [56, 56], [56, 56], [0, 0]),
    (Op::A, &[PageBit], [17, 17], [17, 17], [0, 0]),
    (Op::An, &[FarBit], [55, 55], [55, 55], [0, 0]),
    (Op::An, &[PageBit], [17, 17], [17, 17], [0, 0]),
    (Op::O, &[FarBit], [56, 56], [56, 56], [0, 0]),
    (Op::O, &[PageBit], [17, 17], [17, 17], [0, 0]),
    (Op::On, &[FarBit], [55, 55], [55, 55], [0, 0]),
    (Op::On, &[PageBit], [17, 17], [17, 17], [0, 0]),
    (Op::Not, &[], [14, 14], [14, 14], [0, 0]),
    (Op::Eu, &[Edge], [76, 76], [76, 76], [0, 0]),
    (Op::Ed, &[Edge], [77, 78], [77, 77], [0, 0]),
    (Op::Assign, &[FarBitOut], [56, 56], [56, 56], [0, 0]),
    (Op::Assign, &[PageBitOut], [18, 18], [18, 18], [0, 0]),
    (Op::Set, &[FarBitOut, Count], [19, 19], [66, 66], [0, 0]),
    (Op::Set, &[PageBitOut, One], [15, 15], [21, 21], [0, 0]),
    (Op::Reset, &[FarBitReset, Count], [19, 19], [66, 66], [0, 0]),
    (Op::Reset, &[PageBitReset, One], [15, 15], [21, 21], [0, 0]),
    (Op::ResetTimers, &[TimerNumber, Byte], [19, 19], [0, 67], [0, 0]),
    (Op::ResetTimers, &[TimerNumber, Count], [21, 21], [0, 60], [0, 0]),
    (Op::ResetCounters, &[CounterNumber, Byte], [19, 19], [10, 67], [0, 0]),
    (Op::ResetCounters, &[CounterNumber, Count], [21, 21], [5, 62], [0, 0]),
    (Op::Nop, &[Number], [13, 13], [13, 13], [0, 0]),
    (Op::Ald, &[], [14, 14], [14, 14], [0, 0]),
    (Op::Old, &[], [14, 14], [14, 14], [0, 0]),
    (Op::Lps, &[], [13, 13], [13, 13], [0, 0]),
    (Op::Lrd, &[], [12, 12], [12, 12], [0, 0]),
    (Op::Lpp, &[], [13, 13], [13, 13], [0, 0]),
    (Op::Lds, &[Level], [26, 26], [26, 26], [0, 0]),
    (Op::Ldw, &[Relation, AnyInt, AnyInt], [96, 109], [96, 109], [0, 0]),
    (Op::Ldw, &[Relation, Word, IntConst], [35, 35], [35, 35], [0, 0]),
    (Op::Ldw, &[Relation, Word, Word], [50, 50], [50, 50], [0, 0]),
    (Op::Aw, &[Relation, AnyInt, AnyInt], [104, 117], [104, 117], [0, 0]),
    (Op::Aw, &[Relation, Word, IntConst], [32, 32], [32, 32], [0, 0]),
    (Op::Aw, &[Relation, Word, Word], [47, 47], [47, 47], [0, 0]),
    (Op::Ow, &[Relation, AnyInt, AnyInt], [111, 124], [111, 124], [0, 0]),
    (Op::Ow, &[Relation, Word, IntConst], [41, 41], [41, 41], [0, 0]),
    (Op::Ow, &[Relation, Word, Word], [47, 47], [47, 47], [0, 0]),
    (Op::Ldb, &[Relation, AnyByte, AnyByte], [95, 107], [95, 107], [0, 0]),
    (Op::Ldb, &[Relation, Byte, ByteConst], [57, 63], [57, 63], [0, 0]),
    (Op::Ldb, &[Relation, Byte, Byte], [65, 71], [65, 71], [0, 0]),
    (Op::Ab, &[Relation, AnyByte, AnyByte], [103, 115], [103, 115], [0, 0]),
    (Op::Ab, &[Relation, Byte, ByteConst], [65, 71], [65, 71], [0, 0]),
    (Op::Ab, &[Relation, Byte, Byte], [73, 79], [73, 79], [0, 0]),
    (Op::Ob, &[Relation, AnyByte, AnyByte], [110, 122], [110, 122], [0, 0]),
    (Op::Ob, &[Relation, Byte, ByteConst], [72, 78], [72, 78], [0, 0]),
    (Op::Ob, &[Relation, Byte, Byte], [80, 86], [80, 86], [0, 0]),
    (Op::Movb, &[Byte, ByteOut], [19, 19], [44, 44], [0, 0]),
    (Op::Movb, &[ByteConst, ByteOut], [19, 19], [37, 37], [0, 0]),
    (Op::Movw, &[Word, WordOut], [17, 17], [40, 40], [0, 0]),
    (Op::Movw, &[WordConst, WordOut], [17, 17], [33, 33], [0, 0]),
    (Op::AddInt, &[IntConst, WordOut], [19, 19], [49, 54], [0, 0]),
    (Op::AddInt, &[Word, WordOut], [19, 19], [53, 58], [0, 0]),
    (Op::SubInt, &[IntConst, WordOut], [19, 19], [49, 54], [0, 0]),
    (Op::SubInt, &[Word, WordOut], [19, 19], [53, 58], [0, 0]),
    (Op::MulInt, &[IntConst, WordOut], [19, 19], [86, 97], [0, 0]),
    (Op::MulInt, &[Word, WordOut], [19, 19], [90, 101], [0, 0]),
    (Op::DivInt, &[IntConst, WordOut], [19, 19], [57, 350], [0, 0]),
    (Op::DivInt, &[Word, WordOut], [19, 19], [61, 349], [0, 0]),
    (Op::Incw, &[WordOut], [21, 21], [48, 50], [0, 0]),
    (Op::Decw, &[WordOut], [21, 21], [48, 50], [0, 0]),
    (Op::Ton, &[TimerSlot, IntConst], [101, 112], [116, 142], [0, 0]),
    (Op::Ton, &[TimerSlot, Word], [110, 121], [125, 151], [0, 0]),
    (Op::Tof, &[TimerSlot, IntConst], [95, 149], [103, 114], [0, 0]),
    (Op::Tof, &[TimerSlot, Word], [104, 158], [112, 123], [0, 0]),
    (Op::Tonr, &[TimerSlot, IntConst], [94, 100], [127, 139], [0, 0]),
    (Op::Tonr, &[TimerSlot, Word], [103, 109], [136, 148], [0, 0]),
    (Op::Ctu, &[CounterSlot, IntConst], [117, 122], [108, 108], [0, 0]),
    (Op::Ctu, &[CounterSlot, Word], [126, 132], [117, 117], [0, 0]),
    (Op::Ctd, &[CounterSlot, IntConst], [121, 124], [109, 109], [0, 0]),
    (Op::Ctd, &[CounterSlot, Word], [130, 133], [118, 118], [0, 0]),
    (Op::Ctud, &[CounterSlot, IntConst], [124, 126], [110, 110], [0, 0]),
    (Op::Ctud, &[CounterSlot, Word], [133, 135], [119, 119], [0, 0]),
    (Op::For, &[WordOut, AnyInt, AnyInt, LoopEnd], [0, 0], [78, 80], [33, 92]),
    (Op::Next, &[LoopStart, Here], [74, 81], [74, 81], [83, 90]),
    (Op::Jmp, &[LabelIndex, Here], [16, 16], [39, 39], [39, 44]),
    (Op::Lbl, &[LabelNumber], [13, 13], [13, 13], [0, 0]),
    (Op::End, &[], [14, 14], [0, 0], [29, 29]),
    (Op::Stop, &[], [14, 14], [0, 0], [42, 42]),
    (Op::Wdr, &[], [19, 19], [49, 49], [0, 0]),
    (Op::Refresh, &[], [76, 76], [76, 76], [0, 0]),
    (Op::Approach, &[], [18, 18], [18, 18], [0, 0]),
    (Op::Lscr, &[FarBit, ScrBit], [113, 113], [113, 113], [0, 0]),
    (Op::ScrAnd, &[FarBit], [56, 56], [56, 56], [0, 0]),
    (Op::Scrt, &[FarBitOut, ScrBit], [18, 18], [136, 136], [0, 0]),
    (Op::Scre, &[], [11, 11], [11, 11], [0, 0]),
    (Op::Cscre, &[SegmentEnd, Here], [16, 16], [0, 0], [39, 39]),
    (Op::CallBegin, &[CallEnd], [0, 0], [20, 20], [27, 27]),
    (Op::BitCopy, &[FarBit, FarBitOut], [118, 118], [118, 118], [0, 0]),
    (Op::Call, &[Routine, Here], [17, 17], [0, 0], [54, 54]),
    (Op::Ret, &[], [0, 0], [0, 0], [32, 34]),
    (Op::Cret, &[], [12, 12], [0, 0], [34, 34]),
    (Op::Creti, &[], [12, 12], [0, 0], [34, 34]),
    (Op::AnalogOutputs, &[Number], [82, 82], [161, 280], [0, 0]),
    (Op::Poll, &[Here], [31, 997], [31, 997], [453, 1309]),
    (Op::Atch, &[Routine, Event], [49, 49], [141, 300], [0, 0]),
    (Op::Dtch, &[Event], [44, 44], [349, 700], [0, 0]),
    (Op::Cevnt, &[Event], [44, 44], [279, 700], [0, 0]),
    (Op::Eni, &[], [43, 43], [66, 66], [0, 0]),
    (Op::Disi, &[], [43, 43], [66, 66], [0, 0]),
    (Op::NoteEno, &[ErrorMask], [24, 24], [24, 24], [0, 0]),
    (Op::Aeno, &[ErrorMask], [22, 26], [22, 26], [0, 0]),
    (Op::MainEnd, &[], [0, 0], [0, 0], [27, 27]),
];

#[cfg(test)]
mod tests {
    use plc_isa::{INSTRUCTIONS, Instruction};

    use super::*;

    #[test]
    fn every_form_has_an_entry_and_none_has_two() {
        // What modules cost is apart, but for a hidden instruction, which has no row of its own.
        let is_measured =
            |row: &&Instruction| row.module().is_none() || row.op == Op::AnalogOutputs;
        let rows = INSTRUCTIONS.iter().filter(is_measured);
        let forms = rows.flat_map(|row| row.forms.iter().map(move |form| (row.op, form.kinds)));
        let entries = |op: Op, kinds: &[Kind]| {
            TABLE.iter().filter(|(of, like, ..)| (*of, *like) == (op, kinds)).count()
        };
        let wrong: Vec<_> = forms.clone().filter(|(op, kinds)| entries(*op, kinds) != 1).collect();
        assert!(wrong.is_empty(), "{wrong:?}");
        assert_eq!(TABLE.len(), forms.count(), "entries of forms that there are not");
    }
}
