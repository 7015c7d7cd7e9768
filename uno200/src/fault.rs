//! Faults of the PLC in words, with the place in the source where the program is known.

use plc_isa::ImageError;
use plc_vm::Fault;

use crate::program::Program;

/// A fault as the PLC tells it; `None` for none.
pub fn text(fault: [u8; 4], program: Option<&Program>) -> Option<String> {
    if fault == Fault::NONE {
        return None;
    }
    let place = |at: u16| {
        let line = program.and_then(|program| program.place_of(at));
        line.map_or_else(|| format!("at offset {at:#06x} of the image"), |line| format!("at {line}"))
    };
    Some(match Fault::from_bytes(fault) {
        Some(Fault::BadImage(ImageError { fault, at })) => format!("bad image: {} (offset {at:#06x})", fault.message()),
        Some(Fault::Watchdog { at }) => format!("watchdog: the scan took too long; the program was {}", place(at)),
        Some(Fault::UndefinedInstruction { at }) => format!("there is no instruction {}", place(at)),
        Some(Fault::ComparedPointer { at }) => {
            format!("a comparison read through a pointer that leads to no value (0011) {}", place(at))
        }
        Some(Fault::ComparedReal { at }) => {
            format!("a comparison read a real that is no number (0012) {}", place(at))
        }
        Some(Fault::ProgramChanged) => "self-test: the program in flash has changed".to_string(),
        Some(Fault::StackOverflow) => "self-test: the stack has grown into the firmware's variables".to_string(),
        Some(Fault::Hang) => "the hardware watchdog: the firmware or its clock stood still".to_string(),
        Some(Fault::Panic) => "the firmware met a state that it holds for impossible".to_string(),
        None => format!("a fault that this tool does not know: {fault:02X?}"),
    })
}
