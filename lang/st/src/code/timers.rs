//! Which timers can count in a word: those whose presets are constants of at most 32.767 s.

use std::collections::HashMap;

use crate::model::{
    ExpressionKind, Place, Program, Root, StatementKind, Step, Type, Value, each_statement,
};

/// What a variable belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Owner {
    Global,
    Unit(usize),
}

/// Timers that count in a word, by the variable; the preset if all calls have the same.
pub(super) type Short = HashMap<(Owner, usize), Option<i64>>;

const SHORT_MAX: i64 = i16::MAX as i64;

pub(super) fn short_timers(program: &Program) -> Short {
    let mut presets: HashMap<(Owner, usize), Option<Vec<i64>>> = HashMap::new();
    for (number, unit) in program.units.iter().enumerate() {
        let key = |place: &Place| match place.root {
            Root::Local(at) => Some((Owner::Unit(number), at)),
            Root::Global(at) => Some((Owner::Global, at)),
            Root::Address(_) => None,
        };
        each_statement(&unit.body, &mut |statement| match &statement.kind {
            StatementKind::Call(call) if is_timer(program, call.block) => {
                let Some(key) = key(&call.instance) else { return };
                let given = call.inputs.iter().find(|(at, _)| *at == 1).map(|(_, value)| value);
                let preset = match given.map(|value| &value.kind) {
                    Some(ExpressionKind::Constant(Value::Int(ms))) => Some(*ms),
                    _ => None,
                };
                let preset = preset.filter(|ms| (0..=SHORT_MAX).contains(ms));
                let list = presets.entry(key).or_insert_with(|| Some(Vec::new()));
                match (list.as_mut(), preset) {
                    (Some(list), Some(preset)) => list.push(preset),
                    _ => *list = None,
                }
            }
            StatementKind::Assign(place, _) if !place.steps.is_empty() => {
                // An input that is written has a preset that is not known.
                let is_member = place.steps.iter().any(|step| matches!(step, Step::Member(_)));
                if let Some(key) = key(place).filter(|_| is_member && place.of_type == Type::Time) {
                    presets.insert(key, None);
                }
            }
            _ => {}
        });
    }
    let known = presets.into_iter().filter_map(|(key, list)| {
        let list = list?;
        let first = list.first().copied();
        Some((key, first.filter(|first| list.iter().all(|one| one == first))))
    });
    known.collect()
}

fn is_timer(program: &Program, block: usize) -> bool {
    let unit = program.units.get(block).filter(|unit| unit.file.is_none());
    unit.is_some_and(|unit| ["TON", "TOF", "TP"].contains(&unit.name.as_str()))
}
