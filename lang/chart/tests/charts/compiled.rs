//! Texts with charts as AWL, for tests.

use std::collections::HashSet;

use diagnostics::Source;
use st::Around;

/// What became of a text.
pub struct Compiled {
    /// What is wrong with its charts.
    pub of_chart: Vec<chart::Diagnostic>,
    /// What is wrong with its Structured Text.
    pub of_st: Vec<st::Diagnostic>,
    /// `None`: there are errors.
    pub awl: Option<String>,
}

impl Compiled {
    /// The codes of all that is wrong.
    pub fn codes(&self) -> Vec<&'static str> {
        let of_st = self.of_st.iter().map(|one| one.code.text());
        self.of_chart.iter().map(|one| one.code.text()).chain(of_st).collect()
    }
}

/// Compiles a text.
pub fn compile(text: &str) -> Compiled {
    let source = Source::new("station.sfc", text).expect("a short text");
    let translation = chart::translate(&source, &mut HashSet::new());
    let of_st = translation.of_st.into_iter().map(|one| (0, one)).collect();
    let compiled = st::translate(&[source], &[translation.file], of_st, &Around::default());
    let of_chart = translation.diagnostics;
    let has_errors = of_chart.iter().any(|one| one.severity() == diagnostics::Severity::Error);
    let of_st = compiled.diagnostics.into_iter().map(|(_, one)| one).collect();
    Compiled { of_chart, of_st, awl: compiled.awl.filter(|_| !has_errors) }
}
