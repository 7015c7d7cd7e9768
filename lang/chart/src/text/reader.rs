//! Finds the charts of a text, and reads each into the model. The elements are read by
//! [`super::elements`].

use std::collections::{HashMap, HashSet};

use diagnostics::{Source, Span};
use st::lexer::{Kind, Token, cut};

use super::{Document, Piece, Reading, Region, program_name};
use crate::diagnostic::{Code as ErrorCode, Diagnostic};
use crate::model::{Chart, Origin, Standard};

/// The words that begin an element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Begin {
    Step { is_initial: bool },
    Transition,
    Action,
}

/// A text that is being read.
pub(super) struct Reader<'t> {
    pub(super) text: &'t str,
    pub(super) tokens: Vec<Token>,
    pub(super) at: usize,
    pub(super) pragmas: Vec<Span>,
    comments: Vec<Span>,
    /// Comments since the element began, and directly before it.
    pub(super) pending: Vec<Span>,
    /// Pragmas since the element began, and before it.
    pub(super) pending_pragmas: Vec<Span>,
    /// In how many actions this chart is.
    pub(super) depth: u32,
    pub(super) diagnostics: Vec<Diagnostic>,
}

pub(super) fn read(source: &Source) -> Reading {
    let cut = cut(&source.text);
    let mut reader = Reader {
        text: &source.text,
        tokens: cut.tokens,
        at: 0,
        pragmas: cut.pragmas,
        comments: cut.comments,
        pending: Vec::new(),
        pending_pragmas: Vec::new(),
        depth: 0,
        diagnostics: Vec::new(),
    };
    let mut found = Vec::new();
    // What the lexer says about the text around charts, the parser of that says, too.
    let mut unit = None;
    while !reader.is_at_end() {
        if reader.begins().is_some() {
            let name = unit.clone().unwrap_or_else(|| program_name(&source.name));
            let (chart, span) = reader.chart_here(&name);
            found.push((chart, Region { span, has_head: unit.is_some() }));
            continue;
        }
        match reader.word(0).to_ascii_uppercase().as_str() {
            "PROGRAM" | "FUNCTION_BLOCK" | "FUNCTION" => unit = Some(reader.word(1).to_owned()),
            "END_PROGRAM" | "END_FUNCTION_BLOCK" | "END_FUNCTION" => unit = None,
            _ => {}
        }
        reader.step();
    }
    let regions: Vec<Region> = found.iter().map(|(_, region)| *region).collect();
    let inside = |span: Span| regions.iter().any(|region| span.is_in(region.span));
    for one in cut.diagnostics {
        if inside(one.span) {
            reader.report(Diagnostic::new(ErrorCode::Syntax, one.span, one.message));
        }
    }
    reader.diagnostics.sort_by_key(|one| one.span);
    reader.diagnostics.dedup_by(|a, b| a.span == b.span && a.message == b.message);
    let settings: Vec<Span> = cut.settings.into_iter().filter(|span| inside(*span)).collect();
    let document = document(&source.text, found, &settings);
    Reading { document, regions, diagnostics: reader.diagnostics }
}

/// What is between charts, without the line break and the indentation that charts bring along.
fn between(mut text: String, is_after: bool) -> String {
    if is_after && text.starts_with(['\n', '\r']) {
        let first = text.find('\n').map_or(1, |at| at + 1);
        text.drain(..first);
    }
    text.truncate(text.trim_end_matches([' ', '\t']).len());
    if !text.is_empty() && !text.ends_with('\n') {
        text.push('\n');
    }
    text
}

/// The pieces of a text. Settings inside of a chart go before it.
fn document(text: &str, found: Vec<(Chart, Region)>, settings: &[Span]) -> Document {
    let mut pieces = Vec::new();
    let mut end = 0;
    let piece = |start: u32, end: u32| Span { start, end }.text(text).to_owned();
    for (chart, Region { span: region, .. }) in found {
        let mut before = between(piece(end, region.start), end > 0);
        for setting in settings.iter().filter(|span| span.is_in(region)) {
            before = format!("{before}{}\n", setting.text(text));
        }
        if !before.is_empty() {
            pieces.push(Piece::Text(before));
        }
        pieces.push(Piece::Chart(chart));
        end = region.end;
    }
    let after = between(piece(end, text.len() as u32), end > 0);
    if !after.trim().is_empty() {
        pieces.push(Piece::Text(after));
    }
    Document { pieces }
}

impl<'t> Reader<'t> {
    pub(super) fn ahead(&self, count: usize) -> Token {
        let end = Token { kind: Kind::End, span: Span::new(self.text.len(), self.text.len()) };
        self.tokens.get(self.at + count).copied().unwrap_or(end)
    }

    pub(super) fn token(&self) -> Token {
        self.ahead(0)
    }

    pub(super) fn is_at_end(&self) -> bool {
        self.token().kind == Kind::End
    }

    /// The word ahead; nothing where there is none.
    pub(super) fn word(&self, count: usize) -> &'t str {
        let token = self.ahead(count);
        if token.kind == Kind::Word { token.span.text(self.text) } else { "" }
    }

    pub(super) fn is_word(&self, word: &str) -> bool {
        self.word(0).eq_ignore_ascii_case(word)
    }

    pub(super) fn take_word(&mut self, word: &str) -> bool {
        let is_there = self.is_word(word);
        if is_there {
            self.step();
        }
        is_there
    }

    pub(super) fn is_sign(&self, sign: &str) -> bool {
        matches!(self.token().kind, Kind::Sign(found) if found == sign)
    }

    pub(super) fn take_sign(&mut self, sign: &str) -> bool {
        let is_there = self.is_sign(sign);
        if is_there {
            self.step();
        }
        is_there
    }

    /// Where the token before ends.
    pub(super) fn end_before(&self) -> usize {
        let before = self.at.checked_sub(1).and_then(|at| self.tokens.get(at));
        before.map_or(0, |token| token.span.end as usize)
    }

    /// The spans of a sorted list between the token before and the one ahead.
    fn in_gap(list: &[Span], start: usize, end: usize) -> &[Span] {
        let first = list.partition_point(|span| (span.start as usize) < start);
        let last = list.partition_point(|span| (span.start as usize) < end);
        list.get(first..last).unwrap_or(&[])
    }

    /// The pragmas before the token ahead.
    pub(super) fn pragmas_here(&self) -> Vec<Span> {
        let end = self.token().span.start as usize;
        Self::in_gap(&self.pragmas, self.end_before(), end).to_vec()
    }

    /// Goes on. Comments that are passed are kept.
    pub(super) fn step(&mut self) -> Token {
        let token = self.token();
        let (start, end) = (self.end_before(), token.span.start as usize);
        let passed = Self::in_gap(&self.comments, start, end);
        self.pending.extend(passed);
        let passed = Self::in_gap(&self.pragmas, start, end);
        self.pending_pragmas.extend(passed);
        self.at = (self.at + 1).min(self.tokens.len());
        token
    }

    pub(super) fn report(&mut self, diagnostic: Diagnostic) {
        self.diagnostics.push(diagnostic);
    }

    /// Whether an element begins here.
    pub(super) fn begins(&self) -> Option<Begin> {
        let next = self.ahead(1).kind;
        let is_named = next == Kind::Word;
        match self.word(0).to_ascii_uppercase().as_str() {
            "INITIAL_STEP" if is_named => Some(Begin::Step { is_initial: true }),
            "STEP" if is_named => Some(Begin::Step { is_initial: false }),
            "ACTION" if is_named => Some(Begin::Action),
            "TRANSITION" if is_named || next == Kind::Sign("(") => Some(Begin::Transition),
            _ => None,
        }
    }

    /// A chart that begins here, and where it is.
    fn chart_here(&mut self, name: &str) -> (Chart, Span) {
        let first = self.token().span.start as usize;
        let start = self.start_of_comment(first);
        self.pending.clear();
        self.pending_pragmas.clear();
        let standard = self.standard(self.end_before(), first);
        let start = standard.map_or(start, |span| start.min(span.start as usize));
        // The first step passes the comments that are in the chart; others stay in the text before.
        let end_before = self.end_before();
        let stays = |span: &Span| span.start as usize >= start || span.end as usize <= end_before;
        self.comments.retain(stays);
        self.pragmas.retain(stays);
        let at = self.at;
        let mut chart = Chart::new(name);
        if let Some(pragma) = standard {
            chart.standard = Standard::Grafcet;
            chart.evolutions_max = self.evolutions_max(pragma);
        }
        self.elements(&mut chart, standard);
        debug_assert!(self.at > at);
        (chart, Span::new(start, self.end_before()))
    }

    /// The pragma `{grafcet}` before a chart.
    fn standard(&self, start: usize, end: usize) -> Option<Span> {
        let list = Self::in_gap(&self.pragmas, start, end).iter();
        let mut found = list.filter(|span| super::pragmas::grafcet(span.text(self.text)).is_some());
        found.next_back().copied()
    }

    /// Where a comment begins that belongs to the first element of a chart: it stands directly
    /// above, without an empty line between.
    fn start_of_comment(&self, first: usize) -> usize {
        let mut start = first;
        for comment in Self::in_gap(&self.comments, self.end_before(), first).iter().rev() {
            let between = self.text.get(comment.end as usize..start).unwrap_or("");
            let begins = comment.start as usize;
            let before = self.text.get(self.end_before()..begins).unwrap_or("");
            let is_alone = self.end_before() == 0 || before.contains('\n');
            if between.matches('\n').count() > 1 || !between.trim().is_empty() || !is_alone {
                break;
            }
            start = begins;
        }
        start
    }

    /// Reports what has a name that something else has: steps and actions share theirs, transitions
    /// have their own. Action blocks have an action once with each qualifier.
    pub(super) fn names_once(&mut self, chart: &Chart) {
        let steps = chart.steps.values().map(|step| (step.name.as_str(), step.origin));
        let actions = chart.actions.values().map(|action| (action.name.as_str(), action.origin));
        let transitions = chart.transitions.values();
        let transitions = transitions.filter_map(|one| Some((one.name.as_deref()?, one.origin)));
        let elements: Vec<(&str, Origin)> = steps.chain(actions).collect();
        for list in [elements, transitions.collect()] {
            let mut seen: HashMap<String, Span> = HashMap::new();
            for (name, Origin(span)) in list {
                let first = *seen.entry(name.to_uppercase()).or_insert(span);
                if first != span {
                    let message = format!("{name}: an element of this name is there already");
                    let twice = Diagnostic::new(ErrorCode::Duplicate, span, message);
                    self.report(twice.related(first, "this one"));
                }
            }
        }
        for step in chart.steps.values() {
            let mut seen = HashSet::new();
            for instance in &step.block {
                if !seen.insert((instance.action, instance.qualifier)) {
                    let message = "this action is in the block already, with this qualifier";
                    let span = instance.origin.0;
                    self.report(Diagnostic::new(ErrorCode::Duplicate, span, message));
                }
            }
        }
    }
}
