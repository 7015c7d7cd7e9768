//! The function and the function blocks of a random program.

use super::Generator;

impl Generator {
    pub(super) fn function(&mut self) -> String {
        self.in_function = true;
        let mut text = String::from(
            "FUNCTION Compute : INT\nVAR_INPUT a, b : INT; p : BOOL; END_VAR\nVAR c : INT; \
             END_VAR\n",
        );
        for _ in 0..self.rng.usize(1..4) {
            let value = self.whole("INT");
            let target = self.pick(&["c", "Compute"]);
            text += &match self.rng.bool() {
                true => format!("{target} := {value};\n"),
                false => format!("IF {} THEN {target} := {value}; END_IF;\n", self.condition()),
            };
        }
        self.in_function = false;
        text + "Compute := Compute + c;\nEND_FUNCTION\n"
    }

    /// A function block with a timer, an array and structures.
    pub(super) fn block(&mut self) -> String {
        self.in_block = true;
        let mut text = String::from(
            "FUNCTION_BLOCK Block\nVAR_INPUT p : BOOL; a : INT; row : Row; \
             name : STRING[5] := 'you'; END_VAR\n\
             VAR_OUTPUT q : BOOL; b : INT; twin : Pair; label : STRING[7]; END_VAR\n\
             VAR_IN_OUT c : INT; both : Pair; log : STRING[9]; END_VAR\nVAR d : DINT; delay : TON; \
             END_VAR\n",
        );
        for _ in 0..self.rng.usize(1..5) {
            text += &match self.rng.u8(..9) {
                7 | 8 if self.has_texts => self.text_assignment(),
                0 => format!("both.x := {};\n", self.whole("INT")),
                1 => self.pick(&["twin := both;\n", "twin.z := a;\n"]).to_owned(),
                2 => format!("delay(IN := {}, PT := T#40ms); q := delay.Q;\n", self.condition()),
                _ => self.block_statement(),
            };
        }
        text += &self.block_end();
        self.in_block = false;
        text
    }

    /// A function block with elementary variables alone, which can be a subroutine.
    pub(super) fn plain(&mut self) -> String {
        (self.in_block, self.is_plain) = (true, true);
        let mut text = String::from(
            "FUNCTION_BLOCK Plain\nVAR_INPUT p : BOOL; a : INT; END_VAR\nVAR_OUTPUT q : BOOL; \
             b : INT; END_VAR\nVAR_IN_OUT c : INT; END_VAR\nVAR d : DINT; END_VAR\n",
        );
        for _ in 0..self.rng.usize(1..5) {
            text += &self.block_statement();
        }
        text += &self.block_end();
        (self.in_block, self.is_plain) = (false, false);
        text
    }

    /// A statement of either block.
    fn block_statement(&mut self) -> String {
        match self.rng.u8(..5) {
            0 => format!("b := {};\n", self.whole("INT")),
            1 => format!("q := {};\n", self.condition()),
            2 => format!("IF {} THEN c := {}; END_IF;\n", self.condition(), self.whole("INT")),
            3 => format!("d := {};\n", self.whole("DINT")),
            _ => format!("b := b + {};\n", self.whole("INT")),
        }
    }

    /// The end of a block, which some leave before it.
    fn block_end(&mut self) -> String {
        let mut text = String::new();
        if self.rng.u8(..4) == 0 {
            text += &format!("IF {} THEN RETURN; END_IF;\nb := b + 1;\n", self.condition());
        }
        text + "END_FUNCTION_BLOCK\n"
    }
}
