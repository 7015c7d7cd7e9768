//! The table of a language's codes as an enum: one line a code, everything else derived. Which
//! codes there are is said by the languages.

/// Makes the enum `Code` of a table, and what is told of each. `pages` is the folder with the page
/// of each code, as seen from the file that has the table.
#[macro_export]
macro_rules! codes {
    (pages $folder:literal; $( $name:ident = $code:literal; )+) => {
        /// Every kind of diagnostic. Each has a page in docs/errors.
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
                match self { $( Code::$name => include_str!(concat!($folder, $code, ".md")), )+ }
            }

            /// Errors begin with E, warnings with W.
            pub fn severity(self) -> $crate::Severity {
                $crate::Severity::of_code(self.text())
            }

            /// The code of this text, in any letter case.
            pub fn find(text: &str) -> Option<Code> {
                Code::ALL.iter().copied().find(|code| code.text().eq_ignore_ascii_case(text))
            }
        }

        impl $crate::Code for Code {
            fn text(self) -> Option<&'static str> {
                Some(self.text())
            }

            fn severity(self) -> $crate::Severity {
                self.severity()
            }

            fn page(self) -> Option<&'static str> {
                Some(self.page())
            }
        }
    };
}
