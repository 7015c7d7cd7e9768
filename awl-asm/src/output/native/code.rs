//! Machine code being written: instructions and labels first, addresses at the end, when every jump
//! has its length.

use super::avr::{Avr, BRANCH_WORDS, Condition, Constant, RJMP_WORDS, Reg};
use super::vectors::Vector;
use crate::output::cycles::Cycles;

/// A place in the code, known before it is reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Label {
    number: usize,
    /// Whether who goes there leaves the instruction of the program.
    leaves: bool,
}

/// A bytecode instruction that the firmware is asked to execute: its number among the pieces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Piece(usize);

/// How far a jump can go.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Reach {
    /// A branch alone; for jumps and calls the same as [`Near`](Reach::Near).
    Short,
    /// `rjmp` or `rcall`.
    Near,
    /// `jmp` or `call`.
    Far,
}

#[derive(Debug, Clone, Copy)]
enum Item {
    Op(Avr),
    Label(Label),
    Branch(Condition, Label, Reach),
    Jump(Label, Reach),
    Call(Vector, Cycles),
    CallRoutine(Label, Reach),
    /// Loads Z with the address of a piece.
    PieceAddress(Piece),
}

/// An instruction with its flash address.
#[derive(Debug, Clone, Copy)]
pub struct Placed {
    /// Its address in bytes.
    pub at: u32,
    /// The instruction.
    pub op: Avr,
    /// What the called routine takes, if it calls one.
    pub callee: Cycles,
    /// Whether a taken branch leaves the instruction of the program.
    pub leaves: bool,
}

/// Code with labels.
#[derive(Debug, Default)]
pub struct Code {
    items: Vec<Item>,
    labels: usize,
    pieces: Vec<Vec<u8>>,
}

/// Code with addresses.
#[derive(Debug)]
pub struct PlacedCode {
    /// The instructions in order.
    pub ops: Vec<Placed>,
    /// For each [mark](Code::mark) from 0 to the last the number of instructions before it.
    marks: Vec<usize>,
    labels: Vec<u32>,
    /// One past the last address.
    pub end: u32,
}

impl PlacedCode {
    /// The instructions between two marks.
    pub fn between(&self, first: usize, last: usize) -> &[Placed] {
        let at = |mark: usize| self.marks.get(mark).copied().unwrap_or(self.ops.len());
        self.ops.get(at(first)..at(last)).unwrap_or(&[])
    }

    /// Address of a mark.
    pub fn address(&self, mark: usize) -> u32 {
        let index = self.marks.get(mark).copied().unwrap_or(self.ops.len());
        self.ops.get(index).map_or(self.end, |placed| placed.at)
    }

    /// Address of a label.
    pub fn label(&self, label: Label) -> u32 {
        self.labels.get(label.number).copied().unwrap_or(self.end)
    }
}

impl Code {
    /// A label within an instruction of the program, which is nowhere yet.
    pub fn label(&mut self) -> Label {
        self.labels += 1;
        Label { number: self.labels - 1, leaves: false }
    }

    /// A label to which instructions of the program lead.
    pub fn target(&mut self) -> Label {
        Label { leaves: true, ..self.label() }
    }

    /// The label is here.
    pub fn bind(&mut self, label: Label) {
        self.items.push(Item::Label(label));
    }

    /// Where the next instruction will be, for [`PlacedCode::between`].
    pub fn mark(&self) -> usize {
        self.items.len()
    }

    /// Appends an instruction.
    pub fn op(&mut self, op: Avr) {
        self.items.push(Item::Op(op));
    }

    /// Appends a branch.
    pub fn branch(&mut self, condition: Condition, to: Label) {
        self.items.push(Item::Branch(condition, to, Reach::Short));
    }

    /// Appends a jump.
    pub fn jump(&mut self, to: Label) {
        self.items.push(Item::Jump(to, Reach::Short));
    }

    /// Appends the call of a routine that takes so long.
    pub fn call(&mut self, vector: Vector, cycles: Cycles) {
        self.items.push(Item::Call(vector, cycles));
    }

    /// Appends the call of a routine of this code.
    pub fn call_routine(&mut self, to: Label) {
        self.items.push(Item::CallRoutine(to, Reach::Short));
    }

    /// Appends the load of Z with the address of a bytecode piece. Equal pieces are stored once.
    pub fn piece_address(&mut self, piece: Vec<u8>) {
        let known = self.pieces.iter().position(|other| *other == piece);
        let index = known.unwrap_or(self.pieces.len());
        if known.is_none() {
            self.pieces.push(piece);
        }
        self.items.push(Item::PieceAddress(Piece(index)));
    }

    /// The pieces, one after the other.
    pub fn pieces(&self) -> Vec<u8> {
        self.pieces.concat()
    }

    /// Gives everything its address: the pieces are at `pieces_at`, the code begins at `start`.
    /// What is too far away for a short jump gets a longer one.
    pub fn place(mut self, pieces_at: u32, start: u32) -> PlacedCode {
        let mut addresses = self.addresses(start);
        while self.lengthen(&addresses) {
            addresses = self.addresses(start);
        }
        let labels = self.label_addresses(&addresses);
        let mut placed = PlacedCode { ops: Vec::new(), marks: Vec::new(), labels, end: start };
        for (item, at) in self.items.iter().zip(&addresses) {
            placed.marks.push(placed.ops.len());
            self.expand(*item, *at, pieces_at, &mut placed);
        }
        placed.end = addresses.last().copied().unwrap_or(start);
        placed
    }

    /// The address of each item, and the end.
    fn addresses(&self, start: u32) -> Vec<u32> {
        let ends = self.items.iter().scan(start, |at, item| {
            *at += 2 * item.words();
            Some(*at)
        });
        [start].into_iter().chain(ends).collect()
    }

    fn label_addresses(&self, addresses: &[u32]) -> Vec<u32> {
        let mut labels = vec![0; self.labels];
        for (item, &at) in self.items.iter().zip(addresses) {
            if let Item::Label(label) = item {
                labels[label.number] = at;
            }
        }
        labels
    }

    /// Lengthens jumps that do not reach their label. Returns whether there were any.
    fn lengthen(&mut self, addresses: &[u32]) -> bool {
        let labels = self.label_addresses(addresses);
        let mut changed = false;
        for (item, &at) in self.items.iter_mut().zip(addresses) {
            let words = item.words();
            let (to, reach) = match item {
                Item::Branch(_, to, reach)
                | Item::Jump(to, reach)
                | Item::CallRoutine(to, reach) => (to, reach),
                _ => continue,
            };
            let distance = (i64::from(labels[to.number]) - i64::from(at)) / 2 - i64::from(words);
            // The jump of a longer form ends where the item ends, so that the distance stays the
            // same.
            let needed = if is_between(distance, BRANCH_WORDS) {
                Reach::Short
            } else if is_between(distance, RJMP_WORDS) {
                Reach::Near
            } else {
                Reach::Far
            };
            if needed as u8 > *reach as u8 {
                *reach = needed;
                changed |= item.words() != words;
            }
        }
        changed
    }

    fn expand(&self, item: Item, at: u32, pieces_at: u32, placed: &mut PlacedCode) {
        let to = |label: Label| placed.labels.get(label.number).copied().unwrap_or(0) as u16;
        let jump = |label: Label, reach: Reach| match reach {
            Reach::Far => Avr::Jmp(to(label)),
            _ => Avr::Rjmp(to(label)),
        };
        let mut ops = Vec::with_capacity(2);
        let mut callee = Cycles::default();
        match item {
            Item::Op(op) => ops.push(op),
            Item::Label(_) => {}
            Item::Branch(condition, label, Reach::Short) => {
                ops.push(Avr::Branch(condition, to(label)))
            }
            Item::Branch(condition, label, reach) => {
                ops.push(Avr::Branch(condition.inverted(), (at + 2 * item.words()) as u16));
                ops.push(jump(label, reach));
            }
            Item::Jump(label, reach) => ops.push(jump(label, reach)),
            Item::CallRoutine(label, Reach::Far) => ops.push(Avr::Call(to(label))),
            Item::CallRoutine(label, _) => ops.push(Avr::Rcall(to(label))),
            Item::Call(vector, cycles) => {
                ops.push(Avr::Call(vector.address()));
                callee = cycles;
            }
            Item::PieceAddress(Piece(index)) => {
                let before: usize = self.pieces.iter().take(index).map(Vec::len).sum();
                let [low, high] = ((pieces_at as usize + before) as u16).to_le_bytes();
                ops.extend([
                    Avr::Constant(Constant::Ldi, Reg(30), low),
                    Avr::Constant(Constant::Ldi, Reg(31), high),
                ]);
            }
        }
        let mut at = at;
        for op in ops {
            // Of a longer form only the jump leaves.
            let leaves = item.leaves() && !(matches!(op, Avr::Branch(..)) && item.words() > 1);
            placed.ops.push(Placed { at, op, callee, leaves });
            at += 2 * u32::from(op.words());
        }
    }
}

fn is_between(distance: i64, words: i32) -> bool {
    (-i64::from(words) - 1..=i64::from(words)).contains(&distance)
}

impl Item {
    fn leaves(&self) -> bool {
        matches!(self, Item::Branch(_, to, _) | Item::Jump(to, _) if to.leaves)
    }

    fn words(&self) -> u32 {
        match self {
            Item::Op(op) => u32::from(op.words()),
            Item::Label(_) => 0,
            Item::Branch(_, _, reach) => 1 + reach.jump_words() * u32::from(*reach != Reach::Short),
            Item::Jump(_, reach) | Item::CallRoutine(_, reach) => reach.jump_words(),
            Item::Call(..) | Item::PieceAddress(_) => 2,
        }
    }
}

impl Reach {
    fn jump_words(self) -> u32 {
        if self == Reach::Far { 2 } else { 1 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What leads over so many words, backward or forward.
    #[derive(Clone, Copy)]
    enum Over {
        Branch,
        Jump,
        Call,
    }

    fn over(words: usize, way: Over, backward: bool) -> (Vec<Placed>, u32) {
        let mut code = Code::default();
        let label = code.target();
        let filler = |code: &mut Code| (0..words).for_each(|_| code.op(Avr::Set));
        if backward {
            code.bind(label);
            filler(&mut code);
        }
        match way {
            Over::Branch => code.branch(Condition::T_SET, label),
            Over::Jump => code.jump(label),
            Over::Call => code.call_routine(label),
        }
        if !backward {
            filler(&mut code);
            code.bind(label);
        }
        let placed = code.place(0x6000, 0x6100);
        let target = placed.label(label);
        let jumps = placed.ops.into_iter().filter(|placed| placed.op != Avr::Set).collect();
        (jumps, target)
    }

    #[test]
    fn jumps_are_as_long_as_they_must_be() {
        let lengths = |words, way, backward| {
            let (jumps, target) = over(words, way, backward);
            let Some(last) = jumps.last() else { return 0 };
            let leads_to = match last.op {
                Avr::Branch(_, to)
                | Avr::Rjmp(to)
                | Avr::Jmp(to)
                | Avr::Rcall(to)
                | Avr::Call(to) => u32::from(to),
                _ => 0,
            };
            assert_eq!(leads_to, target);
            let leaving = jumps.iter().filter(|placed| placed.leaves).count();
            assert_eq!(
                (last.leaves, leaving),
                if matches!(way, Over::Call) { (false, 0) } else { (true, 1) }
            );
            jumps.iter().map(|placed| placed.op.words()).sum()
        };
        for (words, expected) in [(0, 1), (63, 1), (64, 2), (2047, 2), (2048, 3)] {
            assert_eq!(
                lengths(words, Over::Branch, false),
                expected,
                "a branch over {words} words"
            );
        }
        for (words, expected) in [(0, 1), (63, 1), (64, 2), (2046, 2), (2047, 3)] {
            assert_eq!(
                lengths(words, Over::Branch, true),
                expected,
                "a branch back over {words} words"
            );
        }
        for (words, expected) in [(0, 1), (2047, 1), (2048, 2)] {
            for way in [Over::Jump, Over::Call] {
                assert_eq!(lengths(words, way, false), expected, "a jump over {words} words");
                assert_eq!(lengths(words, way, true), expected, "a jump back over {words} words");
            }
        }
    }

    #[test]
    fn the_branch_of_a_longer_form_goes_over_its_jump() {
        for words in [64, 2048] {
            let (jumps, _) = over(words, Over::Branch, false);
            let behind = jumps[1].at + 2 * u32::from(jumps[1].op.words());
            assert_eq!(jumps[0].op, Avr::Branch(Condition::T_CLEAR, behind as u16));
        }
    }

    #[test]
    fn equal_pieces_are_stored_once() {
        let mut code = Code::default();
        for piece in [vec![1, 2], vec![3], vec![1, 2]] {
            code.piece_address(piece);
        }
        assert_eq!(code.pieces(), [1, 2, 3]);
        let ops: Vec<Avr> = code.place(0x60FE, 0x7000).ops.iter().map(|placed| placed.op).collect();
        let z = |low, high| {
            [
                Avr::Constant(Constant::Ldi, Reg(30), low),
                Avr::Constant(Constant::Ldi, Reg(31), high),
            ]
        };
        assert_eq!(ops, [z(0xFE, 0x60), z(0x00, 0x61), z(0xFE, 0x60)].concat());
    }
}
