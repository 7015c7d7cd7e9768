//! Faults: why the controller went to STOP by itself, in words for programs and in bytes for the
//! board.

use plc_isa::{ImageError, ImageFault};

/// Why the controller went to STOP by itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fault {
    /// The image is not valid. The offset in the error counts from the image's first byte.
    BadImage(ImageError),
    /// The scan took longer than the watchdog time; the program was at this offset of the image.
    Watchdog {
        /// Offset of the instruction.
        at: u16,
    },
    /// There was no instruction where one was expected, at this offset of the image.
    UndefinedInstruction {
        /// Offset of the instruction.
        at: u16,
    },
    /// A comparison at this offset of the image read through an illegal pointer, or a text whose
    /// length is impossible.
    ComparedPointer {
        /// Offset of the instruction.
        at: u16,
    },
    /// A comparison at this offset of the image read an illegal real.
    ComparedReal {
        /// Offset of the instruction.
        at: u16,
    },
    /// Self-test of the board: the program in flash is no longer the one that was checked.
    ProgramChanged,
    /// Self-test of the board: the stack has grown into the firmware's variables.
    StackOverflow,
    /// The board's hardware watchdog: the firmware or its clock stood still.
    Hang,
    /// The firmware met a state that it holds for impossible.
    Panic,
}

impl Fault {
    /// No fault, as bytes.
    pub const NONE: [u8; 4] = [0; 4];

    /// [`to_bytes`](Self::to_bytes) as a number, low byte first; 0 stands for no fault.
    #[inline(always)]
    pub const fn to_word(self) -> u32 {
        u32::from_le_bytes(self.to_bytes())
    }

    /// [`BadImage`](Self::BadImage) as such a number.
    #[inline(always)]
    pub(crate) const fn bad_image(ImageError { fault, at }: ImageError) -> u32 {
        let [low, high] = at.to_le_bytes();
        u32::from_le_bytes([1, fault as u8, low, high])
    }

    /// The first of [`to_bytes`](Self::to_bytes).
    pub const fn code(self) -> u8 {
        self.to_bytes()[0]
    }

    /// Code, detail and offset, low byte first: how the board keeps and reports a fault.
    #[inline(always)]
    pub const fn to_bytes(self) -> [u8; 4] {
        let (code, at) = match self {
            Fault::BadImage(error) => return Self::bad_image(error).to_le_bytes(),
            Fault::Watchdog { at } => (2, at),
            Fault::UndefinedInstruction { at } => (3, at),
            Fault::ProgramChanged => (4, 0),
            Fault::StackOverflow => (5, 0),
            Fault::Hang => (6, 0),
            Fault::Panic => (7, 0),
            Fault::ComparedPointer { at } => (8, at),
            Fault::ComparedReal { at } => (9, at),
        };
        let [low, high] = at.to_le_bytes();
        [code, 0, low, high]
    }

    /// What happened, in words. Where there is a [place](Self::at), it belongs after them: "... at
    /// p.awl:3".
    pub const fn message(self) -> &'static str {
        match self {
            Fault::BadImage(_) => "bad image",
            Fault::Watchdog { .. } => "watchdog: the scan took too long; the program was",
            Fault::UndefinedInstruction { .. } => "there is no instruction",
            Fault::ComparedPointer { .. } => {
                "a comparison read through a pointer that leads to no value, or a text of \
                    impossible \
                 length (0011)"
            }
            Fault::ComparedReal { .. } => "a comparison read a real that is no number (0012)",
            Fault::ProgramChanged => "self-test: the program in flash has changed",
            Fault::StackOverflow => "self-test: the stack has grown into the firmware's variables",
            Fault::Hang => "the hardware watchdog: the firmware or its clock stood still",
            Fault::Panic => "the firmware met a state that it holds for impossible",
        }
    }

    /// Offset in the image of the instruction that the program was at; `None` where it was at none.
    pub const fn at(self) -> Option<u16> {
        match self {
            Fault::Watchdog { at }
            | Fault::UndefinedInstruction { at }
            | Fault::ComparedPointer { at }
            | Fault::ComparedReal { at } => Some(at),
            _ => None,
        }
    }

    /// The fault in such bytes; `None` for [`NONE`](Self::NONE) and what is no fault.
    pub fn from_bytes([code, detail, low, high]: [u8; 4]) -> Option<Fault> {
        let at = u16::from_le_bytes([low, high]);
        Some(match code {
            1 => Fault::BadImage(ImageError {
                fault: *ImageFault::ALL.get(usize::from(detail))?,
                at,
            }),
            2 => Fault::Watchdog { at },
            3 => Fault::UndefinedInstruction { at },
            4 => Fault::ProgramChanged,
            5 => Fault::StackOverflow,
            6 => Fault::Hang,
            7 => Fault::Panic,
            8 => Fault::ComparedPointer { at },
            9 => Fault::ComparedReal { at },
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Fault;
    use plc_isa::{ImageError, ImageFault};

    #[test]
    fn every_fault_survives_its_bytes() {
        let images = ImageFault::ALL.map(|fault| Fault::BadImage(ImageError { fault, at: 0x1234 }));
        let others = [
            Fault::Watchdog { at: 0xFEDC },
            Fault::UndefinedInstruction { at: 7 },
            Fault::ProgramChanged,
            Fault::StackOverflow,
            Fault::Hang,
            Fault::Panic,
            Fault::ComparedPointer { at: 3 },
            Fault::ComparedReal { at: 4 },
        ];
        for fault in images.into_iter().chain(others) {
            assert_eq!(Fault::from_bytes(fault.to_bytes()), Some(fault));
            assert_ne!(fault.to_bytes(), Fault::NONE);
        }
        assert_eq!(Fault::from_bytes(Fault::NONE), None);
        assert_eq!(Fault::from_bytes([10, 0, 0, 0]), None);
        assert_eq!(Fault::from_bytes([1, 99, 0, 0]), None);
    }
}
