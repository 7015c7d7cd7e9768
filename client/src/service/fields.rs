//! The fields of an answer one after the other, after its function code. What they mean is not
//! known here.

use crate::error::Error;
use crate::value::raw;

/// What is left of an answer.
pub(super) struct Fields<'a> {
    rest: &'a [u8],
}

impl<'a> Fields<'a> {
    pub fn of(answer: &'a [u8]) -> Fields<'a> {
        Fields { rest: answer.get(1..).unwrap_or(&[]) }
    }

    pub fn take(&mut self, len: usize) -> Result<&'a [u8], Error> {
        let (field, rest) = self
            .rest
            .split_at_checked(len)
            .ok_or_else(|| Error::BadAnswer("it is too short".into()))?;
        self.rest = rest;
        Ok(field)
    }

    pub fn byte(&mut self) -> Result<u8, Error> {
        self.take(1).map(|bytes| raw(bytes) as u8)
    }

    pub fn word(&mut self) -> Result<u16, Error> {
        self.take(2).map(|bytes| raw(bytes) as u16)
    }

    pub fn double(&mut self) -> Result<u32, Error> {
        self.take(4).map(raw)
    }

    pub fn four(&mut self) -> Result<[u8; 4], Error> {
        self.double().map(u32::to_be_bytes)
    }
}
