//! Local variables: their declarations in VAR sections, and their places in the local memory of
//! their unit. Where that memory itself lies is said elsewhere.

use plc_isa::Area;

use crate::diagnostic::{Code, Diagnostic};
use crate::text::address::Address;
use crate::text::ast::{Name, Named, Section, Span, Type, Unit, UnitKind, Variable};
use crate::text::suggest::Suggester;

/// Parameters of a subroutine at most (docs/s7-200.md 1.8).
pub const PARAMETERS_MAX: usize = 16;

/// Reads a declaration such as `Speed:INT` of a unit; `span` is where it is.
pub(crate) fn declare(
    unit: &mut Unit,
    section: Section,
    text: &str,
    span: Span,
    suggester: &Suggester,
) -> Result<(), Box<Diagnostic>> {
    let error = |message: String| Box::new(Diagnostic::new(Code::Declaration, span, message));
    let Some((name, kind)) = text.split_once(':') else {
        return Err(without_colon(unit, section, text, span));
    };
    let (name, kind_text) = (name.trim().trim_matches('"'), kind.trim());
    let kind = read_type(kind_text);
    if let Some(why) = wrong_name(name) {
        return Err(error(format!("{name}: {why}")));
    }
    if let Some(first) = unit.variables.iter().find(|variable| is_same_name(&variable.name, name)) {
        let diagnostic = error(format!("{name}: the unit has a variable of this name already"));
        return Err(diagnostic.related(first.span, "the first one").into());
    }
    if section != Section::Temp && unit.id.kind != UnitKind::Subroutine {
        let message = format!("{name}: only a subroutine has parameters");
        return Err(error(message).help("declare it between VAR and END_VAR").into());
    }
    let name_len = text.split(':').next().unwrap_or(text).trim_end().len();
    let name_span = Span::new(span.start as usize, span.start as usize + name_len);
    // Micro/WIN's ladder has an input EN for power flow; in STL that is the top of the logic stack.
    let is_first = !unit.variables.iter().any(|variable| variable.section == Section::In);
    if section == Section::In
        && kind == Ok(Type::Bool)
        && name.eq_ignore_ascii_case("EN")
        && is_first
    {
        return Ok(());
    }
    let address = Address::Byte { area: Area::L, byte: 0 };
    // A variable of a wrong type is kept, so that its uses are not called unknown.
    let near = near_type(kind_text, suggester);
    unit.variables.push(Variable {
        name: name.to_owned(),
        section,
        kind: kind.clone().unwrap_or(near.map_or(Type::Int, |(_, kind)| kind)),
        address,
        comment: String::new(),
        span: name_span,
    });
    if let Err(why) = kind {
        let mut diagnostic = error(why);
        diagnostic.suggestion = near.map(|(near, _)| text.replacen(kind_text, near, 1));
        return Err(diagnostic);
    }
    let parameters =
        unit.variables.iter().filter(|variable| variable.section != Section::Temp).count();
    if section != Section::Temp && parameters == PARAMETERS_MAX + 1 {
        return Err(error(format!("{name}: a subroutine has at most {PARAMETERS_MAX} parameters")));
    }
    Ok(())
}

/// `Speed INT`: name and type without the colon between them. The name is kept.
fn without_colon(unit: &mut Unit, section: Section, text: &str, span: Span) -> Box<Diagnostic> {
    let message = format!("{text}: a declaration has a name, a colon and a type");
    let diagnostic = Diagnostic::new(Code::Declaration, span, message);
    let words: Vec<&str> = text.split_whitespace().collect();
    let (name, kind) = match words.as_slice() {
        [one, other] => match (read_type(one), read_type(other)) {
            (_, Ok(kind)) => (*one, kind),
            (Ok(kind), _) => (*other, kind),
            _ => return diagnostic.help("such as `Speed : INT;`").into(),
        },
        [name] => (*name, Type::Int),
        _ => return diagnostic.help("such as `Speed : INT;`").into(),
    };
    let is_known = unit.variables.iter().any(|variable| is_same_name(&variable.name, name));
    if wrong_name(name).is_some() || is_known {
        return diagnostic.help("such as `Speed : INT;`").into();
    }
    let address = Address::Byte { area: Area::L, byte: 0 };
    let (comment, name) = (String::new(), name.to_owned());
    let meant = format!("{name} : {}", kind.name());
    unit.variables.push(Variable { name, section, kind, address, comment, span });
    diagnostic.suggest(meant).into()
}

/// The type that was probably meant.
fn near_type(text: &str, suggester: &Suggester) -> Option<(&'static str, Type)> {
    let upper = text.to_ascii_uppercase();
    let named = |wanted: &str| Type::NAMES.into_iter().find(|&(name, _)| name == wanted);
    let longer = Type::NAMES.into_iter().find(|(name, _)| upper.starts_with(name));
    longer
        .or_else(|| named(suggester.nearest(text, Type::NAMES.into_iter().map(|(name, _)| name))?))
}

fn read_type(text: &str) -> Result<Type, String> {
    let found = Type::NAMES.into_iter().find(|(name, _)| name.eq_ignore_ascii_case(text));
    found.map(|(_, kind)| kind).ok_or_else(|| match text.split_once([':', '=']) {
        Some(_) => format!("{text}: a local variable has no initial value"),
        None if text.is_empty() => "the type is missing".to_owned(),
        None => {
            let names = Type::NAMES.map(|(name, _)| name).join(", ");
            format!("{text}: no such type; there are {names}")
        }
    })
}

/// Why a local variable, or a routine, cannot have this name; `None` if it can.
pub fn wrong_name(name: &str) -> Option<&'static str> {
    if name.is_empty() {
        return Some("the name of the variable is missing");
    }
    if !name.starts_with(|c: char| c.is_alphabetic() || c == '_')
        || name.contains([',', '"', '#', '\''])
    {
        return Some("a name begins with a letter and has letters, digits and _");
    }
    if Address::parse(name).is_ok_and(|address| !address.is_german(name)) {
        return Some("a variable cannot be named like an address");
    }
    None
}

/// Whether two names are the same, letter case aside.
pub(crate) fn is_same_name(a: &str, b: &str) -> bool {
    // Names are compared with each other by the thousand: most are plain.
    let is_plain = a.is_ascii() && b.is_ascii();
    a.eq_ignore_ascii_case(b) || !is_plain && a.to_lowercase() == b.to_lowercase()
}

/// Where the variables of a unit are declared, which is this statement of the program.
pub(crate) fn names(statement: usize, unit: &Unit) -> impl Iterator<Item = Name> {
    (0..).zip(&unit.variables).map(move |(index, variable)| Name {
        span: variable.span,
        of: Named::Local(statement as u32, index),
        declares: true,
    })
}

/// Gives the variables their places: parameters first, IN, IN_OUT, OUT, then TEMP. Up to eight BOOL
/// in a row share a byte, everything else begins with a byte of its own (docs/s7-200.md 1.8).
/// Reports what goes beyond LB63.
pub(crate) fn lay_out(unit: &mut Unit, diagnostics: &mut Vec<Diagnostic>) {
    unit.variables.sort_by_key(|variable| variable.section);
    let mut next_byte: u16 = 0;
    // Bits in use of the byte before, when that holds bits.
    let mut bits: u8 = 8;
    let mut is_reported = false;
    for variable in &mut unit.variables {
        let area = Area::L;
        if variable.kind == Type::Bool {
            if bits == 8 {
                (next_byte, bits) = (next_byte + 1, 0);
            }
            variable.address = Address::Bit { area, byte: next_byte - 1, bit: bits };
            bits += 1;
        } else {
            let byte = next_byte;
            variable.address = match variable.kind.bytes() {
                1 => Address::Byte { area, byte },
                2 => Address::Word { area, byte },
                _ => Address::Double { area, byte },
            };
            next_byte += u16::from(variable.kind.bytes());
            bits = 8;
        }
        if next_byte > Area::L.size() && !is_reported {
            let message =
                format!("{}: the unit's local memory is full, it has LB0 to LB63", variable.name);
            diagnostics.push(Diagnostic::new(Code::LocalMemory, variable.span, message));
            is_reported = true;
        }
    }
}
