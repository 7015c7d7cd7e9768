//! Calls in expressions: functions of the program, standard functions, conversions.

use diagnostics::Span;

use super::Checker;
use super::arguments::place;
use super::expressions::{invalid, known};
use super::names::upper;
use crate::diagnostic::{Code, Diagnostic};
use crate::fold;
use crate::model::{
    BinaryOperator, ELEMENTARY, Expression, ExpressionKind, Function, SectionKind, TEXT_MAX, Type,
    UnitKind, Value,
};
use crate::names::Named;
use crate::standard::Standard;
use crate::tree::{Argument, Name};

/// Functions that are an operator between all their arguments.
const OPERATORS: [(&str, BinaryOperator); 14] = [
    ("ADD", BinaryOperator::Add),
    ("SUB", BinaryOperator::Subtract),
    ("MUL", BinaryOperator::Multiply),
    ("DIV", BinaryOperator::Divide),
    ("MOD", BinaryOperator::Modulo),
    ("AND", BinaryOperator::And),
    ("OR", BinaryOperator::Or),
    ("XOR", BinaryOperator::Xor),
    ("GT", BinaryOperator::Greater),
    ("GE", BinaryOperator::GreaterOrEqual),
    ("EQ", BinaryOperator::Equal),
    ("LE", BinaryOperator::LessOrEqual),
    ("LT", BinaryOperator::Less),
    ("NE", BinaryOperator::NotEqual),
];

/// Functions of a REAL.
const OF_REAL: [(&str, Function); 6] = [
    ("SQRT", Function::Sqrt),
    ("LN", Function::Ln),
    ("EXP", Function::Exp),
    ("SIN", Function::Sin),
    ("COS", Function::Cos),
    ("TAN", Function::Tan),
];

/// The only parameter of a conversion; it takes several types.
const OF_CONVERSION: &[(&str, &str)] = &[("IN", "")];

const SHIFTS: [(&str, Function); 4] = [
    ("SHL", Function::Shl),
    ("SHR", Function::Shr),
    ("ROL", Function::Rol),
    ("ROR", Function::Ror),
];

fn in_table<T: Copy>(table: &[(&str, T)], name: &str) -> Option<T> {
    table.iter().find(|(text, _)| *text == name).map(|(_, found)| *found)
}

impl Checker<'_> {
    pub(super) fn function_call(
        &mut self,
        name: &Name,
        arguments: &[Argument],
        wanted: Option<&Type>,
        span: Span,
    ) -> Expression {
        let text = upper(&name.text);
        // The library means the standard functions, whatever is called like them.
        let own = match self.file {
            Some(_) => self.unit_names.get(&text).copied(),
            None => self.library(&text),
        };
        if let Some(number) = own {
            let kind = self.program.units.get(number).map(|unit| unit.kind);
            if kind == Some(UnitKind::Function) {
                self.note(name.span, Named::Unit(text), false);
                return self.own_function(number, arguments, span);
            }
        }
        if let Some((_, Type::Block(..))) = self.variable(&name.text) {
            let message = format!("{}: a function block is no value", name.text);
            let found = Diagnostic::new(Code::SideEffect, span, message);
            self.report(found.help("call it in a statement of its own, then read its outputs"));
            return invalid(span);
        }
        if let Some((from, to)) = conversion(&text) {
            return self.conversion(name, from, to, arguments, span);
        }
        self.standard(name, &text, arguments, wanted, span)
    }

    /// Reports a wrong number of arguments.
    pub(super) fn has_count(
        &mut self,
        name: &Name,
        given: usize,
        least: usize,
        most: usize,
    ) -> bool {
        let fits = (least..=most).contains(&given);
        if !fits {
            let wanted = match (least, most) {
                (1, 1) => "1 argument".to_owned(),
                (a, b) if a == b => format!("{a} arguments"),
                (a, usize::MAX) => format!("{a} arguments or more"),
                (a, b) => format!("{a} to {b} arguments"),
            };
            let message = format!("{}: {wanted} needed, {given} given", name.text);
            self.error(Code::Arguments, name.span, message);
        }
        fits
    }

    fn own_function(&mut self, number: usize, arguments: &[Argument], span: Span) -> Expression {
        let Some(unit) = self.program.units.get(number).cloned() else { return invalid(span) };
        self.used.push(number);
        let inputs: Vec<_> =
            unit.variables.iter().filter(|one| one.section == SectionKind::Input).collect();
        let result = unit.variables.last().map_or(Type::Invalid, |one| one.of_type.base().clone());
        let mut given: Vec<Option<Expression>> = vec![None; inputs.len()];
        let mut are_right = true;
        for (at, argument) in arguments.iter().enumerate() {
            if self.is_output(&unit.name, argument) {
                are_right = false;
                continue;
            }
            let slot = match &argument.name {
                None => at,
                Some(name) => {
                    let same = inputs.iter().position(|one| upper(&one.name) == upper(&name.text));
                    let Some(slot) = same else {
                        let message = format!("{}: {} has no such input", name.text, unit.name);
                        self.error(Code::Arguments, name.span, message);
                        are_right = false;
                        continue;
                    };
                    if let Some(input) = inputs.get(slot) {
                        self.note(name.span, Named::of_unit(&unit, input), false);
                    }
                    slot
                }
            };
            let Some(input) = inputs.get(slot) else {
                let message = format!("{}: {} arguments needed", unit.name, inputs.len());
                self.error(Code::Arguments, argument.value.span, message);
                break;
            };
            let value = self.value_of(&argument.value, &input.of_type);
            match given.get_mut(slot) {
                Some(Some(_)) => self.given_twice(&input.name, place(argument)),
                Some(free) => *free = Some(value),
                None => {}
            }
        }
        let mut all = Vec::new();
        for (input, value) in inputs.iter().zip(given) {
            match value {
                Some(value) => all.push(value),
                None if input.has_initial => {
                    all.push(known(input.initial.clone(), input.of_type.base().clone(), span));
                }
                None => {
                    // What is wrong with the arguments may be why.
                    if are_right {
                        let message = format!("{}: {} is not given", unit.name, input.name);
                        self.error(Code::Arguments, span, message);
                    }
                    return invalid(span);
                }
            }
        }
        Expression { kind: ExpressionKind::Call(number, all), of_type: result, span }
    }

    fn standard(
        &mut self,
        name: &Name,
        text: &str,
        arguments: &[Argument],
        wanted: Option<&Type>,
        span: Span,
    ) -> Expression {
        let Some(function) = Standard::find(text) else {
            self.unknown_name(name, "function");
            return invalid(span);
        };
        let given = self.in_order(name, function.parameters, arguments, span);
        let Some(given) = given else { return invalid(span) };
        let count = given.len();
        if let Some(operator) = in_table(&OPERATORS, text) {
            let most = if matches!(text, "SUB" | "DIV" | "MOD" | "NE") { 2 } else { usize::MAX };
            if !self.has_count(name, count, 2, most) {
                return invalid(span);
            }
            let values =
                self.common_values(&given, if operator.is_comparison() { None } else { wanted });
            return self.chain(operator, values, span);
        }
        if let Some(function) = in_table(&OF_REAL, text) {
            return self.of_one(name, function, &given, Some(&Type::Real), span);
        }
        if let Some(function) = in_table(&SHIFTS, text) {
            return self.shift(name, function, &given, wanted, span);
        }
        if let Some(found) = self.text_function(name, text, &given, span) {
            return found;
        }
        match text {
            "ABS" => self.of_one(name, Function::Abs, &given, None, span),
            "TRUNC" => self.of_one(name, Function::Trunc, &given, Some(&Type::Real), span),
            "MOVE" if self.has_count(name, count, 1, 1) => match given.first() {
                Some(one) => self.expression(&one.value, wanted),
                None => invalid(span),
            },
            "EXPT" if self.has_count(name, count, 2, 2) => {
                let values: Vec<Expression> = given
                    .iter()
                    .map(|one| self.expression(&one.value, Some(&Type::Real)))
                    .collect();
                self.chain(BinaryOperator::Power, values, span)
            }
            "MIN" | "MAX" | "LIMIT" => self.choice(name, text, &given, wanted, span),
            "SEL" | "MUX" => self.select(name, text, &given, wanted, span),
            _ => invalid(span),
        }
    }

    /// Arguments of one common type.
    fn common_values(&mut self, given: &[&Argument], wanted: Option<&Type>) -> Vec<Expression> {
        let mut values: Vec<Expression> =
            given.iter().map(|one| self.expression(&one.value, wanted)).collect();
        let widest = values
            .iter()
            .map(|value| value.of_type.clone())
            .reduce(|widest, next| if widest.widens_to(&next) { next } else { widest });
        let Some(widest) = widest else { return values };
        for (value, one) in values.iter_mut().zip(given) {
            if value.of_type != widest {
                *value = match value.kind {
                    // A literal, once more with its type.
                    ExpressionKind::Constant(_) => self.value_of(&one.value, &widest),
                    _ => self.coerce(value.clone(), &widest),
                };
            }
        }
        values
    }

    fn chain(
        &mut self,
        operator: BinaryOperator,
        values: Vec<Expression>,
        span: Span,
    ) -> Expression {
        let mut values = values.into_iter();
        let Some(first) = values.next() else { return invalid(span) };
        if !operator.is_comparison() {
            return values.fold(first, |left, right| self.combine(operator, left, right, span));
        }
        // a > b > c
        let mut left = first;
        let mut all: Option<Expression> = None;
        for right in values {
            let one = self.combine(operator, left, right.clone(), span);
            all = Some(match all {
                None => one,
                Some(before) => self.combine(BinaryOperator::And, before, one, span),
            });
            left = right;
        }
        all.unwrap_or_else(|| invalid(span))
    }

    fn of_one(
        &mut self,
        name: &Name,
        function: Function,
        given: &[&Argument],
        wanted: Option<&Type>,
        span: Span,
    ) -> Expression {
        if !self.has_count(name, given.len(), 1, 1) {
            return invalid(span);
        }
        let Some(one) = given.first() else { return invalid(span) };
        let value = match wanted {
            Some(wanted) => self.value_of(&one.value, wanted),
            None => self.expression(&one.value, None),
        };
        if value.of_type == Type::Invalid {
            return value;
        }
        if !value.of_type.is_number() {
            let kind = value.of_type.with_article();
            let message = format!("{}: a number is needed, this is {kind}", name.text);
            self.error(Code::WrongType, value.span, message);
            return invalid(span);
        }
        if function == Function::Abs && value.of_type.is_unsigned() {
            return value;
        }
        let of_type = match function {
            Function::Trunc => Type::Dint,
            _ => value.of_type.clone(),
        };
        self.known_or(function, vec![value], of_type, span)
    }

    /// A standard function, computed where its arguments are known.
    fn known_or(
        &mut self,
        function: Function,
        arguments: Vec<Expression>,
        of_type: Type,
        span: Span,
    ) -> Expression {
        if arguments.iter().any(|one| one.of_type == Type::Invalid) {
            return invalid(span);
        }
        let values: Option<Vec<Value>> = arguments
            .iter()
            .map(|one| match &one.kind {
                ExpressionKind::Constant(value) => Some(value.clone()),
                _ => None,
            })
            .collect();
        if let Some(value) = values.and_then(|values| fold::function(function, &of_type, &values)) {
            return known(value, of_type, span);
        }
        Expression { kind: ExpressionKind::Standard(function, arguments), of_type, span }
    }

    fn shift(
        &mut self,
        name: &Name,
        function: Function,
        given: &[&Argument],
        wanted: Option<&Type>,
        span: Span,
    ) -> Expression {
        if !self.has_count(name, given.len(), 2, 2) {
            return invalid(span);
        }
        let [bits, count] = given else { return invalid(span) };
        let bits = self.expression(&bits.value, wanted);
        let count = self.value_of(&count.value, &Type::Int);
        if !bits.of_type.is_bits() && bits.of_type != Type::Invalid {
            let message = format!("{}: BYTE, WORD or DWORD is needed", name.text);
            let found = Diagnostic::new(Code::WrongType, bits.span, message);
            self.report(found.help(format!("{}_TO_WORD(...) has the bits", bits.of_type)));
            return invalid(span);
        }
        let of_type = bits.of_type.clone();
        self.known_or(function, vec![bits, count], of_type, span)
    }

    fn choice(
        &mut self,
        name: &Name,
        text: &str,
        given: &[&Argument],
        wanted: Option<&Type>,
        span: Span,
    ) -> Expression {
        let (least, most) = if text == "LIMIT" { (3, 3) } else { (2, usize::MAX) };
        if !self.has_count(name, given.len(), least, most) {
            return invalid(span);
        }
        let values = self.common_values(given, wanted);
        let of_type = values.first().map_or(Type::Invalid, |one| one.of_type.clone());
        let suits = of_type.is_number() || matches!(of_type, Type::Time | Type::Invalid);
        if !suits {
            let message = format!("{text}: numbers are needed, these are {of_type}");
            self.error(Code::WrongType, span, message);
            return invalid(span);
        }
        match (text, values.as_slice()) {
            ("LIMIT", [low, value, high]) => {
                let both = vec![value.clone(), low.clone()];
                let raised = self.known_or(Function::Max, both, of_type.clone(), span);
                self.known_or(Function::Min, vec![raised, high.clone()], of_type, span)
            }
            ("MIN", _) => self.known_or(Function::Min, values, of_type, span),
            _ => self.known_or(Function::Max, values, of_type, span),
        }
    }

    fn select(
        &mut self,
        name: &Name,
        text: &str,
        given: &[&Argument],
        wanted: Option<&Type>,
        span: Span,
    ) -> Expression {
        let (least, most) = if text == "SEL" { (3, 3) } else { (3, usize::MAX) };
        if !self.has_count(name, given.len(), least, most) {
            return invalid(span);
        }
        let Some((first, rest)) = given.split_first() else { return invalid(span) };
        let (kind, function) = match text {
            "SEL" => (Type::Bool, Function::Sel),
            _ => (Type::Int, Function::Mux),
        };
        let mut all = vec![self.value_of(&first.value, &kind)];
        all.extend(self.common_values(rest, wanted));
        let of_type = all.last().map_or(Type::Invalid, |one| one.of_type.clone());
        if !of_type.is_elementary() || of_type.characters() > 0 {
            let message = format!("{text}: elementary values are needed, these are {of_type}");
            self.error(Code::NotThere, span, message);
            return invalid(span);
        }
        self.known_or(function, all, of_type, span)
    }

    /// `A_TO_B`, `TO_B`.
    fn conversion(
        &mut self,
        name: &Name,
        from: Option<Type>,
        to: Type,
        arguments: &[Argument],
        span: Span,
    ) -> Expression {
        let given = self.in_order(name, OF_CONVERSION, arguments, span);
        let Some(given) = given else { return invalid(span) };
        if !self.has_count(name, given.len(), 1, 1) {
            return invalid(span);
        }
        let Some(one) = given.first() else { return invalid(span) };
        let value = match &from {
            Some(from) => self.value_of(&one.value, from),
            None => self.expression(&one.value, None),
        };
        // The number of a value of an enumeration is an INT.
        let value = match value.of_type {
            Type::Enumeration(_) if to.is_whole() => Expression { of_type: Type::Int, ..value },
            _ => value,
        };
        if value.of_type == Type::Invalid {
            return value;
        }
        if let Some(found) = self.text_conversion(value.clone(), &to) {
            return found;
        }
        let of_type = &value.of_type;
        let is_number = |kind: &Type| kind.is_number() || *kind == Type::Time;
        let exists = match of_type {
            Type::Bool => is_number(&to) || to.is_bits() || to == Type::Bool,
            kind if is_number(kind) => {
                is_number(&to) || to == Type::Bool || kind.is_whole() && to.is_bits()
            }
            kind if kind.is_bits() => to.is_bits() || to.is_whole() || to == Type::Bool,
            _ => false,
        };
        if !exists {
            let message = format!("{}: there is no conversion from {of_type} to {to}", name.text);
            self.error(Code::WrongType, span, message);
            return invalid(span);
        }
        let converted = self.convert_if(value, &to);
        Expression { span, ..converted }
    }
}

/// The types in the name of a conversion.
fn conversion(name: &str) -> Option<(Option<Type>, Type)> {
    let kind = |text: &str| match text {
        "STRING" => Some(Type::String(TEXT_MAX)),
        _ => ELEMENTARY.iter().find(|(name, _)| *name == text).map(|(_, kind)| kind.clone()),
    };
    if let Some(to) = name.strip_prefix("TO_") {
        return Some((None, kind(to)?));
    }
    let (from, to) = name.split_once("_TO_")?;
    Some((Some(kind(from)?), kind(to)?))
}
