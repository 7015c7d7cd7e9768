//! Conditions that are followed from scan to scan. An operand is read once a scan, and a condition
//! looked at again only where a value has changed: scenarios of hours stay quick.

use crate::machine::{Machine, MachineError};
use crate::operand::Operand;
use crate::scenario::condition::Condition;

/// The conditions. Each is known by the number that it got when it was added.
#[derive(Default)]
pub(super) struct Follower {
    conditions: Vec<Condition>,
    holds: Vec<bool>,
    watches: Vec<Watch>,
}

/// An operand, and the conditions with it.
struct Watch {
    operand: Operand,
    /// Nothing before the first look.
    value: Option<i32>,
    conditions: Vec<usize>,
}

impl Follower {
    /// Begins to follow a condition, which does not hold until it is looked at.
    pub(super) fn add(&mut self, condition: &Condition) -> usize {
        let number = self.conditions.len();
        for comparison in condition.comparisons() {
            let operand = comparison.operand;
            match self.watches.iter_mut().find(|watch| watch.operand == operand) {
                Some(watch) => watch.conditions.push(number),
                None => {
                    self.watches.push(Watch { operand, value: None, conditions: vec![number] });
                }
            }
        }
        self.conditions.push(condition.clone());
        self.holds.push(false);
        number
    }

    /// Nobody asks for this condition any more.
    pub(super) fn close(&mut self, number: usize) {
        for watch in &mut self.watches {
            watch.conditions.retain(|&condition| condition != number);
        }
        self.watches.retain(|watch| !watch.conditions.is_empty());
    }

    /// Looks at the state after a scan. Tells the conditions that begin or end to hold.
    pub(super) fn look(
        &mut self,
        machine: &mut (impl Machine + ?Sized),
    ) -> Result<Vec<usize>, MachineError> {
        let mut touched = Vec::new();
        for watch in &mut self.watches {
            let value = machine.read(watch.operand)?;
            if watch.value.replace(value) != Some(value) {
                touched.extend_from_slice(&watch.conditions);
            }
        }
        touched.sort_unstable();
        touched.dedup();
        let mut changed = Vec::new();
        for number in touched {
            let holds = self.conditions[number].holds(&mut |operand| machine.read(operand))?;
            if std::mem::replace(&mut self.holds[number], holds) != holds {
                changed.push(number);
            }
        }
        Ok(changed)
    }

    /// Whether a condition held at the last look.
    pub(super) fn holds(&self, number: usize) -> bool {
        self.holds[number]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::fake::Fake;
    use crate::scenario::{Context, Scenario};

    fn condition(text: &str) -> Condition {
        let context = Context { symbols: &[], plant: None, has_operand: &mut |_| Ok(()) };
        let scenario = Scenario::parse("t.scn", &format!("always {text}"), context).unwrap();
        scenario.rules[0].condition.clone()
    }

    #[test]
    fn tells_what_begins_and_ends_to_hold() {
        let mut machine = Fake::new(|now, memory| memory.set("MW0", now as i32));
        let mut follower = Follower::default();
        let three = follower.add(&condition("MW0 = 3"));
        let large = follower.add(&condition("MW0 > 4 or MW2 = 7"));
        let mut seen = Vec::new();
        for now in 0..6 {
            machine.scan(now);
            for number in follower.look(&mut machine).unwrap() {
                seen.push((now, number, follower.holds(number)));
            }
        }
        assert_eq!(seen, [(3, three, true), (4, three, false), (5, large, true)]);
        follower.close(large);
        assert_eq!(follower.watches.len(), 1, "MW2 is read for nobody");
        follower.close(three);
        assert_eq!(follower.watches.len(), 0);
    }
}
