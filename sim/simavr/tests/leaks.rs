//! Chips and resets must leave no memory behind: tests use thousands. Alone in its process, because
//! it measures it.
#![cfg(all(feature = "link", target_os = "linux"))]

use simavr::{Avr, Reset};

/// Bytes of this process in memory.
fn resident() -> u64 {
    let text = std::fs::read_to_string("/proc/self/statm").unwrap();
    4096 * text.split(' ').nth(1).unwrap().parse::<u64>().unwrap()
}

fn use_chips(chips: usize, resets: usize) {
    for _ in 0..chips {
        let mut avr = Avr::new();
        // UCSR0B: receiver and transmitter on; a byte to UDR0; round in circles.
        let program = [0xE108u16, 0x9300, 0x00C1, 0x9300, 0x00C6, 0xCFFF];
        let bytes: Vec<u8> = program.iter().flat_map(|word| word.to_le_bytes()).collect();
        avr.write_flash(0, &bytes).unwrap();
        for _ in 0..resets {
            avr.reset(Reset::PowerOn);
            avr.uart_send(b"some bytes");
            avr.run_for(1_000);
            assert_eq!(avr.uart_take(), [0x18]);
        }
    }
}

#[test]
fn chips_and_resets_leave_nothing_behind() {
    use_chips(50, 50);
    let before = resident();
    use_chips(2_000, 1);
    use_chips(1, 20_000);
    let grown = resident().saturating_sub(before);
    // The least that libsimavr is known to leave of a chip, the names of its interrupts, is more
    // than 1 KB.
    assert!(grown < 500_000, "{grown} bytes more");
}
