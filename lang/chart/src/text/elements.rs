//! Reads the elements of a chart: steps, transitions, actions. Names are resolved when all
//! elements are there.

use std::collections::{BTreeSet, HashMap};

use awl_asm::suggest::nearest;
use diagnostics::Span;
use st::lexer::Kind;

use super::reader::{Begin, Reader};
use crate::diagnostic::{Code as ErrorCode, Diagnostic};
use crate::model::{
    Action, ActionId, Body, Chart, Code, Instance, Origin, Qualifier, Step, StepId, Transition,
    TransitionId,
};

/// A name in the text.
type Name = (String, Span);

/// Names that are resolved at the end.
#[derive(Default)]
struct Open {
    /// Of each transition the steps before and after it.
    sides: Vec<(TransitionId, Vec<Name>, Vec<Name>)>,
    /// The actions of instances, by step and number.
    instances: Vec<(StepId, usize, Name)>,
}

/// Words that end a chart or begin something else.
const BOUNDARIES: [&str; 10] = [
    "END_ACTION",
    "PROGRAM",
    "END_PROGRAM",
    "FUNCTION_BLOCK",
    "END_FUNCTION_BLOCK",
    "FUNCTION",
    "END_FUNCTION",
    "TYPE",
    "VAR_GLOBAL",
    "END_VAR",
];
/// How deep charts can be in actions of charts.
const DEPTH_MAX: u32 = 20;

impl Reader<'_> {
    /// The elements of a chart, up to what is none.
    pub(super) fn elements(&mut self, chart: &mut Chart, standard: Option<Span>) {
        let mut open = Open::default();
        self.pragmas.retain(|span| Some(*span) != standard);
        loop {
            match self.begins() {
                Some(Begin::Step { is_initial }) => self.step_here(chart, is_initial, &mut open),
                Some(Begin::Transition) => self.transition_here(chart, &mut open),
                Some(Begin::Action) => self.action_here(chart),
                None if self.take_sign(";") => {}
                None if self.is_boundary() => break,
                None => self.outside(),
            }
        }
        self.resolve(chart, open);
    }

    fn is_boundary(&self) -> bool {
        self.is_at_end() || BOUNDARIES.iter().any(|word| self.is_word(word))
    }

    fn is_end_of_element(&self) -> bool {
        let ends = ["END_STEP", "END_TRANSITION"];
        self.is_boundary() || self.begins().is_some() || ends.iter().any(|word| self.is_word(word))
    }

    /// Reports what is no element, up to where one begins.
    fn outside(&mut self) {
        let token = self.step();
        let text = short(token.span.text(self.text));
        let message = format!("`{text}`: a step, a transition or an action is expected here");
        let help = "such as `STEP Fill: Valve; END_STEP`; statements are in actions";
        self.report(Diagnostic::new(ErrorCode::Syntax, token.span, message).help(help));
        while !self.is_boundary() && self.begins().is_none() {
            self.step();
        }
    }

    /// Goes on where the element ends.
    fn skip_element(&mut self) {
        while !self.is_end_of_element() {
            self.step();
        }
    }

    /// Goes on after the next `;`, or where the element ends.
    fn skip_instance(&mut self) {
        while !self.is_end_of_element() && !self.take_sign(";") {
            self.step();
        }
    }

    pub(super) fn expected(&mut self, what: &str) {
        let token = self.token();
        let message = match token.kind {
            Kind::End => format!("{what} is missing at the end of the text"),
            _ => format!("`{}`: {what} is expected here", short(token.span.text(self.text))),
        };
        self.report(Diagnostic::new(ErrorCode::Syntax, token.span, message));
    }

    /// Takes the word that ends an element, or reports that it is missing.
    fn end(&mut self, word: &str, opened: Span) {
        while self.take_sign(";") {}
        if self.take_word(word) {
            self.take_sign(";");
            return;
        }
        if !self.is_end_of_element() {
            self.expected(word);
            self.skip_element();
            if self.take_word(word) {
                self.take_sign(";");
                return;
            }
        }
        let end = self.end_before();
        let span = Span::new(end.saturating_sub(1), end);
        let found = Diagnostic::new(ErrorCode::Missing, span, format!("`{word}` is missing"));
        let found = found.label(format!("`{word}` belongs after this"));
        self.report(found.related(opened, "for this one"));
        // The end of another element is taken for this one's.
        if ["END_STEP", "END_TRANSITION"].iter().any(|other| self.is_word(other)) {
            self.step();
        }
    }

    fn name(&mut self) -> Option<Name> {
        let token = self.token();
        if token.kind != Kind::Word || self.is_end_of_element() {
            self.expected("a name");
            return None;
        }
        self.step();
        Some((token.span.text(self.text).to_owned(), token.span))
    }

    /// Code from here to where `is_end` says; without the space around it.
    fn code(&mut self, is_end: impl Fn(&Self, u32) -> bool) -> Option<Code> {
        let pragmas = self.pragmas_here();
        self.pending_pragmas.extend(pragmas);
        let start = self.token().span.start as usize;
        let first = self.at;
        let mut depth = 0u32;
        while !self.is_end_of_element() && !is_end(self, depth) {
            match self.token().kind {
                Kind::Sign("(" | "[") => depth += 1,
                Kind::Sign(")" | "]") => depth = depth.saturating_sub(1),
                _ => {}
            }
            self.at += 1;
        }
        if self.at == first {
            return None;
        }
        let span = Span::new(start, self.end_before());
        Some(Code { text: span.text(self.text).to_owned(), origin: Origin(span) })
    }

    /// The comments of an element that was read, without their signs.
    fn comment(&mut self) -> String {
        let lines: Vec<String> =
            self.pending.drain(..).map(|span| plain(span.text(self.text))).collect();
        lines.join("\n")
    }

    fn step_here(&mut self, chart: &mut Chart, is_initial: bool, open: &mut Open) {
        let opened = self.step().span;
        let Some((name, span)) = self.name() else { return };
        let mut step = Step { name, is_initial, origin: Origin(span), ..Step::default() };
        let mut names = Vec::new();
        self.take_sign(":");
        while !self.is_end_of_element() {
            if self.take_sign(";") {
                continue;
            }
            let Some((name, instance)) = self.instance() else {
                self.skip_instance();
                continue;
            };
            names.push(name);
            step.block.push(instance);
            if !self.take_sign(";") && !self.is_word("END_STEP") {
                self.expected("`;`");
                self.skip_instance();
            }
            self.step_pragmas(&mut step);
        }
        self.end("END_STEP", opened);
        self.step_pragmas(&mut step);
        step.comment = self.comment();
        let id = chart.add_step(step);
        open.instances.extend((0..).zip(names).map(|(at, name)| (id, at, name)));
    }

    /// `Valve`, `Valve(N)`, `Lamp(L, T#2s)`
    fn instance(&mut self) -> Option<(Name, Instance)> {
        let start = self.token().span;
        let kind = self.token().kind;
        if !matches!(kind, Kind::Word | Kind::Address) {
            self.expected("an action");
            return None;
        }
        self.step();
        while self.is_sign(".") || self.is_sign("[") {
            self.step();
            while self.ahead(0).kind == Kind::Integer && self.ahead(1).kind == Kind::Sign("]") {
                self.step();
            }
            self.step();
        }
        let span = Span::new(start.start as usize, self.end_before());
        let text = span.text(self.text).to_owned();
        let mut instance = Instance::new(ActionId(0));
        instance.origin = Origin(span);
        if self.take_sign("(") {
            self.qualified(&mut instance);
            if !self.take_sign(")") {
                self.expected("`)`");
                return None;
            }
        }
        Some(((text, span), instance))
    }

    /// Qualifier and time, between the brackets.
    fn qualified(&mut self, instance: &mut Instance) {
        let token = self.token();
        if token.kind == Kind::Word {
            self.step();
            let text = token.span.text(self.text);
            match Qualifier::find(text) {
                Some(found) => instance.qualifier = found,
                None => self.unknown_qualifier(text, token.span),
            }
        }
        let is_end = |reader: &Self, depth: u32| {
            depth == 0 && (reader.is_sign(")") || reader.is_sign(",") || reader.is_sign(";"))
        };
        if self.take_sign(",") {
            instance.time = self.code(is_end);
            if instance.time.is_none() {
                self.expected("a time");
            }
        }
        let name = instance.qualifier.text();
        match (&instance.time, instance.qualifier.has_time()) {
            (None, true) => {
                let message = format!("{name}: this qualifier needs a time");
                let found = Diagnostic::new(ErrorCode::BadQualifier, token.span, message);
                self.report(found.help(format!("such as `({name}, T#2s)`")));
            }
            (Some(time), false) => {
                let message = format!("{name}: this qualifier has no time");
                let span = time.origin.0;
                let found = Diagnostic::new(ErrorCode::BadQualifier, span, message);
                self.report(found.help("L, D, SD, DS and SL have one"));
            }
            _ => {}
        }
        if self.is_sign(",") {
            let span = self.step().span;
            let indicator = self.code(is_end).map_or(span, |code| code.origin.0);
            let message = "indicator variables are not there";
            let found = Diagnostic::new(ErrorCode::NotThere, indicator, message);
            self.report(found.help("conditions can ask for the variable itself"));
        }
    }

    fn unknown_qualifier(&mut self, text: &str, span: Span) {
        let names = Qualifier::ALL.map(Qualifier::text);
        let message = format!("{text}: there is no such qualifier");
        let mut found = Diagnostic::new(ErrorCode::BadQualifier, span, message)
            .help(format!("there are {}", names.join(" ")));
        found.suggestion = nearest(text, names.iter().copied()).map(str::to_owned);
        self.report(found);
    }

    fn transition_here(&mut self, chart: &mut Chart, open: &mut Open) {
        let opened = self.step().span;
        let mut transition = Transition { origin: Origin(opened), ..Transition::default() };
        if self.token().kind == Kind::Word && !self.is_word("FROM") {
            let token = self.step();
            transition.origin = Origin(token.span);
            transition.name = Some(token.span.text(self.text).to_owned());
        }
        if self.take_sign("(") {
            transition.priority = self.priority();
        }
        let from = self.side("FROM");
        let to = if from.is_empty() { Vec::new() } else { self.side("TO") };
        if to.is_empty() {
            self.skip_element();
        } else {
            self.condition(&mut transition);
        }
        self.end("END_TRANSITION", opened);
        self.transition_pragmas(&mut transition);
        transition.comment = self.comment();
        if !to.is_empty() {
            let id = chart.add_transition(transition);
            open.sides.push((id, from, to));
        }
    }

    fn condition(&mut self, transition: &mut Transition) {
        if self.is_sign(":") || self.is_sign("=") {
            let span = self.token().span;
            let message = "`:=` is between the steps and the condition";
            let found = Diagnostic::new(ErrorCode::Syntax, span, message);
            self.report(found.suggest(":="));
            self.step();
        } else if !self.take_sign(":=") {
            match self.is_word("PRIORITY") {
                true => self.misplaced_priority(),
                false => self.expected("`:=` and a condition"),
            }
            self.skip_element();
            return;
        }
        match self.code(|reader, _| reader.is_sign(";")) {
            Some(code) => transition.condition = code,
            None => self.expected("a condition"),
        }
    }

    fn misplaced_priority(&mut self) {
        let message = "PRIORITY is before the steps";
        let found = Diagnostic::new(ErrorCode::Syntax, self.token().span, message);
        self.report(found.help("such as `TRANSITION (PRIORITY := 1) FROM A TO B := Go;`"));
    }

    /// `PRIORITY := 2)`
    fn priority(&mut self) -> Option<u32> {
        let is_there = self.take_word("PRIORITY") && self.take_sign(":=");
        let token = self.token();
        let number = token.span.text(self.text).replace('_', "").parse().ok();
        if !is_there || number.is_none() {
            self.expected("`PRIORITY := ` and a number");
            while !self.is_end_of_element() && !self.is_word("FROM") {
                self.step();
            }
            return None;
        }
        self.step();
        if !self.take_sign(")") {
            self.expected("`)`");
        }
        number
    }

    /// `FROM Fill` or `FROM (Fill, Heat)`; empty where it could not be read.
    fn side(&mut self, word: &str) -> Vec<Name> {
        if !self.take_word(word) {
            self.expected(&format!("`{word}` and a step"));
            return Vec::new();
        }
        let has_brackets = self.take_sign("(");
        let mut names = Vec::new();
        loop {
            let Some(name) = self.name() else { return Vec::new() };
            names.push(name);
            if !has_brackets {
                return names;
            }
            if self.take_sign(")") {
                return names;
            }
            if !self.take_sign(",") {
                self.expected("`,` or `)`");
                return Vec::new();
            }
        }
    }

    fn action_here(&mut self, chart: &mut Chart) {
        let opened = self.step().span;
        let Some((name, span)) = self.name() else { return };
        self.take_sign(":");
        let around = std::mem::take(&mut self.pending);
        let body = if self.begins().is_some() && self.depth < DEPTH_MAX {
            let mut inner = Chart::new(name.clone());
            inner.standard = chart.standard;
            self.depth += 1;
            self.elements(&mut inner, None);
            self.depth -= 1;
            Body::Chart(Box::new(inner))
        } else {
            self.too_deep();
            Body::Code(self.statements())
        };
        self.end("END_ACTION", opened);
        // Comments in the body belong to its code and its elements.
        self.pending = around;
        let pragmas = std::mem::take(&mut self.pending_pragmas);
        pragmas.into_iter().for_each(|pragma| self.unknown_pragma(pragma, "an action"));
        let comment = self.comment();
        chart.add_action(Action { name, body, comment, origin: Origin(span) });
    }

    fn too_deep(&mut self) {
        if self.begins().is_none() {
            return;
        }
        let message = format!("more than {DEPTH_MAX} charts in each other");
        self.report(Diagnostic::new(ErrorCode::Syntax, self.token().span, message));
        while !self.is_boundary() {
            self.step();
        }
    }

    /// The statements of an action, with the comments before and after them.
    fn statements(&mut self) -> Code {
        let start = self.end_before();
        while !self.is_boundary() && self.begins().is_none() {
            self.at += 1;
        }
        let ends_here = self.is_word("END_ACTION");
        let token = self.token().span.start as usize;
        let end = if ends_here { token } else { self.end_before() };
        let raw = Span::new(start, end).text(self.text);
        let start = start + (raw.len() - raw.trim_start().len());
        let span = Span::new(start, start + raw.trim().len());
        Code { text: raw.trim().to_owned(), origin: Origin(span) }
    }

    /// Gives transitions their steps and instances their actions.
    fn resolve(&mut self, chart: &mut Chart, open: Open) {
        let mut steps: HashMap<String, StepId> = HashMap::new();
        for (id, step) in &chart.steps {
            steps.entry(step.name.to_uppercase()).or_insert(*id);
        }
        for (id, from, to) in open.sides {
            let from = self.steps(chart, &steps, from);
            let to = self.steps(chart, &steps, to);
            if let Some(transition) = chart.transitions.get_mut(&id) {
                (transition.from, transition.to) = (from, to);
            }
        }
        self.transitions_once(chart);
        let mut actions: HashMap<String, ActionId> = HashMap::new();
        for (id, action) in &chart.actions {
            actions.entry(action.name.to_uppercase()).or_insert(*id);
        }
        for (step, at, (name, span)) in open.instances {
            let action = *actions
                .entry(name.to_uppercase())
                .or_insert_with(|| chart.add_action(Action::variable(name, Origin(span))));
            let instance = chart.steps.get_mut(&step).and_then(|step| step.block.get_mut(at));
            if let Some(instance) = instance {
                instance.action = action;
            }
        }
        self.names_once(chart);
    }

    fn steps(
        &mut self,
        chart: &Chart,
        known: &HashMap<String, StepId>,
        names: Vec<Name>,
    ) -> BTreeSet<StepId> {
        let mut steps = BTreeSet::new();
        for (name, span) in names {
            let Some(&id) = known.get(&name.to_uppercase()) else {
                let message = format!("{name}: there is no step of this name");
                let mut found = Diagnostic::new(ErrorCode::UnknownStep, span, message);
                let names = chart.steps.values().map(|step| step.name.as_str());
                found.suggestion = nearest(&name, names).map(str::to_owned);
                self.report(found);
                continue;
            };
            if !steps.insert(id) {
                let message = format!("{name}: this step is on this side already");
                self.report(Diagnostic::new(ErrorCode::Duplicate, span, message));
            }
        }
        steps
    }

    /// Reports transitions between the same steps.
    fn transitions_once(&mut self, chart: &Chart) {
        let mut found: Vec<Diagnostic> = Vec::new();
        let mut first = HashMap::new();
        for one in chart.transitions.values() {
            if one.from.is_empty() || one.to.is_empty() {
                continue;
            }
            let before = *first.entry((&one.from, &one.to)).or_insert(one.origin.0);
            if before != one.origin.0 {
                let message = "there is a transition between these steps already";
                let twice = Diagnostic::new(ErrorCode::Duplicate, one.origin.0, message);
                let twice = twice.related(before, "this one");
                found.push(twice.help("one transition with `OR` between the conditions does both"));
            }
        }
        found.into_iter().for_each(|one| self.report(one));
    }
}

fn short(text: &str) -> String {
    match text.char_indices().nth(30) {
        Some((at, _)) => format!("{}...", text.get(..at).unwrap_or("")),
        None => text.to_owned(),
    }
}

/// A comment without its signs.
fn plain(text: &str) -> String {
    let inner = if let Some(line) = text.strip_prefix("//") {
        line
    } else {
        let end = text.len().saturating_sub(2).max(2);
        text.get(2..end).unwrap_or("")
    };
    inner.lines().map(str::trim).collect::<Vec<_>>().join("\n").trim().to_owned()
}
