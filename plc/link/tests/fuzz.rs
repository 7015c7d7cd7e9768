//! Random requests never panic, and change nothing that they may not.

mod machine;
#[path = "machine/requests.rs"]
mod requests;

use fastrand::Rng;
use machine::Machine;
use plc_isa::{DATA_END, DATA_START, I_START, M_START, Q_START, SM_START};

const REQUESTS: u32 = 1_000_000;

/// Whether nothing differs between two memories in these addresses.
fn is_unchanged(before: &[u8], after: &[u8], from: u16, to: u16) -> bool {
    let range = usize::from(from - DATA_START)..usize::from(to - DATA_START);
    before[range.clone()] == after[range]
}

#[test]
fn no_request_panics_or_writes_where_it_may_not() {
    let mut rng = Rng::with_seed(6);
    let rooms = [62, 64, 100, 252];
    let mut machines = rooms.map(|room| Machine::with_room(machine::PROGRAM, room));
    let (mut refused, mut answered) = ([0; 5], 0);
    for number in 0..REQUESTS {
        let machine = &mut machines[rng.usize(0..rooms.len())];
        let request = requests::request(&mut rng);
        if number % 1000 == 0 {
            machine.plc.stop();
        } else if number % 1000 == 20 {
            machine.plc.run();
        }
        machine.patience = rng.usize(1..20);
        let (frame, room) = (machine.link.frame(), machine.link.room());
        let before = machine.memory.clone();
        let len = u16::try_from(request.len()).unwrap();
        // What a machine could not have received it does not ask for.
        if len > room {
            continue;
        }
        (frame..).zip(&request).for_each(|(address, &byte)| machine.memory.set_byte(address, byte));
        let mut answer = 0;
        for _ in 0..100 {
            answer = plc_link::answer(machine, len);
            if answer != 0 {
                break;
            }
            // No scan meanwhile: only the answer changes memory. Except for 69, which waits for
            // one.
            if request[0] == 69 {
                machine.link.status_entries();
            }
        }
        assert!((2..=room).contains(&answer), "{request:02X?}: {answer}");
        let (function, code) = (machine.memory.byte(frame), machine.memory.byte(frame + 1));
        let (before, after) = (before.bytes(), machine.memory.bytes());
        let context = format!("{request:02X?}");
        // After the frame's room is nothing of the answer's, but what a trace has begun with.
        assert!(
            request[0] == 70 || is_unchanged(before, after, frame + room, DATA_END),
            "{context}"
        );
        let is_refused = function & 0x80 != 0;
        if is_refused {
            assert_eq!(answer, 2, "{context}");
            assert!((1..=4).contains(&code), "{context}");
            refused[usize::from(code)] += 1;
        } else {
            assert_eq!(function, request[0], "{context}");
            answered += 1;
        }
        let may_write = !is_refused && matches!(request[0], 5 | 6 | 15 | 16 | 23 | 68 | 72);
        if !may_write {
            assert!(is_unchanged(before, after, DATA_START, frame), "{context}");
        }
        if request[0] != 68 {
            assert!(is_unchanged(before, after, I_START, Q_START), "{context}");
            assert!(is_unchanged(before, after, SM_START, SM_START + 32), "{context}");
        }
        if !matches!(request[0], 5 | 15 | 72) {
            assert!(is_unchanged(before, after, Q_START, M_START), "{context}");
        }
    }
    assert!(answered > REQUESTS / 10, "{answered} {refused:?}");
    assert!(refused[1..].iter().all(|&count| count > 1000), "{refused:?}");
}
