//! The serial line: UART0 on GP0 and GP1. What comes in waits in a queue, which an interrupt fills;
//! what goes out waits in the FIFO of the UART. What characters mean is not known here.

use core::cell::UnsafeCell;
use core::fmt;

use cortex_m::peripheral::NVIC;
use heapless::spsc::{Consumer, Producer, Queue};
use plc_isa::{LineSettings, Parity};
use rp2040_hal::pac::{self, interrupt};

/// Of the peripheral clock.
const CLOCK_HZ: u32 = 125_000_000;
const PINS: [usize; 2] = [0, 1];
/// Function of a pin.
const UART: u8 = 2;
/// Characters that can wait: those of 1.4 s at the highest rate, which is a scan as long as the
/// hardware watchdog allows, and a sector that is erased. A power of two is quickly wrapped.
const WAITING: usize = 16_384;
/// Bits of a received character that say that it is wrong: framing, parity, break.
const IS_WRONG: u16 = 0x0700;
/// In the queue, as POSIX terminals mark it (PARMRK): this and 0 are a wrong character, this twice
/// is a character that is this.
const MARK: u8 = 0xFF;
const WRONG: u8 = 0;
/// Receive interrupt when the FIFO is half full, which leaves 1.4 ms to come.
const HALF_FULL: u8 = 2;
const EIGHT_BITS: u8 = 3;

/// Used by one side only, each after the set-up.
struct OneSided<T>(UnsafeCell<T>);

// SAFETY: the queue is used by its two halves alone, the half that fills it by the interrupt alone,
// once that is enabled.
unsafe impl<T> Sync for OneSided<T> {}

static QUEUE: OneSided<Queue<u8, WAITING>> = OneSided(UnsafeCell::new(Queue::new()));
static INCOMING: OneSided<Option<Producer<'static, u8>>> = OneSided(UnsafeCell::new(None));

fn uart() -> &'static pac::uart0::RegisterBlock {
    // SAFETY: only this module uses it.
    unsafe { &*pac::UART0::PTR }
}

/// Connects the pins. The line is to be [set](Serial::set) after that.
pub fn set_up(pac: &pac::Peripherals) {
    pac.RESETS.reset().modify(|_, w| w.uart0().clear_bit());
    while pac.RESETS.reset_done().read().uart0().bit_is_clear() {}
    for pin in PINS {
        // With a pull-up: a line without a wire is idle.
        let pad = pac.PADS_BANK0.gpio(pin);
        pad.write(|w| w.ie().set_bit().od().clear_bit().pue().set_bit().pde().clear_bit());
        // SAFETY: the function exists.
        pac.IO_BANK0.gpio(pin).gpio_ctrl().write(|w| unsafe { w.funcsel().bits(UART) });
    }
}

/// What has come first of what is in the FIFO.
fn take() -> Option<Result<u8, WrongCharacter>> {
    if uart().uartfr().read().rxfe().bit_is_set() {
        return None;
    }
    let character = uart().uartdr().read().bits() as u16;
    Some(if character & IS_WRONG == 0 { Ok(character as u8) } else { Err(WrongCharacter) })
}

/// Puts a character into the queue. Where there is no room it is lost: nobody has looked for longer
/// than a scan lasts.
fn put(queue: &mut Producer<'static, u8>, character: Result<u8, WrongCharacter>) {
    let second = match character {
        Ok(MARK) => MARK,
        Ok(byte) => {
            let _ = queue.enqueue(byte);
            return;
        }
        Err(WrongCharacter) => WRONG,
    };
    if queue.len() + 2 <= queue.capacity() {
        let _ = queue.enqueue(MARK);
        let _ = queue.enqueue(second);
    }
}

/// Takes the first character out of the queue, while the interrupt does not come.
fn get(queue: &mut Consumer<'static, u8>) -> Option<Result<u8, WrongCharacter>> {
    let byte = queue.dequeue()?;
    if byte == MARK && queue.dequeue() == Some(WRONG) {
        return Some(Err(WrongCharacter));
    }
    Some(Ok(byte))
}

#[interrupt]
fn UART0_IRQ() {
    // SAFETY: only this interrupt uses it after the set-up.
    let Some(incoming) = (unsafe { &mut *INCOMING.0.get() }) else { return };
    while let Some(character) = take() {
        put(incoming, character);
    }
}

/// The line.
pub struct Serial {
    waiting: Consumer<'static, u8>,
    /// A wrong character is the next that is read.
    is_wrong_next: bool,
}

/// A character was wrong: framing or parity.
#[derive(Debug)]
pub struct WrongCharacter;

impl Serial {
    /// The line. Once.
    pub fn new() -> Serial {
        // SAFETY: once, and the interrupt, which uses the other half, is enabled after that.
        let waiting = unsafe {
            let (incoming, waiting) = (*QUEUE.0.get()).split();
            *INCOMING.0.get() = Some(incoming);
            NVIC::unmask(pac::Interrupt::UART0_IRQ);
            waiting
        };
        Serial { waiting, is_wrong_next: false }
    }

    /// How characters are sent and received from now on.
    pub fn set(&mut self, settings: LineSettings) {
        let baud = LineSettings::RATES.get(usize::from(settings.rate)).copied().unwrap_or(115_200);
        // The UART divides by 16 and this, which is in 64ths.
        let divider = (CLOCK_HZ * 4 + baud / 2) / baud;
        let uart = uart();
        uart.uartcr().reset();
        // SAFETY: dividers of these rates are valid, and so are the level and the number of bits.
        unsafe {
            uart.uartibrd().write(|w| w.baud_divint().bits((divider >> 6) as u16));
            uart.uartfbrd().write(|w| w.baud_divfrac().bits((divider & 63) as u8));
            uart.uartlcr_h().write(|w| {
                w.wlen().bits(EIGHT_BITS).fen().set_bit();
                w.pen().bit(settings.parity != Parity::None);
                w.eps().bit(settings.parity == Parity::Even)
            });
            uart.uartifls().write(|w| w.rxiflsel().bits(HALF_FULL));
        }
        uart.uartimsc().write(|w| w.rxim().set_bit().rtim().set_bit());
        uart.uartcr().write(|w| w.uarten().set_bit().txe().set_bit().rxe().set_bit());
    }

    /// The next character. What is still in the FIFO need not wait for the interrupt, which comes
    /// when it is half full or the line is quiet: at low rates frames would seem to end before.
    fn next(&mut self) -> Option<Result<u8, WrongCharacter>> {
        // Nothing overtakes: the interrupt does not come between.
        cortex_m::interrupt::free(|_| get(&mut self.waiting).or_else(take))
    }
}

impl embedded_io::ErrorType for Serial {
    type Error = WrongCharacter;
}

impl embedded_io::ReadReady for Serial {
    #[inline(always)]
    fn read_ready(&mut self) -> Result<bool, WrongCharacter> {
        let has_new = uart().uartfr().read().rxfe().bit_is_clear();
        Ok(has_new || self.waiting.ready() || self.is_wrong_next)
    }
}

impl embedded_io::Read for Serial {
    /// Characters up to a wrong one, which is an error of its own. Does not wait: none is 0.
    fn read(&mut self, bytes: &mut [u8]) -> Result<usize, WrongCharacter> {
        let mut count = 0;
        for place in bytes {
            if !self.is_wrong_next {
                match self.next() {
                    Some(Ok(byte)) => *place = byte,
                    Some(Err(WrongCharacter)) => self.is_wrong_next = true,
                    None => break,
                }
            }
            if self.is_wrong_next {
                if count > 0 {
                    break;
                }
                self.is_wrong_next = false;
                return Err(WrongCharacter);
            }
            count += 1;
        }
        Ok(count)
    }
}

impl embedded_io::WriteReady for Serial {
    fn write_ready(&mut self) -> Result<bool, WrongCharacter> {
        Ok(uart().uartfr().read().txff().bit_is_clear())
    }
}

impl embedded_io::Write for Serial {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, WrongCharacter> {
        let mut count = 0;
        for &byte in bytes {
            if uart().uartfr().read().txff().bit_is_set() {
                break;
            }
            // SAFETY: any byte can be sent.
            uart().uartdr().write(|w| unsafe { w.data().bits(byte) });
            count += 1;
        }
        Ok(count)
    }

    /// Waits until all has been sent: the 32 characters of the FIFO at most, 0.3 s at 1200 baud.
    fn flush(&mut self) -> Result<(), WrongCharacter> {
        while uart().uartfr().read().busy().bit_is_set() {}
        Ok(())
    }
}

impl fmt::Display for WrongCharacter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a character was wrong")
    }
}

impl core::error::Error for WrongCharacter {}

impl embedded_io::Error for WrongCharacter {
    fn kind(&self) -> embedded_io::ErrorKind {
        embedded_io::ErrorKind::InvalidData
    }
}
