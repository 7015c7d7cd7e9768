//! Which bytes of data memory deserve a register throughout the program.

use std::collections::BTreeSet;

use plc_isa::{Area, Plan, ProgramMemory, Region};

use super::effects::slots;
use super::emitter::{ALWAYS, Traffic};
use super::registers::PIN_REGISTERS;

/// A load or a store.
const ACCESS_CYCLES: u32 = 2;

/// The bytes that save most when they are pinned, as the loads and stores of a translation without
/// pins say.
pub fn choose<P: ProgramMemory>(traffic: &Traffic, plan: &Plan<P>) -> Vec<u16> {
    let slots = slots(plan);
    let is_candidate =
        |address: &u16| !slots.contains(address) && !is_changed_by_hardware(*address, plan);
    let candidates = traffic.cycles.keys().copied().filter(is_candidate);
    let mut gains: Vec<(i64, u16)> =
        candidates.map(|address| (gain(traffic, address), address)).collect();
    gains.retain(|&(gain, _)| gain > 0);
    gains.sort_unstable_by_key(|&(gain, address)| (-gain, address));
    gains.truncate(PIN_REGISTERS.len());
    gains.into_iter().map(|(_, address)| address).collect()
}

/// Whether counters, pulses and the serial line may change the byte at any time: special memory but
/// for its first two bytes, and current values.
fn is_changed_by_hardware<P: ProgramMemory>(address: u16, plan: &Plan<P>) -> bool {
    match plan.region(address) {
        Some(Region::Byte { area: Area::Sm, byte, .. }) => byte > 1,
        Some(Region::HighSpeedCounter(_)) => true,
        _ => false,
    }
}

/// Weighted cycles saved: what is spent now, without the load at the start, the store at the end
/// and both around calls.
fn gain(traffic: &Traffic, address: u16) -> i64 {
    let now = traffic.cycles.get(&address).copied().unwrap_or(0);
    let is_stored = traffic.stored.contains(&address);
    let once = ACCESS_CYCLES * ALWAYS * (1 + u32::from(is_stored));
    let calls = traffic.calls.iter().map(|(effects, weight)| {
        let accesses =
            u32::from(effects.writes(address)) + u32::from(is_stored && effects.touches(address));
        accesses * ACCESS_CYCLES * weight
    });
    i64::from(now) - i64::from(once) - i64::from(calls.sum::<u32>())
}

/// Those of the bytes that the program changes.
pub fn changed(traffic: &Traffic, pinned: &[u16]) -> BTreeSet<u16> {
    pinned.iter().copied().filter(|address| traffic.stored.contains(address)).collect()
}
