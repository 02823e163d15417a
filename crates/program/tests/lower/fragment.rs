//! Fragments: terms, rules and locations added to a lowered program.

use expect_test::expect;
use model::{Call, FunctionId, Model, RuleKind, RuleNode, Term, TermKind};
use syntax::{FileId, Span};

use crate::{lowered, model};

const PLACE: Span = Span { file: FileId(0), start: 0, end: 0 };

fn example() -> Model {
    model(
        "controlled n: Integer\n controlled f: Integer -> Integer",
        "rule r_set($l in Integer, $v in Integer) = $l := $v + n
         main rule r_Main = r_set[f(n), f(1)]",
    )
}

fn apply(model: &Model, name: &str, arguments: Vec<Term>) -> Term {
    let index = model.functions.iter().position(|function| function.name == name && !function.library).unwrap();
    let domain = model.functions[index].codomain;
    Term { kind: TermKind::Apply { function: FunctionId(index as u32), arguments }, domain, span: PLACE }
}

#[test]
fn a_rule_shares_the_procedures_that_are_there() {
    let model = example();
    let mut program = lowered(&model);
    let before = program.procedures.len();
    let main = &model.rules[model.main.unwrap().0 as usize];
    let again = program::lower_rule(&mut program, &model, main).unwrap();
    assert_eq!((again.0 as usize, program.procedures.len()), (before, before + 1));

    let callee = model.rules.iter().position(|rule| rule.name == "r_set").unwrap();
    let n = || apply(&model, "n", Vec::new());
    let call = Call { rule: model::RuleId(callee as u32), arguments: vec![n(), apply(&model, "f", vec![n()])] };
    let mut rule = main.clone();
    rule.name = "exec".to_string();
    rule.body = RuleNode { kind: RuleKind::MacroCall(call), span: PLACE };
    program::lower_rule(&mut program, &model, &rule).unwrap();
    program::verify(&program).unwrap();
    expect![[r#"
        asm x
        controlled n: Integer
        controlled f: Integer -> Integer
        rule r_Main#0 main
          call r_set#1()
        rule r_set#1
          f(n) := IntAdd(f(1), n)
        rule r_Main#2
          call r_set#1()
        rule exec#3
          call r_set#4()
        rule r_set#4
          n := IntAdd(f(n), n)
    "#]]
    .assert_eq(&program::dump(&program));
}

#[test]
fn terms_and_locations() {
    let model = example();
    let mut program = lowered(&model);
    let location = apply(&model, "f", vec![apply(&model, "n", Vec::new())]);
    let (function, arguments) = program::lower_location(&mut program, &model, &location, &[]).unwrap();
    assert_eq!((program.function(function).name.as_str(), arguments.len()), ("f", 1));
    let term = program::lower_term(&mut program, &model, &location, &[]).unwrap();
    assert!(!program.reads_monitored(&term));
    assert_eq!(term.frame, 0);
    program::verify(&program).unwrap();

    let value = Term { kind: TermKind::Literal(model::Literal::Integer(1)), domain: location.domain, span: PLACE };
    let fault = program::lower_location(&mut program, &model, &value, &[]).unwrap_err();
    assert_eq!(fault[0].id, "not-a-location");
}
