//! What names of a file are called in the program, and conditions with them: variables, steps, what
//! timers and counters say, signals in the place of which stands what defines them.

use std::collections::{HashMap, HashSet};

use diagnostics::Span;
use st::keywords::KEYWORDS;

use crate::diagnostic::{Code, Diagnostic};
use crate::set_reset::action_text::pieces;
use crate::set_reset::plan::Plan;
use crate::set_reset::targets::{Group, Object, new_names, preset_name};
use crate::set_reset::variables::Kind;
use crate::sfcedit::condition::{Condition, Edges};
use crate::text;

/// Variables and signals that can stand for a signal.
const SIGNAL_MAX: usize = 1_000;

/// The names of a program.
pub(super) struct Names<'p> {
    plan: &'p Plan,
    renamed: HashMap<String, String>,
    /// In upper case.
    taken: HashSet<String>,
    /// Variables that stand between the chart and its timers and counters.
    added: Vec<Object>,
}

/// Edges as a GRAFCET has them.
struct Functions;

impl Edges for Functions {
    fn rising(&self, variable: &str) -> String {
        format!("R_EDGE({variable})")
    }

    fn falling(&self, variable: &str) -> String {
        format!("F_EDGE({variable})")
    }
}

impl<'p> Names<'p> {
    pub(super) fn of(plan: &'p Plan) -> Names<'p> {
        let renamed = new_names(plan);
        let charts = plan.charts.iter().map(|chart| &chart.name);
        let steps = plan.charts.iter().flat_map(|chart| &chart.steps).map(|step| &step.name);
        let variables =
            plan.variables.iter().map(|one| renamed.get(&one.name).unwrap_or(&one.name));
        let devices = plan.timers.iter().chain(&plan.counters);
        let presets: Vec<String> = devices.map(preset_name).collect();
        let all =
            charts.chain(steps).chain(&presets).chain(variables).map(|name| name.to_uppercase());
        let words = KEYWORDS.iter().chain(&text::KEYWORDS).map(|word| (*word).to_owned());
        let taken = all.chain(words).collect();
        Names { plan, renamed, taken, added: Vec::new() }
    }

    /// A name that nothing has yet; it is taken then.
    pub(super) fn fresh(&mut self, wanted: &str) -> String {
        let mut name = wanted.to_owned();
        while !self.taken.insert(name.to_uppercase()) {
            name.push('_');
        }
        name
    }

    /// A new global variable of type BOOL.
    pub(super) fn add_bool(&mut self, wanted: &str) -> String {
        let name = self.fresh(wanted);
        self.added.push(Object::plain(&name, "BOOL"));
        name
    }

    /// The variables that were added.
    pub(super) fn added(&mut self) -> Option<Group> {
        let variables = std::mem::take(&mut self.added);
        let title = "from the chart to its timers and counters".to_owned();
        (!variables.is_empty()).then_some(Group { title, variables, is_constant: false })
    }

    /// A variable, as the program calls it.
    pub(super) fn variable(&self, name: &str) -> String {
        let (first, member) = name.split_at(name.find('.').unwrap_or(name.len()));
        format!("{}{member}", self.renamed.get(first).map_or(first, String::as_str))
    }

    /// Whether it is a timer or counter.
    pub(super) fn is_device(&self, name: &str) -> bool {
        let is_it = |kind| matches!(kind, Kind::Timer | Kind::Counter);
        self.plan.variables.iter().any(|one| one.name == name && is_it(one.kind))
    }

    fn is_step(&self, name: &str) -> bool {
        let mut steps = self.plan.charts.iter().flat_map(|chart| &chart.steps);
        steps.any(|step| step.name == name)
    }

    fn definition(&self, name: &str) -> Option<&'p Condition> {
        self.plan.derived.iter().find(|(signal, _)| signal == name).map(|(_, one)| one)
    }

    /// Whether a signal has no variable: what defines it stands in its place everywhere.
    pub(super) fn is_replaced(&self, name: &str) -> bool {
        let is_signal = |name: &str| {
            let found = self.plan.variables.iter().find(|one| one.name == name);
            found.is_some_and(|one| one.kind == Kind::Signal)
        };
        let mut signals = self.plan.derived.iter().map(|(signal, _)| signal);
        signals.any(|signal| self.variable(signal) == name && is_signal(signal))
    }

    /// Reports a signal that cannot be replaced by what defines it: by itself, or by too much.
    pub(super) fn check_signals(&self, at: Span, found: &mut Vec<Diagnostic>) {
        let sizes = self.sizes();
        let is_small = |signal: &str| sizes.get(signal).is_some_and(|size| *size <= SIGNAL_MAX);
        let mut signals = self.plan.derived.iter().map(|(signal, _)| signal.as_str());
        let Some(signal) = signals.find(|signal| !is_small(signal)) else { return };
        let one = match self.circle(signal, &sizes) {
            Some(signal) => {
                let message = format!("{signal}: the signal is defined by itself");
                let help = "in a GRAFCET it stands for what the comment says: let a step hold it";
                Diagnostic::new(Code::NotInStyle, at, message).help(help)
            }
            None => {
                let message = format!("{signal}: what defines this signal is too large");
                Diagnostic::new(Code::NotInStyle, at, message).help("let a step hold a part of it")
            }
        };
        found.push(one);
    }

    /// How many variables and signals stand for a signal, once all in it are replaced; of those in
    /// circles, and those that go too deep, nothing.
    fn sizes(&self) -> HashMap<&str, usize> {
        let signals: HashSet<&str> = self.plan.derived.iter().map(|(name, _)| &name[..]).collect();
        let mut sizes: HashMap<&str, usize> = HashMap::new();
        // Each time those become known whose signals are.
        for _ in 0..SIGNAL_MAX {
            let before = sizes.len();
            for (signal, condition) in &self.plan.derived {
                let mut size = Some(1usize);
                condition.visit(&mut |name, _| {
                    let of_name = match signals.contains(name) {
                        true => sizes.get(name).copied(),
                        false => Some(1),
                    };
                    size = size.zip(of_name).map(|(all, one)| all.saturating_add(one));
                });
                sizes.extend(size.map(|size| (&signal[..], size)));
            }
            if sizes.len() == before {
                break;
            }
        }
        sizes
    }

    /// A signal in a circle, looked for from one whose size is not known.
    fn circle<'n>(&'n self, signal: &'n str, sizes: &HashMap<&str, usize>) -> Option<&'n str> {
        let mut way = HashSet::new();
        let mut signal = signal;
        while way.insert(signal) {
            let condition = self.definition(signal)?;
            let mut names = Vec::new();
            condition.visit(&mut |name, _| names.push(name.to_owned()));
            let mut open = self.plan.derived.iter().map(|(name, _)| name.as_str());
            signal =
                open.find(|name| !sizes.contains_key(name) && names.iter().any(|one| one == name))?;
        }
        Some(signal)
    }

    /// A condition as the program writes it.
    pub(super) fn written(&self, condition: &Condition) -> String {
        self.meant(condition).st(&Functions)
    }

    /// With signals replaced and names as the program calls them.
    fn meant(&self, condition: &Condition) -> Condition {
        condition.replaced(&|one| match one {
            Condition::Variable(name) => Some(match self.definition(name) {
                Some(condition) => self.meant(condition),
                None => Condition::Variable(self.said(name)),
            }),
            Condition::Rising(name) => Some(Condition::Rising(self.operand(name))),
            Condition::Falling(name) => Some(Condition::Falling(self.operand(name))),
            Condition::Comparison(left, relation, right) => {
                Some(Condition::Comparison(self.variable(left), relation, self.variable(right)))
            }
            _ => None,
        })
    }

    /// What an edge is of.
    fn operand(&self, name: &str) -> String {
        self.written(&Condition::Variable(name.to_owned()))
    }

    fn said(&self, name: &str) -> String {
        if self.is_step(name) {
            return format!("{name}.X");
        }
        let devices = self.plan.variables.iter().filter(|_| self.is_device(name));
        match devices.into_iter().find(|one| one.name == name) {
            Some(one) if one.of_type == "CTUD" => format!("{}.QU", self.variable(name)),
            Some(_) => format!("{}.Q", self.variable(name)),
            None => self.variable(name),
        }
    }

    /// Whether it asks for an edge.
    pub(super) fn has_edge(&self, condition: &Condition) -> bool {
        let mut found = false;
        self.meant(condition).visit(&mut |_, edge| found |= edge.is_some());
        found
    }

    /// A value as the program writes it.
    pub(super) fn value(&self, text: &str) -> String {
        let word = |(is_word, piece): (bool, &str)| match is_word {
            true => self.operand(piece),
            false => piece.to_owned(),
        };
        pieces(text).into_iter().map(word).collect()
    }
}
