//! The reference interpreter: its state and what its instructions share. What each of them does,
//! instructions.rs says.

use plc_isa::{
    Bit, ByteSource, Flow, LogicStack, OfWidth, Plan, Program, ProgramMemory, Relation,
    TimerResolution, WordSource, execute, timer_resolution,
};

use crate::calls::Calls;
use crate::clock::Clock;
use crate::counter::Counter;
use crate::environment::Environment;
use crate::events::Events;
use crate::memory::Memory;
use crate::range;
use crate::scan::Scan;
use crate::timer::Timer;

/// Why the program was left.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exit {
    /// Its end was reached, or END executed.
    End,
    /// STOP was executed.
    Stop,
    /// The watchdog time was over.
    Watchdog,
    /// There was no instruction. Cannot happen in a verified image.
    Undefined,
    /// A comparison read through an illegal pointer.
    ComparedPointer,
    /// A comparison read an illegal real.
    ComparedReal,
}

/// Bytes of a jump or of NEXT, about.
const JUMP_LEN: u16 = 3;

/// The state of one program execution.
#[derive(Debug)]
pub struct Interpreter<'a, P, E> {
    pub(crate) program: &'a Program<P>,
    pub(crate) memory: &'a mut Memory,
    pub(crate) environment: &'a mut E,
    pub(crate) clock: &'a mut Clock,
    pub(crate) first_scan: bool,
    pub(crate) stack: LogicStack,
    pub(crate) calls: Calls,
    pub(crate) events: &'a mut Events,
    /// Why the program is left, once it is.
    pub(crate) exit: Exit,
}

impl<'a, P: ProgramMemory, E: Environment> Interpreter<'a, P, E> {
    /// An execution of the program in this scan.
    pub fn new(scan: Scan<'a, P, E, Events>) -> Self {
        let Scan { program, memory, environment, clock, first_scan, events } = scan;
        let (stack, calls, exit) = (LogicStack::EMPTY, Calls::NONE, Exit::End);
        Interpreter { program, memory, environment, clock, first_scan, stack, calls, events, exit }
    }
}

impl<P: ProgramMemory, E: Environment> Interpreter<'_, P, E> {
    /// Executes the program once. Returns why it was left, and the offset of the instruction that
    /// left it.
    pub fn run(self) -> (Exit, u16) {
        let memory = self.program.memory();
        if memory.is_wide() {
            self.run_code(&OfWidth::<P, true>(memory))
        } else {
            self.run_code(&OfWidth::<P, false>(memory))
        }
    }

    /// The same, with what the code is read through.
    fn run_code<C: ProgramMemory>(mut self, code: &C) -> (Exit, u16) {
        let mut pc = self.program.code_at();
        loop {
            let flow = execute(&mut self, code, pc);
            self.tell_executed(pc);
            match flow {
                Flow::Jump(next) => pc = next,
                Flow::Leave | Flow::Next => return (self.exit, pc),
            }
        }
    }

    /// Executes the instruction at this offset. Where the program goes on, or that it is left, for
    /// the reason that [`exit`](Self::exit) says. For an engine that executes others itself.
    #[inline(always)]
    pub fn step(&mut self, pc: u16) -> Flow {
        let program = self.program;
        execute(self, program.memory(), pc)
    }

    /// Tells the environment that the instruction at this offset was executed, for an engine that
    /// is watched.
    #[inline(always)]
    pub fn tell_executed(&mut self, at: u16) {
        self.environment.executed(at, self.stack, self.memory);
    }

    /// Why the program was left.
    pub fn exit(&self) -> Exit {
        self.exit
    }

    /// Data memory between two instructions, for a caller who executes them one by one.
    pub fn memory(&mut self) -> &mut Memory {
        self.memory
    }

    /// The logic stack between two instructions, for the same.
    pub fn stack(&mut self) -> &mut LogicStack {
        &mut self.stack
    }

    pub(crate) fn plan(&self) -> &Plan<P> {
        self.program.plan()
    }

    #[inline]
    pub(crate) fn words(&self, relation: Relation, in1: WordSource, in2: WordSource) -> bool {
        relation.holds(self.memory.int_of(in1), self.memory.int_of(in2))
    }

    #[inline]
    pub(crate) fn bytes(&self, relation: Relation, in1: ByteSource, in2: ByteSource) -> bool {
        relation.holds(self.memory.byte_of(in1), self.memory.byte_of(in2))
    }

    /// An integer box: `compute(OUT, IN1)` gives the result, `None` when it does not fit.
    #[inline]
    pub(crate) fn int_box(
        &mut self,
        in1: WordSource,
        out: u16,
        compute: fn(i16, i16) -> Option<i16>,
        write: fn(&mut Memory, u16, Option<i16>),
    ) -> Flow {
        if self.stack.top() {
            let result = compute(self.memory.int(out), self.memory.int_of(in1));
            write(self.memory, out, result);
        }
        Flow::Next
    }

    pub(crate) fn bit_range(&mut self, bit: Bit, n: ByteSource, value: bool) -> Flow {
        if self.stack.top() {
            let count = self.memory.byte_of(n);
            range::write(self.memory, self.program.plan(), bit, count, value);
        }
        Flow::Next
    }

    /// The count of a reset of timers or counters, 0 when the range would pass number 255.
    pub(crate) fn numbers(&self, first: u8, n: ByteSource) -> u8 {
        let count = self.memory.byte_of(n);
        if u16::from(first) + u16::from(count) <= 256 { count } else { 0 }
    }

    pub(crate) fn timer(&mut self, slot: u8, pt: WordSource) -> Flow {
        let (slot, preset) = (self.plan().timer(slot), self.memory.int_of(pt));
        let ticks = match timer_resolution(slot.number) {
            TimerResolution::Ms1 => {
                self.refresh();
                0
            }
            TimerResolution::Ms10 => 0,
            TimerResolution::Ms100 => self.clock.ticks_100,
        };
        Timer { memory: self.memory, slot }.execute(self.stack.top(), preset, ticks);
        self.events.look_at_timers(self.program.plan(), self.memory);
        Flow::Next
    }

    pub(crate) fn refresh(&mut self) {
        let plan = self.program.plan();
        self.clock.refresh_timers(self.environment, self.memory, plan);
        self.events.look_at_timers(plan, self.memory);
    }

    pub(crate) fn counter(&mut self, slot: u8) -> Counter<'_> {
        let slot = self.plan().counter(slot);
        Counter { memory: self.memory, slot, first_scan: self.first_scan }
    }

    /// Begins a routine with a stack of its own.
    pub(crate) fn enter(&mut self, routine: u8) -> Flow {
        self.stack = LogicStack::EMPTY;
        self.stack.set_top(true);
        Flow::Jump(self.plan().routine(routine))
    }

    pub(crate) fn leave(&mut self, exit: Exit) -> Flow {
        self.exit = exit;
        Flow::Leave
    }

    /// Goes to an offset; back over code only as long as the watchdog allows.
    pub(crate) fn go_to(&mut self, target: u16, here: u16) -> Flow {
        // What was executed: from the target to the jump, and the jump.
        if target <= here && self.environment.is_overdue((here - target).saturating_add(JUMP_LEN)) {
            return self.leave(Exit::Watchdog);
        }
        Flow::Jump(target)
    }
}
