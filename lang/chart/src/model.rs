//! The model of a chart: steps, transitions, action blocks, actions. It says what there is, not
//! how it is drawn: the drawn kinds of transitions follow from it ([`crate::drawn`]).
//!
//! Elements keep their identity while a chart is edited: an id is never given twice. The order of
//! ids is that of the text; it decides where nothing else does, such as between alternatives
//! without a priority.

use std::collections::{BTreeMap, BTreeSet};

use diagnostics::Span;
pub(crate) use st::names::is_same as is_same_name;

/// Identifies a step of a chart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct StepId(pub u32);

/// Identifies a transition of a chart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct TransitionId(pub u32);

/// Identifies an action of a chart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ActionId(pub u32);

/// By whose rules a chart evolves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Standard {
    /// SFC of IEC 61131-3.
    #[default]
    Sfc,
    /// GRAFCET of IEC 60848.
    Grafcet,
}

/// A chart.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Chart {
    /// The name of the program or action that it is.
    pub name: String,
    /// By whose rules it evolves.
    pub standard: Standard,
    /// GRAFCET: how often it evolves in a scan at most; `None`: as often as all do.
    pub evolutions_max: Option<u16>,
    /// Its steps.
    pub steps: BTreeMap<StepId, Step>,
    /// Its transitions.
    pub transitions: BTreeMap<TransitionId, Transition>,
    /// Its actions.
    pub actions: BTreeMap<ActionId, Action>,
    /// The number of the element that was added last.
    last: Last,
}

/// How many elements a chart has had. It says nothing about the chart as it is.
#[derive(Debug, Clone, Copy, Default)]
struct Last(u32);

impl PartialEq for Last {
    fn eq(&self, _: &Last) -> bool {
        true
    }
}

/// A step.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Step {
    /// Its name; no other step of the chart has it. Letter case does not matter.
    pub name: String,
    /// Whether it is active at the beginning.
    pub is_initial: bool,
    /// What it stands for.
    pub kind: StepKind,
    /// GRAFCET: whether it becomes active with the enclosing step around it.
    pub is_linked: bool,
    /// What is done while it is active, in this order.
    pub block: Vec<Instance>,
    /// GRAFCET: what it forces other charts to.
    pub forcings: Vec<Forcing>,
    /// SFC: that a timer of the controller may take the place of its time; where that was read.
    pub coarse: Option<Origin>,
    /// A comment.
    pub comment: String,
    /// Where it is drawn.
    pub at: Option<Position>,
    /// Where it was read.
    pub origin: Origin,
}

/// What a step stands for.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum StepKind {
    /// Itself.
    #[default]
    Plain,
    /// GRAFCET: a macro-step, with the name of the action whose chart is its expansion.
    Macro(String),
    /// GRAFCET: an enclosing step, with the names of the charts in it.
    Enclosing(Vec<String>),
}

/// An action in the block of a step.
#[derive(Debug, Clone, PartialEq)]
pub struct Instance {
    /// Which action.
    pub action: ActionId,
    /// When it is executed.
    pub qualifier: Qualifier,
    /// The time of qualifiers that have one: an expression of type TIME.
    pub time: Option<Code>,
    /// GRAFCET: a condition of a continuous action.
    pub condition: Option<Code>,
    /// GRAFCET: the event at which a stored action is executed.
    pub event: Option<Code>,
    /// Where it was read.
    pub origin: Origin,
}

/// When an action is executed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Qualifier {
    /// While the step is active.
    #[default]
    N,
    /// From activation on, until a step resets it.
    S,
    /// Ends what S, SD, DS and SL began, and keeps everything else from being executed.
    R,
    /// While the step is active, for the time at most.
    L,
    /// While the step is active, once the time has passed.
    D,
    /// Once, at activation.
    P,
    /// Once, at deactivation.
    P0,
    /// Once, at activation.
    P1,
    /// Stored; begins when the time has passed, whether or not the step is active then.
    SD,
    /// Stored, once the step was active for the time.
    DS,
    /// Stored, for the time at most.
    SL,
}

/// A forcing order of GRAFCET.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Forcing {
    /// The name of the chart that is forced.
    pub chart: String,
    /// The situation that it is forced to.
    pub situation: Situation,
    /// Where it was read.
    pub origin: Origin,
}

/// A situation that a chart is forced to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Situation {
    /// These steps are active: `{3}`, and none of them: `{}`.
    Steps(Vec<String>),
    /// As it is: `{*}`.
    Current,
    /// The initial one: `{INIT}`.
    Initial,
}

/// A transition.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Transition {
    /// Its name.
    pub name: Option<String>,
    /// The steps before it.
    pub from: BTreeSet<StepId>,
    /// The steps after it.
    pub to: BTreeSet<StepId>,
    /// What must be true to cross it: an expression of type BOOL.
    pub condition: Code,
    /// SFC: among alternatives the lowest number comes first.
    pub priority: Option<u32>,
    /// GRAFCET: statements that are executed when it is crossed.
    pub crossing: Option<Code>,
    /// A comment.
    pub comment: String,
    /// Where it is drawn.
    pub at: Option<Position>,
    /// Where it was read.
    pub origin: Origin,
}

/// An action.
#[derive(Debug, Clone, PartialEq)]
pub struct Action {
    /// Its name; no other action of the chart has it. Letter case does not matter.
    pub name: String,
    /// What it does.
    pub body: Body,
    /// A comment.
    pub comment: String,
    /// Where it was read.
    pub origin: Origin,
}

/// What an action does.
#[derive(Debug, Clone, PartialEq)]
pub enum Body {
    /// Its name is that of a BOOL variable, which is TRUE while it is active.
    Variable,
    /// Statements.
    Code(Code),
    /// A chart of its own.
    Chart(Box<Chart>),
}

/// A piece of Structured Text: an expression or statements.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Code {
    /// As written, with its comments.
    pub text: String,
    /// Where it was read.
    pub origin: Origin,
}

/// A place in a drawing; y grows downward.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Position {
    /// From the left.
    pub x: i32,
    /// From the top.
    pub y: i32,
}

/// Where an element was read. It says nothing about the element: two charts are equal wherever
/// they come from.
#[derive(Debug, Clone, Copy, Default)]
pub struct Origin(pub Span);

impl PartialEq for Origin {
    fn eq(&self, _: &Origin) -> bool {
        true
    }
}

impl Eq for Origin {}

impl Code {
    /// Code that comes from no text.
    pub fn new(text: impl Into<String>) -> Code {
        Code { text: text.into(), origin: Origin::default() }
    }
}

impl Instance {
    /// An action while the step is active.
    pub fn new(action: ActionId) -> Instance {
        let (time, condition, event) = (None, None, None);
        let (qualifier, origin) = (Qualifier::N, Origin::default());
        Instance { action, qualifier, time, condition, event, origin }
    }
}

impl Qualifier {
    /// All of them.
    pub const ALL: [Qualifier; 11] = {
        use Qualifier::*;
        [N, S, R, L, D, P, P0, P1, SD, DS, SL]
    };

    /// As written.
    pub fn text(self) -> &'static str {
        use Qualifier::*;
        match self {
            N => "N",
            S => "S",
            R => "R",
            L => "L",
            D => "D",
            P => "P",
            P0 => "P0",
            P1 => "P1",
            SD => "SD",
            DS => "DS",
            SL => "SL",
        }
    }

    /// The one of this text, in any letter case.
    pub fn find(text: &str) -> Option<Qualifier> {
        Qualifier::ALL.into_iter().find(|one| one.text().eq_ignore_ascii_case(text))
    }

    /// Whether a time belongs to it.
    pub fn has_time(self) -> bool {
        use Qualifier::*;
        matches!(self, L | D | SD | DS | SL)
    }

    /// Whether it means a moment, not a stretch of time.
    pub fn is_pulse(self) -> bool {
        use Qualifier::*;
        matches!(self, P | P0 | P1)
    }

    /// Whether the action is active with the step alone.
    pub fn is_continuous(self) -> bool {
        use Qualifier::*;
        matches!(self, N | L | D)
    }

    /// Whether the action goes on when the step is no longer active.
    pub fn is_stored(self) -> bool {
        use Qualifier::*;
        matches!(self, S | SD | DS | SL)
    }
}

impl Action {
    /// A variable as an action.
    pub fn variable(name: impl Into<String>, origin: Origin) -> Action {
        Action { name: name.into(), body: Body::Variable, comment: String::new(), origin }
    }
}

impl Chart {
    /// A chart without elements.
    pub fn new(name: impl Into<String>) -> Chart {
        Chart { name: name.into(), ..Chart::default() }
    }

    /// A number that no element has had.
    pub(crate) fn fresh(&mut self) -> u32 {
        self.last.0 += 1;
        self.last.0
    }

    /// Adds a step.
    pub fn add_step(&mut self, step: Step) -> StepId {
        let id = StepId(self.fresh());
        self.steps.insert(id, step);
        id
    }

    /// Adds a transition.
    pub fn add_transition(&mut self, transition: Transition) -> TransitionId {
        let id = TransitionId(self.fresh());
        self.transitions.insert(id, transition);
        id
    }

    /// Adds an action.
    pub fn add_action(&mut self, action: Action) -> ActionId {
        let id = ActionId(self.fresh());
        self.actions.insert(id, action);
        id
    }

    /// The step of a name.
    pub fn step_named(&self, name: &str) -> Option<StepId> {
        let found = self.steps.iter().find(|(_, step)| is_same_name(&step.name, name));
        found.map(|(id, _)| *id)
    }

    /// The action of a name.
    pub fn action_named(&self, name: &str) -> Option<ActionId> {
        let found = self.actions.iter().find(|(_, action)| is_same_name(&action.name, name));
        found.map(|(id, _)| *id)
    }

    /// The steps that are active at the beginning.
    pub fn initial_steps(&self) -> impl Iterator<Item = StepId> {
        self.steps.iter().filter(|(_, step)| step.is_initial).map(|(id, _)| *id)
    }

    /// The chart and those in its actions, each before those in it: as they are drawn.
    pub fn with_inner(&self) -> Vec<&Chart> {
        self.named_with_inner().into_iter().map(|(_, chart)| chart).collect()
    }

    /// As [`with_inner`](Chart::with_inner), each with its name after those of the charts around:
    /// `Plant.Stir`.
    pub fn named_with_inner(&self) -> Vec<(String, &Chart)> {
        let inner = self.actions.values().filter_map(|action| match &action.body {
            Body::Chart(inner) => Some(inner.named_with_inner()),
            Body::Variable | Body::Code(_) => None,
        });
        let named = |(name, chart)| (format!("{}.{name}", self.name), chart);
        std::iter::once((self.name.clone(), self)).chain(inner.flatten().map(named)).collect()
    }

    /// The transitions in the order in which alternatives are tried: by priority, those without
    /// one after those with one, then as in the text.
    pub fn by_priority(&self) -> Vec<TransitionId> {
        let mut all: Vec<TransitionId> = self.transitions.keys().copied().collect();
        let priority = |id: &TransitionId| self.transitions.get(id).and_then(|one| one.priority);
        all.sort_by_key(|id| priority(id).map_or(u64::MAX, u64::from));
        all
    }

    /// The steps in whose block an action is, with its instances.
    pub fn instances_of(
        &self,
        action: ActionId,
    ) -> impl Iterator<Item = (StepId, &Step, &Instance)> {
        let all = self
            .steps
            .iter()
            .flat_map(|(id, step)| step.block.iter().map(move |instance| (*id, step, instance)));
        all.filter(move |(_, _, instance)| instance.action == action)
    }

    /// How a transition is called: its name, or the steps before and after it.
    pub fn transition_title(&self, transition: &Transition) -> String {
        if let Some(name) = &transition.name {
            return name.clone();
        }
        let side = |steps: &BTreeSet<StepId>| {
            let names = steps.iter().filter_map(|id| self.steps.get(id));
            names.map(|step| step.name.as_str()).collect::<Vec<_>>().join("_")
        };
        format!("{}_to_{}", side(&transition.from), side(&transition.to))
    }
}
