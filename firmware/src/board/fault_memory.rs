//! The last fault, in SRAM that a reset leaves alone.

use core::mem::MaybeUninit;

/// A fault as [`Fault::to_word`](plc_vm::Fault::to_word), and whether it holds the board in STOP. Twice, the second time with
/// other bits, so that it is no accident of power-up.
#[derive(Clone, Copy)]
#[repr(C)]
struct Record {
    fault: u32,
    other_fault: u32,
    holds: u8,
    other_holds: u8,
}

/// How the second time differs.
const DIFFERENCE: u32 = 0x5AC3_3CA5;

#[unsafe(link_section = ".noinit")]
static mut RECORD: MaybeUninit<Record> = MaybeUninit::uninit();

/// Remembers a fault. `holds`: the board must not go to RUN by itself after the reset that follows.
#[inline(never)]
pub fn remember(fault: u32, holds: bool) {
    let record = (&raw mut RECORD).cast::<Record>();
    let holds = u8::from(holds);
    // SAFETY: written by the main program with nothing else running, or by an interrupt that never returns.
    unsafe {
        (&raw mut (*record).fault).write_volatile(fault);
        (&raw mut (*record).other_fault).write_volatile(fault ^ DIFFERENCE);
        (&raw mut (*record).holds).write_volatile(holds);
        (&raw mut (*record).other_holds).write_volatile(holds ^ DIFFERENCE as u8);
    }
}

/// The last fault, 0 if there is none. Whether it holds the board in STOP comes with it; it does so only once.
pub fn recall() -> (u32, bool) {
    // SAFETY: every value is valid for numbers, also those of power-up.
    let Record { fault, other_fault, holds, other_holds } = unsafe { (&raw const RECORD).cast::<Record>().read() };
    if fault ^ other_fault != DIFFERENCE || holds ^ other_holds != DIFFERENCE as u8 {
        return (0, false);
    }
    remember(fault, false);
    (fault, holds != 0)
}
