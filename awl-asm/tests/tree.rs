//! Syntax trees that come from elsewhere: the same image as from the text, and clear errors where a
//! front end is wrong.

use awl_asm::Address;
use awl_asm::assemble::{Assembly, assemble, assemble_tree};
use awl_asm::ast::{
    Constant, DataLine, Instruction, Operand, Program, Span, Statement, UnitId, UnitKind, Value,
};
use awl_asm::parser::parse;
use awl_asm::source::Source;
use plc_isa::{Area, Op, Relation};

fn instruction(op: Op, relation: Option<Relation>, values: &[Value]) -> Statement {
    let operand = |value: &Value| Operand { span: Span::default(), value: value.clone() };
    Statement::Instruction(Instruction {
        entry: op.instruction(),
        relation,
        mnemonic_span: Span::default(),
        operands: values.iter().map(operand).collect(),
        span: Span::default(),
    })
}

fn bit(area: Area, bit: u8) -> Value {
    Value::Address(Address::Bit { area, byte: 0, bit })
}

fn assembled(statements: Vec<Statement>) -> Assembly {
    assemble_tree(Program { statements, ..Program::default() }, "tree")
}

fn messages(statements: Vec<Statement>) -> Vec<String> {
    let assembly = assembled(statements);
    assert_eq!(assembly.image, None);
    assembly.diagnostics.iter().map(|one| format!("{} {}", one.code.text(), one.message)).collect()
}

#[test]
fn a_tree_by_hand_is_the_same_program_as_its_text() {
    let word = Value::Address(Address::Word { area: Area::M, byte: 0 });
    let five = Value::Constant(Constant { value: 5, is_pattern: false });
    let tree = assembled(vec![
        instruction(Op::Ld, None, &[bit(Area::I, 0)]),
        instruction(Op::Aw, Some(Relation::GreaterOrEqual), &[word, five]),
        instruction(Op::Assign, None, &[bit(Area::Q, 1)]),
    ]);
    let source = Source::new("tree.awl", "LD I0.0\nAW>= MW0, 5\n= Q0.1\n").unwrap();
    let text = assemble(&source, Vec::new());
    assert!(text.image.is_some(), "{:?}", text.diagnostics);
    assert_eq!(tree.image, text.image, "{:?}", tree.diagnostics);
}

#[test]
fn what_the_parser_reads_is_a_good_tree() {
    let text = "ORGANIZATION_BLOCK MAIN:OB1\nBEGIN\nNETWORK 1\nLD SM0.0\nCALL SBR0, 3, VW10\n\
                MOVW *VD0, AC1\nMOVD &VB4, VD0\nSCPY \"abc\", VB20\nLD T37\nTON T37, +10\n\
                LD C1\nMOVW HC0, VW8\nMOVW AIW0, AQW0\nEND_ORGANIZATION_BLOCK\n\
                SUBROUTINE_BLOCK S:SBR0\nVAR_INPUT\na:INT;\nEND_VAR\nVAR_OUTPUT\nb:INT;\nEND_VAR\n\
                BEGIN\nLD SM0.0\nMOVW #a, #b\nEND_SUBROUTINE_BLOCK\n\
                DATA_BLOCK\nVB100 1, 2\nEND_DATA_BLOCK\n";
    let source = Source::new("tree.awl", text).unwrap();
    let (program, _) = parse(&source, Vec::new());
    let (tree, text) = (assemble_tree(program, "tree"), assemble(&source, Vec::new()));
    let messages = |assembly: &Assembly| {
        assembly.diagnostics.iter().map(|one| one.message.clone()).collect::<Vec<_>>()
    };
    assert_eq!(messages(&tree), messages(&text));
    assert_eq!(tree.image, text.image);
}

#[test]
fn what_no_parser_makes_is_reported() {
    let load = || instruction(Op::Ld, None, &[bit(Area::I, 0)]);
    assert_eq!(
        messages(vec![load(), instruction(Op::Aw, None, &[bit(Area::I, 0)])]).first().unwrap(),
        "E0002 AW: the comparison is missing"
    );
    let hidden = instruction(Op::CallBegin, None, &[]);
    assert_eq!(
        messages(vec![load(), hidden]),
        ["E0001 an instruction that only the assembler makes"]
    );
    assert_eq!(
        messages(vec![load(), instruction(Op::Assign, None, &[bit(Area::Q, 9)])]),
        ["E0005 Q0.9: there is no such address"]
    );
    let routine = UnitId { kind: UnitKind::Subroutine, number: 3 };
    assert_eq!(
        messages(vec![load(), instruction(Op::Call, None, &[Value::Unit(routine)])]),
        ["E0072 SBR3: there is no such routine"]
    );
    let line = DataLine { span: Span::default(), first_byte: u16::MAX, bytes: vec![1, 2] };
    let program = Program { data: vec![line], statements: vec![load()], ..Program::default() };
    let assembly = assemble_tree(program, "tree");
    assert_eq!(assembly.image, None);
    assert_eq!(
        assembly.diagnostics.first().unwrap().message,
        "VB65535: outside V memory, or given a value twice"
    );
}
