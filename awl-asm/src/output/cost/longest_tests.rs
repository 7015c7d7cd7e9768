//! What is told of the longest scan of small programs.

use super::{Assumption, Longest, Missing};
use crate::assemble::assemble;
use crate::output::cost::{Often, Stated, cost_with};
use crate::source::Source;

fn longest_of(text: &str) -> Longest {
    let assembly = assemble(&Source::new("test", text).unwrap(), Vec::new());
    let image = assembly.image.as_deref();
    let image = image.unwrap_or_else(|| panic!("{text}: {:?}", assembly.diagnostics));
    let cost = cost_with(image, &Stated::of(&assembly)).unwrap();
    let native = cost.translated.expect("it can be translated");
    assert_eq!(native.missing, cost.interpreted.missing, "{text}");
    assert_eq!(native.assumptions, cost.interpreted.assumptions, "{text}");
    cost.interpreted
}

fn cycles(text: &str) -> u64 {
    let longest = longest_of(text);
    assert_eq!(longest.missing, [], "{text}");
    longest.program
}

/// Passes that are assumed of the one loop, and whether they are stated.
fn passes(text: &str) -> (u64, bool) {
    let longest = longest_of(text);
    assert_eq!(longest.missing, [], "{text}");
    match longest.assumptions.as_slice() {
        &[Assumption::Passes { most, is_stated, .. }] => (most, is_stated),
        others => panic!("{text}: {others:?}"),
    }
}

#[test]
fn a_loop_counts_as_often_as_it_is_passed() {
    let passes =
        |count: i32, body: &str| cycles(&format!("LD SM0.0\nFOR MW0, 1, {count}\n{body}NEXT\n"));
    let step = passes(2, "") - passes(1, "");
    assert_eq!(passes(12, "") - passes(2, ""), 10 * step);
    let body = "LD SM0.0\nFOR MW2, 1, 3\nNOT\nNEXT\n";
    let nested = passes(2, body) - passes(1, body);
    let not = cycles("LD SM0.0\nNOT\n") - cycles("LD SM0.0\n");
    let more = "LD SM0.0\nFOR MW2, 1, 3\nNOT\nNOT\nNEXT\n";
    assert_eq!(passes(2, more) - passes(1, more), nested + 3 * not);
    assert_eq!(passes(0, body), passes(-5, ""), "a loop that is skipped");
}

#[test]
fn operands_that_are_read_say_how_often_at_most() {
    assert_eq!(passes("LD SM0.0\nFOR MW0, 1, MW2\nNEXT\n"), (32_767, false));
    assert_eq!(passes("LD SM0.0\nFOR MW0, MW2, 1\nNEXT\n"), (32_770, false));
    assert_eq!(passes("LD SM0.0\nFOR MW0, MW2, MW4\nNEXT\n"), (65_536, false));
}

#[test]
fn a_bound_says_it_where_nothing_else_does() {
    for text in [
        "LD SM0.0\n//# bound 7\nFOR MW0, 1, MW2\nNEXT\n",
        "//# bound 7\nLD SM0.0\nFOR MW0, 1, 5\nINCW MW0\nNEXT\n",
        "//# bound 7\nLBL 1\nLD I0.0\nJMP 1\n",
        "//# bound 7\nNETWORK 1\nLBL 1\nNETWORK 2\nLD I0.0\nJMP 1\nNETWORK 3\nLD I0.1\nJMP 1\n",
    ] {
        assert_eq!(passes(text), (7, true), "{text}");
        let ten = cycles(&text.replace("bound 7", "bound 10"));
        assert_eq!(cycles(&text.replace("bound 7", "bound 13")) - ten, ten - cycles(text));
    }
    // What operands say is less.
    let known = "LD SM0.0\n//# bound 9\nFOR MW0, 1, 5\nNEXT\n";
    assert_eq!(cycles(known), cycles("LD SM0.0\nFOR MW0, 1, 5\nNEXT\n"));
}

#[test]
fn what_cannot_be_known_is_said_with_everything_else() {
    for text in [
        "LD SM0.0\nFOR MW0, 1, 5\nINCW MW0\nNEXT\n",
        "LD SM0.0\nFOR MW0, 1, 5\nMOVB 0, MB1\nNEXT\n",
        "LD SM0.0\nFOR MW2, 1, 5\nS M0.0, 17\nNEXT\n",
        "LD SM0.0\nFOR MW0, 1, 5\nMOVD VD0, MD2\nMOVD VD0, MD0\nNEXT\n",
        "LD SM0.0\nMOVD &MB0, AC1\nFOR MW0, 1, 5\nMOVD VD0, *AC1\nNEXT\n",
        "LD SM0.0\nFOR MW8, 1, 5\nFILL 0, MW0, 4\nNEXT\n",
        "LD I0.0\nJMP 1\nLD SM0.0\nFOR MW0, 1, 5\nLBL 1\nNEXT\n",
        "LBL 1\nLD I0.0\nJMP 1\n",
        "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\nLD SM0.0\nFOR MW0, 1, 5\nLD I0.0\nCALL SBR0\nNEXT\n\
         END_ORGANIZATION_BLOCK\nSUBROUTINE_BLOCK A:SBR0\nBEGIN\nLD I0.1\nDECW MW0\n\
         END_SUBROUTINE_BLOCK\n",
    ] {
        let longest = longest_of(text);
        assert!(matches!(longest.missing.as_slice(), [Missing::Bound(_)]), "{text}{longest:?}");
        assert!(longest.program > 0 && longest.scan > longest.program, "{text}");
    }
    // Beside the counted word, or with known counts, nothing changes it.
    cycles("LD SM0.0\nFOR MW2, 1, 5\nMOVB 0, MB1\nMOVW 0, MW4\nS M0.0, 16\nR M4.0, 8\nNEXT\n");
    cycles("LD I0.0\nJMP 1\nLD I0.1\n= Q0.0\nLBL 1\n");
    cycles("LD SM0.0\nFOR MW4, 1, 5\nMOVD VD0, MD0\nMOVD VD0, MD6\nNEXT\n");
}

#[test]
fn of_two_branches_the_longer_one_counts() {
    let branch = |body: &str| cycles(&format!("LD I0.0\nJMP 1\n{body}LBL 1\nLD I0.1\n= Q0.0\n"));
    let (none, one) = (branch(""), branch("LD I0.2\nMOVW 1, VW0\n"));
    assert!(one > none);
    let text = "LD I0.0\nJMP 1\nLD I0.2\nMOVW 1, VW0\nLDN I0.0\nJMP 2\nLBL 1\nLD I0.2\n\
        MOVW 2, VW2\nLBL 2\nLD I0.1\n= Q0.0\n";
    let straight = cycles(&text.replace("JMP 1", "NOT").replace("JMP 2", "NOT"));
    assert!(cycles(text) < straight + 100, "{} {straight}", cycles(text));
}

const BLOCKS: &str = "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\n{}END_ORGANIZATION_BLOCK\n\
    SUBROUTINE_BLOCK A:SBR0\nBEGIN\nLD I0.0\nINCW VW0\nCRET\nLD I0.1\nDECW VW0\n\
    END_SUBROUTINE_BLOCK\nINTERRUPT_BLOCK T:INT0\nBEGIN\nLD SM0.0\nINCW VW2\n\
    END_INTERRUPT_BLOCK\n";

fn blocks(main: &str) -> String {
    BLOCKS.replace("{}", main)
}

#[test]
fn a_routine_counts_for_each_call() {
    let call = "LD I0.5\nCALL SBR0\n";
    let calls = |count: usize| cycles(&blocks(&call.repeat(count)));
    let each = calls(2) - calls(1);
    assert_eq!(calls(5) - calls(2), 3 * each);
    let many = format!("LD SM0.0\nFOR MW0, 1, 10\n{call}NEXT\n");
    assert!(cycles(&blocks(&many)) > 10 * each);
}

#[test]
fn interrupts_count_as_often_as_they_can_be() {
    let attach = |lines: &str| blocks(&format!("LD SM0.1\n{lines}ENI\nLD I0.0\n= Q0.0\n"));
    let timed = longest_of(&attach("MOVB 10, SMB34\nATCH INT0, 10\n"));
    assert!(matches!(
        timed.assumptions.as_slice(),
        [Assumption::Event { number: 10, often: Often::Period(10), .. }]
    ));
    let other = longest_of(&attach("MOVB VB9, SMB34\nATCH INT0, 10\n"));
    assert!(matches!(
        other.assumptions.as_slice(),
        [Assumption::Event { often: Often::Period(1), .. }]
    ));
    let edge = longest_of(&attach("ATCH INT0, 0\n"));
    assert!(matches!(edge.missing.as_slice(), [Missing::Rate(_, 0)]), "{edge:?}");
    let stated = |rate: u32| longest_of(&attach(&format!("//# rate {rate}\nATCH INT0, 0\n")));
    assert_eq!(stated(100).missing, []);
    assert!(edge.program < stated(100).program && stated(100).program < stated(3_000).program);
    assert_eq!(stated(1_000_000).missing, [Missing::NoTimeLeft]);
    let of_routine = attach("ATCH INT0, 0\n").replace("INTERRUPT", "//# rate 100\nINTERRUPT");
    let of_routine = of_routine.replace("END_//# rate 100\n", "END_");
    assert_eq!(longest_of(&of_routine).program, stated(100).program);
}

#[test]
fn counters_need_their_rate() {
    let counter = |line: &str| format!("LD SM0.1\n{line}HDEF 0, 0\nHSC 0\n");
    assert!(matches!(longest_of(&counter("")).missing.as_slice(), [Missing::Pulses(_)]));
    let at = |rate: u32| longest_of(&counter(&format!("//# rate {rate}\n"))).scan;
    assert!(at(30_000) > at(10));
}
