//! The serial line, 115200 8N1, by interrupts and two queues. Nothing waits: a full queue says so.

use core::cell::UnsafeCell;

use avr_device::atmega328p::{Peripherals, USART0};
use avr_device::interrupt::{self, CriticalSection};
use embedded_hal_nb::serial::{ErrorKind, ErrorType, Read, Write};
use heapless::spsc::Queue;

/// 16 MHz / 8 / 115200, the Arduino's own divider: 2.1 % fast, within what receivers take.
const DIVIDER: u16 = 16;
/// Capacity is one less.
const TRANSMIT_LEN: usize = 64;
const RECEIVE_LEN: usize = 16;

static TRANSMIT: Shared<TRANSMIT_LEN> = Shared::new();
static RECEIVE: Shared<RECEIVE_LEN> = Shared::new();

/// A queue between the program and an interrupt. Used as a whole and with interrupts off: its two ends alone would
/// have to divide by a length they do not know.
struct Shared<const N: usize>(UnsafeCell<Queue<u8, N>>);

// SAFETY: the queue is reached with interrupts off only.
unsafe impl<const N: usize> Sync for Shared<N> {}

impl<const N: usize> Shared<N> {
    const fn new() -> Shared<N> {
        Shared(UnsafeCell::new(Queue::new()))
    }

    fn add(&self, _: CriticalSection<'_>, byte: u8) -> Result<(), u8> {
        // SAFETY: interrupts are off, and the reference does not leave this function.
        unsafe { &mut *self.0.get() }.enqueue(byte)
    }

    fn take(&self, _: CriticalSection<'_>) -> Option<u8> {
        // SAFETY: as above.
        unsafe { &mut *self.0.get() }.dequeue()
    }

    fn is_empty(&self, _: CriticalSection<'_>) -> bool {
        // SAFETY: as above.
        unsafe { &*self.0.get() }.is_empty()
    }
}

/// The program's end of the serial line.
pub struct Serial(());

impl Serial {
    /// Sets the line up. Called once, before interrupts are enabled.
    pub fn new(usart: &USART0) -> Serial {
        usart.ucsr0a().write(|w| w.u2x0().set_bit());
        usart.ubrr0().write(|w| w.set(DIVIDER));
        usart.ucsr0c().write(|w| w.umsel0().usart_async().ucsz0().chr8());
        usart.ucsr0b().write(|w| w.rxcie0().set_bit().rxen0().set_bit().txen0().set_bit());
        Serial(())
    }

    /// Whether everything written has been handed to the line: a whole queue is free.
    pub fn is_idle(&self) -> bool {
        interrupt::free(|cs| TRANSMIT.is_empty(cs))
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
            let usart = unsafe { Peripherals::steal() }.USART0;
            usart.ucsr0b().modify(|_, w| w.udrie0().set_bit());
            Ok(())
        })
    }

    fn flush(&mut self) -> nb::Result<(), ErrorKind> {
        if self.is_idle() { Ok(()) } else { Err(nb::Error::WouldBlock) }
    }
}

#[avr_device::interrupt(atmega328p)]
fn USART_RX() {
    // SAFETY: the receive registers belong to this interrupt alone.
    let usart = unsafe { Peripherals::steal() }.USART0;
    let is_broken = usart.ucsr0a().read().fe0().bit_is_set();
    let byte = usart.udr0().read().bits();
    if !is_broken {
        // A full queue loses the byte: whoever floods the line must not stop the scan.
        interrupt::free(|cs| RECEIVE.add(cs, byte).ok());
    }
}

#[avr_device::interrupt(atmega328p)]
fn USART_UDRE() {
    // SAFETY: the registers are changed elsewhere only with interrupts off.
    let usart = unsafe { Peripherals::steal() }.USART0;
    match interrupt::free(|cs| TRANSMIT.take(cs)) {
        Some(byte) => {
            usart.udr0().write(|w| w.set(byte));
        }
        None => {
            usart.ucsr0b().modify(|_, w| w.udrie0().clear_bit());
        }
    }
}
