//! `bind MODULE.wasm FOLDER [web]`: writes the module and the JavaScript through which node, or a
//! page, calls it. What the wasm-bindgen command does, without installing it: the versions always
//! fit.

use std::path::PathBuf;

use anyhow::{Context, Result};
use wasm_bindgen_cli_support::Bindgen;

fn main() -> Result<()> {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let module = arguments.next().context("bind MODULE.wasm FOLDER")?;
    let folder = arguments.next().context("bind MODULE.wasm FOLDER")?;
    let mut bindgen = Bindgen::new();
    // Names of functions are a quarter of a module, and no page shows them.
    bindgen.input_path(&module).typescript(false).remove_name_section(true);
    match arguments.next() {
        Some(_) => bindgen.web(true)?.omit_default_module_path(false),
        None => bindgen.nodejs(true)?,
    };
    bindgen.generate(&folder)
}
