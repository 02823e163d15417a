//! `groundstate graph MODEL`: lists every state of a small model with the steps between them, for pictures of the state graph.
//!
//! Exit codes: 0 all states are listed, 3 not all. It gives no verdicts: `groundstate verify` does.

use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;

use clap::Args;
use groundstate::job::{self, Cancel, ListEvent};
use groundstate::verify::listing::Listing;
use groundstate::verify::{Options, Reason};
use groundstate::{Kind, Said};
use program::PropertyKind;
use wire::{Graph, GraphState, GraphStep};

use crate::check::plural;
use crate::exit::Exit;
use crate::failure::Failure;
use crate::interrupt;
use crate::load::load;
use crate::shell::Shell;
use crate::verify::{Bounded, Teller, no_start};

/// Arguments of `graph`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// The model
    model: PathBuf,
    /// Say of each state whether this term is true in it; may be repeated
    #[arg(long = "where", value_name = "TERM")]
    terms: Vec<String>,
    #[command(flatten)]
    bounded: Bounded,
}

/// The most states, if no other number is given: more are no picture.
const STATES: u64 = 2_000;

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    if Kind::of(&arguments.model) == Some(Kind::Chart) {
        return Err(Failure::usage(
            "a state graph is that of a model: `groundstate chart build` writes the model of a chart",
        ));
    }
    let loaded = match load(shell, &arguments.model)? {
        Ok(loaded) => loaded,
        Err(exit) => return Ok(exit),
    };
    if loaded.program.main.is_none() {
        return crate::run::no_main(shell, &loaded);
    }
    let mut asked = loaded.overlay();
    let beside = arguments.bounded.beside(shell, &loaded.program, &mut asked.sources, &arguments.model)?;
    let Some(beside) = beside else { return Ok(Exit::World) };
    let mut faults = Vec::new();
    for text in beside.assumptions.iter().map(Said::from) {
        faults.extend(asked.property(PropertyKind::Invar, "--assume", text).err());
    }
    for text in beside.properties[0].iter().map(Said::from) {
        faults.extend(asked.property(PropertyKind::Invariant, "--invariant", text).err());
    }
    let mut terms = Vec::new();
    for text in &arguments.terms {
        match asked.ask("--where", text) {
            Ok(term) => terms.push(term),
            Err(wrong) => faults.push(wrong),
        }
    }
    if let Some(wrong) = faults.first() {
        shell.diagnostics(&asked.sources, wrong)?;
        return Ok(Exit::World);
    }
    let program = Arc::clone(&asked.program);
    let (options, mut watch) = arguments.bounded.options(shell, &program, &beside)?;
    let options = Options { max_states: arguments.bounded.max_states.unwrap_or(STATES), ..options };
    let cancel = Cancel::from(interrupt::request().clone());
    let started = job::list(Arc::clone(&program), options, terms, cancel);
    let job = started.map_err(|error| Failure::usage(format!("the listing cannot be started: {error}")))?;
    while let Some(ListEvent(progress)) = job.next_event() {
        watch.at(&progress);
    }
    let outcome = job.finish().unwrap_or_else(|crashed| panic!("{}", crashed.0));
    let teller = Teller::new(&program, &asked.sources, watch.done());
    match outcome {
        Ok(listing) => tell(shell, &teller, &listing),
        Err(trouble) => no_start(shell, &teller, trouble),
    }
}

fn tell(shell: &mut Shell, teller: &Teller<'_>, listing: &Listing) -> Result<Exit, Failure> {
    for (number, state) in listing.states.iter().enumerate() {
        let state = GraphState::new(&teller.words, number, state);
        if shell.json() {
            shell.object(&state)?;
        } else {
            write!(shell.out(), "{}", text(&state))?;
        }
    }
    let reason = match listing.stop {
        Some(stop) => Some(teller.words.reason(&Reason::Stopped(stop))),
        None if listing.is_unsure => Some("a condition could not be decided in every state".to_string()),
        None if !listing.is_complete() => Some("some steps cannot be gone through".to_string()),
        None => None,
    };
    let exit = if listing.is_complete() { Exit::Good } else { Exit::Unknown };
    let graph = Graph::new(listing, reason);
    if shell.json() {
        shell.object(&graph)?;
    } else if shell.talks() {
        let (states, steps) = (plural(graph.states, "state"), plural(graph.steps, "step"));
        match &graph.reason {
            None => writeln!(shell.out(), "{states}, {steps} between them")?,
            Some(reason) => writeln!(shell.out(), "not all: {states}, {steps} between them; {reason}")?,
        }
    }
    Ok(exit)
}

/// A state as lines.
fn text(state: &GraphState) -> String {
    let initial = if state.initial { ", initial" } else { "" };
    let told = state.holds.iter().map(|holds| match holds {
        Some(true) => "true",
        Some(false) => "false",
        None => "undef",
    });
    let told: Vec<&str> = told.collect();
    let holds = if told.is_empty() { String::new() } else { format!(": {}", told.join(", ")) };
    let mut out = format!("state {}{initial}{holds}\n", state.state);
    for (location, value) in &state.values {
        out.push_str(&format!("    {location} = {value}\n"));
    }
    for name in &state.violated {
        out.push_str(&format!("    violates {name}\n"));
    }
    for step in &state.steps {
        out.push_str(&format!("    {}\n", line(step)));
    }
    if !state.whole {
        out.push_str("    not all steps\n");
    }
    out
}

fn line(step: &GraphStep) -> String {
    let inputs = step.inputs.iter().map(|(location, value)| format!("{location} = {value}"));
    let how: Vec<String> = inputs.chain(step.choices.iter().cloned()).collect();
    let how = if how.is_empty() { String::new() } else { format!("  ({})", how.join(", ")) };
    let ways = if step.ways > 1 { format!(", {} ways", step.ways) } else { String::new() };
    match (&step.to, &step.fault) {
        (Some(to), _) => format!("-> state {to}{how}{ways}"),
        (None, fault) => format!("-> cannot be made: {}{how}{ways}", fault.as_deref().unwrap_or_default()),
    }
}
