//! The chip with small programs, given as opcodes: marks, pins, converter, UART, EEPROM, watchdog,
//! resets, crashes.
#![cfg(feature = "link")]

use simavr::{Avr, Edge, Pin, Port, Reset, Stopped};

const GPIOR0: u8 = 0x1E;
const PIND: u8 = 0x09;
const DDRD: u8 = 0x0A;
const PORTD: u8 = 0x0B;
const DDRB: u8 = 0x04;
const PORTB: u8 = 0x05;

fn ldi(register: u16, value: u8) -> u16 {
    let value = u16::from(value);
    0xE000 | (value & 0xF0) << 4 | (register - 16) << 4 | value & 0xF
}

fn out(address: u8, register: u16) -> u16 {
    let address = u16::from(address);
    0xB800 | (address & 0x30) << 5 | register << 4 | address & 0xF
}

fn input(register: u16, address: u8) -> u16 {
    out(address, register) & !0x0800
}

fn sts(address: u16, register: u16) -> [u16; 2] {
    [0x9200 | register << 4, address]
}

fn lds(register: u16, address: u16) -> [u16; 2] {
    [0x9000 | register << 4, address]
}

/// Skips the next instruction if this bit is set.
fn sbrs(register: u16, bit: u16) -> u16 {
    0xFE00 | register << 4 | bit
}

/// A jump by so many words from the next instruction on.
fn rjmp(words: i16) -> u16 {
    0xC000 | words as u16 & 0x0FFF
}

const WDR: u16 = 0x95A8;
const SLEEP: u16 = 0x9588;

fn running(program: &[u16]) -> Avr {
    let mut avr = Avr::new();
    load(&mut avr, program);
    avr
}

fn load(avr: &mut Avr, program: &[u16]) {
    let bytes: Vec<u8> = program.iter().flat_map(|word| word.to_le_bytes()).collect();
    avr.write_flash(0, &bytes).unwrap();
    avr.reset(Reset::PowerOn);
}

fn marks(avr: &mut Avr, count: usize) -> Vec<Stopped> {
    (0..count).map(|_| avr.run_to_mark(10_000)).collect()
}

#[test]
fn runs_stop_at_every_mark_and_cycles_are_exact() {
    let mut avr = running(&[ldi(16, 1), ldi(17, 2), out(GPIOR0, 16), out(GPIOR0, 17), rjmp(-3)]);
    assert_eq!(marks(&mut avr, 3), [1, 2, 1].map(Stopped::Mark));
    assert_eq!(avr.data()[0x3E], 1);
    let before = avr.cycles();
    assert_eq!(marks(&mut avr, 2), [2, 1].map(Stopped::Mark));
    assert_eq!(avr.cycles() - before, 4, "two OUT and a jump of two cycles");
    assert_eq!(avr.run_for(1_000), Stopped::Limit);
    let passed = avr.cycles() - before - 4;
    assert!((1_000..=1_001).contains(&passed), "{passed}");
}

#[test]
fn a_limit_ends_an_endless_loop_to_the_instruction() {
    let mut avr = running(&[rjmp(-1)]);
    for cycles in [1, 999, 12_345] {
        let before = avr.cycles();
        assert_eq!(avr.run_to_mark(cycles), Stopped::Limit);
        let passed = avr.cycles() - before;
        assert!((cycles..=cycles + 1).contains(&passed), "{passed} for {cycles}");
    }
    assert_eq!(avr.step(), Stopped::Limit);
    assert_eq!(avr.pc(), 0);
}

#[test]
fn pins_are_read_and_driven() {
    // PD3 follows PD2, in a loop; PB5 is high.
    let mut avr = running(&[
        ldi(16, 0b1000),
        out(DDRD, 16),
        ldi(16, 0b10_0000),
        out(DDRB, 16),
        out(PORTB, 16),
        input(17, PIND),
        0x0F11, // lsl r17
        out(PORTD, 17),
        rjmp(-4),
    ]);
    let (follower, driven, high) = (Pin::of_uno(3), Pin::of_uno(2), Pin::of_uno(13));
    assert_eq!(high, Pin { port: Port::B, bit: 5 });
    assert!(!avr.is_output(follower) && !avr.is_output(high), "nothing has run yet");
    for level in [true, false, true] {
        avr.drive(driven, level);
        avr.run_for(100);
        assert_eq!((avr.level(follower), avr.level(driven)), (level, level));
    }
    assert!(avr.is_output(follower) && !avr.is_output(driven));
    assert!(avr.is_output(high) && avr.level(high));
    // The level outside does not change with a reset, and the program must see it again.
    avr.reset(Reset::External);
    assert!(!avr.is_output(high) && !avr.is_output(follower));
    avr.run_for(100);
    assert!(avr.level(follower));
    avr.drive(driven, false);
    avr.run_for(100);
    assert!(!avr.level(follower));
}

#[test]
fn a_driven_pin_wins_over_its_pull_up() {
    // Pull-ups at PD2 to PD4, then the pins in a loop to GPIOR0.
    let program = [ldi(16, 0b1_1100), out(PORTD, 16), input(17, PIND), out(GPIOR0, 17), rjmp(-4)];
    let mut avr = Avr::new();
    avr.drive(Pin::of_uno(2), false);
    avr.drive(Pin::of_uno(3), true);
    load(&mut avr, &program);
    assert_eq!(marks(&mut avr, 2), [0b1_1000; 2].map(Stopped::Mark), "PD4 is open and pulled up");
    avr.drive(Pin::of_uno(3), false);
    avr.drive(Pin::of_uno(2), true);
    assert_eq!(marks(&mut avr, 2), [0b1_0100; 2].map(Stopped::Mark));
    assert!(avr.has_pull_up(Pin::of_uno(2)) && !avr.has_pull_up(Pin::of_uno(5)));
}

#[test]
fn the_converter_gives_the_counts_that_were_set() {
    // ADMUX = AVCC, channel 3; ADCSRA = on, start, /2; waits for ADSC = 0; the result to r19 and
    // r20, then a mark.
    let [sts_mux, sts_mux_at] = sts(0x7C, 16);
    let [sts_control, sts_control_at] = sts(0x7A, 17);
    let [lds_control, lds_control_at] = lds(18, 0x7A);
    let [lds_low, lds_low_at] = lds(19, 0x78);
    let [lds_high, lds_high_at] = lds(20, 0x79);
    let mut avr = running(&[
        ldi(16, 0x43),
        sts_mux,
        sts_mux_at,
        ldi(17, 0xC1),
        sts_control,
        sts_control_at,
        lds_control,
        lds_control_at,
        0xFD26, // sbrc r18, 6
        rjmp(-4),
        lds_low,
        lds_low_at,
        lds_high,
        lds_high_at,
        out(GPIOR0, 16),
        rjmp(-12),
    ]);
    let mut read = |counts: Option<u16>| {
        if let Some(counts) = counts {
            avr.set_counts(3, counts);
        } else {
            avr.set_millivolts(3, 2_500);
        }
        // The conversion under way may have begun before.
        assert_eq!(marks(&mut avr, 2), [0x43; 2].map(Stopped::Mark));
        u16::from_le_bytes([avr.data()[19], avr.data()[20]])
    };
    for counts in 0..=1023 {
        assert_eq!(read(Some(counts)), counts);
    }
    assert_eq!(read(None), 511, "half the reference");
}

/// Takes bytes from the UART and sends them back.
fn echo() -> Vec<u16> {
    let mut program = vec![ldi(16, 0x18)];
    program.extend(sts(0xC1, 16)); // UCSR0B: receiver and transmitter on
    program.push(ldi(16, 16));
    program.extend(sts(0xC4, 16)); // UBRR0L
    program.extend(lds(17, 0xC0)); // UCSR0A, here the loop begins
    program.extend([sbrs(17, 7), rjmp(-4)]);
    program.extend(lds(18, 0xC6));
    program.extend(lds(17, 0xC0));
    program.extend([sbrs(17, 5), rjmp(-4)]);
    program.extend(sts(0xC6, 18));
    program.push(rjmp(-13));
    program
}

#[test]
fn the_uart_loses_nothing() {
    let mut avr = running(&echo());
    let text: Vec<u8> = (0..2_000u16).map(|index| (index % 251) as u8).collect();
    // Before the receiver is on, and more than any fifo holds.
    avr.uart_send(&text[..1_500]);
    avr.run_for(1_000_000);
    avr.uart_send(&text[1_500..]);
    let mut received = avr.uart_take();
    assert!(!received.is_empty() && received.len() < text.len(), "the UART has a speed");
    avr.run_for(10_000_000);
    received.extend(avr.uart_take());
    assert_eq!((received, avr.uart_waiting()), (text, 0));
    assert!(avr.uart_take().is_empty());
}

#[test]
fn a_reset_forgets_bytes_under_way() {
    let mut avr = running(&echo());
    avr.uart_send(b"to be forgotten, all of it, though it is more than sixty-four bytes long");
    avr.reset(Reset::External);
    assert_eq!(avr.uart_waiting(), 0);
    avr.run_for(100_000);
    avr.uart_send(b"new");
    avr.run_for(100_000);
    assert_eq!(avr.uart_take(), b"new");
}

#[test]
fn the_eeprom_outlives_resets() {
    // Reads EEPROM byte 5 to GPIOR0.
    let mut avr = running(&[
        ldi(16, 5),
        out(0x21, 16), // EEARL
        ldi(16, 0),
        out(0x22, 16), // EEARH
        ldi(16, 1),
        out(0x1F, 16), // EECR: read
        input(17, 0x20),
        out(GPIOR0, 17),
        rjmp(-1),
    ]);
    assert_eq!(avr.run_to_mark(1_000), Stopped::Mark(0xFF));
    avr.write_eeprom(4, &[1, 2, 3]).unwrap();
    avr.reset(Reset::PowerOn);
    assert_eq!(avr.run_to_mark(1_000), Stopped::Mark(2));
    assert_eq!((avr.eeprom().len(), &avr.eeprom()[3..8]), (1024, &[0xFF, 1, 2, 3, 0xFF][..]));
    assert!(avr.write_eeprom(1023, &[1, 2]).is_err());
    avr.erase_eeprom();
    assert_eq!(avr.eeprom(), [0xFF; 1024]);
}

/// MCUSR to GPIOR0, then the watchdog on, 16 ms, and round in circles; `wdr` in each if asked for.
fn watched(kicks: bool) -> Vec<u16> {
    let mut program = vec![input(20, 0x34), out(GPIOR0, 20), ldi(16, 0x18), ldi(17, 0x08)];
    program.extend(sts(0x60, 16));
    program.extend(sts(0x60, 17));
    program.extend([if kicks { WDR } else { 0 }, rjmp(-2)]);
    program
}

#[test]
fn the_watchdog_resets_unless_it_is_fed() {
    let cycles = 16_000_000 / 1_000 * 20;
    let mut avr = running(&watched(false));
    assert_eq!(avr.run_to_mark(100), Stopped::Mark(1), "power on");
    assert_eq!(avr.run_to_mark(cycles), Stopped::Mark(8), "watchdog");
    for _ in 0..100 {
        avr.feed_watchdog();
        assert_eq!(avr.run_to_mark(cycles / 2), Stopped::Limit);
    }
    avr.reset(Reset::External);
    assert_eq!(avr.run_to_mark(100), Stopped::Mark(2), "reset pin");
    // What is outside is still there after a reset by the watchdog.
    let pin = Pin::of_uno(2);
    avr.drive(pin, true);
    assert_eq!((avr.run_to_mark(cycles), avr.level(pin)), (Stopped::Mark(8), true));
    let mut avr = running(&watched(true));
    assert_eq!(avr.run_to_mark(100), Stopped::Mark(1));
    assert_eq!(avr.run_to_mark(3 * cycles), Stopped::Limit);
}

#[test]
fn what_a_program_cannot_survive_is_a_crash() {
    // Erased flash up to the end.
    let mut avr = running(&[]);
    assert_eq!(avr.run_to_mark(100_000), Stopped::Crash { pc: 0 });
    assert_eq!(avr.run_to_mark(100_000), Stopped::Crash { pc: 0 }, "and stays one");
    // A write after the end of memory.
    let [store, _] = sts(0, 16);
    load(&mut avr, &[store, 0xFFFF, rjmp(-1)]);
    assert!(matches!(avr.run_to_mark(100), Stopped::Crash { .. }));
    // Sleep with interrupts off.
    load(&mut avr, &[ldi(16, 1), out(0x33, 16), SLEEP, rjmp(-1)]);
    assert!(matches!(avr.run_to_mark(10_000), Stopped::Crash { .. }));
    load(&mut avr, &[ldi(16, 9), out(GPIOR0, 16), rjmp(-1)]);
    assert_eq!(avr.run_to_mark(100), Stopped::Mark(9), "a reset helps");
}

#[test]
fn a_bootloader_can_be_where_the_chip_starts() {
    let mut avr = Avr::new();
    avr.load_hex(":047E000001E00EBBE4\n:02000004000 0FA\n".replace(' ', "").as_str()).unwrap_err();
    avr.load_hex(":067E000001E00EBBFFCF04\n:00000001FF\n").unwrap();
    assert_eq!(avr.flash()[0x7DFF..0x7E07], [0xFF, 0x01, 0xE0, 0x0E, 0xBB, 0xFF, 0xCF, 0xFF][..8]);
    avr.set_reset_pc(0x7E00);
    avr.reset(Reset::External);
    assert_eq!(avr.pc(), 0x7E00);
    assert_eq!(avr.run_to_mark(10), Stopped::Mark(1));
    avr.set_pc(0);
    assert_eq!(avr.pc(), 0);
    assert!(avr.write_flash(0x7FFF, &[1, 2]).is_err());
}

/// Sets a bit of an I/O register.
fn sbi(address: u8, bit: u16) -> u16 {
    0x9A00 | u16::from(address) << 3 | bit
}

#[test]
fn a_byte_of_the_eeprom_takes_its_time() {
    const EECR: u8 = 0x1F;
    const EEDR: u8 = 0x20;
    const EEARL: u8 = 0x21;
    let write =
        [ldi(16, 5), out(EEARL, 16), ldi(16, 0xAB), out(EEDR, 16), sbi(EECR, 2), sbi(EECR, 1)];
    let mut avr = running(&[&write[..], &[rjmp(-1)]].concat());
    assert_eq!(avr.eeprom_writing(), None);
    avr.run_for(100);
    assert_eq!((avr.eeprom_writing(), avr.data()[0x3F] & 2, avr.eeprom()[5]), (Some(5), 2, 0xAB));
    avr.run_for(54_400 - 200);
    assert_eq!(avr.eeprom_writing(), Some(5));
    avr.run_for(300);
    assert_eq!(
        (avr.eeprom_writing(), avr.data()[0x3F] & 2, avr.eeprom_is_misused()),
        (None, 0, false)
    );
    assert_eq!((avr.eeprom_writes()[5], avr.eeprom_writes().iter().sum()), (1, 1));

    let mut avr = running(&[&write[..], &write, &[rjmp(-1)]].concat());
    avr.run_for(100);
    assert!(avr.eeprom_is_misused(), "a second write before the first is done");
}

/// Writes a value to a register in data memory.
fn set(address: u16, value: u8) -> [u16; 3] {
    let [store, at] = sts(address, 16);
    [ldi(16, value), store, at]
}

/// Words to timer 1: the high byte first.
fn set_word(address: u16, value: u16) -> Vec<u16> {
    [set(address + 1, (value >> 8) as u8), set(address, value as u8)].concat()
}

const TCCR1A: u16 = 0x80;
const TCCR1B: u16 = 0x81;
const TCCR1C: u16 = 0x82;
const TCNT1: u16 = 0x84;
const ICR1: u16 = 0x86;
const OCR1A: u16 = 0x88;
const OCR1B: u16 = 0x8A;

/// The pins of OC1A and OC1B.
const WAVES: [Pin; 2] = [Pin { port: Port::B, bit: 1 }, Pin { port: Port::B, bit: 2 }];

/// The levels that follow each other at a pin, each with the cycles to the next.
fn wave(edges: &[Edge], pin: Pin) -> Vec<(bool, u64)> {
    let edges: Vec<_> = edges.iter().filter(|edge| edge.pin == pin).collect();
    edges.windows(2).map(|pair| (pair[0].high, pair[1].cycle - pair[0].cycle)).collect()
}

#[test]
fn timer_1_modulates_its_pins() {
    // Up to 99 in 8 cycles each: OC1A is set at 29 and cleared at the bottom, OC1B cleared at 79
    // and set at the bottom.
    let mut program = [
        vec![ldi(16, 6), out(DDRB, 16)],
        set(TCCR1A, 0xF0).to_vec(),
        set(TCCR1C, 0xC0).to_vec(),
        vec![out(GPIOR0, 16)],
        set(TCCR1A, 0xE2).to_vec(),
        set(TCCR1B, 0x18).to_vec(),
        set_word(ICR1, 99),
        set_word(OCR1A, 29),
        set_word(OCR1B, 79),
        set(TCCR1B, 0x1A).to_vec(),
        set_word(TCNT1, 98),
        vec![out(GPIOR0, 16)],
    ]
    .concat();
    // 256 times INC and BRNE, which is nearly a cycle of the timer, and then a new compare value.
    program.extend([ldi(17, 0), 0x9513, 0xF7F1]);
    program.extend([set_word(OCR1A, 49), vec![out(GPIOR0, 16), rjmp(-1)]].concat());
    let mut avr = running(&program);
    avr.watch_waves();
    assert_eq!(avr.run_to_mark(1_000), Stopped::Mark(0xC0));
    assert_eq!(WAVES.map(|pin| avr.level(pin)), [true, true], "forced");
    avr.run_to_mark(1_000);
    avr.take_waves();
    assert_eq!(avr.run_to_mark(2_000), Stopped::Mark(49));
    avr.run_for(4_000);
    let waves = avr.take_waves();
    let [first, second] = WAVES.map(|pin| wave(&waves, pin));
    // The new value counts from the end of a cycle on.
    let changed = first.iter().position(|&part| part == (false, 400)).unwrap();
    assert!(changed >= 2 && first.len() >= changed + 4, "{first:?}");
    assert!(
        first[..changed].iter().all(|part| [(false, 240), (true, 560)].contains(part)),
        "{first:?}"
    );
    assert!(
        first[changed..].iter().all(|part| [(false, 400), (true, 400)].contains(part)),
        "{first:?}"
    );
    assert!(
        second.len() > 8 && second.iter().all(|part| [(true, 640), (false, 160)].contains(part)),
        "{second:?}"
    );
}
