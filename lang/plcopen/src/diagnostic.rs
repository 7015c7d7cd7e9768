//! The kinds of errors and warnings of projects of PLCopen. Each has a page in docs/errors.

/// An error or warning about a project of PLCopen.
pub type Diagnostic = diagnostics::Diagnostic<Code>;

diagnostics::codes! {
    pages "../../../docs/errors/";
    BrokenXml = "E0700";
    OtherFile = "E0701";
    OtherLanguage = "E0702";
    Incomplete = "E0703";
    Unknown = "E0704";
    Twice = "E0705";
    Wiring = "E0706";
    NoPlace = "E0707";
    Ignored = "W0700";
}
