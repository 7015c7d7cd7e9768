//! What the serial line costs the scans of the shipped firmware on a simulated Uno: an idle line, a
//! master that always asks, and each function at its largest. What requests mean is not looked at.
#![cfg(feature = "uno")]

use std::collections::BTreeMap;

use awl_asm::disassemble::instructions;
use plc_isa::{DATA_END, Op, Program, verify};
use tests::bench_board::{BenchBoard, MS, example, example_text, firmware, image};
use tests::link::{Command, UNIT, checksum, frame, identify, run};
use tests::measure::{Executable, Tier, scans};

/// Cycles in a microsecond.
const US: u64 = MS / 1_000;
/// How much an idle line may cost a scan.
const IDLE_MAX: u64 = 100 * US;
/// How much longer a request may make a scan.
const LONGER_MAX: u64 = 150 * US;

/// An upper bound: all that a scan does beside the program, such as reading inputs, and looking
/// whether there is a request and something is forced.
#[test]
fn an_idle_line_costs_little() {
    for tier in [Tier::Interpreter, Tier::Native { pins: true }] {
        let figures = scans::measure(Executable::new("station1", &example_text("station1"), tier));
        let (usual, mean) = figures.overhead();
        println!(
            "{tier}: a scan takes {usual} cycles beside the program, {mean} on average; an idle \
                line is a part"
        );
        assert!(usual <= IDLE_MAX && mean <= IDLE_MAX);
    }
}

/// Cycles of the program's scan with a line that is idle, that is used all the time, and the
/// longest scans of both; and the scans in a second.
#[test]
fn answers_cost_little() {
    let mut board = BenchBoard::new();
    board.insert(&example("station1"));
    board.power_up();
    board.scans_for(200);
    let quiet = board.scans_for(1_000);
    let longest_quiet = quiet.iter().map(|scan| scan.cycles()).max().unwrap_or(0);
    let watch: Vec<u8> = [67, 20]
        .into_iter()
        .chain((0..20).flat_map(|bit| [0x30 | (bit % 8), 0, bit / 8]))
        .collect();
    let requests: [(&[u8], usize); 5] =
        [(&watch, 26), (&[1, 0, 0, 0, 8], 6), (&[3, 0, 0, 0, 1], 5), (&[65], 43), (&[68, 0], 5)];
    let (mut longest, mut longest_of, mut scans, start) = (0, [0; 5], 0, board.avr.cycles());
    for round in 0..60 {
        let (request, answer_len) = requests[round % requests.len()];
        let asked = board.avr.cycles();
        board.say(&frame(UNIT, request));
        let mut heard: Vec<u8> = Vec::new();
        while heard.len() < answer_len {
            let cycles = board.scan().cycles();
            longest = longest.max(cycles);
            longest_of[round % 5] = cycles.max(longest_of[round % 5]);
            scans += 1;
            heard.extend(board.avr.uart_take());
            assert!(
                board.avr.cycles() - asked < 100 * MS,
                "round {round}: {heard:02X?}, state {}",
                board.runs()
            );
        }
        assert_eq!((heard.len(), checksum(&heard)), (answer_len, 0), "{heard:02X?}");
        if round == 0 {
            println!(
                "20 operands watched in {:.1} ms",
                (board.avr.cycles() - asked) as f64 / MS as f64
            );
            assert!(board.avr.cycles() - asked < 50 * MS);
        }
    }
    let rate = f64::from(scans) / (board.avr.cycles() - start) as f64 * (1_000 * MS) as f64;
    let share = 1.0 - rate / quiet.len() as f64;
    println!(
        "scans a second: {} quiet, {rate:.0} with a master that always asks: {:.1} % less",
        quiet.len(),
        share * 100.0
    );
    println!(
        "longest scan: {longest_quiet} cycles quiet, {longest} with a master, {longest_of:?} by \
            request"
    );
    assert!(share <= 0.15);
    assert!(longest <= longest_quiet + LONGER_MAX, "{} cycles longer", longest - longest_quiet);
}

/// A program, and where in its memory much can be asked for at once.
struct Subject {
    name: &'static str,
    image: Vec<u8>,
    /// First byte and bytes of a range of V memory.
    v: (u16, u16),
    /// First number, and how many follow each other.
    timers: (u16, u16),
    counters: (u16, u16),
}

/// Programs of which the one has hardly anything, and another so much that what is asked for is far
/// from the beginning of every table.
fn subjects() -> [Subject; 3] {
    let timers = |numbers: std::ops::Range<u16>| {
        numbers.map(|n| format!("LD SM0.0\nTON T{n}, 9\n")).collect()
    };
    let counters = |numbers: std::ops::Range<u16>| {
        numbers.map(|n| format!("LD SM0.0\nLD SM0.0\nCTU C{n}, 9\n")).collect()
    };
    // What is there shall cost no time of its own.
    let program = |parts: &[String]| {
        let executed = "LD I0.0\n= Q0.0\n".repeat(12);
        image(&format!("{executed}LD SM0.0\nJMP 1\n{}LBL 1\n", parts.concat()))
    };
    let scattered: String = (0..60).map(|n| format!("LD SM0.0\nMOVW 0, VW{}\n", 50 * n)).collect();
    let range = |first, end| format!("LD SM0.0\nMOVB 0, VB{first}\n//# memory VB{first}-VB{end}\n");
    [
        Subject {
            name: "station1",
            image: example("station1"),
            v: (0, 0),
            timers: (101, 3),
            counters: (1, 2),
        },
        Subject {
            name: "small",
            image: program(&[range(0, 249), timers(101..133), counters(0..32)]),
            v: (0, 250),
            timers: (101, 32),
            counters: (0, 32),
        },
        Subject {
            name: "crowded",
            image: program(&[range(5_000, 5_039), scattered, timers(156..256), counters(241..256)]),
            v: (5_000, 40),
            timers: (224, 32),
            counters: (241, 15),
        },
    ]
}

/// A request, and what must be asked for before it.
#[derive(Clone)]
struct Request {
    name: &'static str,
    before: Vec<Vec<u8>>,
    pdu: Vec<u8>,
}

/// A request before which nothing must be asked for.
fn request(name: &'static str, pdu: Vec<u8>) -> Request {
    Request { name, before: Vec::new(), pdu }
}

fn word(value: u16) -> [u8; 2] {
    value.to_be_bytes()
}

/// References of service functions: area times 16 and size, number.
fn reference(kind: u8, number: u16) -> Vec<u8> {
    [&[kind][..], &word(number)].concat()
}

const BIT_OF_M: u8 = 0x27;
const DOUBLE_OF_M: u8 = 0x2A;
const DOUBLE_OF_V: u8 = 0x8A;
const VALUE_OF_T: u8 = 0x59;
const VALUE_OF_C: u8 = 0x69;

/// The most of each function that legal requests can ask for, with room for so many bytes. What a
/// program does not have is left out.
fn requests(subject: &Subject, room: u16) -> Vec<Request> {
    [bits(room), registers(subject, room), watch(subject, room), forces(), others(subject, room)]
        .concat()
}

fn bits(room: u16) -> Vec<Request> {
    let read = |function: u8, first, most: u16| {
        [&[function][..], &word(first), &word(most.min(8 * (room - 2)))].concat()
    };
    let write_many = |first, most: u16| {
        let (count, len) = (most.min(8 * (room - 6)), most.min(8 * (room - 6)).div_ceil(8));
        [&[15][..], &word(first), &word(count), &[len as u8], &vec![0; usize::from(len)]].concat()
    };
    vec![
        request("1 Q", read(1, 0, 128)),
        request("1 M", read(1, 1_000, 256)),
        request("1 M0.3 on", read(1, 1_003, 253)),
        request("2 I", read(2, 0, 128)),
        request("2 T3 on", read(2, 4_003, 253)),
        request("5 M", vec![5, 0x04, 0xE7, 0xFF, 0]),
        request("15 M", write_many(1_000, 256)),
        request("15 M0.3 on", write_many(1_003, 253)),
    ]
}

fn registers(subject: &Subject, room: u16) -> Vec<Request> {
    let areas = [
        (subject.v.0 / 2, subject.v.1 / 2, ["3 V", "6 V", "16 V", "23 V"]),
        (6_000 + subject.timers.0, subject.timers.1, ["3 T", "6 T", "16 T", "23 T"]),
        (7_000 + subject.counters.0, subject.counters.1, ["3 C", "6 C", "16 C", "23 C"]),
        (8_000, 8, ["3 AC", "6 AC", "16 AC", "23 AC"]),
    ];
    let mut requests = vec![
        request("3 AC to AQW", vec![3, 0x1F, 0x40, 0, 14]),
        request("4 AIW", vec![4, 0, 0, 0, 32]),
    ];
    for (first, most, [read, write_one, write_many, both]) in
        areas.into_iter().filter(|(_, most, _)| *most > 0)
    {
        let count = |limit: u16, others: u16| most.min(limit).min((room - others) / 2);
        let values = |count: u16| {
            [&word(count)[..], &[2 * count as u8], &vec![1; usize::from(2 * count)]].concat()
        };
        let read_request =
            |function: u8| [&[function][..], &word(first), &word(count(125, 2))].concat();
        requests.push(request(read, read_request(3)));
        requests.push(request(write_one, [&[6][..], &word(first + most - 1), &[0, 1]].concat()));
        requests
            .push(request(write_many, [&[16][..], &word(first), &values(count(123, 6))].concat()));
        requests.push(request(
            both,
            [&read_request(23)[..], &word(first), &values(count(121, 10))].concat(),
        ));
    }
    requests
}

/// References to as many operands of a kind as there may be, again and again if there are fewer.
fn references(kind: u8, (first, count): (u16, u16), most: u16) -> Option<Vec<Vec<u8>>> {
    (count > 0)
        .then(|| (0..most).map(|n| reference(kind, first + (count - 1 - n % count))).collect())
}

/// Where the last double words of a range begin.
fn doubles((first, len): (u16, u16)) -> (u16, u16) {
    (first, len.saturating_sub(3))
}

fn watch(subject: &Subject, room: u16) -> Vec<Request> {
    let most = |width: u16| 32.min((room - 2) / 3).min((room - 3) / width);
    let watched =
        |references: Vec<Vec<u8>>| [vec![67, references.len() as u8], references.concat()].concat();
    let set = |width: usize, mut references: Vec<Vec<u8>>| {
        references.iter_mut().for_each(|reference| reference.extend(vec![0; width]));
        [vec![72, references.len() as u8], references.concat()].concat()
    };
    let kinds = [
        ("67 M bits", "72 M bits", BIT_OF_M, 1, (16, 16)),
        ("67 MD", "72 MD", DOUBLE_OF_M, 4, (16, 13)),
        ("67 VD", "72 VD", DOUBLE_OF_V, 4, doubles(subject.v)),
        ("67 T", "72 T", VALUE_OF_T, 2, subject.timers),
        ("67 C", "72 C", VALUE_OF_C, 2, subject.counters),
    ];
    let mut requests = Vec::new();
    for (watch_name, set_name, kind, width, place) in kinds {
        let watch = references(kind, place, most(width)).map(watched);
        let most_set = 16.min((room - 2) / (3 + width));
        let set =
            references(kind, place, most_set).map(|references| set(usize::from(width), references));
        requests.extend(watch.map(|pdu| request(watch_name, pdu)));
        requests.extend(set.map(|pdu| request(set_name, pdu)));
    }
    requests
}

fn forces() -> Vec<Request> {
    let force =
        |number: u16| [&[68, 1][..], &reference(DOUBLE_OF_M, 12 + number), &[0; 4]].concat();
    let all_but = |missing: u16| (0..16 - missing).map(force).collect::<Vec<_>>();
    vec![
        Request { before: all_but(0), ..request("68 list", vec![68, 0]) },
        Request { before: all_but(1), ..request("68 force", force(15)) },
        Request {
            before: all_but(0),
            ..request("68 end one", [&[68, 2][..], &reference(DOUBLE_OF_M, 12), &[0; 4]].concat())
        },
        Request { before: all_but(0), ..request("68 end all", vec![68, 3]) },
    ]
}

fn others(subject: &Subject, room: u16) -> Vec<Request> {
    let program = verify(subject.image.as_slice()).expect("the assembler's images are good");
    let command = |command: Command| command.pdu().to_vec();
    let mut requests = vec![
        request("43", vec![43, 14, 2, 0]),
        request("65", vec![65]),
        request("66 forget", command(Command::ClearFault)),
        request("66 RUN", command(Command::Run)),
        request("66 STOP", command(Command::Stop)),
        request("69", status(&program, room, 0)),
        request("70 state", vec![70, 0]),
        request("71", vec![71, 0, 0, 0, 64]),
    ];
    // After the frame there must be memory for it.
    if program.plan().end() + program.plan().retained_len() + room + 200 < DATA_END {
        requests.push(request("70 start", trace(DOUBLE_OF_M, 16)));
    }
    requests
}

/// A window of as many instructions as there may be, from one on.
fn status(program: &Program<&[u8]>, room: u16, first: usize) -> Vec<u8> {
    let lines =
        instructions(program).into_iter().skip(first).take(usize::from((room - 5) / 10).min(24));
    let entries: Vec<Vec<u8>> =
        lines.map(|line| [&word(line.at)[..], &reference(DOUBLE_OF_M, 16)].concat()).collect();
    [vec![69, entries.len() as u8], entries.concat()].concat()
}

/// A trace of as many operands as there may be, with a trigger that does not come.
fn trace(kind: u8, number: u16) -> Vec<u8> {
    let values = reference(kind, number).repeat(8);
    [&[70, 1, 0, 1, 0, 0, 1][..], &reference(BIT_OF_M, 31), &[8], &values].concat()
}

/// Networks of short instructions: the more of them lie between two looks for a window, the more
/// steps lead to it.
const SHORT_NETWORKS: [&str; 4] = [
    "LD I0.0\n= Q0.0\n",
    "LD I0.0\nO I0.1\nLD I0.2\nON I0.3\nALD\n= Q0.0\n",
    "LD I0.0\nLPS\nA I0.1\n= Q0.0\nLRD\nA I0.2\n= Q0.1\nLPP\nA I0.3\n= Q0.2\n",
    "LD I0.0\nA I0.1\nLD I0.2\nA I0.3\nOLD\nNOT\n= Q0.0\n",
];

/// A board whose clock stands still: then quiet scans are alike, and what a request adds to one is
/// seen whenever it comes. What the millisecond has a scan do comes on top of both.
struct Bench {
    board: BenchBoard,
}

impl Bench {
    fn new(image: &[u8]) -> Bench {
        let mut board = BenchBoard::new();
        board.insert(image);
        board.power_up();
        board.scans_for(200);
        board.stop_clock();
        Bench { board }
    }

    /// The cycles of the next scan.
    fn scan(&mut self) -> u64 {
        self.board.avr.feed_watchdog();
        self.board.scan().cycles()
    }

    /// Sends a request and runs until its answer is over. Returns that, and the longest scan
    /// meanwhile.
    fn ask(&mut self, pdu: &[u8]) -> (Vec<u8>, u64) {
        let _ = self.board.avr.uart_take();
        self.board.say(&frame(UNIT, pdu));
        let (mut heard, mut longest) = (Vec::new(), 0);
        let mut end = self.board.avr.cycles() + 500 * MS;
        while self.board.avr.cycles() < end {
            longest = longest.max(self.scan());
            let bytes = self.board.avr.uart_take();
            if !bytes.is_empty() {
                heard.extend(bytes);
                end = self.board.avr.cycles() + 4 * MS;
            }
        }
        assert!(heard.len() >= 5 && checksum(&heard) == 0, "{pdu:02X?}: {heard:02X?}");
        (heard[1..heard.len() - 2].to_vec(), longest)
    }

    fn line_state(&self) -> u8 {
        let rtu = firmware().elf.data_symbol("RTU").expect("the firmware has a line");
        self.board.avr.data()[usize::from(rtu)]
    }

    /// How many cycles longer than a quiet scan the longest is while an answer is made. What
    /// characters take that come and go is left out: of long scans it is more, the longer they are.
    fn work(&mut self, pdu: &[u8]) -> u64 {
        let quiet = (0..3).map(|_| self.scan()).max().unwrap_or(0);
        self.board.say(&frame(UNIT, pdu));
        while self.line_state() < RECEIVING {
            self.scan();
        }
        while self.line_state() == RECEIVING {
            self.scan();
        }
        let mut longest = 0;
        while self.line_state() < ANSWERING {
            longest = longest.max(self.scan());
        }
        while self.line_state() >= ANSWERING {
            self.scan();
        }
        let heard = self.board.avr.uart_take();
        assert_eq!(heard.get(1), pdu.first(), "{pdu:02X?}: {heard:02X?}");
        longest.saturating_sub(quiet)
    }

    /// How many cycles longer than a quiet scan the longest is with this request, at several
    /// moments of a scan.
    fn cost(&mut self, request: &Request) -> u64 {
        let mut most = 0;
        for round in 0..ROUNDS {
            self.ask(&[68, 3]);
            for pdu in &request.before {
                self.ask(pdu);
            }
            let quiet = (0..20).map(|_| self.scan()).max().unwrap_or(0);
            self.board.run_on(quiet * round / ROUNDS);
            let (answer, longest) = self.ask(&request.pdu);
            assert!(
                answer[0] == request.pdu[0],
                "{} {:02X?}: {answer:02X?}",
                request.name,
                request.pdu
            );
            most = most.max(longest.saturating_sub(quiet));
            if !self.board.runs() {
                run(&mut self.board);
                (0..20).for_each(|_| _ = self.scan());
            }
            assert!(self.board.runs(), "{}: {:?}", request.name, self.board.fault());
        }
        most
    }
}

/// States of the line: a request comes in, and from here on an answer goes out.
const RECEIVING: u8 = 2;
const ANSWERING: u8 = 12;

/// How often each request is asked.
const ROUNDS: u64 = 16;

#[test]
fn no_function_makes_a_scan_much_longer() {
    let subjects = subjects();
    let mut table: BTreeMap<(u8, &str), [Option<u64>; 3]> = BTreeMap::new();
    for (column, subject) in subjects.iter().enumerate() {
        let mut bench = Bench::new(&subject.image);
        let room = identify(&mut bench.board).room;
        println!("{}: room for {room} bytes", subject.name);
        for request in requests(subject, room) {
            table.entry((request.pdu[0], request.name)).or_default()[column] =
                Some(bench.cost(&request));
        }
    }
    println!("microseconds by which the longest scan is longer");
    println!("{:<12}{:>9}{:>9}{:>9}", "", subjects[0].name, subjects[1].name, subjects[2].name);
    for ((_, name), columns) in &table {
        let us = |cycles: Option<u64>| {
            cycles.map_or("-".to_string(), |cycles| format!("{:.1}", cycles as f64 / US as f64))
        };
        println!("{name:<12}{:>9}{:>9}{:>9}", us(columns[0]), us(columns[1]), us(columns[2]));
    }
    let longest = table
        .iter()
        .filter_map(|((_, name), columns)| Some((*name, columns.iter().flatten().max()?)));
    let too_long: Vec<_> = longest.filter(|&(_, &cycles)| cycles > LONGER_MAX).collect();
    assert!(too_long.is_empty(), "cycles by which scans are longer: {too_long:?}");
}

/// The hardest are those before which the board has looked for one long ago, in instructions.
#[test]
fn a_window_makes_a_scan_no_longer_wherever_it_is() {
    for network in SHORT_NETWORKS {
        // All but some hundred bytes of the slot.
        let image = image(&network.repeat(3_300 / network.lines().count()));
        let program = verify(image.as_slice()).expect("the assembler's images are good");
        let looks = program
            .instructions()
            .filter(|(_, decoded)| decoded.op == Op::Approach)
            .map(|(at, _)| at);
        let looks: Vec<u16> = looks.collect();
        let lines = instructions(&program);
        let before = |look: u16| lines.partition_point(|line| line.at < look) - 1;
        let mut bench = Bench::new(&image);
        let room = identify(&mut bench.board).room;
        let mut cost = |first| bench.work(&status(&program, room, first));
        let firsts =
            [looks[0], looks[1], looks[looks.len() / 2], looks[looks.len() - 2]].map(before);
        let costs = firsts.map(&mut cost);
        let us = costs.map(|cycles| format!("{:.1}", cycles as f64 / US as f64));
        println!(
            "{} instructions: a window after {firsts:?} of them takes {us:?} us of a scan",
            lines.len()
        );
        assert!(costs.into_iter().all(|cycles| cycles <= LONGER_MAX), "{network}");
    }
}

#[test]
fn a_trace_takes_little_of_a_scan() {
    let mut bench = Bench::new(&example("station1"));
    let quiet = (0..20).map(|_| bench.scan()).max().unwrap_or(0);
    bench.ask(&trace(DOUBLE_OF_M, 16));
    let traced = (0..20).map(|_| bench.scan()).max().unwrap_or(0);
    let us = (traced - quiet) as f64 / US as f64;
    println!("a sample of eight double words takes {us:.1} us of a scan");
    assert!(traced - quiet <= LONGER_MAX);
    assert_eq!(bench.ask(&[70, 0]).0, [70, 2], "it still waits for its trigger");
}
