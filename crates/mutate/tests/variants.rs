//! When two variants of a model are the same.

use std::sync::Arc;

use mutate::{Differs, Extent, Variant, same};
use program::Program;
use syntax::SourceFile;
use testkit::NoFiles;

fn program(rule: &str, initial: &str) -> Arc<Program> {
    let text = format!(
        "asm A\nimport StandardLibrary\nsignature:\ndomain Small subsetof Integer\n\
         controlled a: Small\ncontrolled on: Boolean\nmonitored asked: Boolean\n\
         definitions:\ndomain Small = {{0 : 3}}\nmain rule r_Main = {rule}\n\
         default init s0:\nfunction a = {initial}\nfunction on = false\n"
    );
    let checked = model::check(SourceFile::new("A.asm", text), &mut NoFiles);
    assert!(checked.diagnostics.is_empty(), "{:?}", checked.diagnostics);
    Arc::new(program::lower(&checked.model).expect("it is lowered"))
}

fn check(one: (&str, &str), other: (&str, &str), expect: Result<(), Differs>) {
    let (one, other) = (program(one.0, one.1), program(other.0, other.1));
    let extent = Extent { max_states: 100, ..Extent::default() };
    let variant = |program| Variant { program, observed: &[] };
    assert_eq!(same(variant(&one), variant(&other), &extent), expect);
    assert_eq!(same(variant(&other), variant(&one), &extent), expect, "the other way round");
}

#[test]
fn variants_are_compared_in_every_state() {
    let count = "if a < 3 then a := a + 1 else a := 0 endif";
    check((count, "0"), (count, "0"), Ok(()));
    check((count, "0"), ("if a != 3 then a := a + 1 else a := 0 endif", "0"), Ok(()));
    check((count, "0"), ("if a < 2 then a := a + 1 else a := 0 endif", "0"), Err(Differs::Somewhere));
    check((count, "0"), (count, "1"), Err(Differs::Somewhere));
    // The difference is never reached.
    check(
        ("if a < 3 then a := a + 1 else on := true endif", "3"),
        ("if a < 2 then a := a + 1 else on := true endif", "3"),
        Ok(()),
    );
    // A fault is no step.
    check((count, "0"), ("a := a + 1", "0"), Err(Differs::Somewhere));
}

#[test]
fn what_is_done_at_an_input_counts() {
    let one = "if asked then on := true else on := false endif";
    check((one, "0"), ("if asked then on := false else on := true endif", "0"), Err(Differs::Somewhere));
    check((one, "0"), ("on := asked", "0"), Ok(()));
    let free = "choose $x in Small with true do a := $x";
    check((free, "0"), ("choose $x in Small with $x < 4 do a := $x", "0"), Ok(()));
    check((free, "0"), ("choose $x in Small with $x < 3 do a := $x", "0"), Err(Differs::Somewhere));
}

#[test]
fn a_limit_proves_nothing() {
    let (one, extent) = (program("a := 0", "0"), Extent { max_states: 0, ..Extent::default() });
    let variant = Variant { program: &one, observed: &[] };
    assert_eq!(same(variant, variant, &extent), Err(Differs::TooFar));
}
