//! What every command shares: the global options and the output.
//!
//! Text: results on stdout, faults and failures on stderr. JSON: everything on stdout, one object per line, in order.

use std::io::{self, BufWriter, IsTerminal, Write};
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use serde::Serialize;
use syntax::{Diagnostic, Sources};

use crate::failure::Failure;
use crate::files::Disk;
use crate::limits::Limits;
use crate::render;
use crate::sink::Sink;

/// Options of every command.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Output")]
pub struct Global {
    /// How to write results and faults
    #[arg(long, global = true, value_enum, default_value_t = Format::Text)]
    pub format: Format,
    /// When to colour the output
    #[arg(long, global = true, value_enum, default_value_t = Color::Auto)]
    pub color: Color,
    /// Write faults only
    #[arg(long, short, global = true)]
    pub quiet: bool,
    /// Read and write no file outside this folder
    #[arg(long, global = true, value_name = "FOLDER", help_heading = "Limits")]
    pub within: Option<PathBuf>,
    #[command(flatten)]
    pub limits: Limits,
}

/// How results are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// For people
    Text,
    /// One JSON object per line
    Json,
}

/// When to colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Color {
    /// On a terminal, unless NO_COLOR is set
    Auto,
    /// Always
    Always,
    /// Never
    Never,
}

/// The output and the global options.
#[derive(Debug)]
pub struct Shell {
    pub global: Global,
    out: BufWriter<Sink<io::Stdout>>,
    err: Sink<io::Stderr>,
    color_out: bool,
    color_err: bool,
}

/// The largest number of faults shown at once.
const SHOWN: usize = 100;

impl Shell {
    pub fn new(global: Global) -> Shell {
        let wanted = |terminal: bool| match global.color {
            Color::Always => true,
            Color::Never => false,
            Color::Auto => {
                terminal
                    && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
                    && std::env::var_os("TERM").is_none_or(|term| term != "dumb")
            }
        };
        let (color_out, color_err) = (wanted(io::stdout().is_terminal()), wanted(io::stderr().is_terminal()));
        let (out, err) = (Sink::new(io::stdout()), Sink::new(io::stderr()));
        Shell { global, out: BufWriter::with_capacity(1 << 16, out), err, color_out, color_err }
    }

    pub fn json(&self) -> bool {
        self.global.format == Format::Json
    }

    /// Whether to write results as text.
    pub fn talks(&self) -> bool {
        !self.json() && !self.global.quiet
    }

    pub fn color_out(&self) -> bool {
        self.color_out
    }

    pub fn disk(&self) -> Disk {
        Disk { limit: self.global.limits.max_file_size }
    }

    /// The stream for results.
    pub fn out(&mut self) -> &mut impl Write {
        &mut self.out
    }

    pub fn flush(&mut self) -> Result<(), Failure> {
        Ok(self.out.flush()?)
    }

    /// Writes an object on its own line.
    pub fn object(&mut self, object: &impl Serialize) -> Result<(), Failure> {
        write_object(&mut self.out, object)
    }

    /// Writes faults, at most the first hundred.
    pub fn diagnostics(&mut self, sources: &Sources, diagnostics: &[Diagnostic]) -> Result<(), Failure> {
        for diagnostic in diagnostics.iter().take(SHOWN) {
            self.diagnostic(sources, diagnostic)?;
        }
        if diagnostics.len() > SHOWN {
            let more = diagnostics.len() - SHOWN;
            if self.json() {
                self.object(&wire::Answer::More { faults: more })?;
            } else {
                self.note(&format!("and {more} more"))?;
            }
        }
        Ok(())
    }

    /// Writes faults that are the result itself, so to stdout.
    pub fn details(&mut self, sources: &Sources, diagnostics: &[Diagnostic]) -> Result<(), Failure> {
        for diagnostic in diagnostics.iter().take(SHOWN) {
            let text = render::diagnostic(sources, diagnostic, self.color_out);
            writeln!(self.out, "{text}\n")?;
        }
        if diagnostics.len() > SHOWN {
            writeln!(self.out, "and {} more", diagnostics.len() - SHOWN)?;
        }
        Ok(())
    }

    /// Writes one fault.
    pub fn diagnostic(&mut self, sources: &Sources, diagnostic: &Diagnostic) -> Result<(), Failure> {
        if self.json() {
            return self.object(&wire::Fault::new(sources, diagnostic));
        }
        // On a terminal, results written before the fault come before it.
        self.out.flush()?;
        let text = render::diagnostic(sources, diagnostic, self.color_err);
        writeln!(self.err, "{text}\n")?;
        Ok(())
    }

    /// Writes a remark on stderr.
    pub fn note(&mut self, text: &str) -> Result<(), Failure> {
        self.out.flush()?;
        writeln!(self.err, "{text}")?;
        Ok(())
    }

    /// Writes a failure. If that fails too, nobody is left to be informed.
    pub fn report_failure(&mut self, failure: &Failure) {
        if self.json() {
            let object = wire::WorldFailure::new(failure.id(), failure.to_string(), failure.help());
            let _ = write_object(&mut self.out, &object);
            let _ = self.out.flush();
            return;
        }
        let _ = self.out.flush();
        let _ = writeln!(self.err, "{}", render::failure(failure, self.color_err));
    }
}

/// Writes an object on a line of its own.
pub fn write_object(out: &mut impl Write, object: &impl Serialize) -> Result<(), Failure> {
    serde_json::to_writer(&mut *out, object).map_err(|error| Failure::from(io::Error::from(error)))?;
    out.write_all(b"\n")?;
    Ok(())
}
