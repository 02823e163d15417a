//! The machine from inside, for engines built on it: its state by the numbers of locations, the update set of the
//! running step, and what a step reads.
//!
//! An engine with its own form of states sets the machine to a state ([`Machine::store_mut`], [`Machine::give`]), lets it
//! make a step ([`Machine::prepare`] with an environment that provides [`crate::Alternatives`]) and reads the update set
//! ([`Machine::updates`]). The number of a dense location is the same in all states. INVARIANT: nothing here changes the
//! meaning of a rule or a term. If the values set could not occur in a run, neither can the step.

use std::sync::Arc;

use program::{Builtin, DomainId, DomainKind, FunctionId, RuleId, Term};
use syntax::Span;

use crate::environment::{Closed, Environment};
use crate::location::Location;
use crate::machine::Machine;
use crate::memo::{fixed_functions, is_fixed_term};
use crate::value::Value;

pub use crate::alternatives::is_kept;
pub use crate::elsewhere::Elsewhere;
pub use crate::enumerate::extended;
pub use crate::layout::LocationIndex;
pub use crate::native::SharedCode;
pub use crate::observe::Observations;
pub use crate::store::Store;

/// A function with more locations does not have all its initial values from the start, see [`Machine::start`].
const EAGER: usize = 1 << 20;

/// The elements of a domain that may grow, where they differ from those it is declared with.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Grown {
    /// The domain.
    pub domain: DomainId,
    /// Of an abstract domain: how many elements it has.
    pub count: u32,
    /// Of a concrete one: its elements, sorted.
    pub elements: Vec<Value>,
}

/// The state.
impl Machine {
    /// The values of the current state.
    #[inline]
    pub fn store(&self) -> &Store {
        &self.core.store
    }

    /// The same, to put other values there. What was remembered of the state is not valid before inputs are next forgotten
    /// ([`Machine::forget_inputs`]).
    #[inline]
    pub fn store_mut(&mut self) -> &mut Store {
        &mut self.core.store
    }

    /// The domains that have other elements than those they are declared with; with those made by the step that is
    /// prepared, if these are wanted.
    pub fn grown(&self, updated: bool) -> Vec<Grown> {
        let core = &self.core;
        let created = if updated { core.updates.created() } else { &[] };
        let each = self.program().domains.iter().enumerate().filter_map(|(index, declared)| {
            let domain = DomainId(index as u32);
            let carrier = &core.store.carriers[index];
            let new = || created.iter().filter(|(of, _)| *of == domain);
            match &declared.kind {
                DomainKind::Abstract { elements, .. } => {
                    let count = if new().next().is_some() { carrier.fresh } else { carrier.count };
                    (count as usize != elements.len()).then(|| Grown { domain, count, elements: Vec::new() })
                }
                DomainKind::Concrete { dynamic: true, .. } => {
                    let mut elements = carrier.elements.clone();
                    elements.extend(new().map(|(_, element)| element.clone()));
                    elements.sort_unstable();
                    elements.dedup();
                    Some(Grown { domain, count: 0, elements })
                }
                _ => None,
            }
        });
        each.collect()
    }

    /// Gives these domains these elements, and all others those that they are declared with.
    pub fn set_grown(&mut self, grown: &[Grown]) {
        let program = Arc::clone(self.program());
        self.core.reset_carriers(&program);
        for Grown { domain, count, elements } in grown {
            let carrier = &mut self.core.store.carriers[domain.0 as usize];
            (carrier.count, carrier.fresh) = (*count, *count);
            carrier.elements.clone_from(elements);
        }
    }

    /// Sets an input that the caller asked for before the step.
    pub fn give(&mut self, index: LocationIndex, function: FunctionId, value: Value) {
        let core = &mut self.core;
        core.store.values[index as usize] = value;
        core.store.given[index as usize] = core.epoch;
        core.inputs.push((index, function));
    }

    /// The state in which initial values that come up late are evaluated, if there may be such.
    pub fn origin(&self) -> Option<&Store> {
        self.core.origin.as_deref()
    }

    /// Evaluates them in this one from now on.
    pub fn set_origin(&mut self, origin: Store) {
        self.core.origin = Some(Box::new(origin));
    }

    /// The locations that may have other values than after the start before, if [`Machine::start_again`] has evaluated only these
    /// anew; and how many inputs, the first, are the same.
    pub fn changed_by_start(&self) -> Option<(&[LocationIndex], usize)> {
        self.core.trail.as_ref().and_then(|trail| trail.changed())
    }

    /// Whether a function has initial values.
    pub fn has_initial(&self, function: FunctionId) -> bool {
        self.core.initials[function.0 as usize].is_some()
    }

    /// The value that the term of a location's initial value has, if it has one.
    pub fn initial_value(&mut self, location: &Location) -> Option<Value> {
        let initial = self.core.initials[location.function.0 as usize]?;
        let value = self.execute(&mut Closed, |executor, program| {
            let initial = &program.initials[initial as usize];
            let start = executor.core.frames.len();
            executor.core.frames.extend(location.arguments.iter().cloned());
            executor.in_frame(start, initial.value.frame, initial.span, |this| this.evaluate(initial.value.body))
        });
        value.ok()
    }

    /// By function: its initial values depend on its arguments alone, and some of them are not there from the start.
    pub fn late_initials(&mut self) -> Vec<bool> {
        let program = Arc::clone(self.program());
        let fixed = fixed_functions(&program);
        let constant = program.constant_domains();
        let mut late = vec![false; program.functions.len()];
        for initial in &program.initials {
            let body = initial.value.body;
            let chooses = matches!(program.term(body), Term::Builtin { builtin: Builtin::ChooseOne, .. });
            let mut locations = 1usize;
            for parameter in &program.function(initial.function).parameters {
                let listed = constant[parameter.0 as usize] && program.is_listable(*parameter);
                let count = match listed {
                    true => self.elements(*parameter).map_or(usize::MAX, |elements| elements.len()),
                    false => usize::MAX,
                };
                locations = locations.saturating_mul(count);
            }
            late[initial.function.0 as usize] = locations > EAGER && !chooses && is_fixed_term(&program, body, &fixed);
        }
        late
    }
}

/// The step that is prepared.
impl Machine {
    /// Its updates, in no order.
    pub fn updates(&self) -> impl Iterator<Item = (LocationIndex, &Value)> {
        self.core.updates.net(&self.core.store)
    }

    /// The value that it gives a location, if it does.
    pub fn update_of(&self, location: LocationIndex) -> Option<&Value> {
        self.core.updates.held(location).map(|update| &update.value)
    }

    /// Whether it makes elements of a domain.
    pub fn creates(&self) -> bool {
        !self.core.updates.created().is_empty()
    }
}

/// Steps by compiled code alone.
impl Machine {
    /// Compiles the main rule for the states that are reached from the present one, or takes the code that was `shared` by
    /// another machine; whether there is code. It relies on nothing that is `elsewhere` otherwise.
    pub fn compile_steps(&mut self, elsewhere: Elsewhere, shared: &SharedCode) -> bool {
        self.core.elsewhere = elsewhere;
        self.compile_main(shared)
    }

    /// Whether the state that a compiled step leads to may stand in the store until the step is dropped, where its update set is not
    /// needed otherwise: for whoever asks for nothing but the updates before that.
    pub fn let_stand(&mut self, may: bool) {
        self.core.updates.stays = may;
    }

    /// Computes the main rule's update set as [`Machine::prepare`] does, without noting what is looked at, by the code of
    /// [`Machine::compile_steps`]. False where the code does not know, for a fault perhaps: then nothing is prepared.
    #[inline]
    pub fn prepare_compiled(&mut self, environment: &mut dyn Environment) -> bool {
        self.begin();
        let computed = self.runs_compiled(environment);
        if !computed {
            self.discard();
        }
        computed
    }

    /// Whether a rule has run in compiled code.
    pub fn has_run_compiled(&self, rule: RuleId) -> bool {
        self.main_engine().is_some_and(|engine| engine.code().has_run(rule))
    }
}

/// What is gone through, and what is noted of it.
impl Machine {
    /// From now on, the environment's [`crate::Alternatives`] hear what steps read, and select what they choose.
    pub fn explore(&mut self) {
        self.core.exploring = true;
    }

    /// Whether they hear of pieces of collections from now on, and of edits: see [`crate::Alternatives::keeps_pieces`].
    pub fn keep_in_pieces(&mut self, keep: bool) {
        self.core.in_pieces = keep;
    }

    /// From now on the elements of these ranges, by term, are interchangeable: quantifiers look at all of them, and where a
    /// fault may depend on their order [`Machine::order_mattered`] tells. Empty: none are.
    pub fn set_unordered(&mut self, ranges: Arc<[bool]>) {
        self.core.unordered = ranges;
        // Remembered values may come from quantifiers that read more elements, or fewer.
        self.core.memo.forget();
    }

    /// Where it was found that a fault may depend on the order of interchangeable elements.
    pub fn order_mattered(&self) -> Option<Span> {
        self.core.order_mattered
    }

    /// Notes that it may here.
    pub fn note_order_mattered(&mut self, span: Span) {
        self.core.order_mattered.get_or_insert(span);
    }

    /// What happens in steps is noted there from now on, if anywhere; gives where it was until now.
    pub fn watch(&mut self, observations: Option<Box<Observations>>) -> Option<Box<Observations>> {
        std::mem::replace(&mut self.core.observations, observations)
    }

    /// Where what happens in steps is noted.
    pub fn watched(&mut self) -> Option<&mut Observations> {
        self.core.observations.as_deref_mut()
    }
}
