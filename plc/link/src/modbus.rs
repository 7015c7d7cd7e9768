//! The functions of Modbus on bits and registers. What their numbers stand for is docs/protocol.md.

use plc_isa::{AC_START, AIN_START, AIW_START, AQW_START, COUNTER_SLOT_LEN, HC0, TIMER_SLOT_LEN};
use plc_vm::Memory;

use crate::place::{page_len, page_start, v_address, value_address};
use crate::request::{Answered, Exception, Request};
use crate::station::Station;

const READ_DISCRETE_INPUTS: u8 = 2;
const READ_INPUT_REGISTERS: u8 = 4;
const WRITE_COIL: u8 = 5;
const WRITE_REGISTER: u8 = 6;
const READ_AND_WRITE: u8 = 23;

/// Numbers from the start of one block of bits to that of the next.
const BLOCK: u16 = 1000;
/// Areas whose bits can be written, a bit each: Q, M, S.
const WRITABLE_BITS: u8 = 1 << 1 | 1 << 2 | 1 << 4;

/// Most bits and registers that can be read.
const BITS_MAX: u16 = 2000;
const REGISTERS_MAX: u16 = 125;
/// Most values of timers or counters at once: they do not lie side by side.
const VALUES_MAX: u16 = 32;

/// Blocks of registers.
const V_REGISTERS: u16 = 5120;
const TIMERS: u16 = 6000;
const COUNTERS: u16 = 7000;
const OTHERS: u16 = 8000;
const OTHERS_END: u16 = 8014;
const ANALOG_INPUT_REGISTERS: u16 = 32;

/// Bits or registers in data memory.
#[derive(Clone, Copy)]
struct Run {
    /// Data address of the first.
    address: u16,
    /// Registers: bytes from one to the next. Bits: the place of the first in its byte.
    step: u8,
}

impl Run {
    const NONE: Run = Run { address: 0, step: 2 };
}

/// Functions 1 to 6, 15, 16 and 23.
pub(crate) fn answer<S: Station>(request: &mut Request<S>, function: u8) -> Answered {
    let is_bits = matches!(function, 1 | READ_DISCRETE_INPUTS | WRITE_COIL | 15);
    let reads = function < WRITE_COIL || function == READ_AND_WRITE;
    let writes = function >= WRITE_COIL;
    // Function 23 says what to write after what to read.
    let base = if function == READ_AND_WRITE { 5 } else { 1 };
    let (mut len, mut data, mut written) = (5, 3, request.word(base + 2));
    if function > WRITE_REGISTER {
        let bytes = byte_count(is_bits, written)?;
        data = base + 5;
        len = bytes.saturating_add(data);
        if request.byte(base + 4) != bytes {
            return Err(Exception::Value);
        }
    } else {
        if function == WRITE_COIL && written != 0 && written != 0xFF00 {
            return Err(Exception::Value);
        }
        written = 1;
    }
    request.expect_len(len)?;
    let (read, mut bytes_read) = (request.word(3), 0);
    if reads {
        bytes_read = byte_count(is_bits, read)?;
        request.expect_room(bytes_read + 2)?;
    }
    let (mut to, mut from) = (Run::NONE, Run::NONE);
    if reads {
        let first = request.word(1);
        from = request.find(function, first, read, is_bits, false)?;
    }
    if writes {
        let first = request.word(base);
        to = request.find(function, first, written, is_bits, true)?;
    }
    let (data, answer) = (request.at(data), request.at(2));
    let memory = request.memory();
    if writes {
        if is_bits {
            write_bits(memory, data, to, written);
        } else {
            copy_words(memory, Run { address: data, step: 2 }, to, written);
        }
    }
    if !reads {
        return Ok(5);
    }
    if is_bits {
        read_bits(memory, from, answer, read);
    } else {
        copy_words(memory, from, Run { address: answer, step: 2 }, read);
        if function == READ_INPUT_REGISTERS {
            clear_missing_inputs(memory, from, answer, read);
        }
    }
    request.set_byte(1, bytes_read);
    Ok(bytes_read + 2)
}

/// Bytes that so many bits or registers take.
fn byte_count(is_bits: bool, count: u16) -> Answered {
    let (max, bytes) =
        if is_bits { (BITS_MAX, count.wrapping_add(7) >> 3) } else { (REGISTERS_MAX, count << 1) };
    if count == 0 || count > max { Err(Exception::Value) } else { Ok(bytes as u8) }
}

impl<S: Station> Request<'_, S> {
    /// Where `count` bits or registers from number `first` on are.
    fn find(
        &self,
        function: u8,
        first: u16,
        count: u16,
        is_bits: bool,
        writes: bool,
    ) -> Result<Run, Exception> {
        if is_bits {
            find_bits(function, first, count, writes)
        } else {
            self.find_registers(function, first, count, writes)
        }
    }

    fn find_registers(
        &self,
        function: u8,
        first: u16,
        count: u16,
        writes: bool,
    ) -> Result<Run, Exception> {
        let step = match first {
            TIMERS..COUNTERS => TIMER_SLOT_LEN,
            COUNTERS..OTHERS => COUNTER_SLOT_LEN,
            _ => 2,
        };
        if step != 2 && count > VALUES_MAX {
            return Err(Exception::Value);
        }
        let address = self.register(function, first);
        let last = self.register(function, first.wrapping_add(count - 1));
        // Where the last one follows the first at its distance, so do those between: numbers ascend
        // with addresses.
        if address == 0
            || last != address + step * (count - 1)
            || writes && address < AQW_START && last >= HC0
        {
            return Err(Exception::Address);
        }
        Ok(Run { address, step: step as u8 })
    }

    /// Data address of a register; 0: there is none of this number.
    fn register(&self, function: u8, number: u16) -> u16 {
        let program = self.station.plc().program();
        if function == READ_INPUT_REGISTERS {
            return if number < ANALOG_INPUT_REGISTERS { AIW_START + 2 * number } else { 0 };
        }
        match number {
            0..V_REGISTERS => v_address(program, 2 * number, 2),
            TIMERS..COUNTERS => value_address(program, true, number - TIMERS),
            COUNTERS..OTHERS => value_address(program, false, number - COUNTERS),
            OTHERS..OTHERS_END => AC_START + 2 * (number - OTHERS),
            _ => 0,
        }
    }
}

fn find_bits(function: u8, first: u16, count: u16, writes: bool) -> Result<Run, Exception> {
    let (mut block, mut bit) = (0u8, first);
    while bit >= BLOCK {
        bit -= BLOCK;
        block += 1;
    }
    let area = match block {
        0 if function == READ_DISCRETE_INPUTS => 0,
        6 => 0,
        _ => block + 1,
    };
    let is_there = area <= 6 && bit + count <= 8 * u16::from(page_len(area));
    if !is_there || writes && WRITABLE_BITS >> area & 1 == 0 {
        return Err(Exception::Address);
    }
    Ok(Run { address: page_start(area) + (bit >> 3), step: bit as u8 & 7 })
}

/// Copies registers, whose high byte comes first in data memory and on the line.
fn copy_words(memory: &mut Memory, from: Run, to: Run, count: u16) {
    if from.step == to.step {
        return memory.copy(from.address, to.address, 2 * count);
    }
    let (mut from_at, mut to_at) = (from.address, to.address);
    for _ in 0..count {
        memory.copy(from_at, to_at, 2);
        from_at += u16::from(from.step);
        to_at += u16::from(to.step);
    }
}

/// Analog inputs that the board does not have are 0.
fn clear_missing_inputs(memory: &mut Memory, from: Run, answer: u16, count: u16) {
    let (mut from_at, mut at) = (from.address, answer);
    for _ in 0..count {
        if from_at >= AIN_START {
            memory.set_word(at, 0);
        }
        from_at += 2;
        at += 2;
    }
}

/// Bits to bytes of the frame, the first in bit 0. The rest of the last byte is 0.
fn read_bits(memory: &mut Memory, from: Run, answer: u16, count: u16) {
    let (mut from_at, mut at, mut left) = (from.address, answer, count);
    let mut low = memory.byte(from_at);
    loop {
        from_at += 1;
        let high = memory.byte(from_at);
        let bits = (u16::from_le_bytes([low, high]) >> from.step) as u8;
        memory.set_byte(at, bits & mask(left));
        if left <= 8 {
            return;
        }
        left -= 8;
        low = high;
        at += 1;
    }
}

/// The other way.
fn write_bits(memory: &mut Memory, data: u16, to: Run, count: u16) {
    let (mut from_at, mut at, mut left) = (data, to.address, count);
    loop {
        let bits = u16::from(memory.byte(from_at)) << to.step;
        let mask = (u16::from(mask(left)) << to.step).to_le_bytes();
        for (bits, mask) in bits.to_le_bytes().into_iter().zip(mask) {
            let byte = memory.byte(at);
            memory.set_byte(at, byte & !mask | bits & mask);
            at += 1;
        }
        if left <= 8 {
            return;
        }
        left -= 8;
        from_at += 1;
        at -= 1;
    }
}

/// The bits of a byte that holds so many.
fn mask(count: u16) -> u8 {
    if count < 8 { (1 << count) - 1 } else { 0xFF }
}
