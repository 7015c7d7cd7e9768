//! The questions of a client, asked over a connection that waits for the answers.

use client::service::{
    BeginDownload, Command, EndDownload, Force, Forced, Identification, Identify, Identity, Object,
    Reading, Set, Space, Status, StatusWindow, TracePhase, TraceState, Tracing, Trigger, Watch,
    Watched, blocks,
};
use client::{Error, Operand, Reference};
use plc_isa::LINE_ROOM;

use crate::connection::Client;

impl Client {
    /// Asks the PLC what it is and how it is.
    pub fn identify(&mut self) -> Result<Identity, Error> {
        self.ask(&Identify)
    }

    /// A text of Modbus' identification; `None` where the PLC has none.
    pub fn identification(&mut self, object: Object) -> Result<Option<String>, Error> {
        match self.ask(&Identification(object)) {
            Err(Error::Refused { exception: 2, .. }) => Ok(None),
            other => other,
        }
    }

    /// Tells the PLC what to do. RUN and scans begin after the answer: [`identify`](Self::identify)
    /// tells how it went.
    pub fn control(&mut self, command: Command) -> Result<(), Error> {
        self.ask(&command)
    }

    /// The values of up to [`WATCH_MAX`](client::service::WATCH_MAX) operands, all from the end of
    /// the same scan.
    pub fn watch(&mut self, references: &[Reference]) -> Result<Watched, Error> {
        self.ask(&Watch(references))
    }

    /// The same; when the PLC refuses, the error names the operands that it does not have.
    pub fn watch_operands(&mut self, operands: &[Operand]) -> Result<Watched, Error> {
        let references: Vec<Reference> = operands.iter().map(|operand| operand.reference).collect();
        match self.watch(&references) {
            Err(Error::Refused { function, exception: 2 }) => {
                let missing = |operand: &&Operand| {
                    matches!(
                        self.watch(&[operand.reference]),
                        Err(Error::Refused { exception: 2, .. })
                    )
                };
                let names: Vec<&str> =
                    operands.iter().filter(missing).map(|operand| &*operand.name).collect();
                match names.is_empty() {
                    true => Err(Error::Refused { function, exception: 2 }),
                    false => Err(Error::Request(format!(
                        "the program in the PLC does not use {}",
                        names.join(", ")
                    ))),
                }
            }
            other => other,
        }
    }

    /// Writes values, all of them at the end of the same scan, or none.
    pub fn set(&mut self, values: &[(Reference, u32)]) -> Result<(), Error> {
        self.ask(&Set(values))
    }

    /// What is forced.
    pub fn forced(&mut self) -> Result<Vec<Forced>, Error> {
        self.ask(&Force::List)
    }

    /// Forces an operand. Gives the whole table after it.
    pub fn force(&mut self, reference: Reference, value: u32) -> Result<Vec<Forced>, Error> {
        self.ask(&Force::Begin(reference, value))
    }

    /// Ends the forcing of an operand. Gives the whole table after it.
    pub fn unforce(&mut self, reference: Reference) -> Result<Vec<Forced>, Error> {
        self.ask(&Force::End(reference))
    }

    /// Ends all forcing.
    pub fn unforce_all(&mut self) -> Result<(), Error> {
        self.ask(&Force::EndAll).map(drop)
    }

    /// What instructions do in the next scan, as [`StatusWindow`] takes them.
    pub fn status(&mut self, instructions: &[(u16, Reference)]) -> Result<Status, Error> {
        self.ask(&StatusWindow(instructions))
    }

    /// How far the trace is.
    pub fn trace_phase(&mut self) -> Result<TracePhase, Error> {
        self.ask(&Tracing::Look)
    }

    /// What the trace has recorded, of which there must be one.
    pub fn trace_state(&mut self) -> Result<TraceState, Error> {
        let head = self.read(Space::Trace, 0, TraceState::HEAD_LEN, LINE_ROOM)?;
        Ok(TraceState::of(&head))
    }

    /// Begins a trace of up to [`TRACE_MAX`](client::service::TRACE_MAX) operands, a sample every
    /// `every` scans, `before` of them before the trigger.
    pub fn start_trace(
        &mut self,
        every: u16,
        before: u16,
        trigger: Trigger,
        operands: &[Reference],
    ) -> Result<TracePhase, Error> {
        self.ask(&Tracing::Start { every, before, trigger, operands })
    }

    /// Ends the trace; the samples stay.
    pub fn stop_trace(&mut self) -> Result<TracePhase, Error> {
        self.ask(&Tracing::Stop)
    }

    /// Reads `len` bytes from an offset on, in blocks that fit the PLC's room for answers.
    pub fn read(
        &mut self,
        space: Space,
        offset: u16,
        len: u16,
        room: u16,
    ) -> Result<Vec<u8>, Error> {
        let mut reading = Reading::new(space, offset, len, room);
        while let Some(block) = reading.next() {
            reading.take(&self.ask(&block)?);
        }
        Ok(reading.bytes())
    }

    /// Writes an image over the line, in blocks that fit the PLC's room for requests, while the
    /// program there goes on. Gives the fault that the PLC has with it, all zeros without one: then
    /// it is in force, unless the last answer was lost, which [`identify`](Self::identify) shows.
    pub fn download(&mut self, image: &[u8], room: u16) -> Result<[u8; 4], Error> {
        self.ask(&BeginDownload(image.len() as u16))?;
        for block in blocks(image, room) {
            self.ask(&block)?;
        }
        match self.ask(&EndDownload) {
            Err(error) if error.is_worth_repeating() => Ok([0; 4]),
            other => other,
        }
    }

    /// Reads the image out of the PLC; empty where there is none.
    pub fn read_program(&mut self) -> Result<Vec<u8>, Error> {
        let identity = self.identify()?;
        self.read(Space::Program, 0, identity.image_len, identity.room)
    }
}
