//! Operators as drawings have them: blocks, which are read and written.

/// Blocks that are operators, and the operator in Structured Text.
pub(crate) const OPERATORS: [(&str, &str); 14] = [
    ("AND", "AND"),
    ("OR", "OR"),
    ("XOR", "XOR"),
    ("EQ", "="),
    ("NE", "<>"),
    ("GT", ">"),
    ("GE", ">="),
    ("LT", "<"),
    ("LE", "<="),
    ("ADD", "+"),
    ("SUB", "-"),
    ("MUL", "*"),
    ("DIV", "/"),
    ("MOD", "MOD"),
];
