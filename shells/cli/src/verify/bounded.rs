//! The options that bound a search: its extent, and the values of inputs.

use std::path::{Path, PathBuf};

use clap::Args;
use groundstate::inputs::bound;
use groundstate::inputs::verification::Verification;
use groundstate::verify::Options;
use program::Program;
use syntax::Sources;

use crate::failure::Failure;
use crate::interrupt;
use crate::shell::Shell;
use crate::verify::beside::beside;
use crate::verify::watch::Watch;

/// Bounds of a search.
#[derive(Debug, Clone, Args)]
pub struct Bounded {
    /// The values to try for an input, as NAME=LOW..HIGH or NAME=VALUE,VALUE; may be repeated
    #[arg(long = "bound", value_name = "BOUND")]
    pub bounds: Vec<String>,
    /// An input that may also be undef; may be repeated
    #[arg(long, value_name = "NAME")]
    pub undefined: Vec<String>,
    /// What to verify, and with which inputs. Default: MODEL.verify.yaml beside the model or the chart
    #[arg(long, value_name = "FILE")]
    pub spec: Option<PathBuf>,
    /// The most states
    #[arg(long, value_name = "N", value_parser = crate::limits::count)]
    pub max_states: Option<u64>,
    /// The most steps from an initial state
    #[arg(long, value_name = "N", value_parser = crate::limits::count)]
    pub depth: Option<u64>,
    /// The most memory that the program may take, in MiB
    #[arg(long, value_name = "MIB", default_value_t = 8192)]
    pub max_memory: u64,
    /// The most time, in seconds
    #[arg(long, value_name = "SECONDS", value_parser = crate::limits::count)]
    pub time: Option<u64>,
    /// Properties that were proved already: the place of their kind, and their texts.
    #[arg(skip)]
    pub proved: Vec<(usize, String)>,
}

/// The limits of a survey if none is given: without them, it never ends on infinitely many states.
const STATES: u64 = 1_000_000;
const SECONDS: u64 = 60;

impl Bounded {
    /// The same bounds, with default limits if no limit was given; and whether that is so.
    pub fn with_end(&self) -> (Bounded, bool) {
        let given = self.max_states.is_some() || self.depth.is_some() || self.time.is_some();
        let ends = Bounded { max_states: Some(STATES), time: Some(SECONDS), ..self.clone() };
        if given { (self.clone(), false) } else { (ends, true) }
    }

    /// Says that a default limit was reached.
    pub fn at_end(shell: &mut Shell) -> Result<(), Failure> {
        shell.note(&format!(
            "without a limit, the search stops at {STATES} states or {SECONDS} seconds; --max-states, --depth or --time set another"
        ))
    }

    /// Reads the file beside a model; if it has faults, shows them and returns `None`.
    pub fn beside(
        &self,
        shell: &mut Shell,
        program: &Program,
        sources: &mut Sources,
        model: &Path,
    ) -> Result<Option<Verification>, Failure> {
        let Some(mut read) = beside(shell, sources, self.spec.as_deref(), model)? else { return Ok(None) };
        self.leave_out_proved(&mut read);
        let faults = read.faults(program);
        if faults.is_empty() {
            return Ok(Some(read));
        }
        shell.diagnostics(sources, &faults)?;
        Ok(None)
    }

    /// Takes out of a file what was proved already.
    pub fn leave_out_proved(&self, read: &mut Verification) {
        for (kind, text) in &self.proved {
            read.properties[*kind].retain(|scalar| &**scalar != text.as_str());
        }
    }

    /// Bounds the memory of the process. If it takes more already, only the states are counted.
    fn bound_memory(&self) {
        if interrupt::resident_bytes().is_some_and(|bytes| bytes >> 20 < self.max_memory) {
            interrupt::bound_memory(self.max_memory);
        }
    }

    /// The options of a search, and the watch over it. The file beside the model was found to fit the program.
    pub fn options(
        &self,
        shell: &Shell,
        program: &Program,
        beside: &Verification,
    ) -> Result<(Options, Watch), Failure> {
        let mut bounds =
            bound::read(program, &beside.bounds).map_err(|refused| Failure::usage(format!("bound {refused}")))?;
        let wrong = |refused| Failure::usage_with_help(format!("--bound {refused}"), bound::HELP);
        bounds.extend(bound::read(program, &self.bounds).map_err(wrong)?);
        let mut undefined = bound::undefined(program, &beside.undefined)
            .map_err(|refused| Failure::usage(format!("undefined {refused}")))?;
        let wrong = |refused| Failure::usage(format!("--undefined {refused}"));
        undefined.extend(bound::undefined(program, &self.undefined).map_err(wrong)?);
        let options = Options {
            limits: shell.global.limits.uninterrupted(),
            max_states: self.max_states.unwrap_or(u64::MAX),
            max_depth: self.depth.unwrap_or(u64::MAX),
            max_bytes: self.max_memory.saturating_mul(1 << 20),
            bounds,
            undefined,
            interrupt: interrupt::request().clone(),
            ..Options::default()
        };
        interrupt::listen();
        self.bound_memory();
        Ok((options, Watch::new(self.time, shell.global.quiet || shell.json())))
    }
}
