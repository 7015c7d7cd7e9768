//! The examples as projects of the page, and the list of them.

use std::path::Path;

use serde_json::json;

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
    names.iter().map(|name| ((*name).to_owned(), project(name))).chain([list]).collect()
}

fn project(name: &str) -> String {
    let file = |ending: &str| {
        let name = format!("{name}.{ending}");
        let (_, bytes) = EXAMPLES.iter().find(|(path, _)| *path == name)?;
        Some(json!({ "name": name, "text": String::from_utf8_lossy(bytes) }))
    };
    let files: Vec<_> = ["awl", "scn"].iter().filter_map(|ending| file(ending)).collect();
    json!({ "files": files, "main": format!("{name}.awl"), "plant": plant_of(name) }).to_string()
}
