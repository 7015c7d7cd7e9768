//! Drawings of the IDE: draws charts and changes them, draws diagrams of blocks, sends events to a
//! block of IEC 61499. Questions in, answers out; the text is all there is of a drawing, and
//! nothing is known here of PLCs and of the page.
//!
//! [`Drawings`] answers, [`protocol`] is what it is asked. A page loads it when a drawing is looked
//! at for the first time; the same code runs natively in tests.

mod conditions;
mod diagrams;
mod drawn;
mod events;
mod geometry;
mod opened;
mod places;
pub mod protocol;
mod set_reset;
mod wanted;

use opened::Opened;
use protocol::{Answer, Number, Question, Reply, Request};

/// What answers. It keeps the text with charts that it was asked about last, so that elements are
/// the same ones from edit to edit.
#[derive(Debug, Default)]
pub struct Drawings {
    opened: Option<Opened>,
}

impl Drawings {
    /// As [`answer`](Drawings::answer), both as JSON.
    pub fn request_json(&mut self, request: &str) -> String {
        let reply = match serde_json::from_str(request) {
            Ok(Request { id, question }) => Reply::of(id, self.answer(question)),
            // What is no question has a number all the same, unless it is no request.
            Err(error) => {
                let number = serde_json::from_str(request).map_or(0, |Number { id }| id);
                Reply::of(number, Err(error.to_string()))
            }
        };
        // Numbers, texts and lists of them always are JSON.
        serde_json::to_string(&reply).unwrap_or_default()
    }

    /// Answers, or says why not.
    pub fn answer(&mut self, question: Question) -> Result<Answer, String> {
        match question {
            Question::Draw { text, name, folded } => {
                Ok(Answer::Charts(self.open(text, name)?.draw(&folded)))
            }
            Question::Edit { text, name, folded, chart, edits } => {
                let opened = self.open(text, name)?;
                let select = opened.edit(chart, edits)?;
                let (text, charts) = (opened.text().to_owned(), opened.draw(&folded));
                Ok(Answer::Edited { text, charts, select })
            }
            Question::Allowed { text, name, chart, edits } => {
                Ok(Answer::Allowed(self.open(text, name)?.allowed(chart, edits)?))
            }
            Question::Copy { text, name, chart, steps } => {
                Ok(Answer::Copy(self.open(text, name)?.copy(chart, &steps)?))
            }
            Question::Judge { text, name, transitions } => {
                Ok(Answer::Judged(self.open(text, name)?.judge(&transitions)))
            }
            Question::Convert { text, name, variables, target } => {
                Ok(Answer::Converted(set_reset::convert(&name, text, variables, &target)?))
            }
            Question::Diagrams { text, name, others } => {
                Ok(Answer::Diagrams(diagrams::draw(text, name, &others)?))
            }
            Question::EditDiagram { text, name, others, diagram, edit } => {
                diagrams::edit(text, name, &others, (diagram, edit))
            }
            Question::CopyDiagram { text, name, others, diagram, elements } => {
                Ok(Answer::Copy(diagrams::copy(text, name, &others, (diagram, elements))?))
            }
            Question::Blocks { text, name, others } => {
                Ok(Answer::Blocks(diagrams::blocks(text, name, &others)?))
            }
            Question::Events { text, name, lines } => {
                Ok(Answer::Events(Box::new(events::events(text, name, &lines)?)))
            }
        }
    }

    /// The text, read anew if it is another one.
    fn open(&mut self, text: String, name: String) -> Result<&mut Opened, String> {
        let kept = self.opened.take().filter(|opened| opened.is(&text, &name));
        let opened = match kept {
            Some(opened) => opened,
            None => Opened::of(text, name)?,
        };
        Ok(self.opened.insert(opened))
    }
}

/// What JavaScript calls.
#[cfg(target_arch = "wasm32")]
mod page {
    use wasm_bindgen::prelude::wasm_bindgen;

    /// [`Drawings`](crate::Drawings); what it takes and gives is JSON.
    #[wasm_bindgen]
    #[derive(Default)]
    pub struct Drawings(crate::Drawings);

    #[wasm_bindgen]
    impl Drawings {
        /// Before any text.
        #[wasm_bindgen(constructor)]
        pub fn new() -> Drawings {
            Drawings::default()
        }

        /// See [`request_json`](crate::Drawings::request_json).
        pub fn request(&mut self, json: &str) -> String {
            self.0.request_json(json)
        }
    }
}
