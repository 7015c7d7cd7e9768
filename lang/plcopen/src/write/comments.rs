//! The comments of a text that are neither in charts nor between statements: each belongs to a
//! declaration, a unit, or the file.

use std::collections::BTreeMap;

use ::chart::text::Reading;
use diagnostics::{Source, Span};
use st::tree::{Declaration, File, TypeTextKind};

use super::units::{body_of, head_of};

/// Comments by the place of the name to which they belong.
pub(super) struct Comments {
    of: BTreeMap<u32, String>,
    of_file: String,
}

/// Something that can have a comment.
struct Anchor {
    /// Its name.
    at: Span,
    /// The unit in which it is, or that it is.
    unit: Option<Span>,
    is_variable: bool,
}

impl Comments {
    pub(super) fn of(source: &Source, file: &File, reading: &Reading) -> Comments {
        let text = &source.text;
        let charts: Vec<Span> = reading.regions.iter().map(|region| region.span).collect();
        let is_chart = |span: Span| charts.iter().any(|chart| span.is_in(*chart));
        let anchors = anchors(file, &charts);
        let bodies: Vec<Span> = file
            .units
            .iter()
            .filter(|unit| !charts.iter().any(|chart| chart.is_in(unit.span)))
            .map(|unit| body_of(text, unit))
            .collect();
        let cut = st::lexer::cut(text);
        let tokens: Vec<Span> = cut.tokens.iter().map(|token| token.span).collect();
        let first = tokens.first().map_or(u32::MAX, |token| token.start);
        let mut comments = Comments { of: BTreeMap::new(), of_file: String::new() };
        for span in cut.comments {
            if is_chart(span) || bodies.iter().any(|body| span.is_in(*body)) {
                continue;
            }
            let owner = owner(text, &anchors, file, &tokens, span);
            let list = match owner.filter(|_| span.start > first) {
                Some(owner) => comments.of.entry(owner).or_default(),
                None => &mut comments.of_file,
            };
            let gap = if list.is_empty() { "" } else { "\n" };
            *list += &format!("{gap}{}", bare(span.text(text)));
        }
        comments
    }

    /// The comment of what has its name there.
    pub(super) fn at(&self, name: Span) -> &str {
        self.of.get(&name.start).map_or("", String::as_str)
    }

    pub(super) fn of_file(&self) -> &str {
        &self.of_file
    }
}

/// A comment without its signs.
pub(super) fn bare(comment: &str) -> String {
    let inside = comment.strip_prefix("//").or_else(|| {
        let block = comment.strip_prefix("(*").and_then(|rest| rest.strip_suffix("*)"));
        block.or_else(|| comment.strip_prefix("/*").and_then(|rest| rest.strip_suffix("*/")))
    });
    let lines = inside.unwrap_or(comment).trim().lines().map(str::trim);
    lines.collect::<Vec<_>>().join("\n")
}

fn anchors(file: &File, charts: &[Span]) -> Vec<Anchor> {
    let mut all = Vec::new();
    let mut add = |list: &[Declaration], unit: Option<Span>| {
        let names = list.iter().flat_map(|one| &one.names).map(|name| name.span);
        // What charts declare by use has its place in them.
        let declared = names.filter(|name| !charts.iter().any(|chart| name.is_in(*chart)));
        all.extend(declared.map(|at| Anchor { at, unit, is_variable: true }));
    };
    for section in &file.globals {
        add(&section.declarations, None);
    }
    for declared in &file.types {
        if let TypeTextKind::Struct(members) = &declared.of_type.kind {
            add(members, None);
        }
    }
    for unit in &file.units {
        unit.sections.iter().for_each(|one| add(&one.declarations, Some(unit.span)));
    }
    let types = file.types.iter().map(|one| (one.name.span, None));
    let units = file.units.iter().map(|one| (one.name.span, Some(one.span)));
    all.extend(types.chain(units).map(|(at, unit)| Anchor { at, unit, is_variable: false }));
    all.sort_by_key(|anchor| anchor.at.start);
    all
}

/// The place of the name to which a comment belongs.
fn owner(
    text: &str,
    anchors: &[Anchor],
    file: &File,
    tokens: &[Span],
    comment: Span,
) -> Option<u32> {
    let after = anchors.partition_point(|anchor| anchor.at.start < comment.start);
    let before = after.checked_sub(1).and_then(|at| anchors.get(at));
    let is_beside = |end: u32| {
        let between = text.get(end as usize..comment.start as usize).unwrap_or("\n");
        !between.contains('\n')
    };
    let ended = file.types.iter().rfind(|one| one.span.end <= comment.start);
    // Nothing that can have a comment is between the type and this one.
    let is_last = |end: u32| before.is_none_or(|anchor| anchor.at.start < end);
    let ended = ended.filter(|one| is_beside(one.span.end) && is_last(one.span.end));
    let around = file.units.iter().find(|unit| comment.is_in(unit.span));
    let headed = around.filter(|unit| {
        let head = head_of(unit);
        let first = tokens.partition_point(|token| token.start < head);
        tokens.get(first).is_none_or(|token| token.start > comment.start)
    });
    let beside = before.filter(|anchor| anchor.is_variable && is_beside(anchor.at.end));
    let next =
        anchors.get(after).filter(|next| around.is_none_or(|unit| next.unit == Some(unit.span)));
    let place = |anchor: &Anchor| anchor.at.start;
    let own = ended.map(|one| &one.name).or(headed.map(|unit| &unit.name));
    let found = own.map(|name| name.span.start).or(beside.or(next).map(place));
    // After a unit it is the unit's, not that of its last variable.
    let ended = file.units.iter().rfind(|unit| unit.span.end <= comment.start);
    let ended = ended.filter(|unit| is_last(unit.span.end));
    found.or(around.or(ended).map(|unit| unit.name.span.start)).or(before.map(place))
}
