//! The charts that the page shows: their data, and the steps whose bits the PLC is asked for. How
//! a text becomes a drawing, the library `chart` says.

use analysis::drawing::shapes::{Drawing, Look, Point, Rect, Sheet, StepShape, TransitionShape};
use analysis::drawing::{self, TooLarge};

use analysis::chart::Chart;
use analysis::chart::model::Standard;

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
    /// What is drawn, sheet by sheet.
    pub charts: Vec<Chart>,
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
            sheets: self.sheets().iter().zip(&self.charts).map(sheet).collect(),
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

fn sheet((sheet, chart): (&Sheet, &Chart)) -> page::Sheet {
    page::Sheet {
        name: sheet.name.clone(),
        title: point(&sheet.title),
        origin: point(&sheet.origin),
        is_placed: sheet.is_placed,
        is_grafcet: chart.standard == Standard::Grafcet,
        steps: sheet.steps.iter().map(|one| step(one, chart)).collect(),
        transitions: sheet.transitions.iter().map(|one| transition(sheet, one, chart)).collect(),
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

fn step(shape: &StepShape, chart: &Chart) -> page::Step {
    let look = match shape.look {
        Look::Plain => "plain",
        Look::Macro => "macro",
        Look::Enclosing => "enclosing",
    };
    let step = chart.steps.get(&shape.id).cloned().unwrap_or_default();
    // Forcing orders are drawn below the instances.
    let mut instances = step.block.iter().zip(0..).map(|(one, index)| {
        let action = chart.actions.get(&one.action).map_or("", |action| &action.name);
        page::Instance {
            index,
            qualifier: one.qualifier.text().to_owned(),
            time: one.time.as_ref().map(|time| time.text.clone()),
            action: action.to_owned(),
        }
    });
    let actions = shape.actions.iter().map(|action| page::Action {
        frame: frame(action.frame),
        divider: action.divider,
        qualifier: action.qualifier.clone(),
        name: action.name.clone(),
        instance: instances.next(),
    });
    page::Step {
        line: shape.line as u32,
        name: shape.name.clone(),
        note: shape.note.clone(),
        frame: frame(shape.frame),
        is_initial: shape.is_initial,
        is_linked: shape.is_linked,
        look: look.to_owned(),
        actions: actions.collect(),
        full_name: step.name,
        comment: step.comment,
        is_placed: step.at.is_some(),
    }
}

fn transition(sheet: &Sheet, shape: &TransitionShape, chart: &Chart) -> page::Transition {
    let place = |id: &drawing::StepId| sheet.steps.iter().position(|step| step.id == *id);
    let side = |ids: &[drawing::StepId]| ids.iter().filter_map(place).map(|at| at as u32).collect();
    let points = |points: &Vec<Point>| points.iter().map(point).collect();
    let one = chart.transitions.get(&shape.id).cloned().unwrap_or_default();
    page::Transition {
        line: shape.line as u32,
        title: shape.title.clone(),
        from: side(&shape.from),
        to: side(&shape.to),
        bar: line(&shape.bar),
        text: shape.text.clone(),
        label: point(&shape.label),
        lines: shape.lines.iter().map(points).collect(),
        doubles: shape.doubles.iter().map(line).collect(),
        arrows: shape.arrows.iter().map(point).collect(),
        condition: one.condition.text,
        name: one.name,
        priority: one.priority,
        comment: one.comment,
        is_placed: one.at.is_some(),
    }
}
