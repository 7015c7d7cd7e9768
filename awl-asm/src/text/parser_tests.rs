//! Tests of the whole front end: spellings that are accepted, and each diagnostic with its place.

use std::fmt::Write as _;

use super::*;
use crate::text::ast::{Instruction, Value};

#[path = "parser_settings_tests.rs"]
mod settings;
#[path = "parser_symbols_tests.rs"]
mod symbols;

fn source(text: &str) -> Source {
    Source::new("t.awl", text).unwrap()
}

fn shown(instruction: &Instruction) -> String {
    let mut text = instruction.mnemonic().to_owned();
    text += instruction.relation.map_or("", |relation| relation.symbol());
    for (index, operand) in instruction.operands.iter().enumerate() {
        text += if index == 0 { " " } else { "," };
        let _ = match &operand.value {
            Value::Address(address) => write!(text, "{address}"),
            Value::Constant(constant) if constant.is_pattern => {
                write!(text, "16#{:X}", constant.value)
            }
            Value::Constant(constant) => write!(text, "{}", constant.value),
            Value::Real(bits) => write!(text, "{:?}", f32::from_bits(*bits)),
            Value::Text(bytes) => write!(text, "\"{}\"", bytes.escape_ascii()),
            Value::Indirect(address) => write!(text, "*{address}"),
            Value::AddressOf(address) => write!(text, "&{address}"),
            Value::Unit(unit) => write!(text, "{unit}"),
            Value::Invalid => write!(text, "?"),
        };
    }
    text
}

/// The statements one after the other, as the parser understood them.
fn statements(program: &Program) -> String {
    let statements = program.statements.iter().map(|statement| match statement {
        Statement::Unit(unit) => format!("{}:{}", unit.name, unit.id),
        Statement::Network(network) => format!("NETWORK {}:{}", network.number, network.title),
        Statement::Instruction(instruction) => shown(instruction),
    });
    statements.collect::<Vec<_>>().join("; ")
}

fn place(source: &Source, span: Span) -> String {
    let (line, column) = source.position(span.start as usize);
    format!("{line}:{column} `{}`", span.text(&source.text))
}

fn diagnostics(source: &Source, diagnostics: &[Diagnostic]) -> Vec<String> {
    let shown = diagnostics.iter().map(|diagnostic| {
        let mut text = format!(
            "{} {}: {}",
            diagnostic.code.text(),
            place(source, diagnostic.span),
            diagnostic.message
        );
        if let Some(suggestion) = &diagnostic.suggestion {
            text += &format!(" -> {suggestion}");
        }
        for (span, words) in &diagnostic.related {
            text += &format!(" ({words}: {})", place(source, *span));
        }
        text
    });
    shown.collect()
}

/// Parses a text without errors.
#[track_caller]
fn good_program(text: &str) -> Program {
    let source = source(text);
    let (program, found) = parse(&source, Vec::new());
    assert_eq!(diagnostics(&source, &found), [""; 0], "{text}");
    program
}

#[track_caller]
fn good(text: &str, expected: &str) {
    assert_eq!(statements(&good_program(text)), expected, "{text}");
}

#[track_caller]
fn bad(text: &str, expected: &[&str]) {
    let source = source(text);
    let (_, found) = parse(&source, Vec::new());
    assert_eq!(diagnostics(&source, &found), expected, "{text}");
}

/// What was understood of a text with errors.
fn understood(text: &str) -> String {
    statements(&parse(&source(text), Vec::new()).0)
}

#[test]
fn spellings_of_instructions() {
    for text in [
        "LDW>= 5,MW0",
        "LDW >= 5 , MW0",
        "LDW>=5,MW0",
        "ldw>=5 mw0",
        "\tLdW\t>=\t5\tMW0\t",
        "LDW>=+5,MW0;",
    ] {
        good(text, "LDW>= 5,MW0");
    }
    for text in ["=Q0.0", "= Q0.0", "=A0.0", "=   q0.0 ;", "=Q0.0// x", "= (* a *) Q0.0 /* b */"] {
        good(text, "= Q0.0");
    }
    for text in ["+I 5,VW0", "+I +5, VW0", "+i 5 vw0", "+I + 5,VW0", "+I\t+5\tVW0"] {
        good(text, "+I 5,VW0");
    }
    good(
        "-I -5 VW0\n/I 2,VW0 // half\n*I 3,VW0\n*i VW2 VW0",
        "-I -5,VW0; /I 2,VW0; *I 3,VW0; *I VW2,VW0",
    );
    good(
        "S Q0.0,1\nR Q0.0 1\ns a0.0 , 1\nA A0.0\nO A0.1",
        "S Q0.0,1; R Q0.0,1; S Q0.0,1; A Q0.0; O Q0.1",
    );
    good(
        "MOVW Ain0,MW3\nMOVW aiw2 MW3\nMOVW AEW4,MW3",
        "MOVW Ain0,MW3; MOVW AIW2,MW3; MOVW AIW4,MW3",
    );
    good("U E0.0\nUN A0.1\nUW= EW0,5\nub<> 5,MB0", "A I0.0; AN Q0.1; AW= IW0,5; AB<> 5,MB0");
    good("TOFF T37,5\nTON T38 +5\nCTU Z1,3\nLD T38", "TOF T37,5; TON T38,5; CTU C1,3; LD T38");
    good("LD I0.0; A I0.1; = Q0.0;\n;;\nNOT", "LD I0.0; A I0.1; = Q0.0; NOT");
    good("ON I0.0\nEU\nLDS 3\nJMP 1\nLBL 1\nNOP 0", "ON I0.0; EU; LDS 3; JMP 1; LBL 1; NOP 0");
    good("LD SM0.1\rA IX0.0\r\nO MX1.1", "LD SM0.1; A I0.0; O M1.1");
    good("LD\u{A0}I0.0\u{1A}", "LD I0.0");
    good("", "");
}

#[test]
fn relations() {
    for relation in ["=", "<>", "<", ">", "<=", ">="] {
        good(&format!("LDB{relation}MB0,5"), &format!("LDB{relation} MB0,5"));
    }
    bad("LDW== MW0,5", &["E0002 1:4 `==`: ==: no such comparison; there are = <> < > <= >= -> ="]);
    bad("LDW=>MW0,5", &["E0002 1:4 `=>`: =>: no such comparison; there are = <> < > <= >= -> >="]);
    bad("AW !=MW0,5", &["E0002 1:4 `!=`: !=: no such comparison; there are = <> < > <= >= -> <>"]);
    bad("LDW MW0,5", &["E0002 1:1 `LDW`: LDW: the comparison is missing"]);
    bad("LD>= 5,MW0", &["E0001 1:1 `LD>=`: LD>=: no such instruction -> LDW>="]);
    bad("XDW>= 5,MW0", &["E0001 1:1 `XDW>=`: XDW>=: no such instruction -> LDW>="]);
    bad("MOVW= 5,MW0", &["E0001 1:1 `MOVW=`: MOVW=: no such instruction"]);
    assert_eq!(understood("LDW MW0,5\nLD>= 5,MW0"), "LDW= MW0,5; LDW= ?,?");
}

#[test]
fn constants() {
    good("MOVW 16#FF,MW0\nMOVW 2#1010_0101 MW0", "MOVW 16#FF,MW0; MOVW 16#A5,MW0");
    good(
        "MOVB 'A',MB0\nMOVW 'AB' MW0\nMOVB '/',MB0",
        "MOVB 16#41,MB0; MOVW 16#4142,MW0; MOVB 16#2F,MB0",
    );
    good(
        "MOVW '//',MW0\nMOVW '\"\"' MW0\nMOVB '$'' , MB0",
        "MOVW 16#2F2F,MW0; MOVW 16#2222,MW0; MOVB 16#27,MB0",
    );
    good(
        "MOVB B#'A',MB0\nMOVW W#16#FFFF,MW0\nMOVB ON,MB0",
        "MOVB 16#41,MB0; MOVW 16#FFFF,MW0; MOVB 1,MB0",
    );
    good("MOVW 99999999999999999999,MW0", "MOVW 9223372036854775807,MW0");
    bad("MOVW 16#G1,MW0", &["E0006 1:6 `16#G1`: 16#G1: G is no hexadecimal digit"]);
    bad("MOVW MW0, 5x", &["E0006 1:11 `5x`: 5x: x is no digit"]);
    good("MOVW 1.5,MW0", "MOVW 1.5,MW0");
    bad("MOVW 'A,MW0", &["E0002 1:6 `'A,MW0`: 'A,MW0: the quote is not closed"]);
    good("MOVW DW#16#5,MW0", "MOVW 16#5,MW0");
}

#[test]
fn addresses() {
    bad("= Q0.9", &["E0005 1:3 `Q0.9`: Q0.9: a byte has bits 0 to 7 -> Q1.1"]);
    good("MOVW AC0,VW0", "MOVW AC0,VW0");
    good("MOVD &VB0,*AC1", "MOVD &VB0,*AC1");
    bad("MOVW *AC0,MW0", &["E0082 1:6 `*AC0`: AC0 cannot hold a pointer"]);
    bad("LD #x", &["E0007 1:4 `#x`: #x: no such local variable"]);
    bad("LD IO.0", &["E0007 1:4 `IO.0`: IO.0: no such symbol -> I0.0"]);
    bad("= QO.1", &["E0007 1:3 `QO.1`: QO.1: no such symbol -> Q0.1"]);
    bad("LD I0.O", &["E0007 1:4 `I0.O`: I0.O: no such symbol -> I0.0"]);
    bad("LD I0,0", &["E0005 1:4 `I0,0`: I0,0: a point is before the number of the bit -> I0.0"]);
    bad("S Q0,0,1", &["E0005 1:3 `Q0,0`: Q0,0: a point is before the number of the bit -> Q0.0"]);
    bad("LD I 0.0", &["E0005 1:4 `I 0.0`: I 0.0: no blank is inside an address -> I0.0"]);
    bad("LD M1.", &["E0005 1:4 `M1.`: M1.: an address ends with its number -> M1.0"]);
    bad("LD %I0.0", &["E0007 1:4 `%I0.0`: %I0.0: no such symbol -> I0.0"]);
    bad("LD ?", &["E0002 1:4 `?`: ?: neither an address nor a constant nor a symbol"]);
    assert_eq!(understood("LD I0,0\nS Q0,0,1\nTON ?,5"), "LD ?; S ?,1; TON ?,5");
}

#[test]
fn commas() {
    bad("S Q0.0,,1", &["E0002 1:8 `,`: ,: an operand is missing before the comma"]);
    bad("S ,Q0.0,1", &["E0002 1:3 `,`: ,: an operand is missing before the comma"]);
    bad("S Q0.0,", &["E0002 1:7 `,`: ,: an operand is missing after the comma"]);
    bad(", LD I0.0", &["E0002 1:1 `,`: ,: an instruction begins with its mnemonic"]);
    assert_eq!(understood("S Q0.0,"), "S Q0.0,?");
}

#[test]
fn unknown_mnemonics() {
    let meant = |wrong: &str, right: &str| {
        let message = format!("E0001 2:1 `{wrong}`: {wrong}: no such instruction -> {right}");
        bad(&format!("LD I0.0\n{wrong}"), &[&message]);
    };
    for (wrong, right) in [
        ("OUT", "="),
        ("and", "A"),
        ("OR", "O"),
        ("ANDN", "AN"),
        ("UND", "A"),
        ("RST", "R"),
        ("RES", "R"),
        ("ADD_I", "+I"),
        ("ADDI", "+I"),
        ("MOV", "MOVW"),
        ("TIM", "TON"),
        ("MVOW", "MOVW"),
        ("TOON", "TON"),
        ("NETWROK", "NETWORK"),
        ("LDI0.0", "LD I0.0"),
        ("SQ0.0", "S Q0.0"),
        ("TONT37", "TON T37"),
        ("JMP1", "JMP 1"),
    ] {
        meant(wrong, right);
    }
    // The first contact of a rung is a load.
    bad("and I0.0", &["E0001 1:1 `and`: and: no such instruction -> LD"]);
    bad("NETWORK 1\nORN I0.0", &["E0001 2:1 `ORN`: ORN: no such instruction -> LDN"]);
    bad("XYZZY I0.9,,", &["E0001 1:1 `XYZZY`: XYZZY: no such instruction"]);
    bad("\n  Motör ?", &["E0001 2:3 `Motör`: Motör: no such instruction"]);
    bad("M1: LD I0.0", &["E0001 1:1 `M1:`: M1:: no such instruction"]);
    bad("\"x\" = 5", &["E0002 1:1 `\"x\"`: \"x\": an instruction begins with its mnemonic"]);
    bad("] x", &["E0002 1:1 `]`: ]: an instruction begins with its mnemonic"]);
    bad(")", &["E0001 1:1 `)`: ): no such instruction"]);
    assert_eq!(understood("LDX I0.0\nAND Q0.0\nXYZZY\n= Q0.0"), "LD ?; A ?; = Q0.0");
}

#[test]
fn comparisons_beside_instructions_of_the_same_name() {
    good(
        "LDS 1\nLDS= VB0,\"ab\"\nOR<> VD0,1.5\nFND< VW0,5,AC0",
        "LDS 1; LDS= VB0,\"ab\"; OR<> VD0,1.5; FND< VW0,5,AC0",
    );
    bad("FND=> VW0,5,VW2", &["E0002 1:4 `=>`: =>: no such comparison; there are = <> < >"]);
    bad("LDS== VB0,VB1", &["E0002 1:4 `==`: ==: no such comparison; there are = <> -> ="]);
    let help = |text| {
        parse(&source(text), Vec::new()).1.into_iter().flat_map(|diagnostic| diagnostic.help)
    };
    assert!(help("FND VW0,5,VW2").eq(["there are FND= FND<> FND< FND>, such as `FND= VW0,5,VW2`"]));
    assert!(help("AS VB0,VB1").eq(["there are AS= AS<>, such as `AS= VB0,VB1`"]));
    assert!(help("AW VW0,1").eq([
        "the bits of two values are combined by `ANDW`, which names both",
        "comparisons: there are AW= AW<> AW< AW> AW<= AW>=, such as `AW= VW0,1`",
    ]));
    bad("OR I0.0", &["E0001 1:1 `OR`: OR: no such instruction -> LD"]);
    bad("LD= 1", &["E0001 1:1 `LD=`: LD=: no such instruction -> LDW="]);
}

#[test]
fn missing_instructions() {
    bad(
        "NETR VB0,0",
        &["E0084 1:1 `NETR`: NETR: there is no PPI network after the Uno's serial line"],
    );
    bad(
        "todrx VB0",
        &["E0022 1:1 `todrx`: TODRX: the clock of an Uno is software and knows no daylight \
             saving time"],
    );
    bad("RET", &["E0081 1:1 `RET`: RET returns from a subroutine only"]);
}

#[test]
fn comments() {
    good("/* a\n b */ LD I0.0 (* x\n *) = Q0.0", "LD I0.0; = Q0.0");
    good("NOT /* a\n b */ LD I0.0\nNETWORK 2 (*\n*) = Q0.0", "NOT; LD I0.0; NETWORK 2:; = Q0.0");
    good("S Q0.0, (* how\n many *) // ?\nNOT".replace("0, ", "0,1").as_str(), "S Q0.0,1; NOT");
    bad(
        "LDW /*\n*/ >= 5,MW0",
        &[
            "E0002 1:1 `LDW`: LDW: the comparison is missing",
            "E0002 2:4 `>=`: >=: an instruction begins with its mnemonic",
        ],
    );
    good("// LD I0.0\nLD I0.0 // ( /* not open\n= Q0.0", "LD I0.0; = Q0.0");
    bad("LD I0.0\n= Q0.0 (* x\nLD", &["E0002 2:8 `(*`: (*: the comment is not closed"]);
    bad("/*", &["E0002 1:1 `/*`: /*: the comment is not closed"]);
    bad("*) LD", &["E0002 1:1 `*)`: *): no comment is open here"]);
}

#[test]
fn networks() {
    let program = good_program(
        "NETWORK\nLD I0.0\nNetwork 7 // Title\n= Q0.0\nnetwork\n// first\n// second\nEU",
    );
    assert!(program.has_networks);
    assert_eq!(
        statements(&program),
        "NETWORK 1:; LD I0.0; NETWORK 7:Title; = Q0.0; NETWORK 8:first; EU"
    );
    good(
        "NETWORK 1 //NETWORK TITLE (one line)\nNETWORK 2 ;",
        "NETWORK 1:NETWORK TITLE (one line); NETWORK 2:",
    );
    good("NETWORK 3\nLD I0.0 // no title\n// none either", "NETWORK 3:; LD I0.0");
    let span = |text: &str| match &good_program(text).statements[0] {
        Statement::Network(network) => network.span.text(text).to_owned(),
        Statement::Instruction(_) | Statement::Unit(_) => String::new(),
    };
    assert_eq!(span("Network 1 // x \nLD I0.0"), "Network 1 // x");
    assert_eq!(span("Network 12  \nLD I0.0"), "Network 12");
    assert_eq!(span("Network\nLD I0.0"), "Network");
    bad(
        "NETWORK 1 Motor an",
        &["E0002 1:11 `Motor an`: Motor an: the title of a network is after // -> // Motor an"],
    );
    bad(
        "NETWORK Motor",
        &["E0002 1:9 `Motor`: Motor: the title of a network is after // -> // Motor"],
    );
    assert!(!good_program("LD I0.0").has_networks);
}

const EXPORT: &str = "\
ORGANIZATION_BLOCK MAIN:OB1\r
TITLE=PROGRAM COMMENTS: don't (* panic\r
// comment\r
VAR\r
END_VAR\r
BEGIN\r
Network 1 // First\r
// Network Comment\r
LD     SM0.0\r
=      Q0.0\r
END_ORGANIZATION_BLOCK\r
SUBROUTINE_BLOCK SBR_0:SBR0\r
TITLE=SUBROUTINE COMMENTS\r
VAR_INPUT\r
x:BOOL; // input\r
END_VAR\r
BEGIN\r
Network 1 // Network Title\r
// Network Comment\r
END_SUBROUTINE_BLOCK\r
INTERRUPT_BLOCK INT_0:INT0\r
TITLE=INTERRUPT ROUTINE COMMENTS\r
BEGIN\r
Network 1 // Network Title\r
END_INTERRUPT_BLOCK\r
";

#[test]
fn exported_blocks() {
    let understood = "MAIN:OB1; NETWORK 1:First; LD SM0.0; = Q0.0; SBR_0:SBR0; NETWORK 1:Network \
        Title; \
        INT_0:INT0; NETWORK 1:Network Title";
    good(EXPORT, understood);
    let lower = understood.to_lowercase();
    let program = good_program(&EXPORT.to_lowercase().replace("\r\n", "\n"));
    assert_eq!(statements(&program).to_lowercase(), lower);
    let (_, subroutine) = program.units().nth(1).expect("a subroutine");
    assert_eq!(subroutine.title, "subroutine comments");
    let [variable] = subroutine.variables.as_slice() else { panic!("one variable") };
    assert_eq!((variable.name.as_str(), variable.comment.as_str()), ("x", "input"));
    assert_eq!(variable.address.to_string(), "L0.0");
}

#[test]
fn local_variables_have_places() {
    let text = "SUBROUTINE_BLOCK a:SBR0\nVAR_OUTPUT\no:DINT;\nEND_VAR\nVAR\nt:BYTE;\nEND_VAR\n\
        VAR_INPUT\n\
        EN:BOOL;\nb0:BOOL; b1:BOOL;\nw:WORD; c:BOOL\nEND_VAR\nVAR_IN_OUT\nd:BOOL;\nEND_VAR\nBEGIN\n\
        LD #b1\nA b0\n= #D\nMOVW #w,LW2\nEND_SUBROUTINE_BLOCK\nORGANIZATION_BLOCK x:OB1\n\
        END_ORGANIZATION_BLOCK";
    let program = good_program(text);
    let (_, unit) = program.units().next().expect("a subroutine");
    let places =
        unit.variables.iter().map(|variable| format!("{} {}", variable.name, variable.address));
    let places: Vec<String> = places.collect();
    assert_eq!(places, ["b0 L0.0", "b1 L0.1", "w LW1", "c L3.0", "d L3.1", "o LD4", "t LB8"]);
    assert_eq!(statements(&program), "a:SBR0; LD L0.1; A L0.0; = L3.1; MOVW LW1,LW2; x:OB1");
}

#[test]
fn data_blocks() {
    bad(
        "DATA_BLOCK x\nBEGIN\nVB0 1, 2\n'ab', 300\nVB2 0\nEND_DATA_BLOCK",
        &[
            "E0006 4:7 `300`: 300: a byte holds 0 to 255",
            "E0060 5:1 `VB2 0`: VB2 0: VB2 has a value already (from this line: 4:1 `'ab', 300`)",
        ],
    );
}

#[test]
fn block_structure_errors() {
    bad(
        "ORGANIZATION_BLOCK M:OB1\nBEGIN\nLD I0.0",
        &["E0021 1:1 `ORGANIZATION_BLOCK`: ORGANIZATION_BLOCK: END_ORGANIZATION_BLOCK is missing"],
    );
    bad(
        "BEGIN\nTITLE=x\nVAR\nEND_VAR\nEND_VAR\nEND_DATA_BLOCK",
        &[
            "E0021 1:1 `BEGIN`: BEGIN: no block is open",
            "E0021 2:1 `TITLE`: TITLE: no block is open",
            "E0021 3:1 `VAR`: VAR: no block is open",
            "E0021 5:1 `END_VAR`: END_VAR: no VAR section is open",
            "E0021 6:1 `END_DATA_BLOCK`: END_DATA_BLOCK: no block is open",
        ],
    );
    bad(
        "ORGANIZATION_BLOCK M:OB1\nLD I0.0\nBEGIN\nVAR\nEND_SUBROUTINE_BLOCK\nLD I0.0",
        &[
            "E0021 2:1 `LD`: BEGIN is missing before the first instruction (of this block: 1:1 \
             `ORGANIZATION_BLOCK`)",
            "E0021 3:1 `BEGIN`: BEGIN: the block has already begun",
            "E0021 4:1 `VAR`: VAR: the block has already begun",
            "E0021 4:1 `VAR`: VAR: END_VAR is missing",
            "E0021 5:1 `END_SUBROUTINE_BLOCK`: END_SUBROUTINE_BLOCK: the open block is another \
         -> END_ORGANIZATION_BLOCK (the open block: 1:1 `ORGANIZATION_BLOCK`)",
            "E0021 6:1 `LD`: an instruction is outside of the blocks",
        ],
    );
    bad(
        "LD I0.0\nORGANIZATION_BLOCK M:OB1\nBEGIN x\nORGANIZATION_BLOCK N:OB1\nBEGIN\n\
         END_ORGANIZATION_BLOCK",
        &[
            "E0021 2:1 `ORGANIZATION_BLOCK`: ORGANIZATION_BLOCK: instructions are before the \
             first block \
         (this one, for example: 1:1 `LD`)",
            "E0002 3:7 `x`: x: nothing is after BEGIN",
            "E0021 4:1 `ORGANIZATION_BLOCK`: ORGANIZATION_BLOCK: END_ORGANIZATION_BLOCK is \
             missing before it \
         (this block is still open: 2:1 `ORGANIZATION_BLOCK`)",
            "E0021 4:1 `ORGANIZATION_BLOCK`: ORGANIZATION_BLOCK: a program has only one \
         (the first one: 2:1 `ORGANIZATION_BLOCK`)",
        ],
    );
}

#[test]
fn spans() {
    let text = "  LDW >= 5 , MW0 ; // x";
    let program = good_program(text);
    let Statement::Instruction(instruction) = &program.statements[0] else { panic!() };
    assert_eq!(instruction.mnemonic_span.text(text), "LDW >=");
    assert_eq!(instruction.span.text(text), "LDW >= 5 , MW0");
    assert_eq!(
        instruction.operands.iter().map(|o| o.span.text(text)).collect::<Vec<_>>(),
        ["5", "MW0"]
    );
}

#[test]
fn all_errors_in_one_run_and_in_order() {
    let text = "\u{FEFF}";
    let bytes = format!("{text}LD I0.9\r\n\tFOO\r\n= Motor\r\nMOVW 1.5,,VW0\r\n");
    let source = Source::from_bytes("t.awl", bytes.as_bytes()).unwrap();
    let (_, found) = parse(&source, Vec::new());
    assert_eq!(
        diagnostics(&source, &found),
        [
            "E0005 1:4 `I0.9`: I0.9: a byte has bits 0 to 7 -> I1.1",
            "E0001 2:2 `FOO`: FOO: no such instruction",
            "E0007 3:3 `Motor`: Motor: no such symbol",
            "E0002 4:10 `,`: ,: an operand is missing before the comma",
        ]
    );
}

/// A small generator: the same texts in every run.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) as usize % bound.max(1)
    }
}

/// What random texts are made of.
const PIECES: &[&str] = &[
    "LD",
    "I0.0",
    "= ",
    "Q0.",
    "\n",
    "\r",
    "\r\n",
    " ",
    "\t",
    ",",
    ";",
    "//",
    "//#",
    "/*",
    "*/",
    "(*",
    "*)",
    "'",
    "\"",
    "$",
    "symbol",
    "pullup",
    "retain",
    "name",
    "scan",
    "VB0-VB",
    "-",
    "ä",
    "\u{A0}",
    "€",
    "中",
    "NETWORK",
    "TITLE=",
    "ORGANIZATION_BLOCK",
    "BEGIN",
    "END_ORGANIZATION_BLOCK",
    "VAR",
    "SUBROUTINE_BLOCK",
    "LDW",
    ">=",
    "16#",
    "2#",
    "5",
    "+I",
    "/I",
    "*I",
    "&",
    "*AC1",
    "#",
    "%",
    ".",
    "9999999999",
    "S",
    "OR=",
    "é",
    "\0",
    "\u{1A}",
    "\u{FEFF}",
    "E",
    "AIW",
    "Ain",
];

#[test]
fn no_text_panics() {
    let mut random = Random(7);
    for _ in 0..6000 {
        let mut text = if random.below(4) == 0 { EXPORT.to_owned() } else { String::new() };
        for _ in 0..random.below(30) {
            let mut at = random.below(text.len() + 1);
            while !text.is_char_boundary(at) {
                at -= 1;
            }
            match random.below(5) {
                0 if !text.is_empty() => drop(text.drain(at..).next()),
                _ => text.insert_str(at, PIECES[random.below(PIECES.len())]),
            }
        }
        let source = source(&text);
        let (symbols, found) = crate::text::symbols::load(&source);
        let (_, more) = parse(&source, symbols);
        for diagnostic in found.iter().chain(&more) {
            assert!(
                text.get(diagnostic.span.start as usize..diagnostic.span.end as usize).is_some(),
                "{text:?} {diagnostic:?}"
            );
            crate::render::human(&source, diagnostic, false);
            crate::render::json(&source, diagnostic);
        }
    }
}
