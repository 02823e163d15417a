//! Proves properties of a chart's system on a part of it that is enough, whatever the rest does.
//!
//! In: what is asked about machines. Out: the properties that hold of a part, which then need not be asked of the whole. A part has few
//! states where the whole has too many. INVARIANT: only invariants and formulas of LTL are proved so, and only if they speak of nothing but
//! what the part keeps: then each run of the system is one of the part. What is violated in a part says nothing of the system.

use std::collections::BTreeSet;
use std::io::Write;
use std::sync::Arc;
use std::time::{Duration, Instant};

use groundstate::inputs::Scalar;
use groundstate::inputs::verification::Verification;
use groundstate::job::{self, Cancel, VerifyEvent};
use groundstate::verify::{NoSolvers, Options, Outcome, Request, Subject, Verdict};
use groundstate::{Loaded, Overlay, ReducedSystem, Said, words};
use program::{FunctionKind, Program, PropertyKind, Term};
use syntax::Sources;

use super::beside::beside;
use super::tell::Teller;
use super::{Arguments, Engine, OPTIONS, Storage, conflict};
use crate::failure::Failure;
use crate::interrupt;
use crate::shell::Shell;

/// LIMIT: states of one part. What takes more is asked of the whole.
const STATES: u64 = 400_000;
/// LIMIT: how many times a part is widened.
const WIDENINGS: usize = 16;

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
    if !said.bounds.is_empty() || said.fair.is_some() {
        return Ok(Vec::new());
    }
    let asked = asked(arguments, &said);
    if asked.is_empty() {
        return Ok(Vec::new());
    }
    let Some(timing) = names_of_timing(shell, arguments)? else { return Ok(Vec::new()) };
    let until = arguments.bounded.time.map(|seconds| Instant::now() + Duration::from_secs(seconds) / 2);
    let mut proved = Vec::new();
    for (kind, text) in asked {
        let spoken: BTreeSet<&str> = words(&text).collect();
        if spoken.iter().any(|word| timing.contains(*word)) || interrupt::request().is_raised() {
            continue;
        }
        let asking = Asking { arguments, said: &said, timing: &timing, kind, text: &text, until };
        if asking.proves(shell, &|name| spoken.contains(name))? {
            proved.push((kind, text));
        }
    }
    Ok(proved)
}

/// The kinds of properties, as a file has them.
const KINDS: [PropertyKind; 3] = [PropertyKind::Invariant, PropertyKind::Ctl, PropertyKind::Ltl];
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

/// The names of tasks, phases, channels and patterns: a part has not all of them, so what speaks of them is asked of the whole. None if the
/// chart has faults, which are told when it is loaded.
fn names_of_timing(shell: &Shell, arguments: &Arguments) -> Result<Option<BTreeSet<String>>, Failure> {
    let mut disk = shell.disk();
    let root = disk.root(&arguments.model)?;
    let Ok(bare) = groundstate::verified_system(root, &[], &|_| false, &mut disk) else { return Ok(None) };
    let Loaded { model, sources, .. } = &bare.loaded;
    let is_timing = |span: syntax::Span| !sources.file(span.file).name.starts_with("<std>");
    let functions = model.functions.iter().filter(|function| !function.library && is_timing(function.span));
    let mut names: BTreeSet<String> = functions.map(|function| function.name.clone()).collect();
    let domains = model.domains.iter().filter(|(_, domain)| domain.span.is_some_and(is_timing));
    names.extend(domains.filter_map(|(_, domain)| domain.name.clone()));
    // A part has fewer agents, too.
    names.insert("Agent".to_string());
    Ok(Some(names))
}

/// One property that is asked.
struct Asking<'a> {
    arguments: &'a Arguments,
    said: &'a Verification,
    timing: &'a BTreeSet<String>,
    kind: usize,
    text: &'a str,
    until: Option<Instant>,
}

impl Asking<'_> {
    /// Whether it holds of some part.
    fn proves(&self, shell: &mut Shell, speaks_of: &dyn Fn(&str) -> bool) -> Result<bool, Failure> {
        for widenings in 0..=WIDENINGS {
            let mut disk = shell.disk();
            let root = disk.root(&self.arguments.model)?;
            let libraries: &[&str] = if self.kind == LTL { &["LTLLibrary"] } else { &[] };
            let part = groundstate::reduced_system(root, libraries, speaks_of, widenings, &mut disk);
            let Ok(Some(part)) = part else { return Ok(false) };
            let mut is_searched = false;
            for loaded in part.system.general.iter().chain([&part.system.loaded]) {
                match self.search(shell, &part, loaded)? {
                    Searched::Holds => return Ok(true),
                    Searched::NotHere => is_searched = true,
                    Searched::TooLarge => {}
                    Searched::NotAsked => return Ok(false),
                }
            }
            // A wider part is larger.
            if !is_searched {
                return Ok(false);
            }
        }
        Ok(false)
    }

    fn search(&self, shell: &mut Shell, part: &ReducedSystem, loaded: &Loaded) -> Result<Searched, Failure> {
        let mut asked = loaded.overlay();
        // What is the system's own is asked of the whole; that tasks do not work for ever is assumed here, too.
        let own = [PropertyKind::Invariant, PropertyKind::Ctl, PropertyKind::Ltl];
        Arc::make_mut(&mut asked.program).properties.retain(|property| !own.contains(&property.kind));
        for text in self.assumed(part, &asked) {
            if asked.property(PropertyKind::Invar, "--assume", text).is_err() {
                return Ok(Searched::NotAsked);
            }
        }
        let index = asked.program.properties.len();
        if asked.property(KINDS[self.kind], OPTIONS[self.kind], self.text).is_err() {
            return Ok(Searched::NotAsked);
        }
        let formula = &asked.program.properties[index].formula;
        if !is_within(&asked.program, formula, part) {
            return Ok(Searched::NotAsked);
        }
        let is_there = |name: &&String| loaded.model.functions.iter().any(|function| function.name == **name);
        let given = self.arguments.bounded.undefined.iter();
        let file: Vec<String> = self.said.undefined.iter().map(|name| (**name).to_string()).collect();
        let undefined = part.undefined.iter().chain(given).chain(&file).filter(is_there).cloned().collect();
        let bounded = super::Bounded { undefined, spec: None, ..self.arguments.bounded.clone() };
        let (options, mut watch) = bounded.options(shell, &asked.program, &Verification::default())?;
        let processors = std::thread::available_parallelism().map_or(1, usize::from);
        let workers = self.arguments.workers.map_or(processors, |workers| workers as usize);
        let options = Options { workers, max_states: options.max_states.min(STATES), ..options };
        let request = Request::of(&asked.program, options).build().map_err(conflict::conflict)?;
        let job = job::verify(request, Cancel::new(), NoSolvers, job::NO_KEEPER, || false);
        let job = job.map_err(|error| Failure::usage(format!("the search cannot be started: {error}")))?;
        let is_up = || self.until.is_some_and(|until| Instant::now() > until) || interrupt::request().is_raised();
        while let Some(event) = job.next_event() {
            if let VerifyEvent::Progress(progress) = event
                && (!watch.at(&progress) || is_up())
            {
                job.cancel().cancel();
            }
        }
        let (outcome, _) = job.finish().unwrap_or_else(|crashed| panic!("{}", crashed.0));
        watch.hide();
        let Ok(mut report) = outcome else { return Ok(Searched::NotAsked) };
        report.verdicts.retain(|verdict: &Verdict| verdict.subject == Subject::Property(index));
        report.unreachable.clear();
        let searched = match report.verdicts.first().map(|verdict| &verdict.outcome) {
            Some(Outcome::Holds) => Searched::Holds,
            // It may also have no truth value where something may be anything.
            Some(_) if report.complete => Searched::NotHere,
            _ => Searched::TooLarge,
        };
        if matches!(searched, Searched::Holds) {
            if shell.talks() {
                let names = part.components.join(", ");
                writeln!(
                    shell.out(),
                    "proved of a part that is enough: what the machines of {names} decide, whatever else comes"
                )?;
            }
            let teller = Teller::new(&asked.program, &asked.sources, false);
            teller.report(shell, &report, &BTreeSet::new())?;
        }
        Ok(searched)
    }

    /// The assumptions that speak of nothing but what the part keeps; without the others, more is proved.
    fn assumed(&self, part: &ReducedSystem, asked: &Overlay) -> Vec<Said<'_>> {
        let all = super::assumed(self.arguments, self.said).into_iter();
        let is_about = |said: &Said<'_>| {
            let mut tried = asked.clone();
            !words(said.text()).any(|word| self.timing.contains(word))
                && tried.property(PropertyKind::Invar, "--assume", *said).is_ok()
                && tried.program.properties.last().is_some_and(|last| is_within(&tried.program, &last.formula, part))
        };
        all.filter(is_about).collect()
    }
}

/// What came of a search in a part.
enum Searched {
    Holds,
    /// It does not hold, or has no truth value, in a part in which more happens than in the system.
    NotHere,
    TooLarge,
    /// The part has no words for it.
    NotAsked,
}

/// Whether a term reads nothing but what a part keeps.
fn is_within(program: &Program, expression: &program::Expression, part: &ReducedSystem) -> bool {
    let mut open = vec![expression.body];
    let mut entered = BTreeSet::new();
    while let Some(id) = open.pop() {
        if let Term::Read { function, .. } | Term::Define { function, .. } = program.term(id) {
            let declared = program.function(*function);
            let is = |name: &String| *name == declared.name;
            match &declared.definition {
                _ if part.free.iter().any(is) => return false,
                _ if part.system.data.iter().any(is) => {}
                Some(definition) => {
                    if entered.insert(*function) {
                        open.push(definition.body);
                    }
                }
                None if declared.kind == FunctionKind::Static => {}
                None => return false,
            }
        }
        program.each_child_of_term(id, &mut |child| open.push(child));
    }
    true
}
