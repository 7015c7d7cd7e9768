//! What the instructions of the core do: one method for each of the table. Those of modules are in
//! `modules`.

use plc_isa::{
    Bit, ByteSource, ENO, Execute, Flow, LEFT_ENO, Op, OperandKind, OperandReader, Operands,
    ProgramMemory, Relation, SM_START, WordSource, kinds,
};

use crate::calls::Frame;
use crate::counter;
use crate::edge;
use crate::environment::Environment;
use crate::interpreter::{Exit, Interpreter};
use crate::math;
use crate::range;
use crate::special::PROGRAMMING_ERROR;
use crate::timer::Timer;

/// Bytes of code that take about as long as an interrupt routine's begin and end.
const INTERRUPT_LEN: u16 = 75;
/// Bytes of CALL.
const CALL_LEN: u16 = 2;
/// Where SMB1 is, the status of results.
const STATUS: u16 = SM_START + 1;

impl<P: ProgramMemory, E: Environment> Execute for Interpreter<'_, P, E> {
    #[inline]
    fn load(&mut self, bit: Bit) -> Flow {
        self.stack.push(self.memory.bit(bit));
        Flow::Next
    }

    #[inline]
    fn load_not(&mut self, bit: Bit) -> Flow {
        self.stack.push(!self.memory.bit(bit));
        Flow::Next
    }

    #[inline]
    fn and(&mut self, bit: Bit) -> Flow {
        self.stack.and(self.memory.bit(bit));
        Flow::Next
    }

    #[inline]
    fn and_not(&mut self, bit: Bit) -> Flow {
        self.stack.and(!self.memory.bit(bit));
        Flow::Next
    }

    #[inline]
    fn or(&mut self, bit: Bit) -> Flow {
        self.stack.or(self.memory.bit(bit));
        Flow::Next
    }

    #[inline]
    fn or_not(&mut self, bit: Bit) -> Flow {
        self.stack.or(!self.memory.bit(bit));
        Flow::Next
    }

    #[inline]
    fn not(&mut self) -> Flow {
        self.stack.set_top(!self.stack.top());
        Flow::Next
    }

    fn edge_up(&mut self, edge: u8) -> Flow {
        let place = self.plan().edge(edge);
        let rose = edge::rose(self.memory, place, self.stack.top(), self.first_scan);
        self.stack.set_top(rose);
        Flow::Next
    }

    fn edge_down(&mut self, edge: u8) -> Flow {
        let place = self.plan().edge(edge);
        let fell = edge::fell(self.memory, place, self.stack.top(), self.first_scan);
        self.stack.set_top(fell);
        Flow::Next
    }

    #[inline]
    fn assign(&mut self, bit: Bit) -> Flow {
        self.memory.set_bit(bit, self.stack.top());
        Flow::Next
    }

    #[inline]
    fn set(&mut self, bit: Bit, n: ByteSource) -> Flow {
        self.bit_range(bit, n, true)
    }

    #[inline]
    fn reset(&mut self, bit: Bit, n: ByteSource) -> Flow {
        self.bit_range(bit, n, false)
    }

    fn reset_timers(&mut self, first: u8, n: ByteSource) -> Flow {
        if self.stack.top() {
            let count = self.numbers(first, n);
            range::write(self.memory, self.program.plan(), plc_isa::timer_bit(first), count, false);
            for slot in self.program.plan().timers().filter(|slot| is_in(slot.number, first, count))
            {
                Timer { memory: self.memory, slot }.reset();
            }
        }
        Flow::Next
    }

    fn reset_counters(&mut self, first: u8, n: ByteSource) -> Flow {
        if self.stack.top() {
            let count = self.numbers(first, n);
            range::write(
                self.memory,
                self.program.plan(),
                plc_isa::counter_bit(first),
                count,
                false,
            );
            for slot in
                self.program.plan().counters().filter(|slot| is_in(slot.number, first, count))
            {
                counter::reset(self.memory, slot);
            }
        }
        Flow::Next
    }

    #[inline]
    fn no_operation(&mut self, _n: u8) -> Flow {
        Flow::Next
    }

    #[inline]
    fn and_load(&mut self) -> Flow {
        let top = self.stack.pop();
        self.stack.and(top);
        Flow::Next
    }

    #[inline]
    fn or_load(&mut self) -> Flow {
        let top = self.stack.pop();
        self.stack.or(top);
        Flow::Next
    }

    #[inline]
    fn logic_push(&mut self) -> Flow {
        self.stack.push(self.stack.top());
        Flow::Next
    }

    #[inline]
    fn logic_read(&mut self) -> Flow {
        self.stack.set_top(self.stack.level(1));
        Flow::Next
    }

    #[inline]
    fn logic_pop(&mut self) -> Flow {
        self.stack.pop();
        Flow::Next
    }

    #[inline]
    fn load_stack(&mut self, n: u8) -> Flow {
        self.stack.push(self.stack.level(n));
        Flow::Next
    }

    #[inline]
    fn load_word(&mut self, relation: Relation, in1: WordSource, in2: WordSource) -> Flow {
        self.stack.push(self.words(relation, in1, in2));
        Flow::Next
    }

    #[inline]
    fn and_word(&mut self, relation: Relation, in1: WordSource, in2: WordSource) -> Flow {
        self.stack.and(self.words(relation, in1, in2));
        Flow::Next
    }

    #[inline]
    fn or_word(&mut self, relation: Relation, in1: WordSource, in2: WordSource) -> Flow {
        self.stack.or(self.words(relation, in1, in2));
        Flow::Next
    }

    #[inline]
    fn load_byte(&mut self, relation: Relation, in1: ByteSource, in2: ByteSource) -> Flow {
        self.stack.push(self.bytes(relation, in1, in2));
        Flow::Next
    }

    #[inline]
    fn and_byte(&mut self, relation: Relation, in1: ByteSource, in2: ByteSource) -> Flow {
        self.stack.and(self.bytes(relation, in1, in2));
        Flow::Next
    }

    #[inline]
    fn or_byte(&mut self, relation: Relation, in1: ByteSource, in2: ByteSource) -> Flow {
        self.stack.or(self.bytes(relation, in1, in2));
        Flow::Next
    }

    #[inline]
    fn move_byte(&mut self, input: ByteSource, out: u16) -> Flow {
        if self.stack.top() {
            let value = self.memory.byte_of(input);
            self.memory.set_byte(out, value);
        }
        Flow::Next
    }

    #[inline]
    fn move_word(&mut self, input: WordSource, out: u16) -> Flow {
        if self.stack.top() {
            let value = self.memory.int_of(input);
            self.memory.set_int(out, value);
        }
        Flow::Next
    }

    fn add_int(&mut self, in1: WordSource, out: u16) -> Flow {
        self.int_box(in1, out, i16::checked_add, math::write_result)
    }

    fn sub_int(&mut self, in1: WordSource, out: u16) -> Flow {
        self.int_box(in1, out, i16::checked_sub, math::write_result)
    }

    fn mul_int(&mut self, in1: WordSource, out: u16) -> Flow {
        self.int_box(in1, out, i16::checked_mul, math::write_product)
    }

    fn div_int(&mut self, in1: WordSource, out: u16) -> Flow {
        if self.stack.top() {
            let divisor = self.memory.int_of(in1);
            math::divide(self.memory, out, divisor);
        }
        Flow::Next
    }

    fn increment_word(&mut self, out: u16) -> Flow {
        if self.stack.top() {
            let result = self.memory.int(out).overflowing_add(1);
            math::write_wrapped(self.memory, out, result);
        }
        Flow::Next
    }

    fn decrement_word(&mut self, out: u16) -> Flow {
        if self.stack.top() {
            let result = self.memory.int(out).overflowing_sub(1);
            math::write_wrapped(self.memory, out, result);
        }
        Flow::Next
    }

    fn on_delay(&mut self, timer: u8, pt: WordSource) -> Flow {
        self.timer(timer, pt)
    }

    fn off_delay(&mut self, timer: u8, pt: WordSource) -> Flow {
        self.timer(timer, pt)
    }

    fn retentive_on_delay(&mut self, timer: u8, pt: WordSource) -> Flow {
        self.timer(timer, pt)
    }

    fn count_up(&mut self, counter: u8, pv: WordSource) -> Flow {
        let (stack, preset) = (self.stack, self.memory.int_of(pv));
        self.counter(counter).up(stack, preset);
        Flow::Next
    }

    fn count_down(&mut self, counter: u8, pv: WordSource) -> Flow {
        let (stack, preset) = (self.stack, self.memory.int_of(pv));
        self.counter(counter).down(stack, preset);
        Flow::Next
    }

    fn count_up_down(&mut self, counter: u8, pv: WordSource) -> Flow {
        let (stack, preset) = (self.stack, self.memory.int_of(pv));
        self.counter(counter).up_down(stack, preset);
        Flow::Next
    }

    fn for_loop(&mut self, indx: u16, init: WordSource, last: WordSource, end: u16) -> Flow {
        if !self.stack.top() {
            return Flow::Jump(end);
        }
        let (init, last) = (self.memory.int_of(init), self.memory.int_of(last));
        self.memory.set_int(indx, init);
        if init > last { Flow::Jump(end) } else { Flow::Next }
    }

    /// FINAL is read again after every pass: a program may change it inside the loop.
    fn next_pass(&mut self, start: u16, here: u16) -> Flow {
        let mut reader = OperandReader::new(self.program.memory(), start, start.wrapping_add(1), 0);
        let indx = kinds::WordOut::read(&mut reader);
        let _init = kinds::AnyInt::read(&mut reader);
        let last = kinds::AnyInt::read(&mut reader);
        let _end = kinds::LoopEnd::read(&mut reader);
        let passed = self.memory.int(indx);
        let again = passed < self.memory.int_of(last);
        self.memory.set_int(indx, passed.wrapping_add(1));
        self.stack.set_top(true);
        if again { self.go_to(reader.position(), here) } else { Flow::Next }
    }

    fn jump(&mut self, label: u16, here: u16) -> Flow {
        if !self.stack.top() {
            return Flow::Next;
        }
        self.go_to(self.plan().label(label), here)
    }

    #[inline]
    fn label(&mut self, _n: u16) -> Flow {
        Flow::Next
    }

    fn end(&mut self) -> Flow {
        if self.stack.top() { self.leave(Exit::End) } else { Flow::Next }
    }

    fn stop(&mut self) -> Flow {
        if self.stack.top() { self.leave(Exit::Stop) } else { Flow::Next }
    }

    fn watchdog_reset(&mut self) -> Flow {
        if self.stack.top() {
            self.environment.retrigger_watchdog();
        }
        Flow::Next
    }

    fn refresh_timers(&mut self) -> Flow {
        self.refresh();
        Flow::Next
    }

    /// An engine that sees every instruction anyway has nothing to look for.
    fn approach(&mut self) -> Flow {
        Flow::Next
    }

    fn main_end(&mut self) -> Flow {
        self.leave(Exit::End)
    }

    fn load_scr(&mut self, bit: Bit, scr: Bit) -> Flow {
        let is_active = self.memory.bit(bit);
        self.memory.set_bit(scr, is_active);
        self.stack.push(is_active);
        Flow::Next
    }

    fn and_scr(&mut self, scr: Bit) -> Flow {
        self.stack.and(self.memory.bit(scr));
        Flow::Next
    }

    fn scr_transition(&mut self, bit: Bit, own: Bit) -> Flow {
        if self.stack.top() {
            self.memory.set_bit(own, false);
            self.memory.set_bit(bit, true);
        }
        Flow::Next
    }

    fn scr_end(&mut self) -> Flow {
        Flow::Next
    }

    /// The S stack is what it was: nothing looks at it before the next LSCR.
    fn conditional_scr_end(&mut self, label: u16, here: u16) -> Flow {
        self.jump(label, here)
    }

    fn begin_call(&mut self, end: u16) -> Flow {
        if self.stack.top() { Flow::Next } else { Flow::Jump(end) }
    }

    fn copy_bit(&mut self, bit: Bit, out: Bit) -> Flow {
        let value = self.memory.bit(bit);
        self.memory.set_bit(out, value);
        Flow::Next
    }

    fn call(&mut self, routine: u8, here: u16) -> Flow {
        if !self.stack.top() {
            return Flow::Next;
        }
        if !self.calls.enter(Frame { return_to: here.wrapping_add(CALL_LEN), stack: self.stack }) {
            self.memory.set_bit(PROGRAMMING_ERROR, true);
            return Flow::Next;
        }
        self.enter(routine)
    }

    fn return_(&mut self) -> Flow {
        match self.calls.leave(self.memory) {
            Some(frame) => {
                self.stack = frame.stack;
                Flow::Jump(frame.return_to)
            }
            None => self.leave(Exit::End),
        }
    }

    fn conditional_return(&mut self) -> Flow {
        if self.stack.top() { self.return_() } else { Flow::Next }
    }

    fn conditional_return_from_interrupt(&mut self) -> Flow {
        self.conditional_return()
    }

    /// Afterwards the program goes on here, so that one routine follows the other.
    fn poll_events(&mut self, here: u16) -> Flow {
        if self.calls.is_interrupted() {
            return Flow::Next;
        }
        match self.events.take(self.program.plan(), self.memory) {
            // One can be the cause of the next, without end.
            Some(_) if self.environment.is_overdue(INTERRUPT_LEN) => self.leave(Exit::Watchdog),
            Some(routine) => {
                self.calls.interrupt(Frame { return_to: here, stack: self.stack }, self.memory);
                self.enter(routine)
            }
            None => Flow::Next,
        }
    }

    fn attach(&mut self, int: u8, evnt: u8) -> Flow {
        if self.stack.top() {
            let address = self.plan().event_address(evnt);
            self.memory.set_byte(address, int.wrapping_add(1));
            let event = self.plan().event(evnt);
            self.events.attach(event, self.program.plan(), self.memory);
        }
        Flow::Next
    }

    fn detach(&mut self, evnt: u8) -> Flow {
        if self.stack.top() {
            let address = self.plan().event_address(evnt);
            self.memory.set_byte(address, 0);
        }
        self.clear_event(evnt)
    }

    fn clear_event(&mut self, evnt: u8) -> Flow {
        if self.stack.top() {
            let event = self.plan().event(evnt);
            self.events.clear(event);
        }
        Flow::Next
    }

    fn enable_interrupts(&mut self) -> Flow {
        if self.stack.top() {
            self.events.enable(true, self.memory);
        }
        Flow::Next
    }

    fn disable_interrupts(&mut self) -> Flow {
        if self.stack.top() {
            self.events.enable(false, self.memory);
        }
        Flow::Next
    }

    fn note_eno(&mut self, errors: u8) -> Flow {
        let eno = self.stack.top() && self.memory.byte(STATUS) & errors == 0;
        self.memory.set_byte(ENO, u8::from(eno));
        Flow::Next
    }

    fn and_eno(&mut self, errors: u8) -> Flow {
        let failed = self.memory.byte(STATUS) & errors & !LEFT_ENO != 0;
        let left_failed = errors & LEFT_ENO != 0 && self.memory.byte(ENO) == 0;
        self.stack.and(!failed && !left_failed);
        Flow::Next
    }

    fn module_instruction(&mut self, op: Op, operands: &Operands<'_>) -> Flow {
        crate::modules::execute(self, op, operands)
    }

    fn undefined(&mut self) -> Flow {
        self.leave(Exit::Undefined)
    }
}

fn is_in(number: u8, first: u8, count: u8) -> bool {
    number >= first && number - first < count
}
