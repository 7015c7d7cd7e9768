//! What plant files do, and what is said about wrong ones.

use super::*;
use crate::plant::{Inputs, Outputs};

fn plant(text: &str) -> Box<dyn Plant> {
    PlantFile::read("t.plant", text).unwrap_or_else(|errors| panic!("{errors}")).build()
}

fn value(plant: &dyn Plant, name: &str) -> f64 {
    let view = plant.view();
    view.iter().find(|(known, _)| known == name).map(|(_, value)| *value).unwrap()
}

/// Runs to this time with these outputs, in steps of so many milliseconds.
fn run(plant: &mut dyn Plant, inputs: &mut Inputs, to_ms: u64, outputs: u8, step_ms: u64) {
    for now_ms in (0..=to_ms).step_by(step_ms as usize) {
        plant.step(now_ms, Outputs::from(outputs), inputs);
    }
}

#[test]
fn parts_move_between_their_limits_whatever_the_step() {
    for step_ms in [1, 7, 100] {
        let mut door = plant(
            "part Door 0..100 start 20\nmove Door +12.5/s if Q0.0\nmove Door -0.25/s\n\
             input I0.2 if Door = 100\n",
        );
        let mut inputs = Inputs::default();
        run(&mut *door, &mut inputs, 2100, 0b1, step_ms);
        // 20 + 2.1 s * 12.25 per second.
        assert_eq!(value(&*door, "Door"), 45.0);
        assert!(!inputs.digital(2));
        let mut door = plant("part Door 0..100\nmove Door +100/s\ninput I0.2 if Door = 100\n");
        run(&mut *door, &mut inputs, 2100, 0, step_ms);
        assert!(inputs.digital(2));
    }
}

#[test]
fn a_time_constant_goes_two_thirds_of_the_way() {
    let mut oven = plant("part Heat 0..1000\napproach Heat 1000 in 5s if Q0.1\nanalog Ain3 Heat\n");
    let mut inputs = Inputs::default();
    run(&mut *oven, &mut inputs, 5000, 0b10, 1);
    // 1 - 1/e are 632.1 thousandths.
    assert_eq!(value(&*oven, "Heat"), 632.0);
    assert_eq!(inputs.analog(3), 647);
    assert_eq!(oven.signals().analog, 0b1000);
}

#[test]
fn pieces_queue_and_leave_and_are_taken() {
    let text = "belt Line 0..1000 pieces 3 long 100\npiece Line 50\nfeed Line every 1s\n\
                move Line +200/s\nhold Line 500 if not Q0.0\ninput I0.0 if Line = 490..500\n";
    let mut belt = plant(text);
    let mut inputs = Inputs::default();
    run(&mut *belt, &mut inputs, 10_000, 0, 1);
    // Three are there, one behind the other; no fourth has room.
    assert_eq!((value(&*belt, "Line"), value(&*belt, "Line.out")), (3.0, 0.0));
    assert!(inputs.digital(0));
    for now_ms in 10_001..=13_000 {
        belt.step(now_ms, Outputs::from(0b1), &mut inputs);
    }
    assert!(value(&*belt, "Line.out") >= 2.0);
    let mut belt = plant(&format!("{text}take Line 300..310\n"));
    run(&mut *belt, &mut inputs, 3_000, 0, 1);
    assert!(value(&*belt, "Line.taken") >= 2.0);
}

#[test]
fn what_people_set_is_seen_and_counted() {
    let mut lift = plant(
        "button Call \"Call\"\nslider Load \"Load\" 0..50 start 10\nswitch Key \"Key\" on\n\
         fault Jam \"Jam\"\ncount Calls \"called\" if Call and not Jam\n\
         input I0.0 if Call or Key and Load > 40\nanalog Ain0 Load 100..600\n",
    );
    let mut inputs = Inputs::default();
    lift.step(0, Outputs::from(0), &mut inputs);
    assert_eq!((inputs.digital(0), inputs.analog(0)), (false, 200));
    assert!(lift.set("call", 1) && lift.set("LOAD", 50) && !lift.set("other", 1));
    lift.step(1, Outputs::from(0), &mut inputs);
    assert_eq!((inputs.digital(0), inputs.analog(0)), (true, 600));
    lift.set("Call", 0);
    lift.step(2, Outputs::from(0), &mut inputs);
    assert!(inputs.digital(0), "the key is on");
    lift.set("Jam", 1);
    lift.set("Call", 1);
    lift.step(3, Outputs::from(0), &mut inputs);
    assert_eq!(lift.report().count("Calls"), Some(1));
    assert_eq!(lift.report().events[0].text, "called");
    assert_eq!(lift.controls().len(), 4);
}

#[test]
fn inverted_outputs_and_faults() {
    let mut plant = plant(
        "outputs inverted\nfault Broken \"Broken\" stuck I0.4\ninput I0.4 if Q0.5\n\
         draw lamp 10 10 5 if Q0.5\ndraw box 0 0 1 1 if not Q0.5\n",
    );
    let mut inputs = Inputs::default();
    plant.step(0, Outputs::from(0xFF), &mut inputs);
    assert!(!inputs.digital(4));
    assert_eq!(plant.places(), [vec![0.0, 0.0], vec![0.0]]);
    plant.set("Broken", 1);
    plant.step(1, Outputs::from(0), &mut inputs);
    assert!(!inputs.digital(4));
    assert_eq!(plant.places(), [vec![0.0, 1.0], vec![]]);
    plant.set("Broken", 0);
    plant.step(2, Outputs::from(0), &mut inputs);
    assert!(inputs.digital(4));
}

#[test]
fn a_part_follows_a_modulated_output() {
    for (text, is_low) in [("", false), ("outputs inverted\n", true)] {
        let text = format!("{text}part Voltage 0..5000\nfollow Voltage Q0.1 in 1s\n");
        let mut circuit = plant(&text);
        let mut inputs = Inputs::default();
        // High for 3/4 of the time, whatever the level is.
        let duty = if is_low { 250 } else { 750 };
        let outputs = Outputs::from(0b01).with_duties([(1, Some(duty)), (2, None)]);
        let mut at = |ms: u64| {
            circuit.step(ms, outputs, &mut inputs);
            value(&*circuit, "Voltage")
        };
        // 3750 (1 - exp(-1)) and 3750 (1 - exp(-10)).
        assert!((2369.0..2374.0).contains(&at(1000)), "{}", at(1000));
        assert!((3749.0..=3750.0).contains(&at(10_000)), "{}", at(10_000));
    }
    let mut steady = plant("part Voltage 0..5000\nfollow Voltage Q0.1 in 1ms\n");
    run(&mut *steady, &mut Inputs::default(), 2, 0b10, 1);
    assert_eq!(value(&*steady, "Voltage"), 5000.0, "an output that is simply on");
}

#[test]
fn a_part_moves_as_fast_as_another_one_says() {
    let text = "part Speed -20..20 start 20\nslider Drain \"Drain\" 0..50 start 30\n\
                part Way 0..1000\nmove Way +Speed/s\npart Level 0..100 start 100\n\
                move Level -Drain/s if Q0.0\n";
    let mut plant = plant(text);
    plant.step(2000, Outputs::from(0b1), &mut Inputs::default());
    assert_eq!((value(&*plant, "Way"), value(&*plant, "Level")), (40.0, 40.0));
}

#[test]
fn an_encoder_gives_an_edge_for_each_unit() {
    let mut plant = plant(
        "part Angle 0..100\nencoder I0.0 I0.2 Angle\nmove Angle +1000/s if Q0.0\n\
         move Angle -1000/s if Q0.1\n",
    );
    assert_eq!(plant.signals().digital, 0b101);
    let mut inputs = Inputs::default();
    let mut tracks = |now_ms, outputs: u8| {
        plant.step(now_ms, Outputs::from(outputs), &mut inputs);
        [inputs.digital(0), inputs.digital(2)]
    };
    let forward = (0..=4).map(|ms| tracks(ms, 0b1)).collect::<Vec<_>>();
    let expected = [[false, false], [true, false], [true, true], [false, true], [false, false]];
    assert_eq!(forward, expected, "the first track is ahead");
    let backward = (5..=8).map(|ms| tracks(ms, 0b10)).collect::<Vec<_>>();
    assert_eq!(backward, [[false, true], [true, true], [true, false], [false, false]]);
}

/// Codes with line and column.
fn errors(text: &str) -> Vec<String> {
    let source = Source::new("t.plant", text).unwrap();
    let of = |one: &Diagnostic| {
        let (line, column) = source.position(one.span.start as usize);
        format!("{}:{line}:{column}", one.code.text())
    };
    problems(text).iter().map(of).collect()
}

#[test]
fn every_mistake_has_its_place() {
    let text = "\
prt Door 0..100
part Door 100..0
part Lift 0..10
part Hoist 0..10 start 11
move Lft +5/s
move Lift 5
input I0.6 if Lift = 0
input I0.1 if Lift
input I0.1 if Lift = 1 xor Lift = 2
input I0.2 if Lift = 1
input I0.2 if Lift = 2
button Lift \"again\"
draw bx 1 2 3 4
draw box 1 2 3 4 gren
feed Lift every 1s
fault F \"x\" stuck Q0.1
analog Ain0 Lift 0..2000
encoder I0.2 I0.3 Lift
encoder I0.3 I0.3 Lift
encoder I0.4 I0.5 Lfit
follow Lift Q0.6 in 1s
follow Lift Q0.1 1s
move Lift +Q0.0/s
move Lift +Lft/s
move Door +1/s
";
    let expected = [
        "E0600:1:1",
        "E0603:2:11",
        "E0603:4:24",
        "E0601:5:6",
        "E0603:6:11",
        "E0604:7:7",
        "E0600:8:15",
        "E0600:9:24",
        "E0602:11:7",
        "E0602:12:8",
        "E0600:13:6",
        "E0600:14:18",
        "E0601:15:6",
        "E0604:16:19",
        "E0603:17:18",
        "E0602:18:9",
        "E0602:19:14",
        "E0601:20:19",
        "E0604:21:13",
        "E0600:22:18",
        "E0601:23:12",
        "E0601:24:12",
    ];
    // The last line says nothing: what is wrong with Door is told where it is made.
    assert_eq!(errors(text), expected);
}

#[test]
fn what_was_meant_is_suggested() {
    let suggestion = |text: &str| problems(text).remove(0).suggestion;
    assert_eq!(suggestion("prat A 0..1\n").as_deref(), Some("part"));
    assert_eq!(suggestion("part Door 0..1\nmove Dor +1/s\n").as_deref(), Some("Door"));
    assert_eq!(suggestion("draw bax 1 1 1 1\n").as_deref(), Some("box"));
    let shown = PlantFile::read("t.plant", "part Door 0..1\nmove Dor +1/s\n").unwrap_err();
    let expected = "\
error[E0601]: there is no Dor
 --> t.plant:2:6
  |
2 | move Dor +1/s
  |      ^^^
  |
  = help: did you mean `Door`?
";
    assert_eq!(shown.render(false), expected);
    let lines = "t.plant:2:6: error[E0601]: there is no Dor\n  help: did you mean `Door`?";
    assert_eq!(shown.to_string(), lines);
}

/// Texts, and the code, message and suggestion or help of the last problem.
#[test]
fn words_of_other_languages_are_answered() {
    let door = "part Door 0..2200\ninput I0.1 if Door = 0\nanalog Ain0 Door\n";
    let cases = [
        (
            "draw box 10 10 50 blue",
            "E0600 HEIGHT is missing before blue | write draw box X Y WIDTH HEIGHT",
        ),
        ("draw line 1 2 3", "E0600 Y2 is missing | write draw line X Y X2 Y2"),
        (
            "draw circle 1 2 if Q0.0",
            "E0600 RADIUS is missing before if | write draw circle X Y RADIUS",
        ),
        ("draw text 1 \"a\"", "E0600 Y is missing before \"a\" | write draw text X Y \"WORDS\""),
        ("draw box 1 2 3 4 move Door 5", "E0600 DY is missing | write draw box X Y WIDTH HEIGHT"),
        ("draw box 1 2 3 4O", "E0603 4O is no whole number | "),
        ("part Lift 0-2200", "E0600 a range is written with two points | 0..2200"),
        ("part Lift 0 - 2200 start 5", "E0600 a range is written with two points | 0..2200"),
        ("part Lift -5 to 5", "E0600 a range is written with two points | -5..5"),
        ("part Lift 0...2200", "E0600 a range is written with two points | 0..2200"),
        ("belt Line 0-500 pieces 3", "E0600 a range is written with two points | 0..500"),
        (
            "part Lift from 0",
            "E0600 a range such as 0..100 is missing before from | write part NAME A..B [start N]",
        ),
        ("input I0.2 if Door = 0-20", "E0603 0-20 is no whole number | 0..20"),
        ("input I0.2 if Door == 0", "E0600 == is no sign of a comparison | ="),
        ("input I0.2 if Door != 0", "E0600 != is no sign of a comparison | <>"),
        ("input I0.2 if !Q0.0", "E0600 ! negates nothing | not "),
        (
            "input I0.1 if Door = 2200",
            "E0602 I0.1 is driven by a line above already | \
             join what switches it by or, in one line; or another input is meant here",
        ),
        (
            "analog Ain0 Door",
            "E0602 Ain0 is driven by a line above already | \
             it follows one part or slider: perhaps another analog input is meant here",
        ),
    ];
    for (line, expected) in cases {
        let problem = problems(&format!("{door}{line}\n")).pop().unwrap();
        let meant = problem.suggestion.unwrap_or_else(|| problem.help.join("; "));
        assert_eq!(format!("{} {} | {meant}", problem.code.text(), problem.message), expected);
    }
}

#[test]
fn sizes_are_limited() {
    assert_eq!(errors(&"draw box 1 1 1 1\n".repeat(501)).last().unwrap(), "E0605:501:1");
    assert_eq!(errors(&"#".repeat(100_001)), ["E0605:1:1"]);
    assert_eq!(errors("belt B 0..10 pieces 101\n"), ["E0603:1:21"]);
    assert_eq!(errors(&format!("plant \"{}\"\n", "x".repeat(121))), ["E0605:1:7"]);
    let condition = vec!["Q0.0"; 33].join(" or ");
    assert_eq!(errors(&format!("input I0.0 if {condition}\n")), ["E0605:1:15"]);
    assert_eq!(errors("part A 0..9999999\n"), ["E0603:1:8"]);
}

#[test]
fn the_examples_of_every_page_do_what_the_page_says() {
    for code in Code::ALL {
        let (page, text) = (code.page(), code.text());
        assert!(page.starts_with(&format!("# {text}: ")), "{text}");
        let example = |line: &str| {
            let (_, behind) = page.split_once(&format!("\n{line}\n\n```plant\n")).unwrap();
            behind.split_once("```").unwrap().0
        };
        let codes: Vec<_> = problems(example("Wrong:")).iter().map(|one| one.code).collect();
        assert_eq!(codes, [*code], "the wrong example of {text}");
        assert!(problems(example("Right:")).is_empty(), "the right example of {text}");
    }
}

#[test]
fn every_form_is_that_of_its_statement() {
    for row in STATEMENTS {
        assert!(row.form.starts_with(row.word), "{}", row.form);
    }
    for (shape, form) in SHAPES {
        assert!(form.starts_with(&format!("draw {shape} ")), "{form}");
    }
}

#[test]
fn the_manual_has_every_statement_and_every_shape() {
    let manual = include_str!("../../../../docs/simulator.md");
    for row in STATEMENTS {
        assert!(manual.contains(&format!("\n| `{} ", row.word)), "{}", row.word);
    }
    for (shape, _) in SHAPES {
        assert!(manual.contains(&format!("\n| `draw {shape} ")), "{shape}");
    }
}

/// The plants of the examples, whole, cut off and with letters exchanged: never a panic, and what
/// is good runs.
#[test]
fn random_and_mutated_texts_never_panic() {
    const TEXTS: [&str; 5] = [
        include_str!("../../../../examples/traffic_light.plant"),
        include_str!("../../../../examples/conveyor.plant"),
        include_str!("../../../../examples/garage_door.plant"),
        include_str!("../../../../examples/fbd/motor_speed.plant"),
        include_str!("../../../../examples/fbd/rc_circuit.plant"),
    ];
    let words: Vec<&str> = TEXTS.iter().flat_map(|text| text.split_whitespace()).collect();
    let mut random = fastrand::Rng::with_seed(8);
    let mut good = 0;
    for round in 0..3000 {
        let text = TEXTS[round % TEXTS.len()];
        let mut bytes = text.as_bytes().to_vec();
        let text = match round % 4 {
            // Words in any order.
            0 => {
                let mut text = String::new();
                for _ in 0..random.usize(1..60) {
                    text += words[random.usize(..words.len())];
                    text.push(if random.u8(..6) == 0 { '\n' } else { ' ' });
                }
                text
            }
            // Letters exchanged, or cut off.
            1 => {
                for _ in 0..random.usize(1..8) {
                    let at = random.usize(..bytes.len());
                    bytes[at] = random.u8(..);
                }
                String::from_utf8_lossy(&bytes).into_owned()
            }
            2 => String::from_utf8_lossy(&bytes[..random.usize(..bytes.len())]).into_owned(),
            // A line less, which may be one that makes a name.
            _ => {
                let skip = random.usize(..text.lines().count());
                let kept = text.lines().enumerate().filter(|(line, _)| *line != skip);
                kept.map(|(_, line)| format!("{line}\n")).collect()
            }
        };
        if let Ok(file) = PlantFile::read("random.plant", &text) {
            good += 1;
            let mut plant = file.build();
            let mut inputs = Inputs::default();
            for control in plant.controls() {
                plant.set(&control.name, random.i64(..));
            }
            for step in 0..20 {
                plant.step(step * 100, Outputs::from(random.u8(..)), &mut inputs);
            }
            plant.view();
            assert_eq!(plant.places().len(), file.description.shapes.len());
        }
    }
    assert!(good > 300, "{good} were good");
}
