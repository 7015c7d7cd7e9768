//! Puts the fast engine's assembly together: the jump table follows from the instruction table and from which forms
//! have a handler. What the handlers do stands in `src/engine`.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use plc_isa::{
    C_BITS_START, COUNTER_SLOT_LEN, DATA_END, DATA_START, Form, INSTRUCTIONS, Instruction, Kind, NATIVE_VECTORS,
    Relation, SLOT_START, SM_START, T_BITS_START, TIMER_SLOT_LEN, WIDE_PREFIX,
};

/// Where the jump table lies in flash: `ijmp` takes the token as the low byte of a word address.
pub const TABLE_START: u16 = 0x0200;

/// A form as the handlers name it: `Ldw Relation Word Word`, `wide Ldw Relation AnyInt AnyInt`.
fn name(instruction: &Instruction, form: &Form) -> String {
    let mut name = if form.wide { "wide ".to_string() } else { String::new() };
    let _ = write!(name, "{:?}", instruction.op);
    for kind in form.kinds {
        let _ = write!(name, " {kind:?}");
    }
    name
}

/// All forms by name.
fn forms() -> BTreeMap<String, (&'static Instruction, &'static Form)> {
    let of = |instruction: &'static Instruction| instruction.forms.iter().map(move |form| (instruction, form));
    INSTRUCTIONS.iter().flat_map(of).map(|(instruction, form)| (name(instruction, form), (instruction, form))).collect()
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
            (Some(form), Some(block)) if block.text.is_empty() => block.forms.push(form.to_string()),
            (Some(form), _) => blocks.push(Block { forms: vec![form.to_string()], text: String::new() }),
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

/// The engine: its assembly text, and the instructions it executes in all their forms, a bit each in the order of the
/// table.
pub struct Engine {
    pub text: String,
    pub executed: u128,
}

/// Joins the two sources.
///
/// # Panics
/// When a handler is for no form of the instruction table: the build ends.
pub fn generate(engine: &str, handlers: &str) -> Engine {
    let forms = forms();
    let mut entries: Vec<String> = (0..256).map(|_| "rest".to_string()).collect();
    let mut wide = 0;
    let mut text = String::new();
    let mut handled = Vec::new();
    for block in blocks(handlers) {
        let depends = ["{n}", "{order}", "{branch}", "{inverse}"].iter().any(|place| block.text.contains(place));
        for (index, form_name) in block.forms.iter().enumerate() {
            let (instruction, form) = forms.get(form_name).unwrap_or_else(|| panic!("no such form: {form_name}"));
            handled.push(form_name.clone());
            if form.wide {
                wide += form.last_token - form.first_token + 1;
                entries[usize::from(WIDE_PREFIX)] = "wide".to_string();
                continue;
            }
            for token in form.first_token..=form.last_token {
                let distance = if depends { token - form.first_token } else { 0 };
                let label = format!("{:?}_{:02X}", instruction.op, form.first_token + distance);
                // One text for the whole block, or one for each token.
                if depends || (index == 0 && token == form.first_token) {
                    let _ = write!(text, "{label}:\n{}", expanded(&block.text, form.first_token, distance));
                }
                let shared = forms.get(&block.forms[0]).map(|(first, form)| (first.op, form.first_token));
                entries[usize::from(token)] = match shared {
                    Some((op, first)) if !depends => format!("{op:?}_{first:02X}"),
                    _ => label,
                };
            }
        }
        if block.forms.iter().all(|form| form.starts_with("wide ")) {
            let _ = write!(text, "wide:\n{}", block.text);
        }
    }
    let executed = INSTRUCTIONS
        .iter()
        .filter(|instruction| instruction.forms.iter().all(|form| handled.contains(&name(instruction, form))))
        .fold(0, |set, instruction| set | 1 << instruction.op as u32);
    let table: Vec<String> = entries.iter().map(|entry| format!("    rjmp {entry}\n")).collect();
    let constants = format!(
        ".equ NATIVE_VECTORS, {NATIVE_VECTORS}\n.equ TABLE_START, {TABLE_START}\n.equ SLOT_START, {SLOT_START}\n\
         .equ DATA_START, {DATA_START}\n.equ DATA_END, {DATA_END}\n.equ SM_START, {SM_START}\n\
         .equ T_BITS_START, {T_BITS_START}\n.equ C_BITS_START, {C_BITS_START}\n.equ WIDE_COMPARISONS, {wide}\n\
         .equ TIMER_SLOT_LEN, {TIMER_SLOT_LEN}\n.equ COUNTER_SLOT_LEN, {COUNTER_SLOT_LEN}\n"
    );
    let text = engine.replace("    ENTRIES\n", &table.concat()).replace("    HANDLERS\n", &text);
    Engine { text: constants + &text, executed }
}

/// Kinds that the handlers decode themselves must keep their lengths.
const _: () = assert!(Kind::AnyInt.stored_len() == 3 && Kind::Word.stored_len() == 2 && SLOT_START % 256 == 0);
