//! Keywords of structured text and of the blocks of other systems.

use super::row::Here::{Block, Like, Nothing};
use super::row::{Row, named, row};

const IF: &str = "AWL has no IF: a contact is before what it is for, as in `LD I0.0`, `= Q0.0`; or \
     jump over it with `JMP 1` and `LBL 1`";
const LOOP: &str = "AWL loops with `FOR VW0, 1, 10` and `NEXT`, after a contact such as `LD SM0.0`";
const REPEAT: &str = "AWL has no WHILE and no REPEAT: what the scan itself can repeat needs no \
     loop. Within a scan it is `LBL 1`, then what is repeated, then `LDW< VW0, 10` and `JMP 1`, \
     which goes back while the comparison is true";
const CASE: &str = "AWL has no CASE: a comparison is before what it is for, such as `LDW= VW0, 1`";
const BLOCKS: &str = "the blocks of an S7-200 are `ORGANIZATION_BLOCK MAIN:OB1`, \
     `SUBROUTINE_BLOCK Name:SBR0` and `INTERRUPT_BLOCK Name:INT0`; a program without blocks is \
     fine";
const RETURN: &str = "`CRET` leaves a subroutine with power flow; at the end of one nothing is \
     needed";
const TYPES: &str = "AWL has no own types: variables are declared by `//# var Speed INT`, arrays \
     by `//# var Table ARRAY[0..9] OF INT`";
const LEAVE_OUT: &str = "leave the line out: an S7-200 does not need it";

pub(super) const ROWS: &[Row] = &[
    row(&["IF", "THEN", "ELSE", "ELSIF", "ELSEIF", "END_IF", "ENDIF"], Nothing, IF),
    named(&[], &["WENN", "DANN", "SONST", "ENDE_WENN"], Nothing, IF),
    row(&["CASE", "END_CASE", "SWITCH"], Nothing, CASE),
    row(&["WHILE", "END_WHILE", "REPEAT", "UNTIL", "END_REPEAT"], Nothing, REPEAT),
    row(&["DO"], Nothing, LOOP),
    row(&["END_FOR", "ENDFOR"], Like("NEXT"), LOOP),
    row(
        &["EXIT"],
        Nothing,
        "a loop of `FOR VW0, 1, 10` and `NEXT` ends early by its counter: `MOVW 10, VW0` makes \
         this round the last",
    ),
    row(&["RETURN"], Nothing, RETURN),
    row(
        &[
            "FUNCTION",
            "FUNCTION_BLOCK",
            "PROGRAM",
            "END_FUNCTION",
            "END_FUNCTION_BLOCK",
            "END_PROGRAM",
            "END_SUBROUTINE",
        ],
        Block,
        BLOCKS,
    ),
    row(&["OB1", "MAIN"], Nothing, BLOCKS),
    named(
        &[],
        &[
            "UNTERPROGRAMM",
            "HAUPTPROGRAMM",
            "INTERRUPTPROGRAMM",
            "ORGANISATIONSBAUSTEIN",
            "FUNKTION",
            "FUNKTIONSBAUSTEIN",
            "PROGRAMM",
            "END_FUNKTION",
            "ENDE_FUNKTION",
            "END_FUNKTIONSBAUSTEIN",
            "ENDE_FUNKTIONSBAUSTEIN",
            "END_UNTERPROGRAMM",
            "ENDE_UNTERPROGRAMM",
            "END_HAUPTPROGRAMM",
            "ENDE_HAUPTPROGRAMM",
            "END_INTERRUPTPROGRAMM",
            "ENDE_INTERRUPTPROGRAMM",
            "END_ORGANISATIONSBAUSTEIN",
            "ENDE_ORGANISATIONSBAUSTEIN",
        ],
        Block,
        BLOCKS,
    ),
    row(&["TYPE", "END_TYPE", "STRUCT", "END_STRUCT", "CONST", "ARRAY"], Nothing, TYPES),
    row(
        &["VAR_GLOBAL", "VAR_EXTERNAL", "VAR_STATIC"],
        Nothing,
        "variables of the whole program are declared by `//# var Speed INT`",
    ),
    row(
        &["VERSION", "AUTHOR", "FAMILY", "NAME", "REGION", "END_REGION", "KNOW_HOW_PROTECT"],
        Nothing,
        LEAVE_OUT,
    ),
    named(&[], &["TITEL"], Nothing, "a title is after NETWORK and `//`: `NETWORK 1 // title`"),
    row(
        &["#DEFINE", "#INCLUDE", "INCLUDE"],
        Nothing,
        "names are declared by `//# symbol Start I0.0`",
    ),
];
