//! The benchmark programs, written by a generator: the same text at every call. What they take is
//! measured elsewhere.
//!
//! There are no jumps: every instruction is reached in every scan. Word boxes are after contacts
//! that the translator cannot know, by turns with power flow (M30.0) and without (M30.1), as in a
//! machine not all steps are active.

use std::fmt::Write as _;

/// Instructions of the long programs.
pub const STEPS: usize = 1024;
/// Word instructions of the 80/20 program: a fifth.
pub const WORD_STEPS: usize = STEPS / 5;
/// Instructions of the short mix.
pub const MIX_STEPS: usize = 164;
/// Word instructions of the short mix.
pub const MIX_WORD_STEPS: usize = 12;

/// 1,024 instructions, 80 % of them bit instructions and 20 % word instructions.
pub fn eighty_twenty() -> String {
    Generator::new(8020).program(STEPS, WORD_STEPS)
}

/// The same with power flow at all boxes: its longest scan.
pub fn eighty_twenty_all_boxes() -> String {
    eighty_twenty().replacen(GUARDS, ALL_GUARDS, 1)
}

/// 1,024 bit instructions.
pub fn boolean() -> String {
    Generator::new(1024).program(STEPS, 0)
}

/// 164 instructions, 12 of them word instructions.
pub fn mix() -> String {
    Generator::new(164).program(MIX_STEPS, MIX_WORD_STEPS)
}

/// Whether an instruction of these programs is a word instruction.
pub fn is_word(mnemonic: &str) -> bool {
    matches!(mnemonic, "LDW" | "AW" | "OW" | "MOVW" | "+I" | "-I" | "INCW" | "DECW")
}

/// Rungs of bits. `i`, `m`, `q` stand for a bit of their area.
const BIT_RUNGS: [&str; 8] = [
    // Seal-in.
    "LD i\nO q\nAN i\nAN m\n= q\n",
    "LD i\nO m\nAN i\n= m\n",
    // A step of a sequence.
    "LD m\nA i\nAN m\nS m, 1\nR m, 1\n",
    // Branches after a common contact.
    "LD m\nA i\nLPS\nAN m\n= q\nLPP\nA m\n= m\n",
    "LD i\nAN m\nLPS\nA i\nS q, 1\nLRD\nAN i\nR q, 1\nLPP\nA m\n= m\n",
    // Two ways to the same coil.
    "LD i\nA m\nLDN i\nA m\nOLD\nAN m\n= q\n",
    "LD m\nON i\nLD m\nO i\nALD\n= m\n",
    "LDN m\nA i\nNOT\n= q\n",
];

/// Sets M30.0 in the first scan and leaves M30.1; and sets both.
const GUARDS: &str = "LD SM0.1\nS M30.0, 1\n";
const ALL_GUARDS: &str = "LD SM0.1\nS M30.0, 2\n";

/// Rungs with words. `w` stands for a word, `c` for a constant, `g` for the next of the two guards.
const WORD_RUNGS: [&str; 6] = [
    "LDW>= w, c\nA m\n= m\n",
    "LD m\nAW< w, c\nAN i\n= q\n",
    "LDW> w, w\nAW< w, c\nA i\n= m\n",
    "LD g\nMOVW w, w\n",
    "LD g\n+I c, w\n-I w, w\n",
    "LD g\nMOVW c, w\nINCW w\n",
];

/// What fills up the last places, on the value that is there.
const LAST_BIT: &str = "= m\n";
const LAST_WORD: &str = "INCW w\n";

struct Generator {
    state: u32,
    text: String,
    networks: usize,
    guards: usize,
    /// Instructions, and word instructions among them, that are still wanted.
    wanted: usize,
    wanted_words: usize,
}

impl Generator {
    fn new(seed: u32) -> Generator {
        Generator {
            state: seed,
            text: String::new(),
            networks: 0,
            guards: 0,
            wanted: 0,
            wanted_words: 0,
        }
    }

    /// A number below `end`: Marsaglia's xorshift, so that no library decides what the benchmark
    /// is.
    fn below(&mut self, end: usize) -> usize {
        self.state ^= self.state << 13;
        self.state ^= self.state >> 17;
        self.state ^= self.state << 5;
        self.state as usize % end
    }

    fn program(mut self, steps: usize, word_steps: usize) -> String {
        (self.wanted, self.wanted_words) = (steps, word_steps);
        if word_steps > 0 {
            self.text += GUARDS;
            self.wanted -= count(GUARDS).0;
        }
        while self.wanted > 0 {
            // Words are spread evenly.
            let is_behind = self.wanted_words * steps >= self.wanted * word_steps;
            match self.wanted_words > 0 && is_behind {
                true => self.rung(&WORD_RUNGS, LAST_WORD),
                false => self.rung(&BIT_RUNGS, LAST_BIT),
            }
        }
        self.text
    }

    /// Any of these rungs that fits, else the last resort.
    fn rung(&mut self, rungs: &[&'static str], last: &'static str) {
        let first = self.below(rungs.len());
        let room = (self.wanted, self.wanted_words);
        let fits = |rung: &&&str| count(rung).0 <= room.0 && count(rung).1 <= room.1;
        let rung = rungs.iter().cycle().skip(first).take(rungs.len()).find(fits).copied();
        if rung.is_some() {
            self.networks += 1;
            let _ = writeln!(self.text, "NETWORK {}", self.networks);
        }
        let rung = rung.unwrap_or(last);
        let (len, words) = count(rung);
        (self.wanted, self.wanted_words) = (self.wanted - len, self.wanted_words - words);
        for letter in rung.chars() {
            let operand = self.operand(letter);
            self.text += &operand;
        }
    }

    fn operand(&mut self, letter: char) -> String {
        match letter {
            'i' => format!("I0.{}", self.below(6)),
            'q' => format!("Q0.{}", self.below(6)),
            'm' => format!("M{}.{}", self.below(4), self.below(8)),
            'g' => {
                self.guards += 1;
                format!("M30.{}", self.guards % 2)
            }
            'w' if self.below(4) == 0 => format!("VW{}", 2 * self.below(8)),
            'w' => format!("MW{}", 4 + 2 * self.below(12)),
            'c' => (self.below(200) as i32 - 100).to_string(),
            other => other.to_string(),
        }
    }
}

/// Instructions of a rung, and word instructions among them.
fn count(rung: &str) -> (usize, usize) {
    let mnemonics = rung.lines().filter_map(|line| line.split(' ').next());
    let words = mnemonics.filter(|mnemonic| is_word(mnemonic.trim_end_matches(['=', '<', '>'])));
    (rung.lines().count(), words.count())
}

#[cfg(test)]
mod tests {
    use awl_asm::assemble::assemble;
    use awl_asm::source::Source;
    use plc_isa::SLOT_LEN;

    use super::*;

    /// Instructions, and word instructions among them, as the assembler counts them.
    fn counted(text: &str) -> (usize, usize) {
        let assembly = assemble(&Source::new("bench", text).unwrap(), Vec::new());
        assert!(
            assembly.image.is_some_and(|image| image.len() < usize::from(SLOT_LEN)),
            "{:?}",
            assembly.diagnostics
        );
        let mnemonics = assembly.code.iter().map(|selected| selected.op.instruction().mnemonic());
        (assembly.code.len(), mnemonics.filter(|mnemonic| is_word(mnemonic)).count())
    }

    #[test]
    fn the_programs_are_what_they_are_called() {
        assert_eq!(counted(&eighty_twenty()), (1024, 204));
        assert_eq!(counted(&boolean()), (1024, 0));
        assert_eq!(counted(&mix()), (164, 12));
        assert_eq!(counted(&eighty_twenty_all_boxes()), (1024, 204));
        assert_ne!(eighty_twenty_all_boxes(), eighty_twenty());
    }

    #[test]
    fn the_programs_are_the_same_every_time() {
        assert_eq!(eighty_twenty(), eighty_twenty());
        assert_ne!(eighty_twenty()[..200], boolean()[..200]);
    }
}
