//! The loader's check on the board against the host's: images of the examples and of the cases with
//! something wrong and a checksum that is right. Both must refuse the same, for the same reason, at
//! the same place.
//!
//! `DAMAGED_IMAGES=20000 cargo test --release --package tests --features uno --test board_loader`
//! tries more.
#![cfg(feature = "uno")]

use std::collections::BTreeMap;
use std::ops::Range;

use fastrand::Rng;
use plc_isa::{
    CRC_LEN, DIRECTORY_AT, HEADER_LEN, Header, ImageError, SLOT_LEN, module_of_token, verify,
};
use plc_vm::Fault;
use tests::bench_board::BenchBoard;
use tests::case::Case;
use tests::effort::effort;
use tests::image::{image, sign};

/// After magic, version and interface, and before the directory of modules, which the board alone
/// checks.
const HEADER: Range<usize> = 6..DIRECTORY_AT as usize;
/// The length of the modules, the same.
const MODULES_LEN: Range<usize> = 32..34;

/// Where an image is damaged: the fields of its header, its tables, its code.
fn parts(image: &[u8]) -> [Range<usize>; 3] {
    let header = Header::read(&image).expect("a valid image");
    let (tables_at, code_at) = (HEADER_LEN + header.modules_len, usize::from(header.code_at()));
    [HEADER, usize::from(tables_at)..code_at, code_at..image.len() - usize::from(CRC_LEN)]
}

/// A byte that could be meant instead of another.
fn other(rng: &mut Rng, image: &[u8], part: &Range<usize>, byte: u8) -> u8 {
    match rng.u8(..5) {
        0 => rng.u8(..),
        1 => byte ^ 1 << rng.u8(..8),
        2 => byte.wrapping_add(1),
        3 => byte.wrapping_sub(1),
        _ => image[rng.usize(part.clone())],
    }
}

/// The image with one or two bytes changed in one of its parts, mostly in the code.
fn damaged(rng: &mut Rng, image: &[u8]) -> Vec<u8> {
    let [header, tables, code] = parts(image);
    let part = match rng.u8(..8) {
        0 => header,
        1 | 2 if !tables.is_empty() => tables,
        _ => code,
    };
    let mut image = image.to_vec();
    for _ in 0..rng.u8(1..3) {
        let at = rng.usize(part.clone());
        if !MODULES_LEN.contains(&at) {
            image[at] = other(rng, &image, &part, image[at]);
        }
    }
    sign(&mut image);
    // The board does not know the length of a file.
    image.resize(usize::from(SLOT_LEN), 0xFF);
    image
}

/// What the board says to an image when power comes.
fn error_on_board(board: &mut BenchBoard, image: &[u8]) -> Option<ImageError> {
    board.insert(image);
    board.power_up();
    match board.fault() {
        None => None,
        Some(Fault::BadImage(error)) => Some(error),
        Some(fault) => panic!("{fault:?}"),
    }
}

/// Whether the instruction at an offset is of a module.
fn is_of_module(image: &[u8], at: u16) -> bool {
    image.get(usize::from(at)).is_some_and(|&token| module_of_token(token).is_some())
}

#[test]
fn the_board_refuses_what_the_host_refuses() {
    let images: Vec<_> =
        Case::all().iter().chain(&Case::examples()).map(|case| image(&case.awl)).collect();
    let (mut board, mut rng, mut faults) = (BenchBoard::new(), Rng::with_seed(1), BTreeMap::new());
    for _ in 0..effort("DAMAGED_IMAGES", 1_500) {
        let index = rng.usize(..images.len());
        let image = damaged(&mut rng, &images[index]);
        let (error, on_board) =
            (verify(image.as_slice()).err(), error_on_board(&mut board, &image));
        // The board has those modules alone that are in the image.
        if [error, on_board].iter().flatten().any(|error| is_of_module(&image, error.at)) {
            continue;
        }
        assert_eq!(on_board, error, "image {index}");
        *faults.entry(error.map_or("none", |error| error.fault.message())).or_insert(0) += 1;
    }
    println!("{faults:#?}");
    assert!(faults.len() > 12, "only {faults:?}");
}
