//! The values of terms in a state that a solver gave.
//!
//! In: the values of the variables that the solver was told of. Out: values of terms, and of a machine's locations. A variable that it was
//! not told of does not matter to what was asked: it has its least value.

use machine::{Location, Value};
use solve::session::Constant;
use solve::shared::{Kind, Node, Terms, VariableId, value_at};
use solve::symbol::{Codes, Shape, value_of};

use super::ask::Model;
use super::symbolic::{Store, Symbolic};

/// The values of all terms in a solver's state.
pub(crate) struct Values<'s> {
    pub codes: &'s Codes,
    of: Vec<Option<Constant>>,
}

impl Values<'_> {
    pub fn constant(&self, node: Node) -> Option<Constant> {
        value_at(&self.of, node)
    }

    pub fn truth(&self, node: Node) -> bool {
        value_at(&self.of, node) == Some(Constant::Boolean(true))
    }

    pub fn value(&self, shape: Shape, node: Node) -> Option<Value> {
        value_of(self.codes, shape, value_at(&self.of, node)?)
    }

    /// The values of a machine's locations; of those alone that the solver was told of, if a model is given.
    pub fn state(&self, machine: &Symbolic, state: &[Node], model: Option<&Model>) -> Vec<(Location, Value)> {
        let mut at = 0;
        let mut found = Vec::new();
        for place in &machine.places {
            let node = state[at];
            let is_told = model.is_none_or(|model| {
                let own = machine.state.get(at..at + 1 + usize::from(place.defined != Terms::TRUE));
                own.is_some_and(|own| own.iter().any(|id| model.contains_key(id)))
            });
            at += 1;
            let mut defined = true;
            if place.defined != Terms::TRUE {
                defined = self.truth(state[at]);
                at += 1;
            }
            let value = if defined { self.value(place.shape, node) } else { Some(Value::Undef) };
            if is_told {
                found.extend(value.map(|value| (place.location.clone(), value)));
            }
        }
        found
    }
}

/// The values of all terms; the least ones of variables that the solver was not told of.
pub(crate) fn values<'s>(store: &'s Store, model: &Model) -> Values<'s> {
    let terms = &store.terms;
    let value = |id: VariableId| Some(model.get(&id).copied().unwrap_or_else(|| least(terms, id)));
    Values { codes: &store.codes, of: terms.values(&value) }
}

/// The value of a variable that a solver was not told of.
pub(crate) fn least(terms: &Terms, id: VariableId) -> Constant {
    let variable = terms.variable_of(id);
    match variable.kind {
        Kind::Boolean => Constant::Boolean(false),
        Kind::Integer => Constant::Integer(variable.bounds.0.unwrap_or(0)),
        Kind::Real => Constant::Real(0.0),
    }
}
