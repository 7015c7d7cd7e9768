//! A PLC on the network: a host machine that runs in real time and answers Modbus TCP. What it answers is the business of
//! `plc-link`, as on the board; here are time, connections, and who may do what.
//!
//! Everything happens in one thread, except that each client has one in which its frames are read and written.

mod access;
mod network;
mod pace;

use std::collections::VecDeque;
use std::io;
use std::net::{IpAddr, SocketAddr, TcpListener};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use crate::machine::host::Host;
use crate::machine::{Machine, MachineError, Mode};
use crate::run::{Course, Outcome};

pub use access::{Access, is_here};
use pace::Pace;

/// Modbus: this controller does not do that, or not for this client.
const ILLEGAL_FUNCTION: u8 = 1;
/// Modbus: the request is longer than there is room for.
const ILLEGAL_VALUE: u8 = 3;

/// What a client asks.
struct Request {
    client: IpAddr,
    /// Function code and data.
    pdu: Vec<u8>,
    reply: Sender<Vec<u8>>,
}

/// What comes in from other threads.
enum Event {
    Request(Request),
    Stop,
}

/// Ends a server from another thread.
#[derive(Clone)]
pub struct Stopper(Sender<Event>);

impl Stopper {
    /// The server ends after the scan that is under way.
    pub fn stop(&self) {
        // Fails when it has ended already.
        let _ = self.0.send(Event::Stop);
    }
}

/// A port that is listened at, for a PLC that has not begun.
pub struct Server {
    listener: TcpListener,
    address: SocketAddr,
    access: Access,
    sender: Sender<Event>,
    events: Receiver<Event>,
}

/// A change that somebody at the machine would see: whether the program is executed, and the fault that ended it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Change {
    /// Start of the last scan, in milliseconds.
    pub at_ms: u64,
    /// The mode since then.
    pub mode: Mode,
    /// In words and with its place in the program.
    pub fault: Option<String>,
}

impl Server {
    /// Listens at the first of these addresses that can be had. Whether the PLC may is for
    /// [`Access::allows_listening_at`] to say, before.
    pub fn listen(addresses: &[SocketAddr], access: Access) -> io::Result<Server> {
        let listener = TcpListener::bind(addresses)?;
        let address = listener.local_addr()?;
        let (sender, events) = channel();
        Ok(Server { listener, address, access, sender, events })
    }

    /// Where it listens, with the real port.
    pub fn address(&self) -> SocketAddr {
        self.address
    }

    /// What ends it.
    pub fn stopper(&self) -> Stopper {
        Stopper(self.sender.clone())
    }

    /// Runs the PLC in real time, a scan every `scan_ms` milliseconds, until it is stopped. Its own threads end with the
    /// process. `tell` hears of changes. Fails only if the machine cannot access an operand, in the first scan.
    pub fn run(
        self,
        host: &mut Host,
        mut course: Course<'_>,
        scan_ms: u64,
        tell: &mut dyn FnMut(&Change),
    ) -> Result<Outcome, MachineError> {
        let Server { listener, access, sender, events, .. } = self;
        thread::spawn(move || network::accept(&listener, &sender));
        let mut service = Service { access, waiting: VecDeque::new(), current: None };
        let mut outcome = Outcome { scan_ms, ..Outcome::default() };
        let mut pace = Pace::new(Duration::from_millis(scan_ms), Instant::now());
        // As a new PLC is expected to be: that it is not is a change.
        let (mut before, mut now_ms) = (Mode::Run, 0);
        loop {
            if pace.until_next(Instant::now()).is_zero() {
                pace.scan_starts(Instant::now());
                now_ms = outcome.scans * scan_ms;
                course.go_on(now_ms, host, &mut outcome)?;
                host.scan(now_ms);
                outcome.scans += 1;
                if !course.expects_sent() {
                    // Nobody will ask for it.
                    host.take_sent()?;
                }
                service.go_on(host);
            }
            if before != host.mode() {
                before = host.mode();
                tell(&Change { at_ms: now_ms, mode: before, fault: host.fault() });
            }
            // At most one before the next look at the time: neither scans nor clients wait for ever.
            match events.recv_timeout(pace.until_next(Instant::now())) {
                Ok(Event::Request(request)) => service.take(request, host),
                Err(RecvTimeoutError::Timeout) => {}
                Ok(Event::Stop) | Err(RecvTimeoutError::Disconnected) => break,
            }
        }
        course.finish(&mut outcome);
        Ok(outcome)
    }
}

/// The requests of all clients, answered one after the other: the PLC has room for one.
struct Service {
    access: Access,
    waiting: VecDeque<Request>,
    /// In the PLC, to be answered after a scan.
    current: Option<Request>,
}

impl Service {
    fn take(&mut self, request: Request, host: &mut Host) {
        self.waiting.push_back(request);
        self.answer_waiting(host);
    }

    /// A scan has ended.
    fn go_on(&mut self, host: &mut Host) {
        if let Some(request) = self.current.take() {
            self.answer(request, host);
            self.answer_waiting(host);
        }
    }

    fn answer_waiting(&mut self, host: &mut Host) {
        while self.current.is_none()
            && let Some(request) = self.waiting.pop_front()
        {
            if !self.access.allows(request.client, &request.pdu) {
                request.refuse(ILLEGAL_FUNCTION);
            } else if !host.take_request(&request.pdu) {
                request.refuse(ILLEGAL_VALUE);
            } else {
                self.answer(request, host);
            }
        }
    }

    /// Answers the request that is in the PLC, if it can be by now.
    fn answer(&mut self, request: Request, host: &mut Host) {
        match host.answer() {
            Some(pdu) => {
                request.reply_with(pdu);
                host.carry_out();
            }
            None => self.current = Some(request),
        }
    }
}

impl Request {
    fn refuse(self, exception: u8) {
        let function = self.pdu.first().copied().unwrap_or(0);
        self.reply_with(vec![function | 0x80, exception]);
    }

    fn reply_with(self, pdu: Vec<u8>) {
        // Fails when the client has gone.
        let _ = self.reply.send(pdu);
    }
}

#[cfg(test)]
mod tests {
    use awl_asm::assemble::assemble;
    use awl_asm::source::Source;

    use super::*;

    /// Status of the program's first instruction, without operand; [`FIRST`] is where it is.
    const STATUS: [u8; 7] = [69, 1, 0, 0, 0xFF, 0, 0];
    const FIRST: usize = 2;
    const WRITE_M0_0: [u8; 5] = [5, 0x03, 0xE8, 0xFF, 0];
    const READ_M0_0: [u8; 5] = [1, 0x03, 0xE8, 0, 1];

    fn host() -> Host {
        let assembly = assemble(&Source::new("p.awl", "LD I0.0\n= Q0.0\n").unwrap(), Vec::new());
        Host::new(assembly.image.unwrap(), Box::new(|_| String::new()))
    }

    fn request(client: &str, pdu: &[u8]) -> (Request, Receiver<Vec<u8>>) {
        let (reply, answer) = channel();
        (Request { client: client.parse().unwrap(), pdu: pdu.to_vec(), reply }, answer)
    }

    fn ask(service: &mut Service, host: &mut Host, client: &str, pdu: &[u8]) -> Vec<u8> {
        let (request, answer) = request(client, pdu);
        service.take(request, host);
        answer.try_recv().unwrap()
    }

    fn service(writes: bool) -> Service {
        Service { access: Access { anywhere: true, writes }, waiting: VecDeque::new(), current: None }
    }

    #[test]
    fn what_other_computers_may_not_write_stays_as_it_is() {
        let (mut service, mut host) = (service(false), host());
        assert_eq!(ask(&mut service, &mut host, "10.0.0.1", &WRITE_M0_0), [0x85, 1]);
        assert_eq!(ask(&mut service, &mut host, "10.0.0.1", &READ_M0_0), [1, 1, 0]);
        assert_eq!(ask(&mut service, &mut host, "127.0.0.1", &WRITE_M0_0), WRITE_M0_0);
        assert_eq!(ask(&mut service, &mut host, "10.0.0.1", &READ_M0_0), [1, 1, 1]);
        service.access.writes = true;
        assert_eq!(ask(&mut service, &mut host, "10.0.0.1", &[5, 0x03, 0xE8, 0, 0]), [5, 0x03, 0xE8, 0, 0]);
        assert_eq!(ask(&mut service, &mut host, "10.0.0.1", &READ_M0_0), [1, 1, 0]);
    }

    #[test]
    fn what_needs_a_scan_is_answered_after_it_and_before_what_came_later() {
        let (mut service, mut host) = (service(true), host());
        host.scan(0);
        let code_at = plc_link::Station::plc(&host).program().unwrap().code_at();
        let mut status = STATUS;
        status[FIRST..FIRST + 2].copy_from_slice(&code_at.to_be_bytes());
        let (first, first_answer) = request("127.0.0.1", &status);
        let (second, second_answer) = request("127.0.0.1", &READ_M0_0);
        service.take(first, &mut host);
        service.take(second, &mut host);
        assert!(first_answer.try_recv().is_err() && second_answer.try_recv().is_err());
        host.scan(1);
        service.go_on(&mut host);
        // Executed, with an empty stack below a 0.
        assert_eq!(first_answer.try_recv().unwrap()[3..], [0x80, 0, 0, 0, 0, 0]);
        assert_eq!(second_answer.try_recv().unwrap(), [1, 1, 0]);
    }

    #[test]
    fn a_request_longer_than_the_room_is_an_exception() {
        let (mut service, mut host) = (service(true), host());
        assert_eq!(ask(&mut service, &mut host, "127.0.0.1", &[16; 253]), [0x90, 3]);
    }
}
