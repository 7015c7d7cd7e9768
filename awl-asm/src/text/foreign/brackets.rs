//! Contacts with brackets, as STEP 7 has them (`U(`, `O E0.0`, `O E0.1`, `)`, `U E0.2`), and with
//! `O` alone before a branch, as the contacts of an S7-200, which joins branches by ALD and OLD.

use super::together::{Flow, Lines, Together, address};

/// Lines of one rung, and brackets in each other, that are followed.
const LINES_MAX: usize = 60;
const DEPTH_MAX: usize = 6;

/// How a contact or a bracket goes together with what is before it.
#[derive(Clone, Copy, PartialEq)]
enum Link {
    And,
    Or,
}

enum Item {
    Contact {
        link: Link,
        is_inverted: bool,
        bit: String,
    },
    Open {
        link: Link,
        is_inverted: bool,
    },
    Close,
    /// What follows is the next branch.
    Branch,
}

/// What a line is; `None` ends the contacts.
fn item(word: &str, operand: &str) -> Option<Item> {
    let upper = word.to_ascii_uppercase();
    let (name, opens) = match upper.strip_suffix('(') {
        Some(name) => (name, operand.is_empty()),
        None => (upper.as_str(), operand == "("),
    };
    if word.starts_with(')') {
        return operand.is_empty().then_some(Item::Close);
    }
    let (link, is_inverted) = match name {
        "A" | "U" => (Link::And, false),
        "AN" | "UN" => (Link::And, true),
        "O" => (Link::Or, false),
        "ON" => (Link::Or, true),
        _ => return None,
    };
    if opens {
        return Some(Item::Open { link, is_inverted });
    }
    if name == "O" && operand.is_empty() {
        return Some(Item::Branch);
    }
    let bit = match address(operand) {
        Some(address) => address.to_string(),
        None => operand.to_owned(),
    };
    let is_one = !bit.is_empty() && !bit.contains([' ', ',', '(']);
    is_one.then_some(Item::Contact { link, is_inverted, bit })
}

/// What is in one pair of brackets, or outside of all.
struct Level {
    /// How it goes together with what is before the bracket.
    link: Link,
    is_inverted: bool,
    /// Whether nothing is in it yet; nothing is in its branch yet.
    is_empty: bool,
    is_new_branch: bool,
    /// Whether it has an earlier branch that the present one is to be joined with.
    has_branch: bool,
}

impl Level {
    fn new(link: Link, is_inverted: bool) -> Level {
        Level { link, is_inverted, is_empty: true, is_new_branch: true, has_branch: false }
    }

    /// Ends the present branch.
    fn end_branch(&mut self, code: &mut Vec<String>) {
        if self.has_branch && !self.is_new_branch {
            code.push("OLD".to_owned());
            self.has_branch = false;
        }
    }
}

/// The contacts where the text begins, if a bracket is the first.
pub(super) fn find(text: &str, flow: Flow) -> Option<Together> {
    let mut lines = Lines::of(text);
    let (word, operand) = Lines::of(text).next()?;
    let Item::Open { .. } = item(word, operand)? else { return None };
    let mut levels = vec![Level::new(Link::And, false)];
    levels[0].is_empty = flow != Flow::Contact;
    levels[0].is_new_branch = flow != Flow::Contact;
    let mut code = Vec::new();
    let (mut end, mut count) = (0, 0);
    while let Some((word, operand)) = lines.next() {
        let Some(item) = item(word, operand) else { break };
        count += 1;
        if count > LINES_MAX || levels.len() > DEPTH_MAX {
            return None;
        }
        let level = levels.last_mut()?;
        // What is or-ed ends the branch before it: what follows goes on with both.
        if matches!(item, Item::Contact { link: Link::Or, .. } | Item::Open { link: Link::Or, .. })
        {
            level.end_branch(&mut code);
        }
        match item {
            Item::Contact { link, is_inverted, bit } => {
                let not = if is_inverted { "N" } else { "" };
                code.push(match (level.is_new_branch, link) {
                    (true, _) => format!("LD{not} {bit}"),
                    (false, Link::And) => format!("A{not} {bit}"),
                    (false, Link::Or) => format!("O{not} {bit}"),
                });
                (level.is_empty, level.is_new_branch) = (false, false);
            }
            Item::Open { link, is_inverted } => {
                levels.push(Level::new(link, is_inverted));
            }
            Item::Branch => {
                level.end_branch(&mut code);
                (level.has_branch, level.is_new_branch) = (!level.is_empty, true);
            }
            Item::Close => {
                let mut inside = levels.pop().filter(|_| !levels.is_empty())?;
                inside.end_branch(&mut code);
                if inside.is_empty {
                    return None;
                }
                inside.is_new_branch = false;
                code.extend(inside.is_inverted.then(|| "NOT".to_owned()));
                let outside = levels.last_mut()?;
                if !outside.is_new_branch {
                    code.push(if inside.link == Link::And { "ALD" } else { "OLD" }.to_owned());
                }
                (outside.is_empty, outside.is_new_branch) = (false, false);
            }
        }
        end = lines.end;
    }
    let [outside] = levels.as_mut_slice() else { return None };
    outside.end_branch(&mut code);
    (!outside.is_empty).then(|| Together {
        message: "an S7-200 has no brackets",
        code,
        help: Vec::new(),
        len: end,
        stand_in: Some(if flow == Flow::Contact { "A" } else { "LD" }),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn code(text: &str) -> String {
        find(text, Flow::None).map_or_else(String::new, |found| found.code.join("; "))
    }

    #[test]
    fn brackets_are_branches() {
        assert_eq!(code("U(\nO E0.0\nO E0.1\n)\nU E0.2\n= A0.0"), "LD I0.0; O I0.1; A I0.2");
        assert_eq!(
            code("A(\nO I0.0\nO I0.1\n)\nA(\nO I0.2\nO I0.3\n)\n= Q0.0"),
            "LD I0.0; O I0.1; LD I0.2; O I0.3; ALD"
        );
        assert_eq!(
            code("O(\nA I0.0\nA I0.1\n)\nO(\nA Start\nAN I0.3\n)"),
            "LD I0.0; A I0.1; LD Start; AN I0.3; OLD"
        );
        assert_eq!(code("UN(\nU E0.0\nU E0.1\n)"), "LD I0.0; A I0.1; NOT");
        assert_eq!(
            code("A(\nA I0.0\nO\nA I0.1\nO I0.2\nA I0.3\n)"),
            "LD I0.0; LD I0.1; OLD; O I0.2; A I0.3"
        );
        assert_eq!(
            code("A(\nA I0.0\nA I0.1\nO\nA I0.2\n)\nAN I0.3"),
            "LD I0.0; A I0.1; LD I0.2; OLD; AN I0.3"
        );
        let after = find("A(\nO I0.1\nO I0.2\n)\n= Q0.0", Flow::Contact);
        assert_eq!(after.map(|one| one.code.join("; ")).as_deref(), Some("LD I0.1; O I0.2; ALD"));
    }

    #[test]
    fn what_is_no_pair_of_brackets() {
        for text in ["U(\nO E0.0", ")\nU E0.0", "U(\n)\n= A0.0", "A I0.0\n= Q0.0", "A(I0.0)"] {
            assert_eq!(code(text), "", "{text}");
        }
    }
}
