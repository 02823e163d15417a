//! Whether two variants of one model make the same steps, so that nothing can tell them apart.
//!
//! In: the programs of a model and of a mutant, which declare the same domains and functions, and terms whose values count.
//! Out: whether both have the same initial states, and from each reachable state the same next states for the same inputs;
//! whether the same conditions on steps fail; whether the terms have the same values. Both are explored side by side, state
//! by state, until the first difference. INVARIANT: two variants are the same only if every reachable state was compared.

use std::collections::BTreeSet;
use std::sync::Arc;

use explore::{Explorer, Interner, Outcome, Settings, Trouble, Truth, Widening, input_values};
use machine::{Bounds, FaultClass, FaultKind, Interrupt, Limits, Location, Value};
use program::{Expression, FunctionId, Program, PropertyKind, Rule};
use rustc_hash::FxHashMap;

/// How far to compare.
#[derive(Debug, Clone, Default)]
pub struct Extent {
    /// The machine's limits.
    pub limits: Limits,
    /// The values to try for inputs, if not all of their domains.
    pub bounds: Bounds,
    /// Inputs that may also be undef.
    pub undefined: BTreeSet<FunctionId>,
    /// The most states.
    pub max_states: u64,
    /// Ends the comparison when raised.
    pub interrupt: Interrupt,
}

/// Why two variants are not known to be the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Differs {
    /// A state, a step or a value differs.
    Somewhere,
    /// There are more states than were compared, or the comparison was interrupted.
    TooFar,
    /// The states cannot be compared one by one: elements are added to domains, or inputs cannot be enumerated.
    Beyond,
}

/// A variant, and the terms whose values count.
#[derive(Debug, Clone, Copy)]
pub struct Variant<'p> {
    /// The program.
    pub program: &'p Arc<Program>,
    /// The terms, as many in both variants.
    pub observed: &'p [Expression],
}

/// Compares two variants.
///
/// # Errors
/// They differ, or it is not known whether they do.
pub fn same(one: Variant<'_>, other: Variant<'_>, extent: &Extent) -> Result<(), Differs> {
    let grows = |variant: &Variant<'_>| variant.program.rules.iter().any(|rule| matches!(rule, Rule::Extend { .. }));
    if grows(&one) || grows(&other) {
        return Err(Differs::Beyond);
    }
    let mut widenings = [Widening::default(), Widening::default()];
    loop {
        let mut sides = Vec::new();
        for (variant, widening) in [one, other].into_iter().zip(&mut widenings) {
            sides.push(Side::new(variant, extent, widening)?);
        }
        match compared(&mut sides, extent) {
            Err(Stop::Narrow(place, widening)) => widenings[place].merge(&widening),
            Err(Stop::Differs(why)) => return Err(why),
            Ok(()) => return Ok(()),
        }
    }
}

/// Why a comparison ends early.
enum Stop {
    Narrow(usize, Widening),
    Differs(Differs),
}

impl From<Differs> for Stop {
    fn from(why: Differs) -> Stop {
        Stop::Differs(why)
    }
}

/// What a state holds.
type Contents = Box<[(Location, Value)]>;

/// Numbers for what states hold and for the inputs of steps, the same for both variants.
#[derive(Default)]
struct Numbers {
    states: FxHashMap<Contents, u32>,
    inputs: FxHashMap<Contents, u32>,
}

fn number(table: &mut FxHashMap<Contents, u32>, mut contents: Vec<(Location, Value)>) -> u32 {
    contents.sort_unstable();
    let next = table.len() as u32;
    *table.entry(contents.into()).or_insert(next)
}

/// What a step comes to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Goal {
    State(u32),
    Fault(usize),
}

/// A step: its inputs, the conditions that fail, where it leads.
type Step = (u32, Vec<u32>, Goal);

/// One of the variants.
struct Side<'p> {
    variant: Variant<'p>,
    explorer: Explorer,
    /// Conditions that states which count satisfy.
    assumed: usize,
    numbers: FxHashMap<Box<[u64]>, u32>,
    /// By number, the state as this variant packs it.
    packed: FxHashMap<u32, Box<[u64]>>,
}

impl<'p> Side<'p> {
    fn new(variant: Variant<'p>, extent: &Extent, widening: &mut Widening) -> Result<Side<'p>, Differs> {
        let bounds = input_values(variant.program, &extent.bounds, &extent.undefined);
        let mut settings = Settings { limits: extent.limits.clone(), bounds: Arc::new(bounds), ..Settings::default() };
        settings.interrupt = extent.interrupt.clone();
        for property in &variant.program.properties {
            let assumed = property.kind == PropertyKind::Invar;
            match property.kind {
                PropertyKind::Invar | PropertyKind::Invariant if property.reads_monitored => {
                    settings.step_conditions.push((property.formula.clone(), assumed));
                }
                PropertyKind::Invar => settings.conditions.push(property.formula.clone()),
                _ => {}
            }
        }
        let assumed = settings.conditions.len();
        loop {
            match Explorer::new(variant.program, settings.clone(), widening, &Arc::<Interner>::default()) {
                Ok(explorer) => {
                    let (numbers, packed) = (FxHashMap::default(), FxHashMap::default());
                    return Ok(Side { variant, explorer, assumed, numbers, packed });
                }
                Err(Trouble::TooNarrow(more)) => widening.merge(&more),
                Err(Trouble::Interrupted(_)) => return Err(Differs::TooFar),
                Err(Trouble::Fault(_) | Trouble::Unbounded(_)) => return Err(Differs::Beyond),
            }
        }
    }

    fn is_assumed(&mut self, state: &[u64]) -> bool {
        (0..self.assumed).all(|condition| self.explorer.truth(condition, state) != Truth::False)
    }

    fn number(&mut self, state: &[u64], numbers: &mut Numbers) -> u32 {
        if let Some(known) = self.numbers.get(state) {
            return *known;
        }
        let found = number(&mut numbers.states, self.explorer.values_and_inputs(state));
        self.numbers.insert(state.into(), found);
        self.packed.entry(found).or_insert_with(|| state.into());
        found
    }

    /// The initial states with the inputs that they read.
    fn starts(&mut self, numbers: &mut Numbers) -> Vec<(u32, u32)> {
        let starts: Vec<(Box<[u64]>, _)> =
            self.explorer.initial().iter().map(|(state, start)| (state.into(), start)).collect();
        let mut found = Vec::new();
        for (state, start) in starts {
            if self.is_assumed(&state) {
                let told = self.explorer.told_of_start(start);
                found.push((number(&mut numbers.inputs, told.inputs), self.number(&state, numbers)));
            }
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    fn steps(&mut self, place: usize, state: u32, numbers: &mut Numbers) -> Result<Vec<Step>, Stop> {
        let packed = self.packed[&state].clone();
        let mut paths = Vec::new();
        match self.explorer.paths(&packed, &mut |path| paths.push((path.inputs, path.failed, path.outcome))) {
            Err(widening) => return Err(Stop::Narrow(place, widening)),
            Ok(false) => return Err(Differs::TooFar.into()),
            Ok(true) => {}
        }
        let mut steps = Vec::new();
        for (inputs, failed, outcome) in paths {
            let goal = match outcome {
                Outcome::Next(next) if self.is_assumed(&next) => Goal::State(self.number(&next, numbers)),
                Outcome::Next(_) | Outcome::Excluded => continue,
                Outcome::Fault(fault) if matches!(fault.kind, FaultKind::Interrupted(_)) => {
                    return Err(Differs::TooFar.into());
                }
                Outcome::Fault(fault) if matches!(fault.kind, FaultKind::Limit { .. }) => {
                    return Err(Differs::Beyond.into());
                }
                Outcome::Fault(fault) => Goal::Fault(FaultClass::of(&fault) as usize),
                Outcome::Unbounded(_) => return Err(Differs::Beyond.into()),
            };
            steps.push((number(&mut numbers.inputs, inputs), failed, goal));
        }
        steps.sort_unstable();
        steps.dedup();
        Ok(steps)
    }

    /// The values of the terms in a state; none where one has no value.
    fn observed(&mut self, state: u32) -> Vec<Option<Value>> {
        let packed = self.packed[&state].clone();
        self.variant.observed.iter().map(|term| self.explorer.evaluate(term, &packed).ok()).collect()
    }
}

fn compared(sides: &mut [Side<'_>], extent: &Extent) -> Result<(), Stop> {
    let [one, other] = sides else { return Err(Differs::Beyond.into()) };
    let mut numbers = Numbers::default();
    let starts = one.starts(&mut numbers);
    if starts != other.starts(&mut numbers) {
        return Err(Differs::Somewhere.into());
    }
    // States are numbered as they are found, so those below the first that was not compared are done.
    let mut at = 0;
    while at < numbers.states.len() as u32 {
        if u64::from(at) >= extent.max_states || extent.interrupt.is_raised() {
            return Err(Differs::TooFar.into());
        }
        if !one.packed.contains_key(&at) || !other.packed.contains_key(&at) {
            return Err(Differs::Somewhere.into());
        }
        if one.steps(0, at, &mut numbers)? != other.steps(1, at, &mut numbers)? {
            return Err(Differs::Somewhere.into());
        }
        if !one.variant.observed.is_empty() && one.observed(at) != other.observed(at) {
            return Err(Differs::Somewhere.into());
        }
        at += 1;
    }
    Ok(())
}
