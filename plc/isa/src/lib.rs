//! The instruction set described once: instruction table, operands, encoding, memory layout and program image.
//!
//! Everything else derives from here: the assembler and disassembler, the interpreter, the
//! checks of the loader and the documentation. This crate knows no text beyond mnemonics, runs
//! nothing and allocates nothing.
#![no_std]

mod access;
mod area;
mod core_instructions;
mod crc;
mod decode;
mod image;
mod layout;
mod module_instructions;
mod modules;
mod operand;
mod plan;
mod reference;
mod retention;
mod rules;
mod settings;
mod stack;
mod table;
mod tokens;
mod verify;

pub use access::Access;
pub use area::{AnalogInput, Area, TimerFamily, TimerResolution, timer_family, timer_resolution};
pub use crc::Crc32;
pub use decode::{DecodeError, Decoded, decode};
pub use image::{
    CRC_LEN, DIRECTORY_AT, ENTRY_LEN, EVENT_LEN, FIELDS_AT, FORMAT_VERSION, HEADER_LEN, Header, INITIAL_HEAD_LEN,
    ImageError, ImageFault, LABEL_LEN, MAGIC, NAME_LEN_MAX, NATIVE_INTERFACE, ProgramMemory, ROUTINE_LEN, TIMER_LEN,
    V_RANGE_LEN,
};
pub use layout::*;
pub use modules::{
    COUNTERS_ENTRY, COUNTERS_MODULE, EVENTS_ENTRY, EVENTS_MODULE, FREEPORT_ENTRY, FREEPORT_MODULE, FUNCTION_MODULE,
    MODULE_HEAD_LEN, MODULE_NAMES, MODULES, OPERANDS_MODULE, PID_MODULE, PULSES_ENTRY, PULSES_MODULE, REAL_MODULE,
    ROUTINES_MAX, Routine, data_end, kind_numbers, module_instructions, module_of_token, needed_modules, packed_stack,
    state_at,
};
pub use operand::{Bit, ByteSource, Kind, Operand, OperandKind, OperandReader, Relation, WordSource, kinds};
pub use plan::{CounterSlot, Plan, Region, SM_IN_V, TimerKind, TimerSlot, counter_bit, timer_bit};
pub use reference::{Operands, Place, Reference, pointer};
pub use retention::RetainedWalk;
pub use settings::{DEFAULT_WATCHDOG_MS, LineSettings, Parity, Retained, Settings};
pub use stack::{LogicStack, STACK_LEVELS};
pub use table::{
    CORE_INSTRUCTIONS, Encoded, Execute, Flow, Form, Group, INSTRUCTIONS, Instruction, MODULE_PREFIX, Op, PowerFlow,
    StackEffect, WIDE_PREFIX, execute, execute_compact,
};
pub use tokens::{TOKEN_TABLE, TOKEN_TABLE_LEN};
pub use verify::{LOOPS_MAX, Program, verify, verify_into};
