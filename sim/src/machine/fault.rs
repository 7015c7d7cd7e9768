//! Faults in words, the same for every machine.

use plc_isa::ImageError;
use plc_vm::Fault;

use super::PlaceOf;

/// What happened and where. `limit_ms` is what the scan that took too long was allowed.
pub(super) fn text(fault: Fault, limit_ms: u64, place_of: &PlaceOf) -> String {
    match fault {
        Fault::BadImage(ImageError { fault, at }) => format!("bad image: {} (offset {at:#06x})", fault.message()),
        Fault::Watchdog { at } => {
            format!("watchdog: the scan took longer than {limit_ms} ms; the program was {}", place(at, place_of))
        }
        Fault::UndefinedInstruction { at } => format!("there is no instruction {}", place(at, place_of)),
        Fault::ComparedPointer { at } => {
            format!("a comparison read through a pointer that leads to no value (0011) {}", place(at, place_of))
        }
        Fault::ComparedReal { at } => {
            format!("a comparison read a real that is no number (0012) {}", place(at, place_of))
        }
        Fault::ProgramChanged => "self-test: the program in flash has changed".to_string(),
        Fault::StackOverflow => "self-test: the stack has grown into the firmware's variables".to_string(),
        Fault::Hang => "the hardware watchdog: the firmware or its clock stood still".to_string(),
        Fault::Panic => "the firmware met a state that it holds for impossible".to_string(),
    }
}

fn place(at: u16, place_of: &PlaceOf) -> String {
    let place = place_of(at);
    if place.is_empty() { format!("at offset {at:#06x} of the image") } else { format!("at {place}") }
}
