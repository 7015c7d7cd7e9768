//! The budgets of the board and of compiled programs that `cargo xtask bench` and `size` enforce,
//! with their reasons. Those of this computer are in `speed`.

/// Bytes of flash for the firmware, initial values of variables included: what lies below the
/// program slot.
pub const FIRMWARE_FLASH_MAX: u64 = plc_isa::SLOT_START as u64;

/// Bytes of constants and initial values in SRAM. Every table and every text that the compiler puts
/// there by itself costs twice; what is there now are a few initial values.
pub const FIRMWARE_DATA_MAX: u64 = 32;

/// Bytes of SRAM for the firmware's own variables: what data memory and the deepest stack leave.
/// The plan of a program is in them; since it is placed there at once, the stack is a hundred bytes
/// less deep. So are 16 forced operands.
pub const FIRMWARE_VARIABLES_MAX: u64 = 450;

/// Cycles of a bit instruction in the interpreter, on average over a realistic mix. The S7-200
/// takes 3.5 and has hardware for it; the best interpreters known for this chip take over 30.
pub const INTERPRETER_BIT_CYCLES_MAX: f64 = 20.0;

/// Cycles of a word instruction in the interpreter, on average over the same mix.
pub const INTERPRETER_WORD_CYCLES_MAX: f64 = 40.0;

/// Cycles of the program of 1,024 instructions in the interpreter: 1.35 ms.
pub const INTERPRETER_STEPS_CYCLES_MAX: f64 = 21_600.0;

/// Cycles of the station's program in the interpreter. The PLC of 2015 takes 5,518.
pub const INTERPRETER_STATION_CYCLES_MAX: f64 = 2_000.0;

/// Cycles of the station's whole scan with it, unless a millisecond passes in it. The PLC of 2015
/// takes 15,873.
pub const INTERPRETER_STATION_SCAN_CYCLES_MAX: f64 = 2_600.0;

/// Cycles that a scan takes beside its program, unless a millisecond has passed: then clock, timers
/// and self-test are due.
pub const SCAN_OVERHEAD_CYCLES_MAX: f64 = 400.0;

/// Cycles of a bit instruction in machine code with the process image in SRAM. The S7-200 takes
/// 3.5.
pub const NATIVE_BIT_CYCLES_MAX: f64 = 3.6;

/// The same with the most used bytes of the process image in registers.
pub const NATIVE_PINNED_BIT_CYCLES_MAX: f64 = 2.0;

/// Cycles of the program of 1,024 instructions in machine code: 0.30 ms.
pub const NATIVE_STEPS_CYCLES_MAX: f64 = 4_800.0;

/// Cycles of the station's program in machine code.
pub const NATIVE_STATION_CYCLES_MAX: f64 = 450.0;

/// Cycles of 1,024 bit instructions on the Pico: 8 each, 0.06 us. The S7-200 takes 0.22.
pub const PICO_BITS_CYCLES_MAX: f64 = 8_192.0;

/// Cycles of the program of 1,024 instructions on the Pico: 0.44 ms.
pub const PICO_STEPS_CYCLES_MAX: f64 = 55_000.0;

/// Cycles of a scan on the Pico beside its program, unless a millisecond has passed or an input has
/// changed: 20 us.
pub const PICO_OVERHEAD_CYCLES_MAX: f64 = 2_500.0;

/// Bytes and cycles of Structured Text and of charts, in those of hand-written AWL of the same
/// behaviour: the median of the examples. Beside what the language says of edges there is nothing
/// that a person would not write.
pub const COMPILED_MEDIAN_MAX: f64 = 1.3;

/// The same, of each example.
pub const COMPILED_RATIO_MAX: f64 = 2.0;

/// The same of diagrams: blocks of the library do more than the instruction PID, which is a module
/// whose bytes do not count here.
pub const DIAGRAM_RATIO_MAX: f64 = 7.0;
