//! Charts as drawings: elements with numbers, and where the lines into them come from. Alternatives
//! diverge and converge in elements of their own, parallel branches in others.

use std::collections::BTreeMap;

use ::chart::Chart;
use ::chart::drawing;
use ::chart::model::{
    Action, Body, Instance, Position, Standard, Step, StepId, Transition, TransitionId,
};

use super::Project;

/// Sizes of what is drawn; twice the distance from a middle to an edge.
const STEP: (i32, i32) = (80, 36);
const BAR: (i32, i32) = (24, 2);
const ROW: i32 = 18;
/// From the middle of a step or a bar to what joins lines beside it.
const JOINT: i32 = 30;

/// Numbers of elements: what lines come from.
#[derive(Default)]
struct Numbers {
    last: u32,
    steps: BTreeMap<StepId, u32>,
    transitions: BTreeMap<TransitionId, u32>,
    /// What diverges after a step, and after a transition.
    alternatives: BTreeMap<StepId, u32>,
    branches: BTreeMap<TransitionId, u32>,
}

impl Numbers {
    fn next(&mut self) -> u32 {
        self.last += 1;
        self.last
    }
}

/// A chart that is being drawn.
struct Drawn<'c> {
    chart: &'c Chart,
    numbers: Numbers,
    steps: BTreeMap<StepId, Position>,
    transitions: BTreeMap<TransitionId, Position>,
}

impl<'c> Drawn<'c> {
    fn of(chart: &'c Chart) -> Drawn<'c> {
        let mut numbers = Numbers::default();
        let steps: BTreeMap<StepId, u32> =
            chart.steps.keys().map(|id| (*id, numbers.next())).collect();
        let transitions = chart.transitions.keys().map(|id| (*id, numbers.next())).collect();
        let leaving =
            |id: &StepId| chart.transitions.values().filter(|t| t.from.contains(id)).count();
        let divided = chart.steps.keys().filter(|id| leaving(id) > 1);
        let alternatives = divided.map(|id| (*id, numbers.next())).collect();
        let parallel = chart.transitions.iter().filter(|(_, one)| one.to.len() > 1);
        let branches = parallel.map(|(id, _)| (*id, numbers.next())).collect();
        numbers = Numbers { last: numbers.last, steps, transitions, alternatives, branches };
        let (steps, is_given) = places(chart);
        let middle = |one: &Transition| {
            let ends = one.from.iter().chain(&one.to).filter_map(|id| steps.get(id));
            let ends: Vec<&Position> = ends.collect();
            let count = ends.len().max(1) as i64;
            let mean = |of: fn(&Position) -> i32| {
                let sum: i64 = ends.iter().map(|at| i64::from(of(at))).sum();
                (sum / count) as i32
            };
            Position { x: mean(|at| at.x), y: mean(|at| at.y) }
        };
        // Places of bars are among those of the steps in the text, not among automatic ones.
        let own = |one: &Transition| one.at.filter(|_| is_given).map(near);
        let transitions = chart.transitions.iter();
        let transitions =
            transitions.map(|(id, one)| (*id, own(one).unwrap_or_else(|| middle(one)))).collect();
        Drawn { chart, numbers, steps, transitions }
    }

    fn step(&self, id: StepId) -> Position {
        self.steps.get(&id).copied().unwrap_or_default()
    }
}

/// A place that can be drawn.
fn near(at: Position) -> Position {
    let limited = |one: i32| one.clamp(-drawing::PLACE_MAX, drawing::PLACE_MAX);
    Position { x: limited(at.x), y: limited(at.y) }
}

/// Where steps are: as the text says, which is told, or where they are drawn.
fn places(chart: &Chart) -> (BTreeMap<StepId, Position>, bool) {
    let places = drawing::places(chart);
    if places.is_given {
        let steps = chart.steps.iter();
        return (steps.filter_map(|(id, step)| Some((*id, near(step.at?)))).collect(), true);
    }
    let least = |of: fn(&Position) -> i32| places.steps.values().map(of).min().unwrap_or(0);
    let (x, y) = (least(|at| at.x) - STEP.0, least(|at| at.y) - STEP.1);
    let moved = |at: Position| Position { x: at.x - x, y: at.y - y };
    (places.steps.into_iter().map(|(id, at)| (id, moved(at))).collect(), false)
}

impl Project<'_> {
    /// The chart of a unit, with its actions.
    pub(super) fn chart(&mut self, chart: &Chart) {
        if chart.standard == Standard::Grafcet {
            let place =
                chart.steps.values().next().map_or_else(Default::default, |one| one.origin.0);
            let message = format!("{}: a GRAFCET has no place in a project of PLCopen", chart.name);
            let help = "charts there follow the rules of SFC";
            return self.refuse(place, message, help);
        }
        let coded = |one: &&Action| one.body != Body::Variable;
        if chart.actions.values().any(|one| coded(&one)) {
            self.open("actions", &[]);
            chart.actions.values().filter(coded).for_each(|one| self.action(one));
            self.close();
        }
        self.drawing(chart);
    }

    fn action(&mut self, action: &Action) {
        self.open("action", &[("name", &action.name)]);
        match &action.body {
            Body::Variable => {}
            Body::Code(code) => self.statements(&code.text),
            Body::Chart(inner) => {
                for one in inner.actions.values().filter(|one| one.body != Body::Variable) {
                    let message = format!(
                        "{}: an action of the chart in action {} has no place in a project",
                        one.name, action.name
                    );
                    let help = "actions belong to the chart of a unit there: make it one of that";
                    self.refuse(one.origin.0, message, help);
                }
                self.drawing(inner);
            }
        }
        self.documentation(&action.comment);
        self.close();
    }

    fn drawing(&mut self, chart: &Chart) {
        let mut drawn = Drawn::of(chart);
        self.open("body", &[]);
        self.open("SFC", &[]);
        for (id, step) in &chart.steps {
            self.step(&mut drawn, *id, step);
        }
        for (id, transition) in &chart.transitions {
            self.transition(&mut drawn, *id, transition);
        }
        for (id, number) in &drawn.numbers.alternatives {
            let from = drawn.numbers.steps.get(id).copied().unwrap_or_default();
            let at = drawn.step(*id);
            let at = Position { y: at.y + JOINT, ..at };
            self.joint("selectionDivergence", *number, &[from], at);
        }
        for (id, number) in &drawn.numbers.branches {
            let from = drawn.numbers.transitions.get(id).copied().unwrap_or_default();
            let at = drawn.transitions.get(id).copied().unwrap_or_default();
            let at = Position { y: at.y + JOINT / 2, ..at };
            self.joint("simultaneousDivergence", *number, &[from], at);
        }
        for (id, step) in &chart.steps {
            self.block(&mut drawn, *id, step);
        }
        self.close();
        self.close();
    }

    /// A step, and what converges before it.
    fn step(&mut self, drawn: &mut Drawn, id: StepId, step: &Step) {
        if let Some(pragma) = step.coarse {
            self.refuse_coarse(pragma.0);
        }
        let entering = drawn.chart.transitions.iter().filter(|(_, one)| one.to.contains(&id));
        let mut sources: Vec<u32> = entering
            .filter_map(|(id, _)| {
                let branches = drawn.numbers.branches.get(id);
                branches.or_else(|| drawn.numbers.transitions.get(id)).copied()
            })
            .collect();
        let at = drawn.step(id);
        if sources.len() > 1 {
            let number = drawn.numbers.next();
            let above = Position { y: at.y - JOINT, ..at };
            self.joint("selectionConvergence", number, &sources, above);
            sources = vec![number];
        }
        let number = drawn.numbers.steps.get(&id).copied().unwrap_or_default().to_string();
        let size = [STEP.0, STEP.1].map(|one| one.to_string());
        let mut head = vec![("localId", number.as_str()), ("name", step.name.as_str())];
        head.extend([("width", size[0].as_str()), ("height", size[1].as_str())]);
        head.extend(step.is_initial.then_some(("initialStep", "true")));
        self.open("step", &head);
        self.position(at, STEP);
        self.lines(&sources);
        self.documentation(&step.comment);
        self.close();
    }

    /// A transition, and what converges before it.
    fn transition(&mut self, drawn: &mut Drawn, id: TransitionId, transition: &Transition) {
        let mut sources: Vec<u32> = transition
            .from
            .iter()
            .filter_map(|id| {
                let alternatives = drawn.numbers.alternatives.get(id);
                alternatives.or_else(|| drawn.numbers.steps.get(id)).copied()
            })
            .collect();
        let at = drawn.transitions.get(&id).copied().unwrap_or_default();
        if sources.len() > 1 {
            let number = drawn.numbers.next();
            let above = Position { y: at.y - JOINT / 2, ..at };
            self.joint("simultaneousConvergence", number, &sources, above);
            sources = vec![number];
        }
        let number = drawn.numbers.transitions.get(&id).copied().unwrap_or_default().to_string();
        let priority = transition.priority.map(|one| one.to_string());
        let size = [BAR.0, BAR.1].map(|one| one.to_string());
        let mut head = vec![("localId", number.as_str())];
        head.extend([("width", size[0].as_str()), ("height", size[1].as_str())]);
        head.extend(priority.as_deref().map(|one| ("priority", one)));
        self.open("transition", &head);
        self.position(at, BAR);
        self.lines(&sources);
        self.open("condition", &[]);
        self.open("inline", &[("name", transition.name.as_deref().unwrap_or(""))]);
        self.structured_text(&transition.condition.text);
        self.close();
        self.close();
        self.documentation(&transition.comment);
        self.close();
    }

    /// The actions of a step.
    fn block(&mut self, drawn: &mut Drawn, id: StepId, step: &Step) {
        if step.block.is_empty() {
            return;
        }
        let number = drawn.numbers.next().to_string();
        let at = drawn.step(id);
        let size = (2 * STEP.0, ROW * step.block.len() as i32);
        let [width, height] = [size.0, size.1].map(|one| one.to_string());
        self.open("actionBlock", &[("localId", &number), ("width", &width), ("height", &height)]);
        self.position(Position { x: at.x + 2 * STEP.0, ..at }, size);
        self.lines(&[drawn.numbers.steps.get(&id).copied().unwrap_or_default()]);
        for (instance, row) in step.block.iter().zip(0..) {
            let number = drawn.numbers.next();
            self.instance(drawn.chart, instance, number, row * ROW);
        }
        self.close();
    }

    fn instance(&mut self, chart: &Chart, instance: &Instance, number: u32, y: i32) {
        let number = number.to_string();
        let mut head = vec![("localId", number.as_str())];
        head.push(("qualifier", instance.qualifier.text()));
        head.extend(instance.time.as_ref().map(|time| ("duration", time.text.as_str())));
        self.open("action", &head);
        self.out.empty("relPosition", &[("x", "0"), ("y", &y.to_string())]);
        let name = chart.actions.get(&instance.action).map_or("", |one| one.name.as_str());
        self.out.empty("reference", &[("name", name)]);
        self.close();
    }

    /// What only joins lines.
    fn joint(&mut self, kind: &str, number: u32, from: &[u32], at: Position) {
        self.open(kind, &[("localId", &number.to_string())]);
        self.position(at, STEP);
        match kind {
            // Each of its lines has a point of its own.
            "selectionConvergence" => from.iter().for_each(|one| self.lines(&[*one])),
            _ => self.lines(from),
        }
        self.close();
    }

    /// The corner of what has its middle there.
    fn position(&mut self, middle: Position, size: (i32, i32)) {
        self.corner(middle.x - size.0 / 2, middle.y - size.1 / 2);
    }

    /// Where the lines into an element come from.
    fn lines(&mut self, from: &[u32]) {
        if from.is_empty() {
            return;
        }
        self.open("connectionPointIn", &[]);
        for one in from {
            self.out.empty("connection", &[("refLocalId", &one.to_string())]);
        }
        self.close();
    }
}
