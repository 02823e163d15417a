//! Where a run takes its inputs, choices and clock from.
//!
//! [`Inputs`] is the machine's [`Environment`]: layers of [`Source`]s, of which the first that has a value for a
//! location gives it; a policy for choices; a clock. It notes what it gave, so the run's record is complete.

use machine::{Choice, Draw, Environment, Fault, Location, LocationRef, Machine, TimeUnit, Value};
use program::{DomainId, Program};

use crate::choose::{ChoiceMade, Choices};
use crate::clock::{Clock, LibraryTime, StepClock, library_time};
use crate::draw::{Bounds, Carriers};
use crate::signal::Signal;

/// A question for an input.
#[derive(Debug)]
pub struct Ask<'a> {
    /// The program.
    pub program: &'a Program,
    /// The step that is being made, from 1; 0 while the initial state is set.
    pub step: u64,
    /// What is asked for.
    pub location: LocationRef<'a>,
    /// The domain of its values.
    pub codomain: DomainId,
    /// It is the clock of a time library: a source that has no value for it by name leaves it to the run's clock.
    pub clock: bool,
    /// The elements of the domains that inputs range over.
    pub carriers: &'a Carriers,
}

impl Ask<'_> {
    /// Whether a value of the type is in the domain asked for, as far as its elements are known.
    pub fn admits(&self, value: &Value) -> bool {
        match self.carriers.get(self.codomain) {
            Some(elements) => value.is_undef() || elements.contains(value),
            None => true,
        }
    }
}

/// One source of input values.
pub trait Source {
    /// The value, or none if this source has none and the next layer must be asked. An error is a sentence for the user
    /// and ends the run.
    fn input(&mut self, ask: &Ask<'_>) -> Result<Option<Value>, String>;

    /// Whether [`Source::writes`] may have any.
    fn has_writes(&self) -> bool {
        false
    }

    /// Values that the environment writes to shared locations before a step.
    fn writes(&mut self, _step: u64) -> Vec<(Location, Value)> {
        Vec::new()
    }

    /// After an error: what the user wanted instead of giving a value.
    fn signal(&mut self) -> Option<Signal> {
        None
    }

    /// The step is over: it counted, or (when stepping back) its inputs are asked for again.
    fn after_step(&mut self, _step: u64, _back: bool) {}
}

/// The environment of a run.
pub struct Inputs {
    layers: Vec<Box<dyn Source>>,
    choices: Choices,
    clock: Box<dyn Clock>,
    carriers: Carriers,
    /// What numbers drawn for choices are bounded by.
    bounds: Bounds,
    /// By function: the time library's clock that it is.
    times_of: Vec<Option<LibraryTime>>,
    /// A domain may have got elements since the carriers were read.
    pub(crate) grown: bool,
    pub(crate) step: u64,
    pub(crate) chosen: Vec<ChoiceMade>,
    pub(crate) times: Vec<(TimeUnit, i64)>,
    pub(crate) keep: bool,
    pub(crate) signal: Option<Signal>,
}

impl std::fmt::Debug for Inputs {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Inputs").field("layers", &self.layers.len()).field("choices", &self.choices).finish()
    }
}

impl Default for Inputs {
    fn default() -> Self {
        Inputs::new()
    }
}

impl Inputs {
    /// No source at all: asking for an input is an error; the first candidate is chosen.
    pub fn new() -> Self {
        Inputs {
            layers: Vec::new(),
            choices: Choices::First,
            clock: Box::new(StepClock::default()),
            carriers: Carriers::default(),
            bounds: Bounds::default(),
            times_of: Vec::new(),
            grown: false,
            step: 0,
            chosen: Vec::new(),
            times: Vec::new(),
            keep: true,
            signal: None,
        }
    }

    /// Adds a source, to be asked after those already there.
    pub fn with(mut self, source: impl Source + 'static) -> Self {
        self.layers.push(Box::new(source));
        self
    }

    /// Sets the policy for choices.
    pub fn choosing(mut self, choices: Choices) -> Self {
        self.choices = choices;
        self
    }

    /// Sets the clock.
    pub fn timed_by(mut self, clock: impl Clock + 'static) -> Self {
        self.clock = Box::new(clock);
        self
    }

    pub(crate) fn prepare(&mut self, machine: &mut Machine) {
        self.carriers = Carriers::of_inputs(machine.program());
        self.carriers.fill(machine);
        self.times_of = machine.program().functions.iter().map(library_time).collect();
    }

    /// Begins a step: forgets the notes of the last one, and writes what the environment writes.
    pub(crate) fn begin(
        &mut self,
        step: u64,
        machine: &mut Machine,
        written: &mut Vec<(Location, Value)>,
    ) -> Result<(), Box<Fault>> {
        self.step = step;
        self.chosen.clear();
        self.times.clear();
        self.clock.begin(step);
        self.choices.begin(step);
        if std::mem::take(&mut self.grown) {
            self.carriers.refresh(machine);
        }
        written.clear();
        for layer in self.layers.iter_mut().filter(|layer| layer.has_writes()) {
            let writes = layer.writes(step);
            if writes.is_empty() {
                continue;
            }
            for (location, value) in writes {
                if !written.iter().any(|(earlier, _)| *earlier == location) {
                    machine.set(&location, value.clone()).map_err(Box::new)?;
                    written.push((location, value));
                }
            }
        }
        Ok(())
    }

    /// Whether steps may follow each other without [`Inputs::begin`]: nothing is noted, and nothing is written before a
    /// step.
    pub(crate) fn can_pass(&self) -> bool {
        !self.keep && !self.layers.iter().any(|layer| layer.has_writes())
    }

    pub(crate) fn finish(&mut self, step: u64, back: bool) {
        for layer in &mut self.layers {
            layer.after_step(step, back);
        }
    }
}

impl Environment for Inputs {
    fn monitored(&mut self, program: &Program, location: LocationRef<'_>, codomain: DomainId) -> Result<Value, String> {
        let time = self.times_of.get(location.function.0 as usize).copied().flatten();
        match (self.ask(program, location, codomain, time.is_some())?, time) {
            (Some(value), _) => Ok(value),
            (None, Some(time)) => Ok(Value::Integer(time.of(&mut *self.clock)?)),
            (None, None) if self.step == 0 => {
                Err(format!("no value is given for {} in the initial state", location.show(program)))
            }
            (None, None) => Err(format!("no value is given for {} in step {}", location.show(program), self.step)),
        }
    }

    fn number(&mut self, _program: &Program, draw: &Draw) -> Result<Value, String> {
        self.choices.number(draw, &self.bounds)
    }

    fn choose(&mut self, program: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        let index = self.choices.choose(program, choice).inspect_err(|_| self.signal = self.choices.signal())?;
        if self.keep {
            self.chosen.push(ChoiceMade {
                span: choice.span,
                of: choice.candidates(),
                index,
                values: choice.candidate(index).to_vec(),
            });
        }
        Ok(index)
    }

    fn step_made(&mut self) {
        self.finish(self.step, false);
        self.step += 1;
        self.clock.begin(self.step);
        self.choices.begin(self.step);
    }

    fn time(&mut self, unit: TimeUnit) -> Result<i64, String> {
        let now = self.clock.now(unit)?;
        if self.keep && self.times.last() != Some(&(unit, now)) {
            self.times.push((unit, now));
        }
        Ok(now)
    }
}

impl Inputs {
    fn ask(
        &mut self,
        program: &Program,
        location: LocationRef<'_>,
        codomain: DomainId,
        clock: bool,
    ) -> Result<Option<Value>, String> {
        let ask = Ask { program, step: self.step, location, codomain, clock, carriers: &self.carriers };
        for layer in &mut self.layers {
            match layer.input(&ask) {
                Ok(Some(value)) => return Ok(Some(value)),
                Ok(None) => {}
                Err(reason) => {
                    self.signal = layer.signal();
                    return Err(reason);
                }
            }
        }
        Ok(None)
    }
}
