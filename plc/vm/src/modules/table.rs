//! Tables and blocks of memory (docs/s7-200.md 1.5 and 1.7).

use plc_isa::{Op, ProgramMemory};

use super::execution::{Execution, Failure};
use super::{TABLE_EMPTY, TABLE_FULL};
use crate::environment::Environment;
use crate::references::Width;

/// Most entries of a table.
const ENTRIES_MAX: i64 = 100;
/// Bytes of a word.
const WORD: u16 = Width::Word.len();

/// A table that is in memory completely: its length, its number of entries, its entries.
struct Table {
    address: u16,
    len: u16,
    count: u16,
}

impl Table {
    /// The address of an entry.
    fn entry(&self, index: u16) -> u16 {
        self.address + WORD * (2 + index)
    }
}

impl<P: ProgramMemory, E: Environment> Execution<'_, '_, P, E> {
    pub(super) fn table(&mut self, op: Op) -> Result<(), Failure> {
        match op {
            Op::Att => self.add_to_table(),
            Op::Fifo => self.take_from_table(true),
            Op::Lifo => self.take_from_table(false),
            Op::Fnd => self.find(),
            Op::Fill => self.fill(),
            Op::Bmb => self.copy_block(Width::Byte),
            Op::Bmw => self.copy_block(Width::Word),
            Op::Bmd => self.copy_block(Width::Double),
            _ => Err(Failure::Undefined),
        }
    }

    /// The table at operand `index`.
    fn table_at(&self, index: usize) -> Result<Table, Failure> {
        let address = self.target(index, Width::Word, 2)?;
        let (len, count) = (self.get(address, Width::Word), self.get(address + WORD, Width::Word));
        if !(0..=ENTRIES_MAX).contains(&len) || !(0..=len).contains(&count) {
            return Err(Failure::Operand);
        }
        self.target(index, Width::Word, 2 + len as u16)?;
        Ok(Table { address, len: len as u16, count: count as u16 })
    }

    fn add_to_table(&mut self) -> Result<(), Failure> {
        let (data, table) = (self.read(0, Width::Word)?, self.table_at(1)?);
        let is_full = table.count == table.len;
        self.interpreter.memory.set_bit(TABLE_FULL, is_full);
        if is_full {
            return Err(Failure::Result);
        }
        self.put(table.entry(table.count), Width::Word, data);
        self.put_count(&table, table.count + 1);
        Ok(())
    }

    fn put_count(&mut self, table: &Table, count: u16) {
        self.put(table.address + WORD, Width::Word, i64::from(count));
    }

    /// Takes the oldest entry, which is the first, or the newest. The place that becomes free keeps
    /// its value.
    fn take_from_table(&mut self, oldest: bool) -> Result<(), Failure> {
        let (table, data) = (self.table_at(0)?, self.target(1, Width::Word, 1)?);
        self.interpreter.memory.set_bit(TABLE_EMPTY, table.count == 0);
        let last = table.count.checked_sub(1).ok_or(Failure::Result)?;
        let taken = self.get(table.entry(if oldest { 0 } else { last }), Width::Word);
        if oldest {
            self.copy_bytes(table.entry(1), table.entry(0), WORD * last);
        }
        self.put_count(&table, last);
        self.put(data, Width::Word, taken);
        Ok(())
    }

    /// The table begins with its number of entries here.
    fn find(&mut self) -> Result<(), Failure> {
        let address = self.source(1, Width::Word, 1)?;
        let count = self.get(address, Width::Word);
        let (pattern, indx) = (self.read(2, Width::Word)?, self.target(3, Width::Word, 1)?);
        let start = self.get(indx, Width::Word);
        if !(0..=ENTRIES_MAX).contains(&count) || !(0..=count).contains(&start) {
            return Err(Failure::Operand);
        }
        self.source(1, Width::Word, 1 + count as u16)?;
        let relation = self.operands.relation(0);
        let entry = |index: i64| self.get(address + WORD * (1 + index as u16), Width::Word);
        let found = (start..count).find(|&index| relation.holds(entry(index), pattern));
        self.put(indx, Width::Word, found.unwrap_or(count));
        Ok(())
    }

    fn fill(&mut self) -> Result<(), Failure> {
        let (value, count) = (self.read(0, Width::Word)?, self.read(2, Width::Byte)? as u16);
        let out = self.target(1, Width::Word, count)?;
        for index in 0..count {
            self.put(out + WORD * index, Width::Word, value);
        }
        Ok(())
    }

    fn copy_block(&mut self, width: Width) -> Result<(), Failure> {
        let count = self.read(2, Width::Byte)? as u16;
        let (from, to) = (self.source(0, width, count)?, self.target(1, width, count)?);
        self.copy_bytes(from, to, count * width.len());
        Ok(())
    }

    /// Copies bytes as if all were read before one is written.
    fn copy_bytes(&mut self, from: u16, to: u16, len: u16) {
        let memory = &mut *self.interpreter.memory;
        let mut copy = |at: u16| memory.set_byte(to + at, memory.byte(from + at));
        if from < to {
            (0..len).rev().for_each(&mut copy);
        } else {
            (0..len).for_each(&mut copy);
        }
    }
}
