//! A request and its answer over something that carries bytes. When an answer is complete and how
//! long it is waited for, [`Exchange`] knows.

use std::io::{self, ErrorKind};
use std::time::{Duration, Instant};

use client::Error;
use client::line::{Exchange, Framing};

/// Bytes to a PLC and from it.
pub(super) trait Stream {
    /// Sends bytes. What came before them was for nobody.
    fn send(&mut self, bytes: &[u8]) -> io::Result<()>;

    /// Waits for bytes, about `time` at most. 0: none have come.
    fn receive(&mut self, bytes: &mut [u8], time: Duration) -> io::Result<usize>;
}

/// Why bytes do not get through, in words that help; else the system's.
pub fn reason(error: &io::Error) -> String {
    match error.kind() {
        ErrorKind::BrokenPipe
        | ErrorKind::ConnectionReset
        | ErrorKind::ConnectionAborted
        | ErrorKind::UnexpectedEof => "the other end has closed it".to_owned(),
        _ => error.to_string(),
    }
}

/// Whether nothing has come yet: not all systems say it in the same way.
pub fn is_only_late(error: &io::Error) -> bool {
    #[cfg(unix)]
    if rustix::io::Errno::from_io_error(error) == Some(rustix::io::Errno::INPROGRESS) {
        return true;
    }
    matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut | ErrorKind::Interrupted)
}

/// Sends a request and waits for its answer.
pub(super) fn exchange(
    stream: &mut impl Stream,
    framing: &mut Framing,
    request: &[u8],
    patience: Duration,
) -> Result<Vec<u8>, Error> {
    let begin = Instant::now();
    let now_ms = || begin.elapsed().as_millis() as u64;
    let lost = |error: io::Error| Error::Lost(reason(&error));
    let (mut exchange, frame) =
        Exchange::begin(framing, request, patience.as_millis() as u64, now_ms());
    stream.send(&frame).map_err(lost)?;
    loop {
        let mut bytes = [0; 256];
        let wanted = exchange.wanted().min(bytes.len());
        let left_ms = exchange.deadline_ms().saturating_sub(now_ms()) + 1;
        let count =
            stream.receive(&mut bytes[..wanted], Duration::from_millis(left_ms)).map_err(lost)?;
        let result = match count {
            0 => exchange.expire(now_ms()),
            count => exchange.receive(&bytes[..count], now_ms()),
        };
        if let Some(result) = result {
            return result;
        }
    }
}
