//! Function 101: a program comes, block by block. Where it is kept, and how it comes into force, is
//! the machine's.

use crate::protocol::{DOWNLOAD_HEAD_LEN, DOWNLOAD_MAX};
use crate::request::{Answered, Exception, Request};
use crate::station::Station;

const BEGIN: u8 = 1;
const BLOCK: u8 = 2;
const END: u8 = 3;

/// Function code and action, which begin an answer too.
const HEAD_LEN: u8 = 2;

impl<S: Station> Request<'_, S> {
    pub fn download(&mut self) -> Answered {
        if !S::TAKES_DOWNLOADS {
            return Err(Exception::Function);
        }
        match self.byte(1) {
            BEGIN => self.begin_download(),
            BLOCK => self.take_block(),
            END => self.end_download(),
            _ => Err(Exception::Value),
        }
    }

    fn begin_download(&mut self) -> Answered {
        self.expect_len(HEAD_LEN + 2)?;
        let len = self.word(HEAD_LEN);
        if len == 0 || len > self.station.slot_len() {
            return Err(Exception::Value);
        }
        self.station.begin_download(len)?;
        self.received(0)
    }

    fn take_block(&mut self) -> Answered {
        let (offset, len) = (self.word(HEAD_LEN), self.byte(DOWNLOAD_HEAD_LEN - 1));
        self.expect_count(len, DOWNLOAD_MAX)?;
        self.expect_len(DOWNLOAD_HEAD_LEN + len)?;
        let address = self.at(DOWNLOAD_HEAD_LEN);
        let received = self.station.take_block(offset, address, len)?;
        self.received(received)
    }

    /// Answers how many bytes have come.
    fn received(&mut self, bytes: u16) -> Answered {
        self.out = HEAD_LEN;
        self.put_word(bytes);
        Ok(self.out)
    }

    fn end_download(&mut self) -> Answered {
        self.expect_len(HEAD_LEN)?;
        let fault = self.station.end_download()?;
        self.out = HEAD_LEN;
        self.put_bytes(fault);
        Ok(self.out)
    }
}
