//! Execution times of the S7-200, to be compared with. Quoted, not measured.
//!
//! Source: CPU 22x, release 2.x (2004 to 2008), 0.22 us a boolean. Recollected from the system
//! manual and NOT verified against it; ratios to the verified figures of the edition before fit
//! (docs/s7-200.md 5.2). They must not be taken for figures of Siemens.

/// An execution time in microseconds: a base, and a share for each bit or pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quoted {
    /// Without any bit.
    pub base_us: f64,
    /// More for each bit.
    pub each_us: f64,
}

impl Quoted {
    /// For so many bits.
    pub fn us(self, count: u32) -> f64 {
        self.base_us + f64::from(count) * self.each_us
    }
}

/// A time that does not depend on a count.
pub const fn fixed(base_us: f64) -> Quoted {
    Quoted { base_us, each_us: 0.0 }
}

/// A time with a share for each of what the instruction handles.
pub const fn each(base_us: f64, each_us: f64) -> Quoted {
    Quoted { base_us, each_us }
}

/// A conditional instruction without power flow: "about 1 us" for all of them. Those that are
/// quoted with less take what they take with power flow.
pub const WITHOUT_POWER_FLOW_US: f64 = 1.0;

/// LD of I and SM0.0.
pub const LD_I: Quoted = fixed(0.22);
/// LD of any other bit.
pub const LD: Quoted = fixed(0.8);
/// LDN of I.
pub const LDN_I: Quoted = fixed(0.3);
/// LDN of any other bit.
pub const LDN: Quoted = fixed(0.9);
/// A AN O ON of I.
pub const CONTACT_I: Quoted = fixed(0.22);
/// A AN O ON of any other bit.
pub const CONTACT: Quoted = fixed(0.72);
/// `=` of SM T C V S Q M.
pub const ASSIGN: Quoted = fixed(1.3);
/// NOT NOP ALD OLD LRD LPP LDS LBL.
pub const LOGIC: Quoted = fixed(0.22);
/// LPS.
pub const LPS: Quoted = fixed(0.24);
/// EU ED.
pub const EDGE: Quoted = fixed(8.0);
/// S R of one bit.
pub const SET_ONE: Quoted = fixed(2.9);
/// S R of several bits.
pub const SET: Quoted = Quoted { base_us: 14.0, each_us: 0.5 };
/// LDB AB OB.
pub const COMPARE_BYTES: Quoted = fixed(18.0);
/// LDW OW.
pub const COMPARE_WORDS: Quoted = fixed(24.0);
/// AW.
pub const COMPARE_WORDS_AND: Quoted = fixed(23.0);
/// TON.
pub const TON: Quoted = fixed(33.0);
/// TOF.
pub const TOF: Quoted = fixed(36.0);
/// TONR.
pub const TONR: Quoted = fixed(32.0);
/// CTU without a transition, which takes less than with one.
pub const CTU: Quoted = fixed(19.0);
/// CTD, the same.
pub const CTD: Quoted = fixed(19.0);
/// CTUD, the same.
pub const CTUD: Quoted = fixed(24.0);
/// MOVB.
pub const MOVB: Quoted = fixed(15.0);
/// MOVW.
pub const MOVW: Quoted = fixed(18.0);
/// +I -I.
pub const ADD: Quoted = fixed(25.0);
/// *I.
pub const MULTIPLY: Quoted = fixed(37.0);
/// /I.
pub const DIVIDE: Quoted = fixed(64.0);
/// INCW DECW.
pub const INCREMENT: Quoted = fixed(20.0);
/// FOR, once.
pub const FOR: Quoted = fixed(35.0);
/// A pass of FOR; NEXT itself is quoted with 0.
pub const PASS: Quoted = fixed(28.0);
/// JMP.
pub const JMP: Quoted = fixed(1.8);
/// END.
pub const END: Quoted = fixed(0.2);
/// STOP.
pub const STOP: Quoted = fixed(4.0);
/// WDR.
pub const WDR: Quoted = fixed(7.0);
