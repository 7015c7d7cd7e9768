//! Who may do what. Modbus knows no passwords: the address of a client is all there is to go by. It
//! is no protection against somebody in the same network who forges it.

use core::net::{IpAddr, SocketAddr};

use plc_link::protocol::{FORCE, IDENTIFICATION, IDENTIFY, READ_BLOCK, STATUS, TRACE, WATCH};

/// What clients may do, beside those on the same computer, who may do everything.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Access {
    /// Listen at addresses that other computers reach.
    pub anywhere: bool,
    /// Let other computers write, force and command.
    pub writes: bool,
}

/// Function codes that change nothing in the process: Modbus reading, and those that ask.
const READING: [u8; 10] = [1, 2, 3, 4, IDENTIFICATION, IDENTIFY, WATCH, STATUS, TRACE, READ_BLOCK];
/// The action of [`FORCE`] that only lists.
const LIST: u8 = 0;

impl Access {
    /// Whether the PLC may listen at this address.
    pub fn allows_listening_at(self, address: SocketAddr) -> bool {
        self.anywhere || is_here(address.ip())
    }

    /// Whether a client at this address may make this request (function code and data).
    pub fn allows(self, client: IpAddr, request: &[u8]) -> bool {
        self.writes || is_here(client) || only_reads(request)
    }
}

/// Whether the address is of this computer and cannot be reached from another.
pub fn is_here(address: IpAddr) -> bool {
    address.to_canonical().is_loopback()
}

fn only_reads(request: &[u8]) -> bool {
    match *request {
        [FORCE, LIST] => true,
        [function, ..] => READING.contains(&function),
        [] => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HERE: [&str; 4] = ["127.0.0.1", "127.8.9.10", "::1", "::ffff:127.0.0.1"];
    const ELSEWHERE: [&str; 7] = [
        "192.168.1.7",
        "10.0.0.1",
        "0.0.0.0",
        "::",
        "fe80::1",
        "2001:db8::1",
        "::ffff:192.168.1.7",
    ];
    const WRITES: [u8; 9] = [5, 6, 15, 16, 22, 23, 66, 72, 100];

    fn ip(text: &str) -> IpAddr {
        text.parse().unwrap()
    }

    #[test]
    fn only_this_computer_is_listened_for_unless_said() {
        for text in HERE {
            assert!(Access::default().allows_listening_at((ip(text), 1502).into()), "{text}");
        }
        for text in ELSEWHERE {
            let address = (ip(text), 1502).into();
            assert!(!Access::default().allows_listening_at(address), "{text}");
            assert!(
                !Access { anywhere: false, writes: true }.allows_listening_at(address),
                "{text}"
            );
            assert!(
                Access { anywhere: true, writes: false }.allows_listening_at(address),
                "{text}"
            );
        }
    }

    #[test]
    fn other_computers_write_only_if_that_is_said() {
        let reading = Access { anywhere: true, writes: false };
        for function in WRITES {
            for text in HERE {
                assert!(reading.allows(ip(text), &[function, 0, 0]), "{function} from {text}");
            }
            for text in ELSEWHERE {
                assert!(!reading.allows(ip(text), &[function, 0, 0]), "{function} from {text}");
                assert!(
                    Access { writes: true, ..reading }.allows(ip(text), &[function, 0, 0]),
                    "{function}, {text}"
                );
            }
        }
    }

    #[test]
    fn other_computers_read() {
        let reading = Access { anywhere: true, writes: false };
        for function in READING {
            assert!(reading.allows(ip("10.0.0.1"), &[function, 0, 0, 0, 1]), "{function}");
        }
        assert!(reading.allows(ip("10.0.0.1"), &[FORCE, LIST]));
        for action in 1..=4 {
            assert!(!reading.allows(ip("10.0.0.1"), &[FORCE, action]), "action {action}");
        }
        assert!(!reading.allows(ip("10.0.0.1"), &[FORCE]));
        assert!(!reading.allows(ip("10.0.0.1"), &[FORCE, LIST, 1]));
    }
}
