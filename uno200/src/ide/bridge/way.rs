//! An open port: bytes out, and a thread that passes on what comes in.

use std::io::{self, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use client::Error;
use plc_isa::Parity;
use serialport::SerialPort;

use super::ports::Taken;
use super::protocol::Kind;
use crate::transport::{open_serial, open_tcp, reason_of};

/// How often the thread looks whether it is to end.
const PATIENCE: Duration = Duration::from_millis(50);

/// Is given what comes in, or why nothing more does.
pub type Sink = Arc<dyn Fn(Result<&[u8], String>) + Send + Sync>;

/// A port that is open.
pub struct Way {
    taken: Taken,
    baud: u32,
    parity: Parity,
    sink: Sink,
    /// None while a port without DTR is closed in its place.
    end: Option<End>,
}

/// This computer's end of it.
enum End {
    Serial(Box<dyn SerialPort>, Reading),
    Tcp(TcpStream, Reading),
}

impl Way {
    /// Opens a port.
    pub fn open(taken: Taken, baud: u32, parity: Parity, sink: Sink) -> Result<Way, Error> {
        let mut way = Way { taken, baud, parity, sink, end: None };
        way.reopen()?;
        Ok(way)
    }

    fn reopen(&mut self) -> Result<(), Error> {
        // The old one first: a port is open once.
        self.end = None;
        let name = &self.taken.port.name;
        let lost = |error: io::Error| Error::NotConnected(format!("{name}: {error}"));
        let end = match self.taken.port.kind {
            Kind::Serial => {
                let port = open_serial(name, self.baud, self.parity)?;
                let reader = port.try_clone().map_err(|error| lost(error.into()))?;
                End::Serial(port, Reading::start(reader, Arc::clone(&self.sink)))
            }
            Kind::Tcp => {
                let stream = open_tcp(name)?;
                let reader = stream.try_clone().map_err(lost)?;
                reader.set_read_timeout(Some(PATIENCE)).map_err(lost)?;
                End::Tcp(stream, Reading::start(reader, Arc::clone(&self.sink)))
            }
        };
        self.end = Some(end);
        Ok(())
    }

    /// Sends bytes.
    pub fn send(&mut self, bytes: &[u8]) -> Result<(), String> {
        let sent = match &mut self.end {
            Some(End::Serial(port, _)) => port.write_all(bytes),
            Some(End::Tcp(stream, _)) => stream.write_all(bytes),
            // Nobody is there to hear it.
            None => Ok(()),
        };
        sent.map_err(|error| reason_of(&error))
    }

    /// Switches DTR and RTS. A port that has none is closed and opened in their place: its other
    /// end sees that as well.
    pub fn lines(&mut self, on: bool) -> Result<(), Error> {
        let is_done = match &mut self.end {
            Some(End::Serial(port, _)) => {
                let dtr = port.write_data_terminal_ready(on);
                dtr.and_then(|()| port.write_request_to_send(on)).is_ok()
            }
            // A connection of the network has no such lines.
            Some(End::Tcp(..)) => true,
            None => false,
        };
        match (is_done, on) {
            (true, _) => Ok(()),
            (false, true) => self.reopen(),
            (false, false) => {
                self.end = None;
                Ok(())
            }
        }
    }
}

/// A thread that reads until this is dropped.
struct Reading {
    is_over: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Reading {
    fn start(mut reader: impl Read + Send + 'static, sink: Sink) -> Reading {
        let is_over = Arc::new(AtomicBool::new(false));
        let over = Arc::clone(&is_over);
        let thread = thread::spawn(move || {
            let mut bytes = [0; 4096];
            while !over.load(Ordering::Relaxed) {
                match reader.read(&mut bytes) {
                    Ok(0) if over.load(Ordering::Relaxed) => return,
                    Ok(0) => return sink(Err("the other end has closed it".to_owned())),
                    Ok(len) => sink(Ok(&bytes[..len])),
                    Err(error) if crate::transport::is_only_late(&error) => {}
                    Err(_) if over.load(Ordering::Relaxed) => return,
                    Err(error) => return sink(Err(reason_of(&error))),
                }
            }
        });
        Reading { is_over, thread: Some(thread) }
    }
}

impl Drop for Reading {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            // It has nothing to tell.
            let _ = thread.join();
        }
    }
}

impl Drop for End {
    fn drop(&mut self) {
        let (End::Serial(_, reading) | End::Tcp(_, reading)) = &*self;
        // That it ends the thread does not tell: it is meant.
        reading.is_over.store(true, Ordering::Relaxed);
        if let End::Tcp(stream, _) = self {
            // It may be closed already.
            let _ = stream.shutdown(Shutdown::Both);
        }
    }
}
