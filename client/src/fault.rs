//! Faults of the PLC with the place in the source where the program is known. The words are
//! [`Fault::message`]'s.

use plc_vm::Fault;

use crate::program::Program;

/// A fault as the PLC tells it; `None` for none.
pub fn text(bytes: [u8; 4], program: Option<&Program>) -> Option<String> {
    if bytes == Fault::NONE {
        return None;
    }
    let Some(fault) = Fault::from_bytes(bytes) else {
        return Some(format!("a fault that this tool does not know: {bytes:02X?}"));
    };
    let place = |at: u16| {
        let line = program.and_then(|program| program.place_of(at));
        line.map_or_else(
            || format!("at offset {at:#06x} of the image"),
            |line| format!("at {line}"),
        )
    };
    Some(match (fault, fault.at()) {
        (Fault::BadImage(error), _) => {
            format!("{}: {} (offset {:#06x})", fault.message(), error.fault.message(), error.at)
        }
        (_, Some(at)) => format!("{} {}", fault.message(), place(at)),
        (_, None) => fault.message().to_string(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faults_with_and_without_a_place() {
        let shown = |bytes| text(bytes, None).unwrap_or_default();
        let watchdog =
            "watchdog: the scan took too long; the program was at offset 0x1234 of the image";
        assert_eq!(shown(Fault::Watchdog { at: 0x1234 }.to_bytes()), watchdog);
        assert_eq!(
            shown(Fault::ProgramChanged.to_bytes()),
            "self-test: the program in flash has changed"
        );
        assert_eq!(shown([1, 4, 8, 0]), "bad image: the checksum does not match (offset 0x0008)");
        assert_eq!(shown([99, 0, 0, 0]), "a fault that this tool does not know: [63, 00, 00, 00]");
        assert_eq!(text(Fault::NONE, None), None);
    }
}
