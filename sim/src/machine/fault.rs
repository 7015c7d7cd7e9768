//! Faults with their place in the program, the same for every machine. The words are
//! [`Fault::message`]'s.

use plc_vm::Fault;

use super::PlaceOf;

/// What happened and where. `limit_ms` is what the scan that took too long was allowed.
pub(super) fn text(fault: Fault, limit_ms: u64, place_of: &PlaceOf) -> String {
    match (fault, fault.at()) {
        (Fault::BadImage(error), _) => {
            format!("{}: {} (offset {:#06x})", fault.message(), error.fault.message(), error.at)
        }
        (Fault::Watchdog { at }, _) => {
            format!(
                "watchdog: the scan took longer than {limit_ms} ms; the program was {}",
                place(at, place_of)
            )
        }
        (_, Some(at)) => format!("{} {}", fault.message(), place(at, place_of)),
        (_, None) => fault.message().to_string(),
    }
}

fn place(at: u16, place_of: &PlaceOf) -> String {
    let place = place_of(at);
    if place.is_empty() {
        format!("at offset {at:#06x} of the image")
    } else {
        format!("at {place}")
    }
}
