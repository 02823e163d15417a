//! Makes the steps of packed states. It gives nothing a number, so that several threads may make steps for one search.
//!
//! In: a coupling, and one of its machines with its bounds. Out: of a packed state its [`Steps`], in the order of its alternatives. INVARIANT:
//! they are all of them, or [`Stopped`] says why there are none; they depend on the state alone, not on who makes them.

use std::ops::ControlFlow;
use std::sync::Arc;

use explore::{
    Explorer, Interner, Outcome, Path, Reading, Settings, Starts, Told, Trouble, Truth, Unbounded, Visitor, Widening,
    input_values,
};
use machine::{Fault, FaultKind, Interrupt, Location, Value};
use program::{Program, PropertyKind};
use rustc_hash::FxHashSet;

use super::Stopped;
use crate::CONCRETE;
use crate::computed::{Computed, Values};
use crate::coupling::Coupling;
use crate::joint::Bridge;
use crate::limited::limited;
use crate::options::Extent;

/// The steps of a state.
#[derive(Debug)]
pub(crate) enum Steps {
    /// Nobody has to know more than where they lead: the words of the next states, each once.
    Plain(Vec<u64>),
    /// Each with what it read.
    Labelled(Vec<Step>),
}

/// A step of which somebody has to know what it read.
#[derive(Debug)]
pub(crate) struct Step {
    pub read: Vec<(Location, Value)>,
    /// The inputs of the abstract machine that are terms over it.
    pub values: Values,
    pub leads: Leads,
}

/// Where a [`Step`] leads.
#[derive(Debug)]
pub(crate) enum Leads {
    /// To a state.
    State(Box<[u64]>),
    /// It cannot be made.
    Fault(String),
    /// What it comes to cannot be gone through.
    Open(Unbounded),
    /// Assumptions leave it out, or it ends the runs that count; what it looked at matters all the same.
    Nowhere,
}

/// What makes steppers of one machine alike: states that one of them has packed are those of all.
#[derive(Clone)]
pub(crate) struct Recipe<'c> {
    coupling: &'c Coupling,
    place: usize,
    settings: Settings,
    widening: Widening,
    interner: Arc<Interner>,
    /// The initial states, once they are made.
    starts: Option<Arc<Starts>>,
    /// A step has to be known with what it reads.
    labelled: bool,
    assumed: usize,
}

impl<'c> Recipe<'c> {
    /// Of one of the two machines.
    pub fn new(
        coupling: &'c Coupling,
        place: usize,
        extent: &Extent,
        packing: (&Widening, &Arc<Interner>),
    ) -> Recipe<'c> {
        let program = &coupling.programs[place];
        let bounds = input_values(program, &extent.bounds, &extent.undefined);
        let mut settings = Settings { limits: extent.limits.clone(), bounds: Arc::new(bounds), ..Settings::default() };
        settings.interrupt = extent.interrupt.clone();
        for property in program.properties.iter().filter(|property| property.kind == PropertyKind::Invar) {
            match property.reads_monitored {
                true => settings.step_conditions.push((property.formula.clone(), true)),
                false => settings.conditions.push(property.formula.clone()),
            }
        }
        let computed = computed(coupling, place, &settings);
        settings.read_in_steps = computed.as_ref().map(Computed::readers).unwrap_or_default();
        let shares = !coupling.shared[place].is_empty();
        let labelled = shares || computed.is_some() || !limited(program, extent).is_empty();
        let (widening, interner, assumed) = (packing.0.clone(), Arc::clone(packing.1), settings.conditions.len());
        Recipe { coupling, place, settings, widening, interner, starts: None, labelled, assumed }
    }

    /// The same for steppers that this ends.
    pub fn ended_by(mut self, interrupt: &Interrupt) -> Recipe<'c> {
        self.settings.interrupt = interrupt.clone();
        self.settings.limits.interrupt = interrupt.clone();
        self
    }

    /// The values that have numbers in the states.
    pub fn interner(&self) -> &Interner {
        &self.interner
    }

    /// The machine's values in the joint model.
    pub fn bridge(&self) -> &'c Bridge {
        &self.coupling.joint.bridges[self.place]
    }

    /// The first stepper, whose initial states the others have.
    ///
    /// # Errors
    /// The initial states cannot be made.
    pub fn first(&mut self) -> Result<Stepper, Trouble> {
        let stepper = self.stepper()?;
        self.starts = Some(stepper.explorer.starts());
        Ok(stepper)
    }

    /// A stepper.
    ///
    /// # Errors
    /// See [`Recipe::first`].
    pub fn stepper(&self) -> Result<Stepper, Trouble> {
        let Recipe { coupling, place, settings, widening, interner, starts, labelled, assumed } = self;
        let program = Arc::clone(&coupling.programs[*place]);
        Ok(Stepper {
            place: *place,
            explorer: Explorer::like(&program, settings.clone(), widening, interner, starts.as_ref())?,
            program,
            computed: computed(coupling, *place, settings),
            assumed: *assumed,
            labelled: *labelled,
            ends_at_overflow: *place == CONCRETE && coupling.overflow,
        })
    }
}

/// Inputs of the abstract machine that are terms over steps of the concrete one.
fn computed(coupling: &Coupling, place: usize, settings: &Settings) -> Option<Computed> {
    if place == CONCRETE { Computed::of(coupling, &settings.limits) } else { None }
}

/// See the module.
pub(crate) struct Stepper {
    /// Which of the two machines it is.
    place: usize,
    program: Arc<Program>,
    pub explorer: Explorer,
    /// Inputs of the abstract machine that are terms over this machine's steps.
    computed: Option<Computed>,
    /// So many conditions are satisfied by states that count.
    assumed: usize,
    labelled: bool,
    /// A number beyond 64 bits ends a run, and is no fault.
    ends_at_overflow: bool,
}

impl Stepper {
    /// Whether the assumptions hold in a state. One that cannot be evaluated counts against a refinement: such a state of the concrete machine
    /// has to be answered, and one of the abstract machine is no answer.
    pub fn is_assumed(&mut self, state: &[u64]) -> bool {
        (0..self.assumed).all(|condition| match self.explorer.truth(condition, state) {
            Truth::True => true,
            Truth::False | Truth::Undef => false,
            Truth::Fault | Truth::Unknown => self.place == CONCRETE,
        })
    }

    /// The steps of a state, of which there may be so many.
    ///
    /// # Errors
    /// They cannot be gone through to the end.
    pub fn steps(&mut self, state: &[u64], most: u64, bridge: &Bridge) -> Result<Steps, Stopped> {
        if !self.labelled
            && most == u64::MAX
            && let Some(plain) = self.plain(state)?
        {
            return Ok(Steps::Plain(plain));
        }
        self.with_reads(state, most, bridge).map(Steps::Labelled)
    }

    /// The steps as a search makes them: remembered or compiled. None if somebody has to know more of a step than where it leads.
    fn plain(&mut self, state: &[u64]) -> Result<Option<Vec<u64>>, Stopped> {
        let mut successors = Vec::new();
        let expansion = match self.explorer.expand(state, &mut successors) {
            Err(widening) => return Err(Stopped::Narrow(self.place, widening)),
            Ok(expansion) if expansion.interrupted => return Err(Stopped::Interrupted),
            Ok(expansion) => expansion,
        };
        if expansion.faults != [0; 3] || expansion.unbounded > 0 {
            return Ok(None);
        }
        let mut next = Vec::with_capacity(successors.len());
        let mut seen = FxHashSet::default();
        let stays = (expansion.stayed > 0).then_some(state);
        for successor in successors.chunks_exact(state.len().max(1)).chain(stays) {
            if seen.insert(successor) && self.is_assumed(successor) {
                next.extend_from_slice(successor);
            }
        }
        Ok(Some(next))
    }

    /// The steps with the inputs of each, by the machine.
    fn with_reads(&mut self, state: &[u64], most: u64, bridge: &Bridge) -> Result<Vec<Step>, Stopped> {
        let (paths, whole) = self.paths(state, most, bridge);
        match whole {
            Ok(true) if paths.len() as u64 > most => return Err(Stopped::Many),
            Err(widening) => return Err(Stopped::Narrow(self.place, widening)),
            Ok(false) => return Err(Stopped::Interrupted),
            Ok(true) => {}
        }
        let mut steps = Vec::with_capacity(paths.len());
        for (Path { inputs: read, outcome, .. }, values) in paths {
            let leads = match outcome {
                Outcome::Next(next) if self.is_assumed(&next) => Leads::State(next),
                Outcome::Fault(fault) if matches!(fault.kind, FaultKind::Interrupted(_)) => {
                    return Err(Stopped::Interrupted);
                }
                Outcome::Fault(fault) if !self.is_end(&fault) => Leads::Fault(self.told(&fault)),
                Outcome::Unbounded(unbounded) => Leads::Open(unbounded),
                Outcome::Next(_) | Outcome::Fault(_) | Outcome::Excluded => Leads::Nowhere,
            };
            steps.push(Step { read, values, leads });
        }
        Ok(steps)
    }

    /// The alternatives of a state, each with the inputs that are terms over it; and whether they are all.
    pub fn paths(
        &mut self,
        state: &[u64],
        most: u64,
        bridge: &Bridge,
    ) -> (Vec<(Path, Values)>, Result<bool, Widening>) {
        let mut paths =
            Paths { computed: self.computed.as_mut(), bridge, most, values: Values::new(), found: Vec::new() };
        let whole = self.explorer.paths_read(state, &mut paths);
        (paths.found, whole)
    }

    /// All there is to say of an alternative.
    pub fn tell(&mut self, state: &[u64], picks: &[u32], bridge: &Bridge) -> Told {
        let Stepper { explorer, computed, .. } = self;
        let mut read = |step: &mut Reading<'_>| match computed {
            Some(computed) => computed.values(step, bridge).map(|_| ()),
            None => Ok(()),
        };
        explorer.tell_read(state, picks, &mut read)
    }

    /// A fault in words.
    pub fn told(&self, fault: &Fault) -> String {
        fault.show(&self.program).to_string()
    }

    /// Whether a fault only says that runs are looked at no further.
    pub fn is_end(&self, fault: &Fault) -> bool {
        self.ends_at_overflow && matches!(fault.kind, FaultKind::Overflow { .. })
    }
}

/// The alternatives of a state, each with the inputs that are terms over it.
struct Paths<'p> {
    computed: Option<&'p mut Computed>,
    bridge: &'p Bridge,
    /// So many are enough.
    most: u64,
    /// Those of the alternative that is looked at.
    values: Values,
    found: Vec<(Path, Values)>,
}

impl Visitor for Paths<'_> {
    fn read(&mut self, step: &mut Reading<'_>) -> Result<(), Fault> {
        if let Some(computed) = &mut self.computed {
            self.values = computed.values(step, self.bridge)?;
        }
        Ok(())
    }

    fn visit(&mut self, path: Path) -> ControlFlow<()> {
        self.found.push((path, std::mem::take(&mut self.values)));
        if self.found.len() as u64 > self.most { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}
