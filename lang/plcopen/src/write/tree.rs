//! Elements that are begun, filled and ended one after the other, before they are written.

use diagnostics::xml::Writer;

/// An element: a text, or others.
#[derive(Debug, Default)]
struct Element {
    name: String,
    attributes: Vec<(String, String)>,
    text: Option<String>,
    inside: Vec<Element>,
}

/// What is written, and the elements that are begun, the innermost last.
#[derive(Debug, Default)]
pub(super) struct Tree {
    done: Vec<Element>,
    open: Vec<Element>,
}

impl Element {
    fn new(name: &str, attributes: &[(&str, &str)]) -> Element {
        let owned = |(name, value): &(&str, &str)| ((*name).to_owned(), (*value).to_owned());
        let attributes = attributes.iter().map(owned).collect();
        Element { name: name.to_owned(), attributes, ..Element::default() }
    }

    fn write(&self, out: &mut Writer) {
        let attributes: Vec<(&str, &str)> =
            self.attributes.iter().map(|(name, value)| (name.as_str(), value.as_str())).collect();
        match &self.text {
            Some(text) => out.text(&self.name, &attributes, text),
            None if self.inside.is_empty() => out.empty(&self.name, &attributes),
            None => out.element(&self.name, &attributes, |out| {
                self.inside.iter().for_each(|one| one.write(out));
            }),
        }
    }
}

impl Tree {
    fn add(&mut self, element: Element) {
        let list = self.open.last_mut().map_or(&mut self.done, |outer| &mut outer.inside);
        list.push(element);
    }

    pub(super) fn begin(&mut self, name: &str, attributes: &[(&str, &str)]) {
        self.open.push(Element::new(name, attributes));
    }

    /// Ends the element that was begun last.
    pub(super) fn end(&mut self) {
        if let Some(element) = self.open.pop() {
            self.add(element);
        }
    }

    pub(super) fn empty(&mut self, name: &str, attributes: &[(&str, &str)]) {
        self.add(Element::new(name, attributes));
    }

    /// An element with a text in it.
    pub(super) fn text(&mut self, name: &str, text: &str) {
        self.add(Element { text: Some(text.to_owned()), ..Element::new(name, &[]) });
    }

    /// Writes what has been ended.
    pub(super) fn write(&self, out: &mut Writer) {
        self.done.iter().for_each(|one| one.write(out));
    }
}
