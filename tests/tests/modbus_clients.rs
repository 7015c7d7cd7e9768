//! Modbus clients that people use, mbpoll and pymodbus, against both PLCs: the simulator on the
//! network and the virtual Uno at its port. And a list of exchanges, which both answer byte by
//! byte.
#![cfg(feature = "uno")]

use std::fmt::Write as _;
use std::fs::OpenOptions;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::PathBuf;
use std::process::{Child, Command, Output, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock};
use std::thread;
use std::time::Duration;

use awl_asm::hex::intel_hex;
use simavr::Pin;
use tests::bench_board::BenchBoard;
use tests::case::{folder, read};
use tests::commands;
use tests::image::image;
use tests::link;
use virtual_uno::VirtualUno;

/// The bootloader waits a second for avrdude, and flashes its lamp before that; then the firmware
/// checks the program.
const START_MS: u32 = 2_200;

static AWL_SIM: LazyLock<PathBuf> = LazyLock::new(|| commands::built("awl-sim"));

fn program() -> String {
    read(&folder("link").join("areas.awl"))
}

/// The simulator with the program, until it is dropped.
struct Server {
    child: Child,
    port: u16,
}

impl Server {
    fn start() -> Server {
        let mut command = Command::new(&*AWL_SIM);
        command.arg(folder("link").join("areas.awl")).args(["--serve", "127.0.0.1:0"]);
        let mut child = command.stdout(Stdio::piped()).spawn().expect("the simulator starts");
        let mut line = String::new();
        BufReader::new(child.stdout.as_mut().unwrap()).read_line(&mut line).unwrap();
        let port = line.split("127.0.0.1:").nth(1).and_then(|rest| rest.split(':').next());
        let port =
            port.and_then(|port| port.parse().ok()).unwrap_or_else(|| panic!("no port: {line}"));
        Server { child, port }
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }
}

/// The board at its port, in real time, until it is dropped.
struct Board {
    port: PathBuf,
    ends: Arc<AtomicBool>,
    thread: Option<thread::JoinHandle<()>>,
}

impl Board {
    /// Someone has the port open all the time, so that a client that opens it does not reset the
    /// board.
    fn start() -> Board {
        let (sender, receiver) = std::sync::mpsc::channel();
        let ends = Arc::new(AtomicBool::new(false));
        let end = Arc::clone(&ends);
        let thread = thread::spawn(move || {
            let mut uno = uno();
            sender.send(uno.port().to_path_buf()).unwrap();
            while !end.load(Ordering::Relaxed) {
                uno.step().unwrap();
            }
        });
        let port = receiver.recv().unwrap();
        let holder = OpenOptions::new().read(true).write(true).open(&port).unwrap();
        thread::sleep(Duration::from_millis(u64::from(START_MS)));
        // Open until the process ends.
        std::mem::forget(holder);
        Board { port, ends, thread: Some(thread) }
    }
}

impl Drop for Board {
    fn drop(&mut self) {
        self.ends.store(true, Ordering::Relaxed);
        self.thread.take().unwrap().join().unwrap();
    }
}

fn uno() -> VirtualUno {
    let program_hex = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(&program_hex, intel_hex(&image(&program())).unwrap()).unwrap();
    let mut uno = VirtualUno::new().unwrap();
    uno.load(&commands::kept_firmware()).unwrap();
    uno.load(program_hex.path()).unwrap();
    for pin in 2..=7 {
        uno.avr_mut().drive(Pin::of_uno(pin), false);
    }
    uno
}

fn text(output: &Output) -> String {
    let mut text = String::from_utf8_lossy(&output.stdout).into_owned();
    let _ = write!(text, "{}", String::from_utf8_lossy(&output.stderr));
    text
}

/// mbpoll with these arguments: what it says, and whether it is content.
fn mbpoll(place: &[&str], arguments: &str) -> (bool, String) {
    let mut command = Command::new("mbpoll");
    command
        .args(["-1", "-0", "-o", "3"])
        .args(arguments.split_ascii_whitespace().take_while(|word| *word != "="));
    command
        .args(place)
        .args(arguments.split_ascii_whitespace().skip_while(|word| *word != "=").skip(1));
    let output = command.output().expect("`cargo xtask test` installs mbpoll");
    (output.status.success(), text(&output))
}

/// What mbpoll prints of values: address and value.
fn values(said: &str) -> Vec<(u16, i32)> {
    let lines = said.lines().filter_map(|line| line.strip_prefix('['));
    lines
        .filter_map(|line| {
            let (address, value) = line.split_once("]:")?;
            Some((
                address.trim().parse().ok()?,
                value.split_ascii_whitespace().next()?.parse().ok()?,
            ))
        })
        .collect()
}

fn mbpoll_reads_and_writes(place: &[&str]) {
    let read = |arguments: &str, wanted: &[i32]| {
        let (is_good, said) = mbpoll(place, arguments);
        let got: Vec<i32> = values(&said).into_iter().map(|(_, value)| value).collect();
        assert!(is_good && got == wanted, "mbpoll {arguments}: wanted {wanted:?}\n{said}");
    };
    let write = |arguments: &str| {
        let (is_good, said) = mbpoll(place, arguments);
        assert!(is_good && said.contains("Written"), "mbpoll {arguments}\n{said}");
    };
    let refused = |arguments: &str, words: &str| {
        let (_, said) = mbpoll(place, arguments);
        assert!(said.contains(words), "mbpoll {arguments}: wanted {words}\n{said}");
    };
    // Functions 15, 5, 1, 2.
    write("-t 0 -r 0 = 1 0 1 1");
    write("-t 0 -r 4 = 1");
    read("-t 0 -r 0 -c 6", &[1, 0, 1, 1, 1, 0]);
    write("-t 0 -r 0 = 0 0 0 0 0");
    for first in [1000, 3000] {
        write(&format!("-t 0 -r {} = 1", first + 255));
        read(&format!("-t 0 -r {} -c 2", first + 254), &[0, 1]);
        write(&format!("-t 0 -r {} = 0", first + 255));
    }
    read("-t 0 -r 2000 -c 1", &[1]);
    read("-t 0 -r 4000 -c 100", &[0; 100]);
    read("-t 1 -r 5000 -c 100", &[0; 100]);
    read("-t 1 -r 0 -c 100", &[0; 100]);
    // Functions 16, 6, 3, 4.
    write("-t 4 -r 0 = 100 200 300");
    write("-t 4 -r 3 = 400");
    read("-t 4 -r 0 -c 4", &[100, 200, 300, 400]);
    read("-t 4 -r 0 -c 125", &[&[100, 200, 300, 400][..], &[0; 121]].concat());
    write("-t 4 -r 0 = 0 0 0 0");
    write("-t 4 -r 6037 = 7");
    read("-t 4 -r 6037 -c 2", &[7, 0]);
    write("-t 4 -r 7005 = 8");
    read("-t 4 -r 7005 -c 1", &[8]);
    write("-t 4 -r 8000 = 1 2 3 4 5 6 7 8");
    read("-t 4 -r 8000 -c 12", &[1, 2, 3, 4, 5, 6, 7, 8, 0, 0, 0, 0]);
    write("-t 4 -r 8012 = 32000 1");
    read("-t 4 -r 8012 -c 2", &[32000, 1]);
    write("-t 4 -r 8012 = 0 0");
    read("-t 3 -r 6 -c 26", &[0; 26]);
    refused("-t 4 -r 130 -c 1", "Illegal data address");
    refused("-t 0 -r 128 -c 1", "Illegal data address");
    refused("-t 0 -r 2000 = 1", "Illegal data address");
    refused("-t 4 -r 6000 -c 33", "Illegal data value");
}

fn pymodbus_reads_and_writes(way: &str, place: &str) {
    let script = folder("link").join("pymodbus_client.py");
    let packages = folder("").join("../target/pymodbus");
    assert!(packages.join("pymodbus").exists(), "`cargo xtask test` installs pymodbus");
    let output = Command::new("python3")
        .arg(script)
        .args([way, place])
        .env("PYTHONPATH", packages)
        .output()
        .unwrap();
    let said = text(&output);
    assert!(output.status.success() && said.contains("answers as they should be"), "{said}");
    println!("{way}: {said}");
}

#[test]
fn clients_on_the_network() {
    let server = Server::start();
    let port = server.port.to_string();
    mbpoll_reads_and_writes(&["-m", "tcp", "-p", &port, "127.0.0.1"]);
    pymodbus_reads_and_writes("tcp", &port);
}

#[test]
fn clients_at_the_port_of_a_board() {
    let board = Board::start();
    let port = board.port.to_str().unwrap();
    mbpoll_reads_and_writes(&["-m", "rtu", "-b", "115200", "-P", "none", port]);
    pymodbus_reads_and_writes("rtu", port);
}

/// A request and the answer to it, in which a dot stands for any half byte.
struct Exchange {
    line: usize,
    request: Vec<u8>,
    answer: String,
}

fn exchanges() -> Vec<Exchange> {
    let text = read(&folder("link").join("exchanges.txt"));
    let lines: Vec<_> =
        text.lines().enumerate().filter(|(_, line)| line.starts_with(['>', '<'])).collect();
    let digits = |line: &str| line[1..].replace(' ', "");
    let byte = |pair: &[u8]| u8::from_str_radix(str::from_utf8(pair).unwrap(), 16).unwrap();
    lines
        .chunks(2)
        .map(|pair| {
            let [(line, request), (_, answer)] = *pair else {
                panic!("a request without an answer")
            };
            assert!(request.starts_with('>') && answer.starts_with('<'), "line {}", line + 1);
            let request = digits(request).as_bytes().chunks(2).map(byte).collect();
            Exchange { line: line + 1, request, answer: digits(answer) }
        })
        .collect()
}

impl Exchange {
    fn check(&self, answer: &[u8]) {
        let got: String = answer.iter().map(|byte| format!("{byte:02X}")).collect();
        let is_same = got.len() == self.answer.len()
            && got
                .chars()
                .zip(self.answer.chars())
                .all(|(got, wanted)| wanted == '.' || got == wanted);
        assert!(
            is_same,
            "exchanges.txt:{}: {:02X?}\n got    {got}\n wanted {}",
            self.line, self.request, self.answer
        );
    }
}

/// The same with a simulator, which says that it is one: length and text of the product code.
fn of_a_simulator(exchange: &Exchange) -> Exchange {
    let object = |text: &str| {
        let bytes = [&[text.len() as u8], text.as_bytes()].concat();
        bytes.iter().map(|byte| format!("{byte:02X}")).collect::<String>()
    };
    let answer = exchange.answer.replace(&object("Arduino Uno"), &object("simulator"));
    Exchange { request: exchange.request.clone(), answer, ..*exchange }
}

/// One exchange on the network: the frame of Modbus TCP around both.
fn exchange_on_network(stream: &mut TcpStream, number: u16, request: &[u8]) -> Vec<u8> {
    let len = u16::try_from(request.len() + 1).unwrap();
    let mut frame = [number.to_be_bytes(), [0, 0], len.to_be_bytes()].concat();
    frame.push(1);
    frame.extend(request);
    stream.write_all(&frame).unwrap();
    let mut answer_head = [0; 7];
    stream.read_exact(&mut answer_head).unwrap();
    let [number_high, number_low, 0, 0, len_high, len_low, 1] = answer_head else {
        panic!("{answer_head:02X?}")
    };
    assert_eq!([number_high, number_low], number.to_be_bytes());
    let mut answer = vec![0; usize::from(u16::from_be_bytes([len_high, len_low])) - 1];
    stream.read_exact(&mut answer).unwrap();
    answer
}

#[test]
fn exchanges_byte_by_byte_on_the_network() {
    let server = Server::start();
    let mut stream = TcpStream::connect(("127.0.0.1", server.port)).unwrap();
    stream.set_read_timeout(Some(Duration::from_secs(10))).unwrap();
    let exchanges = exchanges();
    assert!(exchanges.len() >= 60, "{}", exchanges.len());
    for (number, exchange) in exchanges.iter().map(of_a_simulator).enumerate() {
        // On the board a scan lies between two exchanges, too.
        thread::sleep(Duration::from_millis(5));
        exchange.check(&exchange_on_network(&mut stream, number as u16, &exchange.request));
    }
}

#[test]
fn exchanges_byte_by_byte_on_the_line() {
    let mut board = BenchBoard::running(&program());
    for exchange in exchanges() {
        let answer = link::exchange(&mut board, 1, &exchange.request);
        exchange
            .check(&answer.unwrap_or_else(|| panic!("exchanges.txt:{}: no answer", exchange.line)));
    }
}
