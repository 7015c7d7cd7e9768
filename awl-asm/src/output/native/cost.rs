//! How many cycles emitted instructions take, on the shortest and on the longest way through them.

use super::avr::Avr;
use super::code::Placed;
use crate::output::cycles::{Cycles, either};

/// The ways out of a stretch of code.
#[derive(Debug, Clone, Copy, Default)]
pub struct Ways {
    /// To the instruction after it.
    pub through: Option<Cycles>,
    /// To anywhere else.
    pub away: Option<Cycles>,
}

impl Ways {
    fn after(self, cycles: Cycles) -> Ways {
        let add = |way: Option<Cycles>| way.map(|way| way.then(cycles));
        Ways { through: add(self.through), away: add(self.away) }
    }

    fn or(self, other: Ways) -> Ways {
        Ways { through: either(self.through, other.through), away: either(self.away, other.away) }
    }
}

/// The ways out of a stretch of instructions that lie side by side. What is executed after a jump
/// to elsewhere costs what `elsewhere` says; `None` for ways that do not count.
pub fn ways(code: &[Placed], elsewhere: impl Fn(u32) -> Option<Cycles>) -> Ways {
    let exactly = Cycles::exactly;
    let through = Ways { through: Some(Cycles::default()), away: None };
    let end = code.last().map_or(0, |last| last.at + 2 * u32::from(last.op.words()));
    // From the end: after[i] are the ways out from instruction i on.
    let mut behind = vec![through; code.len() + 2];
    for (index, placed) in code.iter().enumerate().rev() {
        let (op, cycles) = (placed.op, placed.op.cycles());
        let at_target = |target: u16| {
            let target = u32::from(target);
            match code.binary_search_by_key(&target, |placed| placed.at) {
                _ if placed.leaves => Ways { through: None, away: elsewhere(target) },
                Ok(found) if found > index => behind[found],
                _ if target == end => through,
                _ => Ways { through: None, away: elsewhere(target) },
            }
        };
        let next = behind[index + 1];
        behind[index] = match op {
            Avr::Branch(_, target) => {
                next.after(exactly(cycles)).or(at_target(target).after(exactly(cycles + 1)))
            }
            Avr::Rjmp(target) | Avr::Jmp(target) => at_target(target).after(exactly(cycles)),
            Avr::Ret => Ways { through: None, away: Some(exactly(cycles)) },
            _ if op.skips() => {
                let skipped = code.get(index + 1).map_or(1, |next| u32::from(next.op.words()));
                next.after(exactly(cycles)).or(behind[index + 2].after(exactly(cycles + skipped)))
            }
            _ => next.after(exactly(cycles).then(placed.callee)),
        };
    }
    behind[0]
}

#[cfg(test)]
mod tests {
    use super::super::avr::{Condition, OfBit, Reg};
    use super::super::code::{Code, Label};
    use super::*;

    fn cycles(write: impl FnOnce(&mut Code, Label)) -> (Option<Cycles>, Option<Cycles>) {
        let mut code = Code::default();
        let elsewhere = code.target();
        write(&mut code, elsewhere);
        let last = code.mark();
        code.bind(elsewhere);
        let placed = code.place(0x6000, 0x6000);
        let ways = ways(placed.between(0, last), |_| Some(Cycles::exactly(100)));
        (ways.through, ways.away)
    }

    const SKIP: Avr = Avr::Bit(OfBit::Sbrc, Reg(16), 0);

    #[test]
    fn ways_are_counted() {
        let exactly = |cycles| Some(Cycles::exactly(cycles));
        assert_eq!(cycles(|_, _| {}), (exactly(0), None));
        assert_eq!(cycles(|code, _| code.op(Avr::Lds(Reg(2), 0x300))), (exactly(2), None));
        assert_eq!(cycles(|code, _| code.op(Avr::Ret)), (None, exactly(4)));
        assert_eq!(
            cycles(|code, to| code.branch(Condition::T_SET, to)),
            (exactly(1), exactly(102))
        );
        assert_eq!(cycles(|code, to| code.jump(to)), (None, exactly(102)));
        let skip_one =
            |code: &mut Code, _: Label| [SKIP, Avr::Set].into_iter().for_each(|op| code.op(op));
        assert_eq!(cycles(skip_one), (exactly(2), None));
        let skip_two = |code: &mut Code, _: Label| {
            [SKIP, Avr::Sts(0x300, Reg(2))].into_iter().for_each(|op| code.op(op))
        };
        assert_eq!(cycles(skip_two), (exactly(3), None));
        let skip_jump = |code: &mut Code, to: Label| {
            code.op(SKIP);
            code.jump(to);
        };
        assert_eq!(cycles(skip_jump), (exactly(2), exactly(103)));
        let branch_within = |code: &mut Code, _: Label| {
            let end = code.label();
            code.branch(Condition::T_CLEAR, end);
            code.op(Avr::Sts(0x300, Reg(2)));
            code.op(Avr::Set);
            code.bind(end);
            code.op(Avr::Clt);
        };
        assert_eq!(cycles(branch_within), (Some(Cycles { min: 3, max: 5 }), None));
    }
}
