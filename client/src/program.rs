//! A program beside the running PLC: its source with lines, symbols and image. It asks the PLC
//! nothing.

use std::fmt;

use awl_asm::assemble::{Assembly, assemble_with_data};
use awl_asm::ast::{DataLine, Statement, Symbol};
use awl_asm::diagnostic::{Diagnostic, Severity};
use awl_asm::disassemble::disassemble;
use awl_asm::native::translate;
use awl_asm::source::{Source, SourceError};
use awl_asm::tools::{Tools, image_in};
use plc_isa::{ImageError, MAGIC};

/// A program with its source.
#[derive(Debug)]
pub struct Program {
    /// The text; of an image its disassembly.
    pub source: Source,
    /// All that the assembler knows.
    pub assembly: Assembly,
    /// The image.
    pub image: Vec<u8>,
    /// The texts that its own was made of, where it was made: what their author sees.
    pub texts: Vec<Source>,
    /// What the file of an image says besides.
    tools: Tools,
}

/// An instruction of the image and where it is in the source.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct InstructionPlace {
    /// Offset of its first byte in the image, hidden instructions before it left out.
    pub offset: u16,
    /// One past its last byte, hidden instructions after it included.
    pub end: u16,
    /// Its line in the source, from 1.
    pub line: usize,
    /// Its index in the assembly's code.
    pub index: usize,
}

impl Program {
    /// Takes AWL text or an image as bytes. `symbols`: further ones. Errors in the program come all
    /// at once.
    pub fn of_bytes(
        name: &str,
        bytes: &[u8],
        symbols: Vec<Symbol>,
    ) -> Result<Program, ProgramError> {
        Program::with_data(name, bytes, symbols, &[])
    }

    /// The same with a data block that is a file of its own; an image has its data.
    pub fn with_data(
        name: &str,
        bytes: &[u8],
        mut symbols: Vec<Symbol>,
        data: &[DataLine],
    ) -> Result<Program, ProgramError> {
        if !is_image(bytes) {
            let source = Source::from_bytes(name, bytes)?;
            return Program::assembled_with_data(source, symbols, data);
        }
        let text = disassemble(image_in(bytes))
            .map_err(|error| ProgramError::Image { name: name.to_string(), error })?;
        let tools = Tools::in_file(bytes).unwrap_or_default();
        symbols.extend(tools.symbols());
        Ok(Program { tools, ..Program::assembled(Source::new(name, text)?, symbols)? })
    }

    /// Assembles a source.
    pub fn assembled(source: Source, symbols: Vec<Symbol>) -> Result<Program, ProgramError> {
        Program::assembled_with_data(source, symbols, &[])
    }

    /// The same with a data block that is a file of its own.
    pub fn assembled_with_data(
        source: Source,
        symbols: Vec<Symbol>,
        data: &[DataLine],
    ) -> Result<Program, ProgramError> {
        let assembly = assemble_with_data(&source, symbols, data);
        Program::of_assembly(source, assembly)
    }

    /// The same program, whose text was made of these: its lines `//# source` lead to them.
    pub fn made_of(self, texts: Vec<Source>) -> Program {
        Program { texts, ..self }
    }

    fn of_assembly(source: Source, mut assembly: Assembly) -> Result<Program, ProgramError> {
        match assembly.image.take() {
            Some(image) => {
                let (texts, tools) = (Vec::new(), Tools::default());
                Ok(Program { source, assembly, image, texts, tools })
            }
            None => Err(ProgramError::of(source, assembly.diagnostics)),
        }
    }

    /// For those who load a board: what the board has no room or no hardware for is an error at its
    /// place.
    pub fn require_board(&mut self) -> Result<(), ProgramError> {
        self.assembly.require_board();
        match self.assembly.has_errors() {
            true => Err(self.error(self.assembly.diagnostics.clone())),
            false => Ok(()),
        }
    }

    /// Errors in the program that were found after it was assembled.
    pub fn error(&self, diagnostics: Vec<Diagnostic>) -> ProgramError {
        ProgramError::of(self.source.clone(), diagnostics)
    }

    /// The symbols that the program declares or was given.
    pub fn symbols(&self) -> &[Symbol] {
        &self.assembly.program.symbols
    }

    /// The checksum of the image, as a PLC tells it.
    pub fn crc(&self) -> u32 {
        self.image.last_chunk().map_or(0, |bytes| u32::from_le_bytes(*bytes))
    }

    /// The program as machine code, as a board runs it after `awl-asm --native`; `None` where it
    /// cannot be translated.
    pub fn native_image(&self) -> Option<Vec<u8>> {
        Some(translate(&self.image).ok()?.image)
    }

    /// The instructions in the order of the source.
    pub fn places(&self) -> impl Iterator<Item = InstructionPlace> + '_ {
        let code = self.assembly.lines.iter().zip(&self.assembly.code).enumerate();
        code.map(|(index, (line, selected))| InstructionPlace {
            offset: (line.at + u32::from(line.hidden_len)) as u16,
            end: (line.at + u32::from(line.len)) as u16,
            line: self.source.position(self.assembly.span_of(selected).start as usize).0,
            index,
        })
    }

    /// The place of the instruction at an offset of the image: `file:line`, or where the text says
    /// that it comes from.
    pub fn place_of(&self, offset: u16) -> Option<String> {
        if let Some(place) = self.tools.place_at(offset) {
            return Some(place.to_string());
        }
        self.assembly.place_at(&self.source, offset).map(|place| place.to_string())
    }

    /// The network that a line belongs to; `None` before the first one.
    pub fn network_of(&self, line: usize) -> Option<u32> {
        let networks =
            self.assembly.program.statements.iter().filter_map(|statement| match statement {
                Statement::Network(network) => Some(network),
                _ => None,
            });
        let begins = |span: awl_asm::ast::Span| self.source.position(span.start as usize).0;
        networks
            .take_while(|network| begins(network.span) <= line)
            .last()
            .map(|network| network.number)
    }
}

/// Whether a file is an image, and no text.
pub fn is_image(bytes: &[u8]) -> bool {
    bytes.starts_with(&MAGIC)
}

/// The symbols of a table. Errors in it come all at once.
pub fn symbols_of(table: Source) -> Result<Vec<Symbol>, ProgramError> {
    let read = awl_asm::symbols::load(&table);
    without_errors(table, read)
}

/// The lines of a data block. Errors in it come all at once.
pub fn data_of(block: Source, symbols: &[Symbol]) -> Result<Vec<DataLine>, ProgramError> {
    let read = awl_asm::data_block::parse(&block, symbols);
    without_errors(block, read)
}

/// What was read of a text, if nothing is wrong with it.
fn without_errors<T>(
    source: Source,
    (read, diagnostics): (T, Vec<Diagnostic>),
) -> Result<T, ProgramError> {
    match diagnostics.iter().any(|found| found.severity() == Severity::Error) {
        true => Err(ProgramError::of(source, diagnostics)),
        false => Ok(read),
    }
}

/// Why something is no program.
#[derive(Debug, Clone)]
pub enum ProgramError {
    /// An image that cannot be read.
    Image {
        /// Where it comes from, usually a path.
        name: String,
        /// What is wrong, and where.
        error: ImageError,
    },
    /// Bytes that are no text.
    Source(SourceError),
    /// A text with errors.
    Errors {
        /// The text.
        source: Box<Source>,
        /// What is wrong with it, without warnings.
        diagnostics: Vec<Diagnostic>,
    },
}

impl ProgramError {
    fn of(source: Source, mut diagnostics: Vec<Diagnostic>) -> ProgramError {
        diagnostics.retain(|found| found.severity() == Severity::Error);
        ProgramError::Errors { source: Box::new(source), diagnostics }
    }
}

impl From<SourceError> for ProgramError {
    fn from(error: SourceError) -> ProgramError {
        ProgramError::Source(error)
    }
}

impl fmt::Display for ProgramError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ProgramError::Image { name, error } => {
                write!(f, "{name}: {} (offset {:#06x})", error.fault.message(), error.at)
            }
            ProgramError::Source(error) => error.fmt(f),
            ProgramError::Errors { source, diagnostics } => {
                write!(f, "{} has errors", source.name)?;
                diagnostics.iter().try_for_each(|found| {
                    let place = source.place(found.span.start as usize);
                    write!(f, "\n{place}: {}", found.message)
                })
            }
        }
    }
}

impl std::error::Error for ProgramError {}

#[cfg(test)]
mod tests {
    use super::*;

    fn program(text: &str) -> Program {
        Program::assembled(Source::new("p.awl", text).unwrap(), Vec::new()).unwrap()
    }

    #[test]
    fn offsets_lead_to_lines_and_networks() {
        let program = program(
            "//# symbol Lamp Q0.0\nNETWORK 1\nLD I0.0\n= Lamp\nNETWORK 7 // second\nLD I0.1\n\
                S Q0.1, 1\n",
        );
        let places: Vec<InstructionPlace> = program.places().collect();
        assert_eq!(places.iter().map(|place| place.line).collect::<Vec<_>>(), [3, 4, 6, 7]);
        assert!(places.windows(2).all(|pair| pair[0].offset < pair[1].offset));
        assert_eq!(program.place_of(places[2].offset).as_deref(), Some("p.awl:6"));
        assert_eq!(program.place_of(0), None);
        assert_eq!(
            [1, 2, 4, 5, 7].map(|line| program.network_of(line)),
            [None, Some(1), Some(1), Some(7), Some(7)]
        );
        assert_eq!(program.symbols()[0].name, "Lamp");
    }

    #[test]
    fn errors_have_their_places() {
        let error =
            Program::assembled(Source::new("p.awl", "LD I0.0\nJMP 7\n").unwrap(), Vec::new())
                .unwrap_err();
        assert!(error.to_string().contains("p.awl:2:5"), "{error}");
    }
}
