//! Names a program gives to addresses, for operands in scenarios and traces. Reading them from files is not done here.

use awl_asm::Address;

use awl_asm::suggest::nearest;

/// A named address.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Symbol {
    /// Its name, without quotes.
    pub name: String,
    /// What it stands for.
    pub address: Address,
    /// What its author says about it; may be empty.
    pub comment: String,
}

/// The symbols of a program. Names are found in any letter case, as in Micro/WIN.
#[derive(Debug, Clone, Default)]
pub struct Symbols {
    list: Vec<Symbol>,
}

impl Symbols {
    /// No symbols.
    pub fn new() -> Symbols {
        Symbols::default()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Adds a symbol. A name that is there already keeps its first meaning.
    pub fn add(&mut self, name: impl Into<String>, address: Address, comment: impl Into<String>) {
        self.list.push(Symbol { name: name.into(), address, comment: comment.into() });
    }

    /// The symbol of this name.
    pub fn find(&self, name: &str) -> Option<&Symbol> {
        let exact = self.list.iter().find(|symbol| symbol.name == name);
        let lower = name.to_lowercase();
        exact.or_else(|| self.list.iter().find(|symbol| symbol.name.to_lowercase() == lower))
    }

    /// The first symbol for this address.
    pub fn of(&self, address: Address) -> Option<&Symbol> {
        self.list.iter().find(|symbol| symbol.address == address)
    }

    /// The name most similar to a misspelt one.
    pub fn nearest(&self, name: &str) -> Option<&str> {
        nearest(name, self.list.iter().map(|symbol| &*symbol.name))
    }
}
