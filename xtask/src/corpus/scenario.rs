//! Does a scenario come to the same verdict?
//!
//! In: a scenario and the peer's verdict. Out: an [`Answer`]. The peer's `PASS` is our passed; its `FAIL` (a check, an
//! invariant) our failed; its `ERROR` either a failed one that ends with a fault, or a scenario or model refused.
//! The record's choices are the first in the peer's hash order, which is not ours: where a verdict differs, other
//! choices are tried.

use groundstate::scenario::{Choices, Failure, FailureKind, FirstCandidate, Options};
use groundstate::{SeededChoices, Suite, Tested};
use machine::Limits;
use syntax::Severity;

use super::accept::refused;
use super::difference::short;
use super::job::Answer;
use super::loader::Checkout;
use super::reason;

/// LIMIT: how many seeds are tried for other choices.
const SEEDS: u64 = 40;

/// Runs a scenario and compares.
pub fn compare(checkout: &Checkout, path: &str, status: &str, message: &str, checks: u64) -> Answer {
    if checkout.source(path).is_err() {
        return Answer::Void { why: "the checkout does not have it".to_string() };
    }
    if status == "TIMEOUT" {
        return Answer::Void { why: "the peer came to no end".to_string() };
    }
    let ours = verdict(checkout, path, &mut FirstCandidate);
    // The peer fails at a pick that cannot be made, or refuses to translate it.
    if ours.0 == status || ours.0 == "PICK" && status != "PASS" {
        return Answer::same();
    }
    let detail = format!("{} here ({}), {status} there ({})", ours.0, ours.1, short(message));
    if ours.1.starts_with("`step until` reached") && status == "PASS" && checks == 0 {
        return Answer::different(Some(reason::NO_END), detail);
    }
    let other = (0..SEEDS).any(|seed| verdict(checkout, path, &mut SeededChoices::new(seed)).0 == status);
    if other {
        return Answer::different(Some(reason::CHOICE_ORDER), detail);
    }
    Answer::different(explained(status, message, &ours), detail)
}

fn explained(status: &str, message: &str, ours: &(&'static str, String)) -> Option<&'static str> {
    let here = ours.1.as_str();
    match (status, ours.0) {
        ("PASS", "ERROR") if here.contains("expected-") || here.contains("name-class") => {
            Some(reason::LENIENT_SCENARIO)
        }
        ("PASS", "ERROR") if here.contains("unknown-model") => Some(reason::MODEL_MISSING),
        (_, "ERROR") if here.contains("cannot be enumerated") => Some(reason::INFINITE_CHOICE),
        ("ERROR", "PASS" | "FAIL") if message.starts_with("ParseException") => Some(reason::GENERATED),
        ("ERROR", "PASS" | "FAIL") if message.contains("does not exist") => Some(reason::MODEL_PATH),
        ("ERROR", _) if message.contains("NullPointerException") => Some(reason::INTERNAL_FAILURE),
        _ => None,
    }
}

/// Our verdict in the peer's words, and why.
fn verdict(checkout: &Checkout, path: &str, choices: &mut dyn Choices) -> (&'static str, String) {
    let Ok(source) = checkout.source(path) else { return ("ERROR", String::new()) };
    let limits = Limits { iterations: 100_000, collection: 2_000_000, locations: 5_000_000, ..Limits::default() };
    let options = Options { limits, bound: 20_000, coverage: false };
    let tested: Tested = Suite::new().test(source, &mut checkout.clone(), options, choices);
    let Some(verdict) = &tested.verdict else {
        let fault = tested.diagnostics.iter().find(|diagnostic| diagnostic.severity == Severity::Error);
        return ("ERROR", fault.map(|fault| refused(&tested.sources, fault)).unwrap_or_default());
    };
    if verdict.passed() {
        return ("PASS", format!("{} checks", verdict.checks.0));
    }
    verdict.failures().first().map_or(("FAIL", String::new()), |first| failure(&tested, first))
}

/// The first failure in the peer's words, and why.
pub fn failure(tested: &Tested, failure: &Failure) -> (&'static str, String) {
    let place = tested.sources.position(failure.span);
    match &failure.kind {
        FailureKind::Fault { fault, .. } => {
            let text = tested.program.as_ref().map(|program| fault.show(program).to_string()).unwrap_or_default();
            ("ERROR", format!("{text} ({place})"))
        }
        FailureKind::Pick { message, .. } => ("PICK", format!("{message} ({place})")),
        FailureKind::Check { .. } => ("FAIL", format!("a check does not hold ({place})")),
        FailureKind::Invariant { name, .. } => ("FAIL", format!("invariant {name} is violated ({place})")),
        FailureKind::Bound { bound } => ("ERROR", format!("`step until` reached {bound} steps ({place})")),
        FailureKind::Expected { .. } => ("FAIL", place),
    }
}
