//! The firmware of the micro:bit, the board of docs/porting.md, in QEMU: points, line, faults,
//! retained values. What instructions do is plc-vm's, as on every board of `runtime`.
#![cfg(feature = "microbit")]

use std::fs;
use std::thread::sleep;
use std::time::{Duration, Instant};

use awl_sim::machine::Machine;
use awl_sim::machine::host::Host;
use client::Operand;
use client::service::{Command, Identity, Object};
use plc_isa::{MICROBIT, UNO};
use plc_vm::Fault;
use tests::case::{folder, host};
use tests::image::image_for;
use tests::microbit::{Microbit, PATIENCE};
use uno200::Client;
use uno200::transport::{SerialSettings, Target};

/// Pins of the chip: button A, the first ring, the first LED of the line with its row, and P8.
const BUTTON_A: u8 = 17;
const RING_P0: u8 = 3;
const LED_1: u8 = 7;
const ROW: u8 = 15;
const P8: u8 = 18;

/// Lines of code that a board may take beside its drivers: who ports to another writes so many.
const BOARD_LINES_MAX: usize = 200;
/// What nrf51-hal lacks: a line that an interrupt reads, and flash.
const DRIVERS: [&str; 2] = ["serial.rs", "flash.rs"];

fn board(text: &str) -> Microbit {
    Microbit::with(&image_for(text, &MICROBIT))
}

fn client(board: &Microbit) -> Client {
    let port = Some(board.line().to_owned());
    Client::new(Target::Serial(SerialSettings { port, ..SerialSettings::default() }), |_| {})
}

/// Waits until the board is as it should be.
#[track_caller]
fn wait_for(client: &mut Client, what: &str, is_so: impl Fn(&Identity) -> bool) -> Identity {
    let begin = Instant::now();
    loop {
        let identity = client.identify().unwrap();
        if is_so(&identity) {
            return identity;
        }
        assert!(begin.elapsed() < PATIENCE, "{what}: {identity:?}");
        sleep(Duration::from_millis(10));
    }
}

fn values(client: &mut Client, operands: &[&str]) -> Vec<u32> {
    let operands = operands.iter().map(|text| Operand::parse(text, &[]).unwrap());
    client.watch_operands(&operands.collect::<Vec<_>>()).unwrap().values
}

#[test]
fn a_lamp_blinks_a_button_switches_and_stop_switches_off() {
    let mut board = board("//# name blink\nLD SM0.5\n= Q0.0\nLD I0.0\n= Q0.5\n");
    board.drive(BUTTON_A, true);
    // An LED is on where its column is low and its row high.
    for is_on in [true, false, true] {
        board.wait_for(LED_1, Some(!is_on));
    }
    assert_eq!(board.level(ROW), Some(true));
    board.wait_for(P8, Some(false));
    board.drive(BUTTON_A, false);
    board.wait_for(P8, Some(true));

    let mut client = client(&board);
    let product = client.identification(Object::Product).unwrap();
    assert_eq!(product.as_deref(), Some("BBC micro:bit"));
    client.control(Command::Stop).unwrap();
    for pin in [LED_1, ROW, P8] {
        board.wait_for(pin, None);
    }
    client.control(Command::Run).unwrap();
    board.wait_for(P8, Some(true));
}

/// Reals, strings, shifts and a subroutine: what the Uno needs modules for, and nothing of time.
/// I0.2 begins anew.
const CALCULATING: &str = "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\n\
    NETWORK 1\nLD I0.2\nMOVR 1.5, VD0\nSCPY \"micro\", VB100\nSCPY \"bit\", VB120\n\
    MOVW 0, VW20\nMOVW 0, MW2\n\
    NETWORK 2\nLD SM0.0\nMOVR VD0, VD4\n*R 1.25, VD4\nSQRT VD4, VD8\n+R VD8, VD0\n\
    SIN VD0, VD12\nSLEN VB100, VB16\nSCAT VB120, VB100\nRLW VW20, 3\n\
    NETWORK 3\nLD I0.0\nCALL SBR0\nLDN I0.0\n= Q0.7\nEND_ORGANIZATION_BLOCK\n\
    SUBROUTINE_BLOCK S:SBR0\nBEGIN\nLD SM0.0\nINCW VW20\nMOVW VW20, MW2\n\
    END_SUBROUTINE_BLOCK\n";

/// What is compared.
const SEEN: [&str; 9] = ["VD0", "VD4", "VD8", "VD12", "VB16", "VW20", "VD100", "VW104", "MW2"];

fn on_host(text: &str) -> awl_sim::operand::Operand {
    awl_sim::operand::Operand::parse(text, &[]).unwrap()
}

/// The values on the host, as they are asked for on the line.
fn values_on(host: &mut Host) -> Vec<u32> {
    let value = |text: &str| {
        let value = host.read(on_host(text)).unwrap();
        if text.contains('D') { value as u32 } else { u32::from(value as u16) }
    };
    SEEN.map(value).to_vec()
}

#[test]
fn single_scans_are_those_of_the_host() {
    let image = image_for(CALCULATING, &MICROBIT);
    let (mut board, mut host) = (Microbit::with(&image), host(&image));
    board.drive(BUTTON_A, true);
    let mut client = client(&board);
    client.control(Command::Stop).unwrap();
    wait_for(&mut client, "STOP", |is| !is.is_running);
    let mut rng = fastrand::Rng::with_seed(1);
    for number in 0..40 {
        let begins = number == 0;
        board.drive(RING_P0, begins);
        let is_pressed = rng.bool();
        board.drive(BUTTON_A, !is_pressed);
        for (input, value) in [("I0.0", is_pressed), ("I0.2", begins)] {
            host.write(on_host(input), value.into()).unwrap();
        }
        client.control(Command::Scans(1)).unwrap();
        wait_for(&mut client, "the end of the scan", |is| !is.is_scanning && !is.is_running);
        host.scan(number);
        assert_eq!(values(&mut client, &SEEN), values_on(&mut host), "scan {number}");
    }
}

#[test]
fn images_that_are_not_for_it_leave_it_in_stop() {
    let mut damaged = image_for("LD I0.0\n= Q0.5\n", &MICROBIT);
    damaged[40] ^= 1;
    for slot in [image_for("LD I0.0\n= Q0.0\n", &UNO), damaged] {
        let mut board = Microbit::with(&slot);
        let refused = client(&board).identify().unwrap();
        assert!(matches!(Fault::from_bytes(refused.fault), Some(Fault::BadImage(_))));
        assert!(!refused.is_running && !refused.has_program);
        assert_eq!([LED_1, ROW, P8].map(|pin| board.level(pin)), [None; 3]);
    }
    let empty = client(&Microbit::with(&[0xFF; 4])).identify().unwrap();
    assert_eq!((empty.fault, empty.is_running), ([0; 4], false));
}

#[test]
fn an_endless_loop_is_a_fault_that_outlives_a_reset() {
    let text = "//# watchdog 50ms\nLD SM0.0\n= Q0.5\nLBL 1\nLD I0.2\nJMP 1\n";
    let mut board = board(text);
    board.wait_for(P8, Some(true));
    board.drive(RING_P0, true);
    let mut client = client(&board);
    let fault = wait_for(&mut client, "the watchdog", |is| !is.is_running).fault;
    assert!(matches!(Fault::from_bytes(fault), Some(Fault::Watchdog { .. })), "{fault:?}");
    board.wait_for(P8, None);
    // A reset takes what is at the pins, too: the loop ends at once.
    board.reset();
    let after = wait_for(&mut client, "RUN after the reset", |is| is.is_running);
    assert_eq!((after.fault, after.fault_before_reset), (Fault::NONE, fault));
    board.wait_for(P8, Some(true));
}

#[test]
fn retained_values_come_back() {
    let mut board = board("//# retain VB0-VB1\nLD I0.0\nEU\nINCW VW0\nLD SM0.0\nINCW VW2\n");
    let mut client = client(&board);
    // A button that is low is pressed.
    for _ in 0..3 {
        let before = values(&mut client, &["VW0"])[0];
        board.drive(BUTTON_A, true);
        sleep(Duration::from_millis(100));
        board.drive(BUTTON_A, false);
        let begin = Instant::now();
        while values(&mut client, &["VW0"]) == [before] {
            assert!(begin.elapsed() < PATIENCE, "nothing is counted");
        }
    }
    // In STOP what has changed is saved at once.
    client.control(Command::Stop).unwrap();
    let counted = values(&mut client, &["VW0"]);
    assert!(counted[0] >= 3);
    sleep(Duration::from_millis(500));
    board.reset();
    wait_for(&mut client, "RUN after the reset", |is| is.is_running);
    assert_eq!(values(&mut client, &["VW0"]), counted);
}

#[test]
fn it_is_small() {
    let mut lines = 0;
    let board = folder("../firmware-microbit/src/board");
    let files = fs::read_dir(board).unwrap().map(|entry| entry.unwrap().path());
    let is_counted = |name: &str| !DRIVERS.contains(&name);
    for file in files.chain([folder("../firmware-microbit/src/main.rs")]) {
        if is_counted(file.file_name().unwrap().to_str().unwrap()) {
            let text = fs::read_to_string(file).unwrap();
            let code = text.lines().map(str::trim);
            lines += code.filter(|line| !line.is_empty() && !line.starts_with("//")).count();
        }
    }
    println!("{lines} lines");
    assert!((50..=BOARD_LINES_MAX).contains(&lines), "{lines} lines");
}
