//! From the charts of a file to the plan: equations, what actions do, variables with their kinds.

use std::collections::{BTreeMap, HashMap, HashSet};

use diagnostics::Span;
use st::keywords::is_keyword;
use st::names::is_name;

use super::action_text::{Does, does, words};
use super::plan::{Assignment, Cause, ChartPlan, Device, Plan, StepPlan};
use super::style;
use super::uses::{Use, Uses};
use super::variables::{Kind, Table, Variable};
use super::well_formed::{not_in_style, well_formed};
use crate::diagnostic::{Code, Diagnostic};
use crate::sfcedit::condition::{Condition, Manner, parse};
use crate::sfcedit::document::{Action, ActionKind, Grafcet, Project, Step};
use crate::sfcedit::wiring::{Wiring, wire};
use crate::sfcedit::words::Words;
use crate::text;

/// How names of timers and counters begin where no table says that they are some.
const PREFIXES: [(&str, Kind); 2] = [("Temp", Kind::Timer), ("Cont", Kind::Counter)];

/// What is made of the charts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Style {
    /// Equations.
    SetReset,
    /// A GRAFCET, which has macro-steps, enclosing steps, orders, events and times, too.
    Grafcet,
}

/// The plan for the charts of a file. All that is wrong, or is not in this style, is reported.
pub fn plan(project: &Project, table: &Table) -> (Plan, Vec<Diagnostic>) {
    assembled(project, table, Style::SetReset)
}

/// As [`plan`]; of a GRAFCET variables, timers and counters are in it, not what only it has.
pub(crate) fn assembled(project: &Project, table: &Table, style: Style) -> (Plan, Vec<Diagnostic>) {
    let mut assembler = Assembler {
        style,
        table,
        plan: Plan::default(),
        uses: Uses::default(),
        step_names: HashMap::new(),
        diagnostics: Vec::new(),
    };
    assembler.names(project);
    for grafcet in &project.grafcets {
        assembler.chart(grafcet);
    }
    assembler.devices_are_complete();
    assembler.variables();
    let Assembler { plan, mut diagnostics, .. } = assembler;
    diagnostics.sort_by_key(|one| one.span);
    (plan, diagnostics)
}

struct Assembler<'t> {
    style: Style,
    table: &'t Table,
    plan: Plan,
    uses: Uses,
    /// Steps of all charts: their names as written, by those in upper case.
    step_names: HashMap<String, (String, Span)>,
    diagnostics: Vec<Diagnostic>,
}

impl Assembler<'_> {
    fn error(&mut self, code: Code, span: Span, message: impl Into<String>, help: &str) {
        self.diagnostics.push(Diagnostic::new(code, span, message).help(help));
    }

    /// Names of charts and steps are there once.
    fn names(&mut self, project: &Project) {
        let mut charts: HashMap<String, Span> = HashMap::new();
        for grafcet in &project.grafcets {
            let name = &grafcet.name;
            if let Some(other) = charts.insert(name.text.to_uppercase(), name.span) {
                self.twice("charts", &name.text, name.span, other);
            }
            self.is_free(&name.text, name.span);
            for element in grafcet.sequences.iter().flat_map(|one| &one.elements) {
                let crate::sfcedit::document::Element::Step(step) = element else { continue };
                let (name, span) = (&step.name.text, step.name.span);
                let known = self.step_names.insert(name.to_uppercase(), (name.clone(), span));
                if let Some((_, other)) = known
                    && !name.is_empty()
                {
                    self.twice("steps", name, span, other);
                }
                self.is_free(name, span);
            }
        }
    }

    fn is_step(&self, name: &str) -> bool {
        self.step_names.get(&name.to_uppercase()).is_some_and(|(step, _)| step == name)
    }

    fn twice(&mut self, what: &str, name: &str, span: Span, other: Span) {
        let message = format!("{name}: there are two {what} of this name");
        let error = Diagnostic::new(Code::XmlStructure, span, message);
        self.diagnostics.push(error.related(other, "the other one"));
    }

    /// Reports what can be no name of a step or chart.
    fn is_free(&mut self, name: &str, span: Span) {
        let is_word = |name: &str| {
            let name = name.to_uppercase();
            is_keyword(&name) || text::KEYWORDS.contains(&name.as_str())
        };
        if self.style == Style::Grafcet && is_word(name) {
            let message = format!("{name}: a word of the language names nothing");
            let help = format!("another name, such as {name}1");
            return self.error(Code::XmlStructure, span, message, &help);
        }
        if is_name(name) || name.is_empty() {
            return;
        }
        let help = "names begin with a letter and go on with letters, digits and _";
        self.error(Code::XmlStructure, span, format!("`{name}` is no name"), help);
    }

    fn instance_kind(&self, name: &str) -> Option<Kind> {
        if let Some(variable) = self.table.get(name) {
            return matches!(variable.kind, Kind::Timer | Kind::Counter).then_some(variable.kind);
        }
        PREFIXES.iter().find(|(prefix, _)| name.starts_with(prefix)).map(|(_, kind)| *kind)
    }

    fn condition(&mut self, words: &Words) -> Option<Condition> {
        if words.is_empty() {
            // That it is missing has been said.
            return None;
        }
        let manner = Manner {
            is_instance: &|name| self.instance_kind(name).is_some(),
            has_times: self.style == Style::Grafcet,
        };
        match parse(words, manner) {
            Ok(condition) => Some(self.note(condition, words.span)),
            Err(error) => {
                self.diagnostics.push(*error);
                None
            }
        }
    }

    /// Notes the variables and edges of a condition; a timer's or counter's name is its `.Q`.
    fn note(&mut self, condition: Condition, at: Span) -> Condition {
        let mut edges = Vec::new();
        let mut names = Vec::new();
        condition.visit(&mut |name, edge| {
            edges.extend(edge.map(|rising| (name.to_owned(), rising)));
            names.push(name.to_owned());
        });
        for edge in edges {
            self.edge(&edge.0, edge.1);
        }
        for name in names {
            let name = name.split('.').next().unwrap_or(&name).to_owned();
            if self.is_step(&name) {
                continue;
            }
            let found = self.uses.of(&name, at);
            found.is_read = true;
            found.is_number |= condition.compares(&name);
        }
        self.answered(condition)
    }

    /// With `.Q` after names of timers and counters.
    fn answered(&self, condition: Condition) -> Condition {
        let all = |all: Vec<Condition>| all.into_iter().map(|one| self.answered(one)).collect();
        match condition {
            Condition::Variable(name)
                if !name.contains('.') && self.instance_kind(&name).is_some() =>
            {
                let block = self.table.get(&name).map_or("", |row| row.of_type.as_str());
                let output = if block == "CTUD" { "QU" } else { "Q" };
                Condition::Variable(format!("{name}.{output}"))
            }
            Condition::Not(one) => Condition::Not(Box::new(self.answered(*one))),
            Condition::Time(on, of, off) => Condition::Time(on, Box::new(self.answered(*of)), off),
            Condition::And(inner) => Condition::And(all(inner)),
            Condition::Or(inner) => Condition::Or(all(inner)),
            other => other,
        }
    }

    fn edge(&mut self, name: &str, rising: bool) {
        let edge = (name.to_owned(), rising);
        if !self.plan.edges.contains(&edge) {
            self.plan.edges.push(edge);
        }
    }

    fn chart(&mut self, grafcet: &Grafcet) {
        let mut found = Vec::new();
        let wiring = wire(grafcet, &mut found);
        let is_sound = found.is_empty();
        self.diagnostics.append(&mut found);
        not_in_style(grafcet, &wiring, self.style, &mut self.diagnostics);
        if is_sound {
            well_formed(grafcet, &wiring, self.style, &mut self.diagnostics);
        }
        let conditions: Vec<Option<Condition>> = wiring
            .transitions
            .iter()
            .map(|wired| {
                wired.transition.actions.iter().for_each(|one| self.crossing(one));
                self.derived(&wired.transition.comment);
                self.condition(&wired.transition.condition)
            })
            .collect();
        self.diagnostics.extend(match self.style {
            Style::SetReset => style::warnings(&wiring, &conditions),
            Style::Grafcet => style::other_in_grafcet(&wiring, &conditions),
        });
        self.equations(grafcet, &wiring, &conditions);
        for step in &wiring.steps {
            for action in &step.actions {
                self.action(step, action);
            }
        }
    }

    /// `Sig := expression` in the comment of a transition.
    fn derived(&mut self, comment: &Words) {
        let Some((name, expression)) = comment.assignment() else { return };
        if !is_name(&name) {
            return;
        }
        let Some(condition) = self.condition(&expression) else { return };
        self.uses.of(&name, comment.span).is_written = true;
        if self.plan.derived.iter().all(|(other, _)| *other != name) {
            self.plan.derived.push((name, condition));
        }
    }

    fn equations(&mut self, grafcet: &Grafcet, wiring: &Wiring, conditions: &[Option<Condition>]) {
        let names = |steps: &[usize]| {
            let mut steps = steps.to_vec();
            steps.sort_unstable();
            let name = |at: usize| wiring.steps[at].name.text.clone();
            steps.into_iter().map(name).collect::<Vec<_>>()
        };
        let step = |(at, step): (usize, &&Step)| StepPlan {
            name: step.name.text.clone(),
            is_initial: step.kind.is_initial(),
            set: wiring
                .transitions
                .iter()
                .zip(conditions)
                .filter(|(wired, _)| wired.to.contains(&at))
                .filter_map(|(wired, condition)| Some((names(&wired.from), condition.clone()?)))
                .collect(),
            reset: wiring
                .transitions
                .iter()
                .filter(|wired| wired.from.contains(&at))
                .map(|wired| names(&wired.to))
                .collect(),
        };
        let steps = wiring.steps.iter().enumerate().map(step).collect();
        self.plan.charts.push(ChartPlan { name: grafcet.name.text.clone(), steps });
    }

    /// An action of a transition.
    fn crossing(&mut self, action: &Action) {
        let span = action.text.span;
        let (text, cause) = (action.text.text(), Condition::Constant(true));
        let cause = Cause { step: cause, condition: None };
        match (self.style, does(&text)) {
            (Style::Grafcet, Some(Does::Value(name, value))) => {
                self.value(name, value, cause, span);
            }
            (Style::Grafcet, Some(Does::Set(name))) => self.value(name, "TRUE", cause, span),
            (Style::Grafcet, Some(Does::Reset(name))) => self.value(name, "FALSE", cause, span),
            (style, _) => {
                let help = match style {
                    Style::SetReset => "not in this style of chart: give it to a step",
                    Style::Grafcet => "what a crossing does is `V := value`, `S V` or `R V`",
                };
                self.error(
                    Code::NotInStyle,
                    action.span,
                    format!("action {text} of a transition"),
                    help,
                );
            }
        }
    }

    fn action(&mut self, step: &Step, action: &Action) {
        let name = step.name.text.clone();
        let cause = match action.kind {
            ActionKind::Normal | ActionKind::Conditional => Condition::Variable(name),
            ActionKind::Activation => Condition::Rising(name),
            ActionKind::Deactivation => Condition::Falling(name),
            ActionKind::Forcing if self.style == Style::Grafcet => return,
            ActionKind::Event if self.style == Style::Grafcet => Condition::Variable(name),
            ActionKind::Forcing | ActionKind::Event => {
                let what = if action.kind == ActionKind::Event { "an event" } else { "forcing" };
                let message = format!("action {}: {what}", action.text.text());
                let help = "not in this style of chart: charts are coordinated by signals";
                return self.error(Code::NotInStyle, action.text.span, message, help);
            }
        };
        if let Condition::Rising(name) | Condition::Falling(name) = &cause {
            let rising = action.kind == ActionKind::Activation;
            let name = name.clone();
            self.edge(&name, rising);
        }
        let condition = match &action.condition {
            Some(words) => match self.condition(words) {
                Some(condition) => Some(condition),
                None => return,
            },
            None => None,
        };
        let cause = Cause { step: cause, condition };
        let text = action.text.text();
        if text.is_empty() {
            return;
        }
        let span = action.text.span;
        let is_stored = !matches!(action.kind, ActionKind::Normal | ActionKind::Conditional);
        match does(&text) {
            Some(Does::Name(name)) => self.on(name, cause, span, is_stored),
            Some(Does::Value(name, value)) => self.value(name, value, cause, span),
            Some(Does::Set(name)) => self.value(name, "TRUE", cause, span),
            Some(Does::Reset(name)) => match self.instance_kind(name) {
                Some(_) => {
                    self.uses.of(name, span);
                    self.device(name).resets.push(cause);
                }
                None => self.value(name, "FALSE", cause, span),
            },
            None => {
                let help = "an action is a name, `V := value`, `S V` or `R V`";
                let message = format!("`{text}`: this is no action of this style");
                self.error(Code::NotInStyle, span, message, help);
            }
        }
    }

    /// A name alone: an output is on, a timer runs, a counter counts.
    fn on(&mut self, name: &str, cause: Cause, span: Span, is_stored: bool) {
        self.uses.of(name, span).is_written = true;
        if self.instance_kind(name).is_some() {
            return self.device(name).starts.push(cause);
        }
        if is_stored {
            let help = format!("write what it gets: `{name} := TRUE` or `S {name}`");
            let message = format!("{name}: a stored action without a value");
            return self.error(Code::NotInStyle, span, message, &help);
        }
        let known = self.plan.outputs.iter_mut().find(|(other, _)| other == name);
        match known {
            Some((_, causes)) => causes.push(cause),
            None => self.plan.outputs.push((name.to_owned(), vec![cause])),
        }
    }

    fn value(&mut self, name: &str, value: &str, cause: Cause, span: Span) {
        if self.instance_kind(name).is_some() {
            self.uses.of(name, span).is_written = true;
            let presets = &mut self.device(name).presets;
            match presets.iter_mut().find(|(known, _)| known == value) {
                Some((_, causes)) => causes.push(cause),
                None => presets.push((value.to_owned(), vec![cause])),
            }
            return;
        }
        let is_bit = matches!(value.to_uppercase().as_str(), "0" | "1" | "TRUE" | "FALSE");
        let is_bool = self.table.get(name).map_or(is_bit, |row| row.of_type == "BOOL");
        let value = match value.to_uppercase().as_str() {
            "1" if is_bool => "TRUE",
            "0" if is_bool => "FALSE",
            _ => value,
        };
        for word in words(value).filter(|word| is_name(word) && !is_keyword(word)) {
            if !self.is_step(word) {
                let found = self.uses.of(word, span);
                found.is_read = true;
                found.is_number |= !is_bool;
            }
        }
        let found = self.uses.of(name, span);
        found.is_written = true;
        found.is_number |= !is_bool;
        let same = |one: &&mut Assignment| one.variable == name && one.value == value;
        match self.plan.assignments.iter_mut().find(|one| same(one)) {
            Some(one) => one.causes.push(cause),
            None => self.plan.assignments.push(Assignment {
                variable: name.to_owned(),
                value: value.to_owned(),
                causes: vec![cause],
            }),
        }
    }

    fn device(&mut self, name: &str) -> &mut Device {
        let is_timer = self.instance_kind(name) == Some(Kind::Timer);
        let block = match self.table.get(name) {
            Some(row) => row.of_type.clone(),
            None => if is_timer { "TON" } else { "CTU" }.to_owned(),
        };
        let all = if is_timer { &mut self.plan.timers } else { &mut self.plan.counters };
        let known = all.iter().position(|one| one.name == name);
        let at = known.unwrap_or_else(|| {
            all.push(Device { name: name.to_owned(), block, ..Device::default() });
            all.len() - 1
        });
        &mut all[at]
    }

    /// A timer or counter has a preset; one that nothing starts is started by the steps that set
    /// it.
    fn devices_are_complete(&mut self) {
        let mut errors = Vec::new();
        for device in self.plan.timers.iter_mut().chain(&mut self.plan.counters) {
            if device.starts.is_empty() {
                device.starts =
                    device.presets.iter().flat_map(|(_, causes)| causes).cloned().collect();
            }
            if device.presets.is_empty() {
                let value = if device.block.starts_with('T') { "T#5s" } else { "10" };
                errors.push((device.name.clone(), value));
            }
        }
        for (name, value) in errors {
            let span = self.uses.of(&name, Span::default()).at;
            let help = format!("an action of a step says it: `{name} := {value}`");
            self.error(Code::BadVariables, span, format!("{name}: it has no preset"), &help);
        }
        let stored: HashSet<String> =
            self.plan.assignments.iter().map(|one| one.variable.clone()).collect();
        let both = self.plan.outputs.iter().map(|(name, _)| name.clone());
        let both: Vec<String> = both.filter(|name| stored.contains(name)).collect();
        for name in both {
            let span = self.uses.of(&name, Span::default()).at;
            let message = format!("{name}: both an action while a step is active and a stored one");
            let help = "the one would undo the other: use either of them";
            self.error(Code::NotInStyle, span, message, help);
        }
    }

    /// All variables with their kinds: as the table says, else as they are used.
    fn variables(&mut self) {
        let mut rows: BTreeMap<Span, Variable> = BTreeMap::new();
        for (variable, span) in self.table.rows() {
            rows.insert(*span, variable.clone());
        }
        let mut order = std::mem::take(&mut self.uses.order);
        let used: HashSet<String> = order.iter().cloned().collect();
        let unused = rows.values().filter(|one| !used.contains(&one.name));
        order.extend(unused.map(|one| one.name.clone()));
        for name in order {
            let used = self.uses.known.get(&name).copied().unwrap_or_default();
            let variable = match self.table.get(&name) {
                Some(row) => row.clone(),
                None => self.guessed(&name, used),
            };
            let can_be_unwritten =
                matches!(variable.kind, Kind::Input | Kind::System | Kind::Constant);
            if used.is_read && !used.is_written && !can_be_unwritten {
                let message = format!("{name}: nothing writes it");
                let help = "an action of a step, or the comment of a transition, does";
                self.diagnostics
                    .push(Diagnostic::new(Code::NeverWritten, used.at, message).help(help));
            }
            if !self.is_step(&name) {
                self.plan.variables.push(variable);
            }
        }
        self.letter_case();
    }

    /// Names that differ in letter case alone are one name to ST.
    fn letter_case(&mut self) {
        let steps = self.step_names.iter().map(|(key, (name, _))| (key.clone(), name.clone()));
        let mut known: HashMap<String, String> = steps.collect();
        for name in self.plan.variables.iter().map(|one| one.name.clone()) {
            let other = known.entry(name.to_uppercase()).or_insert_with(|| name.clone()).clone();
            if other != name {
                let span = self.uses.known.get(&name).map_or(Span::default(), |used| used.at);
                let message = format!("{name} and {other} differ in letter case alone");
                let help = "ST takes them for one variable: give one of them another name";
                let warning = Diagnostic::new(Code::LetterCase, span, message).help(help);
                self.diagnostics.push(warning);
            }
        }
    }

    fn guessed(&self, name: &str, used: Use) -> Variable {
        let is_gate = self.plan.charts.iter().any(|chart| {
            let gates = [format!("Init{}", chart.name), format!("Reset{}", chart.name)];
            gates.iter().any(|gate| gate.eq_ignore_ascii_case(name))
        });
        let is_derived = self.plan.derived.iter().any(|(one, _)| one == name);
        let kind = match (self.instance_kind(name), used.is_read, used.is_written) {
            (Some(kind), ..) => kind,
            _ if is_gate || is_derived => Kind::Signal,
            (_, true, true) => Kind::Memory,
            (_, false, true) => Kind::Output,
            _ => Kind::Input,
        };
        let of_type = match kind {
            Kind::Timer => "TON",
            Kind::Counter => "CTU",
            _ if used.is_number => "INT",
            _ => "BOOL",
        };
        Variable { name: name.to_owned(), kind, of_type: of_type.to_owned(), value: None }
    }
}
