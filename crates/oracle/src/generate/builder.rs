//! The common part of the generators of terms and rules: the random source, the signature so far, and scopes.

use super::piece::{Piece, Sort};
use super::random::Random;
use super::signature::{CARRIERS, ENUMS, Function, Kind, RANGES, Signature, Type};

/// What a term may mention.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Layer {
    /// No function at all.
    Literals,
    /// Static functions.
    Static,
    /// Static and initialised functions.
    Initial,
    /// Everything but functions the machine only writes.
    State,
}

/// A variable in scope.
#[derive(Debug, Clone)]
pub(super) struct Variable {
    pub name: String,
    pub domain: Type,
    pub location: bool,
}

/// What is in scope at a place.
#[derive(Debug, Clone)]
pub(super) struct Scope {
    pub layer: Layer,
    pub variables: Vec<Variable>,
    pub locals: Vec<Function>,
    /// The place is within a rule that the agents run.
    pub agent: bool,
    /// The place is within the main rule: elsewhere, rules that run rule values could run without end.
    pub main: bool,
    /// The place is within a turbo rule: it may have local functions.
    pub turbo: bool,
    /// What the turbo rule returns.
    pub result: Option<Type>,
}

impl Layer {
    /// May dynamic domains be ranged over?
    pub fn reads_domains(self) -> bool {
        matches!(self, Layer::Initial | Layer::State)
    }
}

impl Scope {
    pub fn new(layer: Layer) -> Scope {
        Scope {
            layer,
            variables: Vec::new(),
            locals: Vec::new(),
            agent: false,
            main: false,
            turbo: false,
            result: None,
        }
    }

    /// With one more variable.
    pub fn with(&self, name: &str, domain: &Type) -> Scope {
        let mut scope = self.clone();
        scope.variables.push(Variable { name: name.to_string(), domain: domain.clone(), location: false });
        scope
    }
}

/// A model in the making.
#[derive(Debug)]
pub(super) struct Builder {
    pub random: Random,
    pub signature: Signature,
    /// How many loop counters there are.
    pub counters: usize,
    /// The functions that an initial value may read: rarely one that reads it in turn.
    pub initialised: Vec<String>,
    /// How many local functions.
    pub locals: usize,
}

pub(super) fn term(domain: &Type, template: &str, children: Vec<Piece>) -> Piece {
    Piece::new(Sort::Term(domain.clone()), template, children)
}

pub(super) fn leaf(domain: &Type, text: impl Into<String>) -> Piece {
    Piece::text(Sort::Term(domain.clone()), text)
}

impl Builder {
    /// A variable's name that is not in scope; names recur in disjoint scopes.
    pub fn name(&mut self, scope: &Scope) -> String {
        let names = ["$a", "$b", "$c", "$d", "$e", "$f", "$g", "$h", "$j", "$k", "$l", "$m", "$n", "$p", "$q"];
        let free: Vec<&str> =
            names.into_iter().filter(|name| scope.variables.iter().all(|known| known.name != *name)).collect();
        self.random
            .pick(&free[..free.len().min(4)])
            .map_or_else(|| format!("$v{}", scope.variables.len()), |name| name.to_string())
    }

    /// A type without structure; if wanted, only one that can be enumerated.
    pub fn simple(&mut self, enumerable: bool) -> Type {
        let choice = if enumerable { self.random.below(6) } else { self.random.below(12) };
        match choice {
            0 => Type::Boolean,
            1 | 2 => Type::Enum(self.random.below(ENUMS.len())),
            3 | 4 => Type::Concrete(self.random.below(RANGES.len())),
            5 => Type::Element(self.carrier(false)),
            6..=8 => Type::Integer,
            9 => Type::Natural,
            10 if self.random.percent(15) => Type::Complex,
            10 => Type::Real,
            _ => {
                if self.random.percent(50) {
                    Type::String
                } else {
                    Type::Char
                }
            }
        }
    }

    /// Any type.
    pub fn any_type(&mut self, depth: u32) -> Type {
        if depth == 0 || self.random.percent(65) {
            return self.simple(false);
        }
        match self.random.below(6) {
            0 | 1 => self.any_type(depth - 1).seq(),
            2 | 3 => self.any_type(depth - 1).set(),
            4 => Type::Prod(vec![self.any_type(depth - 1), self.any_type(depth - 1)]),
            _ if self.random.percent(40) => Type::Bag(Box::new(self.any_type(depth - 1))),
            _ => Type::Map(Box::new(self.simple(true)), Box::new(self.any_type(depth - 1))),
        }
    }

    /// An abstract domain or a subset of one, other than all agents.
    pub fn carrier(&mut self, dynamic: bool) -> usize {
        let fitting: Vec<usize> = (1..CARRIERS.len()).filter(|index| !dynamic || CARRIERS[*index].dynamic).collect();
        fitting[self.random.below(fitting.len())]
    }

    /// The functions that give a term of a type in a scope.
    pub fn functions(&self, scope: &Scope, wanted: &Type) -> Vec<Function> {
        let readable = |function: &&Function| match scope.layer {
            Layer::Literals => false,
            Layer::Static => function.kind == Kind::Static,
            Layer::Initial => function.kind == Kind::Static || self.initialised.contains(&function.name),
            Layer::State => function.kind != Kind::Out,
        };
        let all = self.signature.functions.iter().chain(&scope.locals);
        all.filter(readable).filter(|function| function.codomain.fits(wanted)).cloned().collect()
    }
}
