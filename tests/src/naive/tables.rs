//! Tables and blocks of memory.

use awl_asm::ast::{Instruction, Operand};
use plc_isa::{Area, Relation};

use super::Naive;
use super::boxes::width;
use super::places::{Trouble, ValuePlace, Want};

/// Most entries of a table.
const ENTRIES_MAX: i16 = 100;

impl Naive {
    pub(super) fn table_box(&mut self, instruction: &Instruction) -> Result<(), Trouble> {
        let operands = &instruction.operands;
        match instruction.mnemonic() {
            "ATT" => self.add_to_table(&operands[0], &operands[1]),
            "FIFO" => self.take_from_table(&operands[0], &operands[1], true),
            "LIFO" => self.take_from_table(&operands[0], &operands[1], false),
            "FND" => self.find_in_table(instruction),
            "FILL" => {
                let value = self.read(&operands[0], 2)?;
                let count = self.read(&operands[2], 1)? as u16;
                let first = self.place(&operands[1], Want::written(2).of(count))?;
                for number in 0..count {
                    self.set_value_at(Naive::behind(first, 2, number), 2, value);
                }
                Ok(())
            }
            name => self.copy_block(operands, width(name)),
        }
    }

    fn copy_block(&mut self, operands: &[Operand], width: u8) -> Result<(), Trouble> {
        let count = self.read(&operands[2], 1)? as u16;
        let from = self.place(&operands[0], Want::read(width).of(count))?;
        let to = self.place(&operands[1], Want::written(width).of(count))?;
        let values: Vec<u32> =
            (0..count).map(|at| self.value_at(Naive::behind(from, width, at), width)).collect();
        for (value, at) in values.into_iter().zip(0..) {
            self.set_value_at(Naive::behind(to, width, at), width, value);
        }
        Ok(())
    }

    fn word_at(&self, first: ValuePlace, number: i16) -> i16 {
        self.value_at(Naive::behind(first, 2, number as u16), 2) as i16
    }

    fn set_word_at(&mut self, first: ValuePlace, number: i16, value: i16) {
        self.set_value_at(Naive::behind(first, 2, number as u16), 2, u32::from(value as u16));
    }

    /// A table with as many places and entries as its first two words say.
    fn table(&self, operand: &Operand) -> Result<(ValuePlace, i16, i16), Trouble> {
        let head = self.place(operand, Want::written(2).of(2))?;
        let (most, entries) = (self.word_at(head, 0), self.word_at(head, 1));
        if !(0..=ENTRIES_MAX).contains(&most) || !(0..=most).contains(&entries) {
            return Err(Trouble::Operand);
        }
        let table = self.place(operand, Want::written(2).of(2 + most as u16))?;
        Ok((table, most, entries))
    }

    fn add_to_table(&mut self, data: &Operand, table: &Operand) -> Result<(), Trouble> {
        let value = self.read_signed(data, 2)? as i16;
        let (table, most, entries) = self.table(table)?;
        self.set_bit(Area::Sm, 1, 4, entries == most);
        if entries == most {
            return Err(Trouble::Result);
        }
        self.set_word_at(table, 1, entries + 1);
        self.set_word_at(table, 2 + entries, value);
        Ok(())
    }

    fn take_from_table(
        &mut self,
        table: &Operand,
        data: &Operand,
        oldest: bool,
    ) -> Result<(), Trouble> {
        let (table, _, entries) = self.table(table)?;
        self.place(data, Want::written(2))?;
        self.set_bit(Area::Sm, 1, 5, entries == 0);
        if entries == 0 {
            return Err(Trouble::Result);
        }
        let taken = self.word_at(table, if oldest { 2 } else { 1 + entries });
        if oldest {
            for entry in 0..entries - 1 {
                let next = self.word_at(table, 3 + entry);
                self.set_word_at(table, 2 + entry, next);
            }
        }
        self.set_word_at(table, 1, entries - 1);
        self.write(data, 2, u32::from(taken as u16))
    }

    /// The table begins with the number of entries here.
    fn find_in_table(&mut self, instruction: &Instruction) -> Result<(), Trouble> {
        let [table, pattern, indx] = &instruction.operands[..] else {
            panic!("FND has three operands")
        };
        let head = self.place(table, Want::read(2))?;
        let entries = self.word_at(head, 0);
        if !(0..=ENTRIES_MAX).contains(&entries) {
            return Err(Trouble::Operand);
        }
        let table = self.place(table, Want::read(2).of(1 + entries as u16))?;
        let pattern = self.read_signed(pattern, 2)? as i16;
        self.place(indx, Want::written(2))?;
        let start = self.read_signed(indx, 2)? as i16;
        if !(0..=entries).contains(&start) {
            return Err(Trouble::Operand);
        }
        let found = (start..entries).find(|&entry| {
            let value = self.word_at(table, 1 + entry);
            match instruction.relation {
                Some(Relation::Equal) => value == pattern,
                Some(Relation::NotEqual) => value != pattern,
                Some(Relation::Less) => value < pattern,
                _ => value > pattern,
            }
        });
        self.write(indx, 2, found.unwrap_or(entries) as u32)
    }
}
