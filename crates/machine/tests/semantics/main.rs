//! What steps do, construct by construct: small models in, the changes of each step out.

mod collections;
mod faults;
mod limits;
mod pages;
mod rules;
mod states;

use std::fmt::Write;
use std::sync::Arc;

use machine::{Choice, Environment, Limits, LocationRef, Machine, Show, TimeUnit, Value};
use program::{DomainId, Program};
use syntax::SourceFile;
use testkit::NoFiles;

/// Gives integers 1, 2, 3 … or `true` for every input, and takes the last candidate of every choice.
#[derive(Default)]
struct Counting {
    asked: i64,
    chosen: u64,
}

impl Environment for Counting {
    fn monitored(&mut self, program: &Program, _: LocationRef<'_>, codomain: DomainId) -> Result<Value, String> {
        self.asked += 1;
        Ok(match program.domain(codomain).name.as_str() {
            "Boolean" => Value::Boolean(true),
            _ => Value::Integer(self.asked),
        })
    }

    fn choose(&mut self, _: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        self.chosen += 1;
        Ok(choice.candidates() - 1)
    }

    fn time(&mut self, _: TimeUnit) -> Result<i64, String> {
        Ok(42)
    }
}

/// A machine of `signature`, `definitions` (the main rule last) and `init`, without its header.
fn machine_of(text: &str) -> Machine {
    let text = format!("asm test\nimport StandardLibrary\n{text}\n");
    let checked = model::check(SourceFile::new("test.asm", text), &mut NoFiles);
    let errors: Vec<String> = checked
        .diagnostics
        .iter()
        .filter(|d| d.severity == syntax::Severity::Error)
        .map(|d| format!("{} {}", checked.sources.position(d.primary.span), d.message))
        .collect();
    assert!(errors.is_empty(), "{errors:#?}");
    let program = program::lower(&checked.model).expect("small enough");
    let limits = Limits { iterations: 1000, call_depth: 200, collection: 10_000, work: 300_000, ..Limits::default() };
    Machine::new(Arc::new(program), limits)
}

/// The run of a model: what each of `steps` steps changed, or the fault that ended it.
fn run(text: &str, steps: usize) -> String {
    let mut machine = machine_of(text);
    let mut environment = Counting::default();
    let program = Arc::clone(machine.program());
    let mut out = String::new();
    if let Err(fault) = machine.start(&mut environment) {
        return format!("start: {}\n", fault.show(&program));
    }
    for step in 1..=steps {
        match machine.step(&mut environment) {
            Ok(_) => {
                let changes = machine.changes();
                let shown: Vec<String> = changes
                    .iter()
                    .map(|c| format!("{}={}", c.location.show(&program), c.after.show(&program)))
                    .collect();
                let _ = writeln!(out, "{step}: {}", shown.join(" "));
            }
            Err(fault) => {
                let _ = writeln!(out, "{step}: {}", fault.show(&program));
                break;
            }
        }
    }
    out
}

/// Pins the run of a model.
#[track_caller]
fn check(text: &str, steps: usize, expect: expect_test::Expect) {
    expect.assert_eq(&run(text, steps));
}
