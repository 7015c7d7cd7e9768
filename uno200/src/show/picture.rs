//! The view as a picture (SVG), cell by cell, from the buffer that a terminal would be drawn from.
//! The same state gives the same text.

use std::convert::Infallible;

use ratatui::Terminal;
use ratatui::backend::TestBackend;
use ratatui::buffer::{Buffer, Cell};
use ratatui::style::{Color, Modifier};
use svg::Document;
use svg::node::element::{Rectangle, Text};

use super::draw::draw;
use super::theme::Theme;
use client::show::state::State;

/// Size of a cell and of its letters.
const CELL_WIDTH: f64 = 8.4;
const CELL_HEIGHT: f64 = 18.0;
const FONT_SIZE: f64 = 14.0;
/// From the top of a cell to the foot of its letters.
const FOOT: f64 = 13.5;
/// Around the cells.
const MARGIN: f64 = 10.0;

const PAPER: &str = "#1b1f27";
const INK: &str = "#d5d9e0";
const FAINT_INK: &str = "#808896";

/// Draws the state on a screen of this size.
pub fn buffer(state: &mut State, width: u16, height: u16, theme: Theme) -> Buffer {
    // This backend writes to memory.
    let Ok(mut terminal) = infallible(Terminal::new(TestBackend::new(width, height)));
    let Ok(_) = infallible(terminal.draw(|frame| draw(frame, state, theme)));
    terminal.backend().buffer().clone()
}

fn infallible<T>(result: Result<T, Infallible>) -> Result<T, Infallible> {
    result
}

/// The cells as a picture.
pub fn svg(buffer: &Buffer) -> String {
    let area = buffer.area;
    let (width, height) =
        (f64::from(area.width) * CELL_WIDTH, f64::from(area.height) * CELL_HEIGHT);
    let (width, height) = (width + 2.0 * MARGIN, height + 2.0 * MARGIN);
    let mut document = Document::new()
        .set("viewBox", format!("0 0 {width:.1} {height:.1}"))
        .set("width", format!("{width:.1}"))
        .set("height", format!("{height:.1}"))
        .set("font-family", "'DejaVu Sans Mono', Menlo, Consolas, 'Liberation Mono', monospace")
        .set("font-size", FONT_SIZE)
        .add(
            Rectangle::new()
                .set("width", "100%")
                .set("height", "100%")
                .set("rx", 6)
                .set("fill", PAPER),
        );
    for y in 0..area.height {
        for ground in runs(buffer, y, |cell| look(cell).ground) {
            let Some(colour) = ground.look else { continue };
            document = document.add(rectangle(&ground, y).set("fill", colour));
        }
        for run in runs(buffer, y, look) {
            document = run.letters(y).into_iter().fold(document, Document::add);
        }
    }
    format!("{document}\n")
}

/// How cells look.
#[derive(Debug, Clone, Copy, PartialEq)]
struct CellLook {
    ink: &'static str,
    ground: Option<&'static str>,
    is_bold: bool,
    is_underlined: bool,
}

/// Cells of the same look beside each other.
struct Run<L> {
    x: u16,
    cells: u16,
    text: String,
    look: L,
}

fn runs<L: PartialEq>(buffer: &Buffer, y: u16, look: impl Fn(&Cell) -> L) -> Vec<Run<L>> {
    let mut runs: Vec<Run<L>> = Vec::new();
    for x in 0..buffer.area.width {
        let Some(cell) = buffer.cell((x, y)) else { continue };
        let look = look(cell);
        match runs.last_mut() {
            Some(run) if run.look == look => {
                run.text.push_str(cell.symbol());
                run.cells += 1;
            }
            _ => runs.push(Run { x, cells: 1, text: cell.symbol().to_owned(), look }),
        }
    }
    runs
}

fn place(x: u16, y: u16) -> (f64, f64) {
    (MARGIN + f64::from(x) * CELL_WIDTH, MARGIN + f64::from(y) * CELL_HEIGHT)
}

fn rectangle<L>(run: &Run<L>, y: u16) -> Rectangle {
    let (x, top) = place(run.x, y);
    Rectangle::new()
        .set("x", format!("{x:.1}"))
        .set("y", format!("{top:.1}"))
        .set("width", format!("{:.1}", f64::from(run.cells) * CELL_WIDTH))
        .set("height", CELL_HEIGHT)
}

impl Run<CellLook> {
    /// The letters; `None` where there are only blanks.
    fn letters(&self, y: u16) -> Option<Text> {
        let text = self.text.trim_end();
        let blanks = text.chars().take_while(|&character| character == ' ').count();
        let text = text.trim_start();
        if text.is_empty() {
            return None;
        }
        let (x, top) = place(self.x, y);
        // Blanks in a row would become one.
        let mut letters = Text::new(text.replace(' ', "\u{A0}"))
            .set("x", format!("{:.1}", x + blanks as f64 * CELL_WIDTH))
            .set("y", format!("{:.1}", top + FOOT))
            .set("textLength", format!("{:.1}", text.chars().count() as f64 * CELL_WIDTH))
            .set("fill", self.look.ink);
        if self.look.is_bold {
            letters = letters.set("font-weight", "bold");
        }
        if self.look.is_underlined {
            letters = letters.set("text-decoration", "underline");
        }
        Some(letters)
    }
}

fn look(cell: &Cell) -> CellLook {
    let has = |modifier| cell.modifier.contains(modifier);
    let ink = match cell.fg {
        Color::Reset if has(Modifier::DIM) => FAINT_INK,
        Color::Reset => INK,
        other => colour(other),
    };
    let ground = (cell.bg != Color::Reset).then(|| colour(cell.bg));
    let (ink, ground) = match has(Modifier::REVERSED) {
        true => (ground.unwrap_or(PAPER), Some(ink)),
        false => (ink, ground),
    };
    CellLook { ink, ground, is_bold: has(Modifier::BOLD), is_underlined: has(Modifier::UNDERLINED) }
}

fn colour(colour: Color) -> &'static str {
    match colour {
        Color::Black => "#14171c",
        Color::Red => "#c8414b",
        Color::Green => "#5fc26b",
        Color::Yellow => "#e0b84c",
        Color::Blue => "#5c9fe8",
        Color::Magenta => "#c991e8",
        Color::Cyan => "#59c2cf",
        Color::White => "#ffffff",
        _ => INK,
    }
}
