//! Function block diagrams as text: units in Structured Text whose bodies are calls of blocks and
//! assignments. They are checked by the rules of diagrams and put into the order of their links;
//! what a call means is the business of Structured Text.
//!
//! `elements` says what a statement reads and writes, `order` which is executed before which;
//! [`drawing`] draws them, with the pins that [`interfaces`] gives blocks; [`edit`] changes them.

mod addresses;
mod comments;
mod connections;
pub mod diagnostic;
pub mod drawing;
pub mod edit;
mod elements;
mod feedback;
pub mod interfaces;
mod mark;
mod order;
mod pragmas;
pub mod svg;

use diagnostics::Source;
use st::lexer::cut;
use st::tree::{File, Statement, Unit, UnitKind};

use addresses::Addresses;
pub use diagnostic::{Code, Diagnostic};
use elements::{Element, Reading};
use feedback::Feedback;
pub use mark::marked;

/// A text with diagrams.
#[derive(Debug)]
pub struct Read {
    /// Its units; their elements are in the order of the text.
    pub file: File,
    /// What Structured Text says about it.
    pub of_st: Vec<st::Diagnostic>,
    /// What breaks the rules of diagrams; nothing where Structured Text finds something.
    pub diagnostics: Vec<Diagnostic>,
}

/// Reads a text and checks its diagrams, for who wants to see them.
pub fn read(source: &Source) -> Read {
    let (file, of_st) = st::parser::parse(source);
    let diagnostics = match of_st.is_empty() {
        true => arrange(source, &mut file.clone()),
        false => Vec::new(),
    };
    Read { file, of_st, diagnostics }
}

/// Puts the units of a file, as Structured Text has read it, into the order in which they are
/// executed. Returns what breaks the rules of diagrams; functions have none.
pub fn arrange(source: &Source, file: &mut File) -> Vec<Diagnostic> {
    let pragmas = cut(&source.text).pragmas;
    let mut feedback = Feedback::of(&source.text, &pragmas);
    let mut found = pragmas::check(&source.text, &pragmas, diagrams(file));
    for unit in file.units.iter_mut().filter(|one| is_diagram(one)) {
        arrange_unit(&source.text, unit, &mut feedback, &mut found);
    }
    found.extend(feedback.left());
    found.sort_by_key(|one| one.span);
    found
}

/// The units of a file that are diagrams.
fn diagrams(file: &File) -> impl Iterator<Item = &Unit> {
    file.units.iter().filter(|one| is_diagram(one))
}

fn is_diagram(unit: &Unit) -> bool {
    !matches!(unit.kind, UnitKind::Function(_))
}

fn arrange_unit<'t>(
    text: &'t str,
    unit: &mut Unit,
    feedback: &mut Feedback<'t>,
    found: &mut Vec<Diagnostic>,
) {
    let mut reading = Reading { text, addresses: Addresses::of(unit), feedback };
    let statements = std::mem::take(&mut unit.body);
    if statements.is_empty() {
        let message = format!("{}: there is nothing in this diagram", unit.name.text);
        let help = "a call of a block, or an assignment: `Lamp := Button;`";
        found.push(Diagnostic::new(Code::Empty, unit.name.span, message).help(help));
    }
    let mut elements = Vec::new();
    for statement in statements {
        match Element::of(statement, &mut reading) {
            Ok(element) => elements.push(element),
            Err(wrong) => found.push(*wrong),
        }
    }
    connections::check(&reading, unit, &elements, found);
    let order = order::of(&elements, found);
    let mut statements: Vec<Option<Statement>> =
        elements.into_iter().map(|element| Some(element.statement)).collect();
    unit.body = order.into_iter().filter_map(|at| statements.get_mut(at)?.take()).collect();
}
