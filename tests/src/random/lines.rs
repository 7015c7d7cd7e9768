//! Lines of a random program: an instruction with its operands, a network.

use plc_isa::{Form, Instruction, Kind, Op, Relation, STACK_LEVELS};

use super::{EDGES_MAX, Generator};
use crate::forms::Row;

impl Generator<'_> {
    pub(super) fn line(
        &mut self,
        row: &Instruction,
        relation: Option<Relation>,
        operands: &[String],
        form: &Form,
    ) {
        let mut mnemonic = row.mnemonics[0];
        if self.german || self.one_in(50) {
            mnemonic = self.rng.choice(row.mnemonics).unwrap_or(&mnemonic);
        }
        let mnemonic = format!("{mnemonic}{}", relation.map_or("", Relation::symbol));
        let separator = if self.one_in(4) { "," } else { ", " };
        let line = format!("{mnemonic:<6} {}", operands.join(separator));
        self.text.push_str(line.trim_end());
        self.text.push('\n');
        self.wanted = self.wanted.saturating_sub(1);
        self.code_len += u32::from(form.encoded_len());
        self.work += self.passes;
        self.edges += u32::from(form.kinds.contains(&Kind::Edge));
        self.depth = match row.op {
            Op::Lbl | Op::For | Op::Next => 1,
            _ => self.depth.saturating_add_signed(row.stack.adds).min(STACK_LEVELS),
        };
    }

    /// A line of an instruction with given operands: the first form is as good as any.
    pub(super) fn fixed(&mut self, op: Op, operands: &[&str]) {
        let row = op.instruction();
        let operands: Vec<String> = operands.iter().map(|text| text.to_string()).collect();
        self.line(row, None, &operands, &row.forms[row.forms.len() - 1]);
    }

    /// Starts a network here, or now and then not.
    pub(super) fn network(&mut self) {
        if !self.has_networks || (self.networks > 0 && self.one_in(4)) {
            return;
        }
        self.networks += 1;
        let title = if self.one_in(3) { " // random rung" } else { "" };
        self.text.push_str(&format!("NETWORK {}{title}\n", self.networks));
        self.depth = 0;
    }

    /// Writes the instruction with random operands, if there are any for it here.
    pub(super) fn random_line(&mut self, row: &'static Instruction) -> bool {
        let Some(form) = self.rng.choice(row.forms) else { return false };
        if form.kinds.contains(&Kind::Edge) && self.edges >= EDGES_MAX {
            return false;
        }
        for _ in 0..20 {
            let found = if row.module().is_some() {
                self.values(row, form)
            } else {
                self.operands(row, form)
            };
            if let Some(operands) = found {
                let relations = Row { instruction: row, form }.relations();
                let relation = relations[self.rng.usize(..relations.len())];
                self.line(row, relation, &operands, form);
                return true;
            }
        }
        false
    }
}
