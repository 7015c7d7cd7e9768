//! Tests of symbols in programs: where they are known, and what is wrong with them.

use super::*;

#[test]
fn symbols_are_known_everywhere() {
    let text = "LD start\nA \"START\"\n= Größe\nMOVW \"a b\",MW0\n//# symbol Start I0.0 // green\n\
                \t//# symbol größe Q0.0  lamp on the left\n//#symbol \"a b\" 16#FF\n";
    let program = good_program(text);
    assert_eq!(statements(&program), "LD I0.0; A I0.0; = Q0.0; MOVW 16#FF,MW0");
    let comments: Vec<_> = program.symbols.iter().map(|symbol| symbol.comment.as_str()).collect();
    assert_eq!(comments, ["green", "lamp on the left", ""]);
    good("//# symbol M1 Q0.0\n//# symbol S1 I0.1\nLD S1\n= M1", "LD I0.1; = Q0.0");
}

#[test]
fn symbol_errors() {
    bad(
        "//# symbol Start I0.0\nLD Strat\nLD \"Strat\"\nLD Nothing\n= \"x",
        &[
            "E0007 2:4 `Strat`: Strat: no such symbol -> Start",
            "E0007 3:4 `\"Strat\"`: \"Strat\": no such symbol -> \"Start\"",
            "E0007 4:4 `Nothing`: Nothing: no such symbol",
            "E0002 5:3 `\"x`: \"x: the quote is not closed",
        ],
    );
    bad(
        "//# symbol\n//# symbol x\n//# symbol I0.0 I0.1\n//# symbol y I0.9\n//# symbol z VD0\n\
         //# symbol ON 1\nLD y",
        &[
            "E0008 1:5 `symbol`: symbol: //# symbol is followed by a name and an address",
            "E0008 2:12 `x`: x: //# symbol is followed by a name and an address",
            "E0008 3:12 `I0.0`: I0.0: a symbol cannot be named like an address",
            "E0008 4:14 `I0.9`: I0.9: a byte has bits 0 to 7 -> I1.1",
            "E0008 6:12 `ON`: ON: a symbol cannot be named like a constant",
        ],
    );
    bad(
        "//# symbol a I0.0\n//# symbol A I0.1\n//# symbol A I0.0",
        &["E0008 2:12 `A`: A: is already I0.0 (first defined here: 1:12 `a`)"],
    );
}

#[test]
fn symbols_of_files() {
    let (symbols, found) =
        crate::text::symbols::load(&source("x,I0.0\nTotal,OB1\ny,I0.1\ny2,I0.1"));
    assert!(found.is_empty());
    let mut doubled = symbols.clone();
    doubled.extend(crate::text::symbols::load(&source("Y,I0.2")).0);
    let program = source("LD x\nMOVW total,MW0\nA y\n//# symbol y2 I0.3\n");
    let (parsed, found) = parse(&program, doubled);
    assert_eq!(statements(&parsed), "LD I0.0; MOVW ?,MW0; A ?");
    assert_eq!(
        diagnostics(&program, &found),
        [
            "E0022 2:6 `total`: total: the symbol stands for something that uno200 does not have",
            "E0008 3:3 `y`: y: symbol files give it different values",
            "E0008 4:12 `y2`: y2: is already I0.1",
        ]
    );
}
