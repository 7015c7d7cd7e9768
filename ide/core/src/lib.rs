//! The IDE without its pixels: a project of texts, what is wrong with them, a PLC behind its line,
//! live values. Requests in, events out; no file, clock, socket or page is known here.
//!
//! [`Session`] is all of it; [`protocol`] is what it is told and what it tells. The same code runs
//! natively in tests and as WebAssembly in a worker of the page.

mod apart;
mod build;
mod chip;
mod editor;
mod offsets;
mod outside;
mod pace;
mod plc;
mod pulse;
mod sampler;
mod scope;
mod session;
mod simulator;
mod told;

pub mod protocol;

pub use session::Session;

/// What JavaScript calls.
#[cfg(target_arch = "wasm32")]
mod page {
    use wasm_bindgen::prelude::wasm_bindgen;

    use crate::Session;

    /// A [`Session`]; what it takes and gives is JSON.
    #[wasm_bindgen]
    #[derive(Default)]
    pub struct Ide(Session);

    #[wasm_bindgen]
    impl Ide {
        /// With an empty project.
        #[wasm_bindgen(constructor)]
        pub fn new() -> Ide {
            Ide::default()
        }

        /// See [`Session::request_json`].
        pub fn request(&mut self, json: &str, now_ms: f64) -> String {
            self.0.request_json(json, now_ms as u64)
        }

        /// See [`Session::tick`].
        pub fn tick(&mut self, now_ms: f64, scans_max: u32) -> String {
            crate::session::json(&self.0.tick(now_ms as u64, scans_max))
        }

        /// See [`Session::receive`].
        pub fn receive(&mut self, bytes: &[u8], now_ms: f64) -> String {
            crate::session::json(&self.0.receive(bytes, now_ms as u64))
        }

        /// See [`Session::chip_due_ms`].
        #[wasm_bindgen(js_name = chipDueMs)]
        pub fn chip_due_ms(&self) -> u32 {
            self.0.chip_due_ms()
        }

        /// See [`Session::chip_passed`].
        #[wasm_bindgen(js_name = chipPassed)]
        pub fn chip_passed(&mut self, data: &[u8]) -> Vec<u16> {
            self.0.chip_passed(data).to_vec()
        }
    }
}
