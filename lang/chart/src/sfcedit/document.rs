//! What a file of SFCEdit says, as it says it.

use diagnostics::Span;

use super::words::Words;

/// A name and where it was read.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Name {
    /// The name.
    pub text: String,
    /// Where it is.
    pub span: Span,
}

/// The charts of a file.
#[derive(Debug, Clone, Default)]
pub struct Project {
    /// In order.
    pub grafcets: Vec<Grafcet>,
}

/// A chart.
#[derive(Debug, Clone, Default)]
pub struct Grafcet {
    /// Whether it is one by itself.
    pub kind: GrafcetKind,
    /// The step that it belongs to, of a macro-step's or an enclosing step's chart.
    pub owner: Option<Name>,
    /// Its name.
    pub name: Name,
    /// A comment.
    pub comment: String,
    /// Its sequences.
    pub sequences: Vec<Sequence>,
    /// What joins them.
    pub links: Vec<Link>,
    /// Jumps from the end of a sequence to the beginning of one.
    pub jumps: Vec<Jump>,
}

/// What kind of chart it is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum GrafcetKind {
    /// One by itself.
    #[default]
    Normal,
    /// The expansion of a macro-step.
    Macro,
    /// In an enclosing step.
    Enclosure,
}

/// Steps and transitions in turn.
#[derive(Debug, Clone, Default)]
pub struct Sequence {
    /// What links and jumps call it.
    pub id: Name,
    /// In order.
    pub elements: Vec<Element>,
}

/// An element of a sequence.
#[derive(Debug, Clone)]
pub enum Element {
    /// A step.
    Step(Step),
    /// A transition.
    Transition(Transition),
}

impl Element {
    /// Where it is.
    pub fn span(&self) -> Span {
        match self {
            Element::Step(step) => step.span,
            Element::Transition(transition) => transition.span,
        }
    }

    /// How messages call it.
    pub fn title(&self) -> String {
        match self {
            Element::Step(step) => format!("step {}", step.name.text),
            Element::Transition(transition) => match transition.condition.text().as_str() {
                "" => "a transition without a condition".to_owned(),
                condition => format!("transition {condition}"),
            },
        }
    }
}

/// A step.
#[derive(Debug, Clone, Default)]
pub struct Step {
    /// What it stands for.
    pub kind: StepKind,
    /// Its name.
    pub name: Name,
    /// A comment.
    pub comment: String,
    /// What is done while it is active, or when it becomes so.
    pub actions: Vec<Action>,
    /// Where it is.
    pub span: Span,
}

/// What a step stands for.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum StepKind {
    /// Itself.
    #[default]
    Normal,
    /// Itself; active at the beginning.
    Initial,
    /// Itself; nothing follows it.
    Final,
    /// A chart of its own.
    Macro,
    /// A task.
    Task,
    /// The charts in it.
    Enclosing,
    /// The charts in it; active at the beginning.
    InitialEnclosing,
}

impl StepKind {
    /// All of them as files write them.
    pub const ALL: [(&'static str, StepKind); 7] = [
        ("normal", StepKind::Normal),
        ("initial", StepKind::Initial),
        ("final", StepKind::Final),
        ("macro", StepKind::Macro),
        ("task", StepKind::Task),
        ("enclosing", StepKind::Enclosing),
        ("initial enclosing", StepKind::InitialEnclosing),
    ];

    /// Whether it is active at the beginning.
    pub fn is_initial(self) -> bool {
        matches!(self, StepKind::Initial | StepKind::InitialEnclosing)
    }
}

/// An action of a step or transition.
#[derive(Debug, Clone, Default)]
pub struct Action {
    /// When it is done.
    pub kind: ActionKind,
    /// What is done.
    pub text: Words,
    /// A condition, of conditional actions; an event, of those on one.
    pub condition: Option<Words>,
    /// A comment.
    pub comment: String,
    /// Where it is.
    pub span: Span,
}

/// When an action is done.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum ActionKind {
    /// While the step is active.
    #[default]
    Normal,
    /// Once, when the step becomes active.
    Activation,
    /// Once, when it is no longer active.
    Deactivation,
    /// While the step is active and the condition true.
    Conditional,
    /// Orders of another chart.
    Forcing,
    /// At an event while the step is active.
    Event,
}

impl ActionKind {
    /// All of them as files write them.
    pub const ALL: [(&'static str, ActionKind); 6] = [
        ("normal", ActionKind::Normal),
        ("on activation", ActionKind::Activation),
        ("on deactivation", ActionKind::Deactivation),
        ("conditional", ActionKind::Conditional),
        ("forcing", ActionKind::Forcing),
        ("event", ActionKind::Event),
    ];
}

/// A transition.
#[derive(Debug, Clone, Default)]
pub struct Transition {
    /// When it is crossed.
    pub condition: Words,
    /// A comment; `Name := expression` defines a signal.
    pub comment: Words,
    /// What is done when it is crossed.
    pub actions: Vec<Action>,
    /// Where it is.
    pub span: Span,
}

/// What joins sequences.
#[derive(Debug, Clone)]
pub struct Link {
    /// How.
    pub kind: LinkKind,
    /// The sequence on the single side.
    pub single: Name,
    /// The branches.
    pub branches: Vec<Name>,
    /// Where it is.
    pub span: Span,
}

/// How a link joins sequences.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LinkKind {
    /// A transition starts several branches.
    DivergenceAnd,
    /// One of several transitions is crossed.
    DivergenceOr,
    /// A transition waits for several branches.
    ConvergenceAnd,
    /// Branches come together.
    ConvergenceOr,
}

impl LinkKind {
    /// All of them as files write them.
    pub const ALL: [(&'static str, LinkKind); 4] = [
        ("div and", LinkKind::DivergenceAnd),
        ("div or", LinkKind::DivergenceOr),
        ("conv and", LinkKind::ConvergenceAnd),
        ("conv or", LinkKind::ConvergenceOr),
    ];

    /// As files write it.
    pub fn text(self) -> &'static str {
        LinkKind::ALL.iter().find(|(_, kind)| *kind == self).map_or("", |(text, _)| text)
    }

    /// Whether the single side is before the branches.
    pub fn is_divergence(self) -> bool {
        matches!(self, LinkKind::DivergenceAnd | LinkKind::DivergenceOr)
    }
}

/// A jump from the end of a sequence to the beginning of one.
#[derive(Debug, Clone)]
pub struct Jump {
    /// The sequence at whose end it is.
    pub from: Name,
    /// The sequence that it leads to.
    pub to: Name,
    /// Where it is.
    pub span: Span,
}
