//! Timers and counters: function blocks that a second program calls once a scan. Continuous actions
//! of the chart say what starts, counts and resets them.

use super::actions::add;
use super::charts::Writer;
use crate::model::{Action, ActionId, Body, Chart, Code, Instance, Origin, Qualifier, StepId};
use crate::set_reset::plan::{Cause, Device};
use crate::set_reset::targets::{preset, preset_name};
use crate::sfcedit::condition::Condition;

impl Writer<'_, '_> {
    /// The calls of all of them.
    pub(super) fn devices(&mut self, program: &mut Chart) -> String {
        let plan = self.plan;
        let timers = plan.timers.iter().map(|one| self.timer(program, one)).collect::<String>();
        timers + &plan.counters.iter().map(|one| self.counter(program, one)).collect::<String>()
    }

    fn timer(&mut self, program: &mut Chart, timer: &Device) -> String {
        let name = self.names.variable(&timer.name);
        let starts = self.signal(program, &format!("{}_on", timer.name), &timer.starts);
        let preset = self.preset(program, timer);
        format!("    {name}(IN := {starts}, PT := {preset});\n")
    }

    fn counter(&mut self, program: &mut Chart, counter: &Device) -> String {
        let name = self.names.variable(&counter.name);
        let counts = self.signal(program, &format!("{}_counts", counter.name), &counter.starts);
        let resets = self.signal(program, &format!("{}_resets", counter.name), &counter.resets);
        let preset = self.preset(program, counter);
        let (counts_by, resets_by) = match counter.block.as_str() {
            "CTD" => ("CD", "LD"),
            _ => ("CU", "R"),
        };
        format!("    {name}({counts_by} := {counts}, {resets_by} := {resets}, PV := {preset});\n")
    }

    /// The variable that the steps of causes switch on; FALSE, where there are none.
    fn signal(&mut self, program: &mut Chart, wanted: &str, causes: &[Cause]) -> String {
        if causes.is_empty() {
            return "FALSE".to_owned();
        }
        let name = self.names.add_bool(wanted);
        for cause in causes {
            let condition = self.coded_cause(cause);
            let Some((chart, step)) = step_of(program, cause) else { continue };
            let id = chart.action_named(&name).unwrap_or_else(|| {
                chart.add_action(Action::variable(name.clone(), Origin::default()))
            });
            add(chart, step, Instance { condition, ..Instance::new(id) });
        }
        name
    }

    fn coded_cause(&self, cause: &Cause) -> Option<Code> {
        cause.condition.as_ref().map(|one| Code::new(self.names.written(one)))
    }

    /// A preset that changes is a variable, which steps write.
    fn preset(&mut self, program: &mut Chart, device: &Device) -> String {
        if device.presets.len() < 2 {
            return self.names.value(&preset(device));
        }
        let name = self.names.variable(&device.name);
        let variable = preset_name(&Device { name, ..Device::default() });
        for (value, causes) in &device.presets {
            for cause in causes {
                let condition = self.coded_cause(cause);
                let text = format!("{variable} := {};", self.names.value(value));
                let wanted =
                    step_name(cause).map_or(String::new(), |step| format!("{step}_{variable}"));
                let Some((chart, step)) = step_of(program, cause) else { continue };
                let plain = Instance { qualifier: Qualifier::P1, ..Instance::new(ActionId(0)) };
                let later = condition
                    .clone()
                    .map(|_| Instance { event: condition.clone(), ..plain.clone() });
                for instance in std::iter::once(Instance { condition, ..plain }).chain(later) {
                    let (name, comment) = (self.names.fresh(&wanted), String::new());
                    let (body, origin) = (Body::Code(Code::new(&text)), Origin::default());
                    let action = chart.add_action(Action { name, body, comment, origin });
                    add(chart, step, Instance { action, ..instance });
                }
            }
        }
        variable
    }
}

fn step_name(cause: &Cause) -> Option<&str> {
    match &cause.step {
        Condition::Variable(name) | Condition::Rising(name) | Condition::Falling(name) => {
            Some(name)
        }
        _ => None,
    }
}

/// The step of a cause, and the chart in which it is.
fn step_of<'c>(program: &'c mut Chart, cause: &Cause) -> Option<(&'c mut Chart, StepId)> {
    let name = step_name(cause)?;
    if let Some(step) = program.step_named(name) {
        return Some((program, step));
    }
    program.actions.values_mut().find_map(|action| match &mut action.body {
        Body::Chart(inner) => inner.step_named(name).map(|step| (&mut **inner, step)),
        Body::Variable | Body::Code(_) => None,
    })
}
