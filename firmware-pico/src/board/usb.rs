//! The second line: a serial port on USB (CDC-ACM). The interrupt does what the computer asks of a
//! USB device at any time; characters wait in the port, which takes no more than there is room for.

use core::cell::UnsafeCell;
use core::sync::atomic::{AtomicBool, Ordering};

use cortex_m::peripheral::NVIC;
use rp2040_hal::clocks::UsbClock;
use rp2040_hal::pac::{self, interrupt};
use rp2040_hal::usb::UsbBus;
use usb_device::class_prelude::UsbBusAllocator;
use usb_device::device::{StringDescriptors, UsbDevice, UsbDeviceBuilder, UsbVidPid};
use usbd_serial::{SerialPort, USB_CLASS_CDC};

use super::serial::WrongCharacter;

/// Of the Pico, for a serial port.
const ID: UsbVidPid = UsbVidPid(0x2E8A, 0x000A);
/// As the computer names it.
const MANUFACTURER: &str = "uno200";
const PRODUCT: &str = "Raspberry Pi Pico as a PLC";
/// The longest packet, and room for two of them.
const PACKET_LEN: u8 = 64;
const ROOM: usize = 128;
/// Room for the longest answer.
const ANSWER_ROOM: usize = 256;

type Serial = SerialPort<'static, UsbBus, [u8; ROOM], [u8; ANSWER_ROOM]>;

struct Port {
    device: UsbDevice<'static, UsbBus>,
    serial: Serial,
}

struct Place(UnsafeCell<Option<Port>>);

// SAFETY: the interrupt uses it, and `Usb` while the interrupt does not come.
unsafe impl Sync for Place {}

static PORT: Place = Place(UnsafeCell::new(None));
/// A packet has come that nobody has read. The interrupt waits until somebody has: it would come
/// again and again.
static HAS_PACKET: AtomicBool = AtomicBool::new(false);

fn registers() -> &'static pac::usbctrl_regs::RegisterBlock {
    // SAFETY: read only, to see whether there is something to do.
    unsafe { &*pac::USBCTRL_REGS::PTR }
}

#[interrupt]
fn USBCTRL_IRQ() {
    // SAFETY: nothing else uses it while this runs.
    let Some(Port { device, serial }) = (unsafe { &mut *PORT.0.get() }) else { return };
    device.poll(&mut [serial]);
    if registers().ints().read().buff_status().bit_is_set() {
        HAS_PACKET.store(true, Ordering::Relaxed);
        NVIC::mask(pac::Interrupt::USBCTRL_IRQ);
    }
}

/// The line.
pub struct Usb(());

impl Usb {
    /// The line. Once, with its clock of 48 MHz. Where it cannot be set up it is silent.
    pub fn new(clock: UsbClock) -> Usb {
        // SAFETY: once, and nothing else uses these peripherals.
        let mut pac = unsafe { pac::Peripherals::steal() };
        let bus = UsbBus::new(pac.USBCTRL_REGS, pac.USBCTRL_DPRAM, clock, true, &mut pac.RESETS);
        let bus = cortex_m::singleton!(: UsbBusAllocator<UsbBus> = UsbBusAllocator::new(bus));
        // SAFETY: the interrupt is enabled after that.
        unsafe {
            *PORT.0.get() = bus.and_then(|bus| port(bus));
            NVIC::unmask(pac::Interrupt::USBCTRL_IRQ);
        }
        Usb(())
    }

    /// Does something with the port; `None` where there is none.
    fn with<T>(&mut self, act: impl FnOnce(&mut Serial) -> T) -> Option<T> {
        cortex_m::interrupt::free(|_| {
            // SAFETY: the interrupt does not come, and nothing else uses it.
            let port = unsafe { &mut *PORT.0.get() };
            port.as_mut().map(|port| act(&mut port.serial))
        })
    }
}

fn port(bus: &'static UsbBusAllocator<UsbBus>) -> Option<Port> {
    let serial = SerialPort::new_with_store(bus, [0; ROOM], [0; ANSWER_ROOM]);
    let strings = StringDescriptors::default().manufacturer(MANUFACTURER).product(PRODUCT);
    let builder = UsbDeviceBuilder::new(bus, ID).strings(&[strings]).ok()?;
    let builder = builder.device_class(USB_CLASS_CDC).max_packet_size_0(PACKET_LEN).ok()?;
    Some(Port { device: builder.build(), serial })
}

impl embedded_io::ErrorType for Usb {
    type Error = WrongCharacter;
}

impl embedded_io::ReadReady for Usb {
    #[inline(always)]
    fn read_ready(&mut self) -> Result<bool, WrongCharacter> {
        Ok(HAS_PACKET.load(Ordering::Relaxed))
    }
}

impl embedded_io::Read for Usb {
    /// Does not wait: none is 0. Then the interrupt may come again.
    fn read(&mut self, bytes: &mut [u8]) -> Result<usize, WrongCharacter> {
        if let Some(Ok(count)) = self.with(|serial| serial.read(bytes)) {
            return Ok(count);
        }
        HAS_PACKET.store(false, Ordering::Relaxed);
        // SAFETY: it was unmasked before, and what it uses is set up.
        unsafe { NVIC::unmask(pac::Interrupt::USBCTRL_IRQ) };
        Ok(0)
    }
}

impl embedded_io::WriteReady for Usb {
    /// Whether all that was written has gone to the computer.
    fn write_ready(&mut self) -> Result<bool, WrongCharacter> {
        Ok(matches!(self.with(|serial| serial.flush()), Some(Ok(()))))
    }
}

impl embedded_io::Write for Usb {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, WrongCharacter> {
        Ok(self.with(|serial| serial.write(bytes).unwrap_or(0)).unwrap_or(0))
    }

    /// Nobody asks for it: only the first line is set in another way.
    fn flush(&mut self) -> Result<(), WrongCharacter> {
        Ok(())
    }
}
