//! What there is beside the texts in ST: subroutines and a main program in AWL.

use crate::model::Type;

/// What there is beside the texts in ST.
#[derive(Debug, Clone, Default)]
pub struct Around {
    /// Subroutines in AWL that can be called.
    pub routines: Vec<Routine>,
    /// Whether there is a main program in AWL, which calls each PROGRAM by its name.
    pub has_main: bool,
    /// Numbers of subroutines from here on are free.
    pub first_routine: u16,
}

/// A subroutine in AWL that can be called.
#[derive(Debug, Clone)]
pub struct Routine {
    /// Its name.
    pub name: String,
    /// Its parameters in their order.
    pub parameters: Vec<RoutineParameter>,
}

/// A parameter of a subroutine in AWL.
#[derive(Debug, Clone)]
pub struct RoutineParameter {
    /// Its name.
    pub name: String,
    /// Its type.
    pub of_type: Type,
    /// Whether the subroutine writes it.
    pub is_written: bool,
}
