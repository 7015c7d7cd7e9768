//! Modbus TCP: connections and their frames. What a request means is not known here.
//!
//! The frames are ours and not a library's, because the answer to a malformed request counts too: the board answers it
//! with an exception, and a library that takes requests to pieces before it hands them on closes the connection.

use std::io::{self, Read, Write};
use std::net::{IpAddr, TcpListener, TcpStream};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::thread;
use std::time::Duration;

use super::{Event, Request};

/// Transaction (2), protocol (2), length (2), unit (1).
const HEADER_LEN: usize = 7;
/// Longest request and answer: function code and data.
const PDU_LEN_MAX: usize = 253;
/// Most clients at once.
const CLIENTS_MAX: usize = 64;
/// A client that has been silent for so long is held to be gone.
const SILENCE_MAX: Duration = Duration::from_secs(3600);
/// A client that does not take its answer in so long, too.
const WRITE_MAX: Duration = Duration::from_secs(10);
/// When no connection can be accepted: there are too many files open.
const ACCEPT_AGAIN: Duration = Duration::from_millis(100);

/// Accepts clients for ever. Each has a thread, in which it waits for its answers one after the other.
pub fn accept(listener: &TcpListener, events: &Sender<Event>) {
    let clients = Arc::new(AtomicUsize::new(0));
    for stream in listener.incoming() {
        let Ok(stream) = stream else {
            thread::sleep(ACCEPT_AGAIN);
            continue;
        };
        let place = Place::take(&clients);
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
struct Place(Arc<AtomicUsize>);

impl Place {
    /// `None` when all are taken.
    fn take(clients: &Arc<AtomicUsize>) -> Option<Place> {
        let place = Place(Arc::clone(clients));
        (clients.fetch_add(1, Ordering::Relaxed) < CLIENTS_MAX).then_some(place)
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

/// Answers a client's requests until it goes, or sends what is no Modbus.
fn converse(mut stream: TcpStream, client: IpAddr, events: &Sender<Event>) -> io::Result<()> {
    stream.set_nodelay(true)?;
    stream.set_read_timeout(Some(SILENCE_MAX))?;
    stream.set_write_timeout(Some(WRITE_MAX))?;
    while let Some((mut frame, pdu)) = read_frame(&mut stream)? {
        let (reply, answer) = channel();
        let request = Event::Request(Request { client, pdu, reply });
        // Both fail when the PLC has ended.
        let (Ok(()), Ok(pdu)) = (events.send(request), answer.recv()) else { return Ok(()) };
        let [high, low] = ((pdu.len() + 1) as u16).to_be_bytes();
        frame[4..6].copy_from_slice(&[high, low]);
        stream.write_all(&[&frame, pdu.as_slice()].concat())?;
    }
    Ok(())
}

/// The next header and what it announces; `None` at the end, also where it comes from a header that is none of Modbus.
fn read_frame(stream: &mut impl Read) -> io::Result<Option<([u8; HEADER_LEN], Vec<u8>)>> {
    let mut header = [0; HEADER_LEN];
    stream.read_exact(&mut header)?;
    let [_, _, protocol_high, protocol_low, length_high, length_low, _unit] = header;
    let length = usize::from(u16::from_be_bytes([length_high, length_low]));
    // The length counts the unit.
    if [protocol_high, protocol_low] != [0, 0] || !(2..=PDU_LEN_MAX + 1).contains(&length) {
        return Ok(None);
    }
    let mut pdu = vec![0; length - 1];
    stream.read_exact(&mut pdu)?;
    Ok(Some((header, pdu)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(mut bytes: &[u8]) -> Option<Vec<u8>> {
        read_frame(&mut bytes).unwrap().map(|(_, pdu)| pdu)
    }

    #[test]
    fn a_frame_is_as_long_as_its_header_says() {
        assert_eq!(frame(&[0, 9, 0, 0, 0, 2, 1, 0x42, 0x43]), Some(vec![0x42]));
        let longest = [&[0, 9, 0, 0, 0, 254, 1][..], &[7; 254]].concat();
        assert_eq!(frame(&longest), Some(vec![7; 253]));
    }

    #[test]
    fn what_is_no_modbus_ends_the_connection() {
        for header in [[0, 0, 0, 1, 0, 2, 1], [0, 0, 0, 0, 0, 0, 1], [0, 0, 0, 0, 0, 1, 1], [0, 0, 0, 0, 0, 255, 1]] {
            assert_eq!(frame(&[&header[..], &[3; 300]].concat()), None, "{header:?}");
        }
        assert!(read_frame(&mut &b"GET /"[..]).is_err());
    }

    #[test]
    fn places_are_given_back() {
        let clients = Arc::new(AtomicUsize::new(0));
        let mut places: Vec<_> = (0..CLIENTS_MAX).map(|_| Place::take(&clients).unwrap()).collect();
        assert!(Place::take(&clients).is_none());
        assert!(Place::take(&clients).is_none());
        places.pop();
        assert!(Place::take(&clients).is_some());
    }
}
