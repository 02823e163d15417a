//! The verdict of `conform` as JSON, and what it tells while it follows a program.
//!
//! In: a [`Verdict`], and the texts that its claims point into. Out: [`Conformance`]; [`FollowedTold`].

use ::conform::{Event, Parted, Verdict};
use groundstate::job::{Agreed, LastPhase};
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
    /// The verdict as it is said to people.
    words: String,
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

/// How far program and model agree while the program runs.
#[derive(Debug, Serialize)]
#[serde(tag = "type", rename_all = "lowercase")]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub enum FollowedTold {
    /// Told several times a second by `conform --follow`. It is no verdict.
    Followed {
        /// How far, as it is said to people.
        words: String,
        /// How many events agree so far.
        events: usize,
        /// The instant of the newest event that was read; it may not have been compared yet.
        time_ns: i64,
        /// Of each task the phase that it is in, or that it began last since the object before; null if there is none.
        phases: Vec<(String, Option<String>)>,
    },
}

impl FollowedTold {
    /// How far the two agree; the object before was of this instant.
    pub fn new(Agreed { words, events, time_ns, tasks }: Agreed, before_ns: i64) -> FollowedTold {
        let present = |last: &LastPhase| !last.is_over || last.began_ns > before_ns;
        let of = |last: LastPhase| (last.task.clone(), Some(last).filter(present).and_then(|last| last.phase));
        FollowedTold::Followed { words, events, time_ns, phases: tasks.into_iter().map(of).collect() }
    }
}

impl Conformance {
    /// The verdict of a run that was compared in this way.
    pub fn new(sources: &Sources, verdict: &Verdict, way: &str, words: String) -> Conformance {
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
            words,
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
