//! The board's pins as a person names them: inputs are driven, outputs are told.

use anyhow::{Context, Result, bail, ensure};
use simavr::{Avr, Pin};

/// Digital pins that are inputs and outputs of the PLC, six each (docs/flashing.md).
const INPUTS: u8 = 2;
const OUTPUTS: u8 = 8;
const COUNT: u8 = 6;
/// The supply of the board.
const VOLTS_MAX: f64 = 5.0;

/// Does what a line says: `D2=1`, `I0.0=1`, `A0=2.5`, several of them separated by commas or
/// spaces.
pub fn drive(avr: &mut Avr, line: &str) -> Result<()> {
    let words = line.split([',', ' ']).filter(|word| !word.is_empty());
    let all: Vec<Wish> = words.map(wish).collect::<Result<_>>()?;
    for wish in all {
        match wish {
            Wish::Level(pin, level) => avr.drive(Pin::of_uno(pin), level),
            Wish::Volts(channel, volts) => avr.set_millivolts(channel, (volts * 1000.0) as u16),
        }
    }
    Ok(())
}

#[derive(Debug, PartialEq)]
enum Wish {
    /// A level at a digital pin.
    Level(u8, bool),
    /// Volts at an analog channel.
    Volts(u8, f64),
}

fn wish(word: &str) -> Result<Wish> {
    let help = || format!("{word}: write D2=1 or I0.0=1 (D2 to D7), A0=2.5 or Ain0=2.5 (volts)");
    let (name, value) = word.split_once('=').with_context(help)?;
    let name = name.to_ascii_uppercase();
    let analog = name.strip_prefix("AIN").or_else(|| name.strip_prefix('A'));
    if let Some(channel) = analog {
        let channel: u8 =
            channel.parse().ok().filter(|&channel| channel < COUNT).with_context(help)?;
        let volts: f64 = value.trim_end_matches(['v', 'V']).parse().ok().with_context(help)?;
        ensure!((0.0..=VOLTS_MAX).contains(&volts), "{word}: 0 to 5 volts");
        return Ok(Wish::Volts(channel, volts));
    }
    let input = name.strip_prefix("I0.").or_else(|| name.strip_prefix("E0."));
    let pin = match (input, name.strip_prefix('D')) {
        (Some(bit), _) => bit.parse::<u8>().ok().map(|bit| bit.saturating_add(INPUTS)),
        (None, Some(pin)) => pin.parse().ok(),
        (None, None) => None,
    };
    let pin = pin.filter(|pin| (INPUTS..INPUTS + COUNT).contains(pin)).with_context(help)?;
    match value {
        "0" => Ok(Wish::Level(pin, false)),
        "1" => Ok(Wish::Level(pin, true)),
        _ => bail!("{}", help()),
    }
}

/// The outputs as they were last told.
#[derive(Default)]
pub struct Lamps {
    shown: Option<u8>,
}

impl Lamps {
    /// What has changed: `Q0.0=1 Q0.3=0`. The bootloader's lamp is told, too.
    pub fn change(&mut self, avr: &Avr) -> Option<String> {
        let is_on = |bit: u8| {
            let pin = Pin::of_uno(OUTPUTS + bit);
            avr.is_output(pin) && avr.level(pin)
        };
        let now = (0..COUNT).fold(0, |levels, bit| levels | u8::from(is_on(bit)) << bit);
        let changed = now ^ self.shown.replace(now).unwrap_or(0);
        let texts = (0..COUNT)
            .filter(|bit| changed >> bit & 1 != 0)
            .map(|bit| format!("Q0.{bit}={}", now >> bit & 1));
        let text = texts.collect::<Vec<_>>().join(" ");
        (!text.is_empty()).then_some(text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pins_by_both_names() {
        assert_eq!(wish("D2=1").unwrap(), Wish::Level(2, true));
        assert_eq!(wish("i0.5=0").unwrap(), Wish::Level(7, false));
        assert_eq!(wish("A0=2.5V").unwrap(), Wish::Volts(0, 2.5));
        assert_eq!(wish("Ain5=0").unwrap(), Wish::Volts(5, 0.0));
        for wrong in ["D1=1", "D8=1", "I0.6=1", "A6=1", "A0=6", "A0=x", "D2", "D2=2", "Q0.0=1"] {
            assert!(wish(wrong).is_err(), "{wrong}");
        }
    }
}
