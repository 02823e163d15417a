//! Each fault of a formula has a page in spec/faults/ whose example shows it.

use expect_test::{Expect, expect};
use testkit::Page;
use verify::temporal::read::{IDS, read};

use crate::formula::{lowered, model};

#[test]
fn each_id_has_a_page_whose_example_yields_it() {
    for id in IDS {
        let faults = read(&lowered(Page::fault(id).example("asmetal fault"))).expect_err("a fault");
        assert_eq!(faults.iter().map(|fault| fault.id).collect::<Vec<_>>(), [*id]);
        assert!(faults[0].help.is_some());
    }
}

fn check(definitions: &str, expect: Expect) {
    let signature = "controlled level: Integer
        controlled ready: Boolean
        abstract domain Box
        dynamic abstract domain Job
        static low: Integer -> Boolean";
    let text = model(signature, &format!("function low($n in Integer) = g($n < 3)\n{definitions}"));
    let text = text.replace("r_Main = skip", "r_Main = extend Job with $j do skip");
    let mut shown = String::new();
    for fault in read(&lowered(&text)).expect_err("a fault") {
        let at = |span: syntax::Span| text[span.start as usize..span.end as usize].to_string();
        shown += &format!("{}: {} at `{}`\n", fault.id, fault.message, at(fault.primary.span));
        for label in &fault.secondary {
            shown += &format!("  {} at `{}`\n", label.text, at(label.span));
        }
    }
    expect.assert_eq(&shown);
}

#[test]
fn faults_stand_where_they_are() {
    check(
        "CTLSPEC ag(f(ready))
         LTLSPEC g(ready) and ef(ready)
         LTLSPEC size({g(ready), ready}) = 1
         LTLSPEC low(level)
         LTLSPEC (forall $j in Job with f(ready))
         LTLSPEC (forall $n in Integer with g(level != $n))
         LTLSPEC let ($n = level) in x(level > $n) endlet",
        expect![[r#"
            mixed-logics: an operator of the LTL library is used in a formula of CTL at `f(ready)`
            mixed-logics: an operator of the CTL library is used in a formula of LTL at `ef(ready)`
            temporal-in-term: a formula about runs stands where a value is needed at `size({g(ready), ready}) = 1`
              this speaks of runs at `g(ready)`
            temporal-over-changing: an argument of a formula about runs changes from state to state at `level`
            temporal-over-changing: the range of a formula about runs changes from state to state at `Job`
            temporal-over-changing: what this ranges over cannot be enumerated at `Integer`
            temporal-over-changing: a variable of a formula about runs changes from state to state at `level`
        "#]],
    );
}
