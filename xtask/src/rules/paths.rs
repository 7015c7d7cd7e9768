//! The paths in the text of a Rust file that lead to other files of its crate. It reads no more of
//! the language than that.

/// A path to another file.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Use {
    /// Its parts, `crate`, `self` and `super` included.
    pub(super) path: Vec<String>,
    /// The name that a `use` line gives it.
    pub(super) name: Option<String>,
    /// Whether that line is public: it re-exports.
    pub(super) is_public: bool,
}

/// The paths of a file; `below` are the modules below it, whose names begin paths too.
pub(super) fn paths(text: &str, below: &[&str]) -> Vec<Use> {
    let code = without_tests_and_comments(text);
    let mut uses = Vec::new();
    let mut rest = code.as_str();
    // What is before a path decides what it is.
    let mut before = String::new();
    while let Some(start) = rest.find(is_word) {
        before.push_str(&rest[..start]);
        let word_len = rest[start..].find(|c| !is_word(c)).unwrap_or(rest.len() - start);
        let (word, after) = rest[start..].split_at(word_len);
        let is_path = matches!(word, "crate" | "self" | "super") || below.contains(&word);
        let use_line = use_line(&before);
        let begins = after.starts_with("::") && !before.ends_with("::");
        if begins && (is_path || use_line.is_some()) {
            let mut reader = Reader { rest: &rest[start..], uses: &mut uses, use_line };
            reader.tree(&[]);
            rest = reader.rest;
            before.clear();
        } else {
            before.push_str(word);
            rest = after;
        }
    }
    uses
}

fn is_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Whether the text before a path makes it a `use` line, and a public one.
fn use_line(before: &str) -> Option<bool> {
    let line = before.rsplit([';', '}', '{', ']']).next().unwrap_or(before).trim();
    let head = line.strip_suffix("use")?.trim_end();
    (head.is_empty() || head.starts_with("pub")).then(|| head.starts_with("pub"))
}

/// Tests are at the end of a file.
fn without_tests_and_comments(text: &str) -> String {
    let code = text.split("\n#[cfg(test)]\nmod tests").next().unwrap_or(text);
    let code = if code.starts_with("#[cfg(test)]") { "" } else { code };
    let lines = code.lines().map(|line| line.split("//").next().unwrap_or(line));
    lines.collect::<Vec<_>>().join("\n")
}

struct Reader<'t, 'u> {
    rest: &'t str,
    uses: &'u mut Vec<Use>,
    /// Whether it is the path of a public `use` line; `None` for one in an expression.
    use_line: Option<bool>,
}

impl Reader<'_, '_> {
    /// A path, or several with the same beginning.
    fn tree(&mut self, head: &[String]) {
        let mut path = head.to_vec();
        loop {
            self.rest = self.rest.trim_start();
            if self.use_line.is_some() && self.rest.starts_with('{') {
                return self.branches(&path);
            }
            let len = self.rest.find(|c| !is_word(c)).unwrap_or(self.rest.len());
            let (word, after) = self.rest.split_at(len);
            // `use a::b::{self}` is `use a::b`.
            if !word.is_empty() && (word != "self" || path.is_empty()) {
                path.push(word.to_owned());
            }
            self.rest = after;
            match self.rest.strip_prefix("::") {
                Some(after) if !word.is_empty() => self.rest = after,
                _ => break,
            }
        }
        let is_glob = self.rest.starts_with('*');
        let mut name = path.last().filter(|_| !is_glob).cloned();
        if let Some(after) = self.rest.trim_start().strip_prefix("as ") {
            let len = after.find(|c| !is_word(c)).unwrap_or(after.len());
            name = Some(after[..len].to_owned());
            self.rest = &after[len..];
        }
        let name = name.filter(|_| self.use_line.is_some());
        self.uses.push(Use { path, name, is_public: self.use_line == Some(true) });
    }

    fn branches(&mut self, head: &[String]) {
        self.rest = self.rest.strip_prefix('{').unwrap_or(self.rest);
        loop {
            self.rest = self.rest.trim_start();
            match self.rest.chars().next() {
                None => return,
                Some('}') => {
                    self.rest = &self.rest[1..];
                    return;
                }
                Some(c) if c == ',' || c == '*' => self.rest = &self.rest[1..],
                Some(_) => {
                    let len = self.rest.len();
                    self.tree(head);
                    if self.rest.len() == len {
                        return;
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(text: &str) -> Vec<String> {
        let show = |one: &Use| {
            let name = one.name.as_ref().map_or(String::new(), |name| format!(" = {name}"));
            format!("{}{}{name}", if one.is_public { "pub " } else { "" }, one.path.join("::"))
        };
        paths(text, &["below"]).iter().map(show).collect()
    }

    #[test]
    fn use_lines() {
        assert_eq!(shown("use crate::a::B;"), ["crate::a::B = B"]);
        assert_eq!(
            shown("pub(crate) use super::a::{self, b::{C as D, E}};"),
            ["pub super::a = a", "pub super::a::b::C = D", "pub super::a::b::E = E"]
        );
        assert_eq!(shown("mod x;\npub use below::*;"), ["pub below"]);
    }

    #[test]
    fn paths_in_code() {
        assert_eq!(shown("fn f() { let x = crate::a::f(1) + below::g::<u8>(); }").len(), 2);
        assert_eq!(shown("fn f() { other::below::g(); } // crate::a"), [""; 0]);
        assert_eq!(shown("fn f() {}\n#[cfg(test)]\nmod tests {\n use crate::a;\n}"), [""; 0]);
    }
}
