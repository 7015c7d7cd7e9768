//! The forms of the instruction table as they stand in an image: to count them, and to exchange them.

use plc_isa::{Form, Header, INSTRUCTIONS, Instruction, Kind, Op, WIDE_PREFIX, decode};

use crate::image::signed;

/// An instruction in one of its forms.
#[derive(Clone, Copy)]
pub struct Row {
    /// The entry of the table.
    pub instruction: &'static Instruction,
    /// The form.
    pub form: &'static Form,
}

/// Where an instruction stands in an image.
#[derive(Clone, Copy)]
pub struct Place {
    /// What stands there.
    pub row: Row,
    /// Offset of its token, behind the prefix of a wide one.
    pub token_at: usize,
}

/// Every form of every instruction.
pub fn rows() -> Vec<Row> {
    let of = |instruction: &'static Instruction| instruction.forms.iter().map(move |form| Row { instruction, form });
    INSTRUCTIONS.iter().flat_map(of).collect()
}

impl Row {
    /// As a person would look for it: `Ldw (Relation, Word, IntConst)`.
    pub fn name(&self) -> String {
        let kinds: Vec<String> = self.form.kinds.iter().map(|kind| format!("{kind:?}")).collect();
        format!("{:?} ({})", self.instruction.op, kinds.join(", "))
    }

    /// Whether both are the same line of the table.
    pub fn is(&self, other: &Row) -> bool {
        self.first() == other.first()
    }

    /// Whether the bytes of one can be read as the other, and do the same to the depth of the stack.
    pub fn is_sibling(&self, other: &Row) -> bool {
        let span = |form: &Form| form.last_token - form.first_token;
        !self.is(other)
            && self.form.wide == other.form.wide
            && span(self.form) == span(other.form)
            && self.stored().eq(other.stored())
            && self.instruction.stack == other.instruction.stack
    }

    fn first(&self) -> (bool, u8) {
        (self.form.wide, self.form.first_token)
    }

    fn stored(&self) -> impl Iterator<Item = u8> {
        self.form.kinds.iter().map(|kind| kind.stored_len()).filter(|&len| len > 0)
    }

    fn holds(&self, wide: bool, token: u8) -> bool {
        self.form.wide == wide && (self.form.first_token..=self.form.last_token).contains(&token)
    }

    /// Whether the comparison is in the token.
    pub fn has_relation(&self) -> bool {
        self.form.kinds.contains(&Kind::Relation)
    }
}

/// The instructions of an image, the hidden ones too.
///
/// # Panics
/// If the image is not valid.
pub fn places(image: &[u8]) -> Vec<Place> {
    let header = Header::read(&image).expect("a valid header");
    let rows = rows();
    let (mut at, mut places) = (header.code_at(), Vec::new());
    loop {
        let decoded = decode(&image, at).expect("a valid instruction");
        let wide = image[usize::from(at)] == WIDE_PREFIX;
        let token_at = usize::from(at) + usize::from(wide);
        let row = rows.iter().find(|row| row.holds(wide, image[token_at])).expect("a token of the table");
        places.push(Place { row: *row, token_at });
        at += decoded.len;
        if decoded.op == Op::MainEnd {
            return places;
        }
    }
}

/// The image with other tokens; `exchange` gets the row and the token's distance from the row's first, and gives a
/// token to put there. `None` if nothing has changed.
pub fn with_tokens(image: &[u8], exchange: impl Fn(&Row, u8) -> Option<u8>) -> Option<Vec<u8>> {
    let mut changed = image.to_vec();
    for place in places(image) {
        let offset = image[place.token_at] - place.row.form.first_token;
        if let Some(token) = exchange(&place.row, offset) {
            changed[place.token_at] = token;
        }
    }
    if changed == image {
        return None;
    }
    Some(signed(changed))
}
