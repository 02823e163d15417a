//! Elements that a machine makes by `extend` are not those of a coupling: nothing is said of them that was not compared.

use std::sync::Arc;

use program::Program;
use refine::{Coupling, Incomparable, LeftOut, Verdict};
use syntax::SourceFile;

use crate::small::{machine, report};

/// It makes an item that is held, and a second one that is or is not.
fn maker(second: &str) -> Arc<Program> {
    let signature = "dynamic abstract domain Item domain K subsetof Integer controlled held: Item -> Boolean controlled k: K \
                     monitored pick: Item -> Boolean derived allHeld: Boolean";
    let rule = format!(
        "domain K = {{0:2}} function allHeld = (forall $i in Item with held($i))\n\
         main rule r_Main = if k < 2 then extend Item with $i do par held($i) := if k = 0 then true else {second} endif \
         k := k + 1 endpar endif"
    );
    machine(signature, &rule, "function k = 0")
}

fn refused(one: &Arc<Program>, other: &Arc<Program>, text: &str) -> (String, String) {
    let coupling = Coupling::new([one, other], Some(SourceFile::new("c.refine", text)), &machine::Limits::default());
    let faulty = coupling.err().unwrap_or_else(|| panic!("{text}"));
    let fault = &faulty.faults[0];
    (text[fault.primary.span.range()].to_string(), fault.message.clone())
}

#[test]
fn a_coupling_goes_through_no_elements_that_are_made() {
    let (one, other) = (maker("true"), maker("false"));
    for text in [
        "same k; couple (forall $i in Item with concrete.held($i));",
        "same k; couple (exist $i in Item with not concrete.held($i)) or concrete.k < 3;",
        "same k; couple size({ $i in Item | concrete.held($i) : $i }) = 0;",
        "same k; segment (forall $i in Item with concrete.held($i));",
        "same k; fair (forall $i in Item with concrete.held($i));",
        "same k; variant size({ $i in Item | true : $i });",
    ] {
        let (at, says) = refused(&one, &other, text);
        assert!(at == "Item" && says.contains("does not see them"), "{text}: {at}: {says}");
    }
    // A derived function does.
    let coupled = Some("same k; couple concrete.allHeld;");
    assert_eq!(report(&one, &one, coupled).verdict, Verdict::Refines);
    assert!(matches!(report(&one, &other, coupled).verdict, Verdict::DoesNot(_)));
}

#[test]
fn functions_of_such_elements_are_not_said_to_be_compared() {
    let (one, other) = (maker("true"), maker("false"));
    let (at, says) = refused(&one, &other, "same k, held;");
    assert!(at == "held" && says.contains("arguments in Item"), "{says}");
    let coupling = Coupling::new([&one, &other], None, &machine::Limits::default())
        .unwrap_or_else(|faulty| panic!("{:?}", faulty.faults));
    assert_eq!(coupling.same, ["k"]);
    let left_out = [LeftOut { name: "held".to_string(), why: Incomparable::Made("Item".to_string()) }];
    assert_eq!(coupling.left_out, left_out);
}

#[test]
fn inputs_of_such_elements_are_not_the_same() {
    let picks = |rule: &str| {
        let signature = "dynamic abstract domain Item controlled made: Boolean controlled hit: Boolean monitored pick: Item -> Boolean";
        let rule = format!("main rule r_Main = if not made then extend Item with $i do made := true else {rule} endif");
        machine(signature, &rule, "function made = false function hit = false")
    };
    let (one, other) =
        (picks("hit := (exist $i in Item with pick($i))"), picks("hit := not (exist $i in Item with pick($i))"));
    for text in ["same made, hit;", "same made, hit; input abstract.pick = concrete.pick;"] {
        let (_, says) = refused(&one, &other, text);
        assert!(says.contains("elements of Item"), "{text}: {says}");
    }
    assert_eq!(report(&one, &other, Some("same made, hit; free abstract.pick;")).verdict, Verdict::Refines);
}
