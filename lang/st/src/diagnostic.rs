//! The kinds of errors and warnings of Structured Text. Each has a page in docs/errors.

/// An error or warning about Structured Text.
pub type Diagnostic = diagnostics::Diagnostic<Code>;

diagnostics::codes! {
    pages "../../../docs/errors/";
    Syntax = "E0200";
    Missing = "E0201";
    Assignment = "E0202";
    UnknownName = "E0203";
    Duplicate = "E0204";
    WrongType = "E0205";
    Narrowing = "E0206";
    ConstantRange = "E0207";
    NotWritable = "E0208";
    Arguments = "E0209";
    NotThere = "E0210";
    SideEffect = "E0211";
    BadConstant = "E0212";
    CaseLabel = "E0213";
    Loop = "E0214";
    Declaration = "E0215";
    Recursion = "E0216";
    NarrowProduct = "W0200";
    NeverReached = "W0201";
    WrittenTwice = "W0202";
    ReadUnwritten = "W0203";
    Coarse = "W0210";
}
