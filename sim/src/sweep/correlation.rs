//! How much of a sine is in values, and what else: sums that grow value by value.

/// A sine's size and phase as a complex number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Phasor {
    real: f64,
    imaginary: f64,
}

impl Phasor {
    pub(super) fn size(self) -> f64 {
        self.real.hypot(self.imaginary)
    }

    pub(super) fn degrees(self) -> f64 {
        self.imaginary.atan2(self.real).to_degrees()
    }

    pub(super) fn minus(self, other: Phasor) -> Phasor {
        Phasor { real: self.real - other.real, imaginary: self.imaginary - other.imaginary }
    }

    /// The quotient; `other` is not 0.
    pub(super) fn over(self, other: Phasor) -> Phasor {
        let square = other.real * other.real + other.imaginary * other.imaginary;
        Phasor {
            real: (self.real * other.real + self.imaginary * other.imaginary) / square,
            imaginary: (self.imaginary * other.real - self.real * other.imaginary) / square,
        }
    }
}

/// Sums over a window of whole periods. The weights rise from 0 and fall to 0 again (Hann), so that
/// what only drifts or dies away hardly counts.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Correlation {
    /// The first value is taken from all: the sums stay small beside a large offset.
    first: Option<f64>,
    weights: f64,
    in_phase: f64,
    ahead: f64,
    sum: f64,
    squares: f64,
}

impl Correlation {
    /// Adds a value, with the sine there and its cosine.
    pub(super) fn add(&mut self, weight: f64, (sine, cosine): (f64, f64), value: f64) {
        let value = value - *self.first.get_or_insert(value);
        self.weights += weight;
        self.in_phase += weight * value * sine;
        self.ahead += weight * value * cosine;
        self.sum += weight * value;
        self.squares += weight * value * value;
    }

    /// The sine in the values.
    pub(super) fn sine(&self) -> Phasor {
        let scale = 2.0 / self.weights;
        Phasor { real: self.in_phase * scale, imaginary: self.ahead * scale }
    }

    /// The effective value of all that is neither sine nor offset, for that of the sine; 0 without
    /// a sine.
    pub(super) fn distortion(&self) -> f64 {
        let mean = self.sum / self.weights;
        let varying = self.squares / self.weights - mean * mean;
        let sine = self.sine().size().powi(2) / 2.0;
        if sine == 0.0 { 0.0 } else { ((varying - sine).max(0.0) / sine).sqrt() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn of(value: impl Fn(f64) -> f64) -> Correlation {
        let mut correlation = Correlation::default();
        for scan in 0..200 {
            let (part, angle) = (f64::from(scan) / 200.0, f64::from(5 * scan) / 200.0 * TAU);
            correlation.add(1.0 - (TAU * part).cos(), angle.sin_cos(), value(angle));
        }
        correlation
    }

    #[test]
    fn a_sine_is_found_beside_others() {
        let found = of(|angle| 100.0 + 3.0 * (angle + 0.5).sin() + 0.6 * (3.0 * angle).cos());
        let sine = found.sine();
        assert!((sine.size() - 3.0).abs() < 1e-9, "{sine:?}");
        assert!((sine.degrees() - 0.5_f64.to_degrees()).abs() < 1e-9, "{sine:?}");
        assert!((found.distortion() - 0.2).abs() < 1e-9, "{}", found.distortion());
    }

    #[test]
    fn without_a_sine_there_is_no_distortion() {
        assert_eq!(of(|_| 7.0).distortion(), 0.0);
    }

    #[test]
    fn quotients_turn_back() {
        let [a, b] = [Phasor { real: 3.0, imaginary: 4.0 }, Phasor { real: 0.0, imaginary: 2.0 }];
        assert_eq!(a.over(b), Phasor { real: 2.0, imaginary: -1.5 });
        assert_eq!(a.minus(b).size(), 13.0_f64.sqrt());
    }
}
