//! The canonical layout: what Micro/WIN exports comes back byte for byte, everything else keeps its
//! words.

use std::path::{Path, PathBuf};
use std::process::Command;

use awl_asm::format::{first_difference, format};
use awl_asm::source::Source;

fn formatted(text: &str) -> String {
    let source = Source::new("t.awl", text).unwrap();
    format(&source).unwrap_or_else(|errors| panic!("{text}\n{errors:?}"))
}

/// Formats a text, and once more: nothing may change then.
#[track_caller]
fn becomes(text: &str, expected: &str) {
    let once = formatted(text);
    assert_eq!(once, expected, "of:\n{text}");
    assert_eq!(formatted(&once), once, "a second time");
}

#[track_caller]
fn stays(text: &str) {
    becomes(text, text);
}

/// As Micro/WIN V4 exports a project: every kind of line.
const EXPORT: &str = "ORGANIZATION_BLOCK MAIN:OB1
TITLE=PROGRAM COMMENTS
// a second line of the block's comment
VAR
Scratch:WORD; // of the main program
END_VAR
BEGIN
Network 1 // Network Title
// Network Comment
LD     SM0.1
S      M0.0, 1
MOVB   16#85, SMB67
MOVW   +100, VW100
MOVD   &VB200, AC1
MOVR   0.75, VD1004
Network 2 
LD     I0.0
LPS
A      I0.3
TON    T37, +50
LPP
AN     T37
CALL   SBR_0, I0.0, VW100, #Scratch
Network 3 // Gr\u{F6}\u{DF}e: 5 \u{20AC} // zweite
LDW>=  VW100, +20
AR<    VD1004, 1.5
FND<>  VW560, +100, VW604
=      Q0.0
LDS=   \"AB c\", VB300
=I     Q0.1
TONR   T5, +1000
SSCPY  VB0, 5, 3, VB20
NETW   VB780, 0
ENI
ATCH   INT_0, 10
END_ORGANIZATION_BLOCK
SUBROUTINE_BLOCK SBR_0:SBR0
TITLE=SUBROUTINE COMMENTS
VAR_INPUT
EN:BOOL; 
Start:BOOL;
Level:INT;
END_VAR
VAR_OUTPUT
Full:BOOL; // at the limit
END_VAR
BEGIN
Network 1 // Network Title
// Network Comment
LD     #Start
=      #Full
END_SUBROUTINE_BLOCK
INTERRUPT_BLOCK INT_0:INT0
TITLE=INTERRUPT ROUTINE COMMENTS
BEGIN
Network 1 // Network Title
// Network Comment
END_INTERRUPT_BLOCK
";

#[test]
fn comments_in_a_declaration_and_a_header_keep_their_letters() {
    becomes(
        "ORGANIZATION_BLOCK main:ob1 (* the Plant *)\nVAR\nx:int (* in Litres *);; // One\n\
         y:bool; ; z\nEND_VAR\nBEGIN\n\
         Network 1 \nLD I0.0\n= Q0.0\nEND_ORGANIZATION_BLOCK\n",
        "ORGANIZATION_BLOCK main:OB1 (* the Plant *)\nVAR\nx:INT (* in Litres *);  // One\n\
         y:BOOL;\nz\nEND_VAR\nBEGIN\n\
         Network 1 \nLD     I0.0\n=      Q0.0\nEND_ORGANIZATION_BLOCK\n",
    );
}

#[test]
fn blanks_of_other_kinds_and_many_operands_keep_the_words() {
    becomes(
        "LD\u{1A}I0.0\u{A0}\n=\u{A0}Q0.0 // a\u{1A}b\u{A0}c\n",
        "LD     I0.0\n=      Q0.0  // a\u{1A}b\u{A0}c\n",
    );
    let operands: Vec<String> = (0..40).map(|number| format!("VW{number}")).collect();
    let line = format!("CALL   SBR0, {}\n", operands.join(", "));
    becomes(&format!("CALL SBR0 {}\n", operands.join(" ")), &line);
}

#[test]
fn an_export_stays_as_it_is() {
    stays(EXPORT);
    stays(&EXPORT.replace('\n', "\r\n"));
}

#[test]
fn the_export_for_the_smart_stays_as_it_is() {
    let text = "ORGANIZATION_BLOCK MAIN:OB1\r\nTITLE=\u{4E3B}\r\nBEGIN\r\nNetwork 1 \r\n\
        //first\r\n\tLD     Always_On\r\n\
                \tCALL   \u{7CFB}\u{7EDF}\r\nEND_ORGANIZATION_BLOCK\r\n\r\n\
                SUBROUTINE_BLOCK \u{7CFB}\u{7EDF}:SBR0\r\n\
                TITLE=\r\nBEGIN\r\nNetwork 1 \r\n\tENI\r\nEND_SUBROUTINE_BLOCK\r\n";
    stays(text);
}

#[test]
fn columns_and_letter_case() {
    becomes("ld i0.0\nA\tm0.0\n= Q0.0", "LD     I0.0\nA      M0.0\n=      Q0.0\n");
    becomes("ldw >= vw0 , 5\nOR<vd0 1.5\n", "LDW>=  VW0, 5\nOR<    VD0, 1.5\n");
    becomes(
        "=i q0.0\n=q0.1\n/i 5,vw0\n+r 1.0 vd0\n",
        "=I     Q0.0\n=      Q0.1\n/I     5, VW0\n+R     1.0, VD0\n",
    );
    becomes("movd &vb100,ac1\nmovw *ac1,*vd10\n", "MOVD   &VB100, AC1\nMOVW   *AC1, *VD10\n");
    becomes(
        "movw w#16#ff,aqw16\nmovw Ain0 , smw22\n",
        "MOVW   w#16#ff, AQW16\nMOVW   Ain0, SMW22\n",
    );
    becomes(
        "a Motor_on\nlds= \"a, b\" vb0\nmovw 'a,' vw0\n",
        "A      Motor_on\nLDS=   \"a, b\", VB0\nMOVW   'a,', VW0\n",
    );
    becomes("u e0.0\nun z1\n= a0.0\n", "U      E0.0\nUN     Z1\n=      A0.0\n");
    becomes("ld m1\nld t1000\nlps\n", "LD     m1\nLD     t1000\nLPS\n");
}

#[test]
fn one_instruction_a_line() {
    becomes(
        "LD I0.0; A I0.1; // both\n= Q0.0;\n",
        "LD     I0.0\nA      I0.1  // both\n=      Q0.0\n",
    );
    becomes("LD I0.0; A I0.1\r\n", "LD     I0.0\r\nA      I0.1\r\n");
    becomes("LD I0.0", "LD     I0.0\n");
    becomes("", "");
    becomes("\n  \n\nLD I0.0\n \t\n\n", "\n\n\nLD     I0.0\n\n\n");
}

#[test]
fn networks() {
    becomes(
        "NETWORK 1 //title\nnetwork 7\nnetwork\n",
        "Network 1 // title\nNetwork 7 \nNetwork 8 \n",
    );
    becomes(
        "Network 1 ; // a title \nNetwork 2\t//// lines\n",
        "Network 1 // a title \nNetwork 2 //// lines\n",
    );
    stays("Network 1 // \nLD     I0.0\n");
    becomes("Network 3 (* why *) // title\n", "Network 3 (* why *) // title\n");
}

#[test]
fn comments() {
    stays(
        "// file\n//# symbol Start I0.0  green\n//#pullup I0.0\n//text  with trailing blanks  \n\
         LD     Start\n",
    );
    stays("//# modbus address 5 baud 19200 parity even\nLD     I0.0\n");
    becomes("   // moved\n\t//# scan 10ms\nLD I0.0\n", "// moved\n//# scan 10ms\nLD     I0.0\n");
    // In a run in which nothing changes, comments stay where they are; otherwise they get a column.
    stays(
        "LD     I0.0 // near\nA      I0.1        // far\n                   // goes on\n\
         =      Q0.0\t// tab\n",
    );
    becomes(
        "LD I0.0 // near\nA      I0.1        // far\n   // goes on\n= Q0.0\nS Q0.1,1// last\n\n\
         = Q0.2 // alone\n",
        "LD     I0.0       // near\nA      I0.1       // far\n                  // goes on\n\
         =      Q0.0\n\
         S      Q0.1, 1    // last\n\n=      Q0.2  // alone\n"
            .replace("       //", "     //")
            .replace("                  // goes", "                // goes")
            .replace("S      Q0.1, 1    // last", "S      Q0.1, 1  // last")
            .as_str(),
    );
    becomes("(* a *) LD (* b *) I0.0 (* c *)// d\n", "(* a *) LD     (* b *) I0.0 (* c *)  // d\n");
    becomes("S Q0.0 /* x */ , 1 (* y *)\n", "S      Q0.0, /* x */ 1 (* y *)\n");
    becomes("(* two\n  lines *) LD I0.0\n", "(* two\n  lines *)\nLD     I0.0\n");
    becomes(
        "LD I0.0 (* two\r\n  lines *)\r\n= Q0.0",
        "LD     I0.0 (* two\r\n  lines *)\r\n=      Q0.0\r\n",
    );
}

#[test]
fn blocks() {
    becomes(
        "organization_block  Main program : ob1\ntitle = a title // b\nvar\n x : int ;// one\n\
         y:Bool\nend_var\nbegin\n\
         ld #x\nend_organization_block\n",
        "ORGANIZATION_BLOCK Main program:OB1\nTITLE= a title // b\nVAR\nx:INT;   // one\n\
         y:BOOL;\nEND_VAR\nBEGIN\n\
         LD     #x\nEND_ORGANIZATION_BLOCK\n"
            .replace("x:INT;   //", "x:INT;  //")
            .as_str(),
    );
    becomes(
        "data_block\nvb0 1,2 , 3// first\n 4,\n'a, b' \"c, d\"\nv10 w#5\nend_data_block\n",
        "DATA_BLOCK\nVB0    1, 2, 3  // first\n       4,\n       'a, b', \"c, d\"\nV10    w#5\n\
         END_DATA_BLOCK\n",
    );
}

#[test]
fn a_text_with_errors_of_form_is_not_formatted() {
    for text in [
        "LD I0,0",
        "LD \"a",
        "LDX I0.0",
        "LD I0.0,,I0.1",
        "(* open",
        "LD I 0.0",
        "BEGIN\nLD I0.0",
        "I0.0 =",
        "LDW= 5x, VW0",
    ] {
        let source = Source::new("t.awl", text).unwrap();
        assert!(format(&source).is_err_and(|errors| !errors.is_empty()), "{text}");
    }
    // What is wrong with meanings is no matter here.
    stays("LD     Nobody\nMOVW   5, AIW40\n=      I0.0, 5\n");
}

/// Every character but blanks, with letters in upper case: what may not change. Commas and
/// semicolons only divide.
fn essence(text: &str) -> String {
    text.chars()
        .filter(|c| !c.is_whitespace() && !matches!(c, ',' | ';'))
        .flat_map(char::to_uppercase)
        .collect()
}

fn programs(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            programs(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "awl") {
            found.push(path);
        }
    }
}

#[test]
fn every_program_of_the_repository_keeps_its_words() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut paths = Vec::new();
    programs(&root.join("examples"), &mut paths);
    programs(&root.join("tests"), &mut paths);
    let mut count = 0;
    for path in &paths {
        let source = Source::from_bytes("t.awl", &std::fs::read(path).unwrap()).unwrap();
        let text = source.text.as_str();
        let Ok(once) = format(&source) else { continue };
        // Networks without number get one.
        if !text.lines().any(|line| line.trim().eq_ignore_ascii_case("NETWORK")) {
            assert_eq!(essence(&once), essence(text), "{}", path.display());
        }
        assert_eq!(formatted(&once), once, "{}", path.display());
        count += 1;
    }
    assert!(count > 100, "only {count} programs of {}", paths.len());
}

#[test]
fn exported_programs_stay_as_they_are() {
    let mut paths = Vec::new();
    programs(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/exports"), &mut paths);
    for path in &paths {
        let bytes = std::fs::read(path).unwrap();
        let source = Source::from_bytes("t.awl", &bytes).unwrap();
        let text =
            format(&source).unwrap_or_else(|errors| panic!("{}: {errors:?}", path.display()));
        let line = first_difference(&source.text, &text);
        assert!(
            source.encoding.encode(&text).as_ref() == Some(&bytes),
            "{}, line {line:?}",
            path.display()
        );
    }
    assert!(paths.len() >= 5, "only {}", paths.len());
}

/// Pieces of which texts are made at random: what divides, and what looks like something else.
const PIECES: [&str; 40] = [
    "LD",
    "a",
    "=",
    "=I",
    "/I",
    "LDW",
    ">=",
    "R",
    "VB10",
    "v1",
    "I0.0",
    "i0",
    ",",
    ";",
    " ",
    "\t",
    "\n",
    "\r\n",
    "//",
    "(*",
    "*)",
    "/*",
    "*/",
    "\"",
    "'",
    "$",
    "#x",
    "16#f",
    "- 5",
    "-",
    "Network",
    "TITLE",
    "BEGIN",
    "VAR",
    "END_VAR",
    "DATA_BLOCK",
    "END_DATA_BLOCK",
    ":INT",
    "\u{A0}",
    "\u{E4}",
];

#[test]
fn texts_at_random_keep_their_words() {
    let mut count = 0;
    for seed in 0..100_000 {
        let mut state: u64 = seed;
        let mut random = |below: usize| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as usize % below
        };
        let len = 1 + random(12);
        let text: String = (0..len).map(|_| PIECES[random(PIECES.len())]).collect();
        let Ok(once) = format(&Source::new("t.awl", text.as_str()).unwrap()) else { continue };
        assert_eq!(formatted(&once), once, "of {text:?}");
        if !text.contains("Network") {
            assert_eq!(essence(&once), essence(&text), "{text:?}");
        }
        count += 1;
    }
    assert!(count > 5_000, "only {count}");
}

#[test]
fn differences_have_a_line() {
    assert_eq!(first_difference("a\nb\n", "a\nb\n"), None);
    assert_eq!(first_difference("a\nb\n", "a\nc\n"), Some(2));
    assert_eq!(first_difference("a", "a\n"), Some(2));
}

fn awl_asm(folder: &Path, arguments: &[&str]) -> (Option<i32>, Vec<u8>, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_awl-asm"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .unwrap();
    (output.status.code(), output.stdout, String::from_utf8(output.stderr).unwrap())
}

/// A folder of its own for a test, empty.
fn folder(name: &str) -> PathBuf {
    let path = std::env::temp_dir().join(format!("awl-asm-format-{name}-{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&path);
    std::fs::create_dir_all(&path).unwrap();
    path
}

/// The same text as Micro/WIN and other programs write it into a file.
fn encodings(text: &str) -> [Vec<u8>; 4] {
    let text = text.replace('\n', "\r\n");
    let code_page =
        text.chars().map(|c| if c == '\u{20AC}' { 0x80 } else { c as u32 as u8 }).collect();
    let utf16 =
        std::iter::once(0xFEFF).chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    [code_page, text.clone().into_bytes(), [b"\xEF\xBB\xBF", text.as_bytes()].concat(), utf16]
}

#[test]
fn the_command_keeps_encoding_and_line_ends() {
    let folder = folder("encodings");
    let loose = EXPORT.replace("LD     SM0.1", "  ld sm0.1").replace("Network 2 ", "NETWORK 2");
    for (canonical, loose) in encodings(EXPORT).into_iter().zip(encodings(&loose)) {
        std::fs::write(folder.join("a.awl"), &canonical).unwrap();
        assert_eq!(
            awl_asm(&folder, &["--fmt", "a.awl"]),
            (Some(0), canonical.clone(), String::new())
        );
        assert_eq!(
            awl_asm(&folder, &["--fmt", "a.awl", "--check"]),
            (Some(0), Vec::new(), String::new())
        );
        std::fs::write(folder.join("a.awl"), &loose).unwrap();
        let (code, output, errors) =
            awl_asm(&folder, &["a.awl", "--fmt", "--check", "-o", "a.awl"]);
        let message = "a.awl:10: not in canonical layout; `awl-asm --fmt` writes it\n";
        assert_eq!((code, output, errors.as_str()), (Some(1), Vec::new(), message));
        assert_eq!(std::fs::read(folder.join("a.awl")).unwrap(), loose, "--check writes nothing");
        assert_eq!(
            awl_asm(&folder, &["--fmt", "a.awl", "-o", "a.awl"]),
            (Some(0), Vec::new(), String::new())
        );
        assert_eq!(std::fs::read(folder.join("a.awl")).unwrap(), canonical);
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn the_command_refuses_what_it_cannot_write_back() {
    let folder = folder("errors");
    std::fs::write(folder.join("a.awl"), "LD I0.0\nLDX I0,1\n").unwrap();
    let (code, output, errors) = awl_asm(&folder, &["--fmt", "a.awl", "-o", "b.awl"]);
    assert_eq!((code, output.len()), (Some(1), 0));
    assert!(errors.contains("E0001") && errors.contains("a.awl:2:1"), "{errors}");
    assert!(!folder.join("b.awl").exists());
    std::fs::write(folder.join("a.awl"), b"\xEF\xBB\xBFLD I0.0 // \xFC\n").unwrap();
    let (code, _, errors) = awl_asm(&folder, &["--fmt", "a.awl"]);
    assert_eq!((code, errors.contains("byte order mark")), (Some(2), true), "{errors}");
    assert_eq!(awl_asm(&folder, &["--fmt", "none.awl"]).0, Some(2));
    assert_eq!(awl_asm(&folder, &["--fmt", "a.awl", "--native"]).0, Some(2));
    std::fs::remove_dir_all(&folder).unwrap();
}
