//! The listing: every source line with the bytes it became, the depth of the logic stack after it,
//! and its cycles on the board; the cycles of each network and of the longest scan.

use std::collections::HashMap;
use std::fmt::Write as _;

use crate::assemble::Assembly;
use crate::image::encode::Line;
use crate::meaning::selected::span_of;
use crate::output::cost::{self, Cycles, InstructionCost, ProgramCost, Stated, Ways};
use crate::output::longest_scan;
use crate::source::Source;
use crate::text::ast::{Network, Statement};

/// Bytes of the longest instruction: FOR with a hidden one before it.
const BYTES_SHOWN: usize = 12;
/// Characters of the columns.
const BYTES_WIDTH: usize = BYTES_SHOWN * 3 - 1;
const CYCLES_WIDTH: usize = 13;

const LEGEND: &str = "\
Cycles: the least and the most. Of an instruction that needs power flow the least are those \
without it; after / are
those of a jump that is taken, a loop that is skipped or goes back, and the end of the program.
";

/// Writes the listing of an assembled program.
pub fn listing(source: &Source, assembly: &Assembly) -> String {
    let image = assembly.image.as_deref().unwrap_or(&assembly.draft);
    let cost = cost::cost_with(image, &Stated::of(assembly));
    let mut text =
        format!("{}: {} instructions, {} bytes\n\n", source.name, assembly.code.len(), image.len());
    if cost.is_some() {
        let _ = writeln!(text, "{LEGEND}");
    }
    let mut listing =
        Listing { text, source, assembly, image, cost: cost.as_ref(), network: None, next: 0 };
    listing.row(["line", "offset", "bytes", "stack", "interpreter", "native", "source"]);
    listing.lines();
    if let Some(cost) = &cost {
        listing.text += &longest_scan::report(source, assembly, cost);
    }
    listing.text
}

/// The cycles of a network so far.
struct NetworkCost {
    number: u32,
    /// `None` where the costs of an instruction are unknown.
    interpreted: Option<Cycles>,
    /// `None` where the program is not translated, too.
    native: Option<Cycles>,
}

struct Listing<'a> {
    text: String,
    source: &'a Source,
    assembly: &'a Assembly,
    image: &'a [u8],
    cost: Option<&'a ProgramCost>,
    network: Option<NetworkCost>,
    /// The next instruction.
    next: usize,
}

impl Listing<'_> {
    fn row(&mut self, [line, offset, bytes, stack, interpreter, native, source]: [&str; 7]) {
        let row = format!(
            "{line:>6}  {offset:>6}  {bytes:<BYTES_WIDTH$}  {stack:>5}  \
             {interpreter:>CYCLES_WIDTH$}  \
             {native:>CYCLES_WIDTH$}  {source}"
        );
        self.text += row.trim_end();
        self.text.push('\n');
    }

    fn lines(&mut self) {
        let networks = self.networks();
        for (number, line) in (1..).zip(self.source.lines()) {
            if let Some(network) = networks.get(&number) {
                self.end_network();
                let native =
                    self.cost.and_then(|cost| cost.translated.as_ref()).map(|_| Cycles::default());
                self.network = Some(NetworkCost {
                    number: *network,
                    interpreted: Some(Cycles::default()),
                    native,
                });
            }
            let (file, in_file) = self.source.line_in_file(number);
            if in_file == 1 && self.source.has_files() {
                self.row(["", "", "", "", "", "", file]);
            }
            let mut shown = false;
            while self.is_in_line(number) {
                self.instruction(in_file, if shown { "" } else { line });
                shown = true;
            }
            if !shown {
                self.row([&in_file.to_string(), "", "", "", "", "", line]);
            }
        }
        self.end_network();
    }

    /// The networks by the lines in which they begin.
    fn networks(&self) -> HashMap<usize, u32> {
        let networks =
            self.assembly.program.statements.iter().filter_map(|statement| match statement {
                Statement::Network(Network { span, number, .. }) => Some((span, *number)),
                Statement::Instruction(_) | Statement::Unit(_) => None,
            });
        networks
            .map(|(span, number)| (self.source.position(span.start as usize).0, number))
            .collect()
    }

    /// Whether the next instruction is in this line.
    fn is_in_line(&self, number: usize) -> bool {
        self.assembly.code.get(self.next).is_some_and(|selected| {
            let start = span_of(&self.assembly.program, selected).start;
            self.source.position(start as usize).0 == number
        })
    }

    fn instruction(&mut self, number: usize, line: &str) {
        let Some(encoded) = self.assembly.lines.get(self.next).copied() else {
            self.next += 1;
            return;
        };
        let at = encoded.at as usize;
        let bytes = self.image.get(at..at + usize::from(encoded.len)).unwrap_or(&[]);
        let depth = self.assembly.depths.get(self.next).copied().unwrap_or(0);
        let interpreted =
            self.ways(encoded, |cost| Some(cost.interpreted).filter(|ways| ways.is_known()));
        let native = self.ways(encoded, |cost| cost.translated);
        if let Some(network) = &mut self.network {
            network.interpreted =
                network.interpreted.zip(interpreted).map(|(sum, ways)| sum.then(ways.all()));
            network.native = network.native.zip(native).map(|(sum, native)| sum.then(native.all()));
        }
        self.row([
            &number.to_string(),
            &format!("{:04X}", encoded.at),
            &hex(bytes),
            &depth.to_string(),
            &interpreted.map_or(String::new(), ways_text),
            &native.map_or(String::new(), ways_text),
            line,
        ]);
        self.next += 1;
    }

    /// What a line costs, with what is hidden in it.
    fn ways(&self, line: Line, of: impl Fn(&InstructionCost) -> Option<Ways>) -> Option<Ways> {
        let instructions = &self.cost?.instructions;
        let range = line.at..line.at + u32::from(line.len);
        let first = instructions.partition_point(|cost| u32::from(cost.at) < range.start);
        let in_line =
            instructions.get(first..)?.iter().take_while(|cost| range.contains(&cost.at.into()));
        in_line.map(of).reduce(|hidden, ways| Some(behind(hidden?, ways?)))?
    }

    fn end_network(&mut self) {
        let Some(network) = self.network.take() else { return };
        if self.cost.is_some() {
            let native = network.native.map_or(String::new(), range);
            let title = format!("network {}", network.number);
            let interpreted = network.interpreted.map_or(String::new(), range);
            self.row(["", "", &title, "", &interpreted, &native, ""]);
        }
    }
}

/// Both, one after the other.
fn behind(hidden: Ways, ways: Ways) -> Ways {
    let before = hidden.all();
    let add = |way: Option<Cycles>| way.map(|way| before.then(way));
    Ways { off: add(ways.off), on: add(ways.on), away: add(ways.away) }
}

fn ways_text(ways: Ways) -> String {
    match (ways.next(), ways.away) {
        (Some(next), Some(away)) => format!("{}/{}", range(next), range(away)),
        (next, away) => next.or(away).map_or(String::new(), range),
    }
}

fn range(Cycles { min, max }: Cycles) -> String {
    if min == max { max.to_string() } else { format!("{min}-{max}") }
}

/// Bytes as hexadecimal digits, with blanks between.
fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(" ")
}
