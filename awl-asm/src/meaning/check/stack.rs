//! Depth of the logic stack before and after every instruction: underflow, overflow, networks that
//! start without a load.

use plc_isa::{Instruction, Op, STACK_LEVELS};

use crate::diagnostic::{Code, Diagnostic};
use crate::meaning::selected::{Argument, Selected, is_contact, source_of, span_of};
use crate::text::ast::{Program, Span, Statement};

/// The depth after each selected instruction, 0..=9, counted from the start of its network.
pub type Depths = Vec<u8>;

/// Follows the depth through the program and reports what cannot be right.
pub fn stack(program: &Program, code: &[Selected], diagnostics: &mut Vec<Diagnostic>) -> Depths {
    let mut follow = Follow {
        program,
        diagnostics,
        total: 0,
        fresh: 0,
        after_output: false,
        after_label: false,
        at_start: None,
        warned: false,
        loads: Vec::new(),
        taken: 0,
        copies: 0,
        last: None,
        kept: Vec::new(),
    };
    let mut depths = Vec::with_capacity(code.len());
    let mut statement = 0;
    follow.network(Span::default(), 1);
    for selected in code {
        for passed in &program.statements[statement..selected.statement as usize] {
            match passed {
                Statement::Network(network) => follow.network(network.span, network.number),
                Statement::Unit(_) => follow.network(Span::default(), 1),
                Statement::Instruction(_) => {}
            }
        }
        statement = selected.statement as usize;
        depths.push(follow.instruction(selected));
    }
    follow.untaken_contact();
    follow.end_of_rung();
    depths
}

struct Follow<'a> {
    program: &'a Program,
    diagnostics: &'a mut Vec<Diagnostic>,
    /// Values since the start of the network, as far as the nine levels hold them.
    total: u8,
    /// Values since the start of the rung: a load after an output starts a new one.
    fresh: u16,
    after_output: bool,
    /// After a label nothing is certain until the next load: what falls through brings its own
    /// values.
    after_label: bool,
    /// The network whose first instruction is still to come.
    at_start: Option<(Span, u32)>,
    /// Whether this rung's overflow has been reported.
    warned: bool,
    /// Where the values of this rung come from, the oldest first.
    loads: Vec<Span>,
    /// How many of them an output has taken up.
    taken: usize,
    /// How many of them LPS made.
    copies: usize,
    /// The contact that is the last instruction so far, which no output has taken up.
    last: Option<Span>,
    /// The copies of LPS that LPP has not taken back, and where LRD has read them last.
    kept: Vec<(Span, Option<Span>)>,
}

impl Follow<'_> {
    fn network(&mut self, span: Span, number: u32) {
        self.untaken_contact();
        self.end_of_rung();
        (self.total, self.fresh) = (0, 0);
        (self.after_output, self.after_label, self.warned) = (false, false, false);
        self.at_start = Some((span, number));
    }

    fn instruction(&mut self, selected: &Selected) -> u8 {
        let instruction = selected.op.instruction();
        let level = match (selected.op, selected.arguments[0]) {
            (Op::Lds, Argument::Number(level)) => level,
            _ => 0,
        };
        let needs = instruction.stack.needs + level;
        let loads = instruction.stack.needs == 0 && instruction.stack.adds > 0;
        if loads && self.after_output {
            self.end_of_rung();
            (self.fresh, self.warned) = (0, false);
        }
        self.check_needs(selected, instruction, needs);
        self.at_start = None;
        self.after_output = !is_contact(selected.op);
        match selected.op {
            // A copy is as good as used, and so is what is read where it is.
            Op::Lps => {
                self.copies += 1;
                self.kept.push((span_of(self.program, selected), None));
            }
            Op::Lds | Op::Lrd => {
                let span = span_of(self.program, selected);
                self.kept.iter_mut().for_each(|(_, read)| *read = Some(span));
                // What LDS reads stays where it is.
                if selected.op == Op::Lds {
                    self.kept.clear();
                }
                self.taken = self.taken.max(usize::from(needs) + 1);
            }
            Op::Lpp => _ = self.kept.pop(),
            _ if self.after_output => self.taken = self.taken.max(usize::from(needs)),
            _ => {}
        }
        // What begins or copies is told by those who count loads and copies.
        let is_counted = loads || matches!(selected.op, Op::Lps | Op::Lds | Op::Lrd | Op::Lpp);
        self.last = (!self.after_output && !is_counted).then(|| span_of(self.program, selected));
        self.apply(selected, instruction);
        self.total
    }

    /// A contact after the last output of a network: nothing takes it up.
    fn untaken_contact(&mut self) {
        let Some(span) = self.last.take().filter(|_| self.taken > 0 && !self.warned) else {
            return;
        };
        let message = "nothing takes up what this makes of the power flow";
        self.diagnostics.push(Diagnostic::new(Code::UnusedValue, span, message).help(
            "an output takes the power flow of what is before it: move this before the output, or \
             end the rung with another one",
        ));
    }

    /// What the outputs of a rung have not taken up was loaded in vain.
    fn end_of_rung(&mut self) {
        // After an overflow there is more to say than this.
        let unused =
            if self.warned { 0 } else { self.loads.len().saturating_sub(self.taken + self.copies) };
        if let Some(&span) = self.loads[..unused].last() {
            self.diagnostics.push(
                Diagnostic::new(
                    Code::UnusedValue,
                    span,
                    "the value that is loaded here is not used",
                )
                .help(
                    "combine it with A or O, or with ALD or OLD, and end the rung with an output",
                ),
            );
        }
        self.loads.clear();
        (self.taken, self.copies) = (0, 0);
        self.unused_copies();
    }

    /// A copy of the power flow that no branch takes up, or none as the last one.
    fn unused_copies(&mut self) {
        let warned = self.warned;
        for (span, read) in self.kept.drain(..).filter(|_| !warned) {
            let branches = "the last branch begins with `LPP`, those between the first and the \
                            last with `LRD`";
            self.diagnostics.push(match read {
                None => {
                    let message = "the copy that LPS keeps is not used";
                    Diagnostic::new(Code::UnusedValue, span, message)
                        .help(format!("{branches}; with one branch alone LPS is not needed"))
                }
                Some(read) => {
                    let message = "the copy that LPS keeps is read here and never taken away";
                    Diagnostic::new(Code::UnusedValue, read, message)
                        .related(span, "kept here")
                        .help(branches)
                }
            });
        }
    }

    fn check_needs(&mut self, selected: &Selected, instruction: &Instruction, needs: u8) {
        let span = || span_of(self.program, selected);
        // What is hidden in another instruction has its name.
        let name = match instruction.mnemonic() {
            name if selected.parameter.is_none() && !name.is_empty() => name,
            _ => source_of(self.program, selected).map_or("", |source| source.mnemonic()),
        };
        if let (Some((network, number)), 1..) = (self.at_start, needs) {
            let mut diagnostic = Diagnostic::new(
                Code::NetworkStart,
                span(),
                format!("a network starts with a load, but this one starts with {name}"),
            );
            if self.program.has_networks && network.end > 0 {
                diagnostic = diagnostic.related(network, format!("network {number} starts here"));
            }
            diagnostic.related.extend(self.rungs_of_step7(selected.statement, name));
            self.diagnostics.push(diagnostic.help(start_help(name)));
            self.total = needs;
        } else if needs > self.total {
            let message =
                format!("{name} needs {}, the logic stack holds {}", values(needs), self.total);
            self.diagnostics.push(
                Diagnostic::new(Code::StackUnderflow, span(), message)
                    .help(missing_help(selected.op)),
            );
            self.total = needs.min(STACK_LEVELS);
        } else if u16::from(needs) > self.fresh && (self.after_label || !self.program.has_networks)
        {
            self.diagnostics.push(
                Diagnostic::new(
                    Code::StaleStackValue,
                    span(),
                    format!("{name} takes a value that an earlier rung left on the logic stack"),
                )
                .help("a load is probably missing in this rung"),
            );
        }
        self.fresh = self.fresh.max(u16::from(needs));
    }

    /// Whoever begins a network with `A` begins each rung of it so: STEP 7 does after a coil, here
    /// the contact would be added to the rung before.
    fn rungs_of_step7(&self, first: u32, name: &str) -> Vec<(Span, String)> {
        if !matches!(name, "A" | "AN" | "O" | "ON") {
            return Vec::new();
        }
        let statements = self.program.statements.get(first as usize..).unwrap_or_default();
        let network = statements.iter().map_while(|statement| match statement {
            Statement::Instruction(instruction) => Some(instruction),
            Statement::Network(_) | Statement::Unit(_) => None,
        });
        let network: Vec<&crate::text::ast::Instruction> = network.collect();
        let begins = |pair: &&[&crate::text::ast::Instruction]| {
            let is_next = matches!(pair[1].mnemonic(), "A" | "AN" | "O" | "ON");
            is_next && !is_contact(pair[0].entry.op)
        };
        let rungs = network.windows(2).filter(begins);
        rungs
            .map(|pair| {
                (pair[1].span, "if a rung begins here, it begins with `LD`, too".to_owned())
            })
            .collect()
    }

    fn apply(&mut self, selected: &Selected, instruction: &Instruction) {
        if matches!(selected.op, Op::Lbl | Op::For | Op::Next) {
            self.end_of_rung();
            self.after_label = selected.op == Op::Lbl;
            (self.total, self.fresh) = (1, u16::from(!self.after_label));
            return;
        }
        match instruction.stack.adds {
            // The bit of a segment is there for the whole segment.
            1.. if selected.op == Op::Lscr => {}
            1.. => {
                self.loads.push(span_of(self.program, selected));
                self.after_label = false;
            }
            0 => {}
            removed => self
                .loads
                .truncate(self.loads.len().saturating_sub(usize::from(removed.unsigned_abs()))),
        }
        let adds = instruction.stack.adds;
        self.total = self.total.saturating_add_signed(adds).min(STACK_LEVELS);
        self.fresh = self.fresh.saturating_add_signed(i16::from(adds));
        if self.fresh > u16::from(STACK_LEVELS) && !self.warned {
            self.warned = true;
            let message =
                format!("{} pushes a tenth value: the oldest one is lost", instruction.mnemonic());
            let span = span_of(self.program, selected);
            self.diagnostics.push(
                Diagnostic::new(Code::StackOverflow, span, message)
                    .help(format!("the logic stack has {STACK_LEVELS} levels")),
            );
        }
    }
}

fn values(count: u8) -> String {
    if count == 1 { "a value".into() } else { format!("{count} values") }
}

/// What the values are that an instruction needs.
fn missing_help(op: Op) -> &'static str {
    match op {
        Op::Ctu => {
            "CTU has two loads before it: the first LD counts, the second resets, such as \
             `LD I0.0`, `LD I0.1`, `CTU C1, 10`"
        }
        Op::Ctd => {
            "CTD has two loads before it: the first LD counts down, the second loads the preset, \
             such as `LD I0.0`, `LD I0.1`, `CTD C1, 10`"
        }
        Op::Ctud => {
            "CTUD has three loads before it: the first LD counts up, the second down, the third \
             resets"
        }
        Op::Ald | Op::Old => {
            "it joins two branches, and each begins with LD: `LD I0.0`, `LD I0.1`, then this one"
        }
        Op::Lrd | Op::Lpp => {
            "LPS before the branches keeps the value that they begin with: `LD I0.0`, `LPS`, \
             `A I0.1`, `= Q0.0`, `LPP`, `= Q0.1`"
        }
        _ => "each LD pushes one value; ALD, OLD and LPP take one away",
    }
}

fn start_help(name: &str) -> String {
    match name {
        "A" | "O" => "use `LD`".into(),
        "AN" | "ON" => "use `LDN`".into(),
        "CTU" | "CTD" | "CTUD" => format!(
            "begin with the contacts of {name}: {}",
            match name {
                "CTU" => "`LD` of what counts, then `LD` of what resets",
                "CTD" => "`LD` of what counts down, then `LD` of what loads the preset",
                _ => "`LD` of what counts up, `LD` of what counts down, `LD` of what resets",
            }
        ),
        "EU" | "ED" => format!("the contact whose edge it tells is before it: `LD I0.0`, `{name}`"),
        "NOT" => {
            "what it inverts is before it: `LD I0.0`, `NOT`; of one bit that is `LDN I0.0`".into()
        }
        "LPP" | "LRD" => "the branches of `LPS` are in the network where it is: leave the NETWORK \
                          line before it out, or begin with `LD`"
            .into(),
        "TON" | "TOF" | "TONR" => {
            format!("the contact that starts it is before it: `LD I0.0`, then `{name}`")
        }
        "=" | "=I" | "S" | "R" | "SI" | "RI" => {
            "begin with the contact that it depends on, such as `LD I0.0`; `LD SM0.0` is always on"
                .into()
        }
        "ALD" | "OLD" => {
            format!("`{name}` joins two branches that begin with `LD`, and is after both")
        }
        _ => "begin with a contact; `LD SM0.0` is always on".into(),
    }
}
