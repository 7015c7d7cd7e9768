//! Where the local memory of each unit begins, and which parameters its calls hand over: read off the code.

use plc_isa::{Area, Bit, Decoded, Kind, L_START, Op, Operand, Place, Program, ProgramMemory};

use crate::ast::{Section, Type};

/// A parameter of a subroutine.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Parameter {
    pub(super) section: Section,
    pub(super) kind: Type,
    /// Its place in data memory.
    pub(super) place: Bit,
}

/// The frames of all units.
#[derive(Debug, Default)]
pub(super) struct Frames {
    units: Vec<Frame>,
}

#[derive(Debug, Clone)]
struct Frame {
    /// The least data address in use.
    base: u16,
    parameters: Vec<Parameter>,
}

/// One copy of a call with parameters.
#[derive(Debug, Clone, Copy)]
pub(super) struct Copy {
    /// The parameter's place.
    pub(super) place: Bit,
    /// What is copied, or where to.
    pub(super) other: (Kind, Operand),
    pub(super) kind: Type,
    pub(super) is_back: bool,
}

impl Frames {
    pub(super) fn of<P: ProgramMemory>(program: &Program<P>, code: &[(u16, u8, Decoded)]) -> Frames {
        let count = usize::from(program.plan().header.routines) + 1;
        let mut frames = Frames { units: vec![Frame { base: u16::MAX, parameters: Vec::new() }; count] };
        let mut call: Option<Vec<Copy>> = None;
        let mut callee = None;
        let mut end = 0;
        for (at, unit, decoded) in code {
            if *at >= end
                && let (Some(copies), Some(callee)) = (call.take(), callee.take())
            {
                frames.add_call(callee, &copies);
            }
            match (decoded.op, &mut call) {
                (Op::CallBegin, _) => {
                    call = Some(Vec::new());
                    end = offset(decoded);
                }
                (Op::Call, Some(_)) => callee = number(decoded).map(|index| usize::from(index) + 1),
                (_, Some(copies)) => {
                    if let Some(copy) = copy(decoded, callee.is_some()) {
                        frames.note(*unit, copy.other.1);
                        copies.push(copy);
                    }
                }
                (Op::ScrAnd, None) => {}
                (_, None) => decoded
                    .operands()
                    .filter(|&(kind, _)| kind != Kind::ScrBit)
                    .for_each(|(_, operand)| frames.note(*unit, operand)),
            }
        }
        frames
    }

    /// The data address of LB0 of a unit, as far as its text is concerned.
    pub(super) fn base(&self, unit: u8) -> u16 {
        self.units.get(usize::from(unit)).map_or(L_START, |frame| frame.base)
    }

    /// The parameters of a unit in the order of a call.
    pub(super) fn parameters(&self, unit: u8) -> &[Parameter] {
        self.units.get(usize::from(unit)).map_or(&[], |frame| &frame.parameters)
    }

    fn note(&mut self, unit: u8, operand: Operand) {
        if let (Some(frame), Some(address)) = (self.units.get_mut(usize::from(unit)), local(operand)) {
            frame.base = frame.base.min(address);
        }
    }

    fn add_call(&mut self, callee: usize, copies: &[Copy]) {
        let Some(frame) = self.units.get_mut(callee) else { return };
        let mut parameters: Vec<Parameter> = Vec::new();
        for copy in copies {
            frame.base = frame.base.min(copy.place.address);
            match parameters.iter_mut().find(|parameter| parameter.place == copy.place) {
                Some(parameter) => parameter.section = Section::InOut,
                None => {
                    let section = if copy.is_back { Section::Out } else { Section::In };
                    parameters.push(Parameter { section, kind: copy.kind, place: copy.place });
                }
            }
        }
        parameters.sort_by_key(|parameter| parameter.place);
        frame.parameters = parameters;
    }
}

/// The copy that an instruction between CallBegin and its end makes.
pub(super) fn copy(decoded: &Decoded, is_back: bool) -> Option<Copy> {
    let mut operands = decoded.operands().filter(|(kind, _)| kind.is_written());
    let (first, second) = (operands.next()?, operands.next()?);
    let (place, other) = match decoded.op {
        Op::Set => (first, (Kind::ByteConst, Operand::Constant(1))),
        Op::Reset => (first, (Kind::ByteConst, Operand::Constant(0))),
        _ if is_back => (first, second),
        _ => (second, first),
    };
    let (address, kind) = match place.1 {
        Operand::Bit(bit) => (bit, Type::Bool),
        operand => (Bit { address: local(operand)?, bit: 0 }, value_type(place.0)),
    };
    Some(Copy { place: address, other, kind, is_back })
}

fn value_type(kind: Kind) -> Type {
    match kind {
        Kind::Word | Kind::WordOut | Kind::WordIn | Kind::WordTo => Type::Int,
        Kind::DoubleIn | Kind::DoubleTo | Kind::RealIn | Kind::RealTo => Type::Dint,
        _ => Type::Byte,
    }
}

/// The data address of an operand in local memory.
pub(super) fn local(operand: Operand) -> Option<u16> {
    let address = match operand {
        Operand::Bit(bit) => bit.address,
        Operand::Memory(address) => address,
        Operand::Reference(reference) => match reference.place()? {
            Place::Direct(address) | Place::Indirect(address) => address,
            _ => return None,
        },
        _ => return None,
    };
    matches!(Area::of_page_address(address), Some((Area::L, _))).then_some(address)
}

pub(super) fn offset(decoded: &Decoded) -> u16 {
    decoded
        .operands()
        .find_map(|(_, operand)| if let Operand::Offset(offset) = operand { Some(offset) } else { None })
        .unwrap_or(0)
}

pub(super) fn number(decoded: &Decoded) -> Option<u8> {
    decoded.operands().find_map(|(_, operand)| if let Operand::Number(number) = operand { Some(number) } else { None })
}
