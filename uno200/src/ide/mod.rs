//! `uno200 ide`: the page of the IDE from a folder, for browsers on this computer alone. What the
//! page does is in `ide`.

mod page;

use std::fs;
use std::net::{Ipv4Addr, SocketAddr};
use std::path::PathBuf;

use anyhow::{Context, Result, bail, ensure};
use tiny_http::{Method, Request, Response, Server};

use page::{HEADERS, Page};

/// Where a build leaves the page.
const BUILT: &str = "target/ide";

/// What is served, and where.
#[derive(Debug)]
pub struct Settings {
    /// The folder of the page; without it the one that a build leaves.
    pub page: Option<PathBuf>,
    /// Where browsers find it. Only addresses of this computer.
    pub listen: SocketAddr,
    /// Whether a browser is started.
    pub opens: bool,
}

/// Serves the page until the process ends. The first line on standard output is its address.
pub fn serve(settings: &Settings) -> Result<()> {
    let address = settings.listen;
    ensure!(
        address.ip().is_loopback(),
        "{address}: others could reach it; the IDE listens on this computer alone, such as \
         127.0.0.1:8200"
    );
    let page = Page::new(folder(settings.page.clone())?);
    let server = Server::http(address).map_err(|error| anyhow::anyhow!("{address}: {error}"))?;
    let address = server.server_addr().to_ip().unwrap_or(address);
    let url = format!("http://{address}/");
    println!("{url}");
    if settings.opens {
        open_browser(&url);
    }
    loop {
        let request = server.recv().context("the server has ended")?;
        answer(&page, address, request);
    }
}

fn folder(given: Option<PathBuf>) -> Result<PathBuf> {
    let folder = given.unwrap_or_else(|| PathBuf::from(BUILT));
    if !folder.join("index.html").is_file() {
        bail!(
            "{}: the page of the IDE is not there; `cargo xtask ide` builds it in a clone, \
             --page names another folder",
            folder.display()
        );
    }
    Ok(fs::canonicalize(folder)?)
}

/// Answers a request. Who asks under another name than this computer's has been led here by a page
/// of somebody else.
fn answer(page: &Page, address: SocketAddr, request: Request) {
    let host = request.headers().iter().find(|header| header.field.equiv("Host"));
    let is_here = host.is_some_and(|host| is_own(host.value.as_str(), address.port()));
    let is_asking = matches!(request.method(), Method::Get | Method::Head);
    let found = if is_here && is_asking { page.file(request.url()) } else { None };
    let response = match found {
        Some((bytes, kind)) => {
            let response = Response::from_data(bytes);
            let all = HEADERS.iter().copied().chain([("Content-Type", kind)]);
            all.filter_map(|(name, value)| {
                tiny_http::Header::from_bytes(name.as_bytes(), value.as_bytes()).ok()
            })
            .fold(response, Response::with_header)
        }
        None if !is_here => Response::from_string("not for you\n").with_status_code(403),
        None => Response::from_string("there is no such file\n").with_status_code(404),
    };
    // A browser that has gone away misses nothing.
    let _ = request.respond(response);
}

/// Whether a `Host` header names this computer and port.
fn is_own(host: &str, port: u16) -> bool {
    [
        format!("{}:{port}", Ipv4Addr::LOCALHOST),
        format!("localhost:{port}"),
        format!("[::1]:{port}"),
    ]
    .iter()
    .any(|own| own.eq_ignore_ascii_case(host))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_this_computer_is_served() {
        for (host, is_served) in [
            ("127.0.0.1:8200", true),
            ("LocalHost:8200", true),
            ("127.0.0.1:8201", false),
            ("example.org:8200", false),
            ("127.0.0.1", false),
        ] {
            assert_eq!(is_own(host, 8200), is_served, "{host}");
        }
        let listen = "0.0.0.0:8200".parse().unwrap();
        let error = serve(&Settings { page: None, listen, opens: false }).unwrap_err();
        assert!(error.to_string().contains("127.0.0.1"), "{error}");
    }
}
