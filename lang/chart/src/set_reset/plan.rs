//! What is generated from charts, without the words of a target: equations of steps, assignments,
//! timers, counters, variables.

use crate::sfcedit::condition::Condition;

use super::variables::Variable;

/// All of it.
#[derive(Debug, Clone, Default)]
pub struct Plan {
    /// A function block each.
    pub charts: Vec<ChartPlan>,
    /// Variables of which an edge is needed; whether it is the rising one.
    pub edges: Vec<(String, bool)>,
    /// Signals that comments of transitions define.
    pub derived: Vec<(String, Condition)>,
    /// Outputs and control signals with the steps that switch them on.
    pub outputs: Vec<(String, Vec<Cause>)>,
    /// Values that steps give to variables.
    pub assignments: Vec<Assignment>,
    /// Timers in the order of their first use.
    pub timers: Vec<Device>,
    /// Counters in the order of their first use.
    pub counters: Vec<Device>,
    /// All variables but steps, in the order of their first use.
    pub variables: Vec<Variable>,
}

/// A chart.
#[derive(Debug, Clone, Default)]
pub struct ChartPlan {
    /// Its name.
    pub name: String,
    /// Its steps in the order of the text.
    pub steps: Vec<StepPlan>,
}

/// A step with its equations.
#[derive(Debug, Clone, Default)]
pub struct StepPlan {
    /// Its name.
    pub name: String,
    /// Whether it is active at the beginning: then `Init` sets it.
    pub is_initial: bool,
    /// What sets it: of each transition that leads to it the steps before, and its condition.
    pub set: Vec<(Vec<String>, Condition)>,
    /// What resets it: of each transition that leaves it the steps after.
    pub reset: Vec<Vec<String>>,
}

/// A reason to do something: a step, and a condition.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cause {
    /// The step, or its edge.
    pub step: Condition,
    /// What must be true beside.
    pub condition: Option<Condition>,
}

impl Cause {
    /// As one condition.
    pub fn all(&self) -> Condition {
        match &self.condition {
            None => self.step.clone(),
            Some(Condition::And(all)) => {
                let step = std::iter::once(self.step.clone());
                Condition::And(step.chain(all.iter().cloned()).collect())
            }
            Some(one) => Condition::And(vec![self.step.clone(), one.clone()]),
        }
    }
}

/// A value that a variable gets.
#[derive(Debug, Clone)]
pub struct Assignment {
    /// The variable.
    pub variable: String,
    /// The value in ST; of BOOL variables TRUE or FALSE.
    pub value: String,
    /// Why; one is enough.
    pub causes: Vec<Cause>,
}

/// A timer or counter.
#[derive(Debug, Clone, Default)]
pub struct Device {
    /// Its name.
    pub name: String,
    /// Its block: TON, CTU.
    pub block: String,
    /// What starts or counts it.
    pub starts: Vec<Cause>,
    /// What resets a counter.
    pub resets: Vec<Cause>,
    /// Its presets, with the reasons for each.
    pub presets: Vec<(String, Vec<Cause>)>,
}
