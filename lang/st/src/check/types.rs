//! Types: from their text to what they are.

use std::sync::Arc;

use diagnostics::Span;

use super::Checker;
use super::names::upper;
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{
    Array, ELEMENTARY, Enumeration, Member, Range, Structure, TEXT_MAX, TEXT_USUAL, Type, UnitKind,
    Value,
};
use crate::names::Named;
use crate::tree::{Declaration, Expression, File, Name, TypeText, TypeTextKind};

/// Bytes of V memory.
const BYTES_MAX: i64 = 10_240;
/// Elements of an array at most: what V memory could hold.
const ELEMENTS_MAX: i64 = BYTES_MAX;
/// Instances of an array at most.
const INSTANCES_MAX: i64 = 256;

impl<'a> Checker<'a> {
    pub(super) fn collect_types(&mut self, files: &[(Option<usize>, &'a File)]) {
        for &(number, file) in files {
            self.file = number;
            for declared in &file.types {
                let name = upper(&declared.name.text);
                if let Some((_, first)) = self.type_texts.get(&name) {
                    let span = first.name.span;
                    self.twice(&declared.name, Some(span).filter(|_| true));
                    continue;
                }
                if ELEMENTARY.iter().any(|(elementary, _)| *elementary == name) {
                    self.twice(&declared.name, None);
                    continue;
                }
                self.note(declared.name.span, Named::Type(name.clone()), true);
                self.type_texts.insert(name, (number, declared));
            }
        }
    }

    /// Every type is looked at, used or not.
    pub(super) fn check_types(&mut self) {
        let mut names: Vec<String> = self.type_texts.keys().cloned().collect();
        names.sort();
        for name in names {
            let Some(&(file, declared)) = self.type_texts.get(&name) else { continue };
            self.file = file;
            self.named(&name, declared.name.span);
        }
    }

    /// Reports that a name is there already.
    pub(super) fn twice(&mut self, name: &Name, first: Option<Span>) {
        let message = format!("{}: there is something of this name already", name.text);
        let mut found = Diagnostic::new(Code::Duplicate, name.span, message);
        if let Some(first) = first {
            found = found.related(first, "the first one");
        }
        self.report(found);
    }

    /// Reports a type that is called like a block or function of the library.
    pub(super) fn type_of_the_library(&mut self, name: &Name) {
        let message = format!("{}: a standard block or function has this name", name.text);
        let found = Diagnostic::new(Code::Duplicate, name.span, message);
        self.report(found.help(format!("another name, such as `{}1`", name.text)));
    }

    /// The type of a name; reported where there is none.
    pub(super) fn named(&mut self, name: &str, span: Span) -> Type {
        let wanted = upper(name);
        if let Some((_, kind)) = ELEMENTARY.iter().find(|(text, _)| *text == wanted) {
            return kind.clone();
        }
        if let Some(&number) = self.unit_names.get(&wanted) {
            let unit = self.program.units.get(number);
            if let Some(unit) = unit.filter(|unit| unit.kind == UnitKind::Block) {
                let kind = Type::Block(number, unit.name.clone());
                self.used.push(number);
                self.note(span, Named::Unit(wanted), false);
                return kind;
            }
        }
        if self.type_texts.contains_key(&wanted) {
            self.note(span, Named::Type(wanted.clone()), false);
        }
        match self.types.get(&wanted) {
            Some(Some(known)) => return known.clone(),
            Some(None) => {
                let message = format!("{name}: a type cannot contain itself");
                self.error(Code::Recursion, span, message);
                return Type::Invalid;
            }
            None => {}
        }
        let Some(&(file, declared)) = self.type_texts.get(&wanted) else {
            self.unknown_type(name, span);
            return Type::Invalid;
        };
        self.types.insert(wanted.clone(), None);
        let around = std::mem::replace(&mut self.file, file);
        let kind = self.type_of(&declared.of_type, &declared.name.text);
        let initial = self.initial(declared.initial.as_ref(), &declared.of_type, &kind);
        self.type_initials.insert(wanted.clone(), initial);
        self.file = around;
        self.types.insert(wanted, Some(kind.clone()));
        kind
    }

    /// The type of a text; `name` is what an enumeration or structure is called.
    pub(super) fn type_of(&mut self, text: &TypeText, name: &str) -> Type {
        match &text.kind {
            TypeTextKind::Named(name) => self.named(name, text.span),
            TypeTextKind::Text(length) => self.string(length.as_deref()),
            TypeTextKind::Range(name, bounds) => self.range(name, bounds, text.span),
            TypeTextKind::Array(bounds, of) => self.array(bounds, of, name),
            TypeTextKind::Struct(members) => self.structure(members, name),
            TypeTextKind::Enumeration(values) => self.enumeration(values, name),
            TypeTextKind::Missing => Type::Invalid,
        }
    }

    /// What a variable is before the first scan: what its declaration says, or its type.
    pub(super) fn initial(
        &mut self,
        written: Option<&Expression>,
        text: &TypeText,
        kind: &Type,
    ) -> Value {
        let of_type = match &text.kind {
            TypeTextKind::Named(name) => self.type_initials.get(&upper(name)),
            _ => None,
        };
        match (written, of_type) {
            (Some(written), of_type) => {
                let around = of_type.cloned().unwrap_or_else(|| kind.initial());
                self.initial_value(written, kind, around)
            }
            (None, Some(value)) => value.clone(),
            (None, None) => kind.initial(),
        }
    }

    fn range(&mut self, name: &str, bounds: &(Expression, Expression), span: Span) -> Type {
        let of = self.named(name, span);
        if !of.is_whole() {
            if of != Type::Invalid {
                let message = format!("{of}: only whole numbers have parts such as INT(0..100)");
                self.error(Code::WrongType, span, message);
            }
            return Type::Invalid;
        }
        let (low, high) = (self.constant(&bounds.0, &of), self.constant(&bounds.1, &of));
        let (Some(Value::Int(low)), Some(Value::Int(high))) = (low, high) else {
            return Type::Invalid;
        };
        if low > high {
            let message = format!("{low}..{high}: the first value of a range is the lower one");
            self.error(Code::BadConstant, bounds.0.span, message);
            return Type::Invalid;
        }
        Type::Range(Arc::new(Range { of, low, high }))
    }

    fn string(&mut self, length: Option<&Expression>) -> Type {
        let Some(text) = length else { return Type::String(TEXT_USUAL) };
        let Some(most) = self.constant_whole(text) else { return Type::Invalid };
        match u8::try_from(most) {
            Ok(most @ 1..=TEXT_MAX) => Type::String(most),
            _ => {
                let message = format!("{most}: a STRING has 1 to {TEXT_MAX} characters");
                self.error(Code::BadConstant, text.span, message);
                Type::Invalid
            }
        }
    }

    fn array(&mut self, bounds: &[(Expression, Expression)], of: &TypeText, name: &str) -> Type {
        let of_type = self.type_of(of, name);
        let mut known = Vec::new();
        let mut count = 1i64;
        for (low, high) in bounds {
            let (Some(first), Some(last)) = (self.index_bound(low), self.index_bound(high)) else {
                return Type::Invalid;
            };
            count = count.saturating_mul((last - first + 1).max(0));
            if !(1..=ELEMENTS_MAX).contains(&count) {
                let message = format!("an array has 1 to {ELEMENTS_MAX} elements");
                self.error(Code::BadConstant, low.span, message);
                return Type::Invalid;
            }
            known.push((first, last));
        }
        match of_type {
            Type::Invalid => Type::Invalid,
            Type::Array(_) if of_type.block().is_some() => {
                let message = "an array of instances is no element of another array";
                let found = Diagnostic::new(Code::NotThere, of.span, message);
                self.report(found.help("one array can have several dimensions"));
                Type::Invalid
            }
            _ if has_text(&of_type) => {
                let message = "an array holds no texts";
                self.error(Code::NotThere, of.span, message);
                Type::Invalid
            }
            Type::Block(..) if count > INSTANCES_MAX => {
                let message = format!("an array has {INSTANCES_MAX} instances at most");
                self.error(Code::BadConstant, of.span, message);
                Type::Invalid
            }
            of_type if count.saturating_mul(of_type.bytes()) > BYTES_MAX => {
                let message = format!("an array has {BYTES_MAX} bytes at most: all of V memory");
                self.error(Code::BadConstant, of.span, message);
                Type::Invalid
            }
            of_type => {
                let initial = self.initial(None, of, &of_type);
                Type::Array(Arc::new(Array { bounds: known, of: of_type, initial }))
            }
        }
    }

    fn index_bound(&mut self, bound: &Expression) -> Option<i64> {
        let value = self.constant_whole(bound)?;
        if i16::try_from(value).is_err() {
            self.error(Code::BadConstant, bound.span, "an index is -32768 to 32767");
            return None;
        }
        Some(value)
    }

    fn structure(&mut self, declarations: &[Declaration], of: &str) -> Type {
        let mut members: Vec<Member> = Vec::new();
        for declared in declarations {
            let of_type = self.type_of(&declared.of_type, of);
            if of_type.block().is_some() {
                let message = "a structure holds no function blocks";
                self.error(Code::NotThere, declared.of_type.span, message);
                continue;
            }
            let initial = self.initial(declared.initial.as_ref(), &declared.of_type, &of_type);
            for name in &declared.names {
                if members.iter().any(|member| upper(&member.name) == upper(&name.text)) {
                    self.twice(name, None);
                    continue;
                }
                let (of_type, initial) = (of_type.clone(), initial.clone());
                self.note(name.span, Named::Member(upper(of), upper(&name.text)), true);
                members.push(Member { name: name.text.clone(), of_type, initial });
            }
        }
        Type::Struct(Arc::new(Structure { name: of.to_owned(), members }))
    }

    fn enumeration(&mut self, values: &[(Name, Option<Expression>)], of: &str) -> Type {
        let mut numbered: Vec<(String, i64)> = Vec::new();
        let mut next = 0;
        for (name, value) in values {
            if numbered.iter().any(|(other, _)| upper(other) == upper(&name.text)) {
                self.twice(name, None);
            }
            if let Some(number) = value.as_ref().and_then(|value| self.constant_whole(value)) {
                next = number;
            }
            if i16::try_from(next).is_err() {
                let message = format!("{}: a number is -32768 to 32767", name.text);
                self.error(Code::BadConstant, name.span, message);
                next = 0;
            }
            self.note(name.span, Named::Value(upper(of), upper(&name.text)), true);
            numbered.push((name.text.clone(), next));
            next += 1;
        }
        Type::Enumeration(Arc::new(Enumeration { name: of.to_owned(), values: numbered }))
    }
}

/// Whether a text is in it.
fn has_text(kind: &Type) -> bool {
    match kind {
        Type::Struct(kind) => kind.members.iter().any(|member| has_text(&member.of_type)),
        kind => matches!(kind, Type::String(_)),
    }
}
