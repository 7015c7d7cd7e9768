//! Memory as a scenario begins with it: that of a program that was just loaded, as far as it can be
//! written over the line. Local memory and special memory that a program writes stay as they are.

use anyhow::Result;
use awl_asm::Address;
use awl_sim::machine::Machine;
use awl_sim::operand::Operand;
use client::Reference;
use client::service::SET_MAX;
use plc_isa::Area;
use uno200::Client;

use super::prepared::{Prepared, reference};

/// Bytes for a request to set beside the values, and for each value of four bytes.
const SET_BESIDE: usize = 2;
const SET_LEN: usize = 7;

/// Writes it, in STOP.
pub(super) fn begin_anew(client: &mut Client, prepared: &mut Prepared) -> Result<()> {
    let room = usize::from(client.identify()?.room);
    let most = (room.saturating_sub(SET_BESIDE) / SET_LEN).clamp(1, SET_MAX);
    let values = values(prepared);
    for part in values.chunks(most) {
        client.set(part)?;
    }
    Ok(())
}

fn values(prepared: &mut Prepared) -> Vec<(Reference, u32)> {
    let mut values = Vec::new();
    for area in [Area::M, Area::S, Area::V] {
        let mut byte = 0;
        while byte < area.size() {
            let double = Operand::At(Address::Double { area, byte });
            let single = Operand::At(Address::Byte { area, byte });
            let has_double = add(prepared, double, &mut values);
            if !has_double {
                add(prepared, single, &mut values);
            }
            byte += if has_double { 4 } else { 1 };
        }
    }
    let outputs =
        (0..Area::Q.size()).map(|byte| Operand::At(Address::Byte { area: Area::Q, byte }));
    let others = (0..4).map(|number| Operand::At(Address::Accumulator(number)));
    let analog = (0..2).map(|channel| Operand::At(Address::AnalogOutput(channel)));
    let timers = (0..=u8::MAX).map(Operand::TimerCurrent);
    let counters = (0..=u8::MAX).map(Operand::CounterCurrent);
    for operand in outputs.chain(others).chain(analog).chain(timers).chain(counters) {
        add(prepared, operand, &mut values);
    }
    values
}

/// Adds the first value of an operand, if the program has it.
fn add(prepared: &mut Prepared, operand: Operand, values: &mut Vec<(Reference, u32)>) -> bool {
    match (reference(operand), prepared.fresh.read(operand)) {
        (Some(reference), Ok(value)) => {
            values.push((reference, value as u32));
            true
        }
        _ => false,
    }
}
