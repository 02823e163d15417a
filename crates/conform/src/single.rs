//! A step of the model's own main rule in which one task has its turn.
//!
//! In: a model whose main rule lets all schedulers do something, as `forall $c in Scheduler with … do …`. Out: the same rule with a choice
//! of one scheduler there. All else of the main rule stays: what it does for locks, to the clock, before and after the tasks' steps.

use machine::{Change, Choice, Environment, LocationRef, Machine, Show, TimeUnit, Value};
use model::{Binder, DomainId, Model, Rule, RuleKind, RuleNode, TermKind};
use program::Program;

use crate::events::Longest;
use crate::evidence::Claim;
use crate::vocabulary::{Named, Vocabulary};

/// The main rule in which one element of the schedulers' domain is chosen.
///
/// # Errors
/// In words, why it cannot be made of the main rule.
pub(crate) fn one_task_steps(model: &Model, scheduler: DomainId) -> Result<Rule, String> {
    let main = model.main.ok_or("it has no main rule")?;
    let mut rule = model.rule(main).clone();
    match choose(&mut rule.body, scheduler) {
        1 => Ok(rule),
        0 => Err(format!("its main rule {} has no `forall $c in Scheduler` in which its tasks step", rule.name)),
        _ => Err(format!("its main rule {} lets its tasks step in several places", rule.name)),
    }
}

/// Makes each `forall` over the schedulers a choice of one; returns how many there are. What is called is not looked into.
fn choose(rule: &mut RuleNode, scheduler: DomainId) -> usize {
    let mut count = 0;
    let mut open = vec![rule];
    while let Some(node) = open.pop() {
        if let RuleKind::Forall { binders, .. } = &node.kind
            && is_over(binders, scheduler)
            && let RuleKind::Forall { binders, condition, body } = std::mem::replace(&mut node.kind, RuleKind::Skip)
        {
            node.kind = RuleKind::Choose { binders, condition, body, if_none: None };
            count += 1;
            continue;
        }
        match &mut node.kind {
            RuleKind::Par(rules) | RuleKind::Seq(rules) => open.extend(rules),
            RuleKind::If { branches: rules, otherwise } | RuleKind::Switch { cases: rules, otherwise, .. } => {
                open.extend(rules.iter_mut().map(|(_, rule)| rule).chain(otherwise.as_deref_mut()));
            }
            RuleKind::Let { body, .. } => open.push(body),
            // Tasks do not step in any other place.
            _ => {}
        }
    }
    count
}

fn is_over(binders: &[Binder], domain: DomainId) -> bool {
    matches!(binders, [Binder { range, .. }] if matches!(range.kind, TermKind::Domain(of) if of == domain))
}

/// Chooses which component steps. No cycle is released late by its own choice, as in the model's time.
pub(crate) struct Chosen<'a> {
    scheduler: &'a Value,
    made: bool,
}

impl Chosen<'_> {
    /// This scheduler has its turn.
    pub(crate) fn new(scheduler: &Value) -> Chosen<'_> {
        Chosen { scheduler, made: false }
    }
}

impl Environment for Chosen<'_> {
    fn monitored(&mut self, program: &Program, location: LocationRef<'_>, codomain: DomainId) -> Result<Value, String> {
        Longest.monitored(program, location, codomain)
    }

    fn choose(&mut self, _: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        if std::mem::replace(&mut self.made, true) {
            return Ok(0);
        }
        let found = choice.values.iter().position(|candidate| candidate == self.scheduler);
        found.ok_or("the model's main rule does not let this component step".to_string())
    }

    fn time(&mut self, _: TimeUnit) -> Result<i64, String> {
        Ok(0)
    }
}

/// What a step of the component in that tick has done that is not its own: what of it is claimed, and why the model cannot be replayed so.
pub(crate) fn oversteps(
    vocabulary: &Vocabulary,
    machine: &Machine,
    component: usize,
    tick: i64,
    claims: &[(usize, Claim)],
    changes: &[Change],
) -> Option<(Option<Claim>, String)> {
    if let Some((other, claim)) = claims.iter().find(|(of, _)| *of != component) {
        let other = &vocabulary.components[*other].name;
        return Some((
            Some(claim.clone()),
            format!("in the model's step of this task, {other} {}", claim.event.words()),
        ));
    }
    let clock = vocabulary.function(Named::Clock);
    let clock = changes.iter().find(|change| change.location.function == clock).map(|change| &change.after);
    if clock == Some(&Value::Integer(tick + 1)) {
        return None;
    }
    let to = clock.map_or(tick.to_string(), |clock| clock.show(machine.program()).to_string());
    Some((None, format!("a step of the model leads its clock from {tick} to {to}")))
}
