//! What a coupling says of single functions and terms of the abstract machine: which term over the concrete machine they are equal to.
//!
//! In: a coupling. Out: a [`Determined`]. A part of the coupling that is an equation, also below *and* and *forall*, determines its left
//! side or its right one; other parts determine nothing here. INVARIANT: in corresponding states both sides of what is noted are equal,
//! for all values of the variables.

use std::collections::BTreeMap;

use machine::Limits;
use program::{Builtin, DomainId, FunctionId, Quantifier, Slot, Term, TermId};

use crate::coupling::{Conjunct, Coupling};
use crate::joint::described;
use crate::{ABSTRACT, CONCRETE};

/// What is known of a function of the abstract machine.
#[derive(Debug, Clone)]
pub(crate) enum Known {
    /// It is this concrete function, at all arguments in its domains; or at all whatever.
    Same { function: FunctionId, everywhere: bool },
    /// It is this term of the joint model, over variables that stand for its arguments.
    Term { parameters: Vec<Slot>, body: TermId },
}

/// A term over the abstract machine that is equal to one over the concrete machine, both of the joint model, for all values of the
/// variables.
#[derive(Debug, Clone)]
pub(crate) struct Equation {
    pub variables: Vec<Slot>,
    pub term: TermId,
    pub equal: TermId,
}

/// See the module.
#[derive(Debug, Default)]
pub(crate) struct Determined {
    /// By function of the abstract machine.
    pub functions: BTreeMap<FunctionId, Known>,
    /// In the order of the coupling.
    pub equations: Vec<Equation>,
}

impl Determined {
    /// What a coupling says.
    pub fn by(coupling: &Coupling, limits: &Limits) -> Determined {
        let mut determined = Determined::default();
        for conjunct in &coupling.conjuncts {
            determined.learn(coupling, limits, conjunct);
        }
        determined
    }

    /// Notes what a part of the coupling says of one function.
    fn learn(&mut self, coupling: &Coupling, limits: &Limits, conjunct: &Conjunct) {
        let joint = &coupling.joint.program;
        match conjunct {
            Conjunct::Same { functions, arguments, .. } => {
                let [one, other] = *functions;
                let [here, there] = [ABSTRACT, CONCRETE].map(|side| coupling.programs[side].function(functions[side]));
                let codomain = |side: usize| {
                    let function = coupling.joint.with_domains_of[side].get(&functions[side])?;
                    Some(joint.base_domain(joint.function(*function).codomain))
                };
                let fits = codomain(ABSTRACT).is_some() && codomain(ABSTRACT) == codomain(CONCRETE);
                let same = here.parameters.len() == there.parameters.len()
                    && here.parameters.iter().zip(&there.parameters).all(|(here, there)| {
                        described(&coupling.programs[ABSTRACT], limits, *here)
                            == described(&coupling.programs[CONCRETE], limits, *there)
                    });
                if fits && same {
                    let known = Known::Same { function: other, everywhere: arguments.is_none() };
                    self.functions.entry(one).or_insert(known);
                }
            }
            Conjunct::Term { formula, .. } => self.learn_of(coupling, formula.body, &[]),
        }
    }

    /// Notes what a term says that holds for all values of these variables.
    fn learn_of(&mut self, coupling: &Coupling, term: TermId, variables: &[(Slot, DomainId)]) {
        let joint = &coupling.joint.program;
        match joint.term(term) {
            Term::Builtin { builtin: Builtin::And, arguments } => {
                joint.term_list(*arguments).iter().for_each(|part| self.learn_of(coupling, *part, variables));
            }
            Term::Builtin { builtin: Builtin::Eq | Builtin::Iff, arguments } => {
                let &[left, right] = joint.term_list(*arguments) else { return };
                self.learn_equation(coupling, left, right, variables);
                self.learn_equation(coupling, right, left, variables);
            }
            Term::Quantified { quantifier: Quantifier::Forall, binders, condition: Some(condition) } => {
                let mut inside = variables.to_vec();
                for binder in joint.binder_list(*binders) {
                    let Term::Domain(domain) = joint.term(binder.range) else { return };
                    inside.push((binder.slot, *domain));
                }
                self.learn_of(coupling, *condition, &inside);
            }
            _ => {}
        }
    }

    /// Notes `left` = `right` if the one is an abstract function at all its arguments, and the other a concrete term.
    fn learn_equation(&mut self, coupling: &Coupling, left: TermId, right: TermId, variables: &[(Slot, DomainId)]) {
        let joint = &coupling.joint.program;
        let Term::Read { function, arguments } = joint.term(left) else {
            return self.learn_term(coupling, left, right, variables);
        };
        let Some((ABSTRACT, there)) = coupling.joint.of.get(function) else { return };
        let declared = joint.function(*function);
        let mut parameters = Vec::new();
        for (argument, domain) in joint.term_list(*arguments).iter().zip(&declared.parameters) {
            let Term::Slot(slot) = joint.term(*argument) else { return };
            // Each variable once, and over all of the domain.
            if parameters.contains(slot) || !variables.contains(&(*slot, *domain)) {
                return;
            }
            parameters.push(*slot);
        }
        let used = |slot: &Slot| parameters.contains(slot);
        let is_concrete = reads(coupling, right, &mut |side| side == CONCRETE);
        if is_concrete
            && variables.iter().all(|(slot, _)| used(slot))
            && joint.base_domain(declared.codomain) == joint.base_domain(joint.term_domain(right))
        {
            self.functions.entry(*there).or_insert(Known::Term { parameters, body: right });
        }
    }

    /// Notes `left` = `right` if the one is a term over the abstract machine alone, and the other over the concrete one.
    fn learn_term(&mut self, coupling: &Coupling, left: TermId, right: TermId, variables: &[(Slot, DomainId)]) {
        let joint = &coupling.joint.program;
        let mut looks = false;
        let is_abstract = reads(coupling, left, &mut |side| {
            looks = true;
            side == ABSTRACT
        });
        let base = |term: TermId| joint.base_domain(joint.term_domain(term));
        if looks && is_abstract && reads(coupling, right, &mut |side| side == CONCRETE) && base(left) == base(right) {
            let variables = variables.iter().map(|(slot, _)| *slot).collect();
            self.equations.push(Equation { variables, term: left, equal: right });
        }
    }
}

/// Whether all functions that a term of the joint model reads are of sides that `fits` admits.
fn reads(coupling: &Coupling, term: TermId, fits: &mut dyn FnMut(usize) -> bool) -> bool {
    let joint = &coupling.joint;
    let mut open = vec![term];
    let mut all = true;
    while let Some(id) = open.pop() {
        if let Term::Read { function, .. } = joint.program.term(id)
            && let Some((side, _)) = joint.of.get(function)
        {
            all &= fits(*side);
        }
        joint.program.each_child_of_term(id, &mut |child| open.push(child));
    }
    all
}
