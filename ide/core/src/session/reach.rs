//! Sessions with a target outside: the port to it, the board behind it, its program.

use awl_asm::hex;
use client::line::Framing;
use client::show::state::{Agreement, Order};
use flash::{Firmware, Flasher, Job};

use super::Session;
use crate::build;
use crate::outside::{Setting, Then, told_of};
use crate::plc::Plc;
use crate::protocol::{Event, TargetKind, TargetWish};

/// From the opening of its port, which resets it, until a board answers: its bootloader waits a
/// second after it has flashed its lamp.
const BOOT_MS: u64 = 1_900;
/// The same from the end of writing it.
const START_MS: u64 = 300;

impl Session {
    /// Whether the target is a port of this computer.
    pub(super) fn is_outside(&self) -> bool {
        matches!(self.kind, TargetKind::Usb | TargetKind::Bridge)
    }

    /// While a board is written, nothing else is done with it.
    pub(super) fn check_not_loading(&self, wish: &TargetWish) -> Result<(), String> {
        let is_of_port = matches!(wish, TargetWish::Plugged { .. } | TargetWish::Unplugged { .. });
        match self.outside.loading() {
            Some(_) if !is_of_port => {
                Err("the board is being written: wait until that is done".to_owned())
            }
            _ => Ok(()),
        }
    }

    /// Has something done with a target outside as soon as the port to it is open.
    pub(super) fn reach(&mut self, then: Then) -> Result<(), String> {
        let setting = match then {
            Then::Download { .. } => {
                build::board_program(&self.editor)?;
                Setting::BOOTLOADER
            }
            Then::Connect | Then::Run | Then::Start => {
                Setting::of(build::settings(&build::program(&self.editor)?))
            }
        };
        match self.outside.is_ready(self.kind, setting, then, &mut self.errands) {
            true => self.begin(then, START_MS),
            false => Ok(()),
        }
    }

    /// The page has opened the port.
    pub(super) fn plugged(&mut self, is_network: bool) -> Result<(), String> {
        let wait_ms = if is_network { 0 } else { BOOT_MS };
        self.outside.plugged(is_network).map_or(Ok(()), |then| self.begin(then, wait_ms))
    }

    /// The port is gone, or was not opened; without a reason nobody wanted it.
    pub(super) fn unplugged(&mut self, why: &str) -> Result<(), String> {
        let is_written = self.outside.loading().is_some();
        self.outside.unplugged(why);
        self.plc = None;
        // Of a board that was being written more is to be said than that.
        if is_written || why.is_empty() { Ok(()) } else { Err(why.to_owned()) }
    }

    fn begin(&mut self, then: Then, wait_ms: u64) -> Result<(), String> {
        if let Then::Download { with_firmware } = then {
            return self.write_board(with_firmware);
        }
        let program = build::program(&self.editor)?;
        let settings = build::settings(&program);
        let (framing, place) = match self.outside.is_network() {
            true => (Framing::Tcp { unit: settings.modbus_address, transaction: 0 }, "the PLC"),
            false => (build::framing(settings), "the board"),
        };
        self.attach(Plc::new(framing, program, place, self.now_ms + wait_ms));
        self.outside.then = (then != Then::Connect).then_some(then);
        Ok(())
    }

    fn write_board(&mut self, with_firmware: bool) -> Result<(), String> {
        if self.outside.is_network() {
            return Err("a PLC on the network is not written from here: it is `awl-sim --serve`, \
                        which is started with its program"
                .to_owned());
        }
        let program = build::board_program(&self.editor)?;
        let code = hex::firmware(hex::FIRMWARE).map_err(|error| error.to_string())?;
        let firmware = match with_firmware {
            true => Firmware::Write(&code),
            false => Firmware::Expect(&code),
        };
        let job = Job::new(firmware, &program.image).map_err(|error| error.to_string())?;
        self.plc = None;
        self.outside.write(Flasher::new(job));
        Ok(())
    }

    /// Goes on with the writing of a board, and with what is to be done with it then.
    pub(super) fn go_on_outside(&mut self, now_ms: u64) -> Vec<Event> {
        let (mut events, written) = self.outside.go_on(now_ms);
        let done = match written {
            Some(Ok(())) => self.reach(Then::Start),
            Some(Err(failure)) => {
                events.push(told_of(&failure));
                Ok(())
            }
            None => self.start(),
        };
        events.extend(done.err().map(|message| Event::Notice { message, bad: true }));
        events
    }

    /// Starts a PLC that has said what it holds, if that is wanted; one that holds another program
    /// is written before.
    fn start(&mut self) -> Result<(), String> {
        let (Some(then), Some(plc)) = (self.outside.then, &mut self.plc) else { return Ok(()) };
        let agreement = plc.state.agreement();
        let Some(identity) = &plc.state.identity else { return Ok(()) };
        match agreement {
            Agreement::Unknown => return Ok(()),
            Agreement::Same | Agreement::Native => {
                if !identity.is_running {
                    plc.order(Order::Run);
                }
            }
            Agreement::Other | Agreement::NoProgram if then == Then::Start => {
                self.outside.then = None;
                return Err("the board does not hold the program that was written".to_owned());
            }
            Agreement::Other | Agreement::NoProgram => {
                self.outside.then = None;
                return self.reach(Then::Download { with_firmware: false });
            }
        }
        self.outside.then = None;
        Ok(())
    }

    /// Resets a board as by its button; one that is not connected is connected, which does it, too.
    pub(super) fn reset_outside(&mut self) -> Result<(), String> {
        if self.outside.is_network() {
            return Err("a PLC on the network cannot be reset from here".to_owned());
        }
        let Some(plc) = &mut self.plc else { return self.reach(Then::Connect) };
        plc.reset(self.now_ms + BOOT_MS);
        self.errands.push(Event::ResetBoard);
        Ok(())
    }
}
