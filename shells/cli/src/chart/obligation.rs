//! What `chart check` says of each shape that is to be refined: open, refined, or with `--prove` what the proof came to.
//!
//! INVARIANT: *proved* is said only of a proof that this run has made, of the files as they are now; nothing is kept of it.

use std::path::Path;

use groundstate::refine::{Coupling, Options, Verdict, refine};
use groundstate::tell::Refinements;
use groundstate::verify::Progress;
use groundstate::{Owed, OwedProof};
use syntax::SourceFile;

use crate::interrupt;
use crate::shell::Shell;
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
            Told::Proved { pairs, observed, waiting } => {
                let waiting = if *waiting { ", assumed that waiting ends" } else { "" };
                format!(
                    "proved ({}, observed {}{waiting})",
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
            (Ok(proof), Some(asked)) => proved(shell, proof, asked),
        });
    }
    all
}

fn proved(shell: &Shell, proof: &OwedProof, asked: Asked) -> Told {
    let limits = shell.global.limits.uninterrupted();
    let programs = [&proof.models[0].program, &proof.models[1].program];
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
    for extent in &mut options.extents {
        extent.limits = limits.clone();
        extent.interrupt = interrupt::request().clone();
    }
    let mut watch = Watch::new(asked.time, shell.global.quiet || shell.json());
    let outcome = refine(&coupling, &options, &mut |progress| {
        watch.at(&Progress { states: progress.pairs, queue: progress.queue, ..Progress::default() })
    });
    let timed_out = watch.done();
    let words = Refinements {
        models: [&proof.models[0], &proof.models[1]],
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
            Told::Proved { pairs: report.progress.pairs, observed: proof.observed.clone(), waiting: asked.waiting }
        }
        Verdict::DoesNot(refutation) => {
            let report =
                words.report(&report).replace("write `allow waiting;` into the coupling", "add --allow-waiting");
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
