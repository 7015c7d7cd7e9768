//! The README's first program does what the README says, to the letter.

use awl_asm::assemble::assemble;
use awl_asm::cost::{CYCLES_PER_US, cost};
use awl_asm::render;
use awl_asm::source::Source;
use awl_sim::machine::host::Host;
use awl_sim::run::{Job, Length, run};
use awl_sim::scenario::{Context, Scenario};

const README: &str = include_str!("../../README.md");

/// The fenced block that begins with these words.
fn block(beginning: &str) -> &'static str {
    let start =
        README.find(&format!("```\n{beginning}")).unwrap_or_else(|| panic!("no block {beginning}"))
            + 4;
    let len = README[start..].find("```").expect("the block ends");
    &README[start..start + len]
}

#[test]
fn the_mistake_gets_the_message_that_is_shown() {
    let source = Source::new("lamp.awl", block("NETWORK 1 // the button")).unwrap();
    let assembly = assemble(&source, Vec::new());
    let shown: String = assembly
        .diagnostics
        .iter()
        .map(|diagnostic| render::human(&source, diagnostic, false) + "\n")
        .collect();
    let expected = block("$ awl-asm lamp.awl\nerror");
    let message = expected
        .strip_prefix("$ awl-asm lamp.awl\n")
        .and_then(|text| text.split("lamp.awl: 1 error").next());
    assert_eq!(Some(shown.as_str()), message);
}

#[test]
fn the_mended_program_meets_its_scenario() {
    let text = block("NETWORK 1 // the button").replace("T5", "T37");
    let assembly = assemble(&Source::new("lamp.awl", text).unwrap(), Vec::new());
    assert!(assembly.diagnostics.is_empty());
    let image = assembly.image.expect("no errors, so an image");
    let scan = cost(&image).unwrap().interpreted.scan.div_ceil(CYCLES_PER_US.into());
    let summary = format!(
        "{} instructions, {} of 7680 bytes; data 5 of 896 bytes; longest scan {scan} us",
        assembly.code.len(),
        image.len()
    );
    assert!(block("$ awl-asm lamp.awl\nlamp.bin").contains(&summary), "{summary}");

    let mut has_operand = |_| Ok(());
    let context = Context { symbols: &[], plant: None, has_operand: &mut has_operand };
    let scenario = Scenario::parse("lamp.scn", block("at 1s     I0.0 = 1"), context).unwrap();
    let mut machine = Host::new(image, Box::new(|_| String::new()));
    let job = Job {
        scan_ms: 1,
        length: Length::Scenario,
        signals: Vec::new(),
        plant: None,
        progress: None,
    };
    let outcome = run(&mut machine, &scenario, job).unwrap();
    assert_eq!((outcome.met, outcome.failures.len(), outcome.scans), (4, 0, 5_000));
    assert!(README.contains("ran 5000 scans (5 s), 4 expectations met"));
}
