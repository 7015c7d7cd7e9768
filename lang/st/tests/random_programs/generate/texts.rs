//! Texts of a random program, and calls of instances in arrays.

use super::Generator;

/// What texts are made of: numbers and what they end at, names of variables and special characters.
const PIECES: [&str; 16] =
    ["a", "b", "ab", "1", "9", "-", "+", " ", ".", ",", "0", "$N", "$'", "$E4", "gi", "v4"];

impl Generator {
    fn text_variable(&mut self) -> String {
        if self.in_function || self.is_plain {
            return "shared".to_owned();
        }
        if self.in_block {
            return self.pick(&["name", "label", "log", "shared"]).to_owned();
        }
        self.pick(&[
            "v4",
            "v4",
            "v7",
            "v9",
            "w9",
            "v80",
            "full",
            "shared",
            "tag.t",
            "tag2.t",
            "tag3.t",
            "one.name",
            "two.label",
            "blocks[2].label",
        ])
        .to_owned()
    }

    /// A literal that fits into each variable.
    fn text_literal(&mut self) -> String {
        let count = self.rng.usize(..5);
        let mut length = 0;
        let mut text = String::new();
        for _ in 0..count {
            let piece = self.pick(&PIECES);
            length += if piece.starts_with('$') { 2 } else { piece.len() };
            if length <= 4 {
                text += piece;
            }
        }
        format!("'{text}'")
    }

    /// A count or a position, mostly near what there is.
    fn place_in_text(&mut self) -> String {
        match self.rng.u8(..4) {
            0 | 1 => self.rng.i64(-1..11).to_string(),
            2 if self.in_function || self.in_block => "a".to_owned(),
            2 => self.pick(&["gi", "u1", "k1", "LEN(v9)", "FIND(v9, v4)"]).to_owned(),
            _ => self.whole("INT"),
        }
    }

    pub(super) fn text(&mut self) -> String {
        self.depth += 1;
        let choice = match self.depth {
            _ if !self.has_texts => 3,
            0..=3 => self.rng.u8(..14),
            _ => self.rng.u8(..4),
        };
        let text = match choice {
            0..=2 => self.text_variable(),
            3 => self.text_literal(),
            4 | 5 => {
                let function = self.pick(&["LEFT", "RIGHT"]);
                format!("{function}({}, {})", self.text(), self.place_in_text())
            }
            6 => {
                format!("MID({}, {}, {})", self.text(), self.place_in_text(), self.place_in_text())
            }
            7 | 8 => {
                let count = self.rng.usize(2..4);
                let parts: Vec<String> = (0..count).map(|_| self.text()).collect();
                format!("CONCAT({})", parts.join(", "))
            }
            9 => format!("INSERT({}, {}, {})", self.text(), self.text(), self.place_in_text()),
            10 => {
                let (l, p) = (self.place_in_text(), self.place_in_text());
                format!("DELETE({}, {l}, {p})", self.text())
            }
            11 => {
                let (l, p) = (self.place_in_text(), self.place_in_text());
                format!("REPLACE({}, {}, {l}, {p})", self.text(), self.text())
            }
            _ if self.in_function || self.in_block => {
                format!("INT_TO_STRING({})", self.whole("INT"))
            }
            _ => {
                let kind = self.pick(&["INT", "DINT", "SINT", "USINT", "UINT"]);
                format!("{kind}_TO_STRING({})", self.whole(kind))
            }
        };
        self.depth -= 1;
        text
    }

    pub(super) fn text_assignment(&mut self) -> String {
        let target = match (self.in_block, self.rng.u8(..5)) {
            (true, _) => self.pick(&["label", "log"]).to_owned(),
            (_, 0) => self.pick(&["shared", "one.name", "blocks[3].name"]).to_owned(),
            _ => self.pick(&["v4", "v7", "v9", "w9", "v80", "full", "tag.t", "tag2.t"]).to_owned(),
        };
        format!("{target} := {};\n", self.text())
    }

    pub(super) fn text_comparison(&mut self) -> String {
        let relation = self.pick(&["=", "<>"]);
        format!("({} {relation} {})", self.text(), self.text())
    }

    /// A number that a text has, or is.
    pub(super) fn number_of_text(&mut self, kind: &str) -> String {
        match (kind, self.rng.u8(..3)) {
            ("INT", 0) => format!("LEN({})", self.text()),
            ("INT", 1) => format!("FIND({}, {})", self.text(), self.text()),
            _ => format!("STRING_TO_{kind}({})", self.text()),
        }
    }

    /// A call of an instance in an array, or a loop over all of them.
    pub(super) fn instances(&mut self) -> String {
        let condition = self.condition();
        match self.rng.u8(..6) {
            0 => {
                let (at, whole) = (self.rng.u8(1..4), self.whole("INT"));
                format!("plains[{at}](p := {condition}, a := {whole}, c := c, b => b);\n")
            }
            1 => {
                let at = self.rng.u8(2..4);
                let (whole, text) = (self.whole("INT"), self.text());
                format!(
                    "blocks[{at}](p := {condition}, a := {whole}, name := {text}, c := b, \
                     both := twin, log := w9);\ntag.n := blocks[{at}].b;\n"
                )
            }
            2 => format!("plains[2].a := {};\nr := plains[3].q;\n", self.whole("INT")),
            _ if self.loops == 3 => "a := plains[1].b;\n".to_owned(),
            choice => self.loop_over_instances(choice, &condition),
        }
    }

    fn loop_over_instances(&mut self, choice: u8, condition: &str) -> String {
        self.loops += 1;
        let at = format!("ix{}", self.loops);
        let body = self.statement();
        let text = match choice {
            3 => format!(
                "FOR {at} := 1 TO 3 DO\nplains[{at}](p := {condition}, a := {at}, c := b);\n{body}\
                 IF plains[{at}].q THEN a := plains[{at}].b; END_IF;\nEND_FOR;\n"
            ),
            4 => format!(
                "FOR {at} := 1 TO 0 BY -1 DO\nwaits[{at}](IN := {condition}, PT := T#1ms * {at});\n\
                 {body}counts[{at} + 1, 1 - {at}](CU := waits[{at}].Q, PV := {at});\nEND_FOR;\n\
                 c := counts[1, 1].CV;\n"
            ),
            _ => format!(
                "FOR {at} := -1 TO 1 DO\nedges[{at}](CLK := {condition} AND gi > {at});\n{body}\
                 IF edges[{at}].Q THEN tag.n := tag.n + {at}; END_IF;\nEND_FOR;\n"
            ),
        };
        self.loops -= 1;
        text
    }
}
