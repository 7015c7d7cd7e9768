//! A program as it stands in the slot, with the places of its instructions: what a meter runs. It
//! measures nothing.

use std::fmt;
use std::ops::Range;

use awl_asm::assemble::{Assembly, assemble};
use awl_asm::diagnostic::Severity;
use awl_asm::native::{Options, TranslatedInstruction, translate_with};
use awl_asm::source::Source;
use plc_isa::{Decoded, Group, Header, Plan, Program, verify};

use crate::image::OnBoard;

/// How the board executes a program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Tier {
    /// The engine reads bytecode.
    Interpreter,
    /// Translated to machine code.
    Native {
        /// Whether often used bytes of the process image are held in registers.
        pins: bool,
    },
}

impl Tier {
    /// All there are.
    pub const ALL: [Tier; 3] =
        [Tier::Interpreter, Tier::Native { pins: true }, Tier::Native { pins: false }];
}

impl fmt::Display for Tier {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Tier::Interpreter => "interpreter",
            Tier::Native { pins: true } => "native",
            Tier::Native { pins: false } => "native in SRAM",
        })
    }
}

/// A program for the slot. Its instructions are numbered as the bytecode has them: with those that
/// the assembler put in, and with the end of the program.
pub struct Executable {
    /// How it is executed.
    pub tier: Tier,
    /// What is written into the slot.
    pub image: Vec<u8>,
    /// The same as bytecode.
    pub bytecode: Vec<u8>,
    /// What the assembler knows about it.
    pub assembly: Assembly,
    /// The instructions with their offsets in the bytecode.
    pub code: Vec<(u16, Decoded)>,
    /// Where in the image each instruction is.
    places: Vec<Range<u16>>,
}

impl Executable {
    /// A program from its text.
    ///
    /// # Panics
    /// If it has errors.
    pub fn new(name: &str, text: &str, tier: Tier) -> Executable {
        let source = Source::new(name, text).unwrap_or_else(|error| panic!("{name}: {error}"));
        let assembly = assemble(&source, Vec::new());
        let errors = assembly
            .diagnostics
            .iter()
            .filter(|diagnostic| diagnostic.severity() == Severity::Error);
        let errors: Vec<_> = errors.map(|error| (error.span, &error.message)).collect();
        let Some(bytecode) = assembly.image.clone() else { panic!("{name}: {errors:?}") };
        let code: Vec<(u16, Decoded)> = verify(bytecode.as_slice())
            .map_or(Vec::new(), |program| program.all_instructions().collect());
        let (image, places) = match tier {
            Tier::Interpreter => {
                (bytecode.clone(), code.iter().map(|(at, decoded)| *at..at + decoded.len).collect())
            }
            Tier::Native { pins } => {
                let translated = translate_with(&bytecode, Options { pins });
                let translated = translated.unwrap_or_else(|error| panic!("{name}: {error}"));
                (translated.image, places(&code, &translated.instructions))
            }
        };
        Executable { tier, image, bytecode, assembly, code, places }
    }

    /// Its memory plan.
    ///
    /// # Panics
    /// Never: the assembler makes no image that is not valid.
    pub fn plan(&self) -> Plan<Vec<u8>> {
        let program: Program<Vec<u8>> =
            verify(self.bytecode.clone()).expect("an image of the assembler is valid");
        program.plan().clone()
    }

    /// The instruction at this offset of the image.
    pub fn instruction_at(&self, offset: u16) -> Option<usize> {
        let index = self.places.partition_point(|place| place.end <= offset);
        self.places.get(index).filter(|place| place.contains(&offset)).map(|_| index)
    }

    /// The instruction of the AWL text that this one belongs to; `None` for the end of the program.
    pub fn written(&self, instruction: usize) -> Option<usize> {
        let &(at, _) = self.code.get(instruction)?;
        let lines = &self.assembly.lines;
        let index = lines.partition_point(|line| line.at + u32::from(line.len) <= u32::from(at));
        lines.get(index).map(|_| index)
    }

    /// Whether the assembler put this instruction before or after the one that was written.
    pub fn is_hidden(&self, instruction: usize) -> bool {
        let is_hidden =
            |(_, decoded): &(u16, Decoded)| decoded.op.instruction().group == Group::Hidden;
        self.code.get(instruction).is_some_and(is_hidden)
    }

    /// Whether nothing is executed for this instruction.
    pub fn is_nothing(&self, instruction: usize) -> bool {
        self.places.get(instruction).is_none_or(Range::is_empty)
    }

    /// How many instructions were written.
    pub fn len(&self) -> usize {
        self.assembly.code.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Bytes of code, with the end of the program.
    pub fn code_len(&self) -> usize {
        let header = Header::read(&OnBoard(&self.image));
        header.map_or(0, |header| usize::from(header.code_len))
    }
}

/// Where the machine code of each instruction is; nowhere for those of interrupt routines.
fn places(code: &[(u16, Decoded)], translated: &[TranslatedInstruction]) -> Vec<Range<u16>> {
    let mut end = 0;
    let place = |(at, _): &(u16, Decoded)| {
        let found = translated.binary_search_by_key(at, |one| one.at).ok();
        let place = found.map_or(end..end, |index| translated[index].native.clone());
        end = place.end;
        place
    };
    code.iter().map(place).collect()
}
