//! Tests of the data block: bytes of each kind of value, and each diagnostic with its place.

use super::*;

fn read(text: &str) -> (Vec<String>, Vec<String>) {
    let source = Source::new("data.txt", text).unwrap();
    let (symbols, _) =
        crate::text::symbols::load(&Source::new("s", "Recipe,VW100\nLamp,Q0.0").unwrap());
    let (lines, diagnostics) = parse(&source, &symbols);
    let lines = lines.iter().map(|line| {
        let bytes: Vec<String> = line.bytes.iter().map(|byte| format!("{byte:02X}")).collect();
        format!("{}: {}", line.first_byte, bytes.join(" "))
    });
    let diagnostics = diagnostics.iter().map(|diagnostic| {
        let (line, column) = source.position(diagnostic.span.start as usize);
        format!("{line}:{column} {} {}", diagnostic.code.text(), diagnostic.message)
    });
    (lines.collect(), diagnostics.collect())
}

#[track_caller]
fn good(text: &str, expected: &[&str]) {
    let (lines, errors) = read(text);
    assert_eq!(errors, [""; 0], "{text}");
    assert_eq!(lines, expected, "{text}");
}

#[track_caller]
fn bad(text: &str, expected: &[&str]) {
    assert_eq!(read(text).1, expected, "{text}");
}

#[test]
fn typed_lines() {
    good("VB0 1, 2, 3", &["0: 01 02 03"]);
    good("vb0 255 16#FF 2#1010_0101", &["0: FF FF A5"]);
    good("VW10 +100, -1, 65535, 16#1234, 'AB', 'A'", &["10: 00 64 FF FF FF FF 12 34 41 42 00 41"]);
    good("VD20 3.14, -1", &["20: 40 48 F5 C3 FF FF FF FF"]);
    good("VD20 4294967295, -2147483648, 'ABCD'", &["20: FF FF FF FF 80 00 00 00 41 42 43 44"]);
    good("VB30 'ABC', 0, 'D$N'", &["30: 41 42 43 00 44 0D 0A"]);
    good("VB40 \"TEXT\"", &["40: 04 54 45 58 54"]);
    good("VB40 \"\", \"Gr\u{FC}n\"", &["40: 00 04 47 72 FC 6E"]);
    good("Recipe 5\n6", &["100: 00 05", "102: 00 06"]);
    good("\"recipe\" 5", &["100: 00 05"]);
}

#[test]
fn sizes_of_values() {
    good("V10 5, 256, 65536, -1, 1.5", &["10: 05 01 00 00 01 00 00 FF FF 3F C0 00 00"]);
    good("V10 B#5, W#5, D#5, 16#FF, 16#100", &["10: 05 00 05 00 00 00 05 FF 01 00"]);
    good("V0 'ABCDE', \"F\"", &["0: 41 42 43 44 45 01 46"]);
}

#[test]
fn lines_go_on() {
    good(
        "VB0 1\n2, 3\n// pause\n\n4 // end\nVB10 5;6\n",
        &["0: 01", "1: 02 03", "3: 04", "10: 05", "11: 06"],
    );
    good("VW0 1\r\n2\r\n", &["0: 00 01", "2: 00 02"]);
    good("VB0 1,\n  2", &["0: 01", "1: 02"]);
    good("V0 1\n256\n'a' (* b *) , 2", &["0: 01", "1: 01 00", "3: 61 02"]);
}

#[test]
fn errors() {
    bad("1, 2", &["1:1 E0060 1: the first line of a data block begins with an address"]);
    bad("VB0", &["1:1 E0060 VB0: values are missing after the address"]);
    bad(
        "MB0 1\n2",
        &["1:1 E0060 MB0: a data block gives bytes, words and double words of V memory"],
    );
    bad(
        "V0.0 1",
        &["1:1 E0060 V0.0: a data block gives bytes, words and double words of V memory"],
    );
    bad(
        "Lamp 1",
        &["1:1 E0060 Lamp: a data block gives bytes, words and double words of V memory"],
    );
    bad("Nobody 1", &["1:1 E0060 Nobody: neither an address nor a value"]);
    bad(
        "VB0 256, x, 1.5",
        &[
            "1:5 E0006 256: a byte holds 0 to 255",
            "1:10 E0060 x: no value; there are numbers, 'characters' and \"texts\"",
            "1:13 E0060 1.5: a real number takes a double word, such as VD0",
        ],
    );
    bad("VB0 -1", &["1:5 E0006 -1: a byte holds 0 to 255"]);
    bad(
        "VW0 65536, \"a\"",
        &[
            "1:5 E0006 65536: a word holds -32768 to 65535",
            "1:12 E0060 \"a\": a text is at an address such as VB0",
        ],
    );
    bad("VW0 'ABC'", &["1:5 E0006 'ABC': a word holds -32768 to 65535"]);
    bad("VD0 4294967296", &["1:5 E0006 4294967296: a double word holds -2147483648 to 4294967295"]);
    bad("V0 4294967296", &["1:4 E0006 4294967296: data holds -2147483648 to 4294967295"]);
    bad(
        "VB0 'ab",
        &[
            "1:5 E0002 'ab: the quote is not closed",
            "1:1 E0060 VB0: values are missing after the address",
        ],
    );
    bad("VB0 1,,2", &["1:7 E0002 ,: a value is missing before the comma"]);
    bad("VB0 16#G", &["1:5 E0006 16#G: G is no hexadecimal digit"]);
}

#[test]
fn a_data_file_beside_a_data_block() {
    let source =
        Source::new("t", "DATA_BLOCK\nVB0 1,2,3\nVW8 1\nEND_DATA_BLOCK\nLD I0.0\n= Q0.0").unwrap();
    let file = parse(&Source::new("d", "VB3 1\nVB7 1, 2").unwrap(), &[]).0;
    let (mut program, mut diagnostics) = crate::text::parser::parse(&source, Vec::new());
    join(&mut program.data, &file, &mut diagnostics);
    let shown: Vec<_> =
        diagnostics.iter().map(|d| (d.code.text(), d.span, d.message.as_str())).collect();
    let place = Span::new(21, 26);
    assert_eq!(shown, [("E0060", place, "VB8: the data file gives it a value too")]);
    assert_eq!(place.text(&source.text), "VW8 1");
    let bytes: Vec<_> =
        program.data.iter().map(|line| (line.first_byte, line.bytes.len())).collect();
    assert_eq!(bytes, [(0, 3), (8, 2), (3, 1), (7, 2)]);
}

#[test]
fn ranges_and_overlaps() {
    good("VW10238 1", &["10238: 00 01"]);
    bad("VB10239 1, 2", &["1:1 E0005 VB10239 1, 2: the data ends after VB10239"]);
    bad("VB10240 1", &["1:1 E0005 VB10240: V has the bytes VB0 to VB10239"]);
    bad("V10240 1", &["1:1 E0005 V10240 1: the data ends after VB10239"]);
    bad("VW0 1\nVB1 2", &["2:1 E0060 VB1 2: VB1 has a value already"]);
    bad("VB4 1\nVD1 2 // x", &["2:1 E0060 VD1 2: VB4 has a value already"]);
    let source = Source::new("t", "VB4 1\nVB0 1, 2, 3, 4, 5").unwrap();
    let related = parse(&source, &[]).1[0].related[0].clone();
    assert_eq!(
        (source.position(related.0.start as usize), related.1.as_str()),
        ((1, 1), "from this line")
    );
}
