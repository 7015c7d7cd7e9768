//! Writes XML: indented, with attributes that any parser reads as they were given.

use std::fmt::Write;

/// A document that is being written.
#[derive(Debug)]
pub struct Writer {
    text: String,
    /// The elements that are not ended, the innermost last.
    begun: Vec<String>,
    /// Whether nothing is in the innermost yet: its start is not closed.
    is_bare: bool,
}

impl Default for Writer {
    fn default() -> Writer {
        let text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".to_owned();
        Writer { text, begun: Vec::new(), is_bare: false }
    }
}

impl Writer {
    /// Closes the start of the innermost element, in which something comes.
    fn fill(&mut self) {
        if std::mem::take(&mut self.is_bare) {
            self.text.push_str(">\n");
        }
    }

    fn start(&mut self, name: &str, attributes: &[(&str, &str)]) {
        self.fill();
        let _ = write!(self.text, "{:1$}<{name}", "", self.begun.len() * 2);
        for (name, value) in attributes {
            let _ = write!(self.text, " {name}=\"{}\"", escaped(value, true));
        }
    }

    /// Begins an element: what is written before its [`end`](Writer::end) is in it.
    pub fn begin(&mut self, name: &str, attributes: &[(&str, &str)]) {
        self.start(name, attributes);
        self.begun.push(name.to_owned());
        self.is_bare = true;
    }

    /// Ends the element that was begun last; nothing where there is none.
    pub fn end(&mut self) {
        let Some(name) = self.begun.pop() else { return };
        if std::mem::take(&mut self.is_bare) {
            self.text.push_str("/>\n");
        } else {
            let _ = writeln!(self.text, "{:1$}</{name}>", "", self.begun.len() * 2);
        }
    }

    /// An element with nothing in it.
    pub fn empty(&mut self, name: &str, attributes: &[(&str, &str)]) {
        self.begin(name, attributes);
        self.end();
    }

    /// An element with others in it.
    pub fn element(
        &mut self,
        name: &str,
        attributes: &[(&str, &str)],
        inside: impl FnOnce(&mut Writer),
    ) {
        self.begin(name, attributes);
        inside(self);
        self.end();
    }

    /// An element with a text in it, as it is.
    pub fn text(&mut self, name: &str, attributes: &[(&str, &str)], text: &str) {
        self.start(name, attributes);
        let _ = writeln!(self.text, ">{}</{name}>", escaped(text, false));
    }

    /// A line as it is, such as a document type.
    pub fn line(&mut self, line: &str) {
        self.fill();
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// What is written.
    pub fn finish(self) -> String {
        self.text
    }
}

/// With references for what has a meaning in XML. In an attribute line ends and tabs, too: parsers
/// read them as blanks there.
fn escaped(text: &str, is_attribute: bool) -> String {
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\n' | '\t' if is_attribute => {
                let _ = write!(out, "&#{};", u32::from(character));
            }
            '\r' => out.push_str("&#13;"),
            other => out.push(other),
        }
    }
    out
}
