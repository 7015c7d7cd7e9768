//! The same PLC after a serial port: a pseudo-terminal, and something that does what the board
//! does with frames.

use std::fs::{self, File};
use std::io::{ErrorKind, Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread::{self, JoinHandle, sleep};
use std::time::{Duration, Instant};

use client::line::rtu::{answer, frame};
use rustix::fs::{OFlags, fcntl_setfl};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{ControlModes, OptionalActions, tcgetattr, tcsetattr};

use super::{Test, told};

const UNIT: u8 = 5;
/// Frames end with such a pause.
const PAUSE: Duration = Duration::from_millis(3);

/// A board at the end of a cable. Dropping it pulls the cable out.
struct Board {
    is_over: Arc<AtomicBool>,
    /// Requests that it has heard.
    heard: Arc<AtomicUsize>,
    thread: Option<JoinHandle<()>>,
}

impl Board {
    /// Plugs a board in: `port` becomes its serial port. `spoils` says of each answer, by its
    /// number, whether it is damaged; `None` in place of the PLC: a board that never answers.
    fn plug_in(port: &Path, plc: Option<SocketAddr>, spoils: fn(usize) -> bool) -> Board {
        let master = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).unwrap();
        grantpt(&master).unwrap();
        unlockpt(&master).unwrap();
        let name = ptsname(&master, Vec::new()).unwrap();
        let _ = fs::remove_file(port);
        symlink(name.to_str().unwrap(), port).unwrap();
        fcntl_setfl(&master, OFlags::NONBLOCK).unwrap();
        let (is_over, heard) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicUsize::new(0)));
        let thread = thread::spawn({
            let (is_over, heard) = (is_over.clone(), heard.clone());
            move || work(File::from(master), plc, spoils, &is_over, &heard)
        });
        Board { is_over, heard, thread: Some(thread) }
    }
}

impl Drop for Board {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Relaxed);
        self.thread.take().unwrap().join().unwrap();
    }
}

fn work(
    mut line: File,
    plc: Option<SocketAddr>,
    spoils: fn(usize) -> bool,
    is_over: &AtomicBool,
    heard: &AtomicUsize,
) {
    let mut plc = plc.map(|address| TcpStream::connect(address).unwrap());
    let (mut received, mut last) = (Vec::new(), Instant::now());
    while !is_over.load(Ordering::Relaxed) {
        let mut bytes = [0; 256];
        match line.read(&mut bytes) {
            Ok(count) => {
                received.extend_from_slice(&bytes[..count]);
                last = Instant::now();
                continue;
            }
            // EIO: nobody has the port open.
            Err(error)
                if error.kind() == ErrorKind::WouldBlock || error.raw_os_error() == Some(5) => {}
            Err(error) => panic!("{error}"),
        }
        if received.is_empty() || last.elapsed() < PAUSE {
            sleep(Duration::from_micros(300));
            continue;
        }
        let request = std::mem::take(&mut received);
        let (Some(request), Some(plc)) = (answer(UNIT, &request), &mut plc) else { continue };
        let mut reply = frame(UNIT, &asked(plc, request));
        if spoils(heard.fetch_add(1, Ordering::Relaxed)) {
            reply[1] ^= 0x10;
        }
        let _ = line.write_all(&reply);
    }
}

/// Asks the PLC by Modbus TCP.
fn asked(plc: &mut TcpStream, request: &[u8]) -> Vec<u8> {
    let len = (request.len() + 1) as u16;
    plc.write_all(&[&[0, 1, 0, 0][..], &len.to_be_bytes(), &[UNIT], request].concat()).unwrap();
    let mut head = [0; 7];
    plc.read_exact(&mut head).unwrap();
    let mut answer = vec![0; usize::from(u16::from_be_bytes([head[4], head[5]])) - 1];
    plc.read_exact(&mut answer).unwrap();
    answer
}

fn command(port: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_uno200"));
    command.arg("--port").arg(port).args(["--unit", "5"]).args(arguments);
    command
}

fn output(port: &Path, arguments: &[&str]) -> Output {
    command(port, arguments).output().unwrap()
}

#[test]
fn every_function_goes_over_the_line() {
    let test = Test::new();
    let port = test.folder.path().join("port");
    let _board = Board::plug_in(&port, Some(test.plc.address), |_| false);
    let good = |arguments: &[&str]| {
        let (code, text, errors) = told(&output(&port, arguments));
        assert_eq!(code, Some(0), "{arguments:?}: {text}{errors}");
        text
    };
    assert!(good(&["status"]).contains("demo, bytecode"));
    assert_eq!(good(&["set", "MW20=7", "VB0=3"]), "MW20 = 7\nVB0 = 3\n");
    assert_eq!(good(&["force", "I0.0=1", "MW22=5"]), "I0.0 = 1\nMW22 = 5\n");
    let watched = good(&["watch", "MW20", "MB22", "Q0.0", "VD8:real", "--for", "1ms"]);
    assert!(watched.lines().nth(1).unwrap().ends_with("1.5"), "{watched}");
    let image = test.folder.path().join("r.bin");
    good(&["read-program", "-o", image.to_str().unwrap()]);
    assert!(good(&["compare", image.to_str().unwrap()]).starts_with("the same program"));
    assert!(good(&["trace", "MW4", "--every", "1"]).starts_with("time_ms,scan,MW4\n"));
    assert_eq!(good(&["stop"]), "STOP\nnot forced any more: I0.0 = 1, MW22 = 5\n");
    let (code, _, errors) = told(&output(&port, &["set", "I0.0=1"]));
    assert!(code == Some(1) && errors.contains("exception 2"), "{errors}");
}

/// DTR that stays on is no edge at the next opening, and the board is not reset.
#[test]
fn the_system_is_told_to_leave_dtr_on() {
    let test = Test::new();
    let port = test.folder.path().join("port");
    let _board = Board::plug_in(&port, Some(test.plc.address), |_| false);
    let slave = File::options().read(true).write(true).open(&port).unwrap();
    let mut line = tcgetattr(&slave).unwrap();
    line.control_modes.insert(ControlModes::HUPCL);
    tcsetattr(&slave, OptionalActions::Now, &line).unwrap();
    assert!(tcgetattr(&slave).unwrap().control_modes.contains(ControlModes::HUPCL));
    assert_eq!(told(&output(&port, &["force"])).0, Some(0));
    assert!(!tcgetattr(&slave).unwrap().control_modes.contains(ControlModes::HUPCL));
}

#[test]
fn a_damaged_answer_is_asked_for_again() {
    let test = Test::new();
    let port = test.folder.path().join("port");
    let board = Board::plug_in(&port, Some(test.plc.address), |number| number % 2 == 1);
    let (code, text, errors) = told(&output(&port, &["set", "MW20=9"]));
    assert_eq!((code, &*text), (Some(0), "MW20 = 9\n"), "{errors}");
    assert_eq!(board.heard.load(Ordering::Relaxed), 3, "identify, set, set again");
    // Scans are not repeated: twice as many would be done.
    let board_for_scans = Board::plug_in(&port, Some(test.plc.address), |number| number == 2);
    test.good(&["stop"]);
    let (code, _, errors) = told(&output(&port, &["scan", "3"]));
    assert!(code == Some(2) && errors.contains("damaged"), "{code:?} {errors}");
    assert_eq!(board_for_scans.heard.load(Ordering::Relaxed), 3);
}

#[test]
fn nothing_answers() {
    let folder = tempfile::tempdir().unwrap();
    let port = folder.path().join("port");
    let _board = Board::plug_in(&port, None, |_| false);
    let (code, _, errors) = told(&output(&port, &["status"]));
    assert_eq!(code, Some(2));
    for part in ["may have reset the board", "nothing answers at", "unit 5", "freeport", "--baud"] {
        assert!(errors.contains(part), "{part}: {errors}");
    }
}

#[test]
fn a_cable_that_is_unplugged_and_plugged_in_again() {
    let test = Test::new();
    let port = test.folder.path().join("port");
    let board = Board::plug_in(&port, Some(test.plc.address), |_| false);
    let watch = ["watch", "MW4", "--for", "6s", "--every", "50ms", "--format", "csv"];
    let child =
        command(&port, &watch).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    sleep(Duration::from_millis(1000));
    drop(board);
    sleep(Duration::from_millis(700));
    let _board = Board::plug_in(&port, Some(test.plc.address), |_| false);
    let (code, text, errors) = told(&child.wait_with_output().unwrap());
    assert_eq!(code, Some(0), "{errors}");
    assert!(errors.contains("waiting for the connection"), "{errors}");
    let times: Vec<f64> =
        text.lines().skip(1).map(|row| row.split(',').next().unwrap().parse().unwrap()).collect();
    let is_there = |from: f64, to: f64| times.iter().any(|time| (from..to).contains(time));
    assert!(is_there(0.0, 1000.0) && is_there(3500.0, 6000.0), "{times:?}\n{errors}");
}
