//! Power flow of every line, compared with an independent observer of the same scan.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fs;

use awl_asm::source::Source;
use client::Program;
use client::Reference;
use client::service::windows;
use client::show::model::{Flow, Model};
use plc_isa::{Op, decode};
use uno200::Client;

use crate::bench::{Bench, connect};
use crate::example;

/// Asks for so many windows, and compares each line in them with what the observer saw in that
/// scan. Returns how often lines were seen with power flow, without, and not executed.
fn compare(program: &Program, bench: Bench, count: usize) -> [usize; 3] {
    let model = Model::new(program);
    let (bench, mut client): (_, Client) = connect(bench);
    let room = client.identify().unwrap().room;
    let offsets = model
        .rows
        .iter()
        .zip(0..)
        .filter_map(|(line, row)| Some((line.instruction()?.offset?, row)));
    let rows: BTreeMap<u16, usize> = offsets.collect();
    let in_image: Vec<_> = rows.keys().map(|&offset| (offset, Reference::NONE)).collect();
    let all = windows(&in_image, room.into());
    let mut seen = [0; 3];
    for asked in all.iter().cycle().take(count) {
        let status = client.status(asked).unwrap();
        let answers = asked.iter().map(|&(offset, _)| offset).zip(status.executed.iter().copied());
        let answers: HashMap<u16, _> = answers.collect();
        let flows = model.power_flow(&answers);
        let observed = bench.with(|bench| bench.observed.clone());
        for (offset, _) in *asked {
            let row = rows[offset];
            let expected = match observed.get(offset) {
                None => Flow::NotExecuted,
                Some(stack) if stack & 1 == 1 => Flow::On,
                Some(_) => Flow::Off,
            };
            let line = (row + 1, &model.rows[row].text);
            assert_eq!(flows[row], Some(expected), "{line:?} of {}", model.name);
            let stack = answers[offset].stack;
            assert_eq!(
                observed.get(offset).copied().unwrap_or(0),
                stack,
                "{line:?} of {}",
                model.name
            );
            seen[expected as usize] += 1;
        }
        // Rows that were not asked for have no power flow to show.
        assert_eq!(flows.iter().flatten().count(), asked.len());
    }
    seen
}

#[test]
fn station1_with_its_plant_for_a_thousand_scans() {
    let program = example("station1.awl");
    let bench = Bench::with_plant(&program.image, "station1");
    let [not_executed, off, on] = compare(&program, bench, 1_000);
    assert_eq!(not_executed, 0, "every line is executed in every scan");
    assert!(on > 1_000 && off > 1_000, "{on} with power flow, {off} without");
}

/// The names of all examples.
fn examples() -> Vec<String> {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples");
    let names = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let names: Vec<String> = names.filter(|name| name.ends_with(".awl")).collect();
    assert!(names.len() >= 14, "{names:?}");
    names
}

#[test]
fn every_example_with_random_inputs() {
    let mut total = [0; 3];
    for name in examples() {
        let program = example(&name);
        let seen = compare(&program, Bench::with_random(&program.image, 200), 200);
        total.iter_mut().zip(seen).for_each(|(total, seen)| *total += seen);
    }
    assert!(total.iter().all(|&count| count > 1_000), "{total:?}");
}

/// The first word of a line without the comparison in it.
fn mnemonic(text: &str) -> &str {
    let word = text.split_whitespace().next().unwrap_or("");
    let stem = word.trim_end_matches(['<', '>', '=']);
    if stem.is_empty() { word } else { stem }
}

#[test]
fn every_line_of_every_example_is_asked_for_at_its_own_instruction() {
    let mut lines = 0;
    for name in examples() {
        let program = example(&name);
        for row in Model::new(&program).rows {
            let Some(offset) = row.instruction().and_then(|instruction| instruction.offset) else {
                continue;
            };
            let op = decode(&program.image, offset).unwrap().op;
            let word = mnemonic(&row.text);
            let is_hidden = matches!(op, Op::ScrAnd | Op::CallBegin);
            assert!(
                is_hidden || op.instruction().mnemonics.contains(&word),
                "{name}: {} is {op:?}",
                row.text
            );
            lines += 1;
        }
    }
    assert!(lines > 500, "{lines}");
}

/// Programs that leave more and more of the data memory to requests, byte by byte.
#[test]
fn the_largest_window_fits_whatever_the_room() {
    let mut rooms = BTreeSet::new();
    for bytes in 700..895 {
        let text =
            format!("//# memory VB0-VB{bytes}\nNETWORK 1\n{}", "LD I0.0\n= Q0.0\n".repeat(15));
        let program =
            Program::assembled(Source::new("room.awl", text).unwrap(), Vec::new()).unwrap();
        let in_image: Vec<_> =
            program.assembly.lines.iter().map(|line| (line.at as u16, Reference::NONE)).collect();
        let (_, mut client) = connect(Bench::with_random(&program.image, 1));
        let room = client.identify().unwrap().room;
        let window = windows(&in_image, room.into())[0];
        assert_eq!(
            client.status(window).unwrap().executed.len(),
            window.len(),
            "room for {room} bytes"
        );
        assert!(
            window.len() == 24 || client.status(&in_image[..window.len() + 1]).is_err(),
            "room for {room} bytes"
        );
        rooms.insert(room);
    }
    assert!(rooms.len() > 180 && rooms.contains(&74) && rooms.contains(&244), "{rooms:?}");
}
