//! Writes a document as text. Reading that text gives the same document.

use std::cmp::Reverse;
use std::fmt::Write;

use diagnostics::Span;

use super::{Document, Piece};
use crate::model::{
    Action, Body, Chart, Code, Forcing, Instance, Origin, Position, Qualifier, Situation, Standard,
    Step, StepId, StepKind, Transition,
};

/// The text of a document.
pub fn write(document: &Document) -> String {
    let mut text = String::new();
    for piece in &document.pieces {
        match piece {
            Piece::Text(piece) => text += piece,
            Piece::Chart(chart) => {
                if !text.is_empty() && !text.ends_with('\n') {
                    text.push('\n');
                }
                text += &write_chart(chart).text;
            }
        }
    }
    text
}

/// A chart as text, and what in it comes from where.
#[derive(Debug, Default)]
pub struct Written {
    /// The text.
    pub text: String,
    /// Stretches of the text, each with the place where what is written there was read; what is in
    /// an element after the element.
    pub parts: Vec<WrittenPart>,
}

/// A stretch of a written text.
#[derive(Debug, Clone, Copy)]
pub struct WrittenPart {
    /// Where it is written.
    pub written: Span,
    /// Where it was read.
    pub origin: Span,
    /// Whether it is code, written as it was read.
    pub is_code: bool,
}

/// The text of a chart.
pub fn write_chart(chart: &Chart) -> Written {
    let mut writer = Writer { out: Written::default(), indent: 0 };
    writer.chart(chart, None);
    writer.out.parts.sort_by_key(|part| (part.written.start, Reverse(part.written.end)));
    writer.out
}

struct Writer {
    out: Written,
    indent: usize,
}

impl Writer {
    fn line(&mut self, line: &str) {
        if !line.is_empty() {
            let _ = write!(self.out.text, "{:indent$}{line}", "", indent = self.indent * 4);
        }
        self.out.text.push('\n');
    }

    /// Notes where what is written from an offset on comes from.
    fn note(&mut self, start: usize, origin: Origin) {
        let written = Span::new(start, self.out.text.len());
        self.out.parts.push(WrittenPart { written, origin: origin.0, is_code: false });
    }

    /// A line with codes in it, in this order.
    fn coded(&mut self, line: &str, codes: &[&Code]) {
        let mut at = self.out.text.len();
        self.line(line);
        for code in codes {
            let rest = self.out.text.get(at..).unwrap_or("");
            let Some(start) = rest.find(&code.text).map(|start| at + start) else { continue };
            at = start + code.text.len();
            let (written, origin) = (Span::new(start, at), code.origin.0);
            self.out.parts.push(WrittenPart { written, origin, is_code: true });
        }
    }

    fn comment(&mut self, comment: &str) {
        for line in comment.lines() {
            // What begins with `#` would be a setting.
            let space = if line.is_empty() { "" } else { " " };
            self.line(&format!("//{space}{line}"));
        }
    }

    fn chart(&mut self, chart: &Chart, around: Option<Standard>) {
        if chart.standard == Standard::Grafcet && around != Some(Standard::Grafcet) {
            let max = chart.evolutions_max.map(|max| format!(" evolutions {max}"));
            self.line(&format!("{{grafcet{}}}", max.unwrap_or_default()));
        }
        let mut is_first = true;
        for step in chart.steps.values() {
            self.gap(&mut is_first);
            self.step(chart, step);
        }
        for transition in chart.transitions.values() {
            self.gap(&mut is_first);
            self.transition(chart, transition);
        }
        for action in chart.actions.values() {
            if action.body != Body::Variable {
                self.gap(&mut is_first);
                self.action(chart, action);
            }
        }
    }

    fn gap(&mut self, is_first: &mut bool) {
        if !std::mem::take(is_first) {
            self.line("");
        }
    }

    fn step(&mut self, chart: &Chart, step: &Step) {
        let start = self.out.text.len();
        self.comment(&step.comment);
        let word = if step.is_initial { "INITIAL_STEP" } else { "STEP" };
        let mut head = format!("{word} {}{}:", step.name, at(step.at));
        match &step.kind {
            StepKind::Plain => {}
            StepKind::Macro(name) => head += &format!(" {{macro {name}}}"),
            StepKind::Enclosing(names) => head += &format!(" {{enclosing {}}}", names.join(", ")),
        }
        if step.is_linked {
            head += " {linked}";
        }
        if step.coarse.is_some() {
            head += " {coarse}";
        }
        self.line(&head);
        self.indent += 1;
        for forcing in &step.forcings {
            let start = self.out.text.len();
            self.line(&order(forcing));
            self.note(start, forcing.origin);
        }
        for instance in &step.block {
            let (start, line) = (self.out.text.len(), instance_text(chart, instance));
            let codes = [&instance.time, &instance.condition, &instance.event];
            self.coded(&line, &codes.into_iter().flatten().collect::<Vec<_>>());
            self.note(start, instance.origin);
        }
        self.indent -= 1;
        self.line("END_STEP");
        self.note(start, step.origin);
    }

    fn transition(&mut self, chart: &Chart, transition: &Transition) {
        let start = self.out.text.len();
        self.comment(&transition.comment);
        let name = transition.name.iter().map(|name| format!(" {name}"));
        let priority = transition.priority.iter().map(|one| format!(" (PRIORITY := {one})"));
        let head: String = name.chain(priority).collect();
        let from = side(chart, &mut transition.from.iter());
        let to = side(chart, &mut transition.to.iter());
        self.line(&format!("TRANSITION{head}{} FROM {from} TO {to}", at(transition.at)));
        self.indent += 1;
        if let Some(code) = &transition.crossing {
            self.coded(&format!("{{crossing {}}}", code.text), &[code]);
        }
        let condition = &transition.condition;
        self.coded(&format!(":= {};", condition.text), &[condition]);
        self.indent -= 1;
        self.line("END_TRANSITION");
        self.note(start, transition.origin);
    }

    fn action(&mut self, chart: &Chart, action: &Action) {
        let start = self.out.text.len();
        self.comment(&action.comment);
        self.line(&format!("ACTION {}:", action.name));
        self.indent += 1;
        match &action.body {
            Body::Variable => {}
            Body::Code(code) => self.coded(&code.text, &[code]),
            Body::Chart(inner) => self.chart(inner, Some(chart.standard)),
        }
        self.indent -= 1;
        self.line("END_ACTION");
        self.note(start, action.origin);
    }
}

fn at(position: Option<Position>) -> String {
    position.map_or_else(String::new, |at| format!(" {{at {} {}}}", at.x, at.y))
}

fn order(forcing: &Forcing) -> String {
    let situation = match &forcing.situation {
        Situation::Steps(names) => format!("({})", names.join(", ")),
        Situation::Current => "*".to_owned(),
        Situation::Initial => "INIT".to_owned(),
    };
    format!("{{force {} {situation}}}", forcing.chart)
}

fn instance_text(chart: &Chart, instance: &Instance) -> String {
    let name = chart.actions.get(&instance.action).map_or("", |action| action.name.as_str());
    let inside = match (&instance.time, instance.qualifier) {
        (Some(time), qualifier) => format!("({}, {})", qualifier.text(), time.text),
        (None, Qualifier::N) => String::new(),
        (None, qualifier) => format!("({})", qualifier.text()),
    };
    let condition = instance.condition.iter().map(|code| format!(" {{if {}}}", code.text));
    let event = instance.event.iter().map(|code| format!(" {{on {}}}", code.text));
    format!("{name}{inside}{};", condition.chain(event).collect::<String>())
}

fn side(chart: &Chart, steps: &mut dyn Iterator<Item = &StepId>) -> String {
    let names = steps.filter_map(|id| chart.steps.get(id)).map(|step| step.name.as_str());
    match names.collect::<Vec<_>>()[..] {
        [one] => one.to_owned(),
        ref all => format!("({})", all.join(", ")),
    }
}
