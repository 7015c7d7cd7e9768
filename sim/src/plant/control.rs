//! What people, or a scenario, can set in a plant: buttons, switches, sliders and faults, as data.

/// Words for people in the languages of the page.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Words {
    /// English.
    pub en: String,
    /// German, where there are such; otherwise the English ones.
    pub de: Option<String>,
    /// Spanish, likewise.
    pub es: Option<String>,
}

impl Words {
    /// In all three languages.
    pub fn new(en: &str, de: &str, es: &str) -> Words {
        Words { en: en.to_string(), de: Some(de.to_string()), es: Some(es.to_string()) }
    }

    /// In English alone.
    pub fn english(en: &str) -> Words {
        Words { en: en.to_string(), de: None, es: None }
    }
}

/// Something in a plant that can be set from outside.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Control {
    /// Its name in the plant and in scenarios.
    pub name: String,
    /// What people read beside it.
    pub words: Words,
    /// How it is set.
    pub kind: ControlKind,
    /// The least and the greatest value; 0 and 1 of everything but a slider.
    pub range: (i64, i64),
    /// The value at time 0.
    pub start: i64,
}

/// How a control is set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ControlKind {
    /// 1 as long as it is pressed.
    Button,
    /// 0 or 1.
    Switch,
    /// Any whole number of its range.
    Slider,
    /// A switch for something that is broken.
    Fault,
}

impl ControlKind {
    /// As a plant file writes it.
    pub fn word(self) -> &'static str {
        match self {
            ControlKind::Button => "button",
            ControlKind::Switch => "switch",
            ControlKind::Slider => "slider",
            ControlKind::Fault => "fault",
        }
    }
}

impl Control {
    /// Whether this is its name, in any letter case.
    pub fn is_named(&self, name: &str) -> bool {
        self.name.eq_ignore_ascii_case(name)
    }

    /// Whether it can have this value.
    pub fn takes(&self, value: i64) -> bool {
        (self.range.0..=self.range.1).contains(&value)
    }
}

/// A fault by name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fault {
    /// Its name.
    pub name: String,
    /// What is broken.
    pub words: Words,
    /// What that does.
    pub effect: Effect,
}

/// What a fault does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Effect {
    /// The pin of I0.n keeps its level.
    Stuck(u8),
    /// Analog input n keeps its voltage.
    StuckAnalog(u8),
    /// What is at Q0.n sees a change of the pin so many milliseconds later; a shorter one not at
    /// all.
    Slow(u8, u64),
}

/// How late a slow actuator is where nothing else is said, in milliseconds.
pub const SLOW_MS: u64 = 2000;
