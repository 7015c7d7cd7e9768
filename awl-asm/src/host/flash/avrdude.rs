//! avrdude as a process: its arguments, its output, its end. What the output means is not known
//! here.

use std::ffi::OsString;
use std::io::{self, Read, Write};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use plc_isa::UNO;
use tempfile::TempPath;

/// The bootloader of the Uno. Older Nanos have another speed.
const BAUD: &str = "115200";

/// avrdude's words for a board that has answered: from here on it is never silent for long.
const BEGUN: &str = "initialized and ready";

/// How a run ended.
#[derive(Debug)]
pub struct Ended {
    /// Exit status; none if the time was over and it was killed.
    pub status: io::Result<Option<ExitStatus>>,
    /// What it wrote.
    pub output: String,
}

/// What avrdude is to do with an Intel HEX file.
pub struct Operation {
    verb: char,
    file: TempPath,
}

impl Operation {
    /// To write it, and to verify it then.
    pub fn write(file: TempPath) -> Operation {
        Operation { verb: 'w', file }
    }

    /// To compare the board with it.
    pub fn verify(file: TempPath) -> Operation {
        Operation { verb: 'v', file }
    }
}

/// How long a run may take.
#[derive(Debug, Clone, Copy)]
pub struct Patience {
    /// The whole of it.
    pub whole: Duration,
    /// Without a word, after the board has answered.
    pub silence: Duration,
}

/// The command that does this in one session. It ends at the first that fails.
///
/// `-D` because the bootloader cannot erase the chip: a page is erased when it is written, and all
/// others stay.
pub fn command(port: &str, operations: &[&Operation]) -> Command {
    let mut command = Command::new("avrdude");
    command.args([
        "-c",
        "arduino",
        "-p",
        UNO.avrdude_part.unwrap_or_default(),
        "-P",
        port,
        "-b",
        BAUD,
        "-D",
    ]);
    for operation in operations {
        let mut argument = OsString::from(format!("flash:{}:", operation.verb));
        argument.push(&operation.file);
        argument.push(":i");
        command.arg("-U").arg(argument);
    }
    command
}

/// Runs it to its end, but no longer than it may take.
pub fn run(mut command: Command, patience: Patience, echo: bool) -> Ended {
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = match command.spawn() {
        Ok(child) => child,
        Err(error) => return Ended { status: Err(error), output: String::new() },
    };
    let messages = child.stderr.take();
    let heard = Heard::default();
    let status = thread::scope(|scope| {
        // It ends with the child.
        scope.spawn(|| messages.map(|messages| heard.collect(messages, echo)));
        wait(&mut child, &heard, patience)
    });
    Ended { status, output: heard.text() }
}

fn wait(child: &mut Child, heard: &Heard, patience: Patience) -> io::Result<Option<ExitStatus>> {
    let start = Instant::now();
    while start.elapsed() < patience.whole && !heard.is_silent_for(patience.silence) {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        thread::sleep(Duration::from_millis(10));
    }
    child.kill()?;
    child.wait().map(|_| None)
}

/// What avrdude has written so far, and when the last of it came.
#[derive(Default)]
struct Heard(Mutex<(Vec<u8>, Option<Instant>)>);

impl Heard {
    fn collect(&self, mut messages: impl Read, echo: bool) {
        let mut buffer = [0; 256];
        while let Ok(len @ 1..) = messages.read(&mut buffer) {
            let new = &buffer[..len];
            let mut heard = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            heard.0.extend_from_slice(new);
            heard.1 = Some(Instant::now());
            drop(heard);
            if echo {
                // Nobody is left to tell when stderr is closed.
                let _ = io::stderr().write_all(new);
            }
        }
    }

    fn text(&self) -> String {
        let heard = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        String::from_utf8_lossy(&heard.0).into_owned()
    }

    /// Whether the board has answered, and nothing came for so long.
    fn is_silent_for(&self, time: Duration) -> bool {
        let last = self.0.lock().unwrap_or_else(PoisonError::into_inner).1;
        last.is_some_and(|last| last.elapsed() > time) && self.text().contains(BEGUN)
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    fn patience(whole_ms: u64, silence_ms: u64) -> Patience {
        Patience {
            whole: Duration::from_millis(whole_ms),
            silence: Duration::from_millis(silence_ms),
        }
    }

    fn shell(script: &str, patience: Patience) -> Ended {
        let mut command = Command::new("sh");
        command.args(["-c", script]);
        run(command, patience, false)
    }

    #[test]
    fn its_messages_and_its_end() {
        let ended = shell("echo ignored; echo failed >&2; exit 3", patience(30_000, 30_000));
        assert_eq!(
            (ended.status.unwrap().and_then(|status| status.code()), &*ended.output),
            (Some(3), "failed\n")
        );
    }

    #[test]
    fn one_that_hangs_is_ended() {
        let start = Instant::now();
        let ended = shell("echo first >&2; exec sleep 60", patience(200, 30_000));
        assert!(ended.status.unwrap().is_none());
        assert_eq!(ended.output, "first\n");
        assert!(start.elapsed() < Duration::from_secs(30));
    }

    #[test]
    fn a_board_that_falls_silent_is_given_up_early() {
        let start = Instant::now();
        let silent = shell(
            "echo 'AVR device initialized and ready to accept instructions' >&2; exec sleep 60",
            patience(60_000, 200),
        );
        assert!(silent.status.unwrap().is_none());
        assert!(start.elapsed() < Duration::from_secs(30));
        let slow = shell("echo trying >&2; sleep 1; exit 3", patience(60_000, 200));
        assert!(slow.status.unwrap().is_some(), "it may try for long");
    }

    #[test]
    fn one_that_is_not_there() {
        let ended = run(Command::new("no-such-program-as-this"), patience(30_000, 30_000), false);
        assert_eq!(ended.status.unwrap_err().kind(), io::ErrorKind::NotFound);
    }
}
