//! `set`, `force`, `unforce`.

use anyhow::{Error, Result};
use client::service::{FORCE_MAX, Forced};
use client::{Operand, Reference};

use super::context::Context;

pub(super) fn set(context: &mut Context, assignments: &[String]) -> Result<bool> {
    let assignments = context.assignments(assignments)?;
    let values: Vec<(Reference, u32)> =
        assignments.iter().map(|(operand, value)| (operand.reference, *value)).collect();
    if let Err(error) = context.client.set(&values) {
        if !matches!(error, client::Error::Refused { exception: 2, .. }) {
            return Err(error.into());
        }
        // What the program does not use is told by name.
        let operands: Vec<Operand> = assignments.into_iter().map(|(operand, _)| operand).collect();
        context.client.watch_operands(&operands)?;
        return Err(Error::new(error).context(
            "nothing was written: Q, M, S, V, AC, AQW and the current values of timers and \
                counters can be set; inputs and \
             analog inputs can be forced",
        ));
    }
    for (operand, value) in &assignments {
        println!("{} = {}", operand.name, operand.text(*value, context.base));
    }
    Ok(true)
}

pub(super) fn force(context: &mut Context, assignments: &[String]) -> Result<bool> {
    let assignments = context.assignments(assignments)?;
    let mut table = None;
    for (operand, value) in &assignments {
        let forced = context
            .client
            .force(operand.reference, *value)
            .map_err(|error| refusal(&operand.name, error))?;
        table = Some(forced);
    }
    let table = match table {
        Some(table) => table,
        None => context.client.forced()?,
    };
    print(context, &table);
    Ok(true)
}

fn refusal(name: &str, error: client::Error) -> Error {
    let why = match &error {
        client::Error::Refused { exception: 4, .. } => {
            format!("{name}: {FORCE_MAX} operands are forced already; `uno200 unforce` makes room")
        }
        client::Error::Refused { exception: 2, .. } => format!(
            "{name} cannot be forced: bits, bytes and words of I and Q can, AIW, AQW, and V and M \
                that the program uses"
        ),
        _ => return error.into(),
    };
    Error::new(error).context(why)
}

pub(super) fn unforce(context: &mut Context, operands: &[String], all: bool) -> Result<bool> {
    if all {
        context.client.unforce_all()?;
        print(context, &[]);
        return Ok(true);
    }
    let operands = context.operands(operands)?;
    let before = context.client.forced()?;
    let is_forced =
        |operand: &&Operand| !before.iter().any(|forced| forced.reference == operand.reference);
    let missing: Vec<&str> =
        operands.iter().filter(is_forced).map(|operand| &*operand.name).collect();
    if !missing.is_empty() {
        anyhow::bail!("{} is not forced; `uno200 force` lists what is", missing.join(", "));
    }
    let mut table = before;
    for operand in &operands {
        table = context.client.unforce(operand.reference)?;
    }
    print(context, &table);
    Ok(true)
}

fn print(context: &Context, table: &[Forced]) {
    if table.is_empty() {
        println!("nothing is forced");
    }
    for text in texts(context, table) {
        println!("{text}");
    }
}

/// Operands with what they are or were forced to.
pub(super) fn texts(context: &Context, table: &[Forced]) -> Vec<String> {
    let text = |&Forced { reference, value }: &Forced| {
        let (name, form) = match reference.address() {
            Some(address) => (named(context, address), client::value::Form::of(address)),
            None => (format!("{:02X?}", reference.0), client::value::Form::Double),
        };
        format!("{name} = {}", form.text(value, context.base))
    };
    table.iter().map(text).collect()
}

/// An address with its symbol.
fn named(context: &Context, address: awl_asm::Address) -> String {
    let value = awl_asm::ast::Value::Address(address);
    match context.symbols.iter().find(|symbol| symbol.value == value) {
        Some(symbol) => format!("{address} ({})", symbol.name),
        None => address.to_string(),
    }
}
