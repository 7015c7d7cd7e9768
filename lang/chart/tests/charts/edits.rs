//! Random edits: each leaves a chart that is as it should be, or nothing changed; taken back one by
//! one, they leave what was there before. `CHART_EDITS=1000000` makes that many.

use std::collections::{BTreeMap, BTreeSet};

use chart::drawn::Drawn;
use chart::edit::{ChartPath, Edit, Editing, Element, Wanted};
use chart::model::{ActionId, Chart, Position, Qualifier, Standard, StepId, TransitionId};
use chart::text::{Document, Piece, read, write};
use diagnostics::Source;
use fastrand::Rng;

use crate::random_grafcet;
use crate::random_text::program;

/// Edits of a chart before the next one.
const ROUND: usize = 100;

fn document(text: &str) -> Document {
    let reading = read(&Source::new("Main.sfc", text).expect("a short text"));
    let messages: Vec<&str> = reading.diagnostics.iter().map(|one| &*one.message).collect();
    assert!(messages.is_empty(), "{messages:?} in\n{text}");
    reading.document
}

/// What must be true of charts that are edited.
pub fn check(editing: &Editing) {
    let text = editing.text();
    // It is read as it is written: names once, transitions once, ends that are there, qualifiers
    // with their times. Ids alone are others.
    assert_eq!(write(&document(&text)), text);
    for chart in editing.document().charts().flat_map(Chart::with_inner) {
        let initial = chart.initial_steps().count();
        let is_sfc = chart.standard == Standard::Sfc;
        assert!(!is_sfc || initial == usize::from(!chart.steps.is_empty()), "{initial} in\n{text}");
        for transition in chart.transitions.values() {
            assert!(!transition.from.is_empty() && !transition.to.is_empty(), "{text}");
        }
        check_drawn(chart);
    }
    // What finds things is what the document says.
    let anew = Editing::of(editing.document().clone(), "Main").expect("a chart");
    assert_eq!(&anew, editing);
}

/// Each transition is drawn once, and no step has two of what it has once.
fn check_drawn(chart: &Chart) {
    let drawn = Drawn::of(chart);
    let ends = |id: &TransitionId| {
        let one = &chart.transitions[id];
        (*one.from.first().expect("one"), *one.to.first().expect("one"))
    };
    let (mut leaves, mut enters) = (BTreeSet::new(), BTreeSet::new());
    for (from, to) in drawn.simple.iter().map(ends) {
        assert!(leaves.insert(from) && enters.insert(to), "two simple ones");
        assert!(!drawn.divergences.contains_key(&from), "simple beside a divergence");
        assert!(!drawn.convergences.contains_key(&to), "simple beside a convergence");
    }
    let lists = drawn.divergences.values().chain(drawn.convergences.values());
    let lists: Vec<&Vec<TransitionId>> = lists.collect();
    assert!(lists.iter().all(|list| list.len() > 1), "a branch alone");
    let all = drawn.simple.iter().chain(&drawn.simultaneous).chain(lists.into_iter().flatten());
    let all: Vec<&TransitionId> = all.collect();
    assert_eq!(all.iter().collect::<BTreeSet<_>>().len(), all.len());
    assert_eq!(all.len(), chart.transitions.len());
}

/// Edits at random; many of them cannot be carried out.
struct Monkey<'r> {
    random: &'r mut Rng,
    chart: Chart,
    copies: Vec<String>,
}

impl Monkey<'_> {
    fn of<T: Copy>(&mut self, all: Vec<T>, none: T) -> T {
        if all.is_empty() { none } else { all[self.random.usize(..all.len())] }
    }

    fn step(&mut self) -> StepId {
        self.of(self.chart.steps.keys().copied().collect(), StepId(0))
    }

    fn transition(&mut self) -> TransitionId {
        self.of(self.chart.transitions.keys().copied().collect(), TransitionId(0))
    }

    fn element(&mut self) -> Element {
        if self.random.bool() {
            Element::Step(self.step())
        } else {
            Element::Transition(self.transition())
        }
    }

    fn steps(&mut self) -> BTreeSet<StepId> {
        let count = [1, 1, 1, 2, 2, 3, 0][self.random.usize(..7)];
        (0..count).map(|_| self.step()).collect()
    }

    fn place(&mut self) -> Position {
        Position { x: self.random.i32(-3..3) * 160, y: self.random.i32(0..8) * 100 }
    }

    fn pick(&mut self, list: &[&str]) -> String {
        list[self.random.usize(..list.len())].to_owned()
    }

    /// A name of a step, or another one.
    fn name(&mut self) -> String {
        let step = self.step();
        let own = self.chart.steps.get(&step).map(|step| step.name.clone());
        let other = self.pick(&["Fill", "q1", "a", "STEP", "2x", "S1", "n1", "Täglich", "m1"]);
        own.filter(|_| self.random.u8(..3) == 0).unwrap_or(other)
    }

    fn action(&mut self) -> Wanted {
        let qualifier = Qualifier::ALL[self.random.usize(..11)];
        let time = self.pick(&["T#2s", "Limit", "T#"]);
        let action = self.pick(&["q1", "q2", "SA0", "SA1", "m1", "%Q0.3", "x y", "Fill", ""]);
        let has_time = qualifier.has_time() ^ (self.random.u8(..9) == 0);
        Wanted { qualifier, time: has_time.then_some(time), action }
    }

    fn edit(&mut self) -> Edit {
        let index = self.random.usize(..3);
        match self.random.u8(..24) {
            0 | 1 => {
                let at = self.random.bool().then(|| self.place());
                Edit::AddStep { at, is_initial: self.random.u8(..4) == 0 }
            }
            2 | 3 => Edit::AddAfter(self.element()),
            4 => Edit::AddBefore(self.element()),
            5 => Edit::AddBranch { of: self.element(), is_parallel: self.random.bool() },
            6..=8 => Edit::Connect { from: self.steps(), to: self.steps() },
            9..=11 => {
                let transitions = (0..self.random.usize(..2)).map(|_| self.transition()).collect();
                Edit::Erase { steps: self.steps(), transitions }
            }
            12 => Edit::Rename { step: self.step(), name: self.name() },
            13 => Edit::SetInitial { step: self.step(), is_initial: self.random.u8(..4) > 0 },
            14 => {
                let step = self.name();
                let text = self.pick(&["a", "(a OR", "b // c", "TRUE;", "END_STEP", "NOT m1"]);
                let text = if self.random.bool() { format!("a AND {step}.X") } else { text };
                Edit::SetCondition { transition: self.transition(), text }
            }
            15 => {
                let name = self.random.bool().then(|| self.pick(&["Go", "go", "S1", "TO", "On"]));
                let priority = self.random.bool().then(|| self.random.u32(..9));
                let (from, to) = (self.steps(), self.steps());
                Edit::SetTransition { transition: self.transition(), name, priority, from, to }
            }
            16 => Edit::SetAction { step: self.step(), index, action: self.action() },
            17 => Edit::InsertAction { step: self.step(), index, action: self.action() },
            18 => match self.random.u8(..12) {
                0..=4 => Edit::RemoveAction { step: self.step(), index },
                5 => Edit::ClearActions { step: self.step() },
                6 => Edit::EraseAction {
                    action: self.of(self.chart.actions.keys().copied().collect(), ActionId(0)),
                },
                _ => Edit::MoveAction { step: self.step(), index, to: self.random.usize(..3) },
            },
            19 => Edit::InsertAction { step: self.step(), index: 0, action: self.action() },
            20 => {
                let steps: BTreeMap<StepId, Position> =
                    self.steps().into_iter().map(|id| (id, self.place())).collect();
                let transitions = self.transition();
                let transitions = [(transitions, self.place())].into();
                Edit::Place { steps, transitions }
            }
            21 => Edit::Layout,
            22 => {
                let at = self.random.bool().then(|| self.place());
                let none = "STEP S1: END_STEP STEP S1: END_STEP".to_owned();
                let text = self.copies.last().cloned().unwrap_or(none);
                Edit::Paste { text, at }
            }
            _ => {
                let text =
                    self.pick(&["", "once\n\nupon a time ", "# no setting", "(* in *)", "//"]);
                Edit::Comment { of: self.element(), text }
            }
        }
    }
}

/// How often an edit of a kind was carried out, and refused.
type Counts = BTreeMap<String, (u32, u32)>;

/// A round of edits of a chart.
fn round(text: &str, random: &mut Rng, counts: &mut Counts) {
    let mut editing = Editing::of(document(text), "Main").expect("a chart");
    check(&editing);
    let mut copies = Vec::new();
    let mut states = Vec::new();
    for _ in 0..ROUND {
        let charts = editing.charts().map(|(path, chart)| (path.clone(), chart.clone()));
        let charts: Vec<(ChartPath, Chart)> = charts.collect();
        let (path, chart) = charts[random.usize(..charts.len())].clone();
        let is_large = chart.steps.len() > 15;
        let mut monkey = Monkey { random, chart, copies: std::mem::take(&mut copies) };
        let edit = if is_large {
            let steps = (0..5).map(|_| monkey.step()).collect();
            Edit::Erase { steps, transitions: BTreeSet::new() }
        } else {
            monkey.edit()
        };
        let chosen = monkey.steps();
        copies = monkey.copies;
        copies.extend(editing.copy(&path, &chosen));
        copies.drain(..copies.len().saturating_sub(1));
        let before = editing.document().clone();
        let done = editing.apply(&path, &edit);
        let debug = format!("{edit:?}");
        let kind = debug.split([' ', '(']).next().unwrap_or_default().to_owned();
        let count = counts.entry(kind).or_default();
        match done {
            Ok(done) => {
                count.0 += 1;
                check(&editing);
                states.push((before, done.undo));
            }
            Err(refusal) => {
                count.1 += 1;
                assert!(!refusal.to_string().is_empty());
                assert_eq!(editing.document(), &before, "refused: {refusal}");
            }
        }
    }
    let end = editing.document().clone();
    let mut redo = Vec::new();
    for (before, undo) in states.into_iter().rev() {
        redo.push(editing.take_back(undo));
        assert_eq!(editing.document(), &before);
    }
    check(&editing);
    for undo in redo.into_iter().rev() {
        editing.take_back(undo);
    }
    assert_eq!(editing.document(), &end);
}

#[test]
fn random_edits_leave_charts_as_they_should_be() {
    let wanted = std::env::var("CHART_EDITS").ok().and_then(|text| text.parse().ok());
    let wanted: usize = wanted.unwrap_or(10_000);
    let mut counts = Counts::new();
    for seed in 0..(wanted / ROUND) as u64 {
        let mut random = Rng::with_seed(seed);
        let text = match seed % 10 {
            0 => String::new(),
            1..=2 => random_grafcet::program(seed),
            _ => program(seed),
        };
        round(&text, &mut random, &mut counts);
    }
    println!("{counts:?}");
    assert_eq!(counts.len(), 20, "{counts:?}");
    for (kind, (done, _)) in counts {
        assert!(done as usize > wanted / 1000, "{kind}: carried out {done} times");
    }
}

/// The chart of the reference: an alternative, a parallel branch, a way back.
#[test]
fn no_order_of_insertion_matters() {
    let names = ["S0", "S1", "S2", "S3", "S4", "S5"];
    let ends: [(&[usize], &[usize]); 7] = [
        (&[0], &[1]),
        (&[0], &[2]),
        (&[1], &[3]),
        (&[2], &[3]),
        (&[3], &[4, 5]),
        (&[4, 5], &[0]),
        (&[5], &[1]),
    ];
    let mut chart = Chart::new("Main");
    let steps = names.map(|name| {
        let (name, is_initial) = (name.to_owned(), name == "S0");
        chart.add_step(chart::model::Step { name, is_initial, ..Default::default() })
    });
    let document = Document { pieces: vec![Piece::Chart(chart)] };
    let empty = Editing::of(document, "Main").expect("a chart");
    let path = empty.charts().next().expect("a chart").0.clone();
    let side = |list: &[usize]| list.iter().map(|at| steps[*at]).collect::<BTreeSet<_>>();
    let mut seen: BTreeSet<String> = BTreeSet::new();
    let mut order: Vec<usize> = (0..7).collect();
    let mut count = 0;
    permutations(&mut order, 0, &mut |order| {
        let mut editing = empty.clone();
        for at in order {
            let (from, to) = ends[*at];
            let edit = Edit::Connect { from: side(from), to: side(to) };
            editing.apply(&path, &edit).expect("allowed");
        }
        count += 1;
        seen.insert(kinds(editing.chart(&path).expect("a chart")));
    });
    assert_eq!(count, 5040);
    assert_eq!(seen.len(), 1, "{seen:?}");
}

/// The chart as it is drawn, whatever the ids of its transitions.
fn kinds(chart: &Chart) -> String {
    let drawn = Drawn::of(chart);
    let list = |ids: &[TransitionId]| {
        let titles = ids.iter().map(|id| chart.transition_title(&chart.transitions[id]));
        titles.collect::<BTreeSet<_>>()
    };
    let lists = |all: &BTreeMap<StepId, Vec<TransitionId>>| {
        all.values().map(|ids| list(ids)).collect::<Vec<_>>()
    };
    let (simple, simultaneous) = (list(&drawn.simple), list(&drawn.simultaneous));
    let (out, into) = (lists(&drawn.divergences), lists(&drawn.convergences));
    format!("{:?} {simple:?} {simultaneous:?} {out:?} {into:?}", chart.steps)
}

fn permutations(list: &mut Vec<usize>, from: usize, found: &mut dyn FnMut(&[usize])) {
    if from + 1 >= list.len() {
        found(list);
        return;
    }
    for at in from..list.len() {
        list.swap(from, at);
        permutations(list, from + 1, found);
        list.swap(from, at);
    }
}
