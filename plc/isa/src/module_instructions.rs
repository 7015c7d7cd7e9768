//! The instructions of modules: on the board they come with the program that uses them. What the
//! rows mean, table.rs says; a form is the module's token, then the routine in it.

/// Hands the rows it was given and its own to the macro `$last`.
macro_rules! module_instructions {
    ($last:ident ! $($core:tt)*) => {
        $last! { $($core)* modules {
            /// Copies a double word.
            Movd 0xF0 0x00 (input: DoubleIn IN, out: DoubleTo OUT)
                ["MOVD"] Move, needs 1, adds 0, Boxed, flags NONE;
            /// Copies a real.
            Movr 0xF0 0x01 (input: RealIn IN, out: RealTo OUT)
                ["MOVR"] Move, needs 1, adds 0, Boxed, flags NONE;
            /// Copies a byte.
            MovbAny 0xF0 0x02 (input: ByteIn IN, out: ByteTo OUT)
                ["MOVB"] Move, needs 1, adds 0, Boxed, flags NONE;
            /// Copies a word.
            MovwAny 0xF0 0x03 (input: WordIn IN, out: WordTo OUT)
                ["MOVW"] Move, needs 1, adds 0, Boxed, flags NONE;
            /// Adds integers: OUT := OUT + IN1. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative.
            AddIntAny 0xF0 0x04 (in1: WordIn IN.takes(Signed), out: WordTo UPDATE)
                ["+I"] Math, needs 1, adds 0, Boxed, flags RESULT;
            /// Subtracts integers: OUT := OUT - IN1. Sets SM1.0 zero, SM1.1 overflow, SM1.2
            /// negative.
            SubIntAny 0xF0 0x05 (in1: WordIn IN.takes(Signed), out: WordTo UPDATE)
                ["-I"] Math, needs 1, adds 0, Boxed, flags RESULT;
            /// Multiplies integers: OUT := OUT * IN1. Sets SM1.0 zero, SM1.1 overflow, SM1.2
            /// negative. SM1.3 becomes 0.
            MulIntAny 0xF0 0x06 (in1: WordIn IN.takes(Signed), out: WordTo UPDATE)
                ["*I"] Math, needs 1, adds 0, Boxed, flags RESULT | DIVISION;
            /// Divides integers: OUT := OUT / IN1, truncated. Sets SM1.0 zero, SM1.1 overflow,
            /// SM1.2 negative, SM1.3 division by zero.
            DivIntAny 0xF0 0x07 (in1: WordIn IN.takes(Signed), out: WordTo UPDATE)
                ["/I"] Math, needs 1, adds 0, Boxed, flags RESULT | DIVISION;
            /// Adds double integers: OUT := OUT + IN1. Sets SM1.0 zero, SM1.1 overflow, SM1.2
            /// negative.
            AddDouble 0xF0 0x08 (in1: DoubleIn IN.takes(Signed), out: DoubleTo UPDATE)
                ["+D"] Math, needs 1, adds 0, Boxed, flags RESULT;
            /// Subtracts double integers: OUT := OUT - IN1. Sets SM1.0 zero, SM1.1 overflow, SM1.2
            /// negative.
            SubDouble 0xF0 0x09 (in1: DoubleIn IN.takes(Signed), out: DoubleTo UPDATE)
                ["-D"] Math, needs 1, adds 0, Boxed, flags RESULT;
            /// Multiplies double integers: OUT := OUT * IN1. Sets SM1.0 zero, SM1.1 overflow, SM1.2
            /// negative. SM1.3 becomes 0.
            MulDouble 0xF0 0x0A (in1: DoubleIn IN.takes(Signed), out: DoubleTo UPDATE)
                ["*D"] Math, needs 1, adds 0, Boxed, flags RESULT | DIVISION;
            /// Divides double integers: OUT := OUT / IN1, truncated. Sets SM1.0 zero, SM1.1
            /// overflow, SM1.2 negative, SM1.3 division by zero.
            DivDouble 0xF0 0x0B (in1: DoubleIn IN.takes(Signed), out: DoubleTo UPDATE)
                ["/D"] Math, needs 1, adds 0, Boxed, flags RESULT | DIVISION;
            /// Multiplies integers to a double integer: OUT := IN1 * low word of OUT. Sets SM1.0
            /// zero, SM1.2 negative; SM1.1 and SM1.3 become 0.
            Mul 0xF0 0x0C (in1: WordIn IN.takes(Signed), out: DoubleTo UPDATE)
                ["MUL"] Math, needs 1, adds 0, Boxed, flags RESULT | DIVISION;
            /// Divides the low word of OUT by IN1: the quotient becomes its low word, the remainder
            /// its high word. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative, SM1.3 division by
            /// zero.
            Div 0xF0 0x0D (in1: WordIn IN.takes(Signed), out: DoubleTo UPDATE)
                ["DIV"] Math, needs 1, adds 0, Boxed, flags RESULT | DIVISION;
            /// Increments a byte; 255 wraps to 0 and sets SM1.1. Sets SM1.0 zero.
            Incb 0xF0 0x0E (out: ByteTo UPDATE)
                ["INCB"] Math, needs 1, adds 0, Boxed, flags ZERO | OVERFLOW;
            /// Decrements a byte; 0 wraps to 255 and sets SM1.1. Sets SM1.0 zero.
            Decb 0xF0 0x0F (out: ByteTo UPDATE)
                ["DECB"] Math, needs 1, adds 0, Boxed, flags ZERO | OVERFLOW;
            /// Increments a word; 32767 wraps to -32768 and sets SM1.1. Sets SM1.0 zero, SM1.1
            /// overflow, SM1.2 negative.
            IncwAny 0xF0 0x10 (out: WordTo UPDATE)
                ["INCW"] Math, needs 1, adds 0, Boxed, flags RESULT;
            /// Decrements a word; -32768 wraps to 32767 and sets SM1.1. Sets SM1.0 zero, SM1.1
            /// overflow, SM1.2 negative.
            DecwAny 0xF0 0x11 (out: WordTo UPDATE)
                ["DECW"] Math, needs 1, adds 0, Boxed, flags RESULT;
            /// Increments a double word; 2147483647 wraps to -2147483648 and sets SM1.1. Sets SM1.0
            /// zero, SM1.1 overflow, SM1.2 negative.
            Incd 0xF0 0x12 (out: DoubleTo UPDATE)
                ["INCD"] Math, needs 1, adds 0, Boxed, flags RESULT;
            /// Decrements a double word; -2147483648 wraps to 2147483647 and sets SM1.1. Sets SM1.0
            /// zero, SM1.1 overflow, SM1.2 negative.
            Decd 0xF0 0x13 (out: DoubleTo UPDATE)
                ["DECD"] Math, needs 1, adds 0, Boxed, flags RESULT;
            /// Inverts every bit of a byte. Sets SM1.0 zero.
            Invb 0xF0 0x14 (out: ByteTo UPDATE) ["INVB"] Logic, needs 1, adds 0, Boxed, flags ZERO;
            /// Inverts every bit of a word. Sets SM1.0 zero.
            Invw 0xF0 0x15 (out: WordTo UPDATE) ["INVW"] Logic, needs 1, adds 0, Boxed, flags ZERO;
            /// Inverts every bit of a double word. Sets SM1.0 zero.
            Invd 0xF0 0x16 (out: DoubleTo UPDATE)
                ["INVD"] Logic, needs 1, adds 0, Boxed, flags ZERO;
            /// Combines bytes bit by bit with AND: OUT := OUT AND IN1. Sets SM1.0 zero.
            Andb 0xF0 0x17 (in1: ByteIn IN, out: ByteTo UPDATE)
                ["ANDB" "UNDB"] Logic, needs 1, adds 0, Boxed, flags ZERO;
            /// Combines words bit by bit with AND: OUT := OUT AND IN1. Sets SM1.0 zero.
            Andw 0xF0 0x18 (in1: WordIn IN, out: WordTo UPDATE)
                ["ANDW" "UNDW"] Logic, needs 1, adds 0, Boxed, flags ZERO;
            /// Combines double words bit by bit with AND: OUT := OUT AND IN1. Sets SM1.0 zero.
            Andd 0xF0 0x19 (in1: DoubleIn IN, out: DoubleTo UPDATE)
                ["ANDD" "UNDD"] Logic, needs 1, adds 0, Boxed, flags ZERO;
            /// Combines bytes bit by bit with OR: OUT := OUT OR IN1. Sets SM1.0 zero.
            Orb 0xF0 0x1A (in1: ByteIn IN, out: ByteTo UPDATE)
                ["ORB" "ODERB"] Logic, needs 1, adds 0, Boxed, flags ZERO;
            /// Combines words bit by bit with OR: OUT := OUT OR IN1. Sets SM1.0 zero.
            Orw 0xF0 0x1B (in1: WordIn IN, out: WordTo UPDATE)
                ["ORW" "ODERW"] Logic, needs 1, adds 0, Boxed, flags ZERO;
            /// Combines double words bit by bit with OR: OUT := OUT OR IN1. Sets SM1.0 zero.
            Ord 0xF0 0x1C (in1: DoubleIn IN, out: DoubleTo UPDATE)
                ["ORD" "ODERD"] Logic, needs 1, adds 0, Boxed, flags ZERO;
            /// Combines bytes bit by bit with exclusive OR: OUT := OUT XOR IN1. Sets SM1.0 zero.
            Xorb 0xF0 0x1D (in1: ByteIn IN, out: ByteTo UPDATE)
                ["XORB"] Logic, needs 1, adds 0, Boxed, flags ZERO;
            /// Combines words bit by bit with exclusive OR: OUT := OUT XOR IN1. Sets SM1.0 zero.
            Xorw 0xF0 0x1E (in1: WordIn IN, out: WordTo UPDATE)
                ["XORW"] Logic, needs 1, adds 0, Boxed, flags ZERO;
            /// Combines double words bit by bit with exclusive OR: OUT := OUT XOR IN1. Sets SM1.0
            /// zero.
            Xord 0xF0 0x1F (in1: DoubleIn IN, out: DoubleTo UPDATE)
                ["XORD"] Logic, needs 1, adds 0, Boxed, flags ZERO;
            /// Shifts a byte left by N bits; zeros come in. Sets SM1.0 zero and SM1.1, the last bit
            /// shifted out.
            Slb 0xF0 0x20 (out: ByteTo UPDATE, n: ByteIn IN)
                ["SLB"] Shift, needs 1, adds 0, Boxed, flags ZERO | OVERFLOW;
            /// Shifts a word left by N bits; zeros come in. Sets SM1.0 zero and SM1.1, the last bit
            /// shifted out.
            Slw 0xF0 0x21 (out: WordTo UPDATE, n: ByteIn IN)
                ["SLW"] Shift, needs 1, adds 0, Boxed, flags ZERO | OVERFLOW;
            /// Shifts a double word left by N bits; zeros come in. Sets SM1.0 zero and SM1.1, the
            /// last bit shifted out.
            Sld 0xF0 0x22 (out: DoubleTo UPDATE, n: ByteIn IN)
                ["SLD"] Shift, needs 1, adds 0, Boxed, flags ZERO | OVERFLOW;
            /// Shifts a byte right by N bits; zeros come in. Sets SM1.0 zero and SM1.1, the last
            /// bit shifted out.
            Srb 0xF0 0x23 (out: ByteTo UPDATE, n: ByteIn IN)
                ["SRB"] Shift, needs 1, adds 0, Boxed, flags ZERO | OVERFLOW;
            /// Shifts a word right by N bits; zeros come in. Sets SM1.0 zero and SM1.1, the last
            /// bit shifted out.
            Srw 0xF0 0x24 (out: WordTo UPDATE, n: ByteIn IN)
                ["SRW"] Shift, needs 1, adds 0, Boxed, flags ZERO | OVERFLOW;
            /// Shifts a double word right by N bits; zeros come in. Sets SM1.0 zero and SM1.1, the
            /// last bit shifted out.
            Srd 0xF0 0x25 (out: DoubleTo UPDATE, n: ByteIn IN)
                ["SRD"] Shift, needs 1, adds 0, Boxed, flags ZERO | OVERFLOW;
            /// Rotates a byte left by N bits. Sets SM1.0 zero and SM1.1, the last bit rotated.
            Rlb 0xF0 0x26 (out: ByteTo UPDATE, n: ByteIn IN)
                ["RLB"] Shift, needs 1, adds 0, Boxed, flags ZERO | OVERFLOW;
            /// Rotates a word left by N bits. Sets SM1.0 zero and SM1.1, the last bit rotated.
            Rlw 0xF0 0x27 (out: WordTo UPDATE, n: ByteIn IN)
                ["RLW"] Shift, needs 1, adds 0, Boxed, flags ZERO | OVERFLOW;
            /// Rotates a double word left by N bits. Sets SM1.0 zero and SM1.1, the last bit
            /// rotated.
            Rld 0xF0 0x28 (out: DoubleTo UPDATE, n: ByteIn IN)
                ["RLD"] Shift, needs 1, adds 0, Boxed, flags ZERO | OVERFLOW;
            /// Rotates a byte right by N bits. Sets SM1.0 zero and SM1.1, the last bit rotated.
            Rrb 0xF0 0x29 (out: ByteTo UPDATE, n: ByteIn IN)
                ["RRB"] Shift, needs 1, adds 0, Boxed, flags ZERO | OVERFLOW;
            /// Rotates a word right by N bits. Sets SM1.0 zero and SM1.1, the last bit rotated.
            Rrw 0xF0 0x2A (out: WordTo UPDATE, n: ByteIn IN)
                ["RRW"] Shift, needs 1, adds 0, Boxed, flags ZERO | OVERFLOW;
            /// Rotates a double word right by N bits. Sets SM1.0 zero and SM1.1, the last bit
            /// rotated.
            Rrd 0xF0 0x2B (out: DoubleTo UPDATE, n: ByteIn IN)
                ["RRD"] Shift, needs 1, adds 0, Boxed, flags ZERO | OVERFLOW;
            /// Exchanges the two bytes of a word.
            Swap 0xF0 0x2C (input: WordTo UPDATE) ["SWAP"] Move, needs 1, adds 0, Boxed, flags NONE;
            /// Byte to integer.
            Bti 0xF0 0x2D (input: ByteIn IN, out: WordTo OUT)
                ["BTI"] Conversion, needs 1, adds 0, Boxed, flags NONE;
            /// Integer to byte: 0 to 255, anything else sets SM1.1 and changes nothing.
            Itb 0xF0 0x2E (input: WordIn IN.takes(Signed), out: ByteTo OUT)
                ["ITB"] Conversion, needs 1, adds 0, Boxed, flags OVERFLOW;
            /// Integer to double integer.
            Itd 0xF0 0x2F (input: WordIn IN.takes(Signed), out: DoubleTo OUT)
                ["ITD"] Conversion, needs 1, adds 0, Boxed, flags NONE;
            /// Double integer to integer; out of range sets SM1.1 and changes nothing.
            Dti 0xF0 0x30 (input: DoubleIn IN.takes(Signed), out: WordTo OUT)
                ["DTI"] Conversion, needs 1, adds 0, Boxed, flags OVERFLOW;
            /// BCD to integer, in place: 0 to 9999; no BCD sets SM1.6 and changes nothing.
            Bcdi 0xF0 0x31 (out: WordTo UPDATE)
                ["BCDI"] Conversion, needs 1, adds 0, Boxed, flags BCD;
            /// Integer to BCD, in place: 0 to 9999; anything else sets SM1.6 and changes nothing.
            Ibcd 0xF0 0x32 (out: WordTo UPDATE)
                ["IBCD"] Conversion, needs 1, adds 0, Boxed, flags BCD;
            /// Decodes: sets the bit of OUT whose number the lower four bits of IN are, and resets
            /// the others.
            Deco 0xF0 0x33 (input: ByteIn IN, out: WordTo OUT)
                ["DECO"] Conversion, needs 1, adds 0, Boxed, flags NONE;
            /// Encodes: writes the number of the lowest bit of IN that is 1 to the lower four bits
            /// of OUT.
            Enco 0xF0 0x34 (input: WordIn IN.takes(Signed), out: ByteTo OUT)
                ["ENCO"] Conversion, needs 1, adds 0, Boxed, flags NONE;
            /// The segments of a seven-segment display for the lower four bits of IN.
            Seg 0xF0 0x35 (input: ByteIn IN, out: ByteTo OUT)
                ["SEG"] Conversion, needs 1, adds 0, Boxed, flags NONE;
            /// Compares two unsigned bytes and pushes the result.
            LoadByteAny 0xF0 0x36 (
                relation: RelationByte NUMBER,
                in1: ByteIn IN,
                in2: ByteIn IN
            ) ["LDB"] Compare, needs 0, adds 1, Loads, flags NONE;
            /// Compares two unsigned bytes and combines the result with the top of the stack by
            /// AND.
            AndByteAny 0xF0 0x37 (relation: RelationByte NUMBER, in1: ByteIn IN, in2: ByteIn IN)
                ["AB" "UB"] Compare, needs 1, adds 0, Ands, flags NONE;
            /// Compares two unsigned bytes and combines the result with the top of the stack by OR.
            OrByteAny 0xF0 0x38 (relation: RelationByte NUMBER, in1: ByteIn IN, in2: ByteIn IN)
                ["OB"] Compare, needs 1, adds 0, Ors, flags NONE;
            /// Compares two signed words and pushes the result.
            LoadWordAny 0xF0 0x39 (
                relation: RelationByte NUMBER,
                in1: WordIn IN.takes(Signed),
                in2: WordIn IN.takes(Signed)
            ) ["LDW"] Compare, needs 0, adds 1, Loads, flags NONE;
            /// Compares two signed words and combines the result with the top of the stack by AND.
            AndWordAny 0xF0 0x3A (
                relation: RelationByte NUMBER,
                in1: WordIn IN.takes(Signed),
                in2: WordIn IN.takes(Signed)
            ) ["AW" "UW"] Compare, needs 1, adds 0, Ands, flags NONE;
            /// Compares two signed words and combines the result with the top of the stack by OR.
            OrWordAny 0xF0 0x3B (
                relation: RelationByte NUMBER,
                in1: WordIn IN.takes(Signed),
                in2: WordIn IN.takes(Signed)
            ) ["OW"] Compare, needs 1, adds 0, Ors, flags NONE;
            /// Compares two signed double words and pushes the result.
            LoadDouble 0xF0 0x3C (
                relation: RelationByte NUMBER,
                in1: DoubleIn IN.takes(Signed),
                in2: DoubleIn IN.takes(Signed)
            ) ["LDD"] Compare, needs 0, adds 1, Loads, flags NONE;
            /// Compares two signed double words and combines the result with the top of the stack
            /// by AND.
            AndDouble 0xF0 0x3D (
                relation: RelationByte NUMBER,
                in1: DoubleIn IN.takes(Signed),
                in2: DoubleIn IN.takes(Signed)
            ) ["AD" "UD"] Compare, needs 1, adds 0, Ands, flags NONE;
            /// Compares two signed double words and combines the result with the top of the stack
            /// by OR.
            OrDouble 0xF0 0x3E (
                relation: RelationByte NUMBER,
                in1: DoubleIn IN.takes(Signed),
                in2: DoubleIn IN.takes(Signed)
            ) ["OD"] Compare, needs 1, adds 0, Ors, flags NONE;
            /// Shift register: moves DATA into the abs(N) bits from S_BIT on, at S_BIT for a
            /// positive N, at the other end for a negative one. The bit that leaves is in SM1.1.
            Shrb 0xF0 0x3F (
                data: FarBit IN,
                s_bit: FarBitOut UPDATE.many(Register(2)),
                n: ByteIn IN.takes(Shift)
            ) ["SHRB"] Shift, needs 1, adds 0, Boxed, flags OVERFLOW;
            /// Set: sets N consecutive bits.
            SetAny 0xF0 0x40 (bit: FarBitOut OUT.many(Counted(1)), n: ByteIn IN.takes(Memory))
                ["S"] Coil, needs 1, adds 0, Boxed, flags NONE;
            /// Reset: resets N consecutive bits.
            ResetAny 0xF0 0x41 (
                bit: FarBitReset OUT.many(Counted(1)),
                n: ByteIn IN.takes(Memory)
            ) ["R"] Coil, needs 1, adds 0, Boxed, flags NONE;
            /// Adds reals: OUT := OUT + IN1. Sets SM1.0 zero, SM1.1 overflow or illegal value,
            /// SM1.2 negative.
            AddReal 0xF1 0x00 (in1: RealIn IN, out: RealTo UPDATE)
                ["+R"] Real, needs 1, adds 0, Boxed, flags RESULT;
            /// Subtracts reals: OUT := OUT - IN1. Sets SM1.0 zero, SM1.1 overflow or illegal value,
            /// SM1.2 negative.
            SubReal 0xF1 0x01 (in1: RealIn IN, out: RealTo UPDATE)
                ["-R"] Real, needs 1, adds 0, Boxed, flags RESULT;
            /// Multiplies reals: OUT := OUT * IN1. Sets SM1.0 zero, SM1.1 overflow or illegal
            /// value, SM1.2 negative; SM1.3 becomes 0.
            MulReal 0xF1 0x02 (in1: RealIn IN, out: RealTo UPDATE)
                ["*R"] Real, needs 1, adds 0, Boxed, flags RESULT | DIVISION;
            /// Divides reals: OUT := OUT / IN1. Sets SM1.0 zero, SM1.1 overflow or illegal value,
            /// SM1.2 negative, SM1.3 division by zero.
            DivReal 0xF1 0x03 (in1: RealIn IN, out: RealTo UPDATE)
                ["/R"] Real, needs 1, adds 0, Boxed, flags RESULT | DIVISION;
            /// Double integer to real, rounded to the nearest.
            Dtr 0xF1 0x04 (input: DoubleIn IN.takes(Signed), out: RealTo OUT)
                ["DTR"] Conversion, needs 1, adds 0, Boxed, flags NONE;
            /// Real to double integer, to the nearest, halves away from zero; out of range sets
            /// SM1.1 and changes nothing.
            Round 0xF1 0x05 (input: RealIn IN, out: DoubleTo OUT)
                ["ROUND"] Conversion, needs 1, adds 0, Boxed, flags OVERFLOW;
            /// Real to double integer, towards zero; out of range sets SM1.1 and changes nothing.
            Trunc 0xF1 0x06 (input: RealIn IN, out: DoubleTo OUT)
                ["TRUNC"] Conversion, needs 1, adds 0, Boxed, flags OVERFLOW;
            /// Compares two reals and pushes the result.
            LoadReal 0xF1 0x07 (relation: RelationByte NUMBER, in1: RealIn IN, in2: RealIn IN)
                ["LDR"] Compare, needs 0, adds 1, Loads, flags NONE;
            /// Compares two reals and combines the result with the top of the stack by AND.
            AndReal 0xF1 0x08 (relation: RelationByte NUMBER, in1: RealIn IN, in2: RealIn IN)
                ["AR" "UR"] Compare, needs 1, adds 0, Ands, flags NONE;
            /// Compares two reals and combines the result with the top of the stack by OR.
            OrReal 0xF1 0x09 (relation: RelationByte NUMBER, in1: RealIn IN, in2: RealIn IN)
                ["OR"] Compare, needs 1, adds 0, Ors, flags NONE;
            /// Square root of a real. Sets SM1.0 zero, SM1.1 overflow or illegal value, SM1.2
            /// negative.
            Sqrt 0xF2 0x00 (input: RealIn IN, out: RealTo OUT)
                ["SQRT"] Real, needs 1, adds 0, Boxed, flags RESULT;
            /// Sine of an angle in radians. Sets SM1.0 zero, SM1.1 overflow or illegal value, SM1.2
            /// negative.
            Sin 0xF2 0x01 (input: RealIn IN, out: RealTo OUT)
                ["SIN"] Real, needs 1, adds 0, Boxed, flags RESULT;
            /// Cosine of an angle in radians. Sets SM1.0 zero, SM1.1 overflow or illegal value,
            /// SM1.2 negative.
            Cos 0xF2 0x02 (input: RealIn IN, out: RealTo OUT)
                ["COS"] Real, needs 1, adds 0, Boxed, flags RESULT;
            /// Tangent of an angle in radians. Sets SM1.0 zero, SM1.1 overflow or illegal value,
            /// SM1.2 negative.
            Tan 0xF2 0x03 (input: RealIn IN, out: RealTo OUT)
                ["TAN"] Real, needs 1, adds 0, Boxed, flags RESULT;
            /// Natural logarithm of a real. Sets SM1.0 zero, SM1.1 overflow or illegal value, SM1.2
            /// negative.
            Ln 0xF2 0x04 (input: RealIn IN, out: RealTo OUT)
                ["LN"] Real, needs 1, adds 0, Boxed, flags RESULT;
            /// e to the power of a real. Sets SM1.0 zero, SM1.1 overflow or illegal value, SM1.2
            /// negative.
            Exp 0xF2 0x05 (input: RealIn IN, out: RealTo OUT)
                ["EXP"] Real, needs 1, adds 0, Boxed, flags RESULT;
            /// PID controller: computes the output Mn of the loop table at TBL (36 bytes).
            Pid 0xFC 0x00 (
                tbl: ByteTo UPDATE.many(Elements(36)),
                loop_number: Loop NUMBER,
                history: Edge NUMBER
            ) ["PID"] Real, needs 1, adds 0, Drives, flags NONE;
            /// Length of a string.
            Slen 0xF3 0x00 (input: TextIn IN.many(Text), out: ByteTo OUT)
                ["SLEN"] Text, needs 1, adds 0, Boxed, flags NONE;
            /// Copies a string.
            Scpy 0xF3 0x01 (input: TextIn IN.many(Text), out: TextTo OUT.many(Copied(0)))
                ["SCPY"] Text, needs 1, adds 0, Boxed, flags NONE;
            /// Appends the string IN to the string OUT.
            Scat 0xF3 0x02 (input: TextIn IN.many(Text), out: TextTo UPDATE.many(Open))
                ["SCAT"] Text, needs 1, adds 0, Boxed, flags NONE;
            /// Copies N characters of a string from position INDX on.
            Sscpy 0xF3 0x03 (
                input: TextIn IN.many(Text),
                indx: ByteIn IN.takes(Position),
                n: ByteIn IN.takes(Length),
                out: TextTo OUT.many(Characters(2))
            ) ["SSCPY"] Text, needs 1, adds 0, Boxed, flags NONE;
            /// Finds the string IN2 in IN1 from position OUT on: OUT := its position, 0 if it is
            /// not there.
            Sfnd 0xF3 0x04 (
                in1: TextIn IN.many(Text),
                in2: TextIn IN.many(Text),
                out: ByteTo UPDATE
            ) ["SFND"] Text, needs 1, adds 0, Boxed, flags NONE;
            /// Finds the first character of IN1, from position OUT on, that is in IN2: OUT := its
            /// position, 0 if there is none.
            Cfnd 0xF3 0x05 (
                in1: TextIn IN.many(Text),
                in2: TextIn IN.many(Text),
                out: ByteTo UPDATE
            ) ["CFND"] Text, needs 1, adds 0, Boxed, flags NONE;
            /// Compares two strings and pushes the result.
            LoadText 0xF3 0x06 (
                relation: RelationByte NUMBER.takes(Equality),
                in1: TextIn IN.many(Text),
                in2: TextIn IN.many(Text)
            ) ["LDS"] Compare, needs 0, adds 1, Loads, flags NONE;
            /// Compares two strings and combines the result with the top of the stack by AND.
            AndText 0xF3 0x07 (
                relation: RelationByte NUMBER.takes(Equality),
                in1: TextIn IN.many(Text),
                in2: TextIn IN.many(Text)
            ) ["AS" "US"] Compare, needs 1, adds 0, Ands, flags NONE;
            /// Compares two strings and combines the result with the top of the stack by OR.
            OrText 0xF3 0x08 (
                relation: RelationByte NUMBER.takes(Equality),
                in1: TextIn IN.many(Text),
                in2: TextIn IN.many(Text)
            ) ["OS"] Compare, needs 1, adds 0, Ors, flags NONE;
            /// LEN ASCII characters that are hexadecimal digits to bytes; another character sets
            /// SM1.7.
            Ath 0xFB 0x00 (
                input: BytesAt IN.many(Counted(2)),
                out: ByteTo UPDATE.many(Halved(2)),
                len: ByteIn IN.takes(Count(255))
            ) ["ATH"] Text, needs 1, adds 0, Boxed, flags DIGIT;
            /// LEN hexadecimal digits to ASCII characters.
            Hta 0xFB 0x01 (
                input: BytesAt IN.many(Halved(2)),
                out: ByteTo OUT.many(Counted(2)),
                len: ByteIn IN.takes(Count(255))
            ) ["HTA"] Text, needs 1, adds 0, Boxed, flags NONE;
            /// Integer to 8 ASCII characters.
            Ita 0xFB 0x02 (
                input: WordIn IN.takes(Signed),
                out: ByteTo OUT.many(Elements(8)),
                fmt: ByteIn IN.takes(Format)
            ) ["ITA"] Text, needs 1, adds 0, Boxed, flags NONE;
            /// Double integer to 12 ASCII characters.
            Dta 0xFB 0x03 (
                input: DoubleIn IN.takes(Signed),
                out: ByteTo OUT.many(Elements(12)),
                fmt: ByteIn IN.takes(Format)
            ) ["DTA"] Text, needs 1, adds 0, Boxed, flags NONE;
            /// Real to 3 to 15 ASCII characters.
            Rta 0xFB 0x04 (
                input: RealIn IN,
                out: ByteTo OUT.many(Formatted(2, 0)),
                fmt: ByteIn IN.takes(RealFormat)
            ) ["RTA"] Text, needs 1, adds 0, Boxed, flags NONE;
            /// Integer to a string of 8 characters.
            Its 0xFB 0x05 (
                input: WordIn IN.takes(Signed),
                fmt: ByteIn IN.takes(Format),
                out: TextTo OUT.many(Elements(9))
            ) ["ITS"] Text, needs 1, adds 0, Boxed, flags NONE;
            /// Double integer to a string of 12 characters.
            Dts 0xFB 0x06 (
                input: DoubleIn IN.takes(Signed),
                fmt: ByteIn IN.takes(Format),
                out: TextTo OUT.many(Elements(13))
            ) ["DTS"] Text, needs 1, adds 0, Boxed, flags NONE;
            /// Real to a string of 3 to 15 characters.
            Rts 0xFB 0x07 (
                input: RealIn IN,
                fmt: ByteIn IN.takes(RealFormat),
                out: TextTo OUT.many(Formatted(1, 1))
            ) ["RTS"] Text, needs 1, adds 0, Boxed, flags NONE;
            /// String to integer, from position INDX on; no number or one out of range sets SM1.1.
            Sti 0xFB 0x08 (
                input: TextIn IN.many(Text),
                indx: ByteIn IN.takes(Position),
                out: WordTo OUT
            ) ["STI"] Text, needs 1, adds 0, Boxed, flags OVERFLOW;
            /// String to double integer, from position INDX on; no number or one out of range sets
            /// SM1.1.
            Std 0xFB 0x09 (
                input: TextIn IN.many(Text),
                indx: ByteIn IN.takes(Position),
                out: DoubleTo OUT
            ) ["STD"] Text, needs 1, adds 0, Boxed, flags OVERFLOW;
            /// String to real, from position INDX on; no number or one out of range sets SM1.1.
            Str 0xFB 0x0A (
                input: TextIn IN.many(Text),
                indx: ByteIn IN.takes(Position),
                out: RealTo OUT
            ) ["STR"] Text, needs 1, adds 0, Boxed, flags OVERFLOW;
            /// Adds a word to a table; a full one sets SM1.4.
            Att 0xF4 0x00 (data: WordIn IN, tbl: WordTo UPDATE.many(Table))
                ["ATT"] Table, needs 1, adds 0, Boxed, flags FULL;
            /// Takes the oldest word out of a table; an empty one sets SM1.5.
            Fifo 0xF4 0x01 (tbl: WordTo UPDATE.many(Table), data: WordTo OUT)
                ["FIFO"] Table, needs 1, adds 0, Boxed, flags EMPTY;
            /// Takes the newest word out of a table; an empty one sets SM1.5.
            Lifo 0xF4 0x02 (tbl: WordTo UPDATE.many(Table), data: WordTo OUT)
                ["LIFO"] Table, needs 1, adds 0, Boxed, flags EMPTY;
            /// Searches a table from entry INDX on for a word that relates to PTN: INDX := its
            /// number, the number of entries if there is none.
            Fnd 0xF4 0x03 (
                relation: RelationByte NUMBER.takes(Searched),
                tbl: WordsAt IN.many(Entries),
                ptn: WordIn IN,
                indx: WordTo UPDATE
            ) ["FND"] Table, needs 1, adds 0, Boxed, flags NONE;
            /// Fills N words.
            Fill 0xF4 0x04 (
                input: WordIn IN,
                out: WordTo OUT.many(Counted(2)),
                n: ByteIn IN.takes(Count(255))
            ) ["FILL"] Table, needs 1, adds 0, Boxed, flags NONE;
            /// Copies N bytes, as if they had been read before the first is written.
            Bmb 0xF4 0x05 (
                input: BytesAt IN.many(Counted(2)),
                out: ByteTo OUT.many(Counted(2)),
                n: ByteIn IN.takes(Count(255))
            ) ["BMB"] Table, needs 1, adds 0, Boxed, flags NONE;
            /// Copies N words, as if they had been read before the first is written.
            Bmw 0xF4 0x06 (
                input: WordsAt IN.many(Counted(2)),
                out: WordTo OUT.many(Counted(2)),
                n: ByteIn IN.takes(Count(255))
            ) ["BMW"] Table, needs 1, adds 0, Boxed, flags NONE;
            /// Copies N double words, as if they had been read before the first is written.
            Bmd 0xF4 0x07 (
                input: DoublesAt IN.many(Counted(2)),
                out: DoubleTo OUT.many(Counted(2)),
                n: ByteIn IN.takes(Count(255))
            ) ["BMD"] Table, needs 1, adds 0, Boxed, flags NONE;
            /// Load immediate: pushes the state of the input point, beside the process image.
            Ldi 0xF5 0x00 (bit: InputPoint IN)
                ["LDI"] InputOutput, needs 0, adds 1, Loads, flags NONE;
            /// Load Not immediate: pushes the inverted state of the input point, beside the process
            /// image.
            Ldni 0xF5 0x01 (bit: InputPoint IN)
                ["LDNI"] InputOutput, needs 0, adds 1, Loads, flags NONE;
            /// And immediate: combines the state of the input point with the top of the stack,
            /// beside the process image.
            Ai 0xF5 0x02 (bit: InputPoint IN)
                ["AI" "UI"] InputOutput, needs 1, adds 0, Ands, flags NONE;
            /// And Not immediate: combines the inverted state of the input point with the top of
            /// the stack, beside the process image.
            Ani 0xF5 0x03 (bit: InputPoint IN)
                ["ANI" "UNI"] InputOutput, needs 1, adds 0, Ands, flags NONE;
            /// Or immediate: combines the state of the input point with the top of the stack,
            /// beside the process image.
            Oi 0xF5 0x04 (bit: InputPoint IN) ["OI"] InputOutput, needs 1, adds 0, Ors, flags NONE;
            /// Or Not immediate: combines the inverted state of the input point with the top of the
            /// stack, beside the process image.
            Oni 0xF5 0x05 (bit: InputPoint IN)
                ["ONI"] InputOutput, needs 1, adds 0, Ors, flags NONE;
            /// Output immediate: copies the top of the stack to the output point and the process
            /// image.
            AssignImmediate 0xF5 0x06 (bit: OutputPoint OUT)
                ["=I"] InputOutput, needs 1, adds 0, Drives, flags NONE;
            /// Set immediate: sets N output points and their process image.
            SetImmediate 0xF5 0x07 (
                bit: OutputPoint OUT.many(Counted(1)),
                n: ByteIn IN.takes(Count(128))
            ) ["SI"] InputOutput, needs 1, adds 0, Boxed, flags NONE;
            /// Reset immediate: resets N output points and their process image.
            ResetImmediate 0xF5 0x08 (
                bit: OutputPoint OUT.many(Counted(1)),
                n: ByteIn IN.takes(Count(128))
            ) ["RI"] InputOutput, needs 1, adds 0, Boxed, flags NONE;
            /// Byte immediate read: copies the input points of a byte, beside the process image.
            Bir 0xF5 0x09 (input: BytesAt IN.takes(InputByte), out: ByteTo OUT)
                ["BIR"] InputOutput, needs 1, adds 0, Boxed, flags NONE;
            /// Byte immediate write: copies a byte to output points and their process image.
            Biw 0xF5 0x0A (input: ByteIn IN, out: ByteTo OUT.takes(OutputByte))
                ["BIW"] InputOutput, needs 1, adds 0, Boxed, flags NONE;
            /// Diagnosis LED: off for 0, on otherwise.
            Dled 0xF5 0x0B (input: ByteIn IN)
                ["DLED"] InputOutput, needs 1, adds 0, Boxed, flags NONE;
            /// High-speed counter definition: gives a counter its mode.
            Hdef 0xF8 0x00 (
                hsc: Number NUMBER.takes(HighSpeedCounter),
                mode: Number NUMBER.takes(CounterMode)
            ) ["HDEF"] InputOutput, needs 1, adds 0, Boxed, flags NONE;
            /// High-speed counter: takes over control byte, current value and preset from special
            /// memory.
            Hsc 0xF8 0x01 (n: Number NUMBER.takes(HighSpeedCounter))
                ["HSC"] InputOutput, needs 1, adds 0, Boxed, flags NONE;
            /// Pulse output: takes over control byte, cycle, width and count from special memory.
            Pls 0xF9 0x00 (n: Number NUMBER.takes(PulseOutput))
                ["PLS"] InputOutput, needs 1, adds 0, Boxed, flags NONE;
            /// Lets the board take over the analog outputs, a bit each: the program uses these.
            AnalogOutputs 0xF9 0x01 (outputs: Number NUMBER)
                [] Hidden, needs 0, adds 0, Drives, flags NONE;
            /// Time of day read: 8 bytes in BCD.
            Todr 0xF6 0x00 (t: ByteTo OUT.many(Elements(8)))
                ["TODR"] Communication, needs 1, adds 0, Boxed, flags NONE;
            /// Time of day write: 8 bytes in BCD.
            Todw 0xF6 0x01 (t: BytesAt IN.many(Elements(8)))
                ["TODW"] Communication, needs 1, adds 0, Boxed, flags NONE;
            /// Beginning of an interval: the current value of the millisecond clock.
            Bitim 0xF6 0x02 (out: DoubleTo OUT)
                ["BITIM"] Communication, needs 1, adds 0, Boxed, flags NONE;
            /// Interval: milliseconds since IN, which BITIM has written.
            Citim 0xF6 0x03 (input: DoubleIn IN, out: DoubleTo OUT)
                ["CITIM"] Communication, needs 1, adds 0, Boxed, flags NONE;
            /// Transmits the bytes at TBL, the first of which is their number, in freeport mode.
            Xmt 0xFA 0x00 (tbl: BytesAt IN.many(Open), port: Number NUMBER.takes(Port))
                ["XMT"] Communication, needs 1, adds 0, Boxed, flags NONE;
            /// Receives a message to TBL in freeport mode.
            Rcv 0xFA 0x01 (tbl: ByteTo OUT.many(Open), port: Number NUMBER.takes(ReceivingPort))
                ["RCV"] Communication, needs 1, adds 0, Boxed, flags NONE;
            /// Lets the board take over the settings of the serial line in SMB30.
            Freeport 0xFA 0x02 () [] Hidden, needs 0, adds 0, Drives, flags NONE;
        } }
    };
}
pub(crate) use module_instructions;
