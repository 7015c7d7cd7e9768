//! The boundary to C: the functions of shim.c and the one owner of what they give. Everything
//! unsafe is here.
#![allow(unsafe_code)]

use std::ptr::NonNull;
use std::slice;

/// What shim.c keeps for a chip; Rust sees only its address.
#[repr(C)]
struct Shim {
    _opaque: [u8; 0],
}

unsafe extern "C" {
    fn shim_new(has_room: i32) -> *mut Shim;
    fn shim_free(shim: *mut Shim);
    fn shim_reset(shim: *mut Shim, cause: u8);
    fn shim_flash(shim: *mut Shim) -> *mut u8;
    fn shim_flash_len(shim: *mut Shim) -> usize;
    fn shim_data(shim: *mut Shim) -> *mut u8;
    fn shim_data_len(shim: *mut Shim) -> usize;
    fn shim_pc(shim: *mut Shim) -> u32;
    fn shim_set_pc(shim: *mut Shim, pc: u32);
    fn shim_set_reset_pc(shim: *mut Shim, pc: u32);
    fn shim_cycles(shim: *mut Shim) -> u64;
    fn shim_mark(shim: *mut Shim) -> u8;
    fn shim_step(shim: *mut Shim) -> i32;
    fn shim_run(shim: *mut Shim, cycles: u64) -> i32;
    fn shim_drive(shim: *mut Shim, port: i32, bit: i32, level: i32);
    fn shim_set_millivolts(shim: *mut Shim, channel: i32, millivolts: u32);
    fn shim_uart_send(shim: *mut Shim, bytes: *const u8, len: usize) -> i32;
    fn shim_uart_waiting(shim: *mut Shim) -> usize;
    fn shim_uart_received(shim: *mut Shim) -> usize;
    fn shim_uart_take(shim: *mut Shim, to: *mut u8);
    fn shim_eeprom_is_misused(shim: *mut Shim) -> i32;
    fn shim_eeprom_writing(shim: *mut Shim) -> u32;
    fn shim_eeprom_writes(shim: *mut Shim, at: u16) -> u32;
    fn shim_eeprom_len(shim: *mut Shim) -> usize;
    fn shim_eeprom_read(shim: *mut Shim, offset: u16, to: *mut u8, len: u32);
    fn shim_eeprom_write(shim: *mut Shim, offset: u16, from: *const u8, len: u32);
    fn shim_feed_watchdog(shim: *mut Shim);
    fn shim_wave(shim: *mut Shim, wave: i32) -> i32;
    fn shim_watch_edges(shim: *mut Shim);
    fn shim_edges(shim: *mut Shim) -> usize;
    fn shim_take_edges(shim: *mut Shim, to: *mut u64);
}

/// How a run of the chip ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ran {
    On,
    ToMark,
    Crashed,
}

impl Ran {
    /// The numbers of shim.c.
    fn of(code: i32) -> Ran {
        match code {
            0 => Ran::On,
            1 => Ran::ToMark,
            _ => Ran::Crashed,
        }
    }
}

/// A chip. It is neither `Send` nor `Sync`: nobody has looked whether libsimavr would allow it.
pub(crate) struct Chip(NonNull<Shim>);

impl Drop for Chip {
    fn drop(&mut self) {
        // SAFETY: the pointer came from shim_new, this is its only owner, and nothing uses it after
        // drop.
        unsafe { shim_free(self.0.as_ptr()) }
    }
}

/// Calls a function of shim.c that takes the chip and numbers.
macro_rules! call {
    ($chip:ident.$function:ident($($number:expr),*)) => {
        // SAFETY: the pointer is valid as long as its owner. The function keeps no other pointer,
        // takes any number or one that was checked just before, and changes the chip only where the
        // owner is borrowed exclusively, so that no slice of its memory is alive.
        unsafe { $function($chip.0.as_ptr() $(, $number)*) }
    };
}

impl Chip {
    /// A chip with erased memories, or none if there is no memory for it: the Uno's, or the one
    /// that has room.
    pub(crate) fn new(has_room: bool) -> Option<Chip> {
        // SAFETY: takes any number; gives null or what shim_free takes.
        NonNull::new(unsafe { shim_new(has_room.into()) }).map(Chip)
    }

    pub(crate) fn reset(&mut self, cause: u8) {
        call!(self.shim_reset(cause))
    }

    pub(crate) fn step(&mut self) -> Ran {
        Ran::of(call!(self.shim_step()))
    }

    pub(crate) fn run(&mut self, cycles: u64) -> Ran {
        Ran::of(call!(self.shim_run(cycles)))
    }

    pub(crate) fn pc(&self) -> u32 {
        call!(self.shim_pc())
    }

    pub(crate) fn set_pc(&mut self, pc: u32) {
        call!(self.shim_set_pc(pc))
    }

    pub(crate) fn set_reset_pc(&mut self, pc: u32) {
        call!(self.shim_set_reset_pc(pc))
    }

    pub(crate) fn cycles(&self) -> u64 {
        call!(self.shim_cycles())
    }

    /// What the last [`Ran::ToMark`] was about.
    pub(crate) fn mark(&self) -> u8 {
        call!(self.shim_mark())
    }

    pub(crate) fn feed_watchdog(&mut self) {
        call!(self.shim_feed_watchdog())
    }

    pub(crate) fn flash(&self) -> &[u8] {
        // SAFETY: simavr's flash has this length, is initialised, and stays where it is until
        // shim_free; only methods that borrow self exclusively change it.
        unsafe {
            slice::from_raw_parts(shim_flash(self.0.as_ptr()), shim_flash_len(self.0.as_ptr()))
        }
    }

    pub(crate) fn flash_mut(&mut self) -> &mut [u8] {
        // SAFETY: as for flash; the exclusive borrow lasts as long as the slice.
        unsafe {
            slice::from_raw_parts_mut(shim_flash(self.0.as_ptr()), shim_flash_len(self.0.as_ptr()))
        }
    }

    pub(crate) fn data(&self) -> &[u8] {
        // SAFETY: as for flash.
        unsafe { slice::from_raw_parts(shim_data(self.0.as_ptr()), shim_data_len(self.0.as_ptr())) }
    }

    pub(crate) fn data_mut(&mut self) -> &mut [u8] {
        // SAFETY: as for flash_mut.
        unsafe {
            slice::from_raw_parts_mut(shim_data(self.0.as_ptr()), shim_data_len(self.0.as_ptr()))
        }
    }

    /// `port`: 0 to 2 for B to D; `bit`: 0 to 7.
    pub(crate) fn drive(&mut self, port: u8, bit: u8, level: bool) {
        assert!(port < 3 && bit < 8, "the chip has no such pin");
        call!(self.shim_drive(port.into(), bit.into(), level.into()))
    }

    /// `channel`: 0 to 7.
    pub(crate) fn set_millivolts(&mut self, channel: u8, millivolts: u16) {
        assert!(channel < 8, "the converter has no such channel");
        call!(self.shim_set_millivolts(channel.into(), millivolts.into()))
    }

    pub(crate) fn uart_waiting(&self) -> usize {
        call!(self.shim_uart_waiting())
    }

    /// False if there is no room for the bytes.
    pub(crate) fn uart_send(&mut self, bytes: &[u8]) -> bool {
        // SAFETY: the pointer is valid; the shim copies so many bytes from the slice.
        unsafe { shim_uart_send(self.0.as_ptr(), bytes.as_ptr(), bytes.len()) != 0 }
    }

    /// Each byte with what the UART's control register B was then.
    pub(crate) fn uart_take(&mut self) -> Vec<[u8; 2]> {
        let mut bytes = vec![[0; 2]; call!(self.shim_uart_received())];
        if !bytes.is_empty() {
            // SAFETY: the shim writes two bytes for each it has, and their number was just asked
            // for.
            unsafe { shim_uart_take(self.0.as_ptr(), bytes.as_mut_ptr().cast()) }
        }
        bytes
    }

    /// What timer 1 makes of OC1A (0) or OC1B (1).
    pub(crate) fn wave(&self, wave: u8) -> bool {
        assert!(wave < 2, "timer 1 has no such output");
        call!(self.shim_wave(wave.into())) != 0
    }

    pub(crate) fn watch_edges(&mut self) {
        call!(self.shim_watch_edges())
    }

    /// Each as the cycle, above bit 1 for OC1B and bit 0 for the level.
    pub(crate) fn take_edges(&mut self) -> Vec<u64> {
        let mut edges = vec![0; call!(self.shim_edges())];
        if !edges.is_empty() {
            // SAFETY: the shim copies all it has, which is the number just asked for.
            unsafe { shim_take_edges(self.0.as_ptr(), edges.as_mut_ptr()) }
        }
        edges
    }

    pub(crate) fn eeprom_is_misused(&self) -> bool {
        call!(self.shim_eeprom_is_misused()) != 0
    }

    /// Outside the EEPROM if no byte is being written.
    pub(crate) fn eeprom_writing(&self) -> u32 {
        call!(self.shim_eeprom_writing())
    }

    pub(crate) fn eeprom_writes(&self, at: u16) -> u32 {
        call!(self.shim_eeprom_writes(at))
    }

    pub(crate) fn eeprom_len(&self) -> usize {
        call!(self.shim_eeprom_len())
    }

    /// Whether the EEPROM has these bytes.
    fn has_eeprom(&self, at: u16, len: usize) -> bool {
        usize::from(at) + len <= self.eeprom_len()
    }

    pub(crate) fn eeprom_read(&self, at: u16, to: &mut [u8]) {
        assert!(self.has_eeprom(at, to.len()), "outside the EEPROM");
        // SAFETY: the pointer is valid; the shim copies so many bytes into the slice, and the
        // EEPROM has them.
        unsafe { shim_eeprom_read(self.0.as_ptr(), at, to.as_mut_ptr(), to.len() as u32) }
    }

    /// False if the EEPROM has no such place.
    pub(crate) fn eeprom_write(&mut self, at: u16, bytes: &[u8]) -> bool {
        let has_room = self.has_eeprom(at, bytes.len());
        if has_room {
            // SAFETY: the pointer is valid; the shim copies so many bytes from the slice, and the
            // EEPROM has room.
            unsafe { shim_eeprom_write(self.0.as_ptr(), at, bytes.as_ptr(), bytes.len() as u32) }
        }
        has_room
    }
}
