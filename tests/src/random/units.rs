//! Subroutines of a random program, with their parameters and calls.

use awl_asm::ast::Type;
use plc_isa::Op;

use super::Generator;
use super::operand_text::{Count, Extent, OperandText};
use super::subroutine::{Local, Section, Subroutine};
use super::values::DATA;

/// Most subroutines.
const SUBROUTINES_MAX: u32 = 3;

impl Generator<'_> {
    /// The subroutines, then the main program, in blocks if there is more than that.
    pub(super) fn whole_program(&mut self) {
        if !self.offer.has_units() {
            return self.program();
        }
        let wanted = self.wanted;
        for number in (0..self.rng.u32(..=SUBROUTINES_MAX)).rev() {
            self.wanted = (wanted / 4).max(5);
            self.subroutine(number);
        }
        self.wanted = wanted;
        self.start_unit(true);
        if self.offer.has_pointers() {
            self.prepare_pointers();
        }
        self.program();
        let main = std::mem::take(&mut self.text);
        let data = if self.offer.has_modules() { DATA } else { "" };
        self.text =
            format!("{data}ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\n{main}END_ORGANIZATION_BLOCK\n");
        for subroutine in self.subroutines.iter().rev() {
            self.text += &subroutine.text;
        }
    }

    fn start_unit(&mut self, is_main: bool) {
        self.is_main = is_main;
        (self.networks, self.depth, self.work) = (0, 0, 0);
        self.locals.clear();
    }

    fn subroutine(&mut self, number: u32) {
        self.start_unit(false);
        for section in Section::ALL {
            for _ in 0..self.rng.u32(..=2) {
                let types = [Type::Bool, Type::Byte, Type::Int, Type::Int, Type::Dint];
                let kind = types[self.rng.usize(..if self.offer.has_pointers() { 5 } else { 4 })];
                let name = format!("p{}", self.locals.len());
                self.locals.push(Local { name, kind, section });
            }
        }
        self.write_locals();
        self.program();
        let body = std::mem::take(&mut self.text);
        let declared = self.declarations();
        let text = format!(
            "SUBROUTINE_BLOCK SBR_{number}:SBR{number}\n{declared}BEGIN\n\
                {body}END_SUBROUTINE_BLOCK\n"
        );
        let parameters =
            self.locals.iter().filter(|local| local.section != Section::Temp).cloned().collect();
        let work = self.work + 10;
        self.subroutines.push(Subroutine { number, parameters, work, text });
    }

    fn declarations(&self) -> String {
        let mut text = String::new();
        for section in Section::ALL {
            let locals: Vec<&Local> =
                self.locals.iter().filter(|local| local.section == section).collect();
            if locals.is_empty() {
                continue;
            }
            text += &format!("{}\n", section.keyword());
            for local in locals {
                text += &format!("{}:{};\n", local.name, local.kind.name());
            }
            text += "END_VAR\n";
        }
        text
    }

    /// Gives those variables a value that have none at the call: what they hold then is not
    /// defined.
    fn write_locals(&mut self) {
        self.network();
        self.fixed(Op::Ld, &["SM0.0"]);
        for local in self.locals.clone() {
            if matches!(local.section, Section::In | Section::InOut) {
                continue;
            }
            let name = format!("#{}", local.name);
            match local.kind {
                Type::Bool => self.fixed(Op::Assign, &[&name]),
                Type::Byte => self.fixed(Op::Movb, &["7", &name]),
                Type::Int => self.fixed(Op::Movw, &["-7", &name]),
                _ => self.fixed(Op::Movd, &["70000", &name]),
            }
        }
    }

    /// A local variable of a type, if there is one.
    pub(super) fn local(&mut self, kind: Type, is_written: bool) -> Option<OperandText> {
        let found: Vec<usize> = self
            .locals
            .iter()
            .enumerate()
            .filter(|(_, local)| local.kind == kind)
            .map(|(number, _)| number)
            .collect();
        let number = self.rng.choice(found)?;
        let extent = Extent::local(number);
        if is_written && self.is_protected(&extent) {
            return None;
        }
        Some(OperandText { text: format!("#{}", self.locals[number].name), extent: Some(extent) })
    }

    /// Whether there are words that loops depend on.
    pub(super) fn is_any_protected(&self) -> bool {
        !self.protected.is_empty()
    }

    /// A call. In a loop the subroutine might write what the loop depends on.
    pub(super) fn call(&mut self) {
        let Some(subroutine) = self.rng.choice(self.subroutines.clone()) else { return };
        if self.is_any_protected() {
            return;
        }
        let mut operands = vec![format!("SBR{}", subroutine.number)];
        for parameter in &subroutine.parameters {
            match (0..20).find_map(|_| self.argument(parameter)) {
                Some(place) => operands.push(place.text),
                None => return,
            }
        }
        self.network();
        self.logic();
        let operands: Vec<&str> = operands.iter().map(String::as_str).collect();
        self.fixed(Op::Call, &operands);
        self.work += self.passes * subroutine.work;
        self.code_len += 16 * subroutine.parameters.len() as u32;
        if self.one_in(3) {
            self.outputs();
        }
    }

    fn argument(&mut self, parameter: &Local) -> Option<OperandText> {
        let is_written = parameter.section != Section::In;
        let is_constant = !is_written && self.one_in(3);
        match parameter.kind {
            Type::Bool if is_constant => Some(OperandText::constant(self.rng.u8(..2).to_string())),
            // Timers and counters are handed over, not written.
            Type::Bool => {
                self.bit(is_written.then_some(&Count { at_most: 1, is_certain: true }), !is_written)
            }
            Type::Byte if is_constant => Some(OperandText::constant(self.byte_constant())),
            Type::Byte => self.byte(is_written),
            Type::Int if is_constant => {
                let value = self.rng.i16(..);
                Some(OperandText::constant(self.integer_text(value)))
            }
            Type::Int => self.word(is_written),
            _ if is_constant => Some(OperandText::constant(self.rng.i32(..).to_string())),
            _ => self.double(is_written),
        }
    }
}
