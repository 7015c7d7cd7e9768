//! The language server as editors see it: messages in, messages out, files in a folder.

use std::fs;
use std::thread::{self, JoinHandle};

use lsp_server::{Connection, Message, Notification, Request};
use lsp_types::Uri;
use serde_json::{Value, json};

/// An editor with a server in this process.
struct Editor {
    connection: Connection,
    server: Option<JoinHandle<()>>,
    folder: tempfile::TempDir,
    next_id: i32,
}

impl Editor {
    /// An editor that has a folder with these files.
    fn new(files: &[(&str, &str)]) -> Editor {
        Editor::with(json!({}), files)
    }

    /// The same for one that can more.
    fn with(capabilities: Value, files: &[(&str, &str)]) -> Editor {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in files {
            fs::write(folder.path().join(name), text).unwrap();
        }
        let (connection, other) = Connection::memory();
        let server = thread::spawn(move || uno200::lsp::serve(&other).unwrap());
        let mut editor = Editor { connection, server: Some(server), folder, next_id: 0 };
        editor.ask("initialize", json!({ "capabilities": capabilities })).unwrap();
        editor.tell("initialized", json!({}));
        editor
    }

    fn uri(&self, name: &str) -> String {
        let path = self.folder.path().join(name).display().to_string();
        let uri: Uri = format!("file://{path}").parse().unwrap();
        uri.as_str().to_owned()
    }

    fn tell(&self, method: &str, params: Value) {
        let message = Notification::new(method.to_owned(), params);
        self.connection.sender.send(message.into()).unwrap();
    }

    /// Asks, and waits for the answer or the reason why there is none.
    fn ask(&mut self, method: &str, params: Value) -> Result<Value, String> {
        self.next_id += 1;
        let request = Request::new(self.next_id.into(), method.to_owned(), params);
        self.connection.sender.send(request.into()).unwrap();
        loop {
            if let Message::Response(response) = self.connection.receiver.recv().unwrap() {
                return response.response_result.map_err(|error| error.message);
            }
        }
    }

    fn open(&self, name: &str, text: &str) {
        let document =
            json!({ "uri": self.uri(name), "languageId": "awl", "version": 1, "text": text });
        self.tell("textDocument/didOpen", json!({ "textDocument": document }));
    }

    /// What the server says next of a text's problems: file, and their messages.
    fn problems(&self) -> (String, Vec<String>) {
        loop {
            let Message::Notification(note) = self.connection.receiver.recv().unwrap() else {
                continue;
            };
            assert_eq!(note.method, "textDocument/publishDiagnostics");
            let uri = note.params["uri"].as_str().unwrap();
            let name = uri.rsplit('/').next().unwrap().to_owned();
            let list = note.params["diagnostics"].as_array().unwrap();
            let message = |one: &Value| one["message"].as_str().unwrap().to_owned();
            return (name, list.iter().map(message).collect());
        }
    }

    /// Asks about a place: the line and column from 0 on.
    fn at(&mut self, method: &str, name: &str, line: u32, column: u32) -> Result<Value, String> {
        let params = json!({
            "textDocument": { "uri": self.uri(name) },
            "position": { "line": line, "character": column },
            "context": { "includeDeclaration": false, "triggerKind": 1, "isRetrigger": false },
            "newName": "Go",
        });
        self.ask(method, params)
    }
}

impl Drop for Editor {
    fn drop(&mut self) {
        // A test that has failed already says more than a server that is gone.
        if !thread::panicking() {
            self.ask("shutdown", Value::Null).unwrap();
            self.tell("exit", Value::Null);
            self.server.take().unwrap().join().unwrap();
        }
    }
}

const PROGRAM: &str = "//# symbol Lamp Q0.0\nLD Start\n= Lamp\n";

#[test]
fn what_is_wrong_is_told_of_all_that_are_open() {
    let editor = Editor::new(&[("m.awl", PROGRAM), ("m.csv", "Start,I0.0\n")]);
    editor.open("m.scn", "at 0ms Start = 1\nat 1s expect Lmap = 1\n");
    let (name, problems) = editor.problems();
    assert_eq!((name.as_str(), problems.len()), ("m.scn", 1), "the program's file is read");
    editor.open("m.awl", PROGRAM);
    assert_eq!(editor.problems(), ("m.awl".to_owned(), vec![]));
    assert_eq!(editor.problems().0, "m.scn");
    // The name that the scenario has is now one of the program.
    let text = PROGRAM.replace("Lamp", "Lmap");
    let document = json!({ "uri": editor.uri("m.awl"), "version": 2 });
    let change = json!({ "textDocument": document, "contentChanges": [{ "text": text }] });
    editor.tell("textDocument/didChange", change);
    assert_eq!(editor.problems(), ("m.awl".to_owned(), vec![]));
    assert_eq!(editor.problems(), ("m.scn".to_owned(), vec![]));
}

#[test]
fn a_fix_for_what_is_wrong() {
    let mut editor = Editor::new(&[]);
    editor.open("m.awl", "// ä𝄞\nLD I0.0\n= Q0.9\n");
    assert_eq!(editor.problems().1.len(), 1);
    let place = json!({ "line": 2, "character": 3 });
    let params = json!({
        "textDocument": { "uri": editor.uri("m.awl") },
        "range": { "start": place, "end": place },
        "context": { "diagnostics": [] },
    });
    let actions = editor.ask("textDocument/codeAction", params).unwrap();
    let edit = &actions[0]["edit"]["documentChanges"][0];
    assert_eq!(edit["textDocument"]["version"], 1);
    assert_eq!(edit["edits"][0]["newText"], "Q1.1");
    assert_eq!(edit["edits"][0]["range"]["start"], json!({ "line": 2, "character": 2 }));
}

#[test]
fn places_in_other_files() {
    let mut editor = Editor::new(&[("m.awl", PROGRAM), ("m.csv", "Start,I0.0\n")]);
    editor.open("m.scn", "at 0ms Start = 1\n");
    let found = editor.at("textDocument/definition", "m.scn", 0, 8).unwrap();
    assert_eq!(found[0]["uri"], editor.uri("m.csv"));
    let found = editor.at("textDocument/references", "m.scn", 0, 8).unwrap();
    assert_eq!(found.as_array().unwrap().len(), 2, "without the declaration");
    let edit = editor.at("textDocument/rename", "m.scn", 0, 8).unwrap();
    assert_eq!(edit["documentChanges"].as_array().unwrap().len(), 3);
    let hover = editor.at("textDocument/hover", "m.scn", 0, 8).unwrap();
    assert!(hover["contents"]["value"].as_str().unwrap().contains("I0.0"), "{hover}");
}

#[test]
fn refusals_have_words() {
    let mut editor = Editor::new(&[]);
    editor.open("m.awl", "LD I0.0\n= Q0.0\nLD 'a\n");
    let why = editor.at("textDocument/prepareRename", "m.awl", 0, 3).unwrap_err();
    assert!(why.contains("is an address"), "{why}");
    let params = json!({
        "textDocument": { "uri": editor.uri("m.awl") },
        "options": { "tabSize": 8, "insertSpaces": true },
    });
    let why = editor.ask("textDocument/formatting", params).unwrap_err();
    assert!(why.contains("errors of form"), "{why}");
    assert!(editor.ask("textDocument/hover", json!({})).is_err());
    assert!(editor.ask("no/such", Value::Null).unwrap_err().contains("not known"));
}

#[test]
fn parts_and_completions() {
    let mut editor = Editor::new(&[]);
    editor.open("m.awl", "NETWORK 1 // x\nLD I0.0\n= Q0.0\nJMP 1\nLBL 1\nMO\n");
    let parts = editor.at("textDocument/documentSymbol", "m.awl", 0, 0).unwrap();
    assert_eq!(parts[0]["name"], "NETWORK 1");
    assert_eq!(parts[0]["children"][0]["name"], "LBL 1");
    let items = editor.at("textDocument/completion", "m.awl", 5, 2).unwrap();
    let item = items.as_array().unwrap().iter().find(|item| item["label"] == "MOVW").unwrap();
    assert_eq!(item["textEdit"]["range"]["start"], json!({ "line": 5, "character": 0 }));
    assert!(item["documentation"]["value"].as_str().unwrap().contains("Operands"), "{item}");
}

#[test]
fn structured_text_of_two_files() {
    let blocks =
        "FUNCTION Twice : INT\nVAR_INPUT x : INT; END_VAR\nTwice := x * 2;\nEND_FUNCTION\n";
    let main = "PROGRAM Main\nVAR n : INT; END_VAR\nn := Twice(n);\nEND_PROGRAM\n";
    let mut editor = Editor::new(&[("blocks.st", blocks)]);
    editor.open("main.st", main);
    assert_eq!(editor.problems(), ("main.st".to_owned(), vec![]), "the other file is read");
    let found = editor.at("textDocument/definition", "main.st", 2, 6).unwrap();
    assert_eq!(found[0]["uri"], editor.uri("blocks.st"));
    let help = editor.at("textDocument/signatureHelp", "main.st", 2, 11).unwrap();
    assert_eq!(help["signatures"][0]["label"], "Twice(x : INT) : INT");
    assert_eq!(help["signatures"][0]["parameters"][0]["label"], json!([6, 13]));
    let edit = editor.at("textDocument/rename", "main.st", 2, 6).unwrap();
    assert_eq!(edit["documentChanges"].as_array().unwrap().len(), 2);
    let uri = editor.uri("main.st");
    let options = json!({ "tabSize": 4, "insertSpaces": true });
    let params = json!({ "textDocument": { "uri": uri }, "options": options });
    let edits = editor.ask("textDocument/formatting", params).unwrap();
    let laid = edits[0]["newText"].as_str().unwrap();
    assert!(laid.starts_with("PROGRAM Main\nVAR\n    n : INT;\nEND_VAR\n"), "{laid}");
    let items = editor.at("textDocument/completion", "main.st", 2, 0).unwrap();
    let items = items.as_array().unwrap();
    let one = |label: &str| items.iter().find(|item| item["label"] == label).unwrap().clone();
    assert_eq!(one("IF")["textEdit"]["newText"], "IF  THEN\n    \nEND_IF;", "no holes are known");
    assert_eq!(one("n")["detail"], "INT");
}

#[test]
fn templates_have_holes_where_the_editor_knows_them() {
    let item = json!({ "snippetSupport": true });
    let mut editor =
        Editor::with(json!({ "textDocument": { "completion": { "completionItem": item } } }), &[]);
    editor.open("main.st", "PROGRAM Main\n\nEND_PROGRAM\n");
    let items = editor.at("textDocument/completion", "main.st", 1, 0).unwrap();
    let item = items.as_array().unwrap().iter().find(|item| item["label"] == "IF").unwrap().clone();
    assert_eq!(item["textEdit"]["newText"], "IF $1 THEN\n    $2\nEND_IF;$0");
    assert_eq!((&item["insertTextFormat"], &item["filterText"]), (&json!(2), &json!("IF")));
}
