//! What is to be written, page by page. The order makes that an interrupted board never runs half
//! of it:
//!
//! 1. Page 0 becomes an endless loop, if the firmware is written; the program's first page becomes
//!    blank. From here on no firmware starts, or it finds no program: outputs stay off.
//! 2. All other pages are written, then all of them are read back.
//! 3. The program's first page, then page 0, get what belongs there.

use std::fmt;

use plc_isa::UNO;

use crate::PAGE_LEN;
use crate::failure::Holds;

/// Bytes of the firmware that tell it from others: interrupt vectors and start-up code, which know
/// where all the rest is.
const HEAD_LEN: usize = 1024;
/// What flash has where nothing is written.
const BLANK: u8 = 0xFF;
/// `rjmp` to itself: whoever comes here stays, with interrupts off and all pins inputs.
const TRAP: [u8; 2] = [0xFF, 0xCF];

/// The firmware, as bytes from address 0.
#[derive(Debug, Clone, Copy)]
pub enum Firmware<'a> {
    /// It is written, too.
    Write(&'a [u8]),
    /// It must be there: a board without it is left as it is.
    Expect(&'a [u8]),
}

/// What cannot be written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unfit {
    /// There is no firmware, or it reaches into the program slot.
    Firmware,
    /// There is no image, or it is longer than the program slot.
    Image,
}

impl fmt::Display for Unfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Unfit::Firmware => "the firmware does not fit in front of the program slot",
            Unfit::Image => "the program does not fit in the program slot of the Uno",
        })
    }
}

impl std::error::Error for Unfit {}

/// A page, or the beginning of one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Page {
    /// Address of its first byte.
    pub(crate) at: u16,
    /// Its bytes.
    pub(crate) bytes: Vec<u8>,
}

/// What is done one after the other.
#[derive(Debug, Clone)]
pub(crate) enum Step {
    /// Asks which chip it is.
    Identify,
    /// Compares a page with the firmware that must be there.
    Expect(Page),
    /// Writes a page. What the board holds from when the page is sent, and from when it is written.
    Write { page: Page, sent: Holds, written: Holds },
    /// Reads a page back.
    Verify(Page),
    /// Has the board start.
    Leave,
}

impl Step {
    /// The page, where there is one.
    pub(crate) fn page(&self) -> Option<&Page> {
        match self {
            Step::Expect(page) | Step::Verify(page) | Step::Write { page, .. } => Some(page),
            Step::Identify | Step::Leave => None,
        }
    }
}

/// What is to be done to a board.
#[derive(Debug, Clone)]
pub struct Job {
    pub(crate) steps: Vec<Step>,
}

impl Job {
    /// Writes a program image to the program slot, and the firmware where that is asked for.
    pub fn new(firmware: Firmware<'_>, image: &[u8]) -> Result<Job, Unfit> {
        let (Firmware::Write(code) | Firmware::Expect(code)) = firmware;
        if code.is_empty() || code.len() > usize::from(UNO.slot_start) {
            return Err(Unfit::Firmware);
        }
        if image.is_empty() || image.len() > usize::from(UNO.slot_len) {
            return Err(Unfit::Image);
        }
        let program = pages(UNO.slot_start, image);
        let mut steps = vec![Step::Identify];
        match firmware {
            Firmware::Expect(code) => {
                let head = &code[..code.len().min(HEAD_LEN)];
                steps.extend(pages(0, head).into_iter().map(Step::Expect));
                steps.extend(guarded(&[&program], Holds::NoProgram));
            }
            Firmware::Write(code) => {
                steps.extend(guarded(&[&pages(0, code), &program], Holds::NoFirmware));
            }
        }
        steps.push(Step::Leave);
        Ok(Job { steps })
    }
}

/// Bytes from an address on as pages, the last one filled up.
fn pages(start: u16, bytes: &[u8]) -> Vec<Page> {
    let page = |(at, bytes): (u16, &[u8])| {
        let mut bytes = bytes.to_vec();
        bytes.resize(PAGE_LEN, BLANK);
        Page { at, bytes }
    };
    (start..).step_by(PAGE_LEN).zip(bytes.chunks(PAGE_LEN)).map(page).collect()
}

/// Writes and reads back parts, the first page of each last. A part counts only when its first page
/// is there, and the first part guards all others.
fn guarded(parts: &[&[Page]], meanwhile: Holds) -> Vec<Step> {
    let write = |page: Page, sent, written| Step::Write { page, sent, written };
    let firsts: Vec<&Page> = parts.iter().filter_map(|part| part.first()).collect();
    let rest: Vec<&Page> = parts.iter().flat_map(|part| part.iter().skip(1)).collect();
    let mut steps = Vec::new();
    for (index, first) in firsts.iter().enumerate() {
        let sent = if index == 0 { Holds::BeforeOrNothing } else { meanwhile };
        steps.push(write(invalid(first.at), sent, meanwhile));
        steps.push(Step::Verify(invalid(first.at)));
    }
    steps.extend(rest.iter().map(|page| write((*page).clone(), meanwhile, meanwhile)));
    steps.extend(rest.iter().map(|page| Step::Verify((*page).clone())));
    for (index, first) in firsts.iter().enumerate().rev() {
        let (sent, written) = match index {
            0 => (Holds::NewOrNothing, Holds::New),
            _ => (meanwhile, meanwhile),
        };
        steps.push(write((*first).clone(), sent, written));
        steps.push(Step::Verify((*first).clone()));
    }
    steps
}

/// The page that nothing runs with: of the firmware a trap in every word, of a program none.
fn invalid(at: u16) -> Page {
    let bytes = if at == 0 { TRAP.repeat(PAGE_LEN / 2) } else { vec![BLANK; PAGE_LEN] };
    Page { at, bytes }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(job: &Job) -> Vec<(u16, u8)> {
        let write = |step: &Step| match step {
            Step::Write { page, .. } => Some((page.at, page.bytes[0])),
            _ => None,
        };
        job.steps.iter().filter_map(write).collect()
    }

    #[test]
    fn what_makes_it_valid_is_made_invalid_first_and_written_last() {
        let code = [0x0C; 300];
        let image = [0x55; 129];
        let job = Job::new(Firmware::Expect(&code), &image).unwrap();
        assert_eq!(written(&job), [(0x6000, 0xFF), (0x6080, 0x55), (0x6000, 0x55)]);
        let job = Job::new(Firmware::Write(&code), &image).unwrap();
        let invalid = [(0, 0xFF), (0x6000, 0xFF)];
        let rest = [(0x80, 0x0C), (0x100, 0x0C), (0x6080, 0x55)];
        let last = [(0x6000, 0x55), (0, 0x0C)];
        assert_eq!(written(&job), [&invalid[..], &rest, &last].concat());
    }

    #[test]
    fn every_page_is_read_back_before_it_counts() {
        let job = Job::new(Firmware::Write(&[0x0C; 300]), &[0x55; 300]).unwrap();
        let mut unread: Vec<&Page> = Vec::new();
        for step in &job.steps {
            match step {
                Step::Write { page, written: Holds::New, .. } => {
                    assert!(unread.is_empty(), "{unread:?}");
                    unread.push(page);
                }
                Step::Write { page, .. } => unread.push(page),
                Step::Verify(page) => unread.retain(|one| *one != page),
                Step::Identify | Step::Expect(_) | Step::Leave => {}
            }
        }
        assert!(unread.is_empty(), "{unread:?}");
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let slot = usize::from(UNO.slot_len);
        let unfit = |firmware: usize, image: usize| {
            let (firmware, image) = (vec![0; firmware], vec![0; image]);
            let expect = Job::new(Firmware::Expect(&firmware), &image).err();
            assert_eq!(expect, Job::new(Firmware::Write(&firmware), &image).err());
            expect
        };
        assert_eq!(unfit(1, 1), None);
        assert_eq!(unfit(usize::from(UNO.slot_start), slot), None);
        for firmware in [0, usize::from(UNO.slot_start) + 1] {
            assert_eq!(unfit(firmware, 1), Some(Unfit::Firmware));
        }
        for image in [0, slot + 1] {
            assert_eq!(unfit(1, image), Some(Unfit::Image));
        }
    }
}
