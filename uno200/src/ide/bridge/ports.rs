//! Which ports the bridge opens: those of the system that a board can be at, and what the command
//! line has named. Each for one page at a time.

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, PoisonError};

use super::protocol::{Kind, Port};
use crate::transport::ports::usb_ports;

/// The ports.
#[derive(Debug, Default)]
pub struct Ports {
    /// Of the command line.
    pub named: Vec<Port>,
    open: Mutex<BTreeSet<String>>,
}

impl Ports {
    /// With what the command line has named.
    pub fn new(named: Vec<Port>) -> Ports {
        Ports { named, open: Mutex::default() }
    }

    /// What can be opened now.
    pub fn all(&self) -> Vec<Port> {
        let mut ports = self.named.clone();
        for name in usb_ports() {
            if !ports.iter().any(|port| port.name == name) {
                ports.push(Port { name, kind: Kind::Serial });
            }
        }
        ports
    }

    /// The port with a name, for whoever asks first.
    pub fn take(self: &Arc<Self>, name: &str) -> Result<Taken, String> {
        let ports = self.all();
        let Some(port) = ports.iter().find(|port| port.name == name) else {
            let names: Vec<&str> = ports.iter().map(|port| &*port.name).collect();
            return Err(match names.is_empty() {
                true => format!("{name} is no port of this computer: no USB serial port is there"),
                false => format!("{name} is no port of this computer: {}", names.join(", ")),
            });
        };
        if !self.lock().insert(name.to_owned()) {
            return Err(format!("{name} is in use by another page: disconnect there first"));
        }
        Ok(Taken { ports: Arc::clone(self), port: port.clone() })
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, BTreeSet<String>> {
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A port that nobody else gets while this is there.
#[derive(Debug)]
pub struct Taken {
    ports: Arc<Ports>,
    /// Which it is.
    pub port: Port,
}

impl Drop for Taken {
    fn drop(&mut self) {
        self.ports.lock().remove(&self.port.name);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ports_that_are_known_one_at_a_time() {
        let port = Port { name: "127.0.0.1:1502".into(), kind: Kind::Tcp };
        let ports = Arc::new(Ports::new(vec![port.clone()]));
        assert!(ports.all().contains(&port));
        let refused = ports.take("/dev/null").unwrap_err();
        assert!(refused.contains("/dev/null is no port") && refused.contains("1502"), "{refused}");
        let taken = ports.take(&port.name).unwrap();
        assert!(ports.take(&port.name).unwrap_err().contains("another page"));
        drop(taken);
        assert!(ports.take(&port.name).is_ok());
    }
}
