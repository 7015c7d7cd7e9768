//! Names of steps: which are free, who says them, and how all who do follow a new one.

use diagnostics::Span;
use st::parser::{parse_expression, parse_statements};
use st::tree::{Expression, ExpressionKind};
use st::visit;

use super::change::Change;
use super::draft::{Draft, Outcome};
use super::editing::Editing;
use super::kinds::{ChartPath, Element};
use super::legible::check_name;
use super::refusal::Refusal;
use crate::hierarchy::Hierarchy;
use crate::model::{Body, Code, Situation, Standard, Step, StepId, is_same_name};
use crate::text::Piece;

/// What a piece of code is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
    Expression,
    Statements,
}

/// Where a piece of code says a name; or why it cannot be read.
fn mentions(code: &str, form: Form, name: &str) -> Result<Vec<Span>, String> {
    let mut spans = Vec::new();
    let mut look = |one: &mut Expression| {
        if let ExpressionKind::Variable(said, _) = &one.kind
            && is_same_name(&said.text, name)
        {
            spans.push(said.span);
        }
        true
    };
    let part = Span::new(0, code.len());
    let found = match form {
        Form::Expression => {
            let (expression, found) = parse_expression(code, part);
            if let Some(mut expression) = expression {
                visit::expressions(&mut expression, &mut look);
            }
            found
        }
        Form::Statements => {
            let (mut statements, found) = parse_statements(code, part);
            visit::in_statements(&mut statements, &mut look);
            found
        }
    };
    spans.sort_unstable();
    spans.dedup();
    found.into_iter().next().map_or(Ok(spans), |first| Err(first.message))
}

/// Calls `found` with each piece of code of an element.
fn each_code(element: &mut Change, found: &mut dyn FnMut(&mut Code, Form) -> Outcome) -> Outcome {
    match element {
        Change::Step(_, Some(step)) => {
            for instance in &mut step.block {
                let codes = [&mut instance.time, &mut instance.condition, &mut instance.event];
                for code in codes.into_iter().flatten() {
                    found(code, Form::Expression)?;
                }
            }
        }
        Change::Transition(_, Some(one)) => {
            found(&mut one.condition, Form::Expression)?;
            if let Some(code) = &mut one.crossing {
                found(code, Form::Statements)?;
            }
        }
        Change::Action(_, Some(action)) => match &mut action.body {
            Body::Variable => found(&mut Code::new(&action.name), Form::Expression)?,
            Body::Code(code) => found(code, Form::Statements)?,
            Body::Chart(_) => {}
        },
        Change::Step(_, None) | Change::Transition(_, None) | Change::Action(_, None) => {}
    }
    Ok(())
}

impl Editing {
    /// The charts of the same program.
    fn relatives(&self, path: &ChartPath) -> impl Iterator<Item = &ChartPath> {
        let piece = path.piece;
        self.charts.keys().filter(move |path| path.piece == piece)
    }

    /// Where code of a chart looks for steps: in the chart, those around, in a GRAFCET all others.
    fn visible(&self, path: &ChartPath) -> Vec<ChartPath> {
        let around = (0..=path.actions.len()).rev().map(|depth| ChartPath {
            piece: path.piece,
            actions: path.actions.iter().take(depth).copied().collect(),
        });
        let mut visible: Vec<ChartPath> = around.collect();
        if self.chart(path).is_some_and(|chart| chart.standard == Standard::Grafcet) {
            let others = self.relatives(path).filter(|one| !visible.contains(one));
            let others: Vec<ChartPath> = others.cloned().collect();
            visible.extend(others);
        }
        visible
    }

    fn has_step(&self, path: &ChartPath, name: &str) -> bool {
        self.charts.get(path).is_some_and(|index| index.step_named(name).is_some())
    }

    /// Whether code of a chart means a step of another one by a name, or would if that had one.
    fn means(&self, from: &ChartPath, name: &str, of: &ChartPath) -> bool {
        let visible = self.visible(from);
        visible.iter().find(|path| *path == of || self.has_step(path, name)) == Some(of)
    }

    fn element(&self, path: &ChartPath, element: Element) -> Option<Change> {
        let chart = self.chart(path)?;
        Some(match element {
            Element::Step(id) => Change::Step(id, Some(chart.steps.get(&id)?.clone())),
            Element::Transition(id) => {
                Change::Transition(id, Some(chart.transitions.get(&id)?.clone()))
            }
            Element::Action(id) => Change::Action(id, Some(chart.actions.get(&id)?.clone())),
        })
    }

    fn title(&self, path: &ChartPath, element: Element) -> String {
        let title = self.chart(path).and_then(|chart| {
            Some(match element {
                Element::Step(id) => chart.steps.get(&id)?.name.clone(),
                Element::Transition(id) => chart.transition_title(chart.transitions.get(&id)?),
                Element::Action(id) => chart.actions.get(&id)?.name.clone(),
            })
        });
        title.unwrap_or_default()
    }

    /// The elements of a chart whose code says a name. What cannot be read says it.
    fn saying(&self, path: &ChartPath, name: &str) -> Vec<Element> {
        let Some(index) = self.charts.get(path) else { return Vec::new() };
        let key = name.to_uppercase();
        let words = index.words.of(&key).copied();
        let says = |one: &Element| {
            let Some(mut element) = self.element(path, *one) else { return false };
            let mut is_said = false;
            let _ = each_code(&mut element, &mut |code, form| {
                is_said |= mentions(&code.text, form, name).map_or(true, |all| !all.is_empty());
                Ok(())
            });
            is_said
        };
        words.filter(says).collect()
    }

    /// The steps whose forcing orders name a step.
    fn forcing(&self, path: &ChartPath, step: StepId) -> Vec<(ChartPath, StepId)> {
        let Some(Piece::Chart(root)) = self.document.pieces.get(path.piece) else {
            return Vec::new();
        };
        if root.standard == Standard::Sfc {
            return Vec::new();
        }
        let hierarchy = Hierarchy::of(root);
        let paths: Vec<&ChartPath> = self.relatives(path).collect();
        let is_it = |(at, id): (usize, StepId)| id == step && paths.get(at) == Some(&path);
        let mut found = Vec::new();
        for ((at, by), one) in hierarchy.steps() {
            let names = one.forcings.iter().flat_map(|forcing| {
                let names = match &forcing.situation {
                    Situation::Steps(names) => names.as_slice(),
                    Situation::Current | Situation::Initial => &[],
                };
                let chart = hierarchy.chart_named(at, &forcing.chart);
                names.iter().filter_map(move |name| Some((chart?, name)))
            });
            let mut named = names.filter_map(|(chart, name)| hierarchy.step_inside(chart, name));
            if let Some(path) = paths.get(at).filter(|_| named.any(is_it)) {
                found.push(((*path).clone(), by));
            }
        }
        found
    }

    /// Who asks for a step, apart from steps of its chart that go, too.
    pub(super) fn asking(
        &self,
        path: &ChartPath,
        id: StepId,
        is_gone: &dyn Fn(&Element) -> bool,
    ) -> Option<String> {
        let name = self.chart(path)?.steps.get(&id)?.name.clone();
        let is_left = |from: &ChartPath, one: &Element| from != path || !is_gone(one);
        for from in self.relatives(path).filter(|from| self.means(from, &name, path)) {
            let mut saying = self.saying(from, &name).into_iter();
            if let Some(one) = saying.find(|one| is_left(from, one)) {
                return Some(self.title(from, one));
            }
        }
        let mut forcing = self.forcing(path, id).into_iter();
        let found = forcing.find(|(from, by)| is_left(from, &Element::Step(*by)));
        found.map(|(from, by)| self.title(&from, Element::Step(by)))
    }

    /// Whether nothing in the program has or says a name.
    pub(super) fn is_free(&self, path: &ChartPath, name: &str) -> bool {
        let name = name.to_uppercase();
        let mut indexes = self.relatives(path).filter_map(|path| self.charts.get(path));
        check_name(&name).is_ok()
            && !self.around.declares(path.piece, &name)
            && !indexes.any(|index| index.names.has(&name) || index.words.has(&name))
    }
}

/// A name with other digits at its end, from a number on: the first that is free.
pub(super) fn numbered(name: &str, from: usize, is_free: impl Fn(&str) -> bool) -> String {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let mut names = (from..).map(|number| format!("{stem}{number}"));
    names.find(|name| is_free(name)).unwrap_or_default()
}

impl Draft<'_> {
    pub(super) fn rename(&mut self, id: StepId, name: &str) -> Outcome {
        let name = name.trim();
        check_name(name)?;
        let old = self.step(id)?.name;
        self.select.push(Element::Step(id));
        if !is_same_name(&old, name) {
            if self.index()?.names.has(&name.to_uppercase()) {
                return Err(Refusal::Taken(name.to_owned()));
            }
            if self.editing.around.declares(self.path.piece, name) {
                return Err(Refusal::Declared(name.to_owned()));
            }
            self.check_not_captured(name)?;
        }
        let forcing = self.editing.forcing(&self.path, id);
        self.follow(&old, name)?;
        for (path, by) in forcing {
            self.follow_forced(path, by, &old, name);
        }
        let step = Step { name: name.to_owned(), ..self.step(id)? };
        self.put_step(id, step)
    }

    /// Code that says the new name already must not mean the step from then on.
    fn check_not_captured(&self, name: &str) -> Outcome {
        for from in self.editing.relatives(&self.path) {
            if !self.editing.means(from, name, &self.path) {
                continue;
            }
            if let Some(one) = self.editing.saying(from, name).first() {
                let by = self.editing.title(from, *one);
                return Err(Refusal::Captured { name: name.to_owned(), by });
            }
        }
        Ok(())
    }

    /// Code that means the step says the new name.
    fn follow(&mut self, old: &str, name: &str) -> Outcome {
        let means = |from: &&ChartPath| self.editing.means(from, old, &self.path);
        let meaning = self.editing.relatives(&self.path).filter(means);
        for from in meaning.cloned().collect::<Vec<_>>() {
            for one in self.editing.saying(&from, old) {
                let by = self.editing.title(&from, one);
                if !self.editing.means(&from, name, &self.path) {
                    return Err(Refusal::Captured { name: name.to_owned(), by });
                }
                let Some(mut element) = self.editing.element(&from, one) else { continue };
                each_code(&mut element, &mut |code, form| {
                    let spans = mentions(&code.text, form, old)
                        .map_err(|message| Refusal::Code { what: by.clone(), message })?;
                    for span in spans.into_iter().rev() {
                        code.text.replace_range(span.start as usize..span.end as usize, name);
                    }
                    Ok(())
                })?;
                self.set(from.clone(), element);
            }
        }
        Ok(())
    }

    fn follow_forced(&mut self, path: ChartPath, by: StepId, old: &str, name: &str) {
        let Some(Change::Step(_, Some(mut step))) = self.editing.element(&path, Element::Step(by))
        else {
            return;
        };
        for forcing in &mut step.forcings {
            if let Situation::Steps(names) = &mut forcing.situation {
                let named = names.iter_mut().filter(|one| is_same_name(one, old));
                named.for_each(|one| name.clone_into(one));
            }
        }
        self.set(path, Change::Step(by, Some(step)));
    }
}
