//! Which properties come along, in which words, and why others do not: one case for each reason.

use std::sync::Arc;

use program::Program;
use refine::{Preserved, Verdict};

use crate::small::{program, report};

const SIGNATURE: &str = "enum domain Mode = {IDLE | BUSY} domain N subsetof Integer monitored go: Boolean
    controlled n: N controlled f: N -> Boolean controlled mode: Mode controlled hidden: Boolean
    derived busy: Boolean derived low: N -> Boolean";

/// A machine over these functions with this main rule and these properties.
fn machine(signature: &str, elements: &str, rule: &str, properties: &str) -> Arc<Program> {
    let text = format!(
        "asm M\nimport StandardLibrary\nimport CTLLibrary\nimport LTLLibrary\nsignature:\n{signature}\ndefinitions:\n\
         domain N = {elements}\nfunction busy = mode = BUSY\nfunction low($k in N) = $k < 2 and f($k)\n{properties}\n\
         main rule r_Main = {rule}\ndefault init s0: function n = 0 function mode = IDLE function hidden = false\n\
         function f($k in N) = false\n"
    );
    program("M", &text)
}

const ROUND: &str = "n := (n + 1) mod 3";

/// The only property, of a machine with `ROUND`, in another with this rule.
fn preserved(properties: &str, rule: &str, coupling: &str) -> Preserved {
    let one = machine(SIGNATURE, "{0:2}", ROUND, properties);
    let other = machine(SIGNATURE, "{0:2}", rule, "");
    let found = report(&one, &other, Some(coupling));
    assert_eq!(found.verdict, Verdict::Refines, "{rule} {coupling}");
    found.properties.into_iter().next().expect("a property")
}

/// What comes along by `same n, f, mode;` to a machine that makes the same steps.
fn same(property: &str) -> Result<String, String> {
    preserved(property, ROUND, "same n, f, mode;").form
}

fn is(found: Result<String, String>, form: &str) {
    assert_eq!(found.as_deref(), Ok(form));
}

fn not(found: Result<String, String>, why: &str) {
    let reason = found.expect_err("it does not come along");
    assert!(reason.contains(why), "{reason}");
}

#[test]
fn terms_are_written_for_the_other_machine() {
    is(same("invariant over n: n + 1 > 0 and (n = 0 or not f(1))"), "n + 1 > 0 and (n = 0 or not f(1))");
    is(same("invariant over n: not (n = 1) implies busy"), "not (n = 1) implies mode = BUSY");
    is(
        same("invariant over n: (forall $k in N with low($k) implies $k < n - 1)"),
        "(forall $x in N with ($x < 2 and f($x)) implies $x < n - 1)",
    );
    is(
        same("invariant over n: (exists $k in N with (exists $j in N with $j * 2 > $k))"),
        "(exists $x in N with (exists $y in N with $y * 2 > $x))",
    );
    is(same("invariant over n: if n = 0 then true else n > 0 endif"), "if n = 0 then true else n > 0 endif");
    is(same("invariant over n: (let ($k = n) in $k >= 0 endlet)"), "let ($x = n) in $x >= 0 endlet");
    is(same("invariant over n: contains({0, 1, 2}, n) and min(n, 1) < 2"), "contains({0, 1, 2}, n) and min(n, 1) < 2");
}

#[test]
fn what_is_not_the_same_in_both_does_not_come_along() {
    not(same("invariant over hidden: not hidden"), "abstract.hidden, which the coupling does not determine");
    not(same("invariant over n: go or n < 3"), "the input go");
    not(same("invariant over f: f(n)"), "not known to be in its domain");
    not(same("invariant over f: f(7) or n < 3"), "not known to be in its domain");
    not(same("invariant over n: toString(n) = \"0\""), "an order of elements");
    // The other machine has another literal, or a domain with other elements.
    let coupling = |signature: &str, elements: &str, property: &str| {
        let one = machine(SIGNATURE, "{0:2}", ROUND, property);
        // The fourth element of the other machine has no value of `f` here.
        let same = match elements {
            "{0:2}" => "same n, f, mode;",
            _ => "same n, mode; couple (forall $k in {0 : 2} with abstract.f($k) = concrete.f($k));",
        };
        let found = report(&one, &machine(signature, elements, ROUND, ""), Some(same));
        assert_eq!(found.verdict, Verdict::Refines);
        found.properties[0].form.clone()
    };
    let more = SIGNATURE.replace("IDLE | BUSY", "IDLE | BUSY | GONE");
    is(coupling(&more, "{0:2}", "invariant over mode: mode = IDLE"), "mode = IDLE");
    not(
        coupling(&more, "{0:2}", "invariant over mode: (exists $m in Mode with $m = mode)"),
        "no domain Mode with the same elements",
    );
    not(
        coupling(SIGNATURE, "{0:3}", "invariant over n: (exists $k in N with $k = n)"),
        "no domain N with the same elements",
    );
    not(coupling(SIGNATURE, "{0:3}", "invariant over f: not f(1)"), "which the coupling does not determine");
    is(coupling(SIGNATURE, "{0:3}", "invariant over n: n < 3"), "n < 3");
}

#[test]
fn a_function_may_be_a_term_of_the_other_machine() {
    let mirrored = |coupling: &str, property: &str| preserved(property, "n := (n + 2) mod 3", coupling).form;
    let turned = "couple abstract.n = (3 - concrete.n) mod 3;";
    is(mirrored(turned, "invariant over n: n < 2"), "(3 - n) mod 3 < 2");
    is(
        mirrored("couple not concrete.hidden and (3 - concrete.n) mod 3 = abstract.n;", "invariant over n: n < 2"),
        "(3 - n) mod 3 < 2",
    );
    // A term may be known though its functions are not.
    let term = "couple (abstract.n = 0) = (concrete.n = 0);";
    is(mirrored(term, "CTLSPEC ag(n = 0 implies not (n = 0) or n = 0)"), "ag(n = 0 implies (not (n = 0) or n = 0))");
    not(mirrored(term, "invariant over n: n = 1 or n = 0"), "abstract.n, which the coupling does not determine");
    not(mirrored(term, "invariant over n: n < 3"), "abstract.n, which the coupling does not determine");
    let each =
        "couple (forall $k in N with (abstract.f($k) and abstract.n = $k) = (concrete.f($k) and concrete.hidden));";
    let found = preserved("invariant over f: (forall $j in N with not f($j))", ROUND, &format!("same n; {each}"));
    not(found.form, "does not determine");
    let each = "couple (forall $k in N with (not abstract.f($k)) = (not concrete.f($k) and not concrete.hidden));";
    let found =
        preserved("invariant over f: (forall $j in N with not f($j) or n = $j)", ROUND, &format!("same n; {each}"));
    is(found.form, "(forall $x in N with (not f($x) and not hidden) or n = $x)");
    let found =
        preserved("invariant over f: (forall $j in N with not f(2) or n = $j)", ROUND, &format!("same n; {each}"));
    not(found.form, "does not determine");
    // An inequation, or a part of a domain, determines nothing.
    let loose = "couple abstract.n <= 2 and concrete.n >= 0 and (abstract.n = 0 iff concrete.n = 0);";
    not(mirrored(loose, "invariant over n: n < 3"), "does not determine");
    let all = "same n; couple (forall $k in N with abstract.f($k) iff not concrete.hidden and concrete.f($k));";
    is(
        preserved("invariant over f: (forall $j in N with not f($j))", ROUND, all).form,
        "(forall $x in N with not (not hidden and f($x)))",
    );
    let some = "same n; couple (forall $k in N with $k = 0 or (abstract.f($k) iff concrete.f($k)));";
    not(preserved("invariant over f: (forall $j in N with not f($j))", ROUND, some).form, "does not determine");
}

#[test]
fn a_formula_needs_runs_that_keep_step() {
    let two = "n := (n + 2) mod 3";
    // Two abstract steps are one: states are passed over.
    let passed = |property: &str| preserved(property, two, "same n; diagrams 2:1;").form;
    is(passed("CTLSPEC ag(n < 3)"), "ag(n < 3)");
    not(passed("CTLSPEC aw(n = 0, n = 1)"), "several abstract steps");
    not(passed("LTLSPEC f(n = 1)"), "several abstract steps");
    // The concrete machine waits, and it is taken for granted that it ends.
    let waits =
        |property: &str| preserved(property, "if go then n := (n + 1) mod 3 endif", "same n; allow waiting;").form;
    is(waits("CTLSPEC aw(n = 0, n = 1)"), "aw(n = 0, n = 1)");
    not(waits("CTLSPEC af(n = 1)"), "something must happen");
    not(waits("LTLSPEC not g(n = 0)"), "something must happen");
    is(waits("LTLSPEC not f(n > 2)"), "not f(n > 2)");
    // It waits for one step.
    let slow = "if hidden then par n := (n + 1) mod 3 hidden := false endpar else hidden := true endif";
    is(preserved("CTLSPEC af(n = 1)", slow, "same n;").form, "af(n = 1)");
    not(preserved("CTLSPEC ax(n = 1)", slow, "same n;").form, "the next step");
    is(preserved("CTLSPEC ax(n = 1)", ROUND, "same n;").form, "ax(n = 1)");
    not(same("CTLSPEC ef(n = 1)"), "some run");
    not(same("CTLSPEC not ag(n = 1)"), "some run");
    is(same("CTLSPEC not ef(n > 2)"), "not ef(n > 2)");
    not(same("CTLSPEC ag(n < 3)\nJUSTICE n = 0"), "fair runs");
    is(same("invariant over n: n < 3\nJUSTICE n = 0"), "n < 3");
}

/// Assumptions may end a run within a segment: the states there correspond to nothing.
#[test]
fn a_run_may_end_within_a_segment() {
    let one = machine(SIGNATURE, "{0:2}", "hidden := not hidden", "invariant over n: n = 0");
    let rule = "if hidden then par n := 2 hidden := false endpar else par n := 1 hidden := true endpar endif";
    let other = machine(SIGNATURE, "{0:2}", rule, "INVAR n != 2");
    let form = |coupling: &str| {
        let found = report(&one, &other, Some(coupling));
        assert_eq!(found.verdict, Verdict::Refines);
        found.properties[0].form.clone()
    };
    is(form("same n; segment not concrete.hidden;"), "not hidden implies n = 0");
    not(form("same n; diagrams 0..1:2;"), "no `segment`");
}

#[test]
fn where_segments_end_is_said() {
    // In between `n` is what corresponds to nothing.
    let wild = "if hidden then par n := (n + 2) mod 3 hidden := false endpar else par n := (n + 2) mod 3 hidden := true endpar endif";
    let by = |coupling: &str, property: &str| preserved(property, wild, coupling).form;
    let segment = "same n; segment not concrete.hidden;";
    is(by(segment, "invariant over n: n < 2"), "not hidden implies n < 2");
    is(
        by(segment, "CTLSPEC ag(n = 0 implies af(n = 1))"),
        "ag(not hidden implies (n = 0 implies af(not hidden and n = 1)))",
    );
    is(by(segment, "LTLSPEC u(n = 0, n = 1)"), "u(not hidden implies n = 0, not hidden and n = 1)");
    not(by(segment, "CTLSPEC ax(n = 1)"), "the next step");
    not(by(segment, "CTLSPEC ap(n = 2, n = 1)"), "is not translated to the ends of segments");
    not(
        by("couple abstract.n = concrete.n and not concrete.hidden; diagrams 1:2;", "invariant over n: n < 2"),
        "no `segment`",
    );
    let late = "same n; segment not concrete.hidden and concrete.n != 0; diagrams 1..2:1..4;";
    is(by(late, "invariant over n: n < 2"), "(not hidden and n != 0) implies n < 2");
    not(by(late, "CTLSPEC ag(n < 2)"), "an initial state");
}
