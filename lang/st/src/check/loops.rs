//! WHILE and REPEAT that never end: nothing leaves them, and nothing in them changes what their
//! condition reads. A loop that this cannot be told of may be one all the same.

use super::Checker;
use super::recursion::{each_assignment, inside};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{Expression, ExpressionKind, Place, Root, Statement, StatementKind, Value};

impl Checker<'_> {
    /// Reports a loop that goes on while its condition is `goes_on`, for ever.
    pub(super) fn never_ends(&mut self, condition: &Expression, goes_on: bool, body: &[Statement]) {
        if can_leave(body, true) {
            return;
        }
        let why = match &condition.kind {
            ExpressionKind::Constant(Value::Bool(value)) if *value == goes_on => {
                "nothing leaves the loop: it never ends"
            }
            ExpressionKind::Constant(_) => return,
            _ if self.stays(condition, body) => {
                "nothing in the loop changes what its condition reads: once begun, it never ends"
            }
            _ => return,
        };
        let help = "a program runs in every scan: IF does something now and then, without a loop";
        self.report(Diagnostic::new(Code::Loop, condition.span, why).help(help));
    }

    /// Whether a condition is the same in every pass.
    fn stays(&self, condition: &Expression, body: &[Statement]) -> bool {
        let mut written: Vec<Root> = Vec::new();
        each_assignment(body, &mut |place, _| written.push(place.root.clone()));
        let mut stays = true;
        inside(condition, &mut |one| match &one.kind {
            ExpressionKind::Read(place) => {
                stays &= self.is_own(place) && !written.contains(&place.root);
            }
            ExpressionKind::Call(..) => stays = false,
            _ => {}
        });
        stays
    }

    /// Whether what is in a place changes by statements alone that name it, or, as an input, not at
    /// all within a scan.
    fn is_own(&self, place: &Place) -> bool {
        let at = match &place.root {
            Root::Local(at) => self.locals().get(*at).and_then(|one| one.at.as_deref()),
            Root::Global(at) => self.program.globals.get(*at).and_then(|one| one.at.as_deref()),
            Root::Address(text) => Some(text.as_str()),
        };
        at.is_none_or(|text| text.starts_with('I'))
    }
}

/// Whether statements leave the loop around them, or do what cannot be seen here.
fn can_leave(body: &[Statement], is_own_loop: bool) -> bool {
    body.iter().any(|statement| match &statement.kind {
        StatementKind::Exit => is_own_loop,
        StatementKind::Return | StatementKind::Call(_) | StatementKind::Routine(..) => true,
        StatementKind::If(arms, otherwise) => {
            arms.iter().any(|(_, body)| can_leave(body, is_own_loop))
                || can_leave(otherwise, is_own_loop)
        }
        StatementKind::Case(_, arms, otherwise) => {
            arms.iter().any(|(_, body)| can_leave(body, is_own_loop))
                || can_leave(otherwise, is_own_loop)
        }
        StatementKind::For(one) => can_leave(&one.body, false),
        StatementKind::While(_, body) | StatementKind::Repeat(body, _) => can_leave(body, false),
        StatementKind::Assign(..)
        | StatementKind::AddElapsed(_)
        | StatementKind::Element(_)
        | StatementKind::Continue => false,
    })
}
