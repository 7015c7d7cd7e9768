//! Drawings of diagrams: which links there are, where elements and lines are, groups, pictures.

use std::collections::BTreeSet;

use diagnostics::Source;
use diagram::drawing::shapes::{ElementShape, LinkShape};
use diagram::drawing::{Drawing, ELEMENTS_MAX, Sheet, TooLarge, draw};
use diagram::interfaces::Interfaces;
use fastrand::Rng;
use picture::{Point, Rect};

fn drawn(text: &str) -> Result<Drawing, TooLarge> {
    let source = Source::new("d.fbd", text).expect("a short text");
    let read = diagram::read(&source);
    assert!(read.of_st.is_empty(), "{text}\n{:?}", read.of_st);
    draw(&source, &read.file, &Interfaces::default())
}

fn sheet(text: &str) -> Sheet {
    drawn(text).expect("a small diagram").sheets.remove(0)
}

fn main_with(declared: &str, statements: &[String]) -> String {
    format!("PROGRAM Main\n{declared}\n{}\nEND_PROGRAM\n", statements.join("\n"))
}

/// A link as a text: `B1.Y -> V2`, with `~>` where it is a feedback.
fn named(sheet: &Sheet, link: &LinkShape) -> String {
    let (from, to) = (&sheet.elements[link.from.element], &sheet.elements[link.to.element]);
    let pin = |element: &ElementShape, name: &str| match name {
        "" => element.id.clone(),
        name => format!("{}.{name}", element.id),
    };
    let from = pin(from, &from.outputs[link.from.pin].name);
    let to = pin(to, &to.inputs[link.to.pin].name);
    format!("{from} {} {to}", if link.is_feedback { "~>" } else { "->" })
}

fn links(sheet: &Sheet) -> Vec<String> {
    sheet.links.iter().map(|link| named(sheet, link)).collect()
}

/// The points of a line between which it is drawn.
fn segments(points: &[Point]) -> impl Iterator<Item = (Point, Point)> {
    points.windows(2).map(|pair| (pair[0], pair[1]))
}

/// All lines are horizontal and vertical, leave their outputs to the right and enter their inputs
/// from the left.
fn check_lines(sheet: &Sheet) {
    for link in &sheet.links {
        let name = named(sheet, link);
        let from = sheet.elements[link.from.element].outputs[link.from.pin].at;
        let to = sheet.elements[link.to.element].inputs[link.to.pin].at;
        let points = &link.points;
        assert_eq!((points.first(), points.last()), (Some(&from), Some(&to)), "{name}");
        for (a, b) in segments(points) {
            assert!((a.x == b.x) != (a.y == b.y), "{name}: {points:?}");
        }
        let (first, last) = (points[1], points[points.len() - 2]);
        assert!(first.y == from.y && first.x > from.x, "{name}: {points:?}");
        assert!(last.y == to.y && last.x < to.x, "{name}: {points:?}");
    }
    for at in &sheet.junctions {
        let is_on = |(a, b): (Point, Point)| {
            let grown = Rect::between(a, b).grown(1);
            grown.meets(Rect { x: at.x, y: at.y, width: 1, height: 1 })
        };
        let crossing = sheet.links.iter().filter(|one| segments(&one.points).any(is_on));
        assert!(crossing.count() >= 2, "a dot at {at:?}");
    }
}

/// The lines that pass through a box.
fn through_boxes(sheet: &Sheet) -> Vec<String> {
    let passes = |link: &&LinkShape| {
        segments(&link.points).any(|(a, b)| {
            let line = Rect::between(a, b).grown(1);
            sheet.elements.iter().any(|one| one.frame.grown(-2).meets(line))
        })
    };
    sheet.links.iter().filter(passes).map(|link| named(sheet, link)).collect()
}

fn overlapping(elements: &[ElementShape]) -> bool {
    let pairs = |at: usize| elements[at + 1..].iter().map(move |other| (&elements[at], other));
    (0..elements.len()).flat_map(pairs).any(|(one, other)| one.room().meets(other.room()))
}

#[test]
fn links_are_those_of_the_names() {
    let text = main_with(
        "VAR Beat : EVERY; Loop : PID; Tank : LAG; Lamp AT %Q0.0 : BOOL; Level : REAL; END_VAR",
        &[
            "Loop(EN := Beat.Q, SP := Level, PV := {feedback} Tank.Y);".to_owned(),
            "Tank(EN := beat.q, X := Loop.U * 2.0, Y => Level);".to_owned(),
            "Lamp := %Q0.0 OR Level > 3.0;".to_owned(),
            "Beat();".to_owned(),
        ],
    );
    let sheet = sheet(&text);
    let mut found = links(&sheet);
    found.sort();
    assert_eq!(
        found,
        [
            "BEAT.Q -> LOOP.EN",
            "BEAT.Q -> TANK.EN",
            "LAMP -> LAMP",
            "LOOP.U -> TANK.X",
            "TANK.Y -> LAMP",
            "TANK.Y -> LOOP.SP",
            "TANK.Y ~> LOOP.PV",
        ]
    );
    // A link alone leaves no text, an expression stays; so does what an output is written to.
    let texts = |element: usize| {
        let element = &sheet.elements[element];
        let pins = element.inputs.iter().chain(&element.outputs);
        pins.map(|pin| format!("{}={}", pin.name, pin.text)).collect::<Vec<_>>()
    };
    assert_eq!(texts(0), ["EN=", "SP=", "PV=", "U="]);
    assert_eq!(texts(1), ["EN=", "X=Loop.U * 2.0", "Y=Level"]);
    let parameters = |element: usize| {
        let all = sheet.elements[element].parameters.iter();
        all.map(|one| (one.name.as_str(), one.of_type.as_str())).collect::<Vec<_>>()
    };
    assert_eq!(parameters(1)[..2], [("K", "REAL"), ("T1", "TIME")]);
    assert_eq!(sheet.elements[0].outputs[0].names, ["Main.Loop.U", "Loop.U"]);
}

#[test]
fn blocks_without_a_text_have_the_pins_that_are_used() {
    let text = main_with(
        "VAR A : OWN; b : INT; END_VAR",
        &["A(IN := 1, {at} OUT => b);".to_owned(), "b2 := A.Q + A.rest[1];".to_owned()],
    );
    let sheet = sheet(&text);
    let names = |pins: &[diagram::drawing::shapes::Pin]| {
        pins.iter().map(|pin| pin.name.clone()).collect::<Vec<_>>()
    };
    let own = &sheet.elements[0];
    assert!(own.is_unknown);
    assert_eq!(
        (names(&own.inputs), names(&own.outputs)),
        (vec!["IN".to_owned()], vec!["OUT".to_owned(), "Q".to_owned(), "REST".to_owned()],)
    );
    // A block of the same text is known.
    let known = format!(
        "FUNCTION_BLOCK OWN VAR_INPUT IN, MORE : INT; END_VAR VAR_OUTPUT OUT : INT; END_VAR\n\
         OUT := IN; END_FUNCTION_BLOCK\n{text}"
    );
    let sheet = drawn(&known).expect("small").sheets.remove(1);
    let own = &sheet.elements[0];
    assert!(!own.is_unknown);
    assert_eq!(names(&own.inputs), ["IN", "MORE"]);
}

#[test]
fn places_and_groups_are_those_of_the_text() {
    let text = main_with(
        "{at 1 1} VAR a, b, c : INT; END_VAR",
        &[
            "{at 300 120} {group \"Out & in\"} a := b;".to_owned(),
            "{GROUP \"Out & in\"} {At -100 0} b := c;".to_owned(),
            "c := 1;".to_owned(),
        ],
    );
    let sheet = sheet(&text);
    assert!(sheet.is_placed);
    let [a, b, c] = [0, 1, 2].map(|at: usize| sheet.elements[at].frame);
    assert_eq!((a.x - b.x, a.y - b.y), (400, 120));
    assert_eq!(sheet.origin, Point::new(b.x + 100, b.y), "where {{at 0 0}} is");
    assert!(c.y > a.bottom(), "what has no place is below");
    let [group] = &sheet.groups[..] else { panic!("{:?}", sheet.groups) };
    assert_eq!((&group.name[..], &group.elements[..]), ("Out & in", &[0, 1][..]));
    let room = |at: usize| sheet.elements[at].room();
    assert_eq!(group.frame.union(room(0)).union(room(1)), group.frame);

    let picture = diagram::svg::write(&drawn(&text).expect("small"));
    assert!(picture.contains(">Out &amp; in</text>"), "{picture}");
    let places = ["c := 1; {at 5 5}", "{at 5} c := 1;", "{group X} c := 1;", "c := {at 1 1} 1;"];
    for wrong in places {
        let source = Source::new("d.fbd", main_with("", &[wrong.to_owned()])).expect("short");
        let found = diagram::read(&source).diagnostics;
        let [one] = &found[..] else { panic!("{wrong}: {found:?}") };
        assert_eq!((one.code.text(), one.severity()), ("W0501", diagnostics::Severity::Warning));
        assert!(one.span.text(&source.text).starts_with('{'), "{wrong}");
    }
}

#[test]
fn groups_without_places_are_below_each_other() {
    let statements = (0..30).map(|at| {
        let group = if at % 5 < 3 { format!("{{group \"G{}\"}} ", at % 5) } else { String::new() };
        format!("{group}v{} := v{at} + v{};", at + 1, at / 2)
    });
    let sheet = sheet(&main_with("", &statements.collect::<Vec<_>>()));
    assert!(!sheet.is_placed && !overlapping(&sheet.elements));
    for (at, group) in sheet.groups.iter().enumerate() {
        for other in &sheet.groups[at + 1..] {
            assert!(!group.frame.meets(other.frame), "{} and {}", group.name, other.name);
        }
        for (number, element) in sheet.elements.iter().enumerate() {
            let is_inside = group.frame.meets(element.room());
            assert_eq!(is_inside, group.elements.contains(&number), "{} in {}", element.name, at);
        }
    }
    assert_eq!(sheet.groups.len(), 3);
}

/// A random diagram, and its links as texts. Boxes that are placed do not overlap.
fn random_diagram(random: &mut Rng, is_placed: bool) -> (String, BTreeSet<String>) {
    let count = random.usize(1..25);
    let is_block: Vec<bool> = (0..count).map(|_| random.bool()).collect();
    let output = |at: usize| if is_block[at] { format!("B{at}.Y") } else { format!("V{at}") };
    let mut wanted = BTreeSet::new();
    let mut cells: Vec<usize> = (0..count * 2).collect();
    random.shuffle(&mut cells);
    let mut read = |random: &mut Rng, at: usize, pin: &str| {
        let source = random.usize(..count);
        let is_feedback = source >= at;
        let (arrow, before) = if is_feedback { ("~>", "{feedback} ") } else { ("->", "") };
        let to = if is_block[at] { format!("B{at}.{pin}") } else { format!("V{at}") };
        wanted.insert(format!("{} {arrow} {to}", output(source)));
        format!("{before}{}", output(source).to_lowercase())
    };
    let mut statements = Vec::new();
    for (at, cell) in cells.into_iter().take(count).enumerate() {
        let value = read(random, at, "X");
        let value = if random.bool() { value } else { format!("{value} + 1.5") };
        let statement = match is_block[at] {
            true if random.bool() => format!("B{at}(X := {value});"),
            true => format!("B{at}(EN := {}, X := {value});", read(random, at, "EN")),
            false => format!("V{at} := {value} * {};", read(random, at, "")),
        };
        let (x, y) = (cell as i32 % 5 * 700 + random.i32(..100), cell as i32 / 5 * 150);
        let place = if is_placed { format!("{{at {x} {y}}} ") } else { String::new() };
        statements.push(place + &statement);
    }
    random.shuffle(&mut statements);
    let declared = (0..count).filter(|at| is_block[*at]).map(|at| format!("B{at} : LAG; "));
    let declared = format!("VAR x : REAL; {}END_VAR\n", declared.collect::<String>());
    (main_with(&declared, &statements), wanted)
}

#[test]
fn random_diagrams_are_drawn_so_that_all_is_seen() {
    let (mut count, mut through) = (0, 0);
    for seed in 0..1_000 {
        let mut random = Rng::with_seed(seed);
        let is_placed = random.bool();
        let (text, wanted) = random_diagram(&mut random, is_placed);
        let sheet = sheet(&text);
        let found = links(&sheet);
        assert_eq!(found.len(), wanted.len(), "seed {seed}\n{text}");
        assert_eq!(found.into_iter().collect::<BTreeSet<_>>(), wanted, "seed {seed}\n{text}");
        assert!(!overlapping(&sheet.elements), "seed {seed}\n{text}");
        check_lines(&sheet);
        let passing = through_boxes(&sheet);
        assert!(passing.is_empty(), "seed {seed}: {passing:?}\n{text}");
        let rooms = sheet.elements.iter().map(ElementShape::room);
        let lines = sheet.links.iter().flat_map(|link| &link.points);
        let all = rooms.chain(lines.map(|at| Rect::around(*at, 0, 0)));
        assert!(all.into_iter().all(|one| sheet.frame.union(one) == sheet.frame), "seed {seed}");
        count += sheet.links.len();
        through += sheet.links.iter().filter(|link| through_texts(&sheet, link)).count();
    }
    // A way around texts is not always there: a box can be in the corner of its neighbours.
    assert!(through * 100 <= count, "{through} of {count} links pass through texts");
}

fn through_texts(sheet: &Sheet, link: &LinkShape) -> bool {
    segments(&link.points).any(|(a, b)| {
        let line = Rect::between(a, b).grown(1);
        let texts = sheet.elements.iter().flat_map(ElementShape::texts);
        texts.into_iter().any(|text| text.grown(-2).meets(line))
    })
}

#[test]
fn boxes_upon_each_other_are_drawn_all_the_same() {
    for seed in 0..300 {
        let mut random = Rng::with_seed(seed);
        let (text, _) = random_diagram(&mut random, false);
        let placed: String = text
            .lines()
            .map(|line| match line.contains(":=") && !line.starts_with("VAR") {
                true => format!("{{at {} {}}} {line}\n", random.i32(..300), random.i32(..200)),
                false => format!("{line}\n"),
            })
            .collect();
        check_lines(&sheet(&placed));
    }
}

#[test]
fn as_many_elements_as_are_drawn() {
    let statements =
        |count: usize| (0..count).map(|at| format!("v{} := v{at};", at + 1)).collect::<Vec<_>>();
    let drawing = drawn(&main_with("", &statements(ELEMENTS_MAX))).expect("just small enough");
    assert_eq!(drawing.sheets[0].links.len(), ELEMENTS_MAX - 1);
    let refused = drawn(&main_with("", &statements(ELEMENTS_MAX + 1))).unwrap_err().to_string();
    assert_eq!(refused, "Main: 2501 elements; up to 2500 are drawn");
}
