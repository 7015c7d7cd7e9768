//! Whole numbers of values of other types.

use super::Generator;

impl Generator {
    /// An INT or DINT of something else.
    pub(super) fn converted(&mut self, kind: &str) -> String {
        match kind {
            "INT" => match self.rng.u8(..6) {
                4 => "TO_INT(s)".to_owned(),
                0 => format!("DINT_TO_INT({})", self.whole("DINT")),
                1 => format!("REAL_TO_INT({})", self.real()),
                2 => format!("WORD_TO_INT({})", self.bits()),
                3 => format!("BOOL_TO_INT({})", self.condition()),
                _ => self.pick(&["count1.CV", "count2.CV"]).to_owned(),
            },
            _ => match self.rng.u8(..4) {
                2 => "TO_DINT(s)".to_owned(),
                0 => format!("TIME_TO_DINT({})", self.time()),
                1 => format!("REAL_TO_DINT({})", self.real()),
                _ => format!("WORD_TO_DINT({})", self.bits()),
            },
        }
    }
}
