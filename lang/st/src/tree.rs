//! The syntax tree: what the text says, before anybody asks what it means.

use diagnostics::Span;

/// A name in the text.
#[derive(Debug, Clone, PartialEq)]
pub struct Name {
    /// As written.
    pub text: String,
    /// Where.
    pub span: Span,
}

/// All of a text.
#[derive(Debug, Clone, Default)]
pub struct File {
    /// Programs, functions and function blocks, in order.
    pub units: Vec<Unit>,
    /// Named types.
    pub types: Vec<TypeDeclaration>,
    /// Sections VAR_GLOBAL at file level.
    pub globals: Vec<Section>,
    /// Lines `//# ...`.
    pub settings: Vec<Span>,
}

/// What kind of unit it is.
#[derive(Debug, Clone)]
pub enum UnitKind {
    /// PROGRAM
    Program,
    /// FUNCTION with the type of its result.
    Function(TypeText),
    /// FUNCTION_BLOCK
    Block,
}

/// A program, function or function block.
#[derive(Debug, Clone)]
pub struct Unit {
    /// Which of them.
    pub kind: UnitKind,
    /// Its name.
    pub name: Name,
    /// All of it.
    pub span: Span,
    /// Its variables.
    pub sections: Vec<Section>,
    /// What is executed at the start of each scan, for each instance (standard blocks only).
    pub every_scan: Vec<Statement>,
    /// Its statements.
    pub body: Vec<Statement>,
}

impl Unit {
    /// Its declarations, of all sections.
    pub fn declarations(&self) -> impl Iterator<Item = &Declaration> {
        self.sections.iter().flat_map(|section| &section.declarations)
    }

    /// The declaration of a variable, by its name in any letter case.
    pub fn declaration(&self, name: &str) -> Option<&Declaration> {
        let is_it = |one: &Name| one.text.eq_ignore_ascii_case(name);
        self.declarations().find(|one| one.names.iter().any(is_it))
    }
}

/// The word that begins a section of variables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SectionKind {
    /// VAR
    Var,
    /// VAR_INPUT
    Input,
    /// VAR_OUTPUT
    Output,
    /// VAR_IN_OUT
    InOut,
    /// VAR_TEMP
    Temp,
    /// VAR_GLOBAL
    Global,
    /// VAR_EXTERNAL
    External,
}

/// A section of variables.
#[derive(Debug, Clone)]
pub struct Section {
    /// Its word.
    pub kind: SectionKind,
    /// CONSTANT
    pub is_constant: bool,
    /// RETAIN
    pub is_retained: bool,
    /// What is in it.
    pub declarations: Vec<Declaration>,
}

/// One or more variables of a type.
#[derive(Debug, Clone)]
pub struct Declaration {
    /// Their names.
    pub names: Vec<Name>,
    /// What is after AT.
    pub at: Option<Name>,
    /// Their type.
    pub of_type: TypeText,
    /// Their initial value.
    pub initial: Option<Expression>,
    /// The pragma `{coarse}`.
    pub coarse: Option<Span>,
}

impl Declaration {
    /// From its first name to the end of its value, or of its type.
    pub fn span(&self) -> Span {
        let start = self.names.first().map_or(self.of_type.span.start, |name| name.span.start);
        let last = self.initial.as_ref().map_or(self.of_type.span, |value| value.span);
        Span { start, end: last.end }
    }
}

/// `Name : type := value` in TYPE.
#[derive(Debug, Clone)]
pub struct TypeDeclaration {
    /// Its name.
    pub name: Name,
    /// All of it.
    pub span: Span,
    /// What it stands for.
    pub of_type: TypeText,
    /// The initial value of its variables.
    pub initial: Option<Expression>,
}

/// A type as written.
#[derive(Debug, Clone)]
pub struct TypeText {
    /// What.
    pub kind: TypeTextKind,
    /// Where.
    pub span: Span,
}

/// What is written for a type.
#[derive(Debug, Clone)]
pub enum TypeTextKind {
    /// A name: `INT`, `Recipe`.
    Named(String),
    /// `STRING[20]`
    Text(Option<Box<Expression>>),
    /// `INT (0..10)`: the type, the lowest and the highest value.
    Range(String, Box<(Expression, Expression)>),
    /// `ARRAY[1..3] OF T`
    Array(Vec<(Expression, Expression)>, Box<TypeText>),
    /// `STRUCT ... END_STRUCT`
    Struct(Vec<Declaration>),
    /// `(A, B := 5)`
    Enumeration(Vec<(Name, Option<Expression>)>),
    /// What could not be read, which is reported already.
    Missing,
}

/// A statement.
#[derive(Debug, Clone)]
pub struct Statement {
    /// What it does.
    pub kind: StatementKind,
    /// Its head: of IF up to THEN.
    pub span: Span,
}

/// What a statement does.
#[derive(Debug, Clone)]
pub enum StatementKind {
    /// `x := e`
    Assign(Expression, Expression),
    /// `B(...)`
    Call(Expression, Vec<Argument>),
    /// Conditions with their statements, and ELSE.
    If(Vec<(Expression, Vec<Statement>)>, Vec<Statement>),
    /// Selector, arms, ELSE.
    Case(Expression, Vec<CaseArm>, Vec<Statement>),
    /// FOR
    For(Box<ForLoop>),
    /// WHILE
    While(Expression, Vec<Statement>),
    /// REPEAT
    Repeat(Vec<Statement>, Expression),
    /// EXIT
    Exit,
    /// CONTINUE
    Continue,
    /// RETURN
    Return,
    /// What follows and has no place of its own belongs to an element of a drawing. No text says
    /// so: front ends of other languages do.
    Element(Element),
    /// Adds the milliseconds since the start of the scan before to an INT, which ends at its
    /// highest number, or a TIME. It is the last statement of its body. No text says so.
    AddElapsed(Expression),
}

/// An element of a drawing, such as a step.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Element {
    /// Its name, which messages tell.
    pub name: String,
    /// What is said about it in the AWL.
    pub title: String,
}

/// `1, 3..5: ...`
#[derive(Debug, Clone)]
pub struct CaseArm {
    /// First and, of a range, last value.
    pub labels: Vec<(Expression, Option<Expression>)>,
    /// What is done.
    pub body: Vec<Statement>,
}

/// `FOR i := a TO b BY s DO`
#[derive(Debug, Clone)]
pub struct ForLoop {
    /// The control variable.
    pub variable: Expression,
    /// Its first value.
    pub from: Expression,
    /// Its last value.
    pub to: Expression,
    /// The step.
    pub by: Option<Expression>,
    /// What is repeated.
    pub body: Vec<Statement>,
}

/// An argument of a call.
#[derive(Debug, Clone)]
pub struct Argument {
    /// The parameter's name.
    pub name: Option<Name>,
    /// `=>`
    pub is_output: bool,
    /// The value, or where the output goes.
    pub value: Expression,
}

/// An expression.
#[derive(Debug, Clone)]
pub struct Expression {
    /// What.
    pub kind: ExpressionKind,
    /// Where.
    pub span: Span,
}

/// What an expression is.
#[derive(Debug, Clone)]
pub enum ExpressionKind {
    /// A whole number without type.
    Integer(i64),
    /// A number with a point.
    Real(f32),
    /// TRUE, FALSE
    Bool(bool),
    /// Milliseconds.
    Duration(i64),
    /// A literal with its type, `INT#5`: the type's name, the value.
    Typed(String, Box<Expression>),
    /// `State#Fill`
    Member(String, Name),
    /// A text, in Windows-1252.
    Text(Vec<u8>),
    /// `%I0.0`, as written without the sign.
    Address(String),
    /// A variable with what is after its name.
    Variable(Name, Vec<Selector>),
    /// A call of a function.
    Call(Name, Vec<Argument>),
    /// An operator before its operand.
    Unary(UnaryOperator, Box<Expression>),
    /// An operator between its operands.
    Binary(BinaryOperator, Box<Expression>, Box<Expression>),
    /// `[1, 2, 3(0)]`: values with how often they are there.
    List(Vec<(i64, Expression)>),
    /// `(a := 1, b := 2)`
    Members(Vec<(Name, Expression)>),
    /// What could not be read, which is reported already.
    Missing,
}

/// What is after the name of a variable.
#[derive(Debug, Clone)]
pub enum Selector {
    /// `.Speed`
    Field(Name),
    /// `[i, j]`
    Index(Vec<Expression>),
}

/// Operators before an operand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnaryOperator {
    /// `-`
    Minus,
    /// `NOT`
    Not,
}

/// Operators between operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum BinaryOperator {
    Power,
    Multiply,
    Divide,
    Modulo,
    Add,
    Subtract,
    Less,
    Greater,
    LessOrEqual,
    GreaterOrEqual,
    Equal,
    NotEqual,
    And,
    Xor,
    Or,
}

impl BinaryOperator {
    /// As written.
    pub fn text(self) -> &'static str {
        use BinaryOperator::*;
        match self {
            Power => "**",
            Multiply => "*",
            Divide => "/",
            Modulo => "MOD",
            Add => "+",
            Subtract => "-",
            Less => "<",
            Greater => ">",
            LessOrEqual => "<=",
            GreaterOrEqual => ">=",
            Equal => "=",
            NotEqual => "<>",
            And => "AND",
            Xor => "XOR",
            Or => "OR",
        }
    }

    /// Whether the result is the answer to a question about two values.
    pub fn is_comparison(self) -> bool {
        use BinaryOperator::*;
        matches!(self, Less | Greater | LessOrEqual | GreaterOrEqual | Equal | NotEqual)
    }

    /// That answer; `None` of operators that do not compare.
    pub fn compare<T: PartialOrd>(self, left: T, right: T) -> Option<bool> {
        use BinaryOperator::*;
        Some(match self {
            Less => left < right,
            Greater => left > right,
            LessOrEqual => left <= right,
            GreaterOrEqual => left >= right,
            Equal => left == right,
            NotEqual => left != right,
            _ => return None,
        })
    }
}
