//! Why avrdude failed: read from its exit and its output. No words for people here.

use std::io;

use plc_isa::UNO;

use super::avrdude::Ended;

/// What went wrong.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Cause {
    /// There is no such program.
    NotInstalled,
    /// It cannot be started; why.
    NotStarted(String),
    /// It did not come to an end.
    TimedOut,
    /// There is no such port.
    NoPort,
    /// The port is there and may not be opened.
    NoPermission,
    /// Another program has the port.
    PortBusy,
    /// It is a file of another kind.
    NotSerial,
    /// No bootloader answers, or not in its language.
    NoAnswer,
    /// The chip is another one: its name if avrdude knows it, or else its signature.
    OtherChip(String),
    /// The chip does not say what it is.
    NoSignature,
    /// The flash does not hold what was written; where it differs first.
    Mismatch(Option<String>),
    /// The firmware that must be there is not.
    OtherFirmware,
    /// Anything else.
    Unknown,
}

/// What made it fail, if it did. `is_expected`: the firmware was compared and not written.
pub fn of(ended: &Ended, is_expected: bool) -> Option<Cause> {
    match &ended.status {
        Ok(Some(status)) if status.success() => None,
        Ok(Some(_)) => Some(match in_output(&ended.output) {
            Cause::Mismatch(Some(at)) if is_expected && is_in_firmware(&at) => Cause::OtherFirmware,
            cause => cause,
        }),
        Ok(None) => Some(Cause::TimedOut),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Some(Cause::NotInstalled),
        Err(error) => Some(Cause::NotStarted(error.to_string())),
    }
}

/// Whether an address such as `0x6000` is before the program slot.
fn is_in_firmware(at: &str) -> bool {
    let digits = at.trim_start_matches("0x");
    u32::from_str_radix(digits, 16).is_ok_and(|at| at < UNO.slot_start.into())
}

/// What the output tells. The words are those of avrdude 7; 6 and 8 write a few differently.
fn in_output(output: &str) -> Cause {
    let lower = output.to_ascii_lowercase();
    let says = |words: &str| lower.contains(words);
    if says("cannot open port") || says("can't open device") {
        return unopened(&lower);
    }
    if says("cannot set attributes for port") || says("can't set attributes for device") {
        return Cause::NotSerial;
    }
    if says("invalid device signature") {
        return Cause::NoSignature;
    }
    if says("expected signature for") {
        return Cause::OtherChip(chip(output).unwrap_or_else(|| "unknown".into()));
    }
    if says("verification mismatch") || says("verification error") {
        return Cause::Mismatch(mismatch_address(&lower));
    }
    if says("not in sync") || says("programmer is not responding") {
        return Cause::NoAnswer;
    }
    Cause::Unknown
}

/// The reason is the system's: that of Windows comes second. There an open port refuses access to
/// others.
fn unopened(lower: &str) -> Cause {
    let says = |words: &str| lower.contains(words);
    if says("no such file") || says("no such device") || says("cannot find the") {
        Cause::NoPort
    } else if says("permission denied") {
        Cause::NoPermission
    } else if says("resource busy") || says("access is denied") {
        Cause::PortBusy
    } else {
        Cause::Unknown
    }
}

/// The chip in `device signature = 0x1e9406 (probably m168)`, or from version 8 on `= 1E 94 06
/// (ATmega168)`.
fn chip(output: &str) -> Option<String> {
    let line =
        output.lines().find(|line| line.to_ascii_lowercase().contains("device signature ="))?;
    let (_, value) = line.split_once('=')?;
    let (signature, name) = match value.split_once('(') {
        Some((signature, rest)) => (signature, rest.split(')').next()),
        None => (value, None),
    };
    match name
        .map(|name| name.trim_start_matches("probably ").trim())
        .filter(|name| !name.is_empty())
    {
        // The short names of avrdude's -p.
        Some(name) if name.starts_with('m') => {
            Some(format!("ATmega{}", name[1..].to_ascii_uppercase()))
        }
        Some(name) => Some(name.to_string()),
        None => Some(format!("signature {}", signature.trim())),
    }
}

/// The address in `device 0x02 != input 0x03 at addr 0x6000`, in version 6 `first mismatch at byte
/// 0x6000`.
fn mismatch_address(lower: &str) -> Option<String> {
    let rest = ["at addr ", "at byte "].iter().find_map(|words| lower.split_once(words))?.1;
    let end = rest.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(rest.len());
    Some(rest[..end].to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What Debian's avrdude 7.1 wrote, to ports and responders made for it. The lines that only a
    /// port without modem lines gets are left out.
    const REAL: [(&str, Cause); 9] = [
        (
            "avrdude OS error: cannot open port /dev/ttyACM9: No such file or directory\n\
             avrdude error: unable to open programmer arduino on port /dev/ttyACM9\n\n\
             avrdude done.  Thank you.\n",
            Cause::NoPort,
        ),
        (
            "avrdude OS error: cannot open port /dev/ttyACM0: Permission denied\n\
             avrdude error: unable to open programmer arduino on port /dev/ttyACM0\n",
            Cause::NoPermission,
        ),
        (
            "avrdude OS error: cannot open port /dev/pts/0: Device or resource busy\n\
             avrdude error: unable to open programmer arduino on port /dev/pts/0\n",
            Cause::PortBusy,
        ),
        (
            "avrdude OS error: cannot set attributes for port prog.awl: Inappropriate ioctl for \
             device\n\
             avrdude error: unable to open programmer arduino on port prog.awl\n",
            Cause::NotSerial,
        ),
        (
            "avrdude error: programmer is not responding\navrdude warning: attempt 10 of 10: not \
             in sync: resp=0x00\n\
             avrdude error: unable to open programmer arduino on port /dev/pts/0\n",
            Cause::NoAnswer,
        ),
        (
            "avrdude: AVR device initialized and ready to accept instructions\n\
             avrdude: device signature = 0x000000 (retrying)\n\
             avrdude: device signature = 0x000000\n\
             avrdude error: Yikes!  Invalid device signature.\n\
             avrdude error: expected signature for ATmega328P is 1E 95 0F\n",
            Cause::NoSignature,
        ),
        (
            "avrdude warning: verification mismatch\n        device 0x02 != input 0x03 at addr \
             0x6000 (error)\n\
             avrdude error: verification mismatch\n",
            Cause::Mismatch(None),
        ),
        (
            "avrdude: device signature = 0x1e9406 (probably m168)\n\
             avrdude error: expected signature for ATmega328P is 1E 95 0F\n\
             \u{20}       double check chip or use -F to override this check\n",
            Cause::OtherChip(String::new()),
        ),
        ("avrdude error: unable to open programmer arduino on port /dev/null\n", Cause::Unknown),
    ];

    #[test]
    fn real_outputs_have_their_causes() {
        for (output, expected) in REAL {
            let cause = in_output(output);
            let same = std::mem::discriminant(&cause) == std::mem::discriminant(&expected);
            assert!(same, "{cause:?} instead of {expected:?} for:\n{output}");
        }
    }

    #[test]
    fn the_chip_by_name_or_signature() {
        let chip_of = |signature: &str| {
            let output = format!(
                "avrdude: device signature = {signature}\navrdude error: expected signature for \
                 ATmega328P is 1E 95 0F\n"
            );
            match in_output(&output) {
                Cause::OtherChip(chip) => chip,
                other => panic!("{other:?}"),
            }
        };
        assert_eq!(chip_of("0x1e9406 (probably m168)"), "ATmega168");
        assert_eq!(chip_of("0x1e9801 (probably m2560)"), "ATmega2560");
        assert_eq!(chip_of("0x1e7777"), "signature 0x1e7777");
        // Version 8.
        assert_eq!(chip_of("1E 94 06 (ATmega168)"), "ATmega168");
    }

    #[test]
    fn the_first_address_that_differs() {
        let seven = "avrdude warning: verification mismatch\n        device 0x02 != input 0x03 \
            at addr 0x6000 (error)\n";
        assert_eq!(in_output(seven), Cause::Mismatch(Some("0x6000".into())));
        let six =
            "avrdude: verification error, first mismatch at byte 0x0042\n         0x00 != 0x0c\n";
        assert_eq!(in_output(six), Cause::Mismatch(Some("0x0042".into())));
    }

    #[test]
    fn words_of_other_versions_and_systems() {
        let open = |reason: &str| {
            in_output(&format!("avrdude: ser_open(): can't open device \"COM5\": {reason}"))
        };
        assert_eq!(open("The system cannot find the file specified."), Cause::NoPort);
        assert_eq!(open("Access is denied."), Cause::PortBusy);
        assert_eq!(open("No such file or directory"), Cause::NoPort);
        assert_eq!(open("Permission denied"), Cause::NoPermission);
        let six = "avrdude: stk500_recv(): programmer is not responding\n\
                   avrdude: stk500_getsync() attempt 10 of 10: not in sync: resp=0x1b\n";
        assert_eq!(in_output(six), Cause::NoAnswer);
    }

    #[test]
    fn the_end_counts_before_the_output() {
        let ended = |status| Ended {
            status,
            output: "avrdude error: programmer is not responding\n".into(),
        };
        assert_eq!(of(&ended(Ok(None)), false), Some(Cause::TimedOut));
        assert_eq!(
            of(&ended(Err(io::ErrorKind::NotFound.into())), false),
            Some(Cause::NotInstalled)
        );
        assert!(matches!(
            of(&ended(Err(io::ErrorKind::PermissionDenied.into())), false),
            Some(Cause::NotStarted(_))
        ));
        assert_eq!(of(&ended(Ok(Some(Default::default()))), false), None, "it succeeded after all");
    }
}
