//! The coupling relation in parts that are small enough to be remembered.
//!
//! In: a coupling. Out: its [`Part`]s, conjunct by conjunct. A term is taken apart at *and*, and at *forall* over elements that no state
//! determines. INVARIANT: a conjunct is true exactly if all of its parts are.

use machine::{Closed, Machine, Value};
use program::{Binder, Builtin, Program, Quantifier, Term, TermId};

use super::Bound;
use super::remembered::Remembered;
use super::same::Same;
use crate::coupling::{Conjunct, Coupling};

/// LIMIT: a conjunct of more parts is a single one.
const PARTS: usize = 1 << 12;

/// A part of the relation.
#[derive(Debug)]
pub(super) enum Part {
    /// A function has the same values in both.
    Same(Same),
    /// A term is true.
    Term(TermPart),
}

/// A term of a conjunct, in a frame of so many slots of which some have values.
#[derive(Debug)]
pub(super) struct TermPart {
    pub of: usize,
    pub term: (TermId, u32),
    pub bound: Vec<Bound>,
    pub known: Remembered,
}

impl Part {
    /// The conjunct that it is a part of.
    pub fn of(&self) -> usize {
        match self {
            Part::Same(same) => same.of,
            Part::Term(part) => part.of,
        }
    }
}

/// All parts of the relation. The machine is one of the joint model.
pub(super) fn parts(coupling: &Coupling, machine: &mut Machine) -> Vec<Part> {
    let mut parts = Vec::new();
    for (of, conjunct) in coupling.conjuncts.iter().enumerate() {
        match conjunct {
            Conjunct::Same { .. } => parts.push(Part::Same(Same::new(of))),
            Conjunct::Term { formula, .. } => {
                let mut apart =
                    Apart { program: &coupling.joint.program, machine, frame: formula.frame, found: Vec::new() };
                let found = match apart.take(formula.body, &[]) {
                    Some(()) => apart.found,
                    None => vec![(formula.body, Vec::new())],
                };
                parts.extend(found.into_iter().map(|(term, bound)| {
                    Part::Term(TermPart { of, term: (term, formula.frame), bound, known: Remembered::default() })
                }));
            }
        }
    }
    parts
}

/// A term that is taken apart.
struct Apart<'a> {
    program: &'a Program,
    machine: &'a mut Machine,
    frame: u32,
    found: Vec<(TermId, Vec<Bound>)>,
}

impl Apart<'_> {
    /// Takes a term apart; none if there are too many parts.
    fn take(&mut self, term: TermId, bound: &[Bound]) -> Option<()> {
        let program = self.program;
        match program.term(term) {
            Term::Builtin { builtin: Builtin::And, arguments } => {
                program.term_list(*arguments).iter().try_for_each(|operand| self.take(*operand, bound))
            }
            Term::Quantified { quantifier: Quantifier::Forall, binders, condition: Some(condition) } => {
                let instances = self.instances(program.binder_list(*binders), bound);
                match instances {
                    Some(instances) => instances.iter().try_for_each(|bound| self.take(*condition, bound)),
                    None => self.whole(term, bound),
                }
            }
            _ => self.whole(term, bound),
        }
    }

    fn whole(&mut self, term: TermId, bound: &[Bound]) -> Option<()> {
        self.found.push((term, bound.to_vec()));
        (self.found.len() <= PARTS).then_some(())
    }

    /// The values of variables; none if a state determines them, or there are too many.
    fn instances(&mut self, binders: &[Binder], bound: &[Bound]) -> Option<Vec<Vec<Bound>>> {
        let mut all = vec![bound.to_vec()];
        for binder in binders {
            let mut more = Vec::new();
            for bound in &all {
                let values = self.elements(binder, bound)?;
                if more.len() + values.len() > PARTS {
                    return None;
                }
                more.extend(values.into_iter().map(|value| [&bound[..], &[(binder.slot, value)]].concat()));
            }
            all = more;
        }
        Some(all)
    }

    fn elements(&mut self, binder: &Binder, bound: &[Bound]) -> Option<Vec<Value>> {
        match self.program.term(binder.range) {
            Term::Domain(domain) => self.machine.elements(*domain).ok(),
            // A function of either machine has no value here.
            _ => match self.machine.evaluate_with(binder.range, self.frame, bound, &mut Closed).ok()? {
                Value::Set(values) | Value::Seq(values) => Some(values.iter().cloned().collect()),
                _ => None,
            },
        }
    }
}
