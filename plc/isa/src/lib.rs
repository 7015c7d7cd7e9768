//! The instruction set described once: instruction table, operands, encoding, memory layout and
//! program image.
//!
//! Everything else derives from here: the assembler and disassembler, the interpreter, the
//! checks of the loader and the documentation. This crate knows no text beyond mnemonics, runs
//! nothing and allocates nothing.
#![no_std]

mod access;
mod addresses;
mod area;
mod core_instructions;
mod crc;
mod decode;
mod execute;
mod fetch;
mod header;
mod image;
mod kind;
mod kind_rows;
mod layout;
mod memory;
mod module_instructions;
mod modules;
mod operand;
mod plan;
mod profile;
mod reader;
mod reference;
mod retention;
mod role;
mod routines;
mod rules;
mod settings;
mod shape;
mod stack;
mod table;
mod token_table;
mod verify;

pub use access::Access;
pub use area::{AnalogInput, Area, TimerFamily, TimerResolution, timer_family, timer_resolution};
pub use crc::Crc32;
pub use decode::{DecodeError, Decoded, decode};
pub use execute::{Execute, Flow, execute};
pub use header::{
    DIRECTORY_AT, FIELDS_AT, FORMAT_AT, FORMAT_VERSION, HEADER_LEN, NATIVE_INTERFACE,
};
pub use image::{
    CRC_LEN, ENTRY_LEN, EVENT_LEN, Header, INITIAL_HEAD_LEN, ImageError, ImageFault, LABEL_LEN,
    MAGIC, NAME_LEN_MAX, ROUTINE_LEN, TIMER_LEN, V_RANGE_LEN,
};
pub use kind::{Kind, Type, Use, Written};
pub use layout::*;
pub use memory::{OfWidth, ProgramMemory};
pub use modules::{
    COUNTERS_ENTRY, COUNTERS_MODULE, EVENTS_ENTRY, EVENTS_MODULE, FREEPORT_ENTRY, FREEPORT_MODULE,
    FUNCTION_MODULE, MODULE_HEAD_LEN, MODULE_NAMES, MODULE_PREFIX, MODULES, OPERANDS_MODULE,
    PID_MODULE, PULSES_ENTRY, PULSES_MODULE, REAL_MODULE, module_of_token, needed_modules,
    state_at,
};
pub use operand::{Bit, ByteSource, Operand, Operands, Relation, WordSource};
pub use plan::{
    CounterSlot, LOCALS_IN_V, LOCALS_LEN_MAX, Plan, Region, SM_IN_V, TimerKind, TimerSlot,
    counter_bit, timer_bit,
};
pub use profile::*;
pub use reader::{OperandKind, OperandReader, kinds};
pub use reference::{Reference, Referent, pointer};
pub use retention::RetainedWalk;
pub use role::{DIVISION, Does, Many, OVERFLOW, Role, Takes};
pub use routines::{ROUTINES_MAX, Routine, kind_numbers, module_instructions, packed_stack};
pub use settings::{DEFAULT_WATCHDOG_MS, LineSettings, Parity, Retained, Settings};
pub use shape::Shape;
pub use stack::{LogicStack, STACK_LEVELS};
pub use table::{
    CORE_INSTRUCTIONS, Encoded, Form, Group, INSTRUCTIONS, Instruction, Op, PowerFlow, Rung,
    StackEffect, WIDE_PREFIX,
};
pub use token_table::{TOKEN_TABLE, TOKEN_TABLE_LEN};
pub use verify::{LOOPS_MAX, Program, verify, verify_into};
