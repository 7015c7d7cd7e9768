//! What a scenario changes, in the order of time: values, once and repeated, and what else happens.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::action::Action;
use crate::machine::{Machine, MachineError};
use crate::operand::Operand;
use crate::scenario::{Scenario, Setting};

/// The changes, and how far they are done.
pub(super) struct Changes {
    scan_ms: u64,
    settings: Vec<Setting>,
    /// When which setting is due, the next one first; at the same time in the order of the file.
    due: BinaryHeap<Reverse<(u64, usize)>>,
    /// What the last scan saw for the only time.
    events: Vec<Operand>,
    actions: Vec<Action>,
    begun: usize,
}

impl Changes {
    pub(super) fn new(scenario: &Scenario, scan_ms: u64) -> Changes {
        let settings = scenario.settings.clone();
        let due = settings.iter().enumerate().map(|(index, setting)| (setting.at_ms, index));
        let due = due.map(Reverse).collect();
        let mut actions = scenario.actions.clone();
        // Stable: what is at the same time stays in the order of the file.
        actions.sort_by_key(Action::at_ms);
        Changes { scan_ms, settings, due, events: Vec::new(), actions, begun: 0 }
    }

    /// Everything that the scan which starts at `now_ms` is to see.
    pub(super) fn go_on(
        &mut self,
        now_ms: u64,
        machine: &mut (impl Machine + ?Sized),
    ) -> Result<(), MachineError> {
        for event in std::mem::take(&mut self.events) {
            machine.write(event, 0)?;
        }
        while let Some(&Reverse((at_ms, index))) = self.due.peek()
            && at_ms <= now_ms
        {
            self.due.pop();
            let setting = &self.settings[index];
            machine.write(setting.operand, setting.value)?;
            if setting.for_scan {
                self.events.push(setting.operand);
            }
            let next_ms = setting.repeat.and_then(|repeat| repeat.next_ms(at_ms));
            self.due.extend(next_ms.map(|next_ms| Reverse((next_ms, index))));
        }
        while let Some(action) = self.actions.get(self.begun) {
            // A scan before, where the machine waits for the time itself.
            let ahead_ms = if action.keeps_its_time() { self.scan_ms } else { 0 };
            if action.at_ms() > now_ms + ahead_ms {
                break;
            }
            self.begun += 1;
            machine.act(action)?;
        }
        Ok(())
    }

    /// How many have never been done.
    pub(super) fn left(&self) -> usize {
        let is_first = |Reverse((at_ms, index)): &&Reverse<(u64, usize)>| {
            self.settings[*index].at_ms == *at_ms
        };
        self.due.iter().filter(is_first).count() + self.actions.len() - self.begun
    }
}
