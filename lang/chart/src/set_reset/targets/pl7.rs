//! PL7 of Schneider, for TSX Micro: one section in Structured Text. It has no function blocks of
//! one's own, but operators for edges, and timers and counters that are started by instructions.
//! The text has plain names; the table at its head says which object each is.

use super::st::{causes, gates, outputs, reset, set, values};
use crate::set_reset::plan::{Cause, Device, Plan};
use crate::set_reset::variables::Kind;
use crate::sfcedit::condition::Edges;

/// `RE` and `FE` are operators.
struct Operators;

impl Edges for Operators {
    fn rising(&self, variable: &str) -> String {
        format!("RE {variable}")
    }

    fn falling(&self, variable: &str) -> String {
        format!("FE {variable}")
    }
}

/// The section with its symbols.
pub(super) fn write(plan: &Plan) -> String {
    let mut text = symbols(plan);
    text.push_str("XInit:=INIT; XReset:=RESET;\n");
    if !plan.derived.is_empty() {
        text.push_str("\n(* derived signals *)\n");
    }
    for (name, condition) in &plan.derived {
        text.push_str(&format!("{name}:={};\n", condition.st(&Operators)));
    }
    for chart in &plan.charts {
        text.push_str(&format!("\n(* chart {} *)\n", chart.name));
        text.push_str(&gates(plan, chart, &Operators));
        let (init, off) = (format!("Init{}", chart.name), format!("Reset{}", chart.name));
        for step in &chart.steps {
            let name = &step.name;
            text.push_str(&format!(
                "(* Set -Reset {name} *)\nIF ({}) THEN {name}:=TRUE; END_IF; \
                 IF ( {} ) THEN {name}:=FALSE; END_IF;\n",
                set(step, &Operators, &init),
                reset(step, &init, &off)
            ));
        }
    }
    outputs(plan, &mut text, &Operators);
    values(plan, &mut text, &Operators);
    for timer in &plan.timers {
        text.push_str(&run_timer(timer));
    }
    for counter in &plan.counters {
        text.push_str(&count(counter));
    }
    // What a counter answers is called differently.
    for counter in &plan.counters {
        text = text.replace(&format!("{}.Q", counter.name), &format!("{}.D", counter.name));
    }
    text
}

/// A bit that is on while a timer runs or a counter counts.
fn enable(device: &Device) -> String {
    format!("EN{}", device.name)
}

fn run_timer(timer: &Device) -> String {
    let (name, bit) = (&timer.name, enable(timer));
    format!(
        "\n(* timer {name}, time base 100 ms *)\n{bit}:={};\n{}\
         IF RE {bit} THEN START {name}; ELSIF FE {bit} THEN DOWN {name}; END_IF;\n",
        causes(&timer.starts).st(&Operators),
        presets(timer, &|value| tenths(value).unwrap_or_else(|| value.to_owned()))
    )
}

fn count(counter: &Device) -> String {
    let (name, bit) = (&counter.name, enable(counter));
    let word = if counter.block == "CTD" { "DOWN" } else { "UP" };
    let mut text = format!(
        "\n(* counter {name} *)\n{bit}:={};\n{}IF RE {bit} THEN {word} {name}; END_IF;\n",
        causes(&counter.starts).st(&Operators),
        presets(counter, &str::to_owned)
    );
    if !counter.resets.is_empty() {
        let reason = causes(&counter.resets).st(&Operators);
        text.push_str(&format!("IF ({reason}) THEN RESET {name}; END_IF;\n"));
    }
    text
}

fn presets(device: &Device, value: &dyn Fn(&str) -> String) -> String {
    let preset = |(written, reasons): &(String, Vec<Cause>)| {
        let reason = causes(reasons).st(&Operators);
        format!("IF ({reason}) THEN {}.P:={}; END_IF;\n", device.name, value(written))
    };
    match &device.presets[..] {
        [(only, _)] => format!("{}.P:={};\n", device.name, value(only)),
        all => all.iter().map(preset).collect(),
    }
}

/// `T#1.5s` in tenths of a second; `None` where it is no constant.
fn tenths(value: &str) -> Option<String> {
    let text = value.to_lowercase().replace('_', "");
    let mut rest = text.strip_prefix("t#").or_else(|| text.strip_prefix("time#"))?;
    let mut ms = 0.0;
    while !rest.is_empty() {
        let digits = rest.find(|c: char| !(c.is_ascii_digit() || c == '.'))?;
        let number: f64 = rest.get(..digits)?.parse().ok()?;
        rest = rest.get(digits..)?;
        let units = [("ms", 1.0), ("s", 1e3), ("m", 6e4), ("h", 3.6e6), ("d", 8.64e7)];
        let (unit, factor) = units.into_iter().find(|(unit, _)| rest.starts_with(unit))?;
        ms += number * factor;
        rest = rest.get(unit.len()..)?;
    }
    Some(format!("{}", (ms / 100.0).round()))
}

/// Gives objects of a kind one after the other.
#[derive(Default)]
struct Objects {
    text: String,
    bits: usize,
    words: usize,
    inputs: usize,
    outputs: usize,
    input_words: usize,
    output_words: usize,
    constants: usize,
    timers: usize,
    counters: usize,
}

impl Objects {
    fn line(&mut self, object: &str, name: &str, of_type: &str) {
        self.text.push_str(&format!("   {object:<8} {name} : {of_type}\n"));
    }

    fn bit(&mut self, name: &str) {
        let object = format!("%M{}", self.bits);
        self.bits += 1;
        self.line(&object, name, "BOOL");
    }

    /// Memory of a type: a double word takes two.
    fn memory(&mut self, name: &str, of_type: &str) {
        let (letter, size) = match of_type {
            "BOOL" => return self.bit(name),
            "INT" | "WORD" => ("%MW", 1),
            "REAL" => ("%MF", 2),
            _ => ("%MD", 2),
        };
        self.words += self.words % size;
        let object = format!("{letter}{}", self.words);
        self.words += size;
        self.line(&object, name, of_type);
    }

    fn point(&mut self, kind: Kind, name: &str, of_type: &str) {
        let (module, letter) = if kind == Kind::Input { (1, "I") } else { (2, "Q") };
        let is_bit = of_type == "BOOL";
        let count = match (kind, is_bit) {
            (Kind::Input, true) => &mut self.inputs,
            (Kind::Input, false) => &mut self.input_words,
            (_, true) => &mut self.outputs,
            (_, false) => &mut self.output_words,
        };
        let word = if is_bit { "" } else { "W" };
        let object = format!("%{letter}{word}{module}.{count}");
        *count += 1;
        self.line(&object, name, of_type);
    }
}

fn symbols(plan: &Plan) -> String {
    let mut objects = Objects::default();
    for step in plan.charts.iter().flat_map(|chart| &chart.steps) {
        objects.bit(&step.name);
    }
    let known = |name: &str| plan.variables.iter().any(|one| one.name.eq_ignore_ascii_case(name));
    for name in ["INIT", "RESET", "XInit", "XReset"].into_iter().filter(|name| !known(name)) {
        objects.bit(name);
    }
    for chart in &plan.charts {
        objects.bit(&format!("Init{}", chart.name));
        objects.bit(&format!("Reset{}", chart.name));
    }
    for device in plan.timers.iter().chain(&plan.counters) {
        objects.bit(&enable(device));
    }
    for one in &plan.variables {
        let (name, of_type) = (&one.name, &one.of_type);
        match one.kind {
            Kind::Input | Kind::Output => objects.point(one.kind, name, of_type),
            Kind::Timer => {
                let object = format!("%TM{}", objects.timers);
                objects.timers += 1;
                objects.line(&object, name, of_type);
            }
            Kind::Counter => {
                let object = format!("%C{}", objects.counters);
                objects.counters += 1;
                objects.line(&object, name, of_type);
            }
            Kind::System => objects.line("%S", name, of_type),
            Kind::Constant => {
                let object = format!("%KW{}", objects.constants);
                objects.constants += 1;
                objects.line(&object, name, of_type);
            }
            Kind::Signal if super::st::is_gate(plan, name) => {}
            Kind::Signal | Kind::Memory => objects.memory(name, of_type),
        }
    }
    format!("(* objects of the symbols\n{}*)\n\n", objects.text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::set_reset::targets::st::any;
    use crate::sfcedit::condition::Condition;

    #[test]
    fn durations_are_counted_in_tenths_of_a_second() {
        assert_eq!(tenths("T#5s").as_deref(), Some("50"));
        assert_eq!(tenths("TIME#1m30s500ms").as_deref(), Some("905"));
        assert_eq!(tenths("t#1.5s").as_deref(), Some("15"));
        assert_eq!(tenths("Delay"), None);
        assert_eq!(tenths("T#5x"), None);
    }

    #[test]
    fn edges_are_operators() {
        let both = any(vec![Condition::Rising("a".into()), Condition::Falling("b".into())]);
        assert_eq!(both.st(&Operators), "RE a OR FE b");
    }
}
