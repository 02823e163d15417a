//! Derives bounds of inputs from the model's assumptions: `INVAR level >= 0 and level <= 10`.
//!
//! In: the INVARs of a program. Out: for each input over an infinite domain whose least and greatest value they
//! determine, the range of values. The INVARs still apply; a bound only tells which inputs need not be tried. LIMIT:
//! comparisons with literal numbers, joined by `and`, inside `forall` over the whole domain of an argument.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use machine::{Bounds, Limits, Machine, Value};
use model::Basic;
use program::{
    Builtin, DomainKind, FunctionId, FunctionKind, Literal, Program, PropertyKind, Quantifier, Slot, Term, TermId,
};

/// LIMIT: larger ranges are not used as bounds.
const VALUES: i64 = 1 << 16;

/// The bounds that a program's assumptions give; no value where they contradict each other.
pub fn assumed_bounds(program: &Program) -> Bounds {
    let mut found: BTreeMap<FunctionId, (Option<i64>, Option<i64>)> = BTreeMap::new();
    for property in program.properties.iter().filter(|property| property.kind == PropertyKind::Invar) {
        collect(program, property.formula.body, &[], &mut found);
    }
    let mut bounds = Bounds::new();
    for (function, (low, high)) in found {
        let declared = program.function(function);
        let natural = match &program.domain(declared.codomain).kind {
            DomainKind::Basic(Basic::Natural) => true,
            DomainKind::Basic(Basic::Integer) => false,
            _ => continue,
        };
        let low = if natural { Some(low.unwrap_or(0).max(0)) } else { low };
        if let (Some(low), Some(high)) = (low, high)
            && high.saturating_sub(low) < VALUES
        {
            bounds.insert(function, (low..=high).map(Value::Integer).collect());
        }
    }
    bounds
}

/// The values that inputs take, as far as these are not all values of their domains: those that are `given`, else those that
/// the program's assumptions leave. Inputs that may be `undefined` take undef besides. If the values of such an input cannot
/// be listed, it has none here, so that it cannot be gone through.
pub fn input_values(program: &Program, given: &Bounds, undefined: &BTreeSet<FunctionId>) -> Bounds {
    let mut bounds = assumed_bounds(program);
    // Where the assumptions leave no value they leave no step, which one value shows as well as all.
    bounds.values_mut().filter(|values| values.is_empty()).for_each(|values| values.push(Value::Integer(0)));
    bounds.extend(given.iter().map(|(function, values)| (*function, values.clone())));
    if undefined.is_empty() {
        return bounds;
    }
    let constant = program.constant_domains();
    let mut machine = Machine::new(Arc::new(program.clone()), Limits::default());
    for function in undefined {
        let domain = program.function(*function).codomain;
        let listed = bounds.remove(function).or_else(|| {
            let is_listed = constant[domain.0 as usize] && program.is_listable(domain);
            is_listed.then(|| machine.elements(domain).ok()).flatten()
        });
        let mut values = listed.unwrap_or_default();
        if !values.is_empty() && !values.contains(&Value::Undef) {
            values.push(Value::Undef);
        }
        bounds.insert(*function, values);
    }
    bounds
}

/// Adds the bounds in a formula; `whole` are the variables that take every value of a domain.
fn collect(
    program: &Program,
    term: TermId,
    whole: &[(Slot, program::DomainId)],
    found: &mut BTreeMap<FunctionId, (Option<i64>, Option<i64>)>,
) {
    match program.term(term) {
        Term::Builtin { builtin: Builtin::And, arguments } => {
            program.term_list(*arguments).iter().for_each(|conjunct| collect(program, *conjunct, whole, found));
        }
        Term::Quantified { quantifier: Quantifier::Forall, binders, condition: Some(body) } => {
            let mut whole = whole.to_vec();
            for binder in program.binder_list(*binders) {
                if let Term::Domain(domain) = program.term(binder.range) {
                    whole.push((binder.slot, *domain));
                }
            }
            collect(program, *body, &whole, found);
        }
        Term::Builtin { builtin, arguments } => {
            let [left, right] = program.term_list(*arguments) else { return };
            let (input, number, builtin) = match (input(program, *left, whole), input(program, *right, whole)) {
                (Some(input), None) => (input, number(program, *right), *builtin),
                (None, Some(input)) => (input, number(program, *left), turned(*builtin)),
                _ => return,
            };
            let Some(number) = number else { return };
            let (low, high) = match builtin {
                Builtin::Ge => (Some(number), None),
                Builtin::Gt => (number.checked_add(1), None),
                Builtin::Le => (None, Some(number)),
                Builtin::Lt => (None, number.checked_sub(1)),
                Builtin::Eq => (Some(number), Some(number)),
                _ => return,
            };
            let bound = found.entry(input).or_default();
            bound.0 = bound.0.max(low);
            bound.1 = match (bound.1, high) {
                (Some(former), Some(high)) => Some(former.min(high)),
                (former, high) => former.or(high),
            };
        }
        _ => {}
    }
}

/// The input that a term reads for all of its arguments at once.
fn input(program: &Program, term: TermId, whole: &[(Slot, program::DomainId)]) -> Option<FunctionId> {
    let Term::Read { function, arguments } = program.term(term) else { return None };
    let declared = program.function(*function);
    let covers = |(term, parameter): (&TermId, &program::DomainId)| match program.term(*term) {
        Term::Slot(slot) => whole.contains(&(*slot, *parameter)),
        _ => false,
    };
    let arguments = program.term_list(*arguments);
    // `f($x,$x)` covers only some of the arguments.
    let slots: Vec<&Term> = arguments.iter().map(|term| program.term(*term)).collect();
    if (1..slots.len()).any(|index| slots[..index].contains(&slots[index])) {
        return None;
    }
    let all = declared.kind == FunctionKind::Monitored && arguments.iter().zip(&declared.parameters).all(covers);
    all.then_some(*function)
}

fn number(program: &Program, term: TermId) -> Option<i64> {
    match program.term(term) {
        Term::Constant(index) => match program.constants[*index as usize] {
            Literal::Integer(number) => Some(number),
            _ => None,
        },
        Term::Builtin { builtin: Builtin::IntNeg, arguments } => match program.term_list(*arguments) {
            [operand] => number(program, *operand)?.checked_neg(),
            _ => None,
        },
        _ => None,
    }
}

/// `a < b` rewritten with b on the left.
fn turned(builtin: Builtin) -> Builtin {
    match builtin {
        Builtin::Ge => Builtin::Le,
        Builtin::Gt => Builtin::Lt,
        Builtin::Le => Builtin::Ge,
        Builtin::Lt => Builtin::Gt,
        other => other,
    }
}
