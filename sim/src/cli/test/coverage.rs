//! What of the programs no scenario has executed, in words.

use awl_sim::coverage::Coverage;
use awl_sim::suite::plural;

const INDENT: &str = "        ";

/// What of a program no scenario has executed.
pub(super) fn text(program: &str, coverage: &Coverage) -> String {
    let left: Vec<_> = coverage.left_out().collect();
    let is_whole = |(network, left): &&(&awl_sim::coverage::Network, Vec<_>)| {
        network.instructions.len() == left.len()
    };
    let never = left.iter().filter(is_whole).count();
    let (executed, all) = coverage.instructions();
    let networks = coverage.networks();
    let mut text = format!(
        "{program}: {} of {} and {executed} of {} executed\n",
        networks - never,
        plural(networks, "network"),
        plural(all, "instruction")
    );
    for (network, instructions) in &left {
        let from = instructions.first().map_or("", |instruction| &instruction.place);
        if instructions.len() == network.instructions.len() {
            text += &format!("{INDENT}never executed: {network}, {from}\n");
        } else {
            let places: Vec<&str> = instructions.iter().map(|one| one.place.as_str()).collect();
            text += &format!("{INDENT}never executed in {network}: {}\n", places.join(", "));
        }
    }
    for (value, word) in [(false, "off"), (true, "on")] {
        let bits = coverage.constant_bits().filter(|(_, was)| *was == value);
        let bits: Vec<&str> = bits.map(|(name, _)| name).collect();
        if !bits.is_empty() {
            text += &format!("{INDENT}always {word} after a scan: {}\n", bits.join(", "));
        }
    }
    text
}
