//! Types, values and variables.

use st::model::ELEMENTARY;
use st::names::is_same;
use st::tree::{Declaration, Expression, ExpressionKind, TypeDeclaration, TypeText, TypeTextKind};

use super::Project;
use super::comments::Comments;

impl Project<'_> {
    /// A named type.
    pub(super) fn declared(&mut self, declared: &TypeDeclaration, comments: &Comments) {
        self.open("dataType", &[("name", &declared.name.text)]);
        self.inside("baseType", &declared.of_type, comments);
        self.initial(declared.initial.as_ref());
        self.documentation(comments.at(declared.name.span));
        self.close();
    }

    /// A type in an element such as `type` or `baseType`.
    pub(super) fn inside(&mut self, element: &str, of_type: &TypeText, comments: &Comments) {
        self.open(element, &[]);
        self.of_type(of_type, comments);
        self.close();
    }

    fn of_type(&mut self, of_type: &TypeText, comments: &Comments) {
        match &of_type.kind {
            TypeTextKind::Named(name) => self.named(name),
            TypeTextKind::Text(length) => match length {
                Some(length) => {
                    let length = self.text(length.span).to_owned();
                    self.out.empty("string", &[("length", &length)]);
                }
                None => self.out.empty("string", &[]),
            },
            TypeTextKind::Range(base, bounds) => {
                let is_unsigned = base.to_uppercase().starts_with('U');
                let name = if is_unsigned { "subrangeUnsigned" } else { "subrangeSigned" };
                self.open(name, &[]);
                self.bounds("range", &bounds.0, &bounds.1);
                self.open("baseType", &[]);
                self.named(base);
                self.close();
                self.close();
            }
            TypeTextKind::Array(dimensions, base) => {
                self.open("array", &[]);
                dimensions.iter().for_each(|(low, high)| self.bounds("dimension", low, high));
                self.inside("baseType", base, comments);
                self.close();
            }
            TypeTextKind::Struct(members) => {
                self.open("struct", &[]);
                members.iter().for_each(|one| self.variables(one, comments));
                self.close();
            }
            TypeTextKind::Enumeration(values) => {
                self.open("enum", &[]);
                self.open("values", &[]);
                for (name, number) in values {
                    let number = number.as_ref().map(|one| self.text(one.span).to_owned());
                    let mut head = vec![("name", name.text.as_str())];
                    head.extend(number.as_deref().map(|number| ("value", number)));
                    self.out.empty("value", &head);
                }
                self.close();
                self.close();
            }
            TypeTextKind::Missing => {}
        }
    }

    fn named(&mut self, name: &str) {
        match ELEMENTARY.iter().find(|(one, _)| is_same(one, name)) {
            Some((one, _)) => self.out.empty(one, &[]),
            None if is_same(name, "STRING") => self.out.empty("string", &[]),
            None => self.out.empty("derived", &[("name", name)]),
        }
    }

    fn bounds(&mut self, element: &str, low: &Expression, high: &Expression) {
        let [low, high] = [low, high].map(|one| self.text(one.span).to_owned());
        self.out.empty(element, &[("lower", &low), ("upper", &high)]);
    }

    /// The variables of a declaration.
    pub(super) fn variables(&mut self, declaration: &Declaration, comments: &Comments) {
        if let Some(pragma) = declaration.coarse {
            self.refuse_coarse(pragma);
        }
        let address = declaration.at.as_ref().map(|at| self.text(at.span).to_owned());
        for name in &declaration.names {
            let mut head = vec![("name", name.text.as_str())];
            head.extend(address.as_deref().map(|address| ("address", address)));
            self.open("variable", &head);
            self.inside("type", &declaration.of_type, comments);
            self.initial(declaration.initial.as_ref());
            self.documentation(comments.at(name.span));
            self.close();
        }
    }

    fn initial(&mut self, initial: Option<&Expression>) {
        if let Some(initial) = initial {
            self.open("initialValue", &[]);
            self.value(initial);
            self.close();
        }
    }

    fn value(&mut self, value: &Expression) {
        match &value.kind {
            ExpressionKind::List(list) => {
                self.open("arrayValue", &[]);
                for (times, one) in list {
                    let times = times.to_string();
                    let head = [("repetitionValue", times.as_str())];
                    self.open("value", if times == "1" { &[] } else { &head });
                    self.value(one);
                    self.close();
                }
                self.close();
            }
            ExpressionKind::Members(list) => {
                self.open("structValue", &[]);
                for (name, one) in list {
                    self.open("value", &[("member", &name.text)]);
                    self.value(one);
                    self.close();
                }
                self.close();
            }
            _ => {
                let text = self.text(value.span).to_owned();
                self.out.empty("simpleValue", &[("value", &text)]);
            }
        }
    }
}
