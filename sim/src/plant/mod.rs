//! Plants: models of what is wired to the PLC. They see output pins and drive inputs as simulated
//! time passes.
//!
//! A new plant is a type that implements [`Plant`], and a row in [`PLANTS`]:
//!
//! ```
//! use awl_sim::plant::{Inputs, Outputs, Plant, Report, Signals};
//!
//! /// A lamp at Q0.0 with a light sensor at I0.0.
//! struct Lamp {
//!     report: Report,
//! }
//!
//! impl Plant for Lamp {
//!     fn signals(&self) -> Signals {
//!         Signals { digital: 0b1, analog: 0 }
//!     }
//!
//!     fn step(&mut self, now_ms: u64, outputs: Outputs, inputs: &mut Inputs) {
//!         let is_lit = outputs.is_high(0);
//!         if is_lit != inputs.digital(0) {
//!             self.report.event(now_ms, if is_lit { "lit" } else { "dark" });
//!         }
//!         inputs.set_digital(0, is_lit);
//!     }
//!
//!     fn report(&self) -> Report {
//!         self.report.clone()
//!     }
//!
//!     fn view(&self) -> Vec<(String, f64)> {
//!         Vec::new()
//!     }
//! }
//! ```

mod control;
mod faults;
pub mod file;
mod options;
mod outputs;
mod report;
mod spec;
pub mod station1;
pub mod tank;

use awl_asm::Address;
use plc_isa::{AnalogInput, Area};

use crate::operand::Operand;
pub use control::{Control, ControlKind, Effect, Fault, Words};
pub(crate) use file::words_of;
pub use options::{OptionError, Options};
pub use outputs::Outputs;
pub use report::{EVENTS_MAX, Event, Report};
pub(crate) use spec::file_of;
pub use spec::{PlantSpec, SpecErrors, parse_spec, parse_spec_with};

/// A plant model.
///
/// Before every scan the driver calls [`step`](Plant::step) with the pins as the last scan left
/// them; they have been so since the last call. How much time lies between two calls is the length
/// of a scan, but a plant must work for any: it keeps the time of the last call and moves by the
/// difference. The first call has time 0.
pub trait Plant: Send {
    /// The inputs that this plant drives, the same at all times. A scenario cannot set them.
    fn signals(&self) -> Signals;

    /// Goes on to `now_ms`.
    ///
    /// `outputs`: the pins D8 to D13. A plant after an inverting relay board reacts to low pins.
    /// `inputs` keeps what was set in earlier calls.
    fn step(&mut self, now_ms: u64, outputs: Outputs, inputs: &mut Inputs);

    /// What has happened so far.
    fn report(&self) -> Report;

    /// How it is now, for a picture and for scenarios: names of its parts with positions, counts,
    /// or 0 and 1; always the same names.
    fn view(&self) -> Vec<(String, f64)>;

    /// What people and scenarios can set.
    fn controls(&self) -> Vec<Control> {
        Vec::new()
    }

    /// Sets a control, named in any letter case; whether there is one of this name. From the next
    /// step on it has this value.
    fn set(&mut self, _control: &str, _value: i64) -> bool {
        false
    }

    /// How the shapes of a plant file are, in their order: empty where one is not to be seen;
    /// otherwise how far it is moved, in thousandths, and behind that for a lamp 0 or 1, for a
    /// level its thousandths, for a value that, for pieces the thousandths of their way.
    fn places(&self) -> Vec<Vec<f64>> {
        Vec::new()
    }
}

/// A choice of inputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Signals {
    /// Bit n is I0.n, n = 0..=5.
    pub digital: u8,
    /// Bit n is analog channel n (Ain n, AIW 2n), n = 0..=5.
    pub analog: u8,
}

impl Signals {
    /// Whether setting this operand would change one of the inputs.
    pub fn contain(self, operand: Operand) -> bool {
        match operand {
            Operand::At(Address::Bit { area: Area::I, byte: 0, bit }) => {
                self.digital >> bit & 1 == 1
            }
            Operand::At(
                Address::Byte { area: Area::I, byte: 0 } | Address::Word { area: Area::I, byte: 0 },
            ) => self.digital != 0,
            Operand::At(Address::Analog(
                AnalogInput::Scaled(channel) | AnalogInput::Raw(channel),
            )) => self.analog >> channel & 1 == 1,
            _ => false,
        }
    }
}

/// The inputs a plant drives, as electrical levels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Inputs {
    levels: u8,
    counts: [u16; 6],
}

impl Inputs {
    /// The level of the pin of I0.`input`, 0..=5.
    pub fn digital(&self, input: u8) -> bool {
        self.levels >> input & 1 == 1
    }

    /// Sets the level of the pin of I0.`input`, 0..=5.
    pub fn set_digital(&mut self, input: u8, high: bool) {
        self.levels = self.levels & !(1 << input) | u8::from(high) << input;
    }

    /// The voltage at analog input `channel` (0..=5) as converter counts.
    pub fn analog(&self, channel: u8) -> u16 {
        self.counts.get(usize::from(channel)).copied().unwrap_or(0)
    }

    /// Sets the voltage at analog input `channel` (0..=5) as converter counts, limited to 0..=1023.
    pub fn set_analog(&mut self, channel: u8, counts: i32) {
        if let Some(place) = self.counts.get_mut(usize::from(channel)) {
            *place = counts.clamp(0, i32::from(AnalogInput::RAW_MAX)) as u16;
        }
    }
}

/// A plant that can be asked for by name.
pub struct PlantKind {
    /// The name.
    pub name: &'static str,
    /// What it models, in a few words.
    pub doc: &'static str,
    /// Its options: name, and what it takes.
    pub options: &'static [(&'static str, &'static str)],
    /// Faults that it can have: name, what it does, and words in English, German and Spanish.
    pub faults: &'static [(&'static str, Effect, [&'static str; 3])],
    /// Makes one from its options.
    pub build: fn(&Options) -> Result<Box<dyn Plant>, OptionError>,
}

/// Names with numbers, as [`Plant::view`] gives them.
fn named<const COUNT: usize>(list: [(&str, f64); COUNT]) -> Vec<(String, f64)> {
    list.into_iter().map(|(name, value)| (name.to_string(), value)).collect()
}

/// All plants that need no file.
pub const PLANTS: &[PlantKind] = &[station1::KIND, tank::KIND];
