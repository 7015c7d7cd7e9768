//! What a program retains, listed naively: to compare with, and to write copies as the board keeps
//! them.

use plc_isa::{Area, Plan, ProgramMemory};

/// The data addresses of all retained bytes, in order.
pub fn retained_addresses<P: ProgramMemory>(plan: &Plan<P>) -> Vec<u16> {
    let numbers = plan
        .retained()
        .flat_map(|range| (range.first..range.first + range.count).map(move |n| (range.area, n)));
    let places = numbers.flat_map(|(area, number)| match area {
        Area::T => value(plan.timer_slot(number as u8).map(|slot| slot.address)),
        Area::C => value(plan.counter_slot(number as u8).map(|slot| slot.address)),
        _ => vec![plan.byte_address(area, number).expect("a retained byte is in the plan")],
    });
    places.collect()
}

fn value(address: Option<u16>) -> Vec<u16> {
    address.map_or(Vec::new(), |address| vec![address, address + 1])
}

/// A copy of these values as the EEPROM holds it: sequence number, values, checksum.
pub fn copy<P: ProgramMemory>(plan: &Plan<P>, sequence: u16, values: &[u8]) -> Vec<u8> {
    let mut bytes = sequence.to_le_bytes().to_vec();
    bytes.extend_from_slice(values);
    let mut crc = plan.retained_identity();
    bytes.iter().for_each(|&byte| crc.byte(byte));
    bytes.extend(crc.value().to_le_bytes());
    bytes
}

fn generation_program(ranges: &str, words: &[String]) -> String {
    let moves: String = words.iter().map(|word| format!("MOVW VW0, {word}\n")).collect();
    format!("//# retain {ranges}\nLD SM0.0\nINCW VW0\n{moves}")
}

/// Programs in which every retained word has the number of the last scan, so that any mixture of
/// two copies shows. The last of them retains as much as can be.
pub fn generation_programs() -> [String; 3] {
    let words = |area: &str, range: std::ops::Range<u16>| -> Vec<String> {
        range.step_by(2).map(|byte| format!("{area}W{byte}")).collect()
    };
    let values = ["C0", "C7", "T0", "T31"].map(String::from).to_vec();
    let mixed = [words("V", 2..16), words("V", 100..104), words("M", 0..8), values].concat();
    [
        generation_program("VB0-VB1", &[]),
        generation_program("VB0-VB15, MB0-MB7, C0-C9, T0-T31, VB100-VB103, VB8-VB11", &mixed),
        generation_program(
            "VB0-VB405, MB0-MB31, VB0-VB51",
            &[words("V", 2..406), words("M", 0..32)].concat(),
        ),
    ]
}

/// The number that all words have; `None` if it is not the same.
pub fn generation(bytes: &[u8]) -> Option<u16> {
    let mut words = bytes.chunks_exact(2).map(|word| u16::from_be_bytes([word[0], word[1]]));
    let first = words.next()?;
    words.all(|word| word == first).then_some(first)
}
