//! How the target is, as the page is told.

use client::show::state::{Agreement, Link};

use super::Session;
use crate::protocol::{Place, Status};
use crate::surroundings::Surroundings;

impl Session {
    /// How the target is.
    pub(super) fn status(&self) -> Status {
        let loading = self.outside.loading();
        let status = Status { target: self.kind, loading, ..Status::default() };
        let Some(plc) = &self.plc else {
            let mode = if status.loading.is_some() { "LOADING" } else { "OFFLINE" };
            return Status { mode: mode.to_owned(), agreement: "unknown".to_owned(), ..status };
        };
        let state = &plc.state;
        let identity = state.identity.as_ref();
        let mode = match (&state.link, identity) {
            (Link::Lost(_), _) => "LOST",
            _ if self.bench.is_paused => "PAUSE",
            (_, Some(identity)) if identity.is_running => "RUN",
            (_, Some(_)) => "STOP",
            (_, None) => "OFFLINE",
        };
        let agreement = match state.agreement() {
            Agreement::Same => "same",
            Agreement::Native => "native",
            Agreement::Other => "other",
            Agreement::NoProgram => "none",
            Agreement::Unknown => "unknown",
        };
        let lost = match &state.link {
            Link::Lost(why) => Some(why.clone()),
            Link::Up | Link::Connecting => None,
        };
        let fault = state.fault();
        let measured = identity.filter(|one| self.simulator.is_none() && one.counts_per_ms > 0);
        Status {
            mode: mode.to_owned(),
            agreement: agreement.to_owned(),
            scans: identity.map_or(0, |identity| identity.scans),
            time_ms: match (&self.simulator, &self.chip) {
                (Some(simulator), _) => simulator.time_ms(),
                (None, Some(chip)) => chip.time_ms(),
                (None, None) => 0,
            },
            pace: self.chip.as_ref().and_then(Surroundings::pace),
            scan_us: measured.map(|one| {
                let us = |counts: u32| f64::from(counts) * 1000.0 / f64::from(one.counts_per_ms);
                (us(one.shortest), us(one.last), us(one.longest))
            }),
            fault_at: fault.as_deref().and_then(|fault| self.place_in(fault)),
            fault,
            lost,
            ..status
        }
    }

    /// The place that a fault names: `file:line`.
    fn place_in(&self, fault: &str) -> Option<Place> {
        let files = self.editor.files_of(self.editor.main()?);
        files.iter().find_map(|file| {
            let (_, after) = fault.split_once(&format!("{file}:"))?;
            let digits: String = after.chars().take_while(char::is_ascii_digit).collect();
            self.editor.line(file, digits.parse().ok()?)
        })
    }
}
