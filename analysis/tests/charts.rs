//! What editors are told of charts and of function blocks of IEC 61499.

use analysis::{Outline, Project};

const CHART: &str = include_str!("../../examples/sfc/traffic_light.sfc");
const MIXING: &str = include_str!("../../examples/sfc/mixing.sfc");
const RAMP: &str = include_str!("../../examples/fbt/ramp.fbt");

fn project(name: &str, text: &str) -> Project {
    let mut project = Project::new();
    project.set(name, text).unwrap();
    project
}

/// Codes with the text that each is about.
fn found(name: &str, text: &str) -> Vec<(String, String)> {
    let problems = project(name, text).problems(name).into_iter();
    problems
        .map(|one| (one.code.unwrap_or_default().to_owned(), one.span.text(text).to_owned()))
        .collect()
}

fn names(parts: &[Outline]) -> Vec<&str> {
    parts.iter().map(|part| part.name.as_str()).collect()
}

#[test]
fn what_is_wrong_is_told_at_its_place() {
    for (name, text) in [("t.sfc", CHART), ("mixing.sfc", MIXING), ("ramp.fbt", RAMP)] {
        assert_eq!(found(name, text), [], "{name}");
    }
    // Of the chart itself, of the code in it, of the block, of an algorithm.
    let wrong = CHART.replace("FROM Drive TO Slow", "FROM Drive TO Slaw");
    assert!(
        found("t.sfc", &wrong).iter().any(|(code, at)| code.starts_with("E03") && at == "Slaw")
    );
    let wrong = CHART.replace(":= Button AND", ":= Batton AND");
    let told = found("t.sfc", &wrong);
    assert!(told.iter().any(|(code, at)| code.starts_with("E02") && at == "Batton"), "{told:?}");
    let wrong = RAMP.replace("Destination=\"E3\"", "Destination=\"E4\"");
    let told = found("ramp.fbt", &wrong);
    assert!(told.iter().any(|(code, at)| code.starts_with("E04") && at == "E4"), "{told:?}");
    let wrong = RAMP.replace("T := 0;", "U := 0;");
    let told = found("ramp.fbt", &wrong);
    assert!(told.iter().any(|(code, at)| code.starts_with("E02") && at == "U"), "{told:?}");
}

#[test]
fn the_parts_of_a_chart_and_of_a_block() {
    let outline = project("t.sfc", CHART).outline("t.sfc");
    assert_eq!(names(&outline), ["Crossing"]);
    let steps = names(&outline[0].children);
    assert_eq!((steps.len(), steps[0], steps[8]), (9, "Start", "Asked"));
    let outline = project("mixing.sfc", MIXING).outline("mixing.sfc");
    assert_eq!(names(&outline)[0], "mixing");
    assert!(names(&outline[0].children).contains(&"Stir"));
    let outline = project("ramp.fbt", RAMP).outline("ramp.fbt");
    assert_eq!(names(&outline), ["Ramp"]);
    let parts = names(&outline[0].children);
    assert!(["REQ", "Hold", "E2", "RampAlg"].iter().all(|name| parts.contains(name)), "{parts:?}");
}

#[test]
fn variables_of_a_chart_are_known_and_steps_keep_their_names() {
    let project = project("t.sfc", CHART);
    let at = CHART.find("Button AND").unwrap();
    assert_eq!(project.references("t.sfc", at).len(), 2);
    assert_eq!(project.rename("t.sfc", at, "Push").unwrap().len(), 2);
    let step = CHART.find("Walk.X").unwrap();
    assert_eq!(project.references("t.sfc", step).len(), 0);
    let labels: Vec<_> =
        project.completions("t.sfc", at).into_iter().map(|one| one.label).collect();
    assert!(labels.iter().any(|label| label == "CarRed"), "{labels:?}");
}

#[test]
fn a_layout_changes_nothing_once_more() {
    for (name, text) in [("t.sfc", CHART), ("ramp.fbt", RAMP)] {
        let mut project = project(name, text);
        if let Some(edit) = project.format(name).unwrap() {
            let mut laid_out = text.to_owned();
            laid_out.replace_range(edit.span.start as usize..edit.span.end as usize, &edit.text);
            project.set(name, laid_out).unwrap();
        }
        assert_eq!(project.format(name).unwrap(), None, "{name}");
    }
}

#[test]
fn a_scenario_belongs_to_the_chart_or_block_that_is_called_like_it() {
    for (name, text) in [("mixing.sfc", MIXING), ("ramp.fbt", RAMP)] {
        let mut project = project(name, text);
        let scenario = format!("{}.scn", name.split('.').next().unwrap());
        project.set(&scenario, "at 10ms expect Nowhere = 1\nrun 20ms\n").unwrap();
        assert_eq!(project.program(&scenario), [name]);
        assert_eq!(project.problems(&scenario).len(), 1, "{name}");
    }
}
