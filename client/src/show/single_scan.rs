//! Which instructions are asked about: in RUN those that are visible, in a single scan as many of
//! them as go into one window. How answers are shown is not known here.

use std::collections::BTreeMap;

use super::state::{Order, State};
use crate::reference::Reference;
use crate::service::{window_max, windows};

impl State {
    /// The visible instructions by their offsets, ascending, each with its result: where the PLC
    /// can tell what they do.
    pub(super) fn visible_instructions(&self) -> Vec<(u16, Reference)> {
        if !self.has_power_flow() {
            return Vec::new();
        }
        let rows = self.model.rows.get(self.visible()).unwrap_or(&[]);
        let mut asked = BTreeMap::new();
        for instruction in rows.iter().filter_map(|row| row.instruction()) {
            if let Some(offset) = instruction.offset {
                asked.entry(offset).or_insert(Reference::NONE);
            }
            for &(offset, index) in &instruction.taken {
                let watched = instruction.operands.get(index);
                asked.extend(watched.map(|watched| (offset, watched.operand.reference)));
            }
        }
        asked.into_iter().collect()
    }

    /// A single scan, with as many of the visible instructions as go into one window: a scan cannot
    /// be repeated for the others. The selected one and those around it come first.
    pub fn single_scan(&self) -> Order {
        let Some(identity) = self.identity.as_ref().filter(|identity| identity.has_scan_status)
        else {
            return Order::Scan(Vec::new());
        };
        let visible = self.visible_instructions();
        let room = usize::from(identity.room);
        let selected = self.selected_instruction().and_then(|instruction| instruction.offset);
        let selected = selected.and_then(|offset| visible.iter().position(|one| one.0 == offset));
        let most = window_max(room).min(visible.len());
        let around = selected.unwrap_or(0).saturating_sub(most / 2).min(visible.len() - most);
        let from = |first: usize| {
            let window = windows(visible.get(first..).unwrap_or(&[]), room).into_iter().next();
            window.unwrap_or(&[]).to_vec()
        };
        let window = from(around);
        // Those before it may be far away.
        let has_selected = selected.is_none_or(|selected| selected < around + window.len());
        Order::Scan(if has_selected { window } else { from(selected.unwrap_or(0)) })
    }

    /// How many visible instructions there are, and of how many it is known what they did in the
    /// single scan that is shown.
    pub fn known_of_scan(&self) -> (usize, usize) {
        let visible = self.visible_instructions();
        let known = visible.iter().filter(|(offset, _)| self.executed.contains_key(offset));
        (visible.len(), known.count())
    }

    /// Whether the PLC has executed scans after the single scan that is shown.
    pub(super) fn has_gone_on(&self) -> bool {
        let scans = self.identity.as_ref().map(|identity| identity.scans as u16);
        self.scanned.is_some() && self.scanned != scans
    }

    /// What instructions did is not that of the last scan any more.
    pub(super) fn forget_scan(&mut self) {
        self.executed.clear();
        self.scanned = None;
    }
}
