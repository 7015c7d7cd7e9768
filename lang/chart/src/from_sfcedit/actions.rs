//! Actions of steps as instances: continuous ones write a variable, stored ones set or reset it, or
//! are statements. Those of timers and counters are the business of [`super::devices`].

use diagnostics::Span;

use super::charts::{EDGE, Writer};
use super::orders::{gate, order};
use crate::diagnostic::{Code as ErrorCode, Diagnostic};
use crate::model::{
    Action, ActionId, Body, Chart, Code, Instance, Origin, Qualifier, StepId, is_same_name,
};
use crate::set_reset::action_text::{Does, does, words};
use crate::sfcedit::condition::Condition;
use crate::sfcedit::document::{self, ActionKind};

/// What a stored action does.
struct Stored<'t> {
    variable: &'t str,
    value: &'t str,
}

fn stored<'t>(does: &Does<'t>) -> Option<Stored<'t>> {
    let (variable, value) = match *does {
        Does::Name(_) => return None,
        Does::Value(variable, value) => (variable, value),
        Does::Set(variable) => (variable, "TRUE"),
        Does::Reset(variable) => (variable, "FALSE"),
    };
    Some(Stored { variable, value })
}

impl Writer<'_, '_> {
    /// Gives a step an action.
    pub(super) fn action(&mut self, chart: &mut Chart, step: StepId, action: &document::Action) {
        let (text, span) = (action.text.text(), action.text.span);
        if action.kind == ActionKind::Forcing {
            match order(&text, span, self.project) {
                Ok(order) => {
                    chart.steps.entry(step).and_modify(|one| one.forcings.push(order));
                }
                Err(wrong) => self.diagnostics.push(*wrong),
            }
            return;
        }
        // What it says has been asked before.
        let Some(does) = does(&text) else { return };
        if let Does::Name(name) = does
            && let Some(order) = gate(name, span, self.project)
        {
            if action.kind == ActionKind::Conditional {
                let message = format!("{name}: an order with a condition");
                let help = "a chart is forced as long as the step is active: put a step between";
                return self.error(ErrorCode::NotInStyle, span, message, help);
            }
            chart.steps.entry(step).and_modify(|one| one.forcings.push(order));
            return;
        }
        let name = match does {
            Does::Name(name) | Does::Value(name, _) | Does::Set(name) | Does::Reset(name) => name,
        };
        let condition = action.condition.as_ref().and_then(|words| self.condition(words));
        if self.names.is_device(name) {
            return self.is_continuous(name, action, condition.as_ref());
        }
        let instances = match stored(&does) {
            None => self.on(chart, name, action, condition),
            Some(stored) => self.stored(chart, step, &stored, action, condition),
        };
        instances.into_iter().for_each(|one| add(chart, step, one));
    }

    /// Reports what a timer or counter cannot follow: it is called once a scan, when the situation
    /// is stable.
    fn is_continuous(
        &mut self,
        name: &str,
        action: &document::Action,
        condition: Option<&Condition>,
    ) {
        let span = action.text.span;
        if matches!(action.kind, ActionKind::Deactivation | ActionKind::Event) {
            let message = format!("{name}: a timer or counter in a stored action");
            let help = "it runs or counts while a step is active: give a normal action to a step";
            self.error(ErrorCode::NotInStyle, span, message, help);
        }
        self.no_edge(name, span, condition);
    }

    fn no_edge(&mut self, name: &str, span: Span, condition: Option<&Condition>) {
        if condition.is_some_and(|one| self.names.has_edge(one)) {
            let message =
                format!("{name}: an edge in the condition of an action that is not stored");
            self.error(ErrorCode::NotInStyle, span, message, EDGE);
        }
    }

    /// A variable that is TRUE while the step is active.
    fn on(
        &mut self,
        chart: &mut Chart,
        name: &str,
        action: &document::Action,
        condition: Option<Condition>,
    ) -> Vec<Instance> {
        let span = action.text.span;
        self.no_edge(name, span, condition.as_ref());
        let id = self.variable(chart, name, span);
        let condition = self.coded(condition, action);
        vec![Instance { condition, origin: Origin(span), ..Instance::new(id) }]
    }

    fn stored(
        &mut self,
        chart: &mut Chart,
        step: StepId,
        stored: &Stored,
        action: &document::Action,
        condition: Option<Condition>,
    ) -> Vec<Instance> {
        let span = action.text.span;
        self.is_once(stored, action);
        let instance =
            |id, qualifier| Instance { qualifier, origin: Origin(span), ..Instance::new(id) };
        let event = condition.clone().map(|one| self.event(one, action));
        let condition = self.coded(condition, action);
        let bit = match stored.value.to_uppercase().as_str() {
            _ if !self.is_bool(stored.variable) => None,
            "TRUE" | "1" => Some(Qualifier::S),
            "FALSE" | "0" => Some(Qualifier::R),
            _ => None,
        };
        let (qualifier, is_event) = match action.kind {
            ActionKind::Deactivation => (Qualifier::P0, false),
            ActionKind::Event => (Qualifier::P1, true),
            _ => (Qualifier::P1, false),
        };
        let first = match bit {
            Some(bit) if qualifier == Qualifier::P1 && !is_event => {
                instance(self.variable(chart, stored.variable, span), bit)
            }
            _ => instance(self.code(chart, step, stored, span), qualifier),
        };
        if is_event {
            return vec![Instance { event, ..first }];
        }
        let first = Instance { condition, ..first };
        if action.kind != ActionKind::Conditional {
            return vec![first];
        }
        // While it is true: from the activation on, or from when it becomes true.
        let later = instance(self.code(chart, step, stored, span), Qualifier::P1);
        vec![first, Instance { event, ..later }]
    }

    /// An action of statements.
    fn code(&mut self, chart: &mut Chart, step: StepId, stored: &Stored, span: Span) -> ActionId {
        let name = chart.steps.get(&step).map_or("", |step| step.name.as_str());
        let name = self.names.fresh(&format!("{name}_{}", stored.variable));
        let (comment, origin) = (String::new(), Origin(span));
        let body = Body::Code(Code { text: self.assignment(stored), origin });
        chart.add_action(Action { name, body, comment, origin })
    }

    /// Warns of a value that can change while the step is active: it is given once here.
    fn is_once(&mut self, stored: &Stored, action: &document::Action) {
        let is_held = matches!(action.kind, ActionKind::Normal | ActionKind::Conditional);
        if is_held && words(stored.value).next().is_some_and(|word| !is_truth(word)) {
            let message = format!("set/reset, {} gets this value in every scan", stored.variable);
            let one = Diagnostic::new(ErrorCode::StyleDiffers, action.text.span, message);
            let help = "a GRAFCET gives it once, when the step becomes active";
            self.diagnostics.push(one.help(help));
        }
    }

    /// What a transition does when it is crossed.
    pub(super) fn statement(&mut self, action: &document::Action) -> Option<String> {
        if action.condition.is_some() {
            let message =
                format!("{}: an action of a transition with a condition", action.text.text());
            let help = "give it to a step, or the condition to a transition of its own";
            self.error(ErrorCode::NotInStyle, action.span, message, help);
        }
        let text = action.text.text();
        Some(self.assignment(&stored(&does(&text)?)?))
    }

    fn assignment(&self, stored: &Stored) -> String {
        let value = match stored.value {
            "1" if self.is_bool(stored.variable) => "TRUE".to_owned(),
            "0" if self.is_bool(stored.variable) => "FALSE".to_owned(),
            value => self.names.value(value),
        };
        format!("{} := {value};", self.names.variable(stored.variable))
    }

    fn is_bool(&self, name: &str) -> bool {
        let found = self.plan.variables.iter().find(|one| one.name == name);
        found.is_some_and(|one| one.of_type == "BOOL")
    }

    /// The action of a chart that a variable is.
    pub(super) fn variable(&mut self, chart: &mut Chart, name: &str, span: Span) -> ActionId {
        let name = self.names.variable(name);
        let is_it = |one: &Action| is_same_name(&one.name, &name);
        let known = chart.actions.iter().find(|(_, one)| is_it(one)).map(|(id, _)| *id);
        known.unwrap_or_else(|| chart.add_action(Action::variable(name, Origin(span))))
    }

    fn coded(&self, condition: Option<Condition>, action: &document::Action) -> Option<Code> {
        let origin = Origin(action.condition.as_ref().map_or(action.span, |words| words.span));
        condition.map(|one| Code { text: self.names.written(&one), origin })
    }

    /// When something becomes TRUE: an event is that of it anyway.
    fn event(&self, condition: Condition, action: &document::Action) -> Code {
        let condition = match condition {
            Condition::Rising(name) => Condition::Variable(name),
            Condition::Falling(name) => Condition::Not(Box::new(Condition::Variable(name))),
            other => other,
        };
        self.coded(Some(condition), action).unwrap_or_default()
    }
}

/// Adds an instance; a block has an action once with each qualifier, for one of several conditions.
pub(super) fn add(chart: &mut Chart, step: StepId, instance: Instance) {
    let Some(step) = chart.steps.get_mut(&step) else { return };
    let is_same =
        |one: &&mut Instance| one.action == instance.action && one.qualifier == instance.qualifier;
    let Some(known) = step.block.iter_mut().find(is_same) else {
        return step.block.push(instance);
    };
    let both = known.condition.take().zip(instance.condition);
    known.condition = both
        .map(|(one, other)| Code { text: format!("({}) OR ({})", one.text, other.text), ..one });
}

fn is_truth(word: &str) -> bool {
    word.eq_ignore_ascii_case("TRUE") || word.eq_ignore_ascii_case("FALSE")
}
