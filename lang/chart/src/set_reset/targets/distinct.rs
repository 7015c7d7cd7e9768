//! A plan without names that differ in letter case alone, or that are words of the language: the
//! later one gets `_` after it.

use std::collections::{HashMap, HashSet};

use crate::set_reset::plan::{Cause, Device, Plan};
use crate::sfcedit::condition::Condition;
use crate::text;
use st::keywords::KEYWORDS;

/// The plan with names that are different in ST.
pub(crate) fn distinct(plan: &Plan) -> Plan {
    let names = new_names(plan);
    let mut plan = plan.clone();
    if names.is_empty() {
        return plan;
    }
    let rename = |name: &mut String| {
        if let Some(new) = names.get(name) {
            new.clone_into(name);
        }
    };
    for (_, condition) in
        plan.charts.iter_mut().flat_map(|chart| &mut chart.steps).flat_map(|step| &mut step.set)
    {
        within(condition, &rename);
    }
    plan.edges.iter_mut().for_each(|(name, _)| rename(name));
    for (name, condition) in &mut plan.derived {
        rename(name);
        within(condition, &rename);
    }
    for (name, causes) in &mut plan.outputs {
        rename(name);
        causes_within(causes, &rename);
    }
    for one in &mut plan.assignments {
        rename(&mut one.variable);
        causes_within(&mut one.causes, &rename);
    }
    for device in plan.timers.iter_mut().chain(&mut plan.counters) {
        device_within(device, &rename);
    }
    plan.variables.iter_mut().for_each(|one| rename(&mut one.name));
    plan
}

/// The names that variables get in the place of theirs, which something else has.
pub(crate) fn new_names(plan: &Plan) -> HashMap<String, String> {
    let steps = plan.charts.iter().flat_map(|chart| &chart.steps).map(|step| &step.name);
    let charts = plan.charts.iter().map(|chart| &chart.name);
    let mut taken: HashSet<String> = steps.chain(charts).map(|name| name.to_uppercase()).collect();
    taken.extend(KEYWORDS.iter().chain(&text::KEYWORDS).map(|word| (*word).to_owned()));
    let mut names = HashMap::new();
    for one in &plan.variables {
        let mut name = one.name.clone();
        while !taken.insert(name.to_uppercase()) {
            name.push('_');
        }
        if name != one.name {
            names.insert(one.name.clone(), name);
        }
    }
    names
}

fn within(condition: &mut Condition, rename: &dyn Fn(&mut String)) {
    match condition {
        Condition::Constant(_) => {}
        Condition::Variable(name) | Condition::Rising(name) | Condition::Falling(name) => {
            rename(name);
        }
        Condition::Not(one) | Condition::Time(_, one, _) => within(one, rename),
        Condition::And(all) | Condition::Or(all) => {
            all.iter_mut().for_each(|one| within(one, rename));
        }
        Condition::Comparison(left, _, right) => {
            rename(left);
            rename(right);
        }
    }
}

fn causes_within(causes: &mut [Cause], rename: &dyn Fn(&mut String)) {
    for cause in causes {
        within(&mut cause.step, rename);
        cause.condition.iter_mut().for_each(|one| within(one, rename));
    }
}

fn device_within(device: &mut Device, rename: &dyn Fn(&mut String)) {
    rename(&mut device.name);
    causes_within(&mut device.starts, rename);
    causes_within(&mut device.resets, rename);
    for (_, causes) in &mut device.presets {
        causes_within(causes, rename);
    }
}
