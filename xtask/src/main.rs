//! Developer commands: `cargo xtask corpus | bench | fuzz | keystrokes | letters | mutate-log | mutate-text | tidy`.
//!
//! In: the command line, from anywhere inside the repository. Out: what the command prints, and exit code 0 (good),
//! 1 (something is at fault) or 2 (usage, or the world). This is a shell: files, clocks and processes are its trade,
//! and its own findings go to standard output for a person to read.
#![allow(clippy::disallowed_methods, clippy::disallowed_macros, reason = "a shell owns I/O, clocks and printing")]

mod arguments;
mod bench;
mod corpus;
mod fuzz;
mod keystrokes;
mod letters;
mod mutate_log;
mod mutate_text;
mod repository;
mod tidy;

use std::process::ExitCode;

/// Why a command could not do its work: a sentence for the person who called it.
pub type Failure = String;

/// What a command that did its work found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// All is well.
    Good,
    /// Something is at fault; it has been printed.
    AtFault,
}

const USAGE: &str = "\
usage: cargo xtask COMMAND

  corpus CHECKOUT [--recorded DIR] [-o FILE]   compare with recorded results of the public corpus
  bench [--quick] [--only WORD] [--corpus CHECKOUT] [--windows N] [--window-ms N] [--runs N]
                                               steps per second, start-up time, memory
  fuzz [--seconds N] [--only WORD] [--reproduce FILE]
                                               fuzz targets, each for some seconds
  keystrokes [--binary FILE]                   from a letter typed to its faults, over the language server
  mutate-text [--count N] [--seed N] [--only ENDING] [--binary FILE]
                                               mutants of the repository's texts through every command
  letters                                      write the letter cases of the C++ runtime anew, as Rust has them
  mutate-log [--only WORD] [--every N] [--output FILE]
                                               every change of an event in logs of generated systems, seen by `conform`
  tidy                                         the house rules";

fn main() -> ExitCode {
    let mut words: Vec<String> = std::env::args().skip(1).collect();
    if words.is_empty() {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    }
    let command = words.remove(0);
    let result = match command.as_str() {
        "corpus" => corpus::run(&words),
        "bench" => bench::run(&words),
        "fuzz" => fuzz::run(&words),
        "keystrokes" => keystrokes::run(&words),
        "mutate-text" => mutate_text::run(&words),
        "letters" => letters::run(&words),
        "mutate-log" => mutate_log::run(&words),
        "tidy" => tidy::run(&words),
        corpus::WORKER => corpus::work(&words),
        _ => Err(format!("there is no command `{command}`\n{USAGE}")),
    };
    match result {
        Ok(Outcome::Good) => ExitCode::SUCCESS,
        Ok(Outcome::AtFault) => ExitCode::from(1),
        Err(reason) => {
            eprintln!("xtask {command}: {reason}");
            ExitCode::from(2)
        }
    }
}
