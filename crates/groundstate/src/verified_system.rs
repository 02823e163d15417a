//! The model that verifies a chart's system, ready for `verify`, and its counterexamples as runs of the ground model.
//!
//! In: a chart's text and a [`Loader`]. Out: two loaded models: the verified one, which is made of the chart alone, and the ground
//! model that `chart build` makes, which is what the verdicts are about. INVARIANT: both use the same modules of the pattern library,
//! those that the chart imports; and nothing of what a user's rules compute is part of either, nor of what machines decide on which
//! nothing rests that is asked about, so that no property can speak of what is not computed.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::sync::Arc;

use chart::system::{AgeBound, length};
use chart::{Chart, ComponentMachine, Known, Lengths, times};
use conform::Events;
use machine::{Choice, Closed, Environment, Limits, Location, LocationRef, Show, TimeUnit, Value};
use model::Loader;
use program::{DomainId, Expression, FunctionKind, Program, PropertyKind, Term};
use syntax::{FileId, Parse, SourceFile, Sources, Stop};
use verify::{Subject, Trace};

use crate::build::Located;
use crate::picked::Picked;
use crate::simulate::read_value;
use crate::whole_run::whole_run;
use crate::{Loaded, has_errors, load, patterns};

/// A system to verify.
#[derive(Debug)]
pub struct VerifiedSystem {
    /// The chart.
    pub chart: Chart,
    /// The part of it that is verified.
    part: Chart,
    /// The functions of machines, sensors and actuators that a property may speak of.
    pub data: Vec<String>,
    /// The model to search.
    pub loaded: Loaded,
    /// The same, with elaborations of asynchronous components that take any time. What holds of it holds of `loaded`, and it has far
    /// fewer states. None without such elaborations.
    pub general: Option<Loaded>,
    /// The age bounds that need no search, and are no part of these models.
    pub ages: Vec<SureAge>,
    /// The warnings of the chart.
    pub warnings: Located,
    /// The ground model of the same chart, without what elaborations compute; with data, with what machines decide.
    pub ground: Loaded,
    /// That of the whole chart, if machines are left out.
    whole: Option<Loaded>,
}

/// An age bound that holds by the responses of the tasks.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SureAge {
    /// The name of its invariant in the ground model.
    pub name: String,
    /// The greatest age that is possible.
    pub most: String,
}

const VERIFICATION: &str = "verification/";

/// Makes the model that verifies the system of a chart. Its formulas may use the operators of these `libraries`, besides those of CTL. What
/// machines decide is a part of it, as far as a function rests on it that properties speak of.
///
/// # Errors
/// The faults of the chart and of its imports, grouped by their texts. At least one of them is an error.
pub fn verified_system(
    root: SourceFile,
    libraries: &[&str],
    speaks_of: &dyn Fn(&str) -> bool,
    loader: &mut dyn Loader,
) -> Result<Box<VerifiedSystem>, Vec<Located>> {
    let verifiable = Verifiable::load(root, loader)?;
    let part = chart::verifiable(&verifiable.chart, speaks_of);
    verifiable.with(part, libraries, loader)
}

/// A part of a system that is enough for a property if the property holds of it: see [`chart::reduced`].
#[derive(Debug)]
pub struct ReducedSystem {
    /// The part, as a system.
    pub system: Box<VerifiedSystem>,
    /// The inputs that stand for what was left free.
    pub free: Vec<String>,
    /// Those of them that may be undef.
    pub undefined: Vec<String>,
    /// The components whose machines are a part of it.
    pub components: Vec<String>,
}

/// Makes the model that verifies a part of a chart's system: what the functions are that are spoken of, and `widenings` times what they rest
/// on. None if nothing is left out then.
///
/// # Errors
/// As [`verified_system`].
pub fn reduced_system(
    root: SourceFile,
    libraries: &[&str],
    speaks_of: &dyn Fn(&str) -> bool,
    widenings: usize,
    loader: &mut dyn Loader,
) -> Result<Option<ReducedSystem>, Vec<Located>> {
    let verifiable = Verifiable::load(root, loader)?;
    let Some(reduced) = chart::reduced(&verifiable.chart, speaks_of, widenings) else { return Ok(None) };
    let chart::Reduced { mut chart, free, undefined, components } = reduced;
    // Ages are asked of the whole.
    if let Some(system) = &mut chart.system {
        system.bounds.clear();
    }
    let system = verifiable.with(chart, libraries, loader)?;
    Ok(Some(ReducedSystem { system, free, undefined, components }))
}

/// A way of an age bound, to verify by itself.
#[derive(Debug)]
pub struct AgedWay {
    /// The number of the bound in the chart.
    pub bound: usize,
    /// The model to search. Its only property says that no datum comes too old on this way, and has the name that the bound's has in the
    /// model of the whole system.
    pub loaded: Loaded,
}

/// The model that verifies a system as drawn with all its age bounds, also those that hold without a search: who looks for a run against
/// one of these needs it.
///
/// # Errors
/// As [`verified_system`].
pub fn aged_system(root: SourceFile, loader: &mut dyn Loader) -> Result<Option<Loaded>, Vec<Located>> {
    let verifiable = Verifiable::load(root, loader)?;
    let part = chart::verifiable(&verifiable.chart, &|_| false);
    let text = chart::verified(&part, &[], Lengths::AsDrawn);
    let Some((text, library)) = text.zip(chart::library(&part)) else { return Ok(None) };
    load_with(&library, format!("{}{}InTicks.asm", verifiable.folder, verifiable.chart.name), text, loader).map(Some)
}

/// The ways of a system's age bounds that need a search, each with a model in which asynchronous elaborations beside it take any time: what holds of the
/// ages there holds of the system, and there are far fewer states than where all times count. What machines decide is left out: it changes
/// no time.
///
/// # Errors
/// As [`verified_system`].
pub fn aged_ways(root: SourceFile, loader: &mut dyn Loader) -> Result<Vec<AgedWay>, Vec<Located>> {
    let verifiable = Verifiable::load(root, loader)?;
    let part = chart::verifiable(&verifiable.chart, &|_| false);
    let Some((system, library)) = part.system.as_ref().zip(chart::library(&part)) else { return Ok(Vec::new()) };
    let mut found = Vec::new();
    let sure = times::surely_within(system);
    let open = system.bounds.iter().enumerate().filter(|(bound, _)| sure[*bound].is_none());
    for (bound, stated) in open {
        for way in 0..chart::ways::followed(system, stated).len() {
            let Some(text) = chart::verified(&part, &[], Lengths::AnyBeside { bound, way }) else {
                unreachable!("it has a system and a library")
            };
            let name = format!("{}{}InTicks.asm", verifiable.folder, verifiable.chart.name);
            let mut loaded = load_with(&library, name, text, loader)?;
            let program = Arc::make_mut(&mut loaded.program);
            program.properties.retain(|property| property.name == stated.invariant());
            found.push(AgedWay { bound, loaded });
        }
    }
    Ok(found)
}

/// The age bounds of a chart's system that hold by the responses of its tasks.
fn sure_ages(chart: &Chart) -> Vec<SureAge> {
    let Some(system) = &chart.system else { return Vec::new() };
    let told = |(bound, most): (&AgeBound, Option<u64>)| {
        Some(SureAge { name: bound.invariant(), most: length(most? as i64, system.tick_ns) })
    };
    system.bounds.iter().zip(times::surely_within(system)).filter_map(told).collect()
}

/// A chart whose system can be verified.
struct Verifiable {
    chart: Chart,
    known: Known,
    folder: String,
    warnings: Located,
}

impl Verifiable {
    fn load(root: SourceFile, loader: &mut dyn Loader) -> Result<Verifiable, Vec<Located>> {
        let chart::Loaded { sources, mut chart, diagnostics } = chart::load(root.clone(), loader);
        if has_errors(&diagnostics) {
            return Err(vec![(sources, diagnostics)]);
        }
        let folder = root.name.rfind(['/', '\\']).map_or("", |end| &root.name[..=end]).to_string();
        let known = match Known::completed(&mut chart, &format!("{folder}Imports.asm"), loader) {
            Ok(known) => known,
            Err(unknown) => return Err(vec![(sources, unknown.imports), (unknown.checked.sources, unknown.modules)]),
        };
        let mut unverified = chart::unverified(&chart, &known);
        if unverified.is_empty() {
            unverified = chart::clashes(&chart, &known, &format!("{folder}Imports.asm"), loader);
        }
        if has_errors(&unverified) {
            return Err(vec![(sources, unverified)]);
        }
        Ok(Verifiable { chart, known, folder, warnings: (sources, diagnostics) })
    }

    /// The models of a part of the chart.
    fn with(
        self,
        part: Chart,
        libraries: &[&str],
        loader: &mut dyn Loader,
    ) -> Result<Box<VerifiedSystem>, Vec<Located>> {
        let Verifiable { chart, known, folder, warnings } = self;
        let ages = sure_ages(&chart);
        let mut searched = part.clone();
        if let Some(system) = &mut searched.system {
            system.bounds.retain(|bound| !ages.iter().any(|age| age.name == bound.invariant()));
        }
        let text = |lengths| chart::verified(&searched, libraries, lengths);
        let (Some(library), Some(drawn), Some(any)) =
            (chart::library(&part), text(Lengths::AsDrawn), text(Lengths::Any))
        else {
            unreachable!("what has no system or no library was reported above")
        };
        let ground = match chart::build(&part, &known, None) {
            Ok(built) => built.text,
            Err(faults) => return Err(vec![(Sources::default(), faults)]),
        };
        let mut load_as = |name: String, text: String| load_with(&library, name, text, loader);
        let name = format!("{folder}{}InTicks.asm", chart.name);
        let general = if any == drawn { None } else { Some(load_as(name.clone(), any)?) };
        let loaded = load_as(name, drawn)?;
        let ground = load_as(format!("{folder}{}.asm", chart.name), ground)?;
        let machines = |chart: &Chart| chart.system.as_ref().map_or(0, |system| system.computing.machines.len());
        let whole = match machines(&part) < machines(&chart) {
            false => None,
            true => match chart::build(&chart, &known, None) {
                Ok(built) => Some(load_as(format!("{folder}{}.asm", chart.name), built.text)?),
                Err(faults) => return Err(vec![(Sources::default(), faults)]),
            },
        };
        let data = chart::kept(&part);
        Ok(Box::new(VerifiedSystem { chart, part, data, loaded, general, ages, warnings, ground, whole }))
    }
}

/// Loads a verified or a ground model, over the pattern library in this folder.
fn load_with(library: &str, name: String, text: String, loader: &mut dyn Loader) -> Result<Loaded, Vec<Located>> {
    let root = SourceFile::new(name, text);
    let mut loader = Libraries { root: root.name.clone(), library, loader };
    load(root, &mut loader).map_err(|faulty| vec![(faulty.sources, faulty.diagnostics)])
}

/// The libraries of a verified model: the verification library is the built-in one, the pattern library that of the chart.
struct Libraries<'a> {
    /// The name of the verified model.
    root: String,
    /// The folder of the pattern library, as the chart's imports write it.
    library: &'a str,
    loader: &'a mut dyn Loader,
}

impl Loader for Libraries<'_> {
    fn load(&mut self, importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
        let within = importer.name.starts_with("<verification>/");
        if let Some(module) = path.strip_prefix("../patterns/").filter(|_| within) {
            let root = SourceFile::new(self.root.as_str(), "");
            return self.loader.load(&root, &format!("{}{module}", self.library));
        }
        let own = importer.name == self.root && path.starts_with(VERIFICATION);
        match patterns::pattern(&importer.name, path).filter(|_| within || own) {
            Some(file) => Ok(file),
            None => self.loader.load(importer, path),
        }
    }

    fn parse(&mut self, file: FileId, source: &SourceFile) -> Parse {
        self.loader.parse(file, source)
    }

    fn stop(&self) -> Stop {
        self.loader.stop()
    }
}

/// What a verified model keeps of the ground model's state: its configuration and what the reduction leaves as it is.
const KEPT: [&str; 26] = [
    "action",
    "awaited",
    "awaitsAll",
    "dimension",
    "indexUpdated",
    "messageQueue",
    "mq_capacity",
    "nextPhase",
    "sb_ctrlState",
    "sb_fresh",
    "sb_master",
    "sb_pending",
    "scheduler_currentPhase",
    "scheduler_mainThread",
    "sem",
    "sem_illegalPost",
    "sem_permits",
    "sem_state",
    "sem_users",
    "semaq",
    "sharedMemory",
    "sharedValue",
    "sv_fresh",
    "task_deadline",
    "task_kind",
    "task_period",
];
/// What it keeps although the locations behind it change: lengths, what is new, what is due.
const KEPT_DERIVED: [&str; 7] =
    ["channelHasNew", "dataAvailable", "mq_length", "patternsSound", "sv_isNew", "thereIsTime", "trigger"];

/// The functions that a term reads and that a verified model does not keep, or not for every length of an elaboration: what is true of
/// them there need not be true of the system. Besides those of the patterns, it keeps these, of machines, sensors and actuators.
pub fn not_kept(program: &Program, expression: &Expression, data: &[String]) -> Vec<String> {
    let mut found = BTreeSet::new();
    let mut entered = BTreeSet::new();
    let mut open = vec![expression.body];
    while let Some(id) = open.pop() {
        if let Term::Read { function, .. } | Term::Define { function, .. } = program.term(id) {
            let declared = program.function(*function);
            let name = declared.name.as_str();
            match &declared.definition {
                Some(_) if KEPT_DERIVED.contains(&name) => {}
                _ if data.iter().any(|kept| kept == name) => {}
                Some(definition) => {
                    if entered.insert(*function) {
                        open.push(definition.body);
                    }
                }
                None if declared.kind == FunctionKind::Static || KEPT.contains(&name) => {}
                None => _ = found.insert(name.to_string()),
            }
        }
        program.each_child_of_term(id, &mut |child| open.push(child));
    }
    found.into_iter().collect()
}

/// A counterexample as a run of the ground model.
#[derive(Debug)]
pub struct GroundRun {
    /// What happens.
    pub events: Vec<Told>,
    /// Whether the last state violates the property, too; none if the ground model has no words for it.
    pub violates: Option<bool>,
    /// Why the last step cannot be made, if that is what is wrong.
    pub fault: Option<String>,
}

/// Something that happens in a run.
#[derive(Debug, Clone)]
pub struct Told {
    /// When.
    pub tick: u64,
    /// The task.
    pub task: String,
    /// What it does, in words.
    pub words: String,
    /// It is what comes in or what a machine decides.
    pub is_data: bool,
}

impl VerifiedSystem {
    /// The components' machines that are a part of what is verified, and those that are not.
    pub fn machines(&self) -> (Vec<&ComponentMachine>, Vec<&ComponentMachine>) {
        let within = self.part.system.iter().flat_map(|system| &system.computing.machines);
        let within: Vec<usize> = within.map(|machine| machine.component).collect();
        let all = self.chart.system.iter().flat_map(|system| &system.computing.machines);
        all.partition(|machine| within.contains(&machine.component))
    }

    /// Makes the run of a counterexample on the ground model. `asked` is the verified model with the properties that were asked about.
    ///
    /// # Errors
    /// The ground model does not make the run, in words.
    pub fn ground_run(
        &self,
        limits: Limits,
        asked: (&Program, &Sources),
        subject: Subject,
        trace: &Trace,
    ) -> Result<GroundRun, String> {
        let mut ground = self.ground.overlay();
        let formula = invariant(asked, subject).and_then(|text| ground.ask("invariant", text.as_str()).ok());
        let picked = |told: &explore::Told| Picked::of(asked.0, &told.choices);
        let mut given = Given {
            program: asked.0,
            inputs: &trace.start.inputs,
            picked: picked(&trace.start),
            asked: BTreeMap::new(),
        };
        let mut run = Events::start(&ground.program, limits, &mut given)?;
        let mut events = Vec::new();
        for (tick, step) in (0..).zip(&trace.steps) {
            (given.inputs, given.picked) = (&step.inputs, picked(step));
            given.asked.clear();
            match (run.step(&mut given), &step.fault) {
                (Ok(made), None) => {
                    let mut tell = |task, words, is_data| events.push(Told { tick, task, words, is_data });
                    for (name, value) in given.asked.iter().filter(|(name, _)| self.data.contains(name)) {
                        tell(INPUT.to_string(), format!("{name} = {value}"), true);
                    }
                    made.into_iter().for_each(|(task, event)| tell(task, event.words(), false));
                    self.decided(&mut run).for_each(|(task, update)| tell(task, update, true));
                }
                (Err(fault), Some(_)) => return Ok(GroundRun { events, violates: None, fault: Some(fault) }),
                (Err(fault), None) => return Err(fault),
                (Ok(_), Some(_)) => return Err("it makes the step that the verified model cannot make".to_string()),
            }
        }
        let violates = match formula {
            None => None,
            Some(formula) => {
                let holds = run.machine().evaluate(&formula, &mut Closed);
                Some(holds.map_err(|fault| fault.show(&ground.program).to_string())? != Value::Boolean(true))
            }
        };
        Ok(GroundRun { events, violates, fault: None })
    }

    /// What the machines decided in the last step of a run of the ground model: the component, the update.
    fn decided<'r>(&'r self, run: &mut Events) -> impl Iterator<Item = (String, String)> + use<'r> {
        let machine = run.machine();
        let program = Arc::clone(machine.program());
        let changes = machine.changes().into_iter().filter(|change| {
            let function = &program.function(change.location.function);
            change.before != change.after && self.data.contains(&function.name)
        });
        let updates: Vec<(String, String)> = changes
            .map(|change| {
                let name = program.function(change.location.function).name.clone();
                (name, format!("{} := {}", change.location.show(&program), change.after.show(&program)))
            })
            .collect();
        let components = self.chart.system.iter().flat_map(|system| &system.components).collect::<Vec<_>>();
        updates.into_iter().map(move |(name, update)| {
            let is_own = |component: &&&chart::system::Component| {
                name.strip_prefix(&component.name).is_some_and(|rest| rest.starts_with('_'))
            };
            (components.iter().find(is_own).map_or(String::new(), |component| component.name.clone()), update)
        })
    }

    /// The run of a counterexample as lines: what the tasks do, and when.
    ///
    /// # Errors
    /// The ground model does not make the run, in words.
    pub fn tell_run(
        &self,
        limits: Limits,
        asked: (&Program, &Sources),
        subject: Subject,
        trace: &Trace,
    ) -> Result<String, String> {
        let GroundRun { events, violates, fault } = self.ground_run(limits, asked, subject, trace)?;
        let tick_ns = self.chart.system.as_ref().map_or(1, |system| system.tick_ns);
        let instant = |tick: u64| chart::system::length(tick as i64, tick_ns);
        let mut out = String::new();
        // The last events; before them, what came in and was decided.
        let (before, shown) = events.split_at(events.len().saturating_sub(SHOWN));
        let data: Vec<&Told> = before.iter().filter(|told| told.is_data).collect();
        let data = &data[data.len().saturating_sub(SHOWN / 2)..];
        if before.len() > data.len() {
            let _ = writeln!(out, "  \u{2026} {} events before the last ones are not shown", before.len() - data.len());
        }
        let width = data.iter().copied().chain(shown).map(|told| told.task.len()).max().unwrap_or(0);
        let mut last = None;
        for Told { tick, task, words, .. } in data.iter().copied().chain(shown) {
            let at = if last == Some(tick) { String::new() } else { instant(*tick) };
            let _ = writeln!(out, "  {at:>10}  {task:width$}  {words}");
            last = Some(tick);
        }
        let end = instant(trace.steps.len() as u64);
        if let Some(fault) = fault {
            let _ = writeln!(out, "  {end:>10}  the step cannot be made: {fault}");
            return Ok(out);
        }
        let _ = match (violates, trace.turn) {
            (Some(true), _) => writeln!(out, "  {end:>10}  the property does not hold"),
            (Some(false), _) => return Err("the ground model keeps the property in the same run".to_string()),
            (None, Some(turn)) => {
                writeln!(out, "  {end:>10}  and again from {}, for ever", instant(turn as u64))
            }
            (None, None) => writeln!(out, "  {end:>10}  the run ends"),
        };
        Ok(out)
    }

    /// A counterexample as a run of the model that `chart build` writes, with its program; none if no machine was left out, since it is
    /// the run of the verified model then.
    ///
    /// # Errors
    /// No inputs were found with which the machines that were left out make the run; in words.
    pub fn whole_run(
        &self,
        limits: &Limits,
        asked: &Program,
        trace: &Trace,
    ) -> Result<Option<(&Program, Trace)>, &'static str> {
        let Some(whole) = &self.whole else { return Ok(None) };
        let made = whole_run(&whole.program, limits, asked, trace);
        let made =
            made.ok_or("machines were left out of the search, and no inputs were found with which they make this run")?;
        Ok(Some((&*whole.program, made)))
    }

    /// Whether a run of the ground model checks the property by itself.
    pub fn is_checked(&self, asked: &Program, subject: Subject) -> bool {
        let Subject::Property(index) = subject else { return false };
        self.ground.program.properties.iter().any(|own| own.name == asked.properties[index].name)
    }

    /// The property of a subject as a scenario of the ground model writes it: the ground model's own are checked anyway.
    pub fn scenario_property(&self, asked: (&Program, &Sources), subject: Subject) -> Option<String> {
        let text = invariant(asked, subject)?;
        self.ground.overlay().ask("invariant", text.as_str()).ok().map(|_| text)
    }
}

/// Who gives inputs, in a told run.
const INPUT: &str = "(input)";

/// LIMIT: the most events that a told run shows.
const SHOWN: usize = 40;

/// The text of an invariant.
fn invariant((program, sources): (&Program, &Sources), subject: Subject) -> Option<String> {
    let Subject::Property(index) = subject else { return None };
    let property = &program.properties[index];
    let words =
        || sources.text(program.term_span(property.formula.body)).split_whitespace().collect::<Vec<_>>().join(" ");
    (property.kind == PropertyKind::Invariant).then(words)
}

/// The inputs and choices of a step, by their names: the programs of both models number their functions differently.
struct Given<'a> {
    program: &'a Program,
    inputs: &'a [(Location, Value)],
    picked: Picked,
    /// Those that were asked for, by their names.
    asked: BTreeMap<String, String>,
}

impl Environment for Given<'_> {
    fn monitored(&mut self, program: &Program, location: LocationRef<'_>, codomain: DomainId) -> Result<Value, String> {
        let name = location.show(program).to_string();
        match self.inputs.iter().find(|(input, _)| input.show(self.program).to_string() == name) {
            // The same domain may have another number there.
            Some((_, value)) => {
                let text = value.show(self.program).to_string();
                let read = read_value(program, codomain, &text);
                self.asked.insert(name, text);
                read
            }
            None => Closed.monitored(program, location, codomain),
        }
    }

    fn choose(&mut self, program: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        self.picked.take(program, choice).map_or_else(|| Closed.choose(program, choice), Ok)
    }

    fn time(&mut self, unit: TimeUnit) -> Result<i64, String> {
        Closed.time(unit)
    }
}
