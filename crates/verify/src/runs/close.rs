//! Closes propositions: writes the values of bound variables into the term.

use machine::Value;
use program::{Builtin, DomainKind, Expression, FunctionId, Literal, Program, Term, TermId, TermList};

use crate::temporal::read::Proposition;

/// A proposition as an expression without free variables; its terms are added to the program. `None` if a value cannot
/// be written as a term.
pub fn closed(program: &mut Program, proposition: &Proposition) -> Option<Expression> {
    let mut body = proposition.term;
    for (slot, value) in &proposition.bindings {
        let value = written(program, value, body)?;
        body = add(program, Term::Let { slot: *slot, value, body }, body);
    }
    let names = vec![String::new(); proposition.frame as usize];
    Some(Expression { parameters: Vec::new(), frame: proposition.frame, names, body })
}

/// The constant true, at the place of a proposition.
pub fn truth(program: &mut Program, proposition: &Proposition) -> Expression {
    program.constants.push(Literal::Boolean(true));
    let body = add(program, Term::Constant(program.constants.len() as u32 - 1), proposition.term);
    Expression { parameters: Vec::new(), frame: 0, names: Vec::new(), body }
}

/// The negation of an expression.
pub fn negated(program: &mut Program, expression: &Expression) -> Expression {
    let arguments = TermList { start: program.term_lists.len() as u32, len: 1 };
    program.term_lists.push(expression.body);
    let body = add(program, Term::Builtin { builtin: Builtin::Not, arguments }, expression.body);
    Expression { body, ..expression.clone() }
}

/// Adds a term with the place of another.
fn add(program: &mut Program, term: Term, like: TermId) -> TermId {
    program.term_domains.push(program.term_domain(like));
    program.term_spans.push(program.term_span(like));
    program.terms.push(term);
    TermId(program.terms.len() as u32 - 1)
}

fn written(program: &mut Program, value: &Value, like: TermId) -> Option<TermId> {
    let literal = match value {
        Value::Undef => Literal::Undef,
        Value::Boolean(truth) => Literal::Boolean(*truth),
        Value::Integer(number) => Literal::Integer(*number),
        Value::Real(number) => Literal::Real(number.get()),
        Value::Complex(parts) => Literal::Complex(parts.0.get(), parts.1.get()),
        Value::Char(character) => Literal::Char(*character),
        Value::String(text) => Literal::String(text.to_string()),
        Value::Enum(domain, index) => Literal::Enum(*domain, *index),
        Value::Element(domain, index) => {
            let names = |function: &program::Function| {
                let base = match &program.domain(function.codomain).kind {
                    DomainKind::Concrete { base, .. } => *base,
                    _ => function.codomain,
                };
                function.element == Some(*index) && base == *domain
            };
            let function = FunctionId(program.functions.iter().position(names)? as u32);
            let arguments = TermList { start: 0, len: 0 };
            return Some(add(program, Term::Read { function, arguments }, like));
        }
        Value::Tuple(components) => {
            let parts: Option<Vec<TermId>> = components.iter().map(|part| written(program, part, like)).collect();
            let parts = parts?;
            let list = TermList { start: program.term_lists.len() as u32, len: parts.len() as u32 };
            program.term_lists.extend(parts);
            return Some(add(program, Term::Tuple(list), like));
        }
        _ => return None,
    };
    program.constants.push(literal);
    Some(add(program, Term::Constant(program.constants.len() as u32 - 1), like))
}
