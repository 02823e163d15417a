//! Domains of which one machine has more elements than the other.

use std::sync::Arc;

use program::Program;
use refine::Verdict;

use crate::induction::{proved, refines};
use crate::small::{machine, refuted, report};

/// A machine over the seats from 0 to `last`; `kind` is how the function is declared that says which may be sold.
fn hall(last: u32, kind: &str, function: &str, rule: &str) -> Arc<Program> {
    let (defined, begun) = match kind {
        "controlled" => (String::new(), format!("function {function}($s in Seat) = true")),
        "static" => (format!("function {function}($s in Seat) = true"), String::new()),
        _ => (format!("function {function}($s in Seat) = tick or not tick"), String::new()),
    };
    machine(
        &format!("domain Seat subsetof Integer {kind} {function}: Seat -> Boolean controlled tick: Boolean"),
        &format!("domain Seat = {{0:{last}}} {defined} main rule r_Main = {rule}"),
        &format!("{begun} function tick = false"),
    )
}

const SOLD: &str = "same tick; couple (forall $s in Seat with not concrete.unsold($s) implies abstract.may($s));";

#[test]
fn an_element_that_the_abstract_machine_lacks_is_none_of_its_functions() {
    for kind in ["controlled", "static", "derived"] {
        let one = hall(2, kind, "may", "tick := not tick");
        let sells = |last: u32, seat: u32| {
            let rule = format!("par tick := not tick unsold({seat}) := false endpar");
            hall(last, "controlled", "unsold", &rule)
        };
        assert_eq!(report(&one, &sells(2, 2), Some(SOLD)).verdict, Verdict::Refines, "{kind}");
        assert_eq!(report(&one, &sells(3, 2), Some(SOLD)).verdict, Verdict::Refines, "{kind}");
        // What may change is not known by induction alone.
        if kind != "controlled" {
            refines(&one, &sells(2, 2), SOLD);
            refines(&one, &sells(3, 2), SOLD);
        }
        // `may(3)` is undef, so the fourth seat is not one that may be sold.
        refuted(report(&one, &sells(3, 3), Some(SOLD)));
        if let Some(report) = proved(&one, &sells(3, 3), SOLD) {
            assert!(!matches!(report.verdict, Verdict::Refines), "{kind}: {:?}", report.verdict);
        }
    }
}

#[test]
fn of_more_elements_the_same_function_has_other_values() {
    let one = hall(2, "static", "may", "tick := not tick");
    let other = hall(3, "static", "may", "tick := not tick");
    assert_eq!(report(&one, &one, Some("same tick, may;")).verdict, Verdict::Refines);
    assert_ne!(report(&one, &other, Some("same tick, may;")).verdict, Verdict::Refines);
}
