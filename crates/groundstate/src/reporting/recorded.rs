//! Names and verdicts of a program's runs, as its report shows them.

use conform::{Parted, Recording, Verdict};
use report::{Held, ProgramRun};

use crate::job::Conformed;
use crate::tell::{beside, but};

/// A name that distinguishes a run from the others.
pub fn run_name(recording: &Recording, others: &[ProgramRun]) -> String {
    let name = if recording.pace == "real" { "real time" } else { "virtual time" };
    match others.iter().filter(|run| run.name.starts_with(name)).count() {
        0 => name.to_string(),
        n => format!("{name} {}", n + 1),
    }
}

/// A verdict, in the words of the page.
pub fn held_in_words(conformed: &Conformed) -> Held {
    let Conformed { verdict, way, recording, accesses, .. } = conformed;
    let (way, made, many) = (way.words(), way.steps(), |n: usize| report::count(n as u64));
    match verdict {
        Verdict::Conforms { events, steps, after } => {
            let after = match after {
                0 => String::new(),
                more => format!("; {} after the tasks were asked to stop are not compared", many(*more)),
            };
            let steps = report::count(*steps);
            let (but, events) = (but(accesses), many(*events));
            let words = format!("conforms to the model {way}{but}: {events} events, {steps} {made}{after}");
            Held { conforms: Some(true), words, beside: beside(conformed) }
        }
        Verdict::Unknown { events, reason } => Held {
            conforms: None,
            words: format!(
                "not known whether it conforms to the model: {reason}; {} events agree before",
                many(*events)
            ),
            beside: Vec::new(),
        },
        Verdict::Parts(parted) if parted.decides => {
            let at = (parted.tick * recording.tick_ns) as f64 / 1e6;
            let reason = parted.reason.as_deref().unwrap_or_default();
            let words = format!(
                "parts from the model {way}, at {at:.4} ms, after {} decisions: {} {reason}",
                many(parted.agreed),
                parted.task
            );
            Held { conforms: Some(false), words, beside: Vec::new() }
        }
        Verdict::Parts(parted) => {
            let Parted { event, tick, task, claims, agreed, .. } = parted.as_ref();
            let at_ns = event.as_ref().map_or(tick * recording.tick_ns, |event| event.time_ns);
            let did = event.as_ref().map_or("nothing more".to_string(), |event| event.words());
            let claims: Vec<String> = claims.iter().map(|claim| claim.event.words()).collect();
            let model = if claims.is_empty() { "nothing".to_string() } else { claims.join("; ") };
            let at = at_ns as f64 / 1e6;
            let words = format!(
                "parts from the model {way}, at {at:.4} ms, after {} events: {task} did: {did}; the model: {model}",
                many(*agreed)
            );
            Held { conforms: Some(false), words, beside: Vec::new() }
        }
    }
}
