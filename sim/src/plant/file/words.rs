//! The words of a plant file: how each statement is written, and what it means. They are read
//! elsewhere.

/// A statement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Statement {
    /// The word it begins with.
    pub word: &'static str,
    /// How it is written: names in capitals are to be replaced, what is in brackets may be missing.
    pub form: &'static str,
    /// What it means, in a sentence or two.
    pub doc: &'static str,
}

const fn row(word: &'static str, form: &'static str, doc: &'static str) -> Statement {
    Statement { word, form, doc }
}

/// What a line begins with (docs/simulator.md has the same table).
pub const STATEMENTS: [Statement; 20] = [
    row("plant", "plant \"TITLE\"", "What the plant is called."),
    row(
        "outputs",
        "outputs inverted",
        "A low output pin switches on, as behind a relay board with inverted inputs.",
    ),
    row(
        "part",
        "part NAME A..B [start N]",
        "A position, a level, a temperature: a number that moves between limits.",
    ),
    row(
        "belt",
        "belt NAME A..B [pieces N] [long N] [gap N]",
        "A belt or a road: pieces (at most 20, each 50 long, without a gap, unless said otherwise) \
         come at A and leave at B; none goes through another.",
    ),
    row("button", "button NAME \"WORDS\"", "1 as long as somebody presses it."),
    row("switch", "switch NAME \"WORDS\" [on]", "0 or 1, as somebody has set it."),
    row("slider", "slider NAME \"WORDS\" A..B [start N]", "A number that somebody sets."),
    row(
        "fault",
        "fault NAME \"WORDS\" [stuck I0.1 | stuck Ain0 | slow Q0.1 [TIME]]",
        "Something broken, to be switched: a sensor keeps its signal, an actuator follows its \
         output late (2 s), or what conditions make of it.",
    ),
    row(
        "count",
        "count NAME \"WORDS\" if CONDITION",
        "Counts how often the condition becomes true, and tells it.",
    ),
    row(
        "move",
        "move NAME +N/s [if CONDITION]",
        "A part goes up or down, the pieces of a belt go on, so much in a second; `+SPEED/s`: as \
         much as another part or a slider says.",
    ),
    row(
        "approach",
        "approach NAME N in TIME [if CONDITION]",
        "A part comes closer to a value, two thirds of the way in this time (the time constant).",
    ),
    row(
        "follow",
        "follow PART Q0.1 in TIME [if CONDITION]",
        "A part comes closer to where an output is between off (lowest value) and on (highest), as \
         far as that is on in its time, two thirds of the way in this time.",
    ),
    row(
        "feed",
        "feed BELT every TIME [if CONDITION]",
        "Pieces come on a belt; `feed BELT when CONDITION`: one each time it becomes true.",
    ),
    row("hold", "hold BELT N [if CONDITION]", "No piece goes over this place of a belt."),
    row(
        "take",
        "take BELT A..B [if CONDITION]",
        "Pieces whose front is in this range are taken off the belt.",
    ),
    row("input", "input I0.0 if CONDITION", "When a digital input of the PLC is on."),
    row(
        "encoder",
        "encoder I0.0 I0.1 PART",
        "Two digital inputs see the tracks of an encoder: an edge for each unit of a part.",
    ),
    row(
        "analog",
        "analog Ain0 NAME [A..B]",
        "An analog input follows a part or a slider: counts at its limits, 0..1023.",
    ),
    row(
        "draw",
        "draw SHAPE X Y ... [COLOUR] [move PART DX DY] [if CONDITION]",
        "Draws something on a sheet of 640 by 400.",
    ),
    row("piece", "piece BELT N", "A piece lies on a belt at time 0, with its front at this place."),
];

/// The shapes that `draw` knows, with what follows the place.
pub const SHAPES: [(&str, &str); 8] = [
    ("box", "draw box X Y WIDTH HEIGHT"),
    ("circle", "draw circle X Y RADIUS"),
    ("line", "draw line X Y X2 Y2"),
    ("lamp", "draw lamp X Y RADIUS [COLOUR] if CONDITION"),
    ("text", "draw text X Y \"WORDS\""),
    ("value", "draw value X Y NAME \"WORDS\""),
    ("level", "draw level X Y WIDTH HEIGHT PART"),
    ("pieces", "draw pieces X Y X2 Y2 BELT WIDTH HEIGHT"),
];

/// How a statement is written.
pub fn form(word: &str) -> &'static str {
    STATEMENTS.iter().find(|row| row.word == word).map_or("", |row| row.form)
}
