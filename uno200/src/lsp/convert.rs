//! Answers as the protocol has them. Its columns count units of UTF-16.

use analysis::{
    Completion, CompletionKind, Edit, FileEdit, Hover, Location, Outline, OutlineKind, Problem,
    Signature,
};
use awl_asm::diagnostic::Severity;
use awl_asm::source::Source;
use lsp_types::{
    CodeAction, CodeActionKind, CompletionItem, CompletionItemKind, CompletionTextEdit, Diagnostic,
    DiagnosticRelatedInformation, DiagnosticSeverity, DocumentChanges, DocumentSymbol,
    Documentation, HoverContents, InsertTextFormat, MarkupContent, MarkupKind, NumberOrString,
    OneOf, OptionalVersionedTextDocumentIdentifier, ParameterInformation, ParameterLabel, Position,
    PublishDiagnosticsParams, Range, SignatureHelp, SignatureInformation, SymbolKind,
    TextDocumentEdit, TextEdit, WorkspaceEdit,
};

use super::documents::Documents;

/// A stretch of a text.
type Span = awl_asm::source::Span;

/// The byte offset of a position. One after the end of its line is that end.
pub(super) fn offset(source: &Source, position: Position) -> usize {
    let line = position.line as usize + 1;
    if line > source.line_count() {
        return source.text.len();
    }
    let span = source.line_span(line);
    let mut units = position.character as usize;
    let mut at = span.start as usize;
    for character in span.text(&source.text).chars() {
        if units < character.len_utf16() {
            break;
        }
        units -= character.len_utf16();
        at += character.len_utf8();
    }
    at
}

/// The position of a byte offset.
pub(super) fn position(source: &Source, offset: usize) -> Position {
    let (line, _) = source.position(offset);
    let start = source.line_span(line).start as usize;
    let before = source.text.get(start..offset.min(source.text.len())).unwrap_or("");
    // An offset between CR and LF is the end of its line.
    let before = before.trim_end_matches(['\r', '\n']);
    Position::new(line as u32 - 1, before.encode_utf16().count() as u32)
}

pub(super) fn range(source: &Source, span: Span) -> Range {
    Range::new(position(source, span.start as usize), position(source, span.end as usize))
}

/// What is wrong with a text that is open.
pub(super) fn problems(documents: &Documents, name: &str) -> Option<PublishDiagnosticsParams> {
    let (uri, version) = documents.version(name)?;
    let source = documents.project.source(name)?;
    let problems = documents.project.problems(name);
    let shown = problems.iter().map(|one| problem(documents, name, source, one)).collect();
    Some(PublishDiagnosticsParams::new(uri, shown, Some(version)))
}

pub(super) fn problem(
    documents: &Documents,
    name: &str,
    source: &Source,
    problem: &Problem,
) -> Diagnostic {
    let severity = match problem.severity {
        Severity::Error => DiagnosticSeverity::ERROR,
        Severity::Warning => DiagnosticSeverity::WARNING,
    };
    let mut message = problem.message.clone();
    for help in &problem.help {
        message += &format!("\n{help}");
    }
    let related = problem.related.iter().filter_map(|(span, words)| {
        let location = lsp_types::Location::new(documents.uri(name)?, range(source, *span));
        Some(DiagnosticRelatedInformation { location, message: words.clone() })
    });
    Diagnostic {
        range: range(source, problem.span),
        severity: Some(severity),
        code: problem.code.map(|code| NumberOrString::String(code.to_owned())),
        source: Some("uno200".to_owned()),
        message,
        related_information: Some(related.collect()),
        ..Diagnostic::default()
    }
}

/// The change that mends a problem.
pub(super) fn action(
    documents: &Documents,
    name: &str,
    source: &Source,
    one: &Problem,
) -> Option<CodeAction> {
    let fix = one.fix.as_ref()?;
    let edit = FileEdit { file: name.to_owned(), edit: fix.edit.clone() };
    Some(CodeAction {
        title: fix.title.clone(),
        kind: Some(CodeActionKind::QUICKFIX),
        diagnostics: Some(vec![problem(documents, name, source, one)]),
        edit: Some(workspace_edit(documents, &[edit])),
        is_preferred: Some(true),
        ..CodeAction::default()
    })
}

pub(super) fn text_edit(source: &Source, edit: &Edit) -> TextEdit {
    TextEdit::new(range(source, edit.span), edit.text.clone())
}

/// Changes of several texts; those of one text together.
pub(super) fn workspace_edit(documents: &Documents, edits: &[FileEdit]) -> WorkspaceEdit {
    let mut changes: Vec<(&str, TextDocumentEdit)> = Vec::new();
    for FileEdit { file, edit } in edits {
        let Some((source, uri)) = documents.project.source(file).zip(documents.uri(file)) else {
            continue;
        };
        let one = OneOf::Left(text_edit(source, edit));
        match changes.iter_mut().find(|(name, _)| name == file) {
            Some((_, change)) => change.edits.push(one),
            None => {
                let version = documents.version(file).map(|(_, version)| version);
                let text_document = OptionalVersionedTextDocumentIdentifier { uri, version };
                changes.push((file, TextDocumentEdit { text_document, edits: vec![one] }));
            }
        }
    }
    let changes = changes.into_iter().map(|(_, change)| change).collect();
    WorkspaceEdit {
        document_changes: Some(DocumentChanges::Edits(changes)),
        ..WorkspaceEdit::default()
    }
}

pub(super) fn locations(documents: &Documents, all: &[Location]) -> Vec<lsp_types::Location> {
    let place = |location: &Location| {
        let source = documents.project.source(&location.file)?;
        let uri = documents.uri(&location.file)?;
        Some(lsp_types::Location::new(uri, range(source, location.span)))
    };
    all.iter().filter_map(place).collect()
}

fn markdown(value: String) -> MarkupContent {
    MarkupContent { kind: MarkupKind::Markdown, value }
}

pub(super) fn hover(source: &Source, hover: Hover) -> lsp_types::Hover {
    let range = Some(range(source, hover.span));
    lsp_types::Hover { contents: HoverContents::Markup(markdown(hover.text)), range }
}

/// What a call takes.
pub(super) fn signature(one: &Signature) -> SignatureHelp {
    let units = |at: usize| one.label.get(..at).unwrap_or("").encode_utf16().count() as u32;
    let parameters = one.parameters.iter().map(|&(start, end)| ParameterInformation {
        label: ParameterLabel::LabelOffsets([units(start), units(end)]),
        documentation: None,
    });
    let active_parameter = one.active.map(|number| number as u32);
    let signature = SignatureInformation {
        label: one.label.clone(),
        documentation: None,
        parameters: Some(parameters.collect()),
        active_parameter,
    };
    SignatureHelp { signatures: vec![signature], active_signature: Some(0), active_parameter }
}

/// A text with holes as editors write it: `$1` for the first, `$0` where it goes on.
fn snippet(text: &str, holes: &[usize]) -> String {
    let mut snippet = String::new();
    let mut start = 0;
    let ends = holes.iter().copied().chain([text.len()]);
    for (number, end) in (1..).zip(ends) {
        let piece = text.get(start..end).unwrap_or("");
        snippet += &piece.replace('\\', "\\\\").replace('$', "\\$").replace('}', "\\}");
        snippet += &match end == text.len() && number > holes.len() {
            true => "$0".to_owned(),
            false => format!("${number}"),
        };
        start = end;
    }
    snippet
}

/// `place` keeps them in their order; `has_snippets`: the editor knows holes.
pub(super) fn completion(
    source: &Source,
    place: usize,
    has_snippets: bool,
    one: Completion,
) -> CompletionItem {
    let kind = match one.kind {
        CompletionKind::Instruction => CompletionItemKind::FUNCTION,
        CompletionKind::Keyword => CompletionItemKind::KEYWORD,
        CompletionKind::Symbol => CompletionItemKind::VARIABLE,
        CompletionKind::Variable => CompletionItemKind::FIELD,
        CompletionKind::Address => CompletionItemKind::CONSTANT,
        CompletionKind::Routine => CompletionItemKind::MODULE,
        CompletionKind::Label => CompletionItemKind::REFERENCE,
        CompletionKind::Value => CompletionItemKind::VALUE,
    };
    let doc = Some(one.doc).filter(|doc| !doc.is_empty());
    let is_snippet = has_snippets && !one.holes.is_empty();
    let mut edit = text_edit(source, &one.edit);
    // What is typed is the beginning of the label, where a template says more.
    let typed = if one.holes.is_empty() { &one.edit.text } else { &one.label };
    let filter_text = Some(typed.clone());
    if is_snippet {
        edit.new_text = snippet(&one.edit.text, &one.holes);
    }
    CompletionItem {
        filter_text,
        insert_text_format: is_snippet.then_some(InsertTextFormat::SNIPPET),
        text_edit: Some(CompletionTextEdit::Edit(edit)),
        label: one.label,
        kind: Some(kind),
        detail: Some(one.detail),
        documentation: doc.map(|doc| Documentation::MarkupContent(markdown(doc))),
        sort_text: Some(format!("{place:05}")),
        ..CompletionItem::default()
    }
}

pub(super) fn symbol(source: &Source, part: &Outline) -> DocumentSymbol {
    let kind = match part.kind {
        OutlineKind::Unit => SymbolKind::MODULE,
        OutlineKind::Network => SymbolKind::NAMESPACE,
        OutlineKind::Label => SymbolKind::KEY,
        OutlineKind::Symbol => SymbolKind::VARIABLE,
    };
    let children = part.children.iter().map(|child| symbol(source, child)).collect();
    #[expect(deprecated, reason = "the type has the old field beside the new one")]
    DocumentSymbol {
        name: part.name.clone(),
        detail: Some(part.detail.clone()),
        kind,
        tags: None,
        deprecated: None,
        range: range(source, part.span),
        selection_range: range(source, part.name_span),
        children: Some(children),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holes_have_numbers() {
        assert_eq!(snippet("IF  THEN\nEND_IF;", &[3, 9]), "IF $1 THEN\n$2END_IF;$0");
        assert_eq!(snippet("F()", &[2]), "F($1)$0");
        assert_eq!(snippet("$a} ", &[4]), "\\$a\\} $1$0");
    }

    #[test]
    fn columns_count_units_of_utf_16() {
        let source = Source::new("t.awl", "ä𝄞x\r\ny\n").unwrap();
        let x = source.text.find('x').unwrap();
        assert_eq!(position(&source, x), Position::new(0, 3));
        assert_eq!(offset(&source, Position::new(0, 3)), x);
        assert_eq!(offset(&source, Position::new(0, 2)), 2, "inside of a pair");
        assert_eq!(offset(&source, Position::new(0, 99)), x + 1);
        assert_eq!(position(&source, x + 2), Position::new(0, 4));
        assert_eq!(offset(&source, Position::new(1, 1)), source.text.len() - 1);
        assert_eq!(offset(&source, Position::new(9, 0)), source.text.len());
    }
}
