//! Sequence segments of a random program.

use plc_isa::Op;

use super::Generator;

/// Most segments: as many S bits as a byte has.
const SEGMENTS_MAX: u8 = 8;

impl Generator<'_> {
    /// A segment of a few rungs; the S bits are in a byte that others write as well.
    pub(super) fn segment(&mut self) {
        if self.segments >= SEGMENTS_MAX || !self.is_main || !self.open_labels.is_empty() {
            return;
        }
        let own = format!("S0.{}", self.segments);
        self.segments += 1;
        self.network();
        self.fixed(Op::Lscr, &[&own]);
        if self.rng.bool() {
            self.outputs();
        }
        for _ in 0..self.rng.u32(1..=3) {
            self.rung();
            // What the assembler puts after the loads.
            self.code_len += 20;
        }
        self.network();
        self.logic();
        match self.rng.u32(..3) {
            0 => self.fixed(Op::Cscre, &[]),
            _ => {
                // To itself no step leads.
                let own = self.segments - 1;
                let next = format!("S0.{}", (own + self.rng.u8(1..SEGMENTS_MAX)) % SEGMENTS_MAX);
                self.fixed(Op::Scrt, &[&next]);
            }
        }
        self.rung();
        self.network();
        self.fixed(Op::Scre, &[]);
        self.depth = 0;
        self.network();
        self.load();
    }
}
