//! What conditions come to in a state.
//!
//! In: a packed state. Out: the truth of a condition, walked over what was decided before, evaluated by the machine where that
//! does not tell. INVARIANT: of the parts of a condition the first that is not true decides, in the order of the text; an
//! undefined one only if none after it does.

use std::sync::Arc;

use machine::Value;

use crate::explorer::Explorer;
use crate::memory::condition::{Part, Truth};

impl Explorer {
    /// What a condition comes to in a state.
    // The inner loop of a search.
    #[inline(always)]
    pub fn truth(&mut self, condition: usize, state: &[u64]) -> Truth {
        if self.conditions[condition].is_known_true(state, &self.settings.interrupt) {
            return Truth::True;
        }
        for part in 0..self.conditions[condition].parts.len() {
            let truth = self.truth_of_part(condition, part, state);
            if truth != Truth::True {
                return self.truth_from(condition, part, truth, state);
            }
        }
        Truth::True
    }

    /// What a condition comes to in which a part is the first that is not true.
    #[cold]
    fn truth_from(&mut self, condition: usize, part: usize, first: Truth, state: &[u64]) -> Truth {
        let (mut whole, mut others) = (first, part + 1..self.conditions[condition].parts.len());
        // A conjunct after an undefined one may still make the whole false.
        while whole == Truth::Undef
            && let Some(part) = others.next()
        {
            whole = match self.truth_of_part(condition, part, state) {
                Truth::True | Truth::Undef => Truth::Undef,
                truth => truth,
            };
        }
        if !self.settings.unordered.is_empty() {
            // A part after the deciding one might have decided otherwise.
            for part in others {
                let other = self.truth_of_part(condition, part, state);
                if matches!(other, Truth::False | Truth::Fault | Truth::Unknown) && other != whole {
                    let span = self.program.term_span(self.conditions[condition].parts[part].term);
                    self.machine.note_order_mattered(span);
                }
            }
        }
        whole
    }

    #[inline(always)]
    fn truth_of_part(&mut self, condition: usize, part: usize, state: &[u64]) -> Truth {
        let tree = &mut self.conditions[condition].parts[part].tree;
        let mut truth = Truth::True;
        let walked = tree.is_used() && {
            let mut worst = |end| truth = truth.max(Truth::of_end(end));
            tree.walk(state, &self.settings.interrupt, &mut worst).is_ok()
        };
        if walked { truth } else { self.decide(condition, part, state) }
    }

    /// Decides a part of a condition by evaluating it; not known where whoever waits has had enough.
    #[cold]
    pub(super) fn decide(&mut self, condition: usize, part: usize, state: &[u64]) -> Truth {
        let mut worst = Truth::True;
        self.branches.first();
        loop {
            if self.settings.interrupt.is_raised() {
                return Truth::Unknown;
            }
            self.load(state);
            let Part { bindings, term, frame, .. } = &self.conditions[condition].parts[part];
            let (bindings, term, frame) = (Arc::clone(bindings), *term, *frame);
            let outcome = self.machine.evaluate_with(term, frame, &bindings, &mut self.branches);
            if let Err(fault) = &outcome {
                self.branches.note_limit(fault);
            }
            let truth = match outcome {
                Ok(Value::Boolean(true)) => Truth::True,
                Ok(Value::Boolean(false)) => Truth::False,
                Ok(_) => Truth::Undef,
                Err(_) => match self.branches.unbounded {
                    Some(unbounded) => {
                        self.unbounded.insert(unbounded);
                        Truth::Unknown
                    }
                    None => Truth::Fault,
                },
            };
            worst = worst.max(truth);
            if !self.settings.forgetful {
                let tree = &mut self.conditions[condition].parts[part].tree;
                let answers = self.branches.answers();
                tree.learn(&self.encoding.looks, state, &self.branches.events, answers, truth.end());
                self.conditions[condition].front.learned();
            }
            if !self.branches.next() {
                return worst;
            }
        }
    }
}
