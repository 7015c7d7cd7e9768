//! What is drawn of the transitions of a chart: divergences, convergences, simple and simultaneous
//! ones. It follows from the set of transitions, not from the order in which they were made.

use std::collections::BTreeMap;

use crate::model::{Chart, StepId, TransitionId};

/// The transitions of a chart as they are drawn; each is in one place.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Drawn {
    /// One step before, one after, and neither divergence nor convergence.
    pub simple: Vec<TransitionId>,
    /// All transitions from a step to one step each, where there are two or more.
    pub divergences: BTreeMap<StepId, Vec<TransitionId>>,
    /// Two or more transitions from one step each to a step that are in no divergence.
    pub convergences: BTreeMap<StepId, Vec<TransitionId>>,
    /// With more than one step before or after.
    pub simultaneous: Vec<TransitionId>,
}

impl Drawn {
    /// Of a chart.
    pub fn of(chart: &Chart) -> Drawn {
        let mut drawn = Drawn::default();
        let mut leaving: BTreeMap<StepId, Vec<(StepId, TransitionId)>> = BTreeMap::new();
        for (id, transition) in &chart.transitions {
            match (transition.from.len(), transition.to.len()) {
                (1, 1) => {
                    let ends = transition.from.first().zip(transition.to.first());
                    if let Some((from, to)) = ends {
                        leaving.entry(*from).or_default().push((*to, *id));
                    }
                }
                _ => drawn.simultaneous.push(*id),
            }
        }
        let mut entering: BTreeMap<StepId, Vec<TransitionId>> = BTreeMap::new();
        for (from, ends) in leaving {
            if let [(to, id)] = ends[..] {
                entering.entry(to).or_default().push(id);
            } else {
                drawn.divergences.insert(from, ends.into_iter().map(|(_, id)| id).collect());
            }
        }
        for (to, ids) in entering {
            if let [id] = ids[..] {
                drawn.simple.push(id);
            } else {
                drawn.convergences.insert(to, ids);
            }
        }
        drawn.simple.sort_unstable();
        drawn
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Step, Transition};

    fn chart(steps: u32, ends: &[(&[u32], &[u32])]) -> Chart {
        let mut chart = Chart::new("Test");
        let ids: Vec<StepId> = (0..steps)
            .map(|n| chart.add_step(Step { name: format!("S{n}"), ..Step::default() }))
            .collect();
        let side = |list: &[u32]| list.iter().map(|n| ids[*n as usize]).collect();
        for (from, to) in ends {
            let transition = Transition { from: side(from), to: side(to), ..Transition::default() };
            chart.add_transition(transition);
        }
        chart
    }

    /// The kinds, each transition told by its steps.
    fn kinds(chart: &Chart) -> Vec<String> {
        let drawn = Drawn::of(chart);
        let title = |id: &TransitionId| chart.transition_title(&chart.transitions[id]);
        let list = |kind: &str, ids: &Vec<TransitionId>| {
            let mut titles: Vec<String> = ids.iter().map(title).collect();
            titles.sort();
            format!("{kind} {}", titles.join(" "))
        };
        let mut all: Vec<String> = Vec::new();
        all.push(list("simple", &drawn.simple));
        all.push(list("simultaneous", &drawn.simultaneous));
        all.extend(drawn.divergences.values().map(|ids| list("divergence", ids)));
        all.extend(drawn.convergences.values().map(|ids| list("convergence", ids)));
        all.sort();
        all
    }

    #[test]
    fn kinds_of_the_example() {
        let ends: [(&[u32], &[u32]); 8] = [
            (&[0], &[1]),
            (&[1], &[2, 3]),
            (&[3], &[4]),
            (&[2], &[5]),
            (&[2], &[6]),
            (&[5], &[7]),
            (&[6], &[7]),
            (&[7, 4], &[8]),
        ];
        let wanted = [
            "convergence S5_to_S7 S6_to_S7",
            "divergence S2_to_S5 S2_to_S6",
            "simple S0_to_S1 S3_to_S4",
            "simultaneous S1_to_S2_S3 S4_S7_to_S8",
        ];
        assert_eq!(kinds(&chart(9, &ends)), wanted);
    }

    /// Divergences come first, and what enters a step alone beside one of their branches is simple.
    #[test]
    fn no_order_of_insertion_matters() {
        let ends: [(&[u32], &[u32]); 5] =
            [(&[0], &[1]), (&[0], &[2]), (&[3], &[2]), (&[2], &[4]), (&[1], &[4])];
        let wanted = kinds(&chart(5, &ends));
        assert_eq!(
            wanted,
            [
                "convergence S1_to_S4 S2_to_S4",
                "divergence S0_to_S1 S0_to_S2",
                "simple S3_to_S2",
                "simultaneous "
            ]
        );
        let mut random = fastrand::Rng::with_seed(1);
        for _ in 0..200 {
            let mut other = ends;
            random.shuffle(&mut other);
            assert_eq!(kinds(&chart(5, &other)), wanted);
        }
    }
}
