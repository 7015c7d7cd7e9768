//! A board on the desk: pins, line and flash as values, and a clock that is set.
#![allow(dead_code, reason = "each test uses a part")]

use std::cell::RefCell;
use std::collections::VecDeque;
use std::convert::Infallible;
use std::rc::Rc;

use awl_asm::assemble::assemble;
use awl_asm::source::Source;
use embedded_storage::nor_flash::{
    ErrorType, NorFlash, NorFlashError, NorFlashErrorKind, ReadNorFlash,
};
use plc_isa::{Area, LineSettings, Profile};
use runtime::{Board, Controller, Interpreted, Mark};

pub const SECTORS: usize = 4;
pub const SECTOR_LEN: usize = 512;
pub const WRITE_LEN: usize = 16;

/// Flash whose power can be cut.
#[derive(Debug, Clone)]
pub struct Flash {
    pub bytes: Vec<u8>,
    /// So many bytes are erased or written before the power is cut.
    pub power: usize,
    pub erased: Vec<u32>,
}

impl Flash {
    pub fn new() -> Flash {
        Flash { bytes: vec![0xFF; SECTORS * SECTOR_LEN], power: usize::MAX, erased: Vec::new() }
    }

    /// Takes the power for a byte; whether there was any.
    fn spend(&mut self) -> bool {
        let is_on = self.power > 0;
        self.power = self.power.saturating_sub(1);
        is_on
    }
}

/// The power was cut, or the address is wrong.
#[derive(Debug)]
pub struct Cut;

impl NorFlashError for Cut {
    fn kind(&self) -> NorFlashErrorKind {
        NorFlashErrorKind::Other
    }
}

impl ErrorType for Flash {
    type Error = Cut;
}

impl ReadNorFlash for Flash {
    const READ_SIZE: usize = 1;

    fn read(&mut self, offset: u32, bytes: &mut [u8]) -> Result<(), Cut> {
        let from = self.bytes.get(offset as usize..).and_then(|rest| rest.get(..bytes.len()));
        bytes.copy_from_slice(from.ok_or(Cut)?);
        Ok(())
    }

    fn capacity(&self) -> usize {
        self.bytes.len()
    }
}

impl NorFlash for Flash {
    const WRITE_SIZE: usize = WRITE_LEN;
    const ERASE_SIZE: usize = SECTOR_LEN;

    fn erase(&mut self, from: u32, to: u32) -> Result<(), Cut> {
        let is_whole = [from, to].iter().all(|at| at.is_multiple_of(SECTOR_LEN as u32));
        assert!(is_whole, "sectors are erased");
        self.erased.push(from / SECTOR_LEN as u32);
        for at in from..to {
            if !self.spend() {
                return Err(Cut);
            }
            self.bytes[at as usize] = 0xFF;
        }
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Cut> {
        let is_aligned =
            [offset as usize, bytes.len()].iter().all(|at| at.is_multiple_of(WRITE_LEN));
        assert!(is_aligned, "so much is written at once");
        for (at, byte) in (offset as usize..).zip(bytes) {
            if !self.spend() {
                return Err(Cut);
            }
            let place = self.bytes.get_mut(at).ok_or(Cut)?;
            assert_eq!(*place & byte, *byte, "flash is written where it is erased");
            *place &= byte;
        }
        Ok(())
    }
}

/// A line: what comes in, what went out, and how much of that is taken at once.
#[derive(Debug, Clone, Default)]
pub struct Wire {
    pub incoming: VecDeque<u8>,
    pub outgoing: Vec<u8>,
    pub takes: usize,
    pub settings: Option<LineSettings>,
}

impl embedded_io::ErrorType for Wire {
    type Error = Infallible;
}

impl embedded_io::Read for Wire {
    fn read(&mut self, bytes: &mut [u8]) -> Result<usize, Infallible> {
        let count = bytes.len().min(self.incoming.len());
        for (place, byte) in bytes.iter_mut().zip(self.incoming.drain(..count)) {
            *place = byte;
        }
        Ok(count)
    }
}

impl embedded_io::ReadReady for Wire {
    fn read_ready(&mut self) -> Result<bool, Infallible> {
        Ok(!self.incoming.is_empty())
    }
}

impl embedded_io::Write for Wire {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> {
        let count = bytes.len().min(self.takes);
        self.takes -= count;
        self.outgoing.extend_from_slice(&bytes[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

impl embedded_io::WriteReady for Wire {
    fn write_ready(&mut self) -> Result<bool, Infallible> {
        Ok(self.takes > 0)
    }
}

/// Program memory that the board and its controller see. It takes images of every profile.
#[derive(Debug, Clone)]
pub struct Image(Rc<RefCell<Vec<u8>>>);

impl plc_isa::ProgramMemory for Image {
    fn len(&self) -> u16 {
        self.0.borrow().len() as u16
    }

    fn byte(&self, offset: u16) -> u8 {
        self.0.borrow().get(usize::from(offset)).copied().unwrap_or(0xFF)
    }
}

impl Image {
    /// A bit of it changes by itself.
    pub fn spoil(&self, offset: usize) {
        self.0.borrow_mut()[offset] ^= 1;
    }
}

/// Like the Uno, with all points of a byte.
pub static DESK: Profile =
    Profile { title: "the desk", input_pins: &[""; 8], output_pins: &[""; 8], ..plc_isa::UNO };

/// The board.
#[derive(Debug, Clone)]
pub struct Desk {
    pub now_us: u32,
    /// So long a look at the clock takes.
    pub look_us: u32,
    pub image: Option<Image>,
    pub levels: u8,
    /// Parts of full scale.
    pub readings: [u16; 6],
    pub pullups: u8,
    /// The levels of the outputs; `None`: they are not driven.
    pub outputs: Option<u8>,
    pub duties: [Option<u16>; 8],
    pub wire: Wire,
    pub flash: Flash,
    pub fed: u32,
    pub fault: (u32, bool),
    pub is_stack_sound: bool,
    pub marks: Vec<Mark>,
}

impl Desk {
    pub fn new(image: Option<Vec<u8>>) -> Desk {
        Desk {
            now_us: 0,
            look_us: 0,
            image: image.map(|bytes| Image(Rc::new(RefCell::new(bytes)))),
            levels: 0,
            readings: [0; 6],
            pullups: 0,
            outputs: Some(0xFF),
            duties: [None; 8],
            wire: Wire { takes: usize::MAX, ..Wire::default() },
            flash: Flash::new(),
            fed: 0,
            fault: (0, false),
            is_stack_sound: true,
            marks: Vec::new(),
        }
    }
}

impl Board for Desk {
    const PROFILE: &'static Profile = &DESK;
    const PRODUCT: &'static str = "desk";

    type Image = Image;
    type Engine = Interpreted;
    type Line = Wire;
    type Storage = Flash;

    fn engine(&mut self) -> Interpreted {
        Interpreted
    }
    fn now_us(&mut self) -> u32 {
        self.now_us = self.now_us.wrapping_add(self.look_us);
        self.now_us
    }
    fn image(&mut self) -> Option<Image> {
        self.image.clone()
    }
    fn inputs(&mut self) -> u8 {
        self.levels
    }
    fn set_pullups(&mut self, inputs: u8) {
        self.pullups = inputs;
    }
    fn drive_outputs(&mut self, levels: u8) {
        self.outputs = Some(levels);
    }
    fn release_outputs(&mut self) {
        (self.outputs, self.duties) = (None, [None; 8]);
    }
    fn modulate(&mut self, output: u8, duty: Option<u16>) {
        self.duties[usize::from(output)] = duty;
    }
    fn analog(&mut self, channel: u8) -> u16 {
        self.readings[usize::from(channel)]
    }
    fn line(&mut self) -> &mut Wire {
        &mut self.wire
    }
    fn set_line(&mut self, settings: LineSettings) {
        self.wire.settings = Some(settings);
    }
    fn storage(&mut self) -> &mut Flash {
        &mut self.flash
    }
    fn feed_watchdog(&mut self) {
        self.fed += 1;
    }
    fn remember_fault(&mut self, fault: u32, holds: bool) {
        self.fault = (fault, holds);
    }
    fn recall_fault(&mut self) -> (u32, bool) {
        let recalled = self.fault;
        self.fault.1 = false;
        recalled
    }
    fn is_stack_sound(&mut self) -> bool {
        self.is_stack_sound
    }
    fn mark(&mut self, mark: Mark) {
        self.marks.push(mark);
    }
}

/// The image of a program.
pub fn image(text: &str) -> Vec<u8> {
    let assembly = assemble(&Source::new("p.awl", text).unwrap(), Vec::new());
    assembly.image.unwrap_or_else(|| panic!("{:?}", assembly.diagnostics))
}

/// Power comes to a board.
pub fn on(desk: Desk) -> Box<Controller<Desk>> {
    let mut plc = Box::new(Controller::new(desk));
    plc.power_up();
    plc
}

/// Power comes to a board with a program.
pub fn with(text: &str) -> Box<Controller<Desk>> {
    on(Desk::new(Some(image(text))))
}

/// Scans, each so many milliseconds after the one before.
pub fn scans(plc: &mut Controller<Desk>, count: u32, ms: u32) {
    for _ in 0..count {
        plc.board().now_us = plc.board().now_us.wrapping_add(ms * 1000);
        plc.scan();
    }
}

/// The word at a byte of V.
pub fn word(plc: &Controller<Desk>, byte: u16) -> u16 {
    let plan = plc.plc().program().unwrap().plan();
    plc.memory().word(plan.byte_address(Area::V, byte).unwrap())
}
