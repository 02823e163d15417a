//! Constants: the pool, and literals with a sign or a coercion as one constant.
//!
//! Nothing else is folded, so no meaning changes and the IR stays close to the text.

use model::{Basic, DomainId, DomainKind, Literal, Term, TermKind};
use syntax::Span;

use crate::builtin::Builtin;
use crate::ir::{self, TermId};
use crate::lower::Lowering;
use crate::lower::meaning::Meaning;

/// The integers up to here are exact as doubles.
const EXACT: u64 = 1 << 53;

/// A literal as a key: doubles by their bits.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum ConstantKey {
    Undef,
    Boolean(bool),
    Integer(i64),
    Real(u64),
    Complex(u64, u64),
    Char(char),
    String(String),
    Enum(DomainId, u32),
}

impl ConstantKey {
    pub fn of(literal: &Literal) -> Self {
        match literal {
            Literal::Undef => ConstantKey::Undef,
            Literal::Boolean(truth) => ConstantKey::Boolean(*truth),
            Literal::Integer(number) => ConstantKey::Integer(*number),
            Literal::Real(number) => ConstantKey::Real(number.to_bits()),
            Literal::Complex(re, im) => ConstantKey::Complex(re.to_bits(), im.to_bits()),
            Literal::Char(character) => ConstantKey::Char(*character),
            Literal::String(text) => ConstantKey::String(text.clone()),
            Literal::Enum(domain, index) => ConstantKey::Enum(*domain, *index),
        }
    }
}

impl Lowering<'_, '_> {
    /// Adds a constant.
    pub(super) fn constant(&mut self, literal: &Literal, domain: DomainId, span: Span) -> TermId {
        let index = self.constant_index(literal);
        self.term(ir::Term::Constant(index), domain, span)
    }

    /// The index of a literal in the pool. Adding zero turns a negative zero into zero.
    pub(super) fn constant_index(&mut self, literal: &Literal) -> u32 {
        let literal = match literal {
            Literal::Real(number) => Literal::Real(number + 0.0),
            Literal::Complex(re, im) => Literal::Complex(re + 0.0, im + 0.0),
            other => other.clone(),
        };
        let constants = &mut self.program.constants;
        *self.constants.entry(ConstantKey::of(&literal)).or_insert_with(|| {
            constants.push(literal);
            constants.len() as u32 - 1
        })
    }

    /// Adds the constant undef.
    pub(super) fn undef(&mut self, domain: DomainId, span: Span) -> TermId {
        self.constant(&Literal::Undef, domain, span)
    }

    /// The value of a term that is a literal, or a literal with a sign or a coercion.
    pub(super) fn folded(&mut self, term: &Term) -> Option<Literal> {
        match &term.kind {
            TermKind::Literal(literal) => Some(literal.clone()),
            TermKind::Coerce(operand) => coerced(&self.folded(operand)?, self.model.domains.kind(term.domain)),
            TermKind::Apply { function, arguments } if arguments.len() == 1 => match self.meaning(*function) {
                Meaning::Builtin(Builtin::IntNeg | Builtin::RealNeg | Builtin::ComplexNeg) => {
                    negated(&self.folded(&arguments[0])?)
                }
                Meaning::Argument(0) => self.folded(&arguments[0]),
                _ => None,
            },
            _ => None,
        }
    }
}

fn negated(literal: &Literal) -> Option<Literal> {
    match literal {
        Literal::Integer(number) => number.checked_neg().map(Literal::Integer),
        Literal::Real(number) => Some(Literal::Real(-number)),
        Literal::Complex(re, im) => Some(Literal::Complex(-re, -im)),
        _ => None,
    }
}

/// The literal in the form of a domain, Real or Complex, where that is exact.
pub(super) fn coerced(literal: &Literal, to: &DomainKind) -> Option<Literal> {
    let number = match literal {
        Literal::Integer(number) if number.unsigned_abs() <= EXACT => *number as f64,
        Literal::Real(number) => *number,
        _ => return None,
    };
    match to {
        DomainKind::Basic(Basic::Real) => Some(Literal::Real(number)),
        DomainKind::Basic(Basic::Complex) => Some(Literal::Complex(number, 0.0)),
        _ => None,
    }
}
