//! The instruction set described once: instruction table, operands, encoding, memory layout and program image.
//!
//! Everything else derives from here: the assembler and disassembler, the interpreter, the
//! checks of the loader and the documentation. This crate knows no text beyond mnemonics, runs
//! nothing and allocates nothing.
#![no_std]

mod area;
mod crc;
mod decode;
mod image;
mod layout;
mod operand;
mod plan;
mod retention;
mod settings;
mod stack;
mod table;
mod tokens;
mod verify;

pub use area::{AnalogInput, Area, TimerFamily, TimerResolution, timer_family, timer_resolution};
pub use crc::Crc32;
pub use decode::{DecodeError, Decoded, decode};
pub use image::{
    CRC_LEN, ENTRY_LEN, FORMAT_VERSION, HEADER_LEN, Header, ImageError, ImageFault, LABEL_LEN, MAGIC, NAME_LEN_MAX,
    NATIVE_INTERFACE, ProgramMemory,
};
pub use layout::*;
pub use operand::{Bit, ByteSource, Kind, Operand, OperandKind, OperandReader, Relation, WordSource, kinds};
pub use plan::{CounterSlot, Plan, Region, TimerKind, TimerSlot, counter_bit, timer_bit};
pub use retention::RetainedWalk;
pub use settings::{DEFAULT_WATCHDOG_MS, Retained, Settings};
pub use stack::{LogicStack, STACK_LEVELS};
pub use table::{
    Encoded, Execute, Flow, Form, Group, INSTRUCTIONS, Instruction, Op, PowerFlow, StackEffect, WIDE_PREFIX, execute,
    execute_compact,
};
pub use tokens::{TOKEN_TABLE, TOKEN_TABLE_LEN};
pub use verify::{LOOPS_MAX, Program, verify};
