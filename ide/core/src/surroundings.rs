//! What is around the chip of the virtual Uno: its time, its plant, its switches and
//! potentiometers. The page emulates the chip itself: after each millisecond of it comes its data
//! memory, and out goes what is at its input pins.

use awl_asm::Address;
use awl_sim::machine::pins::{OUTPUT_PINS, duty, output_levels};
use awl_sim::operand::Operand;
use awl_sim::plant::{Inputs, Outputs, Plant};
use plc_isa::{AnalogInput, Area, DIGITAL_INPUTS, Settings};

use crate::pace::Pace;
use crate::protocol::Event;
use crate::simulator::{Bench, plant_event};

/// PINB and DDRB: levels of D8 to D13, and which of them are driven.
const LEVELS: usize = 0x23;
const DRIVEN: usize = 0x24;
/// The outputs that can be modulated, Q0.1 and Q0.2.
const MODULATED: [u8; 2] = [1, 2];

/// What is at the input pins: levels of D2 to D7, then converter counts of A0 to A5.
pub type Levels = [u16; 7];

/// The chip's surroundings, since power came.
pub struct Surroundings {
    settings: Settings,
    plant: Option<Box<dyn Plant>>,
    /// What the plant drives.
    wired: Inputs,
    /// What people have set, as levels.
    set: Inputs,
    outputs: u8,
    pwm: Vec<u16>,
    /// How far its time is, and how much is due.
    now_ms: u64,
    due_ms: f64,
    pace: Pace,
}

impl Surroundings {
    /// A chip with a program that has these settings.
    pub fn new(settings: Settings, bench: &Bench) -> Result<Surroundings, String> {
        let mut chip = Surroundings {
            settings,
            plant: bench.new_plant()?,
            wired: Inputs::default(),
            set: Inputs::default(),
            outputs: 0,
            pwm: Vec::new(),
            now_ms: 0,
            due_ms: 0.0,
            pace: Pace::default(),
        };
        // As inputs that nothing is connected to look to the program: off.
        for bit in 0..DIGITAL_INPUTS {
            chip.set.set_digital(bit, chip.settings.invert_inputs >> bit & 1 != 0);
        }
        for (&operand, &value) in &bench.driven {
            chip.drive(operand, value)?;
        }
        if let Some(plant) = &mut chip.plant {
            plant.step(0, chip.settings.invert_outputs.into(), &mut chip.wired);
        }
        Ok(chip)
    }

    /// Sets an input: a digital one logically, an analog one in counts.
    pub fn drive(&mut self, operand: Operand, value: i32) -> Result<(), String> {
        match operand {
            Operand::At(Address::Bit { area: Area::I, byte: 0, bit }) if bit < DIGITAL_INPUTS => {
                let is_inverted = self.settings.invert_inputs >> bit & 1 != 0;
                self.set.set_digital(bit, (value != 0) != is_inverted);
            }
            Operand::At(Address::Analog(AnalogInput::Raw(channel))) => {
                self.set.set_analog(channel, value);
            }
            _ => return Err(format!("{operand} has no pin on the Uno")),
        }
        Ok(())
    }

    /// Sets something in the plant; whether there is such a thing.
    pub fn handle(&mut self, name: &str, value: i64) -> bool {
        self.plant.as_mut().is_some_and(|plant| plant.set(name, value))
    }

    /// So much time of a clock on the wall has passed, of which a time-lapse makes more or less.
    pub fn is_due(&mut self, elapsed_ms: u64, bench: &Bench) {
        self.due_ms = match bench.is_paused {
            true => 0.0,
            false => self.pace.due(self.due_ms, elapsed_ms, bench.speed),
        };
    }

    /// Whole milliseconds of the chip that are due.
    pub fn due_ms(&self) -> u32 {
        self.due_ms as u32
    }

    /// A millisecond of the chip has passed; `data` is its data memory.
    pub fn pass(&mut self, data: &[u8]) -> Levels {
        self.now_ms += 1;
        self.due_ms -= 1.0;
        self.pace.passed();
        let register = |at: usize| data.get(at).copied().unwrap_or(0) & OUTPUT_PINS;
        let off = self.settings.invert_outputs;
        let levels = output_levels(data, register(LEVELS), register(DRIVEN), off) & OUTPUT_PINS;
        self.outputs = levels ^ off & OUTPUT_PINS;
        let duties = MODULATED.map(|output| (output, duty(data, output)));
        self.pwm = duties.iter().filter_map(|(_, duty)| *duty).collect();
        if let Some(plant) = &mut self.plant {
            let outputs = Outputs::from(levels).with_duties(duties);
            plant.step(self.now_ms, outputs, &mut self.wired);
        }
        self.levels()
    }

    /// What is at its pins.
    pub fn levels(&self) -> Levels {
        let signals = self.plant.as_ref().map(|plant| plant.signals()).unwrap_or_default();
        let source =
            |mask: u8, input: u8| if mask >> input & 1 != 0 { &self.wired } else { &self.set };
        let digital = (0..DIGITAL_INPUTS).fold(0, |bits, input| {
            bits | u16::from(source(signals.digital, input).digital(input)) << input
        });
        let mut levels = [digital, 0, 0, 0, 0, 0, 0];
        for (channel, counts) in (0..).zip(&mut levels[1..]) {
            *counts = source(signals.analog, channel).analog(channel);
        }
        levels
    }

    /// Milliseconds since power came.
    pub fn time_ms(&self) -> u64 {
        self.now_ms
    }

    /// How many times as fast as a clock its time goes, where that is not what was asked for.
    pub fn pace(&self) -> Option<f64> {
        self.pace.shortfall()
    }

    /// The points.
    pub fn pins(&self) -> Event {
        let [levels, analog @ ..] = self.levels();
        let inputs = levels as u8 ^ self.settings.invert_inputs & OUTPUT_PINS;
        Event::Pins {
            inputs,
            outputs: self.outputs,
            analog: analog.to_vec(),
            pwm: self.pwm.clone(),
        }
    }

    /// The plant as a picture needs it; `told`: events that were told before.
    pub fn plant(&self, name: &str, told: &mut usize) -> Option<Event> {
        Some(plant_event(self.plant.as_deref()?, name, told))
    }
}
