//! Tests of the `//#` lines: system settings, retained ranges and what can be wrong with them.

use super::*;

#[test]
fn settings() {
    let program = good_program(
        "//# pullup I0.0-I0.2, I0.5\n  //#invert I0.3, Q0.0 - Q0.4 // relays\n//# WATCHDOG 2 s\n\
         //# scan 10ms\n//# filter 16\n\
         //# name \"Station 1\"\n//################\n//#1 is a comment\n//#\n// # pullup x\n\
         LD I0.0 //# foo",
    );
    let settings = program.settings;
    assert_eq!(
        (settings.pullup, settings.invert_inputs, settings.invert_outputs),
        (0b100111, 0b1000, 0b11111)
    );
    assert_eq!((settings.watchdog_ms, settings.scan_ms, settings.filter), (2000, 10, 4));
    assert_eq!(program.name.as_deref(), Some("Station 1"));
    assert_eq!(good_program("//# name Station 1 // x").name.as_deref(), Some("Station 1"));
    assert_eq!(good_program("//# scan 0ms").settings.scan_ms, 0);
}

#[test]
fn retained_ranges() {
    let program = good_program(
        "//# retain VB0-VB31, C0-C9, T0-T3, MB0-MB13\n//# retain VW40, VW50-VW52, C12, T64",
    );
    let shown: Vec<_> = program
        .retained
        .iter()
        .map(|retained| {
            format!(
                "{}{}+{}",
                retained.range.area.name(),
                retained.range.first,
                retained.range.count
            )
        })
        .collect();
    assert_eq!(shown, ["V0+32", "C0+10", "T0+4", "M0+14", "V40+2", "V50+4", "C12+1", "T64+1"]);
    bad(
        "//# retain T30-T33, VB5-VB1, I0.0, VB0-VW2, VB0-C1, VB1-",
        &[
            "E0020 1:12 `T30-T33`: T30-T33: T32 is no timer of TONR, and only those are retained",
            "E0020 1:21 `VB5-VB1`: VB5-VB1: a range begins with its lower address",
            "E0020 1:30 `I0.0`: I0.0: cannot be retained",
            "E0020 1:36 `VB0-VW2`: VB0-VW2: a range goes from one address to another of the same \
             kind",
            "E0020 1:45 `VB0-C1`: VB0-C1: a range goes from one address to another of the same \
             kind",
            "E0020 1:57 ``: an address is missing here",
        ],
    );
}

#[test]
fn memory_ranges() {
    let program = good_program("//# memory VB0-VB99, VW200\n//# memory VD300-VD304");
    let shown: Vec<_> = program.memory.iter().map(|&(first, count, _)| (first, count)).collect();
    assert_eq!(shown, [(0, 100), (200, 2), (300, 8)]);
    bad(
        "//# memory\n//# memory MB0, VB5-VB1, VB0-MB4",
        &[
            "E0020 1:5 `memory`: memory: ranges are missing, such as VB0-VB99",
            "E0020 2:12 `MB0`: MB0: only bytes, words and double words of V memory are asked for",
            "E0020 2:17 `VB5-VB1`: VB5-VB1: a range begins with its lower address",
            "E0020 2:26 `VB0-MB4`: VB0-MB4: a range goes from one address to another of the same \
             kind",
        ],
    );
}

#[test]
fn serial_line() {
    let set = |text: &str| {
        let settings = good_program(text).settings;
        (settings.modbus_address, settings.line)
    };
    assert_eq!(set("LD I0.0"), (1, 0));
    assert_eq!(set("//# modbus address 5 baud 19200 parity even"), (5, 0x13));
    assert_eq!(set("//# MODBUS Parity Odd ADDRESS 247 // slow\n"), (247, 0x20));
    assert_eq!(set("//# modbus baud 1200"), (1, 7));
    assert_eq!(set("//# modbus parity none baud 115200"), (1, 0));
    bad(
        "//# modbus adress 5 baud 19000 parity evn\n",
        &[
            "E0020 1:12 `adress`: adress: cannot be set for modbus -> address",
            "E0020 1:26 `19000`: 19000: the board does not have this rate -> 19200",
            "E0020 1:39 `evn`: evn: is no parity -> even",
        ],
    );
    bad(
        "//# modbus address 0 baud fast 7\n//# modbus baud 9600",
        &[
            "E0020 1:20 `0`: 0: a Modbus address is 1 to 247",
            "E0020 1:27 `fast`: fast: the board does not have this rate",
            "E0020 1:32 `7`: 7: cannot be set for modbus",
            "E0020 2:5 `modbus`: modbus: is already set (first set here: 1:5 `modbus address 0 \
             baud fast 7`)",
        ],
    );
    bad(
        "//# modbus baud address 248 parity odd baud 300 address\n",
        &[
            "E0020 1:12 `baud`: baud: its value is missing",
            "E0020 1:25 `248`: 248: a Modbus address is 1 to 247",
            "E0020 1:40 `baud`: baud: is already set (first set here: 1:12 `baud`)",
            "E0020 1:49 `address`: address: is already set (first set here: 1:17 `address`)",
        ],
    );
    bad(
        "//# modbus",
        &["E0020 1:5 `modbus`: modbus: address, baud or parity is missing, such as address 5"],
    );
}

#[test]
fn setting_errors() {
    bad(
        "//# pulup I0.0\n//# pullup\n//# pullup I0.6, Q0.0, IB0, I0.8, I0.x\n\
         //# invert Q0.4-Q1.0, M0.0",
        &[
            "E0020 1:5 `pulup`: pulup: no such setting -> pullup",
            "E0020 2:5 `pullup`: pullup: points are missing, such as I0.0-I0.5",
            "E0020 3:12 `I0.6`: I0.6: the Uno has no pin for it",
            "E0020 3:18 `Q0.0`: Q0.0: pullup is for inputs, not for Q",
            "E0020 3:24 `IB0`: IB0: only single inputs and outputs such as I0.0 and Q0.0 have pins",
            "E0005 3:29 `I0.8`: I0.8: a byte has bits 0 to 7 -> I1.0",
            "E0020 3:35 `I0.x`: I0.x: is no address",
            "E0020 4:12 `Q0.4-Q1.0`: Q0.4-Q1.0: the Uno has no pin for it",
            "E0020 4:23 `M0.0`: M0.0: only single inputs and outputs such as I0.0 and Q0.0 have \
             pins",
        ],
    );
    bad(
        "//# watchdog 5\n//# watchdog 0ms\n//# scan 61s\n//# scan\n//# scan 5min\n//# scan ms",
        &[
            "E0020 1:14 `5`: 5: a time has a unit, ms or s -> 5ms",
            "E0020 2:14 `0ms`: 0ms: the time for watchdog is 1 to 60000 ms",
            "E0020 3:10 `61s`: 61s: the time for scan is 0 to 60000 ms",
            "E0020 4:5 `scan`: scan: a time is missing, such as 500ms",
            "E0020 5:10 `5min`: 5min: is no time; write a whole number with ms or s",
            "E0020 6:10 `ms`: ms: is no time; write a whole number with ms or s",
        ],
    );
    bad(
        "//# scan 5ms\n//# scan 6ms\n//# name a\n//# name b",
        &[
            "E0020 2:5 `scan`: scan: is already set (first set here: 1:5 `scan 5ms`)",
            "E0020 4:5 `name`: name: is already set (first set here: 3:5 `name a`)",
        ],
    );
    bad(
        "//# name\n//# name \"x\n//# name ä\n//# name 1234567890123456789012345",
        &[
            "E0020 1:5 `name`: name: a name is missing",
            "E0020 2:10 `\"x`: \"x: the quote is not closed",
            "E0020 3:10 `ä`: ä: ä cannot be in a name, only printable ASCII",
            "E0020 4:10 `1234567890123456789012345`: 1234567890123456789012345: a name has at \
             most 24 characters",
        ],
    );
}
