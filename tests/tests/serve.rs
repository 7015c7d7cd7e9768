//! The simulator as a PLC on the network, with a client of somebody else's. What the answers are in
//! detail, plc-link's own tests say.

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use awl_asm::assemble::assemble;
use awl_asm::source::Source;
use awl_sim::machine::Mode;
use awl_sim::machine::host::Host;
use awl_sim::run::{Course, Outcome};
use awl_sim::scenario::Scenario;
use awl_sim::serve::{Access, Change, Server, Stopper};
use tokio_modbus::client::sync::tcp::connect;
use tokio_modbus::client::sync::{Client, Context, Reader, Writer};
use tokio_modbus::{ExceptionCode, Request, Response};

/// Every area: Q0.0 follows I0.0, VW0 counts scans, the rest is only there.
const AREAS: &str = "
LD I0.0
= Q0.0
LD SM0.0
INCW VW0
MOVW VW10, VW12
MOVW AIW0, VW4
MOVW AC1, AC2
LD M0.1
= Q0.1
TON T37, +100
LD M0.2
LD M0.3
CTU C5, +3
";

fn host(text: &str) -> Host {
    let assembly = assemble(&Source::new("p.awl", text).unwrap(), Vec::new());
    let image = assembly.image.unwrap_or_else(|| panic!("{:?}", assembly.diagnostics));
    Host::new(image, Box::new(|at| format!("byte {at}")))
}

/// A server in a thread of its own.
struct Plc {
    address: SocketAddr,
    stopper: Stopper,
    thread: JoinHandle<(Outcome, Vec<Change>)>,
}

impl Plc {
    fn start(text: &'static str) -> Plc {
        let server = Server::listen(&["127.0.0.1:0".parse().unwrap()], Access::default()).unwrap();
        let (address, stopper) = (server.address(), server.stopper());
        let thread = thread::spawn(move || {
            let (scenario, mut changes) = (Scenario::default(), Vec::new());
            let course = Course::new(&scenario, None, 1);
            let outcome = server
                .run(&mut host(text), course, 1, &mut |change| changes.push(change.clone()))
                .unwrap();
            (outcome, changes)
        });
        Plc { address, stopper, thread }
    }

    fn client(&self) -> Context {
        connect(self.address).unwrap()
    }

    fn stop(self) -> (Outcome, Vec<Change>) {
        self.stopper.stop();
        self.thread.join().unwrap()
    }
}

/// The answer of a service function, without its code.
fn service(client: &mut Context, function: u8, data: &[u8]) -> Vec<u8> {
    match client.call(Request::Custom(function, data.to_vec().into())).unwrap().unwrap() {
        Response::Custom(answered, bytes) if answered == function => bytes.to_vec(),
        other => panic!("{other:?}"),
    }
}

/// Waits until it is so.
fn until(mut is_so: impl FnMut() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(start.elapsed() < Duration::from_secs(10), "in ten seconds it has not come");
        thread::sleep(Duration::from_millis(1));
    }
}

#[test]
fn every_area_is_read_and_written() {
    let plc = Plc::start(AREAS);
    let mut client = plc.client();
    // M0.1 makes Q0.1 and starts T37.
    client.write_single_coil(1001, true).unwrap().unwrap();
    until(|| client.read_coils(0, 2).unwrap().unwrap() == [false, true]);
    client.write_multiple_coils(1016, &[true, false, true]).unwrap().unwrap();
    assert_eq!(client.read_coils(1016, 3).unwrap().unwrap(), [true, false, true]);
    client.write_multiple_coils(3000, &[true; 8]).unwrap().unwrap();
    assert_eq!(
        client.read_discrete_inputs(3000, 9).unwrap().unwrap(),
        [[true; 8].as_slice(), &[false]].concat()
    );
    assert_eq!(client.read_coils(2000, 1).unwrap().unwrap(), [true]);
    assert_eq!(client.read_discrete_inputs(0, 128).unwrap().unwrap(), [false; 128]);
    assert_eq!(client.read_coils(6000, 128).unwrap().unwrap(), [false; 128]);
    assert_eq!(client.read_coils(4037, 1).unwrap().unwrap(), [false]);
    assert_eq!(client.read_coils(5005, 1).unwrap().unwrap(), [false]);

    client.write_single_register(5, 0x1234).unwrap().unwrap();
    until(|| client.read_holding_registers(5, 2).unwrap().unwrap() == [0x1234, 0x1234]);
    client.write_multiple_registers(5, &[7, 8]).unwrap().unwrap();
    until(|| client.read_holding_registers(5, 2).unwrap().unwrap() == [7, 7]);
    assert_eq!(client.read_write_multiple_registers(5, 1, 5, &[99]).unwrap().unwrap(), [99]);
    let before = client.read_holding_registers(0, 1).unwrap().unwrap();
    until(|| client.read_holding_registers(0, 1).unwrap().unwrap() != before);
    until(|| client.read_holding_registers(6037, 1).unwrap().unwrap()[0] > 0);
    assert_eq!(client.read_holding_registers(7005, 1).unwrap().unwrap(), [0]);
    client.write_multiple_registers(8002, &[1, 2]).unwrap().unwrap();
    until(|| client.read_holding_registers(8004, 2).unwrap().unwrap() == [0, 2]);
    assert_eq!(client.read_input_registers(0, 32).unwrap().unwrap(), [0; 32]);
    let (outcome, changes) = plc.stop();
    assert!(outcome.scans > 0);
    assert_eq!(changes, []);
}

#[test]
fn what_cannot_be_is_an_exception() {
    let plc = Plc::start(AREAS);
    let mut client = plc.client();
    assert_eq!(client.read_coils(500, 1).unwrap(), Err(ExceptionCode::IllegalDataAddress));
    assert_eq!(client.read_coils(0, 0).unwrap(), Err(ExceptionCode::IllegalDataValue));
    assert_eq!(
        client.write_single_coil(6000, true).unwrap(),
        Err(ExceptionCode::IllegalDataAddress)
    );
    assert_eq!(
        client.read_holding_registers(1, 1).unwrap(),
        Err(ExceptionCode::IllegalDataAddress)
    );
    assert_eq!(client.masked_write_register(5, 0, 0).unwrap(), Err(ExceptionCode::IllegalFunction));
    plc.stop();
}

/// The answer to a frame of which only the unit and what is after it are given.
fn exchange(stream: &mut TcpStream, unit: u8, pdu: &[u8]) -> Vec<u8> {
    let header = [0xAB, 0xCD, 0, 0, 0, pdu.len() as u8 + 1, unit];
    stream.write_all(&[&header, pdu].concat()).unwrap();
    let mut header = [0; 7];
    stream.read_exact(&mut header).unwrap();
    assert_eq!([&header[..5], &header[6..]].concat(), [0xAB, 0xCD, 0, 0, 0, unit]);
    let mut pdu = vec![0; usize::from(header[5]) - 1];
    stream.read_exact(&mut pdu).unwrap();
    pdu
}

#[test]
fn malformed_requests_are_exceptions_and_the_connection_stays() {
    let plc = Plc::start(AREAS);
    let mut stream = TcpStream::connect(plc.address).unwrap();
    let cases: [(&[u8], &[u8]); 6] = [
        (&[5, 0, 0, 0x12, 0x34], &[0x85, 3]),
        (&[15, 0, 0, 0, 100, 1, 0xFF], &[0x8F, 3]),
        (&[16, 0, 0, 0x80, 1, 2, 0, 0], &[0x90, 3]),
        (&[3, 0, 5], &[0x83, 3]),
        (&[43, 13, 1, 0], &[0xAB, 1]),
        (&[200], &[200, 1]),
    ];
    for (unit, (request, answer)) in (0..).zip(cases) {
        assert_eq!(exchange(&mut stream, unit, request), answer, "{request:?}");
    }
    assert_eq!(exchange(&mut stream, 255, &[1, 0, 0, 0, 1]), [1, 1, 0]);
    plc.stop();
}

#[test]
fn clients_are_served_side_by_side_and_may_go() {
    let plc = Plc::start(AREAS);
    let mut clients: Vec<_> = (0..8).map(|_| plc.client()).collect();
    for _ in 0..20 {
        for client in &mut clients {
            assert_eq!(client.read_coils(2000, 1).unwrap().unwrap(), [true]);
        }
    }
    // Q0.1 is forced on; then the client that did it is gone, and one that has sent half a request.
    assert_eq!(service(&mut clients[0], 68, &[1, 0x11, 0, 0, 0, 0, 0, 1]).len(), 8);
    drop(clients);
    TcpStream::connect(plc.address).unwrap().write_all(&[0, 0, 0, 0, 0, 6, 1, 3, 0]).unwrap();
    let mut client = plc.client();
    let scans = |client: &mut Context| client.read_holding_registers(0, 1).unwrap().unwrap();
    let before = scans(&mut client);
    until(|| scans(&mut client) != before);
    assert_eq!(client.read_coils(1, 1).unwrap().unwrap(), [true]);
    assert_eq!(service(&mut client, 65, &[])[2] & 0b111, 0b111);
    plc.stop();
}

#[test]
fn clients_command_and_see_a_fault() {
    let plc = Plc::start("LBL 1\nLD M0.0\nJMP 1\nLD SM0.0\n= Q0.0\n");
    let mut client = plc.client();
    let state = |client: &mut Context| service(client, 65, &[])[2];
    assert_eq!(state(&mut client) & 1, 1);
    assert_eq!(service(&mut client, 66, &[0, 0, 0]), [0, 0, 0]);
    until(|| state(&mut client) & 1 == 0);
    assert_eq!(service(&mut client, 66, &[1, 0, 0]), [1, 0, 0]);
    until(|| state(&mut client) & 1 == 1);
    client.write_single_coil(1000, true).unwrap().unwrap();
    until(|| state(&mut client) & 1 == 0);
    // A watchdog fault, and the server goes on.
    assert_eq!(service(&mut client, 65, &[])[3], 2);
    let (_, changes) = plc.stop();
    let modes: Vec<_> =
        changes.iter().map(|change| (change.mode, change.fault.is_some())).collect();
    assert_eq!(modes, [(Mode::Stop, false), (Mode::Run, false), (Mode::Stop, true)]);
}
