//! Random blocks: what a compiled block leaves after every scan is what the interpreter says.
//! `FB_BLOCKS` sets how many, `FB_SEED` shows one.

mod generate;
mod seeds;

use awl_sim::machine::Machine;
use awl_sim::machine::host::Host;
use awl_sim::open::{File, Opened, open};
use awl_sim::operand::Operand;
use diagnostics::Source;
use fastrand::Rng;
use fb::interpreter::{Stopped, Value};
use fb::parsed::{Parsed, parse};
use fb::{Block, DataType, Interpreter, xml};
use generate::Generator;

const SCANS: usize = 15;

/// What a machine shows of a value. Nobody can tell 0.0 from -0.0 by computing.
fn shown(value: Value) -> i32 {
    match value {
        Value::Real(0.0) => 0,
        Value::Real(value) => value.to_bits() as i32,
        other => other.whole() as i32,
    }
}

fn random_value(of_type: DataType, random: &mut Rng) -> Value {
    let value = match of_type {
        DataType::Bool => Value::Bool(random.bool()),
        DataType::Real => Value::Real(f32::from(random.i16(-100..100)) / 8.0),
        DataType::Dint if random.bool() => Value::Literal(random.i32(..).into()),
        _ if random.bool() => Value::Literal(random.i64(-3..8)),
        _ => Value::Literal(*random.choice(&[0, 1, -1, 32767, -32768]).unwrap_or(&0)),
    };
    value.to(of_type)
}

/// What a run came to.
#[derive(Default)]
struct Tally {
    compared: usize,
    scans: usize,
    sent: usize,
    lost: usize,
    entered: usize,
}

struct Pair<'b> {
    block: &'b Block,
    interpreter: Interpreter<'b>,
    machine: Opened<Host>,
}

impl Pair<'_> {
    fn write(&mut self, name: &str, value: Value) {
        let operand = Operand::parse(name, &self.machine.symbols).expect(name);
        // What the program does not use is nowhere.
        let _ = self.machine.machine.write(operand, shown(value));
    }

    /// What differs from a value that is expected.
    fn differs(&mut self, name: &str, wanted: i32) -> Option<String> {
        let operand = Operand::parse(name, &self.machine.symbols).ok()?;
        let found = self.machine.machine.read(operand).ok()?;
        let found = if found == (-0.0f32).to_bits() as i32 && wanted == 0 { 0 } else { found };
        (found != wanted).then(|| format!("{name} is {found}, not {wanted}"))
    }

    fn scan(
        &mut self,
        now: u64,
        random: &mut Rng,
        tally: &mut Tally,
    ) -> Result<(), Option<String>> {
        for input in &self.block.inputs {
            if random.bool() {
                let value = random_value(input.of_type, random);
                self.interpreter.set(&input.name.text, value);
                self.write(&input.name.text, value);
            }
        }
        let events: Vec<usize> =
            (0..self.block.event_inputs.len()).filter(|_| random.u8(..3) == 0).collect();
        for event in &events {
            self.write(&self.block.event_inputs[*event].name.text.clone(), Value::Bool(true));
        }
        let step = match self.interpreter.send(&events) {
            Ok(step) => step,
            Err(Stopped::NoRest(_) | Stopped::Endless) => return Err(None),
            Err(other) => return Err(Some(other.to_string())),
        };
        self.machine.machine.scan(now);
        if let Some(fault) = self.machine.machine.fault() {
            return Err(Some(fault.to_string()));
        }
        tally.scans += 1;
        tally.sent += step.sent.len();
        tally.lost += step.lost.len();
        tally.entered += step.entered.len();
        for (at, event) in self.block.event_outputs.iter().enumerate() {
            if let Some(found) = self.differs(&event.name.text, step.sent.contains(&at).into()) {
                return Err(Some(found));
            }
        }
        let state = self.interpreter.state_number() as i32;
        let differs = self.differs("State", state);
        let differs = differs.or_else(|| {
            let mut all = self.block.variables();
            all.find_map(|one| {
                let wanted = self.interpreter.value(&one.name.text).expect("a variable");
                self.differs(&one.name.text, shown(wanted))
            })
        });
        differs.map_or(Ok(()), |found| Err(Some(found)))
    }
}

/// How a compiled block differs from the interpreted one.
fn differs(seed: u64, tally: &mut Tally) -> Option<String> {
    let text = xml::write(&Generator::block(seed, false));
    let source = Source::new("random.fbt", text.as_str()).expect("a short text");
    // A chart without rest is no block.
    let block = xml::read(&source).block?;
    let parsed: Parsed = parse(&block, &source);
    let file = File { name: "random.fbt".to_owned(), bytes: text.clone().into_bytes() };
    let machine = match open(&file, &[]) {
        Ok(machine) => machine,
        Err(error) if error.to_string().contains("local memory is full") => return None,
        Err(error) => return Some(format!("seed {seed}: {error}\n{text}")),
    };
    let interpreter = Interpreter::new(&block, &parsed).expect("types that are known");
    let mut random = Rng::with_seed(seed);
    let mut pair = Pair { block: &block, interpreter, machine };
    tally.compared += 1;
    for scan in 0..SCANS {
        match pair.scan(scan as u64 * 10, &mut random, tally) {
            Ok(()) => {}
            Err(None) => break,
            Err(Some(found)) => return Some(format!("seed {seed}, scan {scan}: {found}\n{text}")),
        }
    }
    None
}

#[test]
fn compiled_blocks_do_what_the_interpreter_says() {
    let mut tally = Tally::default();
    let seeds = seeds::seeds(150);
    let count = seeds.len();
    let different: Vec<String> =
        seeds.into_iter().filter_map(|seed| differs(seed, &mut tally)).collect();
    for one in different.iter().take(12) {
        println!("{}", one.lines().next().unwrap_or_default());
    }
    if let Some(shortest) = different.iter().min_by_key(|text| text.len()) {
        panic!("{} of {count} blocks differ, such as\n{shortest}", different.len());
    }
    let Tally { compared, scans, sent, lost, entered } = tally;
    println!(
        "{compared} blocks, {scans} scans, {entered} states entered, {sent} sent, {lost} lost"
    );
    if count > 100 {
        assert!(compared * 2 > count, "{compared} of {count} blocks could be compared");
        assert!(scans > count && sent > count / 2 && lost > count / 4 && entered > count);
    }
}
