//! Function blocks as subroutines: their state goes in and out as parameters. How they are called,
//! and their text; which are one is decided elsewhere.

use super::memory::local_type;
use super::writer::block;
use super::{Frame, Generator, Names};
use crate::model::{SectionKind, Unit, Variable};
use crate::names::safe_name;

/// How a variable of a block goes to its subroutine.
fn section_of(variable: &Variable) -> Option<&'static str> {
    match variable.section {
        _ if variable.is_constant => None,
        SectionKind::Temp => Some("VAR"),
        SectionKind::Input => Some("VAR_INPUT"),
        _ => Some("VAR_IN_OUT"),
    }
}

impl Generator<'_> {
    /// The call of a block's subroutine with the variables of an instance.
    pub(super) fn call_as_routine(&mut self, frame: &Frame, unit: &Unit) {
        let mut operands = vec![unit.name.clone()];
        for wanted in ["VAR_INPUT", "VAR_IN_OUT"] {
            for (at, variable) in unit.variables.iter().enumerate() {
                if section_of(variable) == Some(wanted)
                    && let Some((text, ..)) = self.operand_of(frame, at)
                {
                    operands.push(text);
                }
            }
        }
        self.writer.boxed("CALL", &operands.join(", "));
    }

    /// A block as a subroutine.
    pub(super) fn block_routine(&mut self, number: usize, routine: u16) -> Vec<String> {
        let Some(unit) = self.program.units.get(number) else { return Vec::new() };
        self.begin_text();
        self.frame = Frame {
            unit: number,
            names: Names::Local,
            is_short: false,
            preset: None,
            file: unit.file,
            end: None,
            loops: Vec::new(),
        };
        if unit.variables.iter().any(|one| one.section == SectionKind::Temp) {
            self.writer.section("initial values");
            self.reset_temporaries(unit);
        }
        self.body(&unit.body);
        self.end_of_unit();
        let mut sections = Vec::new();
        for wanted in ["VAR_INPUT", "VAR_IN_OUT", "VAR"] {
            let list: Vec<String> = unit
                .variables
                .iter()
                .filter(|one| section_of(one) == Some(wanted))
                .map(|one| format!("{}:{};", safe_name(&one.name), local_type(&one.of_type)))
                .collect();
            if !list.is_empty() {
                sections.push(wanted.to_owned());
                sections.extend(list);
                sections.push("END_VAR".to_owned());
            }
        }
        let header = format!("SUBROUTINE_BLOCK {}:SBR{routine}", unit.name);
        let writer = std::mem::take(&mut self.writer);
        block(self.place_of(number), &header, "END_SUBROUTINE_BLOCK", &sections, writer)
    }
}
