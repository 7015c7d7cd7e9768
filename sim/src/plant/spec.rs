//! A plant as it is asked for: `station1 noise=2 seed=1`, in a scenario and on the command line
//! alike.

use std::ops::Range;

use super::{OptionError, Options, PLANTS, Plant, PlantKind};
use crate::problem::Problem;
use awl_asm::suggest::nearest;

/// A known plant with options that it takes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlantSpec {
    /// Its name in [`PLANTS`].
    pub name: &'static str,
    /// Its options.
    pub options: Options,
}

impl PlantSpec {
    /// Makes the plant, in its state at time 0.
    pub fn build(&self) -> Result<Box<dyn Plant>, OptionError> {
        match PLANTS.iter().find(|kind| kind.name == self.name) {
            Some(kind) => (kind.build)(&self.options),
            None => Err(OptionError::new("", format!("there is no plant {}", self.name))),
        }
    }
}

/// Reads a name and its options. Problems have their places in `text`.
pub fn parse_spec(text: &str) -> Result<PlantSpec, Vec<Problem>> {
    let mut words = words_of(text);
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
    if problems.is_empty() { Ok(PlantSpec { name: kind.name, options }) } else { Err(problems) }
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
    format!("the plants are: {}", list.join(", "))
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
        assert_eq!(spec.name, "station1");
        assert_eq!(spec.options.text("pieces"), Some("small,207"));
        assert_eq!(spec.options.text("noise"), None);
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
