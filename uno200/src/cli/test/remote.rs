//! A PLC over a line as a machine that scenarios run on: inputs are forced, memory is set, operands
//! are read from what is seen of the scans. It keeps its own time.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::time::{Duration, Instant};

use anyhow::{Error, Result};
use awl_asm::Address;
use awl_sim::machine::{Machine, MachineError, Mode};
use awl_sim::operand::{Operand, Width};
use awl_sim::scenario::{Scenario, Tolerance};
use client::Reference;
use client::fault;
use client::program::Program;
use client::service::{Command, SET_MAX};
use plc_isa::{AnalogInput, Area};
use uno200::Client;

use super::prepared::{Prepared, reference};
use super::sight::{Seen, Sight};

/// A PLC in which no scan is executed for so long, beyond its period, is asked whether it runs.
const SILENCE: Duration = Duration::from_millis(300);
/// Two clocks drift apart by so many thousandths: a board has a ceramic resonator.
const DRIFT: u64 = 5;
/// Analog inputs, AIW0 to AIW10.
const ANALOG_INPUTS: u8 = 6;

/// The machine.
pub(super) struct Remote<'a> {
    client: &'a mut Client,
    program: &'a Program,
    sight: Sight,
    /// The fixed period of the scans in milliseconds; 0: they have none.
    period_ms: u64,
    /// What is read, in the order in which it is seen.
    operands: Vec<Operand>,
    values: HashMap<Operand, i32>,
    /// The start of the last scan that was seen.
    seen_ms: Option<u64>,
    /// Bytes of I, words of AIW by their channel; and which of them the PLC is to be told.
    digital: BTreeMap<u16, u8>,
    analog: BTreeMap<u8, u16>,
    changed: BTreeSet<Input>,
    /// Memory that is to be written.
    writes: Vec<(Reference, u32)>,
    is_begun: bool,
    mode: Mode,
    fault: Option<String>,
    error: Option<client::Error>,
    /// How late a change of inputs came at most, in milliseconds.
    late_ms: u64,
    first_change_ms: Option<u64>,
}

/// What is forced as one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Input {
    Byte(u16),
    Analog(u8),
}

impl<'a> Remote<'a> {
    /// In STOP.
    pub(super) fn new(
        client: &'a mut Client,
        prepared: &'a mut Prepared,
        room: u16,
    ) -> Result<Remote<'a>> {
        let Prepared { program, scenario, period_ms, fresh, .. } = prepared;
        let operands = operands(scenario);
        let values = operands.iter().map(|&operand| Ok((operand, fresh.read(operand)?)));
        let values = values.collect::<Result<_, MachineError>>()?;
        let references = operands.iter().filter_map(|&operand| reference(operand)).collect();
        let bytes_per_s = client.bytes_per_second();
        let sight = Sight::new(client, references, *period_ms, room, bytes_per_s)?;
        let uses = |channel: &u8| {
            let address = Address::Analog(AnalogInput::Scaled(*channel));
            program.assembly.usage.accesses.contains_key(&address)
        };
        let analog: BTreeMap<u8, u16> =
            (0..ANALOG_INPUTS).filter(uses).map(|channel| (channel, 0)).collect();
        let changed = analog.keys().map(|&channel| Input::Analog(channel));
        let changed = changed.chain([Input::Byte(0)]).collect();
        Ok(Remote {
            client,
            program,
            sight,
            period_ms: period_ms.unwrap_or(0),
            operands,
            values,
            seen_ms: None,
            digital: BTreeMap::from([(0, 0)]),
            analog,
            changed,
            writes: Vec::new(),
            is_begun: false,
            mode: Mode::Run,
            fault: None,
            error: None,
            late_ms: 0,
            first_change_ms: first_change_ms(scenario),
        })
    }

    /// How exactly times are kept. `ms`: how late a change may come, and what follows from it.
    pub(super) fn tolerance(&self, ms: u64) -> Tolerance {
        match self.sight.is_exact() {
            true => Tolerance {
                ms,
                // What the PLC does by itself is seen at its time.
                exact_to_ms: self.first_change_ms.unwrap_or(u64::MAX),
                drift: 0,
            },
            false if self.period_ms > 0 => Tolerance { ms, exact_to_ms: 0, drift: 0 },
            false => Tolerance { ms, exact_to_ms: 0, drift: DRIFT },
        }
    }

    /// How late a change of inputs came at most, in milliseconds, and how the PLC was seen. Fails
    /// with what went wrong.
    pub(super) fn end(self) -> Result<(u64, String)> {
        match self.error {
            Some(error) => Err(Error::new(error)),
            None => Ok((self.late_ms, self.sight.to_string())),
        }
    }

    /// Has the scans executed that begin up to this time, and sees the last of them.
    fn go_on(&mut self, now_ms: u64) -> Result<(), client::Error> {
        let has_changes = !self.changed.is_empty() || !self.writes.is_empty();
        self.tell_changes()?;
        if !self.is_begun {
            self.is_begun = true;
            self.client.control(Command::Run)?;
            self.sight.begin();
        } else if has_changes {
            let late_ms = self.sight.now_ms(self.client)?.saturating_sub(now_ms);
            self.late_ms = self.late_ms.max(late_ms);
        }
        let silence = SILENCE + Duration::from_millis(2 * self.period_ms);
        let mut last = Instant::now();
        while self.mode == Mode::Run && self.seen_ms.is_none_or(|seen_ms| seen_ms < now_ms) {
            match self.sight.look(self.client)? {
                Some(Seen { at_ms, values }) => {
                    self.seen_ms = Some(at_ms);
                    for (&operand, raw) in self.operands.iter().zip(values) {
                        self.values.insert(operand, number(operand, raw));
                    }
                    last = Instant::now();
                }
                None if last.elapsed() > silence => {
                    self.look_at_mode()?;
                    last = Instant::now();
                }
                None => {}
            }
        }
        Ok(())
    }

    /// Forces inputs and sets memory.
    fn tell_changes(&mut self) -> Result<(), client::Error> {
        for input in std::mem::take(&mut self.changed) {
            let (address, value) = match input {
                Input::Byte(byte) => {
                    let value = self.digital.get(&byte).copied().unwrap_or(0);
                    (Address::Byte { area: Area::I, byte }, u32::from(value))
                }
                Input::Analog(channel) => {
                    let value = self.analog.get(&channel).copied().unwrap_or(0);
                    (Address::Analog(AnalogInput::Scaled(channel)), u32::from(value))
                }
            };
            if let Some(reference) = Reference::to(address) {
                self.client.force(reference, value)?;
            }
        }
        let writes = std::mem::take(&mut self.writes);
        // In little room fewer at once.
        let most = if writes.len() * 7 + 2 > 62 { SET_MAX / 2 } else { SET_MAX };
        writes.chunks(most).try_for_each(|part| self.client.set(part))
    }

    /// Whether it still runs. In STOP outputs are off.
    fn look_at_mode(&mut self) -> Result<(), client::Error> {
        let identity = self.client.identify()?;
        if identity.is_running {
            return Ok(());
        }
        self.mode = Mode::Stop;
        self.fault = fault::text(identity.fault, Some(self.program));
        for (operand, value) in &mut self.values {
            if is_output(operand.address()) {
                *value = 0;
            }
        }
        Ok(())
    }

    fn set_input(&mut self, byte: u16, mask: u8, value: u8) {
        let held = self.digital.entry(byte).or_default();
        *held = *held & !mask | value & mask;
        self.changed.insert(Input::Byte(byte));
    }
}

impl Machine for Remote<'_> {
    fn write(&mut self, operand: Operand, value: i32) -> Result<(), MachineError> {
        match operand {
            Operand::At(Address::Bit { area: Area::I, byte, bit }) => {
                self.set_input(byte, 1 << bit, u8::from(value != 0) << bit);
            }
            Operand::At(Address::Byte { area: Area::I, byte }) => {
                self.set_input(byte, 0xFF, value as u8);
            }
            Operand::At(Address::Word { area: Area::I, byte }) => {
                for (byte, value) in (byte..).zip((value as u16).to_be_bytes()) {
                    self.set_input(byte, 0xFF, value);
                }
            }
            Operand::At(Address::Double { area: Area::I, byte }) => {
                for (byte, value) in (byte..).zip(value.to_be_bytes()) {
                    self.set_input(byte, 0xFF, value);
                }
            }
            Operand::At(Address::Analog(AnalogInput::Scaled(channel))) => {
                self.analog.insert(channel, value as u16);
                self.changed.insert(Input::Analog(channel));
            }
            _ => {
                let reference = reference(operand)
                    .ok_or_else(|| MachineError(format!("{operand} cannot be set")))?;
                self.writes.push((reference, value as u32));
            }
        }
        Ok(())
    }

    fn read(&mut self, operand: Operand) -> Result<i32, MachineError> {
        let value = self.values.get(&operand).copied();
        value.ok_or_else(|| MachineError(format!("{operand} is not looked at")))
    }

    fn scan(&mut self, now_ms: u64) {
        if self.error.is_some() || self.is_begun && self.mode == Mode::Stop {
            return;
        }
        if let Err(error) = self.go_on(now_ms) {
            self.error = Some(error);
            self.mode = Mode::Stop;
        }
    }

    fn mode(&self) -> Mode {
        self.mode
    }

    fn fault(&self) -> Option<String> {
        self.fault.clone()
    }

    /// Only for plants, which there are none of here.
    fn pin_levels(&mut self) -> u8 {
        0
    }

    /// The same.
    fn drive_pin(&mut self, _input: u8, _high: bool) {}
}

/// What a scenario looks at, each once.
fn operands(scenario: &Scenario) -> Vec<Operand> {
    let expectations = scenario.expectations.iter().map(|expectation| &expectation.condition);
    let rules = scenario.rules.iter().map(|rule| &rule.condition);
    let until = scenario.until.iter().map(|until| &until.condition);
    let conditions = expectations.chain(rules).chain(until);
    let operands = conditions.flat_map(|condition| condition.comparisons());
    let operands: BTreeSet<Operand> = operands.map(|comparison| comparison.operand).collect();
    operands.into_iter().collect()
}

/// When something changes from outside for the first time after the beginning.
fn first_change_ms(scenario: &Scenario) -> Option<u64> {
    let settings = scenario.settings.iter().filter_map(|setting| match setting.repeat {
        Some(repeat) if setting.at_ms == 0 => Some(repeat.period_ms),
        _ => Some(setting.at_ms).filter(|&at_ms| at_ms > 0),
    });
    settings.min()
}

/// A raw value as a scenario has it.
fn number(operand: Operand, raw: u32) -> i32 {
    match operand.width() {
        Width::Bit => i32::from(raw & 1 != 0),
        Width::Byte => i32::from(raw as u8),
        Width::Word => i32::from(raw as i16),
        Width::Double | Width::Real => raw as i32,
    }
}

fn is_output(address: Address) -> bool {
    match address {
        Address::Bit { area, .. }
        | Address::Byte { area, .. }
        | Address::Word { area, .. }
        | Address::Double { area, .. } => area == Area::Q,
        _ => false,
    }
}
