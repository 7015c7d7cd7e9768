//! The measuring station: a platform lifts workpieces to a height sensor, a piston sorts them onto
//! two ramps.
//!
//! It is after a relay board with inverted inputs: a low pin energises, and with all pins high
//! nothing moves. The model knows times and end positions, no forces: what the program should do
//! with a height is not known here.

use super::control::{Effect, SLOW_MS};
use super::options::{OptionError, Options};
use super::{Inputs, Outputs, Plant, PlantKind, Report, Signals, named};

/// The row for the table of plants.
pub const KIND: PlantKind = PlantKind {
    name: "station1",
    doc: "measuring station with lift, height sensor and two ramps",
    options: &[
        ("pieces", "small|normal|large|COUNTS,..."),
        ("noise", "0..50 counts"),
        ("seed", "N"),
        ("button", "auto|manual"),
        ("start", "bottom|middle|top"),
    ],
    faults: &[
        (
            "BottomStuck",
            Effect::Stuck(1),
            [
                "Lower end switch stuck",
                "Unterer Endschalter klemmt",
                "Final de carrera inferior bloqueado",
            ],
        ),
        (
            "TopStuck",
            Effect::Stuck(2),
            [
                "Upper end switch stuck",
                "Oberer Endschalter klemmt",
                "Final de carrera superior bloqueado",
            ],
        ),
        (
            "PistonStuck",
            Effect::Stuck(3),
            [
                "Switch of the piston stuck",
                "Endschalter des Kolbens klemmt",
                "Interruptor del pistón bloqueado",
            ],
        ),
        (
            "HeightStuck",
            Effect::StuckAnalog(0),
            ["Height sensor stuck", "Höhensensor klemmt", "Sensor de altura bloqueado"],
        ),
        (
            "SlowPiston",
            Effect::Slow(2, SLOW_MS),
            ["Slow valve of the piston", "Kolbenventil träge", "Válvula del pistón lenta"],
        ),
    ],
    build: |options| Ok(Box::new(Station1::new(options)?)),
};

/// Platform from bottom to top, or back.
const TRAVEL_MS: u64 = 3000;
/// Pushing piston, out or in.
const PUSH_MS: u64 = 700;
/// Height sensor, down or up.
const SENSOR_MS: u64 = 600;
/// Holding piston, out or in.
const HOLD_MS: u64 = 300;
/// A piece that nothing holds has slid off ramp 2 after this time.
const SLIDE_MS: u64 = 300;
/// The next piece is put on when the platform has been ready for it so long.
const FEED_MS: u64 = 1000;
/// The button is pressed so long.
const PRESS_MS: u64 = 300;
/// The button is pressed this long after a piece arrived on ramp 2, at least and at most.
const READY_MS: std::ops::RangeInclusive<u64> = 2500..=4500;

/// Reading of the height sensor while it is not on a piece, in counts.
const IDLE_COUNTS: u16 = 12;
/// Most pieces in a run.
const PIECES_MAX: usize = 10_000;
const DEFAULT_PIECES: [u16; 6] = [190, 207, 228, 207, 190, 207];

/// Something that moves between two end positions.
struct Actuator {
    position_ms: u64,
    travel_ms: u64,
}

impl Actuator {
    fn new(travel_ms: u64) -> Actuator {
        Actuator { position_ms: 0, travel_ms }
    }

    fn move_by(&mut self, dt_ms: u64, outward: bool) {
        self.position_ms = match outward {
            true => (self.position_ms + dt_ms).min(self.travel_ms),
            false => self.position_ms.saturating_sub(dt_ms),
        };
    }

    fn permille(&self) -> f64 {
        permille(self.position_ms, self.travel_ms)
    }

    fn is_in(&self) -> bool {
        self.position_ms == 0
    }

    fn is_out(&self) -> bool {
        self.position_ms == self.travel_ms
    }
}

#[derive(Clone, Copy)]
struct Piece {
    number: usize,
    height: u16,
}

struct OnRamp {
    piece: Piece,
    slid_ms: u64,
}

/// What the output pins ask for.
struct Relays {
    lower: bool,
    raise: bool,
    push: bool,
    sensor: bool,
    hold: bool,
}

impl Relays {
    fn of_pins(levels: u8) -> Relays {
        let energised = |bit: u8| levels >> bit & 1 == 0;
        Relays {
            lower: energised(0),
            raise: energised(1),
            push: energised(2),
            sensor: energised(3),
            hold: energised(4),
        }
    }
}

/// The model.
pub struct Station1 {
    last_ms: u64,
    platform: Actuator,
    piston: Actuator,
    sensor: Actuator,
    holder: Actuator,
    heights: Vec<u16>,
    fed: usize,
    on_platform: Option<Piece>,
    on_ramp2: Option<OnRamp>,
    ready_since_ms: Option<u64>,
    has_pushed: bool,
    was_conflict: bool,
    press_at_ms: Option<u64>,
    is_button_auto: bool,
    noise: u16,
    random: fastrand::Rng,
    good: i64,
    rejected: i64,
    collisions: i64,
    conflicts: i64,
    report: Report,
}

impl Station1 {
    /// The station with these options.
    pub fn new(options: &Options) -> Result<Station1, OptionError> {
        let heights =
            options.text("pieces").map_or_else(|| Ok(DEFAULT_PIECES.to_vec()), parse_pieces)?;
        let start = options.word("start", &["bottom", "middle", "top"], 0)?;
        let mut platform = Actuator::new(TRAVEL_MS);
        platform.position_ms = TRAVEL_MS * start as u64 / 2;
        Ok(Station1 {
            last_ms: 0,
            platform,
            piston: Actuator::new(PUSH_MS),
            sensor: Actuator::new(SENSOR_MS),
            holder: Actuator::new(HOLD_MS),
            heights,
            fed: 0,
            on_platform: None,
            on_ramp2: None,
            ready_since_ms: None,
            has_pushed: false,
            was_conflict: false,
            press_at_ms: None,
            is_button_auto: options.word("button", &["auto", "manual"], 0)? == 0,
            noise: options.number("noise", 0..=50, 2)? as u16,
            random: fastrand::Rng::with_seed(options.number("seed", 0..=u64::MAX, 1)?),
            good: 0,
            rejected: 0,
            collisions: 0,
            conflicts: 0,
            report: Report::default(),
        })
    }

    fn move_actuators(&mut self, now_ms: u64, dt_ms: u64, relays: &Relays) {
        if relays.lower != relays.raise {
            self.platform.move_by(dt_ms, relays.raise);
        }
        self.piston.move_by(dt_ms, relays.push);
        self.sensor.move_by(dt_ms, relays.sensor);
        self.holder.move_by(dt_ms, relays.hold);
        let is_moving =
            relays.lower && !self.platform.is_in() || relays.raise && !self.platform.is_out();
        let conflict = if relays.lower && relays.raise {
            Some("conflict: platform lowered and raised at once")
        } else if is_moving && !self.piston.is_in() && relays.push {
            Some("conflict: platform moves while the piston is pushed out")
        } else {
            None
        };
        if let (Some(text), false) = (conflict, self.was_conflict) {
            self.conflicts += 1;
            self.report.event(now_ms, text);
        }
        self.was_conflict = conflict.is_some();
    }

    fn feed(&mut self, now_ms: u64) {
        let is_ready = self.platform.is_in() && self.piston.is_in() && self.on_platform.is_none();
        if !is_ready {
            self.ready_since_ms = None;
            return;
        }
        let since_ms = *self.ready_since_ms.get_or_insert(now_ms);
        if now_ms - since_ms < FEED_MS {
            return;
        }
        if let Some(&height) = self.heights.get(self.fed) {
            self.fed += 1;
            self.ready_since_ms = None;
            self.on_platform = Some(Piece { number: self.fed, height });
            self.report.event(now_ms, format!("piece {} ({height}) put on the platform", self.fed));
        }
    }

    /// The piston throws the piece off when it is all the way out; once per stroke.
    fn push(&mut self, now_ms: u64) {
        if !self.piston.is_out() {
            self.has_pushed = false;
            return;
        }
        if std::mem::replace(&mut self.has_pushed, true) {
            return;
        }
        let Some(piece) = self.on_platform else { return };
        let Piece { number, height } = piece;
        if self.platform.is_out() {
            self.on_platform = None;
            self.push_onto_ramp2(now_ms, piece);
        } else if self.platform.is_in() {
            self.on_platform = None;
            self.rejected += 1;
            self.report
                .event(now_ms, format!("piece {number} ({height}) pushed onto ramp 1: rejected"));
        } else {
            self.conflicts += 1;
            self.report.event(
                now_ms,
                format!("conflict: piece {number} ({height}) pushed between the ramps"),
            );
        }
    }

    fn push_onto_ramp2(&mut self, now_ms: u64, piece: Piece) {
        let Piece { number, height } = piece;
        if let Some(occupant) = &self.on_ramp2 {
            self.collisions += 1;
            let other = occupant.piece.number;
            self.report.event(
                now_ms,
                format!(
                    "collision: piece {number} ({height}) pushed against piece {other} on ramp 2"
                ),
            );
            return;
        }
        self.good += 1;
        self.report.event(now_ms, format!("piece {number} ({height}) pushed onto ramp 2: good"));
        self.on_ramp2 = Some(OnRamp { piece, slid_ms: 0 });
        if self.is_button_auto {
            self.press_at_ms = Some(now_ms + self.random.u64(READY_MS));
        }
    }

    fn slide(&mut self, now_ms: u64, dt_ms: u64) {
        let Some(occupant) = &mut self.on_ramp2 else { return };
        if self.holder.is_out() {
            return;
        }
        occupant.slid_ms += dt_ms;
        if occupant.slid_ms >= SLIDE_MS {
            let number = occupant.piece.number;
            self.on_ramp2 = None;
            self.report.event(now_ms, format!("piece {number} slid on to the next station"));
        }
    }

    fn button(&mut self, now_ms: u64) -> bool {
        match self.press_at_ms {
            Some(at) if now_ms >= at + PRESS_MS => {
                self.press_at_ms = None;
                false
            }
            Some(at) => now_ms >= at,
            None => false,
        }
    }

    fn height_counts(&mut self) -> i32 {
        let counts = match self.on_platform {
            Some(piece) if self.sensor.is_out() => piece.height,
            _ => IDLE_COUNTS,
        };
        let noise = i32::from(self.noise);
        i32::from(counts) + self.random.i32(-noise..=noise)
    }
}

impl Plant for Station1 {
    fn signals(&self) -> Signals {
        Signals { digital: if self.is_button_auto { 0b11_1111 } else { 0b01_1111 }, analog: 0b1 }
    }

    fn step(&mut self, now_ms: u64, outputs: Outputs, inputs: &mut Inputs) {
        let dt_ms = now_ms - self.last_ms;
        self.last_ms = now_ms;
        self.move_actuators(now_ms, dt_ms, &Relays::of_pins(outputs.levels));
        self.slide(now_ms, dt_ms);
        self.push(now_ms);
        self.feed(now_ms);
        inputs.set_digital(0, self.on_platform.is_some() && self.platform.is_in());
        inputs.set_digital(1, self.platform.is_in());
        inputs.set_digital(2, self.platform.is_out());
        inputs.set_digital(3, self.piston.is_out());
        inputs.set_digital(4, self.sensor.is_out());
        if self.is_button_auto {
            let is_pressed = self.button(now_ms);
            inputs.set_digital(5, is_pressed);
        }
        inputs.set_analog(0, self.height_counts());
    }

    fn report(&self) -> Report {
        let pieces = self.heights.len() as i64;
        let left = pieces - self.good - self.rejected - self.collisions;
        let summary = vec![
            ("pieces", pieces),
            ("good", self.good),
            ("rejected", self.rejected),
            ("collisions", self.collisions),
            ("conflicts", self.conflicts),
            ("left", left),
        ];
        self.report.with_summary(summary)
    }

    fn view(&self) -> Vec<(String, f64)> {
        let height = |piece: Option<Piece>| f64::from(piece.map_or(0, |piece| piece.height));
        named([
            ("lift", self.platform.permille()),
            ("piston", self.piston.permille()),
            ("sensor", self.sensor.permille()),
            ("holder", self.holder.permille()),
            ("piece", height(self.on_platform)),
            ("ramp2", height(self.on_ramp2.as_ref().map(|occupant| occupant.piece))),
            (
                "slid",
                self.on_ramp2.as_ref().map_or(0.0, |occupant| permille(occupant.slid_ms, SLIDE_MS)),
            ),
            ("fed", self.fed as f64),
            ("good", self.good as f64),
            ("rejected", self.rejected as f64),
            ("collisions", self.collisions as f64),
            ("conflicts", self.conflicts as f64),
        ])
    }
}

/// How far something is, from 0 to 1000.
fn permille(done_ms: u64, whole_ms: u64) -> f64 {
    1000.0 * done_ms.min(whole_ms) as f64 / whole_ms as f64
}

fn parse_pieces(text: &str) -> Result<Vec<u16>, OptionError> {
    let pieces: Vec<u16> = text.split(',').map(parse_piece).collect::<Result<_, _>>()?;
    if pieces.len() > PIECES_MAX {
        return Err(OptionError::new("pieces", format!("at most {PIECES_MAX} pieces")));
    }
    Ok(pieces)
}

fn parse_piece(text: &str) -> Result<u16, OptionError> {
    match text {
        "small" => Ok(190),
        "normal" => Ok(207),
        "large" => Ok(228),
        _ => match text.parse() {
            Ok(counts @ 0..=1023) => Ok(counts),
            _ => Err(OptionError::new(
                "pieces",
                format!(
                    "{text:?} is no piece: write small, normal, large or a height in counts, 0 to \
                        1023"
                ),
            )),
        },
    }
}

#[cfg(test)]
#[path = "station1_tests.rs"]
mod tests;
