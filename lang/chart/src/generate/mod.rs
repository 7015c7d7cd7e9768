//! From charts to Structured Text, as a syntax tree: what a chart means, docs/charts.md says; how
//! its code looks follows from there. Names and types are checked by [`st`], which also writes the
//! AWL.

mod actions;
mod alternatives;
mod asking;
mod build;
mod circles;
mod coarse;
mod declare;
mod evolution;
mod grafcet;
mod idle;
mod mentions;
mod names;
mod parsed;
mod samples;
mod sound;
mod touched;

use std::collections::{BTreeSet, HashSet};

use diagnostics::Source;
use st::tree::{File, Name, Statement, Unit, UnitKind};
use st::visit;

use crate::check;
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{Body, Chart, Origin, Standard};
use crate::text::{self, Reading, Region};
pub use declare::globals as declared;
pub(crate) use sound::wrong_qualifier;

use actions::Actions;
use evolution::Evolution;
use mentions::{Length, Scope, Times};
use names::{Variables, step_name, stored_name};
use parsed::Parsed;

/// A text with charts as Structured Text.
#[derive(Debug)]
pub struct Translation {
    /// The syntax tree. Places in it are those of the text.
    pub file: File,
    /// What is wrong with the charts.
    pub diagnostics: Vec<Diagnostic>,
    /// What is wrong with the Structured Text in them and around them.
    pub of_st: Vec<st::Diagnostic>,
}

/// Translates a text. `known`, in upper case, are the names that other texts of the program declare
/// for all; what this one declares by use is added.
pub fn translate(source: &Source, known: &mut HashSet<String>) -> Translation {
    let reading = text::read(source);
    let (mut file, mut of_st) = around(source, &reading.regions);
    let mut diagnostics = reading.diagnostics;
    known.extend(declare::globals(&file));
    let (mut has_bare, mut warnings) = (false, Vec::new());
    for (chart, region) in reading.document.charts().zip(&reading.regions) {
        let before = diagnostics.len();
        sound::check(chart, region.first(), &mut diagnostics);
        let is_sound = diagnostics.len() == before;
        let mut parsed = Parsed::of(&source.text, chart, &mut of_st);
        if !region.has_head {
            file.globals.extend(declare::by_use(&mut parsed, known));
            if has_bare {
                let message = "a second chart without a head in this file";
                let found = Diagnostic::new(Code::Unit, region.first(), message);
                diagnostics.push(found.help("PROGRAM and a name before it, END_PROGRAM after it"));
                continue;
            }
            has_bare = true;
        }
        let Some(unit) = unit_of(&mut file, chart, region, &mut diagnostics) else { continue };
        if !is_sound {
            continue;
        }
        if diagnostics.is_empty() {
            check::check(chart, &mut warnings);
            alternatives::check(&source.text, &parsed, &mut warnings);
            circles::check(&source.text, &parsed, &mut warnings);
        }
        let mut variables = Variables::default();
        unit.body = unit_body(parsed, &mut variables, &mut diagnostics, &mut of_st);
        variables.check(&mut diagnostics);
        if diagnostics.is_empty() && of_st.is_empty() {
            idle::check(unit, &mut warnings);
        }
        unit.sections.push(variables.section());
    }
    diagnostics.extend(warnings);
    diagnostics.sort_by_key(|one| one.span);
    diagnostics.dedup_by(|a, b| a.span == b.span && a.message == b.message);
    Translation { file, diagnostics, of_st }
}

/// What is around the charts of a text, as a syntax tree, with the variables that charts without a
/// head declare by use; `known` is as in [`translate`]. Such a chart has no unit in it.
pub fn frame(source: &Source, reading: &Reading, known: &mut HashSet<String>) -> File {
    let (mut file, _) = around(source, &reading.regions);
    known.extend(declare::globals(&file));
    let charts = reading.document.charts().zip(&reading.regions);
    for (chart, _) in charts.filter(|(_, region)| !region.has_head) {
        let mut parsed = Parsed::of(&source.text, chart, &mut Vec::new());
        file.globals.extend(declare::by_use(&mut parsed, known));
    }
    file
}

/// What is around the charts, as Structured Text.
fn around(source: &Source, regions: &[Region]) -> (File, Vec<st::Diagnostic>) {
    let mut masked = source.text.clone().into_bytes();
    for region in regions {
        let range = region.span.start as usize..region.span.end as usize;
        masked.get_mut(range).into_iter().flatten().for_each(|byte| *byte = b' ');
    }
    let masked = String::from_utf8(masked).unwrap_or_default();
    let Ok(masked) = Source::new(source.name.clone(), masked) else {
        return (File::default(), Vec::new());
    };
    let (mut file, of_st) = st::parser::parse(&masked);
    file.settings = st::lexer::cut(&source.text).settings;
    (file, of_st)
}

/// The unit that a chart is the body of; a new one for a chart without a head.
fn unit_of<'f>(
    file: &'f mut File,
    chart: &Chart,
    region: &Region,
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<&'f mut Unit> {
    if !region.has_head {
        file.units.push(Unit {
            kind: UnitKind::Program,
            name: Name { text: chart.name.clone(), span: region.first() },
            span: region.span,
            sections: Vec::new(),
            every_scan: Vec::new(),
            body: Vec::new(),
        });
        return file.units.last_mut();
    }
    let unit = file.units.iter_mut().rfind(|unit| unit.name.span.start < region.span.start)?;
    let what = match unit.kind {
        UnitKind::Function(_) => "a FUNCTION keeps nothing from call to call: it is no chart",
        _ if !unit.body.is_empty() => "a unit is a chart or statements, not both",
        _ => return Some(unit),
    };
    let help = "statements of a chart are in its actions";
    diagnostics.push(Diagnostic::new(Code::Unit, region.first(), what).help(help));
    None
}

fn unit_body(
    mut parsed: Parsed,
    variables: &mut Variables,
    diagnostics: &mut Vec<Diagnostic>,
    of_st: &mut Vec<st::Diagnostic>,
) -> Vec<Statement> {
    if parsed.chart.standard == Standard::Grafcet {
        coarse::refuse_all(&parsed, coarse::OF_GRAFCET, of_st);
        return grafcet::body(parsed, variables, diagnostics);
    }
    let scope = Scope::new(&parsed, None, String::new());
    let mut times = Times::new();
    note_all(&mut parsed, &scope, &mut times);
    coarse::choose(&mut parsed, &scope, &mut times, of_st);
    chart_body(&parsed, &scope, &times, variables, diagnostics)
}

/// Code of a chart, with its steps as variables.
fn code(
    mut body: Vec<Statement>,
    scope: &Scope,
    times: &Times,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<Statement> {
    mentions::check_body(&mut body, scope, diagnostics);
    visit::statements(&mut body, &mut |statement| {
        visit::in_statement(statement, &mut |one| {
            mentions::rewrite(one, scope, times, &mut |_, _| "");
            false
        });
    });
    body
}

/// The times that the code of a chart and of those in it asks for.
fn note_all(parsed: &mut Parsed, scope: &Scope, times: &mut Times) {
    mentions::note_times(parsed, scope, times);
    for (id, inner) in &mut parsed.charts {
        let name = parsed.chart.actions.get(id).map_or("", |action| action.name.as_str());
        let prefix = format!("{}{name}.", scope.prefix);
        let scope = Scope::new(inner, Some(scope), prefix);
        note_all(inner, &scope, times);
    }
}

/// What a chart does in a scan.
fn chart_body(
    parsed: &Parsed,
    scope: &Scope,
    times: &Times,
    variables: &mut Variables,
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<Statement> {
    let chart = parsed.chart;
    for (id, step) in &chart.steps {
        variables.add_once(&step_name(chart, scope, *id), "BOOL", step.origin.0);
    }
    let mut statements = time_goes_on(parsed, scope, times, variables);
    statements.extend(Evolution { parsed, scope, times, variables }.statements());
    let mut watched = BTreeSet::new();
    for (id, action) in &chart.actions {
        let body = match &action.body {
            Body::Variable => Vec::new(),
            Body::Code(_) => {
                let body = parsed.bodies.get(id).cloned().unwrap_or_default();
                code(body, scope, times, diagnostics)
            }
            Body::Chart(_) => match parsed.charts.get(id) {
                Some(inner) => {
                    let prefix = format!("{}{}.", scope.prefix, action.name);
                    let inner_scope = Scope::new(inner, Some(scope), prefix);
                    chart_body(inner, &inner_scope, times, variables, diagnostics)
                }
                None => Vec::new(),
            },
        };
        let mut actions = Actions { parsed, scope, times, variables, watched };
        statements.extend(actions.action(*id, action, body));
        watched = actions.watched;
    }
    statements.extend(Actions { parsed, scope, times, variables, watched }.ends());
    statements
}

/// At the start of the scan: times of active steps and of stored actions.
fn time_goes_on(
    parsed: &Parsed,
    scope: &Scope,
    times: &Times,
    variables: &mut Variables,
) -> Vec<Statement> {
    let chart = parsed.chart;
    let mut statements = Vec::new();
    let mut owners: Vec<(String, String, String, Option<Origin>)> = Vec::new();
    for (id, step) in &chart.steps {
        let name = step_name(chart, scope, *id);
        owners.push((name.clone(), name.clone(), format!("Time of step {name}"), step.coarse));
        for instance in step.block.iter().filter(|one| one.qualifier.has_time()) {
            let flag = stored_name(chart, scope, &step.name, instance);
            owners.push((flag.clone(), name.clone(), format!("Time since {flag}"), None));
        }
    }
    for (owner, place, title, pragma) in owners {
        let Some(length) = times.get(&owner) else { continue };
        statements.push(build::element(&place, title));
        if let (Length::Timer(ms), Some(Origin(span))) = (*length, pragma) {
            variables.add_coarse(&coarse::timer(&owner), length.type_name(), span);
            statements.push(coarse::call(&owner, ms));
            continue;
        }
        let time = format!("{owner}.T");
        variables.add(&time, length.type_name());
        let goes_on = vec![build::add_elapsed(&time)];
        statements.push(build::when(build::variable(&owner), goes_on));
    }
    statements
}
