//! The kinds of errors and warnings of Structured Text. Each has a page in docs/errors.

use diagnostics::Severity;

/// An error or warning about Structured Text.
pub type Diagnostic = diagnostics::Diagnostic<Code>;

macro_rules! codes {
    ($( $name:ident = $code:literal; )+) => {
        /// Every kind of diagnostic.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum Code {
            $(
                #[doc = concat!("`", $code, "`, explained in docs/errors/", $code, ".md")]
                $name,
            )+
        }

        impl Code {
            /// All codes in order.
            pub const ALL: &[Code] = &[ $( Code::$name, )+ ];

            /// As printed: `E` or `W` and four digits.
            pub const fn text(self) -> &'static str {
                match self { $( Code::$name => $code, )+ }
            }

            /// The page that explains it, in Markdown.
            pub const fn page(self) -> &'static str {
                match self {
                    $( Code::$name =>
                        include_str!(concat!("../../../docs/errors/", $code, ".md")), )+
                }
            }
        }
    };
}

codes! {
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
}

impl diagnostics::Code for Code {
    fn text(self) -> Option<&'static str> {
        Some(self.text())
    }

    fn severity(self) -> Severity {
        if self.text().starts_with('E') { Severity::Error } else { Severity::Warning }
    }

    fn page(self) -> Option<&'static str> {
        Some(self.page())
    }
}
