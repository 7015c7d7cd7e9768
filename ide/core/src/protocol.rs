//! What the page asks and what it is told, as JSON. Offsets in texts count UTF-16 code units, as a
//! browser does. Times are milliseconds.

pub mod ladder;
pub mod plant;

use serde::{Deserialize, Serialize};

/// What the page wants. `id` comes back in the answer, where there is one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Request {
    /// Chosen by the page.
    pub id: u32,
    /// What it is.
    #[serde(flatten)]
    pub wish: Wish,
}

/// A file of the project.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct File {
    /// Its name, with its ending and perhaps folders, `/` between them.
    pub name: String,
    /// Its text.
    pub text: String,
}

/// The wishes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Wish {
    /// About the files.
    Project(ProjectWish),
    /// A question about a text.
    Text(TextWish),
    /// What is to be done with the target.
    Target(TargetWish),
    /// What is to be seen of it.
    Look(LookWish),
    /// What is done apart from it.
    Apart(ApartWish),
}

/// Wishes about the files of the project.
#[expect(missing_docs, reason = "the fields are told with their variant")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "do", rename_all = "camelCase", rename_all_fields = "camelCase")]
pub enum ProjectWish {
    /// Replaces the project. `main` is the program; without it the first one there is.
    Open { files: Vec<File>, main: Option<String> },
    /// A file has another text, or is new.
    Edit { file: String, text: String },
    /// A file is gone.
    Remove { file: String },
    /// A file has another name.
    Rename { file: String, to: String },
    /// Another program is the one that is run.
    Choose { main: String },
}

/// Questions about a text; `at` is an offset in it.
#[expect(missing_docs, reason = "the fields are told with their variant")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "do", rename_all = "camelCase", rename_all_fields = "camelCase")]
pub enum TextWish {
    /// What could be written there. Answer: [`Completion`]s.
    Complete { file: String, at: u32 },
    /// What is there. Answer: [`Hover`] or null.
    Hover { file: String, at: u32 },
    /// Where that is declared. Answer: [`Place`] or null.
    Definition { file: String, at: u32 },
    /// Where it is used, its declaration included. Answer: [`Place`]s.
    References { file: String, at: u32 },
    /// Gives it another name. Answer: [`Edits`].
    RenameSymbol { file: String, at: u32, to: String },
    /// The file in its layout. Answer: [`Edits`].
    Format { file: String },
    /// Networks, units, labels. Answer: [`Item`]s.
    Outline { file: String },
    /// The network there as a ladder, whose power flow is told from then on. Answer:
    /// [`Ladder`](ladder::Ladder) or null.
    Ladder { file: String, at: u32 },
    /// The situation of the charts of a file is told from then on, with the values of these
    /// operands; of a file without charts none. Answer: [`Chart`] or null.
    Chart { file: String, values: Vec<String> },
    /// A plant as `awl-sim --plant` takes it; files are those of the project. Answer:
    /// [`PlantInfo`](plant::PlantInfo).
    AboutPlant { spec: String },
}

/// What is to be done with the target.
#[expect(missing_docs, reason = "the fields are told with their variant")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "do", rename_all = "camelCase", rename_all_fields = "camelCase")]
pub enum TargetWish {
    /// Chooses what the program runs on.
    Target { kind: TargetKind },
    /// Opens the way to it.
    Connect,
    /// Closes it.
    Disconnect,
    /// Puts the program on it, which starts.
    Download,
    /// Puts firmware and program on a board, which starts.
    DownloadFirmware,
    /// The page has opened the port that it was asked for; whether it is a connection of the
    /// network, with Modbus TCP on it.
    Plugged { network: bool },
    /// The port is gone, or was not opened: why; empty where nobody wanted it.
    Unplugged { why: String },
    /// Connects and downloads if need be, and goes to RUN.
    Run,
    /// Goes to STOP: outputs are off.
    Stop,
    /// The simulator or the virtual Uno stands still, with all values and outputs as they are; or
    /// goes on.
    Pause { on: bool },
    /// One scan; a simulator that runs pauses before it.
    SingleScan,
    /// The simulator as switched on again; a board as by its button.
    Reset,
    /// How fast their time goes: 1 is real time, 0 as fast as it can.
    Speed { factor: f64 },
    /// The plant that is wired to them, as `awl-sim --plant` takes it; none without it.
    Plant { spec: Option<String> },
    /// Something in their plant is set: a button, a fault.
    Handle { name: String, value: i64 },
    /// Their input gets a value: `I0.0` to `I0.5` logically, `Ain0` to `Ain5` in counts.
    Drive { operand: String, value: i32 },
    /// Makes a step active, or inactive, in the simulator; `step` is its variable. Its time begins
    /// anew.
    Activate { step: String, on: bool },
    /// Writes a value once. `value` as people write it.
    Set { operand: String, value: String },
    /// Forces an operand until it is released.
    Force { operand: String, value: String },
    /// Releases an operand, or all of them.
    Unforce { operand: Option<String> },
}

/// What is to be seen of the target.
#[expect(missing_docs, reason = "the fields are told with their variant")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "do", rename_all = "camelCase", rename_all_fields = "camelCase")]
pub enum LookWish {
    /// What the watch table shows.
    Watch { operands: Vec<String> },
    /// Which lines of a file of the program can be seen, from 1; live values come for these alone.
    /// Both 0: none.
    View { file: String, from: u32, to: u32 },
    /// What the oscilloscope shows, and how often a sample is taken; 0: after each scan, or as
    /// often as the line can.
    Scope { signals: Vec<String>, every_ms: u32 },
    /// Records what the target does, for so long on its clock; the oscilloscope has no samples
    /// meanwhile. Told in between: [`Event::Recording`]; at the end: [`Event::Recorded`].
    Record { signals: Vec<String>, every_ms: u32, for_ms: u32 },
    /// Ends a recording before its time.
    EndRecording,
}

/// What is done apart from the target, as fast as possible.
#[expect(missing_docs, reason = "the fields are told with their variant")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "do", rename_all = "camelCase", rename_all_fields = "camelCase")]
pub enum ApartWish {
    /// Runs the program. `scan_ms` 0: as it says itself. Answer: [`Recording`].
    Simulate { signals: Vec<String>, for_ms: u32, scan_ms: u32, plant: Option<String> },
    /// Measures a frequency response. `scan_ms` as above. Answer: [`FrequencyResponse`].
    Sweep { path: Path, scan_ms: u32, plant: Option<String> },
    /// Runs a scenario of the project. Answer: [`TestResult`].
    Test { file: String },
    /// Runs one that is not in it with the program that is run, as the hidden ones of exercises.
    /// `plants`: the plant files that it may name. Answer: [`TestResult`].
    Check { name: String, text: String, plants: Vec<File> },
}

/// What a program can run on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum TargetKind {
    /// The reference interpreter, in the page.
    #[default]
    Simulator,
    /// The firmware on an emulated chip, in the page.
    VirtualUno,
    /// A board at a port of this computer, by Web Serial.
    Usb,
    /// A board or PLC that `uno200 ide` reaches.
    Bridge,
}

/// What the page is told.
#[expect(missing_docs, reason = "the fields are told with their variant")]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "is", rename_all = "camelCase", rename_all_fields = "camelCase")]
pub enum Event {
    /// The answer to a question.
    Answer { id: u32, answer: serde_json::Value },
    /// A request that cannot be carried out, and what helps.
    Refused { id: u32, message: String },
    /// What is wrong in the files, all of it.
    Problems { problems: Vec<Problem> },
    /// What the program takes, after it was assembled; `None` while it has errors.
    Program { program: Option<Summary> },
    /// How the target is.
    Status { status: Status },
    /// Live values beside the lines of a file that can be seen.
    Live { file: String, lines: Vec<Line> },
    /// Power flow in the ladder with this number, the one that was asked for last, rung by rung.
    Power { id: u32, rungs: Vec<ladder::Power> },
    /// How the charts with this number are, those that were asked for last. `before`: the
    /// situations since that was told the last time, where each scan is looked at; `lost` where
    /// some are missing before the first of these.
    Situation {
        id: u32,
        #[serde(flatten)]
        now: Moment,
        before: Vec<Moment>,
        lost: bool,
    },
    /// The watch table, in its order.
    Watched { values: Vec<Value> },
    /// What is forced, wherever it was done.
    Forced { values: Vec<Value> },
    /// The points of the simulator or the virtual Uno, logical. `pwm`: the part of the time in
    /// thousandths that Q0.1 and Q0.2 are on, of those that are modulated.
    Pins { inputs: u8, outputs: u8, analog: Vec<u16>, pwm: Vec<u16> },
    /// How the plant is: what its picture needs. `places`: how its shapes are, as
    /// [`places`](awl_sim::plant::Plant::places) gives them.
    Plant { name: String, state: Vec<(String, f64)>, places: Vec<Vec<f64>>, news: Vec<String> },
    /// Samples of the oscilloscope, in its order of signals; `lost` where some could not be taken
    /// before the first of these.
    Samples { times: Vec<f64>, columns: Vec<Vec<f64>>, lost: bool },
    /// How far the recording is, and how often samples are missing in it.
    Recording { done_ms: f64, gaps: u32 },
    /// What was recorded; `ended`: why before its time.
    Recorded { recording: Recording, ended: Option<String> },
    /// Bytes for the line of a target outside; the page sends them.
    Send { bytes: Vec<u8> },
    /// The virtual Uno is switched on with this in its flash, from address 0 on. Its EEPROM stays.
    PowerOn { flash: Vec<u8> },
    /// The virtual Uno is unplugged.
    PowerOff,
    /// The port to a target of this kind is to be opened, 8 bits and one stop bit; one that was
    /// opened before, again. Opening it may reset a board, so people are asked before the first
    /// time. Answer: [`TargetWish::Plugged`] or [`TargetWish::Unplugged`]. `parity`: `none`,
    /// `even`, `odd`.
    OpenPort { kind: TargetKind, baud: u32, parity: String },
    /// The port is to be closed.
    ClosePort,
    /// DTR and RTS of the port are to be switched.
    Lines { on: bool },
    /// The board does not hold the firmware: whether it shall be written, too, is to be asked.
    AskFirmware,
    /// A board outside is to be reset, as by its button.
    ResetBoard,
    /// Something to tell, for a moment.
    Notice { message: String, bad: bool },
}

/// An error or a warning.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Problem {
    /// The file.
    pub file: String,
    /// `E0012`; empty where it has none.
    pub code: String,
    /// Or a warning.
    pub is_error: bool,
    /// Where it is.
    pub from: u32,
    /// Where it ends.
    pub to: u32,
    /// Line, from 1.
    pub line: u32,
    /// Column, from 1.
    pub column: u32,
    /// What is wrong.
    pub message: String,
    /// How to mend it, a sentence each.
    pub help: Vec<String>,
    /// What would be right in place of `from` to `to`.
    pub suggestion: Option<String>,
    /// Other places that have to do with it.
    pub related: Vec<(Place, String)>,
}

/// Charts whose situation is told.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Chart {
    /// What they are called where their situation is told; another one each time.
    pub id: u32,
    /// The file that they are in.
    pub file: String,
}

/// How charts are at the end of a scan.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Moment {
    /// When, on the clock of the target where it has one.
    pub time_ms: f64,
    /// Scans since RUN, as far as they are known.
    pub scan: u32,
    /// Which steps are active, chart by chart; null where it is not known.
    pub steps: Vec<Vec<Option<bool>>>,
    /// The values that were asked for with the charts.
    pub values: Vec<Option<f64>>,
}

/// A place in a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Place {
    /// The file.
    pub file: String,
    /// Where it begins.
    pub from: u32,
    /// Where it ends.
    pub to: u32,
}

/// Something that could be written.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Completion {
    /// What is written.
    pub label: String,
    /// Its kind: `instruction`, `keyword`, `symbol`, `variable`, `address`, `routine`, `label`,
    /// `value`.
    pub kind: String,
    /// A few words beside it.
    pub detail: String,
    /// Its documentation, in Markdown.
    pub info: String,
    /// What comes in the place of `from` to the cursor.
    pub insert: String,
    /// Where something is to be written in that, in the page's offsets.
    pub holes: Vec<u32>,
    /// Where the text begins that it replaces; that ends at the cursor.
    pub from: u32,
}

/// What something is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Hover {
    /// In Markdown.
    pub text: String,
    /// Where it begins.
    pub from: u32,
    /// Where it ends.
    pub to: u32,
}

/// Changes of files.
pub type Edits = Vec<Edit>;

/// A change of a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Edit {
    /// What is replaced.
    #[serde(flatten)]
    pub place: Place,
    /// By what.
    pub text: String,
}

/// A part of a file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Item {
    /// Its name, or title.
    pub name: String,
    /// `network`, `unit`, `label`, `symbol`.
    pub kind: String,
    /// Line, from 1.
    pub line: u32,
    /// Where it begins.
    pub from: u32,
}

/// What a program takes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Summary {
    /// The main file.
    pub file: String,
    /// All of its files.
    pub files: Vec<String>,
    /// Instructions.
    pub instructions: u32,
    /// Bytes of the image.
    pub bytes: u32,
    /// As many as the Uno has room for.
    pub bytes_max: u32,
    /// Bytes of data memory.
    pub data: u32,
    /// As many as the Uno has.
    pub data_max: u32,
    /// The longest scan on the Uno in microseconds, where it is known.
    pub longest_us: Option<f64>,
    /// Whether it fits the Uno.
    pub fits_uno: bool,
    /// Its symbols and what they are: what watch table and oscilloscope suggest.
    pub operands: Vec<(String, String)>,
}

/// How the target is.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Status {
    /// What it is.
    pub target: TargetKind,
    /// `OFFLINE`, `RUN`, `STOP`, `PAUSE`, `LOST`, `LOADING`.
    pub mode: String,
    /// How far the writing of a board is.
    pub loading: Option<Loading>,
    /// How the program in it relates to the one on the screen: `same`, `native`, `other`, `none`,
    /// `unknown`.
    pub agreement: String,
    /// Scans since RUN.
    pub scans: u32,
    /// Time of the simulator, from its first scan; of the virtual Uno, since power came.
    pub time_ms: u64,
    /// How many times as fast as a clock the virtual Uno goes, where that is not what was asked
    /// for: the computer is not faster.
    pub pace: Option<f64>,
    /// Shortest, last and longest scan in microseconds, where they are measured.
    pub scan_us: Option<(f64, f64, f64)>,
    /// Why it stopped by itself.
    pub fault: Option<String>,
    /// Where in the project that is.
    pub fault_at: Option<Place>,
    /// Why the link is lost.
    pub lost: Option<String>,
}

/// How far the writing of a board is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Loading {
    /// `connecting`, `writing`, `verifying`, `starting`.
    pub phase: String,
    /// Of all that is written and read.
    pub percent: u32,
}

/// Live values beside a line.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Line {
    /// From 1.
    pub line: u32,
    /// Power flow after it: `on`, `off`, `skipped`; none where it is not known. Of a statement
    /// whether it was executed, of a condition whether it was true.
    pub flow: Option<String>,
    /// The values of its operands.
    pub values: Vec<Value>,
}

/// A value of an operand.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Value {
    /// The operand as it was written.
    pub name: String,
    /// The value as people read it; empty where it is not known.
    pub text: String,
    /// The value.
    pub number: Option<f64>,
    /// `bit`, `byte`, `word`, `double`, `real`.
    pub form: String,
    /// Whether it is forced.
    pub forced: bool,
    /// Whether it can be.
    pub can_force: bool,
    /// What is wrong with the operand.
    pub problem: Option<String>,
}

/// What was recorded: a column for each signal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Recording {
    /// Signals.
    pub names: Vec<String>,
    /// When something was measured, or changed.
    pub times: Vec<f64>,
    /// Values from then on; `None`: nothing is known of them.
    pub columns: Vec<Vec<Option<f64>>>,
    /// Least, greatest and mean value of each; not finite where nothing is known.
    pub figures: Vec<(f64, f64, f64)>,
    /// The file that awl-sim would write.
    pub csv: String,
    /// The same as a value change dump.
    pub vcd: String,
    /// What the plant has to say.
    pub plant: Option<String>,
    /// How often samples are missing.
    pub gaps: u32,
}

/// The path whose frequency response is measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Path {
    /// What the sine is written to.
    pub excite: String,
    /// Where the path begins, if that is not what is excited.
    pub from: Option<String>,
    /// Where it ends.
    pub to: String,
    /// Lowest frequency in Hz, above 0.
    pub low: f64,
    /// Highest one, above the lowest.
    pub high: f64,
    /// The amplitude of the sine, above 0.
    pub amplitude: f64,
    /// Around which value it swings.
    pub offset: f64,
}

/// A frequency response: a value for each frequency.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct FrequencyResponse {
    /// In Hz, ascending.
    pub frequencies: Vec<f64>,
    /// In decibels; not finite where nothing comes out.
    pub gains: Vec<f64>,
    /// In degrees; `None` where nothing comes out.
    pub phases: Vec<Option<f64>>,
    /// What comes out besides the sine, for the sine.
    pub distortions: Vec<f64>,
    /// Whether it had settled.
    pub settled: Vec<bool>,
    /// Bandwidth and margins, where they are in the band.
    pub figures: SweepFigures,
    /// The file that awl-sim would write.
    pub csv: String,
}

/// What is read off a frequency response.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct SweepFigures {
    /// Where the gain has fallen by 3 dB, in Hz.
    pub bandwidth: Option<f64>,
    /// Where the gain is 0 dB, in Hz, and the phase margin in degrees.
    pub phase_margin: Option<(f64, f64)>,
    /// Where the phase is -180 degrees, in Hz, and the gain margin in dB.
    pub gain_margin: Option<(f64, f64)>,
}

/// How a scenario went.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct TestResult {
    /// What it is about, where it says so.
    pub goal: Option<plant::Words>,
    /// Whether all was as expected.
    pub passed: bool,
    /// Scans that were run.
    pub scans: u64,
    /// Expectations that were met.
    pub met: u64,
    /// Those that were not: line in the scenario, and expected and got in words.
    pub failures: Vec<(u32, String)>,
    /// Of the plant.
    pub plant: Option<String>,
}
