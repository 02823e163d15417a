//! Builds the whole ground model of a system over the pattern library: elements, configuration and initial state.
//!
//! In: a system without errors. Out: [`Parts`]. Each component is a scheduler with a task and its phases; a waiting
//! phase comes last. The patterns select the reading and writing machines by kind and role. So kinds, masters, periods
//! and times are data of the initial state. Elaborations are rules; they are written by hand and kept.

use std::fmt::Write;

use syntax::Diagnostic;

use super::ages::Ages;
use super::known::Known;
use super::known::missing;
use super::lengths::{Lengths, varies};
use super::module::{Item, Parts};
use super::observed;
use super::table::{by_case, waiting};
use crate::chart::Chart;
use crate::component::{Carrying, carry, compose};
use crate::computing::{Computing, Made};
use crate::fault;
use crate::system::{Action, ChannelKind, Component, Needs, Phase, System, Timing};

/// The parts of a system that cannot be built.
pub(super) fn unbuilt(system: &System, known: &Known) -> Vec<Diagnostic> {
    match missing(known) {
        Some(missing) => vec![fault::no_patterns(system.span, missing)],
        None => late(system).into_iter().chain(doubled(system, known)).collect(),
    }
}

/// The modules of the library that building adds to a chart's imports.
pub(super) fn added(chart: &Chart, known: &Known) -> Vec<String> {
    chart.system.as_ref().map(|system| parts(chart, system, known).imports).unwrap_or_default()
}

/// Names that components' machines make, and that something else has.
fn doubled(system: &System, known: &Known) -> Vec<Diagnostic> {
    let mut faults = Vec::new();
    let mut told: Vec<&str> = Vec::new();
    let elements = parts(&Chart::default(), &bare(system), known).declarations;
    let computing = &system.computing;
    let made = [&computing.declarations, &computing.definitions];
    for made in made {
        for (index, item) in made.iter().enumerate() {
            let is_known = [&known.terms, &known.rules, &known.domains].iter().any(|names| names.contains(&item.name));
            let first = made[..index].iter().find(|first| first.name == item.name).map(|first| first.span);
            let is_element = elements.iter().any(|element| element.name == item.name);
            if (first.is_some() || is_known || is_element) && !told.contains(&item.name.as_str()) {
                told.push(&item.name);
                faults.push(fault::component::made_twice(item.span, &item.name, first));
            }
        }
    }
    faults
}

/// Deadlines that the patterns cannot express.
pub fn late(system: &System) -> Vec<Diagnostic> {
    let late = system.components.iter().filter(|component| match component.timing {
        Timing::Synchronous { period, deadline, .. } => period < deadline,
        Timing::Asynchronous { .. } => false,
    });
    late.map(|component| fault::not_built(component.span, "a deadline after the end of the period")).collect()
}

/// The parts of a system's file.
pub(super) fn parts(chart: &Chart, system: &System, known: &Known) -> Parts {
    let mut parts = Parts { imports: chart.imports.clone(), owns: true, ..Parts::default() };
    let mut element = |name: &str, domain: &str| {
        let text = format!("static {name}: {domain}\n");
        parts.declarations.push(Item { name: name.to_string(), text, decided: true });
    };
    for component in &system.components {
        element(&component.name, "Scheduler");
        element(&task(component), "Task");
    }
    for channel in &system.channels {
        match channel.kind {
            ChannelKind::Buffer { .. } => {
                element(&channel.name, "SwingingBuffer");
                element(&lock(&channel.name), "Semaphore");
            }
            ChannelKind::Queue { .. } => element(&channel.name, "MessageQueue"),
            ChannelKind::Shared => element(&channel.name, "SharedValue"),
        }
    }
    for component in &system.components {
        component.phases.iter().for_each(|phase| element(&phase.name, "SchedulePhase"));
        element(&waiting(component), "SchedulePhase");
    }
    let ages = Ages::of(system);
    let observed = observed::elements(system);
    ages.elements().iter().chain(&observed).for_each(|(name, domain)| element(name, domain));
    for phase in system.components.iter().flat_map(|component| &component.phases) {
        if let Action::Elaborate(Some(link)) = &phase.action
            && !known.rules.contains(&link.name)
        {
            let text = format!("// the elaboration {}\nrule {}($c in Scheduler) = skip\n", phase.name, link.name);
            parts.definitions.push(Item { name: link.name.clone(), text, decided: false });
            parts.to_write.push(link.name.clone());
        }
    }
    fixed(
        &mut parts,
        "r_controlTask",
        "// what each task does when it is its turn\nrule r_controlTask = r_scheduler_execute[self]\n",
    );
    if varies(system) {
        let library = super::library(chart).unwrap_or_else(|| "patterns/".to_string());
        parts.imports.push(format!("{library}VaryingTimes"));
        fixed(
            &mut parts,
            "r_varyingTask",
            "// the same where times vary\nrule r_varyingTask = r_scheduler_executeVarying[self]\n",
        );
    }
    fixed(&mut parts, "inv_patterns", "invariant inv_patterns over sem_state, indexRead: patternsSound\n");
    parts.definitions.push(observed::deadlines(system));
    let library = super::library(chart).unwrap_or_else(|| "patterns/".to_string());
    let mut after = "";
    if !system.bounds.is_empty() {
        parts.imports.push(format!("{library}DataAges"));
        for (name, text) in ages.invariants(system) {
            parts.definitions.push(Item { name, text, decided: true });
        }
        after = "r_ages[]\n";
    }
    parts.imports.extend(observed::observers(system).iter().map(|one| format!("{library}{}", one.module)));
    parts.definitions.extend(observed::invariants(system));
    parts.main = Some(format!("main rule r_Main =\n{}", observed::observed(system, TICK, after, false)));
    let agent = if varies(system) { VARYING_AGENT } else { AGENT };
    if system.computing.ends.is_empty() {
        parts.init = Some(initial(system) + agent);
    } else {
        computing(&system.computing, varies(system), &mut parts);
        parts.init = Some(initial(system) + &system.computing.initial.concat() + COMPUTING_AGENT);
    }
    parts
}

/// What the components' machines compute, and the rule of the tasks that lets them do it. If times vary, an elaboration may end early.
fn computing(computing: &Computing, varies: bool, parts: &mut Parts) {
    let new = computing.imports.iter().filter(|import| !parts.imports.contains(import)).cloned().collect::<Vec<_>>();
    parts.imports.splice(0..0, new);
    let item = |made: &Made| Item { name: made.name.clone(), text: made.text.clone(), decided: true };
    parts.declarations.extend(computing.declarations.iter().map(item));
    parts.definitions.extend(computing.definitions.iter().map(item));
    let cases: Vec<String> = computing.ends.iter().map(|(phase, rule)| format!("case {phase}: {rule}[]\n")).collect();
    let text = format!(
        "// what is computed when an elaboration ends\nrule r_endOfElaboration($p in SchedulePhase) =\nswitch $p\n{}endswitch\n",
        cases.concat()
    );
    parts.definitions.push(Item { name: "r_endOfElaboration".to_string(), text, decided: true });
    let (execute, early) = match varies {
        false => ("r_scheduler_execute", ""),
        true => (
            "r_scheduler_executeVarying",
            "else if mayEnd(self) then if endsNow(self) then r_endOfElaboration[scheduler_currentPhase(self)] endif endif ",
        ),
    };
    let text = format!(
        "// what each task does when it is its turn\nrule r_computingTask =\npar\n{execute}[self]\n\
         if action(scheduler_currentPhase(self)) = ELABORATING then\n\
         if tElapsed(self) then r_endOfElaboration[scheduler_currentPhase(self)] {early}endif\nendif\nendpar\n"
    );
    parts.definitions.push(Item { name: "r_computingTask".to_string(), text, decided: true });
}

fn fixed(parts: &mut Parts, name: &str, text: &str) {
    parts.definitions.push(Item { name: name.to_string(), text: text.to_string(), decided: false });
}

/// One tick of all components.
const TICK: &str = "par
forall $c in Scheduler with true do program($c)
forall $s in Semaphore with true do r_sem_arbitrate[$s]
clock := clock + 1
endpar
";

/// The system without what its elaborations compute.
pub(super) fn bare(system: &System) -> System {
    without_rules(System { computing: Default::default(), ..system.clone() })
}

/// The system without what its elaborations compute by rules.
pub(super) fn without_rules(mut system: System) -> System {
    for phase in system.components.iter_mut().flat_map(|component| &mut component.phases) {
        if let Action::Elaborate(link) = &mut phase.action {
            *link = None;
        }
    }
    system
}

/// The parts of the model that verifies a system: its text is the whole of a file.
///
/// The system's own main rule becomes a tick of the verification library, which forgets after each tick what no rule can tell apart.
/// What elaborations compute by rules is left out; their times are not, nor is what the system's machines decide.
/// `library` is the path of the pattern library's folder in imports.
pub(super) fn verified(chart: &Chart, system: &System, library: &str, lengths: Lengths) -> Parts {
    let decided = (!system.computing.ends.is_empty()).then(|| by_place(system));
    let mut system = bare(system);
    let free = lengths.free(&mut system);
    let mut parts = parts(chart, &system, &Known::default());
    // The tick lets actions end, whatever the tasks' rule.
    parts.definitions.retain(|item| item.name != "r_varyingTask");
    let verification = ["Quotient", "SystemProperties", "SystemInTicks"];
    let standard = ["StandardLibrary", "CTLLibrary"].map(str::to_string);
    parts.imports = standard.into_iter().chain([format!("{library}ControlTask")]).collect();
    parts.imports.extend(verification.map(|name| format!("{VERIFICATION}{name}")));
    let system_tick = match &decided {
        Some(_) => carry::moved(&system, TICK),
        None => TICK.to_string(),
    };
    let system_tick = observed::observed(&system, &system_tick, "", true);
    fixed(&mut parts, "r_system", &format!("// a tick of the system as it is drawn\nrule r_system =\n{system_tick}"));
    for observer in observed::observers(&system) {
        parts.imports.push(format!("{library}{}", observer.module));
        parts.imports.extend(observer.in_ticks.map(|module| format!("{VERIFICATION}{module}")));
    }
    let tick = if system.bounds.is_empty() { "r_tick" } else { "r_agedTick" };
    if !system.bounds.is_empty() {
        parts.imports.extend([format!("{library}DataAges"), format!("{VERIFICATION}AgesInTicks")]);
    }
    parts.main = Some(format!("main rule r_Main = {tick}[<<r_system>>]\n"));
    fixed(&mut parts, "ctlSpec_works", WORKS);
    let task = |name: &String| format!("JUSTICE not isFree({name}_task)\n");
    for (name, _) in &free {
        fixed(&mut parts, &format!("fair {name}"), &task(name));
    }
    let mut initial = initial(&system);
    let mut define = |function: &str, value: &str| _ = writeln!(initial, "function {function} = {value}");
    define("handedOver($b in SwingingBuffer)", "0");
    define("unaccounted($b in SwingingBuffer)", "0");
    define("before_read($b in SwingingBuffer)", "indexRead($b)");
    define("before_written($b in SwingingBuffer)", "0");
    define("before_phase($c in Scheduler)", "scheduler_currentPhase($c)");
    define("lostSilently($v in SharedValue)", "false");
    if let Some(oldest) = system.bounds.iter().map(|bound| bound.limit).max() {
        define("tooOld", &(oldest + 1).to_string());
    }
    if !free.is_empty() {
        let is_free = |phase: &String| free.iter().any(|(_, phases)| phases.contains(phase));
        let all = system
            .components
            .iter()
            .flat_map(|component| component.phases.iter().map(|phase| phase.name.clone()).chain([waiting(component)]));
        let rows: Vec<_> = all.map(|phase| (phase.clone(), is_free(&phase).to_string())).collect();
        define("endless($p in SchedulePhase)", &by_case("$p", &rows));
    }
    match decided {
        Some(decided) => {
            let carries = |import: &&String| super::folder_of_patterns(import).is_none();
            parts.imports.extend(chart.imports.iter().filter(carries).cloned());
            // The tick lets actions end: an elaboration that ends has taken its time.
            computing(&decided, false, &mut parts);
            parts.init = Some(initial + &decided.initial.concat() + COMPUTING_AGENT);
        }
        None => parts.init = Some(initial + AGENT),
    }
    parts
}

/// What a system's components compute, with the values where the data lie.
fn by_place(system: &System) -> Computing {
    let Computing { machines, contents, .. } = system.computing.clone();
    compose(system, machines, contents, Carrying::ByPlace)
}

/// The functions of machines, sensors and actuators that the model with data has in common with the ground model, value for value.
pub(super) fn kept(system: &System) -> Vec<String> {
    let by_number = &system.computing.declarations;
    let made = by_place(system).declarations.into_iter().map(|made| made.name);
    made.filter(|name| by_number.iter().any(|known| known.name == *name)).collect()
}

/// Every task begins its cycle again and again.
const WORKS: &str =
    "CTLSPEC ctlSpec_works: (forall $t in Task with ag(af(isBeginning($t)) and af(not isBeginning($t))))\n";

/// The folder of the verification library in imports.
pub(super) const VERIFICATION: &str = "verification/";

const AGENT: &str = "agent Scheduler: r_controlTask[]\n";
const COMPUTING_AGENT: &str = "agent Scheduler: r_computingTask[]\n";
const VARYING_AGENT: &str = "agent Scheduler: r_varyingTask[]\n";

fn task(component: &Component) -> String {
    format!("{}_task", component.name)
}

fn lock(channel: &str) -> String {
    format!("{channel}_lock")
}

fn initial(system: &System) -> String {
    let mut text = "default init s0:\n".to_string();
    let mut define = |function: &str, value: &str| _ = writeln!(text, "function {function} = {value}");
    define("clock", "0");
    tasks(system, &mut define);
    channels(system, &mut define);
    schedulers(system, &mut define);
    phases(system, &mut define);
    if !system.bounds.is_empty() {
        Ages::of(system).define(system, &mut define);
    }
    observed::define(system, &mut define);
    text
}

fn tasks(system: &System, define: &mut impl FnMut(&str, &str)) {
    let each = |value: &dyn Fn(&Component) -> String| -> Vec<(String, String)> {
        system.components.iter().map(|component| (task(component), value(component))).collect()
    };
    let period = |component: &Component| component.timing.period();
    let kind = each(&|c| if period(c).is_some() { "SYNCHRONOUS" } else { "ASYNCHRONOUS" }.to_string());
    define("task_kind($t in Task)", &by_case("$t", &kind));
    let periods = each(&|c| period(c).map_or("undef".to_string(), |period| period.to_string()));
    define("task_period($t in Task)", &by_case("$t", &periods));
    let early = |timing: &Timing| match timing {
        Timing::Synchronous { period, deadline, .. } if period != deadline => Some(*deadline),
        Timing::Synchronous { .. } | Timing::Asynchronous { .. } => None,
    };
    if system.components.iter().any(|component| early(&component.timing).is_some()) {
        let deadlines = each(&|c| early(&c.timing).map_or("undef".to_string(), |deadline| deadline.to_string()));
        define("task_deadline($t in Task)", &by_case("$t", &deadlines));
    }
    let budget = each(&|c| period(c).map_or("undef".to_string(), |_| budget(system, c).to_string()));
    define("task_timeForElaboration($t in Task)", &by_case("$t", &budget));
    if system.has_jitter() {
        let jitter = each(&|c| match c.timing.jitter() {
            0 => "undef".to_string(),
            jitter => jitter.to_string(),
        });
        define("task_jitter($t in Task)", &by_case("$t", &jitter));
    }
    let start = each(&|c| match c.timing {
        Timing::Synchronous { period, offset, .. } => (offset as i64 - period as i64).to_string(),
        Timing::Asynchronous { .. } => "0".to_string(),
    });
    define("task_periodStart($t in Task)", &by_case("$t", &start));
    let counters = ["timeInWait", "cycles", "deadlinesMet", "deadlinesMissed", "totalWait", "longestWait", "skipped"];
    for name in counters {
        define(&format!("task_{name}($t in Task)"), "0");
    }
}

/// The ticks of a cycle without waiting: a slave's access takes one tick more than its time, a master's two.
pub fn busy(system: &System, component: &Component) -> u64 {
    component.phases.iter().map(|phase| taken(system, component, phase)).sum()
}

/// The ticks of a cycle that are left for no waiting, from the start of its period: however late it is released, it keeps its deadline.
pub fn budget(system: &System, component: &Component) -> u64 {
    busy(system, component) + component.timing.jitter()
}

/// The ticks of a phase without waiting.
pub(crate) fn taken(system: &System, component: &Component, phase: &Phase) -> u64 {
    let index = system.components.iter().position(|known| known.name == component.name);
    match phase.action {
        Action::Read(channel) | Action::Write(channel) => match system.channels[channel].kind {
            ChannelKind::Buffer { master, .. } => phase.time + if Some(master) == index { 2 } else { 1 },
            _ => phase.time,
        },
        Action::Elaborate(_) => phase.time,
    }
}

fn channels(system: &System, define: &mut impl FnMut(&str, &str)) {
    let buffers = || system.channels.iter().enumerate().filter(|(_, c)| matches!(c.kind, ChannelKind::Buffer { .. }));
    define("sem_permits($s in Semaphore)", "1");
    // A shorter period is more urgent; asynchronous tasks come last.
    let users = buffers().map(|(_, channel)| {
        let mut ends = [&system.components[channel.from], &system.components[channel.to]];
        ends.sort_by_key(|component| component.timing.period().unwrap_or(u64::MAX));
        (lock(&channel.name), format!("[{}, {}]", task(ends[0]), task(ends[1])))
    });
    define("sem_users($s in Semaphore)", &by_case("$s", &users.collect::<Vec<_>>()));
    define("sem_state($s in Semaphore, $t in Task)", "READY");
    define("sem_illegalPost($s in Semaphore)", "false");
    define("semaq($s in Semaphore)", "[]");
    let arrays = |less: u64| -> Vec<(String, String)> {
        let number = |kind: ChannelKind| match kind {
            ChannelKind::Buffer { arrays, .. } => (arrays - less).to_string(),
            _ => "undef".to_string(),
        };
        buffers().map(|(_, channel)| (channel.name.clone(), number(channel.kind))).collect()
    };
    define("dimension($b in SwingingBuffer)", &by_case("$b", &arrays(0)));
    let locks: Vec<_> = buffers().map(|(_, channel)| (channel.name.clone(), lock(&channel.name))).collect();
    define("sem($b in SwingingBuffer)", &by_case("$b", &locks));
    let masters = buffers().map(|(index, channel)| {
        let ChannelKind::Buffer { master, .. } = channel.kind else {
            return (channel.name.clone(), "undef".to_string());
        };
        let uses = |action: &Action| matches!(action, Action::Read(c) | Action::Write(c) if *c == index);
        let phase = system.components[master].phases.iter().find(|phase| uses(&phase.action));
        (channel.name.clone(), phase.map_or("undef".to_string(), |phase| phase.name.clone()))
    });
    define("sb_master($b in SwingingBuffer)", &by_case("$b", &masters.collect::<Vec<_>>()));
    define("indexWrite($b in SwingingBuffer)", "0");
    define("indexRead($b in SwingingBuffer)", &by_case("$b", &arrays(1)));
    for name in ["indexUpdated", "sb_pending", "sb_fresh"] {
        define(&format!("{name}($b in SwingingBuffer)"), "false");
    }
    define("sb_sequence($b in SwingingBuffer, $n in ArrayIndex)", "0");
    for name in ["receivedSequence", "written", "swaps", "delivered", "overwritten", "unread", "dropped"] {
        define(&format!("sb_{name}($b in SwingingBuffer)"), "0");
    }
    let queues = system.channels.iter().filter_map(|channel| match channel.kind {
        ChannelKind::Queue { capacity } => Some((channel.name.clone(), capacity.to_string())),
        _ => None,
    });
    let queues: Vec<_> = queues.collect();
    if !queues.is_empty() {
        define("mq_capacity($q in MessageQueue)", &by_case("$q", &queues));
        for name in ["sent", "refused", "taken"] {
            define(&format!("mq_{name}($q in MessageQueue)"), "0");
        }
    }
    if system.channels.iter().any(|channel| channel.kind == ChannelKind::Shared) {
        for name in ["sequence", "overwritten", "receivedSequence"] {
            define(&format!("sv_{name}($v in SharedValue)"), "0");
        }
        define("sv_fresh($v in SharedValue)", "false");
    }
}

fn schedulers(system: &System, define: &mut impl FnMut(&str, &str)) {
    let all = |value: fn(&Component) -> String| -> Vec<(String, String)> {
        system.components.iter().map(|component| (component.name.clone(), value(component))).collect()
    };
    define("scheduler_mainThread($c in Scheduler)", &by_case("$c", &all(task)));
    define("scheduler_currentPhase($c in Scheduler)", &by_case("$c", &all(waiting)));
    define("scheduler_actionStart($c in Scheduler)", "0");
}

/// The configuration of a phase.
#[derive(Default)]
struct Row {
    name: String,
    action: &'static str,
    time: u64,
    /// The shortest time, if it varies.
    least: Option<u64>,
    next: String,
    buffer: Option<String>,
    queue: Option<String>,
    value: Option<String>,
    rule: Option<String>,
    /// Of a waiting phase that awaits several channels: the phases that read them, and of how many it needs data.
    awaits: Option<(Vec<String>, Needs)>,
}

fn phases(system: &System, define: &mut impl FnMut(&str, &str)) {
    let mut rows: Vec<Row> = Vec::new();
    for component in &system.components {
        let names: Vec<&str> = component.phases.iter().map(|phase| phase.name.as_str()).collect();
        let wait = waiting(component);
        for (index, phase) in component.phases.iter().enumerate() {
            let next = names.get(index + 1).map_or(wait.clone(), |next| (*next).to_string());
            let least = (phase.least < phase.time).then_some(phase.least);
            let mut row = Row { name: phase.name.clone(), time: phase.time, least, next, ..Row::default() };
            match &phase.action {
                Action::Read(channel) => {
                    use_channel(&mut row, system, *channel, ["READING_FROM_SB", "RECEIVING", "LOADING"])
                }
                Action::Write(channel) => {
                    use_channel(&mut row, system, *channel, ["WRITING_ON_SB", "SENDING", "STORING"])
                }
                Action::Elaborate(link) => {
                    row.action = "ELABORATING";
                    row.rule = link.as_ref().map(|link| link.name.clone());
                }
            }
            rows.push(row);
        }
        let next = names.first().map_or(wait.clone(), |first| (*first).to_string());
        let mut row = Row { name: wait, time: 1, next, ..Row::default() };
        if let Timing::Asynchronous { awaits } = &component.timing {
            match awaits.channels[..] {
                [] => {}
                [channel] => use_channel(&mut row, system, channel, ["", "", ""]),
                _ => row.awaits = Some((reading(component, &awaits.channels), awaits.needs)),
            }
        }
        row.action = "WAITING_TRIGGER";
        rows.push(row);
    }
    let column = |value: &dyn Fn(&Row) -> String| -> Vec<(String, String)> {
        rows.iter().map(|row| (row.name.clone(), value(row))).collect()
    };
    let or_undef = |value: &Option<String>| value.clone().unwrap_or_else(|| "undef".to_string());
    define("action($p in SchedulePhase)", &by_case("$p", &column(&|row| row.action.to_string())));
    define("time($p in SchedulePhase)", &by_case("$p", &column(&|row| row.time.to_string())));
    if rows.iter().any(|row| row.least.is_some()) {
        let least = |row: &Row| row.least.map_or("undef".to_string(), |least| least.to_string());
        define("timeAtLeast($p in SchedulePhase)", &by_case("$p", &column(&least)));
    }
    define("nextPhase($p in SchedulePhase)", &by_case("$p", &column(&|row| row.next.clone())));
    define("sharedMemory($p in SchedulePhase)", &by_case("$p", &column(&|row| or_undef(&row.buffer))));
    if rows.iter().any(|row| row.queue.is_some()) {
        define("messageQueue($p in SchedulePhase)", &by_case("$p", &column(&|row| or_undef(&row.queue))));
    }
    if rows.iter().any(|row| row.value.is_some()) {
        define("sharedValue($p in SchedulePhase)", &by_case("$p", &column(&|row| or_undef(&row.value))));
    }
    if rows.iter().any(|row| row.awaits.is_some()) {
        let phases = |row: &Row| {
            row.awaits.as_ref().map_or("undef".to_string(), |(phases, _)| format!("{{{}}}", phases.join(", ")))
        };
        define("awaited($p in SchedulePhase)", &by_case("$p", &column(&phases)));
        let needs = |row: &Row| {
            row.awaits.as_ref().map_or("undef".to_string(), |(_, needs)| (*needs == Needs::All).to_string())
        };
        define("awaitsAll($p in SchedulePhase)", &by_case("$p", &column(&needs)));
    }
    let rule = |row: &Row| row.rule.as_ref().map_or("undef".to_string(), |rule| format!("<<{rule}(Scheduler)>>"));
    define("elaborationRule($p in SchedulePhase)", &by_case("$p", &column(&rule)));
}

/// The phases of a component that read these channels, in the order of a cycle.
fn reading(component: &Component, channels: &[usize]) -> Vec<String> {
    let reads = |phase: &&Phase| matches!(phase.action, Action::Read(channel) if channels.contains(&channel));
    component.phases.iter().filter(reads).map(|phase| phase.name.clone()).collect()
}

/// Makes a phase use a channel; the channel's kind (buffer, queue, value) selects the action.
fn use_channel(row: &mut Row, system: &System, channel: usize, actions: [&'static str; 3]) {
    let channel = &system.channels[channel];
    let name = Some(channel.name.clone());
    match channel.kind {
        ChannelKind::Buffer { .. } => (row.action, row.buffer) = (actions[0], name),
        ChannelKind::Queue { .. } => (row.action, row.queue) = (actions[1], name),
        ChannelKind::Shared => (row.action, row.value) = (actions[2], name),
    }
}
