//! What is drawn of small texts: places, symbols, and why something is not drawn.

use awl_asm::assemble::Assembly;
use awl_asm::assemble::assemble;
use diagnostics::Source;

use super::*;

fn assembled(text: &str) -> (Source, Assembly) {
    let source = Source::new("t.awl", text).unwrap();
    let assembly = assemble(&source, Vec::new());
    (source, assembly)
}

/// The only rung of a text.
fn rung(text: &str) -> Result<Picture, (usize, Obstacle)> {
    let (source, assembly) = assembled(text);
    let networks = networks(&source, &assembly);
    let [network] = &networks[..] else { panic!("{networks:?}") };
    let [rung] = &network.rungs[..] else { panic!("{network:?}") };
    draw(&source, &assembly, rung)
}

/// Symbols with column and row.
fn places(picture: &Picture) -> Vec<(&str, usize, usize)> {
    let place = |one: &'_ Element| (one.column, one.row);
    picture.elements.iter().map(|one| (one.symbol.as_str(), place(one).0, place(one).1)).collect()
}

fn obstacle(text: &str) -> (usize, Obstacle) {
    rung(text).unwrap_err()
}

#[test]
fn series_and_parallel_are_placed_and_wired() {
    let picture = rung("LD I0.0\nAN I0.1\nO M0.0\nA I0.2\n= M0.0\n").unwrap();
    assert_eq!((picture.columns, picture.rows), (4, 2));
    let expected = [("", 0, 0), ("/", 1, 0), ("", 0, 1), ("", 2, 0), ("", 3, 0)];
    assert_eq!(places(&picture), expected);
    let wires: Vec<_> = picture.wires.iter().map(|wire| (wire.from, wire.to)).collect();
    // From the shorter branch to the end of the longer one, and both verticals.
    assert_eq!(wires, [((1, 1), (2, 1)), ((0, 0), (0, 1)), ((2, 0), (2, 1))]);
}

#[test]
fn lps_branches_and_coils_stand_at_the_right() {
    let text = "LD I0.0\nLPS\nA I0.1\n= Q0.0\nLRD\nA I0.2\nA I0.3\n= Q0.1\nLPP\nR C1, 1\n";
    let picture = rung(text).unwrap();
    let coils = picture.elements.iter().filter(|one| one.shape == Shape::Coil);
    let coils: Vec<_> = coils.map(|one| (one.column, one.row)).collect();
    assert_eq!(coils, [(3, 0), (3, 1), (3, 2)]);
}

#[test]
fn a_counter_has_its_inputs_below_each_other() {
    let text = "LD I0.0\nO I0.1\nLD I0.2\nA I0.3\nLD M0.0\nCTUD C1, VW2\n";
    let picture = rung(text).unwrap();
    let counter = picture.elements.last().unwrap();
    let powers: Vec<_> = counter.powers.iter().map(|power| (power.name, power.row)).collect();
    assert_eq!(powers, [("CU", 0), ("CD", 2), ("R", 3)]);
    assert_eq!((counter.symbol.as_str(), counter.column), ("CTUD", 2));
    let pins = counter.pins.iter().map(|pin| (pin.name.as_str(), pin.side, &pin.operand.text[..]));
    let expected = [("", Side::Above, "C1"), ("PV", Side::Left, "VW2")];
    assert_eq!(pins.collect::<Vec<_>>(), expected);
}

#[test]
fn what_is_written_in_contacts_follows_from_the_mnemonic() {
    let cases = [
        ("LD I0.0", ""),
        ("LDN I0.0", "/"),
        ("LDI I0.0", "I"),
        ("LDNI I0.0", "/I"),
        ("LDB= VB0, 1", "==B"),
        ("LDW>= VW0, 1", ">=I"),
        ("LDD<> VD0, 1", "<>D"),
        ("LDR< VD0, 1.5", "<R"),
        ("LDS= VB0, VB10", "==S"),
    ];
    for (text, symbol) in cases {
        let picture = rung(&format!("{text}\n= M0.0\n")).unwrap();
        assert_eq!(picture.elements[0].symbol, symbol, "{text}");
        assert_eq!(picture.elements[0].is_inverted, symbol.contains('/'), "{text}");
    }
    // Each contact of the table is one of these kinds.
    for entry in plc_isa::INSTRUCTIONS {
        let begin = match entry.rung {
            plc_isa::Rung::Loads => "LD",
            plc_isa::Rung::Ands => "A",
            plc_isa::Rung::Ors => "O",
            _ => continue,
        };
        let end = entry.mnemonic().strip_prefix(begin);
        let known: &[&str] =
            if entry.has_relation() { &["B", "W", "D", "R", "S"] } else { &["", "N", "I", "NI"] };
        assert!(end.is_some_and(|end| known.contains(&end)), "{}", entry.mnemonic());
    }
}

#[test]
fn coils_and_boxes_follow_from_the_table() {
    let coils = ["= Q0.0", "S M0.0, 2", "R T37, 1", "=I Q0.0", "END", "STOP", "ENI", "JMP 1"];
    for text in coils {
        let picture = rung(&format!("LD I0.0\n{text}\n"));
        assert_eq!(picture.unwrap().elements[1].shape, Shape::Coil, "{text}");
    }
    let boxes = ["TON T37, 5", "MOVW 1, VW0", "INCW VW0", "SHRB I0.0, M0.0, 4", "PID VB0, 0"];
    for text in boxes {
        let picture = rung(&format!("LD I0.0\n{text}\n"));
        assert_eq!(picture.unwrap().elements[1].shape, Shape::Box, "{text}");
    }
}

#[test]
fn german_words_stay_and_names_have_their_addresses() {
    let text =
        "//# symbol Lampe Q0.1 gruen\nU E0.0\nUN E0.1\n= Lampe\n".replace("U E0.0", "LD E0.0");
    let picture = rung(&text).unwrap();
    assert_eq!(picture.elements[1].mnemonic, "UN");
    assert_eq!(picture.elements[1].symbol, "/");
    let lamp = &picture.elements[2].pins[0].operand;
    assert_eq!((lamp.text.as_str(), lamp.other.as_deref()), ("Lampe", Some("Q0.1")));
    assert_eq!(lamp.comment, "gruen");
}

#[test]
fn a_call_has_the_names_of_its_parameters() {
    let text = "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\nLD I0.0\nCALL SBR0, VW0, VW2\n\
        END_ORGANIZATION_BLOCK\nSUBROUTINE_BLOCK Add:SBR0\nVAR_INPUT\na:INT;\nEND_VAR\n\
        VAR_OUTPUT\nb:INT;\nEND_VAR\nBEGIN\nLD SM0.0\nMOVW #a, #b\nEND_SUBROUTINE_BLOCK\n";
    let (source, assembly) = assembled(text);
    let networks = networks(&source, &assembly);
    assert_eq!(networks.len(), 2, "one a unit");
    let picture = draw(&source, &assembly, &networks[0].rungs[0]).unwrap();
    let call = &picture.elements[1];
    assert_eq!((call.symbol.as_str(), call.shape), ("SBR0", Shape::Box));
    let pins: Vec<_> = call.pins.iter().map(|pin| (pin.name.as_str(), pin.side)).collect();
    assert_eq!(pins, [("a", Side::Left), ("b", Side::Right)]);
}

#[test]
fn eno_goes_on_behind_its_box() {
    let picture = rung("LD I0.0\nMOVW 1, VW0\nAENO\n+I 2, VW0\n").unwrap();
    let [contact, first, second] = &picture.elements[..] else { panic!() };
    assert_eq!((first.column, second.column), (1, first.column + first.columns));
    assert_eq!((first.eno, contact.output), (Some(3), Some(first.powers[0].net)));
    assert_eq!(first.output, Some(second.powers[0].net));
}

#[test]
fn what_is_no_ladder_says_why_and_where() {
    let cases = [
        ("LD I0.0\n= Q0.0\nO I0.1\n= Q0.1\n", 3, Obstacle::LeavesRail),
        ("LD I0.0\nNOT\nLD I0.1\nNOT\nALD\n= Q0.0\n", 5, Obstacle::Part),
        ("LD I0.0\nMOVW 1, VW0\nA I0.1\nAENO\n= Q0.0\n", 4, Obstacle::Eno),
        ("LD I0.0\nLD I0.1\nCTU C1, 5\n= Q0.0\n", 4, Obstacle::InputGoesOn),
        ("LD I0.0\nFOR VW0, 1, 2\n= Q0.0\n", 3, Obstacle::Loop),
        ("A I0.0\n= Q0.0\n", 1, Obstacle::NoValue),
        ("LD I0.0\nTON T37\n", 2, Obstacle::Operand),
        ("LD I0.0\n= Q0.9\n", 2, Obstacle::Operand),
    ];
    for (text, line, expected) in cases {
        assert_eq!(obstacle(text), (line, expected), "{text}");
    }
    let (line, obstacle) = obstacle("LD I0.0\nFOO I0.1\n= Q0.0\n");
    assert!(matches!(obstacle, Obstacle::NotUnderstood(_)) && line == 2, "{obstacle:?}");
}

#[test]
fn networks_are_found_by_their_lines() {
    let text = "// head\nNETWORK 1 // first\nLD I0.0\n= Q0.0\n\nNETWORK 7\nLSCR S0.1\nNETWORK 8\n\
        LD I0.1\n= Q0.1\nLD I0.2\n= Q0.2\nSCRE\n";
    let (source, assembly) = assembled(text);
    let at = |line: usize| {
        let offset = source.line_span(line).start as usize;
        network_at(&source, &assembly, offset).unwrap()
    };
    assert_eq!(at(1).number, Some(1), "before the first one is the first one");
    assert_eq!((at(5).number, at(5).lines), (Some(1), (2, 5)));
    assert_eq!(at(2).title, "first");
    let rungs = at(12).rungs;
    let found: Vec<_> = rungs.iter().map(|rung| (rung.lines, rung.segment)).collect();
    assert_eq!(found, [((9, 10), Some(7)), ((11, 12), Some(7)), ((13, 14), None)]);
    let (source, assembly) = assembled("// nothing\n");
    assert_eq!(network_at(&source, &assembly, 0), None);
}

#[test]
fn of_a_long_network_some_rungs_are_drawn() {
    let text = "LD I0.0\n= Q0.0\n".repeat(60);
    let (source, assembly) = assembled(&text);
    let drawing = drawing_at(&source, &assembly, text.len() / 2).unwrap();
    assert_eq!((drawing.first, drawing.pictures.len()), (24, RUNGS_MAX));
    assert_eq!(drawing.rungs().next().unwrap().0.lines, (49, 50));
}
