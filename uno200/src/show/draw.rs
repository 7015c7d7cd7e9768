//! Draws the state: title bar, what must be known first, the source with power flow and values, the
//! selected operand, the keys.

use ratatui::Frame;
use ratatui::layout::{Constraint, Layout, Rect};
use ratatui::style::Modifier;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Clear, Paragraph};

use super::rows::Page;
use super::theme::{Look, Theme};
use client::show::state::{Agreement, Link, Question, State};
use client::value::{Base, Form};

const HELP: [(&str, &str); 17] = [
    ("arrows, PgUp, PgDn", "select a line"),
    ("Home, End", "first, last line"),
    ("n, p", "next, previous network"),
    ("Tab, left, right", "select an operand of the line"),
    ("/", "search; Enter alone searches on"),
    ("x", "hexadecimal or decimal"),
    ("f", "force the operand: a bit to its opposite"),
    ("u, U", "end forcing of the operand, of all"),
    ("s", "write the operand once, a bit its opposite"),
    ("r, t", "RUN, STOP"),
    ("space", "a single scan, in STOP, and what it did"),
    ("q", "quit; the PLC goes on as it is"),
    ("", ""),
    ("\u{25CF} \u{25CB} \u{00B7}", "power flow after the line: yes, no, not executed"),
    ("?", "not known of the single scan that is shown"),
    ("\u{25CF}10", "after it further levels of the logic stack, S1 S2"),
    ("1 F", "forced"),
];

/// Draws everything. The state learns how many rows there is room for.
pub fn draw(frame: &mut Frame<'_>, state: &mut State, theme: Theme) {
    let warning = warning(state);
    let rows = [1, u16::from(warning.is_some()), 0, 1, 1];
    let rows = Layout::vertical([
        Constraint::Length(rows[0]),
        Constraint::Length(rows[1]),
        Constraint::Min(rows[2]),
        Constraint::Length(rows[3]),
        Constraint::Length(rows[4]),
    ]);
    let [title_area, warning_area, source_area, detail_area, keys_area] = rows.areas(frame.area());
    state.resize(source_area.height.into());
    title(frame, title_area, state, theme);
    if let Some((text, look)) = warning {
        let line = Line::from(format!(" {text}")).style(theme.style(look));
        frame.render_widget(Paragraph::new(line).style(theme.style(look)), warning_area);
    }
    Page::new(state, source_area, theme).draw(frame.buffer_mut());
    detail(frame, detail_area, state, theme);
    keys(frame, keys_area, state, theme);
    if state.has_help {
        help(frame, source_area, theme);
    }
}

/// What must be known before anything below it is believed.
fn warning(state: &State) -> Option<(String, Look)> {
    if let Link::Lost(why) = &state.link {
        return Some((format!("trying again: {why}"), Look::Stop));
    }
    if let Some(fault) = state.fault() {
        return Some((format!("fault: {fault}"), Look::Stop));
    }
    let image = |(crc, len): (u32, u16)| format!("{crc:08X}, {len} bytes");
    match state.agreement() {
        Agreement::Other => {
            let identity = state.identity.as_ref()?;
            let there = image((identity.image_crc, identity.image_len));
            let text =
                format!("the PLC has another program: {there}; this: {}", image(state.model.image));
            Some((text, Look::Stop))
        }
        Agreement::NoProgram => Some(("no program is in the PLC".to_owned(), Look::Stop)),
        Agreement::Native => {
            let text = "it runs as machine code: values at the end of the scan, no power flow";
            Some((text.to_owned(), Look::Forced))
        }
        Agreement::Same if !state.has_power_flow() => {
            let text = "this firmware tells no power flow: values at the end of the scan";
            Some((text.to_owned(), Look::Forced))
        }
        Agreement::Same => in_stop(state).map(|text| (text, Look::Forced)),
        Agreement::Unknown => None,
    }
}

/// What is shown in STOP: of which scan, and how much of it is known.
fn in_stop(state: &State) -> Option<String> {
    if state.is_running() {
        return None;
    }
    let Some(scan) = state.scanned else {
        return Some("STOP: what the last scan did is not known; space: a scan, shown".to_owned());
    };
    Some(match state.known_of_scan() {
        (visible, known) if known < visible => format!(
            "scan {scan}: {known} of {visible} lines fit into its window, ? are not known; values \
             are from its end"
        ),
        _ => format!("scan {scan}: what it did; values are from its end"),
    })
}

fn title(frame: &mut Frame<'_>, area: Rect, state: &State, theme: Theme) {
    let bold = theme.style(Look::Bar).add_modifier(Modifier::BOLD);
    let mut left = vec![Span::styled(format!(" {} ", state.model.name), bold), Span::raw(" ")];
    if let Some(identity) = &state.identity {
        let (mode, look) =
            if identity.is_running { (" RUN ", Look::Run) } else { (" STOP ", Look::Stop) };
        left.push(Span::styled(mode, theme.style(look)));
        left.push(Span::raw(format!("  scan {}", identity.scans)));
        if identity.counts_per_ms > 0 && identity.scans > 0 {
            let ms = |counts: u32| f64::from(counts) / f64::from(identity.counts_per_ms);
            left.push(Span::raw(format!(
                ": {:.2} ms, longest {:.2} ms",
                ms(identity.last),
                ms(identity.longest)
            )));
        }
    }
    if !state.forced.is_empty() {
        left.push(Span::raw("  "));
        left.push(Span::styled(
            format!(" {} forced ", state.forced.len()),
            theme.style(Look::Forced),
        ));
    }
    let link = match state.link {
        Link::Up => Span::raw(format!("{} ", state.place)),
        Link::Connecting => Span::raw("connecting "),
        Link::Lost(_) => Span::styled(" no connection ", theme.style(Look::Stop)),
    };
    let left = Line::from(left);
    let room = usize::from(area.width).saturating_sub(left.width() + 1);
    frame.render_widget(Paragraph::new(left).style(theme.style(Look::Bar)), area);
    if link.width() <= room || !matches!(state.link, Link::Up) {
        let width = (link.width() as u16).min(area.width);
        let place = Rect { x: area.right() - width, width, ..area };
        frame.render_widget(Paragraph::new(link).style(theme.style(Look::Bar)), place);
    }
}

/// The line that speaks of the selected operand, asks, or answers.
fn detail(frame: &mut Frame<'_>, area: Rect, state: &State, theme: Theme) {
    if let Some((question, typed)) = &state.question {
        let text = match question {
            Question::Force(operand) => format!(" force {} to: {typed}", operand.official()),
            Question::Set(operand) => format!(" set {} to: {typed}", operand.official()),
            Question::Search => format!(" search: {typed}"),
            Question::Stop => " STOP? The outputs go off. y/n ".to_owned(),
        };
        let line = Line::styled(text, theme.style(Look::Question));
        let x = (line.width() as u16).min(area.width.saturating_sub(1));
        frame.set_cursor_position((area.x + x, area.y));
        return frame.render_widget(Paragraph::new(line), area);
    }
    if let Some((message, is_bad)) = &state.message {
        let look = if *is_bad { Look::Stop } else { Look::Question };
        return frame.render_widget(
            Paragraph::new(Line::styled(format!(" {message} "), theme.style(look))),
            area,
        );
    }
    let Some((watched, value)) = state.selected_operand() else { return };
    let operand = &watched.operand;
    let mut spans = vec![Span::styled(format!(" {}", operand.name), theme.style(Look::Question))];
    if operand.official() != operand.name {
        spans.push(Span::raw(format!("  {}", operand.official())));
    }
    if let Some(value) = value {
        spans.push(Span::raw(format!("  = {}", watched.text(value, Base::Decimal))));
        if operand.form != Form::Bit {
            spans.push(Span::raw(format!("  {}", watched.text(value, Base::Hexadecimal))));
        }
    }
    if let Some(&forced) = state.forced.get(&operand.reference) {
        let text = format!(" forced to {} ", watched.text(forced, state.base));
        spans.extend([Span::raw("  "), Span::styled(text, theme.style(Look::Forced))]);
    }
    if !watched.comment.is_empty() {
        spans.push(Span::styled(format!("  {}", watched.comment), theme.style(Look::Faint)));
    }
    frame.render_widget(Paragraph::new(Line::from(spans)), area);
}

fn keys(frame: &mut Frame<'_>, area: Rect, state: &State, theme: Theme) {
    let is_running = state.identity.as_ref().is_some_and(|identity| identity.is_running);
    let mode: &[(&str, &str)] =
        if is_running { &[("t", "STOP")] } else { &[("r", "RUN"), ("space", "scan")] };
    let first = [("n p", "network"), ("f", "force"), ("u", "unforce"), ("s", "set")];
    let last = [("/", "search"), ("x", "hex"), ("?", "help"), ("q", "quit")];
    let mut all: Vec<_> = first.iter().chain(mode).chain(&last).collect();
    // With blanks around and between them, of which the last one can be cut off.
    let width = |all: &[&(&str, &str)]| {
        all.iter().map(|(key, what)| key.len() + what.len() + 3).sum::<usize>() - 1
    };
    // Help tells the others.
    for dispensable in ["/", "n p", "x", "u", "s"] {
        if width(&all) > area.width.into() {
            all.retain(|(key, _)| *key != dispensable);
        }
    }
    let key = |name: &str| {
        Span::styled(format!(" {name}"), theme.style(Look::Bar).add_modifier(Modifier::BOLD))
    };
    let spans =
        all.into_iter().flat_map(|(name, what)| [key(name), Span::raw(format!(" {what} "))]);
    frame.render_widget(Paragraph::new(Line::from_iter(spans)).style(theme.style(Look::Bar)), area);
}

fn help(frame: &mut Frame<'_>, area: Rect, theme: Theme) {
    let width = 74.min(area.width);
    let height = (HELP.len() as u16 + 2).min(area.height);
    let place = Rect {
        x: area.x + (area.width - width) / 2,
        y: area.y + (area.height - height) / 2,
        width,
        height,
    };
    let line = |&(key, what): &(&'static str, &'static str)| {
        Line::from(vec![
            Span::styled(format!(" {key:<20}"), theme.style(Look::Key)),
            Span::raw(what),
        ])
    };
    let text: Vec<Line<'_>> = HELP.iter().map(line).collect();
    frame.render_widget(Clear, place);
    frame.render_widget(Paragraph::new(text).block(Block::bordered().title(" keys ")), place);
}
