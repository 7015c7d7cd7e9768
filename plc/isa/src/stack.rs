//! The logic stack: nine one-bit levels, S0 on top.

/// Levels of the logic stack (docs/s7-200.md 1.0).
pub const STACK_LEVELS: u8 = 9;

const MASK: u16 = (1 << STACK_LEVELS) - 1;

/// Nine one-bit levels. A push loses S8; a pop shifts a 0 into S8 (docs/decisions.md).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct LogicStack(u16);

impl LogicStack {
    /// All levels 0, as at the start of every scan.
    pub const EMPTY: LogicStack = LogicStack(0);

    /// S0, the top of the stack: the power flow.
    #[inline]
    pub const fn top(self) -> bool {
        self.0 & 1 != 0
    }

    /// Level `n`, 0 for the top. Levels that do not exist read 0.
    #[inline]
    pub const fn level(self, n: u8) -> bool {
        n < STACK_LEVELS && self.0 >> n & 1 != 0
    }

    /// S0 := `value`, nothing moves.
    #[inline]
    pub const fn set_top(&mut self, value: bool) {
        self.0 = self.0 & !1 | value as u16;
    }

    /// S0 := S0 AND `value`.
    #[inline]
    pub const fn and(&mut self, value: bool) {
        self.0 &= !1 | value as u16;
    }

    /// S0 := S0 OR `value`.
    #[inline]
    pub const fn or(&mut self, value: bool) {
        self.0 |= value as u16;
    }

    /// Pushes a value; S8 is lost.
    #[inline]
    pub const fn push(&mut self, value: bool) {
        self.0 = (self.0 << 1 | value as u16) & MASK;
    }

    /// Removes and returns S0; a 0 comes in from below.
    #[inline]
    pub const fn pop(&mut self) -> bool {
        let top = self.top();
        self.0 >>= 1;
        top
    }

    /// The levels as bits, S0 in bit 0.
    pub const fn bits(self) -> u16 {
        self.0
    }

    /// The same the other way round; bits of levels that do not exist are lost.
    pub const fn of_bits(bits: u16) -> LogicStack {
        LogicStack(bits & MASK)
    }
}
