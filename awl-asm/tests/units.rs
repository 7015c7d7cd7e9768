//! Program units from text to image and back: calls with parameters, local memory, sequence
//! control, interrupts.

use awl_asm::assemble::{Assembly, assemble};
use awl_asm::ast::{UnitId, UnitKind};
use awl_asm::disassemble::{disassemble, instructions};
use awl_asm::source::Source;
use awl_asm::units::LocalPlace;
use plc_isa::{APPROACH_LEN, L_START, Op, verify};

fn assembled(text: &str) -> Assembly {
    let assembly = assemble(&Source::new("units.awl", text).expect("a text"), Vec::new());
    assert!(!assembly.has_errors(), "{:#?}", assembly.diagnostics);
    assembly
}

fn image(text: &str) -> Vec<u8> {
    assembled(text).image.expect("an image")
}

/// The instructions of an image by name, the units separated.
fn ops(image: &[u8]) -> Vec<Vec<Op>> {
    let program = verify(image).expect("a valid image");
    let mut units: Vec<Vec<Op>> = Vec::new();
    for line in instructions(&program) {
        units.resize(units.len().max(usize::from(line.unit) + 1), Vec::new());
        units[usize::from(line.unit)].push(line.decoded.op);
    }
    units
}

#[track_caller]
fn comes_back(text: &str) -> String {
    let first = image(text);
    let back = disassemble(&first).expect("a valid image");
    assert_eq!(image(&back), first, "{back}");
    back
}

fn block(kind: &str, name: &str, head: &str, code: &str) -> String {
    format!("{kind}_BLOCK {name}\n{head}BEGIN\nNETWORK 1\n{code}\nEND_{kind}_BLOCK\n")
}

fn main_block(code: &str) -> String {
    block("ORGANIZATION", "MAIN:OB1", "", code)
}

fn subroutine(name: &str, head: &str, code: &str) -> String {
    block("SUBROUTINE", name, head, code)
}

const PARAMETERS: &str = "VAR_INPUT\na:BOOL;\nb:BYTE;\nc:DWORD;\nd:REAL;\ne:INT;\nf:BOOL;\n\
    END_VAR\nVAR_IN_OUT\n\
    g:BOOL;\nh:WORD;\nEND_VAR\nVAR_OUTPUT\ni:DINT;\nEND_VAR\nVAR\nt:REAL;\nEND_VAR\n";

#[test]
fn calls_with_parameters_come_back() {
    let main = main_block(
        "LD I0.0\nCALL Mixer, T37, *AC1, &VB10, 1.5, -5, TRUE, M0.0, MW2, *VD0\nAENO\n= Q0.0",
    );
    let code =
        "LD #a\nO #f\n= #g\nLD SM0.0\nMOVR #d, #t\nMOVD #c, #i\nMOVB *LD8, VB60\nMOVW #e, #h";
    let back = comes_back(&(main + &subroutine("Mixer:SBR7", PARAMETERS, code)));
    assert!(back.contains("CALL   SBR7, T37, *AC1, &VB10, 1.5, -5, 1, M0.0, MW2, *VD0"), "{back}");
    assert!(back.contains("VAR_IN_OUT\nP_7:BOOL;\nP_8:INT;\nEND_VAR"), "{back}");
    // A timer of 1 ms is brought up to date within the call.
    let words = "VAR_IN_OUT\na:INT;\nEND_VAR\nVAR_OUTPUT\nb:INT;\nc:DINT;\nEND_VAR\n";
    let main = main_block("LD I0.0\nCALL SBR0, T64, T1, VD7\nNOT\n= Q0.0");
    comes_back(&(main + &subroutine("a:SBR0", words, "LDW> #a, 0\n= Q0.1")));
}

#[test]
fn reals_come_back_as_reals() {
    let program = |kind: &str, constant: &str| {
        let head = format!("VAR_INPUT\nx:{kind};\nEND_VAR\n");
        let code = "LD SM0.0\nMOVR LD0, VD0\n";
        main_block(&format!("LD SM0.0\nCALL SBR0, {constant}\n"))
            + &subroutine("SBR_0:SBR0", &head, code)
    };
    let back = comes_back(&program("REAL", "1.5"));
    assert!(back.contains("P_1:REAL;") && back.contains("SBR0, 1.5\n"), "{back}");
    // These bits are no real.
    let back = comes_back(&program("DINT", "16#7FC00000"));
    assert!(back.contains("P_1:DINT;") && back.contains("SBR0, 2143289344\n"), "{back}");
}

#[test]
fn settings_come_back() {
    let program = |settings: &str| format!("{settings}LD I0.0\n= Q0.0\n");
    for settings in [
        "//# pullup I0.0, I0.5\n",
        "//# invert I0.3, Q0.0, Q0.4\n",
        "//# watchdog 200ms\n//# scan 10ms\n//# filter 16\n",
        "//# modbus address 5 baud 19200 parity even\n",
        "//# modbus address 247\n",
        "//# modbus baud 1200 parity odd\n",
    ] {
        let back = comes_back(&program(settings));
        assert!(back.contains(settings), "{back}");
    }
    assert!(
        !comes_back(&program("//# modbus parity none baud 115200 address 1\n")).contains("modbus")
    );
}

#[test]
fn a_call_without_parameters_is_one_instruction() {
    let text = main_block("LD I0.0\nCALL SBR0") + &subroutine("a:SBR0", "", "LD I0.1\n= Q0.0");
    let units = ops(&image(&text));
    assert_eq!(units, [vec![Op::Ld, Op::Call, Op::MainEnd], vec![Op::Ld, Op::Assign, Op::Ret]]);
    comes_back(&text);
}

#[test]
fn callers_stand_before_what_they_call() {
    let text = subroutine("c:SBR2", "", "LD SM0.0\nCALL SBR9")
        + &subroutine("a:SBR0", "", "LD I0.1\n= Q0.0")
        + &main_block("LD SM0.0\nCALL c\nCALL a\nATCH t, 0")
        + &subroutine("d:SBR9", "", "LD SM0.0\nCALL a")
        + &subroutine("never:SBR1", "", "LD SM0.0\nCALL a")
        + &block("INTERRUPT", "t:INT5", "", "LD SM0.0\nS Q0.1, 1");
    let assembly = assembled(&text);
    let id = |kind, number| UnitId { kind, number };
    let order = [
        id(UnitKind::Main, 1),
        id(UnitKind::Interrupt, 5),
        id(UnitKind::Subroutine, 2),
        id(UnitKind::Subroutine, 9),
        id(UnitKind::Subroutine, 0),
    ];
    assert_eq!(assembly.units.in_image().map(|part| part.id).collect::<Vec<_>>(), order);
    comes_back(&text);
}

#[test]
fn local_memory_is_shared_by_what_is_never_active_together() {
    let locals = |code: &str| format!("LD SM0.0\nMOVD 0, LD0\n{code}");
    let text = main_block("LD SM0.0\nMOVW 0, LW10\nCALL SBR0\nCALL SBR1\nATCH INT0, 10")
        + &subroutine("a:SBR0", "", &locals("CALL SBR2"))
        + &subroutine("b:SBR1", "", &locals("MOVD 0, LD60"))
        + &subroutine("c:SBR2", "", &locals(""))
        + &block("INTERRUPT", "t:INT0", "", &locals("CALL SBR3"))
        + &subroutine("s:SBR3", "", &locals(""));
    let assembly = assembled(&text);
    let base = |kind, number, byte| match local(&assembly, kind, number, byte)? {
        LocalPlace::Page(address) => Some(address - L_START),
        LocalPlace::Arena(_) => None,
    };
    let sub = |number, byte| base(UnitKind::Subroutine, number, byte);
    // Only bytes in use have a place, wherever they are in the text.
    assert_eq!(base(UnitKind::Main, 1, 10), Some(0));
    assert_eq!((sub(0, 0), sub(1, 0), sub(1, 60)), (Some(2), Some(2), Some(6)));
    assert_eq!(sub(2, 0), Some(6));
    // An interrupt finds any of them active.
    assert_eq!(base(UnitKind::Interrupt, 0, 0), Some(10));
    assert_eq!(sub(3, 0), Some(14));
    assert_eq!(assembly.units.local_len, [18, 0]);
    comes_back(&text);
}

#[test]
fn a_chain_has_64_bytes_for_each_unit() {
    let locals = |last: u8, code: &str| format!("LD SM0.0\nBMB LB0, LB{last}, {last}\n{code}");
    let text = main_block("LD SM0.0\nCALL SBR0\nATCH INT0, 10")
        + &subroutine("a:SBR0", "", &locals(20, "CALL SBR1"))
        + &subroutine("b:SBR1", "", &locals(20, "CALL SBR2"))
        + &subroutine("c:SBR2", "", &locals(5, "CALL SBR3"))
        + &subroutine("d:SBR3", "", &locals(32, ""))
        + &block("INTERRUPT", "t:INT0", "", &locals(4, ""));
    let assembly = assembled(&text);
    let sub = |number| local(&assembly, UnitKind::Subroutine, number, 0);
    assert_eq!(sub(0), Some(LocalPlace::Page(L_START)));
    assert_eq!(sub(1), Some(LocalPlace::Arena(0)));
    assert_eq!(sub(2), Some(LocalPlace::Page(L_START + 40)));
    assert_eq!(sub(3), Some(LocalPlace::Arena(40)));
    let interrupt = local(&assembly, UnitKind::Interrupt, 0, 0);
    assert_eq!(interrupt, Some(LocalPlace::Page(L_START + 50)));
    assert_eq!(assembly.units.local_len, [58, 104]);
    comes_back(&text);
}

fn local(assembly: &Assembly, kind: UnitKind, number: u8, byte: u16) -> Option<LocalPlace> {
    assembly.units.find(UnitId { kind, number }).and_then(|part| part.local(byte))
}

#[test]
fn events_are_asked_for_between_rungs_where_nothing_is_entered_twice() {
    let rungs = "LD I0.0\nLPS\nA I0.1\n= Q0.0\nLPP\nLD I0.2\nALD\n= Q0.1\nLD I0.3\n= Q0.2";
    let main =
        |attach: &str| main_block(&format!("LD SM0.0\nCALL SBR0\nCALL SBR1\n{attach}\n{rungs}"));
    let rest = subroutine("a:SBR0", "", rungs)
        + &subroutine("s:SBR1", "", rungs)
        + &block("INTERRUPT", "t:INT0", "", &format!("LD SM0.0\nCALL SBR1\n{rungs}"));
    let polls = |text: &str| -> Vec<usize> {
        ops(&image(text))
            .iter()
            .map(|unit| unit.iter().filter(|&&op| op == Op::Poll).count())
            .collect()
    };
    assert_eq!(polls(&(main("ATCH t, 0") + &rest)), [3, 0, 2, 0]);
    assert_eq!(polls(&(main("NOT") + &rest)), [0, 0, 0]);
    comes_back(&(main("ATCH t, 0") + &rest));
}

#[test]
fn power_in_a_segment_comes_from_its_bit() {
    let text = "NETWORK 1\nLSCR S0.0\nNETWORK 2\nLD I0.0\nA I0.1\nO I0.2\nON I0.3\nOW= MW0, 1\n\
        AN I0.4\nLDI I0.5\nALD\n\
        SCRT S0.1\nNETWORK 3\nLDR> VD0, 1.0\nCSCRE\nNETWORK 4\nSCRE\nNETWORK 5\nLD I0.0\nO I0.1\n\
        = Q0.0\n";
    let main = ops(&image(text)).concat();
    let behind: Vec<Op> =
        main.windows(2).filter(|pair| pair[1] == Op::ScrAnd).map(|pair| pair[0]).collect();
    assert_eq!(behind, [Op::Ld, Op::Ow, Op::Ldi, Op::LoadReal]);
    comes_back(text);
}

#[test]
fn constants_stand_once_and_data_as_it_was() {
    let text = "LD SM0.0\nMOVR 1.5, VD0\n+R 1.5, VD0\nMOVD 100000, VD4\nMOVW 16#ABCD, *VD4\n\
        SCPY \"a$22$E4\", VB20\n\
        SHRB I0.0, V8.0, -6\nMOVR -0.0, VD0\nMOVR 1e-40, VD0\nMOVD &C3, AC2\nDATA_BLOCK\n\
        VB300 1, 2\nVW302 -1\nVB20 5\nEND_DATA_BLOCK\n";
    let back = comes_back(text);
    for piece in [
        "SHRB   I0.0, V8.0, -6",
        "SCPY   \"a$\"$E4\", VB20",
        "MOVD   &C3, AC2",
        "VB300 1, 2, 255, 255",
    ] {
        assert!(back.contains(piece), "{piece}: {back}");
    }
    let image = image(text);
    let count = |bytes: &[u8]| image.windows(bytes.len()).filter(|window| *window == bytes).count();
    assert_eq!(count(&1.5f32.to_be_bytes()), 1);
}

#[test]
fn pointers_to_special_memory_that_nothing_follows_come_back() {
    // The byte has a place because of the pointer alone.
    let back = comes_back("LD SM0.0\nMOVD &SMB86, AC1\nMOVD 16#06000057, AC2\nMOVD &SMB5, AC3\n");
    for piece in ["MOVD   &SMB86, AC1", "MOVD   100663383, AC2", "MOVD   100663301, AC3"] {
        assert!(back.contains(piece), "{piece}: {back}");
    }
    comes_back("LD SM0.0\nMOVB SMB87, VB0\nMOVD 16#06000057, AC2\n");
    comes_back(
        &(main_block("LD SM0.0\nCALL SBR0, &SMB186")
            + &subroutine("a:SBR0", "VAR_INPUT\na:DWORD;\nEND_VAR\n", "LD L0.0\n= Q0.0")),
    );
}

#[test]
fn what_a_format_in_memory_can_ask_for_has_a_place() {
    let demand = |text: &str| assembled(&format!("LD SM0.0\n{text}\n")).demand.v_ranges;
    assert_eq!(demand("RTA 5.0, VB10, VB500"), [(10, 15), (500, 1)]);
    assert_eq!(demand("RTS 5.0, VB500, VB10"), [(10, 16), (500, 1)]);
    assert_eq!(demand("RTA 5.0, VB10, 16#A2"), [(10, 10)]);
    assert_eq!(demand("RTS 5.0, 16#A2, VB10"), [(10, 11)]);
    // At the end of an area it may be fewer.
    assert_eq!(demand("RTA 5.0, VB10235, VB500"), [(500, 1), (10235, 5)]);
}

#[test]
fn memory_that_only_the_running_program_knows_takes_the_rest() {
    let demand = |text: &str| assembled(text).demand;
    assert_eq!(demand("LD SM0.0\nMOVW VW10, VW20\n").v_ranges, [(10, 2), (20, 2)]);
    assert_eq!(demand("LD SM0.0\nMOVW *VD10, VW20\n").v_ranges, [(10, 896)]);
    assert_eq!(demand("LD SM0.0\nATT VW0, VW20\nTON T37, 5\nEU\n").v_ranges, [(0, 890)]);
    assert_eq!(demand("LD SM0.0\nBMB VB0, VB100, 10\n").v_ranges, [(0, 10), (100, 10)]);
    // Too far apart for one range: each takes a share.
    assert_eq!(demand("LD SM0.0\nMOVW *VD0, VW4000\n").v_ranges, [(0, 449), (4000, 447)]);
    assert_eq!(demand("//# memory VB0-VB99\nLD SM0.0\nMOVW *VD10, VW20\n").v_ranges, [(0, 100)]);
    comes_back("//# memory VB0-VB99\nLD SM0.0\nMOVW *VD10, VW20\n");
}

#[test]
fn status_windows_are_looked_for_often_enough_and_not_more_often() {
    let rungs = "LD T32\nAW>= MW0, 5\nMOVD VD0, VD4\n= Q0.0\nLD I0.0\nLPS\nA I0.1\n= Q0.1\nLPP\n\
        R M0.0, 9\n"
        .repeat(40);
    let call = "LD I0.3\nCALL Mixer, T37, *AC1, &VB10, 1.5, -5, TRUE, M0.0, MW2, *VD0\n".repeat(9);
    let text = main_block(&format!(
        "{rungs}LD SM0.0\nCALL SBR8\nFOR VW0, 1, 3\n{call}NEXT\nLD I0.0\nJMP 1\n{rungs}LBL 1"
    )) + &subroutine("Mixer:SBR7", PARAMETERS, &rungs)
        + &subroutine("short:SBR8", "", "LD I0.0\n= Q0.0");
    comes_back(&text);
    let image = image(&text);
    let program = verify(image.as_slice()).expect("a valid image");
    let mut looks = Vec::new();
    for unit in instructions(&program).chunk_by(|a, b| a.unit == b.unit) {
        let (mut seen, mut count) = (unit[0].at, 0);
        for line in unit {
            let distance = line.at - seen;
            assert!(distance <= APPROACH_LEN, "{:?} at {}", line.decoded.op, line.at);
            if line.decoded.op == Op::Approach {
                // The next instruction, with what is hidden around it, would not have ended near
                // enough.
                assert!(distance > APPROACH_LEN - 25, "at {}", line.at);
                (seen, count) = (line.at, count + 1);
            }
        }
        looks.push(count);
    }
    assert!(looks[0] > 15 && looks[1] > 5 && looks[2] == 0, "{looks:?}");
}
