//! Ladders mean what the program means: with any state of the contacts, what is drawn has the power
//! flow that the interpreter's logic stack has at each output. And what is drawn can be read: no
//! two things at one place, every wire from something to something.
//!
//! `RANDOM_PROGRAMS` and `RANDOM_SEED` in the environment make the runs longer or different.

use std::collections::{BTreeMap, HashMap};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use analysis::ladder::{self, Element, Net, Obstacle, Picture, Shape, Through};
use awl_asm::assemble::{Assembly, assemble, assemble_for};
use awl_asm::ast::{Instruction, Statement, Symbol};
use awl_asm::source::Source;
use awl_asm::symbols::load;
use fastrand::Rng;
use plc_isa::{HOST, LogicStack, Op, Rung};
use plc_vm::{Environment, Inputs, Memory, Plc};
use tests::effort::effort;
use tests::mutate::mutate;
use tests::random::{Offer, random_program_of};

/// Scans with other contacts each.
const SCANS: usize = 12;
/// First V byte of the divisors, of which 0 is an error of the box.
const DIVISORS_AT: usize = 1000;

/// What was drawn of many programs.
#[derive(Default)]
struct Count {
    drawn: usize,
    obstacles: BTreeMap<String, usize>,
    compared: usize,
    flowing: usize,
}

impl Count {
    fn networks(&self) -> usize {
        self.drawn + self.obstacles.values().sum::<usize>()
    }
}

impl std::fmt::Display for Count {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Count { drawn, compared, flowing, .. } = self;
        writeln!(f, "{drawn} of {} rungs are drawn", self.networks())?;
        writeln!(f, "{compared} power flows compared, {flowing} of them 1")?;
        self.obstacles.iter().try_for_each(|(name, count)| writeln!(f, "  {name}: {count}"))
    }
}

/// A rung that is drawn, with the instructions of its lines.
struct Drawn {
    picture: Picture,
    statements: Vec<usize>,
}

fn line(source: &Source, one: &Instruction) -> usize {
    source.position(one.span.start as usize).0
}

/// Draws all rungs of a program.
fn drawn(source: &Source, assembly: &Assembly, count: &mut Count) -> Vec<Drawn> {
    let mut all = Vec::new();
    for network in ladder::networks(source, assembly) {
        for rung in network.rungs {
            match ladder::draw(source, assembly, &rung) {
                Ok(picture) => {
                    count.drawn += 1;
                    let is_in = |statement: &Statement| match statement {
                        Statement::Instruction(one) => {
                            (rung.lines.0..=rung.lines.1).contains(&line(source, one))
                        }
                        _ => false,
                    };
                    let statements = assembly.program.statements.iter().enumerate();
                    let statements = statements.filter(|(_, statement)| is_in(statement));
                    let statements = statements.map(|(index, _)| index).collect();
                    all.push(Drawn { picture, statements });
                }
                Err((at, obstacle)) => {
                    assert!((rung.lines.0..=rung.lines.1).contains(&at), "{obstacle:?} {at}");
                    *count.obstacles.entry(name(&obstacle)).or_default() += 1;
                }
            }
        }
    }
    all
}

fn name(obstacle: &Obstacle) -> String {
    match obstacle {
        Obstacle::NotUnderstood(_) => "NotUnderstood".to_owned(),
        other => format!("{other:?}"),
    }
}

/// A program with the same logic and nothing else: contacts are bits of V by their number, boxes
/// with ENO are divisions, other outputs do nothing.
struct Skeleton {
    text: String,
    /// The line of each statement in the text.
    lines: HashMap<usize, usize>,
}

impl Skeleton {
    fn of(assembly: &Assembly, drawn: &[Drawn]) -> Skeleton {
        let mut text = String::from("//# memory VB0-VB2999\n");
        let mut lines = HashMap::new();
        for (number, rung) in drawn.iter().enumerate() {
            writeln!(text, "NETWORK {}", number + 1).unwrap();
            for &index in &rung.statements {
                let Statement::Instruction(one) = &assembly.program.statements[index] else {
                    unreachable!("only instructions were taken");
                };
                lines.insert(index, text.lines().count() + 1);
                writeln!(text, "{}", bare(one, index)).unwrap();
            }
        }
        Skeleton { text, lines }
    }
}

/// The V bit that stands for a contact, and the V byte of a box's divisor, by their statements.
fn bit(index: usize) -> (usize, usize) {
    (index / 8 % 900, index % 8)
}

fn divisor(index: usize) -> usize {
    DIVISORS_AT + index % 900 * 2
}

fn bare(one: &Instruction, index: usize) -> String {
    let (byte, number) = bit(index);
    match one.entry.rung {
        Rung::Loads => format!("LD V{byte}.{number}"),
        Rung::Ands => format!("A V{byte}.{number}"),
        Rung::Ors => format!("O V{byte}.{number}"),
        Rung::Combines => match one.entry.op {
            Op::Nop => "NOP 0".to_owned(),
            Op::Lds => match one.operands[0].value {
                awl_asm::ast::Value::Constant(level) => format!("LDS {}", level.value),
                _ => unreachable!("a level"),
            },
            _ => one.mnemonic().to_owned(),
        },
        Rung::Boxed | Rung::Drives if one.entry.op.has_eno() => {
            format!("/I VW{}, VW2900", divisor(index))
        }
        Rung::Boxed | Rung::Drives => "NOP 0".to_owned(),
    }
}

/// The logic stack after each instruction, by its offset.
#[derive(Default)]
struct Stacks(HashMap<u16, LogicStack>);

impl Environment for Stacks {
    fn now_ms(&mut self) -> u32 {
        0
    }
    fn is_overdue(&mut self, _bytes: u16) -> bool {
        false
    }
    fn retrigger_watchdog(&mut self) {}
    fn executed(&mut self, at: u16, stack: LogicStack, _memory: &mut Memory) {
        self.0.insert(at, stack);
    }
}

/// Runs the skeleton of a program and compares what is drawn with it.
fn compare(text: &str, assembly: &Assembly, source: &Source, rng: &mut Rng, count: &mut Count) {
    let drawn = drawn(source, assembly, count);
    for rung in &drawn {
        check_geometry(&rung.picture, text);
    }
    // One program has room for so many edges and jumps of itself only.
    for some in drawn.chunks(20) {
        compare_some(text, assembly, source, some, rng, count);
    }
}

#[expect(
    clippy::too_many_lines,
    reason = "one run of a program, scan by scan, and what is drawn beside it"
)]
fn compare_some(
    text: &str,
    assembly: &Assembly,
    source: &Source,
    drawn: &[Drawn],
    rng: &mut Rng,
    count: &mut Count,
) {
    let skeleton = Skeleton::of(assembly, drawn);
    let own = Source::new("skeleton", skeleton.text.clone()).unwrap();
    let built = assemble_for(&own, Vec::new(), &[], &HOST);
    let image = built.image.as_ref().unwrap_or_else(|| {
        panic!("{:?}\n{}\n{text}", built.diagnostics, skeleton.text);
    });
    // Offsets by lines of the skeleton.
    let offset = |code: usize| {
        let line = built.lines[code];
        (line.at + u32::from(line.hidden_len)) as u16
    };
    let offsets: HashMap<usize, u16> = built
        .code
        .iter()
        .enumerate()
        .map(|(code, selected)| (own.position(built.span_of(selected).start as usize).0, code))
        .map(|(line, code)| (line, offset(code)))
        .collect();
    let (mut plc, mut memory) = (Plc::new(), Memory::new());
    plc.load(&mut memory, image.as_slice()).unwrap();
    plc.run();
    let mut edges: HashMap<usize, bool> = HashMap::new();
    for scan in 0..SCANS {
        let v: Vec<u8> = (0..3000).map(|_| rng.u8(..)).collect();
        for (byte, value) in v.iter().enumerate() {
            // A divisor is 0 or 1.
            let value = match byte {
                DIVISORS_AT..2900 if byte % 2 == 0 => 0,
                DIVISORS_AT..2900 => value & 1,
                2900..2902 => 0,
                _ => *value,
            };
            let plan = plc.program().unwrap().plan();
            memory.set_byte(plan.v_address(byte as u16).unwrap(), value);
        }
        let mut stacks = Stacks::default();
        plc.scan(&mut memory, &Inputs::default(), &mut stacks);
        assert_eq!(plc.mode(), plc_vm::Mode::Run, "{}", skeleton.text);
        for rung in drawn {
            let by_line: HashMap<usize, (usize, &Instruction)> = rung
                .statements
                .iter()
                .map(|&index| match &assembly.program.statements[index] {
                    Statement::Instruction(one) => (line(source, one), (index, one)),
                    _ => unreachable!("only instructions were taken"),
                })
                .collect();
            let flows = rung.picture.flows(Some(true), |number, input| {
                let element = &rung.picture.elements[number];
                let (index, one) = by_line[&element.line];
                let input = input.expect("all is known");
                Some(match (element.through, element.shape) {
                    (Through::And, Shape::Contact) => {
                        let (byte, bit) = bit(index);
                        input && v[byte] >> bit & 1 != 0
                    }
                    (Through::And, _) => input && v[divisor(index) + 1] & 1 != 0,
                    (Through::Inverted, _) => !input,
                    (Through::All, _) => input,
                    (Through::Edge, _) => {
                        let before = edges.insert(index, input);
                        let wanted = one.entry.op == Op::Eu;
                        before.is_some_and(|before| before != input && input == wanted)
                    }
                    (Through::Ends, _) => unreachable!("nothing is behind it"),
                })
            });
            let stack_at = |line: usize| {
                let (index, _) = by_line[&line];
                stacks.0[&offsets[&skeleton.lines[&index]]]
            };
            let mut agree = |line: usize, net: usize, level: u8| {
                let (flow, stack) = (flows[net].unwrap(), stack_at(line));
                count.compared += 1;
                count.flowing += usize::from(flow);
                let text = source.line_text(line);
                assert_eq!(
                    flow,
                    stack.level(level),
                    "scan {scan}, line {line}: {text}\n{:#?}\n{}",
                    rung.picture,
                    skeleton.text
                );
            };
            for element in &rung.picture.elements {
                let (_, one) = by_line[&element.line];
                let is_output = !one.entry.rung.is_contact();
                if is_output && one.entry.stack.needs > 0 {
                    let needs = one.entry.stack.needs;
                    assert_eq!(element.powers.len(), usize::from(needs), "{}", element.symbol);
                    for (power, level) in element.powers.iter().zip((0..needs).rev()) {
                        agree(element.line, power.net, level);
                    }
                }
                // What the page colours by the power flow of a line.
                if let (Some(net), Through::Inverted | Through::Edge) =
                    (element.output, element.through)
                {
                    agree(element.line, net, 0);
                }
                if let (Some(net), Some(line)) = (element.output, element.eno) {
                    agree(line, net, 0);
                }
            }
        }
    }
}

/// Whether what is drawn can be read.
fn check_geometry(picture: &Picture, text: &str) {
    let mut cells: HashMap<(usize, usize), usize> = HashMap::new();
    for (number, element) in picture.elements.iter().enumerate() {
        for column in element.column..element.column + element.columns {
            for row in element.row..element.row + element.rows {
                assert!(column < picture.columns && row < picture.rows, "outside\n{text}");
                let other = cells.insert((column, row), number);
                assert_eq!(other, None, "two elements at {column}, {row}\n{text}");
            }
        }
    }
    // Which net is where: on the left edge of a column in the middle of a row.
    let mut points: HashMap<(usize, usize), Vec<usize>> = HashMap::new();
    let mut add = |column: usize, row: usize, net: usize| {
        points.entry((column, row)).or_default().push(net);
    };
    for element in &picture.elements {
        for power in &element.powers {
            add(element.column, element.row + power.row, power.net);
        }
        if let Some(net) = element.output {
            add(element.column + element.columns, element.row, net);
        }
    }
    for wire in &picture.wires {
        let ((column, row), (to, below)) = (wire.from, wire.to);
        assert!(column == to && row < below || row == below && column < to, "{wire:?}\n{text}");
        for column in column..=to {
            for row in row..=below {
                add(column, row, wire.net);
            }
        }
        for column in column..to {
            let there = cells.get(&(column, row));
            assert_eq!(there, None, "a wire through an element: {wire:?}\n{text}");
        }
        // A vertical wire runs between columns: no element may be on both sides of it.
        for row in row..=below {
            let inside = |element: &&Element| {
                (element.row..element.row + element.rows).contains(&row)
                    && element.column < column
                    && column < element.column + element.columns
            };
            assert!(to > column || !picture.elements.iter().any(|one| inside(&one)), "{text}");
        }
    }
    // Nets meet where they come together, and nowhere else.
    for (at, nets) in points {
        let is_one = nets.iter().any(|&last| nets.iter().all(|&net| joins(picture, last, net)));
        let is_at_rail = at.0 == 0 && nets.contains(&0);
        assert!(is_one || is_at_rail, "{at:?}: {nets:?}\n{picture:#?}\n{text}");
    }
}

/// Whether a net is the other one, or one that comes together in it.
fn joins(picture: &Picture, last: usize, net: usize) -> bool {
    last == net
        || match &picture.nets[last] {
            Net::Join(all) => all.iter().any(|&one| joins(picture, one, net)),
            _ => false,
        }
}

/// Whether a file is a program by itself: `telegram.line.awl` is a part of `telegram.st`, and
/// `motor_speed.counter.awl` one of `motor_speed.fbd`.
fn is_whole(path: &Path) -> bool {
    let is_part = |language| path.with_extension("").with_extension(language).is_file();
    !["st", "fbd"].into_iter().any(is_part) || path.with_extension("scn").is_file()
}

fn program_files(folder: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut open = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)];
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|ending| ending == "awl") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

fn source(path: &Path) -> Source {
    Source::from_bytes(path.to_string_lossy(), &fs::read(path).unwrap()).unwrap()
}

/// The symbols of the table beside a program.
fn tables(path: &Path) -> Vec<Symbol> {
    let tables = ["csv", "txt"].map(|ending| path.with_extension(ending));
    let tables = tables.iter().filter(|table| table.exists());
    tables.flat_map(|table| load(&source(table)).0).collect()
}

#[test]
fn examples_exports_and_cases_are_drawn_as_they_are_executed() {
    let mut rng = Rng::with_seed(1);
    for (folder, least) in [("../examples", 100), ("exports", 99), ("cases", 90)] {
        let mut count = Count::default();
        for path in program_files(folder).into_iter().filter(|path| is_whole(path)) {
            let source = source(&path);
            let assembly = assemble(&source, tables(&path));
            compare(&source.text, &assembly, &source, &mut rng, &mut count);
        }
        println!("{folder}: {count}");
        assert!(count.drawn * 100 >= count.networks() * least, "{folder}: {count}");
    }
}

#[test]
fn random_programs_are_drawn_as_they_are_executed() {
    let (first, programs) = (effort("RANDOM_SEED", 1), effort("RANDOM_PROGRAMS", 1_000));
    for (name, offer) in
        [("core", (|_| Offer::core()) as fn(&mut Rng) -> Offer), ("everything", Offer::everything)]
    {
        let mut count = Count::default();
        for seed in first..first + programs {
            let mut rng = Rng::with_seed(seed);
            let (size, offer) = (rng.usize(5..220), offer(&mut rng));
            let text = random_program_of(&mut rng, size, offer);
            let source = Source::new(format!("seed {seed}"), text.as_str()).unwrap();
            let assembly = assemble(&source, Vec::new());
            compare(&text, &assembly, &source, &mut rng, &mut count);
        }
        println!("{name}: {count}");
        assert!(count.drawn * 2 > count.networks(), "{name}: {count}");
        assert!(count.flowing * 20 > count.compared, "{name}: {count}");
    }
}

#[test]
fn broken_texts_are_drawn_or_refused() {
    let (seed, texts) = (effort("RANDOM_SEED", 1), effort("RANDOM_TEXTS", 5_000));
    let mut rng = Rng::with_seed(seed);
    let programs: Vec<Source> = ["../examples", "exports", "cases", "messages"]
        .iter()
        .flat_map(|folder| program_files(folder))
        .map(|path| source(&path))
        .collect();
    let mut count = Count::default();
    for _ in 0..texts {
        let text = &programs[rng.usize(..programs.len())].text;
        let Ok(source) = Source::from_bytes("broken", &mutate(&mut rng, text)) else { continue };
        let assembly = assemble(&source, Vec::new());
        for rung in drawn(&source, &assembly, &mut count) {
            check_geometry(&rung.picture, &source.text);
        }
        ladder::network_at(&source, &assembly, rng.usize(..=source.text.len()));
    }
    println!("broken: {count}");
    assert!(count.obstacles.contains_key("NotUnderstood"), "{count}");
}
