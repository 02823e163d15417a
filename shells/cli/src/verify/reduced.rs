//! Proves properties of a chart's system on parts of it, before they are asked of the whole ([`groundstate::SystemParts`]).
//!
//! In: what is asked about machines, by the command line or by the file beside the chart. Out: the properties that hold of a part, told; they need
//! not be asked of the whole.

use std::collections::BTreeSet;
use std::io::Write;
use std::time::{Duration, Instant};

use groundstate::inputs::Scalar;
use groundstate::inputs::verification::Verification;
use groundstate::job::Cancel;
use groundstate::verify::{NoSolvers, Options, Report, Request};
use groundstate::{PartQuestion, PartSearch, ProofOnPart, SystemParts};
use program::PropertyKind;
use syntax::Sources;

use super::beside::beside;
use super::tell::Teller;
use super::{Arguments, Bounded, Engine, OPTIONS, Storage, aside, assumed, conflict};
use crate::failure::Failure;
use crate::interrupt;
use crate::shell::Shell;

/// LIMIT: states of one part. What takes more is asked of the whole.
const STATES: u64 = 400_000;

/// A property that was proved: the place of its kind among those of a file, and its text.
pub type Proved = (usize, String);

/// Proves what can be proved on parts; returns what was proved. Takes half of the time that is allowed.
pub fn prove(shell: &mut Shell, arguments: &Arguments) -> Result<Vec<Proved>, Failure> {
    let plain = matches!((arguments.engine, arguments.storage), (Engine::Auto, Storage::Exact))
        && !arguments.data
        && arguments.checkpoint.is_none()
        && arguments.disk.is_none()
        && arguments.fair.is_none()
        && arguments.bounded.depth.is_none()
        && arguments.bounded.bounds.is_empty();
    if !plain {
        return Ok(Vec::new());
    }
    // The file's faults are told when it is read for the whole system.
    let named = arguments.bounded.spec.as_deref();
    let mut quiet = Sources::default();
    let Some(said) = beside(shell, &mut quiet, named, &arguments.model)? else { return Ok(Vec::new()) };
    let asked = asked(arguments, &said);
    if !said.bounds.is_empty() || said.fair.is_some() || asked.is_empty() {
        return Ok(Vec::new());
    }
    let mut disk = shell.disk();
    let root = disk.root(&arguments.model)?;
    let Some(parts) = SystemParts::of(root, &mut disk) else { return Ok(Vec::new()) };
    let undefined = said.undefined.iter().map(|name| (**name).to_string());
    let undefined: Vec<String> = undefined.chain(arguments.bounded.undefined.iter().cloned()).collect();
    let until = arguments.bounded.time.map(|seconds| Instant::now() + Duration::from_secs(seconds) / 2);
    let mut proved = Vec::new();
    for (kind, text) in asked {
        if interrupt::request().is_raised() {
            break;
        }
        let question = PartQuestion {
            kind: if kind == LTL { PropertyKind::Ltl } else { PropertyKind::Invariant },
            shown: OPTIONS[kind],
            text: &text,
            assumptions: assumed(arguments, &said),
            undefined: undefined.clone(),
        };
        let search = &mut |part: PartSearch<'_>| search(shell, arguments, part, until);
        if let Some(proof) = parts.prove(&question, &mut disk, search)? {
            tell(shell, &proof)?;
            proved.push((kind, text));
        }
    }
    Ok(proved)
}

/// The places of the kinds that are proved on parts, among those of a file.
const INVARIANT: usize = 0;
const LTL: usize = 2;

/// The invariants and formulas of LTL that are asked, each once.
fn asked(arguments: &Arguments, said: &Verification) -> Vec<Proved> {
    let mut all = Vec::new();
    for (kind, own) in [(INVARIANT, &arguments.invariants), (LTL, &arguments.ltl)] {
        let file = said.properties[kind].iter().map(|scalar: &Scalar| (**scalar).to_string());
        for text in file.chain(own.iter().cloned()) {
            if !all.contains(&(kind, text.clone())) {
                all.push((kind, text));
            }
        }
    }
    all
}

/// Searches a part, until the time is up or it has too many states.
fn search(
    shell: &Shell,
    arguments: &Arguments,
    part: PartSearch<'_>,
    until: Option<Instant>,
) -> Result<Option<Report>, Failure> {
    let program = &part.asked.program;
    let bounded = Bounded { undefined: part.undefined, spec: None, ..arguments.bounded.clone() };
    let (options, mut watch) = bounded.options(shell, program, &Verification::default())?;
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    let workers = arguments.workers.map_or(processors, |workers| workers as usize);
    let options = Options { workers, max_states: options.max_states.min(STATES), ..options };
    let request = Request::of(program, options).build().map_err(conflict::conflict)?;
    let is_up = || until.is_some_and(|until| Instant::now() > until) || interrupt::request().is_raised();
    Ok(aside::search(request, NoSolvers, Cancel::new(), &mut watch, &is_up)?.ok())
}

fn tell(shell: &mut Shell, proof: &ProofOnPart) -> Result<(), Failure> {
    if shell.talks() {
        let names = proof.components.join(", ");
        writeln!(
            shell.out(),
            "proved of a part that is enough: what the machines of {names} decide, whatever else comes"
        )?;
    }
    let teller = Teller::new(&proof.asked.program, &proof.asked.sources, false);
    teller.report(shell, &proof.report, &BTreeSet::new())?;
    Ok(())
}
