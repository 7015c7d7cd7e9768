//! What is in a chip's place: the reference interpreter, with RTU frames around it.

use core::net::Ipv4Addr;
use std::time::Duration;

use awl_sim::machine::Machine;
use awl_sim::machine::host::Host;
use awl_sim::operand::Operand;
use awl_sim::run::Course;
use awl_sim::scenario::Scenario;
use awl_sim::serve::{Access, Endpoint, Request as Asked};
use client::line::rtu;

/// Where the program slot is in flash.
const SLOT: usize = 0x6000;

/// What is in the chip's place: a PLC at the end of a serial line.
pub struct Board {
    host: Host,
    endpoint: Endpoint<()>,
    /// The unit that it answers as.
    pub unit: u8,
    now_ms: u64,
    /// What it has sent.
    pub sent: Vec<u8>,
}

impl Board {
    /// What is switched on with this in its flash.
    pub fn with(flash: &[u8], unit: u8) -> Board {
        let len = u16::from_le_bytes([flash[SLOT + 6], flash[SLOT + 7]]);
        let image = flash[SLOT..SLOT + usize::from(len)].to_vec();
        let host = Host::new(image, Box::new(|_| String::new()));
        let course = Course::new(&Scenario::default(), None, 1);
        let endpoint = Endpoint::new(course, 1, Access::default(), Duration::ZERO);
        Board { host, endpoint, unit, now_ms: 0, sent: Vec::new() }
    }

    /// A frame has come.
    pub fn receive(&mut self, frame: &[u8]) {
        // Whoever asks another unit gets no answer.
        let Some(pdu) = rtu::answer(self.unit, frame) else { return };
        let client = Ipv4Addr::LOCALHOST.into();
        self.endpoint.ask(&mut self.host, Asked { client, pdu: pdu.to_vec(), from: () });
        self.answer();
    }

    fn answer(&mut self) {
        let answers: Vec<_> = self.endpoint.answers().collect();
        self.sent.extend(answers.iter().flat_map(|answer| rtu::frame(self.unit, &answer.pdu)));
    }

    /// A millisecond; gives what the chip's data memory says of the pins.
    pub fn pass(&mut self) -> Vec<u8> {
        self.endpoint.go_on(&mut self.host, Duration::from_millis(self.now_ms)).unwrap();
        self.now_ms += 1;
        self.answer();
        let mut data = vec![0; 0x900];
        (data[0x23], data[0x24]) = (self.host.pin_levels(), 0x3F);
        data
    }

    /// What is at its pins.
    pub fn drive(&mut self, [levels, analog @ ..]: [u16; 7]) {
        for input in 0..6 {
            self.host.drive_pin(input, levels >> input & 1 != 0);
        }
        for (channel, counts) in analog.iter().enumerate() {
            let operand = Operand::parse(&format!("Ain{channel}"), &[]).unwrap();
            self.host.write(operand, i32::from(*counts)).unwrap();
        }
    }
}
