//! Texts of the diagram and an estimate of how wide they come out. No font is measured: the
//! estimate is on the safe side.

use svg::node::element::Text;

/// Which end of the text is at its x.
#[derive(Clone, Copy)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// A text at its baseline.
pub(crate) fn label(text: &str, x: f64, y: f64, size: f64, colour: &str, anchor: Anchor) -> Text {
    let anchor = match anchor {
        Anchor::Start => "start",
        Anchor::Middle => "middle",
        Anchor::End => "end",
    };
    Text::new(text)
        .set("x", round(x))
        .set("y", round(y))
        .set("font-size", size)
        .set("fill", colour)
        .set("text-anchor", anchor)
}

/// Coordinates with one decimal: finer than any eye, and no digits of rounding errors.
pub(crate) fn round(value: f64) -> f64 {
    (value * 10.0).round() / 10.0
}

/// Width of a text in a bold sans-serif font, rather too wide than too narrow.
pub(super) fn width(text: &str, size: f64) -> f64 {
    let ems: f64 = text
        .chars()
        .map(|c| match c {
            'i' | 'j' | 'l' | 'I' | '.' | ',' | ':' | '\'' | '|' | ' ' | 'f' | 't' => 0.36,
            'm' | 'w' | 'M' | 'W' => 0.95,
            'A'..='Z' => 0.74,
            '\u{1100}'.. => 1.05,
            _ => 0.61,
        })
        .sum();
    ems * size
}

/// The text, cut with an ellipsis where it is wider than the place it has.
pub(super) fn shorten(text: &str, place: f64, size: f64) -> String {
    if width(text, size) <= place {
        return text.to_string();
    }
    let mut cut = String::new();
    for c in text.chars() {
        if width(&cut, size) + width("m…", size) > place {
            break;
        }
        cut.push(c);
    }
    cut.trim_end().to_string() + "…"
}
