//! Whether two conditions can be TRUE together. What is in them counts as free: variables, calls,
//! how two values compare; of one that is compared with numbers, the numbers decide. Nothing is
//! said where that would be a guess: too much is in them, or what is in them depends on each other.

use std::collections::{BTreeMap, BTreeSet};

use st::tree::{BinaryOperator, Expression, ExpressionKind, Selector, UnaryOperator};
use st::visit;

/// So many combinations of values are tried.
const COMBINATIONS_MAX: usize = 4096;

/// Values that make both conditions TRUE, such as `Start = TRUE`; `None` where there are none, or
/// where that is not plain. `text` is that in which the conditions stand.
pub(crate) fn together(text: &str, conditions: [&Expression; 2]) -> Option<Vec<String>> {
    let mut atoms = Atoms { text, list: Vec::new(), users: BTreeMap::new(), is_vague: false };
    let formulas = conditions.map(|one| atoms.formula(one));
    let domains: Vec<Vec<i64>> =
        atoms.list.iter().map(|atom| atom.domain.iter().copied().collect()).collect();
    let combinations =
        domains.iter().try_fold(1usize, |all, domain| all.checked_mul(domain.len()))?;
    if atoms.is_vague || combinations > COMBINATIONS_MAX {
        return None;
    }
    let found = (0..combinations).map(|number| combination(&domains, number));
    let values = found.into_iter().find(|values| formulas.iter().all(|one| one.holds(values)))?;
    Some(atoms.list.iter().zip(values).map(|(atom, value)| atom.says(value)).collect())
}

/// The values of a combination; the last one changes first.
fn combination(domains: &[Vec<i64>], mut number: usize) -> Vec<i64> {
    let backward = domains.iter().rev().map(|domain| {
        let at = number % domain.len().max(1);
        number /= domain.len().max(1);
        domain.get(at).copied().unwrap_or_default()
    });
    let mut values: Vec<i64> = backward.collect();
    values.reverse();
    values
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

struct Atoms<'t> {
    text: &'t str,
    list: Vec<Atom>,
    /// The atoms in which names are.
    users: BTreeMap<String, usize>,
    is_vague: bool,
}

impl Formula {
    fn holds(&self, values: &[i64]) -> bool {
        match self {
            Formula::Constant(value) => *value,
            Formula::Leaf(atom, relation, number) => {
                let value = values.get(*atom).copied().unwrap_or_default();
                compares(value, *relation, *number)
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

fn compares(left: i64, relation: BinaryOperator, right: i64) -> bool {
    match relation {
        BinaryOperator::Less => left < right,
        BinaryOperator::LessOrEqual => left <= right,
        BinaryOperator::Greater => left > right,
        BinaryOperator::GreaterOrEqual => left >= right,
        BinaryOperator::Equal => left == right,
        _ => left != right,
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

impl Atoms<'_> {
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
        Formula::Leaf(self.atom(about, near, &[of]), relation, number)
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
    fn atom<const N: usize>(
        &mut self,
        about: About,
        values: [i64; N],
        in_it: &[&Expression],
    ) -> usize {
        let at = self.list.iter().position(|known| known.about.is_same(&about));
        let at = at.unwrap_or_else(|| {
            self.list.push(Atom { about, domain: BTreeSet::new() });
            self.list.len() - 1
        });
        self.list.get_mut(at).into_iter().for_each(|atom| atom.domain.extend(values));
        for expression in in_it {
            for name in names(expression) {
                self.is_vague |= *self.users.entry(name).or_insert(at) != at;
            }
        }
        at
    }
}

impl About {
    fn is_same(&self, other: &About) -> bool {
        let is_same = |a: &str, b: &str| a.to_uppercase() == b.to_uppercase();
        match (self, other) {
            (About::Truth(a), About::Truth(b)) => is_same(a, b),
            (About::Number { text: a, .. }, About::Number { text: b, .. }) => is_same(a, b),
            (About::Order(a, c), About::Order(b, d)) => is_same(a, b) && is_same(c, d),
            _ => false,
        }
    }
}

/// The variables in an expression, in upper case; of an array all of it.
fn names(expression: &Expression) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    visit::expressions(&mut expression.clone(), &mut |one| {
        match &one.kind {
            ExpressionKind::Variable(name, selectors) => {
                let mut text = name.text.to_uppercase();
                for selector in selectors {
                    let Selector::Field(field) = selector else { break };
                    text = format!("{text}.{}", field.text.to_uppercase());
                }
                names.insert(text);
            }
            ExpressionKind::Address(address) => {
                names.insert(format!("%{}", address.to_uppercase()));
            }
            _ => {}
        }
        true
    });
    names
}
