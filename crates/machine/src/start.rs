//! The initial state, and what is fixed before it: contents of static domains, layouts, membership checks.
//!
//! Initial values are evaluated eagerly, in the initial state. If one reads another initialised location, that one is
//! evaluated first. They are defined for all arguments, also outside the declared domains. LIMIT: if a location cannot be
//! enumerated, its initial value is evaluated in the initial state when it is first read or written. An initial value
//! need not be in the codomain; only updates must be.

use std::sync::Arc;

use program::{DomainId, DomainKind, FunctionId, FunctionKind, Initial, Program};
use syntax::Span;

use crate::enumerate::extended;
use crate::environment::Closed;
use crate::evaluate::constant;
use crate::execute::{Core, Executor, Outcome};
use crate::limits::Limits;
use crate::membership::membership;
use crate::memo::Memo;
use crate::store::Store;
use crate::update::Updates;
use crate::value::Value;
use crate::weighed::Items;
use crate::work::Work;

/// The epoch of the initial state.
pub(crate) const AT_START: u32 = 1;
/// LIMIT: a function with more locations has its initial values evaluated when they are first read.
const EAGER_LIMIT: u64 = 1 << 20;

impl Core {
    /// A core with all locations undef, laid out for the program.
    pub fn new(program: &Program, limits: &Limits) -> Core {
        let mut core = Core {
            store: Store::new(program, &|_| None, limits.locations),
            updates: Updates::default(),
            frames: Vec::new(),
            base: 0,
            epoch: AT_START,
            inputs: Vec::new(),
            clock: [None; 3],
            iterations: 0,
            work: Work::none(),
            depth: 0,
            calls: Vec::new(),
            constants: program.constants.iter().map(constant).collect(),
            memo: Memo::new(program),
            contents: vec![None; program.domains.len()],
            codomains: Vec::new(),
            coverage: None,
            observations: None,
            initials: vec![None; program.functions.len()],
            in_pieces: false,
            origin: None,
            plain: vec![false; program.functions.len()],
            choices: crate::execute::Choices::default(),
            exploring: false,
            unordered: std::sync::Arc::default(),
            order_mattered: None,
            unset: false,
            entered: false,
            elsewhere: crate::elsewhere::Elsewhere::default(),
            disturbed: true,
            journal: None,
            shared: program.functions.iter().any(|function| function.kind == FunctionKind::Shared),
            compacted: 0,
            asked_first: Vec::new(),
            trail: None,
        };
        core.reset_carriers(program);
        Executor { program, core: &mut core, environment: &mut Closed, limits }.fill_contents();
        let contents = |domain: DomainId| core.contents[domain.0 as usize].as_ref().map(|elements| elements.to_vec());
        let store = Store::new(program, &contents, limits.locations);
        let codomains = program.functions.iter().map(|f| membership(program, f.codomain, &contents)).collect();
        core.memo.lay_out(program, &contents);
        core.store = store;
        core.codomains = codomains;
        core.reset_carriers(program);
        core
    }

    /// Gives every domain its static elements alone.
    pub fn reset_carriers(&mut self, program: &Program) {
        for (carrier, domain) in self.store.carriers.iter_mut().zip(&program.domains) {
            carrier.intermediate.clear();
            match &domain.kind {
                DomainKind::Abstract { elements, .. } => {
                    carrier.count = elements.len() as u32;
                    carrier.fresh = carrier.count;
                }
                DomainKind::Concrete { base, elements, dynamic: true, .. } => {
                    carrier.elements = elements.iter().map(|index| Value::Element(*base, *index)).collect();
                }
                _ => {}
            }
        }
    }
}

impl<'a> Executor<'a> {
    /// Evaluates the contents of the static concrete domains. One that cannot be evaluated yet (it ranges over a
    /// later one) is tried again; one that never can stays without contents and is not enumerable.
    fn fill_contents(&mut self) {
        let program = self.program;
        loop {
            let mut progress = false;
            for (index, domain) in program.domains.iter().enumerate() {
                let DomainKind::Concrete { base, dynamic: false, elements, contents } = &domain.kind else { continue };
                if self.core.contents[index].is_some() {
                    continue;
                }
                let declared = elements.iter().map(|element| Value::Element(*base, *element));
                let mut values: Vec<Value> = declared.collect();
                match contents {
                    Some(expression) => match self.closed(expression) {
                        Ok(Value::Set(defined) | Value::Seq(defined)) => values.extend(defined.iter().cloned()),
                        _ => {
                            self.core.frames.clear();
                            self.core.calls.clear();
                            (self.core.base, self.core.depth) = (0, 0);
                            continue;
                        }
                    },
                    None if values.is_empty() => continue,
                    None => {}
                }
                values.sort_unstable();
                values.dedup();
                self.core.contents[index] = Some(Arc::new(Items::new(values)));
                progress = true;
            }
            if !progress {
                return;
            }
        }
    }

    /// Evaluates an expression without parameters in its own frame.
    pub fn closed(&mut self, expression: &'a program::Expression) -> Outcome<Value> {
        let span = self.program.term_span(expression.body);
        let start = self.core.frames.len();
        self.in_frame(start, expression.frame, span, |this| this.evaluate(expression.body))
    }

    /// Sets the initial state.
    pub fn start(&mut self) -> Outcome<()> {
        let program = self.program;
        for (index, domain) in program.domains.iter().enumerate() {
            let DomainKind::Concrete { dynamic: true, contents: Some(expression), .. } = &domain.kind else { continue };
            if let Value::Set(defined) | Value::Seq(defined) = self.closed(expression)? {
                let carrier = &mut self.core.store.carriers[index];
                carrier.elements.extend(defined.iter().cloned());
                carrier.elements.sort_unstable();
                carrier.elements.dedup();
            }
        }
        for (index, initial) in program.initials.iter().enumerate() {
            self.core.initials[initial.function.0 as usize] = Some(index as u32);
        }
        let sparse = self.core.store.sparse_len();
        for (index, initial) in program.initials.iter().enumerate() {
            if program.function(initial.function).kind == FunctionKind::Monitored {
                // The environment is asked, unless it leaves the initial value in force: see `Executor::ask`.
                continue;
            }
            let follows = self.core.trail.as_ref().is_some_and(|trail| trail.depends(initial.function));
            for arguments in self.argument_tuples(initial.function, initial.span).unwrap_or_default() {
                match follows {
                    true => self.add_place(index, arguments)?,
                    false => _ = self.read_initial(initial.function, &arguments, initial.span)?,
                }
            }
        }
        self.core.memo.changed();
        if program.initials.iter().any(|initial| self.is_read_late(initial)) {
            self.core.origin = Some(Box::new(self.core.store.clone()));
        }
        for (index, declared) in program.functions.iter().enumerate() {
            use FunctionKind::{Controlled, Local, Out};
            let kind = matches!(declared.kind, Controlled | Out | Local);
            self.core.plain[index] = kind && declared.element.is_none() && !self.core.exploring;
        }
        self.end_trail(sparse);
        Ok(())
    }

    /// Whether an initial value reads the state and may be evaluated when that is no longer the initial one.
    fn is_read_late(&mut self, initial: &Initial) -> bool {
        let program = self.program;
        let function = program.function(initial.function);
        if function.parameters.is_empty() || program.reads(&initial.value).is_some_and(|read| read.is_empty()) {
            return false;
        }
        let grows = function.parameters.iter().any(|domain| match program.domain(*domain).kind {
            DomainKind::Abstract { dynamic, .. } | DomainKind::Concrete { dynamic, .. } => dynamic,
            DomainKind::Basic(_) | DomainKind::Enum { .. } => false,
            _ => true,
        });
        grows || self.argument_tuples(initial.function, initial.span).is_none()
    }

    /// Evaluates in the initial state. An input has the value there that it had at the start; one that was not asked for
    /// then is an input of the running step.
    fn in_initial_state<T>(&mut self, body: impl FnOnce(&mut Self) -> Outcome<T>) -> Outcome<T> {
        let Some(mut origin) = self.core.origin.take() else { return body(self) };
        if self.core.exploring
            && let Some(alternatives) = self.environment.alternatives()
        {
            alternatives.look_at_origin();
        }
        let asked = self.core.inputs.len();
        let lent = self.lend_inputs(&mut origin);
        std::mem::swap(&mut self.core.store, &mut origin);
        let epoch = std::mem::replace(&mut self.core.epoch, AT_START);
        self.core.memo.changed();
        // Reads of the initial state are not reads of the present one.
        let exploring = std::mem::take(&mut self.core.exploring);
        let outcome = body(self);
        self.core.exploring = exploring;
        self.core.epoch = epoch;
        std::mem::swap(&mut self.core.store, &mut origin);
        self.take_inputs_over(&mut origin, asked);
        for index in lent {
            (origin.values[index as usize], origin.given[index as usize]) = (Value::Undef, 0);
        }
        self.core.memo.changed();
        self.core.origin = Some(origin);
        outcome
    }

    /// Puts what the running step has asked for into the initial state, where that does not have it; gives where.
    fn lend_inputs(&mut self, origin: &mut Store) -> Vec<u32> {
        let mut lent = Vec::new();
        for (index, function) in &self.core.inputs {
            if self.program.function(*function).kind != FunctionKind::Monitored {
                continue;
            }
            let location = self.core.store.location(*index);
            let there = origin.number(*function, &location.arguments);
            if origin.given[there as usize] == 0 {
                origin.values[there as usize] = self.core.store.values[*index as usize].clone();
                origin.given[there as usize] = AT_START;
                lent.push(there);
            }
        }
        lent
    }

    /// Makes what was asked for in the initial state, after the first so many, inputs of the running step.
    fn take_inputs_over(&mut self, origin: &mut Store, first: usize) {
        for place in first..self.core.inputs.len() {
            let (there, function) = self.core.inputs[place];
            let location = origin.location(there);
            let index = self.core.store.number(function, &location.arguments);
            self.core.inputs[place].0 = index;
            let (there, index) = (there as usize, index as usize);
            if self.program.function(function).kind == FunctionKind::Monitored {
                self.core.store.values[index] = std::mem::take(&mut origin.values[there]);
                origin.given[there] = 0;
            } else if self.core.store.given[index] == 0 {
                self.core.store.values[index] = origin.values[there].clone();
            }
            self.core.store.given[index] = self.core.epoch;
        }
    }

    /// All argument tuples of a function, if they can be enumerated and are not too many.
    fn argument_tuples(&mut self, function: FunctionId, span: Span) -> Option<Vec<Vec<Value>>> {
        let mut tuples = vec![Vec::new()];
        for parameter in &self.program.function(function).parameters {
            let elements = self.listed(*parameter, span).ok()?;
            if tuples.len() as u64 * elements.len() as u64 > EAGER_LIMIT {
                return None;
            }
            tuples = extended(tuples, &elements);
        }
        Some(tuples)
    }

    /// The value of a location that has an initial value: evaluated now if that has not been done yet.
    pub fn read_initial(&mut self, function: FunctionId, arguments: &[Value], span: Span) -> Outcome<Value> {
        let program = self.program;
        let index = self.core.store.number(function, arguments) as usize;
        // `given` marks the locations whose initial value has been set. One that could not be evaluated may have been
        // overwritten.
        if self.core.store.given[index] != 0 || !self.core.store.values[index].is_undef() {
            return Ok(self.core.store.values[index].clone());
        }
        let Some(initial) = self.core.initials[function.0 as usize] else {
            return Ok(self.core.store.values[index].clone());
        };
        let initial = &program.initials[initial as usize];
        let start = self.core.frames.len();
        self.core.frames.extend(arguments.iter().cloned());
        let value = self.in_initial_state(|this| {
            this.in_frame(start, initial.value.frame, span, |this| this.evaluate(initial.value.body))
        })?;
        let index = self.core.store.number(function, arguments);
        self.set_initial(index, function, value.clone());
        Ok(value)
    }

    /// Gives a location its initial value.
    pub fn set_initial(&mut self, location: u32, function: FunctionId, value: Value) {
        let Core { store, trail, epoch, .. } = &mut *self.core;
        store.values[location as usize] = value;
        store.given[location as usize] = *epoch;
        store.touch();
        if let Some(trail) = trail {
            trail.note(location, function);
        }
    }
}
