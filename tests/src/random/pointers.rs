//! Pointers of a random program. AC1 leads into V memory and stays there, AC3 to a string; AC2 and
//! VD164 lead anywhere, also to nothing, and move.

use plc_isa::Op;

use super::Generator;
use super::operand_text::OperandText;

/// The double word that is a pointer.
pub(super) const MOVING: &str = "VD164";

impl Generator<'_> {
    /// What every scan begins with.
    pub(super) fn prepare_pointers(&mut self) {
        self.network();
        self.fixed(Op::Ld, &["SM0.0"]);
        let start = format!("&VB{}", self.rng.u32(0..40));
        self.fixed(Op::Movd, &[&start, "AC1"]);
        self.fixed(Op::Movd, &["&VB200", "AC3"]);
        for pointer in ["AC2", MOVING] {
            let target = self.pointer_target();
            self.fixed(Op::Movd, &[&target, pointer]);
        }
    }

    fn pointer_target(&mut self) -> String {
        let areas = [
            "&IB0", "&IB14", "&QB0", "&MB0", "&MB29", "&SB1", "&SMB5", "&SMB31", "&VB0", "&VB30",
            "&AIW2", "&AIW10",
        ];
        match self.rng.u32(..12) {
            0 => ["16#0B000000", "16#08FFFFFF", "16#05000020", "16#09000001", "0", "-1"]
                [self.rng.usize(..6)]
            .to_string(),
            1 => self.numbered_target("T"),
            2 => self.numbered_target("C"),
            _ => areas[self.rng.usize(..areas.len())].to_string(),
        }
    }

    /// A timer or counter that the program has.
    fn numbered_target(&mut self, letter: &str) -> String {
        let owners = if letter == "T" { &self.timers } else { &self.counters };
        match self.rng.choice(owners) {
            Some((number, _)) => format!("&{letter}{number}"),
            None => "&MB1".to_string(),
        }
    }

    /// Moves AC2 or the double word, or makes it lead elsewhere.
    pub(super) fn move_pointer(&mut self) {
        // In a loop it would go far.
        if self.passes > 1 || !self.is_main {
            return;
        }
        self.network();
        self.logic();
        let pointer = if self.rng.bool() { "AC2" } else { MOVING };
        match self.rng.u32(..4) {
            0 => self.fixed(Op::Incd, &[pointer]),
            1 => self.fixed(Op::AddDouble, &["2", pointer]),
            _ => {
                let target = self.pointer_target();
                self.fixed(Op::Movd, &[&target, pointer]);
            }
        }
    }

    /// A value after a pointer. Words that loops depend on must not be written by accident;
    /// comparisons stop the PLC if a pointer leads nowhere.
    pub(super) fn pointed(&mut self, is_written: bool, is_certain: bool) -> Option<OperandText> {
        if !self.offer.has_pointers() || is_written && self.is_any_protected() {
            return None;
        }
        let text =
            if is_certain { "*AC1" } else { ["*AC1", "*AC2", "*VD164"][self.rng.usize(..3)] };
        Some(OperandText::constant(text.to_string()))
    }
}
