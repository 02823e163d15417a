//! The choose rule and inputs when every alternative is wanted: see [`crate::alternatives`].
//!
//! If a choose rule has a guard, the alternative is selected before the guards are evaluated, so that an alternative reads
//! only what its own guard reads. INVARIANT: the alternatives that remain are exactly the candidates of the choose rule,
//! in their order. If none remains, the rule for no candidates runs.

use std::ops::ControlFlow;

use program::{Binder, Expression, FunctionId, RuleId, Term, TermId};
use syntax::Span;

use crate::alternatives::is_kept;
use crate::execute::{Executor, Outcome};
use crate::fault::{Fault, FaultKind};
use crate::location::LocationRef;
use crate::value::Value;

impl Executor<'_> {
    /// Notes that a location is read.
    #[cold]
    pub fn note_look(&mut self, function: FunctionId, found: Option<u32>) {
        let kept = is_kept(self.program, function);
        if let Some(alternatives) = self.environment.alternatives() {
            alternatives.look(function, found, kept);
        }
    }

    /// Notes that a location is written. One without a field may have to have its initial value first.
    #[cold]
    pub fn note_write(&mut self, function: FunctionId, found: Option<u32>) {
        let kept = is_kept(self.program, function);
        if let Some(alternatives) = self.environment.alternatives() {
            alternatives.write(found, kept);
        }
    }

    /// Notes that the elements of a dynamic domain are read.
    #[cold]
    pub fn note_carriers(&mut self) {
        if let Some(alternatives) = self.environment.alternatives() {
            alternatives.look_at_carriers();
        }
    }

    /// One of the values that an input takes.
    pub fn ask_among(&mut self, location: LocationRef<'_>) -> Result<Value, String> {
        let declared = self.program.function(location.function);
        let (codomain, span) = (declared.codomain, declared.span);
        if self.environment.alternatives().is_some_and(|alternatives| alternatives.gives(location.function)) {
            return self.environment.monitored(self.program, location, codomain);
        }
        let values = self.listed(codomain, span).ok().filter(|values| !values.is_empty());
        let Some(alternatives) = self.environment.alternatives() else { return Err(String::new()) };
        match values {
            Some(values) => {
                let taken = alternatives.ask(values.len(), false);
                values.get(taken).cloned().ok_or_else(|| "an answer that there is not".to_string())
            }
            None => Err(alternatives.endless_input(location.function, span)),
        }
    }

    /// Whether an alternative of a choose rule can be selected before its guards are evaluated: neither these nor the
    /// ranges ask for anything themselves. A guard over an input may let all candidates fail for one of its values and
    /// none for another.
    pub fn asks_first(&mut self, id: RuleId, binders: &[Binder], condition: Option<TermId>) -> bool {
        let known = &mut self.core.asked_first;
        if known.is_empty() {
            known.resize(self.program.rules.len(), None);
        }
        let program = self.program;
        *known[id.0 as usize].get_or_insert_with(|| {
            let ranges = binders.iter().map(|binder| binder.range);
            let asks_nothing = |term: TermId| {
                let (parameters, names) = (Vec::new(), Vec::new());
                program.reads(&Expression { parameters, frame: 0, names, body: term }).is_some()
            };
            ranges.chain(condition).all(asks_nothing)
        })
    }

    /// Runs a choose rule with the alternative that is due.
    pub fn perform_alternative(
        &mut self,
        id: RuleId,
        binders: &[Binder],
        condition: Option<TermId>,
        body: RuleId,
        if_none: Option<RuleId>,
    ) -> Outcome<()> {
        let program = self.program;
        let span = program.rule_span(id);
        let mut bindings = 0u64;
        // Bindings are counted instead of visited if possible: each is an alternative that comes through here.
        let (grid, counted) = match self.grid(binders) {
            Some(Ok(grid)) => {
                bindings = grid.len;
                (Some(grid), self.check_size(bindings, span))
            }
            Some(Err(fault)) => (None, Err(fault)),
            None => {
                let counted = self.for_each_binding(binders, &mut |this| {
                    bindings += 1;
                    this.check_size(bindings, span)?;
                    Ok(ControlFlow::Continue(()))
                });
                (None, counted.map(|_| ()))
            }
        };
        if let Err(fault) = counted {
            return self.endless_choice(fault, span);
        }
        let none = |this: &mut Self| {
            this.core.went(id, 0);
            if_none.map_or(Ok(()), |rule| this.perform(rule))
        };
        if bindings == 0 {
            return none(self);
        }
        let guard = condition.filter(|condition| match program.term(*condition) {
            Term::Constant(index) => self.core.constants[*index as usize] != Value::Boolean(true),
            _ => true,
        });
        let Some(alternatives) = self.environment.alternatives() else { return Ok(()) };
        let taken = alternatives.ask(bindings as usize, guard.is_some()) as u64;
        if taken == bindings {
            return none(self);
        }
        match grid {
            Some(grid) => self.bind_from(&grid, binders, taken),
            None => {
                let mut passed = 0;
                let _ = self.for_each_binding(binders, &mut |_| {
                    passed += 1;
                    Ok(if passed > taken { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
                })?;
            }
        }
        if let Some(guard) = guard
            && !self.holds(guard)?
        {
            if let Some(alternatives) = self.environment.alternatives() {
                alternatives.be_dead();
            }
            return self.fault(span, FaultKind::Environment { reason: String::new() });
        }
        let values = binders.iter().map(|binder| self.slot(binder.slot).clone()).collect();
        if let Some(alternatives) = self.environment.alternatives() {
            alternatives.chose(span, values);
        }
        self.core.went(id, 1);
        self.perform(body)
    }

    /// Candidates that cannot be listed are no fault of the step here: they are what cannot be explored.
    #[cold]
    pub fn endless_choice(&mut self, fault: Box<Fault>, span: Span) -> Outcome<()> {
        if let FaultKind::NotEnumerable { .. } = fault.kind
            && let Some(alternatives) = self.environment.alternatives()
        {
            alternatives.endless_choice(span);
        }
        Err(fault)
    }
}
