//! What a random program may use: modules, subroutines, sequences.

use awl_asm::modules;
use fastrand::Rng;
use plc_isa::{
    COUNTERS_MODULE, FREEPORT_MODULE, Group, Instruction, MODULES, OPERANDS_MODULE, Op,
    PULSES_MODULE, SLOT_LEN, needed_modules,
};

/// Bytes of the image that are neither code nor modules, at most, with what the assembler puts into
/// the code.
const REST_LEN: u32 = 1_600;

/// No module is taken that leaves less room for code.
const CODE_LEN_MIN: u32 = 900;

/// What a program may use.
#[derive(Debug, Clone, Copy)]
pub struct Offer {
    modules: [bool; MODULES],
    units: bool,
    /// On the board a byte of inputs has bits without a pin, which BIR reads as 0 whatever a test
    /// has put into the process image.
    has_all_points: bool,
}

impl Offer {
    /// The instructions of the core in one unit.
    pub fn core() -> Offer {
        Offer { modules: [false; MODULES], units: false, has_all_points: true }
    }

    /// The same with subroutines and sequences.
    pub fn units() -> Offer {
        Offer { units: true, ..Offer::core() }
    }

    /// Subroutines, sequences, and as many modules as have room beside code.
    pub fn everything(rng: &mut Rng) -> Offer {
        Offer::some(rng, |_| true)
    }

    /// The same with the modules alone that have machine code.
    pub fn board(rng: &mut Rng) -> Offer {
        Offer { has_all_points: false, ..Offer::some(rng, |module| module_len(module) > 0) }
    }

    /// All modules, whether they have room or not.
    #[cfg(test)]
    pub(super) fn whole() -> Offer {
        Offer { modules: [true; MODULES], units: true, has_all_points: true }
    }

    fn some(rng: &mut Rng, is_there: impl Fn(usize) -> bool) -> Offer {
        let mut offer = Offer { modules: [false; MODULES], units: true, has_all_points: true };
        let mut order: Vec<usize> = (0..MODULES).filter(|&module| !is_apart(module)).collect();
        rng.shuffle(&mut order);
        for module in order.into_iter().filter(|&module| is_there(module)) {
            let before = offer;
            offer.modules[module] = true;
            for &needed in needed_modules(module as u8) {
                offer.modules[usize::from(needed)] = true;
            }
            if offer.code_len_max() < CODE_LEN_MIN {
                offer = before;
            }
        }
        offer
    }

    /// Longest program in bytes of code.
    pub(super) fn code_len_max(&self) -> u32 {
        let used = |&module: &usize| {
            self.modules[module] || self.has_modules() && module == usize::from(OPERANDS_MODULE)
        };
        let modules: u32 = (0..MODULES).filter(used).map(module_len).sum();
        u32::from(SLOT_LEN).saturating_sub(REST_LEN + modules)
    }

    /// Whether there are modules.
    pub(super) fn has_modules(&self) -> bool {
        self.modules.contains(&true)
    }

    /// Whether there are pointers: module general makes them.
    pub(super) fn has_pointers(&self) -> bool {
        self.modules[0]
    }

    /// Whether there are subroutines and sequences.
    pub(super) fn has_units(&self) -> bool {
        self.units
    }

    /// Whether an instruction can be anywhere in a rung and do no harm, and means the same to
    /// all that are compared: what the hardware does is none of that.
    pub(super) fn is_plain(&self, instruction: &Instruction) -> bool {
        let special = matches!(
            instruction.op,
            Op::For
                | Op::Next
                | Op::Jmp
                | Op::Lbl
                | Op::End
                | Op::Stop
                | Op::Aeno
                | Op::Hdef
                | Op::Hsc
                | Op::Pls
        );
        let apart = matches!(
            instruction.group,
            Group::Hidden | Group::Call | Group::Sequence | Group::Interrupt
        );
        let hardware = instruction.group == Group::Communication
            && !matches!(instruction.op, Op::Bitim | Op::Citim);
        let reads_points = instruction.op == Op::Bir && !self.has_all_points;
        let is_there = instruction.module().is_none_or(|module| self.modules[usize::from(module)]);
        !special && !apart && !hardware && !reads_points && is_there
    }
}

/// The modules that no random program asks for: that of operands comes with others, and what
/// counters, pulses and freeport do is no matter of scans.
fn is_apart(module: usize) -> bool {
    matches!(module as u8, OPERANDS_MODULE | COUNTERS_MODULE | PULSES_MODULE | FREEPORT_MODULE)
}

fn module_len(module: usize) -> u32 {
    modules::bytes(module as u8).len() as u32
}
