//! Which double words of a program hold reals: the instructions that use them say it. Values are
//! not looked at.

use std::collections::BTreeSet;

use crate::address::Address;
use crate::disassemble::instructions;
use plc_isa::{Area, Op, Operand, Program, ProgramMemory, Referent, Region, Type, verify};

/// The addresses that an image computes with as reals, and never as whole numbers. MOVD says
/// nothing: it moves both.
pub fn of(image: &[u8]) -> BTreeSet<Address> {
    let Ok(program) = verify(image) else { return BTreeSet::new() };
    let (mut reals, mut others) = (BTreeSet::new(), BTreeSet::new());
    for line in instructions(&program).iter().filter(|line| line.decoded.op != Op::Movd) {
        for (kind, operand) in line.decoded.operands() {
            let Some(address) = address(&program, operand) else { continue };
            match kind.value_type() {
                Some(Type::Real) => reals.insert(address),
                Some(Type::Double) => others.insert(address),
                Some(Type::Bit | Type::Byte | Type::Word | Type::Text) | None => continue,
            };
        }
    }
    &reals - &others
}

/// The double word that an operand names directly. Local memory has another place in every unit.
fn address<P: ProgramMemory>(program: &Program<P>, operand: Operand) -> Option<Address> {
    let Operand::Reference(reference) = operand else { return None };
    let Referent::Direct(at) = reference.place()? else { return None };
    match program.plan().region(at)? {
        Region::Byte { area: Area::L, .. } => None,
        Region::Byte { area, byte, .. } => Some(Address::Double { area, byte }),
        Region::Accumulator { number, .. } => Some(Address::Accumulator(number)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assemble::assemble;
    use crate::source::Source;

    #[test]
    fn only_what_is_computed_with_as_real() {
        let text = "LD SM0.0\nMOVR 1.5, VD0\n+R VD0, VD4\nMOVD VD0, VD8\n+D VD12, VD16\n\
            MOVR VD16, VD20\nSQRT VD24, AC1\n";
        let image = assemble(&Source::new("p.awl", text).unwrap(), Vec::new()).image.unwrap();
        let names: Vec<String> = of(&image).iter().map(Address::to_string).collect();
        assert_eq!(names, ["VD0", "VD4", "VD20", "VD24", "AC1"]);
        assert!(of(&image[1..]).is_empty());
    }
}
