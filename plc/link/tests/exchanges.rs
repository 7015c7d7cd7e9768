//! The exchanges that were written by hand from the protocol: requests and their answers, byte by
//! byte.

mod machine;

use std::fs;
use std::path::Path;

use machine::Machine;
use plc_link::Command;

fn bytes(text: &str) -> Vec<u8> {
    text.split_whitespace().map(|byte| u8::from_str_radix(byte, 16).unwrap()).collect()
}

fn matches(answer: &[u8], expected: &str) -> bool {
    let expected: Vec<&str> = expected.split_whitespace().collect();
    expected.len() == answer.len()
        && expected.iter().zip(answer).all(|(expected, byte)| {
            expected
                .chars()
                .zip(format!("{byte:02X}").chars())
                .all(|(expected, half)| expected == '.' || expected == half)
        })
}

/// What a machine does with a command.
fn obey(machine: &mut Machine) {
    for command in std::mem::take(&mut machine.commands) {
        match command {
            Command::Stop => {
                machine.plc.stop();
                let (memory, link) = (&mut machine.memory, &mut machine.link);
                link.forces.clear(memory);
            }
            Command::Run => {
                machine.plc.run();
            }
            Command::ClearFault => {}
            Command::Scans(count) => {
                machine.plc.run();
                for _ in 0..count {
                    machine.scan();
                }
                machine.plc.stop();
            }
        }
    }
}

#[test]
fn every_exchange_is_as_written() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/link");
    let program = fs::read_to_string(folder.join("areas.awl")).unwrap();
    let text = fs::read_to_string(folder.join("exchanges.txt")).unwrap();
    let mut machine = Machine::with_room(&program, 252);
    let (mut request, mut wrong, mut count) = ("", Vec::new(), 0);
    for (number, line) in text.lines().enumerate() {
        if let Some(line) = line.strip_prefix('>') {
            request = line;
        } else if let Some(expected) = line.strip_prefix('<') {
            let answer = machine.ask(&bytes(request));
            obey(&mut machine);
            machine.scan();
            if !matches(&answer, expected) {
                wrong.push(format!(
                    "line {}: >{request}\n  <{expected}\n  is {answer:02X?}",
                    number + 1
                ));
            }
            count += 1;
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(count > 100);
}
