//! Takes symbolic values from one machine to the joint model and back, as [`crate::joint::Bridge`] takes values.
//!
//! In: a symbol and the domains of both programs. Out: the symbol there, and the condition under which there is no such value. Elements
//! are numbers in terms; each machine numbers its own, so a number goes over by the name that it stands for.

use machine::Value;
use model::Basic;
use program::{DomainId, DomainKind, Program};
use solve::Outside;
use solve::shared::{Node, Terms};
use solve::symbol::{Open, Shape, Symbol};

use super::symbolic::{Store, nowhere};

/// A direction: what a value is on the other side.
pub(crate) type Through<'t> = &'t dyn Fn(&Value) -> Option<Value>;

/// A symbol on the other side, and the condition under which it has no value there.
///
/// # Errors
/// Values of its domain are not taken over.
pub(crate) fn across(
    store: &mut Store,
    program: &Program,
    domain: DomainId,
    symbol: &Symbol,
    through: Through<'_>,
) -> Result<(Symbol, Node), Outside> {
    match symbol {
        Symbol::Known(value) => Ok(match through(value) {
            Some(value) => (Symbol::Known(value), Terms::FALSE),
            None => (Symbol::UNDEF, Terms::TRUE),
        }),
        Symbol::Open(open) => match open.shape {
            Shape::Boolean | Shape::Integer | Shape::Real => Ok((symbol.clone(), Terms::FALSE)),
            Shape::Coded => match program.domain(program.base_domain(domain)).kind {
                DomainKind::Basic(Basic::String | Basic::Char) => Ok((symbol.clone(), Terms::FALSE)),
                _ => Err(nowhere(&format!("a value in {} that both machines look at", program.domain(domain).name))),
            },
            Shape::Enum(of) | Shape::Element(of) => Ok(renumbered(store, program, of, *open, through)),
        },
        Symbol::Tuple(parts) => {
            let DomainKind::Prod(domains) = &program.domain(program.base_domain(domain)).kind else {
                return Err(nowhere("a tuple of a domain that is no product"));
            };
            let (mut all, mut fails) = (Vec::new(), Vec::new());
            for (part, domain) in parts.iter().zip(domains) {
                let (part, fail) = across(store, program, *domain, part, through)?;
                all.push(part);
                fails.push(fail);
            }
            Ok((Symbol::Tuple(all), store.terms.or(fails)))
        }
        Symbol::Set(_) => Err(nowhere("a set that both machines look at")),
    }
}

/// An element by the number that the other side has for it.
fn renumbered(
    store: &mut Store,
    program: &Program,
    domain: DomainId,
    open: Open,
    through: Through<'_>,
) -> (Symbol, Node) {
    let own = match &program.domain(domain).kind {
        DomainKind::Enum { literals } => literals.len(),
        DomainKind::Abstract { elements, .. } => elements.len(),
        _ => 0,
    };
    let value = |number: u32| match open.shape {
        Shape::Enum(_) => Value::Enum(domain, number),
        _ => Value::Element(domain, number),
    };
    let mut there = Vec::new();
    for number in 0..own as u32 {
        if let Some(ref value @ (Value::Enum(_, other) | Value::Element(_, other))) = through(&value(number)) {
            there.push((number, other, Shape::of(value)));
        }
    }
    let Some((_, _, shape)) = there.first().copied() else {
        return (Symbol::UNDEF, open.defined);
    };
    let mut named = Vec::new();
    let mut moved = None;
    for (number, other, _) in there.iter().rev() {
        let (from, to) = (store.terms.integer(i128::from(*number)), store.terms.integer(i128::from(*other)));
        let is_it = store.terms.equal(open.value, from);
        named.push(is_it);
        moved = Some(moved.map_or(to, |rest| store.terms.choose(is_it, to, rest)));
    }
    let same = there.iter().all(|(number, other, _)| number == other) && there.len() == own;
    let value = if same { open.value } else { moved.unwrap_or(open.value) };
    let within = match store.terms.bounds(open.value) {
        (Some(low), Some(high)) if there.len() == own && low >= 0 && high < own as i128 => Terms::TRUE,
        _ => store.terms.or(named),
    };
    let not = store.terms.not(within);
    let fails = store.terms.and([open.defined, not]);
    (Symbol::Open(Open { shape, value, defined: open.defined }), fails)
}
