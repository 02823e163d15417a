//! Whether a model runs a machine, and begins it where its chart does.
//!
//! In: a machine, and its rule and control function in a model. Out: what is otherwise in the model. A model without a main rule runs
//! nothing, so there is nothing to compare; a pattern is begun by whoever calls it.

use model::{FunctionId, Literal, Model, RuleId, TermKind};
use syntax::Span;

use crate::build::state_value;
use crate::chart::{Chart, Machine};

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
