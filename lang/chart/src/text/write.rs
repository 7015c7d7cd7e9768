//! Writes a document as text. Reading that text gives the same document.

use std::fmt::Write;

use super::{Document, Piece};
use crate::model::{
    Action, Body, Chart, Forcing, Instance, Position, Qualifier, Situation, Standard, Step, StepId,
    StepKind, Transition,
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
                Writer { text: &mut text, indent: 0 }.chart(chart, None);
            }
        }
    }
    text
}

struct Writer<'t> {
    text: &'t mut String,
    indent: usize,
}

impl Writer<'_> {
    fn line(&mut self, line: &str) {
        if !line.is_empty() {
            let _ = write!(self.text, "{:indent$}{line}", "", indent = self.indent * 4);
        }
        self.text.push('\n');
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
            self.line("{grafcet}");
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
        self.line(&head);
        self.indent += 1;
        for forcing in &step.forcings {
            self.line(&order(forcing));
        }
        for instance in &step.block {
            let line = instance_text(chart, instance);
            self.line(&line);
        }
        self.indent -= 1;
        self.line("END_STEP");
    }

    fn transition(&mut self, chart: &Chart, transition: &Transition) {
        self.comment(&transition.comment);
        let name = transition.name.iter().map(|name| format!(" {name}"));
        let priority = transition.priority.iter().map(|one| format!(" (PRIORITY := {one})"));
        let head: String = name.chain(priority).collect();
        let from = side(chart, &mut transition.from.iter());
        let to = side(chart, &mut transition.to.iter());
        self.line(&format!("TRANSITION{head}{} FROM {from} TO {to}", at(transition.at)));
        self.indent += 1;
        if let Some(code) = &transition.crossing {
            self.line(&format!("{{crossing {}}}", code.text));
        }
        self.line(&format!(":= {};", transition.condition.text));
        self.indent -= 1;
        self.line("END_TRANSITION");
    }

    fn action(&mut self, chart: &Chart, action: &Action) {
        self.comment(&action.comment);
        self.line(&format!("ACTION {}:", action.name));
        self.indent += 1;
        match &action.body {
            Body::Variable => {}
            Body::Code(code) => self.line(&code.text),
            Body::Chart(inner) => self.chart(inner, Some(chart.standard)),
        }
        self.indent -= 1;
        self.line("END_ACTION");
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
