//! The examples as projects of the page, and the list of them.

use std::path::Path;

use serde_json::json;

use crate::exercises::exercises;
use crate::files::EXAMPLES;

/// Examples that come with more than their scenario: their plant.
const PLANTS: [(&str, &str); 3] = [
    ("station1", "station1 pieces=normal,small,normal,large,small,normal noise=3 seed=7"),
    ("tank", "tank"),
    ("pid", "tank"),
];

/// The plant of an example, as `awl-sim --plant` takes it.
pub fn plant_of(name: &str) -> Option<&'static str> {
    PLANTS.iter().find(|(of, _)| *of == name).map(|(_, plant)| *plant)
}

/// Each project as JSON with its name, and `list` with the names.
pub fn projects() -> Vec<(String, String)> {
    let programs = EXAMPLES.iter().filter_map(|(path, _)| path.strip_suffix(".awl"));
    let names: Vec<&str> =
        programs.filter(|name| Path::new(name).parent() == Some("".as_ref())).collect();
    let list = ("list".to_owned(), json!(names).to_string());
    let text = |(path, bytes): &(&str, &[u8])| {
        ((*path).to_owned(), String::from_utf8_lossy(bytes).into_owned())
    };
    let texts: Vec<_> = EXAMPLES.iter().map(text).collect();
    let exercises = exercises(&texts).into_iter().map(|(name, value)| (name, value.to_string()));
    let projects = names.iter().map(|name| ((*name).to_owned(), project(name)));
    projects.chain([list]).chain(exercises).collect()
}

fn project(name: &str) -> String {
    let is_its = |path: &str| {
        path.strip_prefix(name).is_some_and(|rest| rest.starts_with('.') && !rest.contains('/'))
    };
    let mut own: Vec<_> = EXAMPLES.iter().filter(|(path, _)| is_its(path)).collect();
    // The shorter ones first: the program and the scenario that is called like it.
    own.sort_by_key(|(path, _)| (path.len(), *path));
    let file = |(path, bytes): &&(&str, &[u8])| json!({ "name": path, "text": String::from_utf8_lossy(bytes) });
    let files: Vec<_> = own.iter().map(file).collect();
    let described = format!("{name}.plant");
    let has_plant = own.iter().any(|(path, _)| *path == described);
    let plant = plant_of(name).or_else(|| has_plant.then_some(described.as_str()));
    json!({ "files": files, "main": format!("{name}.awl"), "plant": plant }).to_string()
}
