//! What tools are told of a program: where its instructions come from, and its variables. How that
//! is stored after an image is said elsewhere.

use crate::assemble::Assembly;
use crate::image::tools::{CodePlace, Tools, Variable};
use crate::source::{At, Source};

/// What tools need beside the image; `None` of a program of one file that neither declares anything
/// nor says where it comes from: the text is all there is.
pub fn for_tools(source: &Source, assembly: &Assembly) -> Option<Tools> {
    let declared = &assembly.program.variables;
    if declared.is_empty() && !source.has_origins() && !source.has_files() {
        return None;
    }
    let variables = declared.iter().map(|one| Variable {
        name: one.name.clone(),
        of_type: one.type_name(),
        address: one.address.to_string(),
    });
    let mut tools = Tools { variables: variables.collect(), ..Tools::default() };
    let mut last = None;
    for (line, selected) in assembly.lines.iter().zip(&assembly.code) {
        let place = assembly.place_of(source, selected);
        if last.as_ref() != Some(&place) {
            add(&mut tools, line.at as u16, &place);
            last = Some(place);
        }
    }
    Some(tools)
}

fn add(tools: &mut Tools, offset: u16, place: &crate::source::Place) {
    let known = tools.files.iter().position(|file| *file == place.file);
    let file = known.unwrap_or(tools.files.len());
    if known.is_none() {
        tools.files.push(place.file.clone());
    }
    let (line, column, element) = match &place.at {
        At::Line { line, column } => (*line, column.unwrap_or(0), String::new()),
        At::Element(name) => (0, 0, name.clone()),
    };
    tools.places.push(CodePlace {
        offset,
        file: file as u16,
        line: line as u32,
        column: u16::try_from(column).unwrap_or(u16::MAX),
        element,
    });
}
