//! A plant as it is asked for: `station1 noise=2 seed=1`, or the name of a file that describes it,
//! in a scenario and on the command line alike.

use std::ops::Range;

use super::control::Fault;
use super::faults::WithFaults;
use super::file::{PlantErrors, PlantFile, is_plant_file};
use super::{OptionError, Options, PLANTS, Plant, PlantKind, Words};
use crate::problem::Problem;
use awl_asm::suggest::nearest;

/// A plant that there is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum PlantSpec {
    /// One of [`PLANTS`], by its name, with options that it takes.
    Known(&'static str, Options),
    /// One that a file describes.
    Described(PlantFile),
}

impl PlantSpec {
    /// Its name, or that of its file.
    pub fn name(&self) -> &str {
        match self {
            PlantSpec::Known(name, _) => name,
            PlantSpec::Described(file) => &file.name,
        }
    }

    /// Makes the plant, in its state at time 0.
    pub fn build(&self) -> Result<Box<dyn Plant>, OptionError> {
        let (name, options) = match self {
            PlantSpec::Described(file) => return Ok(file.build()),
            PlantSpec::Known(name, options) => (name, options),
        };
        let Some(kind) = PLANTS.iter().find(|kind| kind.name == *name) else {
            return Err(OptionError::new("", format!("there is no plant {name}")));
        };
        let fault = |&(name, effect, [en, de, es]): &(&str, _, [&str; 3])| Fault {
            name: name.to_string(),
            words: Words::new(en, de, es),
            effect,
        };
        let faults = kind.faults.iter().map(fault).collect();
        Ok(Box::new(WithFaults::new((kind.build)(options)?, faults)))
    }
}

/// The plant file that is asked for, without the quotes that it may have.
pub(crate) fn file_of(text: &str) -> Option<&str> {
    let text = text.trim();
    let bare = text.strip_prefix('"').and_then(|text| text.strip_suffix('"')).unwrap_or(text);
    is_plant_file(bare).then_some(bare)
}

/// Why there is no such plant.
#[derive(Debug, Clone)]
pub enum SpecErrors {
    /// What is wrong with the name or the options, with its place there.
    Spec(Vec<Problem>),
    /// What is wrong with the file.
    File(PlantErrors),
}

/// Reads a name and its options, or the name of a plant file. `read`: gives the text of a file, or
/// says in a sentence without full stop why there is none.
pub fn parse_spec_with(
    text: &str,
    read: &mut dyn FnMut(&str) -> Result<String, String>,
) -> Result<PlantSpec, SpecErrors> {
    let Some(name) = file_of(text) else { return parse_spec(text).map_err(SpecErrors::Spec) };
    let at = text.find(name).unwrap_or(0);
    let missing = |message| SpecErrors::Spec(vec![Problem::new(at..at + name.len(), message)]);
    let file = PlantFile::read(name, &read(name).map_err(missing)?);
    file.map(PlantSpec::Described).map_err(SpecErrors::File)
}

/// Reads a name and its options. Problems have their places in `text`.
pub fn parse_spec(text: &str) -> Result<PlantSpec, Vec<Problem>> {
    let mut words = words_of(text);
    if let Some(name) = file_of(text) {
        let message = format!("{name} cannot be read here: no files are at hand");
        return Err(vec![Problem::new(0..text.len(), message)]);
    }
    let Some((name_span, name)) = words.next() else {
        return Err(vec![
            Problem::new(0..1, "the name of a plant is missing").help(list_of_plants()),
        ]);
    };
    let Some(kind) = PLANTS.iter().find(|kind| kind.name == name) else {
        return Err(vec![unknown_plant(name_span, name)]);
    };
    let mut problems = Vec::new();
    let mut options = Options::default();
    let mut spans = Vec::new();
    for (span, word) in words {
        match option(kind, word, &options) {
            Ok((key, value)) => {
                options.0.push((key.to_string(), value.to_string()));
                spans.push(span);
            }
            Err(problem) => problems.push(Problem { span, ..problem }),
        }
    }
    if let Err(error) = (kind.build)(&options) {
        let place = options.0.iter().position(|(key, _)| key == error.key);
        let span = place.map_or(name_span, |place| spans[place].clone());
        problems.push(Problem::new(span, error.message));
    }
    if problems.is_empty() { Ok(PlantSpec::Known(kind.name, options)) } else { Err(problems) }
}

fn words_of(text: &str) -> impl Iterator<Item = (Range<usize>, &str)> {
    text.split_whitespace().map(move |word| {
        // Both point into the same text, so the difference is the word's place.
        let start = word.as_ptr() as usize - text.as_ptr() as usize;
        (start..start + word.len(), word)
    })
}

fn option<'a>(
    kind: &PlantKind,
    word: &'a str,
    earlier: &Options,
) -> Result<(&'a str, &'a str), Problem> {
    let (key, value) = word.split_once('=').unwrap_or((word, ""));
    if !kind.options.iter().any(|(known, _)| *known == key) {
        let suggestion = nearest(key, kind.options.iter().map(|(known, _)| *known));
        let problem = Problem::new(0..0, format!("the plant {} has no option {key}", kind.name));
        return Err(problem.help(list_of_options(kind)).did_you_mean(suggestion));
    }
    if value.is_empty() {
        return Err(Problem::new(0..0, format!("write {key}=value, without blanks")));
    }
    if earlier.text(key).is_some() {
        return Err(Problem::new(0..0, format!("{key} is given twice")));
    }
    Ok((key, value))
}

fn unknown_plant(span: Range<usize>, name: &str) -> Problem {
    let suggestion = nearest(name, PLANTS.iter().map(|kind| kind.name));
    Problem::new(span, format!("there is no plant {name}"))
        .help(list_of_plants())
        .did_you_mean(suggestion)
}

fn list_of_plants() -> String {
    let list: Vec<_> = PLANTS.iter().map(|kind| format!("{} ({})", kind.name, kind.doc)).collect();
    format!("the plants are: {}, and those that a file NAME.plant describes", list.join(", "))
}

fn list_of_options(kind: &PlantKind) -> String {
    let list: Vec<_> = kind.options.iter().map(|(key, takes)| format!("{key}={takes}")).collect();
    format!("its options are: {}", list.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_plant_with_options() {
        let spec = parse_spec("station1 pieces=small,207 seed=7").unwrap();
        let PlantSpec::Known(name, options) = spec else { panic!("it needs no file") };
        assert_eq!(name, "station1");
        assert_eq!(options.text("pieces"), Some("small,207"));
        assert_eq!(options.text("noise"), None);
    }

    #[test]
    fn every_mistake_has_its_place_and_help() {
        let problems = parse_spec("station1 nois=2 seed=1 seed=2 button").unwrap_err();
        let spans: Vec<_> = problems.iter().map(|problem| problem.span.clone()).collect();
        assert_eq!(spans, [9..15, 23..29, 30..36]);
        assert_eq!(problems[0].suggestion.as_deref(), Some("noise"));
        let value = parse_spec("tank level=101").unwrap_err();
        assert_eq!(value[0].span, 5..14);
        assert!(value[0].message.contains("0 to 100"), "{}", value[0].message);
    }

    #[test]
    fn unknown_plant_lists_all() {
        let problems = parse_spec("press").unwrap_err();
        let help = problems[0].help.clone().unwrap();
        assert!(PLANTS.iter().all(|kind| help.contains(kind.name)), "{help}");
    }
}
