//! `uno200 ide`: the page of the IDE, for browsers on this computer alone, and the bridge through
//! which that page reaches ports and a folder. What the page does is in `ide`.

mod access;
pub mod bridge;
pub mod folder;
mod http;
mod page;

use std::fs;
use std::net::{SocketAddr, TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread;
use std::time::Duration;

use anyhow::{Context, Result, bail, ensure};
use tungstenite::handshake::server::{Request, create_response, write_response};
use tungstenite::http::{Method, StatusCode};

use access::Access;
use bridge::protocol::{Kind, Port};
use bridge::{Ports, Reach};
use folder::Folder;
use page::Page;

/// Before the next connection where one could not be taken.
const RESPITE: Duration = Duration::from_millis(50);

/// What is served, and where.
#[derive(Debug)]
pub struct Settings {
    /// The folder that is the project.
    pub folder: Option<PathBuf>,
    /// The folder of another page than the one that is part of this program.
    pub page: Option<PathBuf>,
    /// Where browsers find it. Only addresses of this computer.
    pub listen: SocketAddr,
    /// A serial port that the bridge opens besides those that the system lists.
    pub port: Option<String>,
    /// A PLC on the network that it connects to, `HOST:PORT`.
    pub tcp: Option<String>,
}

/// A server that is there, and serves when it is [run](Self::run).
#[derive(Debug)]
pub struct Server {
    listener: TcpListener,
    url: String,
    site: Arc<Site>,
}

/// What all connections share.
#[derive(Debug)]
struct Site {
    page: Page,
    access: Access,
    reach: Reach,
}

/// Serves the page until the process ends. The first line on standard output is its address.
pub fn serve(settings: &Settings, opens: bool) -> Result<()> {
    let server = Server::new(settings)?;
    println!("{}", server.url());
    if opens {
        open_browser(server.url());
    }
    server.run()
}

impl Server {
    /// Listens.
    pub fn new(settings: &Settings) -> Result<Server> {
        let address = settings.listen;
        ensure!(
            address.ip().is_loopback(),
            "{address}: others could reach it; the IDE listens on this computer alone, such as \
             127.0.0.1:8200"
        );
        let project = settings.folder.as_deref().map(Folder::new).transpose()?;
        let page = settings.page.as_deref().map_or_else(|| Ok(Page::own()), other_page)?;
        let listener = TcpListener::bind(address).with_context(|| format!("{address}"))?;
        let address = listener.local_addr()?;
        let (access, token) = Access::new(address.port())?;
        let serial = settings.port.iter().map(|name| (name, Kind::Serial));
        let tcp = settings.tcp.iter().map(|name| (name, Kind::Tcp));
        let named = serial.chain(tcp).map(|(name, kind)| Port { name: name.clone(), kind });
        let reach = Reach { ports: Arc::new(Ports::new(named.collect())), folder: project };
        let url = format!("http://{address}/?token={token}");
        Ok(Server { listener, url, site: Arc::new(Site { page, access, reach }) })
    }

    /// The address with the token that is good for once. A fragment can be appended.
    pub fn url(&self) -> &str {
        &self.url
    }

    /// Serves until the process ends.
    pub fn run(&self) -> ! {
        loop {
            let Ok((stream, _)) = self.listener.accept() else {
                // One that was given up, or too many for the system: the next one is served.
                thread::sleep(RESPITE);
                continue;
            };
            let site = Arc::clone(&self.site);
            // A browser that has gone away misses nothing; one that is not answered asks again.
            let _ = thread::Builder::new().spawn(move || site.answer(stream));
        }
    }
}

impl Site {
    /// Answers the request of a connection, or is the bridge for it.
    fn answer(&self, mut stream: TcpStream) -> std::io::Result<()> {
        let request = http::read(&mut stream)?;
        if self.access.is_here(&request) && request.uri().path() == bridge::PATH {
            return self.open_bridge(stream, &request);
        }
        let is_head = request.method() == Method::HEAD;
        let is_asking = is_head || request.method() == Method::GET;
        let (status, bytes, kind) = match self.page.file(request.uri().path()) {
            _ if !self.access.is_here(&request) => refusal(StatusCode::FORBIDDEN),
            Some((bytes, kind)) if is_asking => (StatusCode::OK, bytes, kind),
            _ => refusal(StatusCode::NOT_FOUND),
        };
        let mut headers = page::headers(http::header(&request, "Host"));
        headers.push(("Content-Type", kind.to_owned()));
        http::answer(&mut stream, status, &headers, &bytes, is_head)
    }

    fn open_bridge(&self, mut stream: TcpStream, request: &Request) -> std::io::Result<()> {
        let response = create_response(request).ok().filter(|_| self.access.is_own_page(request));
        let Some(response) = response else {
            let (status, bytes, _) = refusal(StatusCode::FORBIDDEN);
            return http::answer(&mut stream, status, &[], &bytes, false);
        };
        let mut head = Vec::new();
        write_response(&mut head, &response).map_err(std::io::Error::other)?;
        std::io::Write::write_all(&mut stream, &head)?;
        bridge::serve(stream, &self.access, &self.reach)
    }
}

fn refusal(status: StatusCode) -> (StatusCode, Vec<u8>, &'static str) {
    let text = if status == StatusCode::FORBIDDEN { "not for you\n" } else { "no such file\n" };
    (status, text.as_bytes().to_vec(), "text/plain; charset=utf-8")
}

/// The page in a folder.
fn other_page(folder: &Path) -> Result<Page> {
    if !folder.join("index.html").is_file() {
        bail!(
            "{}: the page of the IDE is not there; `cargo xtask ide` builds it in a clone, into \
             target/ide",
            folder.display()
        );
    }
    Ok(Page::In(fs::canonicalize(folder)?))
}

/// Starts the browser. Who has none has the address.
fn open_browser(url: &str) {
    let (program, arguments): (&str, &[&str]) = match std::env::consts::OS {
        "windows" => ("cmd", &["/C", "start", ""]),
        "macos" => ("open", &[]),
        _ => ("xdg-open", &[]),
    };
    let started = std::process::Command::new(program)
        .args(arguments)
        .arg(url)
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::null())
        .spawn();
    if started.is_err() {
        eprintln!("no browser could be started: open the address by hand");
    }
}
