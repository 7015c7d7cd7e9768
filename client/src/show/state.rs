//! What the view knows and where it is: answers of the PLC, scrolling, selection, questions to
//! the user. It neither draws nor talks to the PLC.

use std::collections::HashMap;
use std::ops::Range;

use awl_asm::Address;
use plc_isa::Area;

use super::model::{Flow, Instruction, Model};
use super::operands::Watched;
use crate::program::Program;
use crate::reference::Reference;
use crate::service::{Executed, Forced, Identity};
use crate::value::Base;
use crate::{Operand, fault};

/// How the connection is.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Link {
    /// Nothing has been answered yet.
    Connecting,
    /// The PLC answers.
    Up,
    /// It does not: why. Connecting goes on.
    Lost(String),
}

/// What the PLC is told to do.
#[derive(Debug, Clone, PartialEq)]
pub enum Order {
    /// Go to RUN.
    Run,
    /// Go to STOP.
    Stop,
    /// A single scan, and what these instructions do in it, as
    /// [`ScanStatus`](crate::service::ScanStatus) takes them; without any, nothing is told of it.
    Scan(Vec<(u16, Reference)>),
    /// Force an operand to a value.
    Force(Operand, u32),
    /// End the forcing of an operand.
    Unforce(Operand),
    /// End all forcing.
    UnforceAll,
    /// Write a value once.
    Set(Operand, u32),
}

/// What is asked again and again.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Wishes {
    /// Instructions by their offsets, ascending, each with the operand whose value is wanted.
    /// Several windows' worth.
    pub status: Vec<(u16, Reference)>,
    /// Operands whose values at the end of a scan are wanted.
    pub watch: Vec<Reference>,
}

/// What comes from the PLC.
#[derive(Debug)]
pub enum News {
    /// How it is. Whatever else is known may be old where it has another program or stands still.
    Identity(Box<Identity>),
    /// What instructions did.
    Status(Vec<(u16, Executed)>),
    /// A single scan was executed: its number, the low word of the scans since RUN, and what
    /// instructions did in it, where that was asked for.
    Scanned(Option<(u16, Vec<(u16, Executed)>)>),
    /// Values at the end of a scan.
    Values(Vec<(Reference, u32)>),
    /// The table of forced operands.
    Forced(Vec<Forced>),
    /// An order was carried out.
    Done(String),
    /// An order or question was refused.
    Refused(String),
    /// The connection is lost.
    Lost(String),
}

/// How the program in the PLC relates to the source.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Agreement {
    /// It is this one.
    Same,
    /// It is this one as machine code: there is no power flow to be seen.
    Native,
    /// It is another one.
    Other,
    /// There is none.
    NoProgram,
    /// Nothing is known yet.
    Unknown,
}

/// What the user is asked.
#[derive(Debug, Clone, PartialEq)]
pub enum Question {
    /// A value to force an operand to.
    Force(Operand),
    /// A value to write.
    Set(Operand),
    /// Text to look for.
    Search,
    /// Whether to stop.
    Stop,
}

/// What the view knows.
#[derive(Debug)]
pub struct State {
    /// The program with its source.
    pub program: Program,
    /// Its rows.
    pub model: Model,
    /// Where the PLC is.
    pub place: String,
    /// How the connection is.
    pub link: Link,
    /// What the PLC said about itself last.
    pub identity: Option<Identity>,
    /// What instructions did, by their offsets: in RUN in the last scans that were asked about, in
    /// STOP in the single scan [`scanned`](Self::scanned).
    pub executed: HashMap<u16, Executed>,
    /// In STOP the last scan, if it is known what instructions did in it: the low word of its
    /// number.
    pub scanned: Option<u16>,
    /// Values at the end of a scan.
    pub values: HashMap<Reference, u32>,
    /// What is forced.
    pub forced: HashMap<Reference, u32>,
    /// The first visible row.
    pub top: usize,
    /// How many rows are visible.
    pub height: usize,
    /// The selected row.
    pub selected: usize,
    /// The selected operand of that row.
    pub operand: usize,
    /// How values are written.
    pub base: Base,
    /// What the user is asked, and what was typed so far.
    pub question: Option<(Question, String)>,
    /// Whether help is shown.
    pub has_help: bool,
    /// What the last order led to, and whether that is bad.
    pub message: Option<(String, bool)>,
    /// What was looked for last.
    pub sought: String,
}

impl State {
    /// A view of a program from its beginning. `place`: where the PLC is, for people.
    pub fn new(program: Program, place: String) -> State {
        let model = Model::new(&program);
        let mut state = State {
            program,
            model,
            place,
            link: Link::Connecting,
            identity: None,
            executed: HashMap::new(),
            scanned: None,
            values: HashMap::new(),
            forced: HashMap::new(),
            top: 0,
            height: 1,
            selected: 0,
            operand: 0,
            base: Base::Decimal,
            question: None,
            has_help: false,
            message: None,
            sought: String::new(),
        };
        let first = state.model.rows.iter().position(|row| row.instruction().is_some());
        state.select(first.unwrap_or(0));
        state
    }

    /// Takes in what came from the PLC.
    pub fn hear(&mut self, news: News) {
        match news {
            News::Identity(identity) => {
                self.link = Link::Up;
                let old = self.agreement();
                let was_running = self.is_running();
                self.identity = Some(*identity);
                if self.agreement() != old {
                    self.forget();
                }
                if self.is_running() != was_running || self.has_gone_on() {
                    self.forget_scan();
                }
            }
            News::Status(answers) if self.is_running() => self.executed.extend(answers),
            // It was asked in RUN; of the last scan it is not.
            News::Status(_) => {}
            News::Scanned(scan) => {
                self.forget_scan();
                if let Some((number, executed)) = scan {
                    self.scanned = Some(number);
                    self.executed.extend(executed);
                }
            }
            News::Values(values) => self.values.extend(values),
            News::Forced(table) => self.hear_forced(table),
            News::Done(what) => self.message = Some((what, false)),
            News::Refused(why) => self.message = Some((why, true)),
            News::Lost(why) => {
                self.link = Link::Lost(why);
                self.identity = None;
                self.message = None;
                self.forget();
            }
        }
    }

    /// What is forced now. What has ended is told; an order that has ended it says so itself.
    fn hear_forced(&mut self, table: Vec<Forced>) {
        let now: HashMap<Reference, u32> =
            table.into_iter().map(|forced| (forced.reference, forced.value)).collect();
        let ended = self.forced.keys().filter(|reference| !now.contains_key(reference));
        let mut ended: Vec<String> =
            ended.filter_map(|reference| Some(reference.address()?.to_string())).collect();
        ended.sort();
        if !ended.is_empty() {
            self.message = Some((format!("not forced any more: {}", ended.join(", ")), true));
        }
        self.forced = now;
    }

    /// Whether the PLC is known to be in RUN.
    pub fn is_running(&self) -> bool {
        self.identity.as_ref().is_some_and(|identity| identity.is_running)
    }

    /// What is not true any more.
    fn forget(&mut self) {
        self.forget_scan();
        self.values.clear();
        self.forced.clear();
    }

    /// How the program in the PLC relates to the source.
    pub fn agreement(&self) -> Agreement {
        let Some(identity) = &self.identity else { return Agreement::Unknown };
        let image = (identity.image_crc, identity.image_len);
        match image {
            _ if !identity.has_program || identity.image_len == 0 => Agreement::NoProgram,
            image if image == self.model.image => Agreement::Same,
            image if Some(image) == self.model.native => Agreement::Native,
            _ => Agreement::Other,
        }
    }

    /// Whether the PLC can tell what the instructions of the source do.
    pub fn has_power_flow(&self) -> bool {
        self.agreement() == Agreement::Same
            && self.identity.as_ref().is_some_and(|identity| identity.has_status)
    }

    /// Why the PLC went to STOP by itself.
    pub fn fault(&self) -> Option<String> {
        let identity = self.identity.as_ref()?;
        let program = (self.agreement() == Agreement::Same).then_some(&self.program);
        fault::text(identity.fault, program)
    }

    /// The visible rows.
    pub fn visible(&self) -> Range<usize> {
        self.top..(self.top + self.height).min(self.model.rows.len())
    }

    /// What is to be asked for the visible rows: nothing of a program that is not there.
    pub fn wishes(&self) -> Wishes {
        if !matches!(self.agreement(), Agreement::Same | Agreement::Native) {
            return Wishes::default();
        }
        let rows = self.model.rows.get(self.visible()).unwrap_or(&[]);
        let instructions = || rows.iter().filter_map(|row| row.instruction());
        let in_image = || instructions().filter(|instruction| instruction.offset.is_some());
        // In STOP nothing is executed that could be asked about.
        let status = if self.is_running() { self.visible_instructions() } else { Vec::new() };
        let watch = in_image()
            .flat_map(|instruction| &instruction.operands)
            .filter(|watched| !watched.is_local);
        let mut watch: Vec<Reference> = watch.map(|watched| watched.operand.reference).collect();
        watch.sort();
        watch.dedup();
        Wishes { status, watch }
    }

    /// The power flow after the instruction of a row, or what has become of its statement.
    pub fn flow(&self, instruction: &Instruction) -> Option<Flow> {
        Some(instruction.flow(self.executed.get(&instruction.offset?)?))
    }

    /// The value of an operand of an instruction: right after it where that is known, otherwise at
    /// the end of a scan.
    pub fn value(&self, instruction: &Instruction, index: usize) -> Option<u32> {
        let watched = instruction.operands.get(index)?;
        let at_once = || {
            let (offset, _) = instruction.taken.iter().find(|(_, taken)| *taken == index)?;
            let executed = self.executed.get(offset)?;
            executed.is_executed.then_some(executed.value)
        };
        let at_end = || self.values.get(&watched.operand.reference).copied();
        // Inputs are read in STOP, too: what they are now is not what the scan saw.
        let is_of_scan = self.scanned.is_none() || !is_input(watched.operand.address);
        at_once().or_else(|| at_end().filter(|_| is_of_scan))
    }

    /// The instruction of the selected row.
    pub fn selected_instruction(&self) -> Option<&Instruction> {
        self.model.rows.get(self.selected)?.instruction()
    }

    /// The selected operand with its value, where it is known.
    pub fn selected_operand(&self) -> Option<(&Watched, Option<u32>)> {
        let instruction = self.selected_instruction()?;
        let watched = instruction.operands.get(self.operand)?;
        Some((watched, self.value(instruction, self.operand)))
    }

    /// Selects a row, and scrolls so that it is visible.
    pub fn select(&mut self, row: usize) {
        self.selected = row.min(self.model.rows.len().saturating_sub(1));
        self.operand = self.selected_instruction().map_or(0, |instruction| instruction.result);
        self.scroll();
    }

    /// The view has become this many rows high.
    pub fn resize(&mut self, height: usize) {
        self.height = height.max(1);
        self.scroll();
    }

    fn scroll(&mut self) {
        let last_top = self.model.rows.len().saturating_sub(self.height);
        let least = (self.selected + 1).saturating_sub(self.height);
        self.top = self.top.clamp(least, self.selected.max(least)).min(last_top);
    }

    /// Selects a row and shows it at the top, with what belongs to it below.
    pub fn go_to(&mut self, row: usize) {
        self.top = row;
        self.select(row);
    }
}

/// Whether the PLC takes the operand from its pins.
pub fn is_input(address: Address) -> bool {
    match address {
        Address::Bit { area, .. }
        | Address::Byte { area, .. }
        | Address::Word { area, .. }
        | Address::Double { area, .. } => area == Area::I,
        Address::Analog(_) | Address::HighSpeedCounter(_) => true,
        _ => false,
    }
}

/// Whether an operand can be forced.
pub fn can_force(operand: &Operand) -> bool {
    match operand.address {
        Address::Bit { area, .. }
        | Address::Byte { area, .. }
        | Address::Word { area, .. }
        | Address::Double { area, .. } => matches!(area, Area::I | Area::Q | Area::M | Area::V),
        Address::Analog(_) | Address::AnalogOutput(_) => true,
        _ => false,
    }
}
