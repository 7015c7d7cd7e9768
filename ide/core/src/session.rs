//! Everything together: takes the page's requests, lets time pass, tells what is new.

mod charts;
mod chip;
mod measured;
mod plants;
mod reach;
mod status;

use awl_sim::operand::Operand;
use client::line::Framing;
use client::show::state::{Agreement, Link, Order, is_input};
use serde::Serialize;

use crate::apart::{self, Wanted};
use crate::build;
use crate::chart::Charts;
use crate::editor::Editor;
use crate::ladder::Shown;
use crate::outside::{Outside, Then};
use crate::plc::{Lines, Plc};
use crate::protocol::{
    ApartWish, Chart, Event, LookWish, ProjectWish, Request, TargetKind, TargetWish, TextWish, Wish,
};
use crate::pulse::Pulse;
use crate::recorder::Recorder;
use crate::scope::Scope;
use crate::simulator::{Bench, Simulator};
use crate::surroundings::Surroundings;
use crate::told::Told;

/// How often the page is told what is live, in milliseconds.
const LIVE_MS: u64 = 50;
/// Most requests that a simulator answers in one go: no more are in a round.
const EXCHANGES_MAX: usize = 1000;
/// From a reset of the firmware until it hears, in milliseconds: it checks the program first, and
/// that takes 350 ms of the largest with the most modules. What is asked earlier is lost.
const BOOT_MS: u64 = 400;

/// An IDE.
#[derive(Default)]
pub struct Session {
    editor: Editor,
    /// Whether the texts have changed since the page was told what is wrong with them.
    is_edited: bool,
    kind: TargetKind,
    plc: Option<Plc>,
    simulator: Option<Simulator>,
    /// What is around the chip of the virtual Uno.
    chip: Option<Surroundings>,
    /// The way to a target that is not in the page.
    outside: Outside,
    bench: Bench,
    scope: Scope,
    scope_names: (Vec<String>, u32),
    /// Which of them the program has.
    scope_known: Vec<bool>,
    /// Has the samples while there is one; the oscilloscope has none then.
    recorder: Option<Recorder>,
    watched: Vec<String>,
    view: Option<Lines>,
    /// The ladder that the page shows, until a text changes.
    ladder: Option<Shown>,
    /// How many drawings were shown.
    drawings: u32,
    /// The charts that the page shows, until a text changes.
    charts: Option<Charts>,
    plant_events: usize,
    told: Told,
    live: Option<Pulse>,
    now_ms: u64,
    /// What the page is to do for a target outside, apart from sending bytes.
    errands: Vec<Event>,
}

/// Events as JSON.
pub fn json(value: &impl Serialize) -> String {
    serde_json::to_string(value).unwrap_or_else(|_| "[]".to_owned())
}

/// What comes of a wish: an answer, or nothing to say, or why not.
type Done = Result<Option<serde_json::Value>, String>;

impl Session {
    /// With an empty project.
    pub fn new() -> Session {
        Session::default()
    }

    /// A [`Request`] as JSON, with the time since any beginning; [`Event`]s as JSON.
    pub fn request_json(&mut self, request: &str, now_ms: u64) -> String {
        match serde_json::from_str(request) {
            Ok(request) => json(&self.request(request, now_ms)),
            Err(error) => json(&[Event::Refused { id: 0, message: error.to_string() }]),
        }
    }

    /// Carries a request out. Times never decrease.
    pub fn request(&mut self, request: Request, now_ms: u64) -> Vec<Event> {
        let Request { id, wish } = request;
        let mut events = match self.fulfil(wish) {
            Ok(None) => Vec::new(),
            Ok(Some(answer)) => vec![Event::Answer { id, answer }],
            Err(message) => vec![Event::Refused { id, message }],
        };
        events.extend(self.tick(now_ms, 0));
        events
    }

    /// Bytes have come on the line of a target outside.
    pub fn receive(&mut self, bytes: &[u8], now_ms: u64) -> Vec<Event> {
        let line_ms = self.line_ms(now_ms);
        if !self.outside.receive(bytes, now_ms)
            && let Some(plc) = &mut self.plc
        {
            plc.receive(bytes, line_ms);
        }
        self.tick(now_ms, 0)
    }

    /// The time on the line of the target: a chip in the page has its own, and whoever asks it
    /// waits as long as it takes there.
    fn line_ms(&self, now_ms: u64) -> u64 {
        self.chip.as_ref().map_or(now_ms, Surroundings::time_ms)
    }

    /// Time has passed: a simulator runs so many scans at most. To be called often.
    pub fn tick(&mut self, now_ms: u64, scans_max: u32) -> Vec<Event> {
        let elapsed_ms = now_ms.saturating_sub(self.now_ms);
        self.now_ms = self.now_ms.max(now_ms);
        let mut events = std::mem::take(&mut self.errands);
        if std::mem::take(&mut self.is_edited) {
            events.extend(self.checked());
        }
        events.extend(self.go_on_outside(now_ms));
        // What comes of that is not for the next time.
        events.append(&mut self.errands);
        if scans_max > 0
            && let Some(simulator) = &mut self.simulator
        {
            let answers = simulator.go_on(elapsed_ms, scans_max, &self.bench, &mut self.scope);
            if let Some(plc) = &mut self.plc {
                plc.receive(&answers, now_ms);
            }
        } else if scans_max > 0
            && let Some(chip) = &mut self.chip
        {
            chip.is_due(elapsed_ms, &self.bench);
        } else if scans_max == 0 {
            // This time is still to be gone through.
            self.now_ms = self.now_ms.saturating_sub(elapsed_ms);
        }
        if !self.bench.is_paused {
            events.extend(self.exchange(self.line_ms(now_ms)));
        }
        if self.live.get_or_insert_with(|| Pulse::every(LIVE_MS)).is_due(now_ms) {
            let states = self.states();
            events.extend(states.into_iter().filter_map(|state| self.told.news(state)));
            events.extend(self.samples());
            events.extend(self.complaint());
        }
        events
    }

    /// Whether the simulator was allowed fewer scans in the last [`tick`](Self::tick) than were
    /// due: as fast as it can go, that is always so.
    pub fn is_behind(&self) -> bool {
        self.simulator.as_ref().is_some_and(|simulator| simulator.is_behind)
    }

    /// Requests and answers, as far as the target answers at once.
    fn exchange(&mut self, now_ms: u64) -> Vec<Event> {
        let Some(plc) = &mut self.plc else { return Vec::new() };
        let mut events = Vec::new();
        for _ in 0..EXCHANGES_MAX {
            let Some(bytes) = plc.transmit(now_ms) else { break };
            match &mut self.simulator {
                Some(simulator) => plc.receive(&simulator.receive(&bytes), now_ms),
                None => events.push(Event::Send { bytes }),
            }
        }
        events
    }

    /// What the PLC has refused, and what nobody waits for an answer to.
    fn complaint(&mut self) -> Option<Event> {
        let message = self.plc.as_mut()?.complaint()?;
        Some(Event::Notice { message, bad: true })
    }

    /// What is wrong with the texts, and what the program takes; the target is shown with it.
    fn checked(&mut self) -> Vec<Event> {
        let problems = Event::Problems { problems: self.editor.problems() };
        let program = build::program(&self.editor).ok();
        let summary = program.as_ref().map(build::summary);
        if let (Some(plc), Some(program)) = (&mut self.plc, program) {
            plc.show(program);
        }
        let events = [problems, Event::Program { program: summary }];
        events.into_iter().filter_map(|event| self.told.news(event)).collect()
    }

    /// What the page is told if it is new.
    fn states(&mut self) -> Vec<Event> {
        let mut events = vec![Event::Status { status: self.status() }];
        events.extend(self.situation());
        if let Some(plc) = &self.plc {
            events.extend([plc.live(), plc.watched(), plc.forced()]);
            let shown = self.ladder.as_ref();
            let is_up = plc.state.link == Link::Up && self.has_program();
            events.extend(
                shown
                    .filter(|_| is_up)
                    .map(|shown| Event::Power { id: shown.id, rungs: shown.power(&plc.state) }),
            );
        }
        let name = self.bench.plant.as_ref().map(|(_, spec)| spec.name()).unwrap_or_default();
        if let Some(simulator) = &mut self.simulator {
            events.push(simulator.pins());
            events.extend(simulator.plant(name, &mut self.plant_events));
        }
        if let Some(chip) = &self.chip {
            events.push(chip.pins());
            events.extend(chip.plant(name, &mut self.plant_events));
        }
        events
    }

    fn fulfil(&mut self, wish: Wish) -> Done {
        match wish {
            Wish::Project(wish) => self.change(wish).map(|()| None),
            Wish::Text(wish) => self.tell(wish),
            Wish::Target(wish) => self.act(wish).map(|()| None),
            Wish::Look(wish) => self.look(wish).map(|()| None),
            Wish::Apart(ApartWish::Simulate { signals, for_ms, scan_ms, plant }) => {
                let plant = plant.map(|spec| self.editor.plant(&spec)).transpose()?;
                let plant = plant.as_ref();
                let wanted = Wanted { signals: &signals, for_ms, scan_ms, plant };
                answer(apart::simulate(&build::files(&self.editor)?, &wanted)?)
            }
            Wish::Apart(ApartWish::Sweep { path, scan_ms, plant }) => {
                let plant = plant.map(|spec| self.editor.plant(&spec)).transpose()?;
                let files = build::files(&self.editor)?;
                answer(apart::sweep(&files, &path, scan_ms, plant.as_ref())?)
            }
            Wish::Apart(ApartWish::Test { file }) => self.test(&file),
            Wish::Apart(ApartWish::Check { name, text, plants }) => {
                self.check(&name, &text, &plants)
            }
        }
    }

    /// The files.
    fn change(&mut self, wish: ProjectWish) -> Result<(), String> {
        self.is_edited = true;
        self.ladder = None;
        self.show_charts(None);
        match wish {
            ProjectWish::Open { files, main } => {
                self.disconnect();
                self.editor.open(files, main)
            }
            ProjectWish::Edit { file, text } => self.editor.set(&file, text),
            ProjectWish::Remove { file } => {
                self.editor.remove(&file);
                Ok(())
            }
            ProjectWish::Rename { file, to } => self.editor.rename(&file, &to),
            ProjectWish::Choose { main } => {
                self.editor.choose(main);
                Ok(())
            }
        }
    }

    /// Questions about the texts.
    fn tell(&mut self, wish: TextWish) -> Done {
        let editor = &self.editor;
        match wish {
            TextWish::Complete { file, at } => answer(editor.complete(&file, at)),
            TextWish::Hover { file, at } => answer(editor.hover(&file, at)),
            TextWish::Definition { file, at } => answer(editor.definition(&file, at)),
            TextWish::References { file, at } => answer(editor.references(&file, at)),
            TextWish::RenameSymbol { file, at, to } => {
                answer(editor.rename_symbol(&file, at, &to)?)
            }
            TextWish::Format { file } => answer(editor.format(&file)?),
            TextWish::Outline { file } => answer(editor.outline(&file)),
            TextWish::Ladder { file, at } => {
                self.drawings += 1;
                let id = self.drawings;
                self.ladder = editor.ladder(&file, at).map(|drawing| Shown { id, file, drawing });
                answer(self.ladder.as_ref().map(Shown::ladder))
            }
            TextWish::Chart { file, values } => {
                self.drawings += 1;
                let document = editor.charts(&file);
                let charts = document.and_then(|one| Charts::of(self.drawings, file, values, &one));
                self.show_charts(charts);
                answer(
                    self.charts
                        .as_ref()
                        .map(|Charts { id, file, .. }| Chart { id: *id, file: file.clone() }),
                )
            }
            TextWish::AboutPlant { spec } => self.about_plant(&spec),
        }
    }

    /// What is done with the target.
    fn act(&mut self, wish: TargetWish) -> Result<(), String> {
        self.check_not_loading(&wish)?;
        match wish {
            TargetWish::Target { kind } => {
                self.disconnect();
                self.kind = kind;
            }
            TargetWish::Connect => self.connect()?,
            TargetWish::Disconnect => self.disconnect(),
            TargetWish::Download => self.download()?,
            TargetWish::DownloadFirmware => self.reach(Then::Download { with_firmware: true })?,
            TargetWish::Plugged { network } => self.plugged(network)?,
            TargetWish::Unplugged { why } => self.unplugged(&why)?,
            TargetWish::Reset => self.reset()?,
            TargetWish::Run => {
                self.bench.is_paused = false;
                if self.has_program() {
                    self.order(Order::Run)?;
                } else if self.is_outside() && self.plc.is_none() {
                    self.reach(Then::Run)?;
                } else {
                    self.download()?;
                }
            }
            TargetWish::Stop => {
                self.bench.is_paused = false;
                self.order(Order::Stop)?;
            }
            TargetWish::Pause { on } => self.pause(on)?,
            TargetWish::SingleScan => self.single_scan()?,
            TargetWish::Speed { factor } => {
                if !(0.0..=1000.0).contains(&factor) {
                    return Err(format!("{factor}: time goes 0 to 1000 times as fast"));
                }
                self.bench.speed = factor;
            }
            TargetWish::Plant { spec } => self.wire(spec)?,
            TargetWish::Handle { name, value } => self.handle(name, value)?,
            TargetWish::Drive { operand, value } => self.drive(&operand, value)?,
            TargetWish::Activate { step, on } => self.activate(&step, on)?,
            TargetWish::Set { operand, value } => {
                let (operand, raw) = self.value(&operand, &value)?;
                if is_input(operand.address) {
                    let name = operand.name;
                    return Err(format!("{name} is an input, it follows its pin: force it"));
                }
                self.order(Order::Set(operand, raw))?;
            }
            TargetWish::Force { operand, value } => {
                let (operand, raw) = self.value(&operand, &value)?;
                self.order(Order::Force(operand, raw))?;
            }
            TargetWish::Unforce { operand: Some(operand) } => {
                let operand = self.connected()?.operand(&operand)?;
                self.order(Order::Unforce(operand))?;
            }
            TargetWish::Unforce { operand: None } => self.order(Order::UnforceAll)?,
        }
        Ok(())
    }

    /// What is to be seen.
    fn look(&mut self, wish: LookWish) -> Result<(), String> {
        match wish {
            LookWish::Watch { operands } => {
                self.watched = operands;
                if let Some(plc) = &mut self.plc {
                    plc.watch(&self.watched);
                }
            }
            LookWish::View { file, from, to } => {
                self.view = (from > 0).then_some(Lines { file, from, to });
                if let Some(plc) = &mut self.plc {
                    plc.view(self.view.clone());
                }
            }
            LookWish::Scope { signals, every_ms } => {
                self.scope_names = (signals, every_ms);
                if self.recorder.is_none() {
                    self.choose_signals();
                }
            }
            LookWish::Record { signals, every_ms, for_ms } => {
                self.record(&signals, every_ms, for_ms)?;
            }
            LookWish::EndRecording => {
                let recorded = self.recorded();
                self.errands.extend(recorded);
            }
        }
        Ok(())
    }

    fn connected(&mut self) -> Result<&mut Plc, String> {
        self.plc.as_mut().ok_or_else(|| "not connected: press Run or Connect".to_owned())
    }

    fn order(&mut self, order: Order) -> Result<(), String> {
        self.connected()?.order(order);
        Ok(())
    }

    fn value(&mut self, operand: &str, value: &str) -> Result<(client::Operand, u32), String> {
        let operand = self.connected()?.operand(operand)?;
        let raw = operand.form.parse(value)?;
        Ok((operand, raw))
    }

    fn has_program(&self) -> bool {
        self.plc.as_ref().is_some_and(|plc| plc.state.agreement() == Agreement::Same)
    }

    fn connect(&mut self) -> Result<(), String> {
        match self.kind {
            TargetKind::Simulator | TargetKind::VirtualUno => self.download(),
            TargetKind::Usb | TargetKind::Bridge => self.reach(Then::Connect),
        }
    }

    /// Puts the program on the target, which starts with it.
    fn download(&mut self) -> Result<(), String> {
        match self.kind {
            TargetKind::Simulator => self.switch_on_simulator(),
            TargetKind::VirtualUno => self.switch_on_chip(),
            TargetKind::Usb | TargetKind::Bridge => {
                self.reach(Then::Download { with_firmware: false })
            }
        }
    }

    fn switch_on_simulator(&mut self) -> Result<(), String> {
        self.renew_plant()?;
        let program = build::program(&self.editor)?;
        let files = build::files(&self.editor)?;
        self.simulator = Some(Simulator::new(&files, &self.bench)?);
        (self.plant_events, self.bench.is_paused) = (0, false);
        let framing = Framing::Tcp { unit: 1, transaction: 0 };
        self.attach(Plc::new(framing, program, "the simulator", 0));
        Ok(())
    }

    /// The virtual Uno with firmware and program. It boots before it hears.
    fn switch_on_chip(&mut self) -> Result<(), String> {
        self.renew_plant()?;
        let program = build::board_program(&self.editor)?;
        let settings = build::settings(&program);
        self.chip = Some(Surroundings::new(settings, &self.bench)?);
        self.errands.push(Event::PowerOn { flash: build::flash(&program)? });
        (self.plant_events, self.bench.is_paused) = (0, false);
        self.attach(Plc::new(build::framing(settings), program, "the virtual Uno", BOOT_MS));
        Ok(())
    }

    /// A PLC is at the other end of the line: it is asked from now on for what is to be seen.
    fn attach(&mut self, mut plc: Plc) {
        self.leave_recording("a program was loaded");
        plc.watch(&self.watched);
        plc.view(self.view.clone());
        self.plc = Some(plc);
        self.follow_charts();
        self.scope.restart();
        self.choose_signals();
    }

    /// As switched on again; a board with the program that it has.
    fn reset(&mut self) -> Result<(), String> {
        if self.is_outside() {
            return self.reset_outside();
        }
        let (Some(_), Some(chip)) = (&self.plc, &self.chip) else { return self.download() };
        let begin_ms = chip.time_ms() + BOOT_MS;
        self.errands.push(Event::ResetBoard);
        self.bench.is_paused = false;
        if let Some(plc) = &mut self.plc {
            plc.reset(begin_ms);
        }
        Ok(())
    }

    fn disconnect(&mut self) {
        // Whoever connects again is told everything again.
        self.told = Told::default();
        self.leave_recording("the target was left");
        if self.chip.take().is_some() {
            self.errands.push(Event::PowerOff);
        }
        if self.outside.is_open() {
            self.errands.push(Event::ClosePort);
        }
        (self.plc, self.simulator, self.outside) = (None, None, Outside::default());
        self.bench.is_paused = false;
    }

    fn pause(&mut self, on: bool) -> Result<(), String> {
        if self.simulator.is_none() && self.chip.is_none() {
            return Err(
                "only what is in the page can pause; a board has Stop and Single scan".to_owned()
            );
        }
        self.bench.is_paused = on;
        Ok(())
    }

    /// One scan: of a simulator that runs, which pauses then, or of a PLC in STOP.
    fn single_scan(&mut self) -> Result<(), String> {
        if self.plc.is_none() && self.kind == TargetKind::Simulator {
            self.download()?;
            self.bench.is_paused = true;
        }
        let is_running = |plc: &Plc| plc.state.identity.as_ref().is_none_or(|one| one.is_running);
        match (&mut self.plc, &mut self.simulator) {
            (Some(plc), Some(simulator)) if self.bench.is_paused || is_running(plc) => {
                self.bench.is_paused = true;
                let now_ms = self.now_ms;
                plc.hurry();
                // Questions that are answered by what a scan executes are asked before it; those
                // that another scan would answer stay open.
                let mut has_scanned = false;
                for _ in 0..EXCHANGES_MAX {
                    let Some(bytes) = plc.transmit(now_ms) else { break };
                    let mut answers = simulator.receive(&bytes);
                    if answers.is_empty() && !std::mem::replace(&mut has_scanned, true) {
                        answers = simulator.scan(&mut self.scope);
                    }
                    plc.receive(&answers, now_ms);
                }
                if !has_scanned {
                    let answers = simulator.scan(&mut self.scope);
                    plc.receive(&answers, now_ms);
                }
            }
            (Some(plc), None) if is_running(plc) => {
                return Err("single scans go from STOP: press Stop first".to_owned());
            }
            (Some(plc), _) => {
                let scan = plc.state.single_scan();
                plc.order(scan);
            }
            (None, _) => return Err("not connected: press Run or Connect".to_owned()),
        }
        Ok(())
    }

    fn drive(&mut self, name: &str, value: i32) -> Result<(), String> {
        let operand = Operand::parse(name, &[]).map_err(|error| error.to_string())?;
        if let Some(simulator) = &mut self.simulator {
            simulator.drive(operand, value)?;
        }
        if let Some(chip) = &mut self.chip {
            chip.drive(operand, value)?;
        }
        self.bench.driven.insert(operand, value);
        Ok(())
    }
}

fn answer(value: impl Serialize) -> Done {
    serde_json::to_value(value).map(Some).map_err(|error| error.to_string())
}
