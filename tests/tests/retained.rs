//! The walk over what a program retains, against a naive listing of it.

use std::collections::BTreeSet;

use awl_asm::assemble::assemble;
use awl_asm::diagnostic::{Code, Severity};
use awl_asm::source::Source;
use fastrand::Rng;
use plc_isa::{Area, Crc32, Plan, RetainedWalk, verify};
use tests::effort::effort;
use tests::retained::retained_addresses;

/// A number of a retentive timer.
fn tonr(rng: &mut Rng) -> u16 {
    if rng.bool() { rng.u16(..32) } else { rng.u16(64..96) }
}

fn random_range(rng: &mut Rng) -> String {
    let range = |rng: &mut Rng, name: &str, end: u16, len: u16| {
        let first = rng.u16(..end);
        let last = rng.u16(first..end.min(first + len));
        if first == last { format!("{name}{first}") } else { format!("{name}{first}-{name}{last}") }
    };
    match rng.u8(..4) {
        0 => range(rng, "VB", 300, 20),
        1 => range(rng, "MB", 32, 10),
        2 if rng.bool() => range(rng, "T", 32, 32),
        2 => {
            let first = rng.u16(64..96);
            format!("T{first}-T{}", rng.u16(first..96))
        }
        _ => range(rng, "C", 256, 120),
    }
}

/// A program that uses some V bytes, timers and counters, and retains ranges of anything, also of
/// what it uses not.
fn random_program(rng: &mut Rng) -> String {
    let ranges: Vec<String> = (0..rng.usize(1..=16)).map(|_| random_range(rng)).collect();
    let mut text = format!("//# retain {}\nLD SM0.0\n", ranges.join(", "));
    for _ in 0..rng.usize(..20) {
        text.push_str(&match rng.u8(..5) {
            0 => format!("MOVW 1, VW{}\n", rng.u16(..400)),
            1 => format!("MOVW 1, C{}\n", rng.u8(..)),
            2 => format!("MOVW 1, T{}\n", rng.u8(..)),
            3 => format!("LD I0.0\nTONR T{}, 5\n", tonr(rng)),
            _ => format!("LD I0.0\nTON T{}, 5\n", rng.u16(96..256)),
        });
    }
    text
}

fn plan(text: &str) -> Plan<Vec<u8>> {
    let assembly = assemble(&Source::new("retained", text).unwrap(), Vec::new());
    let image = assembly.image.unwrap_or_else(|| panic!("{:?}\n{text}", assembly.diagnostics));
    verify(image).unwrap_or_else(|error| panic!("{error:?}\n{text}")).plan().clone()
}

/// All bytes of a walk in pieces of at most `len_max`.
fn walked(plan: &Plan<Vec<u8>>, len_max: u16) -> Vec<u16> {
    let mut walk = RetainedWalk::START;
    std::iter::from_fn(|| walk.next(plan, len_max).then_some((walk.address, walk.len)))
        .inspect(|&(_, len)| assert!(len <= len_max))
        .flat_map(|(address, len)| address..address + len)
        .collect()
}

#[test]
fn walks_of_random_programs() {
    let (mut kinds, mut overlaps) = (BTreeSet::new(), 0);
    for seed in 1..=effort("RANDOM_PROGRAMS", 3_000) {
        let mut rng = Rng::with_seed(seed);
        let text = random_program(&mut rng);
        let plan = plan(&text);
        let expected = retained_addresses(&plan);
        for len_max in [u16::MAX, 4, 2, rng.u16(2..40)] {
            assert_eq!(
                walked(&plan, len_max),
                expected,
                "seed {seed}, pieces of {len_max}\n{text}"
            );
        }
        assert_eq!(usize::from(plan.retained_len()), expected.len(), "seed {seed}\n{text}");
        kinds.extend(plan.retained().filter(|_| !expected.is_empty()).map(|range| range.area));
        overlaps += usize::from(expected.iter().collect::<BTreeSet<_>>().len() < expected.len());
    }
    assert_eq!(kinds.len(), 4, "{kinds:?}");
    assert!(overlaps > 0);
}

fn identity(text: &str) -> u32 {
    plan(text).retained_identity().value()
}

/// The ranges as the image holds them, then the numbers of timers and counters: values saved by one
/// version of the firmware are found by the next.
#[test]
fn the_identity_is_pinned() {
    let mut expected = Crc32::new();
    let ranges = [[0, 0, 0, 32, 0], [3, 0, 0, 10, 0], [2, 0, 0, 4, 0], [1, 2, 0, 1, 0]];
    ranges.as_flattened().iter().chain(&[1, 7, 3]).for_each(|&byte| expected.byte(byte));
    let text = "//# retain VB0-VB31, C0-C9, T0-T3, MB2\nLD SM0.0\nMOVW C7, C1\nMOVW T3, C10\n";
    assert_eq!(identity(text), expected.value());
}

#[test]
fn the_identity_is_that_of_the_values_alone() {
    let program =
        |ranges: &str, uses: &str| format!("//# retain {ranges}\nLD SM0.0\nMOVW C1, C3\n{uses}");
    let one = identity(&program("VB4-VB5, C0-C9", ""));
    let same = [
        "MOVW 1, VW0\n",
        "MOVW 1, C10\n",
        "MOVW 1, T3\nLD I0.0\nTON T37, 1\n",
        "LD I0.0\nEU\n= Q0.0\n",
    ];
    for uses in same {
        assert_eq!(identity(&program("VB4-VB5, C0-C9", uses)), one, "{uses}");
    }
    let other = [
        program("VB4-VB6, C0-C9", ""),
        program("VB3-VB4, C0-C9", ""),
        program("C0-C9, VB4-VB5", ""),
        program("VB4-VB5, C0-C8", ""),
        program("VB4-VB5, C0-C9", "MOVW 1, C2\n"),
    ];
    let all: BTreeSet<u32> = other.iter().map(|text| identity(text)).chain([one]).collect();
    assert_eq!(all.len(), 1 + other.len());
    assert_eq!(
        plan(&program("C200-C209", "")).retained().map(|range| range.area).collect::<Vec<_>>(),
        [Area::C]
    );
    assert_eq!(plan(&program("C200-C209", "")).retained_len(), 0, "none of them is used");
}

/// Near the limits the assembler either makes an image that the loader's check accepts, or says
/// that there is no room.
#[test]
fn what_does_not_fit_is_refused_by_the_assembler() {
    let (mut accepted, mut refused) = (0, 0);
    for seed in 1..=effort("RANDOM_PROGRAMS", 3_000) / 3 {
        let mut rng = Rng::with_seed(seed);
        let (v, counters) = (rng.u16(1..520), rng.u8(..=190));
        let marks: String = (0..rng.u8(..15)).map(|_| ", MB0-MB31").collect();
        let uses: String = (0..counters).map(|number| format!("MOVW 0, C{number}\n")).collect();
        let text = format!(
            "//# board uno\n//# retain VB0-VB{v}, C{}-C255{marks}\nLD SM0.0\n{uses}",
            rng.u8(..)
        );
        let assembly = assemble(&Source::new("retained", &*text).unwrap(), Vec::new());
        let Some(image) = assembly.image else {
            let codes: Vec<Code> =
                assembly.diagnostics.iter().map(|diagnostic| diagnostic.code).collect();
            let errors: Vec<&Code> =
                codes.iter().filter(|code| code.severity() == Severity::Error).collect();
            assert_eq!(errors, [&Code::DataTooLarge], "seed {seed}\n{text}");
            refused += 1;
            continue;
        };
        let program =
            verify(image).unwrap_or_else(|error| panic!("seed {seed}: {error:?}\n{text}"));
        assert_eq!(
            usize::from(program.plan().retained_len()),
            assembly.demand.retained_len,
            "seed {seed}\n{text}"
        );
        accepted += 1;
    }
    assert!(accepted > 100 && refused > 100, "{accepted} accepted, {refused} refused");
}
