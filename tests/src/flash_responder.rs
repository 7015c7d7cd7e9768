//! Boards that are no Uno, or a broken one: as much of a bootloader's STK500 protocol as brings
//! avrdude to its errors.

use std::io;
use std::path::Path;

use plc_isa::SLOT_START;
use simavr::Avr;
use virtual_uno::Port;

const IN_SYNC: u8 = 0x14;
const OK: u8 = 0x10;
const FLASH_LEN: usize = 32 * 1024;

/// What is wrong with a board.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flaw {
    /// It talks, but is no bootloader: a program that was not reset.
    NoBootloader,
    /// It is an ATmega168.
    OtherChip,
    /// A bit of each byte of the program that is read is wrong.
    WrongBytes,
}

/// A board with a flaw, on a port of its own.
pub struct Responder {
    port: Port,
    flaw: Flaw,
    received: Vec<u8>,
    flash: Vec<u8>,
    address: usize,
}

impl Responder {
    /// A board with the firmware.
    pub fn new(flaw: Flaw) -> io::Result<Responder> {
        let mut avr = Avr::new();
        avr.load_hex(awl_asm::hex::FIRMWARE).map_err(io::Error::other)?;
        let flash = avr.flash()[..FLASH_LEN].to_vec();
        Ok(Responder { port: Port::new()?, flaw, received: Vec::new(), flash, address: 0 })
    }

    /// What avrdude opens.
    pub fn port(&self) -> &Path {
        self.port.path()
    }

    /// Answers what has come in.
    pub fn step(&mut self) -> io::Result<()> {
        let received = self.port.read()?;
        if self.flaw == Flaw::NoBootloader {
            return if received.is_empty() { Ok(()) } else { self.port.write(b"Hello\r\n") };
        }
        self.received.extend(received);
        while let Some(len) = command_len(&self.received).filter(|len| *len <= self.received.len())
        {
            let command: Vec<u8> = self.received.drain(..len).collect();
            let data = self.obey(&command);
            self.port.write(&[&[IN_SYNC], &data[..], &[OK]].concat())?;
        }
        Ok(())
    }

    /// Executes a command. Returns the data of its answer.
    fn obey(&mut self, command: &[u8]) -> Vec<u8> {
        match *command {
            [b'A', ..] => vec![3],
            [b'V', ..] => vec![0],
            [b'u', ..] if self.flaw == Flaw::OtherChip => vec![0x1E, 0x94, 0x06],
            [b'u', ..] => vec![0x1E, 0x95, 0x0F],
            [b'U', low, high, _] => {
                self.address = 2 * usize::from(u16::from_le_bytes([low, high]));
                Vec::new()
            }
            [b'd', _, _, _, ref page @ .., _] => {
                self.flash[self.address..self.address + page.len()].copy_from_slice(page);
                Vec::new()
            }
            [b't', high, low, ..] => {
                let len = usize::from(u16::from_be_bytes([high, low]));
                let is_program = self.address >= usize::from(SLOT_START);
                let flip = u8::from(self.flaw == Flaw::WrongBytes && is_program);
                self.flash[self.address..self.address + len]
                    .iter()
                    .map(|byte| byte ^ flip)
                    .collect()
            }
            _ => Vec::new(),
        }
    }
}

/// The length of the command at the beginning, with the space at its end; none while it cannot be
/// told.
fn command_len(received: &[u8]) -> Option<usize> {
    Some(match received {
        [b'A', ..] => 3,
        [b'U', ..] => 4,
        [b't', ..] => 5,
        [b'V', ..] => 6,
        [b'E', ..] => 7,
        [b'B', ..] => 22,
        [b'd', high, low, ..] => 5 + usize::from(u16::from_be_bytes([*high, *low])),
        [b'd', ..] | [] => return None,
        _ => 2,
    })
}
