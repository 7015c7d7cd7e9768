//! Executing an instruction: the trait that an engine in Rust implements, one method for each row
//! of the table, and what reads the operands for it.

use crate::core_instructions::core_instructions;
use crate::fetch::Fetched;
use crate::memory::ProgramMemory;
use crate::module_instructions::module_instructions;
use crate::modules::module_of_token;
use crate::operand::{Bit, ByteSource, Operands, Relation, WordSource};
use crate::reader::{OperandKind, OperandReader, kinds};
use crate::table::{Op, WIDE_PREFIX};

/// What an engine does after an instruction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Flow {
    /// Goes on with the next instruction.
    Next,
    /// Goes on at this code offset.
    Jump(u16),
    /// Leaves the program. Why, the engine knows.
    Leave,
}

macro_rules! engine {
    ($(
        $(#[doc = $doc:literal])+
        $op:ident $method:ident ( $( $arg:ident : $value:ty = $role:expr ),* )
        [ $( $mnemonic:literal )* ] $group:ident,
        needs $needs:literal $( ( $( $input:literal )+ ) )?, adds $adds:literal, $rung:ident,
        flags $( $flag:ident )|+ {
            $( $first:literal ..= $last:literal ( $( $kind:ident ),* ); )*
            $( wide $wide_first:literal ..= $wide_last:literal ( $( $wide_kind:ident ),* ); )*
        }
    )+ modules { $( $module:tt )* }) => {
        /// An engine: one method for each instruction, whatever its encoded form.
        pub trait Execute {
            $(
                $(#[doc = $doc])+
                fn $method(&mut self, $( $arg: $value ),*) -> Flow;
            )+
            /// An instruction of a module. `next` is the offset after it.
            fn module_instruction(&mut self, op: Op, operands: &Operands) -> Flow;
            /// A token that is not in the table. The loader's check keeps it out of valid images.
            fn undefined(&mut self) -> Flow;
        }

        /// Executes the instruction at offset `pc`. Never returns [`Flow::Next`]: that has become a
        /// jump.
        #[inline(always)]
        pub fn execute<E: Execute, P: ProgramMemory>(engine: &mut E, code: &P, pc: u16) -> Flow {
            let token = code.byte(pc);
            match token {
                $( $( $first..=$last => {
                    #[allow(unused_mut)]
                    let mut reader =
                        OperandReader::new(code, pc, pc.wrapping_add(1), token - $first);
                    let flow = engine.$method( $( kinds::$kind::read(&mut reader) ),* );
                    go_on(flow, reader.position())
                } )* )+
                WIDE_PREFIX => {
                    let token = code.byte(pc.wrapping_add(1));
                    match token {
                        $( $( $wide_first..=$wide_last => {
                            let (at, in_token) = (pc.wrapping_add(2), token - $wide_first);
                            let mut reader = OperandReader::new(code, pc, at, in_token);
                            let flow =
                                engine.$method( $( kinds::$wide_kind::read(&mut reader) ),* );
                            go_on(flow, reader.position())
                        } )* )+
                        _ => engine.undefined(),
                    }
                }
                _ => execute_module(engine, code, pc),
            }
        }

        /// An instruction of a module, or none.
        #[inline(never)]
        fn execute_module<E: Execute, P: ProgramMemory>(engine: &mut E, code: &P, pc: u16) -> Flow {
            let mut fetched = Fetched::NOTHING;
            if module_of_token(code.byte(pc)).is_none() || !fetched.fetch(code, pc) {
                return engine.undefined();
            }
            let flow = engine.module_instruction(fetched.op, &Operands::of(&fetched.operands));
            go_on(flow, fetched.next)
        }
    };
}

#[inline(always)]
fn go_on(flow: Flow, next: u16) -> Flow {
    match flow {
        Flow::Next => Flow::Jump(next),
        other => other,
    }
}

core_instructions! { module_instructions ! engine }
