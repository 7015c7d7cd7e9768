//! The serial line: UART0, which the chip beside the processor has on USB.

use core::convert::Infallible;

use embedded_io::{ErrorType, Read, ReadReady, Write, WriteReady};
use nrf51_hal::gpio::{Level, p0};
use nrf51_hal::pac::{self, GPIO, UART0, interrupt};
use nrf51_hal::uart::{Baudrate, Parity as Sent, Pins, Uart};
use plc_isa::{LineSettings, Parity};
use runtime::Incoming;

/// As [`LineSettings::RATES`].
#[rustfmt::skip]
const RATES: [Baudrate; 8] = [
    Baudrate::BAUD115200, Baudrate::BAUD57600, Baudrate::BAUD38400, Baudrate::BAUD19200,
    Baudrate::BAUD9600, Baudrate::BAUD4800, Baudrate::BAUD2400, Baudrate::BAUD1200,
];

/// As many characters as a frame has can wait: 255.
static INCOMING: Incoming<256> = Incoming::new();

fn registers() -> &'static pac::uart0::RegisterBlock {
    // SAFETY: only this module uses it, and registers that are set here the driver leaves alone.
    unsafe { &*UART0::PTR }
}

#[interrupt]
fn UART0() {
    while registers().events_rxdrdy.read().bits() != 0 {
        registers().events_rxdrdy.reset();
        INCOMING.push(registers().rxd.read().bits() as u8);
    }
}

/// The line.
pub struct Serial(Uart<UART0>);

impl Serial {
    /// The line. Once.
    pub fn new(uart: UART0, port: GPIO) -> Serial {
        let pins = p0::Parts::new(port);
        let rxd = pins.p0_25.into_floating_input().degrade();
        let txd = pins.p0_24.into_push_pull_output(Level::High).degrade();
        let pins = Pins { rxd, txd, cts: None, rts: None };
        let serial = Serial(Uart::new(uart, pins, Sent::EXCLUDED, RATES[0]));
        registers().intenset.write(|w| w.rxdrdy().set_bit());
        // SAFETY: an event that says that a character can be sent: QEMU does not have the one that
        // the driver waits for. What the interrupt uses is there from the beginning.
        unsafe {
            registers().events_txdrdy.write(|w| w.bits(1));
            pac::NVIC::unmask(pac::Interrupt::UART0);
        }
        serial
    }

    /// How characters are sent from now on. The chip has no odd parity: no line then.
    pub fn set(&mut self, settings: LineSettings) {
        let (is_odd, has_parity) =
            (settings.parity == Parity::Odd, settings.parity != Parity::None);
        let rate = RATES[usize::from(settings.rate) % RATES.len()];
        registers().baudrate.write(|w| w.baudrate().variant(rate));
        registers().config.write(|w| {
            w.parity().variant(if has_parity { Sent::INCLUDED } else { Sent::EXCLUDED })
        });
        registers()
            .enable
            .write(|w| if is_odd { w.enable().disabled() } else { w.enable().enabled() });
    }
}

impl ErrorType for Serial {
    type Error = Infallible;
}

impl ReadReady for Serial {
    fn read_ready(&mut self) -> Result<bool, Infallible> {
        (&INCOMING).read_ready()
    }
}

impl Read for Serial {
    fn read(&mut self, bytes: &mut [u8]) -> Result<usize, Infallible> {
        (&INCOMING).read(bytes)
    }
}

impl WriteReady for Serial {
    fn write_ready(&mut self) -> Result<bool, Infallible> {
        self.0.write_ready()
    }
}

impl Write for Serial {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> {
        self.0.write(bytes)
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        self.0.flush()
    }
}
