//! Limits: doubling by name is cut off, and said.

use crate::faults;

#[test]
fn a_model_that_doubles_is_too_large() {
    let mut definitions = String::from("rule r_0($x in Integer) = n := $x\n");
    for level in 1..40 {
        definitions += &format!("rule r_{level}($x in Integer) = r_{}[$x + $x]\n", level - 1);
    }
    definitions += "main rule r_Main = r_39[n]";
    let found = faults("controlled n: Integer", &definitions);
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].id, "model-too-large");
}

#[test]
fn an_unused_argument_costs_nothing() {
    let mut definitions = String::from("rule r_0($x in Integer) = n := 1\n");
    for level in 1..40 {
        definitions += &format!("rule r_{level}($x in Integer) = r_{}[$x + $x]\n", level - 1);
    }
    definitions += "main rule r_Main = r_39[n]";
    let program = crate::lowered(&crate::model("controlled n: Integer", &definitions));
    assert!(program.terms.len() < 100);
}

#[test]
fn arguments_that_nest_without_end_are_cut_off() {
    let mut definitions = String::from("rule r_0($x in Integer) = n := $x\n");
    for level in 1..2500 {
        definitions += &format!("rule r_{level}($x in Integer) = r_{}[$x + 1]\n", level - 1);
    }
    definitions += "main rule r_Main = r_2499[n]";
    let found = faults("controlled n: Integer", &definitions);
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].id, "model-too-large");
}
