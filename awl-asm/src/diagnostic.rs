//! Errors and warnings as data: code, place, words. How they are shown is the renderer's business.

use crate::ast::Span;

/// How bad it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Severity {
    /// No image is made.
    Error,
    /// The program means something, but perhaps not what its author meant.
    Warning,
}

macro_rules! codes {
    ($( $name:ident = $code:literal; )+) => {
        /// Every kind of diagnostic. Each has a page in docs/errors.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum Code { $( #[doc = concat!("`", $code, "`, explained in docs/errors/", $code, ".md")] $name, )+ }

        impl Code {
            /// All codes in order.
            pub const ALL: &[Code] = &[ $( Code::$name, )+ ];

            /// As printed: `E` or `W` and four digits.
            pub const fn text(self) -> &'static str {
                match self { $( Code::$name => $code, )+ }
            }

            /// The page that explains it, in Markdown.
            pub const fn page(self) -> &'static str {
                match self { $( Code::$name => include_str!(concat!("../../docs/errors/", $code, ".md")), )+ }
            }
        }
    };
}

codes! {
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
    DataBlock = "E0060";
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
    NeverCalled = "W0020";
    MixedMnemonics = "W0030";
    NoEffect = "W0032";
}

impl Code {
    /// Errors begin with E, warnings with W.
    pub fn severity(self) -> Severity {
        if self.text().starts_with('E') { Severity::Error } else { Severity::Warning }
    }

    /// The code of this text, in any letter case.
    pub fn find(text: &str) -> Option<Code> {
        Code::ALL.iter().copied().find(|code| code.text().eq_ignore_ascii_case(text))
    }
}

/// One error or warning.
#[derive(Debug, Clone)]
pub struct Diagnostic {
    /// Which.
    pub code: Code,
    /// The place the caret points at.
    pub span: Span,
    /// What is wrong, in a sentence without full stop that stands by itself.
    pub message: String,
    /// A few words beside the caret.
    pub label: Option<String>,
    /// The text that should probably stand at `span` instead.
    pub suggestion: Option<String>,
    /// What to do, or what the rule is.
    pub help: Vec<String>,
    /// Other places that belong to it, with a few words each.
    pub related: Vec<(Span, String)>,
}

impl Diagnostic {
    /// A diagnostic with a message.
    pub fn new(code: Code, span: Span, message: impl Into<String>) -> Diagnostic {
        Diagnostic {
            code,
            span,
            message: message.into(),
            label: None,
            suggestion: None,
            help: Vec::new(),
            related: Vec::new(),
        }
    }

    /// Adds words beside the caret.
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = Some(label.into());
        self
    }

    /// Adds a replacement for the text at the caret.
    pub fn suggest(mut self, text: impl Into<String>) -> Self {
        self.suggestion = Some(text.into());
        self
    }

    /// Adds a line of help.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help.push(help.into());
        self
    }

    /// Adds another place.
    pub fn related(mut self, span: Span, words: impl Into<String>) -> Self {
        self.related.push((span, words.into()));
        self
    }

    /// Error or warning.
    pub fn severity(&self) -> Severity {
        self.code.severity()
    }
}
