//! What becomes of a model or scenario, whether there is a recorded result for it or not.
//!
//! In: a path. Out: an [`Answer::Explored`] with how far it came, or the trouble that there must never be: a panic or an
//! endless run (the pool sees to these), an internal error, or two engines that part. A model is run twice in each
//! engine, with random inputs: with the first candidates and with random choices.

use std::sync::Arc;

use groundstate::scenario::{FirstCandidate, Options as TestOptions};
use groundstate::{Faulty, Loaded, Suite};
use machine::{EngineChoice, Limits};
use program::Program;
use simulate::{Bounds, Choices, End, Inputs, Options, RandomSource, Record, Run};
use syntax::{Severity, Sources};

use super::accept::refused;
use super::job::Answer;
use super::loader::Checkout;

/// How many steps a run makes.
const STEPS: u64 = 25;
/// The seed of inputs and choices.
const SEED: u64 = 7;

/// Runs a model or a scenario.
pub fn explore(checkout: &Checkout, path: &str) -> Answer {
    if path.ends_with(".avalla") { scenario(checkout, path) } else { model(checkout, path) }
}

fn explored(outcome: &str, detail: String) -> Answer {
    Answer::Explored { outcome: outcome.to_string(), detail }
}

fn limits() -> Limits {
    Limits { iterations: 20_000, collection: 200_000, locations: 1_000_000, updates: 1_000_000, ..Limits::default() }
}

fn model(checkout: &Checkout, path: &str) -> Answer {
    let source = match checkout.source(path) {
        Ok(source) => source,
        Err(why) => return Answer::Void { why },
    };
    let Loaded { sources, program, .. } = match groundstate::load(source, &mut checkout.clone()) {
        Ok(loaded) => loaded,
        Err(faulty) => {
            let Faulty { sources, diagnostics } = *faulty;
            let fault = diagnostics.iter().find(|diagnostic| diagnostic.severity == Severity::Error);
            let detail = fault.map(|fault| refused(&sources, fault)).unwrap_or_default();
            return explored("refused", detail);
        }
    };
    if program.main.is_none() {
        return explored("accepted, without a main rule", String::new());
    }
    let mut outcome = None;
    for choices in [Choices::First, Choices::random(SEED)] {
        let interpreted = run(&program, choices.clone(), EngineChoice::Interpreted);
        let compiled = run(&program, choices, EngineChoice::Compiled);
        if let Some(at) =
            (0..interpreted.len().max(compiled.len())).find(|at| interpreted.get(*at) != compiled.get(*at))
        {
            let detail = format!("the engines part: {:?} and {:?}", interpreted.get(at), compiled.get(at));
            return Answer::different(None, detail);
        }
        let came = interpreted.last().map(|end| told(&program, &sources, end, interpreted.len()));
        // A run that comes to trouble tells more than one that does not.
        let smooth = |(outcome, _): &(&str, String)| *outcome == SMOOTH;
        outcome = match (outcome, came) {
            (Some(before), came) if !smooth(&before) || came.as_ref().is_none_or(smooth) => Some(before),
            (_, came) => came,
        };
    }
    let (outcome, detail) = outcome.unwrap_or_default();
    explored(outcome, detail)
}

const SMOOTH: &str = "run to the last step";

fn run(program: &Arc<Program>, choices: Choices, engine: EngineChoice) -> Vec<Record> {
    let inputs = Inputs::new().choosing(choices).with(RandomSource::new(SEED, Bounds::default()));
    let options = Options { steps: Some(STEPS), engine, ..Options::default() };
    let mut run = Run::new(Arc::clone(program), limits(), inputs, options);
    std::iter::from_fn(|| run.advance()).collect()
}

fn told(program: &Program, sources: &Sources, end: &Record, records: usize) -> (&'static str, String) {
    match end {
        Record::End(End::Fault(fault)) => {
            let text = format!("{} ({})", fault.show(program), sources.position(fault.span));
            // The initial state and the attempt stand before the end.
            ("run to a fault", format!("step {}: {text} [{}]", records.saturating_sub(2), fault.kind.id()))
        }
        Record::End(End::Violation) => ("run to an invariant that does not hold", String::new()),
        _ => (SMOOTH, String::new()),
    }
}

fn scenario(checkout: &Checkout, path: &str) -> Answer {
    let source = match checkout.source(path) {
        Ok(source) => source,
        Err(why) => return Answer::Void { why },
    };
    let options = TestOptions { limits: limits(), bound: 20_000, coverage: false, story: false };
    let tested = Suite::new().test(source, &mut checkout.clone(), options, &mut FirstCandidate);
    let Some(verdict) = &tested.verdict else {
        let fault = tested.diagnostics.iter().find(|diagnostic| diagnostic.severity == Severity::Error);
        return explored("refused", fault.map(|fault| refused(&tested.sources, fault)).unwrap_or_default());
    };
    match verdict.failures().first() {
        None => explored("passed", String::new()),
        Some(failure) => {
            let detail = super::scenario::failure(&tested, failure);
            explored("failed", format!("{}: {}", detail.0, detail.1))
        }
    }
}
