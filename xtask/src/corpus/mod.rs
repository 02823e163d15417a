//! `cargo xtask corpus CHECKOUT`: our results over the public corpus against the recorded ones of the peer.
//!
//! In: a checkout of the models and the folder of recorded results. Out: `spec/conformance.md`: counts, and each
//! difference with its reason; and `spec/charts-found.md`, see `charts.rs` (`--only charts` prints it alone). With
//! `--scripts`, each run that comes out as recorded is written to a folder for generated code to replay (`script.rs`). The models never enter this project; a reason is decided by a test on the model or on
//! the difference, never by a file's name.

mod accept;
mod charts;
mod defect;
mod difference;
mod excuse;
mod explore;
mod inputs;
mod job;
mod loader;
pub(crate) use loader::Checkout;
mod names;
mod pool;
mod reason;
mod recorded;
mod replay;
mod report;
mod scenario;
mod script;
mod simulation;
mod state;
mod text;
mod trace;
mod worker;

use std::path::PathBuf;

use crate::arguments::Arguments;
use crate::{Failure, Outcome, repository};

/// The name under which this program is started again as a worker.
pub const WORKER: &str = "corpus-worker";

/// The command.
///
/// # Errors
/// Usage, or files that cannot be read or written.
pub fn run(words: &[String]) -> Result<Outcome, Failure> {
    let arguments = Arguments::read(words, &["--recorded", "-o", "--only", "--scripts"], &[])?;
    let [checkout] = arguments.rest.as_slice() else {
        return Err("name one folder: a checkout of the public corpus".to_string());
    };
    let checkout = PathBuf::from(checkout);
    let recorded =
        arguments.option("--recorded").map_or_else(|| repository::root().join("../shared/conformance"), PathBuf::from);
    if arguments.option("--only") == Some("charts") {
        println!("{}", charts::page(&checkout)?);
        return Ok(Outcome::Good);
    }
    let mut recorded = recorded::read(&recorded, arguments.option("--scripts"))?;
    let everything = recorded::everything(&checkout, &recorded.jobs)?;
    recorded.jobs.extend(everything);
    if let Some(only) = arguments.option("--only") {
        recorded.jobs.retain(|job| job.section() == only || job.subject().contains(only));
    }
    let answers = pool::run(&checkout, &recorded.jobs)?;
    let report = report::Report::new(&recorded.jobs, &answers);
    let target = match (arguments.option("-o"), arguments.option("--only")) {
        (Some(path), _) => Some(PathBuf::from(path)),
        // A part of the whole is only printed.
        (None, Some(_)) => None,
        (None, None) => Some(repository::root().join("spec/conformance.md")),
    };
    match target {
        Some(path) => {
            std::fs::write(&path, report.page()).map_err(|error| format!("{}: {error}", path.display()))?;
            println!("{}", report.summary());
            println!("written to {}", path.display());
            let path = path.with_file_name("charts-found.md");
            std::fs::write(&path, charts::page(&checkout)?).map_err(|error| format!("{}: {error}", path.display()))?;
            println!("written to {}", path.display());
        }
        None => println!("{}", report.page()),
    }
    Ok(if report.is_explained() { Outcome::Good } else { Outcome::AtFault })
}

/// The worker's side.
///
/// # Errors
/// The pipe broke.
pub fn work(words: &[String]) -> Result<Outcome, Failure> {
    let [root] = words else { return Err("a worker is started by `corpus` alone".to_string()) };
    worker::work(PathBuf::from(root)).map(|()| Outcome::Good)
}
