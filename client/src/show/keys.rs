//! What the keys do. Only the state changes here; what the PLC is to do is handed out.

use super::model::Content;
use super::state::{Agreement, Order, Question, State, can_force};
use crate::operand::Operand;
use crate::value::{Base, Form};

/// A key that was pressed, whoever reads keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Key {
    /// A character.
    Char(char),
    /// The cursor up.
    Up,
    /// The cursor down.
    Down,
    /// The cursor left.
    Left,
    /// The cursor right.
    Right,
    /// A page up.
    PageUp,
    /// A page down.
    PageDown,
    /// To the beginning.
    Home,
    /// To the end.
    End,
    /// The tabulator.
    Tab,
    /// The tabulator with shift.
    BackTab,
    /// The end of an answer.
    Enter,
    /// No answer.
    Escape,
    /// Takes the last character back.
    Backspace,
    /// Shows the keys, as F1 does.
    Help,
    /// Ends the view whatever it shows, as Ctrl-C does.
    Interrupt,
    /// Any other one.
    Other,
}

/// What follows from a key.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    /// Nothing but another view.
    None,
    /// The PLC is to do something.
    Order(Order),
    /// The view ends.
    Quit,
}

impl State {
    /// A key was pressed.
    pub fn key(&mut self, key: Key) -> Action {
        if key == Key::Interrupt {
            return Action::Quit;
        }
        self.message = None;
        if self.has_help {
            self.has_help = false;
            return Action::None;
        }
        match self.question.take() {
            Some((question, typed)) => self.answer(key, question, typed),
            None => self.command(key),
        }
    }

    /// A key while a question is open.
    fn answer(&mut self, key: Key, question: Question, mut typed: String) -> Action {
        match (key, &question) {
            (Key::Char('y' | 'Y'), Question::Stop) => return Action::Order(Order::Stop),
            (_, Question::Stop) | (Key::Escape, _) => return Action::None,
            (Key::Enter, _) => return self.answered(question, typed),
            (Key::Backspace, _) => drop(typed.pop()),
            (Key::Char(character), _) => typed.push(character),
            _ => {}
        }
        self.question = Some((question, typed));
        Action::None
    }

    /// An answer is complete.
    fn answered(&mut self, question: Question, typed: String) -> Action {
        let value = |form: Form| form.parse(&typed);
        let order = match &question {
            Question::Stop => return Action::None,
            Question::Search => {
                if !typed.is_empty() {
                    self.sought = typed;
                }
                self.search();
                return Action::None;
            }
            Question::Force(operand) => {
                value(operand.form).map(|value| Order::Force(operand.clone(), value))
            }
            Question::Set(operand) => {
                value(operand.form).map(|value| Order::Set(operand.clone(), value))
            }
        };
        match order {
            Ok(order) => Action::Order(order),
            Err(why) => {
                self.message = Some((why, true));
                Action::None
            }
        }
    }

    /// A key while nothing is asked.
    fn command(&mut self, key: Key) -> Action {
        let page = self.height.saturating_sub(1).max(1);
        match key {
            Key::Up => self.select(self.selected.saturating_sub(1)),
            Key::Down => self.select(self.selected + 1),
            Key::PageUp => self.select(self.selected.saturating_sub(page)),
            Key::PageDown => self.select(self.selected + page),
            Key::Home => self.select(0),
            Key::End => self.select(usize::MAX),
            Key::Tab | Key::Right => self.next_operand(1),
            Key::BackTab | Key::Left => self.next_operand(-1),
            Key::Char('n') => self.next_network(),
            Key::Char('p') => self.previous_network(),
            Key::Char('x') => {
                self.base =
                    if self.base == Base::Decimal { Base::Hexadecimal } else { Base::Decimal };
            }
            Key::Char('/') => self.question = Some((Question::Search, String::new())),
            Key::Char('?') | Key::Help => self.has_help = true,
            Key::Char('q') => return Action::Quit,
            Key::Char(character) => return self.control(character),
            _ => {}
        }
        Action::None
    }

    /// A key that changes something in the PLC.
    fn control(&mut self, character: char) -> Action {
        let is_running = self.identity.as_ref().map(|identity| identity.is_running);
        match (character, is_running) {
            ('f' | 'u' | 'U' | 's' | 'r' | 't' | ' ', None) => {
                self.complain("the PLC does not answer")
            }
            ('f', _) => self.change(true),
            ('s', _) => self.change(false),
            ('u', _) => match self.known_operand() {
                Some((operand, _)) => Action::Order(Order::Unforce(operand)),
                None => Action::None,
            },
            ('U', _) => Action::Order(Order::UnforceAll),
            ('r', _) => Action::Order(Order::Run),
            ('t', _) => {
                self.question = Some((Question::Stop, String::new()));
                Action::None
            }
            (' ', Some(true)) => self.complain("single scans go from STOP: t first"),
            (' ', _) => Action::Order(self.single_scan()),
            _ => Action::None,
        }
    }

    /// Forces the selected operand or sets it: a bit to what it is not, anything else to what the
    /// user says.
    fn change(&mut self, is_forced: bool) -> Action {
        let Some((operand, value)) = self.known_operand() else { return Action::None };
        if is_forced && !can_force(&operand) {
            return self.complain(&format!(
                "{} cannot be forced, only I, Q, M, V, AIW, AQW",
                operand.official()
            ));
        }
        match (operand.form, value) {
            (Form::Bit, Some(value)) => {
                let other = u32::from(value & 1 == 0);
                Action::Order(if is_forced {
                    Order::Force(operand, other)
                } else {
                    Order::Set(operand, other)
                })
            }
            _ => {
                let question =
                    if is_forced { Question::Force(operand) } else { Question::Set(operand) };
                self.question = Some((question, String::new()));
                Action::None
            }
        }
    }

    /// The selected operand and its value, forced or not; a message where there is none.
    fn known_operand(&mut self) -> Option<(Operand, Option<u32>)> {
        if !matches!(self.agreement(), Agreement::Same | Agreement::Native) {
            self.complain("the PLC has another program");
            return None;
        }
        let found = self.selected_operand().filter(|(watched, _)| !watched.is_local);
        let Some((watched, value)) = found else {
            self.complain("this line has no operand for that");
            return None;
        };
        let forced = self.forced.get(&watched.operand.reference).copied();
        Some((watched.operand.clone(), forced.or(value)))
    }

    fn complain(&mut self, why: &str) -> Action {
        self.message = Some((why.to_owned(), true));
        Action::None
    }

    fn next_operand(&mut self, step: isize) {
        let count = self.selected_instruction().map_or(0, |instruction| instruction.operands.len());
        if count > 0 {
            self.operand = (self.operand as isize + step).rem_euclid(count as isize) as usize;
        }
    }

    fn is_heading(&self, row: usize) -> bool {
        self.model
            .rows
            .get(row)
            .is_some_and(|row| matches!(row.content, Content::Network | Content::Unit))
    }

    fn next_network(&mut self) {
        let next = (self.selected + 1..self.model.rows.len()).find(|&row| self.is_heading(row));
        if let Some(row) = next {
            self.go_to(row);
        }
    }

    fn previous_network(&mut self) {
        let before = (0..self.selected).rev().find(|&row| self.is_heading(row));
        self.go_to(before.unwrap_or(0));
    }

    /// Goes to the next row with what is sought; after the last one from the first on.
    fn search(&mut self) {
        let sought = self.sought.to_lowercase();
        if sought.is_empty() {
            return;
        }
        let rows = &self.model.rows;
        let order = (self.selected + 1..rows.len()).chain(0..(self.selected + 1).min(rows.len()));
        let found = { order }.find(|&row| {
            rows.get(row).is_some_and(|row| row.text.to_lowercase().contains(&sought))
        });
        match found {
            Some(row) => self.select(row),
            None => self.message = Some((format!("{} is nowhere", self.sought), true)),
        }
    }
}
