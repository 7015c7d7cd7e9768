//! avrdude as a process: its arguments, its output, its end. What the output means is not known here.

use std::ffi::OsString;
use std::io::{self, Read, Write};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// The bootloader of the Uno. Older Nanos have another speed.
const BAUD: &str = "115200";

/// How a run ended.
#[derive(Debug)]
pub struct Ended {
    /// Exit status; none if the time was over and it was killed.
    pub status: io::Result<Option<ExitStatus>>,
    /// What it wrote.
    pub output: String,
}

/// The command that writes and verifies these Intel HEX files, in their order, in one session.
///
/// `-D` because the bootloader cannot erase the chip: a page is erased when it is written, and all others stay.
pub fn command(port: &str, files: &[&Path]) -> Command {
    let mut command = Command::new("avrdude");
    command.args(["-c", "arduino", "-p", "m328p", "-P", port, "-b", BAUD, "-D"]);
    for file in files {
        let mut operation = OsString::from("flash:w:");
        operation.push(file);
        operation.push(":i");
        command.arg("-U").arg(operation);
    }
    command
}

/// Runs it to its end, but no longer than that.
pub fn run(mut command: Command, time_max: Duration, echo: bool) -> Ended {
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = match command.spawn() {
        Ok(child) => child,
        Err(error) => return Ended { status: Err(error), output: String::new() },
    };
    let messages = child.stderr.take();
    let reader = thread::spawn(move || messages.map(|messages| collect(messages, echo)).unwrap_or_default());
    let status = wait(&mut child, time_max);
    // The reader ends with the child; it panics nowhere.
    Ended { status, output: reader.join().unwrap_or_default() }
}

fn wait(child: &mut Child, time_max: Duration) -> io::Result<Option<ExitStatus>> {
    let start = Instant::now();
    while start.elapsed() < time_max {
        if let Some(status) = child.try_wait()? {
            return Ok(Some(status));
        }
        thread::sleep(Duration::from_millis(10));
    }
    child.kill()?;
    child.wait().map(|_| None)
}

fn collect(mut messages: impl Read, echo: bool) -> String {
    let mut all = Vec::new();
    let mut buffer = [0; 256];
    while let Ok(len @ 1..) = messages.read(&mut buffer) {
        let new = &buffer[..len];
        all.extend_from_slice(new);
        if echo {
            // Nobody is left to tell when stderr is closed.
            let _ = io::stderr().write_all(new);
        }
    }
    String::from_utf8_lossy(&all).into_owned()
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    fn shell(script: &str, time_max: Duration) -> Ended {
        let mut command = Command::new("sh");
        command.args(["-c", script]);
        run(command, time_max, false)
    }

    #[test]
    fn its_messages_and_its_end() {
        let ended = shell("echo ignored; echo failed >&2; exit 3", Duration::from_secs(30));
        assert_eq!((ended.status.unwrap().and_then(|status| status.code()), &*ended.output), (Some(3), "failed\n"));
    }

    #[test]
    fn one_that_hangs_is_ended() {
        let start = Instant::now();
        let ended = shell("echo first >&2; exec sleep 60", Duration::from_millis(200));
        assert!(ended.status.unwrap().is_none());
        assert_eq!(ended.output, "first\n");
        assert!(start.elapsed() < Duration::from_secs(30));
    }

    #[test]
    fn one_that_is_not_there() {
        let ended = run(Command::new("no-such-program-as-this"), Duration::from_secs(30), false);
        assert_eq!(ended.status.unwrap_err().kind(), io::ErrorKind::NotFound);
    }
}
