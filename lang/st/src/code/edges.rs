//! R_TRIG and F_TRIG without a memory of their own: the last CLK is what they remember, wherever
//! nothing but their calls writes it.

use std::collections::HashSet;

use super::Generator;
use super::hardware::{Key, usages};
use super::timers::Owner;
use crate::model::{BlockCall, Program, Root, Type};

/// Instances whose CLK is their memory.
pub(super) type Edges = HashSet<Key>;

/// CLK, and what blocks.st remembers it in.
const CLK: usize = 0;
pub(super) const M: usize = 2;

/// Whether a falling edge is found; `None`: it is another block.
fn falls(program: &Program, block: usize) -> Option<bool> {
    let unit = program.units.get(block).filter(|unit| unit.file.is_none())?;
    match unit.name.as_str() {
        "R_TRIG" => Some(false),
        "F_TRIG" => Some(true),
        _ => None,
    }
}

/// The instances that every call gives CLK, and that nothing else writes.
pub(super) fn edges(program: &Program) -> Edges {
    let is_one = |key: &Key| {
        let variables = match key.0 {
            Owner::Global => Some(&program.globals),
            Owner::Unit(number) => program.units.get(number).map(|unit| &unit.variables),
        };
        let variable = variables.and_then(|variables| variables.get(key.1));
        // A CLK with an initial value would be taken for one that was there.
        let of_type = variable.filter(|one| !one.has_initial).map(|one| &one.of_type);
        matches!(of_type, Some(Type::Block(block, _)) if falls(program, *block).is_some())
    };
    let gives = |call: &BlockCall| call.inputs.iter().any(|(at, _)| *at == CLK);
    let all = usages(program).into_iter().filter(|(key, _)| is_one(key));
    all.filter(|(_, one)| !one.is_written && one.calls.iter().all(|site| gives(site.call)))
        .map(|(key, _)| key)
        .collect()
}

impl Generator<'_> {
    /// A call of an instance whose CLK is its memory; false: it is another one. The outputs are
    /// not taken.
    pub(super) fn edge_call(&mut self, name: &str, call: &BlockCall) -> bool {
        let key = match call.instance.root {
            Root::Local(at) => (Owner::Unit(self.frame.unit), at),
            Root::Global(at) => (Owner::Global, at),
            Root::Address(_) => return false,
        };
        let is_one = call.instance.steps.is_empty() && self.edges.contains(&key);
        let (Some(falls), Some((_, clock)), true) =
            (falls(self.program, call.block), call.inputs.first(), is_one)
        else {
            return false;
        };
        let clock = self.lower(clock);
        let before = if falls { "LD" } else { "LDN" };
        self.writer.logic(before, &format!("{name}.CLK"), true);
        self.push(&clock);
        self.writer.coil(&format!("{name}.CLK"));
        if falls {
            self.writer.logic("NOT", "", false);
        }
        self.writer.logic("ALD", "", false);
        self.writer.coil(&format!("{name}.Q"));
        true
    }
}
