//! Verifies a system as its chart draws it: `verify NAME.chart`.
//!
//! In: a chart. Out: the model to search; counterexamples told as what the tasks do, and written as scenarios of the ground model.

use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use groundstate::chart::system::Action;
use groundstate::inputs::verification::Verification;
use groundstate::job::{self, Cancel, VerifyEvent};
use groundstate::tell::{Story, Verdicts};
use groundstate::verify::temporal::fairness::AgentFairness;
use groundstate::verify::{NoSolvers, Options, Outcome, Report, Request, Subject, Trace};
use groundstate::{AgedWay, Overlay, VerifiedSystem, libraries_of, words};
use machine::Limits;
use program::{Expression, Program, PropertyKind};
use syntax::Sources;

use super::beside::beside;
use super::counterexample::{named, with_invariant};
use super::tell::{Scripts, Teller};
use super::watch::Watch;
use super::{Arguments, Engine, Storage, conflict};
use crate::exit::Exit;
use crate::failure::Failure;
use crate::files::{relative, write_text};
use crate::interrupt;
use crate::shell::Shell;

/// Loads a system, and shows its warnings if it `warns`. If it has errors, shows them and returns the exit code.
pub fn load(
    shell: &mut Shell,
    arguments: &Arguments,
    warns: bool,
) -> Result<Result<Box<VerifiedSystem>, Exit>, Failure> {
    let mut disk = shell.disk();
    let root = disk.root(&arguments.model)?;
    // What a file says beside the options; its faults are told when it is read for the loaded model.
    let said = beside(shell, &mut Sources::default(), arguments.bounded.spec.as_deref(), &arguments.model)?;
    let Some(mut said) = said else { return Ok(Err(Exit::World)) };
    arguments.bounded.leave_out_proved(&mut said);
    let libraries = if arguments.ltl.is_empty() { libraries_of(&said) } else { &["LTLLibrary"] };
    let spoken = words_of(arguments, &said);
    let speaks_of = |function: &str| arguments.data || spoken.contains(function);
    match groundstate::verified_system(root, libraries, &speaks_of, &mut disk) {
        Ok(system) if arguments.data && system.machines().0.is_empty() => {
            let help = "a machine is named by `elaborate NAME by MACHINE`";
            Err(Failure::usage_with_help("--data: no component of this chart decides by a machine", help))
        }
        Ok(system) => {
            let (sources, warnings) = &system.warnings;
            if warns {
                shell.diagnostics(sources, warnings)?;
            }
            Ok(Ok(system))
        }
        Err(faults) => {
            for (sources, faults) in &faults {
                shell.diagnostics(sources, faults)?;
            }
            if shell.talks() {
                shell.note(&format!("{} was not verified", arguments.model.display()))?;
            }
            Ok(Err(Exit::Model))
        }
    }
}

/// The words of what is asked and assumed, and the names of inputs.
fn words_of(arguments: &Arguments, said: &Verification) -> BTreeSet<String> {
    let options = [&arguments.invariants, &arguments.ctl, &arguments.ltl, &arguments.assumptions];
    let options = options.into_iter().flatten().chain(&arguments.terminal);
    let inputs = arguments.bounded.bounds.iter().chain(&arguments.bounded.undefined);
    let own = options.chain(inputs).flat_map(|text| words(text)).map(str::to_string);
    groundstate::words_of(said).into_iter().chain(own).collect()
}

/// Says what the verdicts are about.
pub fn about(shell: &mut Shell, system: &VerifiedSystem) -> Result<(), Failure> {
    if !shell.talks() {
        return Ok(());
    }
    let (within, without) = system.machines();
    let components = system.chart.system.iter().flat_map(|system| &system.components).collect::<Vec<_>>();
    let names = within.iter().map(|machine| components[machine.component].name.as_str()).collect::<Vec<_>>();
    let subject = match names.join(", ") {
        _ if system.data.is_empty() => {
            "times, locks and channels as drawn; what elaborations compute is left out".to_string()
        }
        names if names.is_empty() => "times, locks, channels and their data as drawn".to_string(),
        names => format!("times, locks and channels as drawn, with what the machines of {names} decide"),
    };
    let phases = components.iter().flat_map(|component| &component.phases);
    let by_rule =
        !system.data.is_empty() && phases.into_iter().any(|phase| matches!(phase.action, Action::Elaborate(Some(_))));
    let rules = if by_rule { "; what elaborations compute by rules is left out" } else { "" };
    // How tasks share processors is for `chart times`.
    let processors = system.chart.system.as_ref().and_then(|system| system.processors);
    let alone = if processors.is_some() { "; each task on a processor of its own" } else { "" };
    writeln!(shell.out(), "of {subject}{rules}{alone}")?;
    let mut files: Vec<&str> = without.iter().map(|machine| machine.source.name.as_str()).collect();
    files.sort_unstable();
    files.dedup();
    if !files.is_empty() {
        let commands: Vec<String> = files.iter().map(|file| format!("`groundstate verify {file}`")).collect();
        let others = if within.is_empty() { "the components'" } else { "the other components'" };
        writeln!(
            shell.out(),
            "left out: what {others} machines decide, of which nothing asks (`--data` does); each by itself: {}",
            commands.join(", ")
        )?;
    }
    Ok(())
}

/// Tells the age bounds that need no search.
pub fn sure_ages(shell: &mut Shell, system: &VerifiedSystem) -> Result<(), Failure> {
    let ground = &system.ground;
    let teller = Teller::new(&ground.program, &ground.sources, false);
    for age in &system.ages {
        let index = ground.program.properties.iter().position(|property| property.name == age.name);
        let Some(index) = index else { unreachable!("the ground model has an invariant for each bound") };
        teller.proved(
            shell,
            Subject::Property(index),
            format!("by the responses of its tasks, at most {}", age.most),
        )?;
    }
    Ok(())
}

/// Refuses what is asked about functions that a verified model does not keep.
pub fn refuse(
    system: &VerifiedSystem,
    asked: &Overlay,
    own: usize,
    terminal: Option<&Expression>,
) -> Result<(), Failure> {
    let properties = asked.program.properties[own..].iter().map(|property| (property.name.as_str(), &property.formula));
    for (name, formula) in properties.chain(terminal.map(|term| ("--terminal", term))) {
        if let Some(reason) = groundstate::refusal(&asked.program, formula, &system.data) {
            let help =
                "ask about phases, locks, queues, what is pending or fresh; or verify the model of `chart build`";
            return Err(Failure::usage_with_help(format!("`{name}` {reason}"), help));
        }
    }
    Ok(())
}

/// What is sought.
pub struct Sought<'a> {
    pub arguments: &'a Arguments,
    pub options: &'a Options,
    pub agents: Option<AgentFairness>,
}

/// What came of the search in which asynchronous elaborations take any time.
pub enum General {
    /// Everything holds, or the user has had enough.
    Decided(Exit),
    /// These checks hold; the others are still to be decided.
    Open(Proved, Watch),
}

/// LIMIT: states of the search in which asynchronous elaborations take any time. Where times vary little, there may be more of them
/// than as drawn.
const GENERAL: u64 = 500_000;

/// Lets asynchronous elaborations take any time: what holds then holds, and mostly the states are far fewer. Takes half of the time that
/// is allowed, so that the times as they are drawn have the other half.
pub fn general(
    shell: &mut Shell,
    system: &VerifiedSystem,
    sought: &Sought<'_>,
    mut watch: Watch,
) -> Result<General, Failure> {
    let Sought { arguments, options, agents } = sought;
    let plain = matches!((arguments.engine, arguments.storage), (Engine::Auto, Storage::Exact))
        && arguments.checkpoint.is_none()
        && arguments.disk.is_none()
        && arguments.bounded.depth.is_none();
    let Some(general) = system.general.as_ref().filter(|_| plain) else {
        return Ok(General::Open(Proved::new(), watch));
    };
    let Some((mut asked, beside, terminal)) = super::ask(shell, arguments, general)? else {
        return Ok(General::Decided(Exit::World));
    };
    let options = Options { terminal, max_states: options.max_states.min(GENERAL), ..(*options).clone() };
    let until = arguments.bounded.time.map(|seconds| Instant::now() + Duration::from_secs(seconds) / 2);
    let own = general.program.properties.len();
    // That some run does a thing may be true only of times that the system does not have: a formula of CTL may ask for that.
    // Ages are those of the times as they are drawn, too.
    let mut left_out = leave_out(&mut asked, own, &|kind| kind == PropertyKind::Ctl);
    let mut searched = search(&asked.program, &options, *agents, (&mut watch, until))?;
    // What was asked may need the times as they are drawn; the rest may not.
    if matches!(searched, Searched::Violated(Subject::Property(index)) if index >= own) {
        left_out |= leave_out(&mut asked, own, &|kind| kind != PropertyKind::Invar);
        searched = search(&asked.program, &options, *agents, (&mut watch, until))?;
    }
    let Searched::Complete(mut report) = searched else { return Ok(General::Open(Proved::new(), watch)) };
    let words = Verdicts::new(&asked.program, &asked.sources, false);
    let hold = report.verdicts.iter().filter(|verdict| matches!(verdict.outcome, Outcome::Holds));
    let mut proved: Proved = hold.map(|verdict| (check(&words, verdict.subject), ANY_LENGTH)).collect();
    let all_hold = proved.len() == report.verdicts.len();
    let drawn = system.chart.system.as_ref();
    let bounds = drawn.map_or(0, |drawn| drawn.bounds.len()) - system.ages.len();
    let ages = if bounds > 0 { aged(shell, sought, &mut watch)? } else { Vec::new() };
    let name = |aged: &Aged| aged.way.loaded.program.properties[0].name.clone();
    proved.extend(ages.iter().map(|aged| ((Some(PropertyKind::Invariant), name(aged)), EACH_WAY)));
    left_out |= ages.len() < bounds || drawn.is_some_and(|drawn| drawn.has_fresh_bounds());
    if !all_hold || left_out {
        watch.hide();
        return Ok(General::Open(proved, watch));
    }
    watch.done();
    report.unreachable.clear();
    if shell.talks() {
        writeln!(shell.out(), "proved {ANY_LENGTH}")?;
    }
    let teller = Teller::new(&asked.program, &asked.sources, false);
    teller.assumed(shell, &super::assumed(arguments, &beside))?;
    teller.report(shell, &report, &BTreeSet::new())?;
    for Aged { way, report } in &ages {
        let mut teller = Teller::new(&way.loaded.program, &way.loaded.sources, false);
        teller.words.elsewhere.insert(Subject::Property(0), EACH_WAY);
        let verdicts = report.verdicts.iter().filter(|verdict| verdict.subject == Subject::Property(0)).cloned();
        let report = Report { verdicts: verdicts.collect(), unreachable: Vec::new(), ..report.clone() };
        teller.report(shell, &report, &BTreeSet::new())?;
    }
    Ok(General::Decided(Exit::Good))
}

/// An age bound that was proved: the way of which the search had most states, and that search.
struct Aged {
    way: AgedWay,
    report: Report,
}

/// LIMIT: states of the search for the ages on one way.
const AGED: u64 = 12_000_000;

const EACH_WAY: &str = "each way by itself, for asynchronous elaborations beside it of any length";

/// Decides which age bounds that need a search hold, on each of their ways by itself. Takes a quarter of the time that is allowed.
fn aged(shell: &mut Shell, sought: &Sought<'_>, watch: &mut Watch) -> Result<Vec<Aged>, Failure> {
    let Sought { arguments, options, .. } = sought;
    let mut disk = shell.disk();
    let root = disk.root(&arguments.model)?;
    let Ok(ways) = groundstate::aged_ways(root, &mut disk) else { return Ok(Vec::new()) };
    let until = arguments.bounded.time.map(|seconds| Instant::now() + Duration::from_secs(seconds) / 4);
    let options = without_data(options, AGED);
    let mut proved: BTreeMap<usize, Option<Aged>> = BTreeMap::new();
    for way in ways {
        if matches!(proved.get(&way.bound), Some(None)) {
            continue;
        }
        let holds = |report: &Report| {
            let own = report.verdicts.iter().filter(|verdict| matches!(verdict.subject, Subject::Property(_)));
            own.clone().count() > 0 && own.clone().all(|verdict| matches!(verdict.outcome, Outcome::Holds))
        };
        let bound = way.bound;
        let aged = match search(&way.loaded.program, &options, None, (&mut *watch, until))? {
            Searched::Complete(report) if holds(&report) => Some(Aged { way, report: *report }),
            _ => None,
        };
        let states = |aged: &Option<Aged>| aged.as_ref().map(|aged| aged.report.progress.states);
        match proved.remove(&bound) {
            Some(other) if aged.is_some() && states(&other) >= states(&aged) => _ = proved.insert(bound, other),
            _ => _ = proved.insert(bound, aged),
        }
    }
    Ok(proved.into_values().flatten().collect())
}

/// Takes properties of these kinds out of what was asked; returns whether there were any. The model's own stay.
fn leave_out(asked: &mut Overlay, own: usize, out: &dyn Fn(PropertyKind) -> bool) -> bool {
    let properties = &mut Arc::make_mut(&mut asked.program).properties;
    let asked = properties.split_off(own);
    let before = asked.len();
    properties.extend(asked.into_iter().filter(|property| !out(property.kind)));
    properties.len() < own + before
}

/// LIMIT: states of the search without what machines decide.
const TIMING: u64 = 500_000;

const ANY_LENGTH: &str = "for asynchronous elaborations of any length";

/// Decides what holds of times, locks and channels, whatever machines decide: with that, there may be too many states. Takes a quarter of
/// the time that is allowed.
pub fn timing(
    shell: &mut Shell,
    system: &VerifiedSystem,
    sought: &Sought<'_>,
    watch: &mut Watch,
    known: &Proved,
    assumes: bool,
) -> Result<Proved, Failure> {
    let Sought { arguments, options, agents } = sought;
    let plain = matches!((arguments.engine, arguments.storage), (Engine::Auto, Storage::Exact))
        && arguments.checkpoint.is_none()
        && arguments.disk.is_none()
        && arguments.bounded.depth.is_none();
    if system.machines().0.is_empty() || !plain {
        return Ok(Proved::new());
    }
    let mut disk = shell.disk();
    let root = disk.root(&arguments.model)?;
    let Ok(bare) = groundstate::verified_system(root, &[], &|_| false, &mut disk) else { return Ok(Proved::new()) };
    let until = arguments.bounded.time.map(|seconds| Instant::now() + Duration::from_secs(seconds) / 4);
    let options = without_data(options, TIMING);
    let mut proved = Proved::new();
    for (loaded, more) in bare.general.iter().map(|general| (general, ANY_LENGTH)).chain([(&bare.loaded, WHATEVER)]) {
        let words = Verdicts::new(&loaded.program, &loaded.sources, false);
        let properties = (0..loaded.program.properties.len()).map(Subject::Property);
        let is_known = |subject: Subject| {
            let check = check(&words, subject);
            known.contains_key(&check) || proved.contains_key(&check)
        };
        if properties.into_iter().all(is_known) {
            break;
        }
        // What is violated is told of the system with its data.
        if let Searched::Complete(report) = search(&loaded.program, &options, *agents, (&mut *watch, until))? {
            let hold = report.verdicts.iter().filter(|verdict| matches!(verdict.outcome, Outcome::Holds));
            // Runs may end where an assumption leaves no step, so that something never comes.
            let is_told = |subject: &Subject| match subject {
                Subject::Property(index) => {
                    !assumes || loaded.program.properties[*index].kind == PropertyKind::Invariant
                }
                _ => false,
            };
            let own = hold.map(|verdict| verdict.subject).filter(is_told);
            for check in own.map(|subject| check(&words, subject)).collect::<Vec<Check>>() {
                proved.entry(check).or_insert(more);
            }
        }
    }
    Ok(proved)
}

/// The options of a search without machines, of at most so many states. Inputs are those of machines.
fn without_data(options: &Options, states: u64) -> Options {
    Options {
        terminal: None,
        bounds: Default::default(),
        undefined: Default::default(),
        max_states: options.max_states.min(states),
        ..options.clone()
    }
}

/// That of machines which are left out, none changes when tasks run.
const WHATEVER: &str = "whatever the machines decide";

/// Checks that hold by another search, and of what more it was.
pub type Proved = BTreeMap<Check, &'static str>;

/// A check, whatever its number among the properties: its kind and its name.
pub type Check = (Option<PropertyKind>, String);

/// The check of a subject.
pub fn check(words: &Verdicts<'_>, subject: Subject) -> Check {
    let kind = match subject {
        Subject::Property(index) => Some(words.program.properties[index].kind),
        _ => None,
    };
    (kind, words.name(subject))
}

/// What came of a search.
enum Searched {
    Complete(Box<Report>),
    Violated(Subject),
    Not,
}

/// Searches until a check is violated, or the time is up.
fn search(
    program: &Arc<Program>,
    options: &Options,
    agents: Option<AgentFairness>,
    (watch, until): (&mut Watch, Option<Instant>),
) -> Result<Searched, Failure> {
    let request = Request::of(program, options.clone()).fair(agents).build().map_err(conflict::conflict)?;
    // A handle of its own: another search follows.
    let job = job::verify(request, Cancel::new(), NoSolvers, job::NO_KEEPER, || true);
    let job = job.map_err(|error| Failure::usage(format!("the search cannot be started: {error}")))?;
    let mut violated = None;
    let is_up = || until.is_some_and(|until| Instant::now() > until) || interrupt::request().is_raised();
    while let Some(event) = job.next_event() {
        match event {
            VerifyEvent::Progress(progress) if watch.at(&progress) && !is_up() => {}
            VerifyEvent::Progress(_) => job.cancel().cancel(),
            VerifyEvent::Violated(subject, _) => {
                violated = Some(subject);
                job.cancel().cancel();
            }
        }
    }
    let (outcome, _) = job.finish().unwrap_or_else(|crashed| panic!("{}", crashed.0));
    Ok(match (violated, outcome) {
        (Some(subject), _) => Searched::Violated(subject),
        (None, Ok(report)) if report.complete => Searched::Complete(Box::new(report)),
        (None, _) => Searched::Not,
    })
}

/// Tells a run as what the tasks do.
pub fn story<'a>(system: &'a VerifiedSystem, limits: Limits, asked: (&'a Program, &'a Sources)) -> Story<'a> {
    Story(Box::new(move |subject, trace| match system.tell_run(limits.clone(), asked, subject, trace) {
        Ok(told) => told,
        Err(reason) => format!("  this run could not be made by the ground model: {reason}\n"),
    }))
}

/// The scenario of a counterexample; `model` is what it loads. It gives inputs to machines that were left out, too.
fn script(
    (system, (program, sources)): (&VerifiedSystem, (&Program, &Sources)),
    (subject, trace): (Subject, &Trace),
    limits: &Limits,
    name: &str,
    model: &str,
) -> String {
    let whole = system.whole_run(limits, program, trace);
    let run = match &whole {
        Ok(Some((whole, made))) => (*whole, made),
        Ok(None) | Err(_) => (program, trace),
    };
    let mut text = groundstate::counterexample_scenario(run.0, run.1, subject, &name.replace('-', "_"), model);
    if let Err(reason) = &whole {
        text.push_str(&format!("\n// {reason}\n"));
    }
    match system.scenario_property((program, sources), subject) {
        Some(property) if !system.is_checked(program, subject) => with_invariant(&text, &property),
        _ => text,
    }
}

/// Writes counterexamples as scenarios beside the ground model, which lies beside the chart.
pub fn scripts<'a>(
    chart: &Path,
    system: &'a VerifiedSystem,
    (program, sources): (&'a Program, &'a Sources),
    limits: &'a Limits,
) -> Option<Box<Scripts<'a>>> {
    let file = chart.file_name()?;
    let model = PathBuf::from(file).with_extension("asm").display().to_string();
    Some(Box::new(move |subject, trace| {
        let name = named(program, subject, &mut Vec::new());
        let about = (system, (program, sources));
        // That nothing moves any more is seen in no state of the ground model, whose clock goes on.
        (subject != Subject::NoDeadlock).then(|| script(about, (subject, trace), limits, &name, &model))
    }))
}

/// Writes counterexamples as scenarios of the ground model: the first one to a file, or all of them into a folder.
pub fn write(
    shell: &mut Shell,
    path: &Path,
    chart: &Path,
    system: &VerifiedSystem,
    asked: &Overlay,
    limits: &Limits,
    report: &Report,
) -> Result<(), Failure> {
    let one = path.extension().is_some_and(|ending| ending == "avalla");
    let model = chart.with_extension("asm");
    let (program, mut names, mut written) = (&asked.program, Vec::new(), Vec::new());
    for verdict in &report.verdicts {
        let Outcome::Violated(trace) = &verdict.outcome else { continue };
        // That nothing moves any more is seen in no state of the ground model, whose clock goes on.
        if verdict.subject == Subject::NoDeadlock {
            continue;
        }
        let name = named(program, verdict.subject, &mut names);
        let about = (system, (program.as_ref(), &asked.sources));
        let file = if one { path.to_path_buf() } else { path.join(format!("{name}.avalla")) };
        let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        std::fs::create_dir_all(folder).map_err(|error| Failure::of_file("write", folder, error))?;
        // The model need not be there yet; the chart is.
        let loaded = PathBuf::from(relative(chart, folder)).with_extension("asm").display().to_string();
        write_text(&file, &script(about, (verdict.subject, trace), limits, &name, &loaded))?;
        written.push(file);
        if one {
            break;
        }
    }
    if shell.talks() {
        for file in &written {
            writeln!(shell.out(), "wrote {}", file.display())?;
        }
        if !written.is_empty() && !model.exists() {
            shell.note(&format!("the scenarios load {}, which `groundstate chart build` writes", model.display()))?;
        }
    }
    Ok(())
}
