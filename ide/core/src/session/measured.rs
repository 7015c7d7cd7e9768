//! What is measured: which signals, for the oscilloscope or a recording, and what has come of them.

use super::Session;
use crate::plc::Plc;
use crate::protocol::Event;
use crate::recorder::Recorder;
use crate::scope::{Batch, signal};

impl Session {
    /// What was measured, for the oscilloscope; or how far the recording is.
    pub(super) fn samples(&mut self) -> Vec<Event> {
        let samples = self.plc.as_mut().map(Plc::samples).unwrap_or_default();
        samples.into_iter().for_each(|sample| self.scope.add(sample));
        let batches = self.scope.take();
        let Some(recorder) = &mut self.recorder else {
            let event = |batch: Batch| batch.into_event(&self.scope_known);
            return batches.into_iter().map(event).collect();
        };
        batches.iter().for_each(|batch| recorder.take(batch));
        if self.simulator.is_none() && !self.plc.as_ref().is_some_and(Plc::is_sampling) {
            recorder.end("the target does not tell these values");
        }
        if recorder.has_ended() {
            return self.recorded().into_iter().collect();
        }
        let progress = recorder.progress();
        self.told.news(progress).into_iter().collect()
    }

    /// Ends the recording with what it has.
    pub(super) fn leave_recording(&mut self, why: &str) {
        if let Some(mut recorder) = self.recorder.take() {
            recorder.end(why);
            self.errands.push(recorder.recorded());
        }
    }

    /// Ends the recording; the oscilloscope goes on.
    pub(super) fn recorded(&mut self) -> Option<Event> {
        let recorder = self.recorder.take()?;
        self.choose_signals();
        self.scope.missed();
        Some(recorder.recorded())
    }

    /// Records signals of the target from now on.
    pub(super) fn record(
        &mut self,
        names: &[String],
        every_ms: u32,
        for_ms: u32,
    ) -> Result<(), String> {
        if self.recorder.is_some() {
            return Err("a recording is under way: end it first".to_owned());
        }
        if names.is_empty() {
            return Err("choose the signals that are to be recorded".to_owned());
        }
        let plc = self.connected()?;
        let operands = names.iter().map(|name| plc.operand(name)).collect::<Result<_, _>>()?;
        if let Err(message) = self.sample(names, every_ms) {
            self.choose_signals();
            return Err(message);
        }
        self.recorder = Some(Recorder::new(operands, every_ms, for_ms));
        Ok(())
    }

    /// Has the signals of the oscilloscope sampled. Those that the program does not have, perhaps
    /// of the last one, are complained about, and are gaps.
    pub(super) fn choose_signals(&mut self) {
        let (names, every_ms) = self.scope_names.clone();
        let Some(plc) = &self.plc else { return };
        let is_simulator = self.simulator.is_some();
        let error = |name: &String| match is_simulator {
            true => signal(name, plc).err(),
            false => plc.operand(name).err(),
        };
        let unknown: Vec<Option<String>> = names.iter().map(error).collect();
        self.scope_known = unknown.iter().map(Option::is_none).collect();
        let known = names.iter().zip(&self.scope_known).filter(|(_, is_known)| **is_known);
        let known: Vec<String> = known.map(|(name, _)| name.clone()).collect();
        let refused = self.sample(&known, every_ms).err();
        let messages = unknown.into_iter().flatten().chain(refused);
        self.errands.extend(messages.map(|message| Event::Notice { message, bad: true }));
    }

    /// Has signals sampled; all of them, or none.
    fn sample(&mut self, names: &[String], every_ms: u32) -> Result<(), String> {
        self.scope.choose(Vec::new(), 0);
        let Some(plc) = &mut self.plc else { return Ok(()) };
        let Some(simulator) = &mut self.simulator else {
            return plc.sample(names, u64::from(every_ms));
        };
        let operands: Result<Vec<_>, _> = names.iter().map(|name| signal(name, plc)).collect();
        let operands = operands?;
        operands.iter().try_for_each(|&operand| simulator.has(operand))?;
        self.scope.choose(operands, u64::from(every_ms));
        Ok(())
    }
}
