//! A rung as it is drawn: elements on a grid, nets that carry power flow, wires that belong to
//! them. Its nets are its meaning: they are evaluated here.

use plc_isa::Relation;

/// What an element looks like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shape {
    /// Two bars with a symbol between them.
    Contact,
    /// Round brackets with a symbol between them: the end of a wire.
    Coil,
    /// A box with inputs to the left and outputs to the right.
    Box,
}

/// What becomes of the power flow in an element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Through {
    /// It goes on where the element lets it: a contact, ENO of a box.
    And,
    /// It is turned round: NOT.
    Inverted,
    /// It goes on in the scan in which it comes or goes: EU, ED.
    Edge,
    /// It goes on.
    All,
    /// It ends here.
    Ends,
}

/// Where an operand is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Above the element.
    Above,
    /// Below a contact or coil.
    Below,
    /// Beside a box: what it reads, and numbers.
    Left,
    /// Beside a box: what it writes.
    Right,
}

/// An operand.
#[derive(Debug, Clone, PartialEq)]
pub struct Operand {
    /// As it is written in the program.
    pub text: String,
    /// Its address, if a name was written; the name, if there is one for the address.
    pub other: Option<String>,
    /// The comment of its symbol.
    pub comment: String,
    /// The number, if it is one.
    pub number: Option<f64>,
}

/// An operand at its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Pin {
    /// What a box has at it: `IN1`, `OUT`; empty beside contacts and coils.
    pub name: String,
    /// Where.
    pub side: Side,
    /// The operand.
    pub operand: Operand,
}

/// An input of power flow.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Power {
    /// What a box has at it: `EN`, `IN`, `CU`; empty at contacts and coils.
    pub name: &'static str,
    /// The row, from that of the element on.
    pub row: usize,
    /// Where the power flow comes from: a net.
    pub net: usize,
}

/// A contact, coil or box.
#[derive(Debug, Clone, PartialEq)]
pub struct Element {
    /// What it looks like.
    pub shape: Shape,
    /// What becomes of the power flow.
    pub through: Through,
    /// Whether it loads a value, so that the power flow after its line is what it lets through.
    pub is_load: bool,
    /// Whether a contact is closed where its bit is 0.
    pub is_inverted: bool,
    /// The comparison of a contact that compares.
    pub relation: Option<Relation>,
    /// What is written in it: `/`, `>=I`, `S`, `TON`.
    pub symbol: String,
    /// The mnemonic as it is written in the program, in upper case.
    pub mnemonic: String,
    /// Its line in the program, from 1.
    pub line: usize,
    /// Of a box whose ENO goes on, the line of the AENO.
    pub eno: Option<usize>,
    /// Its operands.
    pub pins: Vec<Pin>,
    /// Where power flow comes in: one place, more at a counter.
    pub powers: Vec<Power>,
    /// The net behind it, where power flow goes on.
    pub output: Option<usize>,
    /// The first column, from 0.
    pub column: usize,
    /// The first row, from 0: power flow comes in there.
    pub row: usize,
    /// Columns that it takes.
    pub columns: usize,
    /// Rows that it takes.
    pub rows: usize,
}

/// Something that has one power flow everywhere.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Net {
    /// The power rail.
    Rail,
    /// What an element lets through.
    After {
        /// The element.
        element: usize,
        /// The net before it.
        input: usize,
    },
    /// What comes together.
    Join(Vec<usize>),
}

/// A straight wire. Columns count their left edges, rows their middles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Wire {
    /// The net that it belongs to.
    pub net: usize,
    /// Column and row where it begins.
    pub from: (usize, usize),
    /// Column and row where it ends: either the same row to the right, or the same column below.
    pub to: (usize, usize),
}

/// A rung on a grid.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Picture {
    /// How many columns it has.
    pub columns: usize,
    /// How many rows.
    pub rows: usize,
    /// What it is made of, in the order of the program.
    pub elements: Vec<Element>,
    /// The nets: each after those that it comes from.
    pub nets: Vec<Net>,
    /// The wires between the elements.
    pub wires: Vec<Wire>,
}

impl Picture {
    /// The power flow in each net. `rail` is that of the rail; `through` says what comes out of an
    /// element, by its number, where this goes into it. `None`: it is not known.
    pub fn flows(
        &self,
        rail: Option<bool>,
        mut through: impl FnMut(usize, Option<bool>) -> Option<bool>,
    ) -> Vec<Option<bool>> {
        let mut flows: Vec<Option<bool>> = Vec::with_capacity(self.nets.len());
        for net in &self.nets {
            let flow = |net: usize| flows.get(net).copied().flatten();
            flows.push(match net {
                Net::Rail => rail,
                Net::After { element, input } => through(*element, flow(*input)),
                Net::Join(nets) => joined(nets.iter().map(|&net| flow(net))),
            });
        }
        flows
    }
}

/// One is enough; all must be known to be none.
fn joined(flows: impl Iterator<Item = Option<bool>>) -> Option<bool> {
    let mut is_known = true;
    for flow in flows {
        match flow {
            Some(true) => return Some(true),
            Some(false) => {}
            None => is_known = false,
        }
    }
    is_known.then_some(false)
}
