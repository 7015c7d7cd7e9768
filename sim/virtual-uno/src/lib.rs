//! An Arduino Uno with its bootloader, on a pseudo-terminal and in real time. Knows no PLC.
//!
//! libsimavr is GPL-3, so this crate is for tools that test and is part of nothing that is shipped.
//! Without the feature `link` it is empty and needs no libsimavr.

#[cfg(feature = "link")]
mod bootloader;
#[cfg(feature = "link")]
mod clock;
#[cfg(feature = "link")]
mod port;
#[cfg(feature = "link")]
mod uno;

#[cfg(feature = "link")]
pub use port::Port;
#[cfg(feature = "link")]
pub use uno::VirtualUno;
