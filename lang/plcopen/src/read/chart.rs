//! A chart of a drawing: steps, transitions and action blocks in the model of all charts. Jumps are
//! lines to steps, macro-steps are replaced by what is in them.

use std::collections::{BTreeSet, HashMap};

use chart::Chart;
use chart::model::{
    Action, ActionId, Body, Code, Instance, Origin, Position, Qualifier, Step, StepId, Transition,
    TransitionId,
};
use diagnostics::Span;
use diagnostics::xml::{Node, attribute, elements, tag};
use st::names::is_same;

use super::body::{Surroundings, refuse, translated};
use super::condition::{Condition, condition};
use super::formatted::{documentation, formatted, language};
use super::macro_step::expand;
use super::network::{Network, id, lines_into, title};
use super::reader::{Reader, Text, child, is_true, optional};
use super::types::rest;
use crate::diagnostic::{Code as ErrorCode, Diagnostic};

/// Charts in each other at most, in actions and macro-steps.
const DEPTH_MAX: usize = 20;
/// Between statements of an action.
const NEXT_LINE: &str = "\n    ";
/// Which elements join the lines to a transition, and those to a step.
const TO_TRANSITIONS: [&str; 2] = ["selectionDivergence", "simultaneousConvergence"];
const TO_STEPS: [&str; 2] = ["selectionConvergence", "simultaneousDivergence"];
const STEPS: [&str; 2] = ["step", "macroStep"];

/// The chart of a unit's body; `None` where that cannot be made.
pub(super) fn chart(reader: &mut Reader, around: &Surroundings, drawing: Node) -> Option<Chart> {
    let before = reader.diagnostics.len();
    let mut chart = in_body(reader, around, drawing, around.unit, 0)?;
    initial(reader, &chart, drawing);
    actions(reader, around, &mut chart);
    let errors = reader.diagnostics.iter().skip(before);
    let is_sound = errors.filter(|one| one.code != ErrorCode::Ignored).count() == 0;
    is_sound.then_some(chart)
}

/// The chart of a drawing without the actions that have names.
pub(super) fn in_body(
    reader: &mut Reader,
    around: &Surroundings,
    drawing: Node,
    name: &str,
    depth: usize,
) -> Option<Chart> {
    if depth > DEPTH_MAX {
        let message = format!("{name}: more than {DEPTH_MAX} charts in each other");
        reader.error(
            ErrorCode::Wiring,
            tag(drawing),
            message,
            "draw the inner ones beside each other",
        );
        return None;
    }
    let told = reader.diagnostics.len();
    let network = Network::of(reader, drawing);
    let mut builder = Builder {
        reader,
        around,
        network: &network,
        chart: Chart::new(name),
        steps: HashMap::new(),
        macros: Vec::new(),
        called: HashMap::new(),
        depth,
        told,
    };
    builder.steps();
    builder.transitions();
    if depth == 0 {
        builder.named();
    }
    builder.blocks();
    builder.variables();
    builder.comments();
    let Builder { mut chart, macros, .. } = builder;
    places(&mut chart);
    for (step, inner) in macros {
        expand(reader, &mut chart, step, inner);
    }
    Some(chart)
}

/// Reports a chart without an initial step, or with several.
fn initial(reader: &mut Reader, chart: &Chart, drawing: Node) {
    let steps: Vec<&Step> = chart.initial_steps().filter_map(|id| chart.steps.get(&id)).collect();
    let help = "the step that is active at the beginning has initialStep=\"true\"";
    match &steps[..] {
        [_] => {}
        [] => {
            let message = format!("{}: there is no initial step", chart.name);
            reader.error(ErrorCode::Wiring, tag(drawing), message, help);
        }
        [first, others @ ..] => {
            for step in others {
                let message = format!("{}: a second initial step of {}", step.name, chart.name);
                let found = Diagnostic::new(ErrorCode::Wiring, step.origin.0, message);
                reader.report(found.related(first.origin.0, "the first one").help(help));
            }
        }
    }
}

/// Takes places away that say nothing: tools that lay charts out by themselves write the same for
/// all.
fn places(chart: &mut Chart) {
    let all: Vec<Position> = chart.steps.values().filter_map(|step| step.at).collect();
    let different: BTreeSet<(i32, i32)> = all.iter().map(|at| (at.x, at.y)).collect();
    if different.len() < chart.steps.len() || different.contains(&(0, 0)) && different.len() == 1 {
        chart.steps.values_mut().for_each(|step| step.at = None);
        chart.transitions.values_mut().for_each(|one| one.at = None);
    }
}

/// The middle of an element.
fn middle(node: Node) -> Option<Position> {
    let number = |node: Node, name: &str| -> Option<f64> {
        let number: f64 = attribute(node, name)?.value().trim().parse().ok()?;
        number.is_finite().then_some(number)
    };
    let position = child(node, "position")?;
    let half = |name: &str| number(node, name).unwrap_or(0.0) / 2.0;
    let (x, y) = (number(position, "x")? + half("width"), number(position, "y")? + half("height"));
    Some(Position { x: x.round() as i32, y: y.round() as i32 })
}

/// The statements of a diagram or instruction list; `None`: it is none.
fn translated_body(reader: &mut Reader, diagram: Node) -> Option<Body> {
    let codes = translated(reader, diagram)?;
    let texts: Vec<String> = codes.into_iter().map(|code| code.text).collect();
    Some(Body::Code(Code { text: texts.join(NEXT_LINE), origin: Origin(tag(diagram)) }))
}

/// The actions of a unit that have names.
fn actions(reader: &mut Reader, around: &Surroundings, chart: &mut Chart) {
    for node in around.actions() {
        let Some(name) = reader.name(node, "name") else { continue };
        let Some(found) = child(node, "body").and_then(language) else {
            let message = format!("action {}: there is no text", name.text);
            reader.error(
                ErrorCode::Incomplete,
                tag(node),
                message,
                "its statements are in <body><ST>",
            );
            continue;
        };
        let body = match found.tag_name().name() {
            "ST" => {
                let Text { text, span } = formatted(found);
                Body::Code(Code { text, origin: Origin(span) })
            }
            "SFC" => {
                let Some(inner) = in_body(reader, around, found, &name.text, 1) else { continue };
                initial(reader, &inner, found);
                Body::Chart(Box::new(inner))
            }
            _ => match translated_body(reader, found) {
                Some(body) => body,
                None => {
                    refuse(reader, found, &format!("action {}", name.text));
                    continue;
                }
            },
        };
        let comment = documentation(node);
        let origin = Origin(name.span);
        let known = chart.actions.values_mut().find(|one| is_same(&one.name, &name.text));
        match known {
            Some(action) if action.body == Body::Variable => {
                (action.body, action.comment, action.origin) = (body, comment, origin);
            }
            Some(action) => {
                let message = format!("action {} is there twice", name.text);
                let twice = Diagnostic::new(ErrorCode::Twice, name.span, message);
                let first = action.origin.0;
                reader
                    .report(twice.related(first, "this one").help("actions have different names"));
            }
            None => {
                chart.add_action(Action { name: name.text, body, comment, origin });
            }
        }
        rest(reader, node, &["body"], "an action");
    }
}

struct Builder<'b, 'f, 'a, 'i> {
    reader: &'b mut Reader<'f>,
    around: &'b Surroundings<'b, 'a, 'i>,
    network: &'b Network<'a, 'i>,
    chart: Chart,
    /// By their elements.
    steps: HashMap<Node<'a, 'i>, StepId>,
    /// What stands in the place of steps.
    macros: Vec<(StepId, Chart)>,
    /// The actions that call function blocks.
    called: HashMap<StepId, ActionId>,
    depth: usize,
    /// How much was told before.
    told: usize,
}

impl<'a, 'i> Builder<'_, '_, 'a, 'i> {
    fn of(&self, kinds: &[&str]) -> Vec<Node<'a, 'i>> {
        let all = self.network.elements.iter().copied();
        all.filter(|one| kinds.contains(&one.tag_name().name())).collect()
    }

    fn steps(&mut self) {
        for node in self.of(&STEPS) {
            let Some(name) = self.reader.name(node, "name") else { continue };
            let step = Step {
                is_initial: super::reader::is_true(node, "initialStep"),
                comment: documentation(node),
                at: middle(node),
                origin: Origin(name.span),
                name: name.text.clone(),
                ..Step::default()
            };
            if let Some(first) = self.chart.step_named(&name.text) {
                let message = format!("{}: a step of this name is there already", name.text);
                let twice = Diagnostic::new(ErrorCode::Twice, name.span, message);
                let first =
                    self.chart.steps.get(&first).map_or(Span::default(), |one| one.origin.0);
                self.reader
                    .report(twice.related(first, "this one").help("letter case does not matter"));
            }
            let step = self.chart.add_step(step);
            self.steps.insert(node, step);
            if node.tag_name().name() == "macroStep" {
                self.expansion(node, &name, step);
            }
            let known = [
                "position",
                "connectionPointIn",
                "connectionPointOut",
                "connectionPointOutAction",
                "body",
            ];
            rest(self.reader, node, &known, "a step");
        }
    }

    /// What is in a macro-step.
    fn expansion(&mut self, node: Node<'a, 'i>, name: &Text, step: StepId) {
        let body = child(node, "body").and_then(language);
        match body.filter(|body| body.tag_name().name() == "SFC") {
            Some(body) => {
                let inner = in_body(self.reader, self.around, body, &name.text, self.depth + 1);
                self.macros.extend(inner.map(|inner| (step, inner)));
            }
            None => {
                let message = format!("macro-step {}: there is no chart in it", name.text);
                let help = "its steps and transitions are in <body><SFC>";
                self.reader.error(ErrorCode::Incomplete, tag(node), message, help);
            }
        }
    }

    fn transitions(&mut self) {
        let mut made: HashMap<Node, TransitionId> = HashMap::new();
        for node in self.of(&["transition"]) {
            let sources = self.network.before(self.reader, node, &STEPS, &TO_TRANSITIONS);
            if sources.is_empty() && self.goes_nowhere(node) {
                let message = format!("{}: it is joined with nothing, and left out", title(node));
                let left = Diagnostic::new(ErrorCode::Ignored, tag(node), message);
                self.reader.report(left);
                continue;
            }
            if sources.is_empty() {
                self.loose(node, "no step is before");
            }
            let Condition { code, name, calls } =
                condition(self.reader, self.around, self.network, node);
            let first = sources.iter().find_map(|one| self.steps.get(one)).copied();
            if let Some(step) = first.filter(|_| !calls.is_empty()) {
                self.calls(step, calls);
            }
            let is_free = |name: &Text| {
                let mut all = self.chart.transitions.values().filter_map(|one| one.name.as_ref());
                !all.any(|one| is_same(one, &name.text))
            };
            let transition = Transition {
                name: name.filter(is_free).map(|name| name.text),
                from: sources.iter().filter_map(|one| self.steps.get(one)).copied().collect(),
                condition: code,
                priority: self.priority(node),
                comment: documentation(node),
                at: middle(node),
                origin: Origin(tag(node)),
                ..Transition::default()
            };
            made.insert(node, self.chart.add_transition(transition));
            let known = ["position", "connectionPointIn", "connectionPointOut", "condition"];
            rest(self.reader, node, &known, "a transition");
        }
        for node in self.of(&["step", "macroStep", "jumpStep"]) {
            let Some(to) = self.target(node) else { continue };
            let sources = self.network.before(self.reader, node, &["transition"], &TO_STEPS);
            for source in sources {
                let transition =
                    made.get(&source).and_then(|id| self.chart.transitions.get_mut(id));
                transition.into_iter().for_each(|one| {
                    one.to.insert(to);
                });
            }
        }
        for node in self.of(&["transition"]) {
            let Some(id) = made.get(&node) else { continue };
            if self.chart.transitions.get(id).is_some_and(|one| one.to.is_empty()) {
                self.loose(node, "no step is after");
            }
        }
    }

    /// Whether no line leads to an element, and none from it.
    fn goes_nowhere(&self, node: Node<'a, 'i>) -> bool {
        let number = id(node);
        let mut others = self.network.elements.iter().flat_map(|one| lines_into(*one));
        lines_into(node).is_empty() && others.all(|line| line.from.text != number)
    }

    /// Function blocks that a condition asks for are called while the step before it is active.
    fn calls(&mut self, step: StepId, calls: Vec<Code>) {
        let name = self.chart.steps.get(&step).map_or(String::new(), |step| step.name.clone());
        let known = self.called.get(&step).and_then(|id| self.chart.actions.get_mut(id));
        if let Some(Action { body: Body::Code(code), .. }) = known {
            for call in calls {
                if !code.text.lines().any(|line| line.trim() == call.text) {
                    code.text = format!("{}{NEXT_LINE}{}", code.text, call.text);
                }
            }
            return;
        }
        let origin = calls.first().map_or_else(Origin::default, |call| call.origin);
        let texts: Vec<String> = calls.into_iter().map(|call| call.text).collect();
        let Some(name) = self.free(|number| match number {
            1 => format!("{name}_blocks"),
            _ => format!("{name}_blocks{number}"),
        }) else {
            return;
        };
        let body = Body::Code(Code { text: texts.join(NEXT_LINE), origin });
        let comment =
            "Function blocks of drawn conditions: what they give is asked for afterwards.";
        let id = self.chart.add_action(Action { name, body, comment: comment.to_owned(), origin });
        self.called.insert(step, id);
        if let Some(step) = self.chart.steps.get_mut(&step) {
            step.block.push(Instance { origin, ..Instance::new(id) });
        }
    }

    /// The first name for an action that nothing has.
    fn free(&self, name: impl Fn(usize) -> String) -> Option<String> {
        let taken = |name: &str| {
            self.chart.action_named(name).is_some()
                || self.chart.step_named(name).is_some()
                || self.around.actions().any(|one| {
                    optional(one, "name").is_some_and(|other| is_same(&other.text, name))
                })
        };
        (1..).map(name).find(|name| !taken(name))
    }

    /// Reports a transition whose other end is nowhere, unless a line that is broken tells already.
    fn loose(&mut self, node: Node, what: &str) {
        let mut told = self.reader.diagnostics.iter().skip(self.told);
        if told.any(|one| matches!(one.code, ErrorCode::Unknown | ErrorCode::Twice)) {
            return;
        }
        let message = format!("{}: {what} it", title(node));
        let help = "a line begins at its connectionPointOut and is named where it ends: \
                    <connectionPointIn><connection refLocalId=\"...\"/></connectionPointIn>";
        self.reader.error(ErrorCode::Wiring, tag(node), message, help);
    }

    /// The step that an element is, or that it jumps to.
    fn target(&mut self, node: Node<'a, 'i>) -> Option<StepId> {
        if node.tag_name().name() != "jumpStep" {
            return self.steps.get(&node).copied();
        }
        let name = self.reader.needed(node, "targetName")?;
        let found = self.chart.step_named(&name.text);
        if found.is_none() {
            let message = format!("{}: there is no step of this name to jump to", name.text);
            let names: Vec<&str> =
                self.chart.steps.values().map(|step| step.name.as_str()).take(12).collect();
            let help = format!("steps are {}", names.join(", "));
            self.reader.error(ErrorCode::Unknown, name.span, message, help);
        }
        found
    }

    fn priority(&mut self, node: Node) -> Option<u32> {
        let written = optional(node, "priority")?;
        let number = written.text.parse().ok();
        if number.is_none() {
            let message = format!("priority is {}: a number is needed", written.text);
            let help = "the lowest one comes first";
            self.reader.error(ErrorCode::Incomplete, written.span, message, help);
        }
        number
    }

    /// The actions of the unit come first, in their order: that is when they are executed.
    fn named(&mut self) {
        for node in self.around.actions() {
            let Some(name) = optional(node, "name") else { continue };
            if self.chart.action_named(&name.text).is_none() {
                self.chart.add_action(Action::variable(name.text, Origin(name.span)));
            }
        }
    }

    fn blocks(&mut self) {
        for node in self.of(&["actionBlock"]) {
            let Some(line) = lines_into(node).into_iter().next() else {
                let message = format!("{}: no line leads to it from a step", title(node));
                let help = "its connectionPointIn names the step whose actions it has";
                self.reader.error(ErrorCode::Wiring, tag(node), message, help);
                continue;
            };
            let Some(source) = self.network.from(self.reader, &line, node) else { continue };
            let Some(step) = self.steps.get(&source).copied() else {
                let message = format!("{} belongs to no step", title(node));
                self.reader.error(
                    ErrorCode::Wiring,
                    line.from.span,
                    message,
                    "its line comes from a step",
                );
                continue;
            };
            for action in elements(node) {
                match action.tag_name().name() {
                    "action" => self.instance(action, step),
                    "position" | "connectionPointIn" => {}
                    _ => self.reader.ignore(action, "an action block"),
                }
            }
        }
    }

    /// A variable with a line from a step is TRUE while that is active. Others without a line are
    /// left out.
    fn variables(&mut self) {
        for node in self.of(&["outVariable", "inOutVariable"]) {
            let lines = lines_into(node);
            let sources = lines.iter().map(|line| self.network.from(self.reader, line, node));
            let sources: Vec<Option<Node>> = sources.collect();
            let step = match &sources[..] {
                [Some(source)] => self.steps.get(source).copied(),
                _ => None,
            };
            let name =
                child(node, "expression").map(formatted).filter(|_| !is_true(node, "negated"));
            match (step, name) {
                (Some(step), Some(Text { text, span })) => {
                    let origin = Origin(span);
                    let known = self.chart.action_named(&text);
                    let id = known
                        .unwrap_or_else(|| self.chart.add_action(Action::variable(text, origin)));
                    if let Some(step) = self.chart.steps.get_mut(&step) {
                        step.block.push(Instance { origin, ..Instance::new(id) });
                    }
                }
                // A part of a condition.
                _ if lines.is_empty() && !self.goes_nowhere(node) => {}
                _ if lines.is_empty() => {
                    let message = format!("{}: no line leads to it, it is left out", title(node));
                    let left = Diagnostic::new(ErrorCode::Ignored, tag(node), message);
                    self.reader.report(left);
                }
                _ => {
                    let message = format!("{}: no action of a step", title(node));
                    let help = "a line from a step makes it TRUE while that is active; write all \
                                else in an action, as Structured Text (ST)";
                    self.reader.error(ErrorCode::OtherLanguage, tag(node), message, help);
                }
            }
        }
    }

    fn instance(&mut self, node: Node, step: StepId) {
        let qualifier = optional(node, "qualifier");
        let found = qualifier.as_ref().map_or(Some(Qualifier::N), |one| Qualifier::find(&one.text));
        let Some(found) = found else {
            let one = qualifier.unwrap_or_default();
            let message = format!("{}: there is no such qualifier", one.text);
            let names = Qualifier::ALL.map(Qualifier::text).join(" ");
            let help = format!("there are {names}");
            return self.reader.error(ErrorCode::Incomplete, one.span, message, help);
        };
        let Some(action) = self.action(node, step) else { return };
        let time =
            optional(node, "duration").map(|one| Code { text: one.text, origin: Origin(one.span) });
        // Tools write an empty time, or one of nothing, where a qualifier has none.
        let time = time.filter(|_| found.has_time());
        if time.is_none() && found.has_time() {
            let message = format!("qualifier {} has no duration", found.text());
            let place = qualifier.map_or(tag(node), |one| one.span);
            self.reader.error(ErrorCode::Incomplete, place, message, "write duration=\"T#2s\"");
        }
        if let Some(indicator) = optional(node, "indicator") {
            let message = format!("{}: an indicator variable is left out", indicator.text);
            self.reader.report(Diagnostic::new(ErrorCode::Ignored, indicator.span, message));
        }
        let instance =
            Instance { qualifier: found, time, origin: Origin(tag(node)), ..Instance::new(action) };
        if let Some(step) = self.chart.steps.get_mut(&step) {
            step.block.push(instance);
        }
        let known = ["relPosition", "reference", "inline", "connectionPointOut"];
        rest(self.reader, node, &known, "an action");
    }

    /// What an instance executes: an action or variable by its name, or statements of its own.
    fn action(&mut self, node: Node, step: StepId) -> Option<ActionId> {
        if let Some(reference) = child(node, "reference") {
            let name = self.reader.needed(reference, "name")?;
            if let Some(known) = self.chart.action_named(&name.text) {
                return Some(known);
            }
            let origin = Origin(name.span);
            return Some(self.chart.add_action(Action::variable(name.text, origin)));
        }
        let found = child(node, "inline").and_then(language);
        let Some(found) = found else {
            let message = "an action without a name or statements";
            let help = "<reference name=\"...\"/> names an action or a variable";
            self.reader.error(ErrorCode::Incomplete, tag(node), message, help);
            return None;
        };
        let name = self.chart.steps.get(&step).map_or(String::new(), |step| step.name.clone());
        let body = match found.tag_name().name() {
            "ST" => {
                let Text { text, span } = formatted(found);
                Body::Code(Code { text, origin: Origin(span) })
            }
            _ => match translated_body(self.reader, found) {
                Some(body) => body,
                None => {
                    refuse(self.reader, found, &format!("an action of step {name}"));
                    return None;
                }
            },
        };
        let name = self.free(|number| format!("{name}_action{number}"))?;
        let (origin, comment) = (Origin(tag(node)), String::new());
        Some(self.chart.add_action(Action { name, body, comment, origin }))
    }

    /// Comments become those of the nearest step; what cannot be in a chart is told.
    fn comments(&mut self) {
        for node in self.network.elements.clone() {
            match node.tag_name().name() {
                "comment" => self.comment(node),
                "step" | "macroStep" | "jumpStep" | "transition" | "actionBlock" => {}
                "selectionDivergence"
                | "selectionConvergence"
                | "simultaneousDivergence"
                | "simultaneousConvergence" => {}
                // Parts of conditions.
                "inVariable" | "contact" | "leftPowerRail" | "rightPowerRail" | "block" => {}
                "connector" | "continuation" => {}
                "outVariable" | "inOutVariable" => {}
                "addData" | "documentation" => self.reader.ignore(node, "a chart"),
                name => {
                    let message = format!("{name} {}: no element of a chart", id(node));
                    let help = "write what it does in an action, as Structured Text (ST)";
                    self.reader.error(ErrorCode::OtherLanguage, tag(node), message, help);
                }
            }
        }
    }

    fn comment(&mut self, node: Node) {
        let text = child(node, "content").map_or_else(String::new, |one| formatted(one).text);
        let here = middle(node).unwrap_or_default();
        let far = |step: &Step| {
            let at = step.at.unwrap_or_default();
            let square = |a: i32, b: i32| u128::from(a.abs_diff(b)).pow(2);
            square(at.x, here.x) + square(at.y, here.y)
        };
        if let Some(step) = self.chart.steps.values_mut().min_by_key(|step| far(step)) {
            let gap = if step.comment.is_empty() { "" } else { "\n" };
            step.comment = format!("{}{gap}{text}", step.comment);
        }
    }
}
