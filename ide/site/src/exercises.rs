//! The exercises as the page fetches them: each with its texts, its project to begin with and its
//! hidden scenarios, and the list of them.

use std::path::Path;

use serde_json::{Value, json};

/// Languages of the page, as the names of texts have them; the first has none.
const LANGUAGES: [&str; 3] = ["", ".de", ".es"];
const FOLDER: &str = "exercises/";

/// All of them by name, and behind them the list by the name `exercises`. `files`: paths in the
/// folder of the examples, and texts; sorted.
pub fn exercises(files: &[(String, String)]) -> Vec<(String, Value)> {
    let mut list = Vec::new();
    let mut all = Vec::new();
    for (path, _) in files {
        let folder = path.strip_prefix(FOLDER).and_then(|path| path.rsplit_once("/start."));
        let Some((name, ending)) = folder else { continue };
        let exercise = exercise(files, name, ending);
        list.push(json!({ "name": name, "title": exercise["title"] }));
        all.push((format!("exercise-{name}"), exercise));
    }
    all.push(("exercises".to_owned(), json!(list)));
    all
}

/// `ending`: in which language it is.
fn exercise(files: &[(String, String)], name: &str, ending: &str) -> Value {
    let folder = format!("{FOLDER}{name}/");
    let here = || files.iter().filter_map(|(path, text)| Some((path.strip_prefix(&folder)?, text)));
    let text = |file: &str| here().find(|(path, _)| *path == file).map_or("", |(_, text)| text);
    let parts = LANGUAGES.map(|language| {
        let text = text(&format!("exercise{language}.md"));
        let (title, text) = text.split_once('\n').unwrap_or_default();
        (title.trim_start_matches("# "), text.trim())
    });
    let scenarios: Vec<_> = here().filter(|(path, _)| path.ends_with(".scn")).collect();
    let plant = scenarios.iter().rev().find_map(|(_, text)| plant_of(text)).unwrap_or_default();
    let stem = name.trim_start_matches(|c: char| c.is_ascii_digit() || c == '_');
    let main = format!("{stem}.{ending}");
    let start = text(&format!("start.{ending}"));
    let mut project = vec![json!({ "name": main, "text": start })];
    let mut hidden = Vec::new();
    let mut spec = plant.to_owned();
    if plant.ends_with(".plant") {
        let described = beside(files, &folder, plant);
        spec = Path::new(plant).file_name().unwrap_or_default().to_string_lossy().into_owned();
        project.push(json!({ "name": spec, "text": described }));
        // Whatever somebody makes of the plant, it is checked with this one.
        hidden.push(json!({ "name": plant, "text": described }));
    }
    let file = |(name, text): &(&str, &String)| json!({ "name": name, "text": text });
    json!({
        "title": parts.map(|(title, _)| title),
        "text": parts.map(|(_, text)| text),
        "project": {
            "files": project,
            "main": main,
            "plant": if spec.is_empty() { None } else { Some(spec) },
            "view": "exercises",
        },
        "scenarios": scenarios.iter().map(file).collect::<Vec<_>>(),
        "plants": hidden,
    })
}

/// What follows `plant` at the beginning of a line.
fn plant_of(scenario: &str) -> Option<&str> {
    let line = scenario.lines().find_map(|line| line.strip_prefix("plant "))?;
    Some(line.split('#').next().unwrap_or(line).trim())
}

/// The text of a file that is named from a folder on, which `../` leaves.
fn beside<'f>(files: &'f [(String, String)], folder: &str, name: &str) -> &'f str {
    let mut parts: Vec<&str> = folder.trim_end_matches('/').split('/').collect();
    for part in name.split('/') {
        match part {
            ".." => drop(parts.pop()),
            part => parts.push(part),
        }
    }
    let path = parts.join("/");
    files.iter().find(|(known, _)| *known == path).map_or("", |(_, text)| text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_exercise_has_its_start_its_plant_and_its_goals() {
        let file = |path: &str, text: &str| (path.to_owned(), text.to_owned());
        let files = [
            file("door.plant", "part Door 0..1\n"),
            file("exercises/07_door/exercise.de.md", "# Tor\n\nText\n"),
            file("exercises/07_door/exercise.es.md", "# Puerta\n\nTexto\n"),
            file("exercises/07_door/exercise.md", "# Door\n\nText\n"),
            file("exercises/07_door/solution.1.scn", "goal \"x\"\nplant ../../door.plant # it\n"),
            file("exercises/07_door/solution.awl", "LD I0.0\n"),
            file("exercises/07_door/start.awl", "NETWORK 1\n"),
        ];
        let all = exercises(&files);
        let names: Vec<_> = all.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["exercise-07_door", "exercises"]);
        assert_eq!(all[1].1, json!([{ "name": "07_door", "title": ["Door", "Tor", "Puerta"] }]));
        let exercise = &all[0].1;
        assert_eq!(exercise["text"], json!(["Text", "Text", "Texto"]));
        assert_eq!(exercise["project"]["main"], "door.awl");
        assert_eq!(exercise["project"]["plant"], "door.plant");
        assert_eq!(exercise["project"]["files"][1]["text"], "part Door 0..1\n");
        assert_eq!(exercise["plants"][0]["name"], "../../door.plant");
        assert_eq!(exercise["scenarios"].as_array().map(Vec::len), Some(1));
        assert!(!exercise.to_string().contains("LD I0.0"), "the solution stays at home");
    }
}
