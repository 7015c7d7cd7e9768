//! From syntax trees to a checked program: names, types, constants, rules. What is wrong in one
//! statement does not keep the next from being checked.

mod arguments;
mod calls;
mod constants;
mod declarations;
mod expressions;
mod functions;
mod loops;
mod names;
mod operators;
mod places;
mod recursion;
mod statements;
mod texts;
mod types;
mod unrolled;
mod unwritten;

use std::collections::HashMap;
use std::ops::Range;
use std::sync::OnceLock;

use diagnostics::{Source, Span};

pub(crate) use recursion::{each_assignment, each_expression, inside};

use crate::around::Around;
use crate::diagnostic::{Code, Diagnostic};
use crate::library;
use crate::model::{Program, Type, Unit, UnitKind, Value, Variable};
use crate::names::{Name, Named};
use crate::parser;
use crate::tree;

/// What the checker finds out.
pub(crate) struct Checked {
    pub(crate) program: Program,
    pub(crate) diagnostics: Vec<(usize, Diagnostic)>,
    pub(crate) names: Vec<Name>,
}

/// Checks the files of a program.
pub(crate) fn check(sources: &[Source], files: &[tree::File], around: &Around) -> Checked {
    let standard = STANDARD.get_or_init(standard);
    let used = library::used(files);
    let mut checker = Checker {
        around,
        program: Program::default(),
        types: HashMap::new(),
        type_initials: HashMap::new(),
        type_texts: HashMap::new(),
        unit_names: HashMap::new(),
        used: Vec::new(),
        diagnostics: Vec::new(),
        names: Vec::new(),
        file: None,
        unit: None,
        loops: Vec::new(),
        unrolled: Vec::new(),
        instances: Vec::new(),
    };
    for (source, file) in sources.iter().zip(files) {
        let settings = file.settings.iter().map(|span| span.text(&source.text).to_owned());
        checker.program.settings.extend(settings);
    }
    let of_library = standard.iter().chain(used).map(|file| (None, file));
    let all: Vec<(Option<usize>, &tree::File)> =
        (0..).map(Some).zip(files).chain(of_library).collect();
    checker.collect_types(&all);
    checker.collect_units(&all);
    checker.collect_globals(&all);
    checker.declare_units(&all);
    checker.instances();
    checker.bodies(&all);
    checker.recursion();
    checker.written_in_two_programs();
    checker.read_before_written();
    let Checker { program, diagnostics, mut names, .. } = checker;
    names.sort_by_key(|name| (name.file, name.span, !name.declares));
    // Some expressions are looked at twice.
    names.dedup_by_key(|name| (name.file, name.span));
    Checked { program, diagnostics, names }
}

/// The trees of [`standard`], read once.
static STANDARD: OnceLock<[tree::File; 2]> = OnceLock::new();

/// The standard blocks, and functions that no instruction computes.
fn standard() -> [tree::File; 2] {
    [crate::standard::BLOCKS, include_str!("../functions.st")].map(|text| {
        let source = Source::new("standard.st", text).ok();
        source.map(|source| parser::parse(&source).0).unwrap_or_default()
    })
}

pub(crate) struct Checker<'a> {
    pub(crate) around: &'a Around,
    pub(crate) program: Program,
    /// Types by name, upper case; `None` while one is being read.
    types: HashMap<String, Option<Type>>,
    /// The initial values of variables of these types.
    type_initials: HashMap<String, Value>,
    type_texts: HashMap<String, (Option<usize>, &'a tree::TypeDeclaration)>,
    /// Units by name, upper case.
    unit_names: HashMap<String, usize>,
    /// The units that are called or instantiated.
    used: Vec<usize>,
    diagnostics: Vec<(usize, Diagnostic)>,
    /// The names that were found.
    names: Vec<Name>,
    /// The file that is being checked; `None`: the standard blocks and those of the library.
    file: Option<usize>,
    /// The unit that is being checked.
    unit: Option<usize>,
    /// The control variables of the loops around; `None` of WHILE and REPEAT.
    loops: Vec<Option<String>>,
    /// The loops around that are taken for their passes.
    unrolled: Vec<Unrolled>,
    /// Initial values of instances, for when all blocks are declared.
    instances: Vec<Instances<'a>>,
}

/// Instances whose declaration gives their inputs initial values.
struct Instances<'a> {
    file: Option<usize>,
    /// The unit that declares them; `None`: they are global.
    unit: Option<usize>,
    /// Their numbers among the variables there.
    variables: Range<usize>,
    /// The initial values.
    members: &'a [(tree::Name, tree::Expression)],
}

/// A loop that is taken for its passes.
struct Unrolled {
    /// Its variable, upper case.
    name: String,
    /// What the variable is in this pass.
    value: i64,
    /// Passes of this loop and those around.
    passes: i64,
}

impl Checker<'_> {
    pub(crate) fn report(&mut self, diagnostic: Diagnostic) {
        if let Some(file) = self.file {
            self.diagnostics.push((file, diagnostic));
        } else {
            debug_assert!(false, "a block of the library: {}", diagnostic.message);
        }
    }

    /// Notes what a name stands for.
    pub(crate) fn note(&mut self, span: Span, of: Named, declares: bool) {
        if let Some(file) = self.file {
            self.names.push(Name { file, span, of, declares });
        }
    }

    pub(crate) fn error(&mut self, code: Code, span: Span, message: impl Into<String>) {
        self.report(Diagnostic::new(code, span, message));
    }

    pub(crate) fn unit(&self) -> Option<&Unit> {
        self.program.units.get(self.unit?)
    }

    pub(crate) fn is_in_function(&self) -> bool {
        self.unit().is_some_and(|unit| unit.kind == UnitKind::Function)
    }

    pub(crate) fn locals(&self) -> &[Variable] {
        self.unit().map_or(&[], |unit| &unit.variables)
    }
}
