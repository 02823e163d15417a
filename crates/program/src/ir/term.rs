//! Terms of the IR (Börger & Stärk 2003, section 2.4.2).
//!
//! INVARIANT: a child's index is below its parent's.

use model::{CollectionKind, DomainId, FunctionId, Quantifier};

use crate::builtin::Builtin;
use crate::ir::{BinderList, ProcedureId, Slot, TermId, TermList};

/// A term of the IR. [`Program::term_domains`](crate::Program::term_domains) has its domain,
/// [`Program::term_spans`](crate::Program::term_spans) its span.
#[derive(Debug, Clone, PartialEq)]
pub enum Term {
    /// A constant of the pool [`Program::constants`](crate::Program::constants).
    Constant(u32),
    /// A variable.
    Slot(Slot),
    /// The value of a location of a dynamic function (controlled, monitored, shared, out, local), or an element of an
    /// abstract domain, which is a static function without arguments and without definition.
    Read {
        /// The function.
        function: FunctionId,
        /// A term for each parameter.
        arguments: TermList,
    },
    /// A static or derived function with a definition.
    Define {
        /// The function.
        function: FunctionId,
        /// A term for each parameter; they are evaluated first.
        arguments: TermList,
    },
    /// A library function.
    Builtin {
        /// Which.
        builtin: Builtin,
        /// Its arguments.
        arguments: TermList,
    },
    /// The set of a domain's elements.
    Domain(DomainId),
    /// A tuple.
    Tuple(TermList),
    /// Component of a tuple, from 0.
    Project {
        /// The tuple.
        tuple: TermId,
        /// Which component.
        index: u32,
    },
    /// A collection, given by its elements. Those of a map are tuples.
    Collection {
        /// Of which kind.
        kind: CollectionKind,
        /// In order.
        elements: TermList,
    },
    /// `{low : high, step}`
    Range {
        /// Of which kind.
        kind: CollectionKind,
        /// Lower bound.
        low: TermId,
        /// Upper bound, included.
        high: TermId,
        /// Step; 1 if absent.
        step: Option<TermId>,
    },
    /// A comprehension.
    Comprehension {
        /// Of which kind.
        kind: CollectionKind,
        /// The ranges; the leftmost varies slowest.
        binders: BinderList,
        /// The condition on the values.
        condition: Option<TermId>,
        /// The element.
        body: TermId,
    },
    /// A quantified formula.
    Quantified {
        /// Which quantifier.
        quantifier: Quantifier,
        /// The ranges; the leftmost varies slowest.
        binders: BinderList,
        /// The condition; true if absent.
        condition: Option<TermId>,
    },
    /// Guards and terms alternate in `branches`; undef if none is taken and there is no `otherwise`.
    If {
        /// guard, term, guard, term, …
        branches: TermList,
        /// The value if no guard holds.
        otherwise: Option<TermId>,
    },
    /// Values and terms alternate in `cases`.
    Switch {
        /// The term compared.
        subject: TermId,
        /// value, term, value, term, …
        cases: TermList,
        /// The value if no case matches.
        otherwise: Option<TermId>,
    },
    /// One binding; several are nested.
    Let {
        /// The variable.
        slot: Slot,
        /// Its value.
        value: TermId,
        /// The term that can read it.
        body: TermId,
    },
    /// A rule as a value.
    Rule(ProcedureId),
    /// A variable outside its scope: a fault.
    Unbound,
    /// A static or derived function that has no definition and is not an element: a fault.
    Missing(FunctionId),
    /// A numeric coercion to the term's domain, Real or Complex.
    Coerce(TermId),
}
