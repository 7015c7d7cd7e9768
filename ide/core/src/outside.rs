//! A target outside the page: how the port to it is open, what is to be done when it is, and the
//! board that is written through it. The port itself is the page's.

use flash::{Cause, Flasher, Output, Phase};
use plc_isa::{LineSettings, Parity, Settings};

use crate::protocol::{Event, Loading, TargetKind};

/// How a serial line is set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Setting {
    baud: u32,
    parity: Parity,
}

impl Setting {
    /// The bootloader's.
    pub const BOOTLOADER: Setting = Setting { baud: flash::BAUD, parity: Parity::None };

    /// What a program sets.
    pub fn of(settings: Settings) -> Setting {
        let LineSettings { rate, parity, .. } = LineSettings::of_byte(settings.line);
        Setting { baud: LineSettings::RATES[usize::from(rate & 7)], parity }
    }
}

/// What is done when the port is open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Then {
    /// The PLC is asked what it does.
    Connect,
    /// It goes to RUN; with another program than this one in it, that is written before.
    Run,
    /// It goes to RUN with the program that was just written.
    Start,
    /// The program is written, perhaps with the firmware.
    Download {
        /// Whether the firmware is written, too.
        with_firmware: bool,
    },
}

/// How the port is open.
#[derive(Debug, Clone, Copy)]
struct Open {
    setting: Setting,
    is_network: bool,
}

/// The way to a target outside.
#[derive(Debug, Default)]
pub struct Outside {
    open: Option<Open>,
    /// What the page was asked to open, and for what.
    wanted: Option<(Setting, Then)>,
    flasher: Option<Flasher>,
    /// What is to be done when the PLC has said what it holds.
    pub then: Option<Then>,
}

impl Outside {
    /// Has the port of this kind of target open with this setting. True where it is; otherwise the
    /// page is asked.
    pub fn is_ready(
        &mut self,
        kind: TargetKind,
        setting: Setting,
        then: Then,
        errands: &mut Vec<Event>,
    ) -> bool {
        if self.open.is_some_and(|open| open.is_network || open.setting == setting) {
            return true;
        }
        self.wanted = Some((setting, then));
        let parity = match setting.parity {
            Parity::None => "none",
            Parity::Even => "even",
            Parity::Odd => "odd",
        };
        errands.push(Event::OpenPort { kind, baud: setting.baud, parity: parity.to_owned() });
        false
    }

    /// The page has opened it; gives for what.
    pub fn plugged(&mut self, is_network: bool) -> Option<Then> {
        let (setting, then) = self.wanted.take()?;
        self.open = Some(Open { setting, is_network });
        Some(then)
    }

    /// It is gone, or was not opened.
    pub fn unplugged(&mut self, why: &str) {
        (self.open, self.wanted, self.then) = (None, None, None);
        if let Some(flasher) = &mut self.flasher {
            flasher.lost(why);
        }
    }

    /// Whether it is a connection of the network, which frames as such.
    pub fn is_network(&self) -> bool {
        self.open.is_some_and(|open| open.is_network)
    }

    /// Whether a port is open, or about to be.
    pub fn is_open(&self) -> bool {
        self.open.is_some() || self.wanted.is_some()
    }

    /// Writes a board.
    pub fn write(&mut self, flasher: Flasher) {
        self.flasher = Some(flasher);
    }

    /// Bytes have come; whether they were for the writing of the board.
    pub fn receive(&mut self, bytes: &[u8], now_ms: u64) -> bool {
        let Some(flasher) = &mut self.flasher else { return false };
        flasher.receive(bytes, now_ms);
        true
    }

    /// What is to be done with the port, and how the writing ended, once.
    pub fn go_on(&mut self, now_ms: u64) -> (Vec<Event>, Option<Result<(), flash::Failure>>) {
        let Some(flasher) = &mut self.flasher else { return (Vec::new(), None) };
        let outputs = std::iter::from_fn(|| flasher.poll(now_ms));
        let events = outputs.map(|output| match output {
            Output::Lines(on) => Event::Lines { on },
            Output::Send(bytes) => Event::Send { bytes },
        });
        let events = events.collect();
        let result = flasher.result().cloned();
        if result.is_some() {
            self.flasher = None;
        }
        (events, result)
    }

    /// How far the writing is.
    pub fn loading(&self) -> Option<Loading> {
        let progress = self.flasher.as_ref()?.progress();
        let phase = match progress.phase {
            Phase::Connecting => "connecting",
            Phase::Writing => "writing",
            Phase::Verifying => "verifying",
            Phase::Starting => "starting",
        };
        let percent = progress.done * 100 / progress.total.max(1);
        Some(Loading { phase: phase.to_owned(), percent })
    }
}

/// What the page is told of a failure: a board without the firmware is a question.
pub fn told_of(failure: &flash::Failure) -> Event {
    match failure.cause {
        Cause::OtherFirmware => Event::AskFirmware,
        _ => Event::Notice { message: failure.to_string(), bad: true },
    }
}
