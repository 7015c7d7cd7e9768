//! Follows the logic stack through a rung: what each value on it is, as contacts in series and
//! parallel. Where that is no ladder, says why. No places.

use awl_asm::ast::{Constant, Instruction, Statement, Value};
use awl_asm::mnemonics::same_mnemonic;
use plc_isa::{Kind, Op, Rung as Part, STACK_LEVELS};

use super::element::{element, inline};
use super::obstacle::Obstacle;
use super::picture::{Element, Shape, Through};
use super::rungs::Rung;
use super::sheet::Sheet;

/// Most elements of a rung that is drawn: nobody reads a longer one.
const ELEMENTS_MAX: usize = 300;
/// The power rail as a point.
const RAIL: usize = 0;

/// Something in series.
#[derive(Debug, Clone)]
pub(super) enum Node {
    /// An element, by its number.
    Element(usize),
    /// Branches that come together again, none of them empty.
    Parallel(Vec<Vec<Node>>),
    /// A box with more inputs than the one in the wire: what leads to these from the rail.
    Inputs(usize, Vec<Vec<Node>>),
}

/// A wire: what is in series in it, and into what it branches at its end.
#[derive(Debug)]
pub(super) struct Run {
    pub nodes: Vec<Node>,
    pub branches: Vec<Run>,
}

/// A rung.
#[derive(Debug)]
pub(super) struct Circuit {
    pub elements: Vec<Element>,
    /// What is at the rail.
    pub runs: Vec<Run>,
}

/// A value on the logic stack: power flow behind a point, after some more in series.
#[derive(Debug, Clone, Default)]
struct Flow {
    point: usize,
    tail: Vec<Node>,
    /// Whether the tail depends on what goes into it in another way than by AND.
    is_whole: bool,
    /// Why nothing else can be drawn with it.
    taken: Option<Obstacle>,
}

/// What leads from a point to another one.
struct Branch {
    nodes: Vec<Node>,
    to: usize,
}

#[derive(Default)]
struct Draft {
    elements: Vec<Element>,
    points: Vec<Vec<Branch>>,
    /// The top is last.
    stack: Vec<Flow>,
    /// The last box with ENO: its number, the points before and after it.
    last_box: Option<(usize, usize, usize)>,
}

/// Follows a rung. The error has its line.
pub(super) fn circuit(sheet: Sheet<'_>, rung: &Rung) -> Result<Circuit, (usize, Obstacle)> {
    let mut draft = Draft { points: vec![Vec::new()], ..Draft::default() };
    let statements = sheet.assembly.program.statements.get(rung.statements.clone());
    for statement in statements.into_iter().flatten() {
        let Statement::Instruction(one) = statement else { continue };
        let line = sheet.source.position(one.span.start as usize).0;
        draft.take(sheet, one, line).map_err(|obstacle| (line, obstacle))?;
    }
    // What nothing takes is drawn, too: it may be at its beginning.
    for flow in std::mem::take(&mut draft.stack) {
        draft.anchor(flow);
    }
    let runs = draft.runs(RAIL);
    Ok(Circuit { elements: draft.elements, runs })
}

impl Draft {
    fn take(&mut self, sheet: Sheet<'_>, one: &Instruction, line: usize) -> Result<(), Obstacle> {
        if self.elements.len() >= ELEMENTS_MAX {
            return Err(Obstacle::TooLarge);
        }
        if !has_operands(one) {
            return Err(Obstacle::Operand);
        }
        if self.stack.len() < usize::from(one.entry.stack.needs) {
            return Err(Obstacle::NoValue);
        }
        match one.entry.rung {
            Part::Loads => self.load(element(sheet, one, line)),
            Part::Ands => self.extend(element(sheet, one, line)),
            Part::Ors => self.or(element(sheet, one, line)),
            Part::Combines => self.combine(sheet, one, line),
            Part::Drives | Part::Boxed => self.output(one, element(sheet, one, line)),
        }?;
        let is_deep = self.stack.len() > usize::from(STACK_LEVELS);
        if is_deep { Err(Obstacle::TooDeep) } else { Ok(()) }
    }

    fn add(&mut self, element: Element) -> Node {
        self.elements.push(element);
        Node::Element(self.elements.len() - 1)
    }

    /// The top of the stack, which goes away.
    fn pop(&mut self) -> Result<Flow, Obstacle> {
        let flow = self.stack.pop().ok_or(Obstacle::NoValue)?;
        flow.taken.clone().map_or(Ok(flow), Err)
    }

    fn load(&mut self, contact: Element) -> Result<(), Obstacle> {
        let tail = vec![self.add(contact)];
        self.stack.push(Flow { tail, ..Flow::default() });
        Ok(())
    }

    /// Adds something in series.
    fn extend(&mut self, element: Element) -> Result<(), Obstacle> {
        let mut flow = self.pop()?;
        flow.is_whole |= !matches!(element.through, Through::And | Through::All);
        let node = self.add(element);
        flow.tail.push(node);
        self.stack.push(flow);
        Ok(())
    }

    fn or(&mut self, contact: Element) -> Result<(), Obstacle> {
        let flow = self.pop()?;
        let tail = vec![self.add(contact)];
        let joined = parallel(flow, Flow { tail, ..Flow::default() })?;
        self.stack.push(joined);
        Ok(())
    }

    /// What works on the stack alone.
    fn combine(
        &mut self,
        sheet: Sheet<'_>,
        one: &Instruction,
        line: usize,
    ) -> Result<(), Obstacle> {
        if let Some(element) = inline(sheet, one, line) {
            if !self.stack.is_empty() {
                return self.extend(element);
            }
            let node = self.add(element);
            self.branch(RAIL, vec![node]);
            return Ok(());
        }
        match one.entry.op {
            Op::Ald => {
                let (top, below) = (self.pop()?, self.pop()?);
                self.stack.push(series(below, top)?);
            }
            Op::Old => {
                let (top, below) = (self.pop()?, self.pop()?);
                self.stack.push(parallel(below, top)?);
            }
            Op::Lps => self.copy(0)?,
            Op::Lrd => {
                self.drop()?;
                self.copy(0)?;
            }
            Op::Lpp => self.drop()?,
            Op::Lds => self.copy(level(one).ok_or(Obstacle::Operand)?)?,
            Op::Aeno => self.eno(line)?,
            _ => return Err(Obstacle::Stack),
        }
        Ok(())
    }

    /// Pushes a copy of a level: from there on the wire branches.
    fn copy(&mut self, level: usize) -> Result<(), Obstacle> {
        let at = self.stack.len().checked_sub(level + 1).ok_or(Obstacle::NoValue)?;
        let flow = std::mem::take(self.stack.get_mut(at).ok_or(Obstacle::NoValue)?);
        if let Some(obstacle) = flow.taken {
            return Err(obstacle);
        }
        let flow = self.anchor(flow);
        if let Some(place) = self.stack.get_mut(at) {
            *place = flow.clone();
        }
        self.stack.push(flow);
        Ok(())
    }

    /// Takes the top away; what led there and to nothing else ends in the air.
    fn drop(&mut self) -> Result<(), Obstacle> {
        let flow = self.stack.pop().ok_or(Obstacle::NoValue)?;
        self.anchor(flow);
        Ok(())
    }

    fn eno(&mut self, line: usize) -> Result<(), Obstacle> {
        let mut flow = self.pop()?;
        match self.last_box.take() {
            Some((element, before, after)) if flow.point == before && flow.tail.is_empty() => {
                flow.point = after;
                if let Some(element) = self.elements.get_mut(element) {
                    (element.eno, element.through) = (Some(line), Through::And);
                }
                self.stack.push(flow);
                Ok(())
            }
            _ => Err(Obstacle::Eno),
        }
    }

    /// A coil or box at the end of a wire, or at the rail.
    fn output(&mut self, one: &Instruction, element: Element) -> Result<(), Obstacle> {
        let is_box = element.shape == Shape::Box && one.entry.op.has_eno();
        let needs = usize::from(one.entry.stack.needs);
        let mut flows = (0..needs).map(|_| self.pop()).collect::<Result<Vec<_>, _>>()?;
        // The deepest goes into the box where its other outputs are, the others lead there alone.
        let Some(first) = flows.pop() else {
            let node = self.add(element);
            self.branch(RAIL, vec![node]);
            return Ok(());
        };
        flows.reverse();
        if flows.iter().any(|flow| flow.point != RAIL) {
            return Err(Obstacle::InputGoesOn);
        }
        if !flows.is_empty() || repeats(one) {
            self.end_others()?;
        }
        let first = self.anchor(first);
        let others: Vec<_> = flows.into_iter().map(|flow| flow.tail).collect();
        let taken = others.len();
        let mut node = self.add(element);
        if let (Node::Element(number), true) = (&node, taken > 0) {
            node = Node::Inputs(*number, others);
        }
        let after = self.branch(first.point, vec![node]);
        self.last_box = is_box.then_some((self.elements.len() - 1, first.point, after));
        if taken == 0 && !repeats(one) {
            self.stack.push(first);
            return Ok(());
        }
        let why = if taken > 0 { Obstacle::InputGoesOn } else { Obstacle::Loop };
        let none = Flow { taken: Some(why), ..Flow::default() };
        self.stack.extend(vec![none.clone(); taken + 1]);
        self.stack.fill(none);
        Ok(())
    }

    /// Draws what else is on the stack: after a box with several inputs it would cross what leads
    /// to these.
    fn end_others(&mut self) -> Result<(), Obstacle> {
        for flow in std::mem::take(&mut self.stack) {
            if flow.point != RAIL && !flow.tail.is_empty() {
                return Err(Obstacle::Stack);
            }
            let flow = self.anchor(flow);
            self.stack.push(flow);
        }
        Ok(())
    }

    /// Makes a point of a value, at which more than one thing can be.
    fn anchor(&mut self, flow: Flow) -> Flow {
        if flow.tail.is_empty() {
            return flow;
        }
        let point = self.branch(flow.point, flow.tail);
        Flow { point, ..Flow::default() }
    }

    fn branch(&mut self, from: usize, nodes: Vec<Node>) -> usize {
        let to = self.points.len();
        self.points.push(Vec::new());
        if let Some(branches) = self.points.get_mut(from) {
            branches.push(Branch { nodes, to });
        }
        to
    }

    /// What begins at a point.
    fn runs(&mut self, point: usize) -> Vec<Run> {
        let branches = self.points.get_mut(point).map(std::mem::take).unwrap_or_default();
        let run = |Branch { mut nodes, to }: Branch| {
            let mut branches = self.runs(to);
            if branches.len() == 1
                && let Some(only) = branches.pop()
            {
                nodes.extend(only.nodes);
                branches = only.branches;
            }
            Run { nodes, branches }
        };
        branches.into_iter().map(run).collect()
    }
}

/// Both in series.
fn series(below: Flow, top: Flow) -> Result<Flow, Obstacle> {
    let joined = |first: Flow, second: Flow| {
        let is_whole = first.is_whole || second.is_whole;
        let tail = first.tail.into_iter().chain(second.tail).collect();
        Ok(Flow { point: first.point, tail, is_whole, taken: None })
    };
    if top.point == RAIL && !top.is_whole {
        joined(below, top)
    } else if below.point == RAIL && !below.is_whole {
        joined(top, below)
    } else if top.point == RAIL || below.point == RAIL {
        Err(Obstacle::Part)
    } else {
        Err(Obstacle::Stack)
    }
}

/// Both in parallel.
fn parallel(below: Flow, top: Flow) -> Result<Flow, Obstacle> {
    if below.point != top.point || below.tail.is_empty() || top.tail.is_empty() {
        return Err(Obstacle::LeavesRail);
    }
    let branches = |tail: Vec<Node>| match <[Node; 1]>::try_from(tail) {
        Ok([Node::Parallel(branches)]) => branches,
        Ok([node]) => vec![vec![node]],
        Err(tail) => vec![tail],
    };
    let is_whole = below.is_whole || top.is_whole;
    let all = branches(below.tail).into_iter().chain(branches(top.tail)).collect();
    Ok(Flow { point: below.point, tail: vec![Node::Parallel(all)], is_whole, taken: None })
}

/// Whether an instruction has as many operands as it is written with, and none is wrong.
fn has_operands(one: &Instruction) -> bool {
    let is_sound = one.operands.iter().all(|operand| operand.value != Value::Invalid);
    let count = one.operands.len();
    let takes = |entry: &&plc_isa::Instruction| entry.written_roles().count() == count;
    // A routine says itself what it takes.
    is_sound && (one.entry.op == Op::Call || same_mnemonic(one.entry).iter().any(takes))
}

/// Whether what is after it is executed again, with other power flow.
fn repeats(one: &Instruction) -> bool {
    one.entry.forms.iter().any(|form| form.kinds.contains(&Kind::LoopEnd))
}

/// The level that LDS copies.
fn level(one: &Instruction) -> Option<usize> {
    match one.operands.first()?.value {
        Value::Constant(Constant { value, .. }) => usize::try_from(value).ok(),
        _ => None,
    }
}
