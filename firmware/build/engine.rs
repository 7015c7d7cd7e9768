//! Puts the fast engine's assembly together: the jump table follows from the instruction table and
//! the names above the handlers. What the handlers do is in `src/engine`.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use plc_isa::{
    APPROACH_LEN, C_BITS_START, CORE_INSTRUCTIONS, COUNTER_SLOT_LEN, DATA_END, DATA_START, Form,
    INSTRUCTIONS, Instruction, JUMP_TABLE, Kind, NATIVE_VECTORS, ROUTINE_LEN, Relation, SLOT_START,
    SM_START, T_BITS_START, TIMER_SLOT_LEN, WINDOW_LEN, module_of_token,
};

/// A form as the handlers name it: `Ldw Relation Word Word`, `wide Ldw Relation AnyInt AnyInt`.
fn name(instruction: &Instruction, form: &Form) -> String {
    let mut name = if form.prefix.is_some() { "wide ".to_string() } else { String::new() };
    let _ = write!(name, "{:?}", instruction.op);
    for kind in form.kinds {
        let _ = write!(name, " {kind:?}");
    }
    name
}

/// Handlers with one text: the forms they are for, and the text.
struct Block {
    forms: Vec<String>,
    text: String,
}

fn blocks(handlers: &str) -> Vec<Block> {
    let mut blocks: Vec<Block> = Vec::new();
    for line in handlers.lines() {
        match (line.strip_prefix("% "), blocks.last_mut()) {
            // Several names above one text.
            (Some(form), Some(block)) if block.text.is_empty() => {
                block.forms.push(form.to_string())
            }
            (Some(form), _) => {
                blocks.push(Block { forms: vec![form.to_string()], text: String::new() })
            }
            (None, Some(block)) => block.text += &format!("{line}\n"),
            (None, None) => {}
        }
    }
    blocks
}

/// The text for one token of a form. A relation in it chooses branches.
fn expanded(text: &str, token: u8, distance: u8) -> String {
    let relation = Relation::ALL.get(usize::from(distance)).copied().unwrap_or(Relation::Equal);
    let (order, branch, inverse) = match relation {
        Relation::Equal => ("straight", "breq", "brne"),
        Relation::NotEqual => ("straight", "brne", "breq"),
        Relation::Less => ("straight", "brlt", "brge"),
        Relation::Greater => ("swapped", "brlt", "brge"),
        Relation::LessOrEqual => ("swapped", "brge", "brlt"),
        Relation::GreaterOrEqual => ("straight", "brge", "brlt"),
    };
    text.replace("{n}", &distance.to_string())
        .replace("{token}", &token.to_string())
        .replace("{order}", order)
        .replace("{branch}", branch)
        .replace("{inverse}", inverse)
}

/// The jump table while it is filled.
struct Table {
    /// The forms that have no handler yet, by name.
    forms: BTreeMap<String, (&'static Instruction, &'static Form)>,
    /// Where each token leads.
    entries: Vec<String>,
    /// Tokens after the prefix that have a handler: the first so many.
    wide: u8,
}

impl Table {
    fn new() -> Table {
        let of = |instruction: &'static Instruction| {
            instruction.forms.iter().map(move |form| (instruction, form))
        };
        let named = |(instruction, form)| (name(instruction, form), (instruction, form));
        Table {
            forms: core().flat_map(of).map(named).collect(),
            entries: (0..=u8::MAX).map(|token| entry_without_handler(token).to_string()).collect(),
            wide: 0,
        }
    }

    /// Enters the tokens of a block's forms. Returns its text with labels: once for all, or once
    /// for each token when it depends on that.
    fn enter(&mut self, block: &Block) -> String {
        let forms: Vec<_> = block.forms.iter().map(|name| self.take(name)).collect();
        let depends = ["{n}", "{order}", "{branch}", "{inverse}"]
            .iter()
            .any(|place| block.text.contains(place));
        let mut text = String::new();
        let mut write = |(instruction, form): (&Instruction, &Form), token: u8| {
            let label = label(instruction, form, token);
            let own = expanded(&block.text, form.first_token, token - form.first_token);
            text += &format!("{label}:\n{own}");
            label
        };
        let shared =
            forms.first().filter(|_| !depends).map(|&form| write(form, form.1.first_token));
        for &(instruction, form) in &forms {
            for token in form.first_token..=form.last_token {
                let label = shared.clone().unwrap_or_else(|| write((instruction, form), token));
                self.lead(form, token, label);
            }
        }
        text
    }

    /// The form of this name, which gets its only handler.
    fn take(&mut self, name: &str) -> (&'static Instruction, &'static Form) {
        self.forms
            .remove(name)
            .unwrap_or_else(|| panic!("no such form, or it has a handler already: {name}"))
    }

    fn lead(&mut self, form: &Form, token: u8, label: String) {
        if form.prefix.is_some() {
            assert!(
                token == self.wide,
                "tokens after the prefix have handlers in order, from the first on"
            );
            self.wide += 1;
        }
        self.entries[usize::from(form.prefix.unwrap_or(token))] = label;
    }
}

/// Where a token leads that no handler is for.
fn entry_without_handler(token: u8) -> &'static str {
    if module_of_token(token).is_some() { "module" } else { "rest" }
}

/// The instructions that the firmware has itself. Those of modules come with the program.
fn core() -> impl Iterator<Item = &'static Instruction> {
    INSTRUCTIONS.iter().take(CORE_INSTRUCTIONS)
}

fn label(instruction: &Instruction, form: &Form, token: u8) -> String {
    format!("{:?}_{}{token:02X}", instruction.op, if form.prefix.is_some() { "FE" } else { "" })
}

/// Joins the handlers and what is before and after them to the assembly of the engine.
///
/// # Panics
/// When a handler is for no form of the core, or a form has none or two: the build ends.
pub fn generate(before: &str, handlers: &str, after: &str) -> String {
    let mut table = Table::new();
    let text: String = blocks(handlers).iter().map(|block| table.enter(block)).collect();
    let missing: Vec<&String> = table.forms.keys().collect();
    assert!(missing.is_empty(), "no handler for {missing:?}");
    let entries: String = table.entries.iter().map(|entry| format!("    rjmp {entry}\n")).collect();
    let wide = table.wide;
    let constants = format!(
        ".equ NATIVE_VECTORS, {NATIVE_VECTORS}\n.equ JUMP_TABLE, {JUMP_TABLE}\n\
            .equ SLOT_START, {SLOT_START}\n\
         .equ DATA_START, {DATA_START}\n.equ DATA_END, {DATA_END}\n.equ SM_START, {SM_START}\n\
         .equ T_BITS_START, {T_BITS_START}\n.equ C_BITS_START, {C_BITS_START}\n\
         .equ WIDE_COMPARISONS, {wide}\n\
         .equ TIMER_SLOT_LEN, {TIMER_SLOT_LEN}\n.equ COUNTER_SLOT_LEN, {COUNTER_SLOT_LEN}\n\
         .equ APPROACH_LEN, {APPROACH_LEN}\n.equ WINDOW_LEN, {WINDOW_LEN}\n\
         .equ ROUTINE_LEN, {ROUTINE_LEN}\n"
    );
    constants + &before.replace("    ENTRIES\n", &entries) + &text + after
}

/// Kinds that the handlers decode themselves must keep their lengths.
const _: () = assert!(
    Kind::AnyInt.stored_len() == 3
        && Kind::Word.stored_len() == 2
        && SLOT_START.is_multiple_of(256)
);
