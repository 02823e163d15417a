//! Defects of the peer's terms, put into a copy of a program: `range`, `difference`, connectives that evaluate both
//! sides, integers that wrap around, Naturals below zero.
//!
//! In: a program and the difference that is looked into. Out: the copy, if the defect is of any consequence there.

use model::{Basic, Literal};
use program::{Builtin, DomainKind, Program, Term, TermId};

use super::super::difference::{Difference, What};
use super::super::trace::Trace;
use super::graft::{Graft, applications};

/// `range(a, b)` without `b`.
pub fn range(program: &Program, _: &Trace, _: &Difference) -> Vec<Program> {
    let mut graft = Graft::of(program);
    for (place, builtin, operands) in applications(program) {
        if builtin == Builtin::NaturalRange {
            let high = program.term_list(operands)[1];
            graft.replace(place, |graft, whole| {
                let arguments = graft.terms(&[whole, high]);
                Term::Builtin { builtin: Builtin::SetExcluding, arguments }
            });
        }
    }
    graft.done()
}

/// `difference(a, b)` as the symmetric difference.
pub fn difference(program: &Program, _: &Trace, _: &Difference) -> Vec<Program> {
    let mut graft = Graft::of(program);
    for (place, builtin, arguments) in applications(program) {
        if builtin == Builtin::SetDifference {
            graft.replace(place, |_, _| Term::Builtin { builtin: Builtin::SymmetricDifference, arguments });
        }
    }
    graft.done()
}

/// `and`, `or` and `implies` evaluate the right side whatever the left one is.
pub fn both_sides(program: &Program, _: &Trace, _: &Difference) -> Vec<Program> {
    let mut graft = Graft::of(program);
    for (place, builtin, operands) in applications(program) {
        if matches!(builtin, Builtin::And | Builtin::Or | Builtin::Implies) {
            let right = program.term_list(operands)[1];
            graft.replace(place, |graft, whole| {
                // True whatever the right side is, once it is evaluated.
                let defined = graft.builtin(Builtin::IsDef, &[right], place);
                let truth = graft.constant(Literal::Boolean(true), place);
                let evaluated = graft.builtin(Builtin::Or, &[defined, truth], place);
                Term::If { branches: graft.terms(&[evaluated, whole]), otherwise: None }
            });
        }
    }
    graft.done()
}

/// The operation that overflows gives, for these operands, what is left of the result in 64 bits.
pub fn wrap(program: &Program, _: &Trace, difference: &Difference) -> Vec<Program> {
    let What::Fault { id, text, span, .. } = &difference.what else { return Vec::new() };
    let operation = text.strip_prefix("integer overflow: ").filter(|_| id == "integer-overflow");
    let Some((builtin, left, right, wrapped)) = operation.and_then(wrapped) else { return Vec::new() };
    let mut graft = Graft::of(program);
    for (place, _, operands) in applications(program)
        .into_iter()
        .filter(|(place, found, operands)| program.term_span(*place) == *span && *found == builtin && operands.len == 2)
    {
        let (a, b) = (program.term_list(operands)[0], program.term_list(operands)[1]);
        graft.replace(place, |graft, whole| {
            let is = |graft: &mut Graft, operand: TermId, value: i64| {
                let value = graft.constant(Literal::Integer(value), operand);
                graft.builtin(Builtin::Eq, &[operand, value], place)
            };
            let (first, second) = (is(graft, a, left), is(graft, b, right));
            let both = graft.builtin(Builtin::And, &[first, second], place);
            let result = graft.constant(Literal::Integer(wrapped), place);
            Term::If { branches: graft.terms(&[both, result]), otherwise: Some(whole) }
        });
    }
    graft.done()
}

/// The operation that a text tells, its operands, and its result in 64 bits.
fn wrapped(operation: &str) -> Option<(Builtin, i64, i64, i64)> {
    let mut words = operation.split(' ');
    let (left, symbol, right): (i64, _, i64) =
        (words.next()?.parse().ok()?, words.next()?, words.next()?.parse().ok()?);
    let (builtin, wrapped) = match symbol {
        "+" => (Builtin::IntAdd, left.wrapping_add(right)),
        "-" => (Builtin::IntSub, left.wrapping_sub(right)),
        "*" => (Builtin::IntMul, left.wrapping_mul(right)),
        _ => return None,
    };
    Some((builtin, left, right, wrapped))
}

/// A Natural is any Integer.
pub fn negative_natural(program: &Program, _: &Trace, difference: &Difference) -> Vec<Program> {
    let What::Fault { text, .. } = &difference.what else { return Vec::new() };
    if !text.contains("so it is no Natural") && !text.contains("is not in Natural") {
        return Vec::new();
    }
    let mut graft = Graft::of(program);
    for (place, builtin, operands) in applications(program) {
        if builtin == Builtin::IntToNat {
            let number = program.term(program.term_list(operands)[0]).clone();
            graft.replace(place, |_, _| number);
        }
    }
    graft.change(|program| {
        for domain in &mut program.domains {
            if domain.kind == DomainKind::Basic(Basic::Natural) {
                domain.kind = DomainKind::Basic(Basic::Integer);
            }
        }
    });
    graft.done()
}
