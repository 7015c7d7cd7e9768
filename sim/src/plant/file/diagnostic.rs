//! The kinds of errors in plant files. Each has a page in docs/errors.

/// An error in a plant file.
pub type Diagnostic = diagnostics::Diagnostic<Code>;

diagnostics::codes! {
    pages "../../../../docs/errors/";
    Statement = "E0600";
    UnknownName = "E0601";
    Duplicate = "E0602";
    Number = "E0603";
    Point = "E0604";
    TooMuch = "E0605";
}
