//! Operands, as variables, contacts and instruction lists have them: whether a text is one, or an
//! expression that needs brackets beside an operator.

/// Whether a text is one operand, a variable, an address or a literal.
pub(super) fn is_operand(text: &str) -> bool {
    let quoted = |quote: char| {
        let inside = text.strip_prefix(quote).and_then(|rest| rest.strip_suffix(quote));
        inside.is_some_and(|inside| !inside.contains(quote))
    };
    if quoted('\'') || quoted('"') {
        return true;
    }
    let prefix = text.split_once('#').map(|(prefix, _)| prefix.to_uppercase());
    let is_typed = prefix.is_some();
    let is_date = prefix.is_some_and(|it| ["D", "DT", "DATE", "DATE_AND_TIME"].contains(&&*it));
    let is_number = text.starts_with(|c: char| c.is_ascii_digit() || "+-".contains(c));
    let (mut indexes, mut before) = (0, None);
    for c in text.chars() {
        let is_exponent = (is_number || is_typed) && matches!(before, Some('E' | 'e'));
        let is_part = match c {
            '[' | ']' => true,
            _ if indexes > 0 => true,
            '+' | '-' => matches!(before, None | Some('#')) || is_date || is_exponent,
            ':' => is_typed,
            _ => c.is_alphanumeric() || "_.#%".contains(c),
        };
        indexes += i32::from(c == '[') - i32::from(c == ']');
        if !is_part || indexes < 0 {
            return false;
        }
        before = Some(c);
    }
    before.is_some() && indexes == 0
}
