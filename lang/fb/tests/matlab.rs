//! Blocks as MATLAB text: what is written is read as the same block, and what is wrong is told at
//! its place. `FB_BLOCKS` sets how many random blocks there are, `FB_SEED` shows one.

#[path = "random_blocks/generate.rs"]
mod generate;
#[path = "random_blocks/seeds.rs"]
mod seeds;

use diagnostics::{Severity, Source, Span};
use fb::{Block, Code, DataType, matlab, xml};
use generate::Generator;

const HYSTERESIS: &str = include_str!("blocks/hysteresis.fbt");
const RAMP: &str = include_str!("../../../examples/fbt/ramp.fbt");

fn source(name: &str, text: &str) -> Source {
    Source::new(name, text).expect("a short text")
}

fn block(text: &str) -> (Block, Source) {
    let source = source("block.fbt", text);
    let read = xml::read(&source);
    (read.block.unwrap_or_else(|| panic!("{:?}", read.diagnostics)), source)
}

fn written(text: &str) -> String {
    let (block, source) = block(text);
    let written = matlab::write(&block, &source);
    written.text.unwrap_or_else(|| panic!("{:?}{:?}", written.diagnostics, written.of_st))
}

fn read(text: &str) -> Block {
    let read = matlab::read(&source("block.m", text));
    read.block.unwrap_or_else(|| panic!("{:?}\n{text}", read.diagnostics))
}

/// A small block with an algorithm and variables of many types.
fn small(algorithm: &str, guard: &str) -> String {
    let variables = [
        ("flag", "BOOL", ""),
        ("n", "INT", "InitialValue='0'"),
        ("d", "DINT", "InitialValue='-5'"),
        ("r", "REAL", "InitialValue='2'"),
        ("s", "SINT", ""),
        ("u", "USINT", "InitialValue='16#0F'"),
        ("b", "BYTE", "InitialValue='3' Comment='bits'"),
        ("t", "TIME", "InitialValue='T#2s'"),
        ("l", "LREAL", "InitialValue='0.5'"),
        ("x", "STRING", "InitialValue=\"'ab'\""),
        ("e", "STRING", "InitialValue=\"''\""),
        ("a", "INT", "ArraySize='3' InitialValue='[1, 2, 3]'"),
        ("c", "REAL", "ArraySize='2'"),
    ];
    let variables: String = variables
        .iter()
        .map(|(name, of, more)| format!("<VarDeclaration Name='{name}' Type='{of}' {more}/>"))
        .collect();
    let escaped = |text: &str| {
        let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;");
        text.replace('\n', "&#10;")
    };
    format!(
        "<FBType Name='Small' Comment='a &quot;small&quot; one'>
        <InterfaceList><EventInputs><Event Name='REQ'/></EventInputs></InterfaceList>
        <BasicFB><InternalVars>{variables}</InternalVars><ECC><ECState Name='S'/>
        <ECState Name='T'><ECAction Algorithm='L'/></ECState>
        <ECTransition Source='S' Destination='T' Condition='REQ[{}]'/>
        <ECTransition Source='T' Destination='S' Condition='1'/></ECC>
        <Algorithm Name='L'><ST Text=\"{}\"/></Algorithm></BasicFB></FBType>",
        escaped(guard),
        escaped(algorithm),
    )
}

/// The lines between two that are not among them.
fn algorithm(text: &str) -> &str {
    let (_, behind) = text.split_once("case 1 % L\n").expect("the algorithm");
    behind.split_once("end\nend\n%8").expect("its end").0
}

#[test]
fn the_text_has_ten_sections_and_is_read_as_the_same_block() {
    for text in [HYSTERESIS, RAMP] {
        let matlab = written(text);
        for number in 1..=10 {
            assert!(matlab.contains(&format!("\n%{number}-")), "{matlab}");
        }
        assert_eq!(read(&matlab), block(text).0);
        assert_eq!(written(&xml::write(&read(&matlab))), matlab);
    }
    let tank = written(HYSTERESIS);
    assert!(
        tank.starts_with(
            "function [e_Bomba, v_Potencia] = fcn (e_Control, v_Nivel, v_Nivel_actual)"
        ),
        "{tank}"
    );
    assert!(tank.contains("while ~isequal(CE, E)"), "{tank}");
    assert!(tank.contains("if E(2) && ~CE(2)\n    e_Bomba = true;"), "{tank}");
}

#[test]
fn random_blocks_are_the_same_in_both_directions() {
    let seeds = seeds::seeds(300);
    let (count, mut converted) = (seeds.len(), 0);
    for seed in seeds {
        let text = xml::write(&Generator::block(seed, false));
        let file = source("random.fbt", &text);
        // A chart without rest is no block.
        let Some(block) = xml::read(&file).block else { continue };
        let written = matlab::write(&block, &file);
        let matlab = written.text.unwrap_or_else(|| panic!("{seed}: {:?}", written.diagnostics));
        assert_eq!(read(&matlab), block, "seed {seed}\n{matlab}");
        let back = read(&matlab);
        let again = matlab::write(&back, &source("random.m", &xml::write(&back)));
        assert_eq!(again.text.as_deref(), Some(matlab.as_str()), "seed {seed}");
        converted += 1;
    }
    println!("{count} random blocks, {converted} converted both ways");
    assert!(converted * 10 > count * 7, "{converted} of {count}");
}

#[test]
fn types_and_initial_values_are_kept() {
    let text = small("n := 1;", "TRUE");
    let matlab = written(&text);
    assert_eq!(read(&matlab), xml_canonical(&text));
    for line in [
        "flag = logical(0); end\n",
        "n = 0; end % INT := \"0\" \"\"\n",
        "d = int32(-5); end\n",
        "r = 2.0; end % REAL := \"2\" \"\"\n",
        "s = int8(0); end\n",
        "u = uint8(15); end % USINT := \"16#0F\" \"\"\n",
        "b = uint8(3); end % BYTE := \"3\" \"bits\"\n",
        "t = int32(2000); end % TIME := \"T#2s\" \"\"\n",
        "l = double(0.5); end\n",
        "x = 'ab'; end\n",
        "e = '_'; end % STRING := \"''\" \"\"\n",
        "a = [1, 2, 3]; end\n",
        "c = [0.0, 0.0]; end\n",
    ] {
        assert!(matlab.contains(line), "{line}{matlab}");
    }
}

/// A block whose condition is as MATLAB gives it back.
fn xml_canonical(text: &str) -> Block {
    block(&text.replace("REQ[TRUE]", "REQ")).0
}

#[test]
fn a_value_that_is_changed_in_matlab_is_more_than_what_the_comment_says() {
    let matlab = written(&small("n := 1;", "TRUE")).replace("b = uint8(3);", "b = uint8(4);");
    let block = read(&matlab);
    let b = block.internals.iter().find(|one| one.name.text == "b").expect("b");
    assert_eq!(b.of_type, DataType::Usint);
    assert_eq!(b.initial.as_ref().map(|one| one.text.as_str()), Some("4"));
}

#[test]
fn statements_and_operators_have_their_form_in_both() {
    let cases = [
        ("n := n / 2;", "n = fix(n / 2);"),
        ("d := d / n;", "d = int32(fix(double(d) / n));"),
        ("n := n MOD 3 + 1;", "n = rem(n, 3) + 1;"),
        ("d := 70000;", "d = int32(70000);"),
        ("d := n;", "d = int32(n);"),
        ("r := DINT_TO_REAL(d) / 2.0;", "r = DINT_TO_REAL(d) / 2.0;"),
        ("r := r ** 2 - -n;", "r = r ^ 2 - -n;"),
        ("flag := NOT flag AND n <> 3 OR r >= 1.5;", "flag = ~ flag && n ~= 3 || r >= 1.5;"),
        ("flag := (flag XOR n = 1) AND TRUE;", "flag = (xor(flag, n == 1)) && true;"),
        ("r := LN(r) + LOG(r) + ASIN(r) + ABS(r);", "r = log(r) + log10(r) + asin(r) + abs(r);"),
        ("b := b AND 7 OR NOT b;", "b = bitor(bitand(b, 7), bitcmp( b));"),
        ("a[n] := a[0] + a[n + 1];", "a(n + 1) = a(0 + 1) + a(n + 1 + 1);"),
        ("s := s + 1; d := d + s;", "s = s + 1; d = d + int32(s);"),
        ("n := LIMIT(0, n, 5);", "n = LIMIT(0, n, 5);"),
        ("d := DINT#5;", "d = cast(5, 'int32');"),
        (
            "IF flag THEN n := 1; ELSIF n = 2 THEN n := 3; ELSE n := 4; END_IF;",
            "if flag, n = 1; elseif n == 2, n = 3; else, n = 4; end;",
        ),
        (
            "CASE n OF 0: n := 1; 1, 3..5: n := 2; ELSE n := 3; END_CASE;",
            "switch n, case 0, n = 1; case {1, 3,4,5}, n = 2; otherwise, n = 3; end;",
        ),
        (
            "FOR n := 4 TO 0 BY -2 DO\n  r := r + 1.0;\nEND_FOR;",
            "for n = 4:-2: 0\n  r = r + 1.0;\nend, if isempty(n), n = 4; end;",
        ),
        (
            "WHILE n < 3 DO\n  n := n + 1;\n  IF flag THEN EXIT; END_IF;\nEND_WHILE;",
            "while n < 3\n  n = n + 1;\n  if flag, break; end;\nend;",
        ),
        (
            "REPEAT\n  n := n + 1;\nUNTIL n > 2 END_REPEAT;",
            "while true\n  n = n + 1;\nif n > 2, break; end, end;",
        ),
        (
            "// all\nn := 1; // one\n(* two\n lines *)\nn := n (* in it *) + 1;",
            "% all\nn = 1; % one\n%(* two\n% lines *)\nn = n ...(* in it *)\n + 1;",
        ),
        ("n := 1 +\n  2;", "n = 1 + ...\n  2;"),
    ];
    for (of_st, of_matlab) in cases {
        let text = small(of_st, "flag");
        let matlab = written(&text);
        assert_eq!(algorithm(&matlab).trim_end(), of_matlab, "{of_st}");
        let back = read(&matlab);
        let essence = |text: &str| st::format::essence(text);
        let read = &back.algorithms[0].text.text;
        assert_eq!(essence(read), essence(of_st), "{of_matlab}\n{read}");
        assert_eq!(back.transitions[0].condition.text, "REQ[flag]");
    }
}

#[test]
fn what_people_write_in_matlab_means_the_same_in_st() {
    let cases = [
        ("n=-n^2;", "n:=-(n**2);"),
        ("r = n / 2.0", "r := n / 2.0;"),
        ("flag = r == 1 < 2;", "flag := (r = 1) < 2;"),
        ("n = rem(n + 1, 2);", "n := (n + 1) MOD 2;"),
        ("flag = xor(flag, true) && flag;", "flag := (flag XOR TRUE) AND flag;"),
        ("a(2) = 7; a(n) = 1;", "a[1] := 7; a[(n) - 1] := 1;"),
        ("d = int32(r); n = n; % here", "d := REAL_TO_DINT(r); n := n; // here"),
        ("r = fix(r / 2);", "r := TRUNC(r / 2);"),
        ("d = idivide(d, n, 'fix');", "d := d / n;"),
        ("if flag & n > 1, n = 1; end", "IF flag AND n > 1 THEN n := 1; END_IF;"),
        ("flag = flag | flag && n == 1 | flag;", "flag := (flag OR flag) AND (n = 1 OR flag);"),
        (
            "switch n, case {9223372036854775807,1,2}, n = 1; end",
            "CASE n OF 9223372036854775807, 1..2: n := 1; END_CASE;",
        ),
        ("d = int32(n) * int32(n);", "d := INT_TO_DINT(n) * n;"),
        ("d = int32(n) + -int32(s) * 200;", "d := n + SINT_TO_DINT(-s) * 200;"),
        ("d = d - int32(n) * d + int32(n) / int32(s);", "d := d - n * d + n / s;"),
        ("d = 200 - (int32(n));", "d := 200 - INT_TO_DINT((n));"),
        ("r = double(d) * double(d) + r;", "r := DINT_TO_REAL(d) * d + r;"),
        ("n = double(n) * double(n);", "n := n * n;"),
    ];
    let matlab = written(&small("n := 1;", "flag"));
    for (of_matlab, of_st) in cases {
        let text = matlab.replace("case 1 % L\nn = 1;\n", &format!("case 1 % L\n{of_matlab}\n"));
        assert_eq!(read(&text).algorithms[0].text.text.trim_end(), of_st);
    }
}

#[test]
fn endless_loops_in_each_other_are_read_once() {
    let depth = 40;
    let loops = format!("{}break\n{}", "while true\n".repeat(depth), "end\n".repeat(depth));
    let matlab = written(&small("n := 1;", "flag")).replace("\nn = 1;\n", &format!("\n{loops}"));
    let text = &read(&matlab).algorithms[0].text.text;
    assert_eq!(text.matches("WHILE TRUE DO\n").count(), depth, "{text}");
    assert_eq!(text.matches("END_WHILE;").count(), depth, "{text}");
}

#[test]
fn a_quotient_that_matlab_does_not_cut_is_told() {
    let matlab = written(&small("n := 1;", "flag"));
    for (statement, is_told) in [
        ("n = n / 2;", true),
        ("d = d / n;", true),
        ("r = double(d) / n;", true),
        ("r = n / 2.0;", false),
        ("n = fix(n / 2);", false),
        ("r = DINT_TO_REAL(d) / n;", false),
        ("while true\nn = n / 2;\nend", true),
        ("while true\nif n / 2 > 1, n = 0; end\nend", true),
        ("while true\nn = 0;\nif n / 2 > 1, break; end\nend", true),
    ] {
        let text = matlab.replace("case 1 % L\nn = 1;\n", &format!("case 1 % L\n{statement}\n"));
        let expected = [("W0402", "/".to_owned())];
        assert_eq!(found(&text), &expected[usize::from(!is_told)..], "{statement}");
    }
}

/// The errors and warnings, with the text at their places.
fn found(text: &str) -> Vec<(&'static str, String)> {
    let source = source("block.m", text);
    let place = |span: Span| span.text(&source.text).to_owned();
    let all = matlab::read(&source).diagnostics.into_iter();
    all.map(|one| (one.code.text(), place(one.span))).collect()
}

#[test]
fn bad_text_is_told_at_its_place() {
    let matlab = written(RAMP);
    let cases = [
        ("T = T + Cycle;", "T = T + Cyle;", "E0408", "Cyle"),
        ("T = T + Cycle;", "T = (T + Cycle;", "E0408", ";"),
        ("T = T + Cycle;", "T = T + sum(Cycle);", "E0408", "sum"),
        ("T = T + Cycle;", "T += Cycle;", "E0408", "+"),
        ("T = T + Cycle;", "disp(T);", "E0408", "disp"),
        ("%3-DECLARACION DEL ESTADO INICIAL\n", "", "E0408", "\n"),
        ("T = int32(0);", "T = int31(0);", "E0408", "int31(0)"),
        ("persistent T\n", "global T\n", "E0408", "global T"),
        ("    X0 = v_X0;", "    X0 = v_X1;", "E0408", "X0 = v_X1;"),
        ("CE(1) && e_REQ", "CE(1) && REQ", "E0408", "REQ"),
        (
            "E(1) = false; E(3) = true;",
            "E(1) = false; E(5) = true;",
            "E0408",
            "E(1) = false; E(5) = true;",
        ),
        (
            "E(1) = false; E(3) = true;",
            "E(2) = false; E(3) = true;",
            "E0408",
            "E(2) = false; E(3) = true;",
        ),
        ("E_ALG = [2];", "E_ALG = [1];", "E0408", "E_ALG = [1];"),
        ("    e_CNF = true;\n", "    e_INITO = true;\n", "E0408", "e_INITO = true;"),
        ("    e_v_Hold = Hold;\n", "", "E0408", "end"),
        ("RampAlg/CNF", "RampAlg/CNFF", "E0403", "if E(3) && ~CE(3) % RampAlg/CNFF"),
    ];
    for (old, new, code, place) in cases {
        let wrong = matlab.replacen(old, new, 1);
        assert_ne!(wrong, matlab, "{old}");
        let errors = found(&wrong);
        assert_eq!(errors.first(), Some(&(code, place.to_owned())), "{new}: {errors:?}");
    }
    assert_eq!(found(""), [("E0408", String::new())]);
}

#[test]
fn what_has_no_form_in_matlab_is_told_at_its_place_in_the_block() {
    let cases = [
        ("t := T#1s;", Code::NoMatlab, "T#1s"),
        ("n := MUX(n, 1, 2);", Code::NoMatlab, "MUX"),
        ("n := zz;", Code::NoMatlab, "zz"),
        ("FOR n := 0 TO 3 DO n := 2; END_FOR;", Code::MatlabDiffers, "n"),
    ];
    for (algorithm, code, place) in cases {
        let text = small(algorithm, "flag");
        let (block, source) = block(&text);
        let all = matlab::write(&block, &source).diagnostics;
        let found: Vec<(Code, &str)> =
            all.iter().map(|one| (one.code, one.span.text(&text))).collect();
        assert_eq!(found, [(code, place)], "{algorithm}");
    }
}

#[test]
fn texts_that_are_cut_off_or_changed_never_stop_the_reader() {
    let matlab = written(RAMP);
    let mut random = fastrand::Rng::with_seed(1);
    for round in 0..5_000 {
        let mut bytes = matlab.as_bytes().to_vec();
        for _ in 0..random.usize(1..4) {
            let at = random.usize(..bytes.len());
            match random.u8(..8) {
                0 => bytes.truncate(at.max(1)),
                1..=3 => bytes[at] = random.u8(..),
                4 | 5 => drop(bytes.remove(at)),
                _ => bytes.insert(at, *random.choice(b"()%'&|~=;,\n").unwrap_or(&b'(')),
            }
        }
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let read = matlab::read(&source("block.m", &text));
        let is_bad = read.diagnostics.iter().any(|one| one.severity() == Severity::Error);
        assert_eq!(read.block.is_none(), is_bad, "round {round}: {text}");
    }
}
