//! Groundstate in a program of your own: opens a model, edits it, steps it, verifies it, cancels a search.
//!
//! `cargo run --package embed -- examples/coffee_machine/CoffeeMachine.asm`. All of it is the facade, `groundstate`; a shell
//! brings files, a clock and a screen.
#![allow(clippy::disallowed_methods, clippy::disallowed_macros, reason = "a shell reads files and prints")]

use std::error::Error;
use std::sync::Arc;

use groundstate::job::{self, Cancel, Command, RunEvent, RunRequest, VerifyEvent};
use groundstate::machine::{Limits, Show};
use groundstate::simulate::{self, Record, read_value};
use groundstate::syntax::SourceFile;
use groundstate::verify::{NoSolvers, Options, Outcome, Request, Subject};
use groundstate::workspace::{Absent, Files, Findings, NotLoaded};
use groundstate::{Loaded, Workspace};

/// Files as the disk has them.
struct Disk;

impl Files for Disk {
    fn read(&mut self, path: &str) -> Result<SourceFile, Absent> {
        match std::fs::read_to_string(path) {
            Ok(text) => Ok(SourceFile::new(path, text)),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Err(Absent::Missing),
            Err(error) => Err(Absent::Unreadable(error.to_string())),
        }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args().nth(1).ok_or("usage: embed MODEL.asm")?;
    let mut workspace = Workspace::new(Disk);
    tell("as it is", &workspace.check(&path).map_err(absent)?);

    // An edit is seen at once, before anything is saved.
    let text = workspace.text(&path).map_err(absent)?.text;
    let edited = text.replacen("main rule", "main rulo", 1);
    workspace.set_text(&path, 1, edited).map_err(|newer| format!("version {} is there", newer.present))?;
    tell("with a slip", &workspace.check(&path).map_err(absent)?);
    workspace.close(&path);

    let loaded = workspace.load(&path).map_err(|trouble| match trouble {
        NotLoaded::Absent(reason) => absent(reason),
        NotLoaded::Faulty(_) => "it has errors".to_string(),
    })?;
    step(&loaded, 3)?;
    verify(&loaded, false)?;
    verify(&loaded, true)
}

fn absent(reason: Absent) -> String {
    format!("the model cannot be opened: {reason:?}")
}

fn tell(when: &str, findings: &Findings) {
    println!("{when}: {} faults", findings.diagnostics().count());
    for (sources, faults) in &findings.faults {
        for fault in faults {
            println!("  {}: {}", sources.position(fault.primary.span), fault.message);
        }
    }
}

/// Makes some steps by hand, with some value for each input, and takes the last one back.
fn step(loaded: &Loaded, steps: u64) -> Result<(), Box<dyn Error>> {
    let program = &loaded.program;
    let request = RunRequest {
        program: Arc::clone(program),
        limits: Limits::default(),
        options: simulate::Options { history: 100, ..simulate::Options::default() },
        inputs: Box::new(|inputs| inputs),
        asks_inputs: Some(simulate::RandomSource::new(0, simulate::Bounds::default())),
        asks_choices: false,
        paused: true,
        states: false,
        frozen: false,
        due: job::at_once(),
    };
    let (job, remote) = job::run(request, Cancel::new())?;
    let mut commands = [Command::Step(steps), Command::Back, Command::Stop].into_iter();
    while let Some(event) = job.next_event() {
        match event {
            RunEvent::AsksInput { location, domain, values, .. } => {
                let value = values.into_iter().next().map_or_else(|| read_value(program, domain, "1"), Ok)?;
                println!("  in {} = {}", location.show(program), value.show(program));
                remote.send(Command::Set(location, value));
            }
            RunEvent::Paused => _ = commands.next().is_some_and(|command| remote.send(command)),
            RunEvent::Record { record, faults, .. } => {
                match *record {
                    Record::Step(step) => println!("step {}: {} changes", step.step, step.changes.len()),
                    Record::Back { step } => println!("back to before step {step}"),
                    Record::End(end) => println!("end: {end:?}"),
                    Record::Initial { values, .. } => println!("initial state: {} locations", values.len()),
                    Record::Attempt(_) => {}
                }
                faults.iter().for_each(|fault| println!("  {}", fault.message));
            }
            RunEvent::AsksChoice { .. } | RunEvent::Refused(_) | RunEvent::Progress(_) | RunEvent::Said { .. } => {}
        }
    }
    println!("{} steps made", job.finish().map_err(|crashed| crashed.0)?);
    Ok(())
}

/// Verifies the model, as far as its first states; or has had enough as soon as the search tells of itself.
fn verify(loaded: &Loaded, cancels: bool) -> Result<(), Box<dyn Error>> {
    let options = Options { max_states: 10_000, ..Options::default() };
    let request = Request::of(&loaded.program, options).build()?;
    let job = job::verify(request, Cancel::new(), NoSolvers, job::NO_KEEPER, || true)?;
    if cancels {
        job.cancel().cancel();
    }
    while let Some(event) = job.next_event() {
        if let VerifyEvent::Violated(subject, trace) = event {
            println!("violated: {} after {} steps", name(loaded, subject), trace.steps.len());
        }
    }
    match job.finish().map_err(|crashed| crashed.0)?.0 {
        Ok(report) => {
            let holds = report.verdicts.iter().filter(|verdict| verdict.outcome == Outcome::Holds).count();
            println!("{} states, {holds} of {} checks hold", report.progress.states, report.verdicts.len());
        }
        Err(reason) => println!("not verified: {reason:?}"),
    }
    Ok(())
}

fn name(loaded: &Loaded, subject: Subject) -> String {
    match subject {
        Subject::Property(index) => loaded.program.properties[index].name.clone(),
        other => format!("{other:?}"),
    }
}
