//! The signs of pointers before operands, `*` and `&`: what they make of a value. What the value
//! itself is is settled elsewhere.

use plc_isa::{AnalogInput, Area};

use crate::diagnostic::{Code, Diagnostic};
use crate::text::address::Address;
use crate::text::ast::{Span, Value};

/// What is after `*`.
pub(super) fn pointer(span: Span, inner: Value) -> Result<Value, Box<Diagnostic>> {
    let error = |message: &str| Diagnostic::new(Code::Pointer, span, message);
    let double = |area, byte: u16| format!("*{}", Address::Double { area, byte });
    Err(Box::new(match inner {
        Value::Address(address @ Address::Double { area: Area::V | Area::L, .. }) => {
            return Ok(Value::Indirect(address));
        }
        Value::Address(address @ Address::Accumulator(1..)) => return Ok(Value::Indirect(address)),
        Value::Address(Address::Accumulator(_)) => error("AC0 cannot hold a pointer").help(
            "AC1, AC2 and AC3 can: put the pointer there, too, `MOVD &VB100, AC1`, and then read \
             `*AC1`",
        ),
        Value::Address(
            Address::Byte { area: area @ (Area::V | Area::L), byte }
            | Address::Word { area: area @ (Area::V | Area::L), byte },
        ) => error("a pointer is a double word").suggest(double(area, byte)),
        Value::Invalid => return Ok(Value::Invalid),
        _ => error("a pointer is held by V or L memory or by AC1, AC2 or AC3")
            .help("such as *VD10, *LD0 or *AC1"),
    }))
}

/// What is after `&`.
pub(super) fn pointer_to(span: Span, inner: Value) -> Result<Value, Box<Diagnostic>> {
    let error = |message: String| Diagnostic::new(Code::Pointer, span, message);
    Err(Box::new(match inner {
        Value::Address(
            Address::Byte { area: Area::L, .. }
            | Address::Word { area: Area::L, .. }
            | Address::Double { area: Area::L, .. },
        ) => error("no pointer can lead to local memory".into()).help("keep the value in V memory"),
        Value::Address(
            Address::Byte { area, byte }
            | Address::Word { area, byte }
            | Address::Double { area, byte },
        ) => {
            return Ok(Value::AddressOf(Address::Byte { area, byte }));
        }
        Value::Address(
            address @ (Address::Timer(_)
            | Address::Counter(_)
            | Address::Analog(AnalogInput::Scaled(_))
            | Address::AnalogOutput(_)),
        ) => return Ok(Value::AddressOf(address)),
        Value::Address(address @ Address::Bit { area, byte, .. }) if area != Area::L => {
            let byte = Address::Byte { area, byte };
            error(format!("no pointer can lead to the bit {address}")).suggest(format!("&{byte}"))
        }
        Value::Address(address) => error(format!("no pointer can lead to {address}")),
        Value::Invalid => return Ok(Value::Invalid),
        _ => error("after & is an address, such as &VB100".into()),
    }))
}

/// What `*` or `&` before a value makes of it; `None` where that means nothing.
pub fn with_sign(sign: char, value: Value) -> Option<Value> {
    let anywhere = Span::default();
    match sign {
        '*' => pointer(anywhere, value).ok(),
        '&' => pointer_to(anywhere, value).ok(),
        _ => None,
    }
}
