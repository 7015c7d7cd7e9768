//! Whether two conditions can be TRUE together, or one is TRUE whenever the other one is. What is
//! in them counts as free: variables, calls, how two values compare; of one that is compared with
//! numbers, the numbers decide. Nothing is said where that would be a guess: too much is in them,
//! or what is in them depends on each other.

use std::collections::BTreeSet;
use std::ops::Bound::{Excluded, Unbounded};

use awl_asm::Address;
use st::names::is_same;
use st::tree::{BinaryOperator, Expression, ExpressionKind, Selector, UnaryOperator};
use st::visit;

/// So many combinations of values are tried.
const COMBINATIONS_MAX: usize = 4096;
/// More atoms have more combinations: each has two values at least.
const ATOMS_MAX: usize = COMBINATIONS_MAX.ilog2() as usize;

/// Values that make both conditions TRUE, such as `Start = TRUE`; `None` where there are none, or
/// where that is not plain. `text` is that in which the conditions stand.
pub(crate) fn together(text: &str, conditions: [&Expression; 2]) -> Option<Vec<String>> {
    let mut atoms = Atoms::new(text);
    let formulas = conditions.map(|one| atoms.formula(one));
    match atoms.search(|values| formulas.iter().all(|one| one.holds(values))) {
        Search::Found(values) => Some(values),
        Search::None | Search::Vague => None,
    }
}

/// Values that make a condition TRUE, if all values that do make another one TRUE, too; `None`
/// where that is not so, or not plain.
pub(crate) fn implied(text: &str, one: &Expression, other: &Expression) -> Option<Vec<String>> {
    let mut atoms = Atoms { is_signed: true, ..Atoms::new(text) };
    let [one, other] = [one, other].map(|one| atoms.formula(one));
    match atoms.search(|values| one.holds(values) && !other.holds(values)) {
        Search::Found(_) | Search::Vague => return None,
        Search::None => {}
    }
    match atoms.search(|values| one.holds(values)) {
        Search::Found(values) => Some(values),
        Search::None | Search::Vague => None,
    }
}

/// What came of looking for values.
enum Search {
    Found(Vec<String>),
    None,
    /// What is asked depends on each other, or is too much.
    Vague,
}

/// Changes the values into the next combination; the last one changes first. `false` after the last
/// combination.
fn next(atoms: &[Atom], values: &mut [i64]) -> bool {
    for (atom, value) in atoms.iter().zip(values).rev() {
        if let Some(larger) = atom.domain.range((Excluded(*value), Unbounded)).next() {
            *value = *larger;
            return true;
        }
        *value = atom.least();
    }
    false
}

/// A condition.
enum Formula {
    Constant(bool),
    /// How the value of an atom compares with a number.
    Leaf(usize, BinaryOperator, i64),
    Not(Box<Formula>),
    Both(BinaryOperator, Box<Formula>, Box<Formula>),
}

/// What a formula is about.
#[derive(Clone, PartialEq, Eq)]
enum About {
    /// Something that is TRUE or FALSE, 1 or 0.
    Truth(String),
    /// Something that is compared with numbers; a time is in milliseconds.
    Number { text: String, is_time: bool },
    /// Two things that are compared; -1: the first one is less.
    Order(String, String),
}

struct Atom {
    about: About,
    /// The values that make a difference.
    domain: BTreeSet<i64>,
}

/// Something that has a value of its own.
#[derive(PartialEq, Eq)]
enum Named {
    /// A variable, in upper case; of an array all of it.
    Variable(String),
    Address(Address),
}

struct Atoms<'t> {
    text: &'t str,
    list: Vec<Atom>,
    /// What is named, with the atom in which it is.
    users: Vec<(Named, usize)>,
    is_vague: bool,
    /// Whether values below zero are tried of everything.
    is_signed: bool,
}

impl Formula {
    fn holds(&self, values: &[i64]) -> bool {
        match self {
            Formula::Constant(value) => *value,
            Formula::Leaf(atom, relation, number) => {
                let value = values.get(*atom).copied().unwrap_or_default();
                relation.compare(value, *number) == Some(true)
            }
            Formula::Not(inside) => !inside.holds(values),
            Formula::Both(operator, left, right) => {
                let (left, right) = (left.holds(values), right.holds(values));
                match operator {
                    BinaryOperator::And => left && right,
                    BinaryOperator::Or => left || right,
                    _ => left != right,
                }
            }
        }
    }
}

/// The relation that the right side has to the left one.
fn mirrored(relation: BinaryOperator) -> BinaryOperator {
    use BinaryOperator::{Greater, GreaterOrEqual, Less, LessOrEqual};
    match relation {
        Less => Greater,
        LessOrEqual => GreaterOrEqual,
        Greater => Less,
        GreaterOrEqual => LessOrEqual,
        other => other,
    }
}

/// The number that an expression is, and whether it is a time.
fn number(expression: &Expression) -> Option<(i64, bool)> {
    match &expression.kind {
        ExpressionKind::Integer(value) => Some((*value, false)),
        ExpressionKind::Duration(value) => Some((*value, true)),
        ExpressionKind::Typed(_, inside) => number(inside),
        ExpressionKind::Unary(UnaryOperator::Minus, inside) => {
            number(inside).map(|(value, is_time)| (-value, is_time))
        }
        _ => None,
    }
}

impl Atom {
    fn least(&self) -> i64 {
        self.domain.first().copied().unwrap_or_default()
    }

    fn says(&self, value: i64) -> String {
        match &self.about {
            About::Truth(text) => format!("{text} = {}", if value == 0 { "FALSE" } else { "TRUE" }),
            About::Number { text, is_time: true } => format!("{text} = T#{value}ms"),
            About::Number { text, .. } => format!("{text} = {value}"),
            About::Order(left, right) => {
                let relation = match value {
                    0 => "=",
                    1 => ">",
                    _ => "<",
                };
                format!("{left} {relation} {right}")
            }
        }
    }
}

impl<'t> Atoms<'t> {
    fn new(text: &'t str) -> Atoms<'t> {
        let (list, users) = (Vec::new(), Vec::new());
        Atoms { text, list, users, is_vague: false, is_signed: false }
    }

    /// Tries all combinations of values until one is as wanted.
    fn search(&self, is_wanted: impl Fn(&[i64]) -> bool) -> Search {
        let combinations =
            self.list.iter().try_fold(1usize, |all, atom| all.checked_mul(atom.domain.len()));
        if self.is_vague || combinations.is_none_or(|count| count > COMBINATIONS_MAX) {
            return Search::Vague;
        }
        let mut values: Vec<i64> = self.list.iter().map(Atom::least).collect();
        while !is_wanted(&values) {
            if !next(&self.list, &mut values) {
                return Search::None;
            }
        }
        Search::Found(self.list.iter().zip(values).map(|(atom, value)| atom.says(value)).collect())
    }

    fn formula(&mut self, expression: &Expression) -> Formula {
        use BinaryOperator::{And, Or, Xor};
        match &expression.kind {
            ExpressionKind::Bool(value) => Formula::Constant(*value),
            ExpressionKind::Unary(UnaryOperator::Not, inside) => {
                Formula::Not(Box::new(self.formula(inside)))
            }
            ExpressionKind::Binary(operator @ (And | Or | Xor), left, right) => {
                let (left, right) = (self.formula(left), self.formula(right));
                Formula::Both(*operator, Box::new(left), Box::new(right))
            }
            ExpressionKind::Binary(relation, left, right) if relation.is_comparison() => {
                self.comparison(*relation, left, right)
            }
            ExpressionKind::Missing => {
                self.is_vague = true;
                Formula::Constant(false)
            }
            _ => self.truth(expression),
        }
    }

    fn truth(&mut self, expression: &Expression) -> Formula {
        let about = About::Truth(self.written(expression));
        Formula::Leaf(self.atom(about, [0, 1], &[expression]), BinaryOperator::NotEqual, 0)
    }

    fn comparison(
        &mut self,
        relation: BinaryOperator,
        left: &Expression,
        right: &Expression,
    ) -> Formula {
        if let (ExpressionKind::Bool(value), BinaryOperator::Equal | BinaryOperator::NotEqual) =
            (&right.kind, relation)
        {
            let inside = self.formula(left);
            let is_same = *value == (relation == BinaryOperator::Equal);
            return if is_same { inside } else { Formula::Not(Box::new(inside)) };
        }
        let (of, relation, number) = match (number(left), number(right)) {
            (None, Some(number)) => (left, relation, number),
            (Some(number), None) => (right, mirrored(relation), number),
            _ => return self.order(relation, left, right),
        };
        let (number, is_time) = number;
        let about = About::Number { text: self.written(of), is_time };
        let near = [number.saturating_sub(1), number, number.saturating_add(1)];
        // What is compared with nothing below zero may have no such values.
        let is_signed = self.is_signed || number < 0;
        let values = near.into_iter().filter(|value| *value >= 0 || is_signed);
        Formula::Leaf(self.atom(about, values, &[of]), relation, number)
    }

    fn order(
        &mut self,
        relation: BinaryOperator,
        left: &Expression,
        right: &Expression,
    ) -> Formula {
        let (first, second) = (self.written(left), self.written(right));
        let (first, second, relation) = match first.to_uppercase() <= second.to_uppercase() {
            true => (first, second, relation),
            false => (second, first, mirrored(relation)),
        };
        let about = About::Order(first, second);
        Formula::Leaf(self.atom(about, [-1, 0, 1], &[left, right]), relation, 0)
    }

    /// An expression as it is written, in one line.
    fn written(&self, expression: &Expression) -> String {
        let words = expression.span.text(self.text).split_whitespace();
        words.collect::<Vec<_>>().join(" ")
    }

    /// The number of an atom; what makes a difference to it is noted.
    fn atom(
        &mut self,
        about: About,
        values: impl IntoIterator<Item = i64>,
        in_it: &[&Expression],
    ) -> usize {
        if self.is_vague {
            return 0;
        }
        let at = self.list.iter().position(|known| known.about.is_same(&about));
        let at = at.unwrap_or_else(|| {
            self.list.push(Atom { about, domain: BTreeSet::new() });
            self.list.len() - 1
        });
        self.is_vague |= self.list.len() > ATOMS_MAX;
        if let Some(atom) = self.list.get_mut(at) {
            atom.domain.extend(values);
        }
        for expression in in_it {
            for named in named(expression) {
                let is_used = |(other, user): &(Named, usize)| *user != at && named.meets(other);
                self.is_vague |= self.users.iter().any(is_used);
                if !self.users.iter().any(|(other, user)| *user == at && *other == named) {
                    self.users.push((named, at));
                }
            }
        }
        at
    }
}

impl About {
    fn is_same(&self, other: &About) -> bool {
        match (self, other) {
            (About::Truth(a), About::Truth(b)) => is_same(a, b),
            (About::Number { text: a, .. }, About::Number { text: b, .. }) => is_same(a, b),
            (About::Order(a, c), About::Order(b, d)) => is_same(a, b) && is_same(c, d),
            _ => false,
        }
    }
}

impl Named {
    /// Whether what changes the one can change the other.
    fn meets(&self, other: &Named) -> bool {
        match (self, other) {
            (Named::Address(one), Named::Address(other)) => one.overlaps(*other),
            _ => self == other,
        }
    }
}

/// What is named in an expression. An address that there is not is reported elsewhere.
fn named(expression: &Expression) -> Vec<Named> {
    let mut all = Vec::new();
    visit::each(expression, &mut |one| {
        match &one.kind {
            ExpressionKind::Variable(name, selectors) => {
                let mut text = name.text.to_uppercase();
                for selector in selectors {
                    let Selector::Field(field) = selector else { break };
                    text = format!("{text}.{}", field.text.to_uppercase());
                }
                all.push(Named::Variable(text));
            }
            ExpressionKind::Address(address) => {
                // `MX0.0` is M0.0; no area has an X.
                let address = address.to_uppercase().replacen('X', "", 1);
                all.extend(Address::parse(&address).ok().map(Named::Address));
            }
            _ => {}
        }
        true
    });
    all
}
