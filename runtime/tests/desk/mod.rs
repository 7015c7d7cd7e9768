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
use plc_link::crc16;
use runtime::{Board, Controller, Interpreted, Mark};

pub const SECTORS: usize = 4;
pub const SECTOR_LEN: usize = 512;
pub const WRITE_LEN: usize = 16;
/// The bits of a byte that have their new value when the power is cut in the middle of it.
const HALF: u8 = 0xA5;

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
        Flash::of(SECTORS)
    }

    fn of(sectors: usize) -> Flash {
        Flash { bytes: vec![0xFF; sectors * SECTOR_LEN], power: usize::MAX, erased: Vec::new() }
    }

    /// Two slots, the first with a program.
    pub fn of_programs(image: &[u8]) -> Flash {
        let slot_len = image.len().max(DESK.slot_len.into());
        let mut flash = Flash::of(2 * (slot_len.div_ceil(SECTOR_LEN) + 1));
        flash.bytes[..image.len()].copy_from_slice(image);
        flash
    }

    /// The same after a power cut.
    pub fn after_cut(&self) -> Flash {
        Flash { bytes: self.bytes.clone(), power: usize::MAX, erased: Vec::new() }
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
            let is_on = self.spend();
            let place = &mut self.bytes[at as usize];
            *place |= if is_on { 0xFF } else { HALF };
            if !is_on {
                return Err(Cut);
            }
        }
        Ok(())
    }

    fn write(&mut self, offset: u32, bytes: &[u8]) -> Result<(), Cut> {
        let is_aligned =
            [offset as usize, bytes.len()].iter().all(|at| at.is_multiple_of(WRITE_LEN));
        assert!(is_aligned, "so much is written at once");
        for (at, byte) in (offset as usize..).zip(bytes) {
            let is_on = self.spend();
            let place = self.bytes.get_mut(at).ok_or(Cut)?;
            assert_eq!(*place & byte, *byte, "flash is written where it is erased");
            *place &= byte | if is_on { 0 } else { HALF };
            if !is_on {
                return Err(Cut);
            }
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

/// Like the Uno, with all points of a byte.
pub static DESK: Profile = Profile {
    title: "the desk",
    input_pins: &[""; 8],
    output_pins: &[""; 8],
    takes_downloads: true,
    ..plc_isa::UNO
};

/// The board.
#[derive(Debug, Clone)]
pub struct Desk {
    pub now_us: u32,
    /// So long a look at the clock takes.
    pub look_us: u32,
    /// The program that is used.
    pub image: Option<Image>,
    pub programs: Flash,
    pub levels: u8,
    /// Parts of full scale.
    pub readings: [u16; 6],
    pub pullups: u8,
    /// The levels of the outputs; `None`: they are not driven.
    pub outputs: Option<u8>,
    pub duties: [Option<u16>; 8],
    pub wire: Wire,
    pub second: Wire,
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
            image: None,
            programs: Flash::of_programs(&image.unwrap_or_default()),
            levels: 0,
            readings: [0; 6],
            pullups: 0,
            outputs: Some(0xFF),
            duties: [None; 8],
            wire: Wire { takes: usize::MAX, ..Wire::default() },
            second: Wire { takes: usize::MAX, ..Wire::default() },
            flash: Flash::new(),
            fed: 0,
            fault: (0, false),
            is_stack_sound: true,
            marks: Vec::new(),
        }
    }

    /// A bit of the program in the first slot, which is used, changes by itself.
    pub fn spoil(&mut self, offset: usize) {
        self.programs.bytes[offset] ^= 1;
        self.image.as_ref().unwrap().0.borrow_mut()[offset] ^= 1;
    }
}

impl Board for Desk {
    const PROFILE: &'static Profile = &DESK;
    const PRODUCT: &'static str = "desk";

    type Image = Image;
    type Engine = Interpreted;
    type Line = Wire;
    type SecondLine = Wire;
    type Storage = Flash;
    type Programs = Flash;

    fn engine(&mut self) -> Interpreted {
        Interpreted
    }
    fn now_us(&mut self) -> u32 {
        self.now_us = self.now_us.wrapping_add(self.look_us);
        self.now_us
    }
    fn image(&mut self, slot: u8) -> Option<Image> {
        let half = self.programs.bytes.len() / 2;
        let bytes = &self.programs.bytes[usize::from(slot) * half..][..half - SECTOR_LEN];
        let is_written = bytes.iter().any(|byte| *byte != 0xFF);
        self.image = is_written.then(|| Image(Rc::new(RefCell::new(bytes.to_vec()))));
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
    fn second_line(&mut self) -> Option<&mut Wire> {
        Some(&mut self.second)
    }
    fn set_line(&mut self, settings: LineSettings) {
        self.wire.settings = Some(settings);
    }
    fn storage(&mut self) -> &mut Flash {
        &mut self.flash
    }
    fn programs(&mut self) -> Option<&mut Flash> {
        Some(&mut self.programs)
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

/// A frame on the line.
pub fn frame(unit: u8, request: &[u8]) -> Vec<u8> {
    let mut frame = vec![unit];
    frame.extend_from_slice(request);
    frame.extend_from_slice(&crc16(&frame).to_le_bytes());
    frame
}

/// What comes back, without unit and checksum; empty: nothing.
pub fn ask(plc: &mut Controller<Desk>, request: &[u8]) -> Vec<u8> {
    plc.board().wire.incoming.extend(frame(1, request));
    scans(plc, 10, 1);
    answer(plc)
}

/// The same on the second line.
pub fn ask_second(plc: &mut Controller<Desk>, request: &[u8]) -> Vec<u8> {
    plc.board().second.incoming.extend(frame(1, request));
    scans(plc, 10, 1);
    unframed(std::mem::take(&mut plc.board().second.outgoing))
}

/// What has come back.
pub fn answer(plc: &mut Controller<Desk>) -> Vec<u8> {
    unframed(std::mem::take(&mut plc.board().wire.outgoing))
}

fn unframed(sent: Vec<u8>) -> Vec<u8> {
    let Some(inner) = sent.len().checked_sub(2) else { return sent };
    assert_eq!((sent[0], crc16(&sent)), (1, 0));
    sent[1..inner].to_vec()
}
