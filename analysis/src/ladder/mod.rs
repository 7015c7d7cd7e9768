//! Networks of an AWL program as ladders: contacts, coils and boxes in series and parallel, their
//! places on a grid, and the wires between them. Drawn for reading; there is no way back to text,
//! and no pixel is known here.
//!
//! It is here and not in the IDE because it asks what editors ask, of the same syntax tree, and
//! whatever shows programs can draw them.
//!
//! [`network_at`] and [`networks`] find the networks, `rungs` divides them, `circuit` follows the
//! logic stack through a rung, `element` says what an instruction looks like, `layout` places
//! everything. What is drawn can be evaluated: [`Picture::flows`].

mod circuit;
mod element;
mod layout;
mod obstacle;
mod picture;
mod rungs;
mod sheet;
#[cfg(test)]
mod tests;

use awl_asm::assemble::Assembly;
use diagnostics::Source;

use sheet::Sheet;

pub use obstacle::Obstacle;
pub use picture::{Element, Net, Operand, Picture, Pin, Power, Shape, Side, Through, Wire};
pub use rungs::{Network, Rung};

/// All networks of a program in their order. What is not under a NETWORK line is one network to
/// the end of its unit.
pub fn networks(source: &Source, assembly: &Assembly) -> Vec<Network> {
    rungs::networks(Sheet { source, assembly })
}

/// The network that a byte offset is in, or that is before it; of a text that begins with something
/// else the first one. `None` if there are no instructions.
pub fn network_at(source: &Source, assembly: &Assembly, offset: usize) -> Option<Network> {
    let line = source.position(offset).0;
    let mut networks = networks(source, assembly);
    let at = networks.partition_point(|network| network.lines.0 <= line).saturating_sub(1);
    (at < networks.len()).then(|| networks.swap_remove(at))
}

/// Most rungs of a network that are drawn at once.
const RUNGS_MAX: usize = 24;

/// Rungs of a network with their pictures.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// The network, with all its rungs.
    pub network: Network,
    /// Which of them is the first that is drawn, from 0.
    pub first: usize,
    /// The pictures from there on, or where and why there is none.
    pub pictures: Vec<Result<Picture, (usize, Obstacle)>>,
}

impl Drawing {
    /// The rungs that are drawn, with their pictures.
    pub fn rungs(&self) -> impl Iterator<Item = (&Rung, &Result<Picture, (usize, Obstacle)>)> {
        self.network.rungs.iter().skip(self.first).zip(&self.pictures)
    }
}

/// Draws the network at a byte offset; of one with many rungs those around it.
pub fn drawing_at(source: &Source, assembly: &Assembly, offset: usize) -> Option<Drawing> {
    let network = network_at(source, assembly, offset)?;
    let line = source.position(offset).0;
    let at = network.rungs.partition_point(|rung| rung.lines.0 <= line).saturating_sub(1);
    let first = at / RUNGS_MAX * RUNGS_MAX;
    let rungs = network.rungs.iter().skip(first).take(RUNGS_MAX);
    let pictures = rungs.map(|rung| draw(source, assembly, rung)).collect();
    Some(Drawing { network, first, pictures })
}

/// Draws a rung, or says why it is no ladder and in which line.
pub fn draw(
    source: &Source,
    assembly: &Assembly,
    rung: &Rung,
) -> Result<Picture, (usize, Obstacle)> {
    let sheet = Sheet { source, assembly };
    rungs::check(sheet, rung)?;
    circuit::circuit(sheet, rung).map(layout::layout)
}
