//! Variables and their kinds: as a table says (csv: `name,kind,type`), otherwise as their use
//! shows.

use std::collections::HashMap;

use awl_asm::suggest::nearest;
use diagnostics::{Source, Span};
use st::names::is_name;

use crate::diagnostic::{Code, Diagnostic};

/// What a variable is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Between charts: control signals and derived ones.
    Signal,
    /// An input of the controller.
    Input,
    /// An output of the controller.
    Output,
    /// Memory of the controller.
    Memory,
    /// Has its value from the controller.
    System,
    /// Never changes.
    Constant,
    /// A timer.
    Timer,
    /// A counter.
    Counter,
}

impl Kind {
    /// Those that a table can name.
    pub const ALL: [(&'static str, Kind); 8] = [
        ("signal", Kind::Signal),
        ("input", Kind::Input),
        ("output", Kind::Output),
        ("memory", Kind::Memory),
        ("system", Kind::System),
        ("constant", Kind::Constant),
        ("timer", Kind::Timer),
        ("counter", Kind::Counter),
    ];

    fn types(self) -> &'static [&'static str] {
        match self {
            Kind::Timer => &["TON", "TOF", "TP"],
            Kind::Counter => &["CTU", "CTD", "CTUD"],
            _ => &["BOOL", "INT", "WORD", "DWORD", "REAL", "TIME"],
        }
    }
}

/// A variable.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// What it is.
    pub kind: Kind,
    /// Its type: BOOL, INT, ..., TON, CTU.
    pub of_type: String,
    /// Its value, of a constant: after the type in the table, `INT := 5`.
    pub value: Option<String>,
}

/// The rows of a table, by name. Letter case matters in charts, though not in ST.
#[derive(Debug, Clone, Default)]
pub struct Table {
    rows: HashMap<String, (Variable, Span)>,
}

impl Table {
    /// The row of a name.
    pub fn get(&self, name: &str) -> Option<&Variable> {
        self.rows.get(name).map(|(variable, _)| variable)
    }

    /// All rows with their places.
    pub fn rows(&self) -> impl Iterator<Item = &(Variable, Span)> {
        self.rows.values()
    }
}

/// Reads a table. The first line may name the columns; empty lines and lines after `#` are nothing.
pub fn read(source: &Source) -> (Table, Vec<Diagnostic>) {
    let (mut table, mut diagnostics) = (Table::default(), Vec::new());
    let mut start = 0;
    for line in source.text.split_inclusive('\n') {
        if let Some(row) = Row::of(line, start)
            && !(start == 0 && row.cells[0].0.eq_ignore_ascii_case("name"))
        {
            match row.variable() {
                Ok(variable) => {
                    let name = variable.name.clone();
                    let span = row.cells[0].1;
                    if let Some((_, other)) = table.rows.insert(name, (variable, span)) {
                        let message = format!("{}: this name is there twice", row.cells[0].0);
                        let error = Diagnostic::new(Code::BadVariables, span, message);
                        diagnostics.push(error.related(other, "the other one"));
                    }
                }
                Err(error) => diagnostics.push(*error),
            }
        }
        start += line.len();
    }
    (table, diagnostics)
}

struct Row<'t> {
    cells: Vec<(&'t str, Span)>,
}

impl<'t> Row<'t> {
    fn of(line: &'t str, start: usize) -> Option<Row<'t>> {
        if line.trim().is_empty() || line.trim_start().starts_with('#') {
            return None;
        }
        let separator = if line.contains(';') && !line.contains(',') { ';' } else { ',' };
        let (mut cells, mut at) = (Vec::new(), 0);
        for cell in line.split(separator) {
            let text = cell.trim().trim_matches('"');
            let from = at + cell.find(text).unwrap_or(0);
            cells.push((text, Span::new(start + from, start + from + text.len())));
            at += cell.len() + 1;
        }
        Some(Row { cells })
    }

    fn variable(&self) -> Result<Variable, Box<Diagnostic>> {
        let bad = |span, message: String| Diagnostic::new(Code::BadVariables, span, message);
        let [(name, at), (kind, kind_at), rest @ ..] = &self.cells[..] else {
            let message = "a row has a name, a kind and a type".to_owned();
            return Err(Box::new(
                bad(self.cells[0].1, message).help("for example `Start,input,BOOL`"),
            ));
        };
        if !is_name(name) {
            return Err(Box::new(bad(*at, format!("`{name}` is no name"))));
        }
        let Some((_, found)) = Kind::ALL.iter().find(|(text, _)| text.eq_ignore_ascii_case(kind))
        else {
            let mut error = bad(*kind_at, format!("`{kind}` is no kind of variable"));
            error.suggestion = nearest(kind, Kind::ALL.map(|(text, _)| text)).map(str::to_owned);
            let kinds = Kind::ALL.map(|(text, _)| text).join(", ");
            return Err(Box::new(error.help(format!("kinds are {kinds}"))));
        };
        let types = found.types();
        let (written, type_at) = rest.first().copied().unwrap_or(("", *kind_at));
        let (written, value) = match written.split_once(":=") {
            Some((before, after)) => (before.trim(), Some(after.trim().to_owned())),
            None => (written, None),
        };
        let of_type = match types.iter().find(|one| one.eq_ignore_ascii_case(written)) {
            Some(one) => *one,
            None if written.is_empty() => types[0],
            None => {
                let message = format!("{name}: a {kind} cannot be of type {written}");
                return Err(Box::new(
                    bad(type_at, message).help(format!("it can be {}", types.join(", "))),
                ));
            }
        };
        Ok(Variable { name: (*name).to_owned(), kind: *found, of_type: of_type.to_owned(), value })
    }
}
