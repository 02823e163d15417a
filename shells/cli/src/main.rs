//! The `groundstate` command: arguments in, exit code out.
//!
//! Each command has one file, takes its arguments and a [`Shell`], and returns an [`Exit`].
//! This crate does all I/O; files, terminal, clock and signals are touched nowhere below it. The work runs on a thread
//! with a large stack, as a second safeguard beside the limits of the crates below.

#![allow(
    clippy::disallowed_methods,
    clippy::disallowed_macros,
    reason = "a shell: files, clock, environment and printing are its work"
)]

mod bench;
mod chart;
mod check;
mod checkpoint;
mod completions;
mod conform;
mod coverage;
mod dap;
mod dump;
mod engine;
mod exit;
mod explain;
mod failure;
mod files;
mod fmt;
mod generate;
mod generate_tests;
mod graph;
mod inputs;
mod interrupt;
mod limits;
mod load;
mod lsp;
mod man;
mod mutate;
mod new;
mod overwrite;
mod progress;
mod prompt;
mod refine;
mod render;
mod replay;
mod report;
mod review;
mod run;
mod shell;
mod sink;
mod solver;
mod studio;
mod test;
mod tracefile;
mod verify;
mod within;

use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};

use crate::exit::Exit;
use crate::shell::{Global, Shell};

/// Checks, runs and tests Abstract State Machines written in AsmetaL.
#[derive(Debug, Parser)]
#[command(name = "groundstate", version, max_term_width = 100, after_help = EXIT_CODES)]
struct Arguments {
    #[command(flatten)]
    global: Global,
    #[command(subcommand)]
    command: Command,
}

const EXIT_CODES: &str = "Exit codes: 0 good; 1 the model is at fault, an invariant is violated or a scenario fails; \
                          2 wrong usage or the world (a missing file); 3 not known (interrupted, a bound was \
                          reached).";

#[derive(Debug, Subcommand)]
enum Command {
    /// Make a folder with a first model that checks, runs, tests and draws at once
    New(new::Arguments),
    /// Report the faults of models, scenarios and charts without running them
    Check(check::Arguments),
    /// Run a model
    Run(Box<run::Arguments>),
    /// Run scenarios and report which fail
    Test(test::Arguments),
    /// Explore every state of a model: find what always holds, what is violated and how, what is unknown
    Verify(Box<verify::Arguments>),
    /// Prove or refute that every run of a concrete model corresponds to a run of an abstract one
    Refine(Box<refine::Arguments>),
    /// Look for oddities in a model: rules that never run, values never taken, forgotten cases
    Review(review::Arguments),
    /// List every state of a small model with the steps between them
    Graph(graph::Arguments),
    /// Write scenarios that reach the rules, branches, updates, conditions and transitions of a model
    GenerateTests(generate_tests::Arguments),
    /// Put small faults into models and tell which ones no property and no scenario notices
    Mutate(Box<mutate::Arguments>),
    /// Repeat the run of a recorded trace and compare
    Replay(replay::Arguments),
    /// Run a model and write a page about the run: timeline, deadlines, waiting, coverage
    Report(Box<report::Arguments>),
    /// Draw charts, build models from them, compare the two, extract charts from models
    Chart(chart::Arguments),
    /// Write the program that a model or a chart means
    Generate(generate::Arguments),
    /// Compare the recorded events of a generated program with its model
    Conform(conform::Arguments),
    /// Show the result of a stage: tree, model, program or chart
    Dump(dump::Arguments),
    /// Explain a kind of fault by its name
    Explain(explain::Arguments),
    /// Format models, scenarios and charts
    Fmt(fmt::Arguments),
    /// Serve an editor: the language server, over stdin and stdout
    Lsp(lsp::Arguments),
    /// Serve a debugger: the debug adapter, over stdin and stdout
    Dap(dap::Arguments),
    /// Draw, run and check a project in the browser
    Studio(studio::Arguments),
    /// Measure steps per second and memory
    Bench(bench::Arguments),
    /// Write a shell's completion script for this command
    Completions(completions::Arguments),
    /// Write the manual pages
    Man(man::Arguments),
}

/// The size of the working thread's stack.
const STACK_BYTES: usize = 256 << 20;

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help and version are no failures and go to stdout; clap knows which is which.
            let code = if error.use_stderr() { Exit::World } else { Exit::Good };
            let _ = error.print();
            return code.into();
        }
    };
    let worker = std::thread::Builder::new().name("groundstate".to_string()).stack_size(STACK_BYTES);
    match worker.spawn(move || work(arguments)).map(std::thread::JoinHandle::join) {
        Ok(Ok(exit)) => exit.into(),
        // A panic is our bug; its message is printed already.
        Ok(Err(_)) => ExitCode::from(101),
        Err(error) => {
            eprintln!("error: cannot start: {error}");
            Exit::World.into()
        }
    }
}

fn work(arguments: Arguments) -> Exit {
    let folder = arguments.global.within.clone();
    let mut shell = Shell::new(arguments.global);
    if let Some(failure) = folder.and_then(|folder| within::keep(&folder).err()) {
        shell.report_failure(&failure);
        return Exit::World;
    }
    let outcome = match arguments.command {
        Command::Check(arguments) => check::run(&mut shell, &arguments),
        Command::Run(arguments) => run::run(&mut shell, &arguments),
        Command::Test(arguments) => test::run(&mut shell, &arguments),
        Command::Verify(arguments) => verify::run(&mut shell, &arguments),
        Command::Refine(arguments) => refine::run(&mut shell, &arguments),
        Command::Review(arguments) => review::run(&mut shell, &arguments),
        Command::Graph(arguments) => graph::run(&mut shell, &arguments),
        Command::GenerateTests(arguments) => generate_tests::run(&mut shell, &arguments),
        Command::Mutate(arguments) => mutate::run(&mut shell, &arguments),
        Command::Replay(arguments) => replay::run(&mut shell, &arguments),
        Command::Report(arguments) => report::run(&mut shell, &arguments),
        Command::Chart(arguments) => chart::run(&mut shell, &arguments),
        Command::Generate(arguments) => generate::run(&mut shell, &arguments),
        Command::Conform(arguments) => conform::run(&mut shell, &arguments),
        Command::Dump(arguments) => dump::run(&mut shell, &arguments),
        Command::Explain(arguments) => explain::run(&mut shell, &arguments),
        Command::Fmt(arguments) => fmt::run(&mut shell, &arguments),
        Command::Lsp(arguments) => lsp::run(&mut shell, &arguments),
        Command::Dap(arguments) => dap::run(&mut shell, &arguments),
        Command::Studio(arguments) => studio::run(&mut shell, &arguments),
        Command::Bench(arguments) => bench::run(&mut shell, &arguments),
        Command::New(arguments) => new::run(&mut shell, &arguments),
        Command::Completions(arguments) => completions::run(&mut shell, &arguments, Arguments::command()),
        Command::Man(arguments) => man::run(&mut shell, &arguments, Arguments::command()),
    };
    let outcome = outcome.and_then(|exit| shell.flush().map(|()| exit));
    outcome.unwrap_or_else(|failure| {
        shell.report_failure(&failure);
        Exit::World
    })
}
