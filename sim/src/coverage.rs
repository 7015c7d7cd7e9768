//! Which parts of a program were executed, over any number of runs: its networks, and in them its
//! instructions. What was executed is asked of the machine.

use std::fmt;

use awl_asm::assemble::Assembly;
use awl_asm::ast::Statement;

use crate::trace::Trace;

/// A network of a program; in a text without networks the whole of a unit.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Network {
    /// The program unit, such as `SBR0`; empty where the text has no units.
    pub unit: String,
    /// Its number; none in a text without networks.
    pub number: Option<u32>,
    /// Its title; may be empty.
    pub title: String,
    /// Its instructions, in the order of the text.
    pub instructions: Vec<Instruction>,
}

/// An instruction of a network.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Instruction {
    /// Offset of its first byte in the image.
    pub at: u32,
    /// Its bytes.
    pub len: u8,
    /// Where it is in the text, such as `motor.awl:12`.
    pub place: String,
}

impl fmt::Display for Network {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = self.number.map(|number| format!("network {number}"));
        let title = Some(format!("({})", self.title)).filter(|_| !self.title.is_empty());
        let unit = Some(self.unit.clone()).filter(|unit| !unit.is_empty());
        let parts: Vec<String> = [unit, number, title].into_iter().flatten().collect();
        f.write_str(if parts.is_empty() { "program".to_string() } else { parts.join(" ") }.as_str())
    }
}

/// The networks that have instructions, in the order of the text.
pub(crate) fn networks(assembly: &Assembly, place_of: &dyn Fn(u16) -> String) -> Vec<Network> {
    let mut networks = vec![Network::default()];
    let mut code = assembly.code.iter().zip(&assembly.lines).peekable();
    for (number, statement) in (0..).zip(&assembly.program.statements) {
        let unit = networks.last().map(|network| network.unit.clone()).unwrap_or_default();
        match statement {
            Statement::Unit(head) => {
                networks.push(Network { unit: head.id.to_string(), ..Network::default() });
            }
            Statement::Network(head) => {
                let (number, title) = (Some(head.number), head.title.clone());
                networks.push(Network { unit, number, title, instructions: Vec::new() });
            }
            Statement::Instruction(_) => {
                while let Some((_, line)) = code.next_if(|(one, _)| one.statement == number) {
                    let place = u16::try_from(line.at).map(place_of).unwrap_or_default();
                    let instruction = Instruction { at: line.at, len: line.len, place };
                    if let Some(network) = networks.last_mut() {
                        network.instructions.push(instruction);
                    }
                }
            }
        }
    }
    networks.retain(|network| !network.instructions.is_empty());
    networks
}

/// What was executed of a program, and the values that its bits had after the scans.
#[derive(Debug, Clone, Default)]
pub struct Coverage {
    networks: Vec<Network>,
    /// By offset in the image.
    executed: Vec<bool>,
    bits: Vec<Bit>,
}

/// A bit and which values it had.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Bit {
    name: String,
    was: [bool; 2],
}

impl Coverage {
    /// Nothing has been executed yet.
    pub fn new(networks: Vec<Network>) -> Coverage {
        Coverage { networks, executed: Vec::new(), bits: Vec::new() }
    }

    /// Adds a run: what was executed by offset in the image, and a trace of the bits.
    pub fn add(&mut self, executed: &[bool], trace: &Trace) {
        self.executed.resize(self.executed.len().max(executed.len()), false);
        for (all, one) in self.executed.iter_mut().zip(executed) {
            *all |= one;
        }
        for (index, signal) in trace.signals().iter().enumerate() {
            let mut was = [false; 2];
            for change in trace.changes(index) {
                was[usize::from(change.value != 0)] = true;
            }
            match self.bits.iter_mut().find(|bit| bit.name == signal.name) {
                Some(bit) => bit.was = [bit.was[0] | was[0], bit.was[1] | was[1]],
                None => self.bits.push(Bit { name: signal.name.clone(), was }),
            }
        }
    }

    /// Instructions executed, and all of them.
    pub fn instructions(&self) -> (usize, usize) {
        let all = || self.networks.iter().flat_map(|network| &network.instructions);
        (all().filter(|instruction| self.was_executed(instruction)).count(), all().count())
    }

    /// The networks with instructions that were never executed, and these instructions.
    pub fn left_out(&self) -> impl Iterator<Item = (&Network, Vec<&Instruction>)> {
        let left = |network: &'_ Network| -> Vec<usize> {
            let instructions = network.instructions.iter().enumerate();
            let left = instructions.filter(|(_, instruction)| !self.was_executed(instruction));
            left.map(|(index, _)| index).collect()
        };
        self.networks.iter().filter_map(move |network| {
            let left = left(network);
            let instructions = left.iter().map(|&index| &network.instructions[index]);
            (!left.is_empty()).then(|| (network, instructions.collect()))
        })
    }

    /// The number of networks.
    pub fn networks(&self) -> usize {
        self.networks.len()
    }

    /// The bits that had one value after all scans, and that value.
    pub fn constant_bits(&self) -> impl Iterator<Item = (&str, bool)> {
        self.bits.iter().filter_map(|bit| match bit.was {
            [true, false] => Some((bit.name.as_str(), false)),
            [false, true] => Some((bit.name.as_str(), true)),
            [true, true] | [false, false] => None,
        })
    }

    fn was_executed(&self, instruction: &Instruction) -> bool {
        // With it come hidden instructions, before and after.
        let (at, len) = (instruction.at as usize, usize::from(instruction.len));
        (at..at + len).any(|at| self.executed.get(at).copied().unwrap_or(false))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Machine;
    use crate::open::{File, Opened, open};
    use crate::trace::Signal;

    const PROGRAM: &str = "\
ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\nNETWORK 1 // Choice\nLD I0.0\nJMP 1\nNETWORK 2\n\
LD I0.1\n= Q0.0\nNETWORK 3\nLBL 1\nLD I0.2\nCALL SBR0\n\
END_ORGANIZATION_BLOCK\nSUBROUTINE_BLOCK SBR_0:SBR0\nBEGIN\nNETWORK 1\nLD I0.3\nCRET\n\
LD I0.4\n= Q0.1\nEND_SUBROUTINE_BLOCK\n";

    /// Runs a scan with these inputs (IB0) and adds it.
    fn scan(coverage: &mut Option<Coverage>, text: &str, inputs: i32) {
        let file = File { name: "p.awl".to_string(), bytes: text.as_bytes().to_vec() };
        let Opened { mut machine, networks, symbols, .. } =
            open(&file, &[]).unwrap_or_else(|error| panic!("{error}"));
        let coverage = coverage.get_or_insert_with(|| Coverage::new(networks));
        machine.note_executed();
        let signal = |name| Signal::parse(name, &symbols).unwrap();
        machine.write(signal("IB0").operand, inputs).unwrap();
        let mut trace = Trace::new(["I0.1", "Q0.0"].map(signal).to_vec(), 1);
        machine.scan(0);
        trace.record(&mut *machine).unwrap();
        coverage.add(machine.executed(), &trace);
    }

    fn left_out(coverage: &Coverage) -> Vec<String> {
        let left = coverage.left_out().map(|(network, instructions)| {
            let places: Vec<_> = instructions.iter().map(|one| one.place.as_str()).collect();
            format!("{network}: {}", places.join(" "))
        });
        left.collect()
    }

    #[test]
    fn what_no_run_executes_is_left_out() {
        let mut coverage = None;
        scan(&mut coverage, PROGRAM, 0b0001);
        let first = coverage.clone().unwrap();
        assert_eq!(
            left_out(&first),
            [
                "OB1 network 2: p.awl:7 p.awl:8",
                "SBR0 network 1: p.awl:17 p.awl:18 p.awl:19 p.awl:20"
            ]
        );
        assert_eq!((first.networks(), first.instructions()), (4, (5, 11)));
        scan(&mut coverage, PROGRAM, 0b1110);
        let both = coverage.unwrap();
        assert_eq!(left_out(&both), ["SBR0 network 1: p.awl:19 p.awl:20"]);
        assert_eq!(both.instructions(), (9, 11));
        assert_eq!(both.networks[0].to_string(), "OB1 network 1 (Choice)");
    }

    #[test]
    fn bits_with_one_value_in_all_runs() {
        let mut coverage = None;
        scan(&mut coverage, PROGRAM, 0b0010);
        let bits = |coverage: &Option<Coverage>| -> Vec<(String, bool)> {
            let bits = coverage.iter().flat_map(Coverage::constant_bits);
            bits.map(|(name, value)| (name.to_string(), value)).collect()
        };
        assert_eq!(bits(&coverage), [("I0.1".to_string(), true), ("Q0.0".to_string(), true)]);
        scan(&mut coverage, PROGRAM, 0b0011);
        assert_eq!(bits(&coverage), [("I0.1".to_string(), true)]);
    }

    #[test]
    fn a_text_without_networks_is_one() {
        let mut coverage = None;
        scan(&mut coverage, "LD I0.0\nJMP 1\nLD I0.1\n= Q0.0\nLBL 1\n", 1);
        assert_eq!(left_out(&coverage.unwrap()), ["program: p.awl:3 p.awl:4"]);
    }
}
