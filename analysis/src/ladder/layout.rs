//! Where everything is on the grid, and the wires between. What comes of power flow is not known
//! here, but which wires belong together.

use super::circuit::{Circuit, Node, Run};
use super::picture::{Element, Net, Picture, Pin, Shape, Side, Through, Wire};

/// The net of the power rail.
const RAIL: usize = 0;
/// Operands beside a box that are in the row of its power flow, and in each further row.
const PINS_FIRST: usize = 1;
const PINS_PER_ROW: usize = 4;

/// Gives a circuit its places.
pub(super) fn layout(circuit: Circuit) -> Picture {
    let picture =
        Picture { elements: circuit.elements, nets: vec![Net::Rail], ..Picture::default() };
    let mut layout = Layout { picture, bottom: 0, ends: Vec::new() };
    for run in &circuit.runs {
        layout.run(run, 0, layout.bottom, RAIL);
    }
    layout.align();
    layout.picture.rows = layout.bottom;
    layout.picture
}

struct Layout {
    picture: Picture,
    /// The first row in which nothing is.
    bottom: usize,
    /// The coils, which are all at the right.
    ends: Vec<usize>,
}

/// Where a chain ends: column, net, and the first row below it.
type End = (usize, usize, usize);

impl Layout {
    fn net(&mut self, net: Net) -> usize {
        self.picture.nets.push(net);
        self.picture.nets.len() - 1
    }

    fn wire(&mut self, net: usize, from: (usize, usize), to: (usize, usize)) {
        if from != to {
            self.picture.wires.push(Wire { net, from, to });
        }
    }

    fn run(&mut self, run: &Run, column: usize, row: usize, net: usize) {
        let (column, net, below) = self.chain(&run.nodes, column, row, net);
        self.bottom = self.bottom.max(below);
        let mut last = row;
        for (number, branch) in run.branches.iter().enumerate() {
            last = if number == 0 { row } else { self.bottom };
            self.run(branch, column, last, net);
        }
        self.wire(net, (column, row), (column, last));
    }

    /// Elements in series.
    fn chain(&mut self, nodes: &[Node], column: usize, row: usize, net: usize) -> End {
        let mut end = (column, net, row + 1);
        for node in nodes {
            let (column, net, below) = end;
            let (to, net, new_below) = match node {
                Node::Element(number) => self.element(*number, column, row, net),
                Node::Parallel(branches) => self.parallel(branches, column, row, net),
                Node::Inputs(number, others) => {
                    self.bottom = self.bottom.max(below);
                    self.inputs(*number, others, (column, row), net)
                }
            };
            end = (to, net, below.max(new_below));
        }
        end
    }

    fn element(&mut self, number: usize, column: usize, row: usize, net: usize) -> End {
        self.place(number, column, row, vec![(0, net)])
    }

    /// Places an element; `powers` are the rows of its inputs, from its own on, and their nets.
    fn place(
        &mut self,
        number: usize,
        column: usize,
        row: usize,
        powers: Vec<(usize, usize)>,
    ) -> End {
        let net = powers.first().map_or(RAIL, |&(_, net)| net);
        let after = self.picture.nets.len();
        let Some(element) = self.picture.elements.get_mut(number) else {
            return (column, net, row + 1);
        };
        (element.column, element.row) = (column, row);
        let last = powers.last().map_or(0, |&(row, _)| row);
        (element.columns, element.rows) = size(element, last);
        for (power, (row, net)) in element.powers.iter_mut().zip(powers) {
            (power.row, power.net) = (row, net);
        }
        let end = (column + element.columns, net, row + element.rows);
        self.picture.columns = self.picture.columns.max(end.0);
        if element.shape == Shape::Coil {
            self.ends.push(number);
        }
        if element.through == Through::Ends {
            return end;
        }
        element.output = Some(after);
        let net = self.net(Net::After { element: number, input: net });
        (end.0, net, end.2)
    }

    fn parallel(&mut self, branches: &[Vec<Node>], column: usize, row: usize, net: usize) -> End {
        let mut ends = Vec::new();
        let (mut to, mut below, mut last) = (column, row, row);
        for branch in branches {
            last = below;
            let end = self.chain(branch, column, last, net);
            (to, below) = (to.max(end.0), end.2);
            ends.push((end.0, end.1, last));
        }
        for &(end, net, row) in &ends {
            self.wire(net, (end, row), (to, row));
        }
        self.wire(net, (column, row), (column, last));
        let joined = self.net(Net::Join(ends.iter().map(|&(_, net, _)| net).collect()));
        self.wire(joined, (to, row), (to, last));
        (to, joined, below)
    }

    /// A box with several inputs: what leads to the others is below, from the rail on.
    fn inputs(
        &mut self,
        number: usize,
        others: &[Vec<Node>],
        (column, row): (usize, usize),
        net: usize,
    ) -> End {
        let mut ends = vec![(column, net, row)];
        for other in others {
            let row = self.bottom;
            let (column, net, below) = self.chain(other, 0, row, RAIL);
            self.bottom = self.bottom.max(below);
            ends.push((column, net, row));
        }
        let to = ends.iter().map(|end| end.0).max().unwrap_or(column);
        for &(end, net, row) in &ends {
            self.wire(net, (end, row), (to, row));
        }
        let powers = ends.iter().map(|&(_, net, at)| (at - row, net)).collect();
        self.place(number, to, row, powers)
    }

    /// Moves the coils to the right.
    fn align(&mut self) {
        let last = self.picture.columns.saturating_sub(1);
        for number in std::mem::take(&mut self.ends) {
            let Some(element) = self.picture.elements.get_mut(number) else { continue };
            let (column, row) = (element.column, element.row);
            element.column = last;
            let net = element.powers.first().map_or(RAIL, |power| power.net);
            self.wire(net, (column, row), (last, row));
        }
    }
}

/// Columns and rows of an element whose last input is in this row of it. A box has a column on each
/// side for what is beside it.
fn size(element: &Element, last: usize) -> (usize, usize) {
    if element.shape != Shape::Box {
        return (1, 1);
    }
    let beside = |side: Side| element.pins.iter().filter(|pin: &&Pin| pin.side == side).count();
    let rows = |pins: usize| 1 + pins.saturating_sub(PINS_FIRST).div_ceil(PINS_PER_ROW);
    let (left, right) = (beside(Side::Left), beside(Side::Right));
    let columns = if right > 0 { 3 } else { 2 };
    (columns, (last + rows(left)).max(rows(right)))
}
