//! Variables of a chart that are read and never written, or written and never read. Nothing is
//! known of those that others can reach: with an address, of the program's surroundings, given or
//! taken by a caller.

use st::tree::{SectionKind, TypeTextKind, Unit};

use super::touched::Touched;
use crate::diagnostic::{Code, Diagnostic};

/// Types of single values.
const TYPES: [&str; 12] = [
    "BOOL", "BYTE", "WORD", "DWORD", "SINT", "INT", "DINT", "USINT", "UINT", "UDINT", "REAL",
    "TIME",
];

/// Reports them, in a unit whose body is a chart.
pub(super) fn check(unit: &Unit, found: &mut Vec<Diagnostic>) {
    let mut touched = Touched::default();
    touched.statements(&unit.every_scan);
    touched.statements(&unit.body);
    let is_own = |kind: SectionKind| matches!(kind, SectionKind::Var | SectionKind::Temp);
    let own = unit.sections.iter().filter(|one| is_own(one.kind) && !one.is_constant);
    for declaration in own.flat_map(|section| &section.declarations) {
        let TypeTextKind::Named(of_type) = &declaration.of_type.kind else { continue };
        let is_single = TYPES.iter().any(|one| one.eq_ignore_ascii_case(of_type));
        if declaration.at.is_some() || !is_single {
            continue;
        }
        for name in &declaration.names {
            let key = name.text.to_uppercase();
            let is_read = touched.read.contains(&key);
            let is_written = touched.written.contains(&key);
            let (what, area) = match (is_read, is_written) {
                (true, false) if declaration.initial.is_none() => {
                    ("read, and nothing writes it", 'I')
                }
                (false, true) => ("written, and nothing reads it", 'Q'),
                _ => continue,
            };
            let text = &name.text;
            let one = Diagnostic::new(Code::Idle, name.span, format!("{text}: this is {what}"));
            found.push(one.help(format!(
                "`{text} AT %{area}0.0 : BOOL;` for an address; VAR_GLOBAL for what others see"
            )));
        }
    }
}
