//! A block as MATLAB text (`.m`), as Simulink's MATLAB Function block has it, both ways. What the
//! text looks like, and where it does otherwise than the block, is in docs/iec61499.md.

mod constant;
mod functions;
mod lexer;
mod note;
mod read;
mod to_matlab;
mod to_st;
mod vocabulary;
mod write;

pub use read::read;
pub use write::{Written, write};

/// The lines that begin the sections, in their order.
pub(crate) const SECTIONS: [&str; 10] = [
    "%1-DECLARACION DE EVENTOS Y VARIABLES DEL BLOQUE",
    "%2-DECLARACION DE VARIABLES INTERNAS",
    "%3-DECLARACION DEL ESTADO INICIAL",
    "%4-ACTUALIZACION DE LAS VARIABLES DE ENTRADA (WITH)",
    "%5-DIAGRAMA DE CONTROL DE EJECUCION (ECC)",
    "%6-EJECUCION DE ALGORITMOS",
    "%7-DECLARACION DE ALGORITMOS",
    "%8-EJECUCION DE EVENTOS DE SALIDA",
    "%9-EJECUCION DE VARIABLES DE SALIDA (WITH)",
    "%10-FINAL",
];
