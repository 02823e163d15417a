//! The executor: what evaluating terms and running rules share.
//!
//! In: a program, the machine's [`Core`] (store, update set, frames) and an environment. It lives for one call of
//! the machine's public face. INVARIANT: after a fault the core holds the state before the call.

use program::{FunctionId, Program, Slot};
use syntax::Span;

use crate::coverage::Coverage;
use crate::elsewhere::Elsewhere;
use crate::environment::{Choice, Draw, Environment, TimeUnit};
use crate::fault::{Fault, FaultKind};
use crate::journal::Journal;
use crate::limits::Limits;
use crate::location::LocationRef;
use crate::membership::Membership;
use crate::memo::Memo;
use crate::observe::Observations;
use crate::store::Store;
use crate::trail::Trail;
use crate::update::Updates;
use crate::value::Value;
use crate::weighed::Items;
use crate::work::Work;

/// What an evaluation gives.
pub(crate) type Outcome<T> = Result<T, Box<Fault>>;

/// The state of a machine and its working memory.
#[derive(Debug)]
pub(crate) struct Core {
    pub store: Store,
    pub updates: Updates,
    /// Frames of the running procedures and definitions, one on top of the other; above the running frame the
    /// values of arguments being gathered and of candidates.
    pub frames: Vec<Value>,
    /// Start of the running frame.
    pub base: usize,
    /// The epoch of inputs: advances when they are forgotten.
    pub epoch: u32,
    /// Locations the environment gave values for in this epoch, with their functions, in the order asked.
    pub inputs: Vec<(u32, FunctionId)>,
    /// The clock's readings in this epoch.
    pub clock: [Option<i64>; 3],
    /// Rounds of loops in this step.
    pub iterations: u64,
    /// What this step has worked.
    pub work: Work,
    /// Depth of calls.
    pub depth: u64,
    /// Calls being made, for the fault's report.
    pub calls: Vec<Span>,
    /// The values of the constant pool.
    pub constants: Vec<Value>,
    /// The values of derived and static functions in this state.
    pub memo: Memo,
    /// The contents of static concrete domains, evaluated once.
    pub contents: Vec<Option<std::sync::Arc<Items>>>,
    /// What the values of each function must be checked for, by function.
    pub codomains: Vec<Membership>,
    /// Counts, where wanted.
    pub coverage: Option<Box<Coverage>>,
    /// What is seen of the steps, where somebody watches.
    pub observations: Option<Box<Observations>>,
    /// The initial values of functions: index into the program's initials, by function.
    pub initials: Vec<Option<u32>>,
    /// Whether collections are kept in pieces: see [`crate::pieces`].
    pub in_pieces: bool,
    /// The initial state, where initial values that are evaluated later may read it.
    pub origin: Option<Box<Store>>,
    /// By function: its locations are read without asking anybody (but one that is undef may yet have an initial
    /// value).
    pub plain: Vec<bool>,
    /// What steps overwrite, where somebody may go back.
    pub journal: Option<Box<Journal>>,
    /// The choices of this step.
    pub choices: Choices,
    /// Every alternative is wanted, and reads are noted: see [`crate::alternatives`].
    pub exploring: bool,
    /// By term, where any is: a range whose elements are to be interchangeable, all of which quantifiers look at.
    pub unordered: std::sync::Arc<[bool]>,
    /// Where a fault may depend on the order of elements.
    pub order_mattered: Option<Span>,
    /// A location was set to undef from outside.
    pub unset: bool,
    /// A procedure was run from outside that is not the main rule.
    pub entered: bool,
    /// What may be otherwise in other states that compiled code runs in.
    pub elsewhere: Elsewhere,
    /// Locations may have got other values than by steps since compiled code last ran.
    pub disturbed: bool,
    /// Some function is shared.
    pub shared: bool,
    /// Sparse locations at the last compaction.
    pub compacted: usize,
    /// By choose rule, as far as it is known: whether its alternative is selected before its guards are evaluated.
    pub asked_first: Vec<Option<bool>>,
    /// What the last start has set, where others follow it.
    pub trail: Option<Box<Trail>>,
}

/// The choices made in a step, so that it makes the same ones if it is started again.
#[derive(Debug, Default)]
pub(crate) struct Choices {
    made: Vec<usize>,
    /// How many of them the step has made so far.
    again: usize,
    /// The same for numbers.
    drawn: Vec<Value>,
    drawn_again: usize,
}

impl Choices {
    /// Lets the environment choose, unless the step made this choice before it was started again.
    pub fn choose(
        &mut self,
        environment: &mut dyn Environment,
        program: &Program,
        choice: &Choice<'_>,
    ) -> Result<usize, String> {
        let chosen = match self.made.get(self.again) {
            Some(chosen) => *chosen,
            None => {
                let chosen = environment.choose(program, choice)?;
                self.made.push(chosen);
                chosen
            }
        };
        self.again += 1;
        Ok(chosen)
    }

    /// Lets the environment draw a number, unless the step drew it before it was started again.
    pub fn number(
        &mut self,
        environment: &mut dyn Environment,
        program: &Program,
        draw: &Draw,
    ) -> Result<Value, String> {
        if self.drawn_again == self.drawn.len() {
            let number = environment.number(program, draw)?;
            self.drawn.push(number);
        }
        self.drawn_again += 1;
        Ok(self.drawn[self.drawn_again - 1].clone())
    }

    /// A new step begins.
    #[inline]
    pub fn forget(&mut self) {
        self.made.clear();
        self.drawn.clear();
        self.repeat();
    }

    /// The step starts again.
    pub fn repeat(&mut self) {
        (self.again, self.drawn_again) = (0, 0);
    }
}

/// One call's view of program, core and environment.
pub(crate) struct Executor<'a> {
    pub program: &'a Program,
    pub core: &'a mut Core,
    pub environment: &'a mut dyn Environment,
    pub limits: &'a Limits,
}

impl Executor<'_> {
    /// A fault at a place.
    #[cold]
    pub fn fault<T>(&self, span: Span, kind: FaultKind) -> Outcome<T> {
        const SHOWN: usize = 8;
        let calls = &self.core.calls;
        let mut chain: Vec<Span> = calls.iter().rev().take(SHOWN).copied().collect();
        if calls.len() > 2 * SHOWN {
            chain.extend(calls[..SHOWN].iter().rev());
        } else {
            chain.extend(calls.iter().rev().skip(SHOWN));
        }
        Err(Box::new(Fault { kind, span, calls: chain }))
    }

    /// The value of a variable.
    #[inline]
    pub fn slot(&self, slot: Slot) -> &Value {
        &self.core.frames[self.core.base + slot.0 as usize]
    }

    /// Binds a variable.
    #[inline]
    pub fn bind(&mut self, slot: Slot, value: Value) {
        let index = self.core.base + slot.0 as usize;
        self.core.frames[index] = value;
    }

    /// Runs `body` in a new frame. Its first slots are the values on the frame stack from `arguments` on.
    pub fn in_frame<T>(
        &mut self,
        arguments: usize,
        frame: u32,
        span: Span,
        body: impl FnOnce(&mut Self) -> Outcome<T>,
    ) -> Outcome<T> {
        if self.core.depth >= self.limits.call_depth {
            return self.fault(span, FaultKind::Limit { limit: "nested calls", value: self.limits.call_depth });
        }
        self.work(1, span)?;
        let base = std::mem::replace(&mut self.core.base, arguments);
        self.core.frames.resize(arguments + frame as usize, Value::Undef);
        self.core.depth += 1;
        self.core.calls.push(span);
        // LIMIT: terms of one body nest no deeper than the parser allows, which a megabyte holds.
        let result = stacker::maybe_grow(1 << 20, 8 << 20, || body(self));
        self.core.calls.pop();
        self.core.depth -= 1;
        self.core.frames.truncate(arguments);
        self.core.base = base;
        result
    }

    /// The clock, read once an epoch.
    pub fn clock(&mut self, unit: TimeUnit, span: Span) -> Outcome<Value> {
        let entry = unit as usize;
        if let Some(time) = self.core.clock[entry] {
            return Ok(Value::Integer(time));
        }
        match self.environment.time(unit) {
            Ok(time) => {
                self.core.clock[entry] = Some(time);
                Ok(Value::Integer(time))
            }
            Err(reason) => self.fault(span, FaultKind::Environment { reason }),
        }
    }

    /// Counts against the limit of collection sizes.
    #[inline]
    pub fn check_size(&self, size: u64, span: Span) -> Outcome<()> {
        if size > self.limits.collection {
            return self
                .fault(span, FaultKind::Limit { limit: "elements of one collection", value: self.limits.collection });
        }
        Ok(())
    }

    /// Counts a round of a loop.
    #[inline]
    pub fn count_iteration(&mut self, span: Span) -> Outcome<()> {
        self.core.iterations += 1;
        if self.core.iterations > self.limits.iterations {
            return self
                .fault(span, FaultKind::Limit { limit: "iterations in one step", value: self.limits.iterations });
        }
        self.work(1, span)
    }

    /// The value of a location, asking the environment where it is an input not yet given.
    pub fn read(&mut self, function: FunctionId, arguments: &[Value], span: Span) -> Outcome<Value> {
        use program::FunctionKind::{Monitored, Shared};
        let declared = &self.program.functions[function.0 as usize];
        if let Some(element) = declared.element {
            return Ok(Value::Element(self.program.base_domain(declared.codomain), element));
        }
        let found = self.core.store.find(function, arguments);
        if self.core.exploring {
            self.note_look(function, found);
        }
        match declared.kind {
            Monitored => {
                if let Some(index) = found.filter(|index| self.core.store.given[*index as usize] == self.core.epoch) {
                    return Ok(self.core.store.values[index as usize].clone());
                }
                self.ask(function, arguments, span)
            }
            Shared => {
                if let Some(index) = found {
                    let value = &self.core.store.values[index as usize];
                    let updates = &self.core.updates;
                    let written = || updates.has_overwritten(index) && !updates.shows_original();
                    if !value.is_undef() || self.core.store.given[index as usize] != 0 || written() {
                        return Ok(value.clone());
                    }
                }
                if self.core.initials[function.0 as usize].is_some() {
                    return self.read_initial(function, arguments, span);
                }
                self.ask(function, arguments, span)
            }
            program::FunctionKind::Static | program::FunctionKind::Derived => Ok(Value::Undef),
            _ => {
                if self.core.initials[function.0 as usize].is_some() {
                    return self.read_initial(function, arguments, span);
                }
                Ok(found.map_or(Value::Undef, |index| self.core.store.values[index as usize].clone()))
            }
        }
    }

    /// Asks the environment for an input and keeps it.
    fn ask(&mut self, function: FunctionId, arguments: &[Value], span: Span) -> Outcome<Value> {
        let location = LocationRef { function, arguments };
        if self.core.initials[function.0 as usize].is_some() && self.environment.keeps_initial(location) {
            return self.read_initial(function, arguments, span);
        }
        let codomain = self.program.function(function).codomain;
        // This also holds while a late initial value is evaluated, which by itself explores nothing.
        let given = if self.environment.alternatives().is_some() {
            self.ask_among(location)
        } else {
            self.environment.monitored(self.program, location, codomain)
        };
        let value = match given {
            Ok(value) => value,
            Err(reason) => return self.fault(span, FaultKind::Environment { reason }),
        };
        if !self.is_member(function, &value) {
            let location = location.to_location();
            return self.fault(span, FaultKind::OutOfDomain { location, value, domain: codomain });
        }
        let index = self.core.store.number(function, arguments);
        self.core.store.values[index as usize] = value.clone();
        self.core.store.given[index as usize] = self.core.epoch;
        self.core.inputs.push((index, function));
        if self.core.shared {
            self.core.store.touch();
        }
        Ok(value)
    }

    /// Asks for an input whose location has a number. False if the environment has none, or if it does not fit.
    pub fn ask_at(&mut self, function: FunctionId, arguments: &[Value], index: u32) -> bool {
        if self.core.initials[function.0 as usize].is_some() || self.environment.alternatives().is_some() {
            return self.ask(function, arguments, self.program.function(function).span).is_ok();
        }
        let codomain = self.program.function(function).codomain;
        let asked = self.environment.monitored(self.program, LocationRef { function, arguments }, codomain);
        let Ok(value) = asked else { return false };
        if !self.is_member(function, &value) {
            return false;
        }
        self.core.store.values[index as usize] = value;
        self.core.store.given[index as usize] = self.core.epoch;
        self.core.inputs.push((index, function));
        if self.core.shared {
            self.core.store.touch();
        }
        true
    }
}
