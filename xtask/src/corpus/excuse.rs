//! Which differences of a run are the peer's defects: decided on the model and the difference alone.
//!
//! In: the program, the trace, one difference. Out: the name of a [`super::reason`], or none. A difference of one value
//! can be mended: our state takes the recorded value on, and the run is compared further.

use std::collections::BTreeSet;

use machine::{Location, Machine};
use program::{DomainKind, Expression, FunctionId, FunctionKind, Program, Rule, Term, TermId};

use super::difference::What;
use super::reason;
use super::state::Listed;
use super::text;
use super::trace::{End, Trace};

/// Decides on differences of one run.
#[derive(Debug)]
pub struct Excuses<'a> {
    program: &'a Program,
    trace: &'a Trace,
    noted: BTreeSet<&'static str>,
}

impl<'a> Excuses<'a> {
    /// For one run.
    pub fn new(program: &'a Program, trace: &'a Trace) -> Self {
        Excuses { program, trace, noted: BTreeSet::new() }
    }

    /// The reasons noted since this was last asked.
    pub fn take(&mut self) -> BTreeSet<&'static str> {
        std::mem::take(&mut self.noted)
    }

    /// Takes a recorded value on, if there is a reason why it differs.
    pub fn mend(
        &mut self,
        machine: &mut Machine,
        listed: &Listed,
        level: usize,
        (location, theirs, ours): (&str, &str, &str),
    ) -> bool {
        let program = self.program;
        let found = listed.location(location).cloned().or_else(|| text::location_of(program, location));
        let Some(reason) = self.value(machine, location, found.as_ref(), level, ours) else { return false };
        self.noted.insert(reason);
        if let Some(found) = found {
            let domain = program.function(found.function).codomain;
            if let Some(value) = text::value(program, domain, theirs) {
                // A value that the domain does not hold cannot be taken on; the run then parts further on.
                let _ = machine.set(&found, value);
            }
        }
        true
    }

    /// A location that the peer never lists.
    pub fn unlisted(&self, location: &Location) -> bool {
        matches!(self.program.function(location.function).kind, FunctionKind::Shared | FunctionKind::Monitored)
    }

    fn value(
        &self,
        machine: &mut Machine,
        name: &str,
        location: Option<&Location>,
        level: usize,
        ours: &str,
    ) -> Option<&'static str> {
        let program = self.program;
        let Some(location) = location else {
            return self.is_aliased_domain(name).then_some(reason::DEFINED_ELEMENT);
        };
        if Some(location.function) == program.result_function {
            return Some(reason::RESULT_STAYS);
        }
        let initial = program.initials.iter().find(|initial| initial.function == location.function);
        if let Some(initial) = initial {
            if ours == "undef" && self.outside(machine, location) {
                return Some(reason::INITIAL_OUTSIDE);
            }
            if self.reads_state(&initial.value) && self.is_first_listed(name, level) {
                return Some(reason::LAZY_INITIAL);
            }
        }
        None
    }

    /// No state before lists the location: the peer has not read it before this step.
    fn is_first_listed(&self, name: &str, level: usize) -> bool {
        let before = self.trace.steps.iter().take(level.saturating_sub(1)).filter_map(|step| step.after.as_ref());
        let lists = |listing: &super::trace::Listing| listing.iter().any(|(location, _)| location == name);
        level == 0 || !(lists(&self.trace.initial) || before.into_iter().any(lists))
    }

    /// A domain one of whose declared elements is defined as another element.
    fn is_aliased_domain(&self, name: &str) -> bool {
        let program = self.program;
        let Some(domain) = program.domains.iter().position(|domain| domain.name == name) else { return false };
        program.functions.iter().any(|function| {
            function.codomain.0 as usize == domain
                && function.parameters.is_empty()
                && function.kind == FunctionKind::Static
                && function.definition.is_some()
        })
    }

    /// An argument is undef or no value of its parameter's domain.
    fn outside(&self, machine: &mut Machine, location: &Location) -> bool {
        let parameters = &self.program.function(location.function).parameters;
        let mut pairs = parameters.iter().zip(&location.arguments);
        pairs.any(|(domain, argument)| argument.is_undef() || !machine.contains(*domain, argument))
    }

    /// An initial value depends on other locations.
    fn reads_state(&self, expression: &Expression) -> bool {
        mentions(self.program, &[expression.body], &|term| match term {
            Term::Read { function, .. } => self.program.function(*function).element.is_none(),
            _ => false,
        })
    }

    /// The reason why a run parts for good, as far as the difference alone tells it. What takes another run to tell is
    /// found by [`super::defect`].
    pub fn parting(&self, what: &What, step: usize) -> Option<&'static str> {
        match what {
            What::Fault { id, text, theirs, .. } => self.fault(id, text, theirs.as_ref(), step),
            What::GoesOn { theirs } => self.stops(theirs),
            What::Value { location, theirs, ours } => self.splits_by_pattern(location, theirs, ours),
            What::Violation { .. } | What::Written { .. } | What::Beyond { .. } => None,
        }
    }

    fn fault(&self, id: &str, text: &str, theirs: Option<&End>, step: usize) -> Option<&'static str> {
        // Both stop, each for what it meets first.
        if theirs.is_some_and(|end| end.status != "OK") {
            return (step > 0).then_some(reason::OTHER_FAULT);
        }
        match id {
            "division-by-zero" => Some(reason::DIVISION),
            "value-outside-domain" if step == 0 => Some(reason::INITIAL_UNCHECKED),
            "domain-not-enumerable" => Some(reason::INFINITE_CHOICE),
            // The same fault there, in the step in which the initial value is first read.
            "no-definition" if step == 0 => {
                let later = self.trace.end.as_ref().and_then(|end| unresolved(&end.message))?;
                text.starts_with(&format!("`{later}` ")).then_some(reason::LAZY_INITIAL)
            }
            _ => None,
        }
    }

    fn stops(&self, theirs: &End) -> Option<&'static str> {
        let message = theirs.message.as_str();
        match theirs.class.as_str() {
            "UnresolvedReferenceException" => {
                let name = unresolved(message)?;
                let mut functions = self.program.functions.iter().filter(|function| function.name == name);
                functions.any(|function| function.library).then_some(reason::NOT_IMPLEMENTED)
            }
            "RuntimeException" if message.starts_with("definition of ") => Some(reason::NO_CONTENTS),
            "NullPointerException" if message.contains("\"updateSet\" is null") && self.runs_unrun() => {
                Some(reason::NOT_RUN)
            }
            "NullPointerException" if message.contains("LocationSet.formatString") => Some(reason::NO_RESULT),
            "NullPointerException" | "ClassCastException" | "IllegalArgumentException" => {
                Some(reason::INTERNAL_FAILURE)
            }
            _ => None,
        }
    }

    /// The model has a rule that the peer parses and does not run.
    fn runs_unrun(&self) -> bool {
        let unrun =
            |rule: &Rule| matches!(rule, Rule::Local { .. } | Rule::Iterate { .. } | Rule::RecursiveWhile { .. });
        self.program.rules.iter().any(unrun)
    }

    /// Both hold the same text, cut at other places.
    fn splits_by_pattern(&self, location: &str, theirs: &str, ours: &str) -> Option<&'static str> {
        let location = text::location_of(self.program, location)?;
        let codomain = self.program.function(location.function).codomain;
        let texts = matches!(&self.program.domain(codomain).kind, DomainKind::Seq(of)
            if matches!(self.program.domain(*of).kind, DomainKind::Basic(model::Basic::String)));
        let joined = |list: &str| list.split(',').collect::<String>();
        (texts
            && theirs != ours
            && joined(theirs).replace(|c: char| !c.is_alphanumeric(), "")
                == joined(ours).replace(|c: char| !c.is_alphanumeric(), ""))
        .then_some(reason::SPLIT)
    }
}

/// The function that the peer could not evaluate.
fn unresolved(message: &str) -> Option<&str> {
    message.split("Unresolved reference ").nth(1)?.split('(').next()
}

/// Whether a term or what it is defined by has a part of some form.
fn mentions(program: &Program, roots: &[TermId], found: &dyn Fn(&Term) -> bool) -> bool {
    let mut entered: BTreeSet<FunctionId> = BTreeSet::new();
    let mut open = roots.to_vec();
    while let Some(id) = open.pop() {
        let term = program.term(id);
        if found(term) {
            return true;
        }
        if let Term::Define { function, .. } = term
            && entered.insert(*function)
        {
            open.extend(program.function(*function).definition.as_ref().map(|definition| definition.body));
        }
        program.each_child_of_term(id, &mut |child| open.push(child));
    }
    false
}
