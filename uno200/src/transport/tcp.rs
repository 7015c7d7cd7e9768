//! Modbus TCP over a socket. The frames are those of [`client::line`].

use std::io::{self, ErrorKind, Read, Write};
use std::net::{TcpStream, ToSocketAddrs};
use std::time::Duration;

use client::Error;
use client::line::Framing;

use super::Transport;
use super::stream::{Stream, exchange, is_only_late};

const CONNECT_TIMEOUT: Duration = Duration::from_secs(3);

pub(super) struct Tcp {
    stream: TcpStream,
    framing: Framing,
}

pub(super) fn open(address: &str, unit: u8) -> Result<Tcp, Error> {
    let stream = connect(address)?;
    Ok(Tcp { stream, framing: Framing::Tcp { unit, transaction: 0 } })
}

/// Connects to `HOST:PORT`.
pub fn connect(address: &str) -> Result<TcpStream, Error> {
    let failed = |error: io::Error| {
        let hint = match error.kind() {
            ErrorKind::ConnectionRefused => ": nothing listens there; does `awl-sim --serve` run?",
            ErrorKind::TimedOut => ": nobody answers at this address",
            ErrorKind::InvalidInput if address.parse::<u16>().is_ok() => {
                return Error::NotConnected(format!(
                    "{address}: the host is missing: 127.0.0.1:{address}"
                ));
            }
            ErrorKind::InvalidInput => ": an address is HOST:PORT, such as 127.0.0.1:1502",
            _ => "",
        };
        Error::NotConnected(format!("cannot connect to {address}: {error}{hint}"))
    };
    let mut last = io::Error::new(ErrorKind::NotFound, "no such host");
    for place in address.to_socket_addrs().map_err(failed)? {
        match TcpStream::connect_timeout(&place, CONNECT_TIMEOUT) {
            Ok(stream) => {
                stream.set_nodelay(true).map_err(failed)?;
                return Ok(stream);
            }
            Err(error) => last = error,
        }
    }
    Err(failed(last))
}

impl Transport for Tcp {
    fn exchange(&mut self, request: &[u8], patience: Duration) -> Result<Vec<u8>, Error> {
        let Tcp { stream, framing } = self;
        exchange(stream, framing, request, patience)
    }
}

impl Stream for TcpStream {
    fn send(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.write_all(bytes)
    }

    fn receive(&mut self, bytes: &mut [u8], time: Duration) -> io::Result<usize> {
        self.set_read_timeout(Some(time))?;
        match self.read(bytes) {
            Ok(0) => Err(ErrorKind::BrokenPipe.into()),
            Err(error) if is_only_late(&error) => Ok(0),
            result => result,
        }
    }
}
