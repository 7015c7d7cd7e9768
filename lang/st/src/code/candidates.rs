//! Function blocks that can be subroutines. Whether that is shorter than writing them out is for
//! who asks to see.

use std::collections::HashMap;

use crate::model::{Program, StatementKind, Type, Unit, UnitKind, Variable, each_statement};

/// Blocks that can be subroutines: called more than once, with elementary variables alone.
pub(super) fn candidates(program: &Program) -> Vec<usize> {
    let mut calls: HashMap<usize, usize> = HashMap::new();
    for unit in &program.units {
        each_statement(&unit.body, &mut |statement| {
            if let StatementKind::Call(call) = &statement.kind {
                *calls.entry(call.block).or_default() += 1;
            }
        });
    }
    let is_one = |(number, unit): &(usize, &Unit)| {
        // Arrays and structures, constant ones too, are reached by the name of their instance.
        let is_plain = |one: &Variable| {
            one.of_type.is_elementary()
                && one.of_type.characters() == 0
                && one.of_type != Type::Invalid
                && one.at.is_none()
        };
        unit.kind == UnitKind::Block
            && unit.file.is_some()
            && calls.get(number).is_some_and(|&count| count > 1)
            && unit.variables.iter().all(is_plain)
    };
    let units = program.units.iter().enumerate();
    units.filter(is_one).map(|(number, _)| number).collect()
}
