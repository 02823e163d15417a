//! `groundstate replay TRACE`: repeats the run of a trace, prints it as `run` did, and compares.
//!
//! The trace is read line by line, so it may have any length. Exit code 0: the model still does what the trace says. 1:
//! it does not; the first difference is shown.

use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use groundstate::Overlay;
use groundstate::simulate::{Header, Options, Record, Recorded};
use groundstate::tell::parting;
use program::Program;
use wire::{Answer, Line, Reader};

use crate::exit::Exit;
use crate::failure::Failure;
use crate::load::load;
use crate::run::{Show, Teller, options};
use crate::shell::Shell;
use crate::within;

/// Arguments of `replay`.
#[derive(Debug, Args)]
pub struct Arguments {
    /// A trace written by `run --trace`, or the output of `run --format json`
    trace: PathBuf,
    /// The model, if it is not where the trace says
    #[arg(long, value_name = "FILE")]
    model: Option<PathBuf>,
    /// How much of the state is shown
    #[arg(long, value_enum, default_value_t = Show::Changed)]
    show: Show,
}

/// Runs the command.
pub fn run(shell: &mut Shell, arguments: &Arguments) -> Result<Exit, Failure> {
    let mut lines = Lines::open(&arguments.trace, shell.global.limits.max_file_size)?;
    let first = lines.next()?.ok_or_else(|| lines.wrong("it is empty"))?;
    let header = Reader::header(&first).map_err(|message| lines.wrong(&message))?;
    let path = arguments.model.clone().unwrap_or_else(|| PathBuf::from(&header.path));
    let loaded = match load(shell, &path)? {
        Ok(loaded) => loaded,
        Err(exit) => return Ok(exit),
    };
    if groundstate::fingerprint(&loaded.sources) != header.source {
        shell.note("note: the model has changed since the trace was made")?;
    }
    let mut asked = loaded.overlay();
    let until = match &header.until {
        None => None,
        Some(text) => match asked.ask("--until", text) {
            Ok(term) => Some(term),
            Err(faults) => {
                shell.diagnostics(&asked.sources, &faults)?;
                return Ok(Exit::Model);
            }
        },
    };
    let Overlay { sources, program, .. } = asked;
    let options = Options { until, ..options(&header) };
    let recorded = Recorded::new(Arc::clone(&program), shell.global.limits.machine(), options);
    let teller = Teller::new(shell, &program, &sources, arguments.show, header.until.clone());
    follow(shell, &header, lines, recorded, &teller, &program)
}

fn follow(
    shell: &mut Shell,
    header: &Header,
    mut lines: Lines,
    mut recorded: Recorded,
    teller: &Teller<'_>,
    program: &Program,
) -> Result<Exit, Failure> {
    teller.begin(shell, header)?;
    let reader = Reader { program };
    while let Some(line) = lines.next()? {
        let expected = match line {
            Line::Other => continue,
            Line::Back { .. } => {
                return Err(lines.wrong("it contains a step that was taken back; `run --trace` leaves those out"));
            }
            line => match reader.record(&line) {
                Ok(record) => record,
                // The trace contains names that the model no longer has.
                Err(message) => {
                    return told_apart(
                        shell,
                        recorded.run().steps() + 1,
                        "a name that the model no longer has",
                        &message,
                    );
                }
            },
        };
        match recorded.follow(&expected) {
            Ok(record) => {
                let run = recorded.run_mut();
                let faults = groundstate::diagnose_record(&record, run);
                let state = teller.wants_state().then(|| run.machine().locations());
                teller.tell(shell, &record, run.steps(), state.as_deref(), &faults)?;
                if matches!(record, Record::End(_)) {
                    return Ok(Exit::Good);
                }
            }
            Err(parted) => {
                let (trace, now) = parting(&parted, program);
                return told_apart(shell, parted.step, &trace, &now);
            }
        }
    }
    Err(lines.wrong("it has no end"))
}

fn told_apart(shell: &mut Shell, step: u64, trace: &str, now: &str) -> Result<Exit, Failure> {
    if shell.json() {
        let object = Answer::Parted { step, trace, now };
        shell.object(&object)?;
    } else {
        shell.note(&format!(
            "error: the model differs from the trace at step {step}\n  trace: {trace}\n  now:   {now}"
        ))?;
    }
    Ok(Exit::Model)
}

/// The lines of a trace file, each of bounded length.
struct Lines {
    path: PathBuf,
    reader: BufReader<File>,
    limit: u64,
    number: u64,
}

impl Lines {
    fn open(path: &Path, limit: u64) -> Result<Lines, Failure> {
        within::may_read(path)?;
        let wrap = |error| Failure::of_file("read", path, error);
        let file = File::open(path).map_err(wrap)?;
        if file.metadata().map_err(wrap)?.is_dir() {
            return Err(Failure::Folder(path.to_path_buf()));
        }
        Ok(Lines { path: path.to_path_buf(), reader: BufReader::new(file), limit, number: 0 })
    }

    fn next(&mut self) -> Result<Option<Line>, Failure> {
        let mut bytes = Vec::new();
        let read = self.reader.by_ref().take(self.limit + 1).read_until(b'\n', &mut bytes);
        read.map_err(|error| Failure::of_file("read", &self.path, error))?;
        if bytes.len() as u64 > self.limit {
            return Err(Failure::TooLarge { path: self.path.clone(), limit: self.limit });
        }
        if bytes.is_empty() {
            return Ok(None);
        }
        self.number += 1;
        serde_json::from_slice(&bytes).map(Some).map_err(|error| {
            // serde_json counts lines within the one line it sees, so its line number is removed.
            let reason = error.to_string();
            let reason = reason.split(" at line ").next().unwrap_or_default().to_string();
            self.wrong(&reason)
        })
    }

    fn wrong(&self, reason: &str) -> Failure {
        let message = format!("{} is not a trace: line {}: {reason}", self.path.display(), self.number.max(1));
        Failure::usage_with_help(message, "`groundstate run MODEL --trace FILE` writes one")
    }
}
