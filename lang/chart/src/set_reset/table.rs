//! The equations of the steps as a table, as charts are taught: `X1.T1_23`, `X2.X3 + Init + Reset`.

use super::plan::{Plan, StepPlan};
use crate::sfcedit::condition::Condition;

/// The table in Markdown: a row for each step, and a table for each chart.
pub fn table(plan: &Plan) -> String {
    let mut text = String::new();
    for chart in &plan.charts {
        if plan.charts.len() > 1 {
            text.push_str(&format!(
                "{}{}\n\n",
                if text.is_empty() { "" } else { "\n" },
                chart.name
            ));
        }
        text.push_str("| step | set | reset |\n|---|---|---|\n");
        for step in &chart.steps {
            text.push_str(&format!("| {} | {} | {} |\n", step.name, set(step), reset(step)));
        }
    }
    text
}

fn set(step: &StepPlan) -> String {
    let term = |(steps, condition): &(Vec<String>, Condition)| {
        let condition = match condition {
            Condition::Or(_) => format!("({})", condition.equation()),
            _ => condition.equation(),
        };
        format!("{}.{condition}", steps.join("."))
    };
    let mut terms: Vec<String> = step.set.iter().map(term).collect();
    if step.is_initial {
        terms.push("Init".to_owned());
    }
    terms.join(" + ")
}

fn reset(step: &StepPlan) -> String {
    let mut terms: Vec<String> = step.reset.iter().map(|steps| steps.join(".")).collect();
    if !step.is_initial {
        terms.push("Init".to_owned());
    }
    terms.push("Reset".to_owned());
    terms.join(" + ")
}
