//! One request of HTTP on a connection, and its answer; then the connection is closed.

use std::error::Error;
use std::io::{self, Read, Write};
use std::net::TcpStream;
use std::time::Duration;

use tungstenite::handshake::server::{Request, write_response};
use tungstenite::http::{Response, StatusCode};

/// A head is not longer than this.
const HEAD_LEN_MAX: usize = 16 * 1024;
/// Nor has it more headers.
const HEADERS_MAX: usize = 100;
/// Nor does it take longer to come.
const PATIENCE: Duration = Duration::from_secs(10);

/// Reads the head of a request. What comes after it is lost: nothing here has a body.
pub fn read(stream: &mut TcpStream) -> io::Result<Request> {
    stream.set_read_timeout(Some(PATIENCE))?;
    let mut head = Vec::new();
    let mut bytes = [0; 2048];
    while head.len() < HEAD_LEN_MAX {
        let len = stream.read(&mut bytes)?;
        if len == 0 {
            return Err(io::ErrorKind::UnexpectedEof.into());
        }
        head.extend_from_slice(&bytes[..len]);
        if let Some(request) = parse(&head).map_err(io::Error::other)? {
            return Ok(request);
        }
    }
    Err(io::Error::other("the head is too long"))
}

/// The request with this head; none while that is not complete.
fn parse(head: &[u8]) -> Result<Option<Request>, Box<dyn Error + Send + Sync>> {
    let mut headers = [httparse::EMPTY_HEADER; HEADERS_MAX];
    let mut parsed = httparse::Request::new(&mut headers);
    if parsed.parse(head)?.is_partial() {
        return Ok(None);
    }
    let mut request = Request::builder()
        .method(parsed.method.unwrap_or_default())
        .uri(parsed.path.unwrap_or_default());
    for header in parsed.headers.iter() {
        request = request.header(header.name, header.value);
    }
    Ok(Some(request.body(())?))
}

/// A header of a request as text; empty without it.
pub fn header<'a>(request: &'a Request, name: &str) -> &'a str {
    request.headers().get(name).and_then(|value| value.to_str().ok()).unwrap_or_default()
}

/// Answers with some bytes of a kind, or with their length alone.
pub fn answer(
    stream: &mut TcpStream,
    status: StatusCode,
    headers: &[(&str, String)],
    body: &[u8],
    is_head: bool,
) -> io::Result<()> {
    let mut response = Response::builder()
        .status(status)
        .header("Content-Length", body.len())
        .header("Connection", "close");
    for (name, value) in headers {
        response = response.header(*name, value);
    }
    let response = response.body(()).map_err(io::Error::other)?;
    let mut head = Vec::new();
    write_response(&mut head, &response).map_err(io::Error::other)?;
    stream.write_all(&head)?;
    if is_head { Ok(()) } else { stream.write_all(body) }
}
