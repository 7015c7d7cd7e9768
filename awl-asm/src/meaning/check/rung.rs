//! The contacts before an instruction.

use plc_isa::Area;

use crate::meaning::selected::{Argument, Selected, is_contact};
use crate::text::address::Address;

/// The contacts of the rung that the code ends in, from its load on, as far as they are in one
/// piece.
pub(super) fn contacts(code: &[Selected]) -> &[Selected] {
    let outputs = code.iter().rev().take_while(|selected| !is_contact(selected.op)).count();
    let rung = &code[..code.len() - outputs];
    let contacts = rung.iter().rev().take_while(|selected| is_contact(selected.op)).count();
    &rung[rung.len() - contacts..]
}

/// Whether the rung that the code ends in is for the first scan.
pub(super) fn is_of_first_scan(code: &[Selected]) -> bool {
    let first_scan = Argument::Bit(Address::Bit { area: Area::Sm, byte: 0, bit: 1 });
    contacts(code).iter().any(|contact| contact.arguments[0] == first_scan)
}
