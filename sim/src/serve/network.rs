//! Modbus TCP: connections, each with its thread. What is in their frames is not known here.

use std::io::{self, Read, Write};
use std::net::{IpAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::thread;
use std::time::Duration;

use super::Frames;
use super::server::Event;
use super::service::Request;

/// Most clients at once.
const CLIENTS_MAX: usize = 64;
/// A client that has been silent for so long is held to be gone.
const SILENCE_MAX: Duration = Duration::from_secs(3600);
/// A client that does not take its answer in so long, too.
const WRITE_MAX: Duration = Duration::from_secs(10);
/// When no connection can be accepted: there are too many files open.
const ACCEPT_AGAIN: Duration = Duration::from_millis(100);

/// Accepts clients for ever. Each has a thread, in which it waits for its answers one after the
/// other.
pub fn accept(listener: &TcpListener, events: &Sender<Event>) {
    let clients = Arc::new(AtomicUsize::new(0));
    for stream in listener.incoming() {
        let Ok(stream) = stream else {
            thread::sleep(ACCEPT_AGAIN);
            continue;
        };
        let place = Seat::take(&clients);
        if let (Some(place), Ok(address)) = (place, stream.peer_addr()) {
            let events = events.clone();
            // One that cannot be started is a client that is not served: its connection closes.
            let _ = thread::Builder::new().spawn(move || {
                // Whatever ends a connection, nobody is left to be told.
                let _ = converse(stream, address.ip(), &events);
                drop(place);
            });
        }
    }
}

/// The place of one client, given back when it is dropped.
struct Seat(Arc<AtomicUsize>);

impl Seat {
    /// `None` when all are taken.
    fn take(clients: &Arc<AtomicUsize>) -> Option<Seat> {
        let place = Seat(Arc::clone(clients));
        (clients.fetch_add(1, Ordering::Relaxed) < CLIENTS_MAX).then_some(place)
    }
}

impl Drop for Seat {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

/// Answers a client's requests until it goes, or sends what is no Modbus.
fn converse(mut stream: TcpStream, client: IpAddr, events: &Sender<Event>) -> io::Result<()> {
    stream.set_nodelay(true)?;
    stream.set_read_timeout(Some(SILENCE_MAX))?;
    stream.set_write_timeout(Some(WRITE_MAX))?;
    let (mut frames, mut bytes) = (Frames::default(), [0; 512]);
    while let Ok(request) = frames.request() {
        let Some(pdu) = request else {
            match stream.read(&mut bytes)? {
                0 => break,
                count => frames.receive(&bytes[..count]),
            }
            continue;
        };
        let (from, answer) = channel();
        let request = Event::Request(Request { client, pdu, from });
        // Both fail when the PLC has ended.
        let (Ok(()), Ok(pdu)) = (events.send(request), answer.recv()) else { break };
        stream.write_all(&frames.answer(&pdu))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_given_back() {
        let clients = Arc::new(AtomicUsize::new(0));
        let mut places: Vec<_> = (0..CLIENTS_MAX).map(|_| Seat::take(&clients).unwrap()).collect();
        assert!(Seat::take(&clients).is_none());
        assert!(Seat::take(&clients).is_none());
        places.pop();
        assert!(Seat::take(&clients).is_some());
    }
}
