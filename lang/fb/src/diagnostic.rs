//! The kinds of errors and warnings of function blocks. Each has a page in docs/errors.

/// An error or warning about a function block.
pub type Diagnostic = diagnostics::Diagnostic<Code>;

diagnostics::codes! {
    pages "../../../docs/errors/";
    BrokenXml = "E0400";
    OtherKind = "E0401";
    Incomplete = "E0402";
    UnknownName = "E0403";
    BadName = "E0404";
    DataType = "E0405";
    Condition = "E0406";
    NeverRests = "E0407";
    BrokenMatlab = "E0408";
    NoMatlab = "E0409";
    Ignored = "W0400";
    Unused = "W0401";
    MatlabDiffers = "W0402";
}
