//! Cycles of the board: the fewest and the most. What takes them is said elsewhere.

/// Least and most cycles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Cycles {
    /// Least.
    pub min: u32,
    /// Most.
    pub max: u32,
}

impl Cycles {
    /// Always as many.
    pub const fn exactly(cycles: u32) -> Cycles {
        Cycles { min: cycles, max: cycles }
    }

    /// Both one after the other.
    pub const fn then(self, next: Cycles) -> Cycles {
        Cycles { min: self.min + next.min, max: self.max + next.max }
    }

    /// One or the other.
    pub fn or(self, other: Cycles) -> Cycles {
        Cycles { min: self.min.min(other.min), max: self.max.max(other.max) }
    }
}

/// One of two ways, where both need not exist.
pub fn either(one: Option<Cycles>, other: Option<Cycles>) -> Option<Cycles> {
    match (one, other) {
        (Some(one), Some(other)) => Some(one.or(other)),
        (one, other) => one.or(other),
    }
}
