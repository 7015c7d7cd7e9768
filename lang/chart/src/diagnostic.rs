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
    Hierarchy = "E0310";
    Contradiction = "E0311";
    Unstable = "E0312";
    BrokenXml = "E0340";
    XmlStructure = "E0341";
    NotInStyle = "E0342";
    BadCondition = "E0343";
    BadVariables = "E0344";
    NeverReached = "W0300";
    NeverLeft = "W0301";
    NeverJoined = "W0302";
    NeverExecuted = "W0303";
    Alternatives = "W0304";
    Idle = "W0305";
    CanBeUnstable = "W0306";
    XmlIgnored = "W0340";
    StyleDiffers = "W0341";
    NeverWritten = "W0342";
    LetterCase = "W0343";
}
