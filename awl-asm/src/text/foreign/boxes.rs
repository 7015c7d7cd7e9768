//! Boxes of the ladder diagram, of Micro/WIN and of the TIA portal: what they are called in AWL.

use super::row::Here::{Mnemonic, Nothing};
use super::row::{Row, row};

const SCALE: &str = "on an S7-200 that is arithmetic: `ITD`, `DTR`, then `/R`, `*R` and `+R`";
const RISING: &str = "on an S7-200 that is `EU` after the contact, without an operand";
const FALLING: &str = "on an S7-200 that is `ED` after the contact, without an operand";
const ADDS_TO: &str = "AWL names two operands, the second is the result: `+I VW0, VW2`";

pub(super) const ROWS: &[Row] = &[
    row(&["MOV_B"], Mnemonic("MOVB"), ""),
    row(&["MOV_W"], Mnemonic("MOVW"), ""),
    row(&["MOV_DW"], Mnemonic("MOVD"), ""),
    row(&["MOV_R"], Mnemonic("MOVR"), ""),
    row(&["BLKMOV_B"], Mnemonic("BMB"), ""),
    row(&["BLKMOV_W"], Mnemonic("BMW"), ""),
    row(&["BLKMOV_D"], Mnemonic("BMD"), ""),
    row(
        &["BLKMOV", "MOVE_BLK"],
        Nothing,
        "on an S7-200 blocks are copied by `BMB`, `BMW` and `BMD`: `BMW VW0, VW100, 10`",
    ),
    row(&["FILL_N", "FILL_BLK"], Mnemonic("FILL"), ""),
    row(&["ADD_I"], Mnemonic("+I"), ADDS_TO),
    row(&["ADD_DI"], Mnemonic("+D"), ADDS_TO),
    row(&["ADD_R"], Mnemonic("+R"), ADDS_TO),
    row(&["SUB_I"], Mnemonic("-I"), ""),
    row(&["SUB_DI"], Mnemonic("-D"), ""),
    row(&["SUB_R"], Mnemonic("-R"), ""),
    row(&["MUL_I"], Mnemonic("*I"), ""),
    row(&["MUL_DI"], Mnemonic("*D"), ""),
    row(&["MUL_R"], Mnemonic("*R"), ""),
    row(&["DIV_I"], Mnemonic("/I"), ""),
    row(&["DIV_DI"], Mnemonic("/D"), ""),
    row(&["DIV_R"], Mnemonic("/R"), ""),
    row(&["INC_B"], Mnemonic("INCB"), ""),
    row(&["INC_W"], Mnemonic("INCW"), ""),
    row(&["INC_DW"], Mnemonic("INCD"), ""),
    row(&["DEC_B"], Mnemonic("DECB"), ""),
    row(&["DEC_W"], Mnemonic("DECW"), ""),
    row(&["DEC_DW"], Mnemonic("DECD"), ""),
    row(&["INV_B"], Mnemonic("INVB"), ""),
    row(&["INV_W"], Mnemonic("INVW"), ""),
    row(&["INV_DW"], Mnemonic("INVD"), ""),
    row(&["WAND_B"], Mnemonic("ANDB"), ""),
    row(&["WAND_W"], Mnemonic("ANDW"), ""),
    row(&["WAND_DW"], Mnemonic("ANDD"), ""),
    row(&["WOR_B"], Mnemonic("ORB"), ""),
    row(&["WOR_W"], Mnemonic("ORW"), ""),
    row(&["WOR_DW"], Mnemonic("ORD"), ""),
    row(&["WXOR_B"], Mnemonic("XORB"), ""),
    row(&["WXOR_W"], Mnemonic("XORW"), ""),
    row(&["WXOR_DW"], Mnemonic("XORD"), ""),
    row(&["SHL_B"], Mnemonic("SLB"), ""),
    row(&["SHL_W"], Mnemonic("SLW"), ""),
    row(&["SHL_DW"], Mnemonic("SLD"), ""),
    row(&["SHR_B"], Mnemonic("SRB"), ""),
    row(&["SHR_W"], Mnemonic("SRW"), ""),
    row(&["SHR_DW"], Mnemonic("SRD"), ""),
    row(&["ROL_B"], Mnemonic("RLB"), ""),
    row(&["ROL_W"], Mnemonic("RLW"), ""),
    row(&["ROL_DW"], Mnemonic("RLD"), ""),
    row(&["ROR_B"], Mnemonic("RRB"), ""),
    row(&["ROR_W"], Mnemonic("RRW"), ""),
    row(&["ROR_DW"], Mnemonic("RRD"), ""),
    row(&["B_I"], Mnemonic("BTI"), ""),
    row(&["I_B"], Mnemonic("ITB"), ""),
    row(&["I_DI"], Mnemonic("ITD"), ""),
    row(&["DI_I"], Mnemonic("DTI"), ""),
    row(&["DI_R"], Mnemonic("DTR"), ""),
    row(&["I_BCD"], Mnemonic("IBCD"), ""),
    row(&["BCD_I"], Mnemonic("BCDI"), ""),
    row(&["I_R", "INT_TO_REAL"], Nothing, "on an S7-200 that is `ITD VW0, VD4` and `DTR VD4, VD4`"),
    row(&["READ_RTC", "RD_SYS_T"], Mnemonic("TODR"), ""),
    row(&["SET_RTC", "WR_SYS_T"], Mnemonic("TODW"), ""),
    row(&["AD_T_TBL"], Mnemonic("ATT"), ""),
    row(&["TBL_FIND"], Nothing, "in AWL that is `FND=`, `FND<>`, `FND<` or `FND>`"),
    row(
        &["SBR_N", "SBR", "SUBROUTINE"],
        Nothing,
        "a subroutine is called by `CALL SBR0`; its text begins with `SUBROUTINE_BLOCK Name:SBR0`",
    ),
    row(
        &["INT_N"],
        Nothing,
        "an interrupt routine begins with `INTERRUPT_BLOCK Name:INT0`; `ATCH INT0, 0` attaches it",
    ),
    row(&["R_TRIG", "P_TRIG"], Nothing, RISING),
    row(&["F_TRIG", "N_TRIG"], Nothing, FALLING),
    row(&["P"], Nothing, RISING),
    row(&["N"], Nothing, FALLING),
    row(
        &["TP"],
        Nothing,
        "an S7-200 has no pulse timer: set a bit with `EU` and `S M0.0, 1`, let `TON T37, 20` run \
         while it is 1, and reset it with `R M0.0, 1` when T37 is",
    ),
    row(&["CTRL_PWM"], Nothing, "on an S7-200 that is `PLS 0`, with its settings from SMB67 on"),
    row(&["EQ"], Nothing, "on an S7-200 that is a contact: `LDW= VW0, 5`"),
    row(&["NE"], Nothing, "on an S7-200 that is a contact: `LDW<> VW0, 5`"),
    row(&["GT"], Nothing, "on an S7-200 that is a contact: `LDW> VW0, 5`"),
    row(&["GE"], Nothing, "on an S7-200 that is a contact: `LDW>= VW0, 5`"),
    row(&["LT"], Nothing, "on an S7-200 that is a contact: `LDW< VW0, 5`"),
    row(&["LE"], Nothing, "on an S7-200 that is a contact: `LDW<= VW0, 5`"),
    row(
        &["MAX"],
        Nothing,
        "on an S7-200 the larger of VW0 and VW2 comes to VW2 by a comparison before a copy: `LDW> \
         VW0, VW2`, `MOVW VW0, VW2`",
    ),
    row(
        &["MIN"],
        Nothing,
        "on an S7-200 the smaller of VW0 and VW2 comes to VW2 by a comparison before a copy: \
         `LDW< VW0, VW2`, `MOVW VW0, VW2`",
    ),
    row(
        &["LIMIT"],
        Nothing,
        "on an S7-200 each limit is a comparison and a copy: `LDW> VW0, 100`, `MOVW 100, VW0`, \
         then `LDW< VW0, 0`, `MOVW 0, VW0`",
    ),
    row(
        &["SEL"],
        Nothing,
        "on an S7-200 a bit chooses between two copies: `LDN I0.0`, `MOVW VW0, VW4`, then \
         `LD I0.0`, `MOVW VW2, VW4`",
    ),
    row(
        &["MUX"],
        Nothing,
        "on an S7-200 each value has a comparison and a copy: `LDW= VW0, 1`, `MOVW VW2, VW10`, \
         then `LDW= VW0, 2`, `MOVW VW4, VW10`",
    ),
    row(&["SCALE", "SCALE_X", "NORM_X", "UNSCALE", "SCL"], Nothing, SCALE),
    row(
        &["CONVERT", "CONV"],
        Nothing,
        "on an S7-200 each conversion has its name: `BTI`, `ITB`, `ITD`, `DTI`, `DTR`, `ROUND`, `TRUNC`",
    ),
];
