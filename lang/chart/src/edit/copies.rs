//! Copies of steps as text, and what becomes of them where they are pasted.

use std::collections::{BTreeMap, BTreeSet};

use diagnostics::Source;

use super::change::Change;
use super::draft::{Draft, Outcome};
use super::editing::Editing;
use super::kinds::{ChartPath, Edit, Element};
use super::naming::numbered;
use super::refusal::Refusal;
use crate::model::{ActionId, Chart, Position, Step, StepId, Transition, TransitionId};
use crate::text::{Document, Piece, read, write};

/// Steps of a copy that have no places are below each other.
const ROW: i32 = 100;

impl Editing {
    /// Steps with the transitions among them, and with the code of their actions, as text.
    pub fn copy(&self, path: &ChartPath, steps: &BTreeSet<StepId>) -> Result<String, Refusal> {
        let chart = self.chart(path).ok_or(Refusal::NoChart)?;
        if steps.is_empty() {
            return Err(Refusal::Nothing);
        }
        let mut copy = Chart::new(&chart.name);
        copy.standard = chart.standard;
        let mut new_ids = BTreeMap::new();
        let mut actions: BTreeMap<ActionId, ActionId> = BTreeMap::new();
        for id in steps {
            let step = chart.steps.get(id).ok_or_else(|| Refusal::NoStep(format!("{}", id.0)))?;
            let mut step = step.clone();
            for instance in &mut step.block {
                if let Some(action) = chart.actions.get(&instance.action) {
                    instance.action = *actions
                        .entry(instance.action)
                        .or_insert_with(|| copy.add_action(action.clone()));
                }
            }
            new_ids.insert(*id, copy.add_step(step));
        }
        let among = chart
            .transitions
            .values()
            .filter(|one| one.from.is_subset(steps) && one.to.is_subset(steps));
        for one in among {
            copy.add_transition(moved(one, &new_ids));
        }
        Ok(write(&Document { pieces: vec![Piece::Chart(copy)] }))
    }
}

/// A transition whose steps have other ids.
fn moved(one: &Transition, ids: &BTreeMap<StepId, StepId>) -> Transition {
    let side =
        |steps: &BTreeSet<StepId>| steps.iter().filter_map(|id| ids.get(id)).copied().collect();
    Transition { from: side(&one.from), to: side(&one.to), ..one.clone() }
}

/// The chart of a copy, for editing.
fn copied(text: &str) -> Outcome<(Editing, ChartPath)> {
    let not_a_copy = |why: &str| Refusal::NotACopy(why.to_owned());
    let source = Source::new("copy.sfc", text).map_err(|_| not_a_copy("it is too long"))?;
    let reading = read(&source);
    if let Some(first) = reading.diagnostics.first() {
        return Err(Refusal::NotACopy(first.message.clone()));
    }
    let is_blank = |piece: &Piece| matches!(piece, Piece::Text(text) if text.trim().is_empty());
    let mut document = reading.document;
    document.pieces.retain(|piece| !is_blank(piece));
    match &document.pieces[..] {
        [Piece::Chart(chart)] if !chart.steps.is_empty() => {}
        _ => return Err(not_a_copy("it is something else than steps and transitions")),
    }
    let editing = Editing::of(document, "")?;
    let path = editing.charts.keys().next().cloned().ok_or(Refusal::NoChart)?;
    Ok((editing, path))
}

impl Draft<'_> {
    pub(super) fn paste(&mut self, text: &str, at: Option<Position>) -> Outcome {
        let (mut copy, path) = copied(text)?;
        self.give_free_names(&mut copy, &path)?;
        let Some(Piece::Chart(copy)) = copy.document.pieces.pop() else {
            return Err(Refusal::NoChart);
        };
        if copy.standard != self.chart()?.standard {
            return Err(Refusal::OtherStandard);
        }
        let (places, by) = self.places_of_copy(&copy, at)?;
        let actions = self.paste_actions(&copy)?;
        let ids = self.paste_steps(&copy, &actions, &places)?;
        for one in copy.transitions.values() {
            let mut one = moved(one, &ids);
            one.at = one.at.zip(by).map(|(at, by)| Position { x: at.x + by.x, y: at.y + by.y });
            if let Some(name) = &one.name {
                let names = &self.index()?.transition_names;
                if names.has(&name.to_uppercase()) {
                    let is_free = |name: &str| !names.has(&name.to_uppercase());
                    one.name = Some(numbered(name, 2, is_free));
                }
            }
            let id = TransitionId(self.fresh()?);
            self.put_transition(id, one)?;
        }
        Ok(())
    }

    /// Steps of a copy whose names are not free get others, and what names them follows.
    fn give_free_names(&self, copy: &mut Editing, path: &ChartPath) -> Outcome {
        let steps = copy.chart(path).map(|chart| chart.steps.clone()).unwrap_or_default();
        for (step, Step { name, .. }) in steps {
            if self.editing.is_free(&self.path, &name) {
                continue;
            }
            let is_free =
                |name: &str| self.editing.is_free(&self.path, name) && copy.is_free(path, name);
            let name = numbered(&name, 2, is_free);
            copy.apply(path, &Edit::Rename { step, name })?;
        }
        Ok(())
    }

    /// The places of steps of a copy, none where the layout is automatic, and how far all of it is
    /// moved.
    fn places_of_copy(
        &self,
        copy: &Chart,
        at: Option<Position>,
    ) -> Outcome<(BTreeMap<StepId, Position>, Option<Position>)> {
        let steps = copy.steps.iter();
        let own: Option<Vec<(StepId, Position)>> =
            steps.map(|(id, step)| Some((*id, step.at?))).collect();
        let is_empty = self.chart()?.steps.is_empty();
        let corner = match at {
            Some(at) => at,
            None if is_empty => match own.iter().flatten().min_by_key(|(_, at)| (at.y, at.x)) {
                Some((_, at)) => *at,
                None => return Ok((BTreeMap::new(), None)),
            },
            None => match self.place_below_all()? {
                Some(at) => at,
                None => return Ok((BTreeMap::new(), None)),
            },
        };
        let has_own = own.is_some();
        let below = |(id, row): (&StepId, i32)| (*id, Position { x: 0, y: row * ROW });
        let own = own.unwrap_or_else(|| copy.steps.keys().zip(0..).map(below).collect());
        let Some(first) = own.iter().map(|(_, at)| *at).min_by_key(|at| (at.y, at.x)) else {
            return Ok((BTreeMap::new(), None));
        };
        let by =
            Position { x: corner.x.saturating_sub(first.x), y: corner.y.saturating_sub(first.y) };
        let moved =
            |at: Position| Position { x: at.x.saturating_add(by.x), y: at.y.saturating_add(by.y) };
        let places = own.into_iter().map(|(id, at)| (id, moved(at))).collect();
        Ok((places, has_own.then_some(by)))
    }

    /// Actions of a copy are those of the same name, or new ones.
    fn paste_actions(&mut self, copy: &Chart) -> Outcome<BTreeMap<ActionId, ActionId>> {
        let mut ids = BTreeMap::new();
        for (old, action) in &copy.actions {
            let found = self.index()?.names.of(&action.name.to_uppercase()).next().copied();
            let id = match found {
                Some(Element::Action(id)) => id,
                Some(_) => return Err(Refusal::Taken(action.name.clone())),
                None => {
                    let id = ActionId(self.fresh()?);
                    self.set_here(Change::Action(id, Some(action.clone())));
                    id
                }
            };
            ids.insert(*old, id);
        }
        Ok(ids)
    }

    /// Steps of a copy: in a chart that has steps none of them is initial.
    fn paste_steps(
        &mut self,
        copy: &Chart,
        actions: &BTreeMap<ActionId, ActionId>,
        places: &BTreeMap<StepId, Position>,
    ) -> Outcome<BTreeMap<StepId, StepId>> {
        let has_initial = copy.initial_steps().next().is_some();
        let mut ids = BTreeMap::new();
        for (old, step) in &copy.steps {
            let mut step = step.clone();
            let is_first = self.chart()?.steps.is_empty();
            let no_initial = self.index()?.initial.is_empty();
            step.is_initial = no_initial && (step.is_initial || is_first && !has_initial);
            step.at = places.get(old).map(|at| self.free(*at)).transpose()?;
            for instance in &mut step.block {
                if let Some(id) = actions.get(&instance.action) {
                    instance.action = *id;
                }
            }
            let id = StepId(self.fresh()?);
            self.put_step(id, step)?;
            self.select.push(Element::Step(id));
            ids.insert(*old, id);
        }
        Ok(ids)
    }
}
