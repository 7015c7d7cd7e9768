//! One project in XML of PLCopen (TC6, 2.01): blocks and MAIN with bodies in Structured Text, and
//! the global variables of a configuration.

use std::collections::BTreeMap;

use diagnostics::xml::Writer;

use super::dialect::{PLCOPEN, Places};
use super::objects::{Group, Object, groups};
use super::st::{block_body, main_body};
use crate::set_reset::plan::Plan;

/// The schema asks for a time, and this library has no clock.
const MADE: &str = "2000-01-01T00:00:00";

/// The project.
pub(super) fn write(plan: &Plan, name: &str) -> String {
    let groups = groups(plan, Places::Open);
    let types: BTreeMap<String, &str> = groups
        .iter()
        .flat_map(|group| &group.variables)
        .map(|one| (one.name.clone(), one.of_type.as_str()))
        .collect();
    let mut out = Writer::default();
    let namespaces = [
        ("xmlns", "http://www.plcopen.org/xml/tc6_0201"),
        ("xmlns:xhtml", "http://www.w3.org/1999/xhtml"),
    ];
    out.element("project", &namespaces, |out| {
        head(out, name, "");
        out.element("types", &[], |out| {
            out.empty("dataTypes", &[]);
            out.element("pous", &[], |out| pous(out, plan, &types));
        });
        out.element("instances", &[], |out| {
            out.element("configurations", &[], |out| configuration(out, &groups));
        });
    });
    out.finish()
}

/// The two headers of a project: who has made it, and its name with a comment, if there is one.
pub fn head(out: &mut Writer, name: &str, comment: &str) {
    out.empty(
        "fileHeader",
        &[
            ("companyName", ""),
            ("productName", "uno200"),
            ("productVersion", env!("CARGO_PKG_VERSION")),
            ("creationDateTime", MADE),
        ],
    );
    out.element("contentHeader", &[("name", name)], |out| {
        if !comment.is_empty() {
            out.text("Comment", &[], comment);
        }
        out.element("coordinateInfo", &[], |out| {
            for language in ["fbd", "ld", "sfc"] {
                out.element(language, &[], |out| out.empty("scaling", &[("x", "1"), ("y", "1")]));
            }
        });
    });
}

fn pous(out: &mut Writer, plan: &Plan, types: &BTreeMap<String, &str>) {
    for chart in &plan.charts {
        let body = block_body(chart, &PLCOPEN);
        let name = format!("G{}", chart.name);
        pou(out, &name, "functionBlock", &body, |out| {
            out.element("inputVars", &[], |out| {
                variable(out, &Object::plain("Init", "BOOL"));
                variable(out, &Object::plain("Reset", "BOOL"));
            });
            external(out, &body, types);
        });
    }
    let body = main_body(plan, &PLCOPEN);
    pou(out, "MAIN", "program", &body, |out| {
        out.element("localVars", &[], |out| {
            for chart in &plan.charts {
                variable(out, &Object::plain(&chart.name, &format!("G{}", chart.name)));
            }
        });
        external(out, &body, types);
    });
}

fn pou(out: &mut Writer, name: &str, kind: &str, body: &str, interface: impl FnOnce(&mut Writer)) {
    out.element("pou", &[("name", name), ("pouType", kind)], |out| {
        out.element("interface", &[], interface);
        out.element("body", &[], |out| {
            out.element("ST", &[], |out| out.text("xhtml:p", &[], body));
        });
    });
}

/// The global variables that a body names: a unit has to say which it uses.
fn external(out: &mut Writer, body: &str, types: &BTreeMap<String, &str>) {
    let words = body.split(|c: char| !(c.is_alphanumeric() || c == '_'));
    let used: BTreeMap<&str, &str> =
        words.filter_map(|word| Some((word, *types.get(word)?))).collect();
    if !used.is_empty() {
        out.element("externalVars", &[], |out| {
            for (name, of_type) in used {
                variable(out, &Object::plain(name, of_type));
            }
        });
    }
}

fn variable(out: &mut Writer, one: &Object) {
    let mut head = vec![("name", one.name.as_str())];
    head.extend(one.place.as_deref().map(|place| ("address", place)));
    out.element("variable", &head, |out| {
        out.element("type", &[], |out| match one.of_type.as_str() {
            elementary @ ("BOOL" | "INT" | "WORD" | "DWORD" | "REAL" | "TIME") => {
                out.empty(elementary, &[]);
            }
            block => out.empty("derived", &[("name", block)]),
        });
        if let Some(value) = &one.value {
            out.element("initialValue", &[], |out| out.empty("simpleValue", &[("value", value)]));
        }
    });
}

fn configuration(out: &mut Writer, groups: &[Group]) {
    out.element("configuration", &[("name", "Configuration")], |out| {
        out.element("resource", &[("name", "Resource")], |out| {
            let task = [("name", "Scan"), ("interval", "T#10ms"), ("priority", "0")];
            out.element("task", &task, |out| {
                out.empty("pouInstance", &[("name", "Main"), ("typeName", "MAIN")]);
            });
        });
        for group in groups {
            let mut head = vec![("name", group.title.as_str())];
            head.extend(group.is_constant.then_some(("constant", "true")));
            out.element("globalVars", &head, |out| {
                group.variables.iter().for_each(|one| variable(out, one));
            });
        }
    });
}
