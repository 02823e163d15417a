//! Questions about the elements of a domain: are they the same in all states, are they known before a run starts, and is
//! it worth listing them.
//!
//! In: a program. Out: an answer for each domain, without a state. INVARIANT: a domain called constant has the same elements
//! in every state of every run.

use crate::ir::{DomainKind, Program, Rule, Term, TermId};
use model::{Basic, DomainId};

impl Program {
    /// By domain, whether it has the same elements in all states of all runs.
    ///
    /// A domain differs between states if a rule extends it, or if its first elements depend on the environment. What a
    /// domain is declared to be does not matter: one that may grow is constant if nothing extends it.
    pub fn constant_domains(&self) -> Vec<bool> {
        let mut constant = vec![true; self.domains.len()];
        self.each_extended(&mut |domain| constant[domain.0 as usize] = false);
        // Contents and types may refer to domains in any order.
        loop {
            let varying = |index: &usize| constant[*index] && !self.has_constant_parts(*index, &constant);
            let Some(index) = (0..self.domains.len()).find(varying) else { return constant };
            constant[index] = false;
        }
    }

    /// Whether it is worth listing a domain's elements, as far as that can be done: there are about as many as its
    /// declaration or its contents name, or they are tuples of such elements. There are exponentially many sets.
    pub fn is_listable(&self, domain: DomainId) -> bool {
        match &self.domain(domain).kind {
            DomainKind::Basic(Basic::Boolean)
            | DomainKind::Enum { .. }
            | DomainKind::Abstract { .. }
            | DomainKind::Concrete { .. } => true,
            DomainKind::Prod(parts) => parts.iter().all(|part| self.is_listable(*part)),
            DomainKind::Error
            | DomainKind::Any
            | DomainKind::Basic(_)
            | DomainKind::Seq(_)
            | DomainKind::Powerset(_)
            | DomainKind::Bag(_)
            | DomainKind::Map(..)
            | DomainKind::Rule(_) => false,
        }
    }

    /// Whether the elements of a domain are computed only when a run starts, even if every run has the same.
    pub fn waits_for_start(&self, domain: DomainId) -> bool {
        match &self.domain(domain).kind {
            DomainKind::Concrete { dynamic, contents, .. } => *dynamic && contents.is_some(),
            DomainKind::Seq(part) | DomainKind::Powerset(part) | DomainKind::Bag(part) => self.waits_for_start(*part),
            DomainKind::Map(from, to) => self.waits_for_start(*from) || self.waits_for_start(*to),
            DomainKind::Prod(parts) => parts.iter().any(|part| self.waits_for_start(*part)),
            DomainKind::Error
            | DomainKind::Any
            | DomainKind::Basic(_)
            | DomainKind::Enum { .. }
            | DomainKind::Abstract { .. }
            | DomainKind::Rule(_) => false,
        }
    }

    /// Calls `visit` with each domain that some rule makes elements of: the one that is extended, and its type.
    fn each_extended(&self, visit: &mut dyn FnMut(DomainId)) {
        for rule in &self.rules {
            match rule {
                Rule::Extend { domain, .. } => {
                    visit(*domain);
                    visit(self.base_domain(*domain));
                }
                Rule::Skip
                | Rule::Update { .. }
                | Rule::Call { .. }
                | Rule::TurboCall { .. }
                | Rule::RunValue { .. }
                | Rule::RunAgent { .. }
                | Rule::Par(_)
                | Rule::Seq(_)
                | Rule::If { .. }
                | Rule::Switch { .. }
                | Rule::Let { .. }
                | Rule::Choose { .. }
                | Rule::Forall { .. }
                | Rule::Iterate(_)
                | Rule::While { .. }
                | Rule::RecursiveWhile { .. }
                | Rule::Return { .. }
                | Rule::Local { .. } => {}
            }
        }
    }

    /// Whether a domain that no rule extends is constant, if those known not to be are the only ones that are not.
    fn has_constant_parts(&self, index: usize, constant: &[bool]) -> bool {
        let is_constant = |domain: &DomainId| constant[domain.0 as usize];
        match &self.domains[index].kind {
            DomainKind::Seq(part) | DomainKind::Powerset(part) | DomainKind::Bag(part) => is_constant(part),
            DomainKind::Map(from, to) => is_constant(from) && is_constant(to),
            DomainKind::Prod(parts) => parts.iter().all(is_constant),
            // The elements of a static domain are computed once, before the first state; those of a dynamic one when a run
            // starts, when the environment can be asked.
            DomainKind::Concrete { dynamic: true, contents: Some(contents), .. } => {
                self.reads(contents).is_some_and(|read| read.is_empty())
                    && !self.ranges_over(contents.body, &|domain| !is_constant(&domain))
            }
            DomainKind::Concrete { .. }
            | DomainKind::Error
            | DomainKind::Any
            | DomainKind::Basic(_)
            | DomainKind::Enum { .. }
            | DomainKind::Abstract { .. }
            | DomainKind::Rule(_) => true,
        }
    }

    /// Whether a term ranges over such a domain, directly or through definitions.
    fn ranges_over(&self, term: TermId, such: &dyn Fn(DomainId) -> bool) -> bool {
        let mut entered = vec![false; self.functions.len()];
        let mut open = vec![term];
        while let Some(id) = open.pop() {
            match self.term(id) {
                Term::Domain(domain) if such(*domain) => return true,
                Term::Define { function, .. } if !std::mem::replace(&mut entered[function.0 as usize], true) => {
                    open.extend(self.function(*function).definition.as_ref().map(|definition| definition.body));
                }
                Term::Domain(_)
                | Term::Define { .. }
                | Term::Constant(_)
                | Term::Slot(_)
                | Term::Read { .. }
                | Term::Builtin { .. }
                | Term::Tuple(_)
                | Term::Project { .. }
                | Term::Collection { .. }
                | Term::Range { .. }
                | Term::Comprehension { .. }
                | Term::Quantified { .. }
                | Term::If { .. }
                | Term::Switch { .. }
                | Term::Let { .. }
                | Term::Rule(_)
                | Term::Unbound
                | Term::Missing(_)
                | Term::Coerce(_) => {}
            }
            self.each_child_of_term(id, &mut |child| open.push(child));
        }
        false
    }
}
