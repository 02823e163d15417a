//! The verifier finds what is broken on purpose.

use program::{Program, RuleId, Slot, Term, TermId};

use crate::{lowered, model};

fn broken(damage: impl FnOnce(&mut Program)) -> String {
    let model = model(
        "controlled n: Integer\n controlled f: Integer -> Integer",
        "rule r_set($x in Integer) = f($x) := $x
         main rule r_Main = forall $y in {1 : 3} do par r_set[$y] n := f($y) + 1 endpar",
    );
    let mut program = lowered(&model);
    damage(&mut program);
    program::verify(&program).expect_err("damaged")
}

fn first(program: &Program, wanted: impl Fn(&Term) -> bool) -> usize {
    program.terms.iter().position(wanted).expect("such a term")
}

#[test]
fn indices_lie_in_their_tables() {
    let why = broken(|program| {
        let at = first(program, |term| matches!(term, Term::Constant(_)));
        program.terms[at] = Term::Constant(99);
    });
    assert!(why.ends_with("there is no constant 99"), "{why}");
    let why = broken(|program| program.procedures[0].body = RuleId(99));
    assert!(why.ends_with("the body does not exist"), "{why}");
}

#[test]
fn children_stand_before_their_parents() {
    let why = broken(|program| {
        let last = program.terms.len() as u32 - 1;
        program.terms[0] = Term::Coerce(TermId(last));
    });
    assert_eq!(why, "term 0 stands before a child");
}

#[test]
fn slots_are_bound_around_and_once() {
    let slot = |program: &Program| first(program, |term| matches!(term, Term::Slot(_)));
    let why = broken(|program| {
        let at = slot(program);
        program.terms[at] = Term::Slot(Slot(7));
    });
    assert!(why.ends_with("slot 7 is not bound here"), "{why}");
    let why = broken(|program| {
        let twice = program.binder_lists[0];
        program.binder_lists.push(twice);
        program.binder_lists.push(twice);
        let list = program::BinderList { start: 1, len: 2 };
        for rule in &mut program.rules {
            if let program::Rule::Forall { binders, .. } = rule {
                *binders = list;
            }
        }
    });
    assert!(why.ends_with("slot 0 is bound twice"), "{why}");
}

#[test]
fn applications_have_all_arguments() {
    let why = broken(|program| {
        let read = first(program, |term| matches!(term, Term::Read { arguments, .. } if arguments.len == 1));
        if let Term::Read { arguments, .. } = &mut program.terms[read] {
            arguments.len = 0;
        }
    });
    assert!(why.ends_with("f takes 1 arguments, not 0"), "{why}");
}
