//! Decides how a choice gets its candidate: drawn, computed from a number, or out of a list.
//!
//! In: the binders and the condition of a `choose`. Out: a [`Selection`], the same for everything that is generated of the
//! choice. It must not know C++.

use model::Basic;
use program::{Binder, BinderList, DomainId, DomainKind, Program, Term, TermId};

use crate::model::form::is_true;
use crate::model::plan::{Plan, gapless};

/// How a choice gets its candidate.
#[derive(Debug)]
pub(crate) enum Selection {
    /// All its numbers are drawn, so there is one.
    Drawn,
    /// An element of a domain is computed from its number; so many there are.
    Picked(Binder, DomainId, usize),
    /// Candidates are listed, by these binders.
    Listed(Vec<Binder>),
}

/// How a choice with these binders and this condition gets its candidate.
pub(crate) fn selection(program: &Program, plan: &Plan, binders: BinderList, condition: Option<TermId>) -> Selection {
    let binders = program.binder_list(binders);
    let listed: Vec<Binder> =
        binders.iter().filter(|binder| drawn(program, binder, condition).is_none()).copied().collect();
    if condition.is_some_and(|condition| !is_true(program, condition)) {
        return Selection::Listed(listed);
    }
    match listed[..] {
        [] if !binders.is_empty() => Selection::Drawn,
        [binder] => match pickable(program, plan, binder) {
            Some((domain, count)) => Selection::Picked(binder, domain, count),
            None => Selection::Listed(listed),
        },
        _ => Selection::Listed(listed),
    }
}

/// The domain of a binder whose elements can be computed from numbers, and how many it has.
fn pickable(program: &Program, plan: &Plan, binder: Binder) -> Option<(DomainId, usize)> {
    let Term::Domain(domain) = *program.term(binder.range) else { return None };
    let planned = plan.domain(domain);
    let count = match (&program.domain(domain).kind, &planned.contents) {
        (DomainKind::Basic(Basic::Boolean), _) => 2,
        (DomainKind::Enum { literals }, _) => literals.len(),
        (DomainKind::Abstract { elements, .. }, _) if planned.carrier.is_none() => elements.len(),
        (DomainKind::Concrete { .. }, Some(contents)) if planned.carrier.is_none() => {
            gapless(contents)?;
            contents.len()
        }
        _ => 0,
    };
    (count > 0).then_some((domain, count))
}

/// The domain of a binder that ranges over all numbers of a kind without a guard, and the kind.
pub(crate) fn drawn(program: &Program, binder: &Binder, condition: Option<TermId>) -> Option<(DomainId, Basic)> {
    let Term::Domain(domain) = *program.term(binder.range) else { return None };
    let guarded = condition.is_some_and(|condition| !is_true(program, condition));
    match program.domain(domain).kind {
        DomainKind::Basic(basic @ (Basic::Integer | Basic::Natural | Basic::Real)) if !guarded => Some((domain, basic)),
        _ => None,
    }
}
