//! The listing: every source line with the bytes it became and the depth of the logic stack behind it.

use std::fmt::Write as _;

use crate::assemble::Assembly;
use crate::check::span_of;
use crate::source::Source;

/// Bytes of the longest instruction: FOR with a hidden one before it.
const BYTES_SHOWN: usize = 12;

/// Writes the listing of an assembled program.
pub fn listing(source: &Source, assembly: &Assembly) -> String {
    let image = assembly.image.as_deref().unwrap_or(&[]);
    let mut text = format!(
        "{}: {} instructions, {} bytes\n\n  line  offset  {:<width$}  stack  source\n",
        source.name,
        assembly.code.len(),
        image.len(),
        "bytes",
        width = BYTES_SHOWN * 3 - 1,
    );
    let mut next = 0;
    for (number, line) in (1..).zip(source.lines()) {
        let mut shown = false;
        while let Some((selected, encoded)) = assembly.code.get(next).zip(assembly.lines.get(next)) {
            let (at_line, _) = source.position(span_of(&assembly.program, selected).start as usize);
            if at_line != number {
                break;
            }
            let bytes = image.get(encoded.at as usize..encoded.at as usize + usize::from(encoded.len)).unwrap_or(&[]);
            let depth = assembly.depths.get(next).copied().unwrap_or(0);
            let _ = writeln!(
                text,
                "{number:>6}  {:>6}  {:<width$}  {depth:>5}  {}",
                format!("{:04X}", encoded.at),
                hex(bytes),
                if shown { "" } else { line },
                width = BYTES_SHOWN * 3 - 1,
            );
            shown = true;
            next += 1;
        }
        if !shown {
            let blank = " ".repeat(6 + 2 + BYTES_SHOWN * 3 - 1 + 2 + 5);
            let _ = writeln!(text, "{}", format!("{number:>6}  {blank}  {line}").trim_end());
        }
    }
    text
}

/// Bytes as hexadecimal digits, with blanks between.
fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(" ")
}
