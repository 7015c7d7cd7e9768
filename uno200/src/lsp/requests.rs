//! The requests: each asks the analysis and converts its answer.

use analysis::Problem;
use lsp_types::request::{
    CodeActionRequest, Completion, DocumentSymbolRequest, Formatting, GotoDefinition, HoverRequest,
    PrepareRenameRequest, References, Rename, Request, SignatureHelpRequest,
};
use lsp_types::{
    CodeActionOrCommand, CodeActionParams, CodeActionResponse, CompletionParams,
    CompletionResponse, DocumentFormattingParams, DocumentSymbolParams, DocumentSymbolResponse,
    GotoDefinitionParams, GotoDefinitionResponse, Hover, HoverParams, Location,
    PrepareRenameResponse, ReferenceParams, RenameParams, SignatureHelp, SignatureHelpParams,
    TextDocumentPositionParams, TextEdit, WorkspaceEdit,
};
use serde_json::Value;

use super::convert;
use super::documents::Documents;
use super::names::name_of;

/// An answer, or why there is none: a sentence.
type Answer = Result<Value, String>;

/// Answers a request; `None` if it is not known.
pub(super) fn answer(documents: &Documents, method: &str, params: Value) -> Option<Answer> {
    Some(match method {
        Completion::METHOD => asked::<Completion>(documents, params, completion),
        HoverRequest::METHOD => asked::<HoverRequest>(documents, params, hover),
        SignatureHelpRequest::METHOD => asked::<SignatureHelpRequest>(documents, params, signature),
        GotoDefinition::METHOD => asked::<GotoDefinition>(documents, params, definition),
        References::METHOD => asked::<References>(documents, params, references),
        PrepareRenameRequest::METHOD => {
            asked::<PrepareRenameRequest>(documents, params, prepare_rename)
        }
        Rename::METHOD => asked::<Rename>(documents, params, rename),
        DocumentSymbolRequest::METHOD => asked::<DocumentSymbolRequest>(documents, params, symbols),
        Formatting::METHOD => asked::<Formatting>(documents, params, format),
        CodeActionRequest::METHOD => asked::<CodeActionRequest>(documents, params, actions),
        _ => return None,
    })
}

/// Reads the question, and writes the answer.
fn asked<R: Request>(
    documents: &Documents,
    params: Value,
    answer: fn(&Documents, R::Params) -> Result<R::Result, String>,
) -> Answer {
    let params = serde_json::from_value(params).map_err(|error| error.to_string())?;
    let answer = answer(documents, params)?;
    serde_json::to_value(answer).map_err(|error| error.to_string())
}

/// A text, and a byte offset in it.
fn place(documents: &Documents, at: &TextDocumentPositionParams) -> (String, usize) {
    let name = name_of(&at.text_document.uri);
    let source = documents.project.source(&name);
    let offset = source.map_or(0, |source| convert::offset(source, at.position));
    (name, offset)
}

fn completion(
    documents: &Documents,
    params: CompletionParams,
) -> Result<Option<CompletionResponse>, String> {
    let (name, offset) = place(documents, &params.text_document_position);
    let Some(source) = documents.project.source(&name) else { return Ok(None) };
    let all = documents.project.completions(&name, offset).into_iter().enumerate();
    let has_snippets = documents.has_snippets;
    let items = all.map(|(place, one)| convert::completion(source, place, has_snippets, one));
    Ok(Some(CompletionResponse::Array(items.collect())))
}

fn hover(documents: &Documents, params: HoverParams) -> Result<Option<Hover>, String> {
    let (name, offset) = place(documents, &params.text_document_position_params);
    let hover = documents.project.hover(&name, offset);
    Ok(documents.project.source(&name).zip(hover).map(|(source, it)| convert::hover(source, it)))
}

fn signature(
    documents: &Documents,
    params: SignatureHelpParams,
) -> Result<Option<SignatureHelp>, String> {
    let (name, offset) = place(documents, &params.text_document_position_params);
    Ok(documents.project.signature(&name, offset).as_ref().map(convert::signature))
}

fn definition(
    documents: &Documents,
    params: GotoDefinitionParams,
) -> Result<Option<GotoDefinitionResponse>, String> {
    let (name, offset) = place(documents, &params.text_document_position_params);
    let found = documents.project.definition(&name, offset);
    Ok(Some(GotoDefinitionResponse::Array(convert::locations(documents, &found))))
}

fn references(
    documents: &Documents,
    params: ReferenceParams,
) -> Result<Option<Vec<Location>>, String> {
    let (name, offset) = place(documents, &params.text_document_position);
    let mut found = documents.project.references(&name, offset);
    if !params.context.include_declaration {
        let declared = documents.project.definition(&name, offset);
        found.retain(|location| !declared.contains(location));
    }
    Ok(Some(convert::locations(documents, &found)))
}

fn prepare_rename(
    documents: &Documents,
    params: TextDocumentPositionParams,
) -> Result<Option<PrepareRenameResponse>, String> {
    let (name, offset) = place(documents, &params);
    let span = documents.project.renamable(&name, offset).map_err(|refusal| refusal.0)?;
    let source = documents.project.source(&name);
    Ok(source.map(|source| PrepareRenameResponse::Range(convert::range(source, span))))
}

fn rename(documents: &Documents, params: RenameParams) -> Result<Option<WorkspaceEdit>, String> {
    let (name, offset) = place(documents, &params.text_document_position);
    let edits = documents.project.rename(&name, offset, &params.new_name);
    let edits = edits.map_err(|refusal| refusal.0)?;
    Ok(Some(convert::workspace_edit(documents, &edits)))
}

fn symbols(
    documents: &Documents,
    params: DocumentSymbolParams,
) -> Result<Option<DocumentSymbolResponse>, String> {
    let name = name_of(&params.text_document.uri);
    let Some(source) = documents.project.source(&name) else { return Ok(None) };
    let parts = documents.project.outline(&name);
    let parts = parts.iter().map(|part| convert::symbol(source, part)).collect();
    Ok(Some(DocumentSymbolResponse::Nested(parts)))
}

fn format(
    documents: &Documents,
    params: DocumentFormattingParams,
) -> Result<Option<Vec<TextEdit>>, String> {
    let name = name_of(&params.text_document.uri);
    let edit = documents.project.format(&name).map_err(|refusal| refusal.0)?;
    let source = documents.project.source(&name);
    let edits = source.zip(edit).map(|(source, edit)| convert::text_edit(source, &edit));
    Ok(Some(edits.into_iter().collect()))
}

/// The fixes of problems in a range.
fn actions(
    documents: &Documents,
    params: CodeActionParams,
) -> Result<Option<CodeActionResponse>, String> {
    let name = name_of(&params.text_document.uri);
    let Some(source) = documents.project.source(&name) else { return Ok(None) };
    let [start, end] =
        [params.range.start, params.range.end].map(|at| convert::offset(source, at) as u32);
    let touches = |problem: &Problem| problem.span.start <= end && start <= problem.span.end;
    let problems = documents.project.problems(&name);
    let fixes = problems.iter().filter(|problem| touches(problem));
    let fixes = fixes.filter_map(|problem| convert::action(documents, &name, source, problem));
    Ok(Some(fixes.map(CodeActionOrCommand::CodeAction).collect()))
}
