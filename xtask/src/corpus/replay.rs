//! A recorded run made again by our machine, compared state by state.
//!
//! In: a program and a [`Trace`]. Out: the first [`Difference`], or none. Where a step makes choices, outcomes are
//! searched whose next state is the recorded one: first choice by choice, then all of them, back into earlier steps
//! where a later one shows that several agreed by chance. A difference for which [`Excuses`] has a reason is noted and
//! mended in our state, so that what follows is compared all the same. LIMIT: [`BUDGET`].

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use machine::{Fault, FaultKind, Limits, Machine, Snapshot, Value};
use program::{Program, PropertyKind};
use syntax::Sources;

use super::difference::{Difference, What};
use super::excuse::Excuses;
use super::inputs::{Habits, Made, RecordedInputs, Samples, next_plan, samples};
use super::script::Script;
use super::state::Listed;
use super::text;
use super::trace::{End, Listing, Step, Trace};

/// LIMIT: how much the search for choices compares in one trace: locations, with some for each step tried.
const BUDGET: usize = 10_000_000;
/// How wrong a step is that is no step at all.
const HOPELESS: usize = 1_000_000;

/// What came of a replay.
#[derive(Debug, Default)]
pub struct Replayed {
    /// The first difference of the attempt that came furthest.
    pub difference: Option<Difference>,
    /// Reasons for differences that were mended on the way.
    pub reasons: BTreeSet<&'static str>,
    /// Inputs asked for that the record does not have.
    pub beyond: BTreeSet<String>,
    /// New elements are numbered otherwise.
    pub renamed: bool,
    /// The search was cut off.
    pub cut: bool,
    /// The run, where it comes out as recorded.
    pub script: Option<Script>,
}

/// Makes the recorded run again.
pub fn replay(program: &Arc<Program>, sources: &Sources, trace: &Trace) -> Replayed {
    let search = |strict| Search::new(program, sources, trace, strict);
    let strict = search(true).run();
    if strict.difference.is_none() {
        return strict;
    }
    let lenient = search(false).run();
    let step = |replayed: &Replayed| replayed.difference.as_ref().map_or(usize::MAX, |difference| difference.step);
    if step(&lenient) >= step(&strict) { lenient } else { strict }
}

struct Search<'a> {
    program: &'a Arc<Program>,
    sources: &'a Sources,
    trace: &'a Trace,
    machine: Machine,
    excuses: Excuses<'a>,
    samples: Samples,
    habits: Habits,
    strict: bool,
    /// How much of the budget is used up.
    spent: usize,
    worst: Option<Difference>,
    beyond: BTreeMap<usize, Vec<String>>,
    reasons: BTreeMap<usize, BTreeSet<&'static str>>,
    /// Our elements by their names in the record, as far as the levels made have shown.
    renaming: BTreeMap<String, String>,
    /// The same after the level being made.
    renaming_next: BTreeMap<String, String>,
    /// How many locations differed at the last comparison.
    wrong: usize,
    /// The level is made for the first time, with the first choices.
    first_plan: bool,
    /// The level being made.
    depth: usize,
    /// The level's choices are so few that all can be tried with care.
    few_choices: bool,
}

/// A level made: the state before it and the choices taken.
struct Level {
    before: Snapshot,
    /// The renaming before it.
    renaming: BTreeMap<String, String>,
    made: Vec<Made>,
    /// Found choice by choice: the count through all choices has not begun.
    guessed: bool,
}

impl<'a> Search<'a> {
    fn new(program: &'a Arc<Program>, sources: &'a Sources, trace: &'a Trace, strict: bool) -> Self {
        let mut machine = Machine::new(Arc::clone(program), limits());
        let samples = samples(&mut machine);
        Search {
            program,
            sources,
            trace,
            machine,
            excuses: Excuses::new(program, trace),
            samples,
            habits: Habits::default(),
            strict,
            spent: 0,
            worst: None,
            beyond: BTreeMap::new(),
            reasons: BTreeMap::new(),
            renaming: BTreeMap::new(),
            renaming_next: BTreeMap::new(),
            wrong: 0,
            first_plan: true,
            depth: 0,
            few_choices: false,
        }
    }

    /// Makes level after level: the initial state, then the steps.
    fn run(mut self) -> Replayed {
        let mut levels: Vec<Level> = Vec::new();
        while levels.len() <= self.trace.steps.len() {
            if self.spent > BUDGET {
                return self.end(true);
            }
            let (before, renaming) = (self.machine.snapshot(), self.renaming.clone());
            let depth = levels.len();
            let (made, outcome) = self.level(depth, Vec::new(), true);
            if outcome.is_ok() {
                levels.push(Level { before, renaming, made, guessed: false });
            } else if let Some(made) = self.guess(depth, &before, made) {
                levels.push(Level { before, renaming, made, guessed: true });
            } else if let Some(made) = self.count(depth, &before, Some(Vec::new())) {
                levels.push(Level { before, renaming, made, guessed: false });
            } else if !self.back(&mut levels) {
                let cut = self.spent > BUDGET;
                return self.end(cut);
            }
        }
        self.worst = None;
        let script = self.reasons.values().all(BTreeSet::is_empty).then(|| self.script(&levels));
        Replayed { script, ..self.end(false) }
    }

    /// Makes the run once more, with the choices found, and notes it.
    fn script(&mut self, levels: &[Level]) -> Script {
        let (mut script, nothing) = (Script::default(), Step::default());
        for (depth, level) in levels.iter().enumerate() {
            let step = self.trace.steps.get(depth.max(1) - 1).unwrap_or(&nothing);
            let plan = level.made.clone();
            let mut inputs = RecordedInputs::new(step, plan, None, self.strict, &self.samples, &level.renaming);
            if !script.advance(&mut self.machine, &mut inputs, depth == 0) {
                break;
            }
        }
        script
    }

    fn end(self, cut: bool) -> Replayed {
        let reasons = self.reasons.into_values().flatten().collect();
        let beyond = self.beyond.into_values().flatten().collect();
        let renamed = self.renaming.iter().any(|(ours, theirs)| ours != theirs);
        Replayed { difference: self.worst, reasons, beyond, renamed, cut, script: None }
    }

    /// Tries the next choices of the last level that has any left.
    fn back(&mut self, levels: &mut Vec<Level>) -> bool {
        while let Some(level) = levels.pop() {
            if level.made.is_empty() || self.spent > BUDGET {
                continue;
            }
            let depth = levels.len();
            self.renaming.clone_from(&level.renaming);
            let from = if level.guessed { Some(Vec::new()) } else { next_plan(&level.made) };
            let made = self.count(depth, &level.before, from);
            // The count meets the guess again.
            let made = match made {
                Some(made) if level.guessed && made == level.made => {
                    self.renaming.clone_from(&level.renaming);
                    self.count(depth, &level.before, next_plan(&made))
                }
                made => made,
            };
            if let Some(made) = made {
                levels.push(Level { made, guessed: false, ..level });
                return true;
            }
        }
        false
    }

    /// Goes through all choices from a plan on until the level agrees.
    fn count(&mut self, depth: usize, before: &Snapshot, mut plan: Option<Vec<Made>>) -> Option<Vec<Made>> {
        while let Some(next) = plan {
            if self.spent > BUDGET {
                return None;
            }
            self.machine.restore(before);
            let (made, outcome) = self.level(depth, next, false);
            if outcome.is_ok() {
                return Some(made);
            }
            plan = next_plan(&made);
        }
        None
    }

    /// Betters one choice after the other until the level agrees or none can be bettered: first with a few candidates of
    /// each, then with all.
    fn guess(&mut self, depth: usize, before: &Snapshot, made: Vec<Made>) -> Option<Vec<Made>> {
        let mut best = (self.wrong, made);
        for few in [true, false] {
            loop {
                let start = best.0;
                let mut order: Vec<usize> = (0..best.1.len()).collect();
                order.sort_by_key(|at| best.1[*at].of);
                for at in order {
                    if let Some(made) = self.better(depth, before, &mut best, at, few) {
                        return Some(made);
                    }
                }
                if self.spent > BUDGET {
                    return None;
                }
                if best.0 >= start {
                    break;
                }
            }
        }
        None
    }

    /// Tries other candidates for one choice; gives the choices with which the level agrees.
    fn better(
        &mut self,
        depth: usize,
        before: &Snapshot,
        best: &mut (usize, Vec<Made>),
        at: usize,
        few: bool,
    ) -> Option<Vec<Made>> {
        let of = best.1.get(at)?.of;
        let stride = if few { of.div_ceil(12) } else { 1 };
        for index in (0..of.min(500)).step_by(stride) {
            if best.1.get(at).is_none_or(|made| made.index == index) || self.spent > BUDGET {
                continue;
            }
            let mut plan = best.1.clone();
            plan[at].index = index;
            self.machine.restore(before);
            let (made, outcome) = self.level(depth, plan, true);
            if outcome.is_ok() {
                return Some(made);
            }
            if self.wrong < best.0 {
                *best = (self.wrong, made);
            }
        }
        None
    }

    /// The initial state (level 0) or a step, with one plan: the choices made, and whether it is as recorded.
    fn level(&mut self, level: usize, plan: Vec<Made>, by_habit: bool) -> (Vec<Made>, Result<(), What>) {
        self.spent += 100;
        self.depth = level;
        self.wrong = HOPELESS;
        self.first_plan = plan.is_empty();
        self.renaming_next.clone_from(&self.renaming);
        self.excuses.take();
        // The peer evaluates initial values when they are first read, mostly in the first step: what they ask for is
        // recorded there.
        let nothing = Step::default();
        let step = self.trace.steps.get(level.max(1) - 1).unwrap_or(&nothing);
        let (samples, renaming) = (std::mem::take(&mut self.samples), self.renaming.clone());
        let habits = std::mem::take(&mut self.habits);
        let by_habit = by_habit.then_some(&habits);
        let mut inputs = RecordedInputs::new(step, plan, by_habit, self.strict, &samples, &renaming);
        let mut outcome = if level == 0 { self.start(&mut inputs) } else { self.step(step, &mut inputs) };
        let RecordedInputs { made, chosen, beyond, .. } = inputs;
        (self.samples, self.habits) = (samples, habits);
        if let (true, true, Some(location)) = (self.strict, outcome.is_ok(), beyond.first()) {
            outcome = Err(What::Beyond { location: location.clone() });
        }
        match &outcome {
            Ok(()) => {
                self.habits.learn(chosen);
                self.beyond.insert(level, beyond);
                self.renaming = std::mem::take(&mut self.renaming_next);
                self.reasons.insert(level, self.excuses.take());
            }
            Err(what) if self.worst.as_ref().is_none_or(|worst| level > worst.step) => {
                self.worst = Some(Difference { step: level, what: what.clone() });
            }
            Err(_) => {}
        }
        (made, outcome)
    }

    fn start(&mut self, inputs: &mut RecordedInputs<'_>) -> Result<(), What> {
        // With no step at all the record ends in the initial state.
        let trace = self.trace;
        let end = trace.end.as_ref().filter(|_| trace.steps.is_empty());
        if let Err(fault) = self.machine.start(inputs) {
            return self.faulted(&fault, end);
        }
        match self.violated(false, inputs) {
            Ok(None) => {}
            Ok(Some(violated)) => return judged(violated, end),
            Err(fault) => return self.faulted(&fault, end),
        }
        if let Some(end) = end.filter(|end| end.status != "OK") {
            return Err(What::GoesOn { theirs: end.clone() });
        }
        self.compare(&trace.initial, None)
    }

    fn step(&mut self, step: &Step, inputs: &mut RecordedInputs<'_>) -> Result<(), What> {
        let end = self.trace.end.as_ref().filter(|end| step.after.is_none() && end.status != "OK");
        if let Err(fault) = self.machine.prepare(inputs) {
            return self.faulted(&fault, end);
        }
        for committed in [false, true] {
            if committed {
                self.machine.commit();
            }
            match self.violated(!committed, inputs) {
                Ok(None) => {}
                Ok(Some(violated)) => return judged(violated, end),
                Err(fault) => return self.faulted(&fault, end),
            }
        }
        match (&step.after, end) {
            (Some(listing), _) => {
                self.few_choices = inputs.made.iter().fold(1usize, |all, made| all.saturating_mul(made.of)) <= 256;
                self.compare(listing, Some(listing))
            }
            (None, Some(end)) => Err(What::GoesOn { theirs: end.clone() }),
            // Ran out of time in this step: nothing to compare with.
            (None, None) => Ok(()),
        }
    }

    fn fault(&self, fault: &Fault, end: Option<&End>) -> What {
        let text = format!("{} ({})", fault.show(self.program), self.sources.position(fault.span));
        What::Fault { id: fault.kind.id().to_string(), text, span: fault.span, theirs: end.cloned() }
    }

    /// A fault agrees with a recorded one of the same sort.
    fn faulted(&self, fault: &Fault, end: Option<&End>) -> Result<(), What> {
        let clash = matches!(fault.kind, FaultKind::InconsistentUpdate { .. });
        match end {
            Some(end) if end.status == "CLASH" && clash => Ok(()),
            Some(end) if end.status == "EXC" && !clash => Ok(()),
            _ => Err(self.fault(fault, end)),
        }
    }

    /// The first invariant that does not hold, of those that read inputs or of the others.
    fn violated(&mut self, reads_monitored: bool, inputs: &mut RecordedInputs<'_>) -> Result<Option<String>, Fault> {
        for property in &self.program.properties {
            if property.kind != PropertyKind::Invariant || property.reads_monitored != reads_monitored {
                continue;
            }
            if self.machine.evaluate(&property.formula, inputs)? != Value::Boolean(true) {
                return Ok(Some(property.name.clone()));
            }
        }
        Ok(None)
    }

    /// Compares the state with a listing; after a step also what the step wrote.
    fn compare(&mut self, listing: &Listing, written: Option<&Listing>) -> Result<(), What> {
        self.spent += listing.len();
        let changes = self.machine.changes();
        let as_made = Listed::of(&mut self.machine, listing);
        let mut listed = as_made.renamed(&self.renaming);
        let mut differences = differences(&listed, listing);
        // First only the elements that are new here are matched, then, once a level, all of them.
        let all = (self.first_plan || self.few_choices).then(BTreeMap::new);
        for known in [Some(self.renaming.clone()), all].into_iter().flatten() {
            if differences.is_empty() || !listing.iter().any(|(_, value)| value.contains('!')) {
                break;
            }
            self.spent += listing.len() * if known.is_empty() { 50 } else { 5 };
            let Some(renaming) = as_made.matching(listing, &known) else { continue };
            let renamed = as_made.renamed(&renaming);
            let remaining = self::differences(&renamed, listing);
            if remaining.len() < differences.len() {
                (listed, differences) = (renamed, remaining);
                self.renaming_next = renaming;
            }
        }
        let mut first = None;
        self.wrong = 0;
        for (location, theirs, ours) in differences {
            let difference = (location.as_str(), theirs.as_str(), ours.as_str());
            if !self.excuses.mend(&mut self.machine, &listed, self.depth, difference) {
                self.wrong += 1;
                first.get_or_insert(What::Value { location, theirs, ours });
            }
        }
        for change in changes.iter().filter(|_| written.is_some()) {
            let key = listed.key(self.program, &change.location);
            if listing.iter().any(|(location, _)| *location == key) || self.excuses.unlisted(&change.location) {
                continue;
            }
            self.wrong += 1;
            first.get_or_insert(What::Written { location: key, ours: text::show(self.program, &change.after) });
        }
        first.map_or(Ok(()), Err)
    }
}

/// Locations of the listing with another value here: location, theirs, ours.
fn differences(listed: &Listed, listing: &Listing) -> Vec<(String, String, String)> {
    let mut found = Vec::new();
    for (location, theirs) in listing {
        let theirs = text::normal(theirs);
        let ours = listed.value(location, &theirs);
        if ours != theirs {
            found.push((location.clone(), theirs, ours.to_string()));
        }
    }
    found
}

fn judged(violated: String, end: Option<&End>) -> Result<(), What> {
    match end {
        Some(end) if end.status == "INVARIANT" => Ok(()),
        end => Err(What::Violation { name: violated, theirs: end.cloned() }),
    }
}

fn limits() -> Limits {
    Limits { iterations: 100_000, collection: 2_000_000, updates: 2_000_000, locations: 5_000_000, ..Limits::default() }
}
