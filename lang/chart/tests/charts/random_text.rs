//! Random charts as text: parallel branches, alternatives, all qualifiers, times that are short,
//! long and variable, conditions about other steps, charts in actions.

use std::fmt::Write;

use fastrand::Rng;

/// Inputs, outputs, counters of a random chart.
pub const INPUTS: [&str; 4] = ["a", "b", "c", "d"];
/// BOOL that steps write by qualifiers.
pub const OUTPUTS: [&str; 3] = ["q1", "q2", "q3"];
/// BOOL that statements write.
pub const MARKS: [&str; 2] = ["m1", "m2"];
/// INT that statements count.
pub const COUNTERS: [&str; 3] = ["n1", "n2", "n3"];
/// What `Limit` is, in milliseconds.
pub const LIMIT_MS: i64 = 45;

const QUALIFIERS: [&str; 11] = ["N", "S", "R", "L", "D", "P", "P0", "P1", "SD", "DS", "SL"];

/// The names of the steps of a chart and of those around.
pub(super) struct Steps {
    pub(super) own: Vec<String>,
    pub(super) outer: Vec<String>,
}

pub(super) struct Text<'r> {
    pub(super) random: &'r mut Rng,
    pub(super) text: String,
    /// Whether conditions have the operators of GRAFCET.
    pub(super) is_grafcet: bool,
}

/// A chart in a PROGRAM `Main`.
pub fn program(seed: u64) -> String {
    let mut random = Rng::with_seed(seed);
    let mut text = Text { random: &mut random, text: head(), is_grafcet: false };
    text.chart("S", &[], 0);
    text.text += "END_PROGRAM\n";
    text.text
}

/// The program up to its chart.
pub(super) fn head() -> String {
    let bits = [&INPUTS[..], &OUTPUTS, &MARKS].concat().join(", ");
    let counters = COUNTERS.join(", ");
    format!(
        "PROGRAM Main\nVAR\n    {bits} : BOOL;\n    {counters} : INT;\n    \
         Limit : TIME := T#{LIMIT_MS}ms;\nEND_VAR\n"
    )
}

impl Text<'_> {
    pub(super) fn pick<'a>(&mut self, list: &[&'a str]) -> &'a str {
        list[self.random.usize(..list.len())]
    }

    fn chart(&mut self, prefix: &str, outer: &[String], depth: u32) {
        let count = self.random.usize(2..if depth == 0 { 9 } else { 4 });
        let own: Vec<String> = (0..count).map(|n| format!("{prefix}{n}")).collect();
        let steps = Steps { own, outer: outer.to_vec() };
        let actions = self.random.usize(..4);
        for (at, name) in steps.own.iter().enumerate() {
            let word = if at == 0 { "INITIAL_STEP" } else { "STEP" };
            let _ = writeln!(self.text, "{word} {name}:");
            self.block(prefix, actions, depth);
            self.text += "END_STEP\n";
        }
        self.transitions(&steps);
        for number in 0..actions {
            let _ = writeln!(self.text, "ACTION {prefix}A{number}:");
            if depth < 2 && self.random.u8(..5) == 0 {
                let around = [steps.own.clone(), steps.outer.clone()].concat();
                self.chart(&format!("{prefix}{number}_"), &around, depth + 1);
            } else {
                for _ in 0..self.random.usize(1..4) {
                    self.statement(&steps);
                }
            }
            self.text += "END_ACTION\n";
        }
    }

    fn block(&mut self, prefix: &str, actions: usize, depth: u32) {
        let mut used: Vec<(String, &str)> = Vec::new();
        for _ in 0..self.random.usize(..4) {
            let name = match self.random.usize(..actions + 3).checked_sub(3) {
                Some(number) => format!("{prefix}A{number}"),
                // Each output belongs to one chart.
                None if depth == 0 => self.pick(&OUTPUTS).to_owned(),
                None => continue,
            };
            let qualifier = if self.random.u8(..4) == 0 { "N" } else { self.pick(&QUALIFIERS) };
            if used.contains(&(name.clone(), qualifier)) {
                continue;
            }
            let time = match qualifier {
                "L" | "D" | "SD" | "DS" | "SL" => format!(", {}", self.time()),
                _ => String::new(),
            };
            let _ = writeln!(self.text, "    {name}({qualifier}{time});");
            used.push((name, qualifier));
        }
    }

    pub(super) fn time(&mut self) -> String {
        match self.random.u8(..12) {
            0 => "Limit".to_owned(),
            1 => "T#40s".to_owned(),
            2 => "T#32s".to_owned(),
            _ => format!("T#{}ms", self.random.u32(..80)),
        }
    }

    /// A walk through all steps, some of them in parallel, and random transitions besides.
    fn transitions(&mut self, steps: &Steps) {
        let mut ends: Vec<(Vec<&str>, Vec<&str>)> = Vec::new();
        let names: Vec<&str> = steps.own.iter().map(String::as_str).collect();
        let mut at = 0;
        let mut from = vec![names[0]];
        while at + 1 < names.len() {
            let width = self.random.usize(1..3).min(names.len() - at - 1);
            let to: Vec<&str> = names[at + 1..=at + width].to_vec();
            ends.push((from, to.clone()));
            from = to;
            at += width;
        }
        ends.push((from, vec![names[0]]));
        for _ in 0..self.random.usize(..4) {
            let mut side = || {
                let mut side = vec![self.pick(&names)];
                let other = self.pick(&names);
                if self.random.u8(..4) == 0 && other != side[0] {
                    side.push(other);
                }
                side.sort_unstable();
                side
            };
            ends.push((side(), side()));
        }
        let mut seen: Vec<(Vec<&str>, Vec<&str>)> = Vec::new();
        for (from, to) in ends {
            if seen.contains(&(from.clone(), to.clone())) {
                continue;
            }
            let priority = match self.random.u8(..3) {
                0 => format!(" (PRIORITY := {})", self.random.u8(..5)),
                _ => String::new(),
            };
            let side = |side: &[&str]| match side {
                [one] => (*one).to_owned(),
                all => format!("({})", all.join(", ")),
            };
            let (left, right) = (side(&from), side(&to));
            let condition = self.condition(steps, 0);
            let _ = writeln!(
                self.text,
                "TRANSITION{priority} FROM {left} TO {right} := {condition}; END_TRANSITION"
            );
            seen.push((from, to));
        }
    }

    pub(super) fn condition(&mut self, steps: &Steps, depth: u32) -> String {
        if depth < 2 && self.random.bool() {
            let (a, b) = (self.condition(steps, depth + 1), self.condition(steps, depth + 1));
            return format!("({a} {} {b})", self.pick(&["OR", "OR", "AND", "XOR"]));
        }
        if self.is_grafcet && depth < 3 && self.random.u8(..4) == 0 {
            return self.operator(steps, depth + 1);
        }
        let all: Vec<&str> = steps.own.iter().chain(&steps.outer).map(String::as_str).collect();
        let step = self.pick(&all);
        match self.random.u8(..10) {
            0 => format!("{step}.X"),
            1 => format!("NOT {step}.X"),
            2 | 3 => {
                let relation = self.pick(&[">=", ">", "<", "<=", "="]);
                format!("{step}.T {relation} {}", self.time())
            }
            4 => format!("{} > {}", self.pick(&COUNTERS), self.random.u8(..9)),
            5 => format!("NOT {}", self.pick(&INPUTS)),
            6 => self.pick(&OUTPUTS).to_owned(),
            7 => self.pick(&MARKS).to_owned(),
            8 => "TRUE".to_owned(),
            _ => self.pick(&INPUTS).to_owned(),
        }
    }

    pub(super) fn statement(&mut self, steps: &Steps) {
        let counter = self.pick(&COUNTERS);
        let mark = self.pick(&MARKS);
        match self.random.u8(..4) {
            0 | 1 => {
                let _ = writeln!(self.text, "{counter} := {counter} + 1;");
            }
            2 => {
                let condition = self.condition(steps, 1);
                let _ = writeln!(self.text, "{mark} := {condition};");
            }
            _ => {
                let condition = self.condition(steps, 1);
                let _ = writeln!(
                    self.text,
                    "IF {condition} THEN {counter} := 0; ELSE {mark} := NOT {mark}; END_IF;"
                );
            }
        }
    }
}
