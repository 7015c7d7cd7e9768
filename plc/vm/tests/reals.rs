//! How far SQRT SIN COS TAN LN EXP are from the true value, over random operands. Single values are
//! tested in the sources.

use plc_vm::function::{cos, exp, ln, sin, sqrt, tan};

/// A function, the true one, the operands and the error allowed in ulp.
struct Case {
    name: &'static str,
    function: fn(f32) -> Option<f32>,
    truth: fn(f64) -> f64,
    operand: fn(&mut Random) -> f32,
    ulps: f64,
}

const CASES: [Case; 8] = [
    Case { name: "SQRT", function: sqrt, truth: f64::sqrt, operand: Random::positive, ulps: 0.5 },
    Case { name: "SIN", function: sin, truth: f64::sin, operand: Random::angle, ulps: 0.6 },
    Case {
        name: "SIN, next to a zero",
        function: sin,
        truth: f64::sin,
        operand: Random::next_to_quarter,
        ulps: 0.6,
    },
    Case { name: "COS", function: cos, truth: f64::cos, operand: Random::angle, ulps: 0.6 },
    Case { name: "TAN", function: tan, truth: f64::tan, operand: Random::angle, ulps: 0.7 },
    Case { name: "LN", function: ln, truth: f64::ln, operand: Random::positive, ulps: 0.6 },
    Case {
        name: "LN, next to 1",
        function: ln,
        truth: f64::ln,
        operand: Random::next_to_1,
        ulps: 0.6,
    },
    Case { name: "EXP", function: exp, truth: f64::exp, operand: Random::exponent, ulps: 0.6 },
];

/// xorshift64*, with a fixed seed: the same operands in every run.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u32 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 32) as u32
    }

    /// Any positive number, all exponents alike, denormals too.
    fn positive(&mut self) -> f32 {
        f32::from_bits(self.bits() % 0x7F80_0000)
    }

    fn between(&mut self, low: f32, high: f32) -> f32 {
        low + self.bits() as f32 / u32::MAX as f32 * (high - low)
    }

    /// Half of them up to 10,000, half of any size below.
    fn angle(&mut self) -> f32 {
        let evenly = self.between(-10_000.0, 10_000.0);
        if self.bits() & 1 == 0 { evenly } else { self.positive() % 10_000.0 }
    }

    fn next_to_quarter(&mut self) -> f32 {
        (f64::from(self.bits() % 6_000) * std::f64::consts::FRAC_PI_2) as f32
    }

    fn next_to_1(&mut self) -> f32 {
        f32::from_bits(0x3F80_0000 - 0x1000 + self.bits() % 0x2000)
    }

    fn exponent(&mut self) -> f32 {
        let evenly = self.between(-103.0, 88.7);
        if self.bits() & 1 == 0 { evenly } else { -(self.positive() % 1.0) }
    }
}

/// The distance from the true value in units of the last place that it has in single precision.
fn error_in_ulps(result: f32, truth: f64) -> f64 {
    let above = (truth.abs() as f32).max(f32::MIN_POSITIVE);
    let exponent = f64::from(above).log2().floor() as i32;
    (f64::from(result) - truth).abs() / 2_f64.powi(exponent - 23)
}

fn check(operands: u32) {
    for Case { name, function, truth, operand, ulps } in CASES {
        let mut random = Random(0x9E37_79B9_7F4A_7C15);
        let mut worst = (0.0, 0.0, 0.0);
        for _ in 0..operands {
            let x = operand(&mut random);
            let result = function(x).unwrap_or_else(|| panic!("{name} {x:?}: no result"));
            let error = error_in_ulps(result, truth(f64::from(x)));
            if error > worst.0 {
                worst = (error, x, result);
            }
        }
        println!("{name}: {:.4} ulp at {:?}", worst.0, worst.1);
        assert!(worst.0 <= ulps, "{name} {:?} = {:?}: {} ulp", worst.1, worst.2, worst.0);
    }
}

#[test]
fn functions_are_accurate_over_a_million_operands() {
    check(1_000_000);
}

#[test]
fn far_out_the_angle_is_still_known_to_2_to_the_minus_20() {
    let mut random = Random(1);
    for _ in 0..20_000 {
        let x = random.between(1e4, 1e9);
        let error = sin(x).map(|result| (f64::from(result) - f64::from(x).sin()).abs());
        assert!(error.is_some_and(|error| error < 1e-6), "{x}: {error:?}");
    }
}
