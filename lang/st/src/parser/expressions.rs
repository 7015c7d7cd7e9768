//! Expressions by the standard's precedence.

use awl_asm::Address;
use diagnostics::Span;

use super::{Failed, Outcome, Parser};
use crate::diagnostic::{Code, Diagnostic};
use crate::lexer::Kind;
use crate::tree::{
    Argument, BinaryOperator, Expression, ExpressionKind, Name, Selector, UnaryOperator,
};

/// Operators by how strongly they bind, the weakest first.
const LEVELS: [&[(&str, BinaryOperator)]; 8] = [
    &[("OR", BinaryOperator::Or)],
    &[("XOR", BinaryOperator::Xor)],
    &[("AND", BinaryOperator::And), ("&", BinaryOperator::And)],
    &[("=", BinaryOperator::Equal), ("<>", BinaryOperator::NotEqual)],
    &[
        ("<=", BinaryOperator::LessOrEqual),
        (">=", BinaryOperator::GreaterOrEqual),
        ("<", BinaryOperator::Less),
        (">", BinaryOperator::Greater),
    ],
    &[("+", BinaryOperator::Add), ("-", BinaryOperator::Subtract)],
    &[
        ("*", BinaryOperator::Multiply),
        ("/", BinaryOperator::Divide),
        ("MOD", BinaryOperator::Modulo),
    ],
    &[("**", BinaryOperator::Power)],
];

/// How strongly an operator binds, from 1.
pub fn precedence(operator: BinaryOperator) -> u8 {
    let has_it = |level: &&[(&str, BinaryOperator)]| level.iter().any(|(_, one)| *one == operator);
    (1..).zip(&LEVELS).find(|(_, level)| has_it(level)).map_or(0, |(number, _)| number)
}

pub(super) fn joined(first: Span, last: Span) -> Span {
    Span { start: first.start, end: last.end.max(first.end) }
}

impl Parser<'_> {
    pub(super) fn expression(&mut self) -> Outcome<Expression> {
        self.deeper(|parser| parser.level(0))
    }

    fn level(&mut self, level: usize) -> Outcome<Expression> {
        let Some(operators) = LEVELS.get(level) else { return self.unary() };
        let mut left = self.level(level + 1)?;
        while let Some(operator) = self.take_operator(operators) {
            let right = self.level(level + 1)?;
            let span = joined(left.span, right.span);
            let kind = ExpressionKind::Binary(operator, Box::new(left), Box::new(right));
            left = Expression { kind, span };
        }
        Ok(left)
    }

    fn take_operator(&mut self, operators: &[(&str, BinaryOperator)]) -> Option<BinaryOperator> {
        let token = self.token();
        let found = match token.kind {
            Kind::Sign(sign) => operators.iter().find(|(text, _)| *text == sign),
            Kind::Word | Kind::Keyword(_) => {
                let word = self.word_at(0);
                operators.iter().find(|(text, _)| text.eq_ignore_ascii_case(word))
            }
            _ => None,
        };
        let (_, operator) = found?;
        self.step();
        Some(*operator)
    }

    fn unary(&mut self) -> Outcome<Expression> {
        let token = self.token();
        let operator = match token.kind {
            Kind::Sign("-") => Some(UnaryOperator::Minus),
            Kind::Sign("+") => None,
            Kind::Sign("NOT") => Some(UnaryOperator::Not),
            _ if self.is_word("NOT") => Some(UnaryOperator::Not),
            _ => return self.primary(),
        };
        self.step();
        let operand = self.deeper(Parser::unary)?;
        let span = joined(token.span, operand.span);
        let kind = match (operator, operand.kind) {
            (None, kind) => kind,
            // -32768 is a literal.
            (Some(UnaryOperator::Minus), ExpressionKind::Integer(value)) if value >= 0 => {
                ExpressionKind::Integer(-value)
            }
            (Some(UnaryOperator::Minus), ExpressionKind::Real(value)) => {
                ExpressionKind::Real(-value)
            }
            (Some(UnaryOperator::Minus), ExpressionKind::Duration(value)) => {
                ExpressionKind::Duration(-value)
            }
            (Some(operator), kind) => {
                let operand = Expression { kind, span: operand.span };
                ExpressionKind::Unary(operator, Box::new(operand))
            }
        };
        Ok(Expression { kind, span })
    }

    fn primary(&mut self) -> Outcome<Expression> {
        let token = self.token();
        let kind = match token.kind {
            Kind::Integer => self.integer(token.span),
            Kind::Real => self.real(token.span),
            Kind::Prefixed => self.prefixed(token.span),
            Kind::Text => self.text(token.span),
            Kind::Address => {
                let text = self.text_of(token);
                ExpressionKind::Address(text.strip_prefix('%').unwrap_or(text).to_owned())
            }
            Kind::Unknown => ExpressionKind::Missing,
            Kind::Word if self.is_word("TRUE") => ExpressionKind::Bool(true),
            Kind::Word if self.is_word("FALSE") => ExpressionKind::Bool(false),
            Kind::Sign("(") => return self.bracket(),
            Kind::Word if self.is_call_ahead() => return self.call_or_variable(),
            _ => return Err(self.expected("a value")),
        };
        self.step();
        Ok(Expression { kind, span: token.span })
    }

    /// Some functions are named like operators: `AND(a, b)`.
    fn is_call_ahead(&self) -> bool {
        let is_operator = self.is_one_of(&["AND", "OR", "XOR", "MOD"]);
        self.is_name() || is_operator && matches!(self.ahead(1).kind, Kind::Sign("("))
    }

    fn bracket(&mut self) -> Outcome<Expression> {
        let open = self.step();
        let inside = self.expression()?;
        if !self.take_sign(")") {
            self.missing(")", Some((open.span, "for this one")));
        }
        Ok(Expression { kind: inside.kind, span: joined(open.span, self.previous()) })
    }

    fn call_or_variable(&mut self) -> Outcome<Expression> {
        let token = self.step();
        let name = Name { text: self.text_of(token).to_owned(), span: token.span };
        if self.is_sign("(") {
            let arguments = self.arguments()?;
            let span = joined(name.span, self.previous());
            return Ok(Expression { kind: ExpressionKind::Call(name, arguments), span });
        }
        self.variable_after(name)
    }

    /// A variable whose name is read.
    fn variable_after(&mut self, name: Name) -> Outcome<Expression> {
        let mut selectors = Vec::new();
        loop {
            if self.take_sign(".") {
                if let Some(address) = self.bare_address(&name, &selectors) {
                    return Ok(address);
                }
                if self.bit_of(&name) {
                    return Err(Failed);
                }
                selectors.push(Selector::Field(self.name("the name of a member")?));
            } else if self.take_sign("[") {
                selectors.push(Selector::Index(self.indexes()?));
            } else {
                break;
            }
        }
        let span = joined(name.span, self.previous());
        Ok(Expression { kind: ExpressionKind::Variable(name, selectors), span })
    }

    /// The address that a word and the number ahead are without `%`, which is reported.
    fn bare_address(&mut self, name: &Name, selectors: &[Selector]) -> Option<Expression> {
        let token = self.token();
        let span = joined(name.span, token.span);
        let text = span.text(self.text);
        let is_number = selectors.is_empty() && token.kind == Kind::Integer;
        if !is_number || Address::parse(text).is_err() {
            return None;
        }
        self.step();
        let message = format!("{text}: an address is written with `%`");
        let found = Diagnostic::new(Code::Syntax, span, message);
        self.report(found.suggest(format!("%{text}")));
        Some(Expression { kind: ExpressionKind::Address(text.to_owned()), span })
    }

    /// Reports `w.3` and `w.%X3`.
    fn bit_of(&mut self, name: &Name) -> bool {
        let token = self.token();
        let text = self.text_of(token).trim_start_matches(['%', 'X', 'x']);
        let Some(bit) = text.parse::<u32>().ok().and_then(|bit| 1u32.checked_shl(bit)) else {
            return false;
        };
        let message = "a bit of a variable cannot be named";
        let help = format!("`({} AND 16#{bit:X}) <> 0` is it", name.text);
        self.report(Diagnostic::new(Code::NotThere, token.span, message).help(help));
        true
    }

    fn indexes(&mut self) -> Outcome<Vec<Expression>> {
        let mut indexes = vec![self.expression()?];
        while self.take_sign(",") {
            indexes.push(self.expression()?);
        }
        if !self.take_sign("]") {
            self.missing("]", None);
        }
        Ok(indexes)
    }

    /// What a value is given to: a variable or an address.
    pub(super) fn target(&mut self) -> Outcome<Expression> {
        let token = self.token();
        if token.kind == Kind::Address {
            return self.primary();
        }
        let name = self.name("a statement")?;
        self.variable_after(name)
    }

    /// Arguments in brackets.
    pub(super) fn arguments(&mut self) -> Outcome<Vec<Argument>> {
        let open = self.token().span;
        self.need_sign("(")?;
        let mut arguments = Vec::new();
        while !self.is_sign(")") && !self.is_at_end() {
            arguments.push(self.argument()?);
            if !self.take_sign(",") {
                break;
            }
        }
        if !self.take_sign(")") {
            self.missing(")", Some((open, "for this one")));
        }
        Ok(arguments)
    }

    fn argument(&mut self) -> Outcome<Argument> {
        let is_named =
            self.is_name() && matches!(self.ahead(1).kind, Kind::Sign(":=") | Kind::Sign("=>"));
        if !is_named {
            return Ok(Argument { name: None, is_output: false, value: self.expression()? });
        }
        let name = Some(self.name("a name")?);
        let is_output = matches!(self.step().kind, Kind::Sign("=>"));
        let value = if is_output { self.target()? } else { self.expression()? };
        Ok(Argument { name, is_output, value })
    }

    /// An initial value: an expression, `[1, 2, 3(0)]` or `(a := 1)`.
    pub(super) fn initial(&mut self) -> Outcome<Expression> {
        self.deeper(|parser| {
            let start = parser.token().span;
            if parser.take_sign("[") {
                let list = parser.list()?;
                let span = joined(start, parser.previous());
                return Ok(Expression { kind: ExpressionKind::List(list), span });
            }
            let is_members =
                parser.is_sign("(") && matches!(parser.ahead(2).kind, Kind::Sign(":="));
            if is_members {
                parser.step();
                let members = parser.members()?;
                let span = joined(start, parser.previous());
                return Ok(Expression { kind: ExpressionKind::Members(members), span });
            }
            parser.expression()
        })
    }

    fn list(&mut self) -> Outcome<Vec<(i64, Expression)>> {
        let mut list = Vec::new();
        while !self.is_sign("]") {
            let is_repeated = self.token().kind == Kind::Integer
                && matches!(self.ahead(1).kind, Kind::Sign("("))
                && !matches!(self.ahead(2).kind, Kind::Sign(")"));
            if is_repeated {
                let token = self.step();
                let count = match self.integer(token.span) {
                    ExpressionKind::Integer(count) => count,
                    _ => 1,
                };
                self.step();
                let value = self.initial()?;
                self.need_sign(")")?;
                list.push((count, value));
            } else {
                list.push((1, self.initial()?));
            }
            if !self.take_sign(",") {
                break;
            }
        }
        self.need_sign("]")?;
        Ok(list)
    }

    fn members(&mut self) -> Outcome<Vec<(Name, Expression)>> {
        let mut members = Vec::new();
        loop {
            let name = self.name("the name of a member")?;
            self.need_sign(":=")?;
            members.push((name, self.initial()?));
            if !self.take_sign(",") {
                break;
            }
        }
        self.need_sign(")")?;
        Ok(members)
    }

    /// Reports an assignment where a comparison is meant.
    pub(super) fn condition(&mut self) -> Outcome<Expression> {
        let condition = self.expression()?;
        let meant = match self.token().kind {
            Kind::Sign(":=") => Some(("`:=` assigns, `=` compares", "=", Code::Assignment)),
            Kind::Sign("=>") => Some(("`=>` takes outputs, `>=` compares", ">=", Code::Syntax)),
            _ => None,
        };
        if let Some((message, meant, code)) = meant {
            let span = self.step().span;
            self.report(Diagnostic::new(code, span, message).suggest(meant));
            let right = self.expression()?;
            let span = joined(condition.span, right.span);
            let (left, right) = (Box::new(condition), Box::new(right));
            let kind = ExpressionKind::Binary(BinaryOperator::Equal, left, right);
            return Ok(Expression { kind, span });
        }
        Ok(condition)
    }
}
