//! A tank: a pump fills it, consumers draw from it, its level comes as an analog value. No
//! pressure, no pipes.
//!
//! Q0.0 runs the pump, Q0.1 opens the outlet where `outlet=valve`; a high pin is on. The level is
//! on analog input 0, 0 to 100 % as AIW0 = 0 to 32000, and I0.0 is the overflow switch.

use super::control::{Effect, SLOW_MS};
use super::options::{OptionError, Options};
use super::{Inputs, Outputs, Plant, PlantKind, Report, Signals, named};

/// The row for the table of plants.
pub const KIND: PlantKind = PlantKind {
    name: "tank",
    doc: "tank with pump, outlet and level sensor",
    options: &[
        ("level", "0..100 %, at the start"),
        ("inflow", "0..100 % per second, while the pump runs"),
        ("outflow", "0..100 % per second"),
        ("outlet", "constant|valve"),
        ("variation", "0..100 % of the outflow"),
        ("overflow", "1..100 %, where I0.0 switches"),
        ("noise", "0..50 counts"),
        ("seed", "N"),
    ],
    faults: &[
        (
            "LevelStuck",
            Effect::StuckAnalog(0),
            ["Level sensor stuck", "Füllstandsensor klemmt", "Sensor de nivel bloqueado"],
        ),
        (
            "OverflowStuck",
            Effect::Stuck(0),
            ["Overflow switch stuck", "Überlaufschalter klemmt", "Interruptor de rebose bloqueado"],
        ),
        (
            "SlowPump",
            Effect::Slow(0, SLOW_MS),
            [
                "Pump starts and stops late",
                "Pumpe läuft verspätet an und aus",
                "La bomba arranca y para tarde",
            ],
        ),
        (
            "SlowValve",
            Effect::Slow(1, SLOW_MS),
            ["Slow outlet valve", "Auslassventil träge", "Válvula de salida lenta"],
        ),
    ],
    build: |options| Ok(Box::new(Tank::new(options)?)),
};

/// Level units in one percent. A flow of 0.001 % per second is one unit per millisecond.
const PERCENT: i64 = 1_000_000;
const FULL: i64 = 100 * PERCENT;
/// The consumers change their mind this often.
const DEMAND_MS: u64 = 5000;
const COUNTS_MAX: i64 = 1023;

/// The model.
pub struct Tank {
    last_ms: u64,
    level: i64,
    inflow: i64,
    outflow: i64,
    has_valve: bool,
    is_outlet_open: bool,
    variation_percent: i64,
    demand_percent: i64,
    demand_until_ms: u64,
    overflow: i64,
    noise: i32,
    random: fastrand::Rng,
    is_pumping: bool,
    is_over: bool,
    is_dry: bool,
    settled: Option<(i64, i64)>,
    pump_starts: i64,
    overflows: i64,
    dry: i64,
    report: Report,
}

impl Tank {
    /// The tank with these options.
    pub fn new(options: &Options) -> Result<Tank, OptionError> {
        Ok(Tank {
            last_ms: 0,
            level: options.thousandths("level", 0..=100_000, 30_000)? as i64 * (PERCENT / 1000),
            inflow: options.thousandths("inflow", 0..=100_000, 5_000)? as i64,
            outflow: options.thousandths("outflow", 0..=100_000, 2_000)? as i64,
            is_outlet_open: false,
            has_valve: options.word("outlet", &["constant", "valve"], 0)? == 1,
            variation_percent: options.number("variation", 0..=100, 20)? as i64,
            demand_percent: 100,
            demand_until_ms: 0,
            overflow: options.thousandths("overflow", 1_000..=100_000, 95_000)? as i64
                * (PERCENT / 1000),
            noise: options.number("noise", 0..=50, 0)? as i32,
            random: fastrand::Rng::with_seed(options.number("seed", 0..=u64::MAX, 1)?),
            is_pumping: false,
            is_over: false,
            is_dry: false,
            settled: None,
            pump_starts: 0,
            overflows: 0,
            dry: 0,
            report: Report::default(),
        })
    }

    fn flow(&mut self, dt_ms: u64, is_pumping: bool) {
        let inflow = if is_pumping { self.inflow } else { 0 };
        let outflow =
            if self.is_outlet_open { self.outflow * self.demand_percent / 100 } else { 0 };
        self.level = (self.level + (inflow - outflow) * dt_ms as i64).clamp(0, FULL);
    }

    fn change_demand(&mut self, now_ms: u64) {
        if now_ms >= self.demand_until_ms {
            self.demand_percent =
                100 + self.random.i64(-self.variation_percent..=self.variation_percent);
            self.demand_until_ms = now_ms + DEMAND_MS;
        }
    }

    fn watch_pump(&mut self, now_ms: u64, is_pumping: bool) {
        if is_pumping && !self.is_pumping {
            self.pump_starts += 1;
            self.report.event(now_ms, format!("pump on at {}", self.level_text()));
        } else if !is_pumping && self.is_pumping {
            self.report.event(now_ms, format!("pump off at {}", self.level_text()));
            // From the first stop of the pump on the control has the tank in hand.
            self.settled.get_or_insert((self.level, self.level));
        }
        self.is_pumping = is_pumping;
    }

    fn watch_level(&mut self, now_ms: u64) {
        let is_over = self.level >= self.overflow;
        if is_over && !self.is_over {
            self.overflows += 1;
            self.report.event(now_ms, format!("overflow switch on at {}", self.level_text()));
        }
        self.is_over = is_over;
        let is_dry = self.level == 0;
        if is_dry && !self.is_dry {
            self.dry += 1;
            self.report.event(now_ms, "tank empty");
        }
        self.is_dry = is_dry;
        if let Some((lowest, highest)) = &mut self.settled {
            *lowest = self.level.min(*lowest);
            *highest = self.level.max(*highest);
        }
    }

    fn level_text(&self) -> String {
        let tenths = self.level / (PERCENT / 10);
        format!("{}.{} %", tenths / 10, tenths % 10)
    }

    fn counts(&mut self) -> i32 {
        let counts = (self.level * COUNTS_MAX + FULL / 2) / FULL;
        counts as i32 + self.random.i32(-self.noise..=self.noise)
    }
}

impl Plant for Tank {
    fn signals(&self) -> Signals {
        Signals { digital: 0b1, analog: 0b1 }
    }

    fn step(&mut self, now_ms: u64, outputs: Outputs, inputs: &mut Inputs) {
        let dt_ms = now_ms - self.last_ms;
        self.last_ms = now_ms;
        let is_pumping = outputs.is_high(0);
        self.is_outlet_open = !self.has_valve || outputs.is_high(1);
        self.flow(dt_ms, is_pumping);
        self.change_demand(now_ms);
        self.watch_pump(now_ms, is_pumping);
        self.watch_level(now_ms);
        inputs.set_digital(0, self.is_over);
        let counts = self.counts();
        inputs.set_analog(0, counts);
    }

    fn report(&self) -> Report {
        let permille = |level: i64| level / (PERCENT / 10);
        let (lowest, highest) = self.settled.unwrap_or((self.level, self.level));
        let summary = vec![
            ("level_min_permille", permille(lowest)),
            ("level_max_permille", permille(highest)),
            ("pump_starts", self.pump_starts),
            ("overflows", self.overflows),
            ("empty", self.dry),
        ];
        self.report.with_summary(summary)
    }

    fn view(&self) -> Vec<(String, f64)> {
        named([
            ("level", (self.level / (PERCENT / 10)) as f64),
            ("overflow", (self.overflow / (PERCENT / 10)) as f64),
            ("pump", f64::from(u8::from(self.is_pumping))),
            ("outlet", f64::from(u8::from(self.is_outlet_open))),
        ])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::parse_spec;

    fn run(options: &str, steps: &[(u64, u8)]) -> (Box<dyn Plant>, Inputs) {
        let mut plant =
            parse_spec(&format!("tank variation=0 {options}")).unwrap().build().unwrap();
        let mut inputs = Inputs::default();
        plant.step(0, Outputs::from(0), &mut inputs);
        for &(now_ms, outputs) in steps {
            plant.step(now_ms, Outputs::from(outputs), &mut inputs);
        }
        (plant, inputs)
    }

    #[test]
    fn level_is_the_sum_of_the_flows() {
        // 20 % + 10 s * (5 - 2) %/s = 50 %, whatever the step.
        let fine: Vec<_> = (1..=10_000).map(|ms| (ms, 0b01)).collect();
        assert_eq!(run("level=20 inflow=5 outflow=2", &fine).1.analog(0), 512);
        assert_eq!(run("level=20 inflow=5 outflow=2", &[(10_000, 0b01)]).1.analog(0), 512);
        assert_eq!(run("level=20 inflow=5 outflow=2", &[(5_000, 0)]).1.analog(0), 102);
    }

    #[test]
    fn outlet_valve_closes() {
        assert_eq!(run("level=50 outflow=2 outlet=valve", &[(10_000, 0)]).1.analog(0), 512);
        assert_eq!(run("level=50 outflow=2 outlet=valve", &[(10_000, 0b10)]).1.analog(0), 307);
    }

    #[test]
    fn overflow_and_empty_are_told_once_each() {
        let (plant, inputs) =
            run("level=90 inflow=10 outflow=0 overflow=95", &[(400, 1), (500, 1), (5_000, 1)]);
        assert!(inputs.digital(0));
        assert_eq!(plant.report().count("overflows"), Some(1));
        assert_eq!(plant.report().events.last().map(|event| event.time_ms), Some(500));
        assert_eq!(inputs.analog(0), 1023);
        let (plant, inputs) = run("level=1 outflow=1", &[(1_000, 0), (2_000, 0)]);
        assert_eq!((plant.report().count("empty"), inputs.analog(0)), (Some(1), 0));
    }

    #[test]
    fn extremes_count_from_the_first_pump_stop() {
        let steps = [(1_000, 1), (11_000, 1), (12_000, 0), (17_000, 0), (18_000, 1)];
        let (plant, _) = run("level=10 inflow=6 outflow=2", &steps);
        let report = plant.report();
        // 10 % + 11 s * 4 %/s, then falling 2 %/s for 6 s, then one second up.
        assert_eq!(report.count("level_max_permille"), Some(520));
        assert_eq!(report.count("level_min_permille"), Some(420));
        assert_eq!(report.count("pump_starts"), Some(2));
    }

    #[test]
    fn demand_varies_within_its_limits() {
        let mut plant =
            parse_spec("tank level=100 outflow=1 variation=50 seed=3").unwrap().build().unwrap();
        let mut inputs = Inputs::default();
        let mut drops = Vec::new();
        let mut last = 0;
        for second in 0..=8u64 {
            plant.step(second * 5000, Outputs::from(0), &mut inputs);
            let counts = i32::from(inputs.analog(0));
            if second > 0 {
                drops.push(last - counts);
            }
            last = counts;
        }
        // 5 s at 1 %/s +- 50 % are 2.5 to 7.5 %, 25 to 77 counts.
        assert!(drops.iter().all(|drop| (25..=77).contains(drop)), "{drops:?}");
        assert!(drops.iter().any(|drop| *drop != drops[0]), "{drops:?}");
    }
}
