//! A block from MATLAB text, of the form that is written here. What a line says is read once; the
//! lines that follow from others are compared with those that would be written.

mod condition;
mod follow;
mod lines;

use diagnostics::{Severity, Source, Span};

use super::constant::Constant;
use super::note::{Piece, pieces, said, words};
use super::to_st::{Translator, Wrong};
use super::vocabulary::{NOW, RUNNING, class};
use condition::{Condition, condition};
use follow::what_follows;
use lines::{Line, Outcome, lines, sections, wrong};

use crate::check::check;
use crate::data_type::DataType;
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{Action, Algorithm, Block, Event, Place, State, Text, Transition, Variable};
use crate::model::{Primitive, Sequence, Service, Transaction};
use crate::read::Read;

/// Reads a block.
pub fn read(source: &Source) -> Read {
    let mut reader =
        Reader { text: &source.text, block: Block::default(), diagnostics: Vec::new() };
    if let Err(wrong) = reader.all() {
        reader.report(wrong);
    }
    let Reader { block, mut diagnostics, .. } = reader;
    if !has_errors(&diagnostics) {
        diagnostics.extend(check(&block, &source.text));
    }
    if !has_errors(&diagnostics) {
        diagnostics.extend(what_follows(&block, &source.text));
    }
    diagnostics.sort_by_key(|one| one.span);
    Read { block: (!has_errors(&diagnostics)).then_some(block), diagnostics }
}

fn has_errors(diagnostics: &[Diagnostic]) -> bool {
    diagnostics.iter().any(|one| one.severity() == Severity::Error)
}

struct Reader<'t> {
    text: &'t str,
    block: Block,
    diagnostics: Vec<Diagnostic>,
}

impl<'t> Reader<'t> {
    fn report(&mut self, Wrong { span, message, help }: Wrong) {
        let mut error = Diagnostic::new(Code::BrokenMatlab, span, message);
        error.help.extend((!help.is_empty()).then_some(help));
        self.diagnostics.push(error);
    }

    /// A stretch of the text with its place.
    fn part(&self, part: &'t str) -> Text {
        let start = part.as_ptr() as usize - self.text.as_ptr() as usize;
        Text { text: part.to_owned(), span: Span::new(start, start + part.len()) }
    }

    fn all(&mut self) -> Outcome<()> {
        let sections = sections(self.text)?;
        let section = |number: usize| sections.get(number).copied().unwrap_or_default();
        let text = self.text;
        self.head(&lines(text, section(0)))?;
        self.declarations(&lines(text, section(1)))?;
        self.internals(&lines(text, section(2)))?;
        self.states(&lines(text, section(3)))?;
        self.sampled(&lines(text, section(4)))?;
        self.transitions(&lines(text, section(5)))?;
        self.actions(&lines(text, section(6)))?;
        self.algorithms(section(7))
    }

    /// `function [e_A, v_X] = fcn (e_B, v_Y)`
    fn head(&mut self, lines: &[Line<'t>]) -> Outcome<()> {
        let Some(line) = lines.last() else {
            let help = "function [e_CNF, v_Out] = fcn (e_REQ, v_In)";
            return wrong(Span::new(0, 1), "the line that begins the function is missing", help);
        };
        let parts = line.code.strip_prefix("function").and_then(|rest| {
            let (outs, ins) = rest.split_once('=')?;
            let outs = outs.trim().strip_prefix('[')?.strip_suffix(']')?;
            let ins =
                ins.trim().strip_prefix("fcn")?.trim().strip_prefix('(')?.strip_suffix(')')?;
            Some((outs, ins))
        });
        let Some((outs, ins)) = parts else {
            let help = "function [e_CNF, v_Out] = fcn (e_REQ, v_In)";
            return wrong(line.span, "this does not begin a block", help);
        };
        (self.block.event_outputs, self.block.outputs) = self.list(outs)?;
        (self.block.event_inputs, self.block.inputs) = self.list(ins)?;
        Ok(())
    }

    fn list(&mut self, list: &'t str) -> Outcome<(Vec<Event>, Vec<Variable>)> {
        let (mut events, mut variables) = (Vec::new(), Vec::new());
        for name in list.split(',').map(str::trim).filter(|name| !name.is_empty()) {
            let place = self.part(name).span;
            match (name.strip_prefix("e_"), name.strip_prefix("v_")) {
                (Some(event), _) => {
                    events.push(Event { name: self.part(event), ..Event::default() });
                }
                (_, Some(name)) => variables.push(undeclared(self.part(name))),
                _ => {
                    let help = "events begin with e_, variables with v_";
                    return wrong(place, format!("{name} is no event and no variable"), help);
                }
            }
        }
        Ok((events, variables))
    }

    fn declarations(&mut self, lines: &[Line<'t>]) -> Outcome<()> {
        let mut lines = lines.iter().peekable();
        while let Some(line) = lines.next() {
            if line.code.is_empty() {
                self.about_block(line)?;
            } else if let Some(event) = line.code.strip_prefix("e_") {
                self.output_event(line, event)?;
            } else if let Some((variable, next)) = self.declaration(line, lines.next())? {
                let lists = [&mut self.block.inputs, &mut self.block.outputs];
                let slot = lists.into_iter().flatten().find(|one| one.name == variable.name);
                let Some(slot) = slot else {
                    let message = format!("{}: the function has no v_ of it", variable.name.text);
                    return wrong(next, message, "variables of its own are in section 2");
                };
                *slot = Variable { name: slot.name.clone(), ..variable };
            }
        }
        let all = self.block.inputs.iter().chain(&self.block.outputs);
        match all.into_iter().find(|one| one.type_span == Span::default()) {
            Some(one) => {
                let help = "section 1 says what each variable begins with";
                wrong(one.name.span, format!("{}: it is not declared", one.name.text), help)
            }
            None => Ok(()),
        }
    }

    fn about_block(&mut self, line: &Line<'t>) -> Outcome<()> {
        let found = words(&line.note);
        match found.first().copied() {
            Some("BLOCK") => {
                let name = found.get(1).copied().unwrap_or("");
                let at = line.span.text(self.text).find(name).unwrap_or(0);
                let start = line.span.start as usize + at;
                let span = Span::new(start, start + name.len());
                self.block.name = Text { text: name.to_owned(), span };
                self.block.comment = said(line.note.clone()).1;
            }
            Some("Identification") => self.block.identification = pairs(&line.note),
            Some("VersionInfo") => self.block.versions.push(pairs(&line.note)),
            Some(word) if self.service(word, line).is_some() => {}
            _ => {
                let help = "here are BLOCK, Identification, VersionInfo and Service";
                return wrong(line.span, "it is not known what this says", help);
            }
        }
        Ok(())
    }

    /// A line of the service; `None` where it belongs to nothing.
    fn service(&mut self, word: &str, line: &Line<'t>) -> Option<()> {
        let mut said = pairs(&line.note);
        if word == "Service" {
            self.block.service = Some(Service { attributes: said, sequences: Vec::new() });
            return Some(());
        }
        let sequences = &mut self.block.service.as_mut()?.sequences;
        let mut value = |wanted: &str| {
            let at = said.iter().position(|(name, _)| name == wanted);
            let text = at.map(|at| said.remove(at).1).unwrap_or_default();
            Text { text, span: line.span }
        };
        if word == "ServiceSequence" {
            let name = value("Name");
            sequences.push(Sequence { name, attributes: said, transactions: Vec::new() });
            return Some(());
        }
        let transactions = &mut sequences.last_mut()?.transactions;
        if word == "ServiceTransaction" {
            transactions.push(Transaction::default());
            return Some(());
        }
        let transaction = transactions.last_mut()?;
        let (interface, event) = (value("Interface"), value("Event"));
        let primitive = Primitive { interface, event, parameters: value("Parameters") };
        match word {
            "InputPrimitive" => transaction.input = Some(primitive),
            "OutputPrimitive" => transaction.outputs.push(primitive),
            _ => return None,
        }
        Some(())
    }

    fn output_event(&mut self, line: &Line<'t>, code: &'t str) -> Outcome<()> {
        let name = code.split('=').next().unwrap_or("").trim();
        let mut events = self.block.event_outputs.iter_mut();
        let Some(event) = events.find(|one| one.name.text == name) else {
            return wrong(line.span, format!("{name}: the function sends no e_ of it"), "");
        };
        let (found, comment) = said(line.note.clone());
        let with = words(&found).into_iter().skip(1);
        event.with = with.map(|text| Text { text: text.to_owned(), span: line.span }).collect();
        event.comment = comment;
        Ok(())
    }

    /// `persistent X` and `if isempty(X), X = 0; end`.
    fn declaration(
        &mut self,
        line: &Line<'t>,
        next: Option<&Line<'t>>,
    ) -> Outcome<Option<(Variable, Span)>> {
        let Some(names) = line.code.strip_prefix("persistent ") else {
            let help = "persistent X, and then: if isempty(X), X = 0; end";
            return wrong(line.span, "this declares no variable", help);
        };
        let name = names.split_whitespace().next().unwrap_or("").trim_end_matches(';');
        let begin = format!("if isempty({name}), {name} = ");
        let value = next.and_then(|next| {
            let rest = next.code.strip_prefix(begin.as_str())?;
            Some((next, rest.split_once(';')?.0.trim()))
        });
        let Some((next, value)) = value else {
            let help = format!("{begin}0; end");
            let span = next.map_or(line.span, |next| next.span);
            return wrong(span, format!("{name}: this is not what it begins with"), &help);
        };
        let Some(plain) = Constant::of_code(value) else {
            let help = "such as 0, 0.0, logical(0), int32(0), [0, 0]";
            return wrong(self.part(value).span, format!("{value}: no type has this value"), help);
        };
        let (found, comment) = said(next.note.clone());
        let noted = noted(&found, &plain).filter(|one| one.code().as_deref() == Some(value));
        let Constant { of_type, size, initial } = noted.unwrap_or(plain);
        let place = self.part(value).span;
        let initial = initial.map(|text| Text { text, span: place });
        let name = self.part(name);
        Ok(Some((Variable { name, of_type, type_span: place, size, initial, comment }, next.span)))
    }

    fn internals(&mut self, lines: &[Line<'t>]) -> Outcome<()> {
        let mut lines = lines.iter();
        while let Some(line) = lines.next() {
            let found = self.declaration(line, lines.next())?;
            self.block.internals.extend(found.map(|(variable, _)| variable));
        }
        Ok(())
    }

    fn states(&mut self, lines: &[Line<'t>]) -> Outcome<()> {
        for line in lines.iter().filter(|line| line.code.is_empty()) {
            let number = format!("{NOW}({})", self.block.states.len() + 1);
            let (found, comment) = said(line.note.clone());
            let found = words(&found);
            if found.first() != Some(&number.as_str()) || found.len() < 2 {
                let help = format!("the states follow each other: % {number} NAME");
                return wrong(line.span, "this names no state", &help);
            }
            let name = found.get(1).copied().unwrap_or("").to_owned();
            let place = place(found.get(2..).unwrap_or(&[]));
            let name = Text { text: name, span: line.span };
            self.block.states.push(State { name, comment, place, actions: Vec::new() });
        }
        Ok(())
    }

    fn sampled(&mut self, lines: &[Line<'t>]) -> Outcome<()> {
        let mut current: Option<usize> = None;
        for line in lines {
            if let Some(name) = line.code.strip_prefix("if e_") {
                let position = self.block.event_inputs.iter().position(|one| one.name.text == name);
                let Some(at) = position else {
                    return wrong(line.span, format!("{name}: the function takes no e_ of it"), "");
                };
                if let Some(event) = self.block.event_inputs.get_mut(at) {
                    event.comment = said(line.note.clone()).1;
                }
                current = Some(at);
                continue;
            }
            if line.code == "end" {
                current = None;
                continue;
            }
            let name = line.code.split('=').next().unwrap_or("").trim();
            let is_input = line.code == format!("{name} = v_{name};");
            let name = self.part(name);
            let event = current.and_then(|at| self.block.event_inputs.get_mut(at));
            let Some(event) = event.filter(|_| is_input) else {
                let help = "if e_EVENT, then X = v_X; for each input with it, then end";
                return wrong(line.span, "this reads no input with its event", help);
            };
            event.with.push(name);
        }
        Ok(())
    }

    fn transitions(&mut self, lines: &[Line<'t>]) -> Outcome<()> {
        for line in lines.iter().filter(|line| line.code.starts_with("if ")) {
            let mut translator = Translator::new(&self.block, self.text, line.span);
            let Condition { source, event, guard, place: span } = condition(&mut translator)?;
            let different = std::mem::take(&mut translator.differs);
            self.differences(different);
            let next = lines.iter().find(|next| next.span.start > line.span.start);
            let state = |text: Option<&str>| {
                let number: usize = text?.trim().parse().ok()?;
                let state = self.block.states.get(number.checked_sub(1)?)?;
                Some(Text { text: state.name.text.clone(), span: line.span })
            };
            let destination = next.and_then(|next| {
                let (_, after) = next.code.split_once(&format!("; {NOW}("))?;
                state(after.split(')').next())
            });
            let source = state(Some(source.as_str()));
            let Some((source, destination)) = source.zip(destination) else {
                let help = format!("{NOW}(1) = false; {NOW}(2) = true; leads from state 1 to 2");
                let span = next.map_or(line.span, |next| next.span);
                return wrong(span, "there is no such state", &help);
            };
            let text = match (event, guard) {
                (Some(event), Some(guard)) => format!("{event}[{guard}]"),
                (Some(event), None) => event,
                (None, Some(guard)) => format!("[{guard}]"),
                (None, None) => "1".to_owned(),
            };
            let (found, comment) = said(line.note.clone());
            let place = place(words(&found).get(3..).unwrap_or(&[]));
            let condition = Text { text, span };
            self.block.transitions.push(Transition {
                source,
                destination,
                condition,
                comment,
                place,
            });
        }
        Ok(())
    }

    fn actions(&mut self, lines: &[Line<'t>]) -> Outcome<()> {
        for line in lines.iter().filter(|line| line.code.starts_with("if ")) {
            let begin = format!("if {NOW}(");
            let number =
                line.code.strip_prefix(begin.as_str()).and_then(|rest| rest.split(')').next());
            let number = number.and_then(|number| number.parse::<usize>().ok());
            let state = number.and_then(|number| self.block.states.get_mut(number.checked_sub(1)?));
            let Some(state) = state else {
                return wrong(line.span, "there is no such state", "");
            };
            for word in words(&line.note) {
                let Some((algorithm, output)) = word.split_once('/') else {
                    let help = "each action is written Algorithm/Event; either may be missing";
                    return wrong(line.span, format!("{word} is no action"), help);
                };
                let text = |name: &str| {
                    (!name.is_empty()).then(|| Text { text: name.to_owned(), span: line.span })
                };
                let (algorithm, output) = (text(algorithm), text(output));
                state.actions.push(Action { algorithm, output });
            }
        }
        Ok(())
    }

    fn algorithms(&mut self, section: Span) -> Outcome<()> {
        let begin = lines(self.text, section);
        if begin.is_empty() {
            return Ok(());
        }
        let switch = begin.iter().find(|line| line.code == format!("switch {RUNNING}"));
        let Some(switch) = switch else {
            let at = begin.first().map_or(section, |line| line.span);
            let help = format!("for {RUNNING} = E_ALG, and then: switch {RUNNING}");
            return wrong(at, "this does not begin the algorithms", &help);
        };
        let part = Span { start: switch.span.end, end: section.end };
        let mut translator = Translator::new(&self.block, self.text, part);
        let bodies = translator.bodies()?;
        let different = std::mem::take(&mut translator.differs);
        self.differences(different);
        for (at, body) in bodies.into_iter().enumerate() {
            if body.number.text(self.text) != (at + 1).to_string() {
                let help = format!("the next one is case {}", at + 1);
                return wrong(body.number, "algorithms follow each other", &help);
            }
            let note = pieces(body.note.text(self.text).trim_start_matches('%'));
            let (found, comment) = said(note);
            let name = words(&found).first().copied().unwrap_or("").to_owned();
            let name = Text { text: name, span: body.note };
            let text = Text { text: body.text, span: body.span };
            self.block.algorithms.push(Algorithm { name, comment, text });
        }
        Ok(())
    }

    fn differences(&mut self, all: Vec<Wrong>) {
        for Wrong { span, message, help } in all {
            let warning = Diagnostic::new(Code::MatlabDiffers, span, message);
            self.diagnostics.push(warning.help(help));
        }
    }
}

fn undeclared(name: Text) -> Variable {
    Variable {
        name,
        of_type: DataType::Int,
        type_span: Span::default(),
        size: None,
        initial: None,
        comment: String::new(),
    }
}

/// What a note says that the value does not: the type, and how the value is written in ST.
fn noted(note: &[Piece], plain: &Constant) -> Option<Constant> {
    let of_type = words(note).first().and_then(|word| DataType::of(word))?;
    let initial = note.iter().find_map(|piece| match piece {
        Piece::Text(text) => Some(text.clone()),
        Piece::Word(_) => None,
    });
    let is_same = class(of_type) == class(plain.of_type);
    is_same.then_some(Constant { of_type, size: plain.size, initial })
}

fn pairs(note: &[Piece]) -> Vec<(String, String)> {
    let mut pairs = Vec::new();
    let mut name = "";
    for piece in note {
        match piece {
            Piece::Word(word) => name = word,
            Piece::Text(value) => pairs.push((name.to_owned(), value.clone())),
        }
    }
    pairs
}

fn place(words: &[&str]) -> Option<Place> {
    let number = |at: usize| words.get(at)?.parse::<f64>().ok().filter(|one| one.is_finite());
    Some(Place { x: number(0)?, y: number(1)? })
}
