//! The global variables in groups, each with its type and place.

use super::dialect::Places;
use super::st::{edge_name, is_gate, preset_name};
use crate::set_reset::plan::Plan;
use crate::set_reset::variables::{Kind, Variable};

/// A group of variables under a comment.
#[derive(Debug)]
pub(crate) struct Group {
    pub title: String,
    pub variables: Vec<Object>,
    pub is_constant: bool,
}

/// A variable of a target.
#[derive(Debug)]
pub(crate) struct Object {
    pub name: String,
    pub of_type: String,
    pub place: Option<String>,
    pub value: Option<String>,
}

impl Object {
    /// One without place and value.
    pub(crate) fn plain(name: &str, of_type: &str) -> Object {
        Object::new(name, of_type)
    }

    fn new(name: impl Into<String>, of_type: impl Into<String>) -> Object {
        Object { name: name.into(), of_type: of_type.into(), place: None, value: None }
    }
}

/// All groups that have members: the steps of each chart, then signals, edges, timers, counters,
/// inputs, outputs, memory, system, constants.
pub(super) fn groups(plan: &Plan, places: Places) -> Vec<Group> {
    let mut groups = Vec::new();
    for chart in &plan.charts {
        let steps = chart.steps.iter().map(|step| Object::new(&step.name, "BOOL")).collect();
        groups.push(group(format!("steps of {}", chart.name), steps));
    }
    groups.push(group("signals", signals(plan)));
    groups.push(group("edges", edges(plan)));
    groups.extend(of_variables(plan, places, system(plan)));
    groups.retain(|group| !group.variables.is_empty());
    groups
}

/// The variables as they are used here: without steps, edges, gates, INIT and RESET.
pub(crate) fn plain_groups(plan: &Plan) -> Vec<Group> {
    let plain = |kind| {
        let all = of_kind(plan, kind).filter(|one| !is_gate(plan, &one.name));
        all.map(|one| Object::new(&one.name, &one.of_type)).collect()
    };
    let mut groups = vec![group("signals", plain(Kind::Signal))];
    groups.extend(of_variables(plan, Places::S7200, plain(Kind::System)));
    groups.retain(|group| !group.variables.is_empty());
    groups
}

fn of_variables(plan: &Plan, places: Places, system: Vec<Object>) -> Vec<Group> {
    let mut groups = vec![
        group("timers", devices(plan, Kind::Timer)),
        group("counters", devices(plan, Kind::Counter)),
    ];
    let mut numbers = Numbers { places, ..Numbers::default() };
    for (title, kind) in
        [("inputs", Kind::Input), ("outputs", Kind::Output), ("memory", Kind::Memory)]
    {
        let place = |one: &Variable| Object {
            place: numbers.place(kind, &one.of_type),
            ..Object::new(&one.name, &one.of_type)
        };
        groups.push(group(title, of_kind(plan, kind).map(place).collect()));
    }
    groups.push(group("system", system));
    let constant = |one: &Variable| Object {
        value: one.value.clone(),
        ..Object::new(&one.name, &one.of_type)
    };
    let constants: Vec<Object> = of_kind(plan, Kind::Constant).map(constant).collect();
    let (with_value, without): (Vec<_>, Vec<_>) =
        constants.into_iter().partition(|one| one.value.is_some());
    groups.push(group("constants whose value is to be given", without));
    groups.push(Group { is_constant: true, ..group("constants", with_value) });
    groups
}

fn group(title: impl Into<String>, variables: Vec<Object>) -> Group {
    Group { title: title.into(), variables, is_constant: false }
}

fn of_kind(plan: &Plan, kind: Kind) -> impl Iterator<Item = &Variable> {
    plan.variables.iter().filter(move |one| one.kind == kind)
}

fn signals(plan: &Plan) -> Vec<Object> {
    let mut all = vec![Object::new("XInit", "BOOL"), Object::new("XReset", "BOOL")];
    for chart in &plan.charts {
        all.push(Object::new(format!("Init{}", chart.name), "BOOL"));
        all.push(Object::new(format!("Reset{}", chart.name), "BOOL"));
    }
    let others = of_kind(plan, Kind::Signal).filter(|one| !is_gate(plan, &one.name));
    all.extend(others.map(|one| Object::new(&one.name, &one.of_type)));
    all
}

fn edges(plan: &Plan) -> Vec<Object> {
    let edge = |(variable, rising): &(String, bool)| {
        let block = if *rising { "R_TRIG" } else { "F_TRIG" };
        Object::new(edge_name(variable, *rising), block)
    };
    plan.edges.iter().map(edge).collect()
}

fn devices(plan: &Plan, kind: Kind) -> Vec<Object> {
    let (all, preset) = match kind {
        Kind::Timer => (&plan.timers, "TIME"),
        _ => (&plan.counters, "INT"),
    };
    // Those that only conditions name are there, too: nothing ever starts them.
    let idle = of_kind(plan, kind).filter(|one| all.iter().all(|other| other.name != one.name));
    let mut objects: Vec<Object> = idle.map(|one| Object::new(&one.name, &one.of_type)).collect();
    for device in all {
        objects.push(Object::new(&device.name, &device.block));
        if device.presets.len() > 1 {
            let value = device.presets.first().map(|(value, _)| value.clone());
            objects.push(Object { value, ..Object::new(preset_name(device), preset) });
        }
    }
    objects
}

/// INIT and RESET are everybody's, unless the table has them as something else.
fn system(plan: &Plan) -> Vec<Object> {
    let is_known =
        |name: &str| plan.variables.iter().any(|one| one.name.eq_ignore_ascii_case(name));
    let ours = ["INIT", "RESET"].into_iter().filter(|name| !is_known(name));
    let ours = ours.map(|name| Object::new(name, "BOOL"));
    ours.chain(of_kind(plan, Kind::System).map(|one| Object::new(&one.name, &one.of_type)))
        .collect()
}

/// Gives places one after the other.
#[derive(Debug, Default)]
struct Numbers {
    places: Places,
    inputs: usize,
    outputs: usize,
    analog_inputs: usize,
    analog_outputs: usize,
}

impl Numbers {
    fn place(&mut self, kind: Kind, of_type: &str) -> Option<String> {
        let letter = match kind {
            Kind::Input => 'I',
            Kind::Output => 'Q',
            _ => 'M',
        };
        if self.places == Places::Open {
            return Some(format!("%{letter}*"));
        }
        let (count, is_bit) = match (kind, of_type) {
            (Kind::Input, "BOOL") => (&mut self.inputs, true),
            (Kind::Output, "BOOL") => (&mut self.outputs, true),
            (Kind::Input, "INT" | "WORD") => (&mut self.analog_inputs, false),
            (Kind::Output, "INT" | "WORD") => (&mut self.analog_outputs, false),
            _ => return None,
        };
        let at = *count;
        *count += 1;
        Some(match is_bit {
            true => format!("%{letter}{}.{}", at / 8, at % 8),
            false => format!("%A{letter}W{}", at * 2),
        })
    }
}
