//! A PLC that runs in this process in real time, as `awl-sim --serve` does.

use std::net::SocketAddr;
use std::path::Path;
use std::sync::mpsc::channel;
use std::thread;

use awl_sim::open::open_host;
use awl_sim::run::Course;
use awl_sim::scenario::Scenario;
use awl_sim::serve::{Access, Server, Stopper};

/// A PLC that ends with this value.
pub struct Plc {
    /// Where it listens.
    pub address: SocketAddr,
    stopper: Stopper,
}

impl Plc {
    /// Runs a program with a scan each millisecond, or as it says itself.
    pub fn start(program: &Path) -> Plc {
        let program = program.to_owned();
        let (sender, receiver) = channel();
        thread::spawn(move || {
            let access = Access { anywhere: false, writes: false };
            let server = Server::listen(&["127.0.0.1:0".parse().unwrap()], access).unwrap();
            sender.send((server.address(), server.stopper())).unwrap();
            let opened = open_host(&program, &[]).unwrap();
            let (mut host, scan_ms) = (opened.machine, opened.scan_ms.unwrap_or(1));
            let course = Course::new(&Scenario::default(), None, scan_ms);
            server.run(&mut host, course, scan_ms, &mut |_| {}).unwrap();
        });
        let (address, stopper) = receiver.recv().unwrap();
        Plc { address, stopper }
    }
}

impl Drop for Plc {
    fn drop(&mut self) {
        self.stopper.stop();
    }
}
