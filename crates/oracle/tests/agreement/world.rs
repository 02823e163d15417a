//! One world for both: inputs and choices that depend on the seed, the step, the location and the number of the choice,
//! never on the order in which inputs are asked for.

use std::collections::BTreeMap;

use model::{Basic, DomainId, DomainKind, FunctionId, FunctionKind, Model};
use oracle::generate::Random;
use oracle::{Bounds, Double, Location, Oracle, Symbol, Tick, Value};
use program::Program;

use crate::convert;

/// See the head of this file.
#[derive(Debug, Clone, Default)]
pub struct World {
    seed: u64,
    pools: BTreeMap<FunctionId, Vec<Value>>,
    /// What was asked for in this step.
    pub asked: BTreeMap<Location, Value>,
    /// The candidates of the choices made in this step.
    pub choices: Vec<Vec<Vec<Value>>>,
}

impl World {
    /// The world of a step; inputs range over the domains as they are now.
    pub fn new(model: &Model, oracle: &mut Oracle<'_>, seed: u64) -> World {
        let mut world = World { seed, ..World::default() };
        for (id, function) in model.functions() {
            if matches!(function.kind, FunctionKind::Monitored | FunctionKind::Shared) {
                let pool = pool(model, oracle, function.codomain, 3);
                world.pools.insert(id, pool);
            }
        }
        world
    }

    fn hash(&self, about: &str) -> usize {
        let hash = about.bytes().fold(self.seed ^ 0xcbf2_9ce4_8422_2325, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
        });
        (Random::new(hash).bits() >> 1) as usize
    }

    fn input(&mut self, location: &Location) -> Value {
        let Symbol::Function(function) = location.symbol else { panic!("inputs are values of functions") };
        let pool = &self.pools[&function];
        let value = pool[self.hash(&format!("{location:?}")) % pool.len()].clone();
        let twice = self.asked.insert(location.clone(), value.clone());
        assert!(twice.is_none(), "asked twice in one step for {location:?}");
        value
    }

    fn drawn(&self, variable: usize) -> i64 {
        (self.hash(&format!("number {variable} of choice {}", self.choices.len())) % 7) as i64
    }

    fn choice(&mut self, candidates: Vec<Vec<Value>>) -> usize {
        let index = self.hash(&format!("choice {}", self.choices.len())) % candidates.len();
        self.choices.push(candidates);
        index
    }
}

/// The world as the oracle sees it.
impl oracle::Environment for World {
    fn monitored(&mut self, _model: &Model, location: &Location) -> Result<Value, String> {
        Ok(self.input(location))
    }

    fn choose(&mut self, _model: &Model, candidates: &[Vec<Value>]) -> Result<usize, String> {
        Ok(self.choice(candidates.to_vec()))
    }

    fn number(&mut self, _model: &Model, variable: usize, basic: Basic) -> Result<Value, String> {
        let number = self.drawn(variable);
        Ok(match basic {
            Basic::Real => Value::Real(Double::new(number as f64).expect("a number")),
            _ => Value::Integer(number),
        })
    }

    fn time(&mut self, unit: Tick) -> Result<i64, String> {
        Ok(self.hash(&format!("{unit:?}")) as i64)
    }
}

/// The world as the machine sees it.
pub struct Machines<'w>(pub &'w mut World);

impl machine::Environment for Machines<'_> {
    fn monitored(
        &mut self,
        program: &Program,
        location: machine::LocationRef<'_>,
        _codomain: DomainId,
    ) -> Result<machine::Value, String> {
        Ok(convert::back(program, &self.0.input(&convert::location(program, &location.to_location()))))
    }

    fn choose(&mut self, program: &Program, choice: &machine::Choice<'_>) -> Result<usize, String> {
        let candidate =
            |index| choice.candidate(index).iter().map(|value| convert::value(program, value)).collect::<Vec<_>>();
        Ok(self.0.choice((0..choice.candidates()).map(candidate).collect()))
    }

    fn number(&mut self, _program: &Program, draw: &machine::Draw) -> Result<machine::Value, String> {
        let number = self.0.drawn(draw.variable);
        Ok(match draw.basic {
            Basic::Real => machine::Value::Real(machine::Real::new(number as f64).expect("a number")),
            _ => machine::Value::Integer(number),
        })
    }

    fn time(&mut self, unit: machine::TimeUnit) -> Result<i64, String> {
        Ok(self.0.hash(&format!("{unit:?}")) as i64)
    }
}

/// Some values of a domain: all of a small one; undef where there are none.
fn pool(model: &Model, oracle: &mut Oracle<'_>, domain: DomainId, depth: u32) -> Vec<Value> {
    let mut world = World::default();
    let listed = oracle.elements(domain, &mut world).unwrap_or_default();
    if !listed.is_empty() && listed.len() <= Bounds::default().elements {
        return listed;
    }
    let double = |number| Value::Real(Double::new(number).expect("a number"));
    let string = |text: &str| Value::String(text.to_string());
    if depth == 0 {
        return vec![Value::Undef];
    }
    let mut some = |domain: DomainId| {
        let mut values = pool(model, oracle, domain, depth - 1);
        values.truncate(6);
        values
    };
    match model.domains.kind(domain) {
        DomainKind::Basic(Basic::Integer) => (-3..12).map(Value::Integer).collect(),
        DomainKind::Basic(Basic::Natural) => (0..12).map(Value::Integer).collect(),
        DomainKind::Basic(Basic::Real) => [0.0, 1.0, 0.5, -2.5, 100.25].map(double).to_vec(),
        DomainKind::Basic(Basic::String) => ["", "a", "ab", "word word"].map(string).to_vec(),
        DomainKind::Basic(Basic::Char) => ['a', 'b', ' '].map(Value::Char).to_vec(),
        DomainKind::Prod(parts) => {
            let columns: Vec<Vec<Value>> = parts.iter().map(|part| some(*part)).collect();
            (0..6)
                .map(|row| Value::Tuple(columns.iter().map(|column| column[row % column.len()].clone()).collect()))
                .collect()
        }
        DomainKind::Seq(of) => {
            let items = some(*of);
            (0..=items.len()).map(|length| Value::Seq(items[..length].to_vec())).collect()
        }
        DomainKind::Powerset(of) => {
            let items = some(*of);
            (0..=items.len()).map(|length| Value::Set(items[..length].iter().cloned().collect())).collect()
        }
        DomainKind::Bag(of) => {
            let items = some(*of);
            (0..=items.len()).map(|length| Value::bag(items[..length].iter().cloned())).collect()
        }
        DomainKind::Map(from, to) => {
            let (keys, values) = (some(*from), some(*to));
            let entries: Vec<_> = keys.into_iter().zip(values).collect();
            (0..=entries.len()).map(|length| Value::Map(entries[..length].iter().cloned().collect())).collect()
        }
        _ => vec![Value::Undef],
    }
}
