//! The elementary types of IEC 61499, by name. What a value of one may be is decided where values
//! are.

/// An elementary type.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum DataType {
    Bool,
    Sint,
    Int,
    Dint,
    Lint,
    Usint,
    Uint,
    Udint,
    Ulint,
    Real,
    Lreal,
    String,
    Time,
    Byte,
    Word,
    Dword,
}

impl DataType {
    /// All of them.
    pub const ALL: [DataType; 16] = [
        DataType::Bool,
        DataType::Sint,
        DataType::Int,
        DataType::Dint,
        DataType::Lint,
        DataType::Usint,
        DataType::Uint,
        DataType::Udint,
        DataType::Ulint,
        DataType::Real,
        DataType::Lreal,
        DataType::String,
        DataType::Time,
        DataType::Byte,
        DataType::Word,
        DataType::Dword,
    ];

    /// As files and ST have it.
    pub const fn name(self) -> &'static str {
        match self {
            DataType::Bool => "BOOL",
            DataType::Sint => "SINT",
            DataType::Int => "INT",
            DataType::Dint => "DINT",
            DataType::Lint => "LINT",
            DataType::Usint => "USINT",
            DataType::Uint => "UINT",
            DataType::Udint => "UDINT",
            DataType::Ulint => "ULINT",
            DataType::Real => "REAL",
            DataType::Lreal => "LREAL",
            DataType::String => "STRING",
            DataType::Time => "TIME",
            DataType::Byte => "BYTE",
            DataType::Word => "WORD",
            DataType::Dword => "DWORD",
        }
    }

    /// That of a name, in any letter case.
    pub fn of(name: &str) -> Option<DataType> {
        DataType::ALL.into_iter().find(|one| one.name().eq_ignore_ascii_case(name))
    }

    /// Whether it has 64 bits, which no S7-200 computes with.
    pub const fn is_long(self) -> bool {
        matches!(self, DataType::Lint | DataType::Ulint | DataType::Lreal)
    }
}
