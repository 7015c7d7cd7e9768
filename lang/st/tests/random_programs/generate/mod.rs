//! Random programs that compile: every expression has the type that is asked for.

mod conversions;
mod texts;
mod units;

use fastrand::Rng;

/// Variables of the program by type; those that the test writes are the first of each.
pub const VARIABLES: [(&str, &[&str]); 10] = [
    ("INT", &["gi", "gj", "a", "b", "c"]),
    ("DINT", &["gd", "d", "e"]),
    ("BOOL", &["gp", "gq", "gr", "p", "q", "r"]),
    ("WORD", &["gw", "w", "x"]),
    ("REAL", &["gy", "y", "z"]),
    ("TIME", &["t", "u"]),
    ("SINT", &["gs", "s1", "s2"]),
    ("USINT", &["gu", "u1", "u2"]),
    ("UINT", &["gn", "n1", "n2"]),
    ("UDINT", &["gl", "l1", "l2"]),
];

/// Types of whole numbers with their lowest and highest, what the counters of loops are called, and
/// types whose values they take.
const WHOLE: [(&str, i64, i64, &str, &[&str]); 6] = [
    ("INT", -32768, 32767, "i", &["SINT", "USINT"]),
    ("DINT", -2147483648, 2147483647, "id", &["INT", "UINT", "SINT"]),
    ("SINT", -128, 127, "is", &[]),
    ("USINT", 0, 255, "iu", &[]),
    ("UINT", 0, 65535, "in", &["USINT"]),
    ("UDINT", 0, 4294967295, "il", &["UINT", "USINT"]),
];

/// Which of them it is.
fn whole_type(kind: &str) -> (i64, i64, &'static str, &'static [&'static str]) {
    let found = WHOLE.iter().find(|one| one.0 == kind).expect("a type of whole numbers");
    (found.1, found.2, found.3, found.4)
}

/// Types, with initial values.
const TYPES: &str = "TYPE
State : (Idle, Run, Done);
Part : INT(-5..20) := 3;
Row : ARRAY[0..3] OF Part := [1, 2(-4)];
Pair : STRUCT x : INT := 2; y : UINT; z : Part; END_STRUCT;
Twin : Pair := (y := 7);
Tag : STRUCT t : STRING[5] := 'tag'; n : INT; END_STRUCT;
END_TYPE
VAR_GLOBAL
";

const EDGES: [i64; 14] = [0, 1, -1, 2, 3, 5, 7, 10, 100, 255, 300, 32767, -32768, 181];

/// Every so manieth program is meant for a board: with few statements and variables, every other
/// one of them without texts.
pub const SMALL: u64 = 4;

pub struct Generator {
    rng: Rng,
    is_small: bool,
    has_texts: bool,
    depth: u32,
    in_function: bool,
    in_block: bool,
    /// Within the block that has elementary variables alone.
    is_plain: bool,
    loops: u32,
    whiles: u32,
}

impl Generator {
    pub fn program(seed: u64) -> String {
        let mut one = Generator {
            rng: Rng::with_seed(seed),
            is_small: seed.is_multiple_of(SMALL),
            has_texts: !seed.is_multiple_of(2 * SMALL),
            depth: if seed.is_multiple_of(SMALL) { 2 } else { 0 },
            in_function: false,
            in_block: false,
            is_plain: false,
            loops: 0,
            whiles: 0,
        };
        one.all()
    }

    fn all(&mut self) -> String {
        let mut text = String::from(TYPES);
        for (kind, names) in VARIABLES {
            let written: Vec<&str> =
                names.iter().copied().filter(|name| name.starts_with('g')).collect();
            if !written.is_empty() {
                text += &format!("{} : {kind};\n", written.join(", "));
            }
        }
        text += "gt : TIME := T#35ms;\nshared : STRING[6] := ' -12a';\nEND_VAR\n";
        text += &self.function();
        text += &self.block();
        text += &self.plain();
        text += "PROGRAM Main\nVAR\n";
        for (kind, names) in VARIABLES {
            let own: Vec<&str> =
                names.iter().copied().filter(|name| !name.starts_with('g')).collect();
            text += &format!("{} : {kind};\n", own.join(", "));
        }
        text += "k1, k2, k3, ix1, ix2, ix3 : INT;\n";
        for (kind, _, _, counter, _) in WHOLE {
            text += &format!("{counter}1, {counter}2, {counter}3 : {kind};\n");
        }
        text += "part, counter : Part; low : USINT(10..200); row : Row; row2 : Row := [5];\n";
        text += "pair : Pair := (x := 9); twin : Twin; twin2 : Twin := (z := -1);\n";
        text += "pairs : ARRAY[0..2] OF Twin := [(x := 1), 1((y := 4))];\n";
        text += "bytes : ARRAY[0..3] OF SINT;\nwords : ARRAY[0..2] OF UINT;\n";
        text += "longs : ARRAY[0..1] OF UDINT;\n";
        text += "list : ARRAY[1..5] OF INT;\nflags : ARRAY[0..3] OF BOOL;\n";
        text += "grid : ARRAY[0..2, -1..1] OF DINT;\n";
        text += "s : State;\nton1 : TON; tof1 : TOF; tp1 : TP; ton2 : TON; count1 : CTU;\n";
        text += "{coarse} slow1, fast1 : TON;\nslow2, fast2 : TOF {coarse};\n";
        text += "first AT %SM0.1 : BOOL; count2 : CTU;\n";
        text += "v4 : STRING[4]; v7 : STRING[7] := 'ab'; v9, w9 : STRING[9];\n";
        text += "tag, tag2 : Tag; tag3 : Tag := (t := '12');\n";
        text += match self.is_small {
            true => "v80, full : STRING[12] := '-7.5';\n",
            false => "v80 : STRING := '-7.5'; full : STRING[254];\n",
        };
        text += "plains : ARRAY[1..3] OF Plain; waits : ARRAY[0..1] OF TON;\n";
        text += "counts : ARRAY[1..2, 0..1] OF CTU; edges : ARRAY[-1..1] OF R_TRIG;\n";
        text += "blocks : ARRAY[2..3] OF Block;\n";
        text += "edge1 : R_TRIG;\none, two : Block; three, four : Plain;\nEND_VAR\n";
        text += &self.devices();
        let count = self.rng.usize(if self.is_small { 1..5 } else { 3..10 });
        text += &self.statements(count);
        text + "END_PROGRAM\n"
    }

    /// Calls of instances that are timers and counters of the controller.
    fn devices(&mut self) -> String {
        let mut text = String::new();
        for (name, preset) in [("slow1", 100), ("fast1", 30), ("slow2", 100), ("fast2", 20)] {
            text += &format!("{name}(IN := {}, PT := T#{preset}ms);\n", self.condition());
        }
        let (up, reset) = (self.condition(), self.condition());
        for name in ["three", "four", "three"] {
            let (p, a) = (self.condition(), self.whole("INT"));
            text += &format!("{name}(p := {p}, a := {a}, c := c, b => b);\n");
        }
        text + &format!("count2(CU := {up}, R := {reset} OR first, PV := 3);\n")
    }

    fn pick<'t>(&mut self, list: &[&'t str]) -> &'t str {
        list[self.rng.usize(..list.len())]
    }

    fn variable(&mut self, kind: &str) -> String {
        if self.in_function {
            return self.pick(&["a", "b", "c"]).to_owned();
        }
        if self.in_block {
            return match kind {
                "INT" if self.is_plain => self.pick(&["a", "b", "c", "gi"]),
                "INT" => self.pick(&["a", "b", "c", "gi", "both.x", "row[b]", "twin.z"]),
                _ => self.pick(&["d", "gd"]),
            }
            .to_owned();
        }
        let names = VARIABLES.iter().find(|(one, _)| *one == kind).map(|(_, names)| *names);
        match (kind, self.rng.u8(..6)) {
            ("INT", 0) if self.rng.bool() => match self.rng.u8(..5) {
                0 => "part".to_owned(),
                1 => format!("row[{}]", self.index(0, 3)),
                2 => self.pick(&["pair.x", "twin.z", "twin2.x"]).to_owned(),
                3 => format!("pairs[{}].z", self.index(0, 2)),
                _ => format!("pairs[{}].x", self.index(0, 2)),
            },
            ("UINT", 1) => self.pick(&["pair.y", "twin2.y", "pairs[1].y"]).to_owned(),
            ("USINT", 0) => "low".to_owned(),
            ("INT", 0) => format!("list[{}]", self.index(1, 5)),
            ("DINT", 0) => format!("grid[{}, {}]", self.index(0, 2), self.index(-1, 1)),
            ("SINT", 0) => format!("bytes[{}]", self.index(0, 3)),
            ("UINT", 0) => format!("words[{}]", self.index(0, 2)),
            ("UDINT", 0) => format!("longs[{}]", self.index(0, 1)),
            ("BOOL", 0) => format!("flags[{}]", self.index(0, 3)),
            _ => self.pick(names.unwrap_or(&["a"])).to_owned(),
        }
    }

    fn index(&mut self, low: i64, high: i64) -> String {
        match self.rng.u8(..3) {
            0 => self.rng.i64(low..=high).to_string(),
            _ => self.pick(&["gi", "a", "b", "i1", "gi + 1", "u1", "n1", "gl"]).to_owned(),
        }
    }

    fn statements(&mut self, count: usize) -> String {
        (0..count).map(|_| self.statement()).collect()
    }

    fn some(&mut self) -> String {
        let count = self.rng.usize(1..4);
        self.statements(count)
    }

    fn statement(&mut self) -> String {
        self.depth += 1;
        let choice = if self.depth > 3 { self.rng.u8(..8) } else { self.rng.u8(..20) };
        let text = match choice {
            7 | 19 if self.has_texts => self.text_assignment(),
            7 | 19 => self.assignment("INT"),
            0 | 1 => self.assignment("INT"),
            2 => self.assignment("DINT"),
            3 => self.assignment("BOOL"),
            4 => {
                let kind = self.pick(&["WORD", "REAL", "TIME"]);
                self.assignment(kind)
            }
            5 | 17 => {
                let kind = self.pick(&["SINT", "USINT", "UINT", "UDINT"]);
                self.assignment(kind)
            }
            6 | 16 => {
                let value = self.pick(&["TRUE", "FALSE"]);
                format!(
                    "IF {} THEN {} := {value}; END_IF;\n",
                    self.condition(),
                    self.target("BOOL")
                )
            }
            8 => self.if_statement(),
            9 => self.case(),
            10 | 11 => self.for_loop(),
            12 => self.while_loop(),
            13 => self.call(),
            18 => self.instances(),
            14 if self.rng.u8(..3) == 0 => {
                let whole =
                    ["pair := twin;", "twin2 := pairs[gi];", "row := row2;", "tag := tag2;"];
                self.pick(&whole).to_owned() + "\n"
            }
            14 => format!("s := {};\n", self.pick(&["Idle", "Run", "Done"])),
            _ => self.machine(),
        };
        self.depth -= 1;
        text
    }

    /// A variable that is written.
    fn target(&mut self, kind: &str) -> String {
        self.variable(kind)
    }

    fn assignment(&mut self, kind: &str) -> String {
        let target = self.target(kind);
        format!("{target} := {};\n", self.value(kind))
    }

    fn value(&mut self, kind: &str) -> String {
        match kind {
            "BOOL" => self.condition(),
            "WORD" => self.bits(),
            "REAL" => self.real(),
            "TIME" => self.time(),
            kind => self.whole(kind),
        }
    }

    fn if_statement(&mut self) -> String {
        let mut text = format!("IF {} THEN\n{}", self.condition(), self.some());
        for _ in 0..self.rng.usize(..3) {
            text += &format!("ELSIF {} THEN\n{}", self.condition(), self.some());
        }
        if self.rng.bool() {
            text += &format!("ELSE\n{}", self.some());
        }
        text + "END_IF;\n"
    }

    fn case(&mut self) -> String {
        let kind = self.pick(&["INT", "INT", "SINT", "USINT", "UINT", "UDINT"]);
        let selector = if self.rng.bool() { self.variable(kind) } else { self.whole(kind) };
        let mut text = format!("CASE {selector} OF\n");
        text += &format!("0: {}", self.some());
        text += &format!("1, 3..5: {}", self.some());
        let (low, high, ..) = whole_type(kind);
        let far = if low < 0 { (-10, -1) } else { (high / 2 - 20, high - 3) };
        text += &format!("{}..{}: {}", far.0, far.1, self.some());
        if self.rng.bool() {
            text += &format!("ELSE\n{}", self.some());
        }
        text + "END_CASE;\n"
    }

    fn machine(&mut self) -> String {
        let mut text = "CASE s OF\n".to_owned();
        for (state, next) in [("Idle", "Run"), ("Run", "Done"), ("Done", "Idle")] {
            let condition = self.condition();
            text += &format!("{state}: IF {condition} THEN s := {next}; END_IF;\n");
        }
        text + "END_CASE;\n"
    }

    fn leave(&mut self) -> String {
        match self.rng.u8(..4) {
            0 => format!("IF {} THEN EXIT; END_IF;\n", self.condition()),
            1 => format!("IF {} THEN CONTINUE; END_IF;\n", self.condition()),
            _ => String::new(),
        }
    }

    fn for_loop(&mut self) -> String {
        if self.loops == 3 {
            return self.assignment("INT");
        }
        self.loops += 1;
        let number = self.loops;
        let kind = self.pick(&["INT", "INT", "INT", "DINT", "SINT", "USINT", "UINT", "UDINT"]);
        let (low, high, counter, _) = whole_type(kind);
        let base = match self.rng.u8(..4) {
            0 => high - 8,
            1 => low + 3,
            _ => 3.max(low + 3),
        };
        let (from, to) = (base + self.rng.i64(-3..4), base + self.rng.i64(-3..8));
        let by = match self.rng.u8(..4) {
            0 => " BY -1".to_owned(),
            1 => format!(" BY {}", self.rng.i64(2..5)),
            _ => String::new(),
        };
        let to = match self.rng.u8(..3) {
            0 => match kind {
                "INT" => "MIN(gj, 6)".to_owned(),
                kind => format!("MIN({}, 6)", self.variable(kind)),
            },
            _ => to.to_string(),
        };
        let by = if to.starts_with('M') { by.replace("-1", "2") } else { by };
        let body = self.some() + &self.leave() + &self.some();
        self.loops -= 1;
        if kind == "INT" && number == 1 && base == 3 && self.rng.bool() {
            return format!("FOR counter := {from} TO {to}{by} DO\n{body}END_FOR;\n");
        }
        // From a high number on there would be no end of passes backwards.
        let from = if to.starts_with('M') { from.clamp(0.max(low), 6) } else { from };
        format!("FOR {counter}{number} := {from} TO {to}{by} DO\n{body}END_FOR;\n")
    }

    fn while_loop(&mut self) -> String {
        if self.whiles == 3 {
            return self.assignment("INT");
        }
        self.whiles += 1;
        let k = format!("k{}", self.whiles);
        let condition = self.condition();
        let body = format!("{k} := {k} + 1;\n") + &self.leave() + &self.some();
        self.whiles -= 1;
        match self.rng.bool() {
            true => format!("{k} := 0;\nWHILE {k} < 4 AND ({condition}) DO\n{body}END_WHILE;\n"),
            false => {
                format!("{k} := 0;\nREPEAT\n{body}UNTIL {k} >= 4 OR ({condition}) END_REPEAT;\n")
            }
        }
    }

    fn call(&mut self) -> String {
        let condition = self.condition();
        match self.rng.u8(..9) {
            0 => format!("ton1(IN := {condition}, PT := T#30ms);\n"),
            1 => format!("tof1(IN := {condition}, PT := T#1s20ms);\n"),
            2 => format!("tp1(IN := {condition}, PT := T#25ms);\n"),
            3 => format!("ton2(IN := {condition}, PT := gt, Q => q);\n"),
            4 => format!("count1(CU := {condition}, R := gq, PV := gi, CV => b);\n"),
            5 => format!("edge1(CLK := {condition}, Q => p);\n"),
            6 => {
                let (whole, text) = (self.whole("INT"), self.text());
                format!(
                    "one(p := {condition}, a := {whole}, row := row2, name := {text}, c := a, \
                     both := pair, log := v9, b => b, twin => pairs[gi], label => v7);\n"
                )
            }
            7 => format!("four(c := b, p := {condition}, q => r);\n"),
            _ => {
                let whole = self.whole("INT");
                format!("two({condition}, {whole}, c := list[2], both := twin2, log := w9);\n")
            }
        }
    }

    fn condition(&mut self) -> String {
        self.depth += 1;
        let choice = if self.depth > 5 { self.rng.u8(..3) } else { self.rng.u8(..12) };
        let text = match choice {
            0 | 1 if self.in_function || self.in_block => "p".to_owned(),
            0 | 1 => self.variable("BOOL"),
            2 if !self.in_function && !self.in_block => self
                .pick(&[
                    "ton1.Q",
                    "tof1.Q",
                    "tp1.Q",
                    "ton2.Q",
                    "count1.Q",
                    "(s = Run)",
                    "slow1.Q",
                    "fast1.Q",
                    "slow2.Q",
                    "fast2.Q",
                    "count2.Q",
                ])
                .to_owned(),
            2 => "p".to_owned(),
            3 | 4 => {
                let operator = self.pick(&["AND", "OR", "XOR", "=", "<>", "&"]);
                format!("({} {operator} {})", self.condition(), self.condition())
            }
            5 => format!("NOT ({})", self.condition()),
            6..=8 => {
                let relation = self.pick(&["<", ">", "<=", ">=", "=", "<>"]);
                let kind = match self.in_function {
                    true => "INT",
                    false if self.in_block => self.pick(&["INT", "DINT"]),
                    false => self.pick(&[
                        "INT", "INT", "DINT", "WORD", "REAL", "TIME", "SINT", "USINT", "UINT",
                        "UDINT",
                    ]),
                };
                format!("({} {relation} {})", self.variable(kind), self.value(kind))
            }
            9 if self.has_texts && !self.is_plain && self.rng.u8(..4) == 0 => {
                self.text_comparison()
            }
            9 => match self.in_function || self.in_block {
                true => format!("INT_TO_BOOL({})", self.whole("INT")),
                false => {
                    let kind = self.pick(&["INT", "SINT", "UINT", "UDINT"]);
                    format!("{kind}_TO_BOOL({})", self.whole(kind))
                }
            },
            10 => format!("SEL({}, {}, {})", self.condition(), self.condition(), self.condition()),
            _ => format!("({} AND {})", self.condition(), self.condition()),
        };
        self.depth -= 1;
        text
    }

    /// A whole number of a type.
    fn whole(&mut self, kind: &str) -> String {
        self.depth += 1;
        let choice = if self.depth > 4 { self.rng.u8(..4) } else { self.rng.u8(..14) };
        let is_plain = self.in_function || self.in_block;
        let text = match choice {
            0..=2 if kind == "DINT" && self.in_function => "INT_TO_DINT(a)".to_owned(),
            0..=2 => self.variable(kind),
            3 => {
                let (low, high, ..) = whole_type(kind);
                let edges = [low, high, high / 2, high / 2 + 1];
                let value = match self.rng.u8(..4) {
                    0 => edges[self.rng.usize(..4)],
                    _ => EDGES[self.rng.usize(..EDGES.len())].clamp(low, high),
                };
                format!("{kind}#{value}")
            }
            4..=8 => {
                let operator = self.pick(&["+", "-", "*", "/", "MOD"]);
                let taken = whole_type(kind).3;
                let left = match self.rng.u8(..4) {
                    0 if is_plain && kind == "DINT" => "INT",
                    0 if !is_plain && !taken.is_empty() => self.pick(taken),
                    _ => kind,
                };
                let right = match operator {
                    "/" | "MOD" if self.rng.u8(..4) > 0 => self.variable(kind),
                    _ => self.whole(kind),
                };
                format!("({} {operator} {right})", self.whole(left))
            }
            9 if self.has_texts && ["INT", "DINT"].contains(&kind) && self.rng.bool() => {
                self.number_of_text(kind)
            }
            9 if whole_type(kind).0 < 0 => format!("(-{})", self.variable(kind)),
            10 => format!("ABS({})", self.whole(kind)),
            11 => {
                let function = self.pick(&["MIN", "MAX"]);
                let (one, other) = (self.whole(kind), self.whole(kind));
                match self.rng.u8(..4) {
                    0 => format!("{function}(IN2 := {one}, IN1 := {other})"),
                    _ => format!("{function}({one}, {other})"),
                }
            }
            12 if !is_plain && self.rng.bool() => {
                let from = self.pick(&["SINT", "USINT", "INT", "UINT", "DINT", "UDINT", "REAL"]);
                format!("{from}_TO_{kind}({})", self.value(from))
            }
            13 if !is_plain && self.rng.u8(..3) == 0 => {
                let from = self.pick(&["WORD", "TIME", "BOOL"]);
                format!("{from}_TO_{kind}({})", self.value(from))
            }
            12 if ["INT", "DINT"].contains(&kind) && !is_plain => self.converted(kind),
            13 if kind == "INT" && !is_plain => {
                format!(
                    "Compute({}, {}, {})",
                    self.whole("INT"),
                    self.variable("INT"),
                    self.condition()
                )
            }
            _ => {
                let (which, no, yes) = (self.condition(), self.whole(kind), self.whole(kind));
                match self.rng.u8(..4) {
                    0 => format!("SEL(IN1 := {yes}, G := {which}, IN0 := {no})"),
                    _ => format!("SEL({which}, {no}, {yes})"),
                }
            }
        };
        self.depth -= 1;
        text
    }

    fn bits(&mut self) -> String {
        self.depth += 1;
        let choice = if self.depth > 4 { self.rng.u8(..3) } else { self.rng.u8(..8) };
        let text = match choice {
            0 | 1 => self.variable("WORD"),
            2 => format!("WORD#16#{:X}", self.rng.u16(..)),
            3 | 4 => {
                let operator = self.pick(&["AND", "OR", "XOR"]);
                format!("({} {operator} {})", self.bits(), self.bits())
            }
            5 => format!("(NOT {})", self.variable("WORD")),
            6 => {
                let function = self.pick(&["SHL", "SHR", "ROL", "ROR"]);
                let count = match self.rng.bool() {
                    true => self.rng.i64(-1..20).to_string(),
                    false => "gi".to_owned(),
                };
                format!("{function}({}, {count})", self.bits())
            }
            _ if self.in_function || self.in_block => {
                format!("INT_TO_WORD({})", self.whole("INT"))
            }
            _ => {
                let kind = self.pick(&["INT", "SINT", "USINT", "UINT", "UDINT"]);
                format!("{kind}_TO_WORD({})", self.whole(kind))
            }
        };
        self.depth -= 1;
        text
    }

    fn real(&mut self) -> String {
        self.depth += 1;
        let choice = if self.depth > 4 { self.rng.u8(..3) } else { self.rng.u8(..8) };
        let text = match choice {
            0 | 1 => self.variable("REAL"),
            7 if self.has_texts => format!("STRING_TO_REAL({})", self.text()),
            2 => format!("{:?}", f32::from(self.rng.i16(-300..300)) / 4.0),
            3..=5 => {
                let operator = self.pick(&["+", "-", "*", "/"]);
                format!("({} {operator} {})", self.real(), self.real())
            }
            _ => {
                let kind = self.pick(&["INT", "SINT", "USINT", "UINT", "UDINT"]);
                format!("{kind}_TO_REAL({})", self.whole(kind))
            }
        };
        self.depth -= 1;
        text
    }

    fn time(&mut self) -> String {
        self.depth += 1;
        let choice = if self.depth > 4 { self.rng.u8(..3) } else { self.rng.u8(..8) };
        let text = match choice {
            0 | 1 => self.variable("TIME"),
            2 => format!("T#{}ms", self.rng.u32(..100)),
            3 => self.pick(&["ton1.ET", "tof1.ET", "ton2.ET"]).to_owned(),
            4 => format!("({} + {})", self.time(), self.time()),
            5 => format!("({} - {})", self.time(), self.time()),
            6 => {
                let kind = self.pick(&["INT", "SINT", "UINT"]);
                format!("({} * {})", self.time(), self.whole(kind))
            }
            _ => {
                let kind = self.pick(&["DINT", "INT", "SINT", "UDINT"]);
                format!("{kind}_TO_TIME({})", self.whole(kind))
            }
        };
        self.depth -= 1;
        text
    }
}
