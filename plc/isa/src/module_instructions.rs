//! The instructions of modules: on the board they come with the program that uses them. What the rows mean, table.rs
//! says; a form is the module's token, then the routine in it.

/// Hands the rows it was given and its own to the macro `$last`.
macro_rules! module_instructions {
    ($last:ident ! $($core:tt)*) => {
        $last! { $($core)*
            modules {
                /// Copies a double word.
                Movd (input, out) ["MOVD"] Move, needs 1, adds 0, Needed { 0xF0 0x00 (DoubleIn, DoubleTo); }
                /// Copies a real.
                Movr (input, out) ["MOVR"] Move, needs 1, adds 0, Needed { 0xF0 0x01 (RealIn, RealTo); }
                /// Copies a byte.
                MovbAny (input, out) ["MOVB"] Move, needs 1, adds 0, Needed { 0xF0 0x02 (ByteIn, ByteTo); }
                /// Copies a word.
                MovwAny (input, out) ["MOVW"] Move, needs 1, adds 0, Needed { 0xF0 0x03 (WordIn, WordTo); }
                /// Adds integers: OUT := OUT + IN1. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative.
                AddIntAny (in1, out) ["+I"] Math, needs 1, adds 0, Needed { 0xF0 0x04 (WordIn, WordTo); }
                /// Subtracts integers: OUT := OUT - IN1. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative.
                SubIntAny (in1, out) ["-I"] Math, needs 1, adds 0, Needed { 0xF0 0x05 (WordIn, WordTo); }
                /// Multiplies integers: OUT := OUT * IN1. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative. SM1.3 becomes 0.
                MulIntAny (in1, out) ["*I"] Math, needs 1, adds 0, Needed { 0xF0 0x06 (WordIn, WordTo); }
                /// Divides integers: OUT := OUT / IN1, truncated. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative, SM1.3 division by zero.
                DivIntAny (in1, out) ["/I"] Math, needs 1, adds 0, Needed { 0xF0 0x07 (WordIn, WordTo); }
                /// Adds double integers: OUT := OUT + IN1. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative.
                AddDouble (in1, out) ["+D"] Math, needs 1, adds 0, Needed { 0xF0 0x08 (DoubleIn, DoubleTo); }
                /// Subtracts double integers: OUT := OUT - IN1. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative.
                SubDouble (in1, out) ["-D"] Math, needs 1, adds 0, Needed { 0xF0 0x09 (DoubleIn, DoubleTo); }
                /// Multiplies double integers: OUT := OUT * IN1. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative. SM1.3 becomes 0.
                MulDouble (in1, out) ["*D"] Math, needs 1, adds 0, Needed { 0xF0 0x0A (DoubleIn, DoubleTo); }
                /// Divides double integers: OUT := OUT / IN1, truncated. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative, SM1.3 division by zero.
                DivDouble (in1, out) ["/D"] Math, needs 1, adds 0, Needed { 0xF0 0x0B (DoubleIn, DoubleTo); }
                /// Multiplies integers to a double integer: OUT := IN1 * low word of OUT. Sets SM1.0 zero, SM1.2 negative; SM1.1 and SM1.3 become 0.
                Mul (in1, out) ["MUL"] Math, needs 1, adds 0, Needed { 0xF0 0x0C (WordIn, DoubleTo); }
                /// Divides the low word of OUT by IN1: the quotient becomes its low word, the remainder its high word. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative, SM1.3 division by zero.
                Div (in1, out) ["DIV"] Math, needs 1, adds 0, Needed { 0xF0 0x0D (WordIn, DoubleTo); }
                /// Increments a byte; 255 wraps to 0 and sets SM1.1. Sets SM1.0 zero.
                Incb (out) ["INCB"] Math, needs 1, adds 0, Needed { 0xF0 0x0E (ByteTo); }
                /// Decrements a byte; 0 wraps to 255 and sets SM1.1. Sets SM1.0 zero.
                Decb (out) ["DECB"] Math, needs 1, adds 0, Needed { 0xF0 0x0F (ByteTo); }
                /// Increments a word; 32767 wraps to -32768 and sets SM1.1. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative.
                IncwAny (out) ["INCW"] Math, needs 1, adds 0, Needed { 0xF0 0x10 (WordTo); }
                /// Decrements a word; -32768 wraps to 32767 and sets SM1.1. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative.
                DecwAny (out) ["DECW"] Math, needs 1, adds 0, Needed { 0xF0 0x11 (WordTo); }
                /// Increments a double word; 2147483647 wraps to -2147483648 and sets SM1.1. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative.
                Incd (out) ["INCD"] Math, needs 1, adds 0, Needed { 0xF0 0x12 (DoubleTo); }
                /// Decrements a double word; -2147483648 wraps to 2147483647 and sets SM1.1. Sets SM1.0 zero, SM1.1 overflow, SM1.2 negative.
                Decd (out) ["DECD"] Math, needs 1, adds 0, Needed { 0xF0 0x13 (DoubleTo); }
                /// Inverts every bit of a byte. Sets SM1.0 zero.
                Invb (out) ["INVB"] Logic, needs 1, adds 0, Needed { 0xF0 0x14 (ByteTo); }
                /// Inverts every bit of a word. Sets SM1.0 zero.
                Invw (out) ["INVW"] Logic, needs 1, adds 0, Needed { 0xF0 0x15 (WordTo); }
                /// Inverts every bit of a double word. Sets SM1.0 zero.
                Invd (out) ["INVD"] Logic, needs 1, adds 0, Needed { 0xF0 0x16 (DoubleTo); }
                /// Combines bytes bit by bit with AND: OUT := OUT AND IN1. Sets SM1.0 zero.
                Andb (in1, out) ["ANDB" "UNDB"] Logic, needs 1, adds 0, Needed { 0xF0 0x17 (ByteIn, ByteTo); }
                /// Combines words bit by bit with AND: OUT := OUT AND IN1. Sets SM1.0 zero.
                Andw (in1, out) ["ANDW" "UNDW"] Logic, needs 1, adds 0, Needed { 0xF0 0x18 (WordIn, WordTo); }
                /// Combines double words bit by bit with AND: OUT := OUT AND IN1. Sets SM1.0 zero.
                Andd (in1, out) ["ANDD" "UNDD"] Logic, needs 1, adds 0, Needed { 0xF0 0x19 (DoubleIn, DoubleTo); }
                /// Combines bytes bit by bit with OR: OUT := OUT OR IN1. Sets SM1.0 zero.
                Orb (in1, out) ["ORB" "ODERB"] Logic, needs 1, adds 0, Needed { 0xF0 0x1A (ByteIn, ByteTo); }
                /// Combines words bit by bit with OR: OUT := OUT OR IN1. Sets SM1.0 zero.
                Orw (in1, out) ["ORW" "ODERW"] Logic, needs 1, adds 0, Needed { 0xF0 0x1B (WordIn, WordTo); }
                /// Combines double words bit by bit with OR: OUT := OUT OR IN1. Sets SM1.0 zero.
                Ord (in1, out) ["ORD" "ODERD"] Logic, needs 1, adds 0, Needed { 0xF0 0x1C (DoubleIn, DoubleTo); }
                /// Combines bytes bit by bit with exclusive OR: OUT := OUT XOR IN1. Sets SM1.0 zero.
                Xorb (in1, out) ["XORB"] Logic, needs 1, adds 0, Needed { 0xF0 0x1D (ByteIn, ByteTo); }
                /// Combines words bit by bit with exclusive OR: OUT := OUT XOR IN1. Sets SM1.0 zero.
                Xorw (in1, out) ["XORW"] Logic, needs 1, adds 0, Needed { 0xF0 0x1E (WordIn, WordTo); }
                /// Combines double words bit by bit with exclusive OR: OUT := OUT XOR IN1. Sets SM1.0 zero.
                Xord (in1, out) ["XORD"] Logic, needs 1, adds 0, Needed { 0xF0 0x1F (DoubleIn, DoubleTo); }
                /// Shifts a byte left by N bits; zeros come in. Sets SM1.0 zero and SM1.1, the last bit shifted out.
                Slb (out, n) ["SLB"] Shift, needs 1, adds 0, Needed { 0xF0 0x20 (ByteTo, ByteIn); }
                /// Shifts a word left by N bits; zeros come in. Sets SM1.0 zero and SM1.1, the last bit shifted out.
                Slw (out, n) ["SLW"] Shift, needs 1, adds 0, Needed { 0xF0 0x21 (WordTo, ByteIn); }
                /// Shifts a double word left by N bits; zeros come in. Sets SM1.0 zero and SM1.1, the last bit shifted out.
                Sld (out, n) ["SLD"] Shift, needs 1, adds 0, Needed { 0xF0 0x22 (DoubleTo, ByteIn); }
                /// Shifts a byte right by N bits; zeros come in. Sets SM1.0 zero and SM1.1, the last bit shifted out.
                Srb (out, n) ["SRB"] Shift, needs 1, adds 0, Needed { 0xF0 0x23 (ByteTo, ByteIn); }
                /// Shifts a word right by N bits; zeros come in. Sets SM1.0 zero and SM1.1, the last bit shifted out.
                Srw (out, n) ["SRW"] Shift, needs 1, adds 0, Needed { 0xF0 0x24 (WordTo, ByteIn); }
                /// Shifts a double word right by N bits; zeros come in. Sets SM1.0 zero and SM1.1, the last bit shifted out.
                Srd (out, n) ["SRD"] Shift, needs 1, adds 0, Needed { 0xF0 0x25 (DoubleTo, ByteIn); }
                /// Rotates a byte left by N bits. Sets SM1.0 zero and SM1.1, the last bit rotated.
                Rlb (out, n) ["RLB"] Shift, needs 1, adds 0, Needed { 0xF0 0x26 (ByteTo, ByteIn); }
                /// Rotates a word left by N bits. Sets SM1.0 zero and SM1.1, the last bit rotated.
                Rlw (out, n) ["RLW"] Shift, needs 1, adds 0, Needed { 0xF0 0x27 (WordTo, ByteIn); }
                /// Rotates a double word left by N bits. Sets SM1.0 zero and SM1.1, the last bit rotated.
                Rld (out, n) ["RLD"] Shift, needs 1, adds 0, Needed { 0xF0 0x28 (DoubleTo, ByteIn); }
                /// Rotates a byte right by N bits. Sets SM1.0 zero and SM1.1, the last bit rotated.
                Rrb (out, n) ["RRB"] Shift, needs 1, adds 0, Needed { 0xF0 0x29 (ByteTo, ByteIn); }
                /// Rotates a word right by N bits. Sets SM1.0 zero and SM1.1, the last bit rotated.
                Rrw (out, n) ["RRW"] Shift, needs 1, adds 0, Needed { 0xF0 0x2A (WordTo, ByteIn); }
                /// Rotates a double word right by N bits. Sets SM1.0 zero and SM1.1, the last bit rotated.
                Rrd (out, n) ["RRD"] Shift, needs 1, adds 0, Needed { 0xF0 0x2B (DoubleTo, ByteIn); }
                /// Exchanges the two bytes of a word.
                Swap (input) ["SWAP"] Move, needs 1, adds 0, Needed { 0xF0 0x2C (WordTo); }
                /// Byte to integer.
                Bti (input, out) ["BTI"] Conversion, needs 1, adds 0, Needed { 0xF0 0x2D (ByteIn, WordTo); }
                /// Integer to byte: 0 to 255, anything else sets SM1.1 and changes nothing.
                Itb (input, out) ["ITB"] Conversion, needs 1, adds 0, Needed { 0xF0 0x2E (WordIn, ByteTo); }
                /// Integer to double integer.
                Itd (input, out) ["ITD"] Conversion, needs 1, adds 0, Needed { 0xF0 0x2F (WordIn, DoubleTo); }
                /// Double integer to integer; out of range sets SM1.1 and changes nothing.
                Dti (input, out) ["DTI"] Conversion, needs 1, adds 0, Needed { 0xF0 0x30 (DoubleIn, WordTo); }
                /// BCD to integer, in place: 0 to 9999; no BCD sets SM1.6 and changes nothing.
                Bcdi (out) ["BCDI"] Conversion, needs 1, adds 0, Needed { 0xF0 0x31 (WordTo); }
                /// Integer to BCD, in place: 0 to 9999; anything else sets SM1.6 and changes nothing.
                Ibcd (out) ["IBCD"] Conversion, needs 1, adds 0, Needed { 0xF0 0x32 (WordTo); }
                /// Decodes: sets the bit of OUT whose number the lower four bits of IN are, and resets the others.
                Deco (input, out) ["DECO"] Conversion, needs 1, adds 0, Needed { 0xF0 0x33 (ByteIn, WordTo); }
                /// Encodes: writes the number of the lowest bit of IN that is 1 to the lower four bits of OUT.
                Enco (input, out) ["ENCO"] Conversion, needs 1, adds 0, Needed { 0xF0 0x34 (WordIn, ByteTo); }
                /// The segments of a seven-segment display for the lower four bits of IN.
                Seg (input, out) ["SEG"] Conversion, needs 1, adds 0, Needed { 0xF0 0x35 (ByteIn, ByteTo); }
                /// Compares two unsigned bytes and pushes the result.
                LoadByteAny (relation, in1, in2) ["LDB"] Compare, needs 0, adds 1, Always { 0xF0 0x36 (RelationByte, ByteIn, ByteIn); }
                /// Compares two unsigned bytes and combines the result with the top of the stack by AND.
                AndByteAny (relation, in1, in2) ["AB" "UB"] Compare, needs 1, adds 0, Always { 0xF0 0x37 (RelationByte, ByteIn, ByteIn); }
                /// Compares two unsigned bytes and combines the result with the top of the stack by OR.
                OrByteAny (relation, in1, in2) ["OB"] Compare, needs 1, adds 0, Always { 0xF0 0x38 (RelationByte, ByteIn, ByteIn); }
                /// Compares two signed words and pushes the result.
                LoadWordAny (relation, in1, in2) ["LDW"] Compare, needs 0, adds 1, Always { 0xF0 0x39 (RelationByte, WordIn, WordIn); }
                /// Compares two signed words and combines the result with the top of the stack by AND.
                AndWordAny (relation, in1, in2) ["AW" "UW"] Compare, needs 1, adds 0, Always { 0xF0 0x3A (RelationByte, WordIn, WordIn); }
                /// Compares two signed words and combines the result with the top of the stack by OR.
                OrWordAny (relation, in1, in2) ["OW"] Compare, needs 1, adds 0, Always { 0xF0 0x3B (RelationByte, WordIn, WordIn); }
                /// Compares two signed double words and pushes the result.
                LoadDouble (relation, in1, in2) ["LDD"] Compare, needs 0, adds 1, Always { 0xF0 0x3C (RelationByte, DoubleIn, DoubleIn); }
                /// Compares two signed double words and combines the result with the top of the stack by AND.
                AndDouble (relation, in1, in2) ["AD" "UD"] Compare, needs 1, adds 0, Always { 0xF0 0x3D (RelationByte, DoubleIn, DoubleIn); }
                /// Compares two signed double words and combines the result with the top of the stack by OR.
                OrDouble (relation, in1, in2) ["OD"] Compare, needs 1, adds 0, Always { 0xF0 0x3E (RelationByte, DoubleIn, DoubleIn); }
                /// Shift register: moves DATA into the abs(N) bits from S_BIT on, at S_BIT for a positive N, at the other end for a negative one. The bit that leaves is in SM1.1.
                Shrb (data, s_bit, n) ["SHRB"] Shift, needs 1, adds 0, Needed { 0xF0 0x3F (FarBit, FarBitOut, ByteIn); }
                /// Set: sets N consecutive bits.
                SetAny (bit, n) ["S"] Coil, needs 1, adds 0, Needed { 0xF0 0x40 (FarBitOut, ByteIn); }
                /// Reset: resets N consecutive bits.
                ResetAny (bit, n) ["R"] Coil, needs 1, adds 0, Needed { 0xF0 0x41 (FarBitReset, ByteIn); }
                /// Adds reals: OUT := OUT + IN1. Sets SM1.0 zero, SM1.1 overflow or illegal value, SM1.2 negative.
                AddReal (in1, out) ["+R"] Real, needs 1, adds 0, Needed { 0xF1 0x00 (RealIn, RealTo); }
                /// Subtracts reals: OUT := OUT - IN1. Sets SM1.0 zero, SM1.1 overflow or illegal value, SM1.2 negative.
                SubReal (in1, out) ["-R"] Real, needs 1, adds 0, Needed { 0xF1 0x01 (RealIn, RealTo); }
                /// Multiplies reals: OUT := OUT * IN1. Sets SM1.0 zero, SM1.1 overflow or illegal value, SM1.2 negative; SM1.3 becomes 0.
                MulReal (in1, out) ["*R"] Real, needs 1, adds 0, Needed { 0xF1 0x02 (RealIn, RealTo); }
                /// Divides reals: OUT := OUT / IN1. Sets SM1.0 zero, SM1.1 overflow or illegal value, SM1.2 negative, SM1.3 division by zero.
                DivReal (in1, out) ["/R"] Real, needs 1, adds 0, Needed { 0xF1 0x03 (RealIn, RealTo); }
                /// Double integer to real, rounded to the nearest.
                Dtr (input, out) ["DTR"] Conversion, needs 1, adds 0, Needed { 0xF1 0x04 (DoubleIn, RealTo); }
                /// Real to double integer, to the nearest, halves away from zero; out of range sets SM1.1 and changes nothing.
                Round (input, out) ["ROUND"] Conversion, needs 1, adds 0, Needed { 0xF1 0x05 (RealIn, DoubleTo); }
                /// Real to double integer, towards zero; out of range sets SM1.1 and changes nothing.
                Trunc (input, out) ["TRUNC"] Conversion, needs 1, adds 0, Needed { 0xF1 0x06 (RealIn, DoubleTo); }
                /// Compares two reals and pushes the result.
                LoadReal (relation, in1, in2) ["LDR"] Compare, needs 0, adds 1, Always { 0xF1 0x07 (RelationByte, RealIn, RealIn); }
                /// Compares two reals and combines the result with the top of the stack by AND.
                AndReal (relation, in1, in2) ["AR" "UR"] Compare, needs 1, adds 0, Always { 0xF1 0x08 (RelationByte, RealIn, RealIn); }
                /// Compares two reals and combines the result with the top of the stack by OR.
                OrReal (relation, in1, in2) ["OR"] Compare, needs 1, adds 0, Always { 0xF1 0x09 (RelationByte, RealIn, RealIn); }
                /// Square root of a real. Sets SM1.0 zero, SM1.1 overflow or illegal value, SM1.2 negative.
                Sqrt (input, out) ["SQRT"] Real, needs 1, adds 0, Needed { 0xF2 0x00 (RealIn, RealTo); }
                /// Sine of an angle in radians. Sets SM1.0 zero, SM1.1 overflow or illegal value, SM1.2 negative.
                Sin (input, out) ["SIN"] Real, needs 1, adds 0, Needed { 0xF2 0x01 (RealIn, RealTo); }
                /// Cosine of an angle in radians. Sets SM1.0 zero, SM1.1 overflow or illegal value, SM1.2 negative.
                Cos (input, out) ["COS"] Real, needs 1, adds 0, Needed { 0xF2 0x02 (RealIn, RealTo); }
                /// Tangent of an angle in radians. Sets SM1.0 zero, SM1.1 overflow or illegal value, SM1.2 negative.
                Tan (input, out) ["TAN"] Real, needs 1, adds 0, Needed { 0xF2 0x03 (RealIn, RealTo); }
                /// Natural logarithm of a real. Sets SM1.0 zero, SM1.1 overflow or illegal value, SM1.2 negative.
                Ln (input, out) ["LN"] Real, needs 1, adds 0, Needed { 0xF2 0x04 (RealIn, RealTo); }
                /// e to the power of a real. Sets SM1.0 zero, SM1.1 overflow or illegal value, SM1.2 negative.
                Exp (input, out) ["EXP"] Real, needs 1, adds 0, Needed { 0xF2 0x05 (RealIn, RealTo); }
                /// PID controller: computes the output Mn of the loop table at TBL (36 bytes).
                Pid (tbl, loop_number, history) ["PID"] Real, needs 1, adds 0, Always { 0xFC 0x00 (ByteTo, Loop, Edge); }
                /// Length of a string.
                Slen (input, out) ["SLEN"] Text, needs 1, adds 0, Needed { 0xF3 0x00 (TextIn, ByteTo); }
                /// Copies a string.
                Scpy (input, out) ["SCPY"] Text, needs 1, adds 0, Needed { 0xF3 0x01 (TextIn, TextTo); }
                /// Appends the string IN to the string OUT.
                Scat (input, out) ["SCAT"] Text, needs 1, adds 0, Needed { 0xF3 0x02 (TextIn, TextTo); }
                /// Copies N characters of a string from position INDX on.
                Sscpy (input, indx, n, out) ["SSCPY"] Text, needs 1, adds 0, Needed { 0xF3 0x03 (TextIn, ByteIn, ByteIn, TextTo); }
                /// Finds the string IN2 in IN1 from position OUT on: OUT := its position, 0 if it is not there.
                Sfnd (in1, in2, out) ["SFND"] Text, needs 1, adds 0, Needed { 0xF3 0x04 (TextIn, TextIn, ByteTo); }
                /// Finds the first character of IN1, from position OUT on, that stands in IN2: OUT := its position, 0 if there is none.
                Cfnd (in1, in2, out) ["CFND"] Text, needs 1, adds 0, Needed { 0xF3 0x05 (TextIn, TextIn, ByteTo); }
                /// Compares two strings and pushes the result.
                LoadText (relation, in1, in2) ["LDS"] Compare, needs 0, adds 1, Always { 0xF3 0x06 (RelationByte, TextIn, TextIn); }
                /// Compares two strings and combines the result with the top of the stack by AND.
                AndText (relation, in1, in2) ["AS" "US"] Compare, needs 1, adds 0, Always { 0xF3 0x07 (RelationByte, TextIn, TextIn); }
                /// Compares two strings and combines the result with the top of the stack by OR.
                OrText (relation, in1, in2) ["OS"] Compare, needs 1, adds 0, Always { 0xF3 0x08 (RelationByte, TextIn, TextIn); }
                /// LEN ASCII characters that are hexadecimal digits to bytes; another character sets SM1.7.
                Ath (input, out, len) ["ATH"] Text, needs 1, adds 0, Needed { 0xFB 0x00 (BytesAt, ByteTo, ByteIn); }
                /// LEN hexadecimal digits to ASCII characters.
                Hta (input, out, len) ["HTA"] Text, needs 1, adds 0, Needed { 0xFB 0x01 (BytesAt, ByteTo, ByteIn); }
                /// Integer to 8 ASCII characters.
                Ita (input, out, fmt) ["ITA"] Text, needs 1, adds 0, Needed { 0xFB 0x02 (WordIn, ByteTo, ByteIn); }
                /// Double integer to 12 ASCII characters.
                Dta (input, out, fmt) ["DTA"] Text, needs 1, adds 0, Needed { 0xFB 0x03 (DoubleIn, ByteTo, ByteIn); }
                /// Real to 3 to 15 ASCII characters.
                Rta (input, out, fmt) ["RTA"] Text, needs 1, adds 0, Needed { 0xFB 0x04 (RealIn, ByteTo, ByteIn); }
                /// Integer to a string of 8 characters.
                Its (input, fmt, out) ["ITS"] Text, needs 1, adds 0, Needed { 0xFB 0x05 (WordIn, ByteIn, TextTo); }
                /// Double integer to a string of 12 characters.
                Dts (input, fmt, out) ["DTS"] Text, needs 1, adds 0, Needed { 0xFB 0x06 (DoubleIn, ByteIn, TextTo); }
                /// Real to a string of 3 to 15 characters.
                Rts (input, fmt, out) ["RTS"] Text, needs 1, adds 0, Needed { 0xFB 0x07 (RealIn, ByteIn, TextTo); }
                /// String to integer, from position INDX on.
                Sti (input, indx, out) ["STI"] Text, needs 1, adds 0, Needed { 0xFB 0x08 (TextIn, ByteIn, WordTo); }
                /// String to double integer, from position INDX on.
                Std (input, indx, out) ["STD"] Text, needs 1, adds 0, Needed { 0xFB 0x09 (TextIn, ByteIn, DoubleTo); }
                /// String to real, from position INDX on.
                Str (input, indx, out) ["STR"] Text, needs 1, adds 0, Needed { 0xFB 0x0A (TextIn, ByteIn, RealTo); }
                /// Adds a word to a table; a full one sets SM1.4.
                Att (data, tbl) ["ATT"] Table, needs 1, adds 0, Needed { 0xF4 0x00 (WordIn, WordTo); }
                /// Takes the oldest word out of a table; an empty one sets SM1.5.
                Fifo (tbl, data) ["FIFO"] Table, needs 1, adds 0, Needed { 0xF4 0x01 (WordTo, WordTo); }
                /// Takes the newest word out of a table; an empty one sets SM1.5.
                Lifo (tbl, data) ["LIFO"] Table, needs 1, adds 0, Needed { 0xF4 0x02 (WordTo, WordTo); }
                /// Searches a table from entry INDX on for a word that relates to PTN: INDX := its number, the number of entries if there is none.
                Fnd (relation, tbl, ptn, indx) ["FND"] Table, needs 1, adds 0, Needed { 0xF4 0x03 (RelationByte, WordsAt, WordIn, WordTo); }
                /// Fills N words.
                Fill (input, out, n) ["FILL"] Table, needs 1, adds 0, Needed { 0xF4 0x04 (WordIn, WordTo, ByteIn); }
                /// Copies N bytes, as if they had been read before the first is written.
                Bmb (input, out, n) ["BMB"] Table, needs 1, adds 0, Needed { 0xF4 0x05 (BytesAt, ByteTo, ByteIn); }
                /// Copies N words, as if they had been read before the first is written.
                Bmw (input, out, n) ["BMW"] Table, needs 1, adds 0, Needed { 0xF4 0x06 (WordsAt, WordTo, ByteIn); }
                /// Copies N double words, as if they had been read before the first is written.
                Bmd (input, out, n) ["BMD"] Table, needs 1, adds 0, Needed { 0xF4 0x07 (DoublesAt, DoubleTo, ByteIn); }
                /// Load immediate: pushes the state of the input point, beside the process image.
                Ldi (bit) ["LDI"] InputOutput, needs 0, adds 1, Always { 0xF5 0x00 (InputPoint); }
                /// Load Not immediate: pushes the inverted state of the input point, beside the process image.
                Ldni (bit) ["LDNI"] InputOutput, needs 0, adds 1, Always { 0xF5 0x01 (InputPoint); }
                /// And immediate: combines the state of the input point with the top of the stack, beside the process image.
                Ai (bit) ["AI" "UI"] InputOutput, needs 1, adds 0, Always { 0xF5 0x02 (InputPoint); }
                /// And Not immediate: combines the inverted state of the input point with the top of the stack, beside the process image.
                Ani (bit) ["ANI" "UNI"] InputOutput, needs 1, adds 0, Always { 0xF5 0x03 (InputPoint); }
                /// Or immediate: combines the state of the input point with the top of the stack, beside the process image.
                Oi (bit) ["OI"] InputOutput, needs 1, adds 0, Always { 0xF5 0x04 (InputPoint); }
                /// Or Not immediate: combines the inverted state of the input point with the top of the stack, beside the process image.
                Oni (bit) ["ONI"] InputOutput, needs 1, adds 0, Always { 0xF5 0x05 (InputPoint); }
                /// Output immediate: copies the top of the stack to the output point and the process image.
                AssignImmediate (bit) ["=I"] InputOutput, needs 1, adds 0, Always { 0xF5 0x06 (OutputPoint); }
                /// Set immediate: sets N output points and their process image.
                SetImmediate (bit, n) ["SI"] InputOutput, needs 1, adds 0, Needed { 0xF5 0x07 (OutputPoint, ByteIn); }
                /// Reset immediate: resets N output points and their process image.
                ResetImmediate (bit, n) ["RI"] InputOutput, needs 1, adds 0, Needed { 0xF5 0x08 (OutputPoint, ByteIn); }
                /// Byte immediate read: copies the input points of a byte, beside the process image.
                Bir (input, out) ["BIR"] InputOutput, needs 1, adds 0, Needed { 0xF5 0x09 (BytesAt, ByteTo); }
                /// Byte immediate write: copies a byte to output points and their process image.
                Biw (input, out) ["BIW"] InputOutput, needs 1, adds 0, Needed { 0xF5 0x0A (ByteIn, ByteTo); }
                /// Diagnosis LED: off for 0, on otherwise.
                Dled (input) ["DLED"] InputOutput, needs 1, adds 0, Needed { 0xF5 0x0B (ByteIn); }
                /// High-speed counter definition: gives a counter its mode.
                Hdef (hsc, mode) ["HDEF"] InputOutput, needs 1, adds 0, Needed { 0xF8 0x00 (Number, Number); }
                /// High-speed counter: takes over control byte, current value and preset from special memory.
                Hsc (n) ["HSC"] InputOutput, needs 1, adds 0, Needed { 0xF8 0x01 (Number); }
                /// Pulse output: takes over control byte, cycle, width and count from special memory.
                Pls (n) ["PLS"] InputOutput, needs 1, adds 0, Needed { 0xF9 0x00 (Number); }
                /// Lets the board take over the analog outputs, a bit each: the program uses these.
                AnalogOutputs (outputs) [] Hidden, needs 0, adds 0, Always { 0xF9 0x01 (Number); }
                /// Time of day read: 8 bytes in BCD.
                Todr (t) ["TODR"] Communication, needs 1, adds 0, Needed { 0xF6 0x00 (ByteTo); }
                /// Time of day write: 8 bytes in BCD.
                Todw (t) ["TODW"] Communication, needs 1, adds 0, Needed { 0xF6 0x01 (BytesAt); }
                /// Beginning of an interval: the current value of the millisecond clock.
                Bitim (out) ["BITIM"] Communication, needs 1, adds 0, Needed { 0xF6 0x02 (DoubleTo); }
                /// Interval: milliseconds since IN, which BITIM has written.
                Citim (input, out) ["CITIM"] Communication, needs 1, adds 0, Needed { 0xF6 0x03 (DoubleIn, DoubleTo); }
                /// Transmits the bytes at TBL, the first of which is their number, in freeport mode.
                Xmt (tbl, port) ["XMT"] Communication, needs 1, adds 0, Needed { 0xFA 0x00 (BytesAt, Number); }
                /// Receives a message to TBL in freeport mode.
                Rcv (tbl, port) ["RCV"] Communication, needs 1, adds 0, Needed { 0xFA 0x01 (ByteTo, Number); }
                /// Lets the board take over the settings of the serial line in SMB30.
                Freeport () [] Hidden, needs 0, adds 0, Always { 0xFA 0x02 (); }
            }
        }
    };
}
pub(crate) use module_instructions;
