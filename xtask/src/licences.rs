//! Where dependencies come from, and under which licences: of every manifest, what is only for
//! tests included. Advisories are not looked up: that needs a database from outside.

use std::path::Path;

use anyhow::{Context, Result, ensure};
use serde_json::Value;

use crate::process::{cargo, root};

/// All manifests with a lock file.
const MANIFESTS: &[&str] = &[
    "Cargo.toml",
    "firmware/Cargo.toml",
    "firmware-pico/Cargo.toml",
    "firmware-microbit/Cargo.toml",
    "tests/vm-on-avr/Cargo.toml",
    "fuzz/Cargo.toml",
];

/// The registry that dependencies may come from.
const REGISTRY: &str = "registry+https://github.com/rust-lang/crates.io-index";

/// Licences that ask for no more than a notice. MPL-2.0 asks for the source of the files under it
/// alone, which are those of the registry.
const ALLOWED: &[&str] = &[
    "0BSD",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "ISC",
    "MIT",
    "MPL-2.0",
    "NCSA",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
];

/// Tools that run while something is built, of which nothing is in what is shipped.
const BUILD_TOOLS: &[&str] = &[
    // avr-device makes its registers with it, from the chip's description. GPL-3.0-only.
    "atdf2svd",
];

/// Checks every dependency of every manifest and names each that is not allowed.
pub fn check() -> Result<()> {
    let mut breaches = Vec::new();
    let mut count = 0;
    for manifest in MANIFESTS.iter().filter(|manifest| root().join(manifest).exists()) {
        let packages = packages(manifest)?;
        count += packages.len();
        breaches.extend(packages.iter().filter_map(breach));
    }
    breaches.sort();
    breaches.dedup();
    for breach in &breaches {
        eprintln!("  {breach}");
    }
    ensure!(breaches.is_empty(), "{} dependencies are not allowed", breaches.len());
    println!("   {count} packages in the lock files");
    Ok(())
}

/// The packages of a manifest and of its dependencies, as `cargo metadata` describes them.
pub fn packages(manifest: &str) -> Result<Vec<Value>> {
    let output = cargo()
        .args(["metadata", "--locked", "--all-features", "--format-version", "1"])
        .arg("--manifest-path")
        .arg(root().join(manifest))
        .output()
        .context("cannot start cargo")?;
    let errors = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "{manifest}: cargo metadata failed\n{errors}");
    let mut metadata: Value = serde_json::from_slice(&output.stdout)?;
    match metadata["packages"].take() {
        Value::Array(packages) => Ok(packages),
        _ => Ok(Vec::new()),
    }
}

/// What is wrong with a package.
fn breach(package: &Value) -> Option<String> {
    let text = |field: &str| package[field].as_str().unwrap_or_default().to_string();
    let name = format!("{} {}", text("name"), text("version"));
    let is_own = Path::new(&text("manifest_path")).starts_with(root());
    match package["source"].as_str() {
        Some(REGISTRY) => {}
        None if is_own => {}
        source => return Some(format!("{name}: comes from {}", source.unwrap_or("elsewhere"))),
    }
    let licence = text("license");
    if BUILD_TOOLS.contains(&text("name").as_str()) {
        return None;
    }
    (!is_allowed(&licence)).then(|| format!("{name}: licence `{licence}`"))
}

/// Whether an expression can be satisfied by allowed licences. An `/` is an old way to write OR.
fn is_allowed(expression: &str) -> bool {
    let spaced = expression.replace('(', " ( ").replace(')', " ) ").replace('/', " OR ");
    let words: Vec<&str> = spaced.split_whitespace().collect();
    let mut rest = words.as_slice();
    any_of(&mut rest) == Some(true) && rest.is_empty()
}

/// Whether one of several is allowed; `None` where something is missing.
fn any_of(words: &mut &[&str]) -> Option<bool> {
    let mut allowed = all_of(words)?;
    while let [operator, rest @ ..] = *words
        && *operator == "OR"
    {
        *words = rest;
        allowed |= all_of(words)?;
    }
    Some(allowed)
}

fn all_of(words: &mut &[&str]) -> Option<bool> {
    let mut allowed = one(words)?;
    while let [operator, rest @ ..] = *words
        && *operator == "AND"
    {
        *words = rest;
        allowed &= one(words)?;
    }
    Some(allowed)
}

/// A licence, with its exception if it has one, or an expression in brackets.
fn one(words: &mut &[&str]) -> Option<bool> {
    match **words {
        ["(", ref rest @ ..] => {
            *words = rest;
            let allowed = any_of(words)?;
            *words = words.strip_prefix(&[")"])?;
            Some(allowed)
        }
        [licence, "WITH", exception, ref rest @ ..] => {
            *words = rest;
            let with_exception = format!("{licence} WITH {exception}");
            Some(ALLOWED.contains(&with_exception.as_str()) || ALLOWED.contains(&licence))
        }
        [licence, ref rest @ ..] => {
            *words = rest;
            Some(ALLOWED.contains(&licence))
        }
        [] => None,
    }
}

#[cfg(test)]
mod tests {
    use super::is_allowed;

    #[test]
    fn an_expression_is_satisfied_by_allowed_licences_alone() {
        for allowed in [
            "MIT",
            "MIT/Apache-2.0",
            "GPL-3.0-only OR MIT",
            "(MIT OR Apache-2.0) AND Unicode-3.0",
            "Apache-2.0 WITH LLVM-exception OR Apache-2.0 OR MIT",
            "MIT AND (GPL-2.0-only OR Zlib)",
        ] {
            assert!(is_allowed(allowed), "{allowed}");
        }
        for refused in [
            "",
            "GPL-3.0-only",
            "MIT AND GPL-3.0-only",
            "(MIT OR GPL-3.0-only) AND AGPL-3.0-only",
            "MIT OR",
            "(MIT",
            "MIT)",
            "MIT Zlib",
        ] {
            assert!(!is_allowed(refused), "{refused}");
        }
    }
}
