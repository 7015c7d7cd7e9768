//! Random charts: what the AWL leaves in steps, times and variables after every scan is what the
//! interpreter says.

use awl_sim::machine::Machine;
use awl_sim::machine::host::Host;
use awl_sim::open::{File, Opened, open};
use awl_sim::operand::{Operand, Width};
use chart::interpret::{Interpreter, View};
use chart::model::{ActionId, Body, Chart, Instance, StepKind};
use diagnostics::Source;
use fastrand::Rng;

use crate::evaluator::Values;
use crate::random_grafcet;
use crate::random_text::{COUNTERS, INPUTS, LIMIT_MS, MARKS, OUTPUTS, program};

const SCANS: usize = 40;

/// How many charts have what, and how often it happened.
#[derive(Debug, Default)]
struct Counts {
    charts: u32,
    parallel: u32,
    alternatives: u32,
    timed: u32,
    stored: u32,
    charts_in_actions: u32,
    macro_steps: u32,
    enclosing_steps: u32,
    forcing_orders: u32,
    events: u32,
    conditional_actions: u32,
    crossing_actions: u32,
    edges: u32,
    times: u32,
    /// Scans whose situation differs from the one before.
    evolutions: u32,
    /// Scans that ended without a stable situation.
    unstable: u32,
}

/// A chart and those in it.
fn all_charts(chart: &Chart) -> Vec<&Chart> {
    let inner = chart.actions.values().filter_map(|action| match &action.body {
        Body::Chart(inner) => Some(all_charts(inner)),
        Body::Variable | Body::Code(_) => None,
    });
    std::iter::once(chart).chain(inner.flatten()).collect()
}

impl Counts {
    fn take(&mut self, chart: &Chart) {
        let charts = all_charts(chart);
        let steps = || charts.iter().flat_map(|chart| chart.steps.values());
        let transitions = || charts.iter().flat_map(|chart| chart.transitions.values());
        let instances = || steps().flat_map(|step| &step.block);
        let some = |is_there: bool| u32::from(is_there);
        let has_chart =
            |chart: &Chart, action: ActionId| matches!(chart.actions[&action].body, Body::Chart(_));
        let uses_chart = |chart: &&Chart| {
            let mut blocks = chart.steps.values().flat_map(|step| &step.block);
            blocks.any(|one| has_chart(chart, one.action))
        };
        let text = chart::text::write(&chart::text::Document {
            pieces: vec![chart::text::Piece::Chart(chart.clone())],
        });
        self.charts += 1;
        self.parallel += some(transitions().any(|one| one.to.len() > 1));
        let drawn = |chart: &&Chart| !chart::drawn::Drawn::of(chart).divergences.is_empty();
        self.alternatives += some(charts.iter().any(drawn));
        self.timed += some(instances().any(|one| one.time.is_some()));
        let is_stored = |one: &Instance| one.qualifier.is_stored() || one.qualifier.is_pulse();
        self.stored += some(instances().any(is_stored));
        self.charts_in_actions += some(charts.iter().any(uses_chart));
        self.macro_steps += some(steps().any(|one| matches!(one.kind, StepKind::Macro(_))));
        self.enclosing_steps += some(steps().any(|one| matches!(one.kind, StepKind::Enclosing(_))));
        self.forcing_orders += some(steps().any(|one| !one.forcings.is_empty()));
        self.events += some(instances().any(|one| one.event.is_some()));
        self.conditional_actions += some(instances().any(|one| one.condition.is_some()));
        self.crossing_actions += some(transitions().any(|one| one.crossing.is_some()));
        self.edges += some(text.contains("_EDGE("));
        self.times += some(text.contains("ms/"));
    }
}

/// Where a step is compared: its name in AWL, the actions around it, its name.
type Path = (String, Vec<ActionId>, String);

/// The steps of a chart and of the charts in it.
fn steps(chart: &Chart, prefix: &str, around: &[ActionId], found: &mut Vec<Path>) {
    for step in chart.steps.values() {
        found.push((format!("{prefix}{}", step.name), around.to_vec(), step.name.clone()));
    }
    for (id, action) in &chart.actions {
        if let Body::Chart(inner) = &action.body {
            let around = [around, &[*id]].concat();
            steps(inner, &format!("{prefix}{}.", action.name), &around, found);
        }
    }
}

/// The steps of a chart, or of one in its actions.
fn view<'i>(interpreter: &'i Interpreter<'i>, around: &[ActionId]) -> View<'i> {
    match interpreter {
        Interpreter::Sfc(sfc) => {
            around.iter().fold(sfc, |outer, id| outer.inner(*id).expect("a chart")).view()
        }
        Interpreter::Grafcet(grafcet) => grafcet.view(),
    }
}

/// A chart that is being executed twice.
struct Both<'c> {
    opened: Opened<Host>,
    interpreter: Interpreter<'c>,
    values: Values,
    /// Steps with their times, where they have one.
    steps: Vec<(Operand, Option<Operand>, Path)>,
    written: Vec<(&'static str, Operand)>,
    inputs: Vec<(&'static str, Operand)>,
}

impl<'c> Both<'c> {
    fn new(chart: &'c Chart, opened: Opened<Host>) -> Both<'c> {
        let operand = |name: &str| Operand::parse(&format!("Main.{name}"), &opened.symbols);
        let mut paths = Vec::new();
        steps(chart, "", &[], &mut paths);
        let steps = paths.into_iter().map(|path| {
            let time = operand(&format!("{}.T", path.0)).ok();
            (operand(&path.0).expect("a step"), time, path)
        });
        let steps = steps.collect();
        let named = |name: &'static str| (name, operand(name).expect("a variable"));
        let all = OUTPUTS.iter().chain(&MARKS).chain(&COUNTERS);
        let written: Vec<_> = all.map(|name| named(name)).collect();
        let inputs: Vec<_> = INPUTS.iter().map(|name| named(name)).collect();
        let mut values = Values::default();
        for (name, _) in written.iter().chain(&inputs) {
            values.0.insert(name.to_uppercase(), 0);
        }
        values.0.insert("LIMIT".to_owned(), LIMIT_MS);
        let interpreter = Interpreter::new(chart);
        Both { opened, interpreter, values, steps, written, inputs }
    }

    fn scan(&mut self, now: u64, elapsed: i64, random: &mut Rng) {
        for (name, operand) in &self.inputs {
            let value = i64::from(random.bool());
            self.values.0.insert(name.to_uppercase(), value);
            // What the program does not use is nowhere.
            let _ = self.opened.machine.write(*operand, value as i32);
        }
        self.interpreter.scan(elapsed, &mut self.values);
        self.opened.machine.scan(now);
    }

    /// How an operand that is somewhere differs.
    fn wrong(&mut self, name: &str, operand: Operand, wanted: i64) -> Option<String> {
        let found = i64::from(self.opened.machine.read(operand).ok()?);
        (found != wanted).then(|| format!("{name} is {found}, not {wanted}"))
    }

    /// The steps that are active, or how one differs.
    fn situation(&mut self) -> Result<Vec<bool>, String> {
        let mut situation = Vec::new();
        for (active, time, (name, around, step)) in std::mem::take(&mut self.steps) {
            let view = view(&self.interpreter, &around);
            let is_active = view.is_active(&step).expect("a step");
            let exact = view.time(&step).expect("a step");
            situation.push(is_active);
            let mut wrong = self.wrong(&name, active, is_active.into());
            if let Some(time) = time {
                // A word ends at its highest number.
                let is_word = time.width() == Width::Word;
                let wanted = if is_word { exact.min(i16::MAX.into()) } else { exact };
                wrong = wrong.or_else(|| self.wrong(&format!("{name}.T"), time, wanted));
            }
            self.steps.push((active, time, (name, around, step)));
            wrong.map_or(Ok(()), Err)?;
        }
        Ok(situation)
    }

    fn is_unstable(&self) -> bool {
        matches!(&self.interpreter, Interpreter::Grafcet(one) if one.is_unstable())
    }

    fn wrong_variable(&mut self) -> Option<String> {
        let all = self.written.clone();
        let wrong = all.into_iter().find_map(|(name, operand)| {
            let wanted = self.values.0[&name.to_uppercase()];
            self.wrong(name, operand, wanted)
        });
        if wrong.is_some() {
            return wrong;
        }
        let unstable = Operand::parse("Main.Chart.Unstable", &self.opened.symbols).ok()?;
        self.wrong("Chart.Unstable", unstable, self.is_unstable().into())
    }
}

/// How the two differ on a chart; what it has and what it does is counted.
fn differs(text: &str, seed: u64, counts: &mut Counts) -> Option<String> {
    let source = Source::new("r.sfc", text).expect("a short text");
    let reading = chart::text::read(&source);
    let chart = reading.document.charts().next().expect("a chart");
    counts.take(chart);
    let file = File { name: "r.sfc".to_owned(), bytes: text.as_bytes().to_vec() };
    let opened = match open(&file, &[]) {
        Ok(opened) => opened,
        Err(error) => return Some(format!("seed {seed}: {error}\n{text}")),
    };
    let mut both = Both::new(chart, opened);
    let mut random = Rng::with_seed(seed);
    let (mut now, mut elapsed) = (0, 0);
    let mut before = Vec::new();
    for scan in 0..SCANS {
        both.scan(now, elapsed, &mut random);
        let situation = both.situation();
        let wrong = match (both.opened.machine.fault(), &situation) {
            (Some(fault), _) => Some(fault.to_string()),
            (None, Err(wrong)) => Some(wrong.clone()),
            (None, Ok(_)) => both.wrong_variable(),
        };
        if let Some(wrong) = wrong {
            return Some(format!("seed {seed}, scan {scan}: {wrong}\n{text}"));
        }
        let situation = situation.unwrap_or_default();
        counts.evolutions += u32::from(situation != before);
        counts.unstable += u32::from(both.is_unstable());
        before = situation;
        elapsed = match random.u8(..40) {
            0 => random.i64(10_000..16_000),
            _ => random.i64(1..30),
        };
        now += elapsed as u64;
    }
    None
}

/// Compares charts; `CHARTS` sets how many, `CHART_SEED` shows one.
fn compare(program: fn(u64) -> String) -> Counts {
    let number = |name: &str| std::env::var(name).ok().and_then(|text| text.parse::<u64>().ok());
    let mut counts = Counts::default();
    let all = match number("CHART_SEED") {
        Some(seed) => seed..seed + 1,
        None => 0..number("CHARTS").unwrap_or(300),
    };
    let compared = all.filter_map(|seed| differs(&program(seed), seed, &mut counts));
    let different: Vec<String> = compared.collect();
    println!("{counts:?}");
    for one in different.iter().take(12) {
        println!("{}", one.lines().next().unwrap_or_default());
    }
    if let Some(shortest) = different.iter().min_by_key(|text| text.len()) {
        panic!("{} charts differ, such as\n{shortest}", different.len());
    }
    counts
}

#[test]
fn the_awl_of_charts_does_what_the_interpreter_says() {
    let counts = compare(program);
    let some = counts.charts / 20;
    assert!(counts.parallel > some && counts.alternatives > some, "{counts:?}");
    assert!(counts.timed > some && counts.stored > some, "{counts:?}");
    assert!(counts.charts_in_actions > some / 2, "{counts:?}");
    assert!(counts.evolutions > counts.charts * 5, "{counts:?}");
}

#[test]
fn the_awl_of_grafcets_does_what_the_interpreter_says() {
    let counts = compare(random_grafcet::program);
    let many = counts.charts / 10;
    for count in [
        counts.parallel,
        counts.alternatives,
        counts.timed,
        counts.stored,
        counts.macro_steps,
        counts.enclosing_steps,
        counts.forcing_orders,
        counts.events,
        counts.conditional_actions,
        counts.crossing_actions,
        counts.edges,
        counts.times,
        counts.unstable,
    ] {
        assert!(count > many, "{counts:?}");
    }
    let scans = counts.charts * SCANS as u32;
    assert!(counts.evolutions > counts.charts * 5 && counts.unstable < scans / 2, "{counts:?}");
}
