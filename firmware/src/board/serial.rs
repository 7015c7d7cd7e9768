//! The serial line, 115200 8N1, by interrupts and two queues. Nothing waits: a full queue says so.

use core::cell::Cell;

use avr_device::atmega328p::USART0;
use avr_device::interrupt::{self, CriticalSection, Mutex};
use embedded_hal_nb::serial::{ErrorKind, ErrorType, Read, Write};

use super::takeover;

/// 16 MHz / 8 / 115200, the Arduino's own divider: 2.1 % fast, within what receivers take.
const DIVIDER: u16 = 16;
/// Capacity is one less.
const TRANSMIT_LEN: usize = 64;
const RECEIVE_LEN: usize = 16;

static TRANSMIT: Shared<TRANSMIT_LEN> = Shared::new();
static RECEIVE: Shared<RECEIVE_LEN> = Shared::new();

/// Sets the line up, also after a module had it. What is still in the queue goes on.
#[inline(never)]
pub fn set_up() {
    // SAFETY: comes here before interrupts are enabled, or with the module's interrupts without a cause: the registers
    // are changed elsewhere in interrupts of the line only, which do not come while they are switched off.
    let usart = unsafe { USART0::steal() };
    usart.ucsr0b().reset();
    usart.ucsr0a().write(|w| w.u2x0().set_bit());
    usart.ubrr0().write(|w| w.set(DIVIDER));
    usart.ucsr0c().write(|w| w.umsel0().usart_async().ucsz0().chr8());
    usart.ucsr0b().write(|w| w.rxcie0().set_bit().udrie0().set_bit().rxen0().set_bit().txen0().set_bit());
}

/// A queue between the program and an interrupt. Used with interrupts off.
struct Shared<const N: usize> {
    bytes: [Mutex<Cell<u8>>; N],
    first: Mutex<Cell<u8>>,
    end: Mutex<Cell<u8>>,
}

impl<const N: usize> Shared<N> {
    const fn new() -> Shared<N> {
        Shared {
            bytes: [const { Mutex::new(Cell::new(0)) }; N],
            first: Mutex::new(Cell::new(0)),
            end: Mutex::new(Cell::new(0)),
        }
    }

    fn next(place: u8) -> u8 {
        (place + 1) & (N as u8 - 1)
    }

    fn add(&self, cs: CriticalSection<'_>, byte: u8) -> Result<(), u8> {
        let end = self.end.borrow(cs);
        let next = Self::next(end.get());
        if next == self.first.borrow(cs).get() {
            return Err(byte);
        }
        if let Some(place) = self.bytes.get(usize::from(end.get())) {
            place.borrow(cs).set(byte);
        }
        end.set(next);
        Ok(())
    }

    fn take(&self, cs: CriticalSection<'_>) -> Option<u8> {
        if self.is_empty(cs) {
            return None;
        }
        let first = self.first.borrow(cs);
        let place = first.replace(Self::next(first.get()));
        self.bytes.get(usize::from(place)).map(|byte| byte.borrow(cs).get())
    }

    fn is_empty(&self, cs: CriticalSection<'_>) -> bool {
        self.first.borrow(cs).get() == self.end.borrow(cs).get()
    }
}

/// The program's end of the serial line.
pub struct Serial(());

impl Serial {
    /// Sets the line up. Called once, before interrupts are enabled.
    pub fn new() -> Serial {
        set_up();
        Serial(())
    }

    /// Whether there is something to read.
    pub fn has_received(&self) -> bool {
        interrupt::free(|cs| !RECEIVE.is_empty(cs))
    }

    /// Whether everything written has been handed to the line: a whole queue is free. Not while the line is a module's.
    pub fn is_idle(&self) -> bool {
        takeover::flags() & takeover::SERIAL == 0 && interrupt::free(|cs| TRANSMIT.is_empty(cs))
    }
}

impl ErrorType for Serial {
    type Error = ErrorKind;
}

impl Read<u8> for Serial {
    fn read(&mut self) -> nb::Result<u8, ErrorKind> {
        interrupt::free(|cs| RECEIVE.take(cs)).ok_or(nb::Error::WouldBlock)
    }
}

impl Write<u8> for Serial {
    fn write(&mut self, byte: u8) -> nb::Result<(), ErrorKind> {
        interrupt::free(|cs| {
            TRANSMIT.add(cs, byte).map_err(|_| nb::Error::WouldBlock)?;
            // SAFETY: interrupts are off, so that the transmit interrupt cannot change the register meanwhile.
            let usart = unsafe { USART0::steal() };
            usart.ucsr0b().modify(|_, w| w.udrie0().set_bit());
            Ok(())
        })
    }

    fn flush(&mut self) -> nb::Result<(), ErrorKind> {
        if self.is_idle() { Ok(()) } else { Err(nb::Error::WouldBlock) }
    }
}

/// A character has come. With modules the engine asks first whose it is.
#[cfg_attr(feature = "engine", unsafe(export_name = "uno200_character"))]
#[cfg_attr(not(feature = "engine"), unsafe(export_name = "__vector_18"))]
extern "avr-interrupt" fn receive() {
    // SAFETY: the receive registers belong to this interrupt alone.
    let usart = unsafe { USART0::steal() };
    let is_broken = usart.ucsr0a().read().fe0().bit_is_set();
    let byte = usart.udr0().read().bits();
    if !is_broken {
        // A full queue loses the byte: whoever floods the line must not stop the scan.
        // SAFETY: interrupts are off in an interrupt.
        let _ = RECEIVE.add(unsafe { CriticalSection::new() }, byte);
    }
}

#[avr_device::interrupt(atmega328p)]
fn USART_UDRE() {
    // SAFETY: the registers are changed elsewhere only with interrupts off.
    let usart = unsafe { USART0::steal() };
    // SAFETY: interrupts are off in an interrupt.
    match TRANSMIT.take(unsafe { CriticalSection::new() }) {
        Some(byte) => {
            usart.udr0().write(|w| w.set(byte));
        }
        None => {
            usart.ucsr0b().modify(|_, w| w.udrie0().clear_bit());
        }
    }
}
