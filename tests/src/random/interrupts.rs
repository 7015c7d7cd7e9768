//! Random programs with interrupt routines: many events at a time, changed while they come.

use fastrand::Rng;

/// A valid program whose routines count in MW8 and note SMB4 in MB7. IB0 and IB1 should change.
pub fn random_interrupts(rng: &mut Rng) -> String {
    let routines = rng.usize(1..5);
    let presets = [rng.i16(1..40), rng.i16(1..40)];
    Generator { rng, text: String::new(), routines, presets }.program()
}

/// Writes a program.
struct Generator<'a> {
    rng: &'a mut Rng,
    text: String,
    routines: usize,
    /// Of T32, started by TON, and T96, by TOF. One each: two would be two timers in one.
    presets: [i16; 2],
}

/// Events of the inputs, of time, and such as only hardware causes.
const EVENTS: [u8; 16] = [0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 10, 11, 21, 22, 9, 27];

impl Generator<'_> {
    fn line(&mut self, line: &str) {
        self.text += line;
        self.text += "\n";
    }

    fn event(&mut self) -> u8 {
        EVENTS[self.rng.usize(..EVENTS.len())]
    }

    fn attach(&mut self) {
        let (routine, event) = (self.rng.usize(..self.routines), self.event());
        self.line(&format!("ATCH I{routine}, {event}"));
    }

    /// A contact that is seldom closed: the bits of IB1 are.
    fn seldom(&mut self) {
        let bit = self.rng.u8(..8);
        self.line(&format!("LD I1.{bit}"));
    }

    fn condition(&mut self) {
        match self.rng.u8(..4) {
            0 => self.line("LD SM0.0"),
            1 => self.line("LDN I0.4"),
            2 => self.line("LD I0.5\nEU"),
            _ => self.seldom(),
        }
    }

    /// What changes events, possible in main program and routines.
    fn change(&mut self) {
        self.seldom();
        match self.rng.u8(..5) {
            0 | 1 => self.attach(),
            2 => {
                let event = self.event();
                self.line(&format!("DTCH {event}"));
            }
            3 => {
                let event = self.event();
                self.line(&format!("CEVNT {event}"));
            }
            _ => {
                let (byte, period) = (self.rng.u8(34..36), self.rng.u8(..60));
                self.line(&format!("MOVB {period}, SMB{byte}"));
            }
        }
    }

    /// What a routine must leave as it was.
    fn context(&mut self) {
        self.condition();
        let (number, value) = (self.rng.u8(..4), self.rng.i16(..));
        match self.rng.u8(..4) {
            0 => self.line(&format!("MOVD {value}, AC{number}\nAENO\n= M1.{number}")),
            1 => self.line(&format!("MOVW {value}, MW10\n+I {value}, MW10\nAENO\n= M2.{number}")),
            2 => self.line(&format!(
                "LPS\nA I0.{number}\n= M3.{number}\nLRD\nA SM1.1\n= M4.{number}\nLPP\n= M5.{number}"
            )),
            _ => self.line(&format!("+I AC{number}, MW12\nINCW MW14")),
        }
    }

    fn timer(&mut self) {
        let index = self.rng.usize(..2);
        let (kind, number, preset) = (["TON", "TOF"][index], [32, 96][index], self.presets[index]);
        match self.rng.u8(..5) {
            0 => {
                self.seldom();
                self.line(&format!("R T{number}, 1"));
            }
            1 => self.line(&format!("LDN T{number}\n{kind} T{number}, {preset}")),
            _ => {
                self.condition();
                self.line(&format!("{kind} T{number}, {preset}"));
            }
        }
    }

    fn network(&mut self) {
        match self.rng.u8(..8) {
            0 | 1 => self.change(),
            2 => {
                self.seldom();
                self.line("DISI");
            }
            3 => {
                self.seldom();
                self.line("ENI");
            }
            4 => self.timer(),
            5 => self.line("LD SM0.0\nCALL Inner"),
            _ => self.context(),
        }
    }

    fn routine(&mut self, number: usize) {
        self.line(&format!(
            "LD SM0.0\nBMB VB0, VB2, 46\nMOVB {number}, VB0\nMOVB SMB4, VB1\nINCW MW8"
        ));
        for _ in 0..self.rng.u8(..3) {
            self.context();
        }
        // What ends a delay here can do so only once in a scan, or routines would follow each other
        // without end.
        match self.rng.u8(..8) {
            0 => self.line(&format!("LD SM0.0\nTON T32, {}", self.presets[0])),
            1 => self.line(&format!("LDN SM0.0\nTOF T96, {}", self.presets[1])),
            _ => {}
        }
        if self.rng.bool() {
            self.seldom();
            self.line("CRETI");
            self.change();
        }
    }

    fn program(&mut self) -> String {
        let networks = self.rng.u8(3..20);
        self.line("LD SM0.1\nMOVB 3, SMB34\nMOVB 17, SMB35");
        for _ in 0..self.rng.u8(1..12) {
            self.attach();
        }
        if self.rng.bool() {
            self.line("ENI");
        }
        self.line("LDB<> SMB4, 0\nMOVB SMB4, MB7");
        for _ in 0..networks {
            self.network();
        }
        let main = std::mem::take(&mut self.text);
        let inner = "SUBROUTINE_BLOCK Inner:SBR0\nBEGIN\nLD SM0.0\nINCW MW16\nLDN SM0.0\nLD I0.0\n\
            = M6.0\n= M6.1\nEND_SUBROUTINE_BLOCK\n";
        let mut text =
            format!("ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\n{main}END_ORGANIZATION_BLOCK\n{inner}");
        for number in 0..self.routines {
            self.routine(number);
            let routine = std::mem::take(&mut self.text);
            text += &format!(
                "INTERRUPT_BLOCK I{number}:INT{number}\nBEGIN\n{routine}END_INTERRUPT_BLOCK\n"
            );
        }
        text
    }
}
