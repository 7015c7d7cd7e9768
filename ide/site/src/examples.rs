//! The examples as projects of the page, and the list of them.

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
    let mut projects = [
        of_language("", "awl", ""),
        of_language("st/", "st", "-st"),
        of_language("sfc/", "sfc", "-sfc"),
        of_language("grafcet/", "sfc", "-grafcet"),
        of_language("fbd/", "fbd", "-fbd"),
        of_language("fbt/", "fbt", "-fbt"),
    ]
    .concat();
    projects.sort();
    let names: Vec<&str> = projects.iter().map(|(name, _)| name.as_str()).collect();
    let list = ("list".to_owned(), json!(names).to_string());
    let text = |(path, bytes): &(&str, &[u8])| {
        ((*path).to_owned(), String::from_utf8_lossy(bytes).into_owned())
    };
    let texts: Vec<_> = EXAMPLES.iter().map(text).collect();
    let exercises = exercises(&texts).into_iter().map(|(name, value)| (name, value.to_string()));
    projects.into_iter().chain([list]).chain(exercises).collect()
}

/// The examples in a folder; a mark at their names says in which language they are.
fn of_language(folder: &str, ending: &str, mark: &str) -> Vec<(String, String)> {
    let stem = |path: &'static str| {
        let (stem, found) = path.strip_prefix(folder)?.rsplit_once('.')?;
        (found == ending && !stem.contains('/')).then_some(stem)
    };
    let stems = EXAMPLES.iter().filter_map(|(path, _)| stem(path));
    stems.map(|stem| (format!("{stem}{mark}"), project(folder, stem, ending))).collect()
}

fn project(folder: &str, stem: &str, ending: &str) -> String {
    let beside = |folder: &str| {
        let is_its = |path: &str| {
            let rest = path.strip_prefix(folder).and_then(|path| path.strip_prefix(stem));
            rest.is_some_and(|rest| rest.starts_with('.') && !rest.contains('/'))
        };
        EXAMPLES.iter().filter(|(path, _)| is_its(path)).collect::<Vec<_>>()
    };
    let mut own = beside(folder);
    // What an example does in AWL it does in another language, too, unless it has a scenario.
    let is_same = own.len() == 1 || folder.is_empty();
    if is_same && !folder.is_empty() {
        own.extend(beside("").into_iter().filter(|(path, _)| !path.ends_with(".awl")));
    }
    // The shorter ones first: the program and the scenario that is called like it.
    own.sort_by_key(|(path, _)| (path.len(), *path));
    let name = |path: &'static str| path.rsplit('/').next().unwrap_or(path);
    let file = |one: &&'static (&'static str, &'static [u8])| {
        let (path, bytes) = *one;
        json!({ "name": name(path), "text": String::from_utf8_lossy(bytes) })
    };
    let files: Vec<_> = own.iter().map(file).collect();
    let described = format!("{stem}.plant");
    let has_plant = own.iter().any(|(path, _)| name(path) == described);
    let known = plant_of(stem).filter(|_| is_same);
    let plant = known.or_else(|| has_plant.then_some(described.as_str()));
    json!({ "files": files, "main": format!("{stem}.{ending}"), "plant": plant }).to_string()
}
