//! A checked program: names resolved, every expression with its type, every conversion explicit.

use std::fmt;
use std::sync::Arc;

use diagnostics::Span;

pub use crate::tree::{BinaryOperator, Element, SectionKind};

/// A type.
#[derive(Debug, Clone, PartialEq)]
pub enum Type {
    /// FALSE or TRUE.
    Bool,
    /// 8 bits.
    Byte,
    /// 16 bits.
    Word,
    /// 32 bits.
    Dword,
    /// -128 to 127.
    Sint,
    /// 0 to 255.
    Usint,
    /// -32768 to 32767.
    Int,
    /// 0 to 65535.
    Uint,
    /// -2147483648 to 2147483647.
    Dint,
    /// 0 to 4294967295.
    Udint,
    /// An IEEE 754 single.
    Real,
    /// Milliseconds, as DINT.
    Time,
    /// One of several names, stored as INT.
    Enumeration(Arc<Enumeration>),
    /// Part of the whole numbers of a type. Places alone have it: a value is of the type itself.
    Range(Arc<Range>),
    /// So many characters at most.
    String(u8),
    /// Elements of one type.
    Array(Arc<Array>),
    /// Members.
    Struct(Arc<Structure>),
    /// An instance of the function block with this index in [`Program::units`].
    Block(usize, String),
    /// Something that is reported already.
    Invalid,
}

/// The names of an enumeration.
#[derive(Debug, PartialEq)]
pub struct Enumeration {
    /// Its name.
    pub name: String,
    /// Its values with their numbers.
    pub values: Vec<(String, i64)>,
}

/// Part of the whole numbers of a type.
#[derive(Debug, PartialEq)]
pub struct Range {
    /// The type.
    pub of: Type,
    /// The lowest value.
    pub low: i64,
    /// The highest value.
    pub high: i64,
}

/// An array type.
#[derive(Debug)]
pub struct Array {
    /// Lowest and highest index of each dimension.
    pub bounds: Vec<(i64, i64)>,
    /// The type of the elements.
    pub of: Type,
    /// The initial value of each.
    pub initial: Value,
}

impl PartialEq for Array {
    /// Initial values make no other type.
    fn eq(&self, other: &Self) -> bool {
        self.bounds == other.bounds && self.of == other.of
    }
}

/// A structure type.
#[derive(Debug, PartialEq)]
pub struct Structure {
    /// Its name.
    pub name: String,
    /// Its members with their initial values.
    pub members: Vec<Member>,
}

/// A member of a structure.
#[derive(Debug, PartialEq)]
pub struct Member {
    /// Its name.
    pub name: String,
    /// Its type.
    pub of_type: Type,
    /// Its initial value.
    pub initial: Value,
}

/// A value that is known.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// Of BOOL.
    Bool(bool),
    /// Of whole numbers, bit strings (without sign), TIME, enumerations.
    Int(i64),
    /// Of REAL.
    Real(f32),
    /// Characters of Windows-1252.
    Text(Vec<u8>),
    /// Of an array, row after row, or of a structure's members.
    List(Vec<Value>),
}

/// The elementary types by their names.
pub const ELEMENTARY: [(&str, Type); 12] = [
    ("BOOL", Type::Bool),
    ("BYTE", Type::Byte),
    ("WORD", Type::Word),
    ("DWORD", Type::Dword),
    ("SINT", Type::Sint),
    ("USINT", Type::Usint),
    ("INT", Type::Int),
    ("UINT", Type::Uint),
    ("DINT", Type::Dint),
    ("UDINT", Type::Udint),
    ("REAL", Type::Real),
    ("TIME", Type::Time),
];

/// Characters of a text at most, and of a STRING whose text does not say.
pub const TEXT_MAX: u8 = 254;
pub(crate) const TEXT_USUAL: u8 = 80;
/// Characters of a constant text at most (docs/s7-200.md 1.10).
pub(crate) const LITERAL_MAX: usize = 126;

impl fmt::Display for Type {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Type::Enumeration(kind) => f.write_str(&kind.name),
            Type::Struct(kind) => f.write_str(&kind.name),
            Type::Block(_, name) => f.write_str(name),
            Type::String(most) => write!(f, "STRING[{most}]"),
            Type::Range(range) => write!(f, "{}({}..{})", range.of, range.low, range.high),
            Type::Array(array) => {
                f.write_str("ARRAY[")?;
                for (number, (low, high)) in array.bounds.iter().enumerate() {
                    write!(f, "{}{low}..{high}", if number > 0 { ", " } else { "" })?;
                }
                write!(f, "] OF {}", array.of)
            }
            Type::Invalid => f.write_str("?"),
            _ => {
                let found = ELEMENTARY.iter().find(|(_, kind)| kind == self);
                f.write_str(found.map_or("?", |(name, _)| name))
            }
        }
    }
}

impl Type {
    /// Its name in a sentence: `a BOOL`, `an INT`.
    pub(crate) fn with_article(&self) -> String {
        let name = self.to_string();
        let article = if name.starts_with(['A', 'E', 'I', 'O']) { "an" } else { "a" };
        format!("{article} {name}")
    }

    /// The type of the values: of a part of a type's numbers that type.
    pub fn base(&self) -> &Type {
        match self {
            Type::Range(range) => &range.of,
            _ => self,
        }
    }

    /// How many characters a text has at most.
    pub fn characters(&self) -> u8 {
        match self {
            Type::String(most) => *most,
            _ => 0,
        }
    }

    /// The lowest and highest value of a type with whole numbers; of bit strings without sign.
    pub fn range(&self) -> Option<(i64, i64)> {
        match self {
            Type::Bool => Some((0, 1)),
            Type::Byte | Type::Usint => Some((0, 0xFF)),
            Type::Word | Type::Uint => Some((0, 0xFFFF)),
            Type::Dword | Type::Udint => Some((0, 0xFFFF_FFFF)),
            Type::Sint => Some((i8::MIN.into(), i8::MAX.into())),
            Type::Int => Some((i16::MIN.into(), i16::MAX.into())),
            Type::Dint | Type::Time => Some((i32::MIN.into(), i32::MAX.into())),
            Type::Range(range) => Some((range.low, range.high)),
            _ => None,
        }
    }

    /// SINT, USINT, INT, UINT, DINT, UDINT.
    pub fn is_whole(&self) -> bool {
        matches!(self, Type::Sint | Type::Int | Type::Dint) || self.is_unsigned()
    }

    /// USINT, UINT, UDINT.
    pub fn is_unsigned(&self) -> bool {
        matches!(self, Type::Usint | Type::Uint | Type::Udint)
    }

    /// Whole numbers and REAL.
    pub fn is_number(&self) -> bool {
        self.is_whole() || *self == Type::Real
    }

    /// BYTE, WORD, DWORD.
    pub fn is_bits(&self) -> bool {
        matches!(self, Type::Byte | Type::Word | Type::Dword)
    }

    /// Whether it has neither elements nor members.
    pub fn is_elementary(&self) -> bool {
        !matches!(self, Type::Array(_) | Type::Struct(_) | Type::Block(..))
    }

    /// The unit of the instance that it is, or of those in an array.
    pub(crate) fn block(&self) -> Option<usize> {
        match self {
            Type::Block(number, _) => Some(*number),
            _ => self.block_of_array(),
        }
    }

    /// The unit of the instances in an array.
    pub(crate) fn block_of_array(&self) -> Option<usize> {
        match self {
            Type::Array(array) => array.of.block(),
            _ => None,
        }
    }

    /// Whether every value of `self` is one of `wider`, or is taken for it.
    pub fn widens_to(&self, wider: &Type) -> bool {
        if self == wider {
            return false;
        }
        match (self.is_whole(), self.is_bits()) {
            (true, _) if *wider == Type::Real => !matches!(self, Type::Dint | Type::Udint),
            (true, _) => wider.is_whole() && self.is_within(wider),
            (_, true) => wider.is_bits() && self.is_within(wider),
            _ => false,
        }
    }

    /// Whether another type has all of its numbers.
    pub fn is_within(&self, other: &Type) -> bool {
        match (self.range(), other.range()) {
            (Some((low, high)), Some((least, most))) => least <= low && high <= most,
            _ => false,
        }
    }

    /// Bytes of an element of an array of this type.
    pub fn bytes(&self) -> i64 {
        match self {
            Type::Bool | Type::Byte | Type::Sint | Type::Usint => 1,
            Type::Word | Type::Int | Type::Uint | Type::Enumeration(_) => 2,
            Type::Array(array) => (array.count() as i64).saturating_mul(array.of.bytes()),
            Type::Struct(kind) => kind.members.iter().map(|one| one.of_type.bytes()).sum(),
            Type::Range(range) => range.of.bytes(),
            Type::String(most) => i64::from(*most) + 1,
            _ => 4,
        }
    }

    /// The initial value of a variable that has none of its own.
    pub fn initial(&self) -> Value {
        match self {
            Type::Bool => Value::Bool(false),
            Type::Real => Value::Real(0.0),
            Type::Enumeration(kind) => Value::Int(kind.values.first().map_or(0, |(_, n)| *n)),
            Type::Range(range) => Value::Int(range.low),
            Type::String(_) => Value::Text(Vec::new()),
            Type::Array(array) => Value::List(vec![array.initial.clone(); array.count()]),
            Type::Struct(kind) => {
                Value::List(kind.members.iter().map(|member| member.initial.clone()).collect())
            }
            _ => Value::Int(0),
        }
    }
}

impl Array {
    /// How many elements it has.
    pub fn count(&self) -> usize {
        self.bounds.iter().map(|(low, high)| (high - low + 1).max(0) as usize).product()
    }
}

/// A variable.
#[derive(Debug, Clone)]
pub struct Variable {
    /// Its name as declared.
    pub name: String,
    /// Where it is declared.
    pub span: Span,
    /// Its type.
    pub of_type: Type,
    /// The section that it is in.
    pub section: SectionKind,
    /// Whether it is a constant.
    pub is_constant: bool,
    /// Whether it is kept without power.
    pub is_retained: bool,
    /// Its address in AWL, if it has one.
    pub at: Option<String>,
    /// What it is before the first scan.
    pub initial: Value,
    /// Whether the text says so.
    pub has_initial: bool,
}

/// What kind of unit it is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnitKind {
    /// PROGRAM
    Program,
    /// FUNCTION; its last variable is the result.
    Function,
    /// FUNCTION_BLOCK
    Block,
}

/// A unit.
#[derive(Debug, Clone)]
pub struct Unit {
    /// Its kind.
    pub kind: UnitKind,
    /// Its name.
    pub name: String,
    /// The number of its file; `None`: a standard block or one of the library.
    pub file: Option<usize>,
    /// Where its name is.
    pub span: Span,
    /// Its variables.
    pub variables: Vec<Variable>,
    /// What each instance does at the start of each scan.
    pub every_scan: Vec<Statement>,
    /// What it does.
    pub body: Vec<Statement>,
}

/// A checked program.
#[derive(Debug, Clone, Default)]
pub struct Program {
    /// Its units: those of the files in their order, then the standard blocks, then those of the
    /// library that it uses.
    pub units: Vec<Unit>,
    /// Its global variables.
    pub globals: Vec<Variable>,
    /// Timers that need not be exact.
    pub coarse: Vec<Coarse>,
    /// Lines `//# ...`.
    pub settings: Vec<String>,
}

/// A variable with the pragma `{coarse}`.
#[derive(Debug, Clone)]
pub struct Coarse {
    /// The unit that declares it; `None`: it is global.
    pub unit: Option<usize>,
    /// Its number among the variables there.
    pub variable: usize,
    /// The number of the file.
    pub file: usize,
    /// Where the pragma is.
    pub span: Span,
}

/// Where a value is.
#[derive(Debug, Clone)]
pub struct Place {
    /// The variable.
    pub root: Root,
    /// What is after its name.
    pub steps: Vec<Step>,
    /// The type of what is there.
    pub of_type: Type,
}

/// The variable of a place.
#[derive(Debug, Clone, PartialEq)]
pub enum Root {
    /// One of the unit.
    Local(usize),
    /// A global one.
    Global(usize),
    /// An address in AWL.
    Address(String),
}

/// A step into a variable.
#[derive(Debug, Clone)]
pub enum Step {
    /// A member of a structure, or a variable of an instance, by its number.
    Member(usize),
    /// An element; one index for each dimension.
    Element(Vec<Expression>),
}

/// An expression with its type.
#[derive(Debug, Clone)]
pub struct Expression {
    /// What.
    pub kind: ExpressionKind,
    /// Its type.
    pub of_type: Type,
    /// Where.
    pub span: Span,
}

/// What an expression is.
#[derive(Debug, Clone)]
pub enum ExpressionKind {
    /// A known value.
    Constant(Value),
    /// What is in a variable.
    Read(Place),
    /// The opposite number.
    Negate(Box<Expression>),
    /// NOT, of BOOL or bits.
    Not(Box<Expression>),
    /// Two operands of the same type; of TIME `*` and `/` the right one is INT or DINT.
    Binary(BinaryOperator, Box<Expression>, Box<Expression>),
    /// A function of the program, by its number in [`Program::units`], with all its arguments.
    Call(usize, Vec<Expression>),
    /// A standard function.
    Standard(Function, Vec<Expression>),
    /// A conversion from the operand's type.
    Convert(Box<Expression>),
}

/// Standard functions that are no operators.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Function {
    Abs,
    Sqrt,
    Ln,
    Exp,
    Sin,
    Cos,
    Tan,
    /// Any number of arguments of one type.
    Min,
    Max,
    /// BOOL, two of one type.
    Sel,
    /// INT, any number of one type.
    Mux,
    /// Bits, INT.
    Shl,
    Shr,
    Rol,
    Ror,
    Trunc,
    /// Of texts: a text; two texts; a text, how many characters there are, the first; texts.
    Len,
    Find,
    Mid,
    Concat,
    /// A number as a text, and the number that a text is.
    ToText,
    FromText,
}

/// A statement.
#[derive(Debug, Clone)]
pub struct Statement {
    /// What it does.
    pub kind: StatementKind,
    /// Its head.
    pub span: Span,
}

/// What a statement does.
#[derive(Debug, Clone)]
pub enum StatementKind {
    /// Writes a value of the same type; arrays and structures only from places.
    Assign(Place, Expression),
    /// IF
    If(Vec<(Expression, Vec<Statement>)>, Vec<Statement>),
    /// CASE: selector, first and last values with their statements, ELSE.
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
    /// What follows belongs to an element of a drawing.
    Element(Element),
    /// Adds the milliseconds since the start of the scan before.
    AddElapsed(Place),
    /// A call of an instance.
    Call(Box<BlockCall>),
    /// A call of a subroutine in AWL.
    Routine(String, Vec<RoutineArgument>),
}

/// First and last values that an arm of CASE is for, and its statements.
pub type CaseArm = (Vec<(i64, i64)>, Vec<Statement>);

/// FOR with a step that is known.
#[derive(Debug, Clone)]
pub struct ForLoop {
    /// The control variable.
    pub variable: Place,
    /// First value.
    pub from: Expression,
    /// Last value.
    pub to: Expression,
    /// Step, not 0.
    pub by: i64,
    /// What is repeated.
    pub body: Vec<Statement>,
}

/// A call of an instance of a function block.
#[derive(Debug, Clone)]
pub struct BlockCall {
    /// The instance.
    pub instance: Place,
    /// The number of the block's unit.
    pub block: usize,
    /// Inputs by the number of the variable, in the order of their declaration.
    pub inputs: Vec<(usize, Expression)>,
    /// VAR_IN_OUT in the order of their declaration.
    pub in_outs: Vec<(usize, Place)>,
    /// Outputs in the order of their declaration.
    pub outputs: Vec<(usize, Place)>,
}

/// An argument of a subroutine in AWL.
#[derive(Debug, Clone)]
pub enum RoutineArgument {
    /// For an input.
    Value(Expression),
    /// For an output.
    Place(Place),
}

/// Each statement, those in others too.
pub fn each_statement<'s>(statements: &'s [Statement], found: &mut dyn FnMut(&'s Statement)) {
    for statement in statements {
        found(statement);
        match &statement.kind {
            StatementKind::If(arms, otherwise) => {
                arms.iter().for_each(|(_, body)| each_statement(body, found));
                each_statement(otherwise, found);
            }
            StatementKind::Case(_, arms, otherwise) => {
                arms.iter().for_each(|(_, body)| each_statement(body, found));
                each_statement(otherwise, found);
            }
            StatementKind::For(one) => each_statement(&one.body, found),
            StatementKind::While(_, body) | StatementKind::Repeat(body, _) => {
                each_statement(body, found)
            }
            _ => {}
        }
    }
}
