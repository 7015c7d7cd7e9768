//! Programs, functions and function blocks, each with its body.

use ::chart::Chart;
use ::chart::text::Reading;
use diagnostics::Span;
use st::lexer::{Kind, cut};
use st::tree::{File, SectionKind, Unit, UnitKind};

use super::Project;
use super::comments::Comments;

/// A unit: what is declared of it, and its chart; at least one of them.
pub(super) struct Written<'f> {
    unit: Option<&'f Unit>,
    chart: Option<&'f Chart>,
}

/// The units in the order of the text. A chart without a head is a program.
pub(super) fn units<'f>(file: &'f File, reading: &'f Reading) -> Vec<Written<'f>> {
    let charts: Vec<_> = reading.document.charts().zip(&reading.regions).collect();
    let mut all: Vec<(u32, Written)> = Vec::new();
    for unit in &file.units {
        let chart = charts.iter().find(|(_, region)| {
            unit.span.start < region.span.start && region.span.end < unit.span.end
        });
        let chart = chart.map(|(chart, _)| *chart);
        all.push((unit.span.start, Written { unit: Some(unit), chart }));
    }
    for (chart, region) in charts.iter().filter(|(_, region)| !region.has_head) {
        all.push((region.span.start, Written { unit: None, chart: Some(chart) }));
    }
    all.sort_by_key(|(start, _)| *start);
    all.into_iter().map(|(_, unit)| unit).collect()
}

/// Where the head of a unit ends.
pub(super) fn head_of(unit: &Unit) -> u32 {
    match &unit.kind {
        UnitKind::Function(result) => result.span.end,
        UnitKind::Program | UnitKind::Block => unit.name.span.end,
    }
}

/// The statements of a unit, with the comments between them.
pub(super) fn body_of(text: &str, unit: &Unit) -> Span {
    let all = cut(unit.span.text(text));
    let is_word = |kind: Kind, span: Span, word: &str| {
        kind == Kind::Word && span.text(unit.span.text(text)).eq_ignore_ascii_case(word)
    };
    let mut declared = all.tokens.iter().filter(|one| is_word(one.kind, one.span, "END_VAR"));
    let start = declared.next_back().map_or(head_of(unit), |one| unit.span.start + one.span.end);
    let mut words = all.tokens.iter().filter(|one| one.kind == Kind::Word);
    let end = words.next_back().map_or(unit.span.end, |one| unit.span.start + one.span.start);
    Span { start, end: end.max(start) }
}

impl Written<'_> {
    pub(super) fn is_program(&self) -> bool {
        self.unit.is_none_or(|unit| matches!(unit.kind, UnitKind::Program))
    }

    pub(super) fn name(&self) -> &str {
        let of_chart = self.chart.map_or("", |chart| chart.name.as_str());
        self.unit.map_or(of_chart, |unit| unit.name.text.as_str())
    }
}

impl Project<'_> {
    pub(super) fn unit(&mut self, written: &Written, comments: &Comments) {
        let kind = match written.unit.map(|unit| &unit.kind) {
            None | Some(UnitKind::Program) => "program",
            Some(UnitKind::Function(_)) => "function",
            Some(UnitKind::Block) => "functionBlock",
        };
        self.open("pou", &[("name", written.name()), ("pouType", kind)]);
        self.open("interface", &[]);
        if let Some(unit) = written.unit {
            if let UnitKind::Function(result) = &unit.kind {
                self.inside("returnType", result, comments);
            }
            for section in &unit.sections {
                let list = match section.kind {
                    SectionKind::Var => "localVars",
                    SectionKind::Input => "inputVars",
                    SectionKind::Output => "outputVars",
                    SectionKind::InOut => "inOutVars",
                    SectionKind::Temp => "tempVars",
                    SectionKind::Global => "globalVars",
                    SectionKind::External => "externalVars",
                };
                self.section(list, section, comments);
            }
        }
        self.close();
        match (written.chart, written.unit) {
            (Some(chart), _) => self.chart(chart),
            (None, Some(unit)) => match self.sheet(unit) {
                Some(sheet) => self.diagram(unit, sheet),
                None => {
                    let text = self.text(body_of(&self.source.text, unit)).trim().to_owned();
                    self.statements(&text);
                }
            },
            (None, None) => {}
        }
        self.documentation(written.unit.map_or("", |unit| comments.at(unit.name.span)));
        self.close();
    }

    /// A body in Structured Text.
    pub(super) fn statements(&mut self, text: &str) {
        self.open("body", &[]);
        self.structured_text(text);
        self.close();
    }

    pub(super) fn structured_text(&mut self, text: &str) {
        self.open("ST", &[]);
        self.out.text("xhtml:p", &[], text);
        self.close();
    }
}
