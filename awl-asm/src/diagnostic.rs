//! The kinds of errors and warnings of AWL. What a diagnostic consists of besides, and how it is
//! shown, is said in the crate diagnostics.

pub use diagnostics::Severity;

/// An error or warning about AWL.
pub type Diagnostic = diagnostics::Diagnostic<Code>;

diagnostics::codes! {
    pages "../../docs/errors/";
    UnknownMnemonic = "E0001";
    Syntax = "E0002";
    OperandCount = "E0003";
    OperandKind = "E0004";
    AddressRange = "E0005";
    ConstantRange = "E0006";
    UnknownSymbol = "E0007";
    SymbolDefinition = "E0008";
    DuplicateLabel = "E0009";
    MissingLabel = "E0010";
    LoopPairing = "E0011";
    StackUnderflow = "E0012";
    TimerFamily = "E0013";
    TimerTwoKinds = "E0014";
    CounterTwoKinds = "E0015";
    ReadOnly = "E0016";
    NetworkStart = "E0017";
    ProgramTooLarge = "E0018";
    DataTooLarge = "E0019";
    Setting = "E0020";
    Block = "E0021";
    NotSupported = "E0022";
    TooMany = "E0023";
    Promise = "E0024";
    DataBlock = "E0060";
    Variable = "E0061";
    NoFreePlace = "E0062";
    UnitHeader = "E0070";
    Declaration = "E0071";
    UnknownRoutine = "E0072";
    ParameterCount = "E0073";
    ParameterKind = "E0074";
    Recursion = "E0075";
    CallDepth = "E0076";
    LocalMemory = "E0077";
    ScrPairing = "E0078";
    ScrContent = "E0079";
    ScrBit = "E0080";
    WrongUnit = "E0081";
    Pointer = "E0082";
    Event = "E0083";
    Hardware = "E0084";
    StackOverflow = "W0001";
    OutputTwice = "W0002";
    TimerNeverStarted = "W0003";
    TimerNotEveryScan = "W0004";
    NoSuchPin = "W0005";
    StaleStackValue = "W0006";
    CounterNeverCounts = "W0007";
    StartedTwice = "W0008";
    JumpIntoLoop = "W0009";
    UnusedValue = "W0010";
    InputWritten = "W0011";
    InactiveOutput = "W0012";
    MixedCoils = "W0013";
    Overlap = "W0014";
    EveryScan = "W0015";
    EmptyProgram = "W0016";
    NeverPermitted = "W0017";
    NeverActive = "W0018";
    NoResult = "W0019";
    NeverCalled = "W0020";
    NoPreset = "W0021";
    AlwaysReset = "W0022";
    UnseenTimer = "W0023";
    NoInterval = "W0024";
    NeverWritten = "W0025";
    WholeReal = "W0026";
    SameAnswer = "W0027";
    MixedMnemonics = "W0030";
    NoEffect = "W0032";
    NotForBoard = "W0033";
}
