//! What is in V memory when an instruction is measured: values as programs have them, and now
//! and then any others.

use fastrand::Rng;

use super::Meter;

/// A value at a byte of V memory.
pub type Item = (u16, Content);

/// A kind of value, each time another one.
#[derive(Debug, Clone, Copy)]
pub enum Content {
    /// A byte between two.
    Byte(u8, u8),
    /// A word between two.
    Word(i16, i16),
    /// A double word between two.
    Double(i32, i32),
    /// A double word with any number of bits.
    Bits,
    /// As many as the row counts, as a byte.
    Count,
    /// A real between two; one in eight is any finite one.
    Real(f32, f32),
    /// A real between two, always.
    Share(f32, f32),
    /// A word in BCD.
    Bcd,
    /// A table with room for 100 words, and as many in it as the row counts.
    Table,
    /// A string of as many of these characters as the row counts, over and over again.
    Text(&'static str),
    /// This string.
    String(&'static str),
    /// As many of these characters as the row counts, over and over again, without a length before
    /// them.
    Characters(&'static str),
}

/// Room of [`Content::Table`].
const TABLE_LEN: u16 = 100;
/// One real in so many is any.
const ANY_REAL: u8 = 8;

impl Content {
    fn bytes(self, count: u8, rng: &mut Rng) -> Vec<u8> {
        let real = |rng: &mut Rng, least: f32, most: f32| least + (most - least) * rng.f32();
        let repeated = |text: &str| text.bytes().cycle().take(count.into()).collect::<Vec<u8>>();
        match self {
            Content::Byte(least, most) => vec![rng.u8(least..=most)],
            Content::Word(least, most) => rng.i16(least..=most).to_be_bytes().to_vec(),
            Content::Double(least, most) => rng.i32(least..=most).to_be_bytes().to_vec(),
            Content::Bits => (rng.i32(..) >> rng.u8(..32)).to_be_bytes().to_vec(),
            Content::Count => vec![count],
            Content::Real(..) if rng.u8(..ANY_REAL) == 0 => finite(rng).to_be_bytes().to_vec(),
            Content::Real(least, most) | Content::Share(least, most) => {
                real(rng, least, most).to_be_bytes().to_vec()
            }
            Content::Bcd => (0..2).map(|_| rng.u8(..10) << 4 | rng.u8(..10)).collect(),
            Content::Table => [TABLE_LEN.to_be_bytes(), u16::from(count).to_be_bytes()].concat(),
            Content::Text(text) => [vec![count], repeated(text)].concat(),
            Content::String(text) => [vec![text.len() as u8], text.as_bytes().to_vec()].concat(),
            Content::Characters(text) => repeated(text),
        }
    }
}

/// Any finite real, as its bits.
fn finite(rng: &mut Rng) -> u32 {
    loop {
        let bits = rng.u32(..);
        if f32::from_bits(bits).is_finite() {
            return bits;
        }
    }
}

/// Writes the values before the next scan.
///
/// # Panics
/// If the program has not these bytes.
pub fn write(meter: &mut Meter, items: &[Item], count: u8, rng: &mut Rng) {
    let plan = meter.executable.plan();
    for (number, byte) in bytes(items, count, rng) {
        let address = plan.v_address(number).unwrap_or_else(|| panic!("no VB{number}"));
        meter.board.write(address, &[byte]);
    }
}

/// The values as bytes of V memory, with their numbers.
pub fn bytes(items: &[Item], count: u8, rng: &mut Rng) -> Vec<(u16, u8)> {
    items.iter().flat_map(|&(first, content)| (first..).zip(content.bytes(count, rng))).collect()
}
