//! The kinds of errors and warnings of charts. Each has a page in docs/errors.

/// An error or warning about a chart.
pub type Diagnostic = diagnostics::Diagnostic<Code>;

diagnostics::codes! {
    pages "../../../docs/errors/";
    Syntax = "E0300";
    Missing = "E0301";
    UnknownStep = "E0302";
    Duplicate = "E0303";
    BadQualifier = "E0304";
    Initial = "E0305";
    NotThere = "E0306";
    Unit = "E0307";
    Pragma = "E0308";
    NotInAction = "E0309";
    NeverReached = "W0300";
    NeverLeft = "W0301";
    NeverJoined = "W0302";
    NeverExecuted = "W0303";
}
