//! Bits that a program writes in every scan and never reads: whoever else sets them sets nothing.
//! Who that would be is not known here.

use std::ops::Range;

use awl_asm::Address;
use awl_asm::assemble::Assembly;
use awl_asm::check::Access;
use plc_isa::{Area, Op};

use crate::operand::Operand;

/// These bits, by address. In doubt a bit is not one of them: where something may lead past the
/// instruction that writes it, where another than `=` writes it, and where its byte may be read as
/// a whole or through a pointer.
pub fn overwritten(assembly: &Assembly) -> Vec<Operand> {
    let accesses = &assembly.usage.accesses;
    let certain = in_every_scan(assembly);
    // What else may be read: bytes, words, pointers, the bits of a shift register.
    let is_wide = |(address, list): (&Address, &Vec<Access>)| {
        let is_shifted = list.iter().any(|access| access.reads && access.writes);
        (!matches!(address, Address::Bit { .. }) || is_shifted).then(|| address.area())?
    };
    let wide: Vec<Area> = accesses.iter().filter_map(is_wide).collect();
    let is_lost = |(address, list): &(&Address, &Vec<Access>)| {
        let is_coil = |access: &Access| {
            let op = assembly.code.get(access.instruction).map(|selected| selected.op);
            op == Some(Op::Assign) && access.writes && !access.reads
        };
        matches!(address, Address::Bit { area, .. } if !wide.contains(area))
            && list.iter().all(is_coil)
            && list.iter().any(|access| certain.contains(&access.instruction))
    };
    accesses.iter().filter(is_lost).map(|(&address, _)| Operand::At(address)).collect()
}

/// The instructions that every scan executes for certain: those of the main program before the
/// first that can lead elsewhere.
fn in_every_scan(assembly: &Assembly) -> Range<usize> {
    let units = &assembly.units;
    let main = units.order.first().and_then(|&index| units.parts.get(index));
    let Some(main) = main.map(|main| main.code.clone()) else { return 0..0 };
    let leads_elsewhere = |op: Op| {
        let is_end = matches!(op, Op::End | Op::Cret | Op::Creti | Op::Cscre | Op::Stop);
        is_end || matches!(op, Op::Jmp | Op::Lbl | Op::For)
    };
    let code = assembly.code.get(main.clone()).unwrap_or(&[]);
    let len = code.iter().position(|selected| leads_elsewhere(selected.op)).unwrap_or(code.len());
    main.start..main.start + len
}

#[cfg(test)]
mod tests {
    use super::*;
    use awl_asm::assemble::assemble;
    use awl_asm::source::Source;

    fn of(text: &str) -> Vec<String> {
        let assembly = assemble(&Source::new("p.awl", text).unwrap(), Vec::new());
        assert!(!assembly.has_errors(), "{text}");
        overwritten(&assembly).iter().map(Operand::to_string).collect()
    }

    #[test]
    fn what_the_program_writes_in_every_scan() {
        assert_eq!(of("LD I0.0\n= Q0.0\n= M0.1\n"), ["Q0.0", "M0.1"]);
        assert_eq!(of("LD I0.0\n= Q0.0\nLD I0.1\n= Q0.0\n"), ["Q0.0"]);
    }

    #[test]
    fn in_doubt_it_is_not_one() {
        for text in [
            // A latch sees what is set.
            "LD I0.0\nO Q0.0\n= Q0.0\n",
            "LD I0.0\nS Q0.0, 1\nLD I0.1\nR Q0.0, 1\n",
            "LD I0.0\n= Q0.0\nLD I0.1\nR Q0.0, 1\n",
            "LD I0.0\nJMP 1\nLD I0.1\n= Q0.0\nLBL 1\n",
            "LD I0.0\nEND\nLD I0.1\n= Q0.0\n",
            "LD I0.0\n= Q0.0\nMOVB QB0, MB3\n",
            "LD I0.0\n= Q0.0\nLD SM0.0\nMOVD &QB0, VD0\nMOVB *VD0, MB3\n",
            "LD I0.0\n= Q0.1\nLD I0.1\nEU\nSHRB I0.2, Q0.0, 4\n",
            "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\nLD I0.0\nCALL A:SBR0\nEND_ORGANIZATION_BLOCK\n\
             SUBROUTINE_BLOCK A:SBR0\nBEGIN\nLD I0.1\n= Q0.0\nEND_SUBROUTINE_BLOCK\n",
        ] {
            assert_eq!(of(text), [""; 0], "{text}");
        }
    }
}
