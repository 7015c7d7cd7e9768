//! The units of a program: the main program, subroutines and their instructions.

use std::sync::Arc;

use awl_asm::ast::{Instruction, Program, Statement, UnitId, UnitKind, Variable};

/// A program unit.
#[derive(Debug, Clone)]
pub(super) struct Unit {
    pub(super) id: UnitId,
    pub(super) variables: Vec<Variable>,
    pub(super) code: Arc<Vec<Instruction>>,
}

/// The units of a program, the main program first. What is outside of blocks is the main
/// program.
pub(super) fn units(program: &Program) -> Vec<Unit> {
    let main = UnitId { kind: UnitKind::Main, number: 1 };
    let mut found: Vec<(UnitId, Vec<Variable>, Vec<Instruction>)> =
        vec![(main, Vec::new(), Vec::new())];
    let mut current = 0;
    for statement in &program.statements {
        match statement {
            Statement::Unit(unit) if unit.id.kind == UnitKind::Main => {
                found[0].1.clone_from(&unit.variables);
                current = 0;
            }
            Statement::Unit(unit) => {
                current = found.len();
                found.push((unit.id, unit.variables.clone(), Vec::new()));
            }
            Statement::Instruction(instruction) => found[current].2.push(instruction.clone()),
            Statement::Network(_) => {}
        }
    }
    let unit = |(id, variables, code)| Unit { id, variables, code: Arc::new(code) };
    found.into_iter().map(unit).collect()
}
