//! How things look: the terminal's own colours, which fit dark and light ones, and without colours
//! marks and weights.

use ratatui::style::{Color, Modifier, Style};

/// What is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Look {
    /// Ordinary text.
    Plain,
    /// Less than that: line numbers, comments, what is not executed.
    Faint,
    /// Title bar and line of keys.
    Bar,
    /// Power flows; a bit is 1.
    On,
    /// No power flow; a bit is 0.
    Off,
    /// Headings of networks.
    Heading,
    /// A value that is no bit.
    Value,
    /// A forced value.
    Forced,
    /// RUN.
    Run,
    /// STOP, and what is wrong.
    Stop,
    /// What the user is asked.
    Question,
    /// A key.
    Key,
}

/// The looks, with colours or without.
#[derive(Debug, Clone, Copy)]
pub struct Theme {
    has_colours: bool,
}

impl Theme {
    /// With colours or without.
    pub fn new(has_colours: bool) -> Theme {
        Theme { has_colours }
    }

    /// As the user's environment asks: without colours where NO_COLOR is set to anything.
    pub fn of_environment() -> Theme {
        Theme::new(std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty()))
    }

    /// The style of something.
    pub fn style(self, look: Look) -> Style {
        let (style, colour) = match look {
            Look::Plain | Look::Off => (Style::new(), None),
            Look::Faint => (Style::new().add_modifier(Modifier::DIM), None),
            Look::Bar => (Style::new().add_modifier(Modifier::REVERSED), None),
            Look::Question | Look::Key => (Style::new().add_modifier(Modifier::BOLD), None),
            Look::On => (Style::new().add_modifier(Modifier::BOLD), Some(Color::Green)),
            Look::Heading => (Style::new().add_modifier(Modifier::BOLD), Some(Color::Magenta)),
            Look::Value => (Style::new(), Some(Color::Cyan)),
            Look::Forced => return self.badge(Color::Yellow, Color::Black),
            Look::Run => return self.badge(Color::Green, Color::Black),
            Look::Stop => return self.badge(Color::Red, Color::White),
        };
        match colour {
            Some(colour) if self.has_colours => style.fg(colour),
            _ => style,
        }
    }

    /// What must not be overlooked: with a ground of its own, also in a line that is reversed.
    fn badge(self, ground: Color, ink: Color) -> Style {
        let bold = Style::new().add_modifier(Modifier::BOLD);
        match self.has_colours {
            true => bold.remove_modifier(Modifier::REVERSED).bg(ground).fg(ink),
            false => bold.add_modifier(Modifier::REVERSED),
        }
    }
}
