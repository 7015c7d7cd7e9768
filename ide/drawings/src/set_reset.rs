//! Charts of SFCEdit as Structured Text for other controllers, with the kinds of their variables as
//! a person has chosen them: those of the table, and suggestions from their use.

use chart::set_reset::variables::{self, Kind, Variable};
use chart::set_reset::{Target, plan, table, write};
use chart::{Diagnostic, sfcedit};
use diagnostics::{Severity, Source};

use crate::protocol::{Converted, Problem, Variable as Told};

/// Translates a project of SFCEdit for a target; `rows` is a table of variables as a file has it.
pub fn convert(name: &str, text: String, rows: String, target: &str) -> Result<Converted, String> {
    let known = Target::ALL.into_iter().find(|(known, _)| *known == target);
    let (_, target) = known.ok_or_else(|| format!("{target}: there is no such target"))?;
    let source = |name: String, text| Source::new(name, text).map_err(|error| error.to_string());
    let (source, rows) = (source(format!("{name}.xml"), text)?, source("table".to_owned(), rows)?);
    let (rows_read, found) = variables::read(&rows);
    let mut converted =
        Converted { problems: problems(&rows, found, true), ..Converted::default() };
    let reading = sfcedit::read(&source);
    let mut found = reading.diagnostics;
    let plan = reading.project.map(|project| {
        let (plan, more) = plan(&project, &rows_read);
        found.extend(more);
        plan
    });
    found.sort_by_key(|one| one.span);
    converted.problems.extend(problems(&source, found, false));
    let Some(plan) = plan else { return Ok(converted) };
    converted.variables = plan.variables.iter().map(told).collect();
    if !converted.problems.iter().any(|problem| problem.is_error) {
        converted.program = Some(write(&plan, target, name));
        converted.equations = table(&plan);
    }
    converted.ending = target.ending();
    Ok(converted)
}

fn told(variable: &Variable) -> Told {
    let is_kind = |(_, kind): &&(&str, Kind)| *kind == variable.kind;
    Told {
        name: variable.name.clone(),
        kind: Kind::ALL.iter().find(is_kind).map_or("", |(name, _)| name),
        of_type: variable.of_type.clone(),
        value: variable.value.clone(),
    }
}

fn problems(source: &Source, found: Vec<Diagnostic>, is_of_table: bool) -> Vec<Problem> {
    let problem = |one: Diagnostic| Problem {
        line: source.position(one.span.start as usize).0 as u32,
        is_error: one.severity() == Severity::Error,
        is_of_table,
        message: one.message,
        help: one.help,
    };
    found.into_iter().map(problem).collect()
}
