//! The statement list of S7-300, S7-400 and the TIA portal, as far as an S7-200 has it otherwise or
//! not at all. In both languages.

use super::row::Here::{Instruction, Like, Mnemonic, Nothing, Sized};
use super::row::{Row, named, row};

const NO_ACCUMULATORS: &str = "an S7-200 has no accumulators between load and transfer: leave the \
     instruction out and name the operands, as in `MOVW VW0, VW2` or `+I VW0, VW2`";
const NO_DATA_BLOCKS: &str =
    "an S7-200 has no data blocks to open: leave the line out and use V memory, such as `VW0`";
const POINTERS: &str =
    "on an S7-200 a pointer is a double word: `MOVD &VB100, AC1`, then `*AC1` is what it points to";
const NO_MASTER_RELAY: &str = "an S7-200 has no master control relay: put the contact into each \
     rung, or jump over them with `JMP 1` and `LBL 1`";
const BY_ZERO: &str = "on an S7-200 a comparison is before the jump: `LDW= VW0, 0`, then `JMP 1`; \
     `LBL 1` is where it goes";
const BY_OTHER: &str = "on an S7-200 a comparison is before the jump: `LDW<> VW0, 0`, then \
     `JMP 1`; `LBL 1` is where it goes";
const BY_NEGATIVE: &str = "on an S7-200 a comparison is before the jump: `LDW< VW0, 0`, then \
     `JMP 1`; `LBL 1` is where it goes";
const BY_ZERO_OR_MORE: &str = "on an S7-200 a comparison is before the jump: `LDW>= VW0, 0`, then \
     `JMP 1`; `LBL 1` is where it goes";
const BY_ZERO_OR_LESS: &str = "on an S7-200 a comparison is before the jump: `LDW<= VW0, 0`, then \
     `JMP 1`; `LBL 1` is where it goes";
const BY_FLAG: &str =
    "on an S7-200 the flag is a bit: `LD SM1.1` (overflow), then `JMP 1`; `LBL 1` is where it goes";
const BY_BIT: &str = "on an S7-200 labels are numbers: `JMP 1` jumps with power flow (`NOT` before \
     it without), `LBL 1` is where it goes";
const AND_BRACKET: &str = "an S7-200 has no brackets: begin what is inside with `LD`, and where a \
     contact is before it end it with `ALD`";
const OR_BRACKET: &str = "an S7-200 has no brackets: begin what is inside with `LD`, and where a \
     contact is before it end it with `OLD`";
const NO_EXCLUSIVE_OR: &str = "on an S7-200 that is `LD I0.0`, `AN I0.1`, `LDN I0.0`, `A I0.1`, \
     `OLD`: one bit or the other, not both";
const BOTH_OR_NONE: &str = "on an S7-200 that is `LD I0.0`, `A I0.1`, `LDN I0.0`, `AN I0.1`, \
     `OLD`: both bits or none";
const PULSE: &str = "an S7-200 has no pulse timers: set a bit with `EU` and `S M0.0, 1`, let \
     `TON T37, 20` run while it is 1, and reset it with `R M0.0, 1` when T37 is";
const ON_DELAY: &str =
    "on an S7-200 an on-delay is `TON T37, 20` (20 times 100 ms) after the contact";
const BCD: &str = "on an S7-200 numbers are not BCD: compare and copy `C1` or `T37` as words; \
     `IBCD VW0` makes BCD";
const END_OF_BLOCK: &str = "leave the line out where it is the last of its unit; elsewhere \
     `LD SM0.0` and `CRET` leave a subroutine, `LD SM0.0` and `END` the main program";
const CONDITIONAL_END: &str = "on an S7-200 `CRET` leaves a subroutine while the contact before it \
     is 1, `END` the main program, `CRETI` an interrupt routine";
const NO_CALL_LISTS: &str = "on an S7-200 that is `CALL SBR1`, and the block begins with \
     `SUBROUTINE_BLOCK Name:SBR1`";
const ROTATE_THROUGH: &str = "an S7-200 rotates without a further bit: `RLD VD0, 1`, `RRD VD0, 1`";
const ROUND: &str = "an S7-200 rounds to the nearest with `ROUND VD0, VD4` and towards 0 with \
     `TRUNC VD0, VD4`";

pub(super) const ROWS: &[Row] = &[
    // Load and transfer, accumulators.
    row(
        &["L"],
        Nothing,
        "on an S7-200 one instruction names both operands: `MOVW VW0, VW2` copies (of bytes \
         `MOVB`, of double words `MOVD`), `+I VW0, VW2` adds, `LDW> VW0, VW2` compares",
    ),
    row(
        &["T"],
        Nothing,
        "on an S7-200 that is one instruction with the operand of the load (`L`), after a contact \
         such as `LD SM0.0`: `MOVW VW0, VW2`, of bytes `MOVB`, of double words `MOVD`",
    ),
    row(&["LC"], Nothing, BCD),
    row(&["TAK", "PUSH", "POP", "ENT", "LEAVE"], Nothing, NO_ACCUMULATORS),
    named(
        &["CAW"],
        &["TAW"],
        Nothing,
        "on an S7-200 that is `SWAP VW0`: it exchanges the two bytes of a word",
    ),
    named(
        &["CAD"],
        &["TAD"],
        Nothing,
        "on an S7-200 that is `SWAP VW0`, `SWAP VW2` and `RLD VD0, 16`",
    ),
    row(&["LAR1", "LAR2", "TAR1", "TAR2", "+AR1", "+AR2"], Nothing, POINTERS),
    named(&["CAR"], &["TAR"], Nothing, POINTERS),
    named(&["OPN"], &["AUF"], Nothing, NO_DATA_BLOCKS),
    named(&["CDB"], &["TDB"], Nothing, NO_DATA_BLOCKS),
    // Bit logic.
    row(&["A("], Nothing, AND_BRACKET),
    row(
        &["AN("],
        Nothing,
        "an S7-200 has no brackets: begin what is inside with `LD`, end it with `NOT` and `ALD`",
    ),
    named(&[], &["U("], Nothing, AND_BRACKET),
    named(
        &[],
        &["UN("],
        Nothing,
        "an S7-200 has no brackets: begin what is inside with `LD`, end it with `NOT` and `ALD`",
    ),
    row(&["O("], Nothing, OR_BRACKET),
    row(
        &["ON("],
        Nothing,
        "an S7-200 has no brackets: begin what is inside with `LD`, end it with `NOT` and `OLD`",
    ),
    row(&["X("], Nothing, NO_EXCLUSIVE_OR),
    row(&["XN(", "XN"], Nothing, BOTH_OR_NONE),
    row(
        &[")"],
        Nothing,
        "an S7-200 has no brackets: what is inside begins with `LD`, and where a contact is before \
         it, `ALD` (AND) or `OLD` (OR) ends it",
    ),
    row(&["X", "XO"], Nothing, NO_EXCLUSIVE_OR),
    row(&["FP"], Instruction("EU"), "an S7-200 remembers the edge by itself: `EU` has no operand"),
    row(&["FN"], Instruction("ED"), "an S7-200 remembers the edge by itself: `ED` has no operand"),
    row(&["SET"], Mnemonic("S"), "the number of bits is named, too: `S Q0.0, 1`"),
    row(
        &["CLR"],
        Nothing,
        "on an S7-200 `LDN SM0.0` loads 0, `R Q0.0, 1` resets a bit, `MOVW 0, VW0` clears a word",
    ),
    row(
        &["SAVE"],
        Nothing,
        "on an S7-200 the result is kept in a bit: `= M0.0`, and read by `LD M0.0`",
    ),
    named(&[], &["NICHT"], Mnemonic("NOT"), "of one operand it is `LDN`, `AN` or `ON`"),
    row(&["BLD"], Nothing, "leave the line out: it only concerns how STEP 7 draws a network"),
    // Jumps and ends.
    named(
        &["JU"],
        &["SPA"],
        Nothing,
        "on an S7-200 that is `LD SM0.0`, `JMP 1`; labels are numbers, and `LBL 1` is where it goes",
    ),
    named(&["JC"], &["SPB"], Mnemonic("JMP"), BY_BIT),
    named(&["JCN"], &["SPBN"], Like("JMP"), BY_BIT),
    named(&["JCB", "JNB", "JBI", "JNBI"], &["SPBB", "SPBNB", "SPBI", "SPBIN"], Like("JMP"), BY_BIT),
    named(&["JZ"], &["SPZ"], Nothing, BY_ZERO),
    named(&["JN"], &["SPN"], Nothing, BY_OTHER),
    named(&["JM"], &["SPM"], Nothing, BY_NEGATIVE),
    named(&["JPZ"], &["SPPZ"], Nothing, BY_ZERO_OR_MORE),
    named(&["JMZ"], &["SPMZ"], Nothing, BY_ZERO_OR_LESS),
    named(
        &["JP"],
        &["SPP"],
        Nothing,
        "`JMP 1` jumps with power flow; if a number is positive, the comparison \
         `LDW> VW0, 0` is before it. `LBL 1` is where it goes",
    ),
    named(&["JO", "JOS", "JUO"], &["SPO", "SPS", "SPU"], Nothing, BY_FLAG),
    named(
        &["JL"],
        &["SPL"],
        Nothing,
        "an S7-200 has no list of jumps: one comparison and one jump for each value, such as \
         `LDW= VW0, 2` and `JMP 2`",
    ),
    row(
        &["LOOP"],
        Nothing,
        "on an S7-200 a loop is between `FOR VW0, 1, 10` and `NEXT`, with a contact before FOR",
    ),
    row(&["BE"], Nothing, "leave the line out: a unit of an S7-200 ends with its last line"),
    named(&["BEU"], &["BEA"], Nothing, END_OF_BLOCK),
    named(&["BEC"], &["BEB"], Nothing, CONDITIONAL_END),
    row(&["MEND"], Nothing, "leave the line out: a program ends with its last line"),
    row(&["UC", "CC"], Nothing, NO_CALL_LISTS),
    row(&["MCR(", ")MCR", "MCRA", "MCRD", "MCR", "MC"], Nothing, NO_MASTER_RELAY),
    // Timers and counters.
    row(&["SP", "SV"], Nothing, PULSE),
    row(
        &["SE"],
        Like("TON"),
        "on an S7-200 an on-delay (`SE` in German STEP 7) is `TON T37, 20`, 20 times 100 ms; an \
         extended pulse (`SE` in international STEP 7) is made of `EU`, `S`, `TON` and `R`",
    ),
    row(&["SD"], Like("TON"), ON_DELAY),
    row(
        &["SS"],
        Mnemonic("TONR"),
        "on an S7-200 a retentive on-delay is `TONR T5, 20` (20 times 100 ms), and `R T5, 1` \
         resets it",
    ),
    named(
        &["SF"],
        &["SA"],
        Mnemonic("TOF"),
        "on an S7-200 an off-delay is `TOF T37, 20` (20 times 100 ms)",
    ),
    row(&["FR"], Nothing, "leave the line out: timers and counters of an S7-200 need no release"),
    row(
        &["CU"],
        Mnemonic("CTU"),
        "on an S7-200 `CTU C1, 10` has two loads before it: the first counts, the second resets",
    ),
    row(
        &["CD"],
        Mnemonic("CTD"),
        "on an S7-200 `CTD C1, 10` has two loads before it: the first counts, the second loads",
    ),
    // Arithmetic, words.
    row(&["+"], Nothing, "on an S7-200 that is `+I 5, VW0`: the constant is added to the word"),
    row(
        &["MOD"],
        Nothing,
        "on an S7-200 the remainder comes with `DIV VW4, VD0`: it divides VW2 and leaves the \
         remainder in VW0, the quotient in VW2",
    ),
    row(
        &["ABS"],
        Nothing,
        "on an S7-200 that is `LDW< VW0, 0`, then `INVW VW0` and `INCW VW0`; of a real `LDR< VD0, \
         0.0` and `*R -1.0, VD0`",
    ),
    row(
        &["NEGI", "NEG"],
        Nothing,
        "on an S7-200 that is `*I -1, VW0`, or `INVW VW0` and `INCW VW0`",
    ),
    row(&["NEGD"], Nothing, "on an S7-200 that is `*D -1, VD0`, or `INVD VD0` and `INCD VD0`"),
    row(&["NEGR"], Nothing, "on an S7-200 that is `*R -1.0, VD0`"),
    row(&["INVI"], Mnemonic("INVW"), "on an S7-200 the operand is named: `INVW VW0`"),
    row(
        &["SQR"],
        Nothing,
        "on an S7-200 a square is `MOVR VD0, VD4` and `*R VD0, VD4`; the root is `SQRT`",
    ),
    row(
        &["ASIN", "ACOS", "ATAN"],
        Nothing,
        "an S7-200 has `SIN`, `COS` and `TAN` only, not their inverses",
    ),
    row(&["RND"], Mnemonic("ROUND"), "on an S7-200 both operands are named: `ROUND VD0, VD4`"),
    row(&["RND+", "RND-", "CEIL", "FLOOR"], Nothing, ROUND),
    row(
        &["SSI"],
        Nothing,
        "an S7-200 shifts without the sign: `SRW VW0, 1`; a signed number is halved by `/I 2, VW0`",
    ),
    row(
        &["SSD"],
        Nothing,
        "an S7-200 shifts without the sign: `SRD VD0, 1`; a signed number is halved by `/D 2, VD0`",
    ),
    row(&["RLDA", "RRDA"], Nothing, ROTATE_THROUGH),
    row(&["XOW"], Mnemonic("XORW"), "on an S7-200 both operands are named: `XORW VW0, VW2`"),
    row(&["XOD"], Mnemonic("XORD"), "on an S7-200 both operands are named: `XORD VD0, VD4`"),
    row(&["BTD"], Nothing, "an S7-200 converts BCD in words: `BCDI VW0`, then `ITD VW0, VD4`"),
    row(&["DTB"], Nothing, "an S7-200 makes BCD of words: `DTI VD0, VW4`, then `IBCD VW4`"),
    row(
        &["==I", "==D", "==R"],
        Nothing,
        "on an S7-200 a comparison is a contact with both operands: `LDW= VW0, VW2` for words, \
         `LDD= VD0, VD4` for double words, `LDR= VD0, VD4` for reals",
    ),
    row(
        &["<>I", "<>D", "<>R"],
        Nothing,
        "on an S7-200 a comparison is a contact with both operands: `LDW<> VW0, VW2` for words, \
         `LDD<> VD0, VD4` for double words, `LDR<> VD0, VD4` for reals",
    ),
    row(
        &[">I", ">D", ">R"],
        Nothing,
        "on an S7-200 a comparison is a contact with both operands: `LDW> VW0, VW2` for words, \
         `LDD> VD0, VD4` for double words, `LDR> VD0, VD4` for reals",
    ),
    row(
        &["<I", "<D", "<R"],
        Nothing,
        "on an S7-200 a comparison is a contact with both operands: `LDW< VW0, VW2` for words, \
         `LDD< VD0, VD4` for double words, `LDR< VD0, VD4` for reals",
    ),
    row(
        &[">=I", ">=D", ">=R"],
        Nothing,
        "on an S7-200 a comparison is a contact with both operands: `LDW>= VW0, VW2` for words, \
         `LDD>= VD0, VD4` for double words, `LDR>= VD0, VD4` for reals",
    ),
    row(
        &["<=I", "<=D", "<=R"],
        Nothing,
        "on an S7-200 a comparison is a contact with both operands: `LDW<= VW0, VW2` for words, \
         `LDD<= VD0, VD4` for double words, `LDR<= VD0, VD4` for reals",
    ),
    row(
        &["INC"],
        Sized(["", "INCB", "INCW", "INCD", ""], "INCW"),
        "on an S7-200 the operand is named: `INCB VB0`, `INCW VW0`, `INCD VD0`",
    ),
    row(
        &["DEC"],
        Sized(["", "DECB", "DECW", "DECD", ""], "DECW"),
        "on an S7-200 the operand is named: `DECB VB0`, `DECW VW0`, `DECD VD0`",
    ),
];
