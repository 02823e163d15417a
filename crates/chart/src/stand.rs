//! The control states of a chart's machines as terms over its model: who asks whether a machine can always go on asks about each.

use crate::build::{control_location, state_value};
use crate::chart::{Chart, Machine, ShapeKind};

/// A control state of a machine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Stand {
    /// The machine.
    pub machine: String,
    /// Its value, as the model writes it.
    pub value: String,
    /// The machine stands in it. The parameters of the machine are free.
    at: String,
    /// The parameters with their domains, as a quantifier writes them.
    binders: Vec<String>,
}

impl Stand {
    /// The formula that whoever stands there may always come to stand elsewhere.
    pub fn goes_on(&self) -> String {
        let formula = format!("ag({0} implies ef(not ({0})))", self.at);
        match &self.binders[..] {
            [] => formula,
            binders => format!("(forall {} with {formula})", binders.join(", ")),
        }
    }
}

/// All control states of a chart's machines, in its order.
pub fn stands(chart: &Chart) -> Vec<Stand> {
    let of = |machine: &Machine| {
        let machine = machine.flat();
        let Some(location) = control_location(machine) else { return Vec::new() };
        let binders: Vec<String> =
            machine.parameters.iter().map(|one| format!("{} in {}", one.variable, one.domain)).collect();
        let states = machine.numbered().filter(|(_, shape)| matches!(shape.kind, ShapeKind::State { .. }));
        let stand = |value: String| Stand {
            machine: machine.name.clone(),
            at: format!("{location} = {value}"),
            value,
            binders: binders.clone(),
        };
        states.map(|(id, _)| stand(state_value(chart, machine, id))).collect()
    };
    chart.machines.iter().flat_map(of).collect()
}
