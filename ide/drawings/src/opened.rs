//! A text with charts that is open: drawn, and edited if it can be read.

use chart::drawing;
use chart::edit::{ChartPath, Editing, Element, Undo};
use chart::model::Chart;
use chart::text::{Document, Reading, read};
use diagnostics::Source;

use crate::conditions::Condition;
use crate::protocol::{Charts, Edit, ElementId, Judged, Judgement, Mistake};
use crate::{drawn, places, wanted};

/// A text that is open.
#[derive(Debug)]
pub struct Opened {
    source: Source,
    /// What a chart is called that is not there yet.
    name: String,
    content: Content,
}

/// What a text is.
#[derive(Debug)]
enum Content {
    /// Charts, which can be edited.
    Charts(Editing),
    /// What could be read of charts, and why they cannot be edited.
    Broken(Document, Mistake),
}

impl Opened {
    /// Reads a text.
    pub fn of(text: String, name: String) -> Result<Opened, String> {
        let source = source(&name, text)?;
        let Reading { document, diagnostics, .. } = read(&source);
        let mistake = diagnostics.first().map(|error| Mistake::of(&source, error));
        let content = match mistake {
            Some(mistake) => Content::Broken(document, mistake),
            None => match Editing::of(document.clone(), &name) {
                Ok(editing) => Content::Charts(editing),
                Err(refusal) => {
                    Content::Broken(document, Mistake { line: 1, message: refusal.to_string() })
                }
            },
        };
        Ok(Opened { source, name, content })
    }

    /// Whether it is of this text.
    pub fn is(&self, text: &str, name: &str) -> bool {
        self.source.text == text && self.name == name
    }

    /// The text as it is.
    pub fn text(&self) -> &str {
        &self.source.text
    }

    /// Its charts, and why they cannot be edited.
    fn document(&self) -> (&Document, Option<Mistake>) {
        match &self.content {
            Content::Charts(editing) => (editing.document(), None),
            Content::Broken(document, mistake) => (document, Some(mistake.clone())),
        }
    }

    /// Its charts, drawn without those that are folded.
    pub fn draw(&self, folded: &[String]) -> Charts {
        let (document, mistake) = self.document();
        match drawing::draw(document.charts(), &self.source) {
            Ok(drawing) => {
                let drawing = drawing.without(|sheet| folded.contains(&sheet.name));
                drawn::charts(&drawing, document, mistake)
            }
            Err(too_large) => {
                Charts { obstacle: Some(too_large.to_string()), mistake, ..Charts::default() }
            }
        }
    }

    /// Carries all edits out, or none; says what is to be selected then.
    pub fn edit(&mut self, chart: usize, edits: Vec<Edit>) -> Result<Vec<ElementId>, String> {
        let name = self.name.clone();
        let (editing, path) = self.editing(chart)?;
        let mut undo = Vec::new();
        let mut select = Vec::new();
        for edit in edits {
            match apply(editing, &path, edit) {
                Ok((back, elements)) => {
                    undo.push(back);
                    select = elements;
                }
                Err(message) => {
                    undo.into_iter().rev().for_each(|back| drop(editing.take_back(back)));
                    return Err(message);
                }
            }
        }
        let source = source(&name, editing.text())?;
        editing.locate(&read(&source).document);
        self.source = source;
        Ok(select)
    }

    /// For each edit why it would be refused.
    pub fn allowed(
        &mut self,
        chart: usize,
        edits: Vec<Edit>,
    ) -> Result<Vec<Option<String>>, String> {
        let (editing, path) = self.editing(chart)?;
        let tried = edits.into_iter().map(|edit| match apply(editing, &path, edit) {
            Ok((back, _)) => {
                editing.take_back(back);
                None
            }
            Err(message) => Some(message),
        });
        Ok(tried.collect())
    }

    /// Steps with the transitions among them, as a text.
    pub fn copy(&mut self, chart: usize, steps: &[ElementId]) -> Result<String, String> {
        let (editing, path) = self.editing(chart)?;
        editing.copy(&path, &wanted::steps(steps)?).map_err(|refusal| refusal.to_string())
    }

    /// What conditions are with values; of a transition that is not there nothing is known.
    pub fn judge(&self, transitions: &[Judged]) -> Vec<Judgement> {
        let (document, _) = self.document();
        let charts: Vec<&Chart> = document.charts().flat_map(Chart::with_inner).collect();
        let judgement = |judged: &Judged| {
            let Element::Transition(id) = judged.transition.0 else { return None };
            let condition = &charts.get(judged.chart)?.transitions.get(&id)?.condition.text;
            Some(Condition::of(condition, &[]).judge(&judged.values))
        };
        transitions.iter().map(|one| judgement(one).unwrap_or_default()).collect()
    }

    /// The document, and where a sheet is in it.
    fn editing(&mut self, chart: usize) -> Result<(&mut Editing, ChartPath), String> {
        match &mut self.content {
            Content::Broken(_, Mistake { line, message }) => {
                Err(format!("the text is to be mended first, line {line}: {message}"))
            }
            Content::Charts(editing) => {
                let path = editing.charts().nth(chart).map(|(path, _)| path.clone());
                let path = path.ok_or("there is no such chart in the file")?;
                Ok((editing, path))
            }
        }
    }
}

/// A chart without a program around it is called as its file.
fn source(name: &str, text: String) -> Result<Source, String> {
    Source::new(format!("{name}.sfc"), text).map_err(|error| error.to_string())
}

/// Carries an edit out: what takes it back, and what it is about.
fn apply(
    editing: &mut Editing,
    path: &ChartPath,
    edit: Edit,
) -> Result<(Undo, Vec<ElementId>), String> {
    let chart = editing.chart(path).ok_or("there is no such chart in the file")?;
    let edit = places::as_seen(wanted::edit(edit)?, chart);
    let done = editing.apply(path, &edit).map_err(|refusal| refusal.to_string())?;
    Ok((done.undo, done.select.into_iter().map(ElementId).collect()))
}
