//! The EEPROM, byte by byte. Writing takes 3.4 ms in the background; nobody waits for it here.

use avr_device::atmega328p::EEPROM;
use avr_device::interrupt;

/// The EEPROM.
pub struct Eeprom {
    registers: EEPROM,
}

impl Eeprom {
    /// Whether no write is under way.
    pub fn is_ready(&self) -> bool {
        self.registers.eecr().read().eepe().bit_is_clear()
    }

    /// The byte at an address below 1,024. Only when ready.
    #[inline(never)]
    pub fn read(&self, address: u16) -> u8 {
        self.registers.eear().write(|w| w.set(address));
        self.registers.eecr().write(|w| w.eere().set_bit());
        self.registers.eedr().read().bits()
    }

    /// Starts to write a byte, unless it is there already. Only when ready. Returns whether a write
    /// is under way.
    pub fn update(&self, address: u16, byte: u8) -> bool {
        // This selects the address for the write, too.
        if self.read(address) == byte {
            return false;
        }
        self.registers.eedr().write(|w| w.set(byte));
        // The second bit must follow the first within four cycles.
        interrupt::free(|_| {
            self.registers.eecr().write(|w| w.eempe().set_bit());
            self.registers.eecr().write(|w| w.eempe().set_bit().eepe().set_bit());
        });
        true
    }
}
