//! A recording as a picture: bits as waves, numbers as curves between their least and greatest
//! value, over milliseconds from the trigger. The simulator's diagrams are drawn elsewhere: their
//! time is whole milliseconds of a virtual clock.

use std::io::{self, Write};

use svg::Document;
use svg::node::element::{Group, Line, Path, Rectangle, Text};

use super::Recording;
use crate::value::{Base, Form};

const WIDTH: f64 = 960.0;
const MARGIN: f64 = 16.0;
/// Where the waves begin, right of the names.
const LEFT: f64 = 190.0;
const RIGHT: f64 = WIDTH - MARGIN;
const TOP: f64 = 20.0;
const BIT_HEIGHT: f64 = 32.0;
const NUMBER_HEIGHT: f64 = 72.0;
/// Free above and below a wave.
const GAP: f64 = 8.0;
const INK: &str = "#1c2733";
const FAINT: &str = "#5d6b7a";
const GRID: &str = "#d9dfe6";
const BIT: &str = "#1f6f4a";
const NUMBER: &str = "#1d5fa8";
const TRIGGER: &str = "#c0392b";

impl Recording {
    /// Writes a picture (SVG).
    pub fn write_svg(&self, out: &mut dyn Write) -> io::Result<()> {
        let heights: f64 = self.operands.iter().map(|operand| height(operand.form)).sum();
        let bottom = TOP + heights;
        let mut document = Document::new()
            .set("viewBox", format!("0 0 {WIDTH} {}", bottom + 40.0))
            .set("font-family", "Helvetica, Arial, sans-serif")
            .set("font-size", 12)
            .add(Rectangle::new().set("width", "100%").set("height", "100%").set("fill", "#ffffff"))
            .add(self.axis(bottom));
        let mut top = TOP;
        for index in 0..self.operands.len() {
            document = document.add(self.row(index, top));
            top += height(self.operands[index].form);
        }
        if let Some(sample) = self.trigger {
            let x = self.x(sample as f64);
            document = document
                .add(line(x, TOP, x, bottom, TRIGGER).set("stroke-dasharray", "4 3"))
                .add(text("trigger", x, TOP - 6.0, "middle", TRIGGER));
        }
        writeln!(out, "{document}")
    }

    /// A sample lasts until the next one.
    fn x(&self, sample: f64) -> f64 {
        LEFT + (RIGHT - LEFT) * sample / self.samples.len().max(1) as f64
    }

    /// Times from the trigger, or from the first sample.
    fn axis(&self, bottom: f64) -> Group {
        let sample_ms = f64::from(self.every) * self.scan_us / 1000.0;
        let origin = self.trigger.unwrap_or(0) as f64;
        let step = step(sample_ms * self.samples.len() as f64 / 8.0);
        let mut group = Group::new().add(text("ms", RIGHT, bottom + 32.0, "end", FAINT));
        if sample_ms <= 0.0 {
            return group;
        }
        let first = (-origin * sample_ms / step).ceil() as i64;
        for number in first.. {
            let time = number as f64 * step;
            let x = self.x(origin + time / sample_ms);
            if x > RIGHT + 0.5 {
                break;
            }
            let label = text(
                &format!("{}", (time * 1000.0).round() / 1000.0),
                x,
                bottom + 16.0,
                "middle",
                FAINT,
            );
            group = group.add(line(x, TOP, x, bottom, GRID)).add(label);
        }
        group
    }

    fn row(&self, index: usize, top: f64) -> Group {
        let operand = &self.operands[index];
        let bottom = top + height(operand.form);
        let values: Vec<u32> =
            self.samples.iter().filter_map(|sample| sample.get(index).copied()).collect();
        let numbers: Vec<f64> = values.iter().map(|&value| number(operand.form, value)).collect();
        let (mut least, mut greatest) = match operand.form {
            Form::Bit => (0.0, 1.0),
            _ => numbers
                .iter()
                .fold((f64::MAX, f64::MIN), |(least, most), &n| (least.min(n), most.max(n))),
        };
        let name = text(&operand.name, MARGIN, (top + bottom) / 2.0 + 4.0, "start", INK)
            .set("font-weight", "bold");
        let mut group = Group::new().add(line(MARGIN, bottom, RIGHT, bottom, GRID)).add(name);
        if operand.form != Form::Bit && least <= greatest {
            let shown = |wanted: f64| {
                let value = numbers.iter().zip(&values).find(|(number, _)| **number == wanted);
                value.map_or(String::new(), |(_, &value)| operand.text(value, Base::Decimal))
            };
            group = group.add(text(&shown(greatest), LEFT - 6.0, top + GAP + 4.0, "end", FAINT));
            if least < greatest {
                group =
                    group.add(text(&shown(least), LEFT - 6.0, bottom - GAP + 4.0, "end", FAINT));
            }
        }
        if least >= greatest {
            // What does not change is a line in the middle.
            (least, greatest) = (least - 1.0, greatest + 1.0);
        }
        let y = |number: f64| {
            bottom - GAP - (number - least) / (greatest - least) * (bottom - top - 2.0 * GAP)
        };
        let mut path = String::new();
        for (sample, &number) in numbers.iter().enumerate() {
            let (begin, end) = (self.x(sample as f64), self.x(sample as f64 + 1.0));
            let move_to = if path.is_empty() { 'M' } else { 'L' };
            path += &format!("{move_to}{begin:.2} {0:.2}H{end:.2}", y(number));
        }
        let ink = if operand.form == Form::Bit { BIT } else { NUMBER };
        let wave = Path::new()
            .set("d", path)
            .set("fill", "none")
            .set("stroke", ink)
            .set("stroke-width", 1.6);
        group.add(wave)
    }
}

fn height(form: Form) -> f64 {
    if form == Form::Bit { BIT_HEIGHT } else { NUMBER_HEIGHT }
}

/// What cannot be drawn is 0.
fn number(form: Form, value: u32) -> f64 {
    match form {
        Form::Real => Some(f64::from(f32::from_bits(value)))
            .filter(|number| number.is_finite())
            .unwrap_or(0.0),
        form => f64::from(form.number(value)),
    }
}

/// The next of 1, 2 and 5 times a power of ten.
fn step(least: f64) -> f64 {
    let power = 10f64.powf(least.max(1e-3).log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|factor| factor * power);
    steps.into_iter().find(|&step| step >= least).unwrap_or(10.0 * power)
}

fn line(x1: f64, y1: f64, x2: f64, y2: f64, colour: &str) -> Line {
    Line::new().set("x1", x1).set("y1", y1).set("x2", x2).set("y2", y2).set("stroke", colour)
}

fn text(content: &str, x: f64, y: f64, anchor: &str, colour: &str) -> Text {
    Text::new(content).set("x", x).set("y", y).set("text-anchor", anchor).set("fill", colour)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::operand::Operand;

    #[test]
    fn a_wave_a_curve_and_the_trigger() {
        let recording = Recording {
            operands: ["I0.0", "MW3"].map(|name| Operand::parse(name, &[]).unwrap()).to_vec(),
            samples: vec![vec![0, 5], vec![0, 0xFFFF], vec![1, 7], vec![1, 7]],
            first_scan: 0,
            every: 1,
            trigger: Some(2),
            scan_us: 1000.0,
        };
        let mut out = Vec::new();
        recording.write_svg(&mut out).unwrap();
        let picture = String::from_utf8(out).unwrap();
        let paths: Vec<&str> = picture
            .split("<path d=\"")
            .skip(1)
            .map(|rest| rest.split('"').next().unwrap())
            .collect();
        let width = (RIGHT - LEFT) / 4.0;
        let x = |sample: f64| format!("{:.2}", LEFT + width * sample);
        let bit = format!(
            "M{} 44.00H{}L{1} 44.00H{}L{2} 28.00H{}L{3} 28.00H{}",
            x(0.0),
            x(1.0),
            x(2.0),
            x(3.0),
            x(4.0)
        );
        assert_eq!(paths[0], bit);
        assert!(paths[1].starts_with(&format!("M{} 74.00H", x(0.0))), "5 of -1 to 7: {}", paths[1]);
        for part in [">trigger<", ">-2<", ">1<", ">-1<", ">7<", ">MW3<"] {
            assert!(picture.replace('\n', "").contains(part), "{part}: {picture}");
        }
    }

    #[test]
    fn steps_are_round() {
        assert_eq!([0.9, 1.0, 1.1, 3.0, 7.0, 45.0].map(step), [1.0, 1.0, 2.0, 5.0, 10.0, 50.0]);
    }
}
