//! The serial ports of this computer that an Uno can be at. Opens none.

use client::Error;
use serialport::{SerialPortInfo, SerialPortType, available_ports};

/// The USB serial ports by name.
pub fn usb_ports() -> Vec<String> {
    let mut names: Vec<String> =
        available_ports().unwrap_or_default().into_iter().filter_map(usb_name).collect();
    names.sort();
    names
}

/// Of the two names that macOS gives a port, the one that is for calling out.
fn usb_name(port: SerialPortInfo) -> Option<String> {
    let is_usb = matches!(port.port_type, SerialPortType::UsbPort(_));
    (is_usb && !port.port_name.starts_with("/dev/tty.")).then_some(port.port_name)
}

/// The only USB serial port; an error that names them where there are several.
pub fn only_port() -> Result<String, Error> {
    chosen(usb_ports())
}

fn chosen(mut names: Vec<String>) -> Result<String, Error> {
    match names.len() {
        0 => Err(Error::NotConnected(
            "no USB serial port is there: is the board plugged in, with a cable that carries data? \
             `--port` names another port, `--tcp` a PLC on the network"
                .into(),
        )),
        1 => Ok(names.swap_remove(0)),
        _ => {
            Err(Error::NotConnected(format!("there are several serial ports, say which: --port \
                {}", names.join(", "))))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_port_needs_no_name() {
        let choose = |names: &[&str]| chosen(names.iter().map(|name| name.to_string()).collect());
        assert_eq!(choose(&["/dev/ttyACM0"]).unwrap(), "/dev/ttyACM0");
        assert!(choose(&[]).unwrap_err().to_string().contains("plugged in"));
        let several = choose(&["/dev/ttyACM0", "/dev/ttyUSB1"]).unwrap_err().to_string();
        assert!(several.contains("--port /dev/ttyACM0, /dev/ttyUSB1"), "{several}");
    }
}
