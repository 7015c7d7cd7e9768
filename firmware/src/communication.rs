//! The communication phase of the scan: requests on the serial line are answered, a little in every
//! scan. What they mean is the engine's.

use crate::board::serial;
use crate::engine::link;
use crate::scan::Uno;

impl Uno {
    /// There is a request: answers it, or a part of it.
    #[inline(never)]
    pub fn talk(&mut self) {
        if serial::is_new() {
            link::forget();
        }
        let len = serial::take();
        if len == 0 {
            return serial::ignore();
        }
        let len = link::answer(len);
        match link::command() {
            link::STOP => self.stop(),
            link::CLEAR_FAULT => self.clear_fault(),
            link::RUN | link::SCANS => {
                self.is_run_requested = true;
                link::begin_scans();
            }
            _ => {}
        }
        if len != 0 {
            serial::send(link::frame(), len);
        }
    }
}
