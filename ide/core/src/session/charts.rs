//! The charts that the page shows: how they are on the target, and steps that are set by hand.

use client::show::state::Link;

use super::Session;
use crate::chart::Charts;
use crate::protocol::{Event, Moment};
use crate::scope;

impl Session {
    /// The page shows other charts, or none: the target is asked for their operands.
    pub(super) fn show_charts(&mut self, charts: Option<Charts>) {
        self.charts = charts;
        self.follow_charts();
    }

    /// Asks a target for the operands of the charts.
    pub(super) fn follow_charts(&mut self) {
        let names = self.charts.as_ref().map(Charts::operands).unwrap_or_default();
        let Some(plc) = &mut self.plc else { return };
        plc.watch_besides(&names);
        let Some(simulator) = &mut self.simulator else { return };
        let operands = names.iter().map(|name| scope::signal(name, plc).ok()).collect();
        simulator.follow(operands, self.charts.as_ref().map_or(0, Charts::count));
    }

    /// How the charts are, if the target has their program.
    pub(super) fn situation(&mut self) -> Option<Event> {
        let is_up = self.plc.as_ref()?.state.link == Link::Up && self.has_program();
        let seen = self.simulator.as_mut().map(|simulator| simulator.seen());
        let (charts, plc) = (self.charts.as_ref().filter(|_| is_up)?, self.plc.as_ref()?);
        let Some((now, before, lost)) = seen else {
            let time_ms = self.chip.as_ref().map_or(self.now_ms, |chip| chip.time_ms());
            let scan = plc.state.identity.as_ref().map_or(0, |identity| identity.scans);
            let now = charts.moment(time_ms as f64, scan, &plc.besides());
            return Some(Event::Situation { id: charts.id, now, before: Vec::new(), lost: false });
        };
        let moment = |seen: &crate::trail::Seen| -> Moment {
            charts.moment(seen.time_ms as f64, seen.scan, &seen.values)
        };
        let before = before.iter().map(moment).collect();
        Some(Event::Situation { id: charts.id, now: moment(&now), before, lost })
    }

    /// Sets a step of the simulator by hand, at once, whether it runs or is paused.
    pub(super) fn activate(&mut self, step: &str, on: bool) -> Result<(), String> {
        let is_same = self.has_program();
        let (Some(plc), Some(simulator)) = (&self.plc, &mut self.simulator) else {
            return Err(
                "steps are set by hand in the simulator: choose it and press Run".to_owned()
            );
        };
        if !is_same {
            return Err("the simulator has another program: press Run".to_owned());
        }
        let variable = scope::signal(step, plc).map_err(|_| {
            format!("{step} has no variable: a macro-step is active while a step of its chart is")
        })?;
        simulator.set(variable, i32::from(on))?;
        if on && let Ok(time) = scope::signal(&format!("{step}.T"), plc) {
            simulator.set(time, 0)?;
        }
        Ok(())
    }
}
