//! The firmware of the Pico answers on its line as the host does, and takes no image that the host
//! does not take.
//!
//! `RANDOM_REQUESTS=20000 BROKEN_IMAGES=5000 cargo test --package tests --features pico --test
//! pico_link` runs longer.
#![cfg(feature = "pico")]

#[path = "../../plc/link/tests/machine/requests.rs"]
mod requests;

use awl_sim::machine::pico::Pico;
use awl_sim::machine::{Machine, Mode};
use fastrand::Rng;
use plc_isa::{HEADER_LEN, PICO, verify};
use plc_vm::Inputs;
use tests::beside::Pair;
use tests::case::{folder, host, read};
use tests::effort::effort;
use tests::exchange::{comparable, exchange_on_host, memory};
use tests::image::{image_for, sign};
use tests::pico::{OnPico, exchange, pico};
use tests::random_runs::{Programs, random_image_for};

/// A Pico in its first scan.
fn running(image: &[u8]) -> Pico {
    let mut pico = pico();
    pico.load(image.to_vec());
    pico.set_inputs(&Inputs::default());
    pico.scan(0);
    pico
}

#[test]
fn random_requests_have_the_same_answers_as_on_the_host() {
    let image = image_for(&read(&folder("link").join("areas.awl")), &PICO);
    let (mut pico, mut host) = (running(&image), host(&image));
    let end = verify(image).unwrap().plan().end();
    let (mut on_pico_ms, mut on_host_ms) = (0, 0);
    host.scan(0);
    let mut rng = Rng::with_seed(effort("RANDOM_SEED", 1));
    let (mut refused, count) = (0, effort("RANDOM_REQUESTS", 1_000));
    for number in 0..count {
        let request = requests::request(&mut rng);
        // What ends the mode, is another each time, or is not on the host.
        if matches!(request[0], 65 | 66 | 69 | 70 | 101) {
            continue;
        }
        let wanted = exchange_on_host(&mut host, &mut on_host_ms, &request);
        let got = exchange(&mut pico, &mut on_pico_ms, &request);
        let [wanted, got] =
            [wanted, got].map(|answer| answer.map(|answer| comparable(&request, answer)));
        let is_who = request[0] == 43 && got.as_ref().is_some_and(|answer| answer[0] == 43);
        assert!(is_who || got == wanted, "request {number}: {request:02X?}: {got:?}, {wanted:?}");
        refused += u64::from(wanted.is_some_and(|answer| answer[0] >= 0x80));
        let bytes = pico.memory();
        let on_pico = memory(|at| bytes[usize::from(at - plc_isa::DATA_START)], end);
        let on_host = memory(|at| host.memory().byte(at), end);
        let differs = on_pico.iter().zip(&on_host).position(|(pico, host)| pico != host);
        assert_eq!(differs, None, "memory after request {number}: {request:02X?}");
    }
    println!("{refused} of {count} requests were refused");
    assert!(refused > count / 5 && refused < count * 4 / 5, "{refused} of {count}");
    assert_eq!((pico.mode(), pico.broken()), (Mode::Run, None));
}

/// Images that are right in all but some bytes: what is refused has the same reason on both, drives
/// nothing, and answers; what is not runs alike.
#[test]
fn broken_images_are_refused_as_on_the_host() {
    let (first, count) = (effort("RANDOM_SEED", 1), effort("BROKEN_IMAGES", 200));
    let mut emulator = pico();
    let mut refused = 0;
    for seed in first..first + count {
        let (mut image, text, mut rng) = random_image_for(seed, Programs::Everything, &PICO);
        for _ in 0..rng.usize(1..4) {
            let at = rng.usize(usize::from(HEADER_LEN) / 2..image.len());
            image[at] = if rng.bool() { rng.u8(..) } else { image[at] ^ 1 << rng.u8(..8) };
        }
        sign(&mut image);
        let is_good = verify(image.clone()).is_ok();
        let mut pair = Pair::new(OnPico::with(&mut emulator, &image), &image);
        for scan in 0..2 {
            pair.scan(scan);
            assert_eq!(pair.difference(), None, "seed {seed}, scan {scan}\n{text}");
        }
        drop(pair);
        if !is_good {
            refused += 1;
            assert_eq!((emulator.mode(), emulator.outputs()), (Mode::Stop, None), "seed {seed}");
            let answer = exchange(&mut emulator, &mut 10, &[65]).expect("an answer");
            assert_eq!((answer[3], answer[4]), (0, 1), "no program, and a bad image: {answer:?}");
        }
    }
    println!("{refused} of {count} images were refused");
    assert!(refused > count / 4, "{refused}");
}
