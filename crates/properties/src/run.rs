//! Properties of running: steps and scenarios, whatever the texts.

use std::sync::Arc;

use groundstate::scenario::{self, FirstCandidate};
use machine::Machine;
use simulate::{Bounds, Choices, Inputs, RandomSource, Run};
use syntax::{Severity, SourceFile};

use crate::seeds::DIVIDER;
use crate::world::{self, Models, Seeded};

/// A model that checks lowers to a program that the verifier accepts, and runs ten steps with random inputs and choices,
/// or stops for a reason.
pub(crate) fn step_never_panics(bytes: &[u8]) -> bool {
    let Ok(loaded) = groundstate::load(world::source(&world::text(bytes)), &mut Models::default()) else {
        return false;
    };
    assert_eq!(program::verify(&loaded.program), Ok(()));
    if loaded.program.main.is_none() {
        return false;
    }
    let seed = bytes.len() as u64;
    let inputs = Inputs::new().with(RandomSource::new(seed, Bounds::default())).choosing(Choices::random(seed));
    let options = simulate::Options { steps: Some(10), ..Default::default() };
    let mut run = Run::new(loaded.program, world::limits(), inputs, options);
    while run.advance().is_some() {}
    true
}

/// A step ends within its limits, and one that meets a fault leaves the state as it was.
pub(crate) fn a_failed_step_leaves_the_state(bytes: &[u8]) -> bool {
    let text = world::text(bytes);
    let checked = model::check(world::source(&text), &mut Models::default());
    if checked.diagnostics.iter().any(|fault| fault.severity == Severity::Error) {
        return false;
    }
    let Ok(program) = program::lower(&checked.model) else { return false };
    let mut environment = Seeded::new(text.len() as u64);
    let mut machine = Machine::new(Arc::new(program), world::limits());
    if machine.start(&mut environment).is_err() {
        return false;
    }
    for _ in 0..8 {
        machine.forget_inputs();
        let before = machine.locations();
        if machine.step(&mut environment).is_err() {
            machine.forget_inputs();
            assert_eq!(machine.locations(), before);
            return true;
        }
    }
    true
}

/// A scenario against a model ends in a verdict or in faults.
pub(crate) fn scenario_never_panics(bytes: &[u8]) -> bool {
    let text = world::text(bytes);
    let (model, scenario) = text.split_once(DIVIDER).unwrap_or(("", &text));
    let mut models = Models { root: model.to_string() };
    let options = scenario::Options { limits: world::limits(), bound: 20, coverage: true, story: true };
    let source = SourceFile::new("Scenario.avalla", scenario);
    let tested = groundstate::Suite::new().test(source, &mut models, options, &mut FirstCandidate);
    for fault in &tested.diagnostics {
        tested.sources.position(fault.primary.span);
    }
    tested.diagnostics.iter().all(|fault| fault.severity != Severity::Error)
}
