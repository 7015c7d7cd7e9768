//! A PLC on the network, with sockets, threads and a clock: what drives an [`Endpoint`].
//!
//! Everything happens in one thread, except that each client has one in which its frames are read
//! and written.

use std::io;
use std::net::{SocketAddr, TcpListener};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::Instant;

use super::service::{Answer, Request};
use super::{Access, Change, Endpoint, network};
use crate::machine::MachineError;
use crate::machine::host::Host;
use crate::run::{Course, Outcome};

/// What comes in from other threads.
pub(super) enum Event {
    /// A request, with the way back to the client's thread.
    Request(Request<Sender<Vec<u8>>>),
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

    /// Runs the PLC in real time, a scan every `scan_ms` milliseconds, until it is stopped. Its own
    /// threads end with the process. `tell` hears of changes. Fails only if the machine cannot
    /// access an operand, in the first scan.
    pub fn run(
        self,
        host: &mut Host,
        course: Course,
        scan_ms: u64,
        tell: &mut dyn FnMut(&Change),
    ) -> Result<Outcome, MachineError> {
        let Server { listener, access, sender, events, .. } = self;
        thread::spawn(move || network::accept(&listener, &sender));
        let begin = Instant::now();
        host.call_itself_simulator();
        host.measure_with(Box::new(move || begin.elapsed().as_micros() as u64));
        let mut endpoint = Endpoint::new(course, scan_ms, access, begin.elapsed());
        loop {
            endpoint.go_on(host, begin.elapsed())?;
            reply(&mut endpoint);
            if let Some(change) = endpoint.change(host) {
                tell(&change);
            }
            // At most one before the next look at the time: neither scans nor clients wait for
            // ever.
            match events.recv_timeout(endpoint.until_next(begin.elapsed())) {
                Ok(Event::Request(request)) => endpoint.ask(host, request),
                Err(RecvTimeoutError::Timeout) => {}
                Ok(Event::Stop) | Err(RecvTimeoutError::Disconnected) => break,
            }
            reply(&mut endpoint);
        }
        Ok(endpoint.finish())
    }
}

fn reply(endpoint: &mut Endpoint<Sender<Vec<u8>>>) {
    for Answer { to, pdu } in endpoint.answers() {
        // Fails when the client has gone.
        let _ = to.send(pdu);
    }
}
