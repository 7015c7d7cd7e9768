//! What functions read beside their arguments: global variables and addresses. A value that calls
//! such a function is not computed piece by piece into what the function reads.

use std::collections::BTreeSet;

use crate::check::each_expression;
use crate::model::{ExpressionKind, Program, Root};
use crate::names::safe_name;

/// What a function and those that it calls read.
#[derive(Debug, Clone, Default)]
pub(super) struct GlobalReads {
    /// Global variables, as operands.
    names: BTreeSet<String>,
    /// Whether addresses are read.
    addresses: bool,
}

/// Of each unit, by its number.
pub(super) fn of_units(program: &Program) -> Vec<GlobalReads> {
    let mut found = vec![None; program.units.len()];
    for number in 0..program.units.len() {
        of_unit(program, number, &mut found);
    }
    found.into_iter().map(Option::unwrap_or_default).collect()
}

fn of_unit(program: &Program, number: usize, found: &mut [Option<GlobalReads>]) -> GlobalReads {
    match found.get_mut(number) {
        Some(Some(known)) => return known.clone(),
        // Nothing calls itself; if it did, this would end.
        Some(slot) => *slot = Some(GlobalReads::default()),
        None => return GlobalReads::default(),
    }
    let (mut own, mut called) = (GlobalReads::default(), Vec::new());
    if let Some(unit) = program.units.get(number) {
        each_expression(&unit.body, &mut |one| match &one.kind {
            ExpressionKind::Call(number, _) => called.push(*number),
            ExpressionKind::Read(place) => match &place.root {
                Root::Global(at) => {
                    own.names.extend(program.globals.get(*at).map(|one| safe_name(&one.name)));
                }
                Root::Address(_) => own.addresses = true,
                Root::Local(_) => {}
            },
            _ => {}
        });
    }
    for one in called {
        let below = of_unit(program, one, found);
        own.names.extend(below.names);
        own.addresses |= below.addresses;
    }
    if let Some(slot) = found.get_mut(number) {
        *slot = Some(own.clone());
    }
    own
}

impl GlobalReads {
    /// Whether an operand is among them, as far as can be told by its name; `is_located` tells what
    /// has an address.
    pub(super) fn have(&self, operand: &str, is_located: impl Fn(&str) -> bool) -> bool {
        let root = operand.split(['.', '[']).next().unwrap_or(operand);
        // Two addresses may be the same memory.
        let may_be_same = is_located(operand)
            && (self.addresses || self.names.iter().any(|name| is_located(name)));
        may_be_same || self.names.contains(root)
    }
}
