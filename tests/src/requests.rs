//! Random requests to a PLC on its line: mostly sensible ones for the program areas.awl, some of them damaged. What the
//! answers should be is not known here.

use fastrand::Rng;

/// Modbus functions on bits, on registers, and the service functions that mean the same at any time.
const BIT_FUNCTIONS: [u8; 4] = [1, 2, 5, 15];
const REGISTER_FUNCTIONS: [u8; 5] = [3, 4, 6, 16, 23];
const SERVICES: [u8; 4] = [67, 68, 71, 72];

/// Where blocks of bits and registers begin and end, and where there is nothing.
const BITS: [u16; 12] = [0, 120, 1000, 1250, 2000, 3000, 4000, 5000, 6000, 6120, 999, 65535];
const REGISTERS: [u16; 14] = [0, 1, 120, 128, 200, 201, 6037, 6036, 7005, 8000, 8007, 8012, 5119, 31];

/// Areas, sizes and numbers that references are made of.
const NUMBERS: [u16; 16] = [0, 1, 2, 5, 12, 24, 31, 37, 38, 40, 48, 63, 100, 258, 400, 256];

fn near(rng: &mut Rng, places: &[u16]) -> u16 {
    places[rng.usize(..places.len())].wrapping_add(rng.u16(0..4))
}

fn count(rng: &mut Rng) -> u16 {
    match rng.u8(0..16) {
        0 => rng.u16(..),
        1 => 0,
        2 => [125, 126, 123, 124, 2000, 2001, 32, 33][rng.usize(..8)],
        _ => rng.u16(1..20),
    }
}

fn bytes(rng: &mut Rng, len: usize) -> Vec<u8> {
    (0..len).map(|_| rng.u8(..)).collect()
}

/// Data behind a count of its bytes.
fn counted(rng: &mut Rng, len: usize) -> Vec<u8> {
    let len = len.min(246);
    [vec![len as u8], bytes(rng, len)].concat()
}

fn of_bits(rng: &mut Rng) -> Vec<u8> {
    let function = BIT_FUNCTIONS[rng.usize(..4)];
    let (first, count) = (near(rng, &BITS), count(rng));
    let mut request = [vec![function], first.to_be_bytes().to_vec()].concat();
    match function {
        5 => request.extend([[0xFF, 0], [0, 0], [1, 0]][rng.usize(..3)]),
        15 => {
            request.extend(count.to_be_bytes());
            request.extend(counted(rng, usize::from(count).div_ceil(8)));
        }
        _ => request.extend(count.to_be_bytes()),
    }
    request
}

fn of_registers(rng: &mut Rng) -> Vec<u8> {
    let function = REGISTER_FUNCTIONS[rng.usize(..5)];
    let (first, amount) = (near(rng, &REGISTERS), count(rng));
    let mut request = [vec![function], first.to_be_bytes().to_vec(), amount.to_be_bytes().to_vec()].concat();
    let mut written = amount;
    if function == 23 {
        written = count(rng);
        request.extend(near(rng, &REGISTERS).to_be_bytes());
        request.extend(written.to_be_bytes());
    }
    if matches!(function, 16 | 23) {
        request.extend(counted(rng, 2 * usize::from(written)));
    }
    request
}

/// A reference, and the bytes of its value.
fn reference(rng: &mut Rng) -> ([u8; 3], usize) {
    let (area, size) = (rng.u8(0..11), rng.u8(0..12));
    let [high, low] = NUMBERS[rng.usize(..NUMBERS.len())].to_be_bytes();
    ([area << 4 | size, high, low], [1, 2, 4, 1][usize::from(size.saturating_sub(8))])
}

fn service(rng: &mut Rng) -> Vec<u8> {
    let function = SERVICES[rng.usize(..4)];
    let mut request = vec![function];
    match function {
        68 => {
            let action = rng.u8(0..5);
            request.push(action);
            if matches!(action, 1 | 2) {
                request.extend(reference(rng).0);
            }
            if action == 1 {
                request.extend(bytes(rng, 4));
            }
        }
        71 => {
            request.push(u8::from(rng.u8(0..8) == 0));
            request.extend(rng.u16(0..8000).to_be_bytes());
            request.push(rng.u8(..));
        }
        function => {
            let many = if rng.bool() { 1 } else { rng.u8(1..8) };
            request.push(many);
            for _ in 0..many {
                let (reference, len) = reference(rng);
                request.extend(reference);
                if function == 72 {
                    request.extend(bytes(rng, len));
                }
            }
        }
    }
    request
}

/// A request, of 1 to 253 bytes.
pub fn random_request(rng: &mut Rng) -> Vec<u8> {
    let mut request = match rng.u8(0..20) {
        0..6 => of_bits(rng),
        6..12 => of_registers(rng),
        12 => vec![43, 14, rng.u8(0..6), rng.u8(0..8)],
        13 => vec![rng.u8(0..43), 0, 0, 0, 1],
        _ => service(rng),
    };
    if rng.u8(0..6) == 0 {
        let at = rng.usize(..request.len());
        match rng.u8(0..3) {
            0 => request[at] ^= 1 << rng.u8(0..8),
            1 => request.truncate(at.max(1)),
            _ => request.insert(at, rng.u8(..)),
        }
    }
    // What ends the mode or asks for something that is another each time has tests of its own.
    if matches!(request[0], 65 | 66 | 69 | 70) {
        request[0] = 67;
    }
    request.truncate(253);
    request
}
