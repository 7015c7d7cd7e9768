//! What the text promises of a run, by the offsets of the image, which knows nothing of it. Whether
//! it is true nobody checks.

use crate::assemble::Assembly;

/// What is stated of a program; nothing by default.
#[derive(Debug, Clone, Default)]
pub struct Stated {
    /// FOR, or LBL of a jump back, with the most passes each time that the program comes to it.
    bounds: Vec<(u16, u32)>,
    /// ATCH, HDEF and PLS with the most events, edges or pulses in a second.
    rates: Vec<(u16, u32)>,
}

impl Stated {
    /// What the text of a program states.
    pub fn of(assembly: &Assembly) -> Stated {
        let at = |&(index, most): &(usize, u32)| {
            let line = assembly.lines.get(index)?;
            Some((u16::try_from(line.at + u32::from(line.hidden_len)).ok()?, most))
        };
        Stated {
            bounds: assembly.promises.bounds.iter().filter_map(at).collect(),
            rates: assembly.promises.rates.iter().filter_map(at).collect(),
        }
    }

    /// The most passes of the loop that begins with this instruction.
    pub fn bound(&self, at: u16) -> Option<u64> {
        find(&self.bounds, at)
    }

    /// The most in a second of what this instruction attaches, counts or makes.
    pub fn rate(&self, at: u16) -> Option<u64> {
        find(&self.rates, at)
    }
}

fn find(list: &[(u16, u32)], at: u16) -> Option<u64> {
    list.iter().find(|(place, _)| *place == at).map(|&(_, most)| u64::from(most))
}
