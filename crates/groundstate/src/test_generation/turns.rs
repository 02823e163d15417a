//! The transitions of a model's charts, as goals of generated tests.

use chart::{Origin, Target};
use model::{DomainKind, Model};

use crate::test_generation::Turn;

/// The transitions between different control states in the charts that the model's rules form.
pub fn chart_turns(model: &Model) -> Vec<Turn> {
    let literal = |name: &str| {
        model.domains.iter().find_map(|(id, domain)| match &domain.kind {
            DomainKind::Enum { literals } => {
                literals.iter().position(|literal| literal == name).map(|index| (id, index as u32))
            }
            _ => None,
        })
    };
    let found = chart::extract(model, None, None).chart;
    let mut turns: Vec<Turn> = Vec::new();
    for machine in &found.machines {
        let rule = machine.rule.as_ref().map_or(&machine.name, |rule| &rule.name);
        let Some(rule) = model.rules.iter().find(|known| known.name == *rule) else { continue };
        for transition in chart::transitions(&found, machine) {
            let (Origin::State(from), Target::State(to)) = (transition.origin, transition.target) else { continue };
            let state = |id| machine.shape(id).link.as_ref().map(|link| link.name.clone());
            let (Some(from), Some(to)) = (state(from), state(to)) else { continue };
            let (Some((domain, first)), Some((other, second))) = (literal(&from), literal(&to)) else { continue };
            let name = format!("{}, {from} to {to}", rule.name);
            if domain == other && !turns.iter().any(|turn| turn.name == name) && first != second {
                turns.push(Turn { name, span: rule.span, domain, literals: (first, second) });
            }
        }
    }
    turns
}
