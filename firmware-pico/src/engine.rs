//! Executes programs as code of the processor: plc-thumb translates, here the translation is
//! entered, and the interpreter is called from it.
#![allow(unsafe_code)]

use core::arch::naked_asm;
use core::cell::UnsafeCell;
use core::ffi::c_void;

use plc_isa::{Flow, LogicStack, Program, ProgramMemory};
use plc_thumb::Translation;
use plc_vm::{Environment, Events, Exit, Interpreter, Scan};

/// Halfwords of code: what RAM has left.
const CODE_LEN: usize = 9 * 1024;
/// Places where code can be entered.
const ENTRIES: usize = 512;

/// The code of the program in force.
type Code = Translation<CODE_LEN, ENTRIES>;

/// Where the code is: too large for the stack.
struct Place(UnsafeCell<Code>);

// SAFETY: only `Thumb::new` uses it, once.
unsafe impl Sync for Place {}

static PLACE: Place = Place(UnsafeCell::new(Translation::NONE));

/// The engine.
pub struct Thumb {
    code: &'static mut Code,
}

impl Thumb {
    /// The one engine. Once.
    pub fn new() -> Thumb {
        // SAFETY: the board calls it once, so that there is no other reference.
        Thumb { code: unsafe { &mut *PLACE.0.get() } }
    }
}

impl<P: ProgramMemory> runtime::Engine<P> for Thumb {
    fn prepare(&mut self, program: &Program<P>) {
        self.code.translate(program);
    }

    #[inline(always)]
    fn run<E: Environment>(
        &mut self,
        scan: Scan<'_, P, E, Events>,
        is_watched: bool,
    ) -> (Exit, u16) {
        let at = scan.program().code_at();
        let interpreter = Interpreter::new(scan);
        let run = Run { step: step::<P, E>, interpreter, code: self.code, at };
        if is_watched { run.step_by_step() } else { run.translated() }
    }
}

/// Bit 0 of an address where there is code of Thumb.
const THUMB: u32 = 1;

/// The address of the code for the instruction at this offset, as BX takes it.
fn address(code: &Code, offset: u16) -> Option<u32> {
    let halfword = code.code().as_ptr().wrapping_add(code.entry(offset)?);
    Some(halfword.expose_provenance() as u32 | THUMB)
}

/// Answers of [`step`] that are no address: the code goes on, or is left.
const GO_ON: u32 = 0;
const LEAVE: u32 = 1;

/// What [`step`] is called by: offset and length of the instruction, the run, the logic stack.
/// Returns one of the answers or the address where code goes on, and above it the logic stack.
type Step = unsafe extern "C" fn(u32, u32, *mut c_void, u32) -> u64;

/// The execution of a program in a scan.
#[repr(C)]
struct Run<'r, 'a, P, E> {
    /// The first word, where `enter` finds it.
    step: Step,
    interpreter: Interpreter<'a, P, E>,
    code: &'r Code,
    /// Where the program is, or was left.
    at: u16,
}

impl<P: ProgramMemory, E: Environment> Run<'_, '_, P, E> {
    /// The interpreter alone: what somebody watches is written down after every instruction.
    #[inline(never)]
    fn step_by_step(mut self) -> (Exit, u16) {
        loop {
            let flow = self.interpret(self.at);
            self.interpreter.tell_executed(self.at);
            match flow {
                Flow::Jump(next) => self.at = next,
                Flow::Leave | Flow::Next => return (self.interpreter.exit(), self.at),
            }
        }
    }

    fn translated(mut self) -> (Exit, u16) {
        let start = address(self.code, self.at).unwrap_or_else(|| self.go_on_at(self.at));
        if start != LEAVE {
            let data = self.interpreter.memory().bytes_mut().as_mut_ptr().expose_provenance();
            let stack = self.interpreter.stack().bits().into();
            // SAFETY: the address is that of a translation of this program, which was checked, so
            // that it reads and writes data memory alone and ends with a step. Nobody else uses
            // memory or run meanwhile.
            unsafe { enter(start, data as u32, stack, (&raw mut self).cast()) };
        }
        (self.interpreter.exit(), self.at)
    }

    /// Executes an instruction. What the translation does then.
    #[inline(always)]
    fn step(&mut self, pc: u16, len: u16) -> u32 {
        match self.interpret(pc) {
            Flow::Jump(next) if len > 0 && next == pc.wrapping_add(len) => GO_ON,
            Flow::Jump(next) => address(self.code, next).unwrap_or_else(|| self.go_on_at(next)),
            Flow::Leave | Flow::Next => self.leave(pc),
        }
    }

    /// Executes instructions until there is code for the next, or the program is left.
    #[inline(never)]
    fn go_on_at(&mut self, mut pc: u16) -> u32 {
        loop {
            match self.interpret(pc) {
                Flow::Jump(next) => pc = next,
                Flow::Leave | Flow::Next => return self.leave(pc),
            }
            if let Some(address) = address(self.code, pc) {
                return address;
            }
        }
    }

    /// The whole interpreter, once.
    #[inline(never)]
    fn interpret(&mut self, pc: u16) -> Flow {
        self.interpreter.step(pc)
    }

    fn leave(&mut self, pc: u16) -> u32 {
        self.at = pc;
        LEAVE
    }
}

/// See [`Step`].
unsafe extern "C" fn step<P: ProgramMemory, E: Environment>(
    pc: u32,
    len: u32,
    run: *mut c_void,
    stack: u32,
) -> u64 {
    // SAFETY: `translated` has given `enter` this run, and looks at it only when that has returned.
    let run = unsafe { &mut *run.cast::<Run<'_, '_, P, E>>() };
    *run.interpreter.stack() = LogicStack::of_bits(stack as u16);
    let next = run.step(pc as u16, len as u16);
    u64::from(run.interpreter.stack().bits()) << 32 | u64::from(next)
}

/// Enters translated code with the address of data memory, the logic stack and a run, and returns
/// when the program is left. Registers are those of [`plc_thumb::registers`].
#[unsafe(naked)]
unsafe extern "C" fn enter(code: u32, data: u32, stack: u32, run: *mut c_void) {
    naked_asm!(
        "push {{r3, r4, r5, r6, r7, lr}}", // the run is on top
        "movs r5, r1",
        "movs r4, r2",
        "ldr r6, 1f",
        "bx r0",
        ".p2align 2",
        "1: .word {call_step}",
        call_step = sym call_step,
    )
}

/// What translated code calls: `step` of the run, with the logic stack. Then it goes on after the
/// call, elsewhere, or back to who has called `enter`.
#[unsafe(naked)]
unsafe extern "C" fn call_step() {
    naked_asm!(
        "push {{r3, lr}}", // R3 keeps the stack at eight bytes
        "ldr r2, [sp, #8]", // the run
        "movs r3, r4",
        "ldr r4, [r2]", // its step; the logic stack comes back anew
        "blx r4",
        "movs r4, r1",
        "pop {{r2, r3}}", // R3: after the call
        "cmp r0, #{leave}",
        "beq 1f",
        "bhi 2f",
        "bx r3",
        "2: bx r0",
        "1: pop {{r3, r4, r5, r6, r7, pc}}",
        leave = const LEAVE,
    )
}
