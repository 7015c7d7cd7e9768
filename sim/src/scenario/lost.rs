//! A warning of what is set in a scenario and is gone before anything has seen it. What the program
//! does is told from outside.

use diagnostics::{Diagnostic, Span};

use super::Scenario;
use crate::operand::Operand;
use crate::problem::Warning;

impl Scenario {
    /// Warnings of values that are set in bits which the program writes in every scan and never
    /// reads, [`overwritten`](crate::open::Opened::overwritten).
    pub fn lost_settings(&self, overwritten: &[Operand]) -> Vec<Diagnostic<Warning>> {
        let lost = self.settings.iter().filter(|one| overwritten.contains(&one.operand));
        let warning = |setting: &super::Setting| {
            let name = setting.operand.to_string();
            let span = Span::new(setting.span.start, setting.span.end);
            let message = format!("{name} does not keep this value: the program writes it again");
            Diagnostic::new(Warning, span, message)
                .help(format!("it writes {name} in every scan and never reads it"))
                .help("set the inputs that make it so, and expect the output")
        };
        lost.map(warning).collect()
    }
}

#[cfg(test)]
mod tests {
    use crate::open::{File, open};
    use crate::scenario::{Context, Scenario};

    #[test]
    fn only_what_is_overwritten_is_warned_of() {
        let program = b"LD I0.0\n= Q0.0\nLD I0.1\nO Q0.1\n= Q0.1\n".to_vec();
        let opened = open(&File { name: "p.awl".to_string(), bytes: program }, &[]).unwrap();
        let text = "at 1s Q0.1 = 1, Q0.0 = 1\nevery 2s Q0.0 = 1\nat 2s I0.0 = 1\n\
            at 3s expect Q0.0 = 1";
        let context = Context { symbols: &[], plant: None, has_operand: &mut |_| Ok(()) };
        let scenario = Scenario::parse("t.scn", text, context).unwrap();
        let warnings = scenario.lost_settings(&opened.overwritten);
        let places: Vec<_> = warnings.iter().map(|one| one.span.start).collect();
        assert_eq!(places, [16, 34]);
        let message = "Q0.0 does not keep this value: the program writes it again";
        assert_eq!(warnings[0].message, message);
    }
}
