//! Plants that files describe, faults and goals, by way of the command `awl-sim`.

mod folder;

use folder::{Folder, told};

const WINCH: &str = "LD I0.0\nAN I0.1\n= Q0.0\n";
const LIFT: &str = "plant \"Lift\"\npart Lift 0..100\nbutton Call \"Call\"\n\
    fault TopStuck \"Top\" stuck I0.1\nmove Lift +50/s if Q0.0\ninput I0.0 if Call\n\
    input I0.1 if Lift = 100\ncount Top \"at the top\" if Lift = 100\n";

#[test]
fn a_scenario_presses_looks_and_breaks() {
    let scenario = "plant plants/lift.plant\ngoal \"The lift stops at the top\"\n\
        at 1s plant Call = 1\nat 2s expect Q0.0 = 1, plant Lift = 49..51\n\
        at 2s within 2s expect plant Top = 1\nat 4s expect Q0.0 = 0\nrun 5s\n";
    let files = [("p.awl", WINCH), ("p.scn", scenario)];
    let folder = Folder::with_files("plant_scenario", &files);
    std::fs::create_dir(folder.0.join("plants")).unwrap();
    std::fs::write(folder.0.join("plants/lift.plant"), LIFT).unwrap();
    let (code, out, errors) = told(&folder.sim(&["test", "p.scn"]));
    assert_eq!(code, Some(0), "{out}{errors}");
    assert!(out.contains("ran 5000 scans (5 s), 4 expectations met"), "{out}");
    // The sensor at the top says nothing: the motor runs on, and the goal is told.
    let broken = scenario.replace("at 1s plant", "at 500ms plant topstuck = 1\nat 1s plant");
    std::fs::write(folder.0.join("p.scn"), broken).unwrap();
    let (code, out, _) = told(&folder.sim(&["test", "p.scn"]));
    assert_eq!(code, Some(1), "{out}");
    assert!(out.contains("missing: The lift stops at the top\n"), "{out}");
    assert!(out.contains("p.scn:7: at 4s expected Q0.0 = 0, got 1"), "{out}");
}

#[test]
fn the_command_line_takes_a_plant_file() {
    let files = [("p.awl", "LD SM0.0\n= Q0.0\n"), ("lift.plant", LIFT)];
    let folder = Folder::with_files("plant_command", &files);
    let arguments = ["p.awl", "--plant", "lift.plant", "--for", "3s"];
    let (code, _, errors) = told(&folder.sim(&arguments));
    assert_eq!(code, Some(0));
    assert!(errors.contains("2.000 s  at the top\nplant lift.plant: Top 1\n"), "{errors}");
}

#[test]
fn what_is_wrong_is_told_at_its_place() {
    let bad = LIFT.replace("move Lift +50/s", "move Lft +50/s");
    let files = [("p.awl", WINCH), ("bad.plant", &*bad), ("lift.plant", LIFT)];
    let folder = Folder::with_files("plant_errors", &files);
    let plant = |name: &str| told(&folder.sim(&["p.awl", "--plant", name, "--for", "1s"]));
    let (code, _, errors) = plant("bad.plant");
    assert_eq!(code, Some(2));
    assert!(errors.contains("error[E0601]: there is no Lft\n --> bad.plant:5:6\n"), "{errors}");
    assert!(errors.contains("did you mean `Lift`?"), "{errors}");
    let (code, _, errors) = plant("none.plant");
    assert_eq!(code, Some(2));
    assert!(errors.contains("--plant:1:1") && errors.contains("none.plant"), "{errors}");
    let scenario = |text: &str| {
        std::fs::write(folder.0.join("s.scn"), text).unwrap();
        told(&folder.sim(&["p.awl", "--scenario", "s.scn"]))
    };
    for (text, wanted) in [
        ("plant bad.plant\n", "error[E0601]: there is no Lft\n --> bad.plant:5:6\n"),
        ("plant none.plant\n", " --> s.scn:1:7\n"),
        ("plant lift.plant\nat 1s plant Cal = 1\n", "by the name Cal\n --> s.scn:2:13\n"),
        ("plant lift.plant\nat 1s plant Cal = 1\n", "did you mean `Call`?"),
        ("plant lift.plant\nat 1s plant Call = 2\n", "Call is 0 to 1\n --> s.scn:2:20\n"),
        ("plant lift.plant\nat 1s expect plant Lft = 2\n", "did you mean `Lift`?"),
        ("plant lift.plant\nat 1s expect plant Lift = x\n", "x is no whole number and no range"),
        ("plant lift.plant\nat 1s I0.0 = 1\n", "I0.0 is driven by the plant lift.plant"),
        ("at 1s plant Call = 1\n", "there is no plant in this scenario\n --> s.scn:1:13\n"),
        ("plant lift.plant\nat 9s expect plant Lift = 1\nrun 5s\n", "never be checked"),
        ("goal The lift\n", "a text in quotes is missing before The\n --> s.scn:1:6\n"),
    ] {
        let (code, _, errors) = scenario(text);
        assert_eq!(code, Some(2), "{text}{errors}");
        assert!(errors.contains(wanted), "{text}{errors}");
    }
    assert_eq!(folder.names(), ["bad.plant", "lift.plant", "p.awl", "s.scn"]);
    // A symbol may be called so.
    let files = [("q.awl", "//# symbol plant M0.0\nLD plant\n= Q0.0\n")];
    let folder = Folder::with_files("plant_symbol", &files);
    let text = "at 1s plant = 1\nevery 2s plant = 0\nat 1.5s expect plant = 1, Q0.0 = 1\n";
    std::fs::write(folder.0.join("s.scn"), text).unwrap();
    let (code, _, errors) = told(&folder.sim(&["q.awl", "--scenario", "s.scn"]));
    assert_eq!(code, Some(0), "{errors}");
}

#[test]
fn built_in_plants_have_faults_too() {
    let station = env!("CARGO_MANIFEST_DIR").to_owned() + "/../examples/station1.awl";
    let folder = Folder::with_files("plant_faults", &[]);
    let run = |text: &str| {
        std::fs::write(folder.0.join("s.scn"), text).unwrap();
        told(&folder.sim(&[&station, "--scenario", "s.scn"]))
    };
    let plant = "plant station1 pieces=normal,small,normal,large\nscan 2ms\n";
    let (code, _, errors) = run(&format!(
        "{plant}at 59s expect plant good = 2, plant rejected = 2, plant left = 0\nrun 60s\n"
    ));
    assert_eq!(code, Some(2), "left is of the summary alone: {errors}");
    let (code, _, errors) =
        run(&format!("{plant}at 59s expect plant good = 2, plant rejected = 2\nrun 60s\n"));
    assert_eq!(code, Some(0), "{errors}");
    // The upper switch is broken: nothing ever arrives at the top.
    let (code, _, errors) =
        run(&format!("{plant}at 0s plant TopStuck = 1\nat 59s expect plant good = 0\nrun 60s\n"));
    assert_eq!(code, Some(0), "{errors}");
}
