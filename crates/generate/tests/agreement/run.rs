//! A model, its generated code, and a run of the machine to compare it with.

use std::sync::Arc;

use generate::model::replay::{Answers, script, state};
use generate::model::{Generated, Options};
use machine::{Closed, EngineChoice, Limits, Machine, Value};
use model::Loader;
use program::Program;
use simulate::{Bounds, ChoiceMade, Choices, Inputs, RandomSource, Record, Run};
use syntax::{Severity, SourceFile, Sources, Span};
pub use testkit::Disk;

/// The files and texts to compare.
pub struct Prepared {
    pub generated: Generated,
    /// The input of the generated program.
    pub script: String,
    /// Its expected output, without the places of faults.
    pub expected: String,
}

/// A model that can be run.
pub struct Subject {
    pub program: Arc<Program>,
    sources: Sources,
}

/// Reads a model; `None` if it has no main rule. An error is its first fault.
pub fn read(file: SourceFile, disk: &mut dyn Loader) -> Result<Option<Subject>, String> {
    let checked = model::check(file, disk);
    if let Some(error) = checked.diagnostics.iter().find(|found| found.severity == Severity::Error) {
        return Err(error.message.clone());
    }
    let program = program::lower(&checked.model).map_err(|faults| faults[0].message.clone())?;
    Ok(program.main.is_some().then(|| Subject { program: Arc::new(program), sources: checked.sources }))
}

impl Subject {
    /// Its code, or what cannot be generated.
    pub fn generate(&self) -> Result<Generated, String> {
        let mut started = Machine::new(Arc::clone(&self.program), Limits::default());
        // What initial values ask of the environment is asked again at run time.
        let _ = started.start(&mut Closed);
        generate::model::generate(&self.program, &self.sources, &mut started, &Options::default())
            .map_err(|refused| refused[0].message.clone())
    }
}

/// A run with random inputs and choices: the script of its answers, and its states.
pub fn record(program: &Arc<Program>, steps: u64, seed: u64) -> (String, String) {
    let limits = Limits { iterations: 1_000_000, call_depth: 200, collection: 100_000, ..Limits::default() };
    let inputs = Inputs::new().with(RandomSource::new(seed, Bounds::default())).choosing(Choices::random(seed));
    let options = simulate::Options {
        steps: Some(steps),
        engine: EngineChoice::Interpreted,
        invariants: simulate::Invariants::Ignore,
        ..Default::default()
    };
    let mut run = Run::new(Arc::clone(program), limits, inputs, options);
    let (mut text, mut expected, mut attempted) = (String::new(), String::new(), false);
    while let Some(record) = run.advance() {
        match record {
            Record::Initial { inputs, choices, times, .. } => {
                text.push_str(&script(program, &Answers { inputs, times, choices: taken(choices) }));
                expected.push_str(&state(program, &run.machine().locations()));
            }
            Record::Step(step) => {
                text.push_str(&script(program, &answers(step)));
                expected.push_str(&state(program, &run.machine().locations()));
            }
            Record::Attempt(step) => {
                text.push_str(&script(program, &answers(step)));
                attempted = true;
            }
            Record::End(simulate::End::Fault(fault)) => {
                // A step that read nothing from the environment leaves no attempt on record.
                if !attempted {
                    text.push_str("step\n");
                }
                expected.push_str(&format!("fault {}\n", fault.kind.id()));
            }
            _ => {}
        }
    }
    (text, expected)
}

fn answers(step: simulate::StepRecord) -> Answers {
    Answers { inputs: step.inputs, choices: taken(step.choices), times: step.times }
}

fn taken(choices: Vec<ChoiceMade>) -> Vec<(Span, usize, Vec<Value>)> {
    choices.into_iter().map(|choice| (choice.span, choice.index, choice.values)).collect()
}
