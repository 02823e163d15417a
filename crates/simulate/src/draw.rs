//! A random value of a domain.
//!
//! In: a domain, the carriers of the domains whose elements the state knows, bounds for infinite domains, a stream
//! of random bits. Out: a value of the domain. INVARIANT: the value is in the domain in the current state.

use std::sync::Arc;

use machine::{Machine, Real, Value};
use model::Basic;
use program::{DomainId, DomainKind, FunctionKind, Program};

use crate::read::type_domain;
use crate::splitmix::SplitMix;

/// The bounds of infinite domains when inputs are random.
#[derive(Debug, Clone, PartialEq)]
pub struct Bounds {
    /// Integers and Naturals, both ends included; a Natural is never below 0.
    pub integers: (i64, i64),
    /// Reals and parts of Complex numbers, both ends included, with two decimals.
    pub reals: (f64, f64),
    /// Strings.
    pub strings: Vec<String>,
    /// Characters, both ends included.
    pub chars: (char, char),
    /// The greatest length of a random sequence or bag, and size of a random set or map.
    pub size: u64,
}

impl Default for Bounds {
    fn default() -> Self {
        Bounds {
            integers: (-10, 10),
            reals: (-10.0, 10.0),
            strings: ["", "a", "b", "ab", "abc"].map(String::from).to_vec(),
            chars: ('a', 'z'),
            size: 3,
        }
    }
}

/// The elements of abstract and concrete domains that inputs range over.
#[derive(Debug, Clone, Default)]
pub struct Carriers {
    /// By domain.
    elements: Vec<Option<Vec<Value>>>,
    fixed: Vec<DomainId>,
    growing: Vec<DomainId>,
}

impl Carriers {
    /// The domains that values of inputs may contain.
    pub(crate) fn of_inputs(program: &Program) -> Carriers {
        let mut carriers = Carriers { elements: vec![None; program.domains.len()], ..Carriers::default() };
        let inputs = program.functions.iter();
        for function in inputs.filter(|f| matches!(f.kind, FunctionKind::Monitored | FunctionKind::Shared)) {
            carriers.need(program, function.codomain);
        }
        carriers
    }

    fn need(&mut self, program: &Program, domain: DomainId) {
        match &program.domain(domain).kind {
            DomainKind::Abstract { dynamic, .. } => self.note(domain, *dynamic),
            DomainKind::Concrete { dynamic, .. } => self.note(domain, *dynamic),
            DomainKind::Prod(parts) => parts.iter().for_each(|part| self.need(program, *part)),
            DomainKind::Seq(of) | DomainKind::Powerset(of) | DomainKind::Bag(of) => self.need(program, *of),
            DomainKind::Map(key, of) => {
                self.need(program, *key);
                self.need(program, *of);
            }
            _ => {}
        }
    }

    fn note(&mut self, domain: DomainId, growing: bool) {
        let list = if growing { &mut self.growing } else { &mut self.fixed };
        if !list.contains(&domain) {
            list.push(domain);
        }
    }

    /// Takes the elements of the domains that never change; the others have the elements of the initial state so far.
    pub(crate) fn fill(&mut self, machine: &mut Machine) {
        for domain in self.fixed.iter().chain(&self.growing) {
            if let Ok(elements) = machine.elements(*domain) {
                self.elements[domain.0 as usize] = Some(elements);
            }
        }
    }

    /// Takes the elements that the domains which may grow have in the current state.
    pub(crate) fn refresh(&mut self, machine: &mut Machine) {
        for domain in &self.growing {
            if let Ok(elements) = machine.elements(*domain) {
                self.elements[domain.0 as usize] = Some(elements);
            }
        }
    }

    /// The elements of a domain, if known.
    pub fn get(&self, domain: DomainId) -> Option<&[Value]> {
        self.elements.get(domain.0 as usize)?.as_deref()
    }
}

/// Draws a value.
pub(crate) fn draw(
    program: &Program,
    carriers: &Carriers,
    bounds: &Bounds,
    domain: DomainId,
    random: &mut SplitMix,
) -> Result<Value, String> {
    let entry = program.domain(domain);
    let inner = |of: DomainId, random: &mut SplitMix| draw(program, carriers, bounds, of, random);
    match &entry.kind {
        DomainKind::Basic(basic) => draw_basic(*basic, bounds, random),
        DomainKind::Enum { literals } => Ok(Value::Enum(domain, random.below(literals.len() as u64) as u32)),
        DomainKind::Abstract { .. } | DomainKind::Concrete { .. } => match carriers.get(domain) {
            Some([]) => Err(format!("{} has no elements", entry.name)),
            Some(elements) => Ok(elements[random.below(elements.len() as u64) as usize].clone()),
            None if type_domain(program, domain) == domain => {
                Err(format!("the elements of {} are not known", entry.name))
            }
            None => Err(format!("the contents of {} are not defined", entry.name)),
        },
        DomainKind::Prod(parts) => {
            Ok(Value::tuple(parts.iter().map(|part| inner(*part, random)).collect::<Result<_, _>>()?))
        }
        DomainKind::Seq(of) => Ok(Value::seq(several(bounds, random, |random| inner(*of, random))?)),
        DomainKind::Powerset(of) => Ok(Value::set(several(bounds, random, |random| inner(*of, random))?)),
        DomainKind::Bag(of) => Ok(Value::bag(several(bounds, random, |random| inner(*of, random))?)),
        DomainKind::Map(key, of) => {
            Ok(Value::map(several(bounds, random, |random| Ok((inner(*key, random)?, inner(*of, random)?)))?))
        }
        DomainKind::Rule(_) => Err("rules are not drawn".to_string()),
        DomainKind::Any | DomainKind::Error => Err("its domain is not known".to_string()),
    }
}

fn several<T>(
    bounds: &Bounds,
    random: &mut SplitMix,
    mut one: impl FnMut(&mut SplitMix) -> Result<T, String>,
) -> Result<Vec<T>, String> {
    let count = random.below(bounds.size + 1);
    (0..count).map(|_| one(random)).collect()
}

/// Draws a value of a basic domain.
pub(crate) fn draw_basic(basic: Basic, bounds: &Bounds, random: &mut SplitMix) -> Result<Value, String> {
    let real = |random: &mut SplitMix| {
        let (low, high) = bounds.reals;
        let cents = random.between((low * 100.0).ceil() as i64, (high * 100.0).floor() as i64);
        Real::new(cents as f64 / 100.0).ok_or_else(|| "the bounds of Reals are no numbers".to_string())
    };
    let (low, high) = bounds.integers;
    Ok(match basic {
        Basic::Boolean => Value::Boolean(random.below(2) == 1),
        Basic::Integer => Value::Integer(random.between(low, high)),
        Basic::Natural => Value::Integer(random.between(low.max(0), high.max(0))),
        Basic::Real => Value::Real(real(random)?),
        Basic::Complex => Value::Complex(Arc::new((real(random)?, real(random)?))),
        Basic::Char => {
            let (low, high) = (u32::from(bounds.chars.0), u32::from(bounds.chars.1));
            let code = random.between(i64::from(low), i64::from(high)) as u32;
            Value::Char(char::from_u32(code).unwrap_or(bounds.chars.0))
        }
        Basic::String => match bounds.strings.len() {
            0 => Value::string(""),
            count => Value::string(bounds.strings[random.below(count as u64) as usize].as_str()),
        },
        Basic::Undef => Value::Undef,
    })
}
