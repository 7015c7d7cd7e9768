//! The board answers as the host does: the same requests, sensible and damaged ones, get the same
//! answers and leave the same memory. What the answers are, the tests of plc-link and the list of
//! exchanges say.
#![cfg(feature = "uno")]

#[path = "../../plc/link/tests/machine/requests.rs"]
mod requests;

use awl_asm::Address;
use awl_sim::machine::Machine;
use awl_sim::operand::Operand;
use fastrand::Rng;
use plc_isa::Area;
use tests::bench_board::BenchBoard;
use tests::case::{folder, host, read};
use tests::effort::effort;
use tests::exchange::{comparable, memory};
use tests::image::image;
use tests::link::{self, UNIT};

/// Longest request and answer on the line.
const PDU_MAX: usize = 253;

#[test]
fn random_requests_have_the_same_answers_on_host_and_board() {
    let text = read(&folder("link").join("areas.awl"));
    let image = image(&text);
    let (mut board, mut host) = (BenchBoard::running(&text), host(&image));
    let end = plc_isa::verify(image).unwrap().plan().end();
    let mut now_ms = 0;
    host.scan(now_ms);
    let mut rng = Rng::with_seed(effort("RANDOM_SEED", 1));
    let (mut refused, count) = (0, effort("RANDOM_REQUESTS", 4_000));
    for number in 0..count {
        let request = requests::request(&mut rng);
        // What ends the mode or asks for something that is another each time has tests of its own.
        if matches!(request[0], 65 | 66 | 69 | 70) {
            continue;
        }
        assert!(request.len() <= PDU_MAX);
        let wanted = link::exchange_on_host(&mut host, &mut now_ms, &request);
        let got = link::exchange(&mut board, UNIT, &request);
        let [wanted, got] =
            [wanted, got].map(|answer| answer.map(|answer| comparable(&request, answer)));
        assert_eq!(got, wanted, "request {number}: {request:02X?}");
        refused += u64::from(wanted.is_some_and(|answer| answer[0] >= 0x80));
        board.scans(2);
        let (on_board, on_host) =
            (memory(|at| board.byte(at), end), memory(|at| host.memory().byte(at), end));
        let differs = on_board.iter().zip(&on_host).position(|(board, host)| board != host);
        assert_eq!(differs, None, "memory after request {number}: {request:02X?}");
    }
    println!("{refused} of {count} requests were refused");
    assert!(refused > count / 5 && refused < count * 4 / 5, "{refused} of {count}");
    assert!(board.runs(), "{:?}", board.fault());
}

/// Contacts, a jump, a call, calculations: nothing that depends on time.
const STEPPED: &str = "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\nNETWORK 1\nLD I0.0\nA I0.1\nLD I0.2\n\
    O M0.0\nALD\n= Q0.0\n= M0.0\nNETWORK 2\nLD I0.3\nJMP 1\nLD SM0.0\nINCW VW0\nMOVB IB0, VB4\n\
    LBL 1\nNETWORK 3\nLD I0.4\nCALL SBR0\nLD I0.5\nEU\n+I 3, MW2\nEND_ORGANIZATION_BLOCK\n\
    SUBROUTINE_BLOCK S:SBR0\nBEGIN\nLDW> VW0, 5\nLPS\nA I0.0\nMOVW VW0, MW4\nLPP\n= Q0.1\n\
    END_SUBROUTINE_BLOCK\n";

/// Some of the instructions at these offsets, each with an operand or without.
fn random_window(rng: &mut Rng, offsets: &[u16]) -> Vec<u8> {
    const OPERANDS: [[u8; 3]; 6] =
        [[0xFF, 0, 0], [0x08, 0, 0], [0x10, 0, 0], [0x89, 0, 0], [0x28, 0, 3], [0x20, 0, 0]];
    let all: Vec<u16> = offsets.iter().copied().filter(|_| rng.u8(0..3) > 0).take(24).collect();
    let mut request = vec![100, all.len() as u8];
    for at in all {
        request.extend(at.to_be_bytes());
        request.extend(OPERANDS[rng.usize(..OPERANDS.len())]);
    }
    request
}

#[test]
fn single_scans_tell_the_same_on_host_and_board() {
    let image = image(STEPPED);
    let (mut board, mut host) = (BenchBoard::running(STEPPED), host(&image));
    let program = plc_isa::verify(image).unwrap();
    let instructions = awl_asm::disassemble::instructions(&program);
    let offsets: Vec<u16> = instructions.iter().map(|line| line.at).collect();
    // The program has not run freely: both begin with the same memory.
    let mut now_ms = 0;
    host.scan(now_ms);
    let mut rng = Rng::with_seed(effort("RANDOM_SEED", 1));
    let window = random_window(&mut rng, &offsets);
    assert_eq!(link::ask(&mut board, &window), [0xE4, 4], "in RUN");
    assert_eq!(link::exchange_on_host(&mut host, &mut now_ms, &window), Some(vec![0xE4, 4]));
    for request in
        [&[66, 0, 0, 0][..], &[72, 3, 0x89, 0, 0, 0, 0, 0x2A, 0, 2, 0, 0, 0, 0, 0x20, 0, 0, 0]]
    {
        let answer = link::exchange_on_host(&mut host, &mut now_ms, request);
        assert_eq!(Some(link::ask(&mut board, request)), answer);
    }
    let (mut executed, mut passed) = (0, 0);
    let rounds = effort("RANDOM_SINGLE_SCANS", 200);
    for round in 0..rounds {
        let inputs = rng.u8(0..64);
        board.drive_inputs(inputs);
        host.write(Operand::At(Address::Byte { area: Area::I, byte: 0 }), inputs.into()).unwrap();
        let request = random_window(&mut rng, &offsets);
        let wanted = link::exchange_on_host(&mut host, &mut now_ms, &request).unwrap();
        let got = link::ask(&mut board, &request);
        assert_eq!(got[3..], wanted[3..], "scan {round}, inputs {inputs:06b}, {request:02X?}");
        let noted = || got[3..].chunks(6);
        executed += noted().filter(|entry| entry[0] & 0x80 != 0).count();
        passed += noted().filter(|entry| entry[0] & 0x80 == 0).count();
        assert!(!board.runs() && board.is_released(), "STOP again");
        board.scans(rng.usize(0..5));
        // It is one scan, and what it left is the same.
        let scans = |answer: Vec<u8>| u16::from_be_bytes([answer[1], answer[2]]);
        let words = [67, 2, 0x89, 0, 0, 0x29, 0, 2];
        let on_host = link::exchange_on_host(&mut host, &mut now_ms, &words).unwrap();
        let on_board = link::ask(&mut board, &words);
        assert_eq!(on_board[3..], on_host[3..], "scan {round}");
        assert_eq!(scans(on_board), scans(got), "scan {round}");
    }
    assert!(executed as u64 > rounds * 5 && passed as u64 > rounds, "{executed}, {passed}");
}
