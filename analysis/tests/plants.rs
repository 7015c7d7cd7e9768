//! Plant files in editors, and scenarios that name one.

use analysis::Project;

const PLANT: &str = "part Door 0..100\nbutton Call \"Call\"\nmove Door +20/s if Q0.0\n";
const SCENARIO: &str = "plant door.plant\nat 1s plant Call = 1\nat 2s expect plant Door = 0\n";

fn project(plant: &str, scenario: &str) -> Project {
    let mut project = Project::new();
    project.set("d/a.awl", "LD I0.0\n= Q0.0\n").unwrap();
    project.set("d/a.scn", scenario).unwrap();
    project.set("d/door.plant", plant).unwrap();
    project
}

fn problems(project: &Project, name: &str) -> Vec<String> {
    let problems = project.problems(name).into_iter();
    problems.map(|one| format!("{}..{} {}", one.span.start, one.span.end, one.message)).collect()
}

fn labels(project: &Project, name: &str, at: usize) -> Vec<String> {
    let completions = project.completions(name, at).into_iter();
    completions.map(|completion| completion.label).collect()
}

#[test]
fn a_scenario_knows_the_plant_of_its_file() {
    assert!(problems(&project(PLANT, SCENARIO), "d/a.scn").is_empty());
    let wrong = SCENARIO.replace("Call =", "Cal =");
    let found = problems(&project(PLANT, &wrong), "d/a.scn");
    assert_eq!(found, ["29..32 nothing can be set in the plant by the name Cal"]);
    let broken = project(&PLANT.replace("part", "prt"), SCENARIO);
    assert_eq!(problems(&broken, "d/a.scn"), ["6..16 door.plant has errors"]);
    let mut missing = project(PLANT, SCENARIO);
    missing.remove("d/door.plant");
    assert_eq!(problems(&missing, "d/a.scn"), ["6..16 door.plant is not in the project"]);
    let definition = project(PLANT, SCENARIO).definition("d/a.scn", 8);
    assert_eq!(definition[0].file, "d/door.plant");
    let related = project(PLANT, SCENARIO).related("d/door.plant");
    assert!(related.contains(&"d/a.scn".to_owned()), "{related:?}");
}

#[test]
fn a_plant_file_has_problems_with_fixes_completion_and_hover() {
    let text = "part Door 0..100\nmove Dor +20/s\n";
    let project = project(text, SCENARIO);
    let problem = &project.problems("d/door.plant")[0];
    assert_eq!(problem.code, Some("E0601"));
    assert_eq!(problem.fix.as_ref().unwrap().edit.text, "Door");
    let words = labels(&project, "d/door.plant", 0);
    assert!(["part", "belt", "draw"].iter().all(|word| words.iter().any(|one| one == word)));
    assert!(labels(&project, "d/door.plant", 22).contains(&"Door".to_owned()));
    let hover = project.hover("d/door.plant", 18).unwrap();
    assert!(hover.text.contains("move NAME +N/s"), "{}", hover.text);
}

#[test]
fn every_prefix_of_a_plant_file_can_be_asked_about() {
    let whole = include_str!("../../examples/garage_door.plant");
    let mut project = project(PLANT, SCENARIO);
    for (at, _) in whole.char_indices().step_by(3) {
        project.set("d/door.plant", &whole[..at]).unwrap();
        for problem in project.problems("d/door.plant") {
            let (start, end) = (problem.span.start as usize, problem.span.end as usize);
            assert!(whole[..at].get(start..end).is_some(), "{problem:?}");
        }
        for completion in project.completions("d/door.plant", at) {
            let span = completion.edit.span;
            assert!(whole[..at].get(span.start as usize..span.end as usize).is_some());
        }
        drop(project.hover("d/door.plant", at));
    }
}
