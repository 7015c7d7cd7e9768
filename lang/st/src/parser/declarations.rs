//! Units, sections of variables, types.

use diagnostics::Span;

use super::expressions::joined;
use super::{Failed, Outcome, Parser};
use crate::diagnostic::{Code, Diagnostic};
use crate::habits;
use crate::keywords::{SECTIONS, is_keyword};
use crate::lexer::Kind;
use crate::model::ELEMENTARY;
use crate::tree::{
    Declaration, File, Name, Section, SectionKind, TypeDeclaration, TypeText, TypeTextKind, Unit,
    UnitKind,
};

impl Parser<'_> {
    pub(super) fn file(&mut self) -> File {
        let mut file = File::default();
        while !self.is_at_end() {
            let word = self.word_at(0).to_ascii_uppercase();
            match word.as_str() {
                "PROGRAM" | "FUNCTION" | "FUNCTION_BLOCK" => {
                    if let Ok(unit) = self.unit(&word) {
                        file.units.push(unit);
                    }
                }
                "TYPE" => self.types(&mut file.types),
                "VAR_GLOBAL" => file.globals.extend(self.section()),
                "CONFIGURATION" => self.configuration(&mut file.globals),
                _ => self.outside(&word),
            }
        }
        file
    }

    /// Reports what is outside of all units, up to where one begins.
    fn outside(&mut self, word: &str) {
        let token = self.token();
        let message = match word {
            "CLASS" | "METHOD" | "INTERFACE" | "NAMESPACE" | "RESOURCE" => {
                let message = format!("{word}: there are programs, functions and function blocks");
                self.report(Diagnostic::new(Code::NotThere, token.span, message));
                None
            }
            _ => Some("outside of PROGRAM, FUNCTION, FUNCTION_BLOCK, TYPE and VAR_GLOBAL"),
        };
        if let Some(message) = message {
            let text = super::short(self.text_of(token));
            let found = Diagnostic::new(Code::Syntax, token.span, format!("`{text}`: {message}"));
            let help = habits::help(word);
            self.report(found.help(help.unwrap_or("a program is `PROGRAM Main ... END_PROGRAM`")));
        }
        let begins = ["PROGRAM", "FUNCTION", "FUNCTION_BLOCK", "TYPE", "VAR_GLOBAL"];
        self.step();
        while !self.is_at_end() && !self.is_one_of(&begins) {
            self.step();
        }
    }

    /// Reports CONFIGURATION and passes it over, but for its variables.
    fn configuration(&mut self, globals: &mut Vec<Section>) {
        let message = "CONFIGURATION: each PROGRAM runs once a scan without one";
        let found = Diagnostic::new(Code::NotThere, self.step().span, message);
        self.report(found.help("in place of a TASK `//# scan 20ms` sets the time of a scan"));
        while !self.is_at_end() && !self.take_word("END_CONFIGURATION") {
            match self.word_at(0).eq_ignore_ascii_case("VAR_GLOBAL") {
                true => globals.extend(self.section()),
                false => drop(self.step()),
            }
        }
        self.take_sign(";");
    }

    fn unit(&mut self, word: &str) -> Outcome<Unit> {
        let opened = self.step().span;
        let name = match self.name("a name") {
            Ok(name) => name,
            Err(Failed) => Name { text: String::new(), span: opened },
        };
        let kind = match word {
            "PROGRAM" => UnitKind::Program,
            "FUNCTION_BLOCK" => UnitKind::Block,
            _ => {
                self.no_brackets();
                UnitKind::Function(self.result_type(&name))
            }
        };
        self.no_brackets();
        self.take_sign(";");
        let mut sections = Vec::new();
        let mut at = self.token().span;
        while let Some(section) = self.section() {
            if section.kind == SectionKind::Global {
                let message = format!("VAR_GLOBAL is inside of this {word}: it belongs before it");
                let found = Diagnostic::new(Code::Syntax, at, message);
                self.report(found.help("what this unit alone uses is declared in VAR"));
            }
            sections.push(section);
            at = self.token().span;
        }
        let mut every_scan = Vec::new();
        if self.token().kind == Kind::EveryScan {
            self.step();
            every_scan = self.every_scan();
        }
        let body = self.unit_body(word);
        let end = format!("END_{word}");
        if !self.take_word(&end) {
            self.missing(&end, Some((joined(opened, name.span), "for this one")));
            // The end of another unit is taken for this one's.
            if self.is_one_of(&["END_PROGRAM", "END_FUNCTION", "END_FUNCTION_BLOCK"]) {
                self.step();
            }
        }
        self.take_sign(";");
        let span = joined(opened, self.previous());
        Ok(Unit { kind, name, span, sections, every_scan, body })
    }

    /// Reports parameters in brackets after a unit's name.
    fn no_brackets(&mut self) {
        if !self.is_sign("(") {
            return;
        }
        let open = self.token().span;
        while !self.is_at_end() && !self.take_sign(")") && !self.is_boundary() {
            self.step();
        }
        let message = "there are no brackets after the name of a unit";
        let found = Diagnostic::new(Code::Syntax, joined(open, self.previous()), message);
        self.report(found.help("parameters are declared: `VAR_INPUT x : INT; END_VAR`"));
    }

    /// The statements of a unit, words in them that end nothing reported.
    fn unit_body(&mut self, word: &str) -> Vec<crate::tree::Statement> {
        let ends = ["END_PROGRAM", "END_FUNCTION", "END_FUNCTION_BLOCK"];
        if self.word_at(0).eq_ignore_ascii_case("INITIAL_STEP") {
            let message = "a chart is in a file whose name ends with `.sfc`";
            self.report(Diagnostic::new(Code::NotThere, self.token().span, message));
            while !self.is_at_end() && !self.is_one_of(&ends) {
                self.step();
            }
        }
        let mut body = self.statements();
        let begins = ["PROGRAM", "FUNCTION", "FUNCTION_BLOCK", "TYPE", "VAR_GLOBAL"];
        while !self.is_at_end() && !self.is_one_of(&ends) && !self.is_one_of(&begins) {
            let token = self.step();
            let text = super::short(self.text_of(token));
            let message = match self.token().kind {
                Kind::Sign(":") => format!("`{text}:`: a label stands in CASE, `:=` assigns"),
                _ => format!("`{text}`: nothing is open that it belongs to in this {word}"),
            };
            self.report(Diagnostic::new(Code::Syntax, token.span, message));
            self.skip_statement();
            body.extend(self.statements());
        }
        body
    }

    /// The statement after the pragma.
    fn every_scan(&mut self) -> Vec<crate::tree::Statement> {
        let mut all = self.statements();
        let rest = all.split_off(all.len().min(1));
        // What follows belongs to the body: it is read again.
        if let Some(first) = rest.first() {
            let start = first.span.start;
            self.at = self.tokens.iter().position(|token| token.span.start == start).unwrap_or(0);
        }
        all
    }

    fn result_type(&mut self, name: &Name) -> TypeText {
        if self.take_sign(":") {
            return self.type_text();
        }
        let message = format!("FUNCTION {}: the type of its result is missing", name.text);
        let found = Diagnostic::new(Code::Syntax, name.span, message);
        self.report(found.help(format!("such as `FUNCTION {} : INT`", name.text)));
        TypeText { kind: TypeTextKind::Missing, span: name.span }
    }

    fn section(&mut self) -> Option<Section> {
        let &(_, kind) = SECTIONS.iter().find(|(word, _)| self.is_word(word))?;
        let opened = self.step().span;
        let mut section =
            Section { kind, is_constant: false, is_retained: false, declarations: Vec::new() };
        loop {
            if self.take_word("CONSTANT") {
                section.is_constant = true;
            } else if self.take_word("RETAIN") {
                section.is_retained = true;
            } else if !self.take_word("NON_RETAIN") {
                break;
            }
        }
        section.declarations = self.declarations();
        if !self.take_word("END_VAR") {
            self.missing("END_VAR", Some((opened, "for this one")));
        }
        self.take_sign(";");
        Some(section)
    }

    /// Declarations up to a word that ends them.
    fn declarations(&mut self) -> Vec<Declaration> {
        let mut declarations = Vec::new();
        while self.is_name() || self.token().kind == Kind::Address || self.is_word("AT") {
            match self.declaration() {
                Ok(declaration) => {
                    self.semicolon();
                    declarations.push(declaration);
                }
                Err(Failed) => self.skip_statement(),
            }
            // After an assignment the section's end is what is missing.
            let is_statement =
                matches!(self.ahead(1).kind, Kind::Sign(":=" | "(" | "." | "[" | "="));
            if self.is_name() && is_statement && !is_elementary(self.word_at(2)) {
                break;
            }
        }
        if self.token().kind == Kind::Word && is_keyword(self.word_at(0)) {
            let ends = ["END_VAR", "END_STRUCT"];
            let is_declared = matches!(self.ahead(1).kind, Kind::Sign(":" | ","))
                || self.word_at(1).eq_ignore_ascii_case("AT");
            if is_declared && !self.is_one_of(&ends) {
                let word = self.word_at(0).to_owned();
                let message = format!("{word}: is a word of the language and names no variable");
                self.report(Diagnostic::new(Code::Declaration, self.token().span, message));
                self.step();
                self.skip_statement();
                declarations.extend(self.declarations());
            }
        }
        declarations
    }

    fn declaration(&mut self) -> Outcome<Declaration> {
        let before = self.previous().end;
        if let Some(found) = self.foreign_declaration() {
            self.report(found);
            return Err(Failed);
        }
        let mut names = vec![self.name("a name")?];
        while self.take_sign(",") {
            names.push(self.name("a name")?);
        }
        let mut at = if self.take_word("AT") { Some(self.place()?) } else { None };
        if at.is_some() && self.is_sign(",") {
            self.further_places(&mut names)?;
            at = None;
        }
        if self.is_sign(":=") {
            let span = self.token().span;
            let message = "the type is missing before the initial value";
            let found = Diagnostic::new(Code::Syntax, span, message);
            self.report(found.help("such as `Speed : INT := 5;`"));
            return Err(Failed);
        }
        self.need_sign(":")?;
        let of_type = self.type_text();
        self.no_edge();
        let at = if self.is_word("AT") { Some(self.late_place(&names)?) } else { at };
        let initial = self.initial_value()?;
        let coarse = self.coarse_within(before, self.token().span.start);
        Ok(Declaration { names, at, of_type, initial, coarse })
    }

    /// What is wrong with a declaration in the order of another language.
    fn foreign_declaration(&self) -> Option<Diagnostic> {
        let [first, second] = [self.token(), self.ahead(1)];
        let span = joined(first.span, second.span);
        let [first_text, second_text] = [first, second].map(|token| self.text_of(token));
        let (message, meant, span) = if first.kind == Kind::Address {
            ("a variable has a name", format!("Name AT {first_text}"), first.span)
        } else if self.is_word("AT") {
            ("a variable has a name", format!("Name AT {second_text}"), span)
        } else if is_type(self.word_at(0)) && !is_keyword(second_text) && second.kind == Kind::Word
        {
            let kind = first_text.to_ascii_uppercase();
            let kind = habits::type_name(&kind).unwrap_or(&kind);
            ("the type is after the name", format!("{second_text} : {kind}"), span)
        } else if is_type(self.word_at(1)) {
            ("`:` is between name and type", format!("{first_text} : {second_text}"), span)
        } else if matches!(second.kind, Kind::Sign(":=")) && is_elementary(self.word_at(2)) {
            ("`:` is before a type, `:=` before a value", ":".to_owned(), second.span)
        } else {
            return None;
        };
        Some(Diagnostic::new(Code::Syntax, span, message).suggest(meant))
    }

    /// More names with addresses in one declaration, which all get their type.
    fn further_places(&mut self, names: &mut Vec<Name>) -> Outcome<()> {
        let comma = self.token().span;
        let first = names.first().map_or("", |name| name.text.as_str());
        let message = "a variable with an address has a declaration of its own";
        let found = Diagnostic::new(Code::Syntax, comma, message);
        self.report(found.help(format!("`{first} AT ... : BOOL;`, and so on for the next one")));
        while self.take_sign(",") {
            names.push(self.name("a name")?);
            if self.take_word("AT") {
                self.place()?;
            }
        }
        Ok(())
    }

    /// `BOOL R_EDGE`: inputs that are edges.
    fn no_edge(&mut self) {
        for (word, block) in [("R_EDGE", "R_TRIG"), ("F_EDGE", "F_TRIG")] {
            if self.is_word(word) {
                let message = format!("{word}: inputs are values, not edges");
                let found = Diagnostic::new(Code::NotThere, self.token().span, message);
                self.report(
                    found.help(format!("an instance of {block} in the block finds the edge")),
                );
                self.step();
            }
        }
    }

    /// AT after the type, where it does not belong.
    fn late_place(&mut self, names: &[Name]) -> Outcome<Name> {
        let word = self.step().span;
        let place = self.place()?;
        let name = names.first().map_or("", |name| name.text.as_str());
        let message = "AT is before the type";
        let found = Diagnostic::new(Code::Syntax, joined(word, place.span), message);
        self.report(found.help(format!("`{name} AT %{} : ...;`", place.text)));
        Ok(place)
    }

    /// The pragma `{coarse}` between two places in the text, which is taken.
    fn coarse_within(&mut self, start: u32, end: u32) -> Option<Span> {
        let found = self.coarse.iter().position(|one| one.is_in(Span { start, end }))?;
        Some(self.coarse.remove(found))
    }

    fn initial_value(&mut self) -> Outcome<Option<crate::tree::Expression>> {
        if self.is_sign("=") {
            let span = self.token().span;
            let message = "`=` compares, `:=` gives the initial value";
            self.report(Diagnostic::new(Code::Assignment, span, message).suggest(":="));
            self.step();
        } else if !self.take_sign(":=") {
            return Ok(None);
        }
        self.initial().map(Some)
    }

    /// What is after AT: `%I0.0` or `I0.0`, which is cut in two at the point.
    fn place(&mut self) -> Outcome<Name> {
        let first = self.step();
        if !matches!(first.kind, Kind::Address | Kind::Word) {
            return Err(self.expected("an address such as %I0.0"));
        }
        let mut span = first.span;
        if first.kind == Kind::Word && self.is_sign(".") {
            self.step();
            span = joined(span, self.step().span);
        }
        let text = span.text(self.text);
        Ok(Name { text: text.strip_prefix('%').unwrap_or(text).to_owned(), span })
    }

    fn types(&mut self, types: &mut Vec<TypeDeclaration>) {
        let opened = self.step().span;
        while self.is_name() {
            match self.type_declaration() {
                Ok(declared) => {
                    self.semicolon();
                    types.push(declared);
                }
                Err(Failed) => self.skip_statement(),
            }
        }
        if !self.take_word("END_TYPE") {
            self.missing("END_TYPE", Some((opened, "for this one")));
        }
        self.take_sign(";");
    }

    fn type_declaration(&mut self) -> Outcome<TypeDeclaration> {
        let name = self.name("a name")?;
        self.need_sign(":")?;
        let of_type = self.type_text();
        let initial = self.initial_value()?;
        let span = joined(name.span, self.previous());
        Ok(TypeDeclaration { name, span, of_type, initial })
    }

    /// A type. What cannot be read is reported.
    fn type_text(&mut self) -> TypeText {
        let start = self.token().span;
        let kind = self.deeper(Parser::type_kind).unwrap_or_else(|Failed| {
            while !self.is_at_end() && !self.is_sign(";") && !self.is_boundary() {
                self.step();
            }
            TypeTextKind::Missing
        });
        TypeText { kind, span: joined(start, self.previous()) }
    }

    fn type_kind(&mut self) -> Outcome<TypeTextKind> {
        if self.take_word("ARRAY") {
            return self.array();
        }
        if self.is_word("STRUCT") {
            let opened = self.step().span;
            let mut members = self.declarations();
            self.coarse.extend(members.iter_mut().filter_map(|member| member.coarse.take()));
            if !self.take_word("END_STRUCT") {
                self.missing("END_STRUCT", Some((opened, "for this one")));
            }
            return Ok(TypeTextKind::Struct(members));
        }
        if self.take_sign("(") {
            return self.enumeration();
        }
        let name = self.name("a type")?;
        if name.text.eq_ignore_ascii_case("STRING") {
            let close = if self.is_sign("(") { ")" } else { "]" };
            let mut length = None;
            if self.take_sign("(") || self.take_sign("[") {
                length = Some(Box::new(self.expression()?));
                self.need_sign(close)?;
            }
            return Ok(TypeTextKind::Text(length));
        }
        if self.take_sign("(") {
            let low = self.expression()?;
            self.need_sign("..")?;
            let high = self.expression()?;
            self.need_sign(")")?;
            return Ok(TypeTextKind::Range(name.text, Box::new((low, high))));
        }
        if self.is_sign("[") || habits::is_pointer(&name.text) {
            let (message, help) = match self.is_sign("[") {
                true => ("an array begins with ARRAY", format!("`ARRAY[0..9] OF {}`", name.text)),
                false => ("there are no pointers", "a VAR_IN_OUT passes a variable".to_owned()),
            };
            self.report(Diagnostic::new(Code::NotThere, name.span, message).help(help));
            return Err(Failed);
        }
        Ok(TypeTextKind::Named(name.text))
    }

    fn array(&mut self) -> Outcome<TypeTextKind> {
        self.need_sign("[")?;
        let mut bounds = Vec::new();
        loop {
            let low = self.expression()?;
            if self.is_sign("]") {
                let message = "an array has a first and a last index";
                let found = Diagnostic::new(Code::Syntax, low.span, message);
                self.report(found.help("of five elements such as `ARRAY[0..4] OF INT`"));
                return Err(Failed);
            }
            self.need_sign("..")?;
            bounds.push((low, self.expression()?));
            if !self.take_sign(",") {
                break;
            }
        }
        self.need_sign("]")?;
        self.need_word("OF")?;
        Ok(TypeTextKind::Array(bounds, Box::new(self.type_text())))
    }

    fn enumeration(&mut self) -> Outcome<TypeTextKind> {
        let mut values = Vec::new();
        loop {
            let name = self.name("a name")?;
            let value = if self.take_sign(":=") { Some(self.expression()?) } else { None };
            values.push((name, value));
            if !self.take_sign(",") {
                break;
            }
        }
        self.need_sign(")")?;
        Ok(TypeTextKind::Enumeration(values))
    }
}

/// Whether a word names an elementary type, here or in another language.
fn is_type(word: &str) -> bool {
    habits::type_name(word).is_some() || is_elementary(word)
}

fn is_elementary(word: &str) -> bool {
    ELEMENTARY.iter().any(|(name, _)| name.eq_ignore_ascii_case(word))
}
