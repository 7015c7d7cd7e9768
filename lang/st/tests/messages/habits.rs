//! What people write who know other languages, and what they are told: C, Python, Pascal, SCL.

use super::Answer;

/// What is declared beside the declarations of each.
pub const DECLARED: &str = "a, b, c : BOOL; i, j : INT; t : TIME; r : REAL; d : TON; w : WORD;\n";

/// Declarations of a program, its statements, and the answers.
pub const HABITS: &[(&str, &str, &[Answer])] = &[
    ("", "IF a THEN i := 1; ENDIF;", &[Answer("E0200", "ENDIF", &["END_IF"])]),
    ("", "IF a THEN\n    i := 1;\nENDIF\ni := 2;", &[Answer("E0200", "ENDIF", &["END_IF"])]),
    ("", "IF a THEN i := 1; END IF;\ni := 3;", &[Answer("E0200", "END IF", &["END_IF"])]),
    (
        "",
        "IF a THEN i := 1; ELSE IF b THEN i := 2; END_IF;\ni := 5;",
        &[Answer("E0201", "IF", &["ELSIF goes on with the IF before"])],
    ),
    (
        "",
        "IF a THEN\n    i := 1;\nELSE IF b THEN\n    i := 2;\nEND_IF;\ni := 5;",
        &[Answer("E0201", "IF", &["ELSIF goes on with the IF before"])],
    ),
    (
        "",
        "IF a THEN i := 1; ELSEIF b THEN i := 2; END_IF;",
        &[Answer("E0200", "ELSEIF", &["ELSIF"])],
    ),
    ("", "IF a THEN i := 1; ELIF b THEN i := 2; END_IF;", &[Answer("E0200", "ELIF", &["ELSIF"])]),
    ("", "WHILE i < 5 DO i := i + 1; ENDWHILE;", &[Answer("E0200", "ENDWHILE", &["END_WHILE"])]),
    ("", "FOR i := 1 TO 5 DO j := j + 1; ENDFOR;", &[Answer("E0200", "ENDFOR", &["END_FOR"])]),
    ("", "FOR i := 1 TO 5 DO j := j + 1; NEXT;", &[Answer("E0200", "NEXT", &["END_FOR"])]),
    (
        "",
        "FOR i := 1 TO 5 DO j := j + 1; NEXT i;",
        &[
            Answer("E0200", "NEXT", &["END_FOR"]),
            Answer("E0200", "i", &["`i := ...;` gives it a value, `i();` calls an instance"]),
        ],
    ),
    ("", "CASE i OF 1: j := 1; ENDCASE;", &[Answer("E0200", "ENDCASE", &["END_CASE"])]),
    (
        "",
        "REPEAT i := i + 1; UNTIL i > 5; ENDREPEAT;",
        &[Answer("E0200", "ENDREPEAT", &["END_REPEAT"])],
    ),
    (
        "",
        "REPEAT i := i + 1; UNTIL i > 5;\nj := 1;",
        &[Answer("E0201", ";", &["`END_REPEAT` is missing"])],
    ),
    ("", "i := LIMIT(LOW := 1, IN := j, MX := 5);", &[Answer("E0209", "LOW", &["MN, IN, MX"])]),
    ("", "i := LIMIT(MN := 1, MX := 5);", &[Answer("E0209", "LIMIT(MN := 1, MX := 5)", &["IN"])]),
    ("", "i := MAX(IN1 := 1, IN1 := j);", &[Answer("E0209", "IN1", &["twice"])]),
    ("", "i := ADD(IN1 := j, IN2 := 3, IN4 := 4);", &[Answer("E0209", "IN4", &["IN1, IN2"])]),
    ("", "i := SUB(j, 3, IN3 := 4);", &[Answer("E0209", "SUB", &["2 arguments needed"])]),
    ("", "i := REAL_TO_INT(X := r);", &[Answer("E0209", "X", &["it has IN"])]),
    ("AT %I0.0 : BOOL;", "a := b;", &[Answer("E0200", "AT %I0.0", &["Name AT %I0.0"])]),
    (
        "x AT %I0.1, y AT %I0.2 : BOOL;",
        "x := y;",
        &[Answer("E0200", ",", &["a declaration of its own", "`x AT"])],
    ),
    ("x : BOOL R_EDGE;", "a := x;", &[Answer("E0210", "R_EDGE", &["R_TRIG"])]),
    ("", "d(IN := a, PT := 2s);", &[Answer("E0200", "2s", &["T#2s"])]),
    ("", "t := 5s;", &[Answer("E0200", "5s", &["T#5s"])]),
    ("", "t := 200ms;", &[Answer("E0200", "200ms", &["T#200ms"])]),
    ("", "d(IN := a, PT := 2000);", &[Answer("E0205", "2000", &["T#2000ms"])]),
    ("", "d(IN := a, PT := S5T#2s);", &[Answer("E0200", "S5T#2s", &["T#2s"])]),
    ("", "IF a == b THEN i := 1; END_IF;", &[Answer("E0200", "==", &["="])]),
    ("", "IF i != 5 THEN i := 1; END_IF;", &[Answer("E0200", "!=", &["<>"])]),
    ("", "IF a && b THEN i := 1; END_IF;", &[Answer("E0200", "&&", &["&"])]),
    ("", "IF a || b THEN i := 1; END_IF;", &[Answer("E0200", "||", &["OR"])]),
    ("", "IF !a THEN i := 1; END_IF;", &[Answer("E0200", "!", &["NOT"])]),
    ("", "a := ~b;", &[Answer("E0200", "~", &["NOT"])]),
    ("", "i++;", &[Answer("E0200", "i", &["`i := i + 1;` counts"])]),
    ("", "i += 5;", &[Answer("E0200", "+=", &["`x := x + 1;` adds"])]),
    ("", "i -= 1;", &[Answer("E0200", "-=", &["`x := x - 1;` subtracts"])]),
    ("", "i := i % 5;", &[Answer("E0200", "%", &["MOD"])]),
    ("", "i := i << 2;", &[Answer("E0200", "<<", &["`SHL(x, n)` shifts to the left"])]),
    ("", "w := w | 16#FF;", &[Answer("E0200", "|", &["OR"])]),
    (
        "",
        "r := r ^ 2;",
        &[Answer("E0200", "^", &["a power is `**`, exclusive or is XOR; there are no pointers"])],
    ),
    (
        "",
        "a := b ? c : a;",
        &[Answer("E0200", "?", &["`SEL(condition, if_false, if_true)` chooses"])],
    ),
    (
        "",
        "IF (a) { i := 1; }",
        &[Answer("E0201", ")", &["`{...}` is a pragma, which says nothing: words begin and end"])],
    ),
    (
        "",
        "IF a { i := 1; } ELSE { i := 2; }\nj := 2;",
        &[Answer("E0201", "a", &["`{...}` is a pragma, which says nothing: words begin and end"])],
    ),
    ("", "IF a := b THEN i := 1; END_IF;", &[Answer("E0202", ":=", &["="])]),
    ("", "IF a THEN i = 1; END_IF;", &[Answer("E0202", "=", &[":="])]),
    ("", "IF a i := 1; END_IF;", &[Answer("E0201", "a", &["`THEN` is missing"])]),
    ("", "IF a\n    i := 1;\nEND_IF;", &[Answer("E0201", "a", &["`THEN` is missing"])]),
    (
        "",
        "IF a THEN BEGIN i := 1; END; END_IF;",
        &[
            Answer(
                "E0200",
                "BEGIN",
                &["statements need no BEGIN; their END says of what: END_IF, END_PROGRAM"],
            ),
            Answer(
                "E0200",
                "END",
                &["statements need no BEGIN; their END says of what: END_IF, END_PROGRAM"],
            ),
        ],
    ),
    (
        "",
        "BEGIN\ni := 1;\nEND",
        &[
            Answer(
                "E0200",
                "BEGIN",
                &["statements need no BEGIN; their END says of what: END_IF, END_PROGRAM"],
            ),
            Answer(
                "E0200",
                "END",
                &["statements need no BEGIN; their END says of what: END_IF, END_PROGRAM"],
            ),
        ],
    ),
    ("bool x;", "i := 1;", &[Answer("E0200", "bool x", &["x : BOOL"])]),
    ("int x := 5;", "i := 1;", &[Answer("E0200", "int x", &["x : INT"])]),
    ("x INT;", "i := 1;", &[Answer("E0200", "x INT", &["x : INT"])]),
    ("x := INT;", "i := 1;", &[Answer("E0200", ":=", &[":"])]),
    ("x : INT = 5;", "i := x;", &[Answer("E0202", "=", &[":="])]),
    ("%I0.0 : BOOL;", "i := 1;", &[Answer("E0200", "%I0.0", &["Name AT %I0.0"])]),
    ("x : BOOL AT %I0.0;", "a := x;", &[Answer("E0200", "AT %I0.0", &["`x AT %I0.0 : ...;`"])]),
    ("", "a := I0.0;", &[Answer("E0200", "I0.0", &["%I0.0"])]),
    ("", "a := ON;", &[Answer("E0203", "ON", &["the values of a BOOL are TRUE and FALSE"])]),
    ("", "i := 0xFF;", &[Answer("E0200", "0xFF", &["16#FF"])]),
    (
        "",
        "i := 16#fg;",
        &[Answer("E0200", "16#fg", &["16#fg has digits that its base does not have"])],
    ),
    ("", "i := 0b101;", &[Answer("E0200", "0b101", &["2#101"])]),
    ("", "w := $FF;", &[Answer("E0200", "$", &["a hexadecimal number is `16#FF`"])]),
    (
        "",
        "w := #FF;",
        &[Answer("E0200", "#", &["a name has no sign before it, a comment begins with `//`"])],
    ),
    (
        "",
        "#i := 5;",
        &[Answer("E0200", "#", &["a name has no sign before it, a comment begins with `//`"])],
    ),
    ("", "i := 5.;", &[Answer("E0200", "5.", &["5.0"])]),
    ("", "r := .5;", &[Answer("E0200", ".5", &["0.5"])]),
    ("", "r := 1,5;", &[Answer("E0200", ",", &["a number is written with a point: 1.5"])]),
    ("", "SET a;", &[Answer("E0200", "a", &["`Lamp := TRUE;` sets"])]),
    ("", "a.S := TRUE;", &[Answer("E0203", "S", &["S: a BOOL has no members"])]),
    ("", "i := INT(r);", &[Answer("E0203", "INT", &["INT is a type: `TO_INT(x)` converts"])]),
    (
        "",
        "i := (INT)r;",
        &[
            Answer("E0203", "INT", &["INT is a type: `TO_INT(x)` converts"]),
            Answer("E0200", "r", &["`r`: an operator or `;` is expected here"]),
        ],
    ),
    ("", "w.0 := TRUE;", &[Answer("E0210", "0", &["`(w AND 16#1) <> 0` is it"])]),
    ("", "a := w.3;", &[Answer("E0210", "3", &["`(w AND 16#8) <> 0` is it"])]),
    ("", "a := w.%X3;", &[Answer("E0210", "%X3", &["`(w AND 16#8) <> 0` is it"])]),
    (
        "arr : ARRAY[5] OF INT;",
        "i := arr[3];",
        &[Answer("E0200", "5", &["of five elements such as `ARRAY[0..4] OF INT`"])],
    ),
    (
        "arr : ARRAY(1..5) OF INT;",
        "i := arr[3];",
        &[Answer("E0200", "(", &["`(`: `[` is expected here"])],
    ),
    ("arr : INT[5];", "i := 3;", &[Answer("E0210", "INT", &["`ARRAY[0..9] OF INT`"])]),
    (
        "arr : ARRAY[0..5] OF INT;",
        "i := arr[0][1];\nj := arr(2);",
        &[
            Answer("E0205", "arr", &["arr: an INT has no elements"]),
            Answer("E0203", "arr", &["it is a variable: `arr[1]` is an element"]),
        ],
    ),
    (
        "",
        "CALL d(IN := a);",
        &[Answer(
            "E0200",
            "d",
            &["an instance is called by its name: `Delay(IN := Start, PT := T#2s);`"],
        )],
    ),
    (
        "",
        "d;",
        &[Answer("E0200", "d", &["`d := ...;` gives it a value, `d();` calls an instance"])],
    ),
    ("", "d(a, T#1s);\na := d;", &[Answer("E0205", "d", &["its outputs are, such as d.Q"])]),
    (
        "",
        "while (a) { i := 1; }",
        &[Answer("E0201", ")", &["`{...}` is a pragma, which says nothing: words begin and end"])],
    ),
    (
        "",
        "for (i = 0; i < 5; i++) { j := j + 1; }",
        &[Answer(
            "E0200",
            "(",
            &["`(`: a variable to count with, `FOR i := 1 TO 5 DO`, is expected here"],
        )],
    ),
    ("", "FOR i = 1 TO 5 DO j := 1; END_FOR;", &[Answer("E0202", "=", &[":="])]),
    ("", "FOR i := 1 TO 5 STEP 2 DO j := 1; END_FOR;", &[Answer("E0200", "STEP", &["BY"])]),
    (
        "",
        "FOR i := 5 DOWNTO 1 DO j := 1; END_FOR;",
        &[Answer("E0200", "DOWNTO", &["`FOR i := 5 TO 1 BY -1 DO` counts down"])],
    ),
    (
        "",
        "break;",
        &[
            Answer("E0200", "break", &["EXIT"]),
            Answer("E0214", "break", &["EXIT: there is no loop around"]),
        ],
    ),
    (
        "",
        "RETURN i;",
        &[Answer("E0200", "i", &["a function gives what its name has: `Area := x; RETURN;`"])],
    ),
    (
        "",
        "GOTO lab;",
        &[Answer("E0210", "GOTO", &["IF, CASE, loops, EXIT, CONTINUE and RETURN say the same"])],
    ),
    ("", "i := 5 DIV 2;", &[Answer("E0200", "DIV", &["/"])]),
    ("", "a := b AND_THEN c;", &[Answer("E0200", "AND_THEN", &["AND"])]),
    ("", "a := a AND NOT (b OR c;", &[Answer("E0201", "c", &["`)` is missing"])]),
    ("", "a := (a AND b));", &[Answer("E0200", ")", &["`)`: nothing is open that it closes"])]),
    ("", "IF a THEN; i := 1 END_IF", &[Answer("E0201", "1", &["`;` is missing"])]),
    ("", "i := 5", &[Answer("E0201", "5", &["`;` is missing"])]),
    ("", "i : 5;", &[Answer("E0200", "i", &["`i:`: a label stands in CASE, `:=` assigns"])]),
    ("", "i =: 5;", &[Answer("E0200", "=:", &[":="])]),
    ("", "i <- 5;", &[Answer("E0200", "<", &["`<`: `:=` is expected here"])]),
    ("", "IF i => 5 THEN j := 1; END_IF;", &[Answer("E0200", "=>", &[">="])]),
    ("", "IF i =< 5 THEN j := 1; END_IF;", &[Answer("E0200", "=<", &["<="])]),
    (
        "",
        "IF 1 < i < 5 THEN j := 1; END_IF;",
        &[Answer("E0205", "1 < i < 5", &["`a < b AND b < c` compares three"])],
    ),
    (
        "",
        "IF i = 1 OR 2 THEN j := 1; END_IF;",
        &[Answer("E0205", "i = 1 OR 2", &["each side is a condition: `x = 1 OR x = 2`"])],
    ),
    ("", "IF i THEN j := 1; END_IF;", &[Answer("E0205", "i", &["`... <> 0` asks for it"])]),
    (
        "",
        "# comment\ni := 1;",
        &[Answer("E0200", "#", &["a name has no sign before it, a comment begins with `//`"])],
    ),
    (
        "",
        "CASE i OF 1: j := 1; DEFAULT: j := 2; END_CASE;",
        &[Answer("E0203", "DEFAULT", &["ELSE is for all other values"])],
    ),
    (
        "",
        "CASE i OF 1: j := 1; OTHERWISE j := 2; END_CASE;",
        &[Answer("E0200", "OTHERWISE", &["ELSE"])],
    ),
    (
        "",
        "CASE i OF 1..3, 5: j := 1; ELSE: j := 2; END_CASE;",
        &[Answer("E0200", ":", &["ELSE has no `:` after it"])],
    ),
    ("x : BOOL := true\ny : BOOL;", "i := 1;", &[Answer("E0201", "e", &["`;` is missing"])]),
    ("var x : INT;", "i := 1;", &[Answer("E0201", ";", &["`END_VAR` is missing"])]),
    (
        "x : LREAL;",
        "i := 1;",
        &[Answer("E0210", "LREAL", &["it has 32 bits at most: DINT, UDINT, REAL, DWORD, TIME"])],
    ),
    (
        "x : DATE_AND_TIME;",
        "i := 1;",
        &[Answer(
            "E0210",
            "DATE_AND_TIME",
            &["it has 32 bits at most: DINT, UDINT, REAL, DWORD, TIME"],
        )],
    ),
    ("x : S5TIME;", "i := 1;", &[Answer("E0203", "S5TIME", &["TIME"])]),
    (
        "x : POINTER TO INT;",
        "i := 1;",
        &[Answer("E0210", "POINTER", &["a VAR_IN_OUT passes a variable"])],
    ),
    (
        "x : REF_TO INT;",
        "i := 1;",
        &[Answer("E0210", "REF_TO", &["a VAR_IN_OUT passes a variable"])],
    ),
    ("x : BIT;", "i := 1;", &[Answer("E0203", "BIT", &["BOOL"])]),
    ("x : float;", "i := 1;", &[Answer("E0203", "float", &["REAL"])]),
    ("x : BOOLEAN;", "i := 1;", &[Answer("E0203", "BOOLEAN", &["BOOL"])]),
    ("x : INTEGER;", "i := 1;", &[Answer("E0203", "INTEGER", &["INT"])]),
    ("x : Timer;", "i := 1;", &[Answer("E0203", "Timer", &["TON"])]),
    ("x : T_ON;", "i := 1;", &[Answer("E0203", "T_ON", &["TON"])]),
    (
        "x : TON_TIME;",
        "i := 1;",
        &[Answer("E0203", "TON_TIME", &["TON_TIME: there is no type of this name"])],
    ),
    (
        "",
        "THIS^.x := 5;",
        &[Answer("E0200", "^", &["a power is `**`, exclusive or is XOR; there are no pointers"])],
    ),
    (
        "",
        "p^ := 5;",
        &[Answer("E0200", "^", &["a power is `**`, exclusive or is XOR; there are no pointers"])],
    ),
    (
        "",
        "i := ADR(j);",
        &[Answer("E0203", "ADR", &["there are no pointers: a VAR_IN_OUT passes a variable"])],
    ),
];

/// Whole texts and their answers.
pub const TEXTS: &[(&str, &[Answer])] = &[
    (
        "TYPE Ton : INT; asin : REAL; END_TYPE\nPROGRAM Main VAR x : Ton; END_VAR\nEND_PROGRAM",
        &[
            Answer("E0204", "Ton", &["a standard block", "Ton1"]),
            Answer("E0204", "asin", &["a standard block or function"]),
        ],
    ),
    (
        "PROGRAM Main;\nVAR i : INT; END_VAR;\nBEGIN\ni := 1;\nEND_PROGRAM;",
        &[Answer(
            "E0200",
            "BEGIN",
            &["statements need no BEGIN; their END says of what: END_IF, END_PROGRAM"],
        )],
    ),
    (
        "PROGRAM Main\nVAR i : INT; ENDVAR\ni := 1;\nEND_PROGRAM",
        &[Answer("E0200", "ENDVAR", &["END_VAR"])],
    ),
    (
        "PROGRAM Main\nVAR i : INT; END VAR\ni := 1;\nEND_PROGRAM",
        &[Answer("E0200", "END VAR", &["END_VAR"])],
    ),
    (
        "PROGRAM Main\nVAR i : INT; END_VAR\ni := 1;\nENDPROGRAM",
        &[Answer("E0200", "ENDPROGRAM", &["END_PROGRAM"])],
    ),
    (
        "PROGRAM Main\nVAR i : INT; END_VAR\ni := 1;\nEND PROGRAM",
        &[Answer("E0200", "END PROGRAM", &["END_PROGRAM"])],
    ),
    (
        "PROGRAM Main\nVAR i : INT; \nBEGIN\ni := 1;\nEND_PROGRAM",
        &[
            Answer("E0201", ";", &["`END_VAR` is missing"]),
            Answer(
                "E0200",
                "BEGIN",
                &["statements need no BEGIN; their END says of what: END_IF, END_PROGRAM"],
            ),
        ],
    ),
    (
        "PROGRAM Main()\nVAR i : INT; END_VAR\ni := 1;\nEND_PROGRAM",
        &[Answer("E0200", "()", &["parameters are declared: `VAR_INPUT x : INT; END_VAR`"])],
    ),
    (
        "FUNCTION f(x : INT) : INT\nf := x;\nEND_FUNCTION\nPROGRAM Main\nEND_PROGRAM",
        &[
            Answer(
                "E0200",
                "(x : INT)",
                &["parameters are declared: `VAR_INPUT x : INT; END_VAR`"],
            ),
            Answer("E0203", "x", &["declare it: `VAR x : INT; END_VAR`"]),
        ],
    ),
    (
        "FUNCTION f : INT\nVAR_INPUT x : INT; END_VAR\nRETURN x;\nEND_FUNCTION\nPROGRAM Main\nEND_PROGRAM",
        &[Answer("E0200", "x", &["a function gives what its name has: `Area := x; RETURN;`"])],
    ),
    (
        "FUNCTION f : VOID\nVAR_INPUT x : INT; END_VAR\nx := 1;\nEND_FUNCTION\nPROGRAM Main\nEND_PROGRAM",
        &[
            Answer("E0203", "VOID", &["a FUNCTION has a result, a FUNCTION_BLOCK can do without"]),
            Answer("E0208", "x", &["x: an input is given by the caller, not written"]),
        ],
    ),
    (
        "FUNCTION_BLOCK f\nVAR INPUT x : INT; END_VAR\nEND_FUNCTION_BLOCK\nPROGRAM Main\nEND_PROGRAM",
        &[Answer("E0200", "VAR INPUT", &["VAR_INPUT"])],
    ),
    (
        "FUNCTION_BLOCK f\nVAR_INOUT x : INT; END_VAR\nEND_FUNCTION_BLOCK\nPROGRAM Main\nEND_PROGRAM",
        &[Answer("E0200", "VAR_INOUT", &["VAR_IN_OUT"])],
    ),
    (
        "STRUCT Recipe\n   x : INT;\nEND_STRUCT\nPROGRAM Main\nEND_PROGRAM",
        &[Answer(
            "E0200",
            "STRUCT",
            &["a structure is `TYPE Recipe : STRUCT ... END_STRUCT; END_TYPE`"],
        )],
    ),
    (
        "ORGANIZATION_BLOCK OB1\nBEGIN\nEND_ORGANIZATION_BLOCK\nPROGRAM x\nEND_PROGRAM",
        &[
            Answer(
                "E0200",
                "ORGANIZATION_BLOCK",
                &["it is a PROGRAM here; an OB1 in AWL is a file of its own"],
            ),
            Answer(
                "E0200",
                "BEGIN",
                &["statements need no BEGIN; their END says of what: END_IF, END_PROGRAM"],
            ),
        ],
    ),
    (
        "PROGRAM Main\nVAR PERSISTENT i : INT; END_VAR\ni := 1;\nEND_PROGRAM",
        &[Answer("E0200", "PERSISTENT", &["RETAIN"])],
    ),
    (
        "PROGRAM Main\nVAR_GLOBAL i : INT; END_VAR\ni := 1;\nEND_PROGRAM",
        &[Answer("E0200", "VAR_GLOBAL", &["belongs before it", "declared in VAR"])],
    ),
    (
        "PROGRAM Main\nx := 1;\nEND_PROGRAM\nCONFIGURATION c\nVAR_GLOBAL x : INT; END_VAR\n\
         RESOURCE r ON PLC\nTASK t(INTERVAL := T#20ms, PRIORITY := 1);\n\
         PROGRAM p WITH t : Main;\nEND_RESOURCE\nEND_CONFIGURATION",
        &[Answer("E0210", "CONFIGURATION", &["once a scan", "`//# scan 20ms`"])],
    ),
    (
        "PROGRAM Main\nVAR i : INT; END_VAR\nINITIAL_STEP Wait:\nEND_STEP\n\
         TRANSITION FROM Wait TO Go := i > 1;\nEND_TRANSITION\nSTEP Go: A(N); END_STEP\n\
         END_PROGRAM",
        &[Answer("E0210", "INITIAL_STEP", &["whose name ends with `.sfc`"])],
    ),
];
