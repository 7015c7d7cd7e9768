//! Operands that name a symbol and what it stands for, `Start:SBR0` or `Start:I0.0`, as Micro/WIN
//! shows them: the second part counts, and the first must fit it.

use crate::diagnostic::{Code, Diagnostic};
use crate::text::address::Address;
use crate::text::ast::{Span, Unit, UnitId, UnitKind, Value};
use crate::text::symbols::Found;

/// A name with what it stands for.
pub(crate) struct Qualified<'t> {
    /// The name, without quotes.
    pub(crate) name: &'t str,
    /// What is after it, as written.
    target: &'t str,
    /// What that is.
    pub(crate) value: Value,
}

/// Name and address; `None` if the text is none.
pub(crate) fn address(text: &str) -> Option<Qualified<'_>> {
    let (name, target) = parts(text)?;
    let value = Value::Address(Address::parse(target).ok()?);
    Some(Qualified { name, target, value })
}

/// Name and number of a routine; `None` if the text is none.
pub(crate) fn routine(text: &str, kind: UnitKind) -> Option<Qualified<'_>> {
    let (name, target) = parts(text)?;
    let id = UnitId::parse(target).filter(|id| id.kind == kind)?;
    Some(Qualified { name, target, value: Value::Unit(id) })
}

fn parts(text: &str) -> Option<(&str, &str)> {
    let (name, target) = text.rsplit_once(':')?;
    let inside = name.strip_prefix('"').and_then(|name| name.strip_suffix('"'));
    let name = inside.unwrap_or(name).trim();
    (!name.is_empty()).then_some((name, target.trim()))
}

impl Qualified<'_> {
    /// The value, if the symbol of the name has the same. A name that is declared nowhere stands in
    /// a symbol table that is not at hand.
    pub(crate) fn checked(
        self,
        span: Span,
        found: Option<Found<'_>>,
    ) -> Result<Value, Box<Diagnostic>> {
        match found {
            Some(Found::Symbol(_, symbol)) if symbol.value != self.value => {
                let Qualified { name, target, .. } = self;
                let message = format!("{name}:{target}: the symbol {name} stands for another");
                let diagnostic = Diagnostic::new(Code::SymbolDefinition, span, message);
                Err(Box::new(diagnostic.help(format!("write {target} or {name} alone"))))
            }
            _ => Ok(self.value),
        }
    }

    /// The routine of this number has another name.
    pub(crate) fn other_name(&self, span: Span, unit: &Unit) -> Box<Diagnostic> {
        let Qualified { name, target, .. } = self;
        let message = format!("{name}:{target}: {target} is called {}", unit.name);
        let diagnostic = Diagnostic::new(Code::UnknownRoutine, span, message);
        let diagnostic = diagnostic.suggest(format!("{}:{}", unit.name, unit.id));
        Box::new(diagnostic.related(unit.span, "its header"))
    }
}
