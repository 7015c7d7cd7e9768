//! What programs declare by name and type: where it gets a place, what becomes of it in images, and
//! the text with addresses for it.

use awl_asm::Address;
use awl_asm::assemble::{Assembly, assemble};
use awl_asm::declared::Declared;
use awl_asm::for_tools::for_tools;
use awl_asm::format::{resolved, symbol_table};
use awl_asm::source::Source;
use awl_asm::symbols;
use awl_asm::tools::{Tools, image_in};
use plc_isa::{Area, verify};

const MIXED: &str = "\
//# var Speed INT := -5      // rpm
//# var Ready BOOL
//# var \"Motor on\" BOOL := TRUE
//# var Table ARRAY[1..4] OF INT := [1, 2, 16#FFFF]
//# var Bits ARRAY[0..11] OF BOOL := [1, 0, 1]
//# var Runs DINT RETAIN
//# var Once BOOL RETAIN
//# var Wait TIME := T#1m2s3ms
//# var Name STRING[10] := \"hi, you\"
//# var Level REAL := 2.5
//# timer Delay 10ms
//# timer Hours 100ms TONR RETAIN
//# counter Parts RETAIN
//# source pump.st:12:3
LD   I0.0
AN   M0.0
O    \"Motor on\"
=    Ready
TON  Delay, 50
TONR Hours, 50
//# source pump.sfc#Fill
LD   Delay
EU
INCW Speed
LD   Ready
LD   SM0.0
CTU  Parts, 5
LD   Once
A    Bits[9]
S    Once, 1
MOVW Table[3], VW2
INCD Runs
MOVD &Table, AC1
MOVW *AC1, Speed
MOVR Level, VD4
//# source
LDW>= Parts, 5
=    Q0.0
";

fn assembled(text: &str) -> (Source, Assembly) {
    let source = Source::new("pump.awl", text).unwrap();
    let assembly = assemble(&source, Vec::new());
    let errors: Vec<_> = assembly.diagnostics.iter().map(|one| &one.message).collect();
    assert!(!assembly.has_errors(), "{errors:?}\n{text}");
    (source, assembly)
}

fn image(text: &str) -> Vec<u8> {
    assembled(text).1.image.unwrap()
}

fn address_of(declared: &[Declared], name: &str) -> String {
    declared.iter().find(|one| one.name == name).unwrap().address.to_string()
}

#[test]
fn everything_gets_a_place_that_nothing_else_has() {
    let (_, assembly) = assembled(MIXED);
    let declared = &assembly.program.variables;
    let places: Vec<String> = declared.iter().map(|one| one.address.to_string()).collect();
    // VW2 and VD4 are named; retained values are side by side, then their bits.
    let expected = [
        "VW13", "M0.1", "V15.0", "VW16", "V24.0", "VD8", "V12.0", "VD26", "VB30", "VD41", "T33",
        "T5", "C0",
    ];
    assert_eq!(places, expected);
}

#[test]
fn resolved_text_is_the_same_program() {
    for text in [MIXED.to_owned(), MIXED.replace('\n', "\r\n")] {
        let (source, assembly) = assembled(&text);
        let resolved = resolved(&source, &assembly.program);
        for name in ["Speed", "Motor", "Table", "Delay", "Parts"] {
            let is_used = |line: &str| !line.starts_with("//#") && line.contains(name);
            assert!(!resolved.lines().any(is_used), "{name}\n{resolved}");
        }
        assert_eq!(image(&resolved), assembly.image.unwrap(), "{resolved}");
    }
}

#[test]
fn resolved_text_is_in_the_mnemonics_of_the_program() {
    let german = "//# symbol Start E0.1\n//# symbol Lamp A0.0\n//# counter Parts\nLD E0.0\n\
                  U Start\nLD E0.2\nZV Parts, 5\nLD Parts\n= Lamp\n";
    let (source, assembly) = assembled(german);
    let text = resolved(&source, &assembly.program);
    assert!(text.contains("U E0.1\n") && text.contains("ZV Z0, 5\n"), "{text}");
    assert!(text.ends_with("LD Z0\n= A0.0\n"), "{text}");
    assert_eq!(image(&text), assembly.image.unwrap());
}

#[test]
fn the_symbol_table_names_the_same_places() {
    let (_, assembly) = assembled(MIXED);
    let table = Source::new("pump.csv", symbol_table(&assembly.program)).unwrap();
    let (symbols, diagnostics) = symbols::load(&table);
    assert!(diagnostics.is_empty(), "{diagnostics:?}\n{}", table.text);
    let shown = |name: &str| {
        let found = symbols.iter().find(|one| one.name == name).unwrap();
        format!("{:?} {}", found.value, found.comment)
    };
    assert_eq!(shown("Speed"), "Address(Word { area: V, byte: 13 }) rpm");
    assert_eq!(shown("Table[4]"), "Address(Word { area: V, byte: 22 }) ");
    assert_eq!(shown("Bits[11]"), "Address(Bit { area: V, byte: 25, bit: 3 }) ");
    assert_eq!(symbols.len(), assembly.program.symbols.len());
}

#[test]
fn values_before_the_first_scan() {
    let (_, assembly) = assembled(MIXED);
    let mut memory = [0u8; 64];
    for line in &assembly.program.data {
        let first = usize::from(line.first_byte);
        memory[first..first + line.bytes.len()].copy_from_slice(&line.bytes);
    }
    assert_eq!(memory[13..16], [0xFF, 0xFB, 1]);
    assert_eq!(memory[16..26], [0, 1, 0, 2, 0xFF, 0xFF, 0, 0, 0b101, 0]);
    assert_eq!(memory[26..30], 62_003i32.to_be_bytes());
    assert_eq!(memory[30..38], *b"\x07hi, you");
    assert_eq!(memory[41..45], 2.5f32.to_be_bytes());
}

/// What a machine compares before it brings retained values back.
fn identity(text: &str) -> u32 {
    let image = image(text);
    verify(image.as_slice()).unwrap().plan().retained_identity().value()
}

#[test]
fn retained_values_belong_to_name_and_type() {
    let program = |declarations: &str| {
        format!("{declarations}LD I0.0\nINCW First\nINCW Second\nLD I0.1\nCTU C7, 3\n")
    };
    let two = "//# var First INT RETAIN\n//# var Second INT RETAIN\n";
    let base = identity(&program(two));
    assert_eq!(identity(&program(&format!("//# var Other REAL\n{two}"))), base, "not retained");
    assert_eq!(identity(&program(&two.to_uppercase().replace("VAR", "var"))), base, "letter case");
    let swapped = "//# var Second INT RETAIN\n//# var First INT RETAIN\n";
    let typed = "//# var First INT RETAIN\n//# var Second WORD RETAIN\n";
    for other in [swapped, typed] {
        assert_ne!(identity(&program(other)), base, "{other}");
    }
    let renamed = program(two).replace("Second", "Third");
    assert_ne!(identity(&renamed), base);
}

#[test]
fn every_counter_may_be_used() {
    let uses: String =
        (0..256).map(|number| format!("LD I0.0\nLD I0.1\nCTU C{number}, 5\n")).collect();
    let (_, assembly) = assembled(
        &format!("//# var Runs INT RETAIN\nINCW Runs\n{uses}")
            .replace("INCW Runs\n", "LD I0.2\nINCW Runs\n"),
    );
    assert_eq!(assembly.program.retained.len(), 1);
}

#[test]
fn pointers_do_not_reach_what_is_declared() {
    let pointing = "//# var Sum INT\nLD SM0.0\nMOVD &VB100, AC1\n+I *AC1, Sum\n";
    let (_, assembly) = assembled(pointing);
    assert_eq!(address_of(&assembly.program.variables, "Sum"), "VW98");
    let (_, assembly) = assembled(&format!("//# memory VB100-VB119\n{pointing}"));
    assert_eq!(address_of(&assembly.program.variables, "Sum"), "VW0");
    let at_the_start = pointing.replace("VB100", "VB0");
    let (_, assembly) = assembled(&at_the_start);
    assert_eq!(address_of(&assembly.program.variables, "Sum"), "VW1");
}

#[test]
fn bits_go_on_where_an_area_is_full() {
    let count = 8 * (Area::M.size() + Area::S.size()) + 10;
    let mut text: String = (0..count).map(|bit| format!("//# var Bit{bit} BOOL\n")).collect();
    text += "LD I0.0\n= Bit0\n";
    let (_, assembly) = assembled(&text);
    let declared = &assembly.program.variables;
    assert_eq!(address_of(declared, "Bit256"), "S0.0");
    assert_eq!(address_of(declared, "Bit512"), "V0.0");
    assert_eq!(address_of(declared, "Bit521"), "V1.1");
    let mut places: Vec<Address> = declared.iter().map(|one| one.address).collect();
    places.sort();
    places.dedup();
    assert_eq!(places.len(), usize::from(count));
}

#[test]
fn tools_are_told_variables_and_places() {
    let (source, assembly) = assembled(MIXED);
    let tools = for_tools(&source, &assembly).unwrap();
    let image = assembly.image.clone().unwrap();
    let file = [image.clone(), tools.to_bytes()].concat();
    assert_eq!(image_in(&file), image);
    assert_eq!(Tools::in_file(&file).as_ref(), Some(&tools));
    assert_eq!(tools.files, ["pump.st", "pump.sfc", "pump.awl"]);
    let place_of = |needle: &str| {
        let index = assembly
            .code
            .iter()
            .position(|selected| assembly.span_of(selected).text(&source.text).starts_with(needle));
        let offset = assembly.lines[index.unwrap()].at as u16;
        (tools.place_at(offset).unwrap().to_string(), assembly.places(&source)(offset).unwrap())
    };
    for (needle, place) in
        [("AN", "pump.st:12:3"), ("EU", "pump.sfc#Fill"), ("LDW>=", "pump.awl:37")]
    {
        assert_eq!(place_of(needle), (place.to_owned(), place.to_owned()));
    }
    assert_eq!(tools.symbols().len(), assembly.program.variables.len());
    let (source, plain) = assembled("LD I0.0\n= Q0.0\n");
    assert_eq!(for_tools(&source, &plain), None);
}
