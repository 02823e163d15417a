//! The verdict of `conform` as JSON.
//!
//! In: a [`Verdict`], and the texts that its claims point into. Out: [`Conformance`].

use ::conform::{Event, Parted, Verdict};
use serde::Serialize;
use syntax::Sources;

/// The verdict.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Conformance {
    #[cfg_attr(test, schemars(extend("const" = "conformance")))]
    r#type: &'static str,
    /// The same as `type`, for readers of the former key.
    #[cfg_attr(test, schemars(extend("const" = "conformance")))]
    kind: &'static str,
    verdict: &'static str,
    way: String,
    events: usize,
    /// If the run conforms: how many events came after its tasks were asked to stop; these are not compared.
    #[serde(skip_serializing_if = "Option::is_none")]
    after: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    parts: Option<Parts>,
}

/// Where program and model differ.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Parts {
    tick: i64,
    task: String,
    event: Option<Told>,
    model: Vec<Told>,
    before: Vec<Told>,
    state: Vec<(String, String)>,
}

/// An event.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Told {
    task: String,
    time_ns: i64,
    event: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    rule: Option<String>,
}

impl Conformance {
    /// The verdict of a run that was compared in this way.
    pub fn new(sources: &Sources, verdict: &Verdict, way: &str) -> Conformance {
        let (word, events, reason, parts) = match verdict {
            Verdict::Conforms { events, .. } => ("conforms", *events, None, None),
            Verdict::Unknown { events, reason } => ("unknown", *events, Some(reason.clone()), None),
            Verdict::Parts(parted) => {
                ("parts", parted.agreed, parted.reason.clone(), Some(Parts::new(sources, parted)))
            }
        };
        let after = match verdict {
            Verdict::Conforms { after, .. } => Some(*after),
            Verdict::Unknown { .. } | Verdict::Parts(_) => None,
        };
        Conformance {
            r#type: "conformance",
            kind: "conformance",
            verdict: word,
            way: way.to_string(),
            events,
            after,
            reason,
            parts,
        }
    }
}

impl Parts {
    fn new(sources: &Sources, parted: &Parted) -> Parts {
        let told = |task: &String, event: &Event, rule: Option<String>| Told {
            task: task.clone(),
            time_ns: event.time_ns,
            event: event.words(),
            rule,
        };
        Parts {
            tick: parted.tick,
            task: parted.task.clone(),
            event: parted.event.as_ref().map(|event| told(&parted.task, event, None)),
            model: parted
                .claims
                .iter()
                .map(|claim| told(&parted.task, &claim.event, Some(sources.position(claim.span))))
                .collect(),
            before: parted.before.iter().map(|recorded| told(&recorded.task, &recorded.event, None)).collect(),
            state: parted.state.clone(),
        }
    }
}
