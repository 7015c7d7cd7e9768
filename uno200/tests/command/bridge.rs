//! The bridge of `uno200 ide` as a page sees it, and as pages see it that are not meant.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use serde_json::{Value, json};
use tungstenite::client::client_with_config;
use tungstenite::handshake::client::generate_key;
use tungstenite::http::Request;
use tungstenite::{Message, WebSocket};

use super::Test;

/// A server with its page; it ends with this.
struct Ide {
    process: Child,
    address: SocketAddr,
    token: String,
    _folder: tempfile::TempDir,
}

impl Ide {
    fn start(arguments: &[&str]) -> Ide {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("index.html"), "<p>the page").unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_uno200"));
        command.args(["ide", "--no-open", "--listen", "127.0.0.1:0", "--page"]);
        command.arg(folder.path()).args(arguments).stdout(Stdio::piped());
        let mut process = command.spawn().unwrap();
        let mut line = String::new();
        BufReader::new(process.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let (address, token) = line.trim().split_once("/?token=").expect(&line);
        let address = address.strip_prefix("http://").unwrap().parse().unwrap();
        Ide { process, address, token: token.to_owned(), _folder: folder }
    }

    /// What a server with a PLC on the network has.
    fn with(plc: &Test) -> (Ide, String) {
        let plc = plc.plc.address.to_string();
        (Ide::start(&["--tcp", &plc]), plc)
    }

    /// A connection from a page of `origin` that asks for this host.
    fn connect(&self, host: &str, origin: Option<&str>) -> Result<Page, u16> {
        let stream = TcpStream::connect(self.address).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(10))).unwrap();
        let mut request = Request::builder()
            .uri(format!("ws://{}/bridge", self.address))
            .header("Host", host)
            .header("Connection", "Upgrade")
            .header("Upgrade", "websocket")
            .header("Sec-WebSocket-Version", "13")
            .header("Sec-WebSocket-Key", generate_key());
        if let Some(origin) = origin {
            request = request.header("Origin", origin);
        }
        match client_with_config(request.body(()).unwrap(), stream, None) {
            Ok((socket, _)) => Ok(Page(socket)),
            Err(tungstenite::HandshakeError::Failure(tungstenite::Error::Http(response))) => {
                Err(response.status().as_u16())
            }
            Err(error) => panic!("{error}"),
        }
    }

    /// A connection from the page itself.
    fn page(&self) -> Page {
        let host = self.address.to_string();
        self.connect(&host, Some(&format!("http://{host}"))).unwrap()
    }

    /// The same, after the token was exchanged.
    fn welcome(&self) -> Page {
        let mut page = self.page();
        let told = page.ask(json!({ "do": "hello", "token": self.token }));
        assert_eq!(told["is"], "welcome", "{told}");
        page
    }
}

impl Drop for Ide {
    fn drop(&mut self) {
        self.process.kill().unwrap();
        self.process.wait().unwrap();
    }
}

struct Page(WebSocket<TcpStream>);

impl Page {
    fn ask(&mut self, wish: Value) -> Value {
        self.0.send(Message::text(wish.to_string())).unwrap();
        self.told()
    }

    fn told(&mut self) -> Value {
        match self.0.read().unwrap() {
            Message::Text(text) => serde_json::from_str(&text).unwrap(),
            other => panic!("{other:?}"),
        }
    }

    /// What it is refused with.
    fn refusal(&mut self, wish: Value) -> String {
        let told = self.ask(wish);
        assert_eq!(told["is"], "refused", "{told}");
        told["message"].as_str().unwrap().to_owned()
    }

    /// Whether nothing more can be asked.
    fn is_closed(&mut self) -> bool {
        let _ = self.0.send(Message::text(json!({ "do": "ports" }).to_string()));
        matches!(self.0.read(), Ok(Message::Close(_)) | Err(_))
    }

    /// Bytes to the port, and as many as come back.
    fn exchange(&mut self, bytes: &[u8], len: usize) -> Vec<u8> {
        self.0.send(Message::binary(bytes.to_vec())).unwrap();
        let mut answer = Vec::new();
        while answer.len() < len {
            match self.0.read().unwrap() {
                Message::Binary(bytes) => answer.extend_from_slice(&bytes),
                other => panic!("{other:?}"),
            }
        }
        answer
    }
}

/// Modbus TCP: reads the first holding register of unit 1, and the head of its answer.
const READ: [u8; 12] = [0, 7, 0, 0, 0, 6, 1, 3, 0, 0, 0, 1];
const ANSWER: [u8; 9] = [0, 7, 0, 0, 0, 5, 1, 3, 2];

#[test]
fn bytes_to_a_plc_and_back() {
    let plc = Test::new();
    let (ide, name) = Ide::with(&plc);
    let mut page = ide.welcome();
    let ports = page.ask(json!({ "do": "ports" }));
    assert_eq!(ports["ports"][0], json!({ "name": name, "kind": "tcp" }));
    assert_eq!(page.ask(json!({ "do": "open", "name": name }))["is"], "done");
    for _ in 0..50 {
        let answer = page.exchange(&READ, ANSWER.len() + 2);
        assert_eq!(answer[..ANSWER.len()], ANSWER);
    }
    assert_eq!(page.ask(json!({ "do": "close" }))["is"], "done");
    // To a port that is closed bytes go nowhere.
    page.0.send(Message::binary(READ.to_vec())).unwrap();
    assert_eq!(page.ask(json!({ "do": "ports" }))["is"], "ports");
}

#[test]
fn a_token_is_good_for_once_and_its_session_comes_back() {
    let ide = Ide::start(&[]);
    for wrong in [json!({ "do": "hello", "token": "0" }), json!({ "do": "ports" }), json!(7)] {
        let mut page = ide.page();
        assert!(!page.refusal(wrong).is_empty());
        assert!(page.is_closed());
    }
    let mut first = ide.page();
    let told = first.ask(json!({ "do": "hello", "token": ide.token }));
    let session = told["session"].as_str().unwrap();
    let mut second = ide.page();
    assert!(second.refusal(json!({ "do": "hello", "token": ide.token })).contains("already"));
    assert!(second.is_closed());
    let mut later = ide.page();
    assert_eq!(later.ask(json!({ "do": "hello", "session": session }))["is"], "welcome");
    let mut wrong = ide.page();
    assert!(wrong.refusal(json!({ "do": "hello", "session": ide.token })).contains("address"));
    assert!(wrong.is_closed());
}

#[test]
fn no_page_of_others_gets_through() {
    let ide = Ide::start(&[]);
    let host = ide.address.to_string();
    let own = format!("http://{host}");
    for (host, origin) in [
        (&*host, Some("http://example.org")),
        (&*host, Some("null")),
        (&*host, None),
        ("example.org", Some("http://example.org")),
        ("example.org", Some(&*own)),
    ] {
        assert_eq!(ide.connect(host, origin).err(), Some(403), "{host} {origin:?}");
    }
    // None of that has used up the token.
    ide.welcome();
}

/// The answer to a request that is written out.
fn plain(ide: &Ide, head: &str) -> String {
    let mut stream = TcpStream::connect(ide.address).unwrap();
    let head = head.replace("HERE", &ide.address.to_string());
    stream.write_all(format!("{head}\r\n\r\n").as_bytes()).unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    answer
}

#[test]
fn files_are_given_to_this_computer_alone() {
    let ide = Ide::start(&[]);
    let page = plain(&ide, "GET /?token=1 HTTP/1.1\r\nHost: HERE");
    assert!(
        page.starts_with("HTTP/1.1 200 OK\r\n") && page.ends_with("\r\n\r\n<p>the page"),
        "{page}"
    );
    let policy = format!("connect-src 'self' ws://{};", ide.address);
    assert!(page.contains(&policy) && page.contains("default-src 'self'"), "{page}");
    let head = plain(&ide, "HEAD / HTTP/1.1\r\nHost: HERE");
    assert!(head.contains("content-length: 11\r\n") && head.ends_with("\r\n\r\n"), "{head}");
    for (request, status) in [
        ("GET / HTTP/1.1\r\nHost: example.org", "403"),
        ("GET / HTTP/1.1", "403"),
        ("POST / HTTP/1.1\r\nHost: HERE", "404"),
        ("GET /../index.html HTTP/1.1\r\nHost: HERE", "404"),
        ("GET /nothing.html HTTP/1.1\r\nHost: HERE", "404"),
        ("GET /bridge HTTP/1.1\r\nHost: HERE", "403"),
    ] {
        let answer = plain(&ide, request);
        assert!(answer.starts_with(&format!("HTTP/1.1 {status}")), "{request}: {answer}");
    }
    // What is no request is not answered, and harms nobody.
    for nonsense in ["\0\x01\x02", "GET", &"x".repeat(40_000)] {
        let mut stream = TcpStream::connect(ide.address).unwrap();
        let _ = stream.write_all(nonsense.as_bytes());
    }
    assert!(plain(&ide, "GET / HTTP/1.1\r\nHost: HERE").contains("200 OK"));
}

#[test]
fn ports_that_are_not_listed_are_not_opened() {
    let plc = Test::new();
    let ide = Ide::start(&[]);
    let mut page = ide.welcome();
    for name in ["/dev/null", &plc.plc.address.to_string(), "/etc/passwd", ""] {
        let message = page.refusal(json!({ "do": "open", "name": name }));
        assert!(message.contains("no port of this computer"), "{message}");
    }
    let message = page.refusal(json!({ "do": "lines", "on": false }));
    assert!(message.contains("no port is open"), "{message}");
    assert!(page.refusal(json!({ "do": "run", "name": "/bin/sh" })).contains("no message"));
    // It goes on nevertheless.
    assert_eq!(page.ask(json!({ "do": "ports" }))["is"], "ports");
}

#[test]
fn a_port_is_for_one_page_at_a_time() {
    let plc = Test::new();
    let (ide, name) = Ide::with(&plc);
    let open = json!({ "do": "open", "name": name });
    let mut one = ide.page();
    let session = one.ask(json!({ "do": "hello", "token": ide.token }))["session"].clone();
    assert_eq!(one.ask(open.clone())["is"], "done");
    let mut other = ide.page();
    other.ask(json!({ "do": "hello", "session": session }));
    assert!(other.refusal(open.clone()).contains("another page"));
    // Opened again by the same page, it is closed before.
    assert_eq!(one.ask(open.clone())["is"], "done");
    one.0.close(None).unwrap();
    while one.0.read().is_ok() {}
    drop(one);
    let is_free = (0..100).any(|_| {
        std::thread::sleep(Duration::from_millis(20));
        other.ask(open.clone())["is"] == "done"
    });
    assert!(is_free, "a page that is gone holds the port");
}

#[test]
fn a_plc_that_goes_away_is_told() {
    let listener = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let name = listener.local_addr().unwrap().to_string();
    let ide = Ide::start(&["--tcp", &name]);
    let mut page = ide.welcome();
    assert_eq!(page.ask(json!({ "do": "open", "name": name }))["is"], "done");
    drop(listener.accept().unwrap());
    let told = page.told();
    assert_eq!(
        (&told["is"], &told["message"]),
        (&json!("lost"), &json!("the other end has closed it"))
    );
    drop(listener);
    let message = page.refusal(json!({ "do": "open", "name": name }));
    assert!(message.contains("nothing listens there"), "{message}");
}

#[test]
fn other_computers_are_not_served() {
    let mut command = Command::new(env!("CARGO_BIN_EXE_uno200"));
    let output = command.args(["ide", "--no-open", "--listen", "0.0.0.0:0"]).output().unwrap();
    let errors = String::from_utf8(output.stderr).unwrap();
    assert_eq!((output.status.code(), errors.contains("this computer alone")), (Some(2), true));
    assert!(output.stdout.is_empty());
}

#[test]
fn a_folder_is_read_and_written_and_nothing_beside_it() {
    let outer = tempfile::tempdir().unwrap();
    let folder = outer.path().join("lamp");
    std::fs::create_dir(&folder).unwrap();
    std::fs::write(folder.join("lamp.awl"), "LD I0.0\n").unwrap();
    std::fs::write(outer.path().join("secret.txt"), "secret").unwrap();
    let ide = Ide::start(&[folder.to_str().unwrap()]);
    let mut page = ide.page();
    assert!(page.refusal(json!({ "do": "folder" })).contains("hello"), "before the token");
    let mut page = ide.page();
    let told = page.ask(json!({ "do": "hello", "token": ide.token }));
    assert_eq!((&told["is"], &told["folder"]), (&json!("welcome"), &json!(true)));
    let told = page.ask(json!({ "do": "folder" }));
    assert_eq!((&told["is"], &told["name"]), (&json!("folder"), &json!("lamp")));
    assert_eq!(told["files"][0]["name"], "lamp.awl");
    let told = page.ask(json!({ "do": "read", "file": "lamp.awl" }));
    assert_eq!((&told["is"], &told["text"]), (&json!("file"), &json!("LD I0.0\n")));
    let base = &told["version"];
    // More than a message without a folder may hold.
    let text = "LD I0.1 // \"\n".repeat(20_000);
    let save = json!({ "do": "save", "file": "lamp.awl", "text": text, "base": base });
    let saved = page.ask(save.clone());
    assert_eq!(saved["is"], "saved", "{saved}");
    assert_eq!(std::fs::read_to_string(folder.join("lamp.awl")).unwrap(), text);
    let changed = page.ask(save);
    assert_eq!((&changed["is"], &changed["version"]), (&json!("changed"), &saved["version"]));
    let secret = json!({ "do": "read", "file": "../secret.txt" });
    assert!(page.refusal(secret).contains("cannot be the name"));
    let removed = json!({ "do": "remove", "file": "lamp.awl", "base": saved["version"] });
    assert_eq!(page.ask(removed)["is"], "saved");
    assert!(!folder.join("lamp.awl").exists());
}

#[test]
fn without_a_folder_no_file_is_reached() {
    let ide = Ide::start(&[]);
    let mut page = ide.welcome();
    for wish in [json!({ "do": "folder" }), json!({ "do": "read", "file": "lamp.awl" })] {
        assert!(page.refusal(wish).contains("no folder was given"));
    }
    for folder in ["/nowhere/at/all", file!()] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_uno200"));
        let output = command.args(["ide", "--no-open", folder]).output().unwrap();
        let errors = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(2) && errors.contains(folder), "{errors}");
    }
}
