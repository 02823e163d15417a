//! Verifies a system as its chart draws it: `verify NAME.chart`.
//!
//! In: a chart. Out: the model to search; counterexamples told as what the tasks do, and written as scenarios of the ground model.

use std::io::Write;
use std::path::Path;

use groundstate::tell::Story;
use groundstate::verify::{Outcome, Report, Subject};
use groundstate::{Overlay, VerifiedSystem};
use machine::Limits;
use program::Program;
use syntax::Sources;

use super::Arguments;
use super::counterexample::{named, relative, with_invariant};
use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::write_text;
use crate::shell::Shell;

/// Loads a system. If it has errors, shows them and returns the exit code.
pub fn load(shell: &mut Shell, arguments: &Arguments) -> Result<Result<Box<VerifiedSystem>, Exit>, Failure> {
    let mut disk = shell.disk();
    let root = disk.root(&arguments.model)?;
    let libraries: &[&str] = if arguments.ltl.is_empty() { &[] } else { &["LTLLibrary"] };
    match groundstate::verified_system(root, libraries, &mut disk) {
        Ok(system) => Ok(Ok(system)),
        Err(faults) => {
            for (sources, faults) in &faults {
                shell.diagnostics(sources, faults)?;
            }
            if shell.talks() {
                shell.note(&format!("{} was not verified", arguments.model.display()))?;
            }
            Ok(Err(Exit::Model))
        }
    }
}

/// Says what the verdicts are about.
pub fn about(shell: &mut Shell) -> Result<(), Failure> {
    if shell.talks() {
        writeln!(shell.out(), "of times, locks and channels as drawn; what elaborations compute is left out")?;
    }
    Ok(())
}

/// Tells a run as what the tasks do.
pub fn story<'a>(system: &'a VerifiedSystem, limits: Limits, asked: (&'a Program, &'a Sources)) -> Story<'a> {
    Story(Box::new(move |subject, trace| match system.tell_run(limits.clone(), asked, subject, trace) {
        Ok(told) => told,
        Err(reason) => format!("  this run could not be made by the ground model: {reason}\n"),
    }))
}

/// Writes counterexamples as scenarios of the ground model: the first one to a file, or all of them into a folder.
pub fn write(
    shell: &mut Shell,
    path: &Path,
    chart: &Path,
    system: &VerifiedSystem,
    asked: &Overlay,
    report: &Report,
) -> Result<(), Failure> {
    let one = path.extension().is_some_and(|ending| ending == "avalla");
    let model = chart.with_extension("asm");
    let (program, mut names, mut written) = (&asked.program, Vec::new(), Vec::new());
    for verdict in &report.verdicts {
        let Outcome::Violated(trace) = &verdict.outcome else { continue };
        // That nothing moves any more is seen in no state of the ground model, whose clock goes on.
        if verdict.subject == Subject::NoDeadlock {
            continue;
        }
        let name = named(program, verdict.subject, &mut names);
        let file = if one { path.to_path_buf() } else { path.join(format!("{name}.avalla")) };
        let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        std::fs::create_dir_all(folder).map_err(|error| Failure::of_file("write", folder, error))?;
        let loaded = relative(&model, folder);
        let scenario = name.replace('-', "_");
        let text = groundstate::counterexample_scenario(program, trace, verdict.subject, &scenario, &loaded);
        let text = match system.scenario_property((program, &asked.sources), verdict.subject) {
            Some(property) if !system.is_checked(program, verdict.subject) => with_invariant(&text, &property),
            _ => text,
        };
        write_text(&file, &text)?;
        written.push(file);
        if one {
            break;
        }
    }
    if shell.talks() {
        for file in &written {
            writeln!(shell.out(), "wrote {}", file.display())?;
        }
        if !written.is_empty() && !model.exists() {
            shell.note(&format!("the scenarios load {}, which `groundstate chart build` writes", model.display()))?;
        }
    }
    Ok(())
}
