//! The last fault, in SRAM that a reset leaves alone.

use core::mem::MaybeUninit;

/// Bytes of what is remembered.
const LEN: usize = 5;

/// A fault as [`Fault::to_word`](plc_vm::Fault::to_word), and whether it holds the board in STOP.
/// The same again with other bits, so that it is no accident of power-up.
#[repr(C)]
struct Record {
    fault: u32,
    holds: u8,
    others: [u8; LEN],
}

/// How the second time differs, byte by byte.
const DIFFERENCE: u8 = 0xA5;

#[unsafe(link_section = ".noinit")]
static mut RECORD: MaybeUninit<Record> = MaybeUninit::uninit();

fn record() -> *mut Record {
    (&raw mut RECORD).cast()
}

/// Remembers a fault. `holds`: the board must not go to RUN by itself after the reset that follows.
#[inline(never)]
pub fn remember(fault: u32, holds: bool) {
    let (record, bytes) = (record(), record().cast::<u8>());
    // SAFETY: written by the main program with nothing else running, or by an interrupt that never
    // returns.
    unsafe {
        (&raw mut (*record).fault).write_volatile(fault);
        (&raw mut (*record).holds).write_volatile(u8::from(holds));
        for at in 0..LEN {
            let byte = bytes.add(at).read_volatile();
            bytes.add(LEN + at).write_volatile(byte ^ DIFFERENCE);
        }
    }
}

/// The last fault, 0 if there is none. Whether it holds the board in STOP comes with it; it does so
/// only once.
pub fn recall() -> (u32, bool) {
    let (record, bytes) = (record(), record().cast::<u8>());
    // SAFETY: every value is valid for numbers, also those of power-up.
    let (fault, holds) = unsafe {
        for at in 0..LEN {
            if bytes.add(at).read_volatile() ^ bytes.add(LEN + at).read_volatile() != DIFFERENCE {
                return (0, false);
            }
        }
        ((*record).fault, (*record).holds)
    };
    remember(fault, false);
    (fault, holds != 0)
}
