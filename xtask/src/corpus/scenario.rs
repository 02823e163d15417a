//! Does a scenario come to the same verdict?
//!
//! In: a scenario and the peer's verdict. Out: an [`Answer`]. The peer's `PASS` is our passed; its `FAIL` (a check, an
//! invariant) our failed; its `ERROR` either a failed one that ends with a fault, or a scenario or model refused.
//! The record's choices are the first in the peer's hash order, which is not ours: where a verdict differs, other
//! choices are tried.

use std::sync::Arc;

use groundstate::scenario::{self, Blocks, Choices, Failure, FailureKind, FirstCandidate, Options};
use groundstate::{Loaded, SeededChoices, Suite, Tested};
use machine::Limits;
use model::Loader;
use syntax::{Severity, SourceFile, Sources};

use super::accept::refused;
use super::difference::short;
use super::job::Answer;
use super::loader::Checkout;
use super::reason;

/// LIMIT: how many seeds are tried for other choices.
const SEEDS: u64 = 40;

/// What a scenario came to here.
struct Ours {
    /// In the peer's words.
    status: &'static str,
    /// Why.
    why: String,
    /// How many checks held.
    checks: u64,
}

impl Ours {
    fn refused(why: String) -> Ours {
        Ours { status: "ERROR", why, checks: 0 }
    }
}

/// Runs a scenario and compares.
pub fn compare(checkout: &Checkout, path: &str, status: &str, message: &str, checks: u64) -> Answer {
    let Ok(source) = checkout.source(path) else {
        return Answer::Void { why: "the checkout does not have it".to_string() };
    };
    if status == "TIMEOUT" {
        return Answer::Void { why: "the peer did not finish".to_string() };
    }
    let ours = verdict(checkout, &source, &mut FirstCandidate);
    // The peer fails at a pick that cannot be made, or refuses to translate it.
    if ours.status == status || ours.status == "PICK" && status != "PASS" {
        return Answer::same();
    }
    let detail = format!("{} here ({}), {status} there ({})", ours.status, ours.why, short(message));
    if ours.why.starts_with("`step until` reached") && status == "PASS" && checks == ours.checks {
        return Answer::different(Some(reason::NO_END), detail);
    }
    let seeds = || (0..SEEDS).map(SeededChoices::new);
    if seeds().any(|mut choices| verdict(checkout, &source, &mut choices).status == status) {
        return Answer::different(Some(reason::CHOICE_ORDER), detail);
    }
    let lenient = |mut choices: SeededChoices| leniently(checkout, &source, &mut choices);
    if status == "PASS" && ours.status == "ERROR" {
        let same = |ours: Ours| ours.status == status && ours.checks == checks;
        if seeds().filter_map(lenient).any(same) {
            return Answer::different(Some(reason::LENIENT_SCENARIO), detail);
        }
    }
    Answer::different(explained(status, message, &source, &ours), detail)
}

fn explained(status: &str, message: &str, source: &SourceFile, ours: &Ours) -> Option<&'static str> {
    let here = ours.why.as_str();
    match (status, ours.status) {
        ("PASS", "ERROR") if here.contains("unknown-model") => Some(reason::MODEL_MISSING),
        (_, "ERROR") if here.contains("cannot be enumerated") => Some(reason::INFINITE_CHOICE),
        ("ERROR", "PASS" | "FAIL") if message.starts_with("ParseException") => {
            let wider = message.contains("Encountered") && has_literal_operand(source);
            Some(if wider { reason::LITERAL_OPERAND } else { reason::GENERATED })
        }
        ("ERROR", "PASS" | "FAIL") if message.contains("does not exist") => Some(reason::MODEL_PATH),
        ("ERROR", _) if message.contains("NullPointerException") => Some(reason::INTERNAL_FAILURE),
        _ => None,
    }
}

/// A term of the scenario has a collection in brackets behind a relation.
fn has_literal_operand(source: &SourceFile) -> bool {
    let text: String = source.text.chars().filter(|c| !c.is_whitespace()).collect();
    ["=[", "={", "=<", "]=", "}="].iter().any(|operand| text.contains(operand))
}

/// Our verdict in the peer's words, and why.
fn verdict(checkout: &Checkout, source: &SourceFile, choices: &mut dyn Choices) -> Ours {
    let tested: Tested = Suite::new().test(source.clone(), &mut checkout.clone(), options(), choices);
    let Some(verdict) = &tested.verdict else {
        let fault = tested.diagnostics.iter().find(|diagnostic| diagnostic.severity == Severity::Error);
        return Ours::refused(fault.map(|fault| refused(&tested.sources, fault)).unwrap_or_default());
    };
    let (status, why) = match verdict.failures().first() {
        _ if verdict.passed() => ("PASS", format!("{} checks", verdict.checks.0)),
        Some(first) => failure(&tested, first),
        None => ("FAIL", String::new()),
    };
    Ours { status, why, checks: verdict.checks.0 }
}

fn options() -> Options {
    let limits = Limits { iterations: 100_000, collection: 2_000_000, locations: 5_000_000, ..Limits::default() };
    Options { limits, bound: 20_000, coverage: false, story: false }
}

/// The verdict with the peer's defect put in: errors of the scenario's syntax are passed over, commands with them and
/// what stands before `scenario` are left out.
fn leniently(checkout: &Checkout, source: &SourceFile, choices: &mut dyn Choices) -> Option<Ours> {
    let mut text = source.text.to_string();
    loop {
        let source = SourceFile::new(source.name.clone(), text.clone());
        let mut sources = Sources::default();
        let file = sources.add(source.clone());
        let Some((path, _)) = scenario::parse(&sources, file).model else {
            let head = text.find("scenario").filter(|head| *head > 0)?;
            text.drain(..head);
            continue;
        };
        let root = checkout.clone().load(&source, &path).ok()?;
        let Loaded { mut sources, mut model, mut program, .. } = groundstate::load(root, &mut checkout.clone()).ok()?;
        let file = sources.add(source);
        let mut parsed = scenario::parse(&sources, file);
        parsed.diagnostics.clear();
        let (asked, extended) = (Arc::make_mut(&mut model), Arc::make_mut(&mut program));
        match scenario::resolve(&parsed, asked, extended, &mut sources, &mut NoBlocks) {
            Ok((script, _)) => {
                let (verdict, _) = scenario::run(&script, program, options(), choices);
                let status = if verdict.passed() { "PASS" } else { "FAIL" };
                return Some(Ours { status, why: String::new(), checks: verdict.checks.0 });
            }
            Err(faults) => {
                let fault = faults.iter().find(|fault| fault.severity == Severity::Error)?;
                let at = (fault.primary.span.start as usize).min(text.len());
                let start = text[..at].rfind([';', '\n']).map_or(0, |before| before + 1);
                let end = text[at..].find(';').map_or(text.len(), |length| at + length + 1);
                text.replace_range(start..end, "");
            }
        }
    }
}

/// No scenario calls blocks of another.
struct NoBlocks;

impl Blocks for NoBlocks {
    fn load(&mut self, _: &SourceFile, name: &str) -> Result<SourceFile, String> {
        Err(format!("there is no {name}"))
    }
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
