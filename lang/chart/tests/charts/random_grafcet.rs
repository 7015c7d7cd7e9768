//! Random charts by the rules of GRAFCET, as text: with macro-steps, enclosing steps and forcing
//! orders in each other, all kinds of actions, edges and times.

use std::fmt::Write;

use fastrand::Rng;

use crate::random_text::{INPUTS, MARKS, Steps, Text, head};

/// How a chart belongs to another.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// Beside it.
    Partial,
    /// As the expansion of one of its steps.
    Expansion(usize),
    /// In one of its steps.
    Enclosed(usize),
}

struct Plan {
    name: String,
    steps: Vec<String>,
    kind: Kind,
    /// The chart to which it belongs.
    owner: usize,
    /// Orders of its steps.
    orders: Vec<(usize, String)>,
}

/// A GRAFCET in a PROGRAM `Main`.
pub fn program(seed: u64) -> String {
    let mut random = Rng::with_seed(seed);
    let plans = plans(&mut random);
    let pragma = match random.u8(..3) {
        0 => format!("{{grafcet evolutions {}}}\n", random.u8(1..40)),
        _ => "{grafcet}\n".to_owned(),
    };
    let text = head() + &pragma;
    let mut text = Text { random: &mut random, text, is_grafcet: true };
    text.grafcet(&plans, 0);
    text.text += "END_PROGRAM\n";
    text.text
}

fn plan(random: &mut Rng, at: usize, kind: Kind, owner: usize) -> Plan {
    let count = random.usize(1..if at == 0 { 8 } else { 5 });
    let steps = (0..count.max(2)).map(|n| format!("S{at}_{n}")).collect();
    Plan { name: format!("G{at}"), steps, kind, owner, orders: Vec::new() }
}

fn plans(random: &mut Rng) -> Vec<Plan> {
    let mut plans = vec![plan(random, 0, Kind::Partial, 0)];
    let mut used = Vec::new();
    for at in 1..random.usize(1..6) {
        let owner = random.usize(..at);
        let step = random.usize(..plans[owner].steps.len());
        let is_free = !used.contains(&(owner, step));
        let kind = match random.u8(..5) {
            0 | 1 if is_free => Kind::Expansion(step),
            // Of steps of a kind there is one name each; an enclosing step could have more.
            2 | 3 if is_free => Kind::Enclosed(step),
            _ => Kind::Partial,
        };
        if kind != Kind::Partial {
            used.push((owner, step));
        }
        plans.push(plan(random, at, kind, owner));
    }
    for forced in 1..plans.len() {
        if matches!(plans[forced].kind, Kind::Expansion(_)) || random.bool() {
            continue;
        }
        for _ in 0..random.usize(1..3) {
            let by = random.usize(..forced);
            let step = random.usize(..plans[by].steps.len());
            let situation = match random.u8(..5) {
                0 => "()".to_owned(),
                1 => "*".to_owned(),
                2 => "INIT".to_owned(),
                _ => {
                    let steps = plans[forced].steps.iter();
                    let some: Vec<&str> =
                        steps.filter(|_| random.bool()).map(String::as_str).collect();
                    format!("({})", some.join(", "))
                }
            };
            let order = format!("{{force G{forced} {situation}}}");
            plans[by].orders.push((step, order));
        }
    }
    plans
}

impl Text<'_> {
    fn grafcet(&mut self, plans: &[Plan], at: usize) {
        let plan = &plans[at];
        let others = plans.iter().filter(|other| other.name != plan.name);
        let outer = others.flat_map(|other| other.steps.clone()).collect();
        let steps = Steps { own: plan.steps.clone(), outer };
        let actions = self.random.usize(..4);
        for (number, name) in steps.own.iter().enumerate() {
            let is_initial =
                number == 0 || !matches!(plan.kind, Kind::Expansion(_)) && self.random.u8(..6) == 0;
            // What is enclosed or forced needs no initial step.
            let is_initial =
                is_initial && !(matches!(plan.kind, Kind::Enclosed(_)) && self.random.u8(..3) == 0);
            let word = if is_initial { "INITIAL_STEP" } else { "STEP" };
            let mut pragmas = String::new();
            for (other, charts) in plans.iter().enumerate().filter(|(_, one)| one.owner == at) {
                match charts.kind {
                    Kind::Expansion(step) if step == number => {
                        let _ = write!(pragmas, " {{macro G{other}}}");
                    }
                    Kind::Enclosed(step) if step == number => {
                        let _ = write!(pragmas, " {{enclosing G{other}}}");
                    }
                    _ => {}
                }
            }
            if matches!(plan.kind, Kind::Enclosed(_)) && self.random.bool() {
                pragmas += " {linked}";
            }
            let _ = writeln!(self.text, "{word} {name}{pragmas}:");
            for (_, order) in plan.orders.iter().filter(|(step, _)| *step == number) {
                let _ = writeln!(self.text, "    {order}");
            }
            self.grafcet_block(at, actions, &steps);
            self.text += "END_STEP\n";
        }
        self.grafcet_transitions(&steps, matches!(plan.kind, Kind::Expansion(_)));
        for number in 0..actions {
            let _ = writeln!(self.text, "ACTION A{at}_{number}:");
            // Operators belong to conditions of the chart.
            self.is_grafcet = false;
            for _ in 0..self.random.usize(1..4) {
                self.statement(&steps);
            }
            self.is_grafcet = true;
            self.text += "END_ACTION\n";
        }
        for (other, inner) in plans.iter().enumerate().skip(1).filter(|(_, one)| one.owner == at) {
            let _ = writeln!(self.text, "ACTION {}:", inner.name);
            self.grafcet(plans, other);
            self.text += "END_ACTION\n";
        }
    }

    fn grafcet_block(&mut self, at: usize, actions: usize, steps: &Steps) {
        let mut used: Vec<(String, &str)> = Vec::new();
        for _ in 0..self.random.usize(..4) {
            let (name, qualifier) = match self.random.usize(..actions + 3).checked_sub(3) {
                Some(number) => (format!("A{at}_{number}"), self.pick(&["P", "P1", "P0"])),
                None if self.random.bool() => ("q3".to_owned(), self.pick(&["S", "R"])),
                None => (self.pick(&["q1", "q2"]).to_owned(), self.pick(&["N", "N", "L", "D"])),
            };
            // A step does not set and reset at once.
            if used
                .iter()
                .any(|(other, with)| *other == name && (name == "q3" || *with == qualifier))
            {
                continue;
            }
            let time = match qualifier {
                "L" | "D" => format!(", {}", self.time()),
                _ => String::new(),
            };
            let _ = write!(self.text, "    {name}({qualifier}{time})");
            if self.random.u8(..4) == 0 {
                let condition = self.condition(steps, 1);
                let _ = write!(self.text, " {{if {condition}}}");
            }
            if matches!(qualifier, "S" | "R" | "P" | "P1") && self.random.u8(..3) == 0 {
                let event = self.condition(steps, 1);
                let _ = write!(self.text, " {{on {event}}}");
            }
            self.text += ";\n";
            used.push((name, qualifier));
        }
    }

    /// A walk through all steps, some of them in parallel, and random transitions besides.
    fn grafcet_transitions(&mut self, steps: &Steps, is_expansion: bool) {
        let names: Vec<&str> = steps.own.iter().map(String::as_str).collect();
        let mut ends: Vec<(Vec<&str>, Vec<&str>)> = Vec::new();
        let last = names.len() - 1;
        let mut at = 0;
        let mut from = vec![names[0]];
        while at < last {
            // An expansion ends with one step.
            let most = if is_expansion { (last - at - 1).max(1) } else { last - at };
            let width = self.random.usize(1..3).min(most);
            let to = names[at + 1..=at + width].to_vec();
            ends.push((from, to.clone()));
            from = to;
            at += width;
        }
        if !is_expansion {
            ends.push((from, vec![names[0]]));
        }
        let left = if is_expansion { &names[..last] } else { &names[..] };
        for _ in 0..self.random.usize(..4) {
            ends.push((vec![self.pick(left)], vec![self.pick(&names)]));
        }
        let mut seen: Vec<(Vec<&str>, Vec<&str>)> = Vec::new();
        for (from, to) in ends {
            if seen.contains(&(from.clone(), to.clone())) {
                continue;
            }
            let (left, right) = (from.join(", "), to.join(", "));
            let _ = write!(self.text, "TRANSITION FROM ({left}) TO ({right})");
            if self.random.u8(..6) == 0 {
                let mark = self.pick(&MARKS);
                let _ = write!(self.text, " {{crossing {mark} := NOT {mark};}}");
            }
            let input = self.pick(&INPUTS);
            let condition = self.condition(steps, 0);
            // Fewer circles without a stable situation.
            let condition = match self.random.u8(..4) {
                // TRUE alone would be said to be never stable.
                0 if condition == "TRUE" => "NOT FALSE".to_owned(),
                0 => condition,
                1 => format!("R_EDGE({condition})"),
                2 => input.to_owned(),
                _ => format!("{input} AND ({condition})"),
            };
            let _ = writeln!(self.text, " := {condition}; END_TRANSITION");
            seen.push((from, to));
        }
    }

    /// An edge or a time.
    pub(super) fn operator(&mut self, steps: &Steps, depth: u32) -> String {
        let own = steps.own.iter().chain(&steps.outer).map(String::as_str).collect::<Vec<_>>();
        let step = self.pick(&own).to_owned();
        let operand = match self.random.u8(..3) {
            0 => self.condition(steps, depth),
            1 => step.clone(),
            _ => self.pick(&INPUTS).to_owned(),
        };
        match self.random.u8(..5) {
            0 => format!("R_EDGE({operand})"),
            1 => format!("F_EDGE({operand})"),
            2 => format!("({}/{step})", self.time()),
            3 => format!("({}/({operand}))", self.time()),
            _ => format!("({}/({operand})/{})", self.time(), self.time()),
        }
    }
}
