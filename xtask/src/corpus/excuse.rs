//! Which differences of a run are the peer's defects: decided on the model and the difference alone.
//!
//! In: the program, the trace, one difference. Out: the name of a [`super::reason`], or none. A difference of one value
//! can be mended: our state takes the recorded value on, and the run is compared further.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use machine::{Limits, Location, Machine};
use program::{Builtin, Expression, FunctionId, FunctionKind, Program, Rule, Term, TermId};

use super::difference::What;
use super::reason;
use super::state::Listed;
use super::text;
use super::trace::{End, Step, Trace};

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
    pub fn mend(&mut self, machine: &mut Machine, listed: &Listed, location: &str, theirs: &str, ours: &str) -> bool {
        let program = self.program;
        let found = listed.location(location).cloned().or_else(|| text::location_of(program, location));
        let Some(reason) = self.value(machine, location, found.as_ref(), ours) else { return false };
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
            if self.reads_state(&initial.value) {
                return Some(reason::LAZY_INITIAL);
            }
        }
        None
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

    /// An initial value depends on other locations or on a choice.
    fn reads_state(&self, expression: &Expression) -> bool {
        mentions(self.program, &[expression.body], &|term| match term {
            Term::Read { function, .. } => self.program.function(*function).element.is_none(),
            Term::Builtin { builtin, .. } => *builtin == Builtin::ChooseOne,
            _ => false,
        })
    }

    /// The reason why a run parts for good.
    pub fn parting(&self, what: &What, step: usize) -> Option<&'static str> {
        match what {
            What::Fault { id, text, theirs } => self.fault(id, text, theirs.as_ref(), step),
            What::GoesOn { theirs } => self.stops(theirs, step),
            What::Violation { .. } if self.uses_clock() => Some(reason::CLOCK),
            What::Violation { .. } | What::Value { .. } | What::Written { .. } | What::Beyond { .. } => None,
        }
        .or_else(|| self.initialised_outside(step).then_some(reason::INITIAL_OUTSIDE))
        .or_else(|| self.asked_twice(step).then_some(reason::ASKED_TWICE))
        .or_else(|| self.uses(&[Builtin::NaturalRange]).then_some(reason::RANGE))
        .or_else(|| self.uses(&[Builtin::SetDifference]).then_some(reason::DIFFERENCE))
        .or_else(|| self.reads_self_beside_program().then_some(reason::SELF_KEPT))
        .or_else(|| self.splits_by_pattern(what).then_some(reason::SPLIT))
    }

    fn fault(&self, id: &str, text: &str, theirs: Option<&End>, step: usize) -> Option<&'static str> {
        match id {
            "integer-overflow" => Some(reason::OVERFLOW),
            "division-by-zero" => Some(reason::DIVISION),
            "value-outside-domain" if step == 0 => Some(reason::INITIAL_UNCHECKED),
            "bad-operand" if text.contains("so it is no Natural") => Some(reason::NEGATIVE_NATURAL),
            "domain-not-enumerable" => Some(reason::INFINITE_CHOICE),
            // Both stop, each for what it meets first.
            _ if theirs.is_some_and(|end| end.status != "OK") && step > 0 => Some(reason::OTHER_FAULT),
            _ => None,
        }
    }

    fn stops(&self, theirs: &End, step: usize) -> Option<&'static str> {
        let message = theirs.message.as_str();
        match theirs.class.as_str() {
            "UnresolvedReferenceException" => {
                let name = message.split("Unresolved reference ").nth(1)?.split('(').next()?;
                let functions = || self.program.functions.iter().filter(|function| function.name == name);
                if functions().any(|function| function.library) {
                    return Some(reason::NOT_IMPLEMENTED);
                }
                functions()
                    .any(|f| f.kind == FunctionKind::Static && f.definition.is_none())
                    .then_some(reason::NO_DEFINITION)
            }
            "RuntimeException" if message.contains("is unbound") => Some(reason::UNBOUND),
            "RuntimeException" if message.starts_with("definition of ") => Some(reason::NO_CONTENTS),
            "InvalidValueException" => self.is_new(message, step).then_some(reason::NEW_ELEMENT),
            "NullPointerException" | "ClassCastException" | "IllegalArgumentException" => {
                Some(reason::INTERNAL_FAILURE)
            }
            _ => None,
        }
    }

    /// The value refused is an element that no earlier state lists.
    fn is_new(&self, message: &str, step: usize) -> bool {
        let value = message.split("cannot assign ").nth(1).and_then(|rest| rest.split(' ').next());
        let before = self.trace.steps.get(..step.saturating_sub(1)).and_then(<[Step]>::last);
        let listing = before.and_then(|step| step.after.as_ref()).unwrap_or(&self.trace.initial);
        value.is_some_and(|value| value.contains('!') && !listing.iter().any(|(_, held)| held.contains(value)))
    }

    /// The record lists, up to this step, a value of an initialised function for arguments outside its domains.
    fn initialised_outside(&self, step: usize) -> bool {
        let program = self.program;
        let initialised =
            |name: &str| program.initials.iter().any(|initial| program.function(initial.function).name == name);
        let mut machine = Machine::new(Arc::new(program.clone()), Limits::default());
        let listings = self.trace.steps.iter().take(step).filter_map(|step| step.after.as_ref());
        let locations: BTreeSet<&String> =
            listings.flatten().filter(|(_, value)| value != "undef").map(|(name, _)| name).collect();
        locations.into_iter().any(|name| {
            let named = name.split('(').next().is_some_and(initialised);
            named && text::location_of(program, name).is_some_and(|location| self.outside(&mut machine, &location))
        })
    }

    /// The environment gave one location two values in one step, up to this one.
    fn asked_twice(&self, step: usize) -> bool {
        self.trace.steps.iter().take(step).any(|step| {
            let mut first: BTreeMap<&str, &str> = BTreeMap::new();
            step.inputs.iter().any(|(location, value)| *first.entry(location).or_insert(value) != value.as_str())
        })
    }

    fn uses(&self, builtins: &[Builtin]) -> bool {
        self.program
            .terms
            .iter()
            .any(|term| matches!(term, Term::Builtin { builtin, .. } if builtins.contains(builtin)))
    }

    fn uses_clock(&self) -> bool {
        self.uses(&[Builtin::TimeNanoseconds, Builtin::TimeMilliseconds, Builtin::TimeSeconds])
    }

    /// A rule runs an agent's program and reads `self` itself.
    fn reads_self_beside_program(&self) -> bool {
        let program = self.program;
        program.procedures.iter().any(|procedure| {
            let (mut runs, mut reads) = (false, false);
            let mut open = vec![procedure.body];
            while let Some(id) = open.pop() {
                runs |= matches!(program.rule(id), Rule::RunAgent { .. });
                program.each_child_of_rule(id, &mut |child| open.push(child));
                let mut terms = Vec::new();
                program.each_term_of_rule(id, &mut |term| terms.push(term));
                let is_self = |term: &Term| matches!(term, Term::Read { function, .. } if Some(*function) == program.self_function);
                reads |= mentions(program, &terms, &is_self);
            }
            runs && reads
        })
    }

    fn splits_by_pattern(&self, what: &What) -> bool {
        matches!(what, What::Value { .. }) && self.uses(&[Builtin::Split])
    }
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
