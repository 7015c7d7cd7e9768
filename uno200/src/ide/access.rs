//! Who may use the bridge: the page that was opened with the address that was printed. The token in
//! it is good for once; whoever brings it gets the key of a session, and comes back with that.

use std::net::Ipv4Addr;
use std::sync::{Mutex, PoisonError};

use anyhow::{Result, anyhow};
use tungstenite::handshake::server::Request;

use super::http::header;

/// Bytes of a secret: nobody guesses them.
const SECRET_LEN: usize = 16;

/// The secrets of a server.
#[derive(Debug)]
pub struct Access {
    port: u16,
    /// Until somebody has brought it.
    token: Mutex<Option<String>>,
    session: String,
}

impl Access {
    /// New secrets for the server at a port; the token beside it.
    pub fn new(port: u16) -> Result<(Access, String)> {
        let token = secret()?;
        let access = Access { port, token: Mutex::new(Some(token.clone())), session: secret()? };
        Ok((access, token))
    }

    /// Whether a request names this computer. Who asks under another name has been led here by a
    /// page of somebody else.
    pub fn is_here(&self, request: &Request) -> bool {
        let host = header(request, "Host");
        [
            format!("{}:{}", Ipv4Addr::LOCALHOST, self.port),
            format!("localhost:{}", self.port),
            format!("[::1]:{}", self.port),
        ]
        .iter()
        .any(|own| own.eq_ignore_ascii_case(host))
    }

    /// Whether a request comes from the page that is served here.
    pub fn is_own_page(&self, request: &Request) -> bool {
        let own = format!("http://{}", header(request, "Host"));
        self.is_here(request) && header(request, "Origin").eq_ignore_ascii_case(&own)
    }

    /// The key of the session for whoever has a token that was not used yet.
    pub fn exchange(&self, brought: &str) -> Result<&str, &'static str> {
        let mut token = self.token.lock().unwrap_or_else(PoisonError::into_inner);
        match token.as_deref() {
            None => {
                Err("this address was used already: go on in the tab that was opened with it, \
                 or start `uno200 ide` again")
            }
            Some(token) if !is_same(token, brought) => Err(WRONG),
            Some(_) => {
                *token = None;
                Ok(&self.session)
            }
        }
    }

    /// The key of the session for whoever has it.
    pub fn come_back(&self, brought: &str) -> Result<&str, &'static str> {
        if is_same(&self.session, brought) { Ok(&self.session) } else { Err(WRONG) }
    }
}

const WRONG: &str = "this page was not opened with the address that `uno200 ide` has printed: open \
                     that address";

/// Whether two secrets are the same. How long it takes does not tell how much of them is.
fn is_same(one: &str, other: &str) -> bool {
    let differences = one.bytes().zip(other.bytes()).map(|(one, other)| one ^ other);
    one.len() == other.len() && differences.fold(0, |all, one| all | one) == 0
}

fn secret() -> Result<String> {
    let mut bytes = [0; SECRET_LEN];
    getrandom::fill(&mut bytes).map_err(|error| anyhow!("no random numbers: {error}"))?;
    Ok(bytes.iter().map(|byte| format!("{byte:02x}")).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn request(host: &str, origin: Option<&str>) -> Request {
        let mut builder = Request::builder().header("Host", host);
        if let Some(origin) = origin {
            builder = builder.header("Origin", origin);
        }
        builder.body(()).unwrap()
    }

    #[test]
    fn only_this_computer_is_served() {
        let (access, _) = Access::new(8200).unwrap();
        for (host, is_served) in [
            ("127.0.0.1:8200", true),
            ("LocalHost:8200", true),
            ("127.0.0.1:8201", false),
            ("example.org:8200", false),
            ("127.0.0.1", false),
        ] {
            assert_eq!(access.is_here(&request(host, None)), is_served, "{host}");
        }
    }

    #[test]
    fn only_its_own_page_reaches_the_bridge() {
        let (access, _) = Access::new(8200).unwrap();
        for (origin, is_own) in [
            (Some("http://127.0.0.1:8200"), true),
            (Some("http://localhost:8200"), false),
            (Some("https://127.0.0.1:8200"), false),
            (Some("http://127.0.0.1:8201"), false),
            (Some("http://example.org"), false),
            (Some("null"), false),
            (None, false),
        ] {
            let request = request("127.0.0.1:8200", origin);
            assert_eq!(access.is_own_page(&request), is_own, "{origin:?}");
        }
        let led_here = request("example.org:8200", Some("http://example.org:8200"));
        assert!(!access.is_own_page(&led_here));
    }

    #[test]
    fn a_token_is_good_for_once_and_a_session_for_ever() {
        let (access, token) = Access::new(8200).unwrap();
        assert_eq!(token.len(), 2 * SECRET_LEN);
        assert_eq!(access.exchange("1234"), Err(WRONG));
        let key = access.exchange(&token).unwrap().to_owned();
        assert!(access.exchange(&token).unwrap_err().contains("used already"));
        assert_ne!(key, token);
        assert_eq!(access.come_back(&key), Ok(&*key));
        assert_eq!(access.come_back(&key), Ok(&*key));
        assert_eq!(access.come_back(&token), Err(WRONG));
        assert_ne!(Access::new(8200).unwrap().1, token);
    }
}
