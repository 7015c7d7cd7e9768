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
        }
    };
}

/// What is said of a text that is none of these codes: which of them it may mean, by its number.
pub fn unknown_code(text: &str, known: impl IntoIterator<Item = &'static str>) -> String {
    let number = |text: &str| {
        let digits: String = text.chars().filter(char::is_ascii_digit).collect();
        digits.parse::<u32>().ok()
    };
    // In any letter case, and within more: error[E0012].
    let letter = text.chars().next().map(|c| c.to_ascii_uppercase());
    let letter = letter.filter(|letter| ['E', 'W'].contains(letter));
    let is_meant = |code: &&str| {
        number(code) == number(text) && letter.is_none_or(|letter| code.starts_with(letter))
    };
    let meant: Vec<&str> = known.into_iter().filter(is_meant).collect();
    let help = match meant.is_empty() {
        true => "messages have them in brackets, such as E0012".to_string(),
        false => format!("did you mean {}?", meant.join(" or ")),
    };
    format!("{text} is no code of an error or warning: {help}")
}

#[cfg(test)]
mod tests {
    use super::unknown_code;

    #[test]
    fn codes_that_may_be_meant() {
        let told = |text: &str| {
            let text = unknown_code(text, ["E0012", "E0013", "W0013"]);
            text.split_once("warning: ").unwrap().1.to_string()
        };
        assert_eq!(told("13"), "did you mean E0013 or W0013?");
        assert_eq!(told("e13"), "did you mean E0013?");
        assert_eq!(told("warning[W0013]"), "did you mean W0013?");
        assert_eq!(told("error[12]"), "did you mean E0012?");
        for text in ["", "99", "E", "W12", "14.", "9999999999999"] {
            assert_eq!(told(text), "messages have them in brackets, such as E0012", "{text}");
        }
    }
}
