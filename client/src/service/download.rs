//! A program over the line, block by block, while another one may be in force.

use plc_link::protocol::{DOWNLOAD, DOWNLOAD_HEAD_LEN, DOWNLOAD_MAX};

use super::Question;
use super::fields::Fields;
use crate::error::Error;

const BEGIN: u8 = 1;
const BLOCK: u8 = 2;
const END: u8 = 3;
/// Function code and action, which begin an answer too.
const ACTION_LEN: usize = 2;

/// A program of so many bytes comes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BeginDownload(pub u16);

impl Question for BeginDownload {
    type Answer = ();

    fn request(&self) -> Result<Vec<u8>, Error> {
        let [high, low] = self.0.to_be_bytes();
        Ok(vec![DOWNLOAD, BEGIN, high, low])
    }

    fn answer(&self, answer: &[u8]) -> Result<(), Error> {
        expect_received(answer, 0)
    }
}

/// Bytes of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DownloadBlock<'a> {
    /// Where in the image they are.
    pub offset: u16,
    /// 1 to [`DOWNLOAD_MAX`] of them.
    pub bytes: &'a [u8],
}

impl Question for DownloadBlock<'_> {
    type Answer = ();

    fn request(&self) -> Result<Vec<u8>, Error> {
        let [high, low] = self.offset.to_be_bytes();
        let head = [DOWNLOAD, BLOCK, high, low, self.bytes.len() as u8];
        Ok([&head, self.bytes].concat())
    }

    fn answer(&self, answer: &[u8]) -> Result<(), Error> {
        expect_received(answer, self.offset + self.bytes.len() as u16)
    }
}

/// How many bytes the PLC has, which must be so many.
fn expect_received(answer: &[u8], count: u16) -> Result<(), Error> {
    let mut fields = Fields::of(answer.get(ACTION_LEN - 1..).unwrap_or_default());
    let received = fields.word()?;
    if received == count {
        return Ok(());
    }
    Err(Error::BadAnswer(format!("the PLC has {received} bytes of the program, not {count}")))
}

/// All of it has come. The answer is the fault that loading it would have, all zeros without one,
/// as [`plc_vm::Fault`] writes it. An answer that is lost leaves open whether it is in force.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct EndDownload;

impl Question for EndDownload {
    type Answer = [u8; 4];

    fn request(&self) -> Result<Vec<u8>, Error> {
        Ok(vec![DOWNLOAD, END])
    }

    fn answer(&self, answer: &[u8]) -> Result<[u8; 4], Error> {
        Fields::of(answer.get(ACTION_LEN - 1..).unwrap_or_default()).four()
    }

    fn is_repeatable(&self) -> bool {
        false
    }
}

/// The blocks of an image, each as long as the PLC has room for.
pub fn blocks(image: &[u8], room: u16) -> impl Iterator<Item = DownloadBlock<'_>> {
    let head = u16::from(DOWNLOAD_HEAD_LEN);
    let len = room.saturating_sub(head).clamp(1, DOWNLOAD_MAX.into());
    let offsets = (0..=u16::MAX).step_by(len.into());
    let blocks = offsets.zip(image.chunks(len.into()));
    blocks.map(|(offset, bytes)| DownloadBlock { offset, bytes })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_fit_the_room_and_are_all_of_the_image() {
        let image: Vec<u8> = (0..=255).cycle().take(65_000).collect();
        for (room, len) in [(62, 57), (252, 240), (245, 240), (244, 239)] {
            let all: Vec<_> = blocks(&image, room).collect();
            assert!(all.iter().all(|block| block.bytes.len() <= len), "{room}");
            assert_eq!(all[0].bytes.len(), len);
            let together: Vec<u8> = all.iter().flat_map(|block| block.bytes).copied().collect();
            assert!(together == image);
            let last = all.last().unwrap();
            assert_eq!(usize::from(last.offset) + last.bytes.len(), image.len());
        }
    }

    #[test]
    fn what_the_plc_has_must_be_what_was_sent() {
        let block = DownloadBlock { offset: 0x0102, bytes: &[7, 8, 9] };
        assert_eq!(block.request().unwrap(), [101, 2, 1, 2, 3, 7, 8, 9]);
        assert_eq!(block.answer(&[101, 2, 1, 5]), Ok(()));
        assert!(block.answer(&[101, 2, 1, 4]).is_err() && block.answer(&[101]).is_err());
        assert_eq!(BeginDownload(0x1234).request().unwrap(), [101, 1, 0x12, 0x34]);
        assert_eq!(BeginDownload(5).answer(&[101, 1, 0, 0]), Ok(()));
        assert_eq!(EndDownload.request().unwrap(), [101, 3]);
        assert_eq!(EndDownload.answer(&[101, 3, 1, 5, 2, 0]), Ok([1, 5, 2, 0]));
        assert!(!EndDownload.is_repeatable());
    }
}
