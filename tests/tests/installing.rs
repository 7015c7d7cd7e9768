//! What users install from and with: the workflows are good YAML and call what there is, and the
//! crates say what they are.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tests::commands;
use yaml_rust2::{Yaml, YamlLoader};

const CI: &str = include_str!("../../.github/workflows/ci.yml");
const USERS: &str = include_str!("../../examples/ci/awl.yml");

/// The tools, and what they are made of.
const SHIPPED: [&str; 8] =
    ["awl-asm", "awl-sim", "uno200", "client", "diagnostics", "plc-isa", "plc-vm", "plc-link"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_path_buf()
}

/// The steps of all jobs.
fn steps(workflow: &str) -> Vec<Yaml> {
    let documents = YamlLoader::load_from_str(workflow).expect("good YAML");
    let [document] = &documents[..] else { panic!("one document") };
    assert!(document["name"].as_str().is_some() && !document["on"].is_badvalue());
    let jobs = document["jobs"].as_hash().expect("jobs").values();
    let steps = jobs.flat_map(|job| {
        assert!(job["runs-on"].as_str().is_some(), "a job runs somewhere");
        job["steps"].as_vec().expect("steps").clone()
    });
    steps.collect()
}

/// What the steps run.
fn scripts(workflow: &str) -> Vec<String> {
    let scripts = steps(workflow).into_iter().filter_map(|step| {
        let (uses, script) = (step["uses"].as_str(), step["run"].as_str());
        assert!(uses.is_some() != script.is_some(), "{step:?}: a step uses or runs");
        assert!(uses.is_none_or(|uses| uses.contains('@')), "{uses:?}: which version");
        script.map(str::to_owned)
    });
    scripts.collect()
}

/// The words after a word, over all lines.
fn after<'s>(scripts: &'s [String], word: &'s str) -> impl Iterator<Item = Vec<&'s str>> {
    scripts.iter().flat_map(|script| script.lines()).filter_map(move |line| {
        let words: Vec<&str> = line.split_whitespace().collect();
        let at = words.iter().position(|one| *one == word)?;
        Some(words[at + 1..].to_vec())
    })
}

#[test]
fn the_workflow_of_the_repository_calls_what_there_is() {
    let scripts = scripts(CI);
    assert!(scripts.iter().any(|script| script == ".ci/run"));
    assert!(root().join(".ci/run").is_file());
    let tasks = std::fs::read_to_string(root().join("xtask/src/main.rs")).unwrap();
    let mut calls = BTreeSet::new();
    for words in after(&scripts, "cargo") {
        calls.insert(words[0].to_owned());
        match words[..] {
            ["xtask", task] => {
                assert!(tasks.to_lowercase().contains(&format!("task::{task} ")), "{task}");
            }
            ["build", "--locked", ..] => {
                let packages = words.iter().skip_while(|word| **word != "--package");
                let named: Vec<_> = packages.filter(|word| !word.starts_with("--")).collect();
                assert_eq!(named, [&"awl-asm", &"awl-sim", &"uno200"]);
            }
            _ => panic!("{words:?}: not known here"),
        }
    }
    assert_eq!(calls.len(), 2, "{calls:?}");
}

/// Runs a script as a step does, with the tools of the repository.
fn run_step(script: &str, folder: &Path, path: &std::ffi::OsStr) -> Output {
    let mut bash = Command::new("bash");
    bash.args(["--noprofile", "--norc", "-e", "-o", "pipefail", "-c", script]);
    bash.current_dir(folder).env("PATH", path).output().expect("bash starts")
}

#[test]
fn the_workflow_of_users_does_what_it_says() {
    let scripts = scripts(USERS);
    let [install, check, test] = &scripts[..] else { panic!("{scripts:?}") };
    let packages = ["awl-asm", "awl-sim"];
    assert!(install.contains("cargo install --locked --git \"$UNO200\" awl-asm awl-sim"));
    let tools = packages.map(commands::built);
    let own = tools[0].parent().unwrap().to_path_buf();
    let others = std::env::var_os("PATH").unwrap_or_default();
    let path =
        std::env::join_paths(std::iter::once(own).chain(std::env::split_paths(&others))).unwrap();
    let folder = tempfile::tempdir().unwrap();
    for name in ["motor.awl", "motor.scn"] {
        std::fs::copy(root().join("examples").join(name), folder.path().join(name)).unwrap();
    }
    let run = |script: &str| run_step(script, folder.path(), &path);
    for script in [check, test] {
        let output = run(script);
        assert!(output.status.success(), "{script}: {output:?}");
    }
    let results = std::fs::read_to_string(folder.path().join("results.xml")).unwrap();
    assert!(results.contains("motor.scn"), "{results}");
    std::fs::write(folder.path().join("a.awl"), "LD I0.9\n= Q0.0\n").unwrap();
    let output = run(check);
    assert!(!output.status.success(), "an error must fail");
    let shown = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(shown.starts_with("a.awl:1:4: error[E0005]: "), "{shown}");
    std::fs::write(folder.path().join("motor.scn"), "at 1ms expect Q0.0 = 1\n").unwrap();
    assert!(!run(test).status.success(), "a failed expectation must fail");
}

#[test]
fn crates_say_what_they_are() {
    let mut metadata = Command::new(env!("CARGO"));
    metadata.args(["metadata", "--no-deps", "--locked", "--format-version", "1"]);
    let output = metadata.current_dir(root()).output().unwrap();
    let metadata: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let packages = metadata["packages"].as_array().unwrap();
    for name in SHIPPED {
        let package = packages.iter().find(|one| one["name"] == name).expect(name);
        for field in ["description", "license", "readme", "rust_version"] {
            assert!(package[field].is_string(), "{name}: {field} is missing");
        }
        let readme = Path::new(package["manifest_path"].as_str().unwrap())
            .with_file_name(package["readme"].as_str().unwrap());
        assert!(readme.is_file(), "{}", readme.display());
        // What crates.io takes.
        let keywords = package["keywords"].as_array().unwrap();
        assert!((1..=5).contains(&keywords.len()), "{name}: {keywords:?}");
        assert!(keywords.iter().all(|word| word.as_str().unwrap().len() <= 20), "{name}");
        assert!((1..=5).contains(&package["categories"].as_array().unwrap().len()), "{name}");
    }
}
