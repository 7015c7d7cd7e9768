//! Which bytes of data memory are in registers: pinned ones throughout the program, others as
//! long as it is certain.

use super::avr::Reg;

/// Registers for pinned bytes: they survive every call.
pub const PIN_REGISTERS: [Reg; 14] = {
    let mut registers = [Reg(2); 14];
    let mut index = 0;
    while index < registers.len() {
        registers[index] = Reg(2 + index as u8);
        index += 1;
    }
    registers
};

/// More registers for bytes that are used again. Only the first survives a call.
const CACHE_REGISTERS: [Reg; 5] = [Reg(17), Reg(20), Reg(21), Reg(22), Reg(23)];

/// The last register that calls keep.
const LAST_KEPT: Reg = Reg(17);

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Pin {
    address: u16,
    register: Reg,
    /// Whether memory may hold an older value.
    is_dirty: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Cached {
    register: Reg,
    /// The byte, if the register holds one; memory holds the same value.
    address: Option<u16>,
    used: u32,
}

/// The state of the registers at a place of the program.
#[derive(Debug, Clone)]
pub struct Registers {
    pins: Vec<Pin>,
    cached: Vec<Cached>,
    clock: u32,
}

impl Registers {
    /// With these bytes pinned, as many as there are registers for.
    pub fn new(pinned: &[u16]) -> Registers {
        let pin = |(&address, register)| Pin { address, register, is_dirty: false };
        let pins: Vec<Pin> = pinned.iter().zip(PIN_REGISTERS).map(pin).collect();
        let free = PIN_REGISTERS.into_iter().skip(pins.len());
        let empty = |register| Cached { register, address: None, used: 0 };
        Registers {
            cached: CACHE_REGISTERS.into_iter().chain(free).map(empty).collect(),
            pins,
            clock: 0,
        }
    }

    /// The register of a pinned byte.
    pub fn pin(&self, address: u16) -> Option<Reg> {
        self.pins.iter().find(|pin| pin.address == address).map(|pin| pin.register)
    }

    /// A pinned byte has been changed in its register.
    pub fn changed(&mut self, address: u16) {
        self.pins
            .iter_mut()
            .filter(|pin| pin.address == address)
            .for_each(|pin| pin.is_dirty = true);
    }

    /// Memory has its value again.
    pub fn flushed(&mut self, address: u16) {
        self.pins
            .iter_mut()
            .filter(|pin| pin.address == address)
            .for_each(|pin| pin.is_dirty = false);
    }

    /// The pinned bytes with their registers.
    pub fn pins(&self) -> Vec<(u16, Reg)> {
        self.pins.iter().map(|pin| (pin.address, pin.register)).collect()
    }

    /// The pinned bytes whose memory may be older.
    pub fn dirty(&self) -> Vec<(u16, Reg)> {
        self.pins.iter().filter(|pin| pin.is_dirty).map(|pin| (pin.address, pin.register)).collect()
    }

    /// The register that holds a byte, pinned or not.
    pub fn holding(&mut self, address: u16) -> Option<Reg> {
        self.clock += 1;
        let found = self.cached.iter_mut().find(|cached| cached.address == Some(address));
        let clock = self.clock;
        let in_cache = found.map(|cached| {
            cached.used = clock;
            cached.register
        });
        in_cache.or_else(|| self.pin(address))
    }

    /// A register for a byte that is in none: the one that was not used for the longest time.
    /// `constants` asks for one that takes constants.
    pub fn take(&mut self, address: u16, constants: bool) -> Reg {
        self.clock += 1;
        let fits = |cached: &&mut Cached| !constants || cached.register.takes_constants();
        let oldest = self
            .cached
            .iter_mut()
            .filter(fits)
            .min_by_key(|cached| (cached.address.is_some(), cached.used));
        oldest.map_or(LAST_KEPT, |cached| {
            (cached.address, cached.used) = (Some(address), self.clock);
            cached.register
        })
    }

    /// The byte has changed in memory: its copy is worth nothing.
    pub fn forget(&mut self, address: u16) {
        self.forget_if(|held| held == address);
    }

    /// The same for all bytes of which this holds.
    pub fn forget_if(&mut self, holds: impl Fn(u16) -> bool) {
        self.cached
            .iter_mut()
            .filter(|cached| cached.address.is_some_and(&holds))
            .for_each(|cached| cached.address = None);
    }

    /// What is certain at a label: the pinned bytes are in their registers. Any of `modified` may
    /// be newer there.
    pub fn at_label(&mut self, modified: impl Fn(u16) -> bool) {
        self.cached.iter_mut().for_each(|cached| cached.address = None);
        self.pins.iter_mut().for_each(|pin| pin.is_dirty |= modified(pin.address));
    }

    /// A call loses the other registers.
    pub fn called(&mut self) {
        let lost = |cached: &&mut Cached| cached.register > LAST_KEPT;
        self.cached.iter_mut().filter(lost).for_each(|cached| cached.address = None);
    }

    /// What is certain where control comes from here or from where `other` was the state.
    pub fn join(&mut self, other: &Registers) {
        for (cached, other) in self.cached.iter_mut().zip(&other.cached) {
            if cached.address != other.address {
                cached.address = None;
            }
        }
        for (pin, other) in self.pins.iter_mut().zip(&other.pins) {
            pin.is_dirty |= other.is_dirty;
        }
    }
}
