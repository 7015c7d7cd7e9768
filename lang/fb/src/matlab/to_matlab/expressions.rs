//! Expressions: the same operators where MATLAB has them, functions where it has not. Types decide
//! how whole numbers are divided, and what is made of the class that MATLAB wants.

use st::lexer::Kind;
use st::tree::{
    Argument, BinaryOperator, Expression, ExpressionKind, Name, Selector, UnaryOperator,
};

use super::Translator;
use crate::data_type::DataType;
use crate::interpreter::range;
use crate::matlab::functions;
use crate::matlab::vocabulary::{FUNCTIONS, UNARY, class, infix, is_bits, is_real, keeps_type};

impl Translator<'_> {
    /// Marks what becomes of an expression inside of something that binds so strongly.
    pub(super) fn expression(&mut self, expression: &Expression, around: u8) {
        let span = expression.span;
        match &expression.kind {
            ExpressionKind::Variable(name, selectors) => self.variable(name, selectors),
            ExpressionKind::Integer(value) => self.number(expression, *value, around),
            ExpressionKind::Real(_) => {
                if span.text(self.text).starts_with('-') {
                    self.brackets(expression, UNARY, around);
                }
            }
            ExpressionKind::Bool(value) => {
                let token = self.word_at(span.start, &["TRUE", "FALSE"]);
                self.replace(token, if *value { "true" } else { "false" });
            }
            ExpressionKind::Typed(name, value) => self.typed(expression, name, value),
            ExpressionKind::Call(name, arguments) => self.call(expression, name, arguments),
            ExpressionKind::Unary(operator, operand) => {
                self.unary(expression, *operator, operand, around);
            }
            ExpressionKind::Binary(operator, left, right) => {
                self.binary(expression, *operator, left, right, around);
            }
            ExpressionKind::Duration(_) => {
                let help = "write the milliseconds into a DINT";
                self.problem(span, "MATLAB has no durations", help);
            }
            ExpressionKind::Text(_) => {
                let help = "texts are initial values there, and nothing else";
                self.problem(span, "MATLAB's form has no texts in algorithms", help);
            }
            _ => self.problem(span, "MATLAB has no form for this", "write it another way"),
        }
    }

    /// An expression that is given to something of a type.
    pub(super) fn given(&mut self, expression: &Expression, to: DataType) {
        let wanted = class(to);
        let is_there = match self.type_of(expression) {
            Some(of) => class(of) == wanted,
            None => wanted == "double",
        };
        if !is_there && wanted != "logical" {
            self.around(expression.span.start, &format!("{wanted}("), expression.span.end, ")");
        }
        self.expression(expression, 0);
    }

    /// The type of an expression; `None`: a literal, which takes that of what it meets.
    pub(super) fn type_of(&self, expression: &Expression) -> Option<DataType> {
        match &expression.kind {
            ExpressionKind::Variable(name, _) => {
                self.block.variables().find(|one| one.name.names(&name.text)).map(|one| one.of_type)
            }
            ExpressionKind::Bool(_) => Some(DataType::Bool),
            ExpressionKind::Real(_) => Some(DataType::Real),
            ExpressionKind::Typed(name, _) => DataType::of(name),
            ExpressionKind::Unary(_, operand) => self.type_of(operand),
            ExpressionKind::Call(name, arguments) => {
                let name = name.text.to_uppercase();
                let last = arguments.iter().skip(usize::from(name == "SEL"));
                let types = last.map(|one| self.type_of(&one.value));
                match keeps_type(&name) {
                    true => types.fold(None, common),
                    false => functions::result(&name).or(Some(DataType::Real)),
                }
            }
            ExpressionKind::Binary(operator, left, right) => match operator {
                BinaryOperator::Power => Some(DataType::Real),
                one if one.is_comparison() => Some(DataType::Bool),
                _ => common(self.type_of(left), self.type_of(right)),
            },
            _ => None,
        }
    }

    fn variable(&mut self, name: &Name, selectors: &[Selector]) {
        let declared = self.block.variables().find(|one| one.name.names(&name.text));
        let Some(declared) = declared else {
            let message = format!("{}: there is no variable of this name", name.text);
            return self.problem(name.span, message, "algorithms see variables of the block");
        };
        let written = declared.name.text.clone();
        let token = self.token_at(name.span.start);
        self.replace(token, &written);
        match selectors {
            [] => {}
            [Selector::Index(indexes)] if indexes.len() == 1 => {
                let open = self.token_at(name.span.end);
                self.replace(open, "(");
                let Some(index) = indexes.first() else { return };
                let close = self.word_at(index.span.end, &["]"]);
                self.replace(close, " + 1)");
                self.expression(index, 7);
            }
            _ => {
                let help = "only variables and elements of arrays have a form";
                self.problem(name.span, "MATLAB has no form for this", help);
            }
        }
    }

    fn number(&mut self, expression: &Expression, value: i64, around: u8) {
        let span = expression.span;
        let token = self
            .tokens_from(span.start)
            .find(|token| matches!(token.kind, Kind::Integer | Kind::Prefixed));
        self.replace(token, &value.unsigned_abs().to_string());
        if span.text(self.text).starts_with('-') {
            self.brackets(expression, UNARY, around);
        }
    }

    fn typed(&mut self, expression: &Expression, name: &str, value: &Expression) {
        let of = DataType::of(name).filter(|of| class(*of) != "double" && !is_bits(*of));
        let number = match &value.kind {
            ExpressionKind::Integer(value) => Some(value.to_string()),
            _ => None,
        };
        let Some((of, number)) = of.zip(number) else {
            let help = "leave the type out: it follows from what it is used for";
            return self.problem(expression.span, "MATLAB has no literal of this type", help);
        };
        let start = expression.span.start;
        let token = self.tokens_from(start).find(|token| token.kind == Kind::Prefixed);
        self.replace(token, &format!("cast({number}, '{}')", class(of)));
    }

    fn call(&mut self, expression: &Expression, name: &Name, arguments: &[Argument]) {
        let called = name.text.to_uppercase();
        let known = FUNCTIONS.iter().find(|(of_st, _, _)| *of_st == called);
        let is_own = known.is_none() && functions::function(&called).is_some();
        let has_count = known.is_none_or(|(_, _, count)| *count == arguments.len());
        if known.is_none() && !is_own || !has_count {
            let message = format!("{called}: MATLAB's form has no such function");
            return self.problem(name.span, message, "write it with operators");
        }
        if let Some(named) = arguments.iter().find_map(|one| one.name.as_ref()) {
            let help = "write the values in their order";
            return self.problem(named.span, "MATLAB has no names of arguments", help);
        }
        let token = self.token_at(expression.span.start);
        let token =
            token.filter(|token| token.span == name.span).or(self.token_at(name.span.start));
        self.replace(token, known.map_or(called.as_str(), |(_, matlab, _)| matlab));
        if is_own {
            self.out.functions.insert(called);
        }
        arguments.iter().for_each(|one| self.expression(&one.value, 0));
    }

    fn unary(
        &mut self,
        expression: &Expression,
        operator: UnaryOperator,
        operand: &Expression,
        around: u8,
    ) {
        let words: &[&str] = match operator {
            UnaryOperator::Minus => &["-"],
            UnaryOperator::Not => &["NOT"],
        };
        let token = self.word_at(expression.span.start, words);
        if operator == UnaryOperator::Not && self.type_of(operand).is_some_and(is_bits) {
            self.replace(token, "bitcmp(");
            self.after.entry(operand.span.end).or_default().insert(0, ')');
            return self.expression(operand, 0);
        }
        if operator == UnaryOperator::Not {
            self.replace(token, "~");
        }
        self.brackets(expression, UNARY, around);
        self.expression(operand, UNARY);
    }

    fn binary(
        &mut self,
        expression: &Expression,
        operator: BinaryOperator,
        left: &Expression,
        right: &Expression,
        around: u8,
    ) {
        let types = (self.type_of(left), self.type_of(right));
        let of = common(types.0, types.1);
        let token = self.token_at(left.span.end);
        let Some(name) = function_of(operator, of) else {
            let Some((sign, level)) = infix(operator) else { return };
            if operator == BinaryOperator::Divide && !of.is_some_and(is_real) {
                return self.quotient(left, right, of);
            }
            self.replace(token, sign);
            self.brackets(expression, level, around);
            self.operand(left, of, operator, level);
            return self.operand(right, of, operator, level + 1);
        };
        self.around(left.span.start, &format!("{name}("), right.span.end, ")");
        self.replace(token, ",");
        self.close.extend(token.map(|token| token.span.start));
        self.operand(left, of, operator, 0);
        self.operand(right, of, operator, 0);
    }

    /// A quotient of whole numbers, which ST cuts and MATLAB rounds: it is divided as double.
    fn quotient(&mut self, left: &Expression, right: &Expression, of: Option<DataType>) {
        let class = of.map_or("double", class);
        match class {
            "double" => self.around(left.span.start, "fix(", right.span.end, ")"),
            _ => self.around(left.span.start, &format!("{class}(fix("), right.span.end, "))"),
        }
        self.operand(left, Some(DataType::Real), BinaryOperator::Divide, 8);
        self.operand(right, Some(DataType::Real), BinaryOperator::Divide, 9);
    }

    /// An operand, in the class that the operation is done in.
    fn operand(
        &mut self,
        operand: &Expression,
        of: Option<DataType>,
        operator: BinaryOperator,
        level: u8,
    ) {
        let own = self.type_of(operand);
        let target = match operator {
            BinaryOperator::Power => Some(DataType::Real),
            _ => of,
        };
        let is_cast = own.zip(target).is_some_and(|(own, target)| {
            let (from, to) = (class(own), class(target));
            let is_wanted = to != "double" || is_real(target);
            from != to && from != "double" && from != "logical" && is_wanted
        });
        if !is_cast {
            return self.expression(operand, level);
        }
        let target = target.map_or("double", class);
        self.around(operand.span.start, &format!("{target}("), operand.span.end, ")");
        self.expression(operand, 0);
    }
}

/// The function that does what MATLAB has no operator for.
fn function_of(operator: BinaryOperator, of: Option<DataType>) -> Option<&'static str> {
    let is_of_bits = of.is_some_and(is_bits);
    Some(match operator {
        BinaryOperator::Xor if is_of_bits => "bitxor",
        BinaryOperator::And if is_of_bits => "bitand",
        BinaryOperator::Or if is_of_bits => "bitor",
        BinaryOperator::Xor => "xor",
        BinaryOperator::Modulo => "rem",
        _ => return None,
    })
}

/// The type of what two make: of two the one that has all values of the other.
pub(in crate::matlab) fn common(a: Option<DataType>, b: Option<DataType>) -> Option<DataType> {
    let (Some(first), Some(second)) = (a, b) else { return a.or(b) };
    if is_real(first) || is_real(second) {
        return Some(DataType::Real);
    }
    match (range(first), range(second)) {
        (Some((low, high)), Some((least, most))) if least <= low && high <= most => b,
        _ => a,
    }
}
