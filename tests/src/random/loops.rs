//! Loops of a random program: FOR with its bounds, and jumps backward. All of them end.

use plc_isa::{AnalogInput, Op, Relation};

use super::operand_text::OperandText;
use super::{Generator, PASSES_MAX};

/// The first or last value of a loop.
struct Bound {
    place: OperandText,
    /// The values it can have.
    least: i32,
    most: i32,
    /// Whether the program must write it first.
    is_assigned: bool,
}

/// Loops.
impl Generator<'_> {
    /// A jump backward, bounded by a count that nothing else writes.
    pub(super) fn repeated_part(&mut self) {
        let (Some(label), Some(count)) = (self.unused_labels.pop(), self.writable_word()) else {
            return;
        };
        let passes = self.rng.u32(1..=3);
        self.network();
        self.assign("0", &count);
        let before = self.enter(&[&count], passes);
        self.label(label);
        self.block();
        self.network();
        self.fixed(Op::Ld, &["SM0.0"]);
        self.fixed(Op::Incw, &[&count.text]);
        let row = Op::Ldw.instruction();
        self.line(
            row,
            Some(Relation::Less),
            &[count.text.clone(), passes.to_string()],
            &row.forms[1],
        );
        self.fixed(Op::Jmp, &[&label.to_string()]);
        self.restore(before);
    }

    pub(super) fn for_loop(&mut self) {
        let Some(index) = self.writable_word() else { return };
        let (init, last) = self.loop_bounds();
        let passes = (last.most - init.least + 1).max(1) as u32;
        if self.passes * passes > PASSES_MAX
            || index.overlaps(&last.place)
            || index.overlaps(&init.place)
        {
            return;
        }
        self.network();
        for bound in [&init, &last] {
            if bound.is_assigned {
                self.assign(&bound.least.to_string(), &bound.place);
            }
        }
        self.logic();
        self.fixed(Op::For, &[&index.text, &init.place.text, &last.place.text]);
        let before = self.enter(&[&index, &last.place], passes);
        self.loops += 1;
        if self.one_in(3) {
            self.outputs();
        }
        self.block();
        self.loops -= 1;
        self.network();
        self.fixed(Op::Next, &[]);
        self.restore(before);
        if self.one_in(3) {
            self.outputs();
        }
    }

    /// Writes a constant into a word, whatever the power flow.
    fn assign(&mut self, value: &str, word: &OperandText) {
        self.fixed(Op::Ld, &["SM0.0"]);
        self.fixed(Op::Movw, &[value, &word.text]);
    }

    fn enter(&mut self, words: &[&OperandText], passes: u32) -> (usize, u32) {
        let before = (self.protected.len(), self.passes);
        self.protected.extend(words.iter().filter_map(|word| word.extent.clone()));
        self.passes *= passes;
        before
    }

    fn restore(&mut self, (protected, passes): (usize, u32)) {
        self.protected.truncate(protected);
        self.passes = passes;
    }
}

/// Loop bounds.
impl Generator<'_> {
    fn loop_bounds(&mut self) -> (Bound, Bound) {
        let (init, last) = match self.rng.u32(..20) {
            0 => (32766, 32767),
            1 => (32767, 32767),
            2 => (-32768, -32767),
            3 => (32767, -32768),
            4 => (2, 1),
            _ => {
                let init = self.rng.i32(-2..=3);
                (init, init + self.rng.i32(-1..=4))
            }
        };
        let (init, last) = (self.bound(init), self.bound(last));
        if init.place.overlaps(&last.place) {
            return self.loop_bounds();
        }
        (init, last)
    }

    /// A bound with this value; or, where `value` is ordinary, a word that only reads like it.
    fn bound(&mut self, value: i32) -> Bound {
        let small = (-3..=8).contains(&value);
        let (place, most, is_assigned) = match self.rng.u32(..8) {
            0..=2 => (OperandText::constant(self.integer_text(value as i16)), value, false),
            3 if small => {
                // What random_inputs promises about them.
                let scaled = i32::from(AnalogInput::scale(1));
                let (text, most) = [("IW10", 0), ("SMW10", 0), ("Ain5", 1), ("AIW10", scaled)]
                    [self.rng.usize(..4)];
                return Bound {
                    place: OperandText::constant(self.localized(text)),
                    least: 0,
                    most,
                    is_assigned: false,
                };
            }
            _ => match self.writable_word() {
                Some(place) => (place, value, true),
                None => (OperandText::constant(value.to_string()), value, false),
            },
        };
        Bound { place, least: value, most, is_assigned }
    }

    fn writable_word(&mut self) -> Option<OperandText> {
        (0..20).find_map(|_| self.word(true))
    }
}
