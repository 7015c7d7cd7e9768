//! Operands that an instruction takes, in another order: most often the target is first. That they
//! do not fit as they are is known already.

use plc_isa::Instruction;

use crate::meaning::fit::fit_all;
use crate::meaning::quoted::Quoted;

/// The order in which the operands fit, if there is one alone.
pub(super) fn way(quoted: Quoted<'_>, candidates: &[&'static Instruction]) -> Option<String> {
    let orders: &[&[usize]] = match quoted.source.operands.len() {
        2 => &[&[1, 0]],
        3 => &[&[0, 2, 1], &[1, 0, 2], &[1, 2, 0], &[2, 0, 1], &[2, 1, 0]],
        _ => return None,
    };
    let mut fitting = orders.iter().filter(|order| fits(quoted, candidates, order));
    let (Some(order), None) = (fitting.next(), fitting.next()) else { return None };
    let operands: Vec<String> =
        order.iter().map(|&index| quoted.operand(index)).collect::<Option<_>>()?;
    let relation = quoted.source.relation.map_or("", |relation| relation.symbol());
    let (name, operands) = (quoted.source.mnemonic(), operands.join(", "));
    Some(format!("its operands are in another order: `{name}{relation} {operands}`"))
}

fn fits(quoted: Quoted<'_>, candidates: &[&'static Instruction], order: &[usize]) -> bool {
    let operands: Option<Vec<_>> =
        order.iter().map(|&index| quoted.source.operands.get(index).cloned()).collect();
    operands.is_some_and(|operands| {
        let mut forms =
            candidates.iter().flat_map(|one| one.forms.iter().map(move |form| (one, form)));
        forms.any(|(one, form)| fit_all(one, form.kinds, &operands).is_some())
    })
}
