//! The Pico's hardware as the runtime asks for it. It knows pins and registers, nothing of
//! programs.
#![allow(unsafe_code)]

mod adc;
mod clock;
mod divider;
mod fault_memory;
mod flash;
mod image;
mod marks;
mod panic;
mod points;
mod pwm;
mod rom;
mod serial;
mod set_up;
mod stack;
mod start;
mod usb;
mod vectors;
mod watchdog;

use core::cell::UnsafeCell;
use core::mem::{self, MaybeUninit};

use plc_isa::{LineSettings, PICO, Profile};
use plc_vm::Fault;
use runtime::{Board, Controller, Mark};

use crate::engine::Thumb;
use adc::Adc;
use flash::{Flash, PROGRAMS, RETAINED};
use image::Image;
pub use marks::tell_data;
use pwm::Pwm;
use serial::Serial;
use set_up::Found;
use usb::Usb;

/// The board.
pub struct Pico {
    serial: Serial,
    usb: Usb,
    retained: Flash,
    programs: Flash,
    adc: Adc,
    pwm: Pwm,
    /// The watchdog had run out before the reset, and nobody was told yet.
    was_hung: bool,
}

/// Where the controller is: too large for the stack.
struct Place(UnsafeCell<MaybeUninit<Controller<Pico>>>);

// SAFETY: only `place` uses it, once.
unsafe impl Sync for Place {}

static PLACE: Place = Place(UnsafeCell::new(MaybeUninit::uninit()));

/// The controller in its place. Once.
pub fn place(make: impl FnOnce() -> Controller<Pico>) -> &'static mut Controller<Pico> {
    // SAFETY: `main` calls it once, before there is anything else.
    unsafe { (*PLACE.0.get()).write(make()) }
}

impl Pico {
    /// The board as a reset leaves it, set up. Once.
    pub fn of_reset() -> Pico {
        let Found { was_hung, adc, pwm, usb } = set_up::set_up();
        let (retained, programs) = (RETAINED, PROGRAMS);
        Pico { serial: Serial::new(), usb, retained, programs, adc, pwm, was_hung }
    }
}

impl Board for Pico {
    const PROFILE: &'static Profile = &PICO;
    const PRODUCT: &'static str = "Raspberry Pi Pico";

    type Image = Image;
    type Engine = Thumb;
    type Line = Serial;
    type SecondLine = Usb;
    type Storage = Flash;
    type Programs = Flash;

    fn engine(&mut self) -> Thumb {
        Thumb::new()
    }

    #[inline(always)]
    fn now_us(&mut self) -> u32 {
        clock::now_us()
    }

    fn image(&mut self, slot: u8) -> Option<Image> {
        Image::in_slot(slot)
    }

    #[inline(always)]
    fn inputs(&mut self) -> u8 {
        points::inputs()
    }

    fn set_pullups(&mut self, inputs: u8) {
        points::set_pullups(inputs);
    }

    #[inline(always)]
    fn drive_outputs(&mut self, levels: u8) {
        points::drive(levels);
    }

    #[inline(always)]
    fn release_outputs(&mut self) {
        points::release();
        self.pwm.end_all();
    }

    #[inline(always)]
    fn modulate(&mut self, output: u8, duty: Option<u16>) {
        self.pwm.modulate(output, duty);
    }

    #[inline(always)]
    fn analog(&mut self, channel: u8) -> u16 {
        self.adc.value(channel)
    }

    #[inline(always)]
    fn line(&mut self) -> &mut Serial {
        &mut self.serial
    }

    #[inline(always)]
    fn second_line(&mut self) -> Option<&mut Usb> {
        Some(&mut self.usb)
    }

    fn set_line(&mut self, settings: LineSettings) {
        self.serial.set(settings);
    }

    fn storage(&mut self) -> &mut Flash {
        &mut self.retained
    }

    fn programs(&mut self) -> Option<&mut Flash> {
        Some(&mut self.programs)
    }

    #[inline(always)]
    fn feed_watchdog(&mut self) {
        watchdog::feed();
    }

    fn remember_fault(&mut self, fault: u32, holds: bool) {
        fault_memory::remember(fault, holds);
    }

    fn recall_fault(&mut self) -> (u32, bool) {
        if mem::take(&mut self.was_hung) {
            // Noted by nobody: the watchdog cannot do more than reset.
            fault_memory::remember(Fault::Hang.to_word(), false);
            return (Fault::Hang.to_word(), true);
        }
        fault_memory::recall()
    }

    fn free_stack(&self) -> u16 {
        stack::free()
    }

    #[inline(always)]
    fn mark(&mut self, mark: Mark) {
        marks::tell(mark);
    }
}
