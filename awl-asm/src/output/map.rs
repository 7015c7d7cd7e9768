//! The map: where the program's data lives, and the cross-reference of every operand.

use std::collections::HashMap;
use std::fmt::Write as _;

use plc_isa::{Area, Header, LOCALS_IN_V, Plan};

use crate::assemble::Assembly;
use crate::meaning::check::Access;
use crate::meaning::selected::operand_span;
use crate::meaning::units::LocalPlace;
use crate::plan::demand::v_range;
use crate::source::Source;
use crate::text::address::Address;
use crate::text::ast::{Symbol, Value};

/// Writes the map of an assembled program.
pub fn map(source: &Source, assembly: &Assembly) -> String {
    let mut text = format!("{}: memory plan\n\n", source.name);
    for line in assembly.demand.describe() {
        let _ = writeln!(text, "  {line}");
    }
    if let Some(image) = assembly.image.as_deref() {
        places(image, &mut text);
    }
    units(assembly, &mut text);
    text.push_str("\nCross-reference (r read, w written, rw both; source lines)\n\n");
    cross_reference(source, assembly, &mut text);
    text
}

fn places(image: &[u8], text: &mut String) {
    let Ok(header) = Header::read(&image) else { return };
    let plan = Plan::trusted(image, header);
    text.push_str("\nData addresses\n\n");
    let mut address = plc_isa::ARENA_START;
    for (first, len) in plan.v_ranges() {
        let _ = writeln!(text, "  {address:04X}  {}", v_range(first, len));
        address += len;
    }
    for slot in plan.timers() {
        let _ = writeln!(
            text,
            "  {:04X}  T{} ({} ms)",
            slot.address,
            slot.number,
            plc_isa::timer_resolution(slot.number).ms()
        );
    }
    for slot in plan.counters() {
        let _ = writeln!(text, "  {:04X}  C{}", slot.address, slot.number);
    }
    if header.edges > 0 {
        let _ = writeln!(text, "  {:04X}  {} edges", plan.edge(0).address, header.edges);
    }
}

/// The units in the order of the image: offset of the first instruction, and where local memory
/// lies.
fn units(assembly: &Assembly, text: &mut String) {
    let Some(image) = assembly.image.as_deref() else { return };
    let Ok(header) = Header::read(&image) else { return };
    if assembly.units.order.len() < 2 && assembly.units.local_len == [0, 0] {
        return;
    }
    let plan = Plan::trusted(image, header);
    text.push_str("\nProgram units\n\n");
    for part in assembly.units.in_image() {
        let at = assembly
            .lines
            .get(part.code.start)
            .filter(|_| !part.code.is_empty())
            .map_or(0, |line| line.at);
        let _ = write!(text, "  {at:04X}  {:<6}  {}", part.id.to_string(), part.name);
        let address = |place| match place {
            LocalPlace::Page(address) => Some(address),
            LocalPlace::Arena(number) => plan.v_address(LOCALS_IN_V + number),
        };
        let locals =
            (0..Area::L.size()).filter_map(|byte| Some((byte, address(part.local(byte)?)?)));
        let runs: Vec<(u16, u16)> = locals.collect();
        let runs =
            runs.chunk_by(|a, b| a.0 + 1 == b.0).filter_map(|run| run.first().zip(run.last()));
        for (&(first, address), &(last, _)) in runs {
            let _ = write!(text, "  LB{first}-LB{last} at {address:04X}");
        }
        text.push('\n');
    }
}

fn cross_reference(source: &Source, assembly: &Assembly, text: &mut String) {
    let symbols = symbols_by_address(&assembly.program.symbols);
    for (address, accesses) in &assembly.usage.accesses {
        let places: Vec<String> =
            accesses.iter().map(|access| place(source, assembly, access)).collect();
        let symbol = symbols.get(address).map(|symbol| symbol.name.as_str()).unwrap_or("");
        let _ = writeln!(text, "  {:<8}  {symbol:<20}  {}", address.to_string(), places.join(", "));
    }
}

fn symbols_by_address(symbols: &[Symbol]) -> HashMap<Address, &Symbol> {
    let addresses = symbols.iter().filter_map(|symbol| match symbol.value {
        Value::Address(address) => Some((address, symbol)),
        _ => None,
    });
    addresses.collect()
}

fn place(source: &Source, assembly: &Assembly, access: &Access) -> String {
    let selected = &assembly.code[access.instruction];
    let span = operand_span(&assembly.program, selected, access.operand);
    let (line, _) = source.position(span.start as usize);
    let how = match (access.reads, access.writes) {
        (true, true) => "rw",
        (false, true) => "w",
        _ => "r",
    };
    match source.line_in_file(line) {
        (file, line) if source.has_files() => format!("{file}:{line}{how}"),
        (_, line) => format!("{line}{how}"),
    }
}
