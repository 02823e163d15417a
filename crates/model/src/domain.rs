//! Domains: the universes of the many-sorted first-order structures that ASM states are
//! (spec/language.md, section 3).
//!
//! All domains of a model live in one interned table: two [`DomainId`]s are equal exactly when the domains are
//! the same (structured domains by structure, declared ones by declaration).

use std::collections::BTreeMap;

use syntax::Span;

use crate::collection::CollectionKind;
use crate::id::DomainId;
use crate::term::Term;

/// The basic domains. `Natural ⊂ Integer ⊂ Real ⊂ Complex`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Basic {
    /// Complex numbers, as two doubles.
    Complex,
    /// IEEE 754 doubles.
    Real,
    /// 64-bit integers; overflow is an error.
    Integer,
    /// Non-negative 64-bit integers.
    Natural,
    /// One Unicode scalar value.
    Char,
    /// Unicode strings.
    String,
    /// Truth values.
    Boolean,
    /// The domain of `undef` alone; compatible with every other.
    Undef,
}

/// A domain with the name and place of its declaration (structured ones have neither).
#[derive(Debug, Clone)]
pub struct Domain {
    /// What it is.
    pub kind: DomainKind,
    /// Declared name.
    pub name: Option<String>,
    /// Place of the declaration.
    pub span: Option<Span>,
}

/// What a domain is.
#[derive(Debug, Clone)]
pub enum DomainKind {
    /// A basic domain.
    Basic(Basic),
    /// A type variable of a polymorphic library function.
    Any,
    /// An enumeration, its literals in order.
    Enum {
        /// Names of the literals.
        literals: Vec<String>,
    },
    /// A carrier of unnamed elements. `Agent` and `Reserve` are predefined.
    Abstract {
        /// May grow by `extend`.
        dynamic: bool,
    },
    /// A subset of a type domain.
    Concrete {
        /// The domain of which it is a subset; this is never concrete itself.
        base: DomainId,
        /// Whether its contents are part of the state.
        dynamic: bool,
        /// The contents of a static one. ([`crate::Init`] has those of a dynamic one.)
        definition: Option<Term>,
    },
    /// A Cartesian product of at least two domains.
    Prod(Vec<DomainId>),
    /// Finite sequences.
    Seq(DomainId),
    /// Finite subsets.
    Powerset(DomainId),
    /// Finite multisets.
    Bag(DomainId),
    /// Finite maps.
    Map(DomainId, DomainId),
    /// Rules with these parameter domains.
    Rule(Vec<DomainId>),
    /// A domain that is unknown after a reported fault; compatible with every other.
    Error,
}

/// The interned table of all domains of a model.
///
/// The first entries are fixed: see the constants.
#[derive(Debug, Clone)]
pub struct Domains {
    entries: Vec<Domain>,
    structures: BTreeMap<(Constructor, Vec<DomainId>), DomainId>,
}

/// Tells structured domains over the same parts apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Constructor {
    Prod,
    Seq,
    Powerset,
    Bag,
    Map,
    Rule,
}

impl Domains {
    /// [`DomainKind::Error`].
    pub const ERROR: DomainId = DomainId(0);
    /// Complex.
    pub const COMPLEX: DomainId = DomainId(1);
    /// Real.
    pub const REAL: DomainId = DomainId(2);
    /// Integer.
    pub const INTEGER: DomainId = DomainId(3);
    /// Natural.
    pub const NATURAL: DomainId = DomainId(4);
    /// Char.
    pub const CHAR: DomainId = DomainId(5);
    /// String.
    pub const STRING: DomainId = DomainId(6);
    /// Boolean.
    pub const BOOLEAN: DomainId = DomainId(7);
    /// Undef.
    pub const UNDEF: DomainId = DomainId(8);
    /// The predefined dynamic abstract domain of agents.
    pub const AGENT: DomainId = DomainId(9);
    /// The predefined dynamic abstract domain Reserve.
    pub const RESERVE: DomainId = DomainId(10);
    /// The wildcard `Any` that is never bound.
    pub const ANY: DomainId = DomainId(11);

    /// The table of the predefined domains.
    pub fn new() -> Self {
        let named = |kind, name: &str| Domain { kind, name: Some(name.to_string()), span: None };
        let basic = |basic, name| named(DomainKind::Basic(basic), name);
        Domains {
            entries: vec![
                Domain { kind: DomainKind::Error, name: None, span: None },
                basic(Basic::Complex, "Complex"),
                basic(Basic::Real, "Real"),
                basic(Basic::Integer, "Integer"),
                basic(Basic::Natural, "Natural"),
                basic(Basic::Char, "Char"),
                basic(Basic::String, "String"),
                basic(Basic::Boolean, "Boolean"),
                basic(Basic::Undef, "Undef"),
                named(DomainKind::Abstract { dynamic: true }, "Agent"),
                named(DomainKind::Abstract { dynamic: true }, "Reserve"),
                named(DomainKind::Any, "Any"),
            ],
            structures: BTreeMap::new(),
        }
    }

    /// Adds a declared domain; it differs from all others.
    pub fn declare(&mut self, name: impl Into<String>, kind: DomainKind, span: Span) -> DomainId {
        self.entries.push(Domain { kind, name: Some(name.into()), span: Some(span) });
        DomainId(self.entries.len() as u32 - 1)
    }

    /// The one domain of this structure; the kind must be a structured one.
    pub fn structured(&mut self, kind: DomainKind) -> DomainId {
        let key = match &kind {
            DomainKind::Prod(parts) => (Constructor::Prod, parts.clone()),
            DomainKind::Rule(parts) => (Constructor::Rule, parts.clone()),
            DomainKind::Seq(of) => (Constructor::Seq, vec![*of]),
            DomainKind::Powerset(of) => (Constructor::Powerset, vec![*of]),
            DomainKind::Bag(of) => (Constructor::Bag, vec![*of]),
            DomainKind::Map(key, value) => (Constructor::Map, vec![*key, *value]),
            _ => unreachable!("only structured domains are interned"),
        };
        let next = DomainId(self.entries.len() as u32);
        let id = *self.structures.entry(key).or_insert(next);
        if id == next {
            self.entries.push(Domain { kind, name: None, span: None });
        }
        id
    }

    /// The set of values of a domain.
    pub fn powerset(&mut self, of: DomainId) -> DomainId {
        self.structured(DomainKind::Powerset(of))
    }

    /// The collections of one kind with elements of a domain; for a map the domain is that of its pairs.
    pub fn collection(&mut self, kind: CollectionKind, of: DomainId) -> DomainId {
        let kind = match kind {
            CollectionKind::Set => DomainKind::Powerset(of),
            CollectionKind::Seq => DomainKind::Seq(of),
            CollectionKind::Bag => DomainKind::Bag(of),
            CollectionKind::Map => match self.kind(of) {
                DomainKind::Prod(pair) if pair.len() == 2 => DomainKind::Map(pair[0], pair[1]),
                _ => return Domains::ERROR,
            },
        };
        self.structured(kind)
    }

    /// The domain of a collection's elements; for a map, of its pairs.
    pub fn element(&mut self, collection: DomainId) -> Option<DomainId> {
        match self.kind(self.type_domain(collection)) {
            DomainKind::Powerset(of) | DomainKind::Seq(of) | DomainKind::Bag(of) => Some(*of),
            DomainKind::Map(key, value) => {
                let pair = vec![*key, *value];
                Some(self.structured(DomainKind::Prod(pair)))
            }
            DomainKind::Error | DomainKind::Any => Some(Domains::ERROR),
            _ => None,
        }
    }

    /// The parameter domains of a function declared over `domain`: the components of a product, otherwise the domain
    /// itself.
    pub fn parameters_of(&self, domain: DomainId) -> Vec<DomainId> {
        match self.kind(domain) {
            DomainKind::Prod(parts) => parts.clone(),
            _ => vec![domain],
        }
    }

    /// The domain with this id; panics on an id of another table.
    pub fn get(&self, id: DomainId) -> &Domain {
        &self.entries[id.0 as usize]
    }

    /// The domain with this id, to complete its declaration.
    pub fn get_mut(&mut self, id: DomainId) -> &mut Domain {
        &mut self.entries[id.0 as usize]
    }

    /// What the domain is.
    pub fn kind(&self, id: DomainId) -> &DomainKind {
        &self.get(id).kind
    }

    /// The domain itself, or the base of a concrete one.
    pub fn type_domain(&self, id: DomainId) -> DomainId {
        match self.kind(id) {
            DomainKind::Concrete { base, .. } => *base,
            _ => id,
        }
    }

    /// All domains in the order of their ids.
    pub fn iter(&self) -> impl Iterator<Item = (DomainId, &Domain)> {
        self.entries.iter().enumerate().map(|(i, entry)| (DomainId(i as u32), entry))
    }

    /// The domain as a model would write it.
    pub fn display(&self, id: DomainId) -> String {
        let list = |ids: &[DomainId]| ids.iter().map(|id| self.display(*id)).collect::<Vec<_>>().join(",");
        let entry = self.get(id);
        match &entry.kind {
            DomainKind::Error => "?".to_string(),
            DomainKind::Prod(parts) => format!("Prod({})", list(parts)),
            DomainKind::Seq(of) => format!("Seq({})", self.display(*of)),
            DomainKind::Powerset(of) => format!("Powerset({})", self.display(*of)),
            DomainKind::Bag(of) => format!("Bag({})", self.display(*of)),
            DomainKind::Map(key, value) => format!("Map({},{})", self.display(*key), self.display(*value)),
            DomainKind::Rule(parts) if parts.is_empty() => "Rule".to_string(),
            DomainKind::Rule(parts) => format!("Rule({})", list(parts)),
            _ => entry.name.clone().unwrap_or_default(),
        }
    }
}

impl Default for Domains {
    fn default() -> Self {
        Domains::new()
    }
}
