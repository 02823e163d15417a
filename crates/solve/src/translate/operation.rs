//! The functions of the standard library: connectives, equality, order, arithmetic, membership.
//!
//! SYNC(operations): `machine/src/builtin` says what each one does; `tests/agreement.rs` compares the two.

use model::TermKind;
use syntax::Span;

use super::{Frame, Partial, Result, Translator, equal, sure, to_real};
use crate::formula::{Arithmetic, Order, Sort, Term, Value};

impl Translator<'_> {
    pub(super) fn operation(
        &mut self,
        name: &str,
        arguments: &[model::Term],
        term: &model::Term,
        frame: &Frame,
        depth: usize,
    ) -> Result {
        if let ("contains", [set, element]) = (name, arguments) {
            return self.membership(set, element, frame, depth);
        }
        let mut operands = Vec::new();
        for argument in arguments {
            operands.push(self.term(argument, frame, depth)?);
        }
        match (name, &operands[..]) {
            ("and", [a, b]) => Ok(kleene(a, b, false)),
            ("or", [a, b]) => Ok(kleene(a, b, true)),
            ("implies", [a, b]) => Ok(kleene(&Partial { value: a.value.clone().not(), ..a.clone() }, b, true)),
            ("not", [a]) => Ok(Partial { value: a.value.clone().not(), ..a.clone() }),
            ("eq", [a, b]) => self.compared(a, b, term.span),
            ("neq", [a, b]) => {
                let equal = self.compared(a, b, term.span)?;
                Ok(Partial { value: equal.value.not(), ..equal })
            }
            ("isDef", [a]) => Ok(Partial { value: a.defined.clone(), defined: Term::TRUE, safe: a.safe.clone() }),
            ("isUndef", [a]) => {
                Ok(Partial { value: a.defined.clone().not(), defined: Term::TRUE, safe: a.safe.clone() })
            }
            _ => {
                let safe: Vec<Term> = operands.iter().flat_map(|one| [one.safe.clone(), one.defined.clone()]).collect();
                let values: Vec<Term> = operands.into_iter().map(|one| one.value).collect();
                let (value, also) = self.strict(name, values, term)?;
                Ok(Partial { value, defined: Term::TRUE, safe: Term::and(safe.into_iter().chain([also])) })
            }
        }
    }

    /// Equality of terms that may be numbers of two kinds.
    fn compared(&self, a: &Partial, b: &Partial, span: Span) -> Result {
        let sorts = (self.formula.sort(&a.value), self.formula.sort(&b.value));
        let known = a.defined.truth() != Some(false) && b.defined.truth() != Some(false);
        match sorts {
            (Sort::Integer, Sort::Real) if known => {
                Ok(equal(&Partial { value: to_real(a.value.clone()), ..a.clone() }, b))
            }
            (Sort::Real, Sort::Integer) if known => {
                Ok(equal(a, &Partial { value: to_real(b.value.clone()), ..b.clone() }))
            }
            (a_sort, b_sort) if a_sort != b_sort && known => self.outside("an equality across domains", span),
            _ => Ok(equal(a, b)),
        }
    }

    /// Operations that need all their operands; with what must hold for them to succeed.
    fn strict(&mut self, name: &str, mut values: Vec<Term>, term: &model::Term) -> Result<(Term, Term)> {
        let sorts: Vec<Sort> = values.iter().map(|value| self.formula.sort(value)).collect();
        let numbers = sorts.iter().all(|sort| matches!(sort, Sort::Integer | Sort::Real));
        let mixed = sorts.contains(&Sort::Real);
        if numbers && mixed {
            let kinds = values.into_iter().zip(&sorts);
            values = kinds.map(|(value, sort)| if *sort == Sort::Integer { to_real(value) } else { value }).collect();
        }
        let plain = |value: Term| Ok((value, Term::TRUE));
        match (name, &values[..]) {
            ("xor", [a, b]) => plain(Term::equal(a.clone(), b.clone()).not()),
            ("iff", [a, b]) => plain(Term::equal(a.clone(), b.clone())),
            ("lt", [a, b]) if numbers => plain(Term::compare(Order::Less, a.clone(), b.clone())),
            ("le", [a, b]) if numbers => plain(Term::compare(Order::LessEqual, a.clone(), b.clone())),
            ("gt", [a, b]) if numbers => plain(Term::compare(Order::Less, b.clone(), a.clone())),
            ("ge", [a, b]) if numbers => plain(Term::compare(Order::LessEqual, b.clone(), a.clone())),
            ("max", [a, b]) if numbers => plain(larger(a, b)),
            ("min", [a, b]) if numbers => plain(smaller(a, b)),
            ("plus", [a]) if numbers => plain(a.clone()),
            ("minus", [a]) if numbers => Ok(computed(Arithmetic::Subtract, zero(mixed), a.clone(), mixed)),
            ("abs", [a]) if numbers => {
                let (negative, safe) = computed(Arithmetic::Subtract, zero(mixed), a.clone(), mixed);
                let below = Term::compare(Order::Less, a.clone(), zero(mixed));
                let safe = Term::or([below.clone().not(), safe]);
                Ok((Term::choose(below, negative, a.clone()), safe))
            }
            ("plus", [a, b]) if numbers => Ok(computed(Arithmetic::Add, a.clone(), b.clone(), mixed)),
            ("minus", [a, b]) if numbers => Ok(computed(Arithmetic::Subtract, a.clone(), b.clone(), mixed)),
            ("mult", [a, b]) if numbers => Ok(computed(Arithmetic::Multiply, a.clone(), b.clone(), mixed)),
            ("idiv" | "mod", [a, b]) if numbers && !mixed => {
                let nonzero = Term::equal(b.clone(), Term::integer(0)).not();
                if name == "mod" {
                    return Ok((Term::compute(Arithmetic::Remainder, a.clone(), b.clone()), nonzero));
                }
                let (value, bounded) = computed(Arithmetic::Quotient, a.clone(), b.clone(), false);
                Ok((value, Term::and([nonzero, bounded])))
            }
            ("div", [a, b]) if numbers => {
                let nonzero = Term::equal(b.clone(), zero(mixed)).not();
                let real = |value: &Term| if mixed { value.clone() } else { to_real(value.clone()) };
                Ok((Term::compute(Arithmetic::Divide, real(a), real(b)), nonzero))
            }
            ("itor" | "ntor", [a]) => plain(to_real(a.clone())),
            ("ntoi", [a]) => plain(a.clone()),
            ("iton", [a]) => Ok((a.clone(), Term::compare(Order::LessEqual, Term::integer(0), a.clone()))),
            ("floor", [a]) if mixed => {
                let whole = Term::Floor(Box::new(a.clone()));
                Ok((whole.clone(), bounded(whole)))
            }
            _ => self.outside(format!("the function `{name}`"), term.span),
        }
    }

    /// `x in S`: S is a domain, a range or a collection.
    fn membership(&mut self, set: &model::Term, element: &model::Term, frame: &Frame, depth: usize) -> Result {
        let element = self.term(element, frame, depth)?;
        let mut any = Vec::new();
        let mut safe = vec![element.safe.clone()];
        if let TermKind::Collection { elements, .. } = &set.kind {
            for other in elements {
                let other = self.term(other, frame, depth)?;
                let same = self.compared(&element, &other, set.span)?;
                any.push(same.value);
                safe.push(same.safe);
            }
        } else if let TermKind::Range { low, high, step: None, .. } = &set.kind {
            let (low, high) = (self.term(low, frame, depth)?, self.term(high, frame, depth)?);
            if [&low, &high, &element].iter().any(|term| self.formula.sort(&term.value) != Sort::Integer) {
                return self.outside("a range that is not of integers", set.span);
            }
            let within = [
                element.defined.clone(),
                Term::compare(Order::LessEqual, low.value, element.value.clone()),
                Term::compare(Order::LessEqual, element.value.clone(), high.value),
            ];
            any.push(Term::and(within));
            safe.extend([low.safe, low.defined, high.safe, high.defined]);
        } else {
            let Some(values) = self.enumerated(set) else {
                return self.outside(format!("membership in {}", self.model.domains.display(set.domain)), set.span);
            };
            for value in values {
                any.push(equal(&element, &sure(Term::Constant(value))).value);
            }
        }
        Ok(Partial { value: Term::or(any), defined: Term::TRUE, safe: Term::and(safe) })
    }
}

/// Kleene's connectives: one operand that decides is enough; the right one is evaluated only where the left does not.
fn kleene(a: &Partial, b: &Partial, deciding: bool) -> Partial {
    let decides = |one: &Partial| {
        let value = if deciding { one.value.clone() } else { one.value.clone().not() };
        Term::and([one.defined.clone(), value])
    };
    let either = Term::or([decides(a), decides(b)]);
    let value = if deciding { either.clone() } else { either.clone().not() };
    Partial {
        value,
        defined: Term::or([Term::and([a.defined.clone(), b.defined.clone()]), either]),
        safe: Term::and([a.safe.clone(), Term::or([decides(a), b.safe.clone()])]),
    }
}

fn zero(real: bool) -> Term {
    Term::Constant(if real { Value::Real(0.0) } else { Value::Integer(0) })
}

fn larger(a: &Term, b: &Term) -> Term {
    Term::choose(Term::compare(Order::Less, a.clone(), b.clone()), b.clone(), a.clone())
}

fn smaller(a: &Term, b: &Term) -> Term {
    Term::choose(Term::compare(Order::Less, a.clone(), b.clone()), a.clone(), b.clone())
}

/// The result of an operation, and that it fits.
fn computed(operation: Arithmetic, a: Term, b: Term, real: bool) -> (Term, Term) {
    let result = match (operation, &a, &b) {
        (Arithmetic::Subtract, Term::Constant(Value::Integer(0)), Term::Constant(Value::Integer(n)))
            if *n != i64::MIN =>
        {
            return (Term::integer(-n), Term::TRUE);
        }
        (Arithmetic::Subtract, Term::Constant(Value::Real(0.0)), Term::Constant(Value::Real(x))) => {
            return (Term::Constant(Value::Real(-x)), Term::TRUE);
        }
        _ => Term::compute(operation, a, b),
    };
    let fits = if real { Term::TRUE } else { bounded(result.clone()) };
    (result, fits)
}

/// It has 64 bits.
fn bounded(term: Term) -> Term {
    let low = Term::compare(Order::LessEqual, Term::integer(i64::MIN), term.clone());
    Term::and([low, Term::compare(Order::LessEqual, term, Term::integer(i64::MAX))])
}
