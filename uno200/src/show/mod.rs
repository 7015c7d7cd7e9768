//! The terminal view: a program's source with power flow and values beside every line, from the
//! running PLC. What is shown
//! and asked is in [`client::show`]; how the PLC is reached, the connection knows.

mod draw;
#[cfg(test)]
mod draw_tests;
mod keys;
pub mod picture;
pub mod poll;
mod rows;
mod theme;

use std::io::{IsTerminal, stdout};
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use anyhow::{Result, bail};
use awl_asm::files::write_whole;
use client::Program;
use client::show::state::{News, State, Wishes};
use client::show::{Action, Key};
use client::value::Base;
use ratatui::DefaultTerminal;
use ratatui::crossterm::event::{self, Event};

use crate::connection::Client;
pub use theme::Theme;

use poll::{Message, Poller};

/// The shortest time from one drawing to the next, keys aside.
const DRAWING: Duration = Duration::from_millis(100);
/// How long keys are waited for before news are looked at.
const WAIT: Duration = Duration::from_millis(30);
/// Columns and rows of a picture.
const PICTURE: (u16, u16) = (92, 32);

/// What is shown, and how.
#[derive(Debug)]
pub struct Arguments {
    /// The program.
    pub program: Program,
    /// A picture is made of the view instead of showing it.
    pub picture: Option<PathBuf>,
    /// The line of the source that is selected first, from 1.
    pub line: Option<usize>,
    /// A single scan is executed first, and shown.
    pub scan: bool,
}

/// Shows a program until the user ends it.
pub fn run(client: Client, arguments: Arguments) -> Result<()> {
    run_in(Base::Decimal, client, arguments)
}

/// The same with values in this base to begin with.
pub fn run_in(base: Base, mut client: Client, arguments: Arguments) -> Result<()> {
    let Arguments { program, picture, line, scan } = arguments;
    let mut state = State::new(program, client.place());
    state.base = base;
    if let Some(line) = line {
        state.go_to(line.saturating_sub(1));
    }
    if let Some(path) = picture {
        return write_whole(&path, snapshot(&mut state, client, scan)?.as_bytes());
    }
    if !stdout().is_terminal() {
        bail!("show draws on a terminal, and this is none");
    }
    if !client.is_connected() {
        client.connect_again(&mut |text| anstream::eprintln!("{text}"))?;
    }
    let (to_poller, messages) = channel();
    let (to_view, news) = channel();
    thread::spawn(move || Poller::new(client, messages).run(&to_view));
    let mut terminal = ratatui::try_init()?;
    let view = View { state, to_poller, news, wishes: Wishes::default(), is_scan_due: scan };
    let result = view.run(&mut terminal);
    ratatui::restore();
    result
}

/// The view as a picture, as soon as everything that is visible is known; after a single scan, if
/// that is asked for.
pub fn snapshot(state: &mut State, client: Client, has_scan: bool) -> Result<String> {
    let (width, height) = PICTURE;
    let theme = Theme::new(true);
    let (to_poller, messages) = channel();
    let mut poller = Poller::new(client, messages);
    // First what the PLC is, then what is asked for; the warning above the source comes or goes in
    // between.
    for _ in 0..3 {
        poller.round()?.into_iter().for_each(|news| state.hear(news));
        picture::buffer(state, width, height, theme);
        to_poller.send(Message::Wishes(state.wishes()))?;
    }
    if has_scan && let Action::Order(order) = state.key(Key::Char(' ')) {
        to_poller.send(Message::Order(order))?;
    }
    poller.round()?.into_iter().for_each(|news| state.hear(news));
    Ok(picture::svg(&picture::buffer(state, width, height, theme)))
}

struct View {
    state: State,
    to_poller: Sender<Message>,
    news: Receiver<News>,
    /// What the poller was told last.
    wishes: Wishes,
    /// A single scan is to be executed as soon as the PLC has answered.
    is_scan_due: bool,
}

impl View {
    fn run(mut self, terminal: &mut DefaultTerminal) -> Result<()> {
        let theme = Theme::of_environment();
        let (mut is_due, mut has_news, mut drawn) = (true, false, Instant::now());
        loop {
            while let Ok(news) = self.news.try_recv() {
                self.state.hear(news);
                has_news = true;
            }
            if is_due || has_news && drawn.elapsed() >= DRAWING {
                terminal.draw(|frame| draw::draw(frame, &mut self.state, theme))?;
                (is_due, has_news, drawn) = (false, false, Instant::now());
                self.tell_wishes();
            }
            if self.is_scan_due && self.state.identity.is_some() {
                self.is_scan_due = false;
                let action = self.state.key(Key::Char(' '));
                self.obey(action);
            }
            if !event::poll(WAIT)? {
                continue;
            }
            is_due = true;
            if let Event::Key(event) = event::read()?
                && let Some(key) = keys::pressed(event)
            {
                let action = self.state.key(key);
                if action == Action::Quit {
                    return Ok(());
                }
                self.obey(action);
            }
        }
    }

    fn obey(&self, action: Action) {
        if let Action::Order(order) = action {
            // A poller that has gone has said why.
            drop(self.to_poller.send(Message::Order(order)));
        }
    }

    /// Which rows are visible is known when they have been drawn.
    fn tell_wishes(&mut self) {
        let wishes = self.state.wishes();
        if wishes != self.wishes {
            self.wishes = wishes.clone();
            drop(self.to_poller.send(Message::Wishes(wishes)));
        }
    }
}
