//! A session that writes down what it is told and what it answers. WebAssembly is told the same
//! afterwards, and must answer the same: `ide/page/test/log.mjs`.

use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::thread;

use ide_core::Session;
use ide_core::protocol::{Event, Request};
use serde_json::json;

/// The session. Its log is in `target/tmp/ide-log`, a file for each test, a line of JSON for each
/// call.
#[derive(Default)]
pub struct Recorded {
    session: Session,
    log: String,
}

impl Recorded {
    /// See [`Session::request`].
    pub fn request(&mut self, request: Request, now_ms: u64) -> Vec<Event> {
        let json = json!(request).to_string();
        let events = self.session.request(request, now_ms);
        self.write("request", json!([json, now_ms]), &events);
        events
    }

    /// See [`Session::tick`].
    pub fn tick(&mut self, now_ms: u64, scans_max: u32) -> Vec<Event> {
        let events = self.session.tick(now_ms, scans_max);
        self.write("tick", json!([now_ms, scans_max]), &events);
        events
    }

    /// See [`Session::receive`].
    #[allow(dead_code, reason = "not every session has a line")]
    pub fn receive(&mut self, bytes: &[u8], now_ms: u64) -> Vec<Event> {
        let events = self.session.receive(bytes, now_ms);
        self.write("receive", json!([bytes, now_ms]), &events);
        events
    }

    /// See [`Session::request_json`].
    #[allow(dead_code, reason = "most tests have no JSON")]
    pub fn request_json(&mut self, request: &str, now_ms: u64) -> String {
        let answer = self.session.request_json(request, now_ms);
        self.write("request", json!([request, now_ms]), &serde_json::from_str(&answer).unwrap());
        answer
    }

    fn write(&mut self, call: &str, arguments: serde_json::Value, events: &Vec<Event>) {
        // As the answer is given to the page: the order of what is in it counts, too.
        let answer = serde_json::to_string(events).unwrap();
        let line = json!({ "call": call, "arguments": arguments, "answer": answer });
        writeln!(self.log, "{line}").unwrap();
    }
}

impl Drop for Recorded {
    fn drop(&mut self) {
        if thread::panicking() {
            return;
        }
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("ide-log");
        fs::create_dir_all(&folder).unwrap();
        let test = thread::current().name().unwrap().replace(':', "-");
        fs::write(folder.join(test).with_extension("jsonl"), &self.log).unwrap();
    }
}
