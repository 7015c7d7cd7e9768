//! Words of the instruction lists of other makers, and the full words of which mnemonics are made.

use super::row::Here::{Like, Mnemonic, Nothing, Routine, Sized};
use super::row::{Row, named, row};

const BITS_OR_WORDS: &str = "of bits it is `A`, of bytes `ANDB`, of words `ANDW`, of double words \
     `ANDD`";
const BITS_OR_WORDS_OR: &str = "of bits it is `O`, of bytes `ORB`, of words `ORW`, of double words \
     `ORD`";
const ADDS_TO: &str = "words are added by `+I`, double words by `+D`, reals by `+R`, always to the \
     second operand: `+I VW0, VW2`";
const SUBTRACTS: &str = "words are subtracted by `-I`, double words by `-D`, reals by `-R`, always \
     from the second operand: `-I VW0, VW2`";
const COMPARE: &str = "on an S7-200 a comparison is a contact with both operands, such as \
     `LDW= VW0, VW2`; the relations are `=` `<>` `>` `<` `>=` `<=`";
const TIMER: &str = "a timer has its number and its preset: `TON T37, 20`, 20 times 100 ms";
const COUNTER: &str = "a counter has its number and its preset: `CTU C1, 10`, and two loads before \
     it: the first counts, the second resets";
const JUMP: &str = "labels are numbers: `JMP 1`, and `LBL 1` where it goes";
const BRANCH: &str = "on an S7-200 a branch begins with `LD` and ends with `OLD`, or with `ALD` \
     where it follows another";

pub(super) const ROWS: &[Row] = &[
    row(
        &["OUT", "ST", "OUTPUT", "COIL", "OTE"],
        Sized(["=", "", "", "", ""], "="),
        "a bit is written by `=`; a value is copied by `MOVW`, which names both operands: \
         `LD SM0.0`, `MOVW VW0, VW2`; bytes by `MOVB`, double words by `MOVD`",
    ),
    row(
        &["STN", "OUTNOT"],
        Nothing,
        "on an S7-200 that is `NOT` and `= Q0.0`: a coil does not invert",
    ),
    row(&["AND"], Sized(["A", "ANDB", "ANDW", "ANDD", ""], "A"), BITS_OR_WORDS),
    named(&[], &["UND"], Sized(["A", "ANDB", "ANDW", "ANDD", ""], "A"), BITS_OR_WORDS),
    row(&["ANDN", "ANDNOT"], Mnemonic("AN"), ""),
    named(&[], &["UNDN", "UNDNICHT", "UNICHT"], Mnemonic("AN"), ""),
    row(&["OR"], Sized(["O", "ORB", "ORW", "ORD", ""], "O"), BITS_OR_WORDS_OR),
    named(&[], &["ODER"], Sized(["O", "ORB", "ORW", "ORD", ""], "O"), BITS_OR_WORDS_OR),
    row(&["ORN", "ORNOT", "ORI"], Mnemonic("ON"), ""),
    named(&[], &["ODERN", "ODERNICHT", "ONICHT"], Mnemonic("ON"), ""),
    row(
        &["XOR"],
        Sized(["", "XORB", "XORW", "XORD", ""], ""),
        "of bytes it is `XORB`, of words `XORW`, of double words `XORD`; of bits `LD I0.0`, \
         `AN I0.1`, `LDN I0.0`, `A I0.1`, `OLD`",
    ),
    row(
        &["XORN"],
        Nothing,
        "of two bits that is `LD I0.0`, `A I0.1`, `LDN I0.0`, `AN I0.1`, `OLD`: both or none; of \
         values `XORW VW0, VW2`, `INVW VW2`",
    ),
    row(&["LOAD"], Mnemonic("LD"), ""),
    named(
        &[],
        &["LADE", "LADEN"],
        Sized(["LD", "", "", "", ""], "LD"),
        "of a bit it is `LD`; a value is copied by `MOVW`, bytes by `MOVB`, double words by `MOVD`",
    ),
    row(&["LDNOT", "LOADN", "LDNT"], Mnemonic("LDN"), ""),
    row(&["XIO"], Like("LDN"), "the first contact of a rung is `LDN`, those after it `AN` or `ON`"),
    row(&["XIC"], Like("LD"), "the first contact of a rung is `LD`, those after it `A` or `O`"),
    row(
        &["RST", "RES", "RESET", "OTU"],
        Mnemonic("R"),
        "the number of bits is named, too: `R Q0.0, 1`",
    ),
    row(&["OTL", "LATCH"], Mnemonic("S"), "the number of bits is named, too: `S Q0.0, 1`"),
    row(&["UNLATCH"], Mnemonic("R"), "the number of bits is named, too: `R Q0.0, 1`"),
    named(
        &[],
        &["SETZE", "SETZEN"],
        Mnemonic("S"),
        "the number of bits is named, too: `S Q0.0, 1`",
    ),
    named(
        &[],
        &["RUECKSETZEN", "RÜCKSETZEN", "LÖSCHE", "LOESCHE"],
        Mnemonic("R"),
        "the number of bits is named, too: `R Q0.0, 1`",
    ),
    row(&["ANB", "ANDLD"], Mnemonic("ALD"), ""),
    row(&["ORLD", "ORBLOCK"], Mnemonic("OLD"), ""),
    row(&["MPS"], Mnemonic("LPS"), ""),
    row(&["MRD"], Mnemonic("LRD"), ""),
    row(&["MPP"], Mnemonic("LPP"), ""),
    row(&["BST", "NXB", "BND"], Nothing, BRANCH),
    row(
        &["DIFU", "OSR", "ONS", "PLSR"],
        Like("EU"),
        "on an S7-200 `EU` after the contact is 1 for one scan: `LD I0.0`, `EU`, `= M0.0`",
    ),
    row(
        &["DIFD", "OSF", "PLF"],
        Like("ED"),
        "on an S7-200 `ED` after the contact is 1 for one scan: `LD I0.0`, `ED`, `= M0.0`",
    ),
    row(
        &["EDGE", "R_EDGE", "RISING", "RISE", "POS", "UP_EDGE", "DIFF_UP"],
        Like("EU"),
        "on an S7-200 `EU` after the contact is 1 for one scan: `LD I0.0`, `EU`, `= M0.0`",
    ),
    row(
        &["F_EDGE", "FALLING", "FALL", "DOWN_EDGE", "DIFF_DOWN"],
        Like("ED"),
        "on an S7-200 `ED` after the contact is 1 for one scan: `LD I0.0`, `ED`, `= M0.0`",
    ),
    named(
        &[],
        &["FLANKE", "FLANKEP"],
        Like("EU"),
        "on an S7-200 `EU` after the contact is 1 for one scan: `LD I0.0`, `EU`, `= M0.0`",
    ),
    row(
        &["ALT", "ALTP", "TOGGLE", "FLIPFLOP", "T_FF", "TFF", "INVERT"],
        Like("="),
        "on an S7-200 a press changes an output by `LD I0.0`, `EU`, `= M0.0`, then `LD M0.0`, \
         `AN Q0.0`, `LDN M0.0`, `A Q0.0`, `OLD`, `= Q0.0`",
    ),
    row(
        &["BLINK", "FLASH", "FLASHER"],
        Like("="),
        "on an S7-200 SM0.5 blinks in seconds: `LD I0.0`, `A SM0.5`, `= Q0.0`; other times are \
         timers: `LDN T37`, `TON T37, 10`",
    ),
    named(
        &["PULSE"],
        &["IMPULS"],
        Nothing,
        "a pulse of one scan is `EU` after the contact; a longer one is `EU`, `S M0.0, 1`, then \
         `LD M0.0`, `TON T37, 20` and `LD T37`, `R M0.0, 1`",
    ),
    row(&["REM", "COMMENT", "NOTE"], Nothing, "a comment begins with //"),
    named(&[], &["KOMMENTAR", "BEMERKUNG"], Nothing, "a comment begins with //"),
    row(
        &["PRINT", "PRINTF", "WRITE", "SERIAL"],
        Nothing,
        "a program of an S7-200 shows nothing by itself: `uno200 show` shows its values, and \
         characters are sent by `XMT VB100, 0`",
    ),
    row(
        &["FEND", "SRET", "IRET", "ENDP", "EOF"],
        Nothing,
        "leave the line out: a program and a block end with their last line",
    ),
    row(&["DMOV", "DMOVP", "MOVL"], Mnemonic("MOVD"), "double words are copied by `MOVD VD0, VD4`"),
    row(
        &["MOVP", "@MOV", "INCP", "DECP", "ADDP", "SUBP"],
        Nothing,
        "what is done once for a press has `EU` after the contact: `LD I0.0`, `EU`, `MOVW VW0, \
         VW2`",
    ),
    row(
        &["XFER"],
        Nothing,
        "on an S7-200 blocks are copied by `BMB`, `BMW` and `BMD`: `BMW VW0, VW100, 10`",
    ),
    row(
        &["SFT", "SFTL", "SFTR", "SHIFT", "BSL", "BSR", "WSFT"],
        Nothing,
        "on an S7-200 a register of bits is `SHRB I0.0, V0.0, 8`, with `EU` before it; a value is \
         shifted by `SLW VW0, 1` and `SRW VW0, 1`",
    ),
    row(&["LDP"], Nothing, "on an S7-200 that is `LD I0.0` and `EU`"),
    row(&["LDF"], Nothing, "on an S7-200 that is `LD I0.0` and `ED`"),
    row(
        &["INV"],
        Sized(["NOT", "INVB", "INVW", "INVD", ""], "NOT"),
        "`NOT` inverts the result of the contacts, `INVB`, `INVW` and `INVD` the bits of a value",
    ),
    row(&["ADD"], Sized(["", "", "+I", "+D", "+R"], "+I"), ADDS_TO),
    row(&["ADDI"], Mnemonic("+I"), ""),
    row(&["SUB"], Sized(["", "", "-I", "-D", "-R"], "-I"), SUBTRACTS),
    row(&["SUBI"], Mnemonic("-I"), ""),
    row(&["MULI"], Mnemonic("*I"), ""),
    row(&["DIVI"], Mnemonic("/I"), ""),
    row(
        &["MOV", "MOVE"],
        Sized(["", "MOVB", "MOVW", "MOVD", "MOVR"], "MOVW"),
        "bytes are copied by `MOVB`, words by `MOVW`, double words by `MOVD`, reals by `MOVR`; a \
         bit by `LD I0.0` and `= M0.0`",
    ),
    row(
        &["SHL", "SL"],
        Sized(["", "SLB", "SLW", "SLD", ""], ""),
        "bytes are shifted by `SLB`, words by `SLW`, double words by `SLD`, with the count: \
         `SLW VW0, 1`",
    ),
    row(
        &["SHR", "SR"],
        Sized(["", "SRB", "SRW", "SRD", ""], ""),
        "bytes are shifted by `SRB`, words by `SRW`, double words by `SRD`, with the count: \
         `SRW VW0, 1`. The box of set and reset is `S Q0.0, 1` and `R Q0.0, 1`",
    ),
    row(
        &["ROL", "RL"],
        Sized(["", "RLB", "RLW", "RLD", ""], ""),
        "bytes are rotated by `RLB`, words by `RLW`, double words by `RLD`, with the count: \
         `RLW VW0, 1`",
    ),
    row(
        &["ROR", "RR"],
        Sized(["", "RRB", "RRW", "RRD", ""], ""),
        "bytes are rotated by `RRB`, words by `RRW`, double words by `RRD`, with the count: \
         `RRW VW0, 1`",
    ),
    row(
        &["RS", "KEEP"],
        Nothing,
        "on an S7-200 that is a rung with `S Q0.0, 1` and a rung with `R Q0.0, 1`: the later one \
         wins",
    ),
    row(&["CMP", "COMP", "CP", "COMPARE"], Nothing, COMPARE),
    named(&[], &["VGL", "VERGLEICH"], Nothing, COMPARE),
    row(&["EQU"], Nothing, "on an S7-200 that is a contact: `LDW= VW0, 5`"),
    row(&["NEQ"], Nothing, "on an S7-200 that is a contact: `LDW<> VW0, 5`"),
    row(&["GRT"], Nothing, "on an S7-200 that is a contact: `LDW> VW0, 5`"),
    row(&["LES"], Nothing, "on an S7-200 that is a contact: `LDW< VW0, 5`"),
    row(&["GEQ"], Nothing, "on an S7-200 that is a contact: `LDW>= VW0, 5`"),
    row(&["LEQ"], Nothing, "on an S7-200 that is a contact: `LDW<= VW0, 5`"),
    row(&["TIM", "TIMER", "TMR", "TIMH"], Mnemonic("TON"), TIMER),
    named(&[], &["ZEIT", "TE", "TEV"], Mnemonic("TON"), TIMER),
    named(
        &[],
        &["TA", "TAV"],
        Mnemonic("TOF"),
        "an off-delay has its number and its preset: `TOF T37, 20`",
    ),
    row(
        &["RTO"],
        Mnemonic("TONR"),
        "a retentive timer has its number and its preset: `TONR T5, 20`",
    ),
    row(&["CNT", "COUNT", "COUNTER"], Mnemonic("CTU"), COUNTER),
    named(&[], &["ZAEHLER", "ZÄHLER"], Mnemonic("CTU"), COUNTER),
    row(&["JUMP", "CJ"], Mnemonic("JMP"), JUMP),
    named(&[], &["SPRUNG", "SPRINGE"], Mnemonic("JMP"), JUMP),
    row(&["GOTO"], Nothing, "on an S7-200 that is `LD SM0.0`, `JMP 1`; `LBL 1` is where it goes"),
    row(&["LABEL"], Mnemonic("LBL"), ""),
    named(&[], &["MARKE"], Mnemonic("LBL"), "a label is a number: `LBL 1`"),
    row(&["JSR", "GOSUB", "CALLSUB", "SUBR"], Routine, "on an S7-200 that is `CALL SBR0`"),
    row(
        &["NW", "SEGMENT", "RUNG"],
        Mnemonic("NETWORK"),
        "a network begins with its number, and its title is after //: `NETWORK 1 // title`",
    ),
    named(
        &[],
        &["NETZWERK"],
        Mnemonic("NETWORK"),
        "a network begins with its number, and its title is after //: `NETWORK 1 // title`",
    ),
    row(&["ORGANISATION_BLOCK"], Mnemonic("ORGANIZATION_BLOCK"), ""),
    row(&["END_ORGANISATION_BLOCK"], Mnemonic("END_ORGANIZATION_BLOCK"), ""),
    row(&["EI"], Mnemonic("ENI"), ""),
    row(&["DI"], Mnemonic("DISI"), ""),
    row(&["HALT"], Mnemonic("STOP"), ""),
    row(&["JMPC", "JPC"], Mnemonic("JMP"), JUMP),
    row(
        &["JMPN", "JPN", "JMPCN", "JPCN"],
        Like("JMP"),
        "on an S7-200 a jump without power flow is `NOT` and `JMP 1`; `LBL 1` is where it goes",
    ),
    row(
        &["STEP", "STL", "SFC", "TRANS", "INITIAL_STEP"],
        Nothing,
        "a step of an S7-200 is a segment: `LSCR S0.0` begins it, `SCRT S0.1` after a contact goes \
         on to the next, `SCRE` ends it",
    ),
    row(
        &["CTR"],
        Nothing,
        "a counter of an S7-200 is `CTU C1, 10` (up), `CTD C1, 10` (down) or `CTUD C1, 10` (both)",
    ),
    row(
        &["WAIT", "DELAY", "SLEEP"],
        Nothing,
        "a program of an S7-200 never waits: `TON T37, 20` runs while the contact before it is 1, \
         and `LD T37` is 1 when its time is over",
    ),
    named(&[], &["ZUW", "ZUWEISEN", "ZUWEISUNG", "AUSGANG"], Mnemonic("="), ""),
    row(&["ZRST"], Nothing, "on an S7-200 several bits are reset by `R M0.0, 8`"),
    row(
        &["IL", "ILC"],
        Nothing,
        "an S7-200 has no interlock: jump over the rungs with `JMP 1` and `LBL 1`",
    ),
    row(
        &["DIGITALWRITE", "ANALOGWRITE"],
        Nothing,
        "on a PLC an output is written by a rung: a condition such as `LD I0.0`, then `= Q0.0`; \
         an analog output by `MOVW VW0, AQW0`",
    ),
    row(
        &["DIGITALREAD", "ANALOGREAD", "PINMODE"],
        Nothing,
        "on a PLC inputs are read before each scan: `LD I0.0` is one, `AIW0` an analog one",
    ),
    row(
        &["VOID", "{", "}", "};", "INT", "BOOL", "FLOAT"],
        Nothing,
        "leave the line out: the scan is the loop, and its rungs are contacts and coils such as \
         `LD I0.0`, `= Q0.0`; a variable is `//# var Speed INT`",
    ),
    row(&["ITR"], Nothing, "on an S7-200 that is `ITD VW0, VD4` and `DTR VD4, VD4`"),
    row(&["RTI"], Nothing, "on an S7-200 that is `ROUND VD0, VD4` and `DTI VD4, VW8`"),
    row(
        &["SCR"],
        Nothing,
        "a segment begins with `LSCR S0.1`, `SCRT S0.2` goes on to another, `SCRE` ends it",
    ),
    named(&[], &["ENDE"], Nothing, "leave the line out: a program ends with its last line"),
    row(&["BIN"], Nothing, "on an S7-200 `BCDI VW0` makes a number of the BCD digits in VW0"),
    row(&["BCD"], Nothing, "on an S7-200 `IBCD VW0` makes BCD digits of the number in VW0"),
    row(
        &["BMOV"],
        Nothing,
        "on an S7-200 blocks are copied by `BMB`, `BMW` and `BMD`: `BMW VW0, VW100, 10`",
    ),
    row(&["FMOV", "FLL"], Nothing, "on an S7-200 that is `FILL 0, VW0, 10`: ten words from VW0 on"),
];
