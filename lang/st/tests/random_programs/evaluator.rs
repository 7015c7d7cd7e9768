//! A naive evaluator of the syntax tree, written from docs/structured-text.md alone: it looks up
//! every name and every type when it gets there. It uses nothing of the compiler but the parser.

use std::collections::{HashMap, HashSet};

use super::coarse::Coarse;
use super::texts;
use super::values::{Kind, Value, as_type, binary, convert, shift, unary, whole};
use st::tree::{
    Argument, BinaryOperator, CaseArm, Expression, ExpressionKind, File, Name, Section,
    SectionKind, Selector, Statement, StatementKind, TypeTextKind, UnaryOperator, Unit, UnitKind,
};

/// What a statement leaves.
enum Flow {
    On,
    Exit,
    Continue,
    Return,
}

/// A program that is being evaluated.
pub struct Evaluator {
    pub(super) file: File,
    /// Variables by their full name, upper case.
    pub values: HashMap<String, Value>,
    /// Bounds of arrays by their full name.
    pub(super) bounds: HashMap<String, Vec<(i64, i64)>>,
    /// Arrays and structures.
    pub(super) wholes: HashSet<String>,
    /// Variables that have only some of the numbers of their type.
    pub(super) ranges: HashMap<String, (i64, i64)>,
    /// How many characters the texts have at most.
    pub(super) rooms: HashMap<String, usize>,
    /// The types of instances by their full name.
    pub(super) instances: HashMap<String, String>,
    /// Enumerations: their values by name.
    enumerators: HashMap<String, i64>,
    /// For timers and edges: what they remember, by instance.
    since: HashMap<String, Option<u64>>,
    was_on: HashMap<String, bool>,
    /// Timers that need not be exact, by instance.
    pub(super) coarse: HashMap<String, Coarse>,
    pub(super) now: u64,
}

pub(super) fn upper(text: &str) -> String {
    text.to_uppercase()
}

impl Evaluator {
    pub fn new(file: File) -> Evaluator {
        let mut evaluator = Evaluator {
            file: file.clone(),
            values: HashMap::new(),
            bounds: HashMap::new(),
            wholes: HashSet::new(),
            ranges: HashMap::new(),
            rooms: HashMap::new(),
            instances: HashMap::new(),
            enumerators: HashMap::new(),
            since: HashMap::new(),
            was_on: HashMap::new(),
            coarse: HashMap::new(),
            now: 0,
        };
        for declared in &file.types {
            if let TypeTextKind::Enumeration(values) = &declared.of_type.kind {
                for (at, (name, _)) in (0i64..).zip(values) {
                    evaluator.enumerators.insert(upper(&name.text), at);
                }
            }
        }
        for section in &file.globals {
            evaluator.declare(section, "");
        }
        for unit in &file.units {
            if matches!(unit.kind, UnitKind::Program) {
                for section in &unit.sections {
                    evaluator.declare(section, &upper(&unit.name.text));
                }
            }
        }
        evaluator
    }

    pub(super) fn declare(&mut self, section: &Section, prefix: &str) {
        for declared in &section.declarations {
            for name in &declared.names {
                let full = join(prefix, &name.text);
                self.declare_one(&full, &declared.of_type, declared.initial.as_ref());
                if declared.coarse.is_some() {
                    self.coarse.insert(full, Coarse::default());
                }
            }
        }
    }

    pub(super) fn unit(&self, name: &str) -> Option<Unit> {
        self.file.units.iter().find(|unit| upper(&unit.name.text) == name).cloned()
    }

    /// One scan that begins at a time.
    pub fn scan(&mut self, now: u64) {
        self.values.insert("MAIN.FIRST".to_owned(), Value::Bool(now == 0));
        self.now = now;
        self.go_on();
        for unit in self.file.units.clone() {
            if matches!(unit.kind, UnitKind::Program) {
                self.run(&unit.body, &upper(&unit.name.text));
            }
        }
    }

    /// Timers that run show the time since they began, whether or not they are called.
    fn go_on(&mut self) {
        for (instance, block) in self.instances.clone() {
            if self.coarse.contains_key(&instance) {
                self.steps_at_scan_start(&block, &instance);
                continue;
            }
            let Some(began) = self.since.get(&instance).copied().flatten() else { continue };
            let (on, q) = (self.bit(&instance, "IN"), self.bit(&instance, "Q"));
            let runs = match block.as_str() {
                "TON" => on && !q,
                "TOF" => !on && q,
                _ => q,
            };
            if runs {
                self.set(&instance, "ET", Value::Open((self.now - began) as i64));
            }
        }
    }

    fn run(&mut self, body: &[Statement], prefix: &str) -> Flow {
        for statement in body {
            match self.statement(statement, prefix) {
                Flow::On => {}
                other => return other,
            }
        }
        Flow::On
    }

    fn statement(&mut self, statement: &Statement, prefix: &str) -> Flow {
        match &statement.kind {
            StatementKind::Assign(target, value) => {
                let place = self.place(target, prefix);
                self.give(value, prefix, &place);
            }
            StatementKind::Call(target, arguments) => self.call(target, arguments, prefix),
            StatementKind::If(arms, otherwise) => {
                for (condition, body) in arms {
                    if self.is_true(condition, prefix) {
                        return self.run(body, prefix);
                    }
                }
                return self.run(otherwise, prefix);
            }
            StatementKind::Case(selector, arms, otherwise) => {
                return self.case(selector, arms, otherwise, prefix);
            }
            StatementKind::For(one) => return self.for_loop(one, prefix),
            StatementKind::While(condition, body) => {
                while self.is_true(condition, prefix) {
                    match self.run(body, prefix) {
                        Flow::Exit => break,
                        Flow::Return => return Flow::Return,
                        Flow::On | Flow::Continue => {}
                    }
                }
            }
            StatementKind::Repeat(body, condition) => loop {
                match self.run(body, prefix) {
                    Flow::Exit => break,
                    Flow::Return => return Flow::Return,
                    Flow::On | Flow::Continue => {}
                }
                if self.is_true(condition, prefix) {
                    break;
                }
            },
            StatementKind::Exit => return Flow::Exit,
            StatementKind::Continue => return Flow::Continue,
            StatementKind::Return => return Flow::Return,
            other => panic!("no text has {other:?}"),
        }
        Flow::On
    }

    /// Writes a value, or all of an array or structure, to a place.
    fn give(&mut self, value: &Expression, prefix: &str, place: &str) {
        if self.wholes.contains(place) {
            let from = self.place(value, prefix);
            self.copy_whole(&from, place);
            return;
        }
        let value = self.expression(value, prefix);
        self.write(place, value);
    }

    fn is_true(&mut self, condition: &Expression, prefix: &str) -> bool {
        self.expression(condition, prefix) == Value::Bool(true)
    }

    fn case(
        &mut self,
        selector: &Expression,
        arms: &[CaseArm],
        otherwise: &[Statement],
        prefix: &str,
    ) -> Flow {
        let value = whole(&self.expression(selector, prefix));
        for arm in arms {
            for (low, high) in &arm.labels {
                let low = whole(&self.expression(low, prefix));
                let high = high.as_ref().map_or(low, |high| whole(&self.expression(high, prefix)));
                if (low..=high).contains(&value) {
                    return self.run(&arm.body, prefix);
                }
            }
        }
        self.run(otherwise, prefix)
    }

    fn for_loop(&mut self, one: &st::tree::ForLoop, prefix: &str) -> Flow {
        let from = self.expression(&one.from, prefix);
        let to = whole(&self.expression(&one.to, prefix));
        let by = one.by.as_ref().map_or(1, |by| whole(&self.expression(by, prefix)));
        let place = self.place(&one.variable, prefix);
        let to = self.ranges.get(&place).map_or(to, |&(low, high)| to.clamp(low, high));
        self.write(&place, from);
        let is_past = |value: i64| if by > 0 { value > to } else { value < to };
        if is_past(whole(&self.values[&place])) {
            return Flow::On;
        }
        loop {
            match self.run(&one.body, prefix) {
                Flow::Exit => return Flow::On,
                Flow::Return => return Flow::Return,
                Flow::On | Flow::Continue => {}
            }
            let next = whole(&self.values[&place]) + by;
            if is_past(next) {
                return Flow::On;
            }
            self.write(&place, Value::Open(next));
        }
    }

    /// The full name of a variable.
    fn place(&mut self, target: &Expression, prefix: &str) -> String {
        let ExpressionKind::Variable(name, selectors) = &target.kind else {
            panic!("not evaluated: {target:?}")
        };
        self.named(name, selectors, prefix)
    }

    fn named(&mut self, name: &Name, selectors: &[Selector], prefix: &str) -> String {
        let local = join(prefix, &name.text);
        let is_local = self.values.contains_key(&local)
            || self.bounds.contains_key(&local)
            || self.wholes.contains(&local)
            || self.instances.contains_key(&local);
        let mut full = if is_local { local } else { upper(&name.text) };
        for selector in selectors {
            match selector {
                Selector::Field(field) => full = join(&full, &field.text),
                Selector::Index(indexes) => {
                    let bounds = self.bounds[&full].clone();
                    let mut at = 0;
                    for (index, (low, high)) in indexes.iter().zip(bounds) {
                        let index = whole(&self.expression(index, prefix)).clamp(low, high);
                        at = at * (high - low + 1) + index - low;
                    }
                    full = format!("{full}[{at}]");
                }
            }
        }
        full
    }

    pub(super) fn write(&mut self, place: &str, value: Value) {
        let value = match self.ranges.get(place) {
            Some(&(low, high)) => Value::Open(whole(&value).clamp(low, high)),
            None => value,
        };
        let slot = self.values.get_mut(place).unwrap_or_else(|| panic!("no {place}"));
        *slot = match (&*slot, value) {
            (&Value::Number(kind, _), Value::Number(_, value) | Value::Open(value)) => {
                Value::Number(kind, value)
            }
            (Value::Real(_), Value::Number(_, value) | Value::Open(value)) => {
                Value::Real(value as f32)
            }
            (Value::Bool(_), Value::Open(value)) => Value::Bool(value != 0),
            (_, Value::Text(mut text)) => {
                text.truncate(self.rooms[place]);
                Value::Text(text)
            }
            (_, value) => value,
        };
    }

    fn call(&mut self, target: &Expression, arguments: &[Argument], prefix: &str) {
        let instance = self.place(target, prefix);
        let block = self.instances[&instance].clone();
        let unit = self.unit(&block);
        let order: Vec<String> = match &unit {
            Some(unit) => unit
                .sections
                .iter()
                .filter(|section| matches!(section.kind, SectionKind::Input | SectionKind::InOut))
                .flat_map(|section| &section.declarations)
                .flat_map(|declared| &declared.names)
                .map(|name| upper(&name.text))
                .collect(),
            None => standard_variables(&block).iter().map(|(name, _)| (*name).to_owned()).collect(),
        };
        let mut given: Vec<(String, &Argument)> = Vec::new();
        for (at, argument) in arguments.iter().enumerate() {
            let name = argument.name.as_ref().map(|name| upper(&name.text));
            given.push((name.unwrap_or_else(|| order[at].clone()), argument));
        }
        for name in &order {
            for (_, argument) in
                given.iter().filter(|(one, one_of)| one == name && !one_of.is_output)
            {
                let parameter = format!("{instance}.{name}");
                self.give(&argument.value, prefix, &parameter);
            }
        }
        match unit {
            Some(unit) => drop(self.run(&unit.body, &instance)),
            None => self.standard_block(&block, &instance),
        }
        let is_in_out = |name: &str| {
            let unit = self.unit(&block);
            let sections = unit.iter().flat_map(|unit| unit.sections.iter());
            let mut names = sections
                .filter(|section| section.kind == SectionKind::InOut)
                .flat_map(|section| &section.declarations)
                .flat_map(|declared| declared.names.clone())
                .collect::<Vec<_>>();
            names.retain(|one| upper(&one.text) == name);
            !names.is_empty()
        };
        let back: Vec<(String, &Argument)> =
            given.iter().filter(|(name, one)| one.is_output || is_in_out(name)).cloned().collect();
        for (name, argument) in back {
            let parameter = format!("{instance}.{name}");
            let place = self.place(&argument.value, prefix);
            if self.wholes.contains(&place) {
                self.copy_whole(&parameter, &place);
                continue;
            }
            let value = self.values[&parameter].clone();
            self.write(&place, value);
        }
    }

    pub(super) fn bit(&self, instance: &str, name: &str) -> bool {
        self.values[&format!("{instance}.{name}")] == Value::Bool(true)
    }

    pub(super) fn set(&mut self, instance: &str, name: &str, value: Value) {
        self.write(&format!("{instance}.{name}"), value);
    }

    /// Timers by the time at which they began, not by counting.
    fn standard_block(&mut self, block: &str, instance: &str) {
        let was_on = self.was_on.get(instance).copied().unwrap_or(false);
        let number =
            |evaluator: &Self, name: &str| whole(&evaluator.values[&format!("{instance}.{name}")]);
        match block {
            "TON" | "TOF" if self.coarse.contains_key(instance) => {
                self.coarse_timer(block, instance);
            }
            "TON" | "TOF" | "TP" => self.timer(block, instance, was_on),
            "R_TRIG" => {
                let clk = self.bit(instance, "CLK");
                self.set(instance, "Q", Value::Bool(clk && !was_on));
                self.was_on.insert(instance.to_owned(), clk);
            }
            "CTU" => {
                let (cu, reset) = (self.bit(instance, "CU"), self.bit(instance, "R"));
                let count = number(self, "CV");
                let next = match (reset, cu && !was_on) {
                    (true, _) => 0,
                    (false, true) => (count + 1).min(32767),
                    _ => count,
                };
                self.set(instance, "CV", Value::Open(next));
                let preset = number(self, "PV");
                self.set(instance, "Q", Value::Bool(next >= preset));
                self.was_on.insert(instance.to_owned(), cu);
            }
            other => panic!("not evaluated: {other}"),
        }
    }

    fn timer(&mut self, block: &str, instance: &str, was_on: bool) {
        let on = self.bit(instance, "IN");
        let preset = whole(&self.values[&format!("{instance}.PT")]);
        let began = self.since.get(instance).copied().flatten();
        let passed = began.map(|began| (self.now - began) as i64);
        let (mut began, mut q, mut elapsed) = (began, false, 0);
        match block {
            "TON" => {
                if on && !was_on {
                    began = Some(self.now);
                }
                if on {
                    let passed = if was_on { passed.unwrap_or(0) } else { 0 };
                    q = passed >= preset;
                    elapsed = passed.min(preset);
                }
            }
            "TOF" => {
                if !on && was_on {
                    began = Some(self.now);
                }
                if on {
                    q = true;
                } else if let Some(began) = began {
                    let passed = (self.now - began) as i64;
                    q = passed < preset;
                    elapsed = passed.min(preset);
                }
            }
            _ => {
                let was_q = self.bit(instance, "Q");
                let is_over = began.is_some_and(|began| (self.now - began) as i64 >= preset);
                if on && !was_on && !was_q {
                    began = Some(self.now);
                    q = preset > 0;
                } else if was_q {
                    q = !is_over;
                }
                if let Some(began) = began {
                    elapsed = ((self.now - began) as i64).min(preset);
                }
                if !q && !on {
                    (elapsed, began) = (0, None);
                }
            }
        }
        self.since.insert(instance.to_owned(), began);
        self.was_on.insert(instance.to_owned(), on);
        self.set(instance, "Q", Value::Bool(q));
        self.set(instance, "ET", Value::Open(elapsed));
    }

    pub(super) fn expression(&mut self, expression: &Expression, prefix: &str) -> Value {
        match &expression.kind {
            ExpressionKind::Integer(value) => Value::Open(*value),
            ExpressionKind::Real(value) => Value::Real(*value),
            ExpressionKind::Bool(value) => Value::Bool(*value),
            ExpressionKind::Text(text) => Value::Text(text.clone()),
            ExpressionKind::Duration(ms) => Value::Number(Kind::Time, *ms),
            ExpressionKind::Typed(name, value) => {
                let value = self.expression(value, prefix);
                as_type(value, &upper(name))
            }
            ExpressionKind::Variable(name, selectors) => {
                if let Some(value) = self.enumerators.get(&upper(&name.text)) {
                    return Value::Number(Kind::Int, *value);
                }
                let place = self.named(name, selectors, prefix);
                self.values.get(&place).unwrap_or_else(|| panic!("no {place}")).clone()
            }
            ExpressionKind::Unary(operator, operand) => {
                let value = self.expression(operand, prefix);
                unary(*operator, value)
            }
            ExpressionKind::Binary(operator, left, right) => {
                let left = self.expression(left, prefix);
                let right = self.expression(right, prefix);
                binary(*operator, left, right)
            }
            ExpressionKind::Call(name, arguments) => self.function(name, arguments, prefix),
            other => panic!("not evaluated: {other:?}"),
        }
    }

    fn function(&mut self, name: &Name, arguments: &[Argument], prefix: &str) -> Value {
        // Names of standard functions here are in the order of the alphabet.
        let mut arguments: Vec<&Argument> = arguments.iter().collect();
        arguments.sort_by_key(|one| one.name.as_ref().map(|name| upper(&name.text)));
        let values: Vec<Value> =
            arguments.iter().map(|one| self.expression(&one.value, prefix)).collect();
        let name = upper(&name.text);
        if let Some(unit) = self.unit(&name) {
            return self.own_function(&unit, &values);
        }
        let to = name.strip_prefix("TO_").or_else(|| Some(name.split_once("_TO_")?.1));
        if let Some(to) = to {
            return convert(values[0].clone(), to);
        }
        let best = |better: BinaryOperator| {
            let is_better =
                |a: &Value, b: &Value| binary(better, a.clone(), b.clone()) == Value::Bool(true);
            values.iter().fold(&values[0], |best, next| match is_better(next, best) {
                true => next,
                false => best,
            })
        };
        match (name.as_str(), values.as_slice()) {
            ("ABS", [Value::Real(value)]) => Value::Real(value.abs()),
            ("ABS", [value]) if whole(value) < 0 => unary(UnaryOperator::Minus, value.clone()),
            ("ABS", [value]) => value.clone(),
            ("MIN", _) => best(BinaryOperator::Less).clone(),
            ("MAX", _) => best(BinaryOperator::Greater).clone(),
            ("SEL", [which, no, yes]) => {
                if *which == Value::Bool(true) {
                    yes.clone()
                } else {
                    no.clone()
                }
            }
            ("SHL" | "SHR" | "ROL" | "ROR", [value, count]) => {
                shift(&name, value.clone(), whole(count))
            }
            _ => texts::function(&name, &values),
        }
    }

    fn own_function(&mut self, unit: &Unit, values: &[Value]) -> Value {
        let UnitKind::Function(result) = &unit.kind else { panic!("no function") };
        let prefix = upper(&unit.name.text);
        for section in &unit.sections {
            self.declare(section, &prefix);
        }
        let name = join(&prefix, &unit.name.text);
        self.declare_one(&name, result, None);
        let inputs = unit.sections.iter().filter(|section| section.kind == SectionKind::Input);
        let names = inputs.flat_map(|section| &section.declarations).flat_map(|one| &one.names);
        for (name, value) in names.zip(values) {
            self.write(&join(&prefix, &name.text), value.clone());
        }
        self.run(&unit.body, &prefix);
        self.values[&name].clone()
    }
}

pub(super) fn join(prefix: &str, name: &str) -> String {
    match prefix {
        "" => upper(name),
        prefix => format!("{prefix}.{}", upper(name)),
    }
}

pub(super) fn standard_variables(name: &str) -> &'static [(&'static str, &'static str)] {
    match name {
        "TON" | "TOF" | "TP" => &[("IN", "BOOL"), ("PT", "TIME"), ("Q", "BOOL"), ("ET", "TIME")],
        "CTU" => &[("CU", "BOOL"), ("R", "BOOL"), ("PV", "INT"), ("Q", "BOOL"), ("CV", "INT")],
        "R_TRIG" => &[("CLK", "BOOL"), ("Q", "BOOL")],
        _ => &[],
    }
}

pub(super) fn number(kind: &ExpressionKind) -> i64 {
    match kind {
        ExpressionKind::Integer(value) => *value,
        other => panic!("no number: {other:?}"),
    }
}
