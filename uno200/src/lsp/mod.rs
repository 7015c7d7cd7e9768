//! The language server: editors ask, [`analysis`] answers. Here are the protocol, files and the way
//! from one kind of position to the other.

mod convert;
mod documents;
mod names;
mod requests;

use anyhow::{Context as _, Result};
use lsp_server::{Connection, ErrorCode, Message, Notification, Request, Response};
use lsp_types::notification::{
    DidChangeTextDocument, DidChangeWatchedFiles, DidCloseTextDocument, DidOpenTextDocument,
    DidSaveTextDocument, Notification as _, PublishDiagnostics,
};
use lsp_types::{
    CodeActionKind, CodeActionOptions, CodeActionProviderCapability, CompletionOptions,
    HoverProviderCapability, InitializeParams, OneOf, PublishDiagnosticsParams, RenameOptions,
    SaveOptions, ServerCapabilities, SignatureHelpOptions, TextDocumentSyncCapability,
    TextDocumentSyncKind, TextDocumentSyncOptions, TextDocumentSyncSaveOptions,
    WorkDoneProgressOptions,
};
use serde::de::DeserializeOwned;

use documents::Documents;

/// Answers an editor on standard input and output until it says that it is done.
pub fn run() -> Result<()> {
    let (connection, threads) = Connection::stdio();
    serve(&connection)?;
    // The thread that writes ends with the connection.
    drop(connection);
    threads.join().context("the editor does not read any more")
}

/// Answers an editor until it says that it is done, or is gone.
pub fn serve(connection: &Connection) -> Result<()> {
    let capabilities = serde_json::to_value(capabilities())?;
    let asked = connection.initialize(capabilities)?;
    let mut server = Server { connection, documents: Documents::default() };
    server.documents.initialize(&serde_json::from_value::<InitializeParams>(asked)?);
    for message in &connection.receiver {
        match message {
            Message::Request(request) if connection.handle_shutdown(&request)? => break,
            Message::Request(request) => server.request(request)?,
            Message::Notification(notification) => server.notification(notification)?,
            Message::Response(_) => {}
        }
    }
    Ok(())
}

fn capabilities() -> ServerCapabilities {
    let no_progress = WorkDoneProgressOptions::default();
    ServerCapabilities {
        text_document_sync: Some(TextDocumentSyncCapability::Options(TextDocumentSyncOptions {
            open_close: Some(true),
            change: Some(TextDocumentSyncKind::FULL),
            save: Some(TextDocumentSyncSaveOptions::SaveOptions(SaveOptions::default())),
            ..TextDocumentSyncOptions::default()
        })),
        completion_provider: Some(CompletionOptions {
            trigger_characters: Some(
                [" ", "#", "*", "&", ".", "(", "%"].map(str::to_owned).to_vec(),
            ),
            ..CompletionOptions::default()
        }),
        signature_help_provider: Some(SignatureHelpOptions {
            trigger_characters: Some(["(", ","].map(str::to_owned).to_vec()),
            ..SignatureHelpOptions::default()
        }),
        hover_provider: Some(HoverProviderCapability::Simple(true)),
        definition_provider: Some(OneOf::Left(true)),
        references_provider: Some(OneOf::Left(true)),
        document_symbol_provider: Some(OneOf::Left(true)),
        document_formatting_provider: Some(OneOf::Left(true)),
        rename_provider: Some(OneOf::Right(RenameOptions {
            prepare_provider: Some(true),
            work_done_progress_options: no_progress,
        })),
        code_action_provider: Some(CodeActionProviderCapability::Options(CodeActionOptions {
            code_action_kinds: Some(vec![CodeActionKind::QUICKFIX]),
            ..CodeActionOptions::default()
        })),
        ..ServerCapabilities::default()
    }
}

struct Server<'c> {
    connection: &'c Connection,
    documents: Documents,
}

impl Server<'_> {
    fn request(&self, request: Request) -> Result<()> {
        let id = request.id.clone();
        let response = match requests::answer(&self.documents, &request.method, request.params) {
            Some(Ok(answer)) => Response::new_ok(id, answer),
            Some(Err(why)) => Response::new_err(id, ErrorCode::RequestFailed as i32, why),
            None => {
                let why = format!("{}: not known", request.method);
                Response::new_err(id, ErrorCode::MethodNotFound as i32, why)
            }
        };
        self.send(response.into())
    }

    fn notification(&mut self, notification: Notification) -> Result<()> {
        let Notification { method, params } = notification;
        match method.as_str() {
            DidOpenTextDocument::METHOD => {
                let name = read(params).and_then(|params| self.documents.open(params));
                self.tell(name)
            }
            DidChangeTextDocument::METHOD => {
                let name = read(params).and_then(|params| self.documents.change(params));
                self.tell(name)
            }
            DidSaveTextDocument::METHOD => {
                let name = read(params).and_then(|params| self.documents.save(params));
                self.tell(name)
            }
            DidChangeWatchedFiles::METHOD => {
                read(params).into_iter().for_each(|params| self.documents.look_again(params));
                let all = self.documents.open_names();
                all.into_iter().try_for_each(|name| self.publish(&name))
            }
            DidCloseTextDocument::METHOD => {
                let Some(params) = read::<lsp_types::DidCloseTextDocumentParams>(params) else {
                    return Ok(());
                };
                let uri = params.text_document.uri.clone();
                let name = self.documents.close(params);
                self.send_problems(PublishDiagnosticsParams::new(uri, Vec::new(), None))?;
                self.tell(name)
            }
            _ => Ok(()),
        }
    }

    /// Tells what is wrong with a text, and with those that belong to it.
    fn tell(&self, name: Option<String>) -> Result<()> {
        let related = name.map(|name| self.documents.project.related(&name));
        related.into_iter().flatten().try_for_each(|name| self.publish(&name))
    }

    /// Tells what is wrong with a text, if the editor has it open.
    fn publish(&self, name: &str) -> Result<()> {
        match convert::problems(&self.documents, name) {
            Some(params) => self.send_problems(params),
            None => Ok(()),
        }
    }

    fn send_problems(&self, params: PublishDiagnosticsParams) -> Result<()> {
        self.send(Notification::new(PublishDiagnostics::METHOD.to_owned(), params).into())
    }

    fn send(&self, message: Message) -> Result<()> {
        self.connection.sender.send(message).context("the editor is gone")
    }
}

/// What comes with a message; `None` if it is something else than the protocol says.
fn read<T: DeserializeOwned>(params: serde_json::Value) -> Option<T> {
    serde_json::from_value(params).ok()
}
