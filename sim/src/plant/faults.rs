//! Faults that every plant can have, whatever it models: a sensor whose signal stays as it is, an
//! actuator that follows its output late. They are between the plant and its wires.

use super::control::{Control, ControlKind, Effect, Fault};
use super::{Inputs, Outputs, Plant, Report, Signals};

/// A plant with faults that can be switched.
pub(super) struct WithFaults {
    plant: Box<dyn Plant>,
    faults: Vec<Fault>,
    is_on: Vec<bool>,
    /// What the plant drives, faults left out.
    sound: Inputs,
    /// What the plant was shown of the output pins; nothing before the first call.
    shown: Option<u8>,
    /// Since when a pin differs from that, in milliseconds.
    since_ms: [Option<u64>; 8],
}

impl WithFaults {
    /// A plant with all of these switched off.
    pub(super) fn new(plant: Box<dyn Plant>, faults: Vec<Fault>) -> WithFaults {
        let is_on = vec![false; faults.len()];
        WithFaults {
            plant,
            faults,
            is_on,
            sound: Inputs::default(),
            shown: None,
            since_ms: [None; 8],
        }
    }

    fn effects(&self) -> impl Iterator<Item = Effect> + '_ {
        let all = self.faults.iter().zip(&self.is_on);
        all.filter(|(_, is_on)| **is_on).map(|(fault, _)| fault.effect)
    }

    /// What the plant sees of the output pins.
    fn seen(&mut self, now_ms: u64, outputs: u8) -> u8 {
        let before = self.shown.unwrap_or(outputs);
        let mut seen = outputs;
        let mut since_ms = [None; 8];
        for effect in self.effects() {
            let Effect::Slow(output, by_ms) = effect else { continue };
            let mask = 1 << (output & 7);
            if (outputs ^ before) & mask == 0 {
                continue;
            }
            let since = self.since_ms[usize::from(output & 7)].unwrap_or(now_ms);
            if now_ms - since < by_ms {
                seen ^= mask;
                since_ms[usize::from(output & 7)] = Some(since);
            }
        }
        self.since_ms = since_ms;
        self.shown = Some(seen);
        seen
    }
}

impl Plant for WithFaults {
    fn signals(&self) -> Signals {
        self.plant.signals()
    }

    fn step(&mut self, now_ms: u64, outputs: Outputs, inputs: &mut Inputs) {
        let levels = self.seen(now_ms, outputs.levels);
        self.plant.step(now_ms, Outputs { levels, ..outputs }, &mut self.sound);
        let before = std::mem::replace(inputs, self.sound);
        for effect in self.effects() {
            match effect {
                Effect::Stuck(input) => inputs.set_digital(input, before.digital(input)),
                Effect::StuckAnalog(channel) => {
                    inputs.set_analog(channel, before.analog(channel).into());
                }
                Effect::Slow(..) => {}
            }
        }
    }

    fn report(&self) -> Report {
        self.plant.report()
    }

    fn view(&self) -> Vec<(String, f64)> {
        self.plant.view()
    }

    fn controls(&self) -> Vec<Control> {
        let faults = self.faults.iter().map(|fault| Control {
            name: fault.name.clone(),
            words: fault.words.clone(),
            kind: ControlKind::Fault,
            range: (0, 1),
            start: 0,
        });
        self.plant.controls().into_iter().chain(faults).collect()
    }

    fn set(&mut self, control: &str, value: i64) -> bool {
        let place = self.faults.iter().position(|fault| fault.name.eq_ignore_ascii_case(control));
        match place {
            Some(place) => {
                self.is_on[place] = value != 0;
                true
            }
            None => self.plant.set(control, value),
        }
    }

    fn places(&self) -> Vec<Vec<f64>> {
        self.plant.places()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::Words;

    /// I0.0 and Ain0 follow Q0.0.
    struct Wire;

    impl Plant for Wire {
        fn signals(&self) -> Signals {
            Signals { digital: 1, analog: 1 }
        }

        fn step(&mut self, _: u64, outputs: Outputs, inputs: &mut Inputs) {
            inputs.set_digital(0, outputs.is_high(0));
            inputs.set_analog(0, i32::from(outputs.is_high(0)) * 500);
        }

        fn report(&self) -> Report {
            Report::default()
        }

        fn view(&self) -> Vec<(String, f64)> {
            Vec::new()
        }
    }

    fn wire(effect: Effect) -> WithFaults {
        let fault = Fault { name: "Broken".to_string(), words: Words::default(), effect };
        WithFaults::new(Box::new(Wire), vec![fault])
    }

    #[test]
    fn a_stuck_sensor_keeps_its_signal_until_it_is_mended() {
        let mut inputs = Inputs::default();
        for (effect, digital, analog) in
            [(Effect::Stuck(0), true, 0), (Effect::StuckAnalog(0), false, 500)]
        {
            let mut plant = wire(effect);
            plant.step(0, 1_u8.into(), &mut inputs);
            assert_eq!((inputs.digital(0), inputs.analog(0)), (true, 500));
            assert!(plant.set("broken", 1));
            plant.step(1, 0_u8.into(), &mut inputs);
            assert_eq!((inputs.digital(0), inputs.analog(0)), (digital, analog), "{effect:?}");
            plant.set("broken", 0);
            plant.step(2, 0_u8.into(), &mut inputs);
            assert_eq!((inputs.digital(0), inputs.analog(0)), (false, 0));
        }
    }

    #[test]
    fn a_slow_actuator_follows_late_and_misses_what_is_short() {
        let mut plant = wire(Effect::Slow(0, 100));
        plant.set("Broken", 1);
        let mut inputs = Inputs::default();
        let mut rises = Vec::new();
        for now_ms in 0..400 {
            // A pulse of 50 ms, and a long one from 200 ms on.
            let outputs = u8::from((10..60).contains(&now_ms) || now_ms >= 200);
            let before = inputs.digital(0);
            plant.step(now_ms, outputs.into(), &mut inputs);
            if inputs.digital(0) && !before {
                rises.push(now_ms);
            }
        }
        assert_eq!(rises, [300]);
    }

    #[test]
    fn other_names_are_the_plants() {
        assert!(!wire(Effect::Stuck(0)).set("Other", 1));
    }
}
