//! High-speed counters HSC0 and HSC3: what they count, and HDEF and HSC (docs/s7-200.md 1.9, 3.2).
//!
//! The current value lives in data memory, as HC0 and HC3; control, status, preset and new current
//! value in special memory, where the program names it.

use plc_isa::{Area, HC0, HC3, Plan, ProgramMemory};

use crate::memory::Memory;

/// Control: which level of the reset input resets, 0 high, 1 low. Taken by HDEF.
const RESET_LOW: u8 = 1 << 0;
/// Control: quadrature counts one edge of four. Taken by HDEF.
const ONE_FOLD: u8 = 1 << 2;
/// Control: the direction is up.
const UP: u8 = 1 << 3;
/// Control: take over the direction.
const TAKE_DIRECTION: u8 = 1 << 4;
/// Control: take over the preset.
const TAKE_PRESET: u8 = 1 << 5;
/// Control: take over the current value.
const TAKE_CURRENT: u8 = 1 << 6;
/// Control: count.
const ENABLE: u8 = 1 << 7;

/// Status: counts up.
const IS_UP: u8 = 1 << 5;
/// Status: current value and preset are the same.
const IS_EQUAL: u8 = 1 << 6;
/// Status: the current value is above the preset.
const IS_ABOVE: u8 = 1 << 7;

/// A counter's place in the machine.
#[derive(Debug, Clone, Copy)]
struct Site {
    /// Its number.
    number: u8,
    /// Bit of IB0 with the clock. Direction or second clock and reset follow.
    clock: u8,
    /// First byte of its special memory: status, then control, current value, preset.
    special: u16,
    current: u16,
    equal: u8,
    direction: u8,
    reset: u8,
}

/// Most inputs that a counter takes.
const INPUTS_MAX: u8 = 3;

/// No such event.
const NONE: u8 = u8::MAX;

const SITES: [Site; 2] = [
    Site { number: 0, clock: 0, special: 36, current: HC0, equal: 12, direction: 27, reset: 28 },
    Site {
        number: 3,
        clock: 1,
        special: 136,
        current: HC3,
        equal: 32,
        direction: NONE,
        reset: NONE,
    },
];

/// What a mode makes of the inputs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Inputs {
    /// One clock, the direction is in the control byte.
    InternalDirection,
    /// One clock, the second input is the direction.
    ExternalDirection,
    /// One clock up, one down.
    TwoClocks,
    /// Two tracks of an encoder.
    Quadrature,
}

/// How a counter counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Mode {
    inputs: Inputs,
    has_reset: bool,
}

impl Mode {
    /// The mode of a number, as far as the counter has it.
    fn of(counter: u8, number: u8) -> Option<Mode> {
        let inputs = match number / 3 {
            0 => Inputs::InternalDirection,
            1 => Inputs::ExternalDirection,
            2 => Inputs::TwoClocks,
            3 => Inputs::Quadrature,
            _ => return None,
        };
        // Start inputs are not there.
        let is_there = number % 3 < 2 && (counter == 0 || number == 0);
        is_there.then_some(Mode { inputs, has_reset: number % 3 == 1 })
    }

    /// The inputs it takes, a bit each, from the clock on.
    fn taken(self) -> u8 {
        let clocks = if self.inputs == Inputs::InternalDirection { 0b001 } else { 0b011 };
        if self.has_reset { clocks | 0b100 } else { clocks }
    }
}

/// What a counter is, beside its values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Counter {
    mode: Option<Mode>,
    /// RESET_LOW and ONE_FOLD as HDEF found them.
    options: u8,
    enabled: bool,
    up: bool,
    preset: i32,
}

/// Events that an edge causes, by their numbers; few of them.
pub(crate) type Occurred = [Option<u8>; 2];

/// HSC0 and HSC3.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct HighSpeedCounters {
    counters: [Counter; 2],
}

impl HighSpeedCounters {
    /// None is defined: as after the change to RUN.
    pub const UNDEFINED: HighSpeedCounters = HighSpeedCounters {
        counters: [Counter { mode: None, options: 0, enabled: false, up: true, preset: 0 }; 2],
    };

    fn find(&mut self, number: u8) -> Option<(Site, &mut Counter)> {
        SITES.into_iter().zip(&mut self.counters).find(|(site, _)| site.number == number)
    }

    /// HDEF. Whether it was possible: the counter has the mode, none yet, and its inputs are not
    /// those of the other.
    pub fn define<P: ProgramMemory>(
        &mut self,
        number: u8,
        mode: u8,
        levels: u8,
        plan: &Plan<P>,
        memory: &Memory,
    ) -> bool {
        let Some(mode) = Mode::of(number, mode) else { return false };
        let inputs_of = |site: Site, mode: Mode| mode.taken() << site.clock;
        let taken = SITES
            .into_iter()
            .zip(&self.counters)
            .filter(|(site, _)| site.number != number)
            .filter_map(|(site, counter)| Some(inputs_of(site, counter.mode?)))
            .fold(0, |all, inputs| all | inputs);
        let Some((site, counter)) = self.find(number).filter(|(_, counter)| counter.mode.is_none())
        else {
            return false;
        };
        if inputs_of(site, mode) & taken != 0 {
            return false;
        }
        counter.mode = Some(mode);
        counter.options = special(site.special + 1, plan, memory);
        if mode.inputs == Inputs::ExternalDirection {
            counter.up = levels >> (site.clock + 1) & 1 != 0;
        }
        true
    }

    /// HSC: takes over what the control byte says. Whether there was an HDEF before.
    pub fn activate<P: ProgramMemory>(
        &mut self,
        number: u8,
        plan: &Plan<P>,
        memory: &mut Memory,
    ) -> bool {
        let Some((site, counter)) = self.find(number) else { return false };
        let Some(mode) = counter.mode else { return false };
        let control = special(site.special + 1, plan, memory);
        if control & TAKE_DIRECTION != 0 && mode.inputs == Inputs::InternalDirection {
            counter.up = control & UP != 0;
        }
        if control & TAKE_PRESET != 0 {
            counter.preset = special_double(site.special + 6, plan, memory);
        }
        if control & TAKE_CURRENT != 0 {
            let current = special_double(site.special + 2, plan, memory);
            set_double(memory, site.current, current);
        }
        counter.enabled = control & ENABLE != 0;
        counter.write_status(site, plan, memory);
        true
    }

    /// An input has changed: which bit of IB0, and IB0 afterwards.
    pub fn edge<P: ProgramMemory>(
        &mut self,
        input: u8,
        levels: u8,
        plan: &Plan<P>,
        memory: &mut Memory,
    ) -> [Occurred; 2] {
        let mut occurred = [[None; 2]; 2];
        for ((site, counter), events) in
            SITES.into_iter().zip(&mut self.counters).zip(&mut occurred)
        {
            if let (Some(mode), true, Some(offset)) =
                (counter.mode, counter.enabled, input.checked_sub(site.clock))
            {
                *events = counter.edge(mode, site, offset, levels >> site.clock, plan, memory);
            }
        }
        occurred
    }
}

impl Counter {
    /// Input `offset` of the counter has changed; `levels`: its inputs from bit 0 on.
    fn edge<P: ProgramMemory>(
        &mut self,
        mode: Mode,
        site: Site,
        offset: u8,
        levels: u8,
        plan: &Plan<P>,
        memory: &mut Memory,
    ) -> Occurred {
        if offset >= INPUTS_MAX || mode.taken() >> offset & 1 == 0 {
            return [None; 2];
        }
        let is_resetting =
            mode.has_reset && (levels >> 2 & 1 != 0) != (self.options & RESET_LOW != 0);
        let occurred = match offset {
            2 if is_resetting => {
                set_double(memory, site.current, 0);
                [Some(site.reset), None]
            }
            2 => [None; 2],
            1 if mode.inputs == Inputs::ExternalDirection => {
                [self.turn(levels & 2 != 0, site), None]
            }
            _ if is_resetting => [None; 2],
            _ => match self.direction(mode.inputs, offset, levels) {
                Some(up) => {
                    let turned = self.turn(up, site);
                    let current =
                        double(memory, site.current).wrapping_add(if up { 1 } else { -1 });
                    set_double(memory, site.current, current);
                    [turned, (current == self.preset).then_some(site.equal)]
                }
                None => [None; 2],
            },
        };
        self.write_status(site, plan, memory);
        occurred
    }

    /// Whether an edge of a clock counts, and then whether up.
    fn direction(&self, inputs: Inputs, offset: u8, levels: u8) -> Option<bool> {
        let (first, second) = (levels & 1 != 0, levels & 2 != 0);
        let rose = if offset == 0 { first } else { second };
        match inputs {
            Inputs::InternalDirection | Inputs::ExternalDirection => rose.then_some(self.up),
            Inputs::TwoClocks => rose.then_some(offset == 0),
            // The first track leads when it changes to what the second is not, or the second to
            // what the first is.
            Inputs::Quadrature => {
                let up = (first != second) == (offset == 0);
                let counts = self.options & ONE_FOLD == 0 || offset == 0 && !second;
                counts.then_some(up)
            }
        }
    }

    fn turn(&mut self, up: bool, site: Site) -> Option<u8> {
        let turned = self.up != up;
        self.up = up;
        turned.then_some(site.direction)
    }

    fn write_status<P: ProgramMemory>(&self, site: Site, plan: &Plan<P>, memory: &mut Memory) {
        let current = double(memory, site.current);
        let bits = [
            (self.up, IS_UP),
            (current == self.preset, IS_EQUAL),
            (current > self.preset, IS_ABOVE),
        ];
        let status =
            bits.into_iter().filter(|(is_so, _)| *is_so).fold(0, |status, (_, bit)| status | bit);
        if let Some(address) = plan.byte_address(Area::Sm, site.special) {
            memory.set_byte(address, status);
        }
    }
}

/// A byte of special memory; 0 where the program does not name it.
pub(crate) fn special<P: ProgramMemory>(byte: u16, plan: &Plan<P>, memory: &Memory) -> u8 {
    plan.byte_address(Area::Sm, byte).map_or(0, |address| memory.byte(address))
}

/// A double word of special memory.
pub(crate) fn special_double<P: ProgramMemory>(byte: u16, plan: &Plan<P>, memory: &Memory) -> i32 {
    i32::from_be_bytes([0, 1, 2, 3].map(|offset| special(byte + offset, plan, memory)))
}

fn double(memory: &Memory, address: u16) -> i32 {
    i32::from_be_bytes([0, 1, 2, 3].map(|offset| memory.byte(address + offset)))
}

fn set_double(memory: &mut Memory, address: u16, value: i32) {
    for (address, byte) in (address..).zip(value.to_be_bytes()) {
        memory.set_byte(address, byte);
    }
}

#[cfg(test)]
mod tests {
    //! Edges in, counts and events out. The programs that use it are tested with the machines.

    use super::*;
    use plc_isa::{HEADER_LEN, Header, SM_IN_V, UNO};

    const RANGES_LEN: usize = 8;
    const LEN: usize = HEADER_LEN as usize + RANGES_LEN;

    /// A plan with the special memory of both counters.
    fn plan() -> Plan<[u8; LEN]> {
        let header = Header { v_ranges: 2, ..Header::default() };
        let mut image = [0; LEN];
        image[..usize::from(HEADER_LEN)].copy_from_slice(&header.to_bytes(&UNO));
        let words = [SM_IN_V + 36, 10, SM_IN_V + 136, 10 + 10];
        for (place, word) in image[usize::from(HEADER_LEN)..].chunks_exact_mut(2).zip(words) {
            place.copy_from_slice(&word.to_le_bytes());
        }
        Plan::trusted(image, header)
    }

    /// The counters with their inputs and memory.
    struct Bench {
        counters: HighSpeedCounters,
        memory: Memory,
        levels: u8,
    }

    impl Bench {
        fn new() -> Bench {
            Bench { counters: HighSpeedCounters::UNDEFINED, memory: Memory::new(), levels: 0 }
        }

        fn set(&mut self, byte: u16, bytes: &[u8]) {
            for (at, &value) in (byte..).zip(bytes) {
                self.memory.set_byte(plan().byte_address(Area::Sm, at).unwrap(), value);
            }
        }

        /// HDEF and HSC with this control byte, current value 0 and this preset.
        fn start(number: u8, mode: u8, control: u8, preset: i32) -> Bench {
            let mut bench = Bench::new();
            let special = if number == 0 { 36 } else { 136 };
            bench.set(special + 1, &[control]);
            bench.set(special + 6, &preset.to_be_bytes());
            assert!(bench.counters.define(number, mode, bench.levels, &plan(), &bench.memory));
            assert!(bench.counters.activate(number, &plan(), &mut bench.memory));
            bench
        }

        /// These inputs change one after the other. The events that came of it.
        fn toggle(&mut self, inputs: &[u8]) -> [u8; 4] {
            let (mut events, mut count) = ([0; 4], 0);
            for &input in inputs {
                self.levels ^= 1 << input;
                let occurred = self.counters.edge(input, self.levels, &plan(), &mut self.memory);
                for event in occurred.into_iter().flatten().flatten() {
                    events[count] = event;
                    count += 1;
                }
            }
            events
        }

        fn count(&self) -> i32 {
            double(&self.memory, HC0)
        }

        fn status(&self) -> u8 {
            special(36, &plan(), &self.memory)
        }
    }

    #[test]
    fn one_clock_up_to_the_preset_and_down() {
        let mut bench = Bench::start(0, 0, 0xF8, 2);
        assert_eq!(bench.toggle(&[0, 0]), [0; 4]);
        assert_eq!((bench.count(), bench.status()), (1, IS_UP));
        assert_eq!(bench.toggle(&[0, 0]), [12, 0, 0, 0]);
        assert_eq!((bench.count(), bench.status()), (2, IS_UP | IS_EQUAL));
        assert_eq!(bench.toggle(&[0, 0, 1, 2]), [0; 4]);
        assert_eq!((bench.count(), bench.status()), (3, IS_UP | IS_ABOVE));
        // Only the direction: count and preset stay.
        bench.set(37, &[0x90]);
        assert!(bench.counters.activate(0, &plan(), &mut bench.memory));
        assert_eq!(bench.toggle(&[0, 0]), [12, 0, 0, 0]);
        assert_eq!((bench.count(), bench.status()), (2, IS_EQUAL));
        // A new current value; and disabled.
        bench.set(37, &[0x40]);
        bench.set(38, &(-7i32).to_be_bytes());
        assert!(bench.counters.activate(0, &plan(), &mut bench.memory));
        assert_eq!(bench.toggle(&[0, 0]), [0; 4]);
        assert_eq!(bench.count(), -7);
    }

    #[test]
    fn the_second_input_is_the_direction() {
        let mut bench = Bench::start(0, 3, 0xF8, 100);
        // At HDEF the input was off: down.
        assert_eq!(bench.toggle(&[0, 0, 0, 0]), [0; 4]);
        assert_eq!(bench.count(), -2);
        assert_eq!(bench.toggle(&[1, 0, 0, 1]), [27, 27, 0, 0]);
        assert_eq!((bench.count(), bench.status()), (-1, 0));
    }

    #[test]
    fn one_clock_up_and_one_down() {
        let mut bench = Bench::start(0, 6, 0xF8, 1);
        assert_eq!(bench.toggle(&[0, 0, 0, 0]), [12, 0, 0, 0]);
        assert_eq!(bench.toggle(&[1, 1, 1, 0]), [27, 12, 27, 12]);
        assert_eq!(bench.count(), 1);
    }

    #[test]
    fn an_encoder_counts_four_edges_or_one() {
        const FORWARD: [u8; 4] = [0, 1, 0, 1];
        const BACK: [u8; 4] = [1, 0, 1, 0];
        let mut bench = Bench::start(0, 9, 0xF8, 100);
        assert_eq!(bench.toggle(&FORWARD), [0; 4]);
        assert_eq!(bench.count(), 4);
        assert_eq!(bench.toggle(&BACK), [27, 0, 0, 0]);
        assert_eq!((bench.count(), bench.status()), (0, 0));
        let mut bench = Bench::start(0, 9, 0xF8 | ONE_FOLD, 100);
        bench.toggle(&FORWARD);
        bench.toggle(&FORWARD);
        assert_eq!(bench.count(), 2);
        bench.toggle(&BACK);
        assert_eq!(bench.count(), 1);
        // Trembling on one edge goes nowhere.
        bench.toggle(&[0, 0, 0, 0]);
        assert_eq!(bench.count(), 1);
    }

    #[test]
    fn the_reset_input_resets_and_holds() {
        for (mode, step) in [(1, 1), (4, -1), (7, 1), (10, 1)] {
            let mut bench = Bench::start(0, mode, 0xF8, 100);
            bench.toggle(&[0]);
            assert_eq!(bench.count(), step, "mode {mode}");
            assert_eq!(bench.toggle(&[2, 0, 0]), [28, 0, 0, 0]);
            assert_eq!(bench.count(), 0);
            assert_eq!(bench.toggle(&[2])[0], 0);
        }
        let mut low = Bench::start(0, 1, 0xF8 | RESET_LOW, 100);
        low.toggle(&[0, 0]);
        assert_eq!(low.count(), 0, "the input is low from the start");
        low.toggle(&[2, 0, 0]);
        assert_eq!((low.count(), low.toggle(&[2])[0]), (1, 28));
    }

    #[test]
    fn the_other_counter_has_one_mode_and_an_input_of_its_own() {
        let mut bench = Bench::start(3, 0, 0xF8, 2);
        assert_eq!(bench.toggle(&[0, 1, 1, 0, 1, 2]), [32, 0, 0, 0]);
        assert_eq!((double(&bench.memory, HC3), bench.count()), (2, 0));
        assert_eq!(special(136, &plan(), &bench.memory), IS_UP | IS_EQUAL);
    }

    #[test]
    fn what_cannot_be_defined() {
        let define = |bench: &mut Bench, number, mode| {
            bench.counters.define(number, mode, 0, &plan(), &bench.memory)
        };
        for (number, mode) in
            [(0, 2), (0, 5), (0, 11), (0, 12), (3, 1), (3, 3), (1, 0), (4, 0), (5, 0)]
        {
            assert!(!define(&mut Bench::new(), number, mode), "HSC{number} mode {mode}");
        }
        let mut bench = Bench::new();
        assert!(!bench.counters.activate(0, &plan(), &mut bench.memory), "before HDEF");
        assert!(define(&mut bench, 0, 0) && !define(&mut bench, 0, 0), "twice");
        assert!(define(&mut bench, 3, 0), "each has its input");
        // The second input of HSC0 is the clock of HSC3.
        let mut bench = Bench::new();
        assert!(define(&mut bench, 3, 0) && !define(&mut bench, 0, 9));
        let mut bench = Bench::new();
        assert!(define(&mut bench, 0, 3) && !define(&mut bench, 3, 0));
        let mut bench = Bench::new();
        assert!(define(&mut bench, 0, 1) && define(&mut bench, 3, 0), "one clock and a reset");
    }
}
