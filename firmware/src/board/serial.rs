//! The serial line: frames of Modbus RTU, by interrupts (`serial.s`), in data memory. Nothing
//! waits. What requests ask for is not known here.

use core::arch::global_asm;
use core::mem::offset_of;

use avr_device::atmega328p::{TC2, USART0};
use avr_device::interrupt;
use plc_isa::Settings;

use super::{flash, takeover};

/// Nothing has come since the last pause.
const LISTENING: u8 = 0;
/// A frame without errors is there. The next character begins another one.
const COMPLETE: u8 = 1;
/// Characters of a frame come in.
const RECEIVING: u8 = 2;
/// What comes in until the next pause is none.
const IGNORING: u8 = 4;
/// From here on nothing is received. The request is being answered.
const BUSY: u8 = 9;
/// The frame is to stay as it is.
const HELD: u8 = 10;
/// The answer is to be sent, and it is being sent.
const ANSWERING: u8 = 12;
const SENDING: u8 = 14;
/// The bit of those that the main program has something to do for.
const NEEDS_ANSWER: u8 = 1;

/// What is left for a frame that was longer than there is room for. Less than this there is.
const TOO_LONG: u8 = 0xFF;

/// Bytes of the checksum.
const CRC_LEN: u8 = 2;

/// What the interrupts know.
#[repr(C)]
struct Rtu {
    state: u8,
    /// Our address.
    unit: u8,
    /// That of the request: ours, or 0 for all.
    address: u8,
    /// Bytes that the frame has room for.
    room: u8,
    /// Data address of the next byte, and how many may follow.
    next: u16,
    left: u8,
    crc: u16,
    /// Rate and parity, as in [`Settings`].
    settings: u8,
}

static mut RTU: Rtu = Rtu {
    state: LISTENING,
    unit: 0,
    address: 0,
    room: 0,
    next: 0,
    left: 0,
    crc: 0,
    settings: Settings::DEFAULT.line,
};

global_asm!(
    ".equ RTU_STATE, {state}",
    ".equ RTU_UNIT, {unit}",
    ".equ RTU_ADDRESS, {address}",
    ".equ RTU_ROOM, {room}",
    ".equ RTU_NEXT, {next}",
    ".equ RTU_LEFT, {left}",
    ".equ RTU_CRC, {crc}",
    ".equ LISTENING, {listening}",
    ".equ COMPLETE, {complete}",
    ".equ RECEIVING, {receiving}",
    ".equ IGNORING, {ignoring}",
    ".equ BUSY, {busy}",
    ".equ SENDING, {sending}",
    ".equ CRC_LEN, {crc_len}",
    ".equ TOO_LONG, {too_long}",
    ".set RTU, {line}",
    state = const offset_of!(Rtu, state),
    unit = const offset_of!(Rtu, unit),
    address = const offset_of!(Rtu, address),
    room = const offset_of!(Rtu, room),
    next = const offset_of!(Rtu, next),
    left = const offset_of!(Rtu, left),
    crc = const offset_of!(Rtu, crc),
    listening = const LISTENING,
    complete = const COMPLETE,
    receiving = const RECEIVING,
    ignoring = const IGNORING,
    busy = const BUSY,
    sending = const SENDING,
    crc_len = const CRC_LEN,
    too_long = const TOO_LONG,
    line = sym RTU,
);
global_asm!(include_str!("serial.s"), options(raw));

/// Of each rate in the order of [`plc_isa::LineSettings::RATES`]: the divider of 2 MHz, less 1, and
/// the pause that ends a frame, less 1, in counts of 16 us, or of 64 us from 4800 baud down: 1.76
/// ms, then 3.5 characters of 11 bits. 115200 is 2.1 % fast, what receivers take, 57600 0.8 % slow.
/// At 1200 the counter ends after 1.8 characters.
#[unsafe(link_section = ".progmem.data")]
static RATES: [[u8; 3]; 8] = [
    rate(16, 109),
    rate(34, 109),
    rate(51, 109),
    rate(103, 125),
    rate(207, 250),
    rate(416, 125),
    rate(832, 250),
    rate(1666, 255),
];
/// The first rate with long counts.
const SLOW: u8 = 5;

const fn rate(divider: u16, pause: u8) -> [u8; 3] {
    let [low, high] = divider.to_le_bytes();
    [low, high, pause]
}

/// Where that is.
#[inline(always)]
fn rtu() -> *mut Rtu {
    &raw mut RTU
}

/// Sets the line up for frames, also after a module had it.
#[unsafe(export_name = "uno200_set_up_line")]
pub extern "C" fn set_up() {
    interrupt::free(|_| {
        // SAFETY: with interrupts off nobody else uses the registers and the state of the line.
        let (usart, timer, line) = unsafe { (USART0::steal(), TC2::steal(), &mut *rtu()) };
        line.state = LISTENING;
        let (rate, parity) = (line.settings & 7, line.settings >> 4);
        let entry = &raw const RATES as u16 + 3 * u16::from(rate);
        usart.ucsr0b().reset();
        usart.ucsr0a().write(|w| w.u2x0().set_bit());
        usart.ubrr0().write(|w| w.set(flash::word(entry)));
        // Even is 2, odd is 3.
        let parity_bits = if parity == 0 { 0 } else { (parity + 1) << 4 };
        // SAFETY: a valid choice of parity with 8 bits.
        usart.ucsr0c().write(|w| unsafe { w.bits(parity_bits | 0x06) });
        timer.timsk2().reset();
        timer.tccr2a().write(|w| w.wgm2().ctc());
        timer
            .tccr2b()
            .write(|w| if rate < SLOW { w.cs2().prescale_256() } else { w.cs2().prescale_1024() });
        timer.ocr2a().write(|w| w.set(flash::byte(entry + 2)));
        usart.ucsr0b().write(|w| w.rxcie0().set_bit().rxen0().set_bit().txen0().set_bit());
    });
}

fn state() -> u8 {
    // SAFETY: a byte that interrupts change.
    unsafe { (&raw const RTU.state).read_volatile() }
}

fn set_state(state: u8) {
    // SAFETY: a byte, written where interrupts do not write it: they are off, or the state is one
    // that they leave alone.
    unsafe { (&raw mut RTU.state).write_volatile(state) };
}

/// Whether there is a request to be answered, or one whose answer has begun.
#[inline(always)]
pub fn has_request() -> bool {
    state() & NEEDS_ANSWER != 0
}

/// Whether that request has just come: nothing has been done about it.
#[inline(always)]
pub fn is_new() -> bool {
    state() == COMPLETE
}

/// Whether an answer is on its way and the frame must stay as it is.
pub fn is_sending() -> bool {
    state() >= ANSWERING
}

/// Length of the request, which stays as it is from now on: function code and data. 255: it is
/// longer than there is room for. 0: something else has come meanwhile.
pub fn take() -> u8 {
    let is_there = interrupt::free(|_| {
        let is_there = has_request();
        if is_there {
            set_state(BUSY);
        }
        is_there
    });
    // SAFETY: interrupts do not use it in the state of now, if it is that.
    let line = unsafe { &*rtu() };
    if !is_there {
        return 0;
    }
    if line.left == TOO_LONG {
        return u8::MAX;
    }
    let received = line.room - line.left;
    if received <= CRC_LEN {
        return 0;
    }
    received - CRC_LEN
}

/// Nothing is received until [`place`].
pub fn hold() {
    set_state(HELD);
}

/// The request gets no answer; the line listens again.
pub fn ignore() {
    set_state(LISTENING);
}

/// Sends the answer, so many bytes from data address `frame` on. Requests to all get none, nor do
/// any when a module has taken over the line.
pub fn send(frame: u16, len: u8) {
    // SAFETY: interrupts do not use it in the state of now.
    let line = unsafe { &mut *rtu() };
    if line.address == 0 || takeover::flags() & takeover::SERIAL != 0 {
        return ignore();
    }
    line.next = frame;
    line.left = len + CRC_LEN;
    set_state(ANSWERING);
    interrupt::free(|_| {
        // SAFETY: interrupts are off.
        unsafe { USART0::steal() }.ucsr0b().modify(|_, w| w.udrie0().set_bit());
    });
}

/// From now on the frame, which the engine has placed, has room for requests of so many bytes, and
/// the line is as a program's settings say.
pub fn place(room: u8, settings: &Settings) {
    // SAFETY: interrupts do not use it in the state of now, and the line is listening only after
    // that.
    let line = unsafe { &mut *rtu() };
    line.room = room + CRC_LEN;
    line.unit = settings.modbus_address;
    if line.settings != settings.line {
        line.settings = settings.line;
        set_up();
    }
    ignore();
}
