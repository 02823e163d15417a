//! Whether a model runs a machine, and begins it where its chart does.
//!
//! In: a machine, and its rule and control function in a model. Out: what is otherwise in the model. A model without a main rule runs
//! nothing, so there is nothing to compare. A pattern is begun by whoever calls it: before that its control variable is undef.

use std::collections::BTreeSet;

use model::{FunctionId, Literal, Model, RuleId, RuleKind, Target, TermKind};
use syntax::Span;

use crate::build::{control_location, memory_location, rule_name, state_value};
use crate::chart::{Chart, Control, History, Machine, Shape, ShapeKind};

/// The value of a location that nothing has set.
pub(crate) const UNDEF: &str = "undef";

/// How a model begins a machine otherwise than its chart does.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Otherwise {
    /// Nothing calls its rule.
    NotRun,
    /// It begins in another state.
    In {
        /// The value of the control variable that the chart begins with.
        drawn: String,
        /// The model's value.
        written: String,
        /// Where the model says so, if it does.
        place: Option<Span>,
    },
    /// The first state is computed, so it is not compared.
    Computed {
        /// The value of the control variable that the chart begins with.
        drawn: String,
        /// The model's value.
        place: Span,
    },
}

/// What is otherwise in the model, if anything is.
pub(crate) fn otherwise(
    chart: &Chart,
    machine: &Machine,
    model: &Model,
    rule: RuleId,
    control: Option<FunctionId>,
) -> Option<Otherwise> {
    if machine.is_pattern || model.main.is_none() {
        return None;
    }
    if !model.may_run().contains(&rule) {
        return Some(Otherwise::NotRun);
    }
    let drawn = state_value(chart, machine, machine.initial()?);
    match initial_value(model, control?)? {
        Initial::Value(written, _) if written == drawn => None,
        Initial::Value(written, place) => Some(Otherwise::In { drawn, written, place }),
        Initial::Computed(place) => Some(Otherwise::Computed { drawn, place }),
    }
}

/// A function that a chart takes for undef in the beginning, and that has a value in the model.
pub(crate) struct NotUndef {
    pub(crate) function: String,
    /// Until what it is undef, as a clause.
    pub(crate) until: &'static str,
    /// Where the chart has it.
    pub(crate) span: Span,
    pub(crate) given: Initial,
}

/// The function of a location.
fn function_of(location: &str) -> &str {
    location.split('(').next().unwrap_or_default().trim()
}

/// What has a value too early: the control variable of a pattern, which none is at work in before it is entered, and what remembers where a
/// composite state was left.
pub(crate) fn too_early(chart: &Chart, machine: &Machine, model: &Model) -> Vec<NotUndef> {
    let is_instance = |shape: &Shape| matches!(&shape.kind, ShapeKind::Instance(of) if of.name == machine.name);
    let is_drawn = matches!(machine.control, Some(Control::Made { .. }))
        || chart.machines.iter().flat_map(|machine| &machine.shapes).any(is_instance);
    // A variable of the model's own is what the model says, where no machine enters the pattern.
    let control = control_location(machine).filter(|_| machine.is_pattern && is_drawn);
    let control = control.map(|location| (location, "the pattern is entered", machine.span));
    let remembers = |shape: &&Shape| shape.composite().is_some_and(|composite| composite.history.is_some());
    let histories = machine.shapes.iter().filter(remembers);
    let histories = histories.map(|shape| (memory_location(machine, shape), "the composite state is left", shape.span));
    let early = |(location, until, span): (String, &'static str, Span)| {
        let name = function_of(&location);
        let function = model.functions.iter().position(|function| function.name == name)?;
        let given = initial_value(model, FunctionId(function as u32))?;
        let is_undef = matches!(&given, Initial::Value(value, _) if value == UNDEF);
        (!is_undef).then(|| NotUndef { function: name.to_string(), until, span, given })
    };
    control.into_iter().chain(histories).filter_map(early).collect()
}

/// Rules that run and are none of the chart's machines, but set what only these set: the function, the rule's name, the place.
pub(crate) fn intruders(chart: &Chart, machine: &Machine, model: &Model) -> Vec<(String, String, Span)> {
    let own: BTreeSet<String> = chart.machines.iter().map(rule_name).collect();
    let control = matches!(machine.control, Some(Control::Made { .. })).then(|| control_location(machine)).flatten();
    let remembers =
        |shape: &&Shape| shape.composite().is_some_and(|composite| matches!(composite.history, Some(History::Made)));
    let histories = machine.shapes.iter().filter(remembers).map(|shape| memory_location(machine, shape));
    let locations = control.into_iter().chain(histories);
    let guarded: BTreeSet<String> = locations.map(|location| function_of(&location).to_string()).collect();
    let mut found = Vec::new();
    for rule in model.may_run().into_iter().map(|id| model.rule(id)).filter(|rule| !own.contains(&rule.name)) {
        rule.body.walk(&mut |node| {
            if let RuleKind::Update { target, .. } | RuleKind::Return { target, .. } = &node.kind
                && let Target::Location { function, .. } = target
                && let function = &model.function(*function).name
                && guarded.contains(function)
            {
                found.push((function.clone(), rule.name.clone(), node.span));
            }
        });
    }
    found
}

/// What a control function begins with.
pub(crate) enum Initial {
    /// A literal or undef, and its place if it is written.
    Value(String, Option<Span>),
    /// Another term.
    Computed(Span),
}

/// What a control function has in the default initial state; nothing for a model that does not run.
pub(crate) fn initial_value(model: &Model, function: FunctionId) -> Option<Initial> {
    model.main?;
    let init = model.default_init.map(|index| &model.inits[index]);
    let Some(given) = init.and_then(|init| init.functions.iter().find(|given| given.function == function)) else {
        return Some(Initial::Value(UNDEF.to_string(), None));
    };
    let value = match &given.definition.body.kind {
        TermKind::Literal(Literal::Undef) => Some(UNDEF.to_string()),
        TermKind::Literal(Literal::Enum(domain, index)) => match model.domains.kind(*domain) {
            model::DomainKind::Enum { literals } => literals.get(*index as usize).cloned(),
            _ => None,
        },
        _ => None,
    };
    Some(match value {
        Some(value) => Initial::Value(value, Some(given.span)),
        None => Initial::Computed(given.definition.body.span),
    })
}
