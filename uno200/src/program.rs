//! Programs and symbol tables from files, with errors as the assembler shows them.

use std::path::PathBuf;

use anyhow::{Error, Result, bail};
use awl_asm::ast::{DataLine, Symbol};
use awl_asm::files::{ensure_program, read, read_program, read_program_texts, read_source};
use awl_asm::render::human;
use awl_asm::report::ProgramErrors;
use client::program::{Program, ProgramError, data_of, is_image, symbols_of};
use project::{Findings, Language, join};

/// Files that belong to a program.
#[derive(Debug, Clone, Default)]
pub struct Files {
    /// Tables of further symbols.
    pub symbols: Vec<PathBuf>,
    /// Its data block, if that is a file of its own.
    pub data: Option<PathBuf>,
}

impl Files {
    /// Reads AWL text, in one file or several, or an image. Errors in the program come all at once,
    /// as the assembler shows them.
    pub fn open(&self, paths: &[PathBuf]) -> Result<Program> {
        let symbols = self.symbols()?;
        let is_awl = |path: &PathBuf| Language::of(&path.to_string_lossy()) == Language::Awl;
        if !paths.iter().all(is_awl) {
            let sources = read_program_texts(paths)?;
            let joined = join(sources.clone()).map_err(told)?;
            let program = Program::assembled(joined.awl, symbols).map_err(shown)?;
            return Ok(program.made_of(sources));
        }
        let [path] = paths else {
            let data = self.data_lines(&symbols)?;
            return Program::assembled_with_data(read_program(paths)?, symbols, &data)
                .map_err(shown);
        };
        let bytes = read(path)?;
        ensure_program(path, &bytes, paths)?;
        if let Some(block) = self.data.as_ref().filter(|_| is_image(&bytes)) {
            bail!(
                "{}: a data block goes with AWL text; in an image such as {} there is one already",
                block.display(),
                path.display()
            );
        }
        let data = self.data_lines(&symbols)?;
        Program::with_data(&path.display().to_string(), &bytes, symbols, &data).map_err(shown)
    }

    /// The lines of the data block, if there is one.
    fn data_lines(&self, symbols: &[Symbol]) -> Result<Vec<DataLine>> {
        match &self.data {
            Some(block) => data_of(read_source(block)?, symbols).map_err(shown),
            None => Ok(Vec::new()),
        }
    }

    /// Reads the tables. Errors in them come all at once.
    pub fn symbols(&self) -> Result<Vec<Symbol>> {
        let mut symbols = Vec::new();
        for path in &self.symbols {
            symbols.extend(symbols_of(read_source(path)?).map_err(shown)?);
        }
        Ok(symbols)
    }
}

/// What is wrong with texts in other languages.
fn told(findings: Vec<Findings>) -> Error {
    let all = findings.iter().flat_map(|Findings { source, diagnostics }| {
        diagnostics.iter().map(move |found| human(source, found, true) + "\n")
    });
    ProgramErrors(format!("the program has errors\n{}", all.collect::<String>().trim_end())).into()
}

/// Why it is no program, as the assembler shows it.
pub fn shown(error: ProgramError) -> Error {
    let ProgramError::Errors { source, diagnostics } = &error else { return error.into() };
    let text: String = diagnostics.iter().map(|found| human(source, found, true) + "\n").collect();
    ProgramErrors(format!("{} has errors\n{}", source.name, text.trim_end())).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use awl_asm::source::Source;

    #[test]
    fn several_files_are_one_program() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let routine = "SUBROUTINE_BLOCK Lamp:SBR0\nBEGIN\nLD I0.0\n= Q0.0\nEND_SUBROUTINE_BLOCK\n";
        std::fs::write(path("main.awl"), "LD SM0.0\nCALL Lamp:SBR0\n").unwrap();
        std::fs::write(path("sbr0.awl"), routine).unwrap();
        let paths = [path("main.awl"), path("sbr0.awl")];
        let program = Files::default().open(&paths).unwrap();
        let places = program.places().filter_map(|place| program.place_of(place.offset));
        assert!(places.last().unwrap().ends_with("sbr0.awl:4"));
        std::fs::write(path("sbr0.awl"), routine.replace("I0.0", "I0.9")).unwrap();
        let error = Files::default().open(&paths).unwrap_err().to_string();
        assert!(error.contains("sbr0.awl:3:4"), "{error}");
        std::fs::write(path("sbr0.awl"), b"GJK\0R04.00").unwrap();
        for paths in [&paths[..], &paths[1..]] {
            let error = Files::default().open(paths).unwrap_err().to_string();
            assert!(error.contains("this is a project of STEP 7-Micro/WIN"), "{error}");
        }
    }

    #[test]
    fn errors_come_as_the_assembler_shows_them() {
        let source = Source::new("p.awl", "LD I0.0\nJMP 7\n").unwrap();
        let error = shown(Program::assembled(source, Vec::new()).unwrap_err());
        let text = error.to_string();
        assert!(text.starts_with("p.awl has errors\n") && text.contains("p.awl:2:5"), "{text}");
        assert!(text.contains("\u{1b}["), "with colours: {text}");
    }
}
