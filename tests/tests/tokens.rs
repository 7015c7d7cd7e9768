//! The token table against its copy kept by hand: a token whose meaning changes would break every
//! stored image.

use std::collections::BTreeSet;

use plc_isa::{INSTRUCTIONS, MODULE_PREFIX, MODULES, WIDE_PREFIX};

/// A line for each form, as the table has it.
fn table() -> Vec<String> {
    let mut lines = Vec::new();
    for instruction in INSTRUCTIONS {
        for form in instruction.forms {
            let prefix = form.prefix.map_or(String::new(), |prefix| format!("{prefix:02X} "));
            let kinds: Vec<String> = form.kinds.iter().map(|kind| format!("{kind:?}")).collect();
            let line = format!(
                "{prefix}{:02X}-{:02X} {:?} {}",
                form.first_token,
                form.last_token,
                instruction.op,
                kinds.join(" ")
            );
            lines.push(line.trim_end().to_string());
        }
    }
    lines.sort();
    lines
}

#[test]
fn tokens_are_the_pinned_ones() {
    let pinned = include_str!("../tokens.txt");
    let pinned: BTreeSet<String> = pinned
        .lines()
        .filter(|line| !line.is_empty() && !line.starts_with('#'))
        .map(str::to_owned)
        .collect();
    let table: BTreeSet<String> = table().into_iter().collect();
    let only = |one: &BTreeSet<String>, other: &BTreeSet<String>| {
        one.difference(other).cloned().collect::<Vec<_>>().join("\n")
    };
    assert!(
        table == pinned,
        "a token may be added, never changed\nonly in the table:\n{}\nonly in tokens.txt:\n{}",
        only(&table, &pinned),
        only(&pinned, &table)
    );
}

#[test]
fn tokens_do_not_overlap_and_leave_the_erased_byte_undefined() {
    let modules = MODULE_PREFIX..MODULE_PREFIX + MODULES as u8;
    let prefixes: Vec<u8> = modules.chain([WIDE_PREFIX]).collect();
    for prefix in [None].into_iter().chain(prefixes.iter().copied().map(Some)) {
        let mut used = [false; 256];
        for form in
            INSTRUCTIONS.iter().flat_map(|row| row.forms).filter(|form| form.prefix == prefix)
        {
            for token in form.first_token..=form.last_token {
                assert!(!used[usize::from(token)], "token {token:02X} is used twice");
                used[usize::from(token)] = true;
            }
        }
        assert!(!used[0xFF], "erased flash must not be an instruction");
        let is_free = |&prefix: &u8| !used[usize::from(prefix)];
        assert!(prefix.is_some() || prefixes.iter().all(is_free), "a prefix is a token");
    }
    let known = |row: &plc_isa::Instruction| {
        row.forms.iter().all(|form| form.prefix.is_none_or(|p| prefixes.contains(&p)))
    };
    assert!(INSTRUCTIONS.iter().all(known), "a prefix that nobody decodes");
}
