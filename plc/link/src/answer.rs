//! A request and the way to its answer: which function answers.

use crate::identity;
use crate::link::Phase;
use crate::modbus;
use crate::protocol::IDENTIFICATION;
use crate::request::{Exception, Request};
use crate::service;
use crate::station::Station;

/// Answers the request of `len` bytes, at least 1, in the frame of
/// [`Link::place`](crate::Link::place). Returns the length of the answer, which has replaced it; 0:
/// the answer takes another scan, at whose end this is called again.
pub fn answer<S: Station>(station: &mut S, len: u16) -> u16 {
    let (frame, room) = (station.link().frame, station.link().room);
    let mut request = Request { station, frame, len: len as u8, room: room as u8, out: 1 };
    let function = request.byte(0);
    let answered = if len > room {
        Err(Exception::Value)
    } else {
        match function {
            1..=6 | 15 | 16 | 23 => modbus::answer(&mut request, function),
            IDENTIFICATION => identity::answer(&mut request),
            _ => service::answer(&mut request, function),
        }
    };
    let len = match answered {
        Ok(0) => return 0,
        Ok(len) => len,
        Err(exception) => {
            request.set_byte(0, function | 0x80);
            request.set_byte(1, exception as u8);
            2
        }
    };
    request.station.link().phase = Phase::New;
    u16::from(len)
}
