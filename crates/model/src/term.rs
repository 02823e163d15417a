//! Terms with every name resolved and a domain on each (spec/language.md, section 6).
//!
//! Operators are applications of library functions. Sugar is gone: `self.f(a)` is `f(self, a)`, and `x in S` is
//! `contains(S, x)`. Parentheses are dropped, and an argument list given as one product is taken apart.

use syntax::Span;

use crate::collection::CollectionKind;
use crate::id::DomainId;
use crate::id::{FunctionId, RuleId, VariableId};

/// A term, its domain and its place.
#[derive(Debug, Clone)]
pub struct Term {
    /// What it is.
    pub kind: TermKind,
    /// The domain of its value, as far as the checker knows it.
    pub domain: DomainId,
    /// Where it is written.
    pub span: Span,
}

/// A constant.
#[derive(Debug, Clone, PartialEq)]
pub enum Literal {
    /// `undef`
    Undef,
    /// `true`, `false`
    Boolean(bool),
    /// `12` and `12n`; the term's domain tells which.
    Integer(i64),
    /// `1.5`
    Real(f64),
    /// `2.0i1`: real and imaginary part.
    Complex(f64, f64),
    /// `'a'`
    Char(char),
    /// `"a"`, escapes decoded.
    String(String),
    /// An enum literal: its domain and its place in it.
    Enum(DomainId, u32),
}

/// `forall`, `exists`, `exists unique`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Quantifier {
    /// True when the condition holds for all.
    Forall,
    /// True when it holds for at least one.
    Exists,
    /// True when it holds for exactly one.
    ExistsUnique,
}

/// `$x in range`
#[derive(Debug, Clone)]
pub struct Binder {
    /// The variable bound.
    pub variable: VariableId,
    /// The collection ranged over: a term of kind [`TermKind::Domain`] or one whose value is a set, sequence or bag.
    /// It may use the variables of earlier binders.
    pub range: Term,
}

/// What a term is.
#[derive(Debug, Clone)]
pub enum TermKind {
    /// A constant.
    Literal(Literal),
    /// A logical variable of the enclosing declaration.
    Variable(VariableId),
    /// A variable that is bound elsewhere in the declaration, but not here: a run that gets here ends.
    Unbound(VariableId),
    /// A function applied to as many arguments as it has parameters.
    Apply {
        /// The function, overloads resolved.
        function: FunctionId,
        /// One term a parameter.
        arguments: Vec<Term>,
    },
    /// A domain as the set of its elements.
    Domain(DomainId),
    /// A tuple of at least two components.
    Tuple(Vec<Term>),
    /// Component `index` (from 0) of a product-valued term.
    Project {
        /// The product.
        tuple: Box<Term>,
        /// Which component, from 0.
        index: u32,
    },
    /// A collection by its elements; those of a map are [`TermKind::Tuple`]s of key and value.
    Collection {
        /// Of which kind.
        kind: CollectionKind,
        /// In order.
        elements: Vec<Term>,
    },
    /// `{low : high, step}`, both bounds included.
    Range {
        /// Of which kind, not a map.
        kind: CollectionKind,
        /// Lower bound.
        low: Box<Term>,
        /// Upper bound.
        high: Box<Term>,
        /// Step; 1 if absent.
        step: Option<Box<Term>>,
    },
    /// `{binders | condition : body}`
    Comprehension {
        /// Of which kind.
        kind: CollectionKind,
        /// What is ranged over, leftmost slowest.
        binders: Vec<Binder>,
        /// Only where this holds.
        condition: Option<Box<Term>>,
        /// The element; for a map a tuple of key and value.
        body: Box<Term>,
    },
    /// A quantified formula.
    Quantified {
        /// Which quantifier.
        quantifier: Quantifier,
        /// What is ranged over, leftmost slowest.
        binders: Vec<Binder>,
        /// The condition; true if absent.
        condition: Option<Box<Term>>,
    },
    /// `if … elseif … else … endif`; undef if no branch is taken.
    If {
        /// Guards and terms in order.
        branches: Vec<(Term, Term)>,
        /// Where no guard holds.
        otherwise: Option<Box<Term>>,
    },
    /// `switch … endswitch`; undef if no case matches.
    Switch {
        /// The term compared.
        subject: Box<Term>,
        /// Values compared with, in order, and the terms taken.
        cases: Vec<(Term, Term)>,
        /// Where no case matches.
        otherwise: Option<Box<Term>>,
    },
    /// `let (…) in … endlet`; a later binding may use an earlier one.
    Let {
        /// Variables and their terms, in order.
        bindings: Vec<(VariableId, Term)>,
        /// The term they are bound in.
        body: Box<Term>,
    },
    /// `<<r_x>>`: the rule as a value.
    Rule(RuleId),
    /// A numeric coercion along Natural ⊂ Integer ⊂ Real ⊂ Complex that changes the value's form: to the term's
    /// domain, which is Real or Complex.
    Coerce(Box<Term>),
    /// Stands where a reported fault left no term.
    Error,
}
