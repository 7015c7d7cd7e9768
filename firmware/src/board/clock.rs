//! The millisecond tick, which tick.s counts, and its finer measure, by Timer0. Time is only handed
//! out here; what it means is not known. The other timers are left to the modules of a program.

use core::cell::Cell;

use avr_device::atmega328p::TC0;
use avr_device::interrupt::{self, Mutex};

/// Timer counts of 4 us in a millisecond.
pub const COUNTS_PER_MS: u8 = 250;

/// Milliseconds since power-up. Wraps after 49.7 days. Harnesses read and write it by this name;
/// machine code of programs reads it at [`plc_isa::CLOCK`], which is where this section begins.
#[unsafe(no_mangle)]
#[unsafe(link_section = ".bss")]
pub static UNO200_TICK: Mutex<Cell<u32>> = Mutex::new(Cell::new(0));

/// Starts it.
pub fn start() {
    // SAFETY: before interrupts are enabled; nobody writes its registers later.
    let timer = unsafe { TC0::steal() };
    timer.ocr0a().write(|w| w.set(COUNTS_PER_MS - 1));
    timer.tccr0a().write(|w| w.wgm0().ctc());
    timer.tccr0b().write(|w| w.cs0().prescale_64());
    timer.timsk0().write(|w| w.ocie0a().set_bit());
}

/// The millisecond clock.
#[inline(never)]
pub fn now_ms() -> u32 {
    interrupt::free(|cs| UNO200_TICK.borrow(cs).get())
}

/// Its lower half, for what takes no longer than a minute.
#[inline(always)]
pub fn now_ms_low() -> u16 {
    interrupt::free(|cs| UNO200_TICK.borrow(cs).get()) as u16
}

/// A moment in time, to the timer's count. Moments repeat after 65 seconds.
#[derive(Clone, Copy)]
pub struct Moment {
    /// The lower half of the clock, low byte first.
    pub ms: [u8; 2],
    /// Counts of 4 us in this millisecond.
    pub counts: u8,
}

impl Moment {
    /// This one. With interrupts enabled: the timer begins again, and its interrupt comes, before
    /// or after both readings.
    #[inline(always)]
    pub fn now() -> Moment {
        let tick = (&raw const UNO200_TICK).cast::<u8>();
        loop {
            // SAFETY: bytes of the clock are read, which its interrupt alone changes, and a
            // register of its timer.
            let (low, high, counts, again) = unsafe {
                let (low, high) = (tick.read_volatile(), tick.add(1).read_volatile());
                (low, high, TC0::steal().tcnt0().read().bits(), tick.read_volatile())
            };
            if low == again {
                return Moment { ms: [low, high], counts };
            }
        }
    }
}
