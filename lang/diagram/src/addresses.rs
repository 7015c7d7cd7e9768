//! Addresses of variables: names with the same address are the same operand, as is the address.

use std::collections::HashMap;

use st::tree::Unit;

/// The addresses of the variables of a unit that have one, by their names in upper case.
pub(crate) struct Addresses(HashMap<String, String>);

impl Addresses {
    pub(crate) fn of(unit: &Unit) -> Addresses {
        let with_address =
            unit.declarations().filter_map(|one| Some((one.at.as_ref()?, &one.names)));
        let of_names = with_address.flat_map(|(at, names)| {
            let address = written(&at.text);
            names.iter().map(move |name| (name.text.to_uppercase(), address.clone()))
        });
        Addresses(of_names.collect())
    }

    /// What a variable is told apart by: its address if it has one, or its name.
    pub(crate) fn resolve(&self, name: &str) -> String {
        let name = name.to_uppercase();
        self.0.get(&name).cloned().unwrap_or(name)
    }
}

/// An address in one way of writing: `%QX0.0` is `%Q0.0`; no area has an X.
pub(crate) fn written(address: &str) -> String {
    format!("%{}", address.trim_start_matches('%').to_uppercase().replacen('X', "", 1))
}
