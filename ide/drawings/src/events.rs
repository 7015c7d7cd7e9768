//! A block of IEC 61499 as the page gets it: its chart, and what events make of it. All that was
//! done with a block is done again for each answer: there is nothing to be kept.

use diagnostics::Source;
use fb::drawing::draw;
use fb::drawing::shapes::{self, ActionShape};
use fb::model::{Block, Event, Variable};
use fb::parsed::{Parsed, parse};
use fb::session::{Done, Session};
use fb::xml;
use picture::Rect;

use crate::geometry::{frame, point};
use crate::protocol::Mistake;
use crate::protocol::events::{
    Action, BlockEvent, BlockValue, Boxed, Events, State, Told, Transition,
};

/// Most lines that are done again.
const LINES_MAX: usize = 10_000;

/// The chart of a block after lines as `uno200 events` takes them. A text with errors has its first
/// one alone.
pub fn events(text: String, name: String, lines: &[String]) -> Result<Events, String> {
    let source = Source::new(name, text).map_err(|error| error.to_string())?;
    let fb::Read { block, diagnostics } = xml::read(&source);
    let Some(block) = block else {
        return Ok(Events { mistake: Mistake::first(&source, &diagnostics), ..Events::default() });
    };
    let parsed = parse(&block, &source);
    match Mistake::first(&source, &parsed.diagnostics) {
        None => after(&block, &parsed, lines),
        mistake => Ok(Events { mistake, ..Events::default() }),
    }
}

fn after(block: &Block, parsed: &Parsed, lines: &[String]) -> Result<Events, String> {
    if lines.len() > LINES_MAX {
        return Err(format!("more than {LINES_MAX} lines: begin anew"));
    }
    let mut session = Session::new(block, parsed).map_err(|stopped| stopped.to_string())?;
    let told: Vec<Told> = lines.iter().map(|line| obeyed(&mut session, line)).collect();
    let drawing = draw(block).map_err(|too_large| too_large.to_string())?;
    let values = |all: &[Variable]| all.iter().map(|one| value(&session, one)).collect();
    Ok(Events {
        width: drawing.width,
        height: drawing.height,
        name: drawing.name.clone(),
        title: point(drawing.title),
        states: drawing.states.iter().map(state).collect(),
        transitions: drawing.transitions.iter().map(transition).collect(),
        state: session.state_number(),
        cleared: session.last().cleared.clone(),
        sent: session.last().sent.clone(),
        event_inputs: block.event_inputs.iter().map(event).collect(),
        event_outputs: block.event_outputs.iter().map(event).collect(),
        inputs: values(&block.inputs),
        outputs: values(&block.outputs),
        internals: values(&block.internals),
        told,
        mistake: None,
    })
}

fn obeyed(session: &mut Session, line: &str) -> Told {
    let (text, is_wrong) = match session.obey(line) {
        Ok(Done::Said(text)) => (text, false),
        Ok(Done::Failed(text)) => (text, true),
        Ok(Done::End) => (String::new(), false),
        Err(mistake) => {
            let help = mistake.help.map(|help| format!("; {help}")).unwrap_or_default();
            (mistake.message + &help, true)
        }
    };
    Told { text, is_wrong }
}

fn value(session: &Session, one: &Variable) -> BlockValue {
    BlockValue {
        name: one.name.text.clone(),
        of_type: one.of_type.name().to_owned(),
        comment: one.comment.clone(),
        is_array: one.size.is_some(),
        value: session.value(&one.name.text),
    }
}

fn event(one: &Event) -> BlockEvent {
    BlockEvent {
        name: one.name.text.clone(),
        comment: one.comment.clone(),
        with: one.with.iter().map(|one| one.text.clone()).collect(),
    }
}

fn state(one: &shapes::StateShape) -> State {
    State {
        name: one.name.clone(),
        comment: one.comment.clone(),
        is_initial: one.is_initial,
        frame: frame(one.frame),
        actions: one.actions.iter().map(action).collect(),
    }
}

fn action(ActionShape { algorithm, output }: &ActionShape) -> Action {
    let boxed = |one: &Option<(String, Rect)>| {
        one.as_ref().map(|(text, at)| Boxed { text: text.clone(), frame: frame(*at) })
    };
    Action { algorithm: boxed(algorithm), output: boxed(output) }
}

fn transition(one: &shapes::TransitionShape) -> Transition {
    Transition {
        states: one.states,
        text: one.text.clone(),
        label: frame(one.label),
        curve: one.curve.map(point),
        middle: point(one.middle),
        arrow: one.arrow.map(point),
    }
}
