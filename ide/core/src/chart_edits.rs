//! Edits of charts: what the page wants, in its names and numbers, becomes edits of `chart::edit`.

use std::collections::BTreeSet;

use analysis::chart::Chart;
use analysis::chart::edit::{ChartPath, Edit, Editing, Element, Refusal, Wanted};
use analysis::chart::model::{ActionId, Position, Qualifier, StepId, TransitionId};
use analysis::drawing::{Places, places};

use crate::editor::Editor;
use crate::protocol::chart_edit::{Allowed, Change, ChartEdit, Copied, Edited, Selection};

type Outcome<T> = Result<T, String>;

/// The text of a file after edits of its charts.
pub fn edit(editor: &Editor, file: &str, edits: &[ChartEdit]) -> Edited {
    match edited(editor, file, edits) {
        Ok((text, select)) => Edited { text: Some(text), select, refusal: None },
        Err(refusal) => Edited { refusal: Some(refusal), ..Edited::default() },
    }
}

fn edited(editor: &Editor, file: &str, edits: &[ChartEdit]) -> Outcome<(String, Vec<String>)> {
    let mut editing = editor.editing(file)?;
    let mut selected: Vec<(ChartPath, Element)> = Vec::new();
    for ChartEdit { sheet, change } in edits {
        let (path, _) = sheet_of(&editing, *sheet)?;
        let found = apply(&mut editing, &path, change)?;
        if !found.is_empty() {
            selected = found.into_iter().map(|one| (path.clone(), one)).collect();
        }
    }
    let title = |(path, element): &(ChartPath, Element)| {
        let chart = editing.chart(path)?;
        match element {
            Element::Step(id) => chart.steps.get(id).map(|step| step.name.clone()),
            Element::Transition(id) => {
                chart.transitions.get(id).map(|one| chart.transition_title(one))
            }
            Element::Action(_) => None,
        }
    };
    let select = selected.iter().filter_map(title).collect();
    Ok((editing.text(), select))
}

/// The steps that are selected, as text.
pub fn copy(editor: &Editor, file: &str, sheet: u32, selection: &Selection) -> Copied {
    let copied = || -> Outcome<String> {
        let editing = editor.editing(file)?;
        let (path, chart) = sheet_of(&editing, sheet)?;
        let steps = side(&chart, &selection.steps)?;
        editing.copy(&path, &steps).map_err(|refusal| refusal.to_string())
    };
    match copied() {
        Ok(text) => Copied { text: Some(text), refusal: None },
        Err(refusal) => Copied { text: None, refusal: Some(refusal) },
    }
}

/// Which edits are allowed for what is selected.
pub fn allowed(editor: &Editor, file: &str, sheet: u32, selection: &Selection) -> Vec<Allowed> {
    let editing = editor.editing(file);
    let kinds = KINDS.iter().map(|(kind, ask)| {
        let refusal = match &editing {
            Ok(editing) => refusal(&mut editing.clone(), sheet, selection, *ask),
            Err(why) => Some(why.clone()),
        };
        Allowed { kind: (*kind).to_owned(), refusal }
    });
    kinds.collect()
}

/// What has to be tried to know whether an edit is allowed; `None`: that something of this kind is
/// selected is enough.
type Ask = fn(&Chart, &Selection) -> Outcome<Option<Change>>;

const KINDS: [(&str, Ask); 23] = [
    ("addStep", |_, _| Ok(Some(Change::AddStep { at: None, initial: false }))),
    ("addStepAfter", |_, selection| {
        one_element(selection)
            .map(|(step, transition)| Some(Change::AddStepAfter { step, transition }))
    }),
    ("addStepBefore", |_, selection| {
        one_element(selection)
            .map(|(step, transition)| Some(Change::AddStepBefore { step, transition }))
    }),
    ("addStepBetween", |_, selection| {
        one_transition(selection).map(|transition| Some(Change::AddStepBetween { transition }))
    }),
    ("addBranch", |_, selection| branch(selection, false)),
    ("addParallelBranch", |_, selection| branch(selection, true)),
    ("connect", |_, selection| match &selection.steps[..] {
        [from, to] => Ok(Some(Change::Connect { from: vec![from.clone()], to: vec![to.clone()] })),
        _ => Err("two steps are to be selected".to_owned()),
    }),
    ("erase", |_, selection| {
        let Selection { steps, transitions } = selection.clone();
        Ok(Some(Change::Erase { steps, transitions }))
    }),
    ("rename", |_, selection| one_step(selection).map(|_| None)),
    ("setInitial", |_, selection| {
        let step = one_step(selection)?;
        Ok(Some(Change::SetInitial { step, initial: None }))
    }),
    ("setCondition", |_, selection| one_transition(selection).map(|_| None)),
    ("setTransition", |_, selection| one_transition(selection).map(|_| None)),
    ("setAction", |_, selection| one_step(selection).map(|_| None)),
    ("insertAction", |_, selection| one_step(selection).map(|_| None)),
    ("removeAction", |_, selection| {
        let step = one_step(selection)?;
        Ok(Some(Change::RemoveAction { step, index: 0 }))
    }),
    ("clearActions", |_, selection| {
        let step = one_step(selection)?;
        Ok(Some(Change::RemoveAction { step, index: 0 }))
    }),
    ("eraseAction", |chart, _| match chart.actions.values().next() {
        Some(_) => Ok(None),
        None => Err("the chart has no actions".to_owned()),
    }),
    ("moveAction", |_, selection| {
        let step = one_step(selection)?;
        Ok(Some(Change::MoveAction { step, index: 0, to: 1 }))
    }),
    ("place", |_, selection| some(selection)),
    ("layout", |_, _| Ok(Some(Change::Layout))),
    ("paste", |_, _| Ok(None)),
    ("comment", |_, selection| one_element(selection).map(|_| None)),
    ("copy", |_, selection| match selection.steps[..] {
        [] => Err(Refusal::Nothing.to_string()),
        _ => Ok(None),
    }),
];

/// Why an edit is not allowed. What was tried stays in `editing`.
fn refusal(editing: &mut Editing, sheet: u32, selection: &Selection, ask: Ask) -> Option<String> {
    let mut tried = || -> Outcome<()> {
        let (path, chart) = sheet_of(editing, sheet)?;
        side(&chart, &selection.steps)?;
        selection.transitions.iter().try_for_each(|at| transition(&chart, *at).map(|_| ()))?;
        match ask(&chart, selection)? {
            Some(change) => apply(editing, &path, &change).map(|_| ()),
            None => Ok(()),
        }
    };
    tried().err()
}

fn one_step(selection: &Selection) -> Outcome<String> {
    match &selection.steps[..] {
        [one] => Ok(one.clone()),
        _ => Err("one step is to be selected".to_owned()),
    }
}

fn one_transition(selection: &Selection) -> Outcome<u32> {
    match selection.transitions[..] {
        [one] => Ok(one),
        _ => Err("one transition is to be selected".to_owned()),
    }
}

fn one_element(selection: &Selection) -> Outcome<(Option<String>, Option<u32>)> {
    match (&selection.steps[..], &selection.transitions[..]) {
        ([step], []) => Ok((Some(step.clone()), None)),
        ([], [transition]) => Ok((None, Some(*transition))),
        _ => Err("one step or one transition is to be selected".to_owned()),
    }
}

fn some(selection: &Selection) -> Outcome<Option<Change>> {
    let is_empty = selection.steps.is_empty() && selection.transitions.is_empty();
    if is_empty { Err(Refusal::Nothing.to_string()) } else { Ok(None) }
}

fn branch(selection: &Selection, parallel: bool) -> Outcome<Option<Change>> {
    let (step, transition) = one_element(selection)?;
    Ok(Some(Change::AddBranch { step, transition, parallel }))
}

/// A chart by its number in the drawing.
fn sheet_of(editing: &Editing, sheet: u32) -> Outcome<(ChartPath, Chart)> {
    let found = editing.charts().nth(sheet as usize);
    let found = found.map(|(path, chart)| (path.clone(), chart.clone()));
    found.ok_or_else(|| Refusal::NoChart.to_string())
}

/// Carries out what the page wants; what is to be selected then.
fn apply(editing: &mut Editing, path: &ChartPath, change: &Change) -> Outcome<Vec<Element>> {
    let chart = editing.chart(path).ok_or_else(|| Refusal::NoChart.to_string())?;
    let mut select = Vec::new();
    for edit in edits_of(chart, change)? {
        select = editing.apply(path, &edit).map_err(|refusal| refusal.to_string())?.select;
    }
    Ok(select)
}

fn step(chart: &Chart, name: &str) -> Outcome<StepId> {
    chart.step_named(name).ok_or_else(|| Refusal::NoStep(name.to_owned()).to_string())
}

fn side(chart: &Chart, names: &[String]) -> Outcome<BTreeSet<StepId>> {
    names.iter().map(|name| step(chart, name)).collect()
}

fn transition(chart: &Chart, index: u32) -> Outcome<TransitionId> {
    let found = chart.transitions.keys().nth(index as usize).copied();
    found.ok_or_else(|| Refusal::NoTransition.to_string())
}

fn action(chart: &Chart, name: &str) -> Outcome<ActionId> {
    chart.action_named(name).ok_or_else(|| Refusal::NoAction(name.to_owned()).to_string())
}

fn element(chart: &Chart, name: Option<&String>, index: Option<u32>) -> Outcome<Element> {
    match (name, index) {
        (Some(name), _) => step(chart, name).map(Element::Step),
        (None, Some(index)) => transition(chart, index).map(Element::Transition),
        (None, None) => Err(Refusal::Nothing.to_string()),
    }
}

fn wanted(qualifier: &str, time: Option<&String>, action: &str) -> Outcome<Wanted> {
    let found = Qualifier::find(qualifier);
    let qualifier = found.ok_or_else(|| format!("{qualifier}: there is no such qualifier"))?;
    Ok(Wanted { qualifier, time: time.cloned(), action: action.to_owned() })
}

fn position((x, y): (i32, i32)) -> Position {
    Position { x, y }
}

/// The edits of a chart that do what the page wants, one after the other.
fn edits_of(chart: &Chart, change: &Change) -> Outcome<Vec<Edit>> {
    let step = |name: &str| step(chart, name);
    let side = |names: &[String]| side(chart, names);
    let transition = |index: u32| transition(chart, index);
    let element = |name: &Option<String>, index: Option<u32>| element(chart, name.as_ref(), index);
    let mut first = Vec::new();
    let edit = match change {
        Change::AddStep { at, initial } => {
            first.extend(at.iter().flat_map(|_| pinned(chart)));
            Edit::AddStep { at: at.map(position), is_initial: *initial }
        }
        Change::AddStepAfter { step, transition } => Edit::AddAfter(element(step, *transition)?),
        Change::AddStepBefore { step, transition } => Edit::AddBefore(element(step, *transition)?),
        Change::AddStepBetween { transition: index } => {
            Edit::AddAfter(Element::Transition(transition(*index)?))
        }
        Change::AddBranch { step, transition, parallel } => {
            Edit::AddBranch { of: element(step, *transition)?, is_parallel: *parallel }
        }
        Change::Connect { from, to } => Edit::Connect { from: side(from)?, to: side(to)? },
        Change::Erase { steps, transitions } => Edit::Erase {
            steps: side(steps)?,
            transitions: transitions.iter().map(|at| transition(*at)).collect::<Outcome<_>>()?,
        },
        Change::Rename { step: of, name } => Edit::Rename { step: step(of)?, name: name.clone() },
        Change::SetInitial { step: of, initial } => {
            Edit::SetInitial { step: step(of)?, is_initial: initial.unwrap_or(true) }
        }
        Change::SetCondition { transition: of, text } => {
            Edit::SetCondition { transition: transition(*of)?, text: text.clone() }
        }
        Change::SetTransition { transition: of, name, priority, from, to } => {
            let name = name.clone().filter(|name| !name.trim().is_empty());
            let (transition, from, to) = (transition(*of)?, side(from)?, side(to)?);
            Edit::SetTransition { transition, name, priority: *priority, from, to }
        }
        Change::Place { steps, transitions } => {
            first.extend(pinned(chart));
            let steps = steps.iter().map(|one| Ok((step(&one.name)?, position(one.at))));
            let bars = transitions.iter().map(|one| Ok((transition(one.index)?, position(one.at))));
            let transitions = bars.collect::<Outcome<_>>()?;
            Edit::Place { steps: steps.collect::<Outcome<_>>()?, transitions }
        }
        Change::Layout => Edit::Layout,
        Change::Paste { text, at } => {
            first.extend(at.iter().flat_map(|_| pinned(chart)));
            Edit::Paste { text: text.clone(), at: at.map(position) }
        }
        Change::Comment { step, transition, text } => {
            Edit::Comment { of: element(step, *transition)?, text: text.clone() }
        }
        _ => of_block(chart, change)?,
    };
    first.push(edit);
    Ok(first)
}

/// Those of blocks.
fn of_block(chart: &Chart, change: &Change) -> Outcome<Edit> {
    let step = |name: &str| step(chart, name);
    Ok(match change {
        Change::SetAction { step: of, index, qualifier, time, action } => Edit::SetAction {
            step: step(of)?,
            index: *index as usize,
            action: wanted(qualifier, time.as_ref(), action)?,
        },
        Change::InsertAction { step: of, index, qualifier, time, action } => Edit::InsertAction {
            step: step(of)?,
            index: *index as usize,
            action: wanted(qualifier, time.as_ref(), action)?,
        },
        Change::RemoveAction { step: of, index } => {
            Edit::RemoveAction { step: step(of)?, index: *index as usize }
        }
        Change::ClearActions { step: of } => Edit::ClearActions { step: step(of)? },
        Change::MoveAction { step: of, index, to } => {
            Edit::MoveAction { step: step(of)?, index: *index as usize, to: *to as usize }
        }
        Change::EraseAction { action: of } => Edit::EraseAction { action: action(chart, of)? },
        _ => return Err(Refusal::Nothing.to_string()),
    })
}

/// What gives everything in a chart the place where it is drawn: so moving one step never lays out
/// the others anew.
fn pinned(chart: &Chart) -> Vec<Edit> {
    let Places { steps, bars, is_given } = places(chart);
    let has_place = chart.transitions.values().any(|one| one.at.is_some())
        || chart.steps.values().any(|step| step.at.is_some());
    let mut edits = Vec::new();
    if has_place && !is_given {
        edits.push(Edit::Layout);
    }
    let is_other = |id: &StepId, at: &Position| {
        !is_given || chart.steps.get(id).is_some_and(|step| step.at != Some(*at))
    };
    let steps = steps.into_iter().filter(|(id, at)| is_other(id, at));
    let steps: std::collections::BTreeMap<StepId, Position> = steps.collect();
    if !steps.is_empty() {
        edits.push(Edit::Place { steps, transitions: bars });
    }
    edits
}
