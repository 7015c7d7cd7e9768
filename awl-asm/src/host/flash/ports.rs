//! The serial ports that are there, as an Uno or a clone shows up. Opens none.

use std::fs;
use std::path::{Path, PathBuf};

/// How device files of USB serial ports begin: Linux (Uno, clones), then macOS.
const BEGINNINGS: [&str; 4] = ["ttyACM", "ttyUSB", "cu.usb", "cu.wchusb"];

/// The ports by name. On Windows they are no files, and there is no answer.
pub fn available() -> Option<Vec<PathBuf>> {
    cfg!(unix).then(|| in_folder(Path::new("/dev")))
}

fn in_folder(folder: &Path) -> Vec<PathBuf> {
    // A folder that cannot be read shows no ports.
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let is_port = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        BEGINNINGS.iter().any(|beginning| name.starts_with(beginning))
    };
    let mut ports: Vec<PathBuf> = entries.map(|entry| entry.path()).filter(is_port).collect();
    ports.sort();
    ports
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_usb_serial_ports_and_sorted() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["ttyUSB0", "tty7", "ttyACM1", "ttyS0", "cu.usbmodem1101", "ttyACM0", "null"] {
            fs::write(folder.path().join(name), "").unwrap();
        }
        let expected = ["cu.usbmodem1101", "ttyACM0", "ttyACM1", "ttyUSB0"]
            .map(|name| folder.path().join(name));
        assert_eq!(in_folder(folder.path()), expected);
        assert!(in_folder(&folder.path().join("none")).is_empty());
    }
}
