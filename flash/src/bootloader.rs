//! A model of an Uno with Optiboot, for tests: its flash, its reset, its answers. Time does not
//! pass in it; a command that does not end as it must starts the application, which is silent.

use crate::PAGE_LEN;
use crate::stk500;

/// All of the Uno's flash.
const FLASH_LEN: usize = 32 * 1024;
/// Above this address a page is erased when it is complete, below it as soon as it is announced.
const LATE_ERASE: usize = 0x7000;

/// A board.
#[derive(Debug, Clone)]
pub struct Bootloader {
    /// The bytes that name its chip.
    pub signature: [u8; 3],
    flash: Vec<u8>,
    received: Vec<u8>,
    address: usize,
    is_listening: bool,
    lines: bool,
}

impl Default for Bootloader {
    fn default() -> Self {
        Bootloader {
            signature: [0x1E, 0x95, 0x0F],
            flash: vec![0xFF; FLASH_LEN],
            received: Vec::new(),
            address: 0,
            is_listening: false,
            lines: true,
        }
    }
}

impl Bootloader {
    /// Its flash.
    pub fn flash(&self) -> &[u8] {
        &self.flash
    }

    /// Its flash, to put something in it.
    pub fn flash_mut(&mut self) -> &mut [u8] {
        &mut self.flash
    }

    /// DTR is switched: its coming on is a reset.
    pub fn lines(&mut self, on: bool) {
        if on && !self.lines {
            self.received.clear();
            self.is_listening = true;
        }
        self.lines = on;
    }

    /// Bytes come; gives those that it answers.
    pub fn receive(&mut self, bytes: &[u8]) -> Vec<u8> {
        bytes.iter().flat_map(|&byte| self.take(byte)).collect()
    }

    fn take(&mut self, byte: u8) -> Vec<u8> {
        if !self.is_listening {
            return Vec::new();
        }
        self.received.push(byte);
        if self.received.len() == 4 && self.received[0] == stk500::WRITE_PAGE {
            self.erase_if(|address| address < LATE_ERASE);
        }
        let Some(data_len) = data_len(&self.received) else { return Vec::new() };
        if self.received.len() < data_len + 2 {
            return Vec::new();
        }
        let command = std::mem::take(&mut self.received);
        if command.last() != Some(&stk500::END) {
            self.is_listening = false;
            return Vec::new();
        }
        let answer = self.obey(command[0], &command[1..=data_len]);
        [&[stk500::IN_SYNC], &answer[..], &[stk500::OK]].concat()
    }

    fn obey(&mut self, command: u8, data: &[u8]) -> Vec<u8> {
        match (command, data) {
            (stk500::READ_SIGNATURE, _) => return self.signature.to_vec(),
            (stk500::LOAD_ADDRESS, &[low, high]) => {
                self.address = 2 * usize::from(u16::from_le_bytes([low, high]));
            }
            (stk500::WRITE_PAGE, [_, _, _, page @ ..]) => {
                self.erase_if(|address| address >= LATE_ERASE);
                let room = self.flash.iter_mut().skip(self.address);
                room.zip(page).for_each(|(old, new)| *old = *new);
            }
            (stk500::READ_PAGE, &[high, low, _]) => {
                let len = usize::from(u16::from_be_bytes([high, low]));
                return self.flash.iter().skip(self.address).take(len).copied().collect();
            }
            (stk500::LEAVE, _) => self.is_listening = false,
            _ => {}
        }
        Vec::new()
    }

    /// Erases the page at the address, if that is such a one.
    fn erase_if(&mut self, is_such: fn(usize) -> bool) {
        if is_such(self.address) {
            let page = self.flash.iter_mut().skip(self.address / PAGE_LEN * PAGE_LEN);
            page.take(PAGE_LEN).for_each(|byte| *byte = 0xFF);
        }
    }
}

/// How many bytes are between a command and its end; none while that cannot be told.
fn data_len(received: &[u8]) -> Option<usize> {
    Some(match received {
        [] => return None,
        [stk500::LOAD_ADDRESS, ..] => 2,
        [stk500::READ_PAGE, ..] => 3,
        [stk500::WRITE_PAGE, high, low, ..] => 3 + usize::from(u16::from_be_bytes([*high, *low])),
        [stk500::WRITE_PAGE, ..] => return None,
        _ => 0,
    })
}
