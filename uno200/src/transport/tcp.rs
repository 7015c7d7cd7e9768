//! Modbus TCP, by tokio-modbus. The service functions are its custom functions.

use std::io;
use std::net::ToSocketAddrs;
use std::time::Duration;

use tokio_modbus::client::sync::tcp::connect_slave_with_timeout;
use tokio_modbus::client::sync::{Client as _, Context};
use tokio_modbus::prelude::{ReadCode, ReadDeviceIdentificationResponse, Request, Response, Slave};

use super::Transport;
use crate::error::Error;

const CONNECT_TIMEOUT: Duration = Duration::from_secs(3);

pub(super) struct Tcp {
    context: Context,
}

pub(super) fn open(address: &str, unit: u8) -> Result<Tcp, Error> {
    let failed = |error: io::Error| {
        let hint = match error.kind() {
            io::ErrorKind::ConnectionRefused => ": nothing listens there; does `awl-sim --serve` run?",
            io::ErrorKind::TimedOut => ": nobody answers at this address",
            io::ErrorKind::InvalidInput => ": an address is HOST:PORT, such as 127.0.0.1:1502",
            _ => "",
        };
        Error::NotConnected(format!("cannot connect to {address}: {error}{hint}"))
    };
    let mut last = io::Error::new(io::ErrorKind::NotFound, "no such host");
    for place in address.to_socket_addrs().map_err(failed)? {
        match connect_slave_with_timeout(place, Slave(unit), Some(CONNECT_TIMEOUT)) {
            Ok(context) => return Ok(Tcp { context }),
            Err(error) => last = error,
        }
    }
    Err(failed(last))
}

impl Transport for Tcp {
    fn exchange(&mut self, request: &[u8], patience: Duration) -> Result<Vec<u8>, Error> {
        let function = request.first().copied().unwrap_or(0);
        self.context.set_timeout(patience);
        match self.context.call(request_of(request)) {
            Ok(Ok(response)) => super::accepted(request, bytes_of(response)?),
            Ok(Err(exception)) => Err(Error::Refused { function, exception: exception.into() }),
            // A late answer would be taken for that to the next request: the connection is given up.
            Err(tokio_modbus::Error::Transport(error)) => Err(Error::Lost(error)),
            Err(tokio_modbus::Error::Protocol(error)) => Err(Error::Lost(io::Error::other(error))),
        }
    }
}

fn request_of(request: &[u8]) -> Request<'_> {
    match *request {
        [43, 14, code, object] => match ReadCode::try_from_value(code) {
            Some(code) => Request::ReadDeviceIdentification(code, object),
            None => Request::Custom(43, request[1..].into()),
        },
        [function, ref data @ ..] => Request::Custom(function, data.into()),
        [] => Request::Custom(0, [].as_slice().into()),
    }
}

fn bytes_of(response: Response) -> Result<Vec<u8>, Error> {
    match response {
        Response::Custom(function, data) => Ok([&[function], &data[..]].concat()),
        Response::ReadDeviceIdentification(answer) => Ok(identification(&answer)),
        other => Err(Error::Request(format!("this client does not use function {}", other.function_code().value()))),
    }
}

fn identification(answer: &ReadDeviceIdentificationResponse) -> Vec<u8> {
    let objects = &answer.device_id_objects;
    // Conformity, more follows, next object: this client asks for one object and looks at nothing else.
    let mut bytes = vec![43, 14, answer.read_code.value(), 0x82, 0, 0, objects.len() as u8];
    for object in objects {
        bytes.extend_from_slice(&[object.id, object.value.len() as u8]);
        bytes.extend_from_slice(&object.value);
    }
    bytes
}
