//! Colours of the diagram, one for each kind of operand. Dark enough to read on white, also in
//! grey.

use awl_asm::Address;
use plc_isa::Area;

use crate::operand::Operand;

pub(crate) const PAPER: &str = "#ffffff";
pub(crate) const INK: &str = "#1c2733";
pub(crate) const FAINT_INK: &str = "#5d6b7a";
pub(super) const STRIPE: &str = "#f4f6f9";
pub(crate) const GRID: &str = "#d9dfe6";
pub(crate) const AXIS: &str = "#8593a3";

/// The colour of an operand's wave.
pub(super) fn of(operand: Operand) -> &'static str {
    match operand.address() {
        Address::Bit { area, .. }
        | Address::Byte { area, .. }
        | Address::Word { area, .. }
        | Address::Double { area, .. } => match area {
            Area::I => "#1f5fb4",
            Area::Q => "#c2410c",
            Area::T => "#7a3ea1",
            Area::C => "#8a6100",
            Area::M | Area::Sm | Area::S | Area::V | Area::L => "#2f7d3b",
        },
        Address::Timer(_) => "#7a3ea1",
        Address::Counter(_) | Address::HighSpeedCounter(_) => "#8a6100",
        Address::Analog(_) | Address::AnalogOutput(_) => "#0f7286",
        Address::Accumulator(_) => "#2f7d3b",
    }
}
