//! Which variables charts name, and what is done with them: how they are used says what they are,
//! where no table does.

use std::collections::HashMap;

use diagnostics::Span;

/// Which variables there are, in the order of their first use, and what is done with them.
#[derive(Debug, Default)]
pub(super) struct Uses {
    pub(super) order: Vec<String>,
    pub(super) known: HashMap<String, Use>,
}

#[derive(Debug, Default, Clone, Copy)]
pub(super) struct Use {
    pub(super) is_read: bool,
    pub(super) is_written: bool,
    /// Compared, or given a number.
    pub(super) is_number: bool,
    pub(super) at: Span,
}

impl Uses {
    pub(super) fn of(&mut self, name: &str, at: Span) -> &mut Use {
        if !self.known.contains_key(name) {
            self.order.push(name.to_owned());
        }
        self.known.entry(name.to_owned()).or_insert(Use { at, ..Use::default() })
    }
}
