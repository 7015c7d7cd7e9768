//! What all commands of `uno200` need: the connection, the program, and operands as people write
//! them.

use std::collections::BTreeSet;

use anyhow::{Error, Result};
use awl_asm::Address;
use awl_asm::ast::Symbol;
use client::Program;
use client::operand::Operand;
use client::service::Identity;
use client::value::Base;
use uno200::Client;
use uno200::program::Files;

/// What all commands need.
pub(super) struct Context {
    pub(super) client: Client,
    pub(super) program: Option<Program>,
    pub(super) symbols: Vec<Symbol>,
    /// What the program computes with as reals.
    pub(super) reals: BTreeSet<Address>,
    pub(super) files: Files,
    pub(super) base: Base,
}

impl Context {
    /// The program of `--program`, if it is the one in the PLC: only then its lines are those of
    /// the fault.
    pub(super) fn known_program(&self, identity: &Identity) -> Option<&Program> {
        self.program
            .as_ref()
            .filter(|program| !identity.is_native && program.crc() == identity.image_crc)
    }

    /// Reads operands; all that are wrong are told at once.
    pub(super) fn operands(&self, texts: &[String]) -> Result<Vec<Operand>> {
        let mut errors = Vec::new();
        let mut operands = Vec::new();
        // Commas are what awl-sim separates operands with.
        for text in texts.iter().flat_map(|text| text.split(',')).filter(|text| !text.is_empty()) {
            match Operand::parse(text, &self.symbols) {
                Ok(operand) => operands.push(operand.in_program(&self.reals)),
                Err(error) => errors.push(error.to_string()),
            }
        }
        match errors.is_empty() {
            true => Ok(operands),
            false => Err(Error::msg(errors.join("\nerror: "))),
        }
    }

    /// Reads `OPERAND=VALUE`, all that are wrong at once.
    pub(super) fn assignments(&self, texts: &[String]) -> Result<Vec<(Operand, u32)>> {
        let one = |text: &String| -> Result<(Operand, u32), String> {
            let (name, value) =
                text.split_once('=').ok_or_else(|| format!("{text}: write OPERAND=VALUE"))?;
            let operand = Operand::parse(name, &self.symbols).map_err(|error| error.to_string())?;
            let operand = operand.in_program(&self.reals);
            let value =
                operand.form.parse(value).map_err(|error| format!("{}: {error}", operand.name))?;
            Ok((operand, value))
        };
        let (mut good, mut errors) = (Vec::new(), Vec::new());
        for text in texts {
            match one(text) {
                Ok(assignment) => good.push(assignment),
                Err(error) => errors.push(error),
            }
        }
        match errors.is_empty() {
            true => Ok(good),
            false => Err(Error::msg(errors.join("\nerror: "))),
        }
    }
}

/// Tells what happens to the connection.
pub(super) fn notice(text: &str) {
    anstream::eprintln!("{text}");
}
