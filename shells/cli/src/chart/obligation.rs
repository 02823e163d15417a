//! What `chart check` says of each shape that is to be refined: open, refined, or with `--prove` what the proof came to.
//!
//! INVARIANT: *proved* is said only of a proof that this run has made, of the files as they are now; nothing is kept of it.

use std::path::Path;

use groundstate::refine::{Coupling, Options, Verdict, refine};
use groundstate::tell::{Refinements, WAITS};
use groundstate::verify::Progress;
use groundstate::{Assumptions, Leaving, Loaded, Owed, OwedProof, Stuck, StuckAt, assume, leaving};
use syntax::SourceFile;

use crate::failure::Failure;
use crate::files::read_source;
use crate::interrupt;
use crate::shell::Shell;
use crate::verify::beside::path_of;
use crate::verify::watch::Watch;

/// LIMIT: the most memory of a proof, in MiB.
const MEMORY: u64 = 8192;

/// How a proof is made.
#[derive(Debug, Clone, Copy)]
pub struct Asked {
    /// Waiting for something outside is taken to end.
    pub waiting: bool,
    /// The most time for one proof, in seconds.
    pub time: Option<u64>,
}

/// What is said of a shape.
pub enum Told {
    /// There is nothing to prove yet.
    Open(String),
    /// There is a machine; nobody asked for the proof.
    Refined {
        /// What proves it.
        command: String,
    },
    /// There is a machine, and chart and model differ.
    Differs,
    /// It was proved just now.
    Proved {
        /// How many pairs of states were looked at.
        pairs: u64,
        /// What is compared.
        observed: Vec<String>,
        /// Waiting was taken to end.
        waiting: bool,
        /// What the file beside the chart assumes.
        assumed: Vec<String>,
        /// The answers that it never gives.
        never: Vec<bool>,
        /// The machine never comes to it.
        idle: bool,
        /// Whether it can always be left was not looked at.
        unasked: bool,
    },
    /// It was refuted.
    Refuted {
        /// Why, in a clause.
        why: String,
        /// Both runs.
        report: String,
    },
    /// It is not known.
    Unknown(String),
}

impl Told {
    /// What is said, in a line.
    pub fn words(&self) -> String {
        match self {
            Told::Open(why) => format!("open, {why}"),
            Told::Refined { command } => format!("refined, not proved; `{command}` looks"),
            Told::Differs => "refined, not proved: chart and model differ".to_string(),
            Told::Proved { pairs, observed, waiting, assumed, never, idle, unasked } => {
                let mut taken = assumed.clone();
                taken.extend(waiting.then(|| "that waiting ends".to_string()));
                let waiting = if taken.is_empty() { String::new() } else { format!(", assumed {}", taken.join(", ")) };
                let never = match never[..] {
                    [true] => "; it never answers yes",
                    [false] => "; it never answers no",
                    [] if *idle => "; it is never entered",
                    [] => "",
                    _ => "; it is never asked",
                };
                let unasked = if *unasked { "; whether it can always be left was not looked at" } else { "" };
                format!(
                    "proved ({}, observed {}{waiting}{never}{unasked})",
                    crate::check::plural(*pairs as usize, "pair"),
                    observed.join(", ")
                )
            }
            Told::Refuted { why, .. } => format!("refuted, {why}"),
            Told::Unknown(why) => format!("not known, {why}"),
        }
    }
}

/// What is to be said of each shape. With `prove` the proofs are made.
pub fn told(shell: &Shell, file: &Path, owed: &[Owed], prove: Option<Asked>, differs: bool) -> Vec<Told> {
    let mut all = Vec::new();
    for owed in owed {
        all.push(match (&owed.question, prove) {
            (Err(why), _) => Told::Open(why.clone()),
            (Ok(_), _) if differs => Told::Differs,
            (Ok(_), None) => Told::Refined { command: format!("groundstate chart check {} --prove", file.display()) },
            (Ok(proof), Some(asked)) => proved(shell, file, proof, asked),
        });
    }
    all
}

/// The file beside the chart that says what is assumed.
fn beside(shell: &Shell, path: &Path) -> Result<Option<SourceFile>, Told> {
    match read_source(path, shell.global.limits.max_file_size) {
        Ok(read) => Ok(Some(read)),
        Err(Failure::Missing(_)) => Ok(None),
        Err(_) => Err(Told::Unknown(format!("{} cannot be read", path.display()))),
    }
}

/// Both models with what the file beside the chart assumes. They are the chart's: what is assumed of one is assumed of the other.
fn assumed(path: &Path, beside: Option<&SourceFile>, proof: &OwedProof) -> Result<[Assumptions; 2], Told> {
    let of = |model: &Loaded| {
        assume(model, beside, &[]).map_err(|trouble| {
            let message = trouble.1.first().map_or("", |fault| &fault.message);
            Told::Open(format!("{} has faults: {message}", path.display()))
        })
    };
    Ok([of(&proof.models[0])?, of(&proof.models[1])?])
}

/// Whether the machine in the shape's place can always be left, and all machines go on, and what it answers.
fn left(shell: &Shell, proof: &OwedProof, beside: Option<&SourceFile>, asked: Asked) -> Leaving {
    let options = groundstate::verify::Options {
        limits: shell.global.limits.uninterrupted(),
        interrupt: interrupt::request().clone(),
        ..groundstate::verify::Options::default()
    };
    let mut watch = Watch::new(asked.time, true);
    let found = leaving(proof, beside, asked.waiting, &options, &mut shell.disk(), &mut |progress| watch.at(progress));
    watch.done();
    found
}

fn proved(shell: &Shell, file: &Path, proof: &OwedProof, asked: Asked) -> Told {
    let limits = shell.global.limits.uninterrupted();
    let path = path_of(file);
    let file = match beside(shell, &path) {
        Ok(file) => file,
        Err(told) => return told,
    };
    let all = match assumed(&path, file.as_ref(), proof) {
        Ok(all) => all,
        Err(told) => return told,
    };
    let programs = [&all[0].model.program, &all[1].model.program];
    let mut text = proof.coupling.text.to_string();
    if asked.waiting {
        text.push_str("allow waiting;\n");
    }
    let text = SourceFile::new(proof.coupling.name.as_str(), text);
    let coupling = match Coupling::new(programs, Some(text), &limits) {
        Ok(coupling) => coupling,
        Err(faulty) => return Told::Open(format!("the two models cannot be compared: {}", faulty.faults[0].message)),
    };
    interrupt::listen();
    interrupt::bound_memory(MEMORY);
    let mut options = Options::default();
    for (extent, assumptions) in options.extents.iter_mut().zip(&all) {
        assumptions.put(extent);
        extent.limits = limits.clone();
        extent.interrupt = interrupt::request().clone();
    }
    let mut watch = Watch::new(asked.time, shell.global.quiet || shell.json());
    let outcome = refine(&coupling, &options, &mut |progress| {
        watch.at(&Progress { states: progress.pairs, queue: progress.queue, ..Progress::default() })
    });
    let timed_out = watch.done();
    let words = Refinements {
        models: [&all[0].model, &all[1].model],
        coupling: &coupling,
        timed_out,
        all: false,
        verified: None,
    };
    let report = match outcome {
        Ok(report) => report,
        Err(_) => return Told::Unknown("the initial states cannot be made".to_string()),
    };
    match &report.verdict {
        Verdict::Refines => {
            let mut assumed: Vec<String> = Vec::new();
            for (name, from) in report.assumed.iter().map(|assumed| words.assumed_from(assumed)) {
                if from.is_some() && !assumed.contains(&name) {
                    assumed.push(name);
                }
            }
            let (pairs, observed) = (report.progress.pairs, proof.observed.clone());
            let Leaving { stuck, never, idle, open, unasked } = left(shell, proof, file.as_ref(), asked);
            match stuck {
                // All that was taken for granted is that waiting ends, and here it cannot.
                Some(Stuck { at, run }) => {
                    let why = match at {
                        StuckAt::Block => "there is a state from which it is never left".to_string(),
                        StuckAt::Asked { asked, branch } => {
                            format!("there is a state from which it is never left, though `{asked}` is always {branch}")
                        }
                        StuckAt::State { machine, value } => {
                            format!("there is a state from which {machine} never leaves {value}")
                        }
                    };
                    Told::Refuted { why, report: run }
                }
                None if open => Told::Unknown("whether its machines can always go on was not decided".to_string()),
                None => Told::Proved { pairs, observed, waiting: asked.waiting, assumed, never, idle, unasked },
            }
        }
        Verdict::DoesNot(refutation) => {
            let report =
                words.report(&report).replace(WAITS, "if something outside the models ends this, add --allow-waiting");
            Told::Refuted { why: words.headline(refutation), report }
        }
        Verdict::Unknown(whys) => {
            let whys: Vec<String> = whys.iter().map(|why| words.why(why)).collect();
            Told::Unknown(whys.join("; "))
        }
        Verdict::Vacuous(vacuous) => Told::Refuted {
            why: format!("or says nothing: {}", words.vacuous(vacuous).message),
            report: words.report(&report),
        },
    }
}
