//! The kinds of errors and warnings of diagrams. Each has a page in docs/errors.

/// An error or warning about a diagram.
pub type Diagnostic = diagnostics::Diagnostic<Code>;

diagnostics::codes! {
    pages "../../../docs/errors/";
    NoElement = "E0500";
    CalledTwice = "E0501";
    TwoSources = "E0502";
    Loop = "E0503";
    Empty = "E0504";
    Feedback = "E0505";
    NotConnected = "W0500";
    Drawing = "W0501";
    ShortPeriod = "W0502";
}
