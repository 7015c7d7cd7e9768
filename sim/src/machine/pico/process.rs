//! The process that the emulator runs in: it is started, asked and ended here. What is asked is not
//! known.

use std::env;
use std::io::{self, BufReader, Read, Write};
use std::path::PathBuf;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use anyhow::{Context, Result, bail};

/// Below the repository's root.
const SCRIPT: &str = "sim/pico/serve.mjs";
/// More than any answer has.
const ANSWER_MAX: usize = 1 << 20;
/// Before the bytes of an answer.
const IS_ANSWER: u8 = 0;

/// A running emulator. It ends with its standard input.
pub(super) struct Process {
    child: Child,
    requests: Option<ChildStdin>,
    answers: BufReader<ChildStdout>,
}

impl Process {
    /// Starts it. Without Node.js or without the emulator's package the error says what to do.
    pub(super) fn start() -> Result<Process> {
        let script = script()?;
        let mut child = Command::new("node")
            .arg(&script)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .context("cannot start node, which runs the emulator of the Pico: install Node.js")?;
        let (requests, answers) = (child.stdin.take(), child.stdout.take());
        let answers = BufReader::new(answers.context("node has no standard output")?);
        let mut process = Process { child, requests, answers };
        if let Err(error) = process.answer() {
            let folder = script.parent().map(|folder| folder.display().to_string());
            let folder = folder.unwrap_or_default();
            bail!("the emulator of the Pico: {error}; `npm ci` in {folder} installs it");
        }
        Ok(process)
    }

    /// Asks and waits for the answer. An error is a sentence without full stop.
    pub(super) fn ask(&mut self, request: &[u8]) -> Result<Vec<u8>, String> {
        let sent = self.send(request);
        sent.map_err(|error| format!("the emulator of the Pico has ended: {error}"))?;
        self.answer()
    }

    fn send(&mut self, request: &[u8]) -> io::Result<()> {
        let Some(requests) = &mut self.requests else { return Ok(()) };
        let len = request.len() as u32;
        requests.write_all(&[&len.to_le_bytes(), request].concat())?;
        requests.flush()
    }

    fn answer(&mut self) -> Result<Vec<u8>, String> {
        let (is_answer, bytes) = self
            .receive()
            .map_err(|error| format!("the emulator of the Pico has ended: {error}"))?;
        match is_answer {
            true => Ok(bytes),
            false => Err(String::from_utf8_lossy(&bytes).into_owned()),
        }
    }

    fn receive(&mut self) -> io::Result<(bool, Vec<u8>)> {
        let mut head = [0; 5];
        self.answers.read_exact(&mut head)?;
        let [a, b, c, d, kind] = head;
        let len = u32::from_le_bytes([a, b, c, d]) as usize;
        if !(1..=ANSWER_MAX).contains(&len) {
            return Err(io::Error::new(io::ErrorKind::InvalidData, "that is no answer"));
        }
        let mut bytes = vec![0; len - 1];
        self.answers.read_exact(&mut bytes)?;
        Ok((kind == IS_ANSWER, bytes))
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        drop(self.requests.take());
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The script: in the folders above the running program and above the current one.
fn script() -> Result<PathBuf> {
    let program = env::current_exe().unwrap_or_default();
    let here = env::current_dir().unwrap_or_default();
    let folders = here.ancestors().chain(program.ancestors());
    let candidates: Vec<PathBuf> = folders.map(|folder| folder.join(SCRIPT)).collect();
    match candidates.iter().find(|path| path.is_file()) {
        Some(path) => Ok(path.clone()),
        None => bail!(
            "the emulator of the Pico is part of the repository; looked for{}",
            super::lines(&candidates)
        ),
    }
}
