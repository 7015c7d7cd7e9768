//! The IDE without its pixels: a project of texts, what is wrong with them, a PLC behind its line,
//! live values. Requests in, events out; no file, clock, socket or page is known here.
//!
//! [`Session`] is all of it; [`protocol`] is what it is told and what it tells. The same code runs
//! natively in tests and as WebAssembly in a worker of the page.

mod apart;
mod build;
mod chart;
mod editor;
mod ladder;
mod lock_step;
mod offsets;
mod outside;
mod pace;
mod plc;
mod pulse;
mod recorder;
mod sampler;
mod scope;
mod session;
mod simulator;
mod surroundings;
mod told;
mod trail;

pub mod protocol;

pub use session::Session;

/// What JavaScript calls.
#[cfg(target_arch = "wasm32")]
mod page {
    use awl_sim::machine::emulated::Chip;
    use wasm_bindgen::prelude::wasm_bindgen;

    use crate::Session;

    #[wasm_bindgen]
    extern "C" {
        /// An emulated chip, whatever emulates it. What its methods are is told in [`Chip`].
        pub type JsChip;
        #[wasm_bindgen(method, js_name = powerOn)]
        fn power_on(this: &JsChip, flash: &[u8]);
        #[wasm_bindgen(method)]
        fn run(this: &JsChip, cycles: u32) -> u8;
        #[wasm_bindgen(method)]
        fn data(this: &JsChip) -> Vec<u8>;
        #[wasm_bindgen(method)]
        fn write(this: &JsChip, address: u16, byte: u8);
        #[wasm_bindgen(method)]
        fn drive(this: &JsChip, levels: u8, counts: &[u16]);
    }

    impl Chip for JsChip {
        fn power_on(&mut self, flash: &[u8]) {
            JsChip::power_on(self, flash);
        }

        fn run(&mut self, cycles: u32) -> u8 {
            JsChip::run(self, cycles)
        }

        fn data(&self) -> Vec<u8> {
            JsChip::data(self)
        }

        fn write(&mut self, address: u16, byte: u8) {
            JsChip::write(self, address, byte);
        }

        fn drive(&mut self, levels: u8, counts: &[u16]) {
            JsChip::drive(self, levels, counts);
        }
    }

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

        /// See [`Session::is_behind`].
        #[wasm_bindgen(js_name = isBehind)]
        pub fn is_behind(&self) -> bool {
            self.0.is_behind()
        }

        /// See [`Session::receive`].
        pub fn receive(&mut self, bytes: &[u8], now_ms: f64) -> String {
            crate::session::json(&self.0.receive(bytes, now_ms as u64))
        }

        /// See [`Session::compare`]; the answer is scans and operands, or text: what differs.
        #[wasm_bindgen(js_name = compare)]
        pub fn compare(
            &self,
            chip: JsChip,
            scenario: Option<String>,
            for_ms: u32,
            plant: Option<String>,
        ) -> Result<Vec<u32>, String> {
            let compared = self.0.compare(chip, scenario.as_deref(), for_ms, plant.as_deref());
            compared.map(|(scans, operands)| vec![scans as u32, operands as u32])
        }

        /// See [`Session::chip_due_ms`].
        #[wasm_bindgen(js_name = chipDueMs)]
        pub fn chip_due_ms(&self) -> u32 {
            self.0.chip_due_ms()
        }

        /// See [`Session::chip_pins`].
        #[wasm_bindgen(js_name = chipPins)]
        pub fn chip_pins(&self) -> Vec<u16> {
            self.0.chip_pins().to_vec()
        }

        /// See [`Session::chip_bytes`].
        #[wasm_bindgen(js_name = chipBytes)]
        pub fn chip_bytes(&mut self) -> Vec<u8> {
            self.0.chip_bytes()
        }

        /// See [`Session::chip_passed`].
        #[wasm_bindgen(js_name = chipPassed)]
        pub fn chip_passed(&mut self, data: &[u8]) -> Vec<u16> {
            self.0.chip_passed(data).to_vec()
        }
    }
}
