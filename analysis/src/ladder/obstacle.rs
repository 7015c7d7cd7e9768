//! What keeps a rung from being a ladder.

/// Why a rung is no ladder.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Obstacle {
    /// A line was not understood: the assembler's message.
    NotUnderstood(String),
    /// An operand is missing or wrong.
    Operand,
    /// The logic stack has no value of this rung that the line could take.
    NoValue,
    /// It joins the rail with a wire that has left it: one with an output or an LPS before.
    LeavesRail,
    /// NOT, EU or ED are meant for a part of the power flow alone, and what is before it would go
    /// into them too.
    Part,
    /// An AENO that does not stand after a box in the same wire.
    Eno,
    /// What an input of a box takes goes on to something else.
    InputGoesOn,
    /// What is after a FOR in its rung has other power flow in each pass.
    Loop,
    /// This use of the logic stack is neither series nor parallel.
    Stack,
    /// More levels than the logic stack has.
    TooDeep,
    /// Too many elements.
    TooLarge,
}
