//! Where the local memory of each unit begins, and which parameters its calls hand over: read off
//! the code.

use plc_isa::{Area, Bit, Decoded, Kind, Op, Operand, Program, ProgramMemory, Referent, Region};

use crate::text::ast::{Section, Type};

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
    /// The least number in use of all bytes of local memory.
    base: u16,
    parameters: Vec<Parameter>,
    /// Parameters that are handed constants which are no real.
    no_reals: Vec<Bit>,
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
    pub(super) fn of<P: ProgramMemory>(
        program: &Program<P>,
        code: &[(u16, u8, Decoded)],
    ) -> Frames {
        let count = usize::from(program.plan().header.routines) + 1;
        let mut frames = Frames {
            units: vec![
                Frame { base: u16::MAX, parameters: Vec::new(), no_reals: Vec::new() };
                count
            ],
        };
        let mut call: Option<Vec<Copy>> = None;
        let mut callee = None;
        let mut end = 0;
        for (at, unit, decoded) in code {
            if *at >= end
                && let (Some(copies), Some(callee)) = (call.take(), callee.take())
            {
                frames.add_call(program, callee, &copies);
            }
            match (decoded.op, &mut call) {
                (Op::CallBegin, _) => {
                    call = Some(Vec::new());
                    end = offset(decoded);
                }
                (Op::Call, Some(_)) => callee = number(decoded).map(|index| usize::from(index) + 1),
                (_, Some(copies)) => {
                    if let Some(copy) = copy(decoded, callee.is_some()) {
                        frames.note(program, *unit, copy.other.1);
                        copies.push(copy);
                    }
                }
                (Op::ScrAnd, None) => {}
                (_, None) => decoded
                    .operands()
                    .filter(|&(kind, _)| kind != Kind::ScrBit)
                    .for_each(|(_, operand)| frames.note(program, *unit, operand)),
            }
        }
        frames.find_reals(code);
        frames
    }

    /// Calls copy reals like any double word: a parameter is a real if its unit computes with it as
    /// one, and nowhere otherwise.
    fn find_reals(&mut self, code: &[(u16, u8, Decoded)]) {
        for (number, frame) in (0..).zip(&mut self.units) {
            let own =
                code.iter().filter(|(_, unit, decoded)| *unit == number && decoded.op != Op::Movd);
            let uses: Vec<(Kind, u16)> = own
                .flat_map(|(_, _, decoded)| decoded.operands())
                .filter_map(|(kind, operand)| Some((kind, address(operand)?)))
                .collect();
            for parameter in frame.parameters.iter_mut().filter(|one| one.kind == Type::Dint) {
                let mut uses =
                    uses.iter().filter(|(_, at)| *at == parameter.place.address).peekable();
                let is_used = uses.peek().is_some() && !frame.no_reals.contains(&parameter.place);
                if is_used && uses.all(|(kind, _)| matches!(kind, Kind::RealIn | Kind::RealTo)) {
                    parameter.kind = Type::Real;
                }
            }
        }
    }

    /// The number of LB0 of a unit among all bytes of local memory, as far as its text is
    /// concerned.
    pub(super) fn base(&self, unit: u8) -> u16 {
        self.units.get(usize::from(unit)).map_or(0, |frame| frame.base)
    }

    /// The parameters of a unit in the order of a call.
    pub(super) fn parameters(&self, unit: u8) -> &[Parameter] {
        self.units.get(usize::from(unit)).map_or(&[], |frame| &frame.parameters)
    }

    fn note<P: ProgramMemory>(&mut self, program: &Program<P>, unit: u8, operand: Operand) {
        if let (Some(frame), Some(number)) = (
            self.units.get_mut(usize::from(unit)),
            address(operand).and_then(|address| local_number(program, address)),
        ) {
            frame.base = frame.base.min(number);
        }
    }

    fn add_call<P: ProgramMemory>(&mut self, program: &Program<P>, callee: usize, copies: &[Copy]) {
        let Some(frame) = self.units.get_mut(callee) else { return };
        let mut parameters: Vec<Parameter> = Vec::new();
        for copy in copies {
            let bits = constant(program, copy.other.1).filter(|_| copy.kind == Type::Dint);
            if bits.is_some_and(|bits| !f32::from_bits(bits).is_finite()) {
                frame.no_reals.push(copy.place);
            }
            let number = local_number(program, copy.place.address);
            frame.base = number.map_or(frame.base, |number| frame.base.min(number));
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
        operand => (Bit { address: address(operand)?, bit: 0 }, value_type(place.0)),
    };
    Some(Copy { place: address, other, kind, is_back })
}

fn value_type(kind: Kind) -> Type {
    match kind.value_type() {
        Some(plc_isa::Type::Word) => Type::Int,
        Some(plc_isa::Type::Double | plc_isa::Type::Real) => Type::Dint,
        Some(plc_isa::Type::Bit | plc_isa::Type::Byte | plc_isa::Type::Text) | None => Type::Byte,
    }
}

/// The data address of an operand in memory.
fn address(operand: Operand) -> Option<u16> {
    match operand {
        Operand::Bit(bit) => Some(bit.address),
        Operand::Memory(address) => Some(address),
        Operand::Reference(reference) => match reference.place()? {
            Referent::Direct(address) | Referent::Indirect(address) => Some(address),
            _ => None,
        },
        _ => None,
    }
}

/// The bits of a constant of four bytes.
fn constant<P: ProgramMemory>(program: &Program<P>, operand: Operand) -> Option<u32> {
    let Operand::Reference(reference) = operand else { return None };
    match reference.place()? {
        Referent::Constant(value) => Some(value as u32),
        Referent::Pool(at) => {
            let bytes = [0, 1, 2, 3].map(|index| program.memory().byte(at + index));
            Some(u32::from_be_bytes(bytes))
        }
        Referent::Direct(_) | Referent::Indirect(_) => None,
    }
}

/// The number of a byte among all of local memory, of which the bit page has the first.
fn local_number<P: ProgramMemory>(program: &Program<P>, address: u16) -> Option<u16> {
    match program.plan().region(address)? {
        Region::Byte { area: Area::L, byte, .. } => Some(byte),
        _ => None,
    }
}

pub(super) fn offset(decoded: &Decoded) -> u16 {
    decoded
        .operands()
        .find_map(
            |(_, operand)| if let Operand::Offset(offset) = operand { Some(offset) } else { None },
        )
        .unwrap_or(0)
}

pub(super) fn number(decoded: &Decoded) -> Option<u8> {
    decoded.operands().find_map(|(_, operand)| {
        if let Operand::Number(number) = operand { Some(number) } else { None }
    })
}
