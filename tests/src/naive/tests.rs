//! The rules of the naive evaluator, one by one.

use super::*;

/// A controller with a clock and inputs.
struct Bench {
    plc: Naive,
    now_ms: u32,
    inputs: Inputs,
}

fn bench(source: &str) -> Bench {
    Bench { plc: Naive::new(parse(source)), now_ms: 0, inputs: Inputs::default() }
}

impl Bench {
    /// A scan `ms` after the one before, with this IB0.
    fn scan(&mut self, ms: u32, ib0: u8) -> &mut Self {
        self.now_ms = self.now_ms.wrapping_add(ms);
        self.inputs.digital[0] = ib0;
        self.plc.scan(self.now_ms, &self.inputs);
        self
    }

    fn mw(&self, byte: u16) -> i16 {
        self.plc.word(Area::M, byte)
    }

    fn mb(&self, byte: u16) -> u8 {
        self.plc.byte(Area::M, byte)
    }

    fn sm1(&self) -> u8 {
        self.plc.byte(Area::Sm, 1) & 0x0F
    }

    /// Current value and bit.
    fn timer(&self, number: u8) -> (i16, bool) {
        (self.plc.timer(number).current, self.plc.timer(number).bit)
    }

    fn counter(&self, number: u8) -> (i16, bool) {
        (self.plc.counter(number).current, self.plc.counter(number).bit)
    }
}

/// MW0 and SM1.3-SM1.0 after `start` in MW0 met the instruction.
fn calculated(start: i16, line: &str) -> (i16, u8) {
    let mut bench = bench(&format!("LD SM0.0\nMOVW {start},MW0\n{line}"));
    bench.scan(0, 0);
    (bench.mw(0), bench.sm1())
}

#[test]
fn contacts_and_coils() {
    let mut bench =
        bench("LD I0.0\nAN I0.1\nO I0.2\nNOT\n= M0.0\nLDN I0.0\nA I0.1\nON I0.2\n= M0.1");
    let truth: Vec<u8> = (0..8).map(|ib0| bench.scan(1, ib0).mb(0)).collect();
    assert_eq!(truth, [3, 2, 3, 3, 0, 0, 2, 0]);
}

#[test]
fn stack_operations() {
    let source = "LD I0.0\nLD I0.1\nLD I0.2\nLPS\n= M0.0\nLPP\nLRD\n= M0.1\nLDS 2\n= M0.2\nOLD\n\
        = M0.3\nALD\n= M0.4";
    let mut bench = bench(source);
    // LRD replaces I0.2 by I0.1; LDS 2 brings I0.0 to the top of I0.1, I0.1, I0.0.
    assert_eq!(bench.scan(1, 0b101).mb(0), 0b0_1101);
    assert_eq!(bench.scan(1, 0b010).mb(0), 0b1_1010);
    assert_eq!(bench.scan(1, 0b011).mb(0), 0b1_1110);
}

#[test]
fn tenth_level_is_lost_and_zero_comes_from_below() {
    let pushes = "LD I0.0\n".to_string() + &"LD SM0.0\n".repeat(8);
    let eight = format!("{pushes}{}= M0.0", "ALD\n".repeat(8));
    assert_eq!(bench(&eight).scan(1, 1).mb(0), 1);
    let nine = format!("{pushes}LD SM0.0\n{}= M0.0", "ALD\n".repeat(8));
    assert_eq!(bench(&nine).scan(1, 0).mb(0), 1, "I0.0 has fallen off");
    let too_many = format!("{pushes}{}= M0.0", "ALD\n".repeat(9));
    assert_eq!(bench(&too_many).scan(1, 1).mb(0), 0);
}

#[test]
fn edges_need_two_scans() {
    let mut bench = bench("LD I0.0\nEU\n= M0.0\nLD I0.0\nED\n= M0.1");
    let seen: Vec<u8> = [1, 1, 0, 0, 1].map(|ib0| bench.scan(1, ib0).mb(0)).into();
    assert_eq!(seen, [0, 0, 2, 0, 1]);
    bench.plc.stop();
    bench.plc.start();
    assert_eq!(bench.scan(1, 0).mb(0), 0, "first scan again");
}

#[test]
fn comparisons_are_signed_for_words_only() {
    let source = "LDW< -1,1\n= M0.0\nLDB> 16#FF,1\n= M0.1\nLD SM0.0\nAW>= AIW2,Ain0\n= M0.2\n\
        LDW<> 1,1\nOB= IB0,5\n= M0.3";
    let mut bench = bench(source);
    bench.inputs.aiw[1] = 7;
    bench.inputs.ain[0] = 7;
    assert_eq!(bench.scan(1, 5).mb(0), 0b1111);
    assert_eq!(bench.scan(1, 4).mb(0), 0b0111);
}

#[test]
fn arithmetic_and_its_bits() {
    assert_eq!(calculated(5, "+I 3,MW0"), (8, 0b0000));
    assert_eq!(calculated(5, "+I -5,MW0"), (0, 0b0001));
    assert_eq!(calculated(5, "-I 6,MW0"), (-1, 0b0100));
    assert_eq!(calculated(32767, "+I 1,MW0"), (32767, 0b0010));
    assert_eq!(calculated(-32768, "-I 1,MW0"), (-32768, 0b0010));
    assert_eq!(calculated(-7, "*I 3,MW0"), (-21, 0b0100));
    assert_eq!(calculated(300, "*I 300,MW0"), (300, 0b0010));
    assert_eq!(calculated(-7, "/I 2,MW0"), (-3, 0b0100));
    assert_eq!(calculated(1, "/I 2,MW0"), (0, 0b0001));
    assert_eq!(calculated(-32768, "/I -1,MW0"), (-32768, 0b0010));
    assert_eq!(calculated(32767, "INCW MW0"), (-32768, 0b0110));
    assert_eq!(calculated(-32768, "DECW MW0"), (32767, 0b0010));
    assert_eq!(calculated(-1, "INCW MW0"), (0, 0b0001));
}

#[test]
fn division_by_zero_changes_one_bit_until_the_next_division() {
    assert_eq!(calculated(5, "-I 6,MW0\n/I 0,MW0"), (-1, 0b1100));
    assert_eq!(calculated(5, "/I 0,MW0\n+I 1,MW0"), (6, 0b1000));
    assert_eq!(calculated(5, "/I 0,MW0\n*I 0,MW0"), (0, 0b0001));
    assert_eq!(calculated(5, "/I 0,MW0\n*I 32767,MW0"), (5, 0b0010));
}

#[test]
fn boxes_without_power_flow_do_nothing() {
    let boxes = "MOVB 1,MB0\nMOVW 1,MW1\nINCW MW3\n+I 1,MW5\n/I 0,MW7\nS M9.0,8\nR T37,1\nSTOP\n\
        END\nLD SM0.0\n= M31.0";
    let mut bench = bench(&format!("LD I0.0\n{boxes}"));
    bench.scan(1, 0);
    assert!((0..31).all(|byte| bench.mb(byte) == 0));
    assert_eq!((bench.mb(31), bench.sm1(), bench.plc.mode()), (1, 0, Mode::Run));
}

#[test]
fn words_are_big_endian_at_any_byte() {
    let mut bench = bench("LD SM0.0\nMOVW 16#1234,MW1\nMOVB MB1,MB3\nMOVW MW2,VW10238");
    bench.scan(1, 0);
    assert_eq!([0, 1, 2, 3].map(|byte| bench.mb(byte)), [0, 0x12, 0x34, 0x12]);
    assert_eq!(bench.plc.word(Area::V, 10238), 0x3412);
}

#[test]
fn set_and_reset_ranges() {
    let mut bench = bench(
        "LD SM0.0\nS M0.6,4\nS M31.0,IB0\nMOVB 8,VB0\nS V10239.1,VB0\nS V10238.0,VB0\nR M0.7,2",
    );
    bench.scan(1, 8);
    assert_eq!([bench.mb(0), bench.mb(1), bench.mb(31)], [0x40, 0x02, 0xFF]);
    assert_eq!([bench.plc.byte(Area::V, 10238), bench.plc.byte(Area::V, 10239)], [0xFF, 0]);
    let mut bench = self::bench("LD SM0.0\nS M31.0,IB0\nS T255,IB0\nS T254,IB0");
    bench.scan(1, 9);
    assert_eq!((bench.mb(31), bench.timer(255), bench.timer(254)), (0, (0, false), (0, false)));
    bench.scan(1, 0);
    assert_eq!((bench.mb(31), bench.timer(255)), (0, (0, false)));
    bench.scan(1, 2);
    assert_eq!((bench.mb(31), bench.timer(255), bench.timer(254)), (3, (0, true), (0, true)));
}

#[test]
fn special_memory_tells_scans_and_times() {
    let mut bench = bench("");
    let mut sm0 = |ms| bench.scan(ms, 0).plc.byte(Area::Sm, 0);
    assert_eq!([sm0(1000), sm0(7), sm0(3)], [0b1100_1011, 0b1000_0001, 0b1100_0001]);
    assert_eq!([sm0(490), sm0(500), sm0(29_000)], [0b1010_0001, 0b1100_0001, 0b1001_0001]);
    let times = [22, 24, 26].map(|byte| bench.plc.word(Area::Sm, byte));
    assert_eq!(times, [29_000, 3, 29_000]);
    bench.plc.stop();
    bench.plc.start();
    assert_eq!(bench.scan(5, 0).plc.byte(Area::Sm, 0), 0b1100_0011, "not from power-up");
    assert_eq!([22, 24, 26].map(|byte| bench.plc.word(Area::Sm, byte)), [0, 0, 0]);
}

#[test]
fn time_may_wrap() {
    let mut bench = bench("LD SM0.0\nTON T33,5");
    bench.now_ms = u32::MAX - 14;
    bench.scan(0, 0).scan(20, 0).scan(30, 0);
    assert_eq!((bench.timer(33), bench.plc.word(Area::Sm, 22)), ((5, true), 30));
}

#[test]
fn on_delay_100_ms_counts_when_executed() {
    let mut bench = bench("LD I0.0\nTON T37,2\nLD I0.1\nTON T37,2");
    assert_eq!(bench.scan(0, 3).timer(37), (0, false));
    // Executed twice a scan it counts twice.
    assert_eq!(bench.scan(99, 3).timer(37), (0, false));
    assert_eq!(bench.scan(1, 3).timer(37), (2, true));
    assert_eq!(bench.scan(250, 3).timer(37), (6, true));
    assert_eq!(bench.scan(100, 0).timer(37), (0, false));
}

#[test]
fn timers_that_are_jumped_over() {
    let source = "LD I0.0\nJMP 1\nLD SM0.0\nTON T37,3\nTON T33,3\nTON T32,30\nLBL 1";
    let mut bench = bench(source);
    bench.scan(0, 0).scan(100, 1);
    assert_eq!([37, 33, 32].map(|n| bench.timer(n)), [(0, false), (10, true), (100, true)]);
    bench.scan(100, 1);
    assert_eq!([37, 33, 32].map(|n| bench.timer(n)), [(0, false), (20, true), (200, true)]);
    bench.scan(100, 0);
    assert_eq!([37, 33, 32].map(|n| bench.timer(n)), [(1, false), (30, true), (300, true)]);
}

#[test]
fn ticks_count_from_run_start() {
    let mut bench = bench("LD I0.0\nTON T33,5");
    bench.scan(3, 0).scan(9, 1);
    assert_eq!(bench.scan(1, 1).timer(33), (1, false), "10 ms after the first scan");
}

#[test]
fn retentive_timer_holds_until_reset() {
    let mut bench = bench("LD I0.0\nTONR T5,2\nLD I0.1\nR T5,1");
    bench.scan(0, 1).scan(100, 1);
    assert_eq!(bench.scan(100, 0).timer(5), (1, false));
    assert_eq!(bench.scan(100, 1).timer(5), (1, false));
    assert_eq!(bench.scan(100, 1).timer(5), (2, true));
    assert_eq!(bench.scan(100, 0).timer(5), (2, true));
    assert_eq!(bench.scan(100, 3).timer(5), (0, false));
    assert_eq!(bench.scan(100, 1).timer(5), (0, false), "starts again");
    assert_eq!(bench.scan(100, 1).timer(5), (1, false));
}

#[test]
fn off_delay() {
    let mut bench = bench("LD I0.0\nTOF T37,2\nLD I0.0\nTOF T33,2");
    bench.scan(0, 0).scan(500, 0);
    assert_eq!([bench.timer(37), bench.timer(33)], [(0, false), (0, false)]);
    bench.scan(100, 1);
    assert_eq!([bench.timer(37), bench.timer(33)], [(0, true), (0, true)]);
    bench.scan(100, 0);
    assert_eq!([bench.timer(37), bench.timer(33)], [(0, true), (0, true)]);
    bench.scan(100, 0);
    assert_eq!([bench.timer(37), bench.timer(33)], [(1, true), (2, false)]);
    bench.scan(300, 0);
    assert_eq!([bench.timer(37), bench.timer(33)], [(2, false), (2, false)]);
}

#[test]
fn presets_of_nothing_act_at_once() {
    let mut bench =
        bench("LD I0.0\nTON T37,0\nLD I0.0\nTONR T5,-1\nLD I0.0\nTOF T38,-3\nLD I0.0\nTOF T39,0");
    bench.scan(0, 1);
    assert_eq!([37, 5, 38, 39].map(|n| bench.timer(n)), [(0, true); 4]);
    bench.scan(0, 0);
    assert_eq!(
        [37, 5, 38, 39].map(|n| bench.timer(n)),
        [(0, false), (0, true), (0, false), (0, false)]
    );
}

#[test]
fn reset_off_delay_needs_a_new_fall() {
    let mut bench = bench("LD I0.0\nTOF T33,5\nLD I0.1\nR T33,1");
    bench.scan(0, 1).scan(10, 3);
    assert_eq!(bench.timer(33), (0, false));
    assert_eq!(bench.scan(10, 0).timer(33), (0, false));
    assert_eq!(bench.scan(10, 1).timer(33), (0, true));
    assert_eq!(bench.scan(10, 0).timer(33), (0, true));
}

#[test]
fn timers_stop_at_their_end_and_can_be_written() {
    let mut bench = bench("LD SM0.0\nTON T37,32767\nLD I0.0\nMOVW 32766,T37");
    bench.scan(0, 1).scan(100, 0);
    assert_eq!(bench.timer(37), (32767, true));
    assert_eq!(bench.scan(500, 0).timer(37), (32767, true));
}

#[test]
fn count_up() {
    let mut bench = bench("LD I0.0\nLD I0.1\nCTU C1,2");
    let seen = [1, 0, 1, 1, 0, 1, 2, 3, 1].map(|ib0| {
        bench.scan(1, ib0);
        bench.counter(1)
    });
    let expected = [
        (0, false),
        (0, false),
        (1, false),
        (1, false),
        (1, false),
        (2, true),
        (0, false),
        (0, false),
        (0, false),
    ];
    assert_eq!(seen, expected, "no edge in the first scan; the edge under reset is spent");
}

#[test]
fn count_down() {
    let mut bench = bench("LD I0.0\nLD I0.1\nCTD C1,2");
    let seen = [0, 2, 0, 1, 0, 1, 0, 1].map(|ib0| {
        bench.scan(1, ib0);
        bench.counter(1)
    });
    let expected = [
        (0, true),
        (2, false),
        (2, false),
        (1, false),
        (1, false),
        (0, true),
        (0, true),
        (0, true),
    ];
    assert_eq!(seen, expected);
}

#[test]
fn count_up_and_down_wraps() {
    let mut bench = bench("LD I0.0\nLD I0.1\nLD I0.2\nCTUD C1,0\nLD I0.3\nMOVW 32767,C1");
    bench.scan(1, 8).scan(1, 1);
    assert_eq!(bench.counter(1), (-32768, false));
    assert_eq!(bench.scan(1, 2).counter(1), (32767, true));
    assert_eq!(bench.scan(1, 0).scan(1, 3).counter(1), (32767, true));
    assert_eq!(bench.scan(1, 4).counter(1), (0, false));
}

#[test]
fn reset_keeps_the_edge_memory_of_a_counter() {
    let mut bench = bench("LD I0.0\nLD SM0.2\nCTU C1,1\nLD I0.1\nR C1,1");
    bench.scan(1, 0).scan(1, 1);
    assert_eq!(bench.counter(1), (1, true));
    assert_eq!(bench.scan(1, 3).counter(1), (0, false));
    assert_eq!(bench.scan(1, 1).counter(1), (0, false));
}

#[test]
fn loops() {
    let mut bench = bench("LD SM0.0\nFOR MW0,1,MW4\n+I MW0,MW2\nNEXT\n= M10.0");
    bench.plc.set_byte(Area::M, 5, 4);
    bench.scan(1, 0);
    assert_eq!((bench.mw(0), bench.mw(2), bench.mb(10)), (5, 10, 1));
    let mut skipped = self::bench(
        "LD SM0.0\nFOR MW0,3,2\nINCW MW2\nNEXT\n= M10.0\nLD I0.0\nFOR MW4,1,2\nINCW MW2\nNEXT\n\
            = M10.1",
    );
    skipped.scan(1, 0);
    assert_eq!((skipped.mw(0), skipped.mw(2), skipped.mw(4), skipped.mb(10)), (3, 0, 0, 1));
    let mut top = self::bench("LD SM0.0\nFOR MW0,32766,32767\nINCW MW2\nNEXT");
    top.scan(1, 0);
    assert_eq!((top.mw(0), top.mw(2)), (-32768, 2));
}

#[test]
fn nested_loops() {
    let mut bench = bench("LD SM0.0\nFOR MW0,1,3\nFOR MW2,1,MW0\nINCW MW4\nNEXT\nNEXT");
    bench.scan(1, 0);
    assert_eq!((bench.mw(0), bench.mw(2), bench.mw(4)), (4, 4, 6));
}

#[test]
fn jumps_forward_and_backward() {
    let mut bench = bench(
        "LBL 7\nLD SM0.0\nINCW MW0\nLDW< MW0,5\nJMP 7\nLD SM0.0\nJMP 8\nINCW MW0\nLBL 8\n= M10.0",
    );
    bench.scan(1, 0);
    assert_eq!((bench.mw(0), bench.mb(10)), (5, 1));
}

#[test]
fn end_and_stop() {
    let mut bench = bench("LD SM0.0\n= Q0.0\nLD I0.0\nEND\nLD I0.1\nSTOP\nLD SM0.0\nINCW MW0");
    assert_eq!(bench.scan(1, 0).mw(0), 1);
    assert_eq!(bench.scan(1, 1).mw(0), 1);
    assert_eq!(bench.scan(1, 2).mw(0), 1);
    assert_eq!(
        (bench.plc.mode(), bench.plc.output(0), bench.plc.byte(Area::Q, 0)),
        (Mode::Stop, 0, 1)
    );
    assert_eq!(bench.scan(1, 0).mw(0), 1, "nothing runs in STOP");
    bench.plc.start();
    assert_eq!(bench.scan(1, 0).mw(0), 2);
    assert_eq!((bench.plc.fault(), bench.plc.output(0)), (None, 1));
}

#[test]
fn an_endless_loop_is_a_fault_unless_retriggered() {
    let mut endless = bench("LBL 1\nLD SM0.0\nJMP 1");
    endless.scan(1, 0);
    assert_eq!((endless.plc.mode(), endless.plc.fault()), (Mode::Stop, Some(Fault::Watchdog)));
    let mut long = bench("LD SM0.0\nFOR MW0,1,32767\nFOR MW2,1,9\nWDR\nNEXT\nNEXT");
    long.scan(1, 0);
    assert_eq!((long.plc.mode(), long.plc.fault()), (Mode::Run, None));
}
