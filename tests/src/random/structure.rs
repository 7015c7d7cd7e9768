//! What is in a random program: rungs, jumps forward, ends.

use plc_isa::{INSTRUCTIONS, Instruction, Op};

use super::{Generator, LOOPS_MAX};

/// Whether an instruction only works on the logic stack; the others do something with it.
fn is_logic(instruction: &Instruction) -> bool {
    instruction.rung.is_contact()
}

impl Generator<'_> {
    pub(super) fn program(&mut self) {
        while !self.is_full() {
            self.item();
        }
        if self.text.is_empty() {
            self.rung();
        }
    }

    pub(super) fn block(&mut self) {
        for _ in 0..self.rng.u32(1..=4) {
            if !self.is_full() {
                self.item();
            }
        }
    }

    fn item(&mut self) {
        match self.rng.u32(..100) {
            0..=6 if self.loops < LOOPS_MAX => self.for_loop(),
            7..=12 => self.skipped_part(),
            13 if self.loops == 0 && self.passes == 1 => self.repeated_part(),
            14..=17 if !self.open_labels.is_empty() => self.jump_out(),
            18 => self.leave(),
            19 => self.number_line(),
            20..=25 if self.offer.has_units() => self.call(),
            26..=28 if self.offer.has_units() && self.loops == 0 && self.passes == 1 => {
                self.segment()
            }
            29..=32 if self.offer.has_pointers() => self.move_pointer(),
            _ => self.rung(),
        }
    }

    pub(super) fn rung(&mut self) {
        self.network();
        self.logic();
        self.outputs();
    }

    pub(super) fn outputs(&mut self) {
        for _ in 0..self.rng.u32(1..=3) {
            let of_modules = self.offer.has_modules() && self.rng.bool();
            let offer = self.offer;
            let rows: Vec<_> = INSTRUCTIONS
                .iter()
                .filter(|row| {
                    offer.is_plain(row) && !is_logic(row) && row.module().is_some() == of_modules
                })
                .collect();
            let Some(row) = self.rng.choice(rows) else { return };
            while self.depth < row.stack.needs {
                self.load();
            }
            if self.random_line(row) && self.offer.has_units() && self.one_in(5) {
                if self.one_in(4) {
                    self.logic_step(false);
                }
                self.fixed(Op::Aeno, &[]);
            }
            if self.one_in(3) {
                self.logic_step(false);
            }
        }
    }

    /// Something that leaves power flow in the top of the stack, or not.
    pub(super) fn logic(&mut self) {
        self.load();
        let deep = self.one_in(25);
        for _ in 0..self.rng.u32(0..=if deep { 24 } else { 4 }) {
            self.logic_step(deep);
        }
    }

    pub(super) fn load(&mut self) {
        if self.one_in(6) {
            return self.fixed(Op::Ld, &["SM0.0"]);
        }
        let offer = self.offer;
        let rows: Vec<_> = INSTRUCTIONS
            .iter()
            .filter(|row| {
                offer.is_plain(row) && is_logic(row) && row.stack.needs == 0 && row.stack.adds == 1
            })
            .collect();
        let row = if self.one_in(2) {
            Op::Ld.instruction()
        } else {
            self.rng.choice(rows).unwrap_or(&INSTRUCTIONS[0])
        };
        self.random_line(row);
    }

    fn logic_step(&mut self, deep: bool) {
        let (depth, grows) = (self.depth, deep || self.depth < 3 || self.one_in(4));
        let offer = self.offer;
        let rows: Vec<_> = INSTRUCTIONS
            .iter()
            .filter(|row| {
                offer.is_plain(row)
                    && is_logic(row)
                    && row.stack.needs <= depth
                    && (grows || row.stack.adds <= 0)
            })
            .collect();
        // Several pushes in a row reach the ninth level and lose what is below.
        let pushes = rows.iter().filter(|row| row.stack.adds > 0).copied().collect::<Vec<_>>();
        let candidates = if deep && !self.one_in(4) { pushes } else { rows };
        if let Some(row) = self.rng.choice(candidates) {
            self.random_line(row);
        }
    }

    fn number_line(&mut self) {
        self.network();
        let number = self.rng.u8(..).to_string();
        self.fixed(Op::Nop, &[&number]);
        self.rung_continued();
    }

    /// A rung that has no network line of its own.
    fn rung_continued(&mut self) {
        self.logic();
        self.outputs();
    }

    /// END, or STOP in few programs, after a condition that is rarely true.
    fn leave(&mut self) {
        self.network();
        self.load();
        let bit = self.rng.u32(4..8).to_string();
        for byte in ["I2.", "I0.", "I1."] {
            let operand = format!("{byte}{bit}");
            self.fixed(Op::A, &[&self.localized(&operand)]);
        }
        let op = match self.is_main {
            true => Op::End,
            false => Op::Cret,
        };
        let op = if self.may_stop && self.one_in(2) { Op::Stop } else { op };
        self.fixed(op, &[]);
    }

    /// A jump forward over some items.
    fn skipped_part(&mut self) {
        let Some(label) = self.unused_labels.pop() else { return };
        self.network();
        self.logic();
        self.fixed(Op::Jmp, &[&label.to_string()]);
        if self.one_in(3) {
            self.outputs();
        }
        self.open_labels.push(label);
        self.block();
        self.open_labels.pop();
        self.label(label);
    }

    pub(super) fn label(&mut self, label: u8) {
        self.network();
        self.fixed(Op::Lbl, &[&label.to_string()]);
        if self.one_in(3) {
            self.outputs();
        }
    }

    /// A jump to any label that is open, out of loops too.
    fn jump_out(&mut self) {
        let Some(label) = self.rng.choice(self.open_labels.clone()) else { return };
        self.network();
        self.logic();
        self.fixed(Op::Jmp, &[&label.to_string()]);
    }
}
