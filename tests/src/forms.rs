//! The forms of the instruction table as they stand in an image: to count them, and to exchange
//! them.

use plc_isa::{Form, Header, INSTRUCTIONS, Instruction, Kind, Relation, decode};

use crate::image::signed;

/// An instruction in one of its forms.
#[derive(Clone, Copy)]
pub struct Row {
    /// The entry of the table.
    pub instruction: &'static Instruction,
    /// The form.
    pub form: &'static Form,
}

/// Where an instruction is in an image.
#[derive(Clone, Copy)]
pub struct FormPlace {
    /// What is there.
    pub row: Row,
    /// Offset of its token, after the prefix if there is one.
    pub token_at: usize,
    /// Its comparison.
    pub relation: Option<Relation>,
}

/// Every form of every instruction.
pub fn rows() -> Vec<Row> {
    let of = |instruction: &'static Instruction| {
        instruction.forms.iter().map(move |form| Row { instruction, form })
    };
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

    /// Whether the bytes of one can be read as the other, and do the same to the depth of the
    /// stack.
    pub fn is_sibling(&self, other: &Row) -> bool {
        let span = |form: &Form| form.last_token - form.first_token;
        !self.is(other)
            && self.form.prefix == other.form.prefix
            && span(self.form) == span(other.form)
            && self.stored().eq(other.stored())
            && self.instruction.stack == other.instruction.stack
    }

    fn first(&self) -> (Option<u8>, u8) {
        (self.form.prefix, self.form.first_token)
    }

    fn stored(&self) -> impl Iterator<Item = u8> {
        self.form.kinds.iter().map(|kind| kind.stored_len()).filter(|&len| len > 0)
    }

    fn holds(&self, prefix: Option<u8>, token: u8) -> bool {
        self.form.prefix == prefix
            && (self.form.first_token..=self.form.last_token).contains(&token)
    }

    /// The comparisons that the form can be written with; `None` alone if it has none.
    pub fn relations(&self) -> Vec<Option<Relation>> {
        match self.instruction.relations() {
            [] => vec![None],
            known => known.iter().copied().map(Some).collect(),
        }
    }
}

/// The instructions of an image, the hidden ones too.
///
/// # Panics
/// If the image is not valid.
pub fn places(image: &[u8]) -> Vec<FormPlace> {
    let header = Header::read(&image).expect("a valid header");
    let rows = rows();
    let (mut at, mut places) = (header.code_at(), Vec::new());
    while at < header.code_end() {
        let decoded = decode(&image, at).expect("a valid instruction");
        let first = image[usize::from(at)];
        let prefix = rows.iter().find_map(|row| row.form.prefix.filter(|&prefix| prefix == first));
        let token_at = usize::from(at) + usize::from(prefix.is_some());
        let row = rows
            .iter()
            .find(|row| row.holds(prefix, image[token_at]))
            .expect("a token of the table");
        places.push(FormPlace { row: *row, token_at, relation: decoded.relation() });
        at += decoded.len;
    }
    places
}

/// The image with one row of the table in the place of another; `None` if it does not occur.
pub fn with_row(image: &[u8], from: &Row, to: &Row) -> Option<Vec<u8>> {
    changed(image, |place, bytes| {
        if place.row.is(from) {
            bytes[0] = bytes[0] - from.form.first_token + to.form.first_token;
        }
    })
}

/// The image with one comparison of a row in the place of another; `None` if it does not occur.
pub fn with_relation(image: &[u8], row: &Row, from: Relation, to: Relation) -> Option<Vec<u8>> {
    let has_own_byte = row.form.kinds.contains(&Kind::RelationByte);
    changed(image, |place, bytes| match place.relation {
        Some(relation) if place.row.is(row) && relation == from && has_own_byte => {
            bytes[1] = to as u8
        }
        Some(relation) if place.row.is(row) && relation == from => {
            bytes[0] = row.form.first_token + to as u8
        }
        _ => {}
    })
}

/// The image after `change` has seen each of its instructions with its bytes from the token on.
fn changed(image: &[u8], change: impl Fn(&FormPlace, &mut [u8])) -> Option<Vec<u8>> {
    let mut changed = image.to_vec();
    for place in places(image) {
        change(&place, &mut changed[place.token_at..]);
    }
    (changed != image).then(|| signed(changed))
}
