//! The hardware functions on the host: interrupts, pulses, high-speed counters, pulse outputs, the
//! clock. And operands of every class in scenarios.

use awl_asm::assemble::assemble;
use awl_asm::source::Source;
use awl_sim::action::Action;
use awl_sim::machine::Machine;
use awl_sim::machine::host::Host;
use awl_sim::operand::Operand;
use awl_sim::run::{Job, Length, Outcome, run};
use awl_sim::scenario::{Context, Scenario};
use plc_vm::TimeOfDay;

/// A program of a main block and interrupt routines, `INT_0` first, each of one network.
fn program(main: &str, routines: &[&str]) -> String {
    let mut text = format!("ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\n{main}\nEND_ORGANIZATION_BLOCK\n");
    for (number, routine) in routines.iter().enumerate() {
        text += &format!("INTERRUPT_BLOCK INT_{number}:INT{number}\nBEGIN\nNETWORK 1\n{routine}\n");
        text += "END_INTERRUPT_BLOCK\n";
    }
    text
}

fn host(program: &str) -> Host {
    let assembly = assemble(&Source::new("test.awl", program).unwrap(), Vec::new());
    let image = assembly.image.unwrap_or_else(|| panic!("{program}\n{:#?}", assembly.diagnostics));
    let host = Host::new(image, Box::new(|at| format!("byte {at}")));
    assert_eq!(host.fault(), None, "{program}");
    host
}

fn outcome(program: &str, scenario: &str) -> Outcome {
    let mut host = host(program);
    let mut has_operand = |operand| host.read(operand).map(|_| ());
    let context = Context { symbols: &[], plant: None, has_operand: &mut has_operand };
    let scenario =
        Scenario::parse("t.scn", scenario, context).unwrap_or_else(|problems| panic!("{problems}"));
    let scan_ms = scenario.scan_ms.unwrap_or(1);
    let job =
        Job { scan_ms, length: Length::Scenario, signals: Vec::new(), plant: None, progress: None };
    run(&mut host, &scenario, job).unwrap()
}

/// Everything is as expected.
fn assert_holds(program: &str, scenario: &str) {
    let outcome = outcome(program, scenario);
    let failures: Vec<_> =
        outcome.failures.iter().map(|failure| format!("{}: {failure}", failure.line)).collect();
    assert!(
        failures.is_empty() && outcome.fault.is_none(),
        "{failures:#?} {:?}\n{program}",
        outcome.fault
    );
    assert!(outcome.met > 0 && outcome.unreached_expectations == 0);
}

/// Attaches routines to events in the first scan and enables interrupts.
fn attaching(events: &[(u8, u8)], more: &str) -> String {
    let mut text = "NETWORK 1\nLD SM0.1\n".to_string();
    for (routine, event) in events {
        text += &format!("ATCH INT_{routine}, {event}\n");
    }
    format!("{text}ENI\n{more}")
}

#[test]
fn edges_of_the_first_four_inputs_are_events() {
    // Each of the eight routines counts in its own word.
    let events: Vec<_> = (0..8).map(|event| (event, event)).collect();
    let routines: Vec<_> = (0..8).map(|event| format!("LD SM0.0\nINCW VW{}", 2 * event)).collect();
    let routines: Vec<_> = routines.iter().map(String::as_str).collect();
    let program = program(&attaching(&events, ""), &routines);
    let scenario = "at 10ms I0.0 = 1\nat 11ms expect VW0 = 1, VW2 = 0\nat 20ms I0.0 = 0\n\
            at 21ms expect VW0 = 1, VW2 = 1
        at 30ms IB0 = 16#FE # all but the first rise
        at 31ms expect VW0 = 1, VW4 = 1, VW6 = 0, VW8 = 1, VW10 = 0, VW12 = 1, VW14 = 0
        at 40ms IB0 = 0\nat 41ms expect VW0 = 1, VW2 = 1, VW6 = 1, VW10 = 1, VW14 = 1
        at 50ms pulse I0.3 2500Hz 100 times\nat 50ms pulse I0.1 1kHz for 100ms\n\
        at 200ms expect VW12 = 101, VW14 = 101
        at 200ms expect VW4 = 101, VW6 = 101, VW0 = 1";
    assert_holds(&program, scenario);
}

#[test]
fn events_stay_in_their_order_within_a_scan() {
    // A digit for each event, the oldest first.
    let digit = |event: u8| format!("LD SM0.0\n*D 10, VD0\n+D {}, VD0", event + 1);
    let [rise, fall, second] = [digit(0), digit(1), digit(2)];
    let program = program(&attaching(&[(0, 0), (1, 1), (2, 2)], ""), &[&rise, &fall, &second]);
    // Edges at 10, 11, 12, 13 ms of the first input; of the second at 10.5 ms.
    let scenario = "scan 10ms\nat 10ms pulse I0.0 500Hz 2 times\nat 20ms expect VD0 = 1\n\
        at 30ms expect VD0 = 1212
        at 40ms VD0 = 0\nat 40ms pulse I0.0, I0.1 250Hz 2 times\nat 60ms expect VD0 = 132132";
    assert_holds(&program, scenario);
}

#[test]
fn more_events_than_can_wait() {
    // The routine sees SM4.1; after the last one the queue is empty again.
    let count = "LD SM0.0\nINCW VW0\nLD SM4.1\nINCW VW2";
    let program = program(
        &attaching(&[(0, 0)], "NETWORK 2\nLD SM4.1\nINCW VW4\nNETWORK 3\nLD SM4.4\n= Q0.0"),
        &[count],
    );
    let scenario =
        "scan 10ms\nat 10ms pulse I0.0 1600Hz 16 times\nat 30ms expect VW0 = 16, VW2 = 0, Q0.0 = 1
        at 30ms pulse I0.0 2kHz 20 times\nat 50ms expect VW0 = 33, VW2 = 16, VW4 = 0, SM4.1 = 0";
    assert_holds(&program, scenario);
}

#[test]
fn disabled_interrupts_wait_and_detached_ones_do_not() {
    let main = attaching(
        &[(0, 0)],
        "NETWORK 2\nLD I1.0\nEU\nDISI\nNETWORK 3\nLD I1.1\nEU\nENI\nNETWORK 4\nLD I1.2\nEU\n\
            DTCH 0\n\
         NETWORK 5\nLD I1.3\nEU\nCEVNT 0\nNETWORK 6\nLD SM4.4\n= Q0.0",
    );
    let program = program(&main, &["LD SM0.0\nINCW VW0"]);
    let scenario = "at 5ms expect Q0.0 = 1\nat 5ms I1.0 = 1\nat 10ms pulse I0.0 100Hz 2 times\n\
            at 40ms expect VW0 = 0, Q0.0 = 0
        at 40ms I1.1 = 1\nat 41ms expect Q0.0 = 1\nat 42ms expect VW0 = 2\nat 42ms IB1 = 0\n\
        at 45ms I1.0 = 1
        at 50ms pulse I0.0 100Hz 2 times\nat 80ms I1.3 = 1\nat 82ms I1.1 = 1\nat 90ms expect VW0 = 2
        at 90ms I1.2 = 1\nat 95ms pulse I0.0 100Hz 2 times\nat 150ms expect VW0 = 2";
    assert_holds(&program, scenario);
}

#[test]
fn timed_interrupts_have_the_period_of_their_attachment() {
    let main = "NETWORK 1\nLD SM0.1\nMOVB 5, SMB34\nMOVB 20, SMB35\nATCH INT_0, 10\n\
        ATCH INT_1, 11\nENI\nMOVB 1, SMB34\n\
        NETWORK 2\nLD I0.5\nEU\nMOVB 2, SMB34\nATCH INT_0, 10";
    let program = program(main, &["LD SM0.0\nINCW VW0", "LD SM0.0\nINCW VW2"]);
    assert_holds(
        &program,
        "at 5ms expect VW0 = 0\nat 6ms expect VW0 = 1\nat 101ms expect VW0 = 20, VW2 = 5
         at 101ms I0.5 = 1\nat 122ms expect VW0 = 30, VW2 = 6",
    );
    // Slower scans: all of them, at the next start.
    assert_holds(&program, "scan 10ms\nat 101ms expect VW0 = 20, VW2 = 5");
    // More than eight cannot wait: 5, 10, 15, 20, 20 of the other, 25, 30, 35.
    assert_holds(&program, "scan 100ms\nat 101ms expect VW0 = 7, VW2 = 1");
}

#[test]
fn fast_timers_tell_that_they_have_reached_their_preset() {
    let main = attaching(
        &[(0, 21), (1, 22)],
        "NETWORK 2\nLDN T32\nTON T32, 10\nNETWORK 3\nLD I0.0\nTOF T96, 20\nNETWORK 4\nLD I0.1\n\
            R T96, 1",
    );
    let program = program(&main, &["LD SM0.0\nINCW VW0", "LD SM0.0\nINCW VW2"]);
    let scenario = "at 100ms expect VW0 = 9\nat 10ms I0.0 = 1\nat 20ms I0.0 = 0\n\
        at 39ms expect VW2 = 0
        at 42ms expect VW2 = 1\nat 50ms I0.0 = 1\nat 60ms I0.0 = 0\nat 65ms I0.1 = 1\n\
        at 100ms expect VW2 = 1";
    assert_holds(&program, scenario);
}

/// Defines HSC0 with a mode and starts it; a second network copies its value.
fn counting(mode: u8, preset: i32, attach: &str) -> String {
    format!(
        "NETWORK 1\nLD SM0.1\nMOVB 16#F8, SMB37\nMOVD 0, SMD38\nMOVD {preset}, SMD42\n\
            HDEF 0, {mode}\n{attach}ENI\nHSC 0\n\
         NETWORK 2\nLD SM0.0\nMOVD HC0, VD0\nMOVB SMB36, VB4\n"
    )
}

#[test]
fn a_fast_clock_is_counted_between_scans() {
    let program =
        program(&counting(0, 500, "ATCH INT_0, 12\n"), &["LD SM0.0\nINCW VW8\nMOVD HC0, VD10"]);
    // 20 pulses in each scan; at the event of the 500th the scan's last are counted already.
    let scenario = "at 10ms pulse I0.0 20kHz for 1s\nat 20ms expect VD0 = 181, VW8 = 0\n\
            at 2s expect VD0 = 20000, HC0 = 20000
        at 2s expect VW8 = 1, VD10 = 501, VB4 = 2#1010_0000, I0.0 = 0";
    assert_holds(&program, scenario);
}

#[test]
fn an_encoder_is_counted_in_both_directions() {
    let program = program(&counting(9, 100_000, "ATCH INT_0, 27\n"), &["LD SM0.0\nINCW VW8"]);
    let scenario = "at 10ms pulse I0.0, I0.1 500Hz for 1s\n\
        at 1100ms expect VD0 = 2000, VW8 = 0, VB4 = 16#20
        at 1100ms pulse I0.0, I0.1 500Hz 600 times reverse\n\
        at 4s expect VD0 = -400, VW8 = 1, VB4 = 0";
    assert_holds(&program, scenario);
}

#[test]
fn the_reset_input_sets_the_counter_to_0() {
    let program = program(
        &counting(10, 100_000, "ATCH INT_0, 28\n"),
        &["LD SM0.0\nINCW VW8\nMOVD HC0, VD10"],
    );
    let scenario = "at 10ms pulse I0.0, I0.1 500Hz 100 times\nat 215ms expect VD0 = 400, VW8 = 0\n\
        at 220ms I0.2 = 1
        at 221ms expect VW8 = 1, VD10 = 0, VD0 = 0\nat 230ms pulse I0.0, I0.1 500Hz 10 times\n\
        at 260ms expect VD0 = 0
        at 260ms I0.2 = 0\nat 270ms pulse I0.0, I0.1 500Hz 10 times\n\
        at 300ms expect VD0 = 40, VW8 = 1";
    assert_holds(&program, scenario);
}

#[test]
fn an_interrupt_gives_the_counter_its_next_task() {
    // Up to 100, then from there down to 0: the interrupt turns the direction.
    let turn = "LD SM0.0\nMOVB 16#B0, SMB37\nMOVD 0, SMD42\nHSC 0\n= M0.0";
    let program = program(&counting(0, 100, "ATCH INT_0, 12\n"), &[turn]);
    let scenario =
        "at 10ms pulse I0.0 1kHz 100 times\nat 200ms expect HC0 = 100, M0.0 = 1, SMB37 = 16#B0
        at 200ms pulse I0.0 1kHz 40 times\nat 300ms expect HC0 = 60";
    assert_holds(&program, scenario);
}

#[test]
fn counters_are_defined_once_and_before_they_are_used() {
    let main = "NETWORK 1\nLD SM0.1\nMOVB 16#F8, SMB37\nHDEF 0, 0\nAENO\n= M0.0\nLD I0.4\nEU\n\
        HDEF 0, 0\nAENO\n= M0.1\n\
        NETWORK 2\nLD I0.5\nEU\nHSC 3\nAENO\n= M0.2";
    let scenario =
        "at 1ms expect M0.0 = 1, SM4.3 = 0\nat 2ms I0.4 = 1\nat 3ms expect M0.1 = 0, SM4.3 = 1\n\
            at 3ms SM4.3 = 0
        at 4ms I0.5 = 1\nat 5ms expect M0.2 = 0, SM4.3 = 1";
    assert_holds(&program(main, &[]), scenario);
}

#[test]
fn the_change_to_run_forgets_everything_but_the_clock() {
    let main = "NETWORK 1\nLD SM0.1\nMOVB 16#F8, SMB37\nHDEF 0, 0\nAENO\nS M0.0, 1\nLD I0.4\nEU\n\
        ENI\nHSC 0\nATCH INT_0, 0\n\
        MOVB 16#CB, SMB77\nMOVW 100, SMW78\nMOVW 50, SMW80\nPLS 1\nNETWORK 2\nLD SM0.0\n\
        TODR VB10\nAENO\n= M0.1";
    let mut host = host(&program(main, &["LD SM0.0\nINCW VW0"]));
    let operand = |name: &str| Operand::parse(name, &[]).unwrap();
    let set = |host: &mut Host, name: &str, value| host.write(operand(name), value).unwrap();
    let read = |host: &mut Host, name: &str| host.read(operand(name)).unwrap();
    let values = |host: &mut Host| {
        ["M0.0", "M0.1", "SM4.4", "HC0", "VW0", "Q0.1.duty"].map(|name| read(host, name))
    };
    let time = TimeOfDay::new([26, 11, 21], [15, 0, 0]).unwrap();
    host.act(&Action::SetClock { at_ms: 0, time }).unwrap();
    host.scan(0);
    set(&mut host, "I0.4", 1);
    host.scan(1);
    set(&mut host, "I0.0", 1);
    host.scan(2);
    assert_eq!(values(&mut host), [1, 1, 1, 1, 1, 500]);
    host.stop();
    assert_eq!(read(&mut host, "Q0.1.duty"), 0);
    set(&mut host, "M0.0", 0);
    for input in [0, 1, 0] {
        set(&mut host, "I0.0", input);
        host.scan(3);
    }
    // Nothing is counted in STOP. The counter can be defined again, and is not active.
    set(&mut host, "I0.4", 0);
    host.run();
    host.scan(4);
    set(&mut host, "I0.0", 1);
    host.scan(5);
    assert_eq!(values(&mut host), [1, 1, 0, 1, 1, 0]);
}

#[test]
fn the_third_counter_has_its_own_input() {
    let main = "NETWORK 1\nLD SM0.1\nMOVB 16#F8, SMB137\nMOVD 5, SMD142\nHDEF 3, 0\n\
        ATCH INT_0, 32\nENI\nHSC 3";
    let scenario = "at 10ms pulse I0.1 2kHz 10 times\nat 10ms pulse I0.0 1kHz 10 times\n\
        at 100ms expect HC3 = 10, VW0 = 1";
    assert_holds(&program(main, &["LD SM0.0\nINCW VW0"]), scenario);
}

#[test]
fn pulse_width_modulation_drives_its_output() {
    let main = "NETWORK 1\nLD SM0.1\nMOVB 16#CB, SMB77\nMOVW 100, SMW78\nMOVW 25, SMW80\nPLS 1\n\
        NETWORK 2\nLD I0.0\nEU\nMOVB 16#CA, SMB77\nMOVW 50, SMW80\nPLS 1\nNETWORK 3\nLD I0.1\nEU\n\
        MOVB 0, SMB77\nPLS 1\n\
        NETWORK 4\nLD SM0.0\n= Q0.1";
    let scenario =
        "at 1ms expect Q0.1 = 1, Q0.1.duty = 250, Q0.2.duty = 0\nat 25ms expect Q0.1 = 1\n\
            at 26ms expect Q0.1 = 0
        at 100ms expect Q0.1 = 0\nat 101ms expect Q0.1 = 1\nat 126ms expect Q0.1 = 0\n\
        at 130ms I0.0 = 1
        at 131ms expect Q0.1.duty = 500, Q0.1 = 1\nat 150ms expect Q0.1 = 1\n\
        at 151ms expect Q0.1 = 0
        at 210ms I0.1 = 1\nat 211ms expect Q0.1 = 1, Q0.1.duty = 1000";
    assert_holds(&program(main, &[]), scenario);
}

#[test]
fn a_train_of_pulses_tells_its_end() {
    let main = "NETWORK 1\nLD SM0.1\nMOVB 16#8D, SMB77\nMOVW 10, SMW78\nMOVD 5, SMD82\nPLS 1\n\
        NETWORK 2\nLD SM76.7\n= M0.0";
    let scenario = "at 1ms expect Q0.1 = 1, M0.0 = 0, Q0.1.duty = 500\nat 6ms expect Q0.1 = 0\n\
        at 45ms expect Q0.1 = 1
        at 46ms expect Q0.1 = 0\nat 50ms expect M0.0 = 0\nat 51ms expect M0.0 = 1, Q0.1 = 0
        at 100ms expect Q0.1.duty = 0";
    assert_holds(&program(main, &[]), scenario);
}

#[test]
fn the_clock_stands_at_nothing_until_it_is_set() {
    let main = "NETWORK 1\nLD SM0.0\nTODR VB0\nAENO\n= M0.0\nNETWORK 2\nLD I0.0\nEU\nTODW VB10\n\
        AENO\n= M0.1";
    let set = "VB10 = 16#27, VB11 = 16#12, VB12 = 16#31, VB13 = 16#23, VB14 = 16#59, VB15 = 16#58, \
        VB16 = 0, VB17 = 1";
    let scenario = format!(
        "at 10ms expect M0.0 = 0, SM4.3 = 1, VB0 = 0\nat 10ms SM4.3 = 0\n\
            at 100ms clock 2026-11-21 15:00:00
         at 101ms expect M0.0 = 1, VB0 = 16#26, VB1 = 16#11, VB2 = 16#21, VB3 = 16#15, VB4 = 0, \
         VB5 = 0, VB7 = 7
         at 1099ms expect VB5 = 0\nat 1101ms expect VB5 = 1\nat 60100ms expect VB4 = 0, VB5 = 16#59
         at 61101ms expect VB4 = 1, VB5 = 1
         at 62s {set}, I0.0 = 1\nat 62002ms expect M0.1 = 0, VB0 = 16#27, VB5 = 16#58\n\
         at 63s I0.0 = 0
         at 64001ms expect VB0 = 16#28, VB1 = 1, VB2 = 1, VB3 = 0, VB4 = 0, VB5 = 0, VB7 = 7
         at 65s VB11 = 16#13, I0.0 = 1\nat 65s SM4.3 = 0\nat 65002ms expect SM4.3 = 1, VB5 = 1"
    );
    assert_holds(&program(main, &[]), &scenario);
}

#[test]
fn operands_of_every_class() {
    let main = "NETWORK 1\nLD SM0.0\nMOVD VD0, AC0\nMOVR VD4, AC1\n+R 0.5, AC1\nMOVR AC1, VD8\n\
        MOVW VW12, AQW0\nMOVB SMB34, MB5\n\
        MOVD VD14, MD8\nMOVB VB18, SMB35";
    let scenario =
        "at 0ms VD0 = -70000, VD4 = 1.25, VW12 = 16000, SMB34 = 17, VD14 = 16#80000000, \
        VB18 = 9
        at 1ms expect VD0 = -70000, AC0 = -70000, AC1 = 1.75, VD8 = 1.7..1.8, VD8:real = 1.75, \
        AQW0 = 16000, AQW2 = 0
        at 1ms expect MB5 = 17, MD8 = -2147483648, SMB34 = 17, SMB35 = 9, HC0 = 0, VB0 = 16#FF, \
        VD8 = 16#3FE00000
        at 1ms VB0 = \"\\x12\\x34\\x56\"\n\
        at 2ms expect VD0 = 16#03123456, AC0 = 16#03123456, VB0 = \"\\x12\\x34\\x56\"";
    assert_holds(&program(main, &[]), scenario);
    let wrong = outcome(
        &program(main, &[]),
        "at 0ms VD4 = 1.25\nat 1ms expect VD8 = 1.7, VD8 = 0.5..1.5, AC0 = 1",
    );
    let told: Vec<_> = wrong.failures.iter().map(|failure| &*failure.text).collect();
    let expected = [
        "expected VD8 = 1.7, got 1.75",
        "expected VD8 = 0.5..1.5, got 1.75",
        "expected AC0 = 1, got 0",
    ];
    assert_eq!(told, expected);
}

#[test]
fn a_message_is_received_and_echoed() {
    let main = "//# memory VB100-VB131\nNETWORK 1\nLD SM0.1\nMOVB 16#09, SMB30\n\
        MOVB 16#E0, SMB87\nMOVB 58, SMB88\n\
        MOVB 13, SMB89\nMOVB 30, SMB94\nATCH INT_0, 23\nATCH INT_1, 9\nENI\nRCV VB100, 0\n\
        NETWORK 2\nLD SM4.5\n= M0.0";
    let echo = "LD SM0.0\nMOVB SMB86, VB50\nINCW VW52\nXMT VB100, 0";
    let again = "LD SM0.0\nINCW VW54\nRCV VB100, 0";
    let scenario = "at 2ms expect M0.0 = 1\nat 10ms receive \"noise:1,2\\r:next\"\n\
        at 18ms expect VW52 = 0, SMB2 = 44
        at 30ms expect VB50 = 16#20, VW52 = 1, VB100 = \":1,2\\r\", VW54 = 1, M0.0 = 1\n\
        at 30ms expect sent \":1,2\\r\"
        at 20ms expect M0.0 = 0, VW52 = 1\nat 25ms expect VW54 = 0\nat 26ms expect VW54 = 1\n\
        at 100ms receive \":0123456789012345678901234567890\"
        at 200ms expect VB50 = 2, VW52 = 2, VB100 = 30\n\
        at 200ms expect sent \":01234567890123456789012345678\"";
    assert_holds(&program(main, &[echo, again]), scenario);
    let wrong = outcome(
        &program(main, &[echo, again]),
        "at 10ms receive \":\\r\"\nat 99ms expect sent \"x\"",
    );
    assert_eq!(wrong.failures[0].to_string(), "at 99ms expected sent = \"x\", got \":\\r\"");
}

#[test]
fn messages_end_by_time_and_single_characters_are_events() {
    // Any character begins (idle time 0), 20 ms of silence end.
    let main = "//# memory VB100-VB131\nNETWORK 1\nLD SM0.1\nMOVB 16#09, SMB30\n\
        MOVB 16#94, SMB87\nMOVW 0, SMW90\n\
        MOVW 20, SMW92\nMOVB 30, SMB94\nATCH INT_0, 23\nATCH INT_1, 8\nENI\nNETWORK 2\nLD I0.0\n\
        EU\nRCV VB100, 0\n\
        NETWORK 3\nLD I0.1\nEU\nMOVB 0, SMB87\nRCV VB100, 0";
    let message = "LD SM0.0\nMOVB SMB86, VB50\nINCW VW52";
    let character = "LD SM0.0\n+I 1, VW54\nMOVB SMB2, VB56";
    let scenario = "at 10ms receive \"abc\"\nat 20ms expect VW54 = 3, VB56 = 99, VW52 = 0
        at 30ms I0.0 = 1\nat 40ms receive \"hello\"\nat 64ms expect VW52 = 0\n\
        at 66ms expect VW52 = 1, VB50 = 4
        at 66ms expect VB100 = \"hello\", VW54 = 3\nat 70ms I0.0 = 0\nat 80ms I0.0 = 1\n\
        at 90ms I0.1 = 1
        at 95ms expect VW52 = 2, VB50 = 16#80, VB100 = 0";
    assert_holds(&program(main, &[message, character]), scenario);
}

#[test]
fn a_frame_between_two_equal_characters() {
    let main = "//# memory VB100-VB131\nNETWORK 1\nLD SM0.1\nMOVB 16#09, SMB30\n\
        MOVB 16#E0, SMB87\nMOVB 126, SMB88\n\
        MOVB 126, SMB89\nMOVB 30, SMB94\nATCH INT_0, 23\nENI\nRCV VB100, 0\n\
        NETWORK 2\nLD I0.0\nEU\nXMT VB100, 0\nAENO\n= M0.0\nNETWORK 3\nLD I0.0\nEU\nRCV VB100, 0\n\
        AENO\n= M0.1";
    let scenario = "at 10ms receive \"x~abc~y\"\nat 15ms expect VW52 = 0\n\
        at 20ms expect VW52 = 1, VB100 = \"~abc~\"
        at 5ms I0.0 = 1 # while it receives
        at 6ms expect M0.0 = 0, M0.1 = 0, SM4.3 = 1\nat 21ms I0.0 = 0\nat 22ms I0.0 = 1\n\
        at 23ms expect M0.0 = 1, M0.1 = 0
        at 99ms expect sent \"~abc~\"";
    assert_holds(&program(main, &["LD SM0.0\nINCW VW52"]), scenario);
}
