//! The program from instruction to instruction: which comes next.

use std::sync::Arc;

use awl_asm::ast::Instruction;

use super::memory::number;
use super::{Fault, INSTRUCTIONS_MAX, Mode, Naive};

/// What follows an instruction.
enum Go {
    Next,
    To(usize),
    /// The unit is over.
    Return,
    /// The program is over.
    Leave,
}

/// The program.
impl Naive {
    pub(super) fn run_program(&mut self) {
        self.unit = 0;
        self.segment = None;
        self.run_unit();
    }

    /// Executes the unit at hand. Returns whether the program goes on after it.
    pub(super) fn run_unit(&mut self) -> bool {
        let code = self.code();
        let mut at = 0;
        while let Some(instruction) = code.get(at) {
            if self.instructions_in_scan >= INSTRUCTIONS_MAX {
                return self.fail(Fault::Watchdog);
            }
            self.instructions_in_scan += 1;
            match self.execute(at, instruction) {
                Go::Next => at += 1,
                Go::To(target) => at = target,
                Go::Return => return true,
                Go::Leave => return false,
            }
        }
        true
    }

    fn code(&self) -> Arc<Vec<Instruction>> {
        Arc::clone(&self.units[self.unit].code)
    }

    fn fail(&mut self, fault: Fault) -> bool {
        self.fault = Some(fault);
        self.mode = Mode::Stop;
        false
    }

    fn execute(&mut self, at: usize, instruction: &Instruction) -> Go {
        match instruction.mnemonic() {
            "LD" | "LDN" | "A" | "AN" | "O" | "ON" | "NOT" | "EU" | "ED" | "NOP" | "=" | "AENO"
            | "LDI" | "LDNI" | "AI" | "ANI" | "OI" | "ONI" | "=I" => self.contact(at, instruction),
            "ALD" | "OLD" | "LPS" | "LRD" | "LPP" | "LDS" if instruction.relation.is_none() => {
                self.stack_operation(instruction);
            }
            "LDB" | "AB" | "OB" | "LDW" | "AW" | "OW" | "LDD" | "AD" | "OD" | "LDR" | "AR"
            | "OR" | "LDS" | "AS" | "OS" => {
                if let Err(fault) = self.compare(instruction) {
                    self.fail(fault);
                    return Go::Leave;
                }
            }
            "TON" | "TONR" | "TOF" => self.timer_instruction(instruction),
            "CTU" | "CTD" | "CTUD" => self.counter_instruction(instruction),
            "CSCRE" if self.stack[0] => {
                // The segment is left with the instruction that ends it.
                return Go::To(self.segment_end(at));
            }
            "LSCR" | "SCRT" | "SCRE" | "CSCRE" => self.sequence(instruction),
            "PID" => self.pid(at, instruction),
            "CALL" if self.call(instruction) => {}
            "CALL" => return Go::Leave,
            "FOR" | "NEXT" | "JMP" | "LBL" | "END" | "STOP" | "WDR" | "CRET" => {
                return self.control(at, instruction);
            }
            _ => self.powered_box(instruction),
        }
        Go::Next
    }
}

/// Program control.
impl Naive {
    fn control(&mut self, at: usize, instruction: &Instruction) -> Go {
        match instruction.mnemonic() {
            "NEXT" => return self.end_of_pass(at),
            "LBL" => return Go::Next,
            _ if !self.stack[0] => {
                let skips = instruction.mnemonic() == "FOR";
                self.eno &= !skips;
                return if skips { Go::To(self.matching_next(at) + 1) } else { Go::Next };
            }
            _ => {}
        }
        match instruction.mnemonic() {
            "FOR" => self.enter_loop(at, instruction),
            "JMP" => Go::To(self.label(number(&instruction.operands[0]))),
            "STOP" => {
                self.mode = Mode::Stop;
                Go::Leave
            }
            "WDR" => {
                self.instructions_in_scan = 0;
                Go::Next
            }
            "CRET" => Go::Return,
            _ => Go::Leave,
        }
    }

    fn enter_loop(&mut self, at: usize, instruction: &Instruction) -> Go {
        let [indx, init, last] = &instruction.operands[..] else {
            panic!("FOR has three operands")
        };
        let (init, last) = (self.word_operand(init), self.word_operand(last));
        self.write_word_operand(indx, init);
        self.eno = true;
        if init > last {
            return Go::To(self.matching_next(at) + 1);
        }
        Go::Next
    }

    fn end_of_pass(&mut self, at: usize) -> Go {
        let start = self.matching_for(at);
        let code = self.code();
        let [indx, _, last] = &code[start].operands[..] else { panic!("FOR has three operands") };
        let index = self.word_operand(indx);
        let was_last = index >= self.word_operand(last);
        self.write_word_operand(indx, index.wrapping_add(1));
        self.stack[0] = true;
        if was_last { Go::Next } else { Go::To(start + 1) }
    }

    fn matching_next(&self, start: usize) -> usize {
        let mut open = 0;
        for (at, instruction) in self.code().iter().enumerate().skip(start) {
            match instruction.mnemonic() {
                "FOR" => open += 1,
                "NEXT" => open -= 1,
                _ => {}
            }
            if open == 0 {
                return at;
            }
        }
        panic!("FOR without NEXT")
    }

    fn segment_end(&self, at: usize) -> usize {
        let code = self.code();
        let rest = code.iter().skip(at).position(|instruction| instruction.mnemonic() == "SCRE");
        at + rest.expect("a segment ends with SCRE")
    }

    fn matching_for(&self, end: usize) -> usize {
        let (mut open, code) = (0, self.code());
        for at in (0..=end).rev() {
            match code[at].mnemonic() {
                "NEXT" => open += 1,
                "FOR" => open -= 1,
                _ => {}
            }
            if open == 0 {
                return at;
            }
        }
        panic!("NEXT without FOR")
    }

    fn label(&self, wanted: i64) -> usize {
        let is_wanted = |instruction: &Instruction| {
            instruction.mnemonic() == "LBL" && number(&instruction.operands[0]) == wanted
        };
        self.code().iter().position(is_wanted).unwrap_or_else(|| panic!("no LBL {wanted}"))
    }
}
