//! Calls of subroutines with their parameters, and sequence segments.

use std::sync::Arc;

use awl_asm::ast::{Instruction, Operand, Section, Span, Type, Value, Variable};
use plc_isa::Area;

use super::memory::address;
use super::places::Trouble;
use super::{Naive, Segment};

/// The value of a parameter on its way.
enum Parameter {
    Bit(bool),
    Value(u32),
}

/// Calls.
impl Naive {
    /// Calls a subroutine if power flows. Returns whether the program goes on.
    pub(super) fn call(&mut self, instruction: &Instruction) -> bool {
        if !self.stack[0] {
            return true;
        }
        let Value::Unit(id) = instruction.operands[0].value else {
            panic!("CALL names a subroutine")
        };
        let units = Arc::clone(&self.units);
        let callee = units.iter().position(|unit| unit.id == id).expect("the subroutine is there");
        let parameters =
            units[callee].variables.iter().filter(|variable| variable.section != Section::Temp);
        let parameters: Vec<(&Variable, &Operand)> =
            parameters.zip(&instruction.operands[1..]).collect();
        for &(variable, operand) in
            parameters.iter().filter(|(variable, _)| variable.section != Section::Out)
        {
            if let Some(value) = self.given(variable, operand) {
                self.change_locals(callee);
                self.take(variable, &local(variable), value);
                self.change_locals(callee);
            }
        }
        let goes_on = self.inside(callee);
        for &(variable, operand) in
            parameters.iter().filter(|(variable, _)| variable.section != Section::In)
        {
            self.change_locals(callee);
            let value = self.given(variable, &local(variable));
            self.change_locals(callee);
            if let Some(value) = value {
                self.take(variable, operand, value);
            }
        }
        goes_on
    }

    /// Executes a unit with a logic stack and local memory of its own.
    fn inside(&mut self, callee: usize) -> bool {
        let (stack, segment, caller) = (self.stack, self.segment.take(), self.unit);
        self.change_locals(callee);
        self.unit = callee;
        self.stack = [false; 9];
        self.stack[0] = true;
        let goes_on = self.run_unit();
        (self.stack, self.segment, self.unit) = (stack, segment, caller);
        self.change_locals(callee);
        goes_on
    }

    /// Exchanges the local memory at hand for that of another unit, or back.
    fn change_locals(&mut self, other: usize) {
        let theirs = std::mem::take(&mut self.locals[other]);
        self.locals[other] = std::mem::replace(self.area(Area::L), theirs);
    }

    /// What is handed over as by a move, a constant bit as by S or R: they have ENO. Nothing
    /// through a pointer that leads nowhere.
    fn given(&mut self, variable: &Variable, operand: &Operand) -> Option<Parameter> {
        if variable.kind == Type::Bool {
            return Some(Parameter::Bit(match &operand.value {
                Value::Constant(constant) => {
                    self.eno = true;
                    constant.value != 0
                }
                _ => self.bit_operand(operand),
            }));
        }
        let value = match (&operand.value, variable.kind) {
            (Value::Constant(constant), Type::Real) => Ok((constant.value as f32).to_bits()),
            _ => self.read(operand, variable.kind.bytes()),
        };
        self.noticed(value).map(Parameter::Value)
    }

    fn take(&mut self, variable: &Variable, operand: &Operand, value: Parameter) {
        match value {
            Parameter::Bit(value) => self.write_bit_operand(operand, value),
            Parameter::Value(value) => {
                let written = self.write(operand, variable.kind.bytes(), value);
                self.noticed(written);
            }
        }
    }

    fn noticed<T>(&mut self, result: Result<T, Trouble>) -> Option<T> {
        self.eno = result.is_ok();
        if result.is_err() {
            self.set_bit(Area::Sm, 4, 3, true);
        }
        result.ok()
    }
}

/// The place of a parameter in the subroutine.
fn local(variable: &Variable) -> Operand {
    Operand { span: Span::default(), value: Value::Address(variable.address) }
}

/// Sequence control.
impl Naive {
    pub(super) fn sequence(&mut self, instruction: &Instruction) {
        let operands = &instruction.operands;
        match instruction.mnemonic() {
            "LSCR" => {
                let is_active = self.bit_operand(&operands[0]);
                self.segment = Some(Segment { own: address(&operands[0]), is_active });
                self.push(is_active);
            }
            "SCRE" => self.segment = None,
            "SCRT" if self.stack[0] => {
                self.write_bit_operand(&operands[0], true);
                if let Some(segment) = self.segment {
                    let own = Operand { span: Span::default(), value: Value::Address(segment.own) };
                    self.write_bit_operand(&own, false);
                }
            }
            _ => {}
        }
    }

    /// What a load or parallel contact brings: nothing in a segment without power.
    pub(super) fn powered(&self, value: bool) -> bool {
        value && self.segment.is_none_or(|segment| segment.is_active)
    }
}
