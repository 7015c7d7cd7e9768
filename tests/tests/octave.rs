//! Blocks of IEC 61499 in MATLAB, run by GNU Octave: event by event it has the outputs of the
//! interpreter. One process runs all of them.
//!
//! `MATLAB_BLOCKS=5000 cargo test --package tests --features uno --test octave` runs more,
//! `RANDOM_SEED` starts elsewhere. A failure names its seed.
#![cfg(feature = "uno")]

#[path = "../../lang/fb/tests/random_blocks/generate.rs"]
mod generate;

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Command;

use diagnostics::Source;
use fastrand::Rng;
use fb::interpreter::Value;
use fb::parsed::parse;
use fb::{Block, DataType, Interpreter, matlab, xml};
use generate::Generator;
use tests::effort::effort;

/// Random blocks of an ordinary run.
const BLOCKS: u64 = 150;
/// Calls of each block.
const CALLS: usize = 20;
/// A REAL has 32 bits, a double 64.
const TOLERANCE: f64 = 1e-5;

/// What a call must give: events and outputs, in order.
type Outputs = Vec<f64>;

/// The calls of all blocks, and what they must give.
#[derive(Default)]
struct Calls {
    script: String,
    expected: Vec<(String, Outputs)>,
}

fn number(value: Value) -> f64 {
    match value {
        Value::Real(real) => real.into(),
        other => other.whole() as f64,
    }
}

/// A value as MATLAB writes it, in the class of its type.
fn written(value: Value, of: DataType) -> String {
    match of {
        DataType::Bool => format!("logical({})", number(value)),
        DataType::Dint => format!("int32({})", number(value)),
        _ => format!("{:?}", number(value)),
    }
}

fn random_value(of: DataType, random: &mut Rng) -> Value {
    match of {
        DataType::Bool => Value::Bool(random.bool()),
        DataType::Real => Value::Real(f32::from(random.i16(-160..160)) / 8.0),
        _ => Value::Literal(random.i64(-20..=20)),
    }
    .to(of)
}

/// An event, or none, with inputs by their numbers.
type Call = (Option<usize>, Vec<Value>);

impl Calls {
    /// Adds a block; returns whether its MATLAB does what it does.
    fn add(&mut self, folder: &Path, name: &str, text: &str, calls: &[Call]) -> bool {
        let source = Source::new(format!("{name}.fbt"), text).expect("a short text");
        // A chart without rest is no block.
        let Some(block) = xml::read(&source).block else { return false };
        let written = matlab::write(&block, &source);
        // What MATLAB does otherwise is told.
        let Some(text) = written.text.filter(|_| written.diagnostics.is_empty()) else {
            return false;
        };
        let parsed = parse(&block, &source);
        let mut interpreter = Interpreter::new(&block, &parsed).expect("types that are known");
        let own = text.replacen("= fcn (", &format!("= {name} ("), 1);
        fs::write(folder.join(format!("{name}.m")), own).expect("a folder");
        let mut values: Vec<Value> =
            block.inputs.iter().map(|one| Value::Literal(0).to(one.of_type)).collect();
        for (at, (event, inputs)) in calls.iter().enumerate() {
            values.iter_mut().zip(inputs).for_each(|(value, input)| *value = *input);
            for (input, value) in block.inputs.iter().zip(&values) {
                interpreter.set(&input.name.text, *value);
            }
            let events: Vec<usize> = event.iter().copied().collect();
            let Ok(step) = interpreter.send(&events) else { return at > 0 };
            self.call(name, &block, *event, &values);
            let sent = (0..block.event_outputs.len()).map(|one| step.sent.contains(&one).into());
            let values = block
                .outputs
                .iter()
                .map(|one| number(interpreter.value(&one.name.text).expect("an output")));
            let outputs = sent.map(|is: u8| f64::from(is)).chain(values).collect();
            self.expected.push((format!("{name}, call {at}"), outputs));
        }
        true
    }

    fn call(&mut self, name: &str, block: &Block, event: Option<usize>, values: &[Value]) {
        let events = (0..block.event_inputs.len()).map(|one| (event == Some(one)).to_string());
        let values =
            block.inputs.iter().zip(values).map(|(one, value)| written(*value, one.of_type));
        let all: Vec<String> = events.chain(values).collect();
        let count = block.event_outputs.len() + block.outputs.len();
        let _ = writeln!(
            self.script,
            "o = cell(1, {count}); [o{{:}}] = {name}({}); show(o);",
            all.join(", ")
        );
    }

    /// Runs all calls in one process and compares.
    ///
    /// # Panics
    /// At the first difference.
    fn assert_are_the_same(&self, folder: &Path) {
        let show =
            "function show(o)\nprintf('%.17g ', cellfun(@double, o)); printf(\"\\n\");\nend\n";
        fs::write(folder.join("show.m"), show).expect("a folder");
        fs::write(folder.join("calls.m"), &self.script).expect("a folder");
        let output = Command::new("octave-cli")
            .args(["--no-gui", "--norc", "--quiet", "--eval", "calls"])
            .current_dir(folder)
            .output()
            .expect("GNU Octave is installed (package octave)");
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{errors}");
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), self.expected.len(), "{errors}");
        for ((name, wanted), line) in self.expected.iter().zip(lines) {
            let found: Vec<f64> =
                line.split_whitespace().filter_map(|one| one.parse().ok()).collect();
            let is_near = |(a, b): (&f64, &f64)| (a - b).abs() <= TOLERANCE * b.abs().max(1.0);
            let is_same = found.len() == wanted.len() && found.iter().zip(wanted).all(is_near);
            let file = folder.join(name.split(',').next().unwrap_or(name)).with_extension("m");
            assert!(
                is_same,
                "{name}: Octave has {found:?}, the interpreter {wanted:?}\n{}",
                fs::read_to_string(file).unwrap_or_default()
            );
        }
        println!("{} calls", self.expected.len());
    }
}

#[test]
fn random_blocks_do_in_octave_what_the_interpreter_says() {
    let folder = tempfile::tempdir().expect("a folder");
    let (first, count) = (effort("RANDOM_SEED", 0), effort("MATLAB_BLOCKS", BLOCKS));
    let (mut calls, mut compared) = (Calls::default(), 0);
    for seed in first..first + count {
        let block = Generator::block(seed, true);
        let mut random = Rng::with_seed(seed);
        let mut call = || {
            let inputs = block.inputs.iter().map(|one| random_value(one.of_type, &mut random));
            let inputs = inputs.collect();
            let events = block.event_inputs.len();
            (Some(random.usize(..=events)).filter(|one| *one < events), inputs)
        };
        let all: Vec<Call> = (0..CALLS).map(|_| call()).collect();
        let name = format!("block_{seed}");
        compared += u64::from(calls.add(folder.path(), &name, &xml::write(&block), &all));
    }
    calls.assert_are_the_same(folder.path());
    println!("{compared} of {count} blocks");
    assert!(compared * 3 >= count, "{compared} of {count} blocks");
}

#[test]
fn the_examples_do_in_octave_what_the_interpreter_says() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut calls = Calls::default();
    let tank = include_str!("../../examples/fbt/tank.fbt");
    let levels = [5.0, 9.5, 10.5, 10.6, 10.0, 9.5, 5.0, 9.4];
    let levels = levels.iter().enumerate().map(|(at, level)| {
        (Some(0).filter(|_| at != 6), vec![Value::Real(10.0), Value::Real(*level)])
    });
    assert!(calls.add(folder.path(), "tank", tank, &levels.collect::<Vec<Call>>()));
    let ramp = include_str!("../../examples/fbt/ramp.fbt");
    let inputs = || {
        let whole = |value: i64| Value::Literal(value).to(DataType::Dint);
        vec![Value::Real(0.0), Value::Real(10.0), whole(200), whole(1000), Value::Real(5.0)]
    };
    let events = [1, 0, 1, 1, 1, 1, 1, 1, 1, 0];
    let events = events.iter().map(|event| (Some(*event), inputs()));
    assert!(calls.add(folder.path(), "ramp", ramp, &events.collect::<Vec<Call>>()));
    let excitation = include_str!("../../examples/fbt/excitation.fbt");
    let inputs = || [1.0, 0.8, -0.3, 0.01, 0.5].map(Value::Real).to_vec();
    let events = (0..120).map(|at| (Some(usize::from(at > 0)), inputs()));
    assert!(calls.add(folder.path(), "excitation", excitation, &events.collect::<Vec<Call>>()));
    let out: Vec<f64> = calls.expected[8..18].iter().map(|(_, outputs)| outputs[2]).collect();
    assert_eq!(out, [0.0, 0.0, 0.0, 2.0, 4.0, 6.0, 8.0, 8.0, 8.0, 8.0], "the published trace");
    calls.assert_are_the_same(folder.path());
}

/// A block whose outputs are of all types that a controller computes with.
fn of_all_types(algorithm: &str) -> String {
    let types = ["BOOL", "INT", "DINT", "REAL", "SINT", "USINT", "UINT", "UDINT", "BYTE", "WORD"];
    let names = types.map(|of| (of.to_lowercase(), of));
    let declared =
        names.iter().map(|(name, of)| format!("<VarDeclaration Name='x_{name}' Type='{of}'/>"));
    let with = names.iter().map(|(name, _)| format!("<With Var='x_{name}'/>"));
    format!(
        "<FBType Name='Types'><InterfaceList><EventInputs><Event Name='REQ'><With Var='in'/></Event>
        </EventInputs><EventOutputs><Event Name='CNF'>{}</Event></EventOutputs>
        <InputVars><VarDeclaration Name='in' Type='INT'/></InputVars>
        <OutputVars>{}</OutputVars></InterfaceList><BasicFB><InternalVars>
        <VarDeclaration Name='list' Type='DINT' ArraySize='4' InitialValue='[1, 2, 3, 4]'/>
        </InternalVars><ECC><ECState Name='S'/>
        <ECState Name='T'><ECAction Algorithm='A' Output='CNF'/></ECState>
        <ECTransition Source='S' Destination='T' Condition='REQ'/>
        <ECTransition Source='T' Destination='S' Condition='1'/></ECC>
        <Algorithm Name='A'><ST Text='{algorithm}'/></Algorithm></BasicFB></FBType>",
        with.collect::<String>(),
        declared.collect::<String>(),
    )
}

#[test]
fn functions_and_types_do_in_octave_what_the_interpreter_says() {
    let algorithms = [
        "x_dint := INT_TO_DINT(in) * 1000; x_int := DINT_TO_INT(x_dint); x_bool := in > 3;",
        "x_sint := INT_TO_SINT(in); x_usint := INT_TO_USINT(in); x_uint := INT_TO_UINT(in);",
        "x_real := INT_TO_REAL(in) / 4.0; x_int := REAL_TO_INT(x_real); x_dint := TRUNC(x_real);",
        "x_int := LIMIT(-3, in, 4); x_dint := SEL(in > 0, 5, 6); x_real := MAX(1.5, x_real);",
        "x_byte := INT_TO_BYTE(in) AND 15; x_word := INT_TO_WORD(in) OR NOT x_word;",
        "x_byte := x_byte XOR INT_TO_BYTE(in); x_bool := x_byte = 3;",
        "x_dint := list[ABS(in) MOD 4]; list[1] := x_dint + in; x_udint := DINT_TO_UDINT(list[1]);",
        "x_real := SQRT(ABS(INT_TO_REAL(in))) + EXP(0.5) + LN(2.0) + LOG(3.0) + ATAN(0.5);",
        "x_real := SIN(0.5) + COS(0.5) + TAN(0.5) + ASIN(0.5) + ACOS(0.5) + 2.0 ** 3.0;",
        "x_sint := x_sint / 2 + 7; x_dint := x_dint + x_sint; x_usint := x_usint / 3 + 20;",
        "x_int := 7 / -2; x_dint := (INT_TO_DINT(in) - 40) / 7; x_uint := x_uint MOD 5 + 9;",
        "x_dint := 0; FOR x_dint := 5 TO 1 DO x_int := 3; END_FOR;",
    ];
    let folder = tempfile::tempdir().expect("a folder");
    let mut calls = Calls::default();
    for (at, algorithm) in algorithms.iter().enumerate() {
        let text = of_all_types(&algorithm.replace('<', "&lt;"));
        let whole = |value: i64| Value::Literal(value).to(DataType::Int);
        let inputs = [0, 1, -1, 3, 7, -7, 15, 19, -20].map(|value| (Some(0), vec![whole(value)]));
        assert!(calls.add(folder.path(), &format!("types_{at}"), &text, &inputs), "{algorithm}");
    }
    calls.assert_are_the_same(folder.path());
}
