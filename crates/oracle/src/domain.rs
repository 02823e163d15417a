//! Universes in a state: their elements in canonical order, and membership.
//!
//! Abstract and dynamic domains are read off the state (their characteristic functions are part of it); enumerations,
//! truth values, and products and powersets of what can be enumerated have the elements their definition says.

use model::{Basic, DomainId, DomainKind, Domains, FunctionId, RuleId};

use crate::element::{is_abstract, named_elements};
use crate::fault::Fault;
use crate::interpreter::{Assignment, Interpreter};
use crate::state::State;
use crate::value::Value;

impl Interpreter<'_> {
    /// The elements of a domain in canonical order.
    pub fn elements(&mut self, domain: DomainId, state: &State) -> Result<Vec<Value>, Fault> {
        match self.model.domains.kind(domain).clone() {
            DomainKind::Basic(Basic::Boolean) => Ok(vec![Value::Boolean(false), Value::Boolean(true)]),
            DomainKind::Enum { literals } => {
                Ok((0..literals.len() as u32).map(|place| Value::Literal(domain, place)).collect())
            }
            DomainKind::Abstract { .. } => Ok(state.members(domain).cloned().collect()),
            DomainKind::Concrete { base, dynamic, definition } => {
                let mut elements: Vec<Value> = state.members(domain).cloned().collect();
                match definition {
                    Some(definition) => match self.value(&definition, state, &Assignment::default())?.elements() {
                        Some(defined) => elements.extend(defined),
                        None => return Err(Fault::NotEnumerable),
                    },
                    None if dynamic => {}
                    // The elements of an abstract domain may be declared one by one in a subset of it.
                    None if is_abstract(self.model, base) && !elements.is_empty() => {}
                    None => return Err(Fault::NotEnumerable),
                }
                elements.sort();
                elements.dedup();
                Ok(elements)
            }
            DomainKind::Prod(parts) => {
                let mut tuples = vec![Vec::new()];
                for part in parts {
                    let elements = self.elements(part, state)?;
                    self.bounded(tuples.len().saturating_mul(elements.len()))?;
                    let extend = |tuple: &Vec<Value>, element: &Value| {
                        [tuple.as_slice(), std::slice::from_ref(element)].concat()
                    };
                    tuples = tuples
                        .iter()
                        .flat_map(|tuple| elements.iter().map(|e| extend(tuple, e)).collect::<Vec<_>>())
                        .collect();
                }
                Ok(tuples.into_iter().map(Value::Tuple).collect())
            }
            DomainKind::Powerset(of) => {
                let elements = self.elements(of, state)?;
                self.bounded(1usize.checked_shl(elements.len() as u32).unwrap_or(usize::MAX))?;
                let subset = |mask: usize| (0..elements.len()).filter(move |place| mask >> place & 1 == 1);
                let mut subsets: Vec<Value> = (0..1usize << elements.len())
                    .map(|mask| Value::Set(subset(mask).map(|place| elements[place].clone()).collect()))
                    .collect();
                subsets.sort();
                Ok(subsets)
            }
            _ => Err(Fault::NotEnumerable),
        }
    }

    fn bounded(&self, elements: usize) -> Result<(), Fault> {
        if elements > self.bounds.elements { Err(Fault::Limit) } else { Ok(()) }
    }

    /// Is the value in the domain? Undef is in every one.
    pub fn contains(&mut self, domain: DomainId, value: &Value, state: &State) -> Result<bool, Fault> {
        let all = |this: &mut Self, of: DomainId, values: Vec<Value>| -> Result<bool, Fault> {
            for value in values {
                if !this.contains(of, &value, state)? {
                    return Ok(false);
                }
            }
            Ok(true)
        };
        match (self.model.domains.kind(domain).clone(), value) {
            (_, Value::Undef) => Ok(true),
            (DomainKind::Basic(Basic::Natural), Value::Integer(number)) => Ok(*number >= 0),
            // An element is seen by the rule that imports it before the state has it in its domain.
            (DomainKind::Concrete { .. }, _) if self.imported.iter().any(|(to, new)| *to == domain && new == value) => {
                Ok(true)
            }
            (DomainKind::Concrete { .. }, _) => match self.elements(domain, state) {
                Err(Fault::NotEnumerable) => Ok(false),
                elements => Ok(elements?.contains(value)),
            },
            (DomainKind::Abstract { .. }, Value::Element(of, _)) => Ok(*of == domain),
            (DomainKind::Prod(domains), Value::Tuple(parts)) => {
                for (domain, part) in domains.iter().zip(parts) {
                    if !self.contains(*domain, part, state)? {
                        return Ok(false);
                    }
                }
                Ok(true)
            }
            (DomainKind::Seq(of) | DomainKind::Powerset(of) | DomainKind::Bag(of), _) => {
                all(self, of, value.elements().unwrap_or_default())
            }
            (DomainKind::Map(from, to), Value::Map(entries)) => Ok(all(self, from, entries.keys().cloned().collect())?
                && all(self, to, entries.values().cloned().collect())?),
            // The checker has seen to the rest.
            _ => Ok(true),
        }
    }

    /// The element that a static function without definition denotes, if it denotes one.
    pub(crate) fn element(&self, id: FunctionId) -> Option<Value> {
        named_elements(self.model).find(|(function, ..)| *function == id).map(|(_, _, element)| element)
    }

    /// The program of an agent: that of the smallest domain it is in.
    pub(crate) fn program_of(&mut self, agent: &Value, state: &State) -> Result<Option<RuleId>, Fault> {
        let Some(init) = self.model.default_init.map(|index| &self.model.inits[index]) else { return Ok(None) };
        let mut found = None;
        for program in &init.agents {
            let inside = !agent.is_undef() && self.contains(program.domain, agent, state)?;
            if inside && (found.is_none() || program.domain != Domains::AGENT) {
                found = Some(program.rule);
            }
        }
        Ok(found)
    }
}
