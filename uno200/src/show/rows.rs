//! The rows of the source on the screen: number, power flow, levels of the logic stack, text,
//! values.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};
use ratatui::text::Line;

use super::theme::{Look, Theme};
use client::show::model::{Content, Flow, Instruction, Row};
use client::show::operands::Watched;
use client::show::state::State;
use client::value::{Base, Form};

/// Columns for further levels of the logic stack.
const LEVELS_WIDTH: u16 = 3;
/// Columns between the source and the values.
const GAP: u16 = 2;
/// Columns that values have at least.
const VALUES_WIDTH: u16 = 16;
/// Columns that the source has at least.
const CODE_WIDTH_MIN: u16 = 16;

/// The visible rows, and where their columns are.
pub struct Page<'a> {
    state: &'a State,
    theme: Theme,
    area: Rect,
    mark: u16,
    code: u16,
    /// Columns of lines with values.
    code_width: u16,
    values: u16,
}

impl Page<'_> {
    /// Finds the columns: as narrow as the longest line with an instruction allows.
    pub fn new(state: &State, area: Rect, theme: Theme) -> Page<'_> {
        let digits = state.model.rows.len().to_string().len().max(3) as u16;
        let mark = area.x + digits + 1;
        let code = mark + 1 + LEVELS_WIDTH + 1;
        let with_code = state.model.rows.iter().filter(|row| row.instruction().is_some());
        let longest = with_code.map(|row| Line::raw(&row.text).width()).max().unwrap_or(0);
        let most = area.right().saturating_sub(code + GAP + VALUES_WIDTH).max(CODE_WIDTH_MIN);
        let code_width = (longest.min(usize::from(u16::MAX)) as u16).clamp(CODE_WIDTH_MIN, most);
        Page { state, theme, area, mark, code, code_width, values: code + code_width + GAP }
    }

    /// Draws them.
    pub fn draw(&self, buffer: &mut Buffer) {
        for (y, index) in (self.area.y..self.area.bottom()).zip(self.state.visible()) {
            let Some(row) = self.state.model.rows.get(index) else { break };
            let is_selected = index == self.state.selected;
            let number =
                format!("{:>width$}", row.number, width = usize::from(self.mark - self.area.x - 1));
            let style = match is_selected {
                true => self.theme.style(Look::Bar).add_modifier(Modifier::BOLD),
                false => self.theme.style(Look::Faint),
            };
            put(buffer, (self.area.x, y), &number, self.area.right(), style);
            let look = match &row.content {
                Content::Instruction(instruction) => {
                    self.instruction(buffer, y, row, instruction);
                    self.values(buffer, y, instruction, is_selected);
                    continue;
                }
                Content::Network | Content::Unit => Look::Heading,
                Content::Text if row.comment_at == leading(&row.text) => Look::Faint,
                Content::Text => Look::Plain,
            };
            put(buffer, (self.code, y), &row.text, self.area.right(), self.theme.style(look));
        }
    }

    /// Power flow, levels and text.
    fn instruction(&self, buffer: &mut Buffer, y: u16, row: &Row, instruction: &Instruction) {
        let (mark, look) = match self.state.flow(instruction) {
            Some(Flow::On) => ("\u{25CF}", Look::On),
            Some(Flow::Off) => ("\u{25CB}", Look::Off),
            Some(Flow::NotExecuted) => ("\u{00B7}", Look::Faint),
            None if self.state.scanned.is_some() && instruction.offset.is_some() => {
                ("?", Look::Faint)
            }
            None => (" ", Look::Plain),
        };
        let faint = self.theme.style(Look::Faint);
        put(buffer, (self.mark, y), mark, self.area.right(), self.theme.style(look));
        let levels_end = self.code.min(self.area.right());
        put(buffer, (self.mark + 1, y), &levels(self.state, instruction), levels_end, faint);
        let end = (self.code + self.code_width).min(self.area.right());
        put(buffer, (self.code, y), &row.text, end, self.theme.style(look));
        if let Some(at) = row.comment_at {
            let before = Line::from(row.text.chars().take(at).collect::<String>()).width() as u16;
            let comment: String = row.text.chars().skip(at).collect();
            put(buffer, (self.code.saturating_add(before), y), &comment, end, faint);
        }
    }

    fn values(&self, buffer: &mut Buffer, y: u16, instruction: &Instruction, is_selected: bool) {
        let mut x = self.values;
        for (index, watched) in instruction.operands.iter().enumerate() {
            let forced = self.state.forced.get(&watched.operand.reference).copied();
            let Some(value) = self.state.value(instruction, index).or(forced) else { continue };
            let (text, look) = value_text(watched, value, forced.is_some(), self.state.base);
            let mut style = self.theme.style(look);
            if is_selected && index == self.state.operand {
                style = style.add_modifier(Modifier::UNDERLINED);
            }
            x = put(buffer, (x, y), &text, self.area.right(), style) + GAP;
        }
    }
}

/// The first character that is no blank.
fn leading(text: &str) -> Option<usize> {
    text.chars().position(|character| character != ' ')
}

/// The levels of the logic stack after S0 that belong to the rung.
fn levels(state: &State, instruction: &Instruction) -> String {
    let executed = instruction.offset.and_then(|offset| state.executed.get(&offset));
    let Some(executed) = executed.filter(|executed| executed.is_executed) else {
        return String::new();
    };
    let levels = (1..instruction.levels.min(1 + LEVELS_WIDTH as u8))
        .map(|level| executed.stack >> level & 1);
    levels.map(|level| if level == 1 { '1' } else { '0' }).collect()
}

fn value_text(watched: &Watched, value: u32, is_forced: bool, base: Base) -> (String, Look) {
    let text = watched.text(value, base);
    match watched.operand.form {
        _ if is_forced => (format!("{text} F"), Look::Forced),
        Form::Bit if value & 1 == 1 => (text, Look::On),
        Form::Bit => (text, Look::Off),
        _ => (text, Look::Value),
    }
}

/// Writes a text up to a column; what is cut off ends with a mark. Returns the column after it.
fn put(buffer: &mut Buffer, (x, y): (u16, u16), text: &str, end: u16, style: Style) -> u16 {
    let room = usize::from(end.saturating_sub(x));
    if room == 0 {
        return x;
    }
    let (behind, _) = buffer.set_stringn(x, y, text, room, style);
    if Line::raw(text).width() > room {
        buffer.set_stringn(end - 1, y, "\u{2026}", 1, style);
    }
    behind
}
