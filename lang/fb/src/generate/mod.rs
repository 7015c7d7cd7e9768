//! A block as Structured Text: a FUNCTION_BLOCK that others call, or a program of its own. How it
//! does what the block says is in docs/iec61499.md.

mod chart;
mod declare;
mod out;

use diagnostics::{Source, Span};
use st::places;
use st::tree::File;

use crate::model::{Block, Text, Variable};
use crate::parsed::{Parsed, parse};
use out::Out;

/// What becomes of a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// A FUNCTION_BLOCK. Its events are inputs and outputs.
    FunctionBlock,
    /// A program whose events and variables are global, under their own names.
    Program,
}

/// A block as a syntax tree of Structured Text.
#[derive(Debug)]
pub struct Translation {
    /// The tree. Places are those in the block's file.
    pub file: File,
    /// What is wrong in the block's texts.
    pub diagnostics: Vec<st::Diagnostic>,
}

/// The end of the name that the count of an output event has in a written text, and in programs.
const COUNT: (&str, &str) = ("__count", ".count");

/// Translates a block without errors that was read from a file.
pub fn translate(block: &Block, source: &Source, form: Form) -> Translation {
    let parsed = parse(block, source);
    let out = write(block, &parsed, source, form);
    let mut diagnostics = parsed.diagnostics;
    // It is never longer than a text can be: the file is not, and this has no more than its parts.
    let Ok(written) = Source::new(source.name.as_str(), out.traced.text()) else {
        return Translation { file: File::default(), diagnostics };
    };
    let (mut file, wrong) = st::parser::parse(&written);
    if diagnostics.is_empty() {
        // What an initial value says wrong; everything else was read before.
        diagnostics.extend(wrong.into_iter().map(|one| one.moved(|span| out.traced.place(span))));
    }
    let mut place = |span: &mut Span| *span = out.traced.place(*span);
    places::in_file(
        &mut file,
        &mut |name| {
            name.span = out.traced.place(name.span);
            let is_own = block.variables().any(|one| one.name.names(&name.text));
            if let Some(event) = name.text.strip_suffix(COUNT.0).filter(|_| !is_own) {
                name.text = format!("{event}{}", COUNT.1);
            }
        },
        &mut place,
    );
    Translation { file, diagnostics }
}

/// The text of a block as a FUNCTION_BLOCK.
pub fn text(block: &Block, source: &Source) -> Result<String, Vec<st::Diagnostic>> {
    let parsed = parse(block, source);
    if !parsed.diagnostics.is_empty() {
        return Err(parsed.diagnostics);
    }
    Ok(write(block, &parsed, source, Form::FunctionBlock).traced.text().to_owned())
}

fn write(block: &Block, parsed: &Parsed, source: &Source, form: Form) -> Out {
    let names = Names::of(block);
    let mut generator =
        Generator { block, parsed, file: &source.text, form, names, out: Out::default() };
    generator.unit();
    generator.out
}

/// The name of the number of the state in the program that a block is.
pub(crate) fn state_name(block: &Block) -> String {
    Names::of(block).state
}

/// Names of what a block has not itself.
struct Names {
    state: String,
    event: String,
    next: String,
    lost: String,
    /// Of an input: what was read with the last event; of an output: what is computed.
    copies: Vec<(String, String)>,
}

impl Names {
    fn of(block: &Block) -> Names {
        let free = |wanted: &str| {
            let events = block.event_inputs.iter().chain(&block.event_outputs);
            let mut taken: Vec<&Text> = events.map(|event| &event.name).collect();
            taken.extend(block.variables().map(|variable| &variable.name));
            taken.push(&block.name);
            let mut name = wanted.to_owned();
            while taken.iter().any(|one| one.names(&name)) {
                name.push('_');
            }
            name
        };
        let copy = |variable: &Variable, what: &str| {
            let name = &variable.name.text;
            (name.to_lowercase(), free(&format!("{name}_{what}")))
        };
        let inputs = block.inputs.iter().filter(|one| is_sampled(block, one));
        let outputs = block.outputs.iter().filter(|one| is_held(block, one));
        let copies = inputs.map(|one| copy(one, "sampled"));
        Names {
            state: free("State"),
            event: free("Event"),
            next: free("Next"),
            lost: free("lost"),
            copies: copies.chain(outputs.map(|one| copy(one, "computed"))).collect(),
        }
    }

    /// The variable that algorithms and guards work on.
    fn copy(&self, name: &str) -> Option<&str> {
        let name = name.to_lowercase();
        let found = self.copies.iter().find(|(of, _)| *of == name);
        found.map(|(_, copy)| copy.as_str())
    }
}

/// Whether an input can differ from what was read with the last event that has it with it.
fn is_sampled(block: &Block, variable: &Variable) -> bool {
    let has = |with: &[Text]| with.iter().any(|one| one.names(&variable.name.text));
    !block.event_inputs.iter().all(|event| has(&event.with))
}

/// Whether an output can differ from what was sent: an algorithm may compute it without an event
/// after it.
fn is_held(block: &Block, variable: &Variable) -> bool {
    let mut actions = block.states.iter().flat_map(|state| &state.actions);
    !actions.all(|action| {
        let name = action.output.as_ref();
        let event = name
            .and_then(|name| block.event_outputs.iter().find(|event| event.name.names(&name.text)));
        let is_sent =
            event.is_some_and(|event| event.with.iter().any(|one| one.names(&variable.name.text)));
        action.algorithm.is_none() || is_sent
    })
}

struct Generator<'b> {
    block: &'b Block,
    parsed: &'b Parsed,
    file: &'b str,
    form: Form,
    names: Names,
    out: Out,
}

impl Generator<'_> {
    fn unit(&mut self) {
        let name = self.block.name.clone();
        let comment = one_line(&self.block.comment);
        if !comment.is_empty() {
            self.out.line(name.span, &format!("// {comment}"));
        }
        match self.form {
            Form::FunctionBlock => {
                self.out.line(name.span, &format!("FUNCTION_BLOCK {}", name.text));
                self.interface();
                self.internals();
                self.body();
                self.out.line(name.span, "END_FUNCTION_BLOCK");
            }
            Form::Program => {
                self.globals();
                // Nobody sees its name, which can be that of an event.
                self.out.line(name.span, &format!("PROGRAM {}__block", name.text));
                self.steps("VAR");
                self.body();
                self.out.line(name.span, "END_PROGRAM");
            }
        }
    }
}

/// A comment that fits after `//`.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
