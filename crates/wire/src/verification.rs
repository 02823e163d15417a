//! The results of a verification, as JSON objects: verdicts with their runs, the extent of the search, assumptions.

use groundstate::tell::{FoundChange, FoundStep, Verdicts, id, place_of, why_unreduced};
use groundstate::verify::{self, EngineKind, Outcome, Report, Subject, Symmetry, Trace};
use serde::Serialize;

use crate::Place;

/// `{"type":"verdict",…}`
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Verdict {
    #[cfg_attr(test, schemars(extend("const" = "verdict")))]
    r#type: &'static str,
    check: String,
    kind: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    at: Option<Place>,
    /// `holds`, `violated` or `unknown`.
    pub verdict: &'static str,
    /// How many states were explored, if the check holds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub states: Option<u64>,
    /// How it was proved, if not by exploring all states.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub by: Option<String>,
    /// Why the verdict is unknown.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub reasons: Vec<String>,
    /// The run that violates it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub trace: Option<Vec<RunStep>>,
    /// The step from which the trace repeats forever.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub again_from: Option<usize>,
    /// Whether the trace ends because no step satisfies the assumptions.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub ends: bool,
    /// That run as a scenario, to be written beside the model; none where no scenario makes it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scenario: Option<String>,
}

impl Verdict {
    /// A verdict of a search.
    pub fn new(words: &Verdicts<'_>, verdict: &verify::Verdict, report: &Report) -> Verdict {
        let mut line = Verdict::holds(words, verdict.subject);
        match &verdict.outcome {
            Outcome::Holds => match words.proof(verdict.subject, report) {
                None => line.states = Some(report.progress.states),
                proof => line.by = proof,
            },
            Outcome::Unknown(reasons) => {
                line.verdict = "unknown";
                line.reasons = words.reasons(verdict.subject, reasons, report);
            }
            Outcome::Violated(trace) => line = Verdict::violated(words, verdict.subject, trace),
        }
        line
    }

    /// A violation.
    pub fn violated(words: &Verdicts<'_>, subject: Subject, trace: &Trace) -> Verdict {
        Verdict {
            verdict: "violated",
            trace: Some(RunStep::all(words, trace)),
            again_from: trace.turn.map(|turn| turn + 1),
            ends: trace.ends,
            ..Verdict::holds(words, subject)
        }
    }

    /// That a check holds.
    pub fn holds(words: &Verdicts<'_>, subject: Subject) -> Verdict {
        let (kind, span) = match subject {
            Subject::Property(index) => ("property", Some(words.program.properties[index].span)),
            _ => ("builtin", None),
        };
        Verdict {
            r#type: "verdict",
            check: id(subject).map_or_else(|| words.name(subject), str::to_string),
            kind,
            at: span.map(|span| Place::new(words.sources, span)),
            verdict: "holds",
            states: None,
            by: None,
            reasons: Vec::new(),
            trace: None,
            again_from: None,
            ends: false,
            scenario: None,
        }
    }
}

/// A step of a run that was found; step 0 is the initial state.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct RunStep {
    /// Its number.
    pub step: usize,
    /// The initial state.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub values: Vec<(String, String)>,
    /// What it read.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub inputs: Vec<(String, String)>,
    /// What it chose, in words.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub choices: Vec<String>,
    /// What it changed.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub changes: Vec<RunChange>,
    /// Why the step could not be made.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fault: Option<String>,
}

impl RunStep {
    /// The initial state and the steps of a run.
    pub fn all(words: &Verdicts<'_>, trace: &Trace) -> Vec<RunStep> {
        RunStep::of(words.steps(trace))
    }

    /// Steps in words, numbered from 0.
    pub fn of(steps: Vec<FoundStep>) -> Vec<RunStep> {
        let steps = steps.into_iter().enumerate();
        let line = |(step, FoundStep { values, inputs, choices, changes, fault })| {
            let change = |FoundChange { location, from, to, by }| RunChange { location, from, to, by };
            let changes = changes.into_iter().map(change).collect();
            RunStep { step, values, inputs, choices, changes, fault }
        };
        steps.map(line).collect()
    }
}

/// A location whose value changed.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct RunChange {
    /// The location.
    pub location: String,
    /// Its value before.
    pub from: String,
    /// Its value after.
    pub to: String,
    /// The place of the update.
    pub by: String,
}

/// `{"type":"explored",…}`
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct ExploredLine<'a> {
    #[cfg_attr(test, schemars(extend("const" = "explored")))]
    r#type: &'static str,
    complete: bool,
    states: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    transitions: Option<u64>,
    depth: u64,
    bytes: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    disk: Option<u64>,
    /// How many states' steps were made by machine code, where any were.
    #[serde(skip_serializing_if = "Option::is_none")]
    compiled: Option<u64>,
    /// Of how many states the assumptions leave no step, where there are any.
    #[serde(skip_serializing_if = "Option::is_none")]
    blocked: Option<u64>,
    #[serde(flatten)]
    more: &'a Explored,
}

impl<'a> ExploredLine<'a> {
    /// How far a search came, with further facts.
    pub fn new(progress: &groundstate::verify::Progress, complete: bool, more: &'a Explored) -> ExploredLine<'a> {
        ExploredLine {
            r#type: "explored",
            complete,
            states: progress.states,
            transitions: (!more.sets).then_some(progress.transitions),
            depth: progress.depth,
            bytes: progress.bytes,
            disk: (progress.spilled > 0).then_some(progress.spilled),
            compiled: (progress.compiled > 0).then_some(progress.compiled),
            blocked: (progress.blocked > 0).then_some(progress.blocked),
            more,
        }
    }
}

/// Facts about a search besides its numbers.
#[derive(Debug, Default, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Explored {
    /// How many bits a state has.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bits: Option<usize>,
    /// The expected number of omitted states, if the search kept hashes or bits instead of states.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub omission: Option<f64>,
    /// With partial-order reduction: whether it was exact.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub partial_order: Option<&'static str>,
    /// With symmetry reduction: the domains it looked at.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub symmetry: Option<Vec<DomainLine>>,
    /// The search used sets of states, so transitions are not counted.
    #[serde(skip)]
    pub sets: bool,
}

impl Explored {
    /// The facts of a verification.
    pub fn new(words: &Verdicts<'_>, report: &Report) -> Explored {
        Explored {
            bits: Some(report.width.1),
            omission: report.omission.map(|expected| expected.0),
            partial_order: report.reduced.map(|reduced| reduced.map_or_else(why_unreduced, |()| "reduced")),
            symmetry: report.symmetry.as_ref().map(|symmetry| DomainLine::all(words, symmetry)),
            sets: report.engine == EngineKind::Symbolic,
        }
    }
}

/// A domain with its interchangeable elements, or why none are interchangeable.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct DomainLine {
    /// Its name.
    pub domain: String,
    /// The elements.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub interchangeable: Vec<String>,
    /// Why no elements are interchangeable.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub distinct: Option<String>,
    /// The place that shows why.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<Place>,
}

impl DomainLine {
    /// The domains that symmetry reduction looked at.
    pub fn all(words: &Verdicts<'_>, symmetry: &Symmetry) -> Vec<DomainLine> {
        let name = |domain: &program::DomainId| words.program.domain(*domain).name.clone();
        let classes = symmetry.classes.iter().map(|(domain, class)| DomainLine {
            domain: name(domain),
            interchangeable: words.elements(class),
            distinct: None,
            at: None,
        });
        let distinct = symmetry.distinct.iter().map(|(domain, why)| DomainLine {
            domain: name(domain),
            interchangeable: Vec::new(),
            distinct: Some(words.why_distinct(*why)),
            at: place_of(*why).map(|span| Place::new(words.sources, span)),
        });
        classes.chain(distinct).collect()
    }
}

/// `{"type":"vacuity",…}`
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Vacuity {
    #[cfg_attr(test, schemars(extend("const" = "vacuity")))]
    r#type: &'static str,
    /// How many properties that hold have parts that were replaced.
    properties: usize,
    /// How many parts were.
    parts: usize,
    /// How many of them are idle: a fault `idle-part` tells of each.
    idle: usize,
    /// Of how many it is not known.
    open: usize,
}

impl Vacuity {
    /// What a search for idle parts has found.
    pub fn new(properties: usize, parts: usize, idle: usize, open: usize) -> Vacuity {
        Vacuity { r#type: "vacuity", properties, parts, idle, open }
    }
}

/// `{"type":"assumed",…}`
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Assumed<'a> {
    #[cfg_attr(test, schemars(extend("const" = "assumed")))]
    r#type: &'static str,
    term: &'a str,
}

impl<'a> Assumed<'a> {
    /// An assumption of the verdicts that is not part of the model.
    pub fn new(term: &'a str) -> Assumed<'a> {
        Assumed { r#type: "assumed", term }
    }
}
