//! Every module instruction on a controller of its own: values, edges, SM bits, ENO. AWL is not
//! needed here.

mod arithmetic;
mod ascii;
mod compare;
mod convert;
mod logic;
mod machine;
mod points;
mod real;
mod references;
mod rows;
mod shift;
mod table;
mod text;
