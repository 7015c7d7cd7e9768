//! The table of instructions: every form of every instruction of the core with its operands, the
//! small program it is in, and what the S7-200 takes. Those of modules are in `module_rows`.
//! Nothing is measured here.

use super::s7_200::{self, Quoted};
use super::values::Item;

/// An instruction in a form, as a row of the table.
#[derive(Debug, Clone, Copy)]
pub struct Row {
    /// Its AWL. `{b}` stands for each bit number, `{x}` for each comparison.
    pub awl: &'static str,
    /// The program around it, which has `{}` where the instruction is.
    frame: &'static str,
    /// What the S7-200 takes, and for how many bits.
    quoted: Option<(Quoted, u32)>,
    /// A line before the program.
    settings: &'static str,
    /// What is in V memory before a scan.
    pub items: &'static [Item],
    /// What its time goes with.
    pub count: Option<Count>,
    /// It does its work once in a program, and refuses to do it again.
    pub is_once: bool,
}

/// How many of something an instruction handles: `{n}` in its AWL and in its items.
#[derive(Debug, Clone, Copy)]
pub struct Count {
    /// Of what.
    pub unit: &'static str,
    /// So many, as a rule.
    pub usual: u8,
    /// So many, to see what each takes.
    pub many: u8,
}

impl Row {
    /// A row with its program. `settings` is a line before it.
    pub const fn new(awl: &'static str, settings: &'static str, frame: &'static str) -> Row {
        Row { awl, frame, quoted: None, settings, items: &[], count: None, is_once: false }
    }

    /// The same with what the S7-200 takes.
    pub const fn quoted(mut self, quoted: Quoted) -> Row {
        let usual = if let Some(count) = self.count { count.usual } else { 0 };
        self.quoted = Some((quoted, usual as u32));
        self
    }

    /// The same with other values in V memory.
    pub const fn with(mut self, items: &'static [Item]) -> Row {
        self.items = items;
        self
    }

    /// The same, of which the longest time counts.
    pub const fn once(mut self) -> Row {
        self.is_once = true;
        self
    }

    /// The same with a count.
    pub const fn count(mut self, unit: &'static str, usual: u8, many: u8) -> Row {
        self.count = Some(Count { unit, usual, many });
        self
    }

    /// Its AWL, with the usual count.
    pub fn name(&self) -> String {
        let usual = self.count.map_or(0, |count| count.usual);
        self.awl.replace("{n}", &usual.to_string())
    }

    /// What the S7-200 takes, in microseconds.
    pub fn quoted_us(&self) -> Option<f64> {
        self.quoted.map(|(quoted, count)| quoted.us(count))
    }

    /// The instructions of this row.
    fn instructions(&self, count: u8) -> Vec<String> {
        const RELATIONS: [&str; 6] = ["=", "<>", "<", ">", "<=", ">="];
        match (self.awl.contains("{b}"), self.awl.contains("{x}")) {
            (true, _) => (0..8).map(|bit| self.awl.replace("{b}", &bit.to_string())).collect(),
            (_, true) => {
                RELATIONS.iter().map(|relation| self.awl.replace("{x}", relation)).collect()
            }
            _ => vec![self.awl.replace("{n}", &count.to_string())],
        }
    }

    /// The program, and the numbers of the instructions that are this row.
    pub fn program(&self) -> (String, Vec<usize>) {
        self.program_with(self.count.map_or(0, |count| count.usual))
    }

    /// The program without this row's instructions, whether it is one or not.
    pub fn rest(&self) -> String {
        let lines = self.frame.lines().filter(|line| *line != "{}").collect::<Vec<_>>().join("\n");
        let forms = self.instructions(0).len();
        format!("{}{}", self.settings, format!("{lines}\n").repeat(forms))
    }

    /// The same with this count.
    pub fn program_with(&self, count: u8) -> (String, Vec<usize>) {
        let (mut text, mut numbers) = (self.settings.to_string(), Vec::new());
        let instructions = self.instructions(count);
        let lines = instructions
            .iter()
            .flat_map(|instruction| self.frame.lines().map(move |line| (line, instruction)));
        let mut number = 0;
        for (line, instruction) in lines {
            if line == "{}" {
                numbers.push(number);
            }
            // What opens and closes a block is no instruction.
            number += usize::from(!line.contains("_BLOCK") && line != "BEGIN");
            text += &line.replace("{}", instruction);
            text.push('\n');
        }
        (text, numbers)
    }
}

/// A contact that loads; one after another; a coil or box after a contact; two and three values.
const LOADS: &str = "{}\n= M31.7";
const BEHIND: &str = "LD M30.0\n{}\n= M31.7";
const BOX: &str = "LD M30.0\n{}";
const TWO: &str = "LD M30.0\nLD M30.1\n{}\n= M31.7";
const THREE: &str = "LD M30.2\nLD M30.1\nLD M30.0\n{}";

const fn row(awl: &'static str, frame: &'static str, quoted: Quoted) -> Row {
    Row::new(awl, "", frame).quoted(quoted)
}

const fn range(awl: &'static str, frame: &'static str, count: u32) -> Row {
    let mut row = Row::new(awl, "", frame);
    row.quoted = Some((s7_200::SET, count));
    row
}

const fn unquoted(awl: &'static str, frame: &'static str) -> Row {
    Row::new(awl, "", frame)
}

const CONTACTS: &[Row] = &[
    row("LD I0.{b}", LOADS, s7_200::LD_I),
    row("LD SM0.0", LOADS, s7_200::LD_I),
    row("LD M1.{b}", LOADS, s7_200::LD),
    row("LD T37", LOADS, s7_200::LD),
    row("LD V0.{b}", LOADS, s7_200::LD),
    row("LDN I0.{b}", LOADS, s7_200::LDN_I),
    row("LDN M1.{b}", LOADS, s7_200::LDN),
    row("LDN C1", LOADS, s7_200::LDN),
    row("LDN V0.{b}", LOADS, s7_200::LDN),
    row("A I0.{b}", BEHIND, s7_200::CONTACT_I),
    row("A M1.{b}", BEHIND, s7_200::CONTACT),
    row("A T37", BEHIND, s7_200::CONTACT),
    row("A V0.{b}", BEHIND, s7_200::CONTACT),
    row("AN I0.{b}", BEHIND, s7_200::CONTACT_I),
    row("AN M1.{b}", BEHIND, s7_200::CONTACT),
    row("AN T37", BEHIND, s7_200::CONTACT),
    row("AN V0.{b}", BEHIND, s7_200::CONTACT),
    row("O I0.{b}", BEHIND, s7_200::CONTACT_I),
    row("O M1.{b}", BEHIND, s7_200::CONTACT),
    row("O T37", BEHIND, s7_200::CONTACT),
    row("O V0.{b}", BEHIND, s7_200::CONTACT),
    row("ON I0.{b}", BEHIND, s7_200::CONTACT_I),
    row("ON M1.{b}", BEHIND, s7_200::CONTACT),
    row("ON T37", BEHIND, s7_200::CONTACT),
    row("ON V0.{b}", BEHIND, s7_200::CONTACT),
    // Of a 1 ms timer: with the hidden instruction that brings it up to date.
    row("LD T32", "LD M30.0\nTON T32, 500\n{}\n= M31.7", s7_200::LD),
    row("NOT", BEHIND, s7_200::LOGIC),
    row("EU", BEHIND, s7_200::EDGE),
    row("ED", BEHIND, s7_200::EDGE),
    row("NOP 0", BEHIND, s7_200::LOGIC),
];

/// A count that is read in a scan.
const COUNTED: &str = "LD SM0.0\nMOVB 8, MB29\nLD M30.0\n{}";

const COILS: &[Row] = &[
    row("= Q0.{b}", BOX, s7_200::ASSIGN),
    row("= M1.{b}", BOX, s7_200::ASSIGN),
    row("= S1.{b}", BOX, s7_200::ASSIGN),
    row("= V0.{b}", BOX, s7_200::ASSIGN),
    row("S Q0.{b}, 1", BOX, s7_200::SET_ONE),
    row("S M1.{b}, 1", BOX, s7_200::SET_ONE),
    row("S V0.{b}, 1", BOX, s7_200::SET_ONE),
    range("S M1.{b}, 8", BOX, 8),
    range("S M0.0, 64", BOX, 64),
    range("S V0.0, 255", BOX, 255),
    range("S M1.{b}, MB29", COUNTED, 8),
    row("R Q0.{b}, 1", BOX, s7_200::SET_ONE),
    row("R M1.{b}, 1", BOX, s7_200::SET_ONE),
    row("R V0.{b}, 1", BOX, s7_200::SET_ONE),
    range("R M1.{b}, 8", BOX, 8),
    range("R M0.0, 64", BOX, 64),
    range("R V0.0, 255", BOX, 255),
    range("R M1.{b}, MB29", COUNTED, 8),
    unquoted("R T37, 1", "LD M30.1\nTON T37, 5\nLD M30.0\n{}"),
    unquoted("R T37, 8", "LD M30.1\nTON T37, 5\nTON T38, 5\nLD M30.0\n{}"),
    unquoted("R T37, MB29", "LD SM0.0\nMOVB 8, MB29\nLD M30.1\nTON T37, 5\nLD M30.0\n{}"),
    unquoted("R C1, 1", "LD M30.1\nLD M30.2\nCTU C1, 5\nLD M30.0\n{}"),
    unquoted("R C1, 8", "LD M30.1\nLD M30.2\nCTU C1, 5\nCTU C2, 5\nLD M30.0\n{}"),
    unquoted("R C1, MB29", "LD SM0.0\nMOVB 8, MB29\nLD M30.1\nLD M30.2\nCTU C1, 5\nLD M30.0\n{}"),
];

const STACK: &[Row] = &[
    row("ALD", TWO, s7_200::LOGIC),
    row("OLD", TWO, s7_200::LOGIC),
    row("LPS", "LD M30.0\n{}\nA M30.1\n= M31.7\nLPP\n= M31.6", s7_200::LPS),
    row("LRD", "LD M30.0\nLPS\nA M30.1\n= M31.7\n{}\n= M31.6\nLPP\n= M31.5", s7_200::LOGIC),
    row("LPP", "LD M30.0\nLPS\nA M30.1\n= M31.7\n{}\n= M31.6", s7_200::LOGIC),
    row("LDS 1", "LD M30.0\nLD M30.1\n{}\nALD\nALD\n= M31.7", s7_200::LOGIC),
    row("LDS 8", "LD M30.0\nLPS\nLPS\nLPS\nLPS\nLPS\nLPS\nLPS\nLPS\n{}\n= M31.7", s7_200::LOGIC),
];

const COMPARISONS: &[Row] = &[
    row("LDW{x} MW4, MW6", LOADS, s7_200::COMPARE_WORDS),
    row("LDW{x} VW4, VW6", LOADS, s7_200::COMPARE_WORDS),
    row("LDW{x} MW4, 5", LOADS, s7_200::COMPARE_WORDS),
    row("LDW{x} VW4, 5", LOADS, s7_200::COMPARE_WORDS),
    row("LDW{x} 5, MW4", LOADS, s7_200::COMPARE_WORDS),
    row("LDW{x} T37, C1", LOADS, s7_200::COMPARE_WORDS),
    row("AW{x} MW4, MW6", BEHIND, s7_200::COMPARE_WORDS_AND),
    row("AW{x} VW4, VW6", BEHIND, s7_200::COMPARE_WORDS_AND),
    row("AW{x} MW4, 5", BEHIND, s7_200::COMPARE_WORDS_AND),
    row("AW{x} 5, MW4", BEHIND, s7_200::COMPARE_WORDS_AND),
    row("OW{x} MW4, MW6", BEHIND, s7_200::COMPARE_WORDS),
    row("OW{x} VW4, VW6", BEHIND, s7_200::COMPARE_WORDS),
    row("OW{x} MW4, 5", BEHIND, s7_200::COMPARE_WORDS),
    row("OW{x} 5, MW4", BEHIND, s7_200::COMPARE_WORDS),
    row("LDB{x} MB4, MB6", LOADS, s7_200::COMPARE_BYTES),
    row("LDB{x} VB4, VB6", LOADS, s7_200::COMPARE_BYTES),
    row("LDB{x} MB4, 5", LOADS, s7_200::COMPARE_BYTES),
    row("LDB{x} 5, MB4", LOADS, s7_200::COMPARE_BYTES),
    row("AB{x} MB4, MB6", BEHIND, s7_200::COMPARE_BYTES),
    row("AB{x} MB4, 5", BEHIND, s7_200::COMPARE_BYTES),
    row("AB{x} 5, MB4", BEHIND, s7_200::COMPARE_BYTES),
    row("OB{x} MB4, MB6", BEHIND, s7_200::COMPARE_BYTES),
    row("OB{x} MB4, 5", BEHIND, s7_200::COMPARE_BYTES),
    row("OB{x} 5, MB4", BEHIND, s7_200::COMPARE_BYTES),
];

const BOXES: &[Row] = &[
    row("MOVB MB4, MB6", BOX, s7_200::MOVB),
    row("MOVB VB4, VB6", BOX, s7_200::MOVB),
    row("MOVB 5, MB6", BOX, s7_200::MOVB),
    row("MOVW MW4, MW6", BOX, s7_200::MOVW),
    row("MOVW VW4, VW6", BOX, s7_200::MOVW),
    row("MOVW AIW0, VW6", BOX, s7_200::MOVW),
    row("MOVW 500, MW6", BOX, s7_200::MOVW),
    row("+I MW4, MW6", BOX, s7_200::ADD),
    row("+I VW4, VW6", BOX, s7_200::ADD),
    row("+I 500, MW6", BOX, s7_200::ADD),
    row("-I MW4, MW6", BOX, s7_200::ADD),
    row("-I VW4, VW6", BOX, s7_200::ADD),
    row("-I 500, MW6", BOX, s7_200::ADD),
    row("*I MW4, MW6", BOX, s7_200::MULTIPLY),
    row("*I 7, VW6", BOX, s7_200::MULTIPLY),
    row("/I MW4, MW6", BOX, s7_200::DIVIDE),
    row("/I 7, VW6", BOX, s7_200::DIVIDE),
    row("INCW MW6", BOX, s7_200::INCREMENT),
    row("INCW VW6", BOX, s7_200::INCREMENT),
    row("DECW MW6", BOX, s7_200::INCREMENT),
    row("DECW VW6", BOX, s7_200::INCREMENT),
];

const TIMERS: &[Row] = &[
    row("TON T32, 50", BOX, s7_200::TON),
    row("TON T33, 5", BOX, s7_200::TON),
    row("TON T37, 2", BOX, s7_200::TON),
    row("TON T37, MW4", BOX, s7_200::TON),
    row("TOF T32, 50", BOX, s7_200::TOF),
    row("TOF T33, 5", BOX, s7_200::TOF),
    row("TOF T37, 2", BOX, s7_200::TOF),
    row("TOF T37, MW4", BOX, s7_200::TOF),
    row("TONR T0, 50", BOX, s7_200::TONR),
    row("TONR T1, 5", BOX, s7_200::TONR),
    row("TONR T5, 2", BOX, s7_200::TONR),
    row("TONR T5, MW4", BOX, s7_200::TONR),
    row("CTU C1, 3", THREE, s7_200::CTU),
    row("CTU C1, MW4", THREE, s7_200::CTU),
    row("CTD C1, 3", THREE, s7_200::CTD),
    row("CTD C1, MW4", THREE, s7_200::CTD),
    row("CTUD C1, 3", THREE, s7_200::CTUD),
    row("CTUD C1, MW4", THREE, s7_200::CTUD),
];

/// A word that is 0 at the start of each scan, and one more with each pass.
const BACK: &str = "LD SM0.0\nMOVW 0, MW28\nLBL 1\nLD SM0.0\nINCW MW28\nLDW< MW28, 4\n{}";

const CONTROL: &[Row] = &[
    row("FOR MW28, 1, 3", "LD M30.0\n{}\nLD SM0.0\n= M31.7\nNEXT", s7_200::FOR),
    row(
        "FOR MW28, VW2, VW4",
        "LD SM0.0\nMOVW 1, VW2\nMOVW 3, VW4\nLD M30.0\n{}\nLD SM0.0\n= M31.7\nNEXT",
        s7_200::FOR,
    ),
    row("NEXT", "LD M30.0\nFOR MW28, 1, 3\nLD SM0.0\n= M31.7\n{}", s7_200::PASS),
    row("JMP 1 // forward", "LD M30.0\n{}\nLD SM0.0\n= M31.7\nLBL 1", s7_200::JMP),
    row("JMP 1 // back", BACK, s7_200::JMP),
    row("LBL 1", "LD M30.0\nJMP 1\nLD SM0.0\n= M31.7\n{}\nLD SM0.0\n= M31.6", s7_200::LOGIC),
    row("END", BOX, s7_200::END),
    row("STOP", "LD M30.0\nA M30.1\nA M30.2\n{}", s7_200::STOP),
    row("WDR", BOX, s7_200::WDR),
];

/// A chapter of the table.
pub struct Chapter {
    /// Its title.
    pub title: &'static str,
    /// Its rows.
    pub rows: &'static [Row],
}

/// All rows.
pub const CHAPTERS: [Chapter; 7] = [
    Chapter { title: "Contacts", rows: CONTACTS },
    Chapter { title: "Coils", rows: COILS },
    Chapter { title: "Logic stack", rows: STACK },
    Chapter { title: "Comparisons", rows: COMPARISONS },
    Chapter { title: "Moves and arithmetic", rows: BOXES },
    Chapter { title: "Timers and counters", rows: TIMERS },
    Chapter { title: "Program control", rows: CONTROL },
];

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use plc_isa::{Group, Op, WIDE_PREFIX};

    use super::*;
    use crate::forms::{Row, places, rows};
    use crate::image::image;

    /// What this page measures: the core, without what the assembler puts in and what comes in
    /// units.
    fn is_measured(row: &Row) -> bool {
        let group = row.instruction.group;
        let is_apart = matches!(group, Group::Call | Group::Sequence | Group::Interrupt);
        row.form.prefix.is_none_or(|prefix| prefix == WIDE_PREFIX)
            && !is_apart
            && !NOT_WRITTEN.contains(&row.instruction.op)
    }

    const NOT_WRITTEN: [Op; 8] = [
        Op::ScrAnd,
        Op::CallBegin,
        Op::BitCopy,
        Op::Ret,
        Op::Poll,
        Op::NoteEno,
        Op::Aeno,
        Op::Approach,
    ];

    #[test]
    fn every_form_of_the_core_has_a_row() {
        let mut seen = BTreeSet::new();
        for row in CHAPTERS.iter().flat_map(|chapter| chapter.rows) {
            seen.extend(places(&image(&row.program().0)).iter().map(|place| place.row.name()));
        }
        let measured = rows().into_iter().filter(is_measured);
        let missing: Vec<String> =
            measured.map(|row| row.name()).filter(|name| !seen.contains(name)).collect();
        assert!(missing.is_empty(), "{missing:?}");
    }
}
