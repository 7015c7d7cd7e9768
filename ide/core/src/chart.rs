//! The charts that the page shows: their data, and the steps whose bits the PLC is asked for. How
//! a text becomes a drawing is in `chart`.

use analysis::drawing::shapes::{Drawing, Look, Point, Rect, Sheet, StepShape, TransitionShape};
use analysis::drawing::{self, TooLarge};

use crate::protocol::chart as page;

/// Charts with their file.
#[derive(Debug)]
pub struct Charts {
    /// Their number.
    pub id: u32,
    /// The file that they are drawn of.
    pub file: String,
    /// The drawing, or why there is none.
    pub drawing: Result<Drawing, TooLarge>,
}

impl Charts {
    /// For the page.
    pub fn chart(&self) -> page::Chart {
        let drawing = self.drawing.as_ref();
        let (width, height) = drawing.map_or((0, 0), |drawing| (drawing.width, drawing.height));
        page::Chart {
            id: self.id,
            file: self.file.clone(),
            obstacle: drawing.err().map(TooLarge::to_string),
            width,
            height,
            sheets: self.sheets().iter().map(sheet).collect(),
        }
    }

    fn sheets(&self) -> &[Sheet] {
        self.drawing.as_ref().map_or(&[], |drawing| &drawing.sheets)
    }

    /// The variables of the steps, sheet by sheet.
    pub fn variables(&self) -> Vec<String> {
        let steps = self.sheets().iter().flat_map(|sheet| &sheet.steps);
        steps.map(|step| step.variable.clone()).collect()
    }

    /// Which steps are active, sheet by sheet, from what is known of their variables. A macro-step
    /// has none: it is active while a step of its expansion is.
    pub fn situation(&self, known: &[Option<bool>]) -> Vec<Vec<Option<bool>>> {
        let mut known = known.iter().copied();
        let of = |sheet: &Sheet| -> Vec<Option<bool>> {
            sheet.steps.iter().map(|_| known.next().flatten()).collect()
        };
        let own: Vec<Vec<Option<bool>>> = self.sheets().iter().map(of).collect();
        let expansion = |name: &str| {
            let is_it = |sheet: &Sheet| sheet.name.rsplit('.').next() == Some(name);
            let at = self.sheets().iter().position(is_it)?;
            own.get(at)?.iter().copied().try_fold(false, |any, step| Some(any | step?))
        };
        let steps = self.sheets().iter().zip(&own).map(|(sheet, known)| {
            let steps = sheet.steps.iter().zip(known);
            let active = steps.map(|(step, known)| match step.look {
                Look::Macro => known.or_else(|| expansion(&step.note)),
                _ => *known,
            });
            active.collect()
        });
        steps.collect()
    }
}

fn sheet(sheet: &Sheet) -> page::Sheet {
    page::Sheet {
        name: sheet.name.clone(),
        title: point(&sheet.title),
        steps: sheet.steps.iter().map(step).collect(),
        transitions: sheet.transitions.iter().map(|one| transition(sheet, one)).collect(),
    }
}

fn point(point: &Point) -> (i32, i32) {
    (point.x, point.y)
}

fn frame(rect: Rect) -> [i32; 4] {
    [rect.x, rect.y, rect.width, rect.height]
}

fn line((a, b): &(Point, Point)) -> [i32; 4] {
    [a.x, a.y, b.x, b.y]
}

fn step(step: &StepShape) -> page::Step {
    let look = match step.look {
        Look::Plain => "plain",
        Look::Macro => "macro",
        Look::Enclosing => "enclosing",
    };
    let actions = step.actions.iter().map(|action| page::Action {
        frame: frame(action.frame),
        divider: action.divider,
        qualifier: action.qualifier.clone(),
        name: action.name.clone(),
    });
    page::Step {
        line: step.line as u32,
        name: step.name.clone(),
        note: step.note.clone(),
        frame: frame(step.frame),
        is_initial: step.is_initial,
        is_linked: step.is_linked,
        look: look.to_owned(),
        actions: actions.collect(),
    }
}

fn transition(sheet: &Sheet, one: &TransitionShape) -> page::Transition {
    let place = |id: &drawing::StepId| sheet.steps.iter().position(|step| step.id == *id);
    let points = |points: &Vec<Point>| points.iter().map(point).collect();
    page::Transition {
        line: one.line as u32,
        title: one.title.clone(),
        from: one.from.iter().filter_map(place).map(|at| at as u32).collect(),
        bar: line(&one.bar),
        text: one.text.clone(),
        label: point(&one.label),
        lines: one.lines.iter().map(points).collect(),
        doubles: one.doubles.iter().map(line).collect(),
        arrows: one.arrows.iter().map(point).collect(),
    }
}
