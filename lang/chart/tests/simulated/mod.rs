//! Texts as programs in the simulator, for tests.

use awl_sim::machine::Machine;
use awl_sim::open::{File, open};
use awl_sim::run::{Job, Length, run};
use awl_sim::scenario::{Context, Scenario};

/// Runs a text by a scenario; all that it expects must come.
pub fn holds(name: &str, text: String, scenario: &str) {
    let file = File { name: name.to_owned(), bytes: text.into_bytes() };
    let mut opened = open(&file, &[]).unwrap_or_else(|error| panic!("{error}"));
    let machine = &mut *opened.machine;
    let mut has_operand = |operand| Machine::read(machine, operand).map(|_| ());
    let context = Context { symbols: &opened.symbols, plant: None, has_operand: &mut has_operand };
    let scenario = Scenario::parse("run.scn", scenario, context)
        .unwrap_or_else(|problems| panic!("{}", problems.render(false)));
    let scan_ms = scenario.scan_ms.unwrap_or(1);
    let length = Length::Scenario;
    let job = Job { scan_ms, length, signals: Vec::new(), plant: None, progress: None };
    let outcome = run(&mut *opened.machine, &scenario, job).expect("operands that are there");
    assert!(outcome.failures.is_empty(), "{:?}", outcome.failures);
    assert!(outcome.fault.is_none(), "{:?}", outcome.fault);
}
