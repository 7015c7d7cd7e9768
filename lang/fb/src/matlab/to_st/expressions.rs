//! Expressions. Each comes with how strongly it binds in ST, so that brackets are where ST needs
//! them, and with its type, which says how numbers are divided.

use diagnostics::Span;
use st::parser::precedence;
use st::tree::BinaryOperator;

use super::{Outcome, Translator, Wrong};
use crate::data_type::DataType;
use crate::interpreter::range;
use crate::matlab::functions;
use crate::matlab::lexer::Kind;
use crate::matlab::to_matlab::common;
use crate::matlab::vocabulary::{FUNCTIONS, LEVELS, UNARY, WHOLE, is_bits, is_real, keeps_type};
use crate::matlab::vocabulary::{class, type_of_class};

/// An expression in ST.
pub(in crate::matlab) struct Phrase {
    /// What is before it.
    gap: String,
    text: String,
    level: u8,
    /// Its type in MATLAB; `None`: a literal.
    of: Option<DataType>,
    /// The type that its text has in ST, without the class that MATLAB wants.
    own: Option<DataType>,
    /// The type that MATLAB makes of it, where that has more values than its own.
    lost: Option<DataType>,
    /// It divides what are whole numbers in ST.
    is_whole_division: bool,
}

impl Phrase {
    fn whole(gap: String, text: impl Into<String>, of: Option<DataType>) -> Phrase {
        let text = text.into();
        Phrase { gap, text, level: WHOLE, of, own: of, lost: None, is_whole_division: false }
    }

    /// As it stands.
    pub(in crate::matlab) fn text(self) -> String {
        self.gap + &self.text
    }

    /// Inside of something that binds so strongly.
    fn within(self, around: u8) -> (String, String) {
        match self.level < around {
            true => (self.gap, format!("({})", self.text)),
            false => (self.gap, self.text),
        }
    }

    fn is_real(&self) -> bool {
        self.of.is_some_and(is_real)
    }

    /// With a conversion to the type that it lost, for an operation that is done in another one.
    fn kept(self, operation: Option<DataType>) -> Phrase {
        let Some((own, to)) = self.own.zip(self.lost) else { return self };
        if operation.is_some_and(|of| !is_wider(to, of)) {
            return self;
        }
        let text = format!("{}_TO_{}({})", own.name(), to.name(), self.text);
        Phrase::whole(self.gap, text, Some(to))
    }
}

/// Whether a type has all values of another and more.
fn is_wider(one: DataType, other: DataType) -> bool {
    match (range(one), range(other)) {
        (None, Some(_)) => is_real(one),
        (Some((low, high)), Some((least, most))) => {
            low <= least && most <= high && (low, high) != (least, most)
        }
        _ => false,
    }
}

/// Two operands, one of them converted where ST would do the operation in a type with fewer values
/// than MATLAB. A quotient has no more values than what is divided.
fn in_their_class(left: Phrase, operator: BinaryOperator, right: Phrase) -> (Phrase, Phrase) {
    use BinaryOperator::{Add, Multiply, Subtract};
    if !matches!(operator, Add | Subtract | Multiply) {
        return (left, right);
    }
    let operation = common(left.own, right.own);
    let left = left.kept(operation);
    let operation = common(left.own, right.own);
    (left, right.kept(operation))
}

/// Two operands with an operator of ST between them. `gap`: what is before the operator.
fn joined(left: Phrase, gap: &str, operator: BinaryOperator, right: Phrase) -> Phrase {
    let (left, right) = in_their_class(left, operator, right);
    let level = precedence(operator);
    let typed = |left, right| match operator {
        BinaryOperator::Power => Some(DataType::Real),
        _ if operator.is_comparison() => Some(DataType::Bool),
        _ => common(left, right),
    };
    let (of, own) = (typed(left.of, right.of), typed(left.own, right.own));
    let (before, left) = left.within(level);
    let (between, right) = right.within(level + 1);
    let word = operator.text();
    // A word needs blanks around it, a sign has those that are there.
    let needed = if word.starts_with(char::is_alphabetic) { " " } else { "" };
    let gap = if gap.is_empty() { needed } else { gap };
    let between = if between.is_empty() { needed.to_owned() } else { between };
    let text = format!("{left}{gap}{word}{between}{right}");
    Phrase { gap: before, text, level, of, own, lost: None, is_whole_division: false }
}

impl Translator<'_> {
    /// An expression.
    pub(in crate::matlab) fn expression(&mut self) -> Outcome<Phrase> {
        self.deeper(|this| this.binary(0))
    }

    fn binary(&mut self, at: usize) -> Outcome<Phrase> {
        let Some(operators) = LEVELS.get(at) else { return self.unary() };
        let mut left = self.binary(at + 1)?;
        loop {
            let before = self.at;
            let gap = self.gap(false);
            let found = match self.token().kind {
                Kind::Sign(sign) => operators.iter().find(|(written, _)| *written == sign),
                _ => None,
            };
            let Some((_, operator)) = found else {
                self.at = before;
                return Ok(left);
            };
            let sign = self.step();
            let right = self.binary(at + 1)?;
            left = match operator {
                BinaryOperator::Divide => self.divided(left, &gap, right, sign.span),
                _ => joined(left, &gap, *operator, right),
            };
        }
    }

    /// A quotient. Of whole numbers it is the same only if something cuts it in MATLAB.
    fn divided(&mut self, left: Phrase, gap: &str, right: Phrase, at: Span) -> Phrase {
        let divided = joined(left, gap, BinaryOperator::Divide, right);
        if divided.own.is_some_and(is_real) {
            return divided;
        }
        let is_rounded = divided.of.is_some_and(|of| class(of) != "double");
        self.differs.push(Wrong {
            span: at,
            message: "ST cuts this quotient of whole numbers, MATLAB does not".to_owned(),
            help: "fix(double(a) / double(b)) is what ST does".to_owned(),
        });
        Phrase { is_whole_division: !is_rounded, ..divided }
    }

    fn unary(&mut self) -> Outcome<Phrase> {
        let before = self.at;
        let gap = self.gap(false);
        let word = match self.token().kind {
            Kind::Sign("-") => "-",
            Kind::Sign("~") => "NOT",
            Kind::Sign("+") => "",
            _ => {
                self.at = before;
                return self.power();
            }
        };
        self.step();
        let operand = self.deeper(Self::unary)?;
        let (of, own, lost) = (operand.of, operand.own, operand.lost);
        let (between, text) = operand.within(UNARY);
        let between = if between.is_empty() && word == "NOT" { " ".to_owned() } else { between };
        let text = format!("{word}{between}{text}");
        Ok(Phrase { gap, text, level: UNARY, of, own, lost, is_whole_division: false })
    }

    fn power(&mut self) -> Outcome<Phrase> {
        let mut left = self.primary()?;
        loop {
            let before = self.at;
            let gap = self.gap(false);
            if !matches!(self.token().kind, Kind::Sign("^" | ".^")) {
                self.at = before;
                return Ok(left);
            }
            self.step();
            let before = self.at;
            self.gap(false);
            let is_signed = matches!(self.token().kind, Kind::Sign("-" | "+" | "~"));
            self.at = before;
            let right = if is_signed { self.unary()? } else { self.primary()? };
            left = joined(left, &gap, BinaryOperator::Power, right);
        }
    }

    fn primary(&mut self) -> Outcome<Phrase> {
        let gap = self.gap(false);
        let word = self.word();
        match self.token().kind {
            Kind::Number => {
                self.step();
                let is_real = word.contains(['.', 'e', 'E']);
                let text = match word {
                    word if word.starts_with('.') => format!("0{word}"),
                    word if word.ends_with('.') => format!("{word}0"),
                    word if is_real && !word.contains('.') => {
                        word.to_lowercase().replace('e', ".0e")
                    }
                    word => word.to_owned(),
                };
                Ok(Phrase::whole(gap, text, is_real.then_some(DataType::Real)))
            }
            Kind::Sign("(") => {
                self.step();
                let inside = self.expression()?;
                let end = self.gap(false);
                self.sign(")")?;
                let text = format!("({}{}{end})", inside.gap, inside.text);
                Ok(Phrase { gap, text, level: WHOLE, ..inside })
            }
            Kind::Word if word == "true" || word == "false" => {
                self.step();
                Ok(Phrase::whole(gap, word.to_uppercase(), Some(DataType::Bool)))
            }
            Kind::Word => {
                let phrase = self.named()?;
                Ok(Phrase { gap: gap + &phrase.gap, ..phrase })
            }
            _ => self.expected("a value"),
        }
    }

    /// A variable, an element, or a call.
    fn named(&mut self) -> Outcome<Phrase> {
        let name = self.word();
        if let Some(of) = self.variable(name) {
            self.step();
            let text = format!("{name}{}", self.element()?);
            return Ok(Phrase::whole(String::new(), text, Some(of)));
        }
        let is_call =
            matches!(self.tokens.get(self.at + 1).map(|next| next.kind), Some(Kind::Sign("(")));
        if !is_call {
            let message = format!("{name}: the block has no variable of this name");
            return self.wrong(message, "sections 1 and 2 declare the variables");
        }
        self.called(name)
    }

    /// The index after a variable: the first element is 1 here, and 0 in ST.
    pub(super) fn element(&mut self) -> Outcome<String> {
        if !self.is_sign("(") {
            return Ok(String::new());
        }
        self.step();
        let index = self.expression()?;
        let end = self.gap(false);
        self.sign(")")?;
        let text = index.text();
        Ok(match text.trim_end().strip_suffix("+ 1") {
            Some(index) => format!("[{}{end}]", index.trim_end()),
            None => match text.trim().parse::<u32>() {
                Ok(number) if number > 0 => format!("[{}]", number - 1),
                _ => format!("[({text}{end}) - 1]"),
            },
        })
    }

    fn called(&mut self, name: &str) -> Outcome<Phrase> {
        let at = self.token();
        let known = FUNCTIONS.iter().find(|(_, matlab, _)| *matlab == name);
        let own = functions::function(name).is_some();
        let is_class = type_of_class(name).is_some();
        let others =
            ["cast", "fix", "rem", "idivide", "xor", "bitand", "bitor", "bitxor", "bitcmp"];
        if known.is_none() && !own && !is_class && !others.contains(&name) {
            let message = format!("{name}: ST has no function that does this");
            return self.wrong(message, "write it with operators");
        }
        self.step();
        self.sign("(")?;
        let mut all = vec![self.expression()?];
        let mut mode = None;
        let mut end = self.gap(false);
        while self.is_sign(",") {
            self.step();
            let before = self.at;
            self.gap(false);
            if self.token().kind == Kind::Text {
                mode = Some(self.word().trim_matches('\''));
                self.step();
            } else {
                self.at = before;
                all.push(self.expression()?);
            }
            end = self.gap(false);
        }
        self.sign(")")?;
        let wanted = known.map(|(_, _, count)| *count);
        if let (Some((of_st, _, _)), true) = (known, wanted == Some(all.len())) {
            return Ok(listed(of_st, all, &end));
        }
        if own {
            return Ok(listed(name, all, &end));
        }
        if let ("fix", [_]) = (name, all.as_slice()) {
            return Ok(self.cut(all));
        }
        translated(name, all, mode).ok_or_else(|| Wrong {
            span: at.span,
            message: format!("{name}: ST has no form for this call"),
            help: "fix(a / b) and idivide(a, b, 'fix') divide, rem(a, b) is MOD".to_owned(),
        })
    }
}

impl Translator<'_> {
    /// `fix` of a value: a quotient of whole numbers is cut in ST anyway.
    fn cut(&mut self, mut all: Vec<Phrase>) -> Phrase {
        match all.pop() {
            Some(value) if value.is_whole_division => {
                self.differs.pop();
                Phrase { of: value.own, is_whole_division: false, ..value }
            }
            value => {
                let text = format!("TRUNC({})", value.map(Phrase::text).unwrap_or_default());
                Phrase::whole(String::new(), text, Some(DataType::Dint))
            }
        }
    }
}

/// A call of a function that ST has.
fn listed(name: &str, all: Vec<Phrase>, end: &str) -> Phrase {
    let values = all.iter().skip(usize::from(name == "SEL"));
    let of = match keeps_type(name) {
        true => values.map(|one| one.own).fold(None, common),
        false => functions::result(name).or(Some(DataType::Real)),
    };
    let all: Vec<String> = all.into_iter().map(Phrase::text).collect();
    Phrase::whole(String::new(), format!("{name}({}{end})", all.join(",")), of)
}

/// A call that is something else in ST.
fn translated(name: &str, all: Vec<Phrase>, mode: Option<&str>) -> Option<Phrase> {
    let mut all = all.into_iter();
    let (first, second) = (all.next()?, all.next());
    if all.next().is_some() {
        return None;
    }
    let operator = match (name, mode) {
        ("rem", None) => Some(BinaryOperator::Modulo),
        ("idivide", Some("fix")) => Some(BinaryOperator::Divide),
        ("xor" | "bitxor", None) => Some(BinaryOperator::Xor),
        ("bitand", None) => Some(BinaryOperator::And),
        ("bitor", None) => Some(BinaryOperator::Or),
        _ => None,
    };
    match (operator, second, mode) {
        (Some(operator), Some(second), _) => Some(joined(first, " ", operator, second)),
        (None, None, Some(class)) if name == "cast" && first.of.is_none() => {
            let of = type_of_class(class)?;
            let text = format!("{}#{}", of.name(), first.text);
            Some(Phrase::whole(first.gap, text, Some(of)))
        }
        (None, None, None) => alone(name, first),
        _ => None,
    }
}

/// A function of one value that is no class.
fn alone(name: &str, value: Phrase) -> Option<Phrase> {
    if name == "bitcmp" {
        let of = value.of.filter(|of| is_bits(*of));
        let (gap, text) = value.within(UNARY);
        let whole = Phrase::whole(String::new(), format!("NOT {gap}{text}"), of);
        return Some(Phrase { level: UNARY, ..whole });
    }
    let to = type_of_class(name)?;
    if value.is_real() && !is_real(to) {
        let text = format!("REAL_TO_{}({})", to.name(), value.text());
        return Some(Phrase::whole(String::new(), text, Some(to)));
    }
    // What is written around it is for the class alone, but where ST computes with too few values.
    let to = if is_real(to) { DataType::Real } else { to };
    let of = if is_real(to) { Some(to) } else { value.of.or(Some(to)) };
    let is_lost = |own: DataType| class(own) != class(to) && is_wider(to, own);
    let lost = value.own.filter(|own| is_lost(*own)).map(|_| to);
    Some(Phrase { of, lost, is_whole_division: false, ..value })
}
