//! The requests of all clients, answered one after the other: the PLC has room for one. Where they
//! come from and how answers go back is not known here.

use core::net::IpAddr;
use std::collections::VecDeque;

use super::Access;
use crate::machine::host::Host;

/// Modbus: this controller does not do that, or not for this client.
const ILLEGAL_FUNCTION: u8 = 1;
/// Modbus: the request is longer than there is room for.
const ILLEGAL_VALUE: u8 = 3;

/// What a client asks.
#[derive(Debug, Clone)]
pub struct Request<T> {
    /// Where the client is, for [`Access`].
    pub client: IpAddr,
    /// Function code and data.
    pub pdu: Vec<u8>,
    /// By what its answer is known.
    pub from: T,
}

/// What the PLC answers.
#[derive(Debug, Clone)]
pub struct Answer<T> {
    /// The request's `from`.
    pub to: T,
    /// Function code and data.
    pub pdu: Vec<u8>,
}

pub(super) struct Service<T> {
    pub access: Access,
    waiting: VecDeque<Request<T>>,
    /// In the PLC, to be answered after a scan.
    current: Option<Request<T>>,
    answers: Vec<Answer<T>>,
}

impl<T> Service<T> {
    pub fn new(access: Access) -> Service<T> {
        Service { access, waiting: VecDeque::new(), current: None, answers: Vec::new() }
    }

    pub fn take(&mut self, request: Request<T>, host: &mut Host) {
        self.waiting.push_back(request);
        self.answer_waiting(host);
    }

    /// A scan has ended.
    pub fn go_on(&mut self, host: &mut Host) {
        if let Some(request) = self.current.take() {
            self.answer(request, host);
            self.answer_waiting(host);
        }
    }

    /// The answers there are by now, in the order of the requests, once.
    pub fn answers(&mut self) -> impl Iterator<Item = Answer<T>> + use<T> {
        std::mem::take(&mut self.answers).into_iter()
    }

    fn answer_waiting(&mut self, host: &mut Host) {
        while self.current.is_none()
            && let Some(request) = self.waiting.pop_front()
        {
            if !self.access.allows(request.client, &request.pdu) {
                self.refuse(request, ILLEGAL_FUNCTION);
            } else if !host.take_request(&request.pdu) {
                self.refuse(request, ILLEGAL_VALUE);
            } else {
                self.answer(request, host);
            }
        }
    }

    /// Answers the request that is in the PLC, if it can be by now.
    fn answer(&mut self, request: Request<T>, host: &mut Host) {
        match host.answer() {
            Some(pdu) => {
                self.answers.push(Answer { to: request.from, pdu });
                host.carry_out();
            }
            None => self.current = Some(request),
        }
    }

    fn refuse(&mut self, request: Request<T>, exception: u8) {
        let function = request.pdu.first().copied().unwrap_or(0);
        self.answers.push(Answer { to: request.from, pdu: vec![function | 0x80, exception] });
    }
}

#[cfg(test)]
mod tests {
    use awl_asm::assemble::assemble;
    use awl_asm::source::Source;

    use super::*;
    use crate::machine::Machine;

    /// Status of the program's first instruction, without operand; [`FIRST`] is where it is.
    const STATUS: [u8; 7] = [69, 1, 0, 0, 0xFF, 0, 0];
    const FIRST: usize = 2;
    const WRITE_M0_0: [u8; 5] = [5, 0x03, 0xE8, 0xFF, 0];
    const READ_M0_0: [u8; 5] = [1, 0x03, 0xE8, 0, 1];

    fn host() -> Host {
        let assembly = assemble(&Source::new("p.awl", "LD I0.0\n= Q0.0\n").unwrap(), Vec::new());
        Host::new(assembly.image.unwrap(), Box::new(|_| String::new()))
    }

    fn request(client: &str, pdu: &[u8], from: u8) -> Request<u8> {
        Request { client: client.parse().unwrap(), pdu: pdu.to_vec(), from }
    }

    fn ask(service: &mut Service<u8>, host: &mut Host, client: &str, pdu: &[u8]) -> Vec<u8> {
        service.take(request(client, pdu, 7), host);
        let answers: Vec<Answer<u8>> = service.answers().collect();
        assert_eq!((answers.len(), answers[0].to), (1, 7));
        answers[0].pdu.clone()
    }

    fn service(writes: bool) -> Service<u8> {
        Service::new(Access { anywhere: true, writes })
    }

    #[test]
    fn what_other_computers_may_not_write_stays_as_it_is() {
        let (mut service, mut host) = (service(false), host());
        assert_eq!(ask(&mut service, &mut host, "10.0.0.1", &WRITE_M0_0), [0x85, 1]);
        assert_eq!(ask(&mut service, &mut host, "10.0.0.1", &READ_M0_0), [1, 1, 0]);
        assert_eq!(ask(&mut service, &mut host, "127.0.0.1", &WRITE_M0_0), WRITE_M0_0);
        assert_eq!(ask(&mut service, &mut host, "10.0.0.1", &READ_M0_0), [1, 1, 1]);
        service.access.writes = true;
        assert_eq!(
            ask(&mut service, &mut host, "10.0.0.1", &[5, 0x03, 0xE8, 0, 0]),
            [5, 0x03, 0xE8, 0, 0]
        );
        assert_eq!(ask(&mut service, &mut host, "10.0.0.1", &READ_M0_0), [1, 1, 0]);
    }

    #[test]
    fn what_needs_a_scan_is_answered_after_it_and_before_what_came_later() {
        let (mut service, mut host) = (service(true), host());
        host.scan(0);
        let code_at = plc_link::Station::plc(&host).program().unwrap().code_at();
        let mut status = STATUS;
        status[FIRST..FIRST + 2].copy_from_slice(&code_at.to_be_bytes());
        service.take(request("127.0.0.1", &status, 1), &mut host);
        service.take(request("127.0.0.1", &READ_M0_0, 2), &mut host);
        assert_eq!(service.answers().count(), 0);
        host.scan(1);
        service.go_on(&mut host);
        let answers: Vec<Answer<u8>> = service.answers().collect();
        assert_eq!(answers.iter().map(|answer| answer.to).collect::<Vec<_>>(), [1, 2]);
        // Executed, with an empty stack below a 0.
        assert_eq!(answers[0].pdu[3..], [0x80, 0, 0, 0, 0, 0]);
        assert_eq!(answers[1].pdu, [1, 1, 0]);
    }

    #[test]
    fn a_request_longer_than_the_room_is_an_exception() {
        let (mut service, mut host) = (service(true), host());
        assert_eq!(ask(&mut service, &mut host, "127.0.0.1", &[16; 253]), [0x90, 3]);
    }
}
