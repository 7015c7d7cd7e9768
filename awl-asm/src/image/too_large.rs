//! Says of a program that is larger than the slot by how much, what takes the bytes, and what would
//! have to go. That it is too large is known already.

use std::collections::BTreeSet;

use plc_isa::{CRC_LEN, MODULE_NAMES, OPERANDS_MODULE, needed_modules};

use crate::diagnostic::{Code, Diagnostic};
use crate::image::encode::{Checked, Line};
use crate::meaning::selected::{Selected, span_of};
use crate::plan::modules;

/// Modules whose first instruction is shown.
const SHOWN: usize = 3;
/// Mnemonics of a module that are named.
const NAMED: usize = 4;

/// The error; `total_len` is the image's, which needs `code_at` bytes before its code.
pub fn too_large(
    checked: Checked<'_>,
    lines: &[Line],
    total_len: usize,
    code_at: usize,
) -> Diagnostic {
    let Checked { program, code, demand, .. } = checked;
    let slot_len = demand.profile.slot_len;
    let excess = total_len - usize::from(slot_len);
    // The end of the program takes a byte after the last instruction.
    let limit = u32::from(slot_len - CRC_LEN) - 1;
    let first_outside =
        lines.iter().position(|line| line.at + u32::from(line.len) > limit).unwrap_or(0);
    let span =
        code.get(first_outside).map(|selected| span_of(program, selected)).unwrap_or_default();
    let bytes = if excess == 1 { "1 byte" } else { &format!("{excess} bytes") };
    let message = format!(
        "the program needs {total_len} bytes, the program slot has {slot_len}: {bytes} too many"
    );
    let code_len = total_len - code_at - usize::from(CRC_LEN);
    let mut error = Diagnostic::new(Code::ProgramTooLarge, span, message)
        .label("from here on it does not fit")
        .help(format!(
            "{} instructions take {code_len} bytes, what is before them {code_at}",
            lines.len(),
        ));
    let uses = Uses::of(checked);
    for (module, first) in uses.first().into_iter().take(SHOWN) {
        let what = format!("the first that needs the module {}", named(module));
        error = error.related(span_of(program, first), what);
    }
    error.help.extend(uses.describe());
    error.help.push(uses.way(excess, code_len.checked_div(lines.len()).unwrap_or(1)));
    error.help.extend(demand.describe());
    error
}

fn name(module: u8) -> &'static str {
    MODULE_NAMES.get(usize::from(module)).copied().unwrap_or_default()
}

fn named(module: u8) -> String {
    format!("{}, {} bytes", name(module), modules::bytes(module).len())
}

fn len_of(modules: &BTreeSet<u8>) -> usize {
    modules.iter().map(|&module| modules::bytes(module).len()).sum()
}

/// The modules with the instructions that need them.
struct Uses<'a> {
    /// Those whose machine code is in the image.
    all: BTreeSet<u8>,
    /// The instructions of each module in the order of the text.
    of_rows: Vec<(u8, &'a Selected)>,
}

impl<'a> Uses<'a> {
    fn of(checked: Checked<'a>) -> Uses<'a> {
        let used = checked.demand.modules.iter().zip(0..).filter(|&(&used, _)| used);
        let in_image = checked.units.in_image().flat_map(|part| part.code.clone());
        let rows = in_image.filter_map(|index| {
            let selected = checked.code.get(index)?;
            Some((selected.op.instruction().module()?, selected))
        });
        let takes_modules = checked.demand.profile.takes_modules;
        Uses {
            all: used.map(|(_, module)| module).filter(|_| takes_modules).collect(),
            of_rows: rows.collect(),
        }
    }

    /// The largest modules with the first instruction of each.
    fn first(&self) -> Vec<(u8, &'a Selected)> {
        let find = |&module: &u8| self.of_rows.iter().find(|(of, _)| *of == module).copied();
        let mut first: Vec<_> = self.all.iter().filter_map(find).collect();
        first.sort_by_key(|(module, _)| usize::MAX - modules::bytes(*module).len());
        first
    }

    /// What they take of the program slot, in a line for people; none without modules.
    fn describe(&self) -> Option<String> {
        let mut lens: Vec<(usize, &str)> =
            self.all.iter().map(|&module| (modules::bytes(module).len(), name(module))).collect();
        lens.sort_unstable_by(|a, b| b.cmp(a));
        let words: Vec<String> = lens.iter().map(|(len, name)| format!("{name} {len}")).collect();
        let total = len_of(&self.all);
        (total > 0).then(|| format!("{total} bytes of them are modules: {}", words.join(", ")))
    }

    /// The modules that are needed for those of rows outside of these.
    fn without(&self, gone: &BTreeSet<u8>) -> BTreeSet<u8> {
        let closed = |rows: &mut dyn Iterator<Item = u8>| -> BTreeSet<u8> {
            rows.flat_map(|row| {
                [row, OPERANDS_MODULE].into_iter().chain(needed_modules(row).iter().copied())
            })
            .collect()
        };
        let by_rows = closed(&mut self.of_rows.iter().map(|(module, _)| *module));
        let rest = self.of_rows.iter().map(|(module, _)| *module);
        let rest = closed(&mut rest.filter(|module| !gone.contains(module)));
        // What no row needs is there for other reasons and stays.
        let stays = |module: &u8| rest.contains(module) || !by_rows.contains(module);
        self.all.iter().copied().filter(stays).collect()
    }

    /// What would have to go for so many bytes; an instruction has about `each`.
    fn way(&self, excess: usize, each: usize) -> String {
        let freed = |gone: &BTreeSet<u8>| len_of(&self.all) - len_of(&self.without(gone));
        let modules: BTreeSet<u8> = self.of_rows.iter().map(|(module, _)| *module).collect();
        let rows = |gone: &BTreeSet<u8>| {
            self.of_rows.iter().filter(|(module, _)| gone.contains(module)).count()
        };
        // One module is enough: that with the fewest instructions. Otherwise the largest first.
        let alone = modules.iter().map(|&module| BTreeSet::from([module]));
        let alone = alone.filter(|gone| freed(gone) >= excess).min_by_key(rows);
        let gone = alone.or_else(|| {
            let mut left: Vec<u8> = modules.iter().copied().collect();
            left.sort_by_key(|&module| usize::MAX - freed(&BTreeSet::from([module])));
            let mut gone = BTreeSet::new();
            left.into_iter().find(|&module| {
                gone.insert(module);
                freed(&gone) >= excess
            })?;
            Some(gone)
        });
        match gone {
            Some(gone) => format!(
                "without the {} of {} it fits",
                if rows(&gone) == 1 {
                    "instruction".into()
                } else {
                    format!("{} instructions", rows(&gone))
                },
                self.words(&gone)
            ),
            None => format!(
                "about {} instructions must go: FOR and NEXT repeat lines that are the same, and a \
                 subroutine has them once",
                excess.div_ceil(each.max(1))
            ),
        }
    }

    /// Modules with what is written for their instructions.
    fn words(&self, modules: &BTreeSet<u8>) -> String {
        let words = modules.iter().map(|module| {
            let rows = self.of_rows.iter().filter(|(of, _)| of == module);
            let mut words: Vec<&str> =
                rows.map(|(_, selected)| selected.op.instruction().mnemonic()).collect();
            words.sort_unstable();
            words.dedup();
            let more = if words.len() > NAMED { ", ..." } else { "" };
            words.truncate(NAMED);
            format!("{} (`{}`{more})", name(*module), words.join("`, `"))
        });
        words.collect::<Vec<_>>().join(" and ")
    }
}
