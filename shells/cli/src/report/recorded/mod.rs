//! `groundstate report MODEL --run FILE…`: compares runs of a program with its model, and shows them as a page.
//!
//! A file is a recording (MCAP), or the JSON of a run (spec/run.md), which names its recording and pictures. The first
//! run is shown in detail; the figures of all runs stand side by side. The exit code is that of `conform` for the worst
//! run; it is also 1 if a closed loop in virtual time missed its goal.

use std::io::Write;
use std::path::{Path, PathBuf};

use ::report::{Fact, Program, ProgramRun, RunSummary, render_program};
use chart::system::System;
use groundstate::reporting::{Counted, counted_inputs, counted_times, held_in_words, run_name, system_beside};
use recording::Recording;

use crate::conform::{hold, read};
use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::read_bytes;
use crate::load::load;
use crate::report::{Arguments, write_beside};
use crate::shell::Shell;
use wire::{RunFile, RunTold, Unseen};

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let mut program = Program {
        title: String::new(),
        note: String::new(),
        model: String::new(),
        runs: Vec::new(),
        facts: Vec::new(),
    };
    let mut worst = Exit::Good;
    let system = arguments.write_inputs.as_ref().map(|_| varying(shell, &arguments.model)).transpose()?;
    let mut recordings = Vec::new();
    let fact = |label: &str, value: String| Fact { label: label.to_string(), value };
    program.facts.push(fact("Model", arguments.model.display().to_string()));
    for path in &arguments.runs {
        let (recording, told) = find(shell, path)?;
        let loaded = match load(shell, &arguments.model)? {
            Ok(loaded) => loaded,
            Err(exit) => return Ok(exit),
        };
        program.model.clone_from(&loaded.program.name);
        if program.runs.is_empty() {
            program.facts.push(fact("Fingerprint of all texts", groundstate::fingerprint(&loaded.sources)));
        }
        let (recording, held) = match hold(shell, loaded, &arguments.model, recording, false)? {
            Ok(conformed) => {
                let held = held_in_words(&conformed);
                (conformed.recording, held)
            }
            Err(exit) => return Ok(exit),
        };
        worst = worst.max(match held.conforms {
            Some(true) => Exit::Good,
            Some(false) => Exit::Model,
            None => Exit::Unknown,
        });
        let name = run_name(&recording, &program.runs);
        let mut run = ProgramRun::of(name, &recording);
        run.verdict = Some(held);
        let RunTold { title, note, closed_loop } = told;
        if program.runs.is_empty() {
            program.title = title.unwrap_or_else(|| recording.system.clone());
            program.note = note.unwrap_or_default();
        }
        if closed_loop.as_ref().is_some_and(|world| world.reached == Some(false)) {
            worst = worst.max(Exit::Model);
        }
        run.closed_loop = closed_loop;
        program.facts.push(fact(&format!("Run in {}", run.name), path.display().to_string()));
        program.runs.push(run);
        if system.is_some() {
            recordings.push(recording);
        }
    }
    program.facts.push(fact("Groundstate", env!("CARGO_PKG_VERSION").to_string()));
    if let Some(path) = &arguments.output {
        write_beside(path, &render_program(&program))?;
    }
    let counted = system.map(|system| counted_times(&system, &recordings)).unwrap_or_default();
    if let Some(path) = &arguments.write_inputs {
        let from: Vec<String> = arguments.runs.iter().map(|path| path.display().to_string()).collect();
        write_beside(path, &counted_inputs(&counted, &from))?;
    }
    let written = [&arguments.output, &arguments.write_inputs].into_iter().flatten();
    tell(shell, &program, &counted, written.map(|path| path.display().to_string()).collect())?;
    Ok(worst)
}

/// The system of the chart beside the model, in which some time varies.
fn varying(shell: &mut Shell, model: &Path) -> Result<System, Failure> {
    let chart = model.with_extension("chart");
    let found = system_beside(&model.to_string_lossy(), &mut shell.disk());
    let found = found.map_err(|(path, absent)| Failure::usage(absent.told(&path)))?;
    let nothing = |reason: &str| {
        let message = format!("there are no inputs to write: {reason}");
        Failure::usage_with_help(
            message,
            "an elaboration varies as in `elaborate look 3..9 ms`, a release as in `jitter 0.2 ms`",
        )
    };
    let system = found.ok_or_else(|| nothing(&format!("{} draws no system, or has faults", chart.display())))?;
    let varies = system.components.iter().flat_map(|component| &component.phases).any(|phase| phase.least < phase.time);
    match varies || system.has_jitter() {
        true => Ok(system),
        false => Err(nothing(&format!("no time varies in {}", chart.display()))),
    }
}

/// The recording, and what else the file says about the run.
fn find(shell: &Shell, path: &Path) -> Result<(Recording, RunTold), Failure> {
    let is_json = path.extension().is_some_and(|extension| extension == "json");
    crate::overwrite::note(path);
    if !is_json {
        return Ok((read(shell, path)?, RunTold::default()));
    }
    let limit = shell.global.limits.max_file_size;
    let run = RunFile::read(&read_bytes(path, limit)?).map_err(|reason| {
        Failure::usage_with_help(
            format!("{} is no run of a program: {reason}", path.display()),
            "spec/run.md lists what the file of a run has",
        )
    })?;
    let beside = |name: &str| -> PathBuf { path.parent().unwrap_or(Path::new("")).join(name) };
    let Some(log) = run.log.clone() else {
        return Err(Failure::usage_with_help(
            format!("{} names no recording", path.display()),
            "the program writes its events with `--log FILE`, and names them in the JSON of the same run",
        ));
    };
    crate::overwrite::note(&beside(&log));
    let recording = read(shell, &beside(&log))?;
    let told = run.told(&mut |picture| read_bytes(&beside(picture), limit)).map_err(|unseen| match unseen {
        Unseen::Unread(failure) => failure,
        Unseen::NoPng(picture) => Failure::usage(format!("{} is no PNG", beside(&picture).display())),
    })?;
    Ok((recording, told))
}

fn tell(shell: &mut Shell, program: &Program, counted: &[Counted], written: Vec<String>) -> Result<(), Failure> {
    if shell.json() {
        return shell.object(&wire::ProgramReported::new(program, written));
    }
    if shell.talks() {
        let options = RunSummary { colour: shell.color_out() };
        write!(shell.out(), "{}", ::report::summarise_program(program, &options))?;
        for one in counted {
            let Counted { input, what, below, beyond, .. } = one;
            let outside = match below + beyond {
                0 => String::new(),
                outside => format!("; {outside} are outside the chart's bounds, and count as the bound"),
            };
            writeln!(shell.out(), "{input}: {} {what}{outside}", one.number())?;
        }
        for path in written {
            writeln!(shell.out(), "written: {path}")?;
        }
    }
    Ok(())
}
