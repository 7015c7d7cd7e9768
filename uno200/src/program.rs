//! A program beside the running PLC: its source with lines, symbols and image. It asks the PLC nothing.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use awl_asm::assemble::{Assembly, assemble};
use awl_asm::ast::{Statement, Symbol};
use awl_asm::diagnostic::Severity;
use awl_asm::disassemble::disassemble;
use awl_asm::files::{read, read_source};
use awl_asm::native::translate;
use awl_asm::render::human;
use awl_asm::source::Source;
use plc_isa::MAGIC;

/// A program with its source.
#[derive(Debug)]
pub struct Program {
    /// The text; of an image its disassembly.
    pub source: Source,
    /// All that the assembler knows.
    pub assembly: Assembly,
    /// The image.
    pub image: Vec<u8>,
}

/// An instruction of the image and where it stands in the source.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Place {
    /// Offset of its first byte in the image, hidden instructions before it left out.
    pub offset: u16,
    /// One past its last byte, hidden instructions behind it included.
    pub end: u16,
    /// Its line in the source, from 1.
    pub line: usize,
    /// Its index in the assembly's code.
    pub index: usize,
}

impl Program {
    /// Reads AWL text or an image. `symbol_files`: further symbols. Errors in the program come all at once, as the
    /// assembler shows them.
    pub fn open(path: &Path, symbol_files: &[PathBuf]) -> Result<Program> {
        let symbols = load_symbols(symbol_files)?;
        let bytes = read(path)?;
        let name = path.display().to_string();
        if bytes.starts_with(&MAGIC) {
            let text = disassemble(&bytes)
                .map_err(|error| anyhow::anyhow!("{name}: {} (offset {:#06x})", error.fault.message(), error.at))?;
            return Program::assembled(Source::new(name, text)?, symbols);
        }
        Program::assembled(Source::from_bytes(name, &bytes)?, symbols)
    }

    /// Assembles a source.
    pub fn assembled(source: Source, symbols: Vec<Symbol>) -> Result<Program> {
        let mut assembly = assemble(&source, symbols);
        match assembly.image.take() {
            Some(image) => Ok(Program { source, assembly, image }),
            None => {
                let errors = assembly.diagnostics.iter().filter(|error| error.severity() == Severity::Error);
                let text: String = errors.map(|error| human(&source, error, true) + "\n").collect();
                bail!("{} has errors\n{}", source.name, text.trim_end())
            }
        }
    }

    /// The symbols that the program declares or was given.
    pub fn symbols(&self) -> &[Symbol] {
        &self.assembly.program.symbols
    }

    /// The checksum of the image, as a PLC tells it.
    pub fn crc(&self) -> u32 {
        self.image.last_chunk().map_or(0, |bytes| u32::from_le_bytes(*bytes))
    }

    /// The program as machine code, as a board runs it after `awl-asm --native`.
    pub fn native_image(&self) -> Result<Vec<u8>> {
        Ok(translate(&self.image).context("the program cannot be translated")?.image)
    }

    /// The instructions in the order of the source.
    pub fn places(&self) -> impl Iterator<Item = Place> + '_ {
        let code = self.assembly.lines.iter().zip(&self.assembly.code).enumerate();
        code.map(|(index, (line, selected))| Place {
            offset: (line.at + u32::from(line.hidden_len)) as u16,
            end: (line.at + u32::from(line.len)) as u16,
            line: self.source.position(self.assembly.span_of(selected).start as usize).0,
            index,
        })
    }

    /// `file:line` of the instruction at an offset of the image.
    pub fn place_of(&self, offset: u16) -> Option<String> {
        let line = self.assembly.line_at(&self.source, offset)?;
        Some(format!("{}:{line}", self.source.name))
    }

    /// The network that a line belongs to; `None` before the first one.
    pub fn network_of(&self, line: usize) -> Option<u32> {
        let networks = self.assembly.program.statements.iter().filter_map(|statement| match statement {
            Statement::Network(network) => Some(network),
            _ => None,
        });
        let begins = |span: awl_asm::ast::Span| self.source.position(span.start as usize).0;
        networks.take_while(|network| begins(network.span) <= line).last().map(|network| network.number)
    }
}

/// Reads symbol files. Errors in them come all at once.
pub fn load_symbols(files: &[PathBuf]) -> Result<Vec<Symbol>> {
    let mut symbols = Vec::new();
    for path in files {
        let table = read_source(path)?;
        let (list, diagnostics) = awl_asm::symbols::load(&table);
        let errors = diagnostics.iter().filter(|error| error.severity() == Severity::Error);
        let text: String = errors.map(|error| human(&table, error, true) + "\n").collect();
        if !text.is_empty() {
            bail!("{} has errors\n{}", path.display(), text.trim_end());
        }
        symbols.extend(list);
    }
    Ok(symbols)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn program(text: &str) -> Program {
        Program::assembled(Source::new("p.awl", text).unwrap(), Vec::new()).unwrap()
    }

    #[test]
    fn offsets_lead_to_lines_and_networks() {
        let program =
            program("//# symbol Lamp Q0.0\nNETWORK 1\nLD I0.0\n= Lamp\nNETWORK 7 // second\nLD I0.1\nS Q0.1, 1\n");
        let places: Vec<Place> = program.places().collect();
        assert_eq!(places.iter().map(|place| place.line).collect::<Vec<_>>(), [3, 4, 6, 7]);
        assert!(places.windows(2).all(|pair| pair[0].offset < pair[1].offset));
        assert_eq!(program.place_of(places[2].offset).as_deref(), Some("p.awl:6"));
        assert_eq!(program.place_of(0), None);
        assert_eq!([1, 2, 4, 5, 7].map(|line| program.network_of(line)), [None, Some(1), Some(1), Some(7), Some(7)]);
        assert_eq!(program.symbols()[0].name, "Lamp");
    }

    #[test]
    fn errors_come_as_the_assembler_shows_them() {
        let error = Program::assembled(Source::new("p.awl", "LD I0.0\nJMP 7\n").unwrap(), Vec::new()).unwrap_err();
        assert!(error.to_string().contains("p.awl:2:5"), "{error}");
    }
}
