//! Conditions on states, decided without a machine where the same question has been answered before.
//!
//! In: a formula. It is taken apart at `and` and at `forall` over a fixed domain, since a part looks at less of the state
//! than the whole and so has fewer different answers; each part has its own [`Tree`]. INVARIANT: the truth is that of
//! evaluating the formula from the left.

use std::sync::Arc;

use machine::inside::extended;
use machine::{Interrupt, Machine, Value};
use program::{Builtin, DomainId, Expression, Program, Quantifier, Slot, Term, TermId};

use crate::memory::front::Front;
use crate::memory::tree::{End, Tree};

/// LIMIT: a formula is taken apart into so many parts at most.
const PARTS: usize = 1 << 12;

/// Fewer parts are walked one by one.
const MANY: usize = 8;

/// What a condition comes to in a state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Truth {
    /// It holds.
    True,
    /// It does not.
    False,
    /// It is neither true nor false.
    Undef,
    /// It cannot be evaluated.
    Fault,
    /// It asks for what cannot be gone through.
    Unknown,
}

impl Truth {
    const ALL: [Truth; 5] = [Truth::True, Truth::False, Truth::Undef, Truth::Fault, Truth::Unknown];

    pub(crate) fn end(self) -> End {
        1 + self as End
    }

    #[inline]
    pub(crate) fn of_end(end: End) -> Truth {
        Truth::ALL[end as usize - 1]
    }
}

/// A part of a condition.
#[derive(Debug)]
pub(crate) struct Part {
    /// The slots of the quantified variables.
    pub bindings: Arc<[(Slot, Value)]>,
    pub term: TermId,
    pub frame: u32,
    pub tree: Tree,
}

/// A condition.
#[derive(Debug)]
pub(crate) struct Condition {
    pub parts: Vec<Part>,
    /// Which parts the first field that each looks at decides.
    pub front: Front,
}

impl Condition {
    /// Whether it is known to be true in a state without a look at each part. False also where looking at each is as quick.
    #[inline(always)]
    pub fn is_known_true(&mut self, state: &[u64], interrupt: &Interrupt) -> bool {
        let Condition { parts, front } = self;
        parts.len() >= MANY && front.all_end(parts.len(), |part| &parts[part].tree, Truth::True.end(), state, interrupt)
    }

    /// A condition of a formula without parameters.
    pub fn new(program: &Program, machine: &mut Machine, formula: &Expression) -> Condition {
        let mut condition = Condition { parts: Vec::new(), front: Front::default() };
        let constant = program.constant_domains();
        condition.take_apart(program, &constant, machine, formula.frame, formula.body, Arc::new([]));
        condition
    }

    fn take_apart(
        &mut self,
        program: &Program,
        constant: &[bool],
        machine: &mut Machine,
        frame: u32,
        term: TermId,
        bindings: Arc<[(Slot, Value)]>,
    ) {
        match program.term(term) {
            Term::Builtin { builtin: Builtin::And, arguments } => {
                for conjunct in program.term_list(*arguments) {
                    self.take_apart(program, constant, machine, frame, *conjunct, Arc::clone(&bindings));
                }
                return;
            }
            Term::Quantified { quantifier: Quantifier::Forall, binders, condition: Some(body) } => {
                let binders = program.binder_list(*binders);
                let is_listed = |domain: DomainId| constant[domain.0 as usize] && program.is_listable(domain);
                let elements: Option<Vec<Vec<Value>>> = binders
                    .iter()
                    .map(|binder| match program.term(binder.range) {
                        Term::Domain(domain) if is_listed(*domain) => machine.elements(*domain).ok(),
                        _ => None,
                    })
                    .collect();
                let count = |elements: &Vec<Vec<Value>>| {
                    elements.iter().fold(1usize, |count, elements| count.saturating_mul(elements.len()))
                };
                if let Some(elements) = elements.filter(|elements| self.parts.len() + count(elements) <= PARTS) {
                    let mut all = vec![bindings.to_vec()];
                    for (binder, elements) in binders.iter().zip(&elements) {
                        let column: Vec<_> = elements.iter().map(|value| (binder.slot, value.clone())).collect();
                        all = extended(all, &column);
                    }
                    for bindings in all {
                        self.take_apart(program, constant, machine, frame, *body, bindings.into());
                    }
                    return;
                }
            }
            _ => {}
        }
        self.parts.push(Part { bindings, term, frame, tree: Tree::default() });
    }
}
