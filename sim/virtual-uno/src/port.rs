//! The board's USB serial port: a pseudo-terminal. Bytes both ways, whether another program has it
//! open, and how that has set the line.

use std::fs::{File, OpenOptions};
use std::io::{self, ErrorKind, Read, Write};
use std::os::unix::ffi::OsStringExt;
use std::path::{Path, PathBuf};

use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::{OFlags, fcntl_getfl, fcntl_setfl};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{ControlModes, OptionalActions, tcgetattr, tcsetattr};

/// What the line is set to before anybody sets it: a new Uno's sketches and bootloader talk so.
const USUAL_BAUD: u32 = 115_200;

/// How the program that has the port open has set it, or the last one that had.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Line {
    /// Bits a second.
    pub baud: u32,
    /// Whether DTR falls when the port is closed (HUPCL).
    pub hangs_up: bool,
}

/// The board's end of the port.
pub struct Port {
    end: File,
    path: PathBuf,
}

impl Port {
    /// A new port. Nobody has it open.
    pub fn new() -> io::Result<Port> {
        let end = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY)?;
        grantpt(&end)?;
        unlockpt(&end)?;
        let path =
            PathBuf::from(std::ffi::OsString::from_vec(ptsname(&end, Vec::new())?.into_bytes()));
        fcntl_setfl(&end, fcntl_getfl(&end)? | OFlags::NONBLOCK)?;
        let port = Port { end: end.into(), path };
        port.make_plain()?;
        Ok(port)
    }

    /// Bytes pass unchanged and without echo, as through a wire, and the settings are those of a
    /// serial port that nobody has set. Closing the other end again also makes that it counts as
    /// closed: one that was never open does not.
    fn make_plain(&self) -> io::Result<()> {
        let other = OpenOptions::new().read(true).write(true).open(&self.path)?;
        let mut attributes = tcgetattr(&other)?;
        attributes.make_raw();
        attributes.control_modes.insert(ControlModes::HUPCL);
        attributes.set_speed(USUAL_BAUD)?;
        tcsetattr(&other, OptionalActions::Now, &attributes)?;
        Ok(())
    }

    /// What other programs open.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether another program has it open.
    pub fn is_open(&self) -> io::Result<bool> {
        let mut ends = [PollFd::new(&self.end, PollFlags::empty())];
        poll(&mut ends, Some(&Timespec::default()))?;
        Ok(!ends[0].revents().contains(PollFlags::HUP))
    }

    /// How it is set.
    pub fn line(&self) -> io::Result<Line> {
        let attributes = tcgetattr(&self.end)?;
        Ok(Line {
            baud: attributes.output_speed(),
            hangs_up: attributes.control_modes.contains(ControlModes::HUPCL),
        })
    }

    /// What has been sent to the board.
    pub fn read(&mut self) -> io::Result<Vec<u8>> {
        let mut bytes = vec![0; 4096];
        let len = match self.end.read(&mut bytes) {
            Ok(len) => len,
            Err(error) if is_idle(&error) => 0,
            Err(error) => return Err(error),
        };
        bytes.truncate(len);
        Ok(bytes)
    }

    /// Sends to whoever has it open. As on a real board, nothing waits for a program that does not
    /// read.
    pub fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        match self.end.write(bytes) {
            Err(error) if !is_idle(&error) => Err(error),
            _ => Ok(()),
        }
    }
}

/// Whether this is no error: no bytes are there, there is no room, or the other end has just been
/// closed (EIO).
fn is_idle(error: &io::Error) -> bool {
    let closed = io::Error::from(rustix::io::Errno::IO);
    error.kind() == ErrorKind::WouldBlock || error.raw_os_error() == closed.raw_os_error()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn other_end(port: &Port) -> File {
        OpenOptions::new().read(true).write(true).open(port.path()).unwrap()
    }

    #[test]
    fn open_while_another_program_has_it() {
        let port = Port::new().unwrap();
        for _ in 0..2 {
            assert!(!port.is_open().unwrap());
            let other = other_end(&port);
            assert!(port.is_open().unwrap());
            drop(other);
        }
        assert!(!port.is_open().unwrap());
    }

    #[test]
    fn all_bytes_pass_unchanged_and_without_echo() {
        let mut port = Port::new().unwrap();
        assert_eq!(port.read().unwrap(), [], "closed");
        let mut other = other_end(&port);
        let all: Vec<u8> = (0..=255).collect();
        other.write_all(&all).unwrap();
        assert_eq!(port.read().unwrap(), all);
        port.write(&all).unwrap();
        let mut seen = [0; 256];
        other.read_exact(&mut seen).unwrap();
        assert_eq!(seen[..], all);
        assert_eq!(port.read().unwrap(), [], "an echo");
    }

    #[test]
    fn settings_outlive_the_program_that_made_them() {
        let port = Port::new().unwrap();
        assert_eq!(port.line().unwrap(), Line { baud: USUAL_BAUD, hangs_up: true });
        let other = other_end(&port);
        let mut attributes = tcgetattr(&other).unwrap();
        attributes.control_modes.remove(ControlModes::HUPCL);
        attributes.set_speed(9_600).unwrap();
        tcsetattr(&other, OptionalActions::Now, &attributes).unwrap();
        drop(other);
        assert_eq!(port.line().unwrap(), Line { baud: 9_600, hangs_up: false });
    }

    #[test]
    fn a_program_that_does_not_read_stops_nothing() {
        let mut port = Port::new().unwrap();
        let _other = other_end(&port);
        for _ in 0..100 {
            port.write(&[0x55; 1000]).unwrap();
        }
    }
}
