//! Random requests: near what is legal, where the mistakes are.

use fastrand::Rng;

/// A request for random operands of a random function.
pub fn request(rng: &mut Rng) -> Vec<u8> {
    let mut bytes = match rng.u8(0..20) {
        0..3 => read(rng),
        3..5 => write_one(rng),
        5..8 => write_many(rng),
        8 => read_and_write(rng),
        9 => vec![43, *pick(rng, &[14, 14, 14, 13, 0]), rng.u8(0..6), rng.u8(0..9)],
        10 => vec![65],
        11 => vec![66, rng.u8(0..5), rng.u8(0..2), rng.u8(0..3)],
        12 => entries(rng, 67, 33, |rng, bytes| bytes.extend(reference(rng))),
        13..15 => force(rng),
        15 => status(rng),
        16 => trace(rng),
        17 => vec![71, rng.u8(0..3), rng.u8(0..32), rng.u8(..), rng.u8(0..70)],
        18 => entries(rng, 72, 17, |rng, bytes| {
            let reference = reference(rng);
            bytes.extend(reference);
            let width = [1, 2, 4][usize::from((reference[0] & 15).saturating_sub(8).min(2))];
            (0..width).for_each(|_| bytes.push(rng.u8(..)));
        }),
        _ => (0..rng.usize(1..20)).map(|_| rng.u8(..)).collect(),
    };
    mutate(rng, &mut bytes);
    bytes
}

/// Sometimes a byte is another, or one too many or too few are there.
fn mutate(rng: &mut Rng, bytes: &mut Vec<u8>) {
    if rng.u8(0..8) == 0 {
        let at = rng.usize(0..bytes.len());
        bytes[at] = rng.u8(..);
    }
    match rng.u8(0..24) {
        0 => bytes.push(rng.u8(..)),
        1 if bytes.len() > 1 => {
            bytes.pop();
        }
        _ => {}
    }
    bytes.truncate(252);
}

fn pick<'a, T>(rng: &mut Rng, of: &'a [T]) -> &'a T {
    &of[rng.usize(0..of.len())]
}

fn word(value: u16) -> [u8; 2] {
    value.to_be_bytes()
}

/// A number of a bit or register, mostly one that is there.
fn number(rng: &mut Rng, is_bits: bool) -> u16 {
    if rng.u8(0..10) == 0 {
        return rng.u16(..);
    }
    if is_bits {
        return 1000 * rng.u16(0..8) + rng.u16(0..260);
    }
    match rng.u8(0..10) {
        0..4 => *pick(rng, &[5, 10, 50, 60, 100, 110, 200, 500, 502, 17]) + rng.u16(0..4),
        4 => rng.u16(0..33),
        5 => 5110 + rng.u16(0..12),
        6 => *pick(rng, &[6005, 6037, 6038, 6000, 6255, 6256]),
        7 => *pick(rng, &[7005, 7007, 7006, 7255]),
        _ => 8000 + rng.u16(0..15),
    }
}

fn count(rng: &mut Rng, is_bits: bool) -> u16 {
    match rng.u8(0..12) {
        0 => rng.u16(..),
        1 => *pick(rng, &[0, 1, 32, 33, 120, 124, 125, 126, 2000, 2001]),
        2 if is_bits => rng.u16(0..257),
        2 => rng.u16(0..101),
        _ if is_bits => rng.u16(1..40),
        _ => rng.u16(1..4),
    }
}

fn read(rng: &mut Rng) -> Vec<u8> {
    let function = rng.u8(1..5);
    let is_bits = function < 3;
    [&[function][..], &word(number(rng, is_bits)), &word(count(rng, is_bits))].concat()
}

fn write_one(rng: &mut Rng) -> Vec<u8> {
    let function = rng.u8(5..7);
    let value = if function == 5 {
        *pick(rng, &[0, 0xFF00, 0xFF00, 0x00FF, 0x0100, 0xFE00])
    } else {
        rng.u16(..)
    };
    [&[function][..], &word(number(rng, function == 5)), &word(value)].concat()
}

fn values(rng: &mut Rng, is_bits: bool, count: u16) -> Vec<u8> {
    let len = if is_bits { count.div_ceil(8).min(246) } else { count.min(121) * 2 };
    let stated = if rng.u8(0..20) == 0 { rng.u8(..) } else { len as u8 };
    let values = (0..len).map(|_| rng.u8(..));
    [stated].into_iter().chain(values).collect()
}

fn write_many(rng: &mut Rng) -> Vec<u8> {
    let function = *pick(rng, &[15, 16]);
    let is_bits = function == 15;
    let count = count(rng, is_bits);
    [&[function][..], &word(number(rng, is_bits)), &word(count), &values(rng, is_bits, count)]
        .concat()
}

fn read_and_write(rng: &mut Rng) -> Vec<u8> {
    let written = count(rng, false);
    let read = [word(number(rng, false)), word(count(rng, false))].concat();
    [&[23][..], &read, &word(number(rng, false)), &word(written), &values(rng, false, written)]
        .concat()
}

fn reference(rng: &mut Rng) -> [u8; 3] {
    let (area, size) = (rng.u8(0..11), *pick(rng, &[0, 3, 7, 8, 8, 9, 9, 10, 10, 11]));
    let number = match area {
        _ if rng.u8(0..20) == 0 => rng.u16(..),
        0 | 1 => rng.u16(0..17),
        3 => *pick(rng, &[0, 4, 31, 32, 34, 35, 28]),
        5 => *pick(rng, &[5, 37, 38, 39, 255]),
        6 => *pick(rng, &[5, 7, 6, 0]),
        8 => *pick(rng, &[10, 20, 21, 100, 101, 120, 1000, 1004, 1007, 200, 399, 400, 401, 11]),
        9 => 2 * rng.u16(0..27),
        _ => rng.u16(0..34),
    };
    let [high, low] = number.to_be_bytes();
    [area << 4 | size, high, low]
}

fn entries(
    rng: &mut Rng,
    function: u8,
    most: u8,
    mut entry: impl FnMut(&mut Rng, &mut Vec<u8>),
) -> Vec<u8> {
    let count = if rng.bool() { rng.u8(0..4) } else { rng.u8(0..=most) };
    let mut bytes = vec![function, count];
    (0..count).for_each(|_| entry(rng, &mut bytes));
    bytes
}

fn force(rng: &mut Rng) -> Vec<u8> {
    match rng.u8(0..20) {
        0 => vec![68, 0],
        1 => vec![68, 3],
        2 => vec![68, rng.u8(..)],
        action => {
            let mut bytes = vec![68, if action < 15 { 1 } else { 2 }];
            bytes.extend(reference(rng));
            (0..4).for_each(|_| bytes.push(rng.u8(..)));
            bytes
        }
    }
}

fn status(rng: &mut Rng) -> Vec<u8> {
    let mut offset = 60;
    let function = *pick(rng, &[69, 69, 100]);
    entries(rng, function, 25, |rng, bytes| {
        offset += if rng.u8(0..60) == 0 { 0 } else { rng.u16(1..6) };
        bytes.extend(word(offset));
        let reference = reference(rng);
        bytes.extend(if rng.bool() { [0xFF, 0, 0] } else { reference });
    })
}

fn trace(rng: &mut Rng) -> Vec<u8> {
    let action = rng.u8(0..4);
    if action != 1 {
        return vec![70, action];
    }
    let mut bytes = [
        &[70, 1][..],
        &word(rng.u16(0..4)),
        &word(rng.u16(0..30)),
        &[rng.u8(0..6)],
        &reference(rng),
    ]
    .concat();
    let count = rng.u8(0..10);
    bytes.push(count);
    (0..count).for_each(|_| bytes.extend(reference(rng)));
    bytes
}
