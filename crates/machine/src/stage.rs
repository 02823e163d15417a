//! The stages of a step, on the core: begin, compute the update set, apply it, forget the inputs.
//!
//! In: a core between two steps. Between [`Core::begin_step`] and [`Core::commit`], [`crate::perform`] or
//! [`crate::native`] computes the update set. INVARIANT: only `commit` changes the state.

use program::{DomainKind, FunctionKind, Program};

use crate::execute::Core;
use crate::native;
use crate::step::Step;
use crate::work::Work;

impl Core {
    /// Begins a step: its update set is empty, and it has chosen nothing yet.
    #[inline]
    pub fn begin_step(&mut self) {
        self.updates.release();
        self.iterations = 0;
        self.work = Work::none();
        self.choices.forget();
        self.updates.begin();
    }

    /// No procedure is running, even where the last call ended in a fault.
    #[inline]
    pub fn clear_calls(&mut self) {
        if !self.calls.is_empty() {
            self.frames.clear();
            self.calls.clear();
        }
        (self.base, self.depth) = (0, 0);
    }

    /// Applies the update set. What remains of it is a record of what the step overwrote.
    #[inline]
    pub fn commit(&mut self, program: &Program) -> Step {
        if let Some(journal) = &mut self.journal {
            journal.note_step(&self.store, &self.updates);
        }
        if self.shared {
            self.note_shared(program);
        }
        let created = self.updates.created().len();
        let grown = created > 0;
        let updates = self.updates.len() + created;
        let changed = native::apply(&mut self.store, &mut self.updates) | grown;
        if grown {
            self.grow(program);
        }
        self.updates.settle();
        self.memo.changed();
        Step { updates, changed, grown }
    }

    /// The environment is not asked for a shared location that the machine makes undef.
    #[cold]
    fn note_shared(&mut self, program: &Program) {
        for update in self.updates.stack.iter().filter(|update| update.value.is_undef()) {
            let function = self.store.function_of(update.location);
            if program.function(function).kind == FunctionKind::Shared {
                self.store.given[update.location as usize] = self.epoch;
            }
        }
    }

    /// Adds the elements made to their domains.
    #[cold]
    fn grow(&mut self, program: &Program) {
        for (domain, element) in self.updates.created() {
            let carrier = &mut self.store.carriers[domain.0 as usize];
            if matches!(program.domain(*domain).kind, DomainKind::Abstract { .. }) {
                carrier.count = carrier.fresh;
            } else {
                carrier.elements.push(element.clone());
                carrier.elements.sort_unstable();
            }
        }
    }

    /// Forgets the values of all monitored locations and of the clock, so that a step asks for them again. True if locations
    /// got new numbers.
    #[inline]
    pub fn forget_inputs(&mut self, program: &Program) -> bool {
        self.epoch += 1;
        self.memo.changed();
        self.clock = [None; 3];
        for (index, function) in &self.inputs {
            let (index, function) = (*index, *function);
            if program.function(function).kind == FunctionKind::Monitored {
                self.store.values[index as usize] = crate::Value::Undef;
            }
        }
        self.inputs.clear();
        // Locations can be numbered anew here, because nothing holds a number.
        let crowded = self.store.sparse_len() > 2 * self.compacted + 4096;
        if crowded {
            self.compact(program);
        }
        crowded
    }

    #[cold]
    fn compact(&mut self, program: &Program) {
        let noted = self.journal.as_ref().map(|journal| journal.locations(&self.store));
        self.store.compact(&|location| program.function(location.function).kind != FunctionKind::Monitored);
        if let (Some(journal), Some(locations)) = (&mut self.journal, noted) {
            journal.renumber(&mut self.store, &locations);
        }
        self.updates.renumbered();
        self.updates.release();
        self.compacted = self.store.sparse_len();
    }
}
