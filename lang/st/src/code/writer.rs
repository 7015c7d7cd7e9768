//! Lines of a unit in AWL: networks, places in the source, labels, temporaries. It knows the
//! layout, not what is computed.

use diagnostics::{Source, Span};

use crate::model::Element;

/// How a value is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Storage {
    /// A bit.
    Bit,
    /// A BOOL that is a byte: 0 or 1.
    ByteBit,
    /// 8 bits.
    Byte,
    /// 16 bits.
    Word,
    /// 32 bits.
    Double,
    /// 32 bits that are a REAL.
    Real,
}

impl Storage {
    /// Bytes of an element of an array.
    pub(super) fn bytes(self) -> i64 {
        match self {
            Storage::Bit | Storage::ByteBit | Storage::Byte => 1,
            Storage::Word => 2,
            Storage::Double | Storage::Real => 4,
        }
    }

    /// The letter of the instruction that moves it: MOVB, MOVW, MOVD, MOVR.
    pub(super) fn letter(self) -> char {
        match self {
            Storage::Bit | Storage::ByteBit | Storage::Byte => 'B',
            Storage::Word => 'W',
            Storage::Double => 'D',
            Storage::Real => 'R',
        }
    }

    fn temporary(self) -> (&'static str, &'static str) {
        match self {
            Storage::Bit => ("b__", "BOOL"),
            Storage::ByteBit | Storage::Byte => ("y__", "BYTE"),
            Storage::Word => ("w__", "INT"),
            Storage::Double => ("d__", "DINT"),
            Storage::Real => ("r__", "REAL"),
        }
    }
}

const STORAGES: [Storage; 5] =
    [Storage::Bit, Storage::Byte, Storage::Word, Storage::Double, Storage::Real];

/// Temporaries in use.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct InUse([u16; 5]);

/// The text of a unit that is being written.
#[derive(Debug, Default)]
pub(super) struct Writer {
    lines: Vec<String>,
    networks: u32,
    labels: u16,
    in_use: InUse,
    most: InUse,
    /// The head of the statement that the next instruction begins.
    head: Option<Head>,
    /// Where the last line comes from; empty: from no text.
    place: String,
    /// Where the next one comes from.
    next_place: String,
    /// Whether the top of the stack is known to be 1.
    has_power: bool,
    /// The bit that the top of the stack is equal to.
    top: Option<String>,
    /// FOR that have no NEXT yet.
    pub(super) open_loops: usize,
    /// Inside the body of a condition: instructions hang on its power flow.
    pub(super) is_guarded: bool,
    /// Lines after which nothing was put out that could be jumped over.
    pub(super) boxes: usize,
}

#[derive(Debug, Clone)]
struct Head {
    title: String,
    place: String,
}

impl Writer {
    /// What is written from now on belongs to a statement.
    pub(super) fn statement(&mut self, source: &Source, span: Span) {
        let text = span.text(&source.text).split_whitespace().collect::<Vec<_>>().join(" ");
        let title = match text.char_indices().nth(76) {
            Some((at, _)) => format!("{}...", text.get(..at).unwrap_or("")),
            None => text,
        };
        self.head = Some(Head { title, place: place_in(source, span) });
    }

    /// What is written from now on belongs to an element of a drawing.
    pub(super) fn element(&mut self, file: &str, element: &Element) {
        self.section(&element.title);
        if let Some(head) = &mut self.head {
            head.place = format!("{file}#{}", element.name);
        }
    }

    /// What is written from now on comes from no text.
    pub(super) fn section(&mut self, title: &str) {
        self.head = Some(Head { title: title.to_owned(), place: String::new() });
        self.has_power = false;
        self.top = None;
    }

    /// Where the lines come from that are written now.
    pub(super) fn place(&self) -> String {
        self.head.as_ref().map_or(&self.next_place, |head| &head.place).clone()
    }

    /// What is written from now on comes from a place, in the network that there is.
    pub(super) fn go_on_at(&mut self, place: &str) {
        self.head = None;
        place.clone_into(&mut self.next_place);
    }

    fn network(&mut self, head: &Head) {
        self.networks += 1;
        if !self.lines.is_empty() {
            self.lines.push(String::new());
        }
        self.lines.push(format!("NETWORK {} // {}", self.networks, head.title));
        self.mark(&head.place);
        self.has_power = false;
        self.top = None;
    }

    fn mark(&mut self, place: &str) {
        self.lines.push(format!("//# source {place}").trim_end().to_owned());
        place.clone_into(&mut self.place);
        place.clone_into(&mut self.next_place);
    }

    /// A statement in the network of the one before.
    fn go_on(&mut self, head: &Head) {
        self.mark(&head.place);
        if !head.title.is_empty() {
            self.lines.push(format!("// {}", head.title));
        }
    }

    fn line(&mut self, mnemonic: &str, operands: &str) {
        if self.next_place != self.place {
            self.mark(&self.next_place.clone());
        }
        self.lines.push(text_of(mnemonic, operands));
    }

    /// The first instruction of a rung. What loads the bit that is on top already is left out; a
    /// statement that begins so, right after the coil, goes on in the network.
    fn rung(&mut self, mnemonic: &str, operands: &str) {
        let is_coil = self.lines.last().is_some_and(|last| *last == text_of("=", operands));
        if let Some(head) = self.head.take() {
            match is_coil && ["LD", "LDN"].contains(&mnemonic) {
                true => self.go_on(&head),
                false => self.network(&head),
            }
        }
        let is_there = self.top.as_deref() == Some(operands);
        match mnemonic {
            "LD" if is_there => {}
            "LDN" if is_there => {
                self.line("NOT", "");
                self.top = None;
            }
            _ => {
                self.line(mnemonic, operands);
                self.top = (mnemonic == "LD").then(|| operands.to_owned());
            }
        }
        self.has_power = mnemonic == "LD" && operands == "SM0.0";
    }

    /// An instruction of the logic stack; `is_first`: it begins a rung.
    pub(super) fn logic(&mut self, mnemonic: &str, operands: &str, is_first: bool) {
        if is_first && !self.is_guarded {
            self.rung(mnemonic, operands);
            return;
        }
        self.line(mnemonic, operands);
        self.has_power = false;
        self.top = None;
    }

    /// `= bit`: the top of the stack stays.
    pub(super) fn coil(&mut self, bit: &str) {
        self.line("=", bit);
        if !self.has_power {
            self.top = Some(bit.to_owned());
        }
    }

    /// A box, which is executed if there is power flow.
    pub(super) fn boxed(&mut self, mnemonic: &str, operands: &str) {
        self.power();
        self.line(mnemonic, operands);
        self.boxes += 1;
        if self.top.as_deref().is_some_and(|top| operands.contains(top) && !self.has_power) {
            self.top = None;
        }
    }

    /// A box that hangs on the condition before it.
    pub(super) fn boxed_here(&mut self, mnemonic: &str, operands: &str) {
        self.line(mnemonic, operands);
        self.boxes += 1;
        self.has_power = false;
    }

    /// Makes the top of the stack 1, unless instructions hang on the power flow of a condition.
    pub(super) fn power(&mut self) {
        if self.is_guarded {
            return;
        }
        if !self.has_power {
            self.rung("LD", "SM0.0");
        } else if let Some(head) = self.head.take() {
            self.go_on(&head);
        }
    }

    /// What follows hangs on the top of the stack, or no longer does.
    pub(super) fn guard(&mut self, is_guarded: bool) -> bool {
        self.has_power = false;
        std::mem::replace(&mut self.is_guarded, is_guarded)
    }

    /// The top of the stack is not known any more.
    pub(super) fn forget(&mut self) {
        self.has_power = false;
        self.top = None;
    }

    /// A label that nothing has yet.
    pub(super) fn new_label(&mut self) -> u16 {
        self.labels += 1;
        self.labels - 1
    }

    /// The place of a label.
    pub(super) fn label(&mut self, label: u16) {
        self.line("LBL", &label.to_string());
        self.forget();
    }

    /// The end of a loop. The top of the stack is 1 after it.
    pub(super) fn next(&mut self) {
        self.line("NEXT", "");
        self.forget();
    }

    /// A jump for the power flow that there is.
    pub(super) fn jump(&mut self, label: u16) {
        self.line("JMP", &label.to_string());
        self.boxes += 1;
    }

    /// Goes to a label in any case.
    pub(super) fn always_jump(&mut self, label: u16) {
        self.power();
        self.jump(label);
        self.forget();
    }

    /// A temporary in local memory.
    pub(super) fn temporary(&mut self, storage: Storage) -> String {
        let wanted = storage.temporary();
        let at = STORAGES.iter().position(|one| one.temporary() == wanted).unwrap_or(0);
        let InUse(in_use) = &mut self.in_use;
        in_use[at] += 1;
        let InUse(most) = &mut self.most;
        most[at] = most[at].max(in_use[at]);
        format!("#{}{}", wanted.0, in_use[at])
    }

    /// The temporaries that are in use, to go back to.
    pub(super) fn in_use(&self) -> InUse {
        self.in_use
    }

    /// Gives back the temporaries that were taken since.
    pub(super) fn release(&mut self, in_use: InUse) {
        self.in_use = in_use;
    }

    /// The declarations of the temporaries.
    pub(super) fn temporaries(&self) -> Vec<String> {
        let InUse(most) = self.most;
        let named = STORAGES.iter().zip(most).flat_map(|(storage, count)| {
            let (prefix, kind) = storage.temporary();
            (1..=count).map(move |number| format!("{prefix}{number}:{kind};"))
        });
        named.collect()
    }

    /// Whether nothing was written.
    pub(super) fn is_empty(&self) -> bool {
        self.lines.is_empty()
    }

    /// All lines.
    pub(super) fn finish(self) -> Vec<String> {
        self.lines
    }
}

fn text_of(mnemonic: &str, operands: &str) -> String {
    format!("{mnemonic:<6} {operands}").trim_end().to_owned()
}

/// Where a statement begins, as `//# source` has it.
pub(super) fn place_in(source: &Source, span: Span) -> String {
    let (line, column) = source.position(span.start as usize);
    format!("{}:{line}:{column}", source.name)
}

/// A block with its sections and lines.
pub(super) fn block(
    place: Option<String>,
    header: &str,
    end: &str,
    sections: &[String],
    writer: Writer,
) -> Vec<String> {
    let mut lines = vec![String::new()];
    lines.extend(place.map(|place| format!("//# source {place}")));
    lines.push(header.to_owned());
    lines.extend(sections.iter().cloned());
    let temporaries = writer.temporaries();
    if !temporaries.is_empty() {
        lines.push("VAR".to_owned());
        lines.extend(temporaries);
        lines.push("END_VAR".to_owned());
    }
    lines.push("BEGIN".to_owned());
    lines.extend(writer.finish());
    lines.push("//# source".to_owned());
    lines.push(end.to_owned());
    lines
}
