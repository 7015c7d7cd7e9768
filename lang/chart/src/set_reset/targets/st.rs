//! Blocks, MAIN and global variables as Structured Text.

use super::dialect::{Dialect, Instances};
use super::objects::{Group, groups};
use crate::set_reset::plan::{Cause, ChartPlan, Device, Plan, StepPlan};
use crate::sfcedit::condition::{Condition, Edges};

/// The whole text.
pub(super) fn write(plan: &Plan, dialect: &Dialect) -> String {
    let mut text = String::new();
    for chart in &plan.charts {
        text.push_str(&format!(
            "FUNCTION_BLOCK G{}\nVAR_INPUT\n    Init : BOOL;\n    Reset : BOOL;\nEND_VAR\n{}\
             END_FUNCTION_BLOCK\n\n",
            chart.name,
            block_body(chart, dialect)
        ));
    }
    text.push_str("PROGRAM MAIN\nVAR\n");
    for chart in &plan.charts {
        text.push_str(&format!("    {0} : G{0};\n", chart.name));
    }
    text.push_str("END_VAR\n");
    text.push_str(&main_body(plan, dialect));
    text.push_str("END_PROGRAM\n\n");
    text.push_str(&globals(plan, dialect));
    text
}

/// The equations of a chart's steps.
pub(super) fn block_body(chart: &ChartPlan, dialect: &Dialect) -> String {
    let mut text = String::new();
    for step in &chart.steps {
        let name = &step.name;
        text.push_str(&format!("(* Set -Reset {name} *)\n"));
        text.push_str(&format!(
            "IF ({}) THEN {name}:={}; END_IF; IF ( {} ) THEN {name}:={}; END_IF;\n",
            set(step, &Instances, "Init"),
            dialect.on,
            reset(step, "Init", "Reset"),
            dialect.off
        ));
    }
    text
}

/// When a step is set.
pub(super) fn set(step: &StepPlan, edges: &dyn Edges, init: &str) -> String {
    let term = |(steps, condition): &(Vec<String>, Condition)| {
        let steps = steps.iter().cloned().map(Condition::Variable);
        let condition = match condition {
            Condition::And(all) => all.clone(),
            one => vec![one.clone()],
        };
        Condition::And(steps.chain(condition).collect())
    };
    let mut terms: Vec<Condition> = step.set.iter().map(term).collect();
    if step.is_initial {
        terms.push(Condition::Variable(init.to_owned()));
    }
    any(terms).st(edges)
}

/// When a step is reset.
pub(super) fn reset(step: &StepPlan, init: &str, reset: &str) -> String {
    let term = |steps: &Vec<String>| all(steps.iter().cloned().map(Condition::Variable).collect());
    let mut terms: Vec<Condition> = step.reset.iter().map(term).collect();
    if !step.is_initial {
        terms.push(Condition::Variable(init.to_owned()));
    }
    terms.push(Condition::Variable(reset.to_owned()));
    // No edge is in it.
    any(terms).st(&Instances)
}

/// One of them at least.
pub(super) fn any(mut terms: Vec<Condition>) -> Condition {
    match terms.len() {
        0 => Condition::Constant(false),
        1 => terms.swap_remove(0),
        _ => Condition::Or(terms),
    }
}

fn all(mut terms: Vec<Condition>) -> Condition {
    match terms.len() {
        1 => terms.swap_remove(0),
        _ => Condition::And(terms),
    }
}

/// The reasons for something as one condition.
pub(super) fn causes(causes: &[Cause]) -> Condition {
    any(causes.iter().map(Cause::all).collect())
}

fn heading(text: &mut String, words: &str) {
    text.push_str(&format!("\n(* {words} *)\n"));
}

/// What MAIN does, in this order: edges, derived signals, charts, outputs, values, timers,
/// counters.
pub(super) fn main_body(plan: &Plan, dialect: &Dialect) -> String {
    let first_scan = dialect.first_scan.map_or(String::new(), |bit| format!(" OR {bit}"));
    let mut text = format!("XInit:=INIT{first_scan}; XReset:=RESET;\n");
    if !plan.edges.is_empty() {
        heading(&mut text, "edges");
    }
    for (variable, rising) in &plan.edges {
        let name = edge_name(variable, *rising);
        text.push_str(&format!("{name}(CLK:={variable}{}\n", dialect.edge_end));
    }
    if !plan.derived.is_empty() {
        heading(&mut text, "derived signals");
    }
    for (name, condition) in &plan.derived {
        text.push_str(&format!("{name}:={};\n", condition.st(&Instances)));
    }
    heading(&mut text, "charts");
    for chart in &plan.charts {
        text.push_str(&gates(plan, chart, &Instances));
        text.push_str(&format!("{0}(Init:=Init{0}, Reset:=Reset{0});\n", chart.name));
    }
    outputs(plan, &mut text, &Instances);
    values(plan, &mut text, &Instances);
    if !plan.timers.is_empty() {
        heading(&mut text, "timers");
    }
    for timer in &plan.timers {
        let start = causes(&timer.starts).st(&Instances);
        text.push_str(&presets(timer));
        text.push_str(&format!("{}(IN:={start}, PT:={});\n", timer.name, preset(timer)));
    }
    if !plan.counters.is_empty() {
        heading(&mut text, "counters");
    }
    for counter in &plan.counters {
        text.push_str(&presets(counter));
        text.push_str(&count(counter, dialect));
    }
    text
}

/// The gate variables of a chart, with the steps of other charts that switch them on.
pub(super) fn gates(plan: &Plan, chart: &ChartPlan, edges: &dyn Edges) -> String {
    let gate = |word: &str| {
        let name = format!("{word}{}", chart.name);
        let mut terms = vec![Condition::Variable(format!("X{word}"))];
        let known = plan.outputs.iter().find(|(output, _)| output.eq_ignore_ascii_case(&name));
        terms.extend(known.iter().flat_map(|(_, causes)| causes).map(Cause::all));
        format!("{name}:={};", any(terms).st(edges))
    };
    format!("{} {}\n", gate("Init"), gate("Reset"))
}

/// Whether it is a gate variable, which is written where its chart is called.
pub(super) fn is_gate(plan: &Plan, name: &str) -> bool {
    let gates = |chart: &ChartPlan| [format!("Init{}", chart.name), format!("Reset{}", chart.name)];
    plan.charts.iter().flat_map(gates).any(|gate| gate.eq_ignore_ascii_case(name))
}

/// Exactly one assignment for every output and control signal.
pub(super) fn outputs(plan: &Plan, text: &mut String, edges: &dyn Edges) {
    let all = || plan.outputs.iter().filter(|(name, _)| !is_gate(plan, name));
    if all().next().is_some() {
        heading(text, "outputs and control signals");
    }
    for (name, reasons) in all() {
        text.push_str(&format!("{name}:= {};\n", causes(reasons).st(edges)));
    }
}

/// Values that steps give.
pub(super) fn values(plan: &Plan, text: &mut String, edges: &dyn Edges) {
    if !plan.assignments.is_empty() {
        heading(text, "set, reset and values");
    }
    for one in &plan.assignments {
        let reason = causes(&one.causes).st(edges);
        text.push_str(&format!("IF ({reason}) THEN {}:={}; END_IF;\n", one.variable, one.value));
    }
}

/// The instance that finds an edge.
pub(super) fn edge_name(variable: &str, rising: bool) -> String {
    format!("{}{variable}", if rising { "RE" } else { "FE" })
}

/// The variable of a preset that changes.
pub(crate) fn preset_name(device: &Device) -> String {
    format!("{}_PV", device.name)
}

/// The preset of a timer or counter: a value, or the variable of the one that changes.
pub(crate) fn preset(device: &Device) -> String {
    match &device.presets[..] {
        [(value, _)] => value.clone(),
        _ => preset_name(device),
    }
}

fn presets(device: &Device) -> String {
    if device.presets.len() < 2 {
        return String::new();
    }
    let one = |(value, reasons): &(String, Vec<Cause>)| {
        let reason = causes(reasons).st(&Instances);
        format!("IF ({reason}) THEN {}:={value}; END_IF;\n", preset_name(device))
    };
    device.presets.iter().map(one).collect()
}

/// The call of a counter.
fn count(counter: &Device, dialect: &Dialect) -> String {
    let (counts, resets) = (causes(&counter.starts), causes(&counter.resets));
    let (counts, resets) = (counts.st(&Instances), resets.st(&Instances));
    let (name, preset) = (&counter.name, preset(counter));
    match counter.block.as_str() {
        "CTD" => format!("{name}(CD:={counts}, {}:={resets}, PV:={preset});\n", dialect.load),
        _ => format!("{name}(CU:={counts}, {}:={resets}, PV:={preset});\n", dialect.reset),
    }
}

fn globals(plan: &Plan, dialect: &Dialect) -> String {
    declared(groups(plan, dialect.places))
}

/// Global variables in their groups.
pub(crate) fn declared(groups: Vec<Group>) -> String {
    let (mut variables, mut constants) = (String::new(), String::new());
    for Group { title, variables: members, is_constant } in groups {
        let text = if is_constant { &mut constants } else { &mut variables };
        text.push_str(&format!("    (* {title} *)\n"));
        for one in members {
            let place = one.place.map_or(String::new(), |place| format!(" AT {place}"));
            let value = one.value.map_or(String::new(), |value| format!(" := {value}"));
            text.push_str(&format!("    {}{place} : {}{value};\n", one.name, one.of_type));
        }
    }
    let mut text = format!("VAR_GLOBAL\n{variables}END_VAR\n");
    if !constants.is_empty() {
        text.push_str(&format!("VAR_GLOBAL CONSTANT\n{constants}END_VAR\n"));
    }
    text
}
