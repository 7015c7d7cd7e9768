//! Tests of symbols and of the files that declare them.

use super::*;
use crate::source::Source;

fn loaded(text: &str) -> (Vec<String>, Vec<String>) {
    let source = Source::new("s.csv", text).unwrap();
    let (symbols, diagnostics) = load(&source);
    let symbols = symbols
        .iter()
        .map(|s| format!("{}={}={}", s.name, words_of(&s.value), s.comment))
        .collect();
    let shown = diagnostics.iter().map(|diagnostic| {
        let (line, column) = source.position(diagnostic.span.start as usize);
        let mut text = format!("{line}:{column} {} {}", diagnostic.code.text(), diagnostic.message);
        if let Some(suggestion) = &diagnostic.suggestion {
            text += &format!(" -> {suggestion}");
        }
        text
    });
    (symbols, shown.collect())
}

fn good(text: &str) -> Vec<String> {
    let (symbols, errors) = loaded(text);
    assert_eq!(errors, [""; 0], "{text}");
    symbols
}

#[test]
fn separators_and_quotes() {
    assert_eq!(good("Start\tI0.0\tgreen button"), ["Start=I0.0=green button"]);
    assert_eq!(
        good("Start, I0.0, green button\r\nStop,I0.1"),
        ["Start=I0.0=green button", "Stop=I0.1="]
    );
    assert_eq!(good("Start;e0.0;Taster"), ["Start=I0.0=Taster"]);
    assert_eq!(
        good("\"Start\",\"I0.0\",\"say \"\"go\"\", then\""),
        ["Start=I0.0=say \"go\", then"]
    );
    assert_eq!(good("\"a,b\",MW3,x"), ["a,b=MW3=x"]);
    assert_eq!(good("\t\t\tStart\tI0.0\tx"), ["Start=I0.0=x"]);
    assert_eq!(good("Max,16#FF,\nMin,-5"), ["Max=255=", "Min=-5="]);
}

#[test]
fn headers_comments_and_blank_lines() {
    assert_eq!(good("Symbol\tAddress\tComment\nA1\tI0.0\t"), ["A1=I0.0="]);
    assert_eq!(good("// list\n\nSymbol,Adresse,Kommentar\n\n  // x\nM1,Q0.0"), ["M1=Q0.0="]);
    assert_eq!(
        loaded("A,I0.0\nName,Place").1,
        ["2:6 E0008 Place: a symbol stands for an address or a constant"]
    );
}

#[test]
fn every_kind_of_address() {
    assert_eq!(
        good(
            "Sum\tVD0\t\r\nPointer\tAC1\r\nStep\tL0.1\r\nLocal\tLW2\r\nCount\tHC0\r\n\
             Out\tAQW2\r\nClock\tSMB34\r\n"
        ),
        [
            "Sum=VD0=",
            "Pointer=AC1=",
            "Step=L0.1=",
            "Local=LW2=",
            "Count=HC0=",
            "Out=AQW2=",
            "Clock=SMB34="
        ]
    );
    assert_eq!(
        good("Pi\t3.14\nMask\t16#FFFF_FFFF\nFill\tSBR0\nTick\tint3\nMAIN\tOB1\ttop"),
        ["Pi=3.14=", "Mask=4294967295=", "Fill=SBR0=", "Tick=INT3=", "MAIN=defined=top"]
    );
    let wrong = loaded("p\t*AC1\nq\t&VB0\nr\tAC4\ns\tSBR256").1;
    assert_eq!(
        wrong,
        [
            "1:3 E0008 *AC1: a symbol stands for an address or a constant",
            "2:3 E0008 &VB0: a symbol stands for an address or a constant",
            "3:3 E0008 AC4: accumulators are AC0 to AC3",
            "4:3 E0008 SBR256: a symbol stands for an address or a constant",
        ]
    );
}

#[test]
fn errors() {
    let errors = |text| loaded(text).1;
    assert_eq!(errors("Start,I0.9"), ["1:7 E0008 I0.9: a byte has bits 0 to 7 -> I1.1"]);
    assert_eq!(
        errors("Start,IO.0"),
        ["1:7 E0008 IO.0: a symbol stands for an address or a constant -> I0.0"]
    );
    assert_eq!(errors("a,I0.0\nb,I0.1\nA,I0.2"), ["3:1 E0008 A: is already I0.0"]);
    assert_eq!(errors("a,I0.0\nA,I0.0"), [""; 0]);
    assert_eq!(errors("I0.0,I0.1"), ["1:1 E0008 I0.0: a symbol cannot be named like an address"]);
    assert_eq!(errors("TRUE,I0.1"), ["1:1 E0008 TRUE: a symbol cannot be named like a constant"]);
    assert_eq!(errors("16#F,I0.1"), ["1:1 E0008 16#F: a symbol cannot be named like a constant"]);
    assert_eq!(errors("\"\",I0.1"), ["1:1 E0008 the name of the symbol is missing"]);
    assert_eq!(errors("x,I0.0\n,I0.1,lamp"), ["2:2 E0008 the name of the symbol is missing"]);
    assert_eq!(errors("x,I0.0\nStart"), ["2:1 E0008 Start: the address of the symbol is missing"]);
    assert_eq!(errors("\"Start,I0.0"), ["1:1 E0008 \"Start,I0.0: the quote is not closed"]);
}

#[test]
fn files_that_disagree_are_ambiguous() {
    let (mut symbols, _) = load(&Source::new("a", "x,I0.0\ny,I0.1").unwrap());
    symbols.extend(load(&Source::new("b", "X,I0.2\ny,I0.1").unwrap()).0);
    let table = SymbolTable::of_files(symbols);
    let mut buffer = String::new();
    assert!(matches!(table.find("x", &mut buffer), Some(Found::Ambiguous)));
    assert!(matches!(table.find("Y", &mut buffer), Some(Found::Symbol(..))));
    assert!(table.find("z", &mut buffer).is_none());
}

#[test]
fn tables_as_micro_win_copies_them() {
    let rows = "1\t\t\tMotor ein\tQ0.0\tder \"große\" Motor\r\n\
        2\t\t\tNot-Aus\tE0.1\t\"Not-Aus\" Taster\r\n3\t\t\t\t\t\r\n4\r\n";
    let symbols = ["Motor ein=Q0.0=der \"große\" Motor", "Not-Aus=I0.1=\"Not-Aus\" Taster"];
    for header in [
        "",
        "\t\t\tSymbol\tAdresse\tKommentar\r\n",
        "\t\t\tSymbol\tAddress\tComment\r\n",
        "Nr.\t\t\tSymbol\tAdresse\tKommentar\r\n",
    ] {
        assert_eq!(good(&format!("{header}{rows}")), symbols, "{header}");
    }
    assert_eq!(good("1,Start,I0.0,\n2,,,\n3,Stop,I0.1,red"), ["Start=I0.0=", "Stop=I0.1=red"]);
    let two_tables = "Symbol\tAddress\nA1\tI0.0\nSymbol\tAddress\nA2\tI0.1\n";
    assert_eq!(good(two_tables), ["A1=I0.0=", "A2=I0.1="]);
    assert_eq!(good("Pumpe\tQ0.1\t\"läuft\n"), ["Pumpe=Q0.1=\"läuft"]);
}

#[test]
fn a_header_says_which_column_is_which() {
    assert_eq!(
        good("Name;Data type;Address;Comment\nStart;Bool;I0.0;green\nLevel;Int;MW3;"),
        ["Start=I0.0=green", "Level=MW3="]
    );
    assert_eq!(good("Adresse\tSymbol\nE0.0\tStart\n\t\n"), ["Start=I0.0="]);
    assert_eq!(
        loaded("Adresse\tSymbol\nStart\tE0.0").1,
        ["2:1 E0008 Start: a symbol stands for an address or a constant"]
    );
}

#[test]
fn tables_of_step_7() {
    assert_eq!(good("\"Start\",\"E      0.0\",\"BOOL\",\"Taster\""), ["Start=I0.0=Taster"]);
}

#[test]
fn nothing_of_a_comment_is_lost() {
    assert_eq!(good("Start, I0.0, green, on the left"), ["Start=I0.0=green, on the left"]);
    assert_eq!(good("Start\tI0.0\tgreen\ton the left"), ["Start=I0.0=green on the left"]);
}

#[test]
fn lines_that_cannot_be_read_are_errors_at_their_place() {
    let errors = |text| loaded(text).1;
    assert_eq!(errors("1\tStart\tI0.9\n"), ["1:9 E0008 I0.9: a byte has bits 0 to 7 -> I1.1"]);
    assert_eq!(
        errors("1\t\t\tStart\t\tgreen\n"),
        ["1:5 E0008 Start: the address of the symbol is missing"]
    );
    assert_eq!(errors("\"Start\tI0.0\n"), ["1:1 E0008 \"Start: a quote in the name of a symbol"]);
}
