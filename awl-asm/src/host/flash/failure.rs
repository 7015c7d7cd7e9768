//! A failure in words: what happened, what helps, and avrdude's own last lines.

use std::error::Error;
use std::fmt;
use std::path::PathBuf;

use super::avrdude::Ended;
use super::cause::Cause;
use super::ports;

/// So many of avrdude's lines tell enough.
const LINES_MAX: usize = 4;

/// A board that could not be written.
#[derive(Debug)]
pub struct Failure {
    message: String,
    help: Vec<String>,
    lines: Vec<String>,
}

impl Failure {
    /// `shown` if avrdude's output has been on the screen already: it is not repeated.
    pub(super) fn new(port: &str, cause: Cause, ended: &Ended, shown: bool) -> Failure {
        Failure {
            message: message(port, &cause),
            help: help(port, &cause, ports::available()),
            lines: if shown { Vec::new() } else { last_lines(&ended.output) },
        }
    }
}

impl Error for Failure {}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        for help in &self.help {
            write!(f, "\n  = help: {help}")?;
        }
        for (index, line) in self.lines.iter().enumerate() {
            write!(f, "{}\n  {line}", if index == 0 { "\navrdude's last lines:" } else { "" })?;
        }
        Ok(())
    }
}

fn message(port: &str, cause: &Cause) -> String {
    match cause {
        Cause::NotInstalled => {
            "avrdude is not there: it is the program that writes the board".into()
        }
        Cause::NotStarted(why) => format!("cannot start avrdude: {why}"),
        Cause::TimedOut => format!("the board at {port} stopped answering"),
        Cause::NoPort => format!("there is no port {port}"),
        Cause::NoPermission => format!("no permission to open {port}"),
        Cause::PortBusy => format!("{port} is in use by another program"),
        Cause::NotSerial => format!("{port} is no serial port"),
        Cause::NoAnswer => format!("no bootloader answers at {port}"),
        Cause::OtherChip(chip) => {
            format!("the board at {port} has another chip than an Uno: {chip}")
        }
        Cause::NoSignature => format!("the board at {port} does not tell which chip it has"),
        Cause::Mismatch(Some(at)) => {
            format!("the board holds something else than was written, first at {at}")
        }
        Cause::Mismatch(None) => "the board holds something else than was written".into(),
        Cause::OtherFirmware => {
            format!("the board at {port} does not hold the uno200 firmware of this version")
        }
        Cause::Unknown => format!("avrdude could not write the board at {port}"),
    }
}

fn help(port: &str, cause: &Cause, ports: Option<Vec<PathBuf>>) -> Vec<String> {
    let lines: Vec<&str> = match cause {
        Cause::NotInstalled => vec![
            "Debian, Ubuntu: sudo apt-get install avrdude",
            "macOS: brew install avrdude",
            "Windows: unpack https://github.com/avrdudes/avrdude/releases into a folder on PATH",
        ],
        Cause::TimedOut => {
            vec!["is it still plugged in? Plug it in again, then repeat the command"]
        }
        Cause::NoPort | Cause::NotSerial => return vec![ports_in_words(ports)],
        Cause::NoPermission => vec![
            "Linux: sudo usermod -aG dialout $USER (on Arch the group is uucp), then log out and \
             in again",
            "until then: sudo chmod a+rw on the port",
        ],
        Cause::PortBusy => {
            vec!["close what has it open: a serial monitor, the Arduino IDE, another awl-asm"]
        }
        Cause::NoAnswer => return unanswered(port, ports),
        Cause::OtherChip(_) => {
            vec!["uno200 needs an Arduino Uno, or a board with an ATmega328P at 16 MHz"]
        }
        Cause::NoSignature => vec!["take the wires off D0 and D1, press reset, and try again"],
        Cause::Mismatch(_) => vec![
            "try again, with another cable and without the wires at D0 and D1",
            "the same address every time: the flash is worn out there",
        ],
        Cause::OtherFirmware => vec![
            "nothing was written; with --with-firmware the firmware is written first",
            "one that you have built yourself is named by UNO200_FIRMWARE",
        ],
        Cause::NotStarted(_) | Cause::Unknown => Vec::new(),
    };
    lines.into_iter().map(str::to_string).collect()
}

fn unanswered(port: &str, ports: Option<Vec<PathBuf>>) -> Vec<String> {
    vec![
        format!("is {port} the Uno? {}", ports_in_words(ports)),
        "close serial monitors, and take the wires off D0 and D1".into(),
        "press the reset button as it starts: not every board is reset by the computer".into(),
        "an older Nano answers at 57600 baud only: write a .hex with -o, then call avrdude with \
         -b 57600"
            .into(),
    ]
}

fn ports_in_words(ports: Option<Vec<PathBuf>>) -> String {
    match ports {
        None => "the Device Manager lists the ports, such as COM3".into(),
        Some(ports) if ports.is_empty() => {
            "there is no USB serial port: plug the board in, with a cable that carries data".into()
        }
        Some(ports) => {
            let names: Vec<String> = ports.iter().map(|port| port.display().to_string()).collect();
            format!("ports that are there: {}", names.join(", "))
        }
    }
}

/// The lines that tell most, the last ones. That a pty has no DTR is no news.
fn last_lines(output: &str) -> Vec<String> {
    let is_news = |line: &&str| {
        !line.is_empty() && !line.contains("done.  Thank you") && !line.contains("TIOCMGET")
    };
    let lines: Vec<&str> = output.lines().map(str::trim_end).filter(is_news).collect();
    lines[lines.len().saturating_sub(LINES_MAX)..].iter().map(|line| line.to_string()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn failure(cause: Cause, output: &str, shown: bool) -> String {
        let ended = Ended { status: Ok(None), output: output.into() };
        Failure::new("/dev/ttyACM0", cause, &ended, shown).to_string()
    }

    #[test]
    fn error_help_and_the_last_lines() {
        let output = "avrdude OS error: ioctl(\"TIOCMGET\"): Inappropriate ioctl for device\n\n\
                      avrdude: device signature = 0x1e9406 (probably m168)\n\
                      avrdude error: expected signature for ATmega328P is 1E 95 0F\n\
                      \u{20}       double check chip or use -F to override this check\n\n\
                      avrdude done.  Thank you.\n\n";
        let expected = "\
the board at /dev/ttyACM0 has another chip than an Uno: ATmega168
  = help: uno200 needs an Arduino Uno, or a board with an ATmega328P at 16 MHz
avrdude's last lines:
  avrdude: device signature = 0x1e9406 (probably m168)
  avrdude error: expected signature for ATmega328P is 1E 95 0F
          double check chip or use -F to override this check";
        assert_eq!(failure(Cause::OtherChip("ATmega168".into()), output, false), expected);
        let shown = expected.split("\navrdude's").next().unwrap();
        assert_eq!(failure(Cause::OtherChip("ATmega168".into()), output, true), shown);
    }

    #[test]
    fn no_more_lines_than_help() {
        let output: String = (1..=10)
            .map(|n| format!("avrdude warning: attempt {n} of 10: not in sync\n"))
            .collect();
        let text = failure(Cause::Unknown, &output, false);
        let lines: Vec<&str> = text.lines().skip(2).collect();
        assert_eq!(lines.len(), LINES_MAX, "{text}");
        assert!(lines[0].contains("attempt 7") && lines[3].contains("attempt 10"), "{text}");
    }

    #[test]
    fn the_ports_that_are_there() {
        let found = |names: &[&str]| Some(names.iter().map(PathBuf::from).collect());
        assert_eq!(
            help("COM9", &Cause::NoPort, found(&["/dev/a", "/dev/b"])),
            ["ports that are there: /dev/a, /dev/b"]
        );
        assert!(help("x", &Cause::NoPort, found(&[]))[0].contains("no USB serial port"));
        assert!(help("COM9", &Cause::NoPort, None)[0].contains("Device Manager"));
        assert!(
            help("/dev/x", &Cause::NoAnswer, found(&["/dev/y"]))[0]
                .contains("is /dev/x the Uno? ports")
        );
    }

    #[test]
    fn not_installed_names_the_package() {
        let text = failure(Cause::NotInstalled, "", false);
        assert!(
            text.contains("apt-get install avrdude")
                && text.contains("brew")
                && text.contains("Windows"),
            "{text}"
        );
        assert!(!text.contains("last lines"), "{text}");
    }
}
