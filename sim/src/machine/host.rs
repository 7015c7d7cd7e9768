//! The host machine: the reference interpreter with virtual time. What the board does, without a board.

use awl_asm::Address;
use plc_isa::{AnalogInput, Area, Bit, ImageError, Plan, counter_bit, timer_bit};
use plc_vm::{Environment, Fault, Inputs, Memory, Plc};

use crate::machine::{Machine, MachineError, Mode};
use crate::operand::Operand;

/// Bytes of looped code that count as a millisecond of execution: 20 cycles of the board for an
/// instruction of 2.5 bytes, at 16 MHz.
const LOOPED_BYTES_PER_MS: u64 = 2_000;
/// However often a program executes WDR, a scan ends after this time.
const SCAN_MS_MAX: u64 = 60_000;

/// Virtual time, which stands still while a scan runs. Only loops cost watchdog time.
#[derive(Debug)]
struct VirtualTime {
    now_ms: u32,
    /// Since the scan started, or since WDR.
    looped_bytes: u64,
    looped_bytes_max: u64,
    /// Since the scan started.
    scan_bytes: u64,
}

impl VirtualTime {
    fn is_at_ceiling(&self) -> bool {
        self.scan_bytes > SCAN_MS_MAX * LOOPED_BYTES_PER_MS
    }
}

impl Environment for VirtualTime {
    fn now_ms(&mut self) -> u32 {
        self.now_ms
    }

    fn is_overdue(&mut self, bytes: u16) -> bool {
        self.looped_bytes += u64::from(bytes);
        self.scan_bytes += u64::from(bytes);
        self.looped_bytes > self.looped_bytes_max || self.is_at_ceiling()
    }

    fn retrigger_watchdog(&mut self) {
        self.looped_bytes = 0;
    }
}

/// Says where an offset of the image is in the source; empty when that is not known.
pub type PlaceOf = Box<dyn Fn(u16) -> String>;

/// A PLC on the host.
pub struct Host {
    plc: Plc<Vec<u8>>,
    memory: Memory,
    inputs: Inputs,
    time: VirtualTime,
    clock_start_ms: u32,
    place_of: PlaceOf,
}

impl Host {
    /// A PLC that is switched on with this image and goes to RUN. A bad image leaves it in STOP with a fault.
    pub fn new(image: Vec<u8>, place_of: PlaceOf) -> Host {
        let mut host = Host {
            plc: Plc::new(),
            memory: Memory::new(),
            inputs: Inputs::default(),
            time: VirtualTime { now_ms: 0, looped_bytes: 0, looped_bytes_max: 0, scan_bytes: 0 },
            clock_start_ms: 0,
            place_of,
        };
        if host.plc.load(&mut host.memory, image).is_ok() {
            host.plc.run();
        }
        if let Some(plan) = host.plan() {
            host.time.looped_bytes_max = u64::from(plan.header.settings.watchdog_ms) * LOOPED_BYTES_PER_MS;
        }
        host
    }

    /// Lets the millisecond clock begin at another value, to come near its wrap.
    pub fn start_clock_at(&mut self, clock_ms: u32) {
        self.clock_start_ms = clock_ms;
    }

    /// STOP to RUN, as by a command from outside.
    pub fn run(&mut self) {
        self.plc.run();
    }

    /// RUN to STOP, as by a command from outside.
    pub fn stop(&mut self) {
        self.plc.stop();
    }

    /// The data memory, for comparisons with other machines.
    pub fn memory(&self) -> &Memory {
        &self.memory
    }

    fn plan(&self) -> Option<&Plan<Vec<u8>>> {
        self.plc.program().map(|program| program.plan())
    }

    /// Where a byte of an area lives; `None` where the program has none planned.
    fn byte_address(&self, area: Area, byte: u16) -> Option<u16> {
        match area.page_start() {
            Some(start) => Some(start + byte),
            None => self.plan()?.v_address(byte),
        }
    }

    fn current_value_address(&self, operand: Operand) -> Option<u16> {
        match operand {
            Operand::TimerCurrent(number) => self.plan()?.timer_slot(number).map(|slot| slot.address),
            Operand::CounterCurrent(number) => self.plan()?.counter_slot(number).map(|slot| slot.address),
            Operand::At(_) => None,
        }
    }

    /// A byte as seen from outside: inputs and outputs are the physical points.
    fn outside_byte(&self, area: Area, byte: u16) -> Option<u8> {
        match area {
            Area::I => self.inputs.digital.get(usize::from(byte)).copied(),
            Area::Q => Some(self.plc.outputs(&self.memory, byte as u8)),
            _ => Some(self.memory.byte(self.byte_address(area, byte)?)),
        }
    }

    fn set_outside_byte(&mut self, area: Area, byte: u16, value: u8) -> Option<()> {
        match area {
            Area::I => *self.inputs.digital.get_mut(usize::from(byte))? = value,
            _ => {
                let address = self.byte_address(area, byte)?;
                self.memory.set_byte(address, value);
            }
        }
        Some(())
    }

    fn analog(&mut self, input: AnalogInput, value: u16) {
        let (channel, raw, scaled) = match input {
            AnalogInput::Raw(channel) => (channel, value, AnalogInput::scale(value)),
            AnalogInput::Scaled(channel) => (channel, AnalogInput::unscale(value), value),
        };
        if let (Some(raw_place), Some(scaled_place)) =
            (self.inputs.raw.get_mut(usize::from(channel)), self.inputs.scaled.get_mut(usize::from(channel)))
        {
            (*raw_place, *scaled_place) = (raw, scaled);
        }
    }

    fn read_address(&self, address: Address) -> Option<i32> {
        Some(match address {
            Address::Bit { area, byte, bit } => i32::from(self.outside_byte(area, byte)? >> bit & 1),
            Address::Byte { area, byte } => i32::from(self.outside_byte(area, byte)?),
            Address::Word { area, byte } => {
                let bytes = [self.outside_byte(area, byte)?, self.outside_byte(area, byte + 1)?];
                i32::from(i16::from_be_bytes(bytes))
            }
            Address::Timer(number) => i32::from(self.memory.bit(timer_bit(number))),
            Address::Counter(number) => i32::from(self.memory.bit(counter_bit(number))),
            Address::Analog(AnalogInput::Raw(channel)) => {
                self.inputs.raw.get(usize::from(channel)).map_or(0, |&value| i32::from(value))
            }
            Address::Analog(AnalogInput::Scaled(channel)) => {
                self.inputs.scaled.get(usize::from(channel)).map_or(0, |&value| i32::from(value))
            }
        })
    }

    fn write_address(&mut self, address: Address, value: i32) -> Option<()> {
        match address {
            Address::Bit { area: Area::I, byte, bit } => {
                let old = self.outside_byte(Area::I, byte)?;
                self.set_outside_byte(Area::I, byte, old & !(1 << bit) | u8::from(value != 0) << bit)?;
            }
            Address::Bit { area, byte, bit } => {
                let address = self.byte_address(area, byte)?;
                self.memory.set_bit(Bit { address, bit }, value != 0);
            }
            Address::Byte { area, byte } => self.set_outside_byte(area, byte, value as u8)?,
            Address::Word { area, byte } => {
                let [high, low] = (value as u16).to_be_bytes();
                self.set_outside_byte(area, byte, high)?;
                self.set_outside_byte(area, byte + 1, low)?;
            }
            Address::Timer(number) => self.memory.set_bit(timer_bit(number), value != 0),
            Address::Counter(number) => self.memory.set_bit(counter_bit(number), value != 0),
            Address::Analog(input) => self.analog(input, value as u16),
        }
        Some(())
    }

    fn place(&self, at: u16) -> String {
        let place = (self.place_of)(at);
        if place.is_empty() { format!("at offset {at:#06x} of the image") } else { format!("at {place}") }
    }
}

impl Machine for Host {
    fn write(&mut self, operand: Operand, value: i32) -> Result<(), MachineError> {
        let written = match operand {
            Operand::At(address) => self.write_address(address, value),
            Operand::TimerCurrent(_) | Operand::CounterCurrent(_) => {
                self.current_value_address(operand).map(|address| self.memory.set_word(address, value as u16))
            }
        };
        written.ok_or_else(|| not_used(operand))
    }

    fn read(&mut self, operand: Operand) -> Result<i32, MachineError> {
        let value = match operand {
            Operand::At(address) => self.read_address(address),
            Operand::TimerCurrent(_) | Operand::CounterCurrent(_) => {
                self.current_value_address(operand).map(|address| i32::from(self.memory.int(address)))
            }
        };
        value.ok_or_else(|| not_used(operand))
    }

    fn scan(&mut self, now_ms: u64) {
        // The PLC's clock has 32 bits and wraps.
        self.time.now_ms = self.clock_start_ms.wrapping_add(now_ms as u32);
        (self.time.looped_bytes, self.time.scan_bytes) = (0, 0);
        self.plc.scan(&mut self.memory, &self.inputs, &mut self.time);
    }

    fn mode(&self) -> Mode {
        match self.plc.mode() {
            plc_vm::Mode::Run => Mode::Run,
            plc_vm::Mode::Stop => Mode::Stop,
        }
    }

    fn fault(&self) -> Option<String> {
        Some(match self.plc.fault()? {
            Fault::BadImage(ImageError { fault, at }) => {
                format!("bad image: {} (offset {at:#06x})", fault.message())
            }
            Fault::Watchdog { at } => {
                let limit_ms = self.plan().map_or(0, |plan| u64::from(plan.header.settings.watchdog_ms));
                // WDR may have put the end off until it could be put off no longer.
                let limit_ms = if self.time.is_at_ceiling() { SCAN_MS_MAX } else { limit_ms };
                format!("watchdog: the scan took longer than {limit_ms} ms; the program was {}", self.place(at))
            }
            Fault::UndefinedInstruction { at } => format!("there is no instruction {}", self.place(at)),
            Fault::ProgramChanged => "self-test: the program in flash has changed".to_string(),
            Fault::StackOverflow => "self-test: the stack has grown into data memory".to_string(),
            Fault::Hang => "the hardware watchdog: the firmware or its clock stood still".to_string(),
            Fault::Panic => "the firmware met a state that it holds for impossible".to_string(),
        })
    }

    fn pin_levels(&mut self) -> u8 {
        let inverted = self.plan().map_or(0, |plan| plan.header.settings.invert_outputs);
        self.plc.outputs(&self.memory, 0) ^ inverted
    }

    fn drive_pin(&mut self, input: u8, high: bool) {
        let inverted = self.plan().map_or(0, |plan| plan.header.settings.invert_inputs);
        let logical = high ^ (inverted >> (input & 7) & 1 != 0);
        if let Some(byte) = self.inputs.digital.first_mut() {
            *byte = *byte & !(1 << (input & 7)) | u8::from(logical) << (input & 7);
        }
    }
}

fn not_used(operand: Operand) -> MachineError {
    MachineError(format!("the program does not use {}", operand.address()))
}
