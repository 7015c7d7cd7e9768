//! The picture in the documentation: station1 while the height of a workpiece is measured.

use std::path::Path;

use client::show::state::State;
use uno200::show::snapshot;

use crate::bench::{Bench, connect};
use crate::example;

/// Set to anything: the picture is written instead of compared.
const WRITE: &str = "UNO200_WRITE_PICTURE";

#[test]
fn the_picture_is_what_the_view_shows() {
    let program = example("station1.awl");
    let (bench, client) = connect(Bench::with_plant(&program.image, "station1"));
    // The sensor comes down to the first piece.
    bench.with(|bench| (0..485).for_each(|_| bench.scan()));
    let mut state = State::new(program, "/dev/ttyACM0".to_owned());
    state.resize(28);
    let network =
        state.model.rows.iter().position(|row| row.text.starts_with("NETWORK 4")).unwrap();
    state.go_to(network);
    let row =
        state.model.rows.iter().position(|row| row.text.starts_with("TON    Settle")).unwrap();
    state.select(row);
    let picture = snapshot(&mut state, client, false).unwrap();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/show.svg");
    if std::env::var_os(WRITE).is_some() {
        std::fs::write(&path, &picture).unwrap();
    }
    let written = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        written == picture,
        "docs/show.svg is not up to date: {WRITE}=1 cargo test -p uno200 --test show picture"
    );
}
