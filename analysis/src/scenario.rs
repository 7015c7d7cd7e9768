//! Scenarios: what editors ask about one. All of it comes from the simulator's parser; which
//! operands there are, the program says.

use awl_asm::Address;
use awl_asm::ast::{Symbol, Value};
use awl_sim::machine::Machine;
use awl_sim::machine::host::Host;
use awl_sim::open::overwritten;
use awl_sim::operand::{Operand, stem};
use awl_sim::plant::{PLANTS, PlantSpec};
use awl_sim::problem;
use awl_sim::scenario::{
    AFTER_TIME, Context, NoPlant, Reading, STATEMENTS, Word, plant_file_of, plant_of, program_of,
    read,
};
use diagnostics::{Diagnostic, Span};

use crate::answer::{Completion, CompletionKind, Outline, Problem, Refusal};
use crate::explain::{address_words, symbol_line, value_words};
use crate::language::{Text, View, word_around};
use crate::names::joined;
use crate::structured;
use crate::subject::{Mention, Subject};

/// Scenarios of the simulator.
pub(crate) struct Scenario;

impl Text for Scenario {
    fn problems(&self, view: View<'_>) -> Vec<Problem> {
        // Without its program no symbol is known: that says more than each of them.
        let Some(model) = view.model else { return vec![without_program(view)] };
        // Nor are there any while the program has errors that keep it from becoming AWL.
        if model.is_without_awl() {
            return Vec::new();
        }
        let Reading { scenario, mut problems, .. } = reading(view);
        let lost = scenario.lost_settings(&overwritten(&model.assembly));
        let lost = lost.into_iter().map(|warning| Problem::of(warning, view.text()));
        let no_plant = plant(view).err();
        // That it was not given says less than why.
        problems.retain(|problem| no_plant.as_ref().is_none_or(|one| one.span != problem.span));
        let problems = problems.into_iter().chain(no_plant);
        let errors = problems.map(|problem| Problem::of(problem.diagnostic(), view.text()));
        errors.chain(lost).collect()
    }

    fn mentions(&self, view: View<'_>) -> Vec<Mention> {
        let text = view.text();
        let spans = reading(view).operands.into_iter();
        let spans = spans.map(|span| Span::new(span.start, span.end.min(text.len())));
        let mentions = spans.flat_map(|span| mentions(view, span));
        mentions.chain(programs(view)).chain(plant_file(view)).collect()
    }

    fn word_at(&self, view: View<'_>, offset: usize) -> Option<Mention> {
        let word = word_around(view.text(), offset);
        let written = word.text(view.text());
        let mut words = STATEMENTS.iter().chain(&AFTER_TIME);
        let found = words.find(|row| row.word.eq_ignore_ascii_case(written))?;
        let text = format!("**{}**: {}\n\n`{}`", found.word, found.doc, found.example);
        Some(Mention::word(word, text))
    }

    fn completions(&self, view: View<'_>, offset: usize) -> Vec<Completion> {
        completions(view, offset)
    }

    fn outline(&self, _: View<'_>) -> Vec<Outline> {
        Vec::new()
    }

    fn formatted(&self, _: View<'_>) -> Result<String, Refusal> {
        Err(Refusal("a scenario has no canonical layout".to_owned()))
    }

    fn written(&self, name: &str) -> String {
        let is_bare = name.chars().all(|c| c.is_alphanumeric() || c == '_');
        if is_bare { name.to_owned() } else { format!("\"{name}\"") }
    }
}

fn without_program(view: View<'_>) -> Problem {
    let named = programs(view).into_iter().find(
        |mention| matches!(&mention.subject, Subject::File(name) if view.missing.contains(name)),
    );
    let span = named.map_or(Span::default(), |mention| mention.span);
    let what = match span.text(view.text()) {
        "" => "the program of this scenario",
        file => file,
    };
    let diagnostic = Diagnostic::new((), span, format!("{what} is not in the project"))
        .help("a line `program FILE` names it, or it has the same name and ends in .awl or .st");
    Problem::of(diagnostic, view.text())
}

fn symbols<'p>(view: View<'p>) -> &'p [Symbol] {
    view.model.map_or(&[], |model| &model.assembly.program.symbols)
}

/// The scenario as it is read beside its program. One with errors has any operand.
fn reading(view: View<'_>) -> Reading {
    let image = view.model.and_then(|model| model.assembly.image.clone());
    let mut host = image.map(|image| Host::new(image, Box::new(|_| String::new())));
    let mut has_operand = |operand: Operand| match &mut host {
        Some(host) => host.read(operand).map(drop),
        None => Ok(()),
    };
    let plant = plant(view).ok().flatten();
    let context =
        Context { symbols: symbols(view), plant: plant.as_ref(), has_operand: &mut has_operand };
    read(&view.source.name, view.text(), context)
}

/// The names of an operand: of Structured Text each part of `Main.Delay.ET`.
fn mentions(view: View<'_>, span: Span) -> Vec<Mention> {
    let written = span.text(view.text());
    let bare = written.trim_matches('"');
    let start = span.start as usize + usize::from(written.starts_with('"'));
    let parts =
        view.model.map(|model| structured::mentions_in(bare, start, model)).unwrap_or_default();
    if parts.is_empty() { mention(view, span).into_iter().collect() } else { parts }
}

/// An operand, without `.cv` and its like.
fn mention(view: View<'_>, span: Span) -> Option<Mention> {
    let written = stem(span.text(view.text()));
    let span = Span { end: span.start + written.len() as u32, ..span };
    let name = written.trim_matches('"').to_lowercase();
    let symbol = symbols(view).iter().find(|symbol| symbol.name.to_lowercase() == name);
    let address = match symbol.map(|symbol| &symbol.value) {
        Some(Value::Address(address)) => Some(*address),
        Some(_) => None,
        None => Some(Address::parse(written).ok()?),
    };
    let subject = match (symbol, address) {
        (None, Some(address)) => Subject::Address(address),
        _ => Subject::Symbol(name),
    };
    Some(Mention { address, ..Mention::of(span, subject) })
}

/// The plant of a file, or what is wrong with it.
fn plant(view: View<'_>) -> Result<Option<PlantSpec>, problem::Problem> {
    let name = &view.source.name;
    let mut read = |file: &str| {
        let text = (view.other)(&joined(name, file)).map(str::to_owned);
        text.ok_or_else(|| format!("{file} is not in the project"))
    };
    plant_of(name, view.text(), &mut read).map_err(|error| {
        let span = plant_file(view)
            .map_or(0..0, |mention| mention.span.start as usize..mention.span.end as usize);
        match error {
            NoPlant::Scenario(problems) => {
                let first = problems.list.into_iter().next();
                first.unwrap_or_else(|| problem::Problem::new(span, "there is no such plant"))
            }
            NoPlant::File(errors) => {
                problem::Problem::new(span, format!("{} has errors", errors.name))
            }
        }
    })
}

/// The file of the line `plant`.
fn plant_file(view: View<'_>) -> Option<Mention> {
    file_mention(view, plant_file_of(view.text())?)
}

/// The files of the line `program`.
fn programs(view: View<'_>) -> Vec<Mention> {
    let files = program_of(view.text()).into_iter().filter(|file| !file.is_empty());
    files.filter_map(|file| file_mention(view, file)).collect()
}

/// A part of the text that names a file.
fn file_mention(view: View<'_>, file: &str) -> Option<Mention> {
    // The difference is its place.
    let start = file.as_ptr() as usize - view.text().as_ptr() as usize;
    let span = Span::new(start, start + file.len());
    Some(Mention::of(span, Subject::File(joined(&view.source.name, file))))
}

fn completions(view: View<'_>, offset: usize) -> Vec<Completion> {
    let text = view.text();
    let offset = word_around(text, offset).end.min(offset as u32) as usize;
    let Some(before) = text.get(..offset) else { return Vec::new() };
    let line = before.rsplit('\n').next().unwrap_or("");
    if line.contains('#') {
        return Vec::new();
    }
    let typed_len = line.len()
        - line.trim_end_matches(|c: char| c.is_alphanumeric() || c == '_' || c == '.').len();
    let (done, _) = line.split_at(line.len() - typed_len);
    let span = Span::new(offset - typed_len, offset);
    let words: Vec<&str> = done.split_whitespace().collect();
    let first = words.first().map(|word| word.to_ascii_lowercase());
    match (first.as_deref(), words.len()) {
        (None, _) => words_of(&STATEMENTS, span),
        (Some("plant"), 1) => {
            let one = |name, doc| value(name, doc, span);
            PLANTS.iter().map(|kind| one(kind.name, kind.doc)).collect()
        }
        (Some("plant"), _) => {
            let kind = PLANTS.iter().find(|kind| words.get(1) == Some(&kind.name));
            let options = kind.map_or(&[][..], |kind| kind.options);
            options.iter().map(|(name, takes)| value(&format!("{name}="), takes, span)).collect()
        }
        (Some("scan" | "run" | "program"), _) | (Some("at" | "every"), 1) => Vec::new(),
        // After a sign is a value.
        _ if done.trim_end().ends_with(['=', '<', '>']) => Vec::new(),
        (Some("at"), 2) => [words_of(&AFTER_TIME, span), operands(view, span)].concat(),
        _ => operands(view, span),
    }
}

fn words_of(table: &[Word], span: Span) -> Vec<Completion> {
    let rows = table.iter().map(|row| Completion {
        doc: row.doc.to_owned(),
        ..Completion::new(row.word, CompletionKind::Keyword, row.example, span)
    });
    rows.collect()
}

fn value(label: &str, detail: &str, span: Span) -> Completion {
    Completion::new(label, CompletionKind::Value, detail, span)
}

/// The symbols of the program for addresses, and the addresses that it names.
fn operands(view: View<'_>, span: Span) -> Vec<Completion> {
    let is_wanted =
        |symbol: &&Symbol| matches!(symbol.value, Value::Address(_)) && !symbol.name.ends_with(']');
    let symbols = symbols(view).iter().filter(is_wanted).map(|symbol| Completion {
        kind: CompletionKind::Symbol,
        doc: symbol_line(symbol),
        ..value(&Scenario.written(&symbol.name), &value_words(&symbol.value), span)
    });
    let used = view.model.map(|model| model.assembly.usage.accesses.keys());
    let used = used.into_iter().flatten().map(|address| Completion {
        kind: CompletionKind::Address,
        ..value(&address.to_string(), &address_words(*address), span)
    });
    symbols.chain(used).collect()
}
