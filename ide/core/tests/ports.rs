//! A session with a board at a port of this computer: the port is opened, the board written by its
//! bootloader, and asked.

mod board;
mod recorded;

use awl_asm::hex;
use board::Board;
use flash::bootloader::Bootloader;
use ide_core::protocol::{Event, File, ProjectWish, Request, Status, TargetKind, TargetWish, Wish};
use recorded::Recorded;

const LAMP: &str = "LD I0.0\nNOT\n= Q0.1\n";

/// How long the bootloader waits.
const BOOTLOADER_MS: u64 = 1_400;

/// An Uno at its cable: its bootloader, and what runs when that has nothing to do.
struct Uno {
    bootloader: Bootloader,
    /// Until when the bootloader has the line.
    until_ms: u64,
    board: Option<Board>,
    /// What its flash begins with when it has the firmware.
    firmware: Vec<u8>,
    /// What is on its way to the page.
    sent: Vec<u8>,
}

impl Uno {
    fn reset(&mut self, now_ms: u64) {
        (self.until_ms, self.board) = (now_ms + BOOTLOADER_MS, None);
    }

    fn receive(&mut self, bytes: &[u8], now_ms: u64) {
        if let Some(board) = &mut self.board {
            return board.receive(bytes);
        }
        let answer = self.bootloader.receive(bytes);
        if bytes == b"Q " {
            self.until_ms = now_ms;
        } else if !answer.is_empty() {
            self.until_ms = now_ms + BOOTLOADER_MS;
        }
        self.sent.extend(answer);
    }

    /// A millisecond; gives what it says.
    fn pass(&mut self, now_ms: u64) -> Vec<u8> {
        if self.board.is_none() && now_ms >= self.until_ms {
            let flash = self.bootloader.flash();
            self.board = flash.starts_with(&self.firmware).then(|| Board::with(flash, 1));
        }
        if let Some(board) = &mut self.board {
            board.pass();
            board.drive([0; 7]);
            self.sent.append(&mut board.sent);
        }
        std::mem::take(&mut self.sent)
    }
}

/// A page with an Uno at a port.
struct Page {
    session: Recorded,
    uno: Uno,
    open: Option<(u32, String)>,
    /// Whether people say yes to what they are asked.
    agrees: bool,
    now_ms: u64,
    asked: Vec<&'static str>,
    notices: Vec<String>,
    status: Option<Status>,
}

impl Page {
    fn new(text: &str) -> Page {
        let uno = Uno {
            bootloader: Bootloader::default(),
            until_ms: 0,
            board: None,
            firmware: hex::firmware(hex::FIRMWARE).unwrap(),
            sent: Vec::new(),
        };
        let mut page = Page {
            session: Recorded::default(),
            uno,
            open: None,
            agrees: true,
            now_ms: 0,
            asked: Vec::new(),
            notices: Vec::new(),
            status: None,
        };
        let files = vec![File { name: "p.awl".to_owned(), text: text.to_owned() }];
        page.wish(Wish::Project(ProjectWish::Open { files, main: None }));
        page.target(TargetWish::Target { kind: TargetKind::Usb });
        page
    }

    fn wish(&mut self, wish: Wish) {
        let events = self.session.request(Request { id: 1, wish }, self.now_ms);
        self.take(events);
    }

    fn target(&mut self, wish: TargetWish) {
        self.wish(Wish::Target(wish));
    }

    fn take(&mut self, events: Vec<Event>) {
        for event in events {
            match event {
                Event::OpenPort { kind: _, baud, parity } => {
                    self.asked.push("port");
                    if self.agrees {
                        self.open = Some((baud, parity));
                        self.uno.bootloader.lines(false);
                        self.uno.bootloader.lines(true);
                        self.uno.reset(self.now_ms);
                        self.target(TargetWish::Plugged { network: false });
                    } else {
                        self.target(TargetWish::Unplugged { why: String::new() });
                    }
                }
                Event::ClosePort => self.open = None,
                Event::Lines { on } => {
                    self.uno.bootloader.lines(on);
                    if on {
                        self.uno.reset(self.now_ms);
                    }
                }
                Event::Send { bytes } => {
                    self.uno.receive(&bytes, self.now_ms);
                }
                Event::AskFirmware => {
                    self.asked.push("firmware");
                    if self.agrees {
                        self.target(TargetWish::DownloadFirmware);
                    }
                }
                Event::Notice { message, .. } | Event::Refused { message, .. } => {
                    self.notices.push(message);
                }
                Event::Status { status } => self.status = Some(status),
                _ => {}
            }
        }
    }

    fn pass(&mut self, ms: u64) {
        for _ in 0..ms {
            self.now_ms += 1;
            let said = self.uno.pass(self.now_ms);
            if !said.is_empty() {
                let events = self.session.receive(&said, self.now_ms);
                self.take(events);
            }
            if self.now_ms.is_multiple_of(10) {
                let events = self.session.tick(self.now_ms, 1000);
                self.take(events);
            }
        }
    }

    fn state(&self) -> (&str, &str) {
        self.status.as_ref().map_or(("", ""), |status| (&status.mode, &status.agreement))
    }
}

#[test]
fn run_brings_firmware_and_program_to_a_new_board() {
    let mut page = Page::new(LAMP);
    page.target(TargetWish::Run);
    page.pass(300);
    assert_eq!(page.asked, ["port"]);
    // Nobody there knows Modbus; the firmware is missing.
    page.target(TargetWish::Download);
    page.pass(700);
    assert_eq!(page.asked, ["port", "firmware"]);
    assert_eq!(page.state().0, "LOADING");
    page.pass(10_000);
    assert_eq!(page.state(), ("RUN", "same"), "{:?}", page.notices);
    assert!(page.notices.is_empty(), "{:?}", page.notices);
}

#[test]
fn another_program_and_nobody_is_asked_again() {
    let mut page = Page::new(LAMP);
    page.target(TargetWish::Download);
    page.pass(12_000);
    assert_eq!(page.state(), ("RUN", "same"), "{:?}", page.notices);
    let (file, text) = ("p.awl".to_owned(), "LD I0.1\n= Q0.2\n".to_owned());
    page.wish(Wish::Project(ProjectWish::Edit { file, text }));
    page.pass(500);
    assert_eq!(page.state(), ("RUN", "other"));
    page.asked.clear();
    page.target(TargetWish::Run);
    page.pass(4_000);
    assert_eq!((page.state(), page.asked.len()), (("RUN", "same"), 0));
    page.target(TargetWish::Stop);
    page.pass(500);
    assert_eq!(page.state(), ("STOP", "same"));
    page.target(TargetWish::Run);
    page.pass(500);
    assert_eq!(page.state(), ("RUN", "same"));
    page.target(TargetWish::Disconnect);
    page.pass(100);
    assert_eq!((page.state().0, &page.open), ("OFFLINE", &None));
}

#[test]
fn a_program_with_another_line_is_written_at_the_bootloaders_and_asked_at_its_own() {
    let mut page = Page::new(&format!("//# modbus baud 19200 parity even\n{LAMP}"));
    page.target(TargetWish::Connect);
    page.pass(100);
    assert_eq!(page.open, Some((19_200, "even".to_owned())));
    page.target(TargetWish::Download);
    page.pass(1_000);
    assert_eq!(page.open, Some((115_200, "none".to_owned())));
    page.pass(12_000);
    assert_eq!(page.open, Some((19_200, "even".to_owned())));
    assert_eq!(page.state(), ("RUN", "same"), "{:?}", page.notices);
}

#[test]
fn who_does_not_want_the_port_or_the_firmware_gets_neither() {
    let mut page = Page::new(LAMP);
    page.agrees = false;
    page.target(TargetWish::Run);
    page.pass(3_000);
    assert_eq!((page.asked.as_slice(), page.state().0), (&["port"][..], "OFFLINE"));
    page.agrees = true;
    page.target(TargetWish::Connect);
    page.pass(100);
    page.agrees = false;
    let before = page.uno.bootloader.flash().to_vec();
    page.target(TargetWish::Download);
    page.pass(12_000);
    assert_eq!(page.asked.last(), Some(&"firmware"));
    assert_eq!(page.state().0, "OFFLINE");
    assert!(page.uno.bootloader.flash() == before && page.notices.is_empty());
}

#[test]
fn a_cable_that_is_pulled_out_is_told_with_what_the_board_holds() {
    let mut page = Page::new(&LAMP.repeat(100));
    page.target(TargetWish::Download);
    let is_writing = |page: &Page| {
        let loading = page.status.as_ref().and_then(|status| status.loading.as_ref());
        loading.is_some_and(|loading| loading.phase == "writing" && loading.percent > 20)
    };
    for _ in 0..10_000 {
        if is_writing(&page) {
            break;
        }
        page.pass(1);
    }
    assert!(is_writing(&page));
    page.target(TargetWish::Disconnect);
    assert!(page.notices.pop().is_some_and(|notice| notice.contains("being written")));
    page.target(TargetWish::Unplugged { why: "the device has been lost".to_owned() });
    page.pass(100);
    assert_eq!(page.state().0, "OFFLINE");
    let [notice] = &page.notices[..] else { panic!("{:?}", page.notices) };
    assert!(notice.contains("lost") && notice.contains("all outputs stay off"), "{notice}");
    // Plugged in again, all is well.
    page.target(TargetWish::Download);
    page.pass(15_000);
    assert_eq!(page.state(), ("RUN", "same"), "{:?}", page.notices);
    page.target(TargetWish::Unplugged { why: "the device has been lost".to_owned() });
    page.pass(100);
    assert_eq!((page.state().0, page.notices.len()), ("OFFLINE", 2));
}

#[test]
fn a_plc_on_the_network_is_asked_and_not_written() {
    let files = vec![File { name: "p.awl".to_owned(), text: LAMP.to_owned() }];
    let mut session = Recorded::default();
    let mut ask = |wish| session.request(Request { id: 1, wish }, 0);
    ask(Wish::Project(ProjectWish::Open { files, main: None }));
    ask(Wish::Target(TargetWish::Target { kind: TargetKind::Bridge }));
    let events = ask(Wish::Target(TargetWish::Connect));
    let opens = |event: &Event| matches!(event, Event::OpenPort { kind: TargetKind::Bridge, .. });
    assert!(events.iter().any(opens), "{events:?}");
    let events = ask(Wish::Target(TargetWish::Plugged { network: true }));
    // Modbus TCP: a number, the protocol 0.
    let sent = events.iter().find_map(|event| match event {
        Event::Send { bytes } => Some(bytes.clone()),
        _ => None,
    });
    assert_eq!(sent.expect("it is asked at once")[2..4], [0, 0]);
    for wish in [TargetWish::Download, TargetWish::Reset] {
        let events = ask(Wish::Target(wish));
        let is_refused = |event: &Event| match event {
            Event::Refused { message, .. } => message.contains("on the network"),
            _ => false,
        };
        assert!(events.iter().any(is_refused), "{events:?}");
    }
}
