//! References of the service functions, and where in data memory what they name is.

use plc_isa::{
    AC_START, AIN_START, AIW_START, ANALOG_OUTPUTS, AQW_START, ARENA_START, C_BITS_START, HC0,
    L_START, M_START, PAGE_START, Program, ProgramMemory, S_START, SM_IN_V, SM_START, T_BITS_START,
};
use plc_vm::Memory;

/// Sizes of values in a reference. Below them: a bit.
pub(crate) const BYTE: u8 = 8;
pub(crate) const WORD: u8 = 9;
const DOUBLE: u8 = 10;

/// Areas in a reference. I, Q, M, SM, S, T, C, L have the order that they have in the bit page.
const Q: u8 = 1;
const SM: u8 = 3;
pub(crate) const T: u8 = 5;
pub(crate) const C: u8 = 6;
const L: u8 = 7;
const V: u8 = 8;
const SECOND_PAGE: u8 = 9;

/// What a reference may name: a bit for each area; after them one for each other part of the
/// second page, and one for bits of T and C.
pub(crate) const ANYTHING: u16 = u16::MAX;
/// I, Q, M, V, AIW, AQW.
pub(crate) const FORCED: u16 = 1 | 1 << Q | 1 << 2 | 1 << V | 1 << SECOND_PAGE | 1 << OUTPUTS;
/// Q, M, S, V, current values of T and C, AC, AQW.
pub(crate) const WRITABLE: u16 =
    1 << Q | 1 << 2 | 1 << 4 | 1 << T | 1 << C | 1 << V | 1 << ACCUMULATORS | 1 << OUTPUTS;
const RAW: u8 = 10;
const ACCUMULATORS: u8 = 11;
const COUNTERS: u8 = 12;
const OUTPUTS: u8 = 13;
const NUMBERED_BITS: u8 = 14;

/// Where the parts of the second page begin.
const AIN: u16 = AIN_START - AIW_START;
const AC: u16 = AC_START - AIW_START;
const HC: u16 = HC0 - AIW_START;
const AQW: u16 = AQW_START - AIW_START;
const END: u16 = AQW + 2 * ANALOG_OUTPUTS as u16;

const _: () =
    assert!(page_start(2) == M_START && page_start(SM) == SM_START && page_start(4) == S_START);
const _: () = assert!(
    page_start(T) == T_BITS_START && page_start(C) == C_BITS_START && page_start(L) == L_START
);

/// Where a value is: a data address and its size. Bits 0 to 11 are those of the address; bits 12 to
/// 15 the size: 0 to 7 that bit of a byte, 8 a byte, 9 a word, 10 a double word; bits 16 and 17 are
/// bits 12 and 13 of the address. Many wait in the frame: in two bytes where they can.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SizedAddress(pub u32);

/// Bytes of a place in data memory that ends at this address. It lies there with its low byte
/// first.
pub(crate) const fn place_len(end: u16) -> u8 {
    if end > 1 << ADDRESS_BITS { 3 } else { 2 }
}

/// Bits of an address in the lower word of a place.
const ADDRESS_BITS: u32 = 12;

impl SizedAddress {
    /// No place: a reference that names nothing.
    pub const NONE: SizedAddress = SizedAddress(0);

    fn new(address: u16, size: u8) -> SizedAddress {
        let (upper, lower) = (address >> ADDRESS_BITS, address & ((1 << ADDRESS_BITS) - 1));
        SizedAddress(u32::from(upper) << 16 | u32::from(lower | u16::from(size) << ADDRESS_BITS))
    }

    /// The data address.
    pub const fn address(self) -> u16 {
        self.upper() << ADDRESS_BITS | self.0 as u16 & ((1 << ADDRESS_BITS) - 1)
    }

    /// The size, as in a reference.
    pub const fn size(self) -> u8 {
        (self.0 as u16 >> ADDRESS_BITS) as u8
    }

    /// The bits of the address that have no room in the lower word.
    pub(crate) const fn upper(self) -> u16 {
        (self.0 >> 16) as u16
    }

    /// The place that lies at a data address in so many bytes.
    pub(crate) fn read(memory: &Memory, at: u16, len: u8) -> SizedAddress {
        let upper = if len > 2 { memory.byte(at + 2) } else { 0 };
        SizedAddress(u32::from(upper) << 16 | u32::from(memory.word(at).swap_bytes()))
    }

    /// Lays it there.
    pub(crate) fn write(self, memory: &mut Memory, at: u16, len: u8) {
        memory.set_word(at, (self.0 as u16).swap_bytes());
        if len > 2 {
            memory.set_byte(at + 2, self.upper() as u8);
        }
    }

    /// The value, of the four bytes that begin at its address.
    pub const fn value_in(self, bytes: u32) -> u32 {
        match self.size() {
            DOUBLE => bytes,
            WORD => bytes >> 16,
            BYTE => bytes >> 24,
            bit => bytes >> 24 >> bit & 1,
        }
    }

    /// The four bytes from its first on, a bit as 0 or 1 in the first. What comes after the value
    /// is in the rest.
    pub(crate) fn bytes_in(self, memory: &Memory) -> [u8; 4] {
        let mut bytes = [0, 1, 2, 3].map(|offset| memory.byte(self.address() + offset));
        if self.size() < BYTE {
            bytes[0] = bytes[0] >> self.size() & 1;
        }
        bytes
    }

    /// Bytes of the value.
    pub const fn width(self) -> u8 {
        width(self.size())
    }
}

/// Bytes of a value of a size.
pub(crate) const fn width(size: u8) -> u8 {
    match size {
        DOUBLE => 4,
        WORD => 2,
        _ => 1,
    }
}

/// Where an area begins in the bit page.
pub(crate) const fn page_start(area: u8) -> u16 {
    PAGE_START + if area <= Q { 16 * area as u16 } else { 32 * (area - 1) as u16 }
}

/// Bytes of an area in the bit page.
pub(crate) const fn page_len(area: u8) -> u8 {
    match area {
        0 | Q => 16,
        L => 64,
        _ => 32,
    }
}

/// The place of what a reference names, if it is among what is allowed.
pub(crate) fn resolve<P: ProgramMemory>(
    program: Option<&Program<P>>,
    code: u8,
    number: u16,
    allowed: u16,
) -> SizedAddress {
    let (area, mut size, mut class) = (code >> 4, code & 15, code >> 4);
    if size > DOUBLE || number >= SM_IN_V {
        return SizedAddress::NONE;
    }
    let width = width(size);
    let address = match area {
        T | C if size == 0 && number < 256 => {
            class = NUMBERED_BITS;
            size = number as u8 & 7;
            page_start(area) + u16::from(number as u8 >> 3)
        }
        T | C if size == WORD => value_address(program, area == T, number),
        T | C => 0,
        V => v_address(program, number, width),
        SM if number >= 32 => v_address(program, number | SM_IN_V, width),
        SECOND_PAGE => {
            let Some(found) = second_page(number, size) else { return SizedAddress::NONE };
            class = found;
            AIW_START + number
        }
        _ if area <= L && number + u16::from(width) <= u16::from(page_len(area)) => {
            page_start(area) + number
        }
        _ => 0,
    };
    if address == 0 || allowed >> class & 1 == 0 {
        SizedAddress::NONE
    } else {
        SizedAddress::new(address, size)
    }
}

/// To which class an offset of the second page belongs, and whether a value of this size begins
/// there.
fn second_page(number: u16, size: u8) -> Option<u8> {
    let (class, width) = match number {
        0..AIN => (SECOND_PAGE, 2),
        AIN..AC => (RAW, 2),
        AC..HC => (ACCUMULATORS, 4),
        HC..AQW => (COUNTERS, 4),
        AQW..END => (OUTPUTS, 2),
        _ => return None,
    };
    (size >= WORD && width == self::width(size) && number as u8 & (width - 1) == 0).then_some(class)
}

/// Data address of a value in V memory that lies in one range of the plan; 0: there is none.
pub(crate) fn v_address<P: ProgramMemory>(
    program: Option<&Program<P>>,
    number: u16,
    width: u8,
) -> u16 {
    let Some(program) = program else { return 0 };
    let mut start = ARENA_START;
    for (first, len) in program.plan().v_ranges() {
        if number >= first && number - first < len {
            let (offset, width) = (number - first, u16::from(width));
            return if len - offset >= width { start + offset } else { 0 };
        }
        start += len;
    }
    0
}

/// Data address of the current value of a timer or counter; 0: the program does not use it.
pub(crate) fn value_address<P: ProgramMemory>(
    program: Option<&Program<P>>,
    is_timer: bool,
    number: u16,
) -> u16 {
    let (Some(program), Ok(number)) = (program, u8::try_from(number)) else { return 0 };
    let plan = program.plan();
    if is_timer {
        plan.timer_slot(number).map_or(0, |slot| slot.address)
    } else {
        plan.counter_slot(number).map_or(0, |slot| slot.address)
    }
}
