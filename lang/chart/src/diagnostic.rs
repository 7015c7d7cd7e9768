//! The kinds of errors and warnings of charts. Each has a page in docs/errors.

/// An error or warning about a chart.
pub type Diagnostic = diagnostics::Diagnostic<Code>;

diagnostics::codes! {
    pages "../../../docs/errors/";
    BrokenXml = "E0340";
    XmlStructure = "E0341";
    NotInStyle = "E0342";
    BadCondition = "E0343";
    BadVariables = "E0344";
    XmlIgnored = "W0340";
    StyleDiffers = "W0341";
    NeverWritten = "W0342";
    LetterCase = "W0343";
}
