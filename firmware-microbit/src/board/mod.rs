//! The micro:bit's hardware as the runtime asks for it. It knows pins and registers, nothing of
//! programs.
#![allow(unsafe_code)]

mod fault;
mod flash;
mod points;
mod serial;

use core::cell::UnsafeCell;
use core::mem::{MaybeUninit, take};
use core::{ptr, slice};

use nrf51_hal::pac::{Peripherals, TIMER0, WDT};
use nrf51_hal::timer::{Periodic, Timer};
use nrf51_hal::wdt::handles::Hdl0;
use nrf51_hal::wdt::{Parts, Watchdog, WatchdogHandle, count};
use plc_isa::{LineSettings, MICROBIT, Profile};
use plc_vm::Fault;
use runtime::{Board, Controller, Interpreted, NeverWritten, NoLine, Slot};

use flash::Flash;
use serial::Serial;

/// Where the program is in flash, after the firmware (memory.x).
const SLOT: usize = 0x2_C000;
/// Ticks of 32,768 Hz that the watchdog waits: a second.
const WATCHDOG_TICKS: u32 = 32_768;

/// The board.
pub struct Microbit {
    timer: Timer<TIMER0, Periodic>,
    serial: Serial,
    flash: Flash,
    watchdog: Option<WatchdogHandle<Hdl0>>,
    /// The watchdog had run out before the reset, and nobody was told yet.
    was_hung: bool,
}

/// Where the controller is: too large for the stack.
struct Place(UnsafeCell<MaybeUninit<Controller<Microbit>>>);

// SAFETY: only `place` uses it, once.
unsafe impl Sync for Place {}

static PLACE: Place = Place(UnsafeCell::new(MaybeUninit::uninit()));

/// The controller in its place. Once.
pub fn place(make: impl FnOnce() -> Controller<Microbit>) -> &'static mut Controller<Microbit> {
    // SAFETY: `main` calls it once, before there is anything else.
    unsafe { (*PLACE.0.get()).write(make()) }
}

impl Microbit {
    /// The board as a reset leaves it, set up. Once.
    pub fn of_reset() -> Microbit {
        points::set_up();
        // SAFETY: once; the points alone use pins beside the line, which has others.
        let pac = unsafe { Peripherals::steal() };
        let was_hung = pac.POWER.resetreas.read().dog().bit_is_set();
        pac.POWER.resetreas.write(|w| w.dog().set_bit());
        let mut timer = Timer::periodic(pac.TIMER0);
        timer.start(u32::MAX);
        let (serial, flash) = (Serial::new(pac.UART0, pac.GPIO), Flash(pac.NVMC));
        Microbit { timer, serial, flash, watchdog: start_watchdog(pac.WDT), was_hung }
    }
}

/// It goes on through a reset of the processor, but with what was set.
fn start_watchdog(wdt: WDT) -> Option<WatchdogHandle<Hdl0>> {
    let Parts { handles: (handle,), .. } = match Watchdog::try_new(wdt) {
        Ok(mut watchdog) => {
            watchdog.set_lfosc_ticks(WATCHDOG_TICKS);
            watchdog.activate::<count::One>()
        }
        Err(wdt) => Watchdog::try_recover::<count::One>(wdt).ok()?,
    };
    Some(handle)
}

impl Board for Microbit {
    const PROFILE: &'static Profile = &MICROBIT;
    const PRODUCT: &'static str = "BBC micro:bit";

    type Image = Slot<Microbit>;
    type Engine = Interpreted;
    type Line = Serial;
    type SecondLine = NoLine;
    type Storage = Flash;
    type Programs = NeverWritten;

    fn engine(&mut self) -> Interpreted {
        Interpreted
    }

    fn now_us(&mut self) -> u32 {
        self.timer.read()
    }

    fn image(&mut self, _slot: u8) -> Option<Slot<Microbit>> {
        let start = ptr::with_exposed_provenance(SLOT);
        // SAFETY: flash, which nothing in this firmware writes here.
        Slot::of(unsafe { slice::from_raw_parts(start, MICROBIT.slot_len.into()) })
    }

    fn inputs(&mut self) -> u8 {
        points::inputs()
    }

    fn set_pullups(&mut self, inputs: u8) {
        points::set_pullups(inputs);
    }

    fn drive_outputs(&mut self, levels: u8) {
        points::drive(levels);
    }

    fn release_outputs(&mut self) {
        points::release();
    }

    fn line(&mut self) -> &mut Serial {
        &mut self.serial
    }

    fn set_line(&mut self, settings: LineSettings) {
        self.serial.set(settings);
    }

    fn storage(&mut self) -> &mut Flash {
        &mut self.flash
    }

    fn feed_watchdog(&mut self) {
        self.watchdog.iter_mut().for_each(WatchdogHandle::pet);
    }

    fn remember_fault(&mut self, fault: u32, holds: bool) {
        fault::remember(fault, holds);
    }

    fn recall_fault(&mut self) -> (u32, bool) {
        if take(&mut self.was_hung) {
            fault::remember(Fault::Hang.to_word(), true);
        }
        fault::recall()
    }
}
