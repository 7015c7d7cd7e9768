//! Forcing orders: `F/G2{3}`, and the gate variables by which charts of the set/reset way begin and
//! end each other.

use diagnostics::Span;
use st::names::{is_name, is_same};

use crate::diagnostic::{Code, Diagnostic};
use crate::model::{Forcing, Origin, Situation};
use crate::sfcedit::Project;
use crate::sfcedit::document::{Element, Grafcet};

/// `InitG2` forces G2 to its beginning, `ResetG2` to nothing.
pub(super) fn gate(name: &str, span: Span, project: &Project) -> Option<Forcing> {
    project.grafcets.iter().find_map(|grafcet| {
        let chart = &grafcet.name.text;
        let situation = match () {
            () if is_same(name, &format!("Init{chart}")) => Situation::Initial,
            () if is_same(name, &format!("Reset{chart}")) => Situation::Steps(Vec::new()),
            () => return None,
        };
        Some(Forcing { chart: chart.clone(), situation, origin: Origin(span) })
    })
}

/// `F/G2{3}`, `G2{}`, `G2{*}`, `G2{INIT}`: steps by their names, or by what is after `X`.
pub(super) fn order(text: &str, span: Span, project: &Project) -> Result<Forcing, Box<Diagnostic>> {
    let wrong = |code, message: String, help: &str| {
        Box::new(Diagnostic::new(code, span, message).help(help))
    };
    let squeezed: String = text.split_whitespace().collect();
    let bare = squeezed.strip_prefix("F/").unwrap_or(&squeezed);
    let parts =
        bare.split_once('{').and_then(|(chart, rest)| Some((chart, rest.strip_suffix('}')?)));
    let Some((name, inside)) = parts.filter(|(name, _)| is_name(name)) else {
        let message = format!("`{text}`: this is no forcing order");
        let help = "an order names a chart and a situation: F/G2{X3}, F/G2{}, F/G2{*}, F/G2{INIT}";
        return Err(wrong(Code::NotInStyle, message, help));
    };
    let Some(chart) = project.grafcets.iter().find(|one| one.name.text == name) else {
        let message = format!("{name}: there is no chart of this name to force");
        let names: Vec<&str> = project.grafcets.iter().map(|one| one.name.text.as_str()).collect();
        let help = format!("charts are {}", names.join(", "));
        return Err(wrong(Code::XmlStructure, message, &help));
    };
    let situation = match inside.to_uppercase().as_str() {
        "*" => Situation::Current,
        "INIT" => Situation::Initial,
        "" => Situation::Steps(Vec::new()),
        _ => {
            let mut steps = Vec::new();
            for written in inside.split(',') {
                let Some(step) = step(chart, written) else {
                    let message = format!("{written}: {name} has no step of this name");
                    let help = "the names of steps are in the brackets, with commas between";
                    return Err(wrong(Code::XmlStructure, message, help));
                };
                steps.push(step);
            }
            Situation::Steps(steps)
        }
    };
    Ok(Forcing { chart: name.to_owned(), situation, origin: Origin(span) })
}

fn step(chart: &Grafcet, written: &str) -> Option<String> {
    let elements = chart.sequences.iter().flat_map(|one| &one.elements);
    let names: Vec<&String> = elements
        .filter_map(|element| match element {
            Element::Step(step) => Some(&step.name.text),
            Element::Transition(_) => None,
        })
        .collect();
    let with_letter = format!("X{written}");
    let found = [written, &with_letter]
        .into_iter()
        .find_map(|wanted| names.iter().find(|name| name.as_str() == wanted));
    found.map(|name| (*name).clone())
}
