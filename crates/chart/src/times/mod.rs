//! What can be told of a system's times before anything runs: for each task its load and its longest response, for each age bound the
//! greatest age.
//!
//! In: a system without errors, how many processors its tasks share, and in which order they are urgent. Out: [`Times`]. A cycle takes as
//! long as its phases, with the ticks that the model spends at locks. Tasks are preempted by more urgent ones; a lock makes its holder
//! as urgent as the task that waits (`cpp/include/groundstate/pair_lock.hpp`). Offsets are not used: all tasks may be released at once.
//! A response counts from the start of a period, so the jitter of the release is part of it.
//! INVARIANT: a response or an age that is given is never exceeded while every task keeps its deadline; none is given otherwise.

mod ages;
mod fresh;
mod locks;
mod missed;
mod response;
mod starts;

use std::cmp::Ordering;

use syntax::Diagnostic;

use crate::build::busy;
use crate::fault;
use crate::system::{AgeBound, System, Timing, Tolerance, length};
use response::{Demand, on_one, on_several};
use starts::Stream;

pub use ages::{Age, Way};
pub use fresh::{Fresh, bounded};
pub(crate) use locks::section;
pub use missed::Missed;

/// What the tasks share, and which goes first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Platform {
    /// The number of processors.
    pub processors: u64,
    /// The order of the synchronous tasks.
    pub order: Order,
}

impl Platform {
    /// As the chart says; one processor if it says nothing.
    pub fn of(system: &System) -> Platform {
        Platform { processors: system.processors.map_or(1, |(number, _)| number), order: Order::Rate }
    }
}

/// Which of two synchronous tasks is more urgent. Asynchronous ones come after all of them; otherwise equal ones in the order of the
/// chart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// That with the shorter period, as in the program that is generated.
    Rate,
    /// That with the shorter deadline.
    Deadline,
}

/// The times of a system.
#[derive(Debug, Clone, PartialEq)]
pub struct Times {
    /// What they are for.
    pub platform: Platform,
    /// One for each component, in the order of the chart.
    pub tasks: Vec<TaskTimes>,
    /// What all tasks together need, as a number of processors; without asynchronous tasks that may start at any time.
    pub load: f64,
    /// The load of the synchronous tasks is more than there are processors.
    pub overloaded: bool,
    /// One for each age bound, in the order of the chart.
    pub ages: Vec<Age>,
    /// One for each reading with a bound, in the order of the chart ([`bounded`]).
    pub fresh: Vec<Fresh>,
}

/// The times of a task, in ticks.
#[derive(Debug, Clone, PartialEq)]
pub struct TaskTimes {
    /// 1 is the most urgent.
    pub priority: usize,
    /// The shortest and the longest time of a cycle that never waits.
    pub execution: (u64, u64),
    /// The shortest time between two cycles in the long run: the period, or what follows from the data that are awaited. Where
    /// it awaits any of several, their mean.
    pub interval: Option<u64>,
    /// The part of a processor that it needs; none if it may start at any time.
    pub load: Option<f64>,
    /// How long others keep it waiting at channels, at most: on one processor also by a lock that a more urgent task waits for.
    pub blocking: Option<u64>,
    /// The longest time from the start of its period until the end of the cycle, with the jitter of its release; of an asynchronous task
    /// from when its cycle could begin: what it awaits is there, and the cycle before is over.
    pub response: Option<u64>,
    /// What follows for its deadline.
    pub verdict: Verdict,
    /// How many deadlines it misses, if it may miss some.
    pub missed: Option<Missed>,
}

impl TaskTimes {
    /// Whether it misses no more deadlines than the chart allows; none: that is not known.
    pub fn keeps(&self, tolerance: Option<&Tolerance>) -> Option<bool> {
        let Some((tolerance, missed)) = tolerance.zip(self.missed.as_ref()) else {
            return match self.verdict {
                Verdict::Meets | Verdict::None => Some(true),
                Verdict::Misses => Some(false),
                Verdict::Open(_) => None,
            };
        };
        match missed.most {
            Some(most) if most <= tolerance.missed => Some(true),
            Some(_) if missed.certain => Some(false),
            _ => None,
        }
    }
}

/// Whether a task keeps its deadline.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verdict {
    /// Always.
    Meets,
    /// Not in the run in which all are released at once and take as long as they may.
    Misses,
    /// The analysis does not show it, for this reason.
    Open(String),
    /// It has none.
    None,
}

/// What is known while the responses are computed.
struct Analysis<'s> {
    system: &'s System,
    platform: Platform,
    /// The indices of the components, the most urgent first.
    urgency: Vec<usize>,
    blocking: Vec<Result<u64, String>>,
    responses: Vec<Option<u64>>,
    /// The periods of what starts each component; none if it may start at any time.
    periods: Vec<Option<Vec<u64>>>,
    /// When the cycles of each component could begin, by the present responses.
    releases: Vec<Option<Vec<Stream>>>,
}

/// LIMIT: a response of a task without a deadline is sought up to so many ticks.
const LONGEST: u64 = 1 << 40;
/// LIMIT: rounds in which the responses of tasks that start each other are computed anew.
const ROUNDS: usize = 64;

/// The times of a system on a platform.
pub fn times(system: &System, platform: Platform) -> Times {
    let count = system.components.len();
    let shares = !is_apart(system, platform);
    let analysis = Analysis::new(system, platform);
    // What comes faster than a task can take it is left out by it; a synchronous one is late.
    let capped = |index: usize, load: f64| match system.components[index].timing {
        Timing::Synchronous { .. } => load,
        Timing::Asynchronous { .. } => load.min(1.0),
    };
    let loads: Vec<Option<f64>> = (0..count)
        .map(|index| {
            let periods = analysis.periods[index].as_ref()?.iter();
            let load: f64 = periods.map(|period| executed(system, index).1 as f64 / (*period).max(1) as f64).sum();
            Some(capped(index, load))
        })
        .collect();
    let synchronous = |index: &usize| system.components[*index].timing.period().is_some();
    let needed: f64 = (0..count).filter(synchronous).filter_map(|index| loads[index]).sum();
    // What just fits must not fail by rounding.
    let overloaded = shares && needed > platform.processors as f64 + 1e-9;
    let tasks = (0..count).map(|index| TaskTimes {
        priority: analysis.urgency.iter().position(|other| *other == index).map_or(0, |place| place + 1),
        execution: executed(system, index),
        interval: analysis.interval(index),
        load: loads[index],
        blocking: analysis.blocking[index].as_ref().ok().copied(),
        response: analysis.responses[index],
        verdict: analysis.verdict(index),
        missed: system.components[index]
            .tolerance
            .as_ref()
            .map(|tolerance| missed::missed(&analysis, index, tolerance, &analysis.verdict(index))),
    });
    let tasks: Vec<TaskTimes> = tasks.collect();
    // A sum of nothing is -0.
    let load = 0.0 + loads.iter().flatten().sum::<f64>();
    let ages = ages::ages(system, &analysis);
    let fresh = fresh::fresh(system, &analysis);
    Times { platform, tasks, load, overloaded, ages, fresh }
}

/// For each age bound the greatest age, if it is within the bound by the responses of the tasks alone, each on a processor of its own as
/// in the model that is verified.
pub fn surely_within(system: &System) -> Vec<Option<u64>> {
    let apart = Platform { processors: system.components.len() as u64, order: Order::Rate };
    let ages = ages::ages(system, &Analysis::new(system, apart));
    let within = |(bound, age): (&AgeBound, Age)| age.most.filter(|most| *most <= bound.limit);
    system.bounds.iter().zip(ages).map(within).collect()
}

/// What a chart must be told: of its age bounds, and of its processors, if it says how many there are.
pub(crate) fn faults(system: &System) -> Vec<Diagnostic> {
    let times = times(system, Platform::of(system));
    let mut faults = system.processors.map(|(_, place)| told(system, &times, place)).unwrap_or_default();
    let shown = |ticks: u64| length(ticks as i64, system.tick_ns);
    for (bound, age) in system.bounds.iter().zip(&times.ages) {
        if let Some(least) = age.least.filter(|least| *least > bound.limit) {
            let (limit, least) = (shown(bound.limit), shown(least));
            faults.push(fault::times::never_fresh(bound.span, &bound.from.text, &bound.to.text, &limit, &least));
        }
    }
    for (reading, reader) in fresh::readings(system) {
        let (phase, bound) = reading;
        let channel = &system.channels[reader.channel];
        let ends = [(channel.to, "reads"), (channel.from, "writes")].map(|(end, does)| {
            let component = &system.components[end];
            (component.timing.period(), format!("`{}` {does}", component.name))
        });
        if let Some((Some(period), who)) = ends.iter().find(|(period, _)| period.is_some_and(|one| one > bound.limit)) {
            let (limit, period) = (shown(bound.limit), shown(*period));
            faults.push(fault::times::seldom_fresh(bound.span, &phase.name, &limit, who, &period));
        }
    }
    faults
}

/// The faults of a system on its platform. `place` is where that is stated.
pub fn told(system: &System, times: &Times, place: syntax::Span) -> Vec<Diagnostic> {
    let shown = |ticks: u64| length(ticks as i64, system.tick_ns);
    let processors = times.platform.processors;
    if times.overloaded {
        let synchronous = system.components.iter().zip(&times.tasks).filter(|(one, _)| one.timing.period().is_some());
        let needed: f64 = synchronous.filter_map(|(_, task)| task.load).sum();
        return vec![fault::times::overloaded(place, needed, processors)];
    }
    let mut faults = Vec::new();
    for (component, task) in system.components.iter().zip(&times.tasks) {
        let Timing::Synchronous { deadline, .. } = component.timing else { continue };
        // A cycle that is too long by itself is told anyway.
        let most = task.execution.1 + component.timing.jitter();
        if most > component.available().unwrap_or(deadline) || task.verdict == Verdict::Meets {
            continue;
        }
        if task.keeps(component.tolerance.as_ref()) == Some(true) {
            continue;
        }
        let certain = task.verdict == Verdict::Misses;
        let reason = match (&task.verdict, task.response) {
            (Verdict::Open(reason), _) => reason.clone(),
            (_, Some(response)) => format!("it may take {}", shown(response)),
            _ => "the more urgent tasks leave it too little time".to_string(),
        };
        // Where a queue or a lock keeps it waiting, or its own cycle is as long as its period, others are no help.
        let is_preempted = task.blocking.is_some() && task.response.is_none_or(|response| response > deadline);
        let more_help = is_preempted && !is_apart(system, times.platform);
        faults.push(fault::times::late_response(
            component.span,
            &component.name,
            certain,
            &reason,
            &shown(deadline),
            (processors, more_help),
        ));
    }
    faults
}

/// The shortest and the longest time of a cycle that never waits.
fn executed(system: &System, index: usize) -> (u64, u64) {
    let component = &system.components[index];
    let most = busy(system, component);
    let spared: u64 = component.phases.iter().map(|phase| phase.time - phase.least).sum();
    (most - spared, most)
}

/// Whether each task has a processor of its own.
fn is_apart(system: &System, platform: Platform) -> bool {
    platform.processors >= system.components.len() as u64
}

/// The components, the most urgent first.
fn urgency(system: &System, order: Order) -> Vec<usize> {
    let key = |index: &usize| match system.components[*index].timing {
        Timing::Synchronous { period, .. } if order == Order::Rate => period,
        Timing::Synchronous { deadline, .. } => deadline,
        Timing::Asynchronous { .. } => u64::MAX,
    };
    let mut all: Vec<usize> = (0..system.components.len()).collect();
    all.sort_by(|one, other| match key(one).cmp(&key(other)) {
        Ordering::Equal => one.cmp(other),
        differ => differ,
    });
    all
}

impl<'s> Analysis<'s> {
    fn new(system: &'s System, platform: Platform) -> Analysis<'s> {
        let urgency = urgency(system, platform.order);
        let blocking = locks::blocking(system, platform, &urgency);
        let count = system.components.len();
        let (periods, responses, releases) = (starts::periods(system), vec![None; count], vec![None; count]);
        let mut analysis = Analysis { system, platform, urgency, blocking, responses, periods, releases };
        analysis.respond();
        analysis
    }

    /// The shortest time between two cycles of a component in the long run, without jitter.
    fn interval(&self, index: usize) -> Option<u64> {
        match &self.periods[index].as_ref()?[..] {
            [one] => Some(*one),
            several => Some((1.0 / starts::rate(several.iter().copied())) as u64),
        }
    }

    /// What a component asks of its processor.
    fn demands(&self, index: usize) -> Option<Vec<Demand>> {
        let execution = executed(self.system, index).1;
        let demand = |one: &Stream| Demand { execution, period: one.period, jitter: one.jitter };
        Some(self.releases[index].as_ref()?.iter().map(demand).collect())
    }

    /// Computes all responses. Asynchronous tasks start after others, so theirs follow from one another.
    fn respond(&mut self) {
        for index in 0..self.responses.len() {
            let awaits_in_a_circle = self.interval(index).is_none() && !self.awaited(index).is_empty();
            self.responses[index] = (!awaits_in_a_circle).then(|| executed(self.system, index).1);
        }
        for _ in 0..ROUNDS {
            let before = self.responses.clone();
            self.releases = starts::releases(self);
            for place in 0..self.urgency.len() {
                let index = self.urgency[place];
                if self.responses[index].is_some() {
                    self.responses[index] = self.response(place);
                }
            }
            if self.responses == before {
                return;
            }
        }
        // They grow on: only what does not depend on itself is known.
        for index in 0..self.responses.len() {
            if self.system.components[index].timing.period().is_none() {
                self.responses[index] = None;
            }
        }
    }

    fn awaited(&self, index: usize) -> &[usize] {
        self.system.components[index].timing.awaited()
    }

    /// Whether a datum that comes on this channel starts a cycle of its reader, or the one after the present cycle.
    fn starts_by(&self, channel: usize) -> bool {
        match &self.system.components[self.system.channels[channel].to].timing {
            Timing::Synchronous { .. } => false,
            Timing::Asynchronous { awaits } => awaits.channels.contains(&channel) && !awaits.gathers(),
        }
    }

    /// The response of the component at this place of the order, by the present responses of the others.
    fn response(&self, place: usize) -> Option<u64> {
        let index = self.urgency[place];
        let execution = executed(self.system, index).1;
        let blocking = *self.blocking[index].as_ref().ok()?;
        let jitter = self.system.components[index].timing.jitter();
        if is_apart(self.system, self.platform) {
            return Some(execution.saturating_add(blocking).saturating_add(jitter));
        }
        // A cycle that ends after its period would delay the next one, which is not analysed.
        let limit = self.system.components[index].timing.period().map_or(LONGEST, |period| period - jitter);
        let higher = &self.urgency[..place];
        let demands = higher.iter().map(|other| self.demands(*other)).collect::<Option<Vec<Vec<Demand>>>>()?;
        let needed: f64 =
            demands.iter().flatten().map(|demand| demand.execution as f64 / demand.period.max(1) as f64).sum();
        if needed >= self.platform.processors as f64 && !demands.is_empty() {
            return None;
        }
        if self.platform.processors == 1 {
            return Some(on_one(execution, blocking, &demands.concat(), limit)?.saturating_add(jitter));
        }
        let with_responses = |(demands, other): (Vec<Demand>, &usize)| {
            // A job of an asynchronous task may still be at work when the next one could begin.
            let [demand] = demands[..] else { return None };
            let response = self.responses[*other].filter(|response| *response <= demand.period)?;
            // That of a synchronous task has its jitter in it.
            let before = match self.system.components[*other].timing {
                Timing::Synchronous { .. } => 0,
                Timing::Asynchronous { .. } => demand.jitter,
            };
            Some((demand, response.saturating_add(before)))
        };
        let all = demands.into_iter().zip(higher).map(with_responses).collect::<Option<Vec<_>>>()?;
        let response = on_several(self.platform.processors, execution.saturating_add(blocking), &all, limit)?;
        Some(response.saturating_add(jitter))
    }

    fn verdict(&self, index: usize) -> Verdict {
        let component = &self.system.components[index];
        let (&Timing::Synchronous { deadline, offset, .. }, Some(available)) =
            (&component.timing, component.available())
        else {
            return Verdict::None;
        };
        if executed(self.system, index).1 + component.timing.jitter() > available {
            return Verdict::Misses;
        }
        let response = self.responses[index];
        if response.is_some_and(|response| response <= available) {
            return Verdict::Meets;
        }
        if response.is_some_and(|response| response <= deadline) {
            return Verdict::Open("a cycle that ends with its period leaves no tick before the next one".to_string());
        }
        let blocking = match &self.blocking[index] {
            Ok(blocking) => *blocking,
            Err(reason) => return Verdict::Open(reason.clone()),
        };
        if is_apart(self.system, self.platform) {
            return Verdict::Open("it gives up an access rather than its deadline where it waits for long".to_string());
        }
        let place = self.urgency.iter().position(|other| *other == index).unwrap_or(0);
        let shifted = |other: &usize| match self.system.components[*other].timing {
            Timing::Synchronous { offset: other, .. } => other != offset,
            Timing::Asynchronous { .. } => true,
        };
        let varies = |other: &usize| self.system.components[*other].timing.jitter() > 0;
        let at_once = !self.urgency[..place].iter().any(shifted) && !self.urgency[..=place].iter().any(varies);
        if self.platform.processors == 1 && blocking == 0 && at_once {
            return Verdict::Misses;
        }
        let shown = |ticks: u64| length(ticks as i64, self.system.tick_ns);
        Verdict::Open(match response {
            Some(response) => format!("the analysis allows {}", shown(response)),
            None => "the more urgent tasks may leave it too little time".to_string(),
        })
    }
}
