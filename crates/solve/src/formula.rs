//! Formulas: terms over symbols, each symbol a function of the model's state, and what its values are.
//!
//! INVARIANT: a term is well-sorted; constructors simplify: `true` and `false` never stand inside a connective, negations
//! stand on no connective.

/// What a value can be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Sort {
    /// Truth values.
    Boolean,
    /// 64-bit integers.
    Integer,
    /// Real numbers. LIMIT: the machine's are doubles.
    Real,
    /// Elements of the carrier of this index.
    Carrier(usize),
}

/// A set of elements that have nothing but their names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Carrier {
    /// The name of the domain.
    pub name: String,
    /// The elements that have names.
    pub elements: Vec<String>,
    /// There may be others.
    pub open: bool,
}

/// Names a symbol of a [`Formula`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SymbolId(pub usize);

/// A function of the state, or a variable.
#[derive(Debug, Clone, PartialEq)]
pub struct Symbol {
    /// The name; that of a definedness test is the function's.
    pub name: String,
    /// It is true where the function of this name is defined.
    pub definedness: bool,
    /// The sorts of its arguments.
    pub parameters: Vec<Sort>,
    /// The sort of its value.
    pub sort: Sort,
    /// Its values, where its domain is a finite part of the sort.
    pub values: Option<Vec<Value>>,
}

/// A constant.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub enum Value {
    /// A truth value.
    Boolean(bool),
    /// An integer.
    Integer(i64),
    /// A real number.
    Real(f64),
    /// An element of a carrier, by both numbers; one behind the last has no name.
    Element(usize, usize),
}

/// `<`, `<=`
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// Less.
    Less,
    /// Less or equal.
    LessEqual,
}

/// An operation on numbers; both operands have one sort.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Arithmetic {
    /// Sum.
    Add,
    /// Difference.
    Subtract,
    /// Product.
    Multiply,
    /// Quotient of integers, towards zero.
    Quotient,
    /// What that leaves, with the sign of the first operand.
    Remainder,
    /// Quotient of reals.
    Divide,
}

/// A term.
#[derive(Debug, Clone, PartialEq)]
pub enum Term {
    /// A constant.
    Constant(Value),
    /// The value of a symbol.
    Apply(SymbolId, Vec<Term>),
    /// Negation.
    Not(Box<Term>),
    /// All of them.
    And(Vec<Term>),
    /// One of them.
    Or(Vec<Term>),
    /// Equality of two terms of one sort.
    Equal(Box<Term>, Box<Term>),
    /// Comparison of numbers.
    Compare(Order, Box<Term>, Box<Term>),
    /// `if … then … else …`
    If(Box<Term>, Box<Term>, Box<Term>),
    /// Arithmetic.
    Compute(Arithmetic, Box<Term>, Box<Term>),
    /// An integer as a real.
    ToReal(Box<Term>),
    /// The greatest integer that is not above a real.
    Floor(Box<Term>),
}

/// A condition over symbols.
#[derive(Debug, Clone, PartialEq)]
pub struct Formula {
    /// Carriers.
    pub carriers: Vec<Carrier>,
    /// Symbols.
    pub symbols: Vec<Symbol>,
    /// What is to hold.
    pub condition: Term,
}

impl Term {
    /// `true`
    pub const TRUE: Term = Term::Constant(Value::Boolean(true));
    /// `false`
    pub const FALSE: Term = Term::Constant(Value::Boolean(false));

    /// An integer.
    pub fn integer(value: i64) -> Term {
        Term::Constant(Value::Integer(value))
    }

    /// The truth value of a constant.
    pub fn truth(&self) -> Option<bool> {
        match self {
            Term::Constant(Value::Boolean(truth)) => Some(*truth),
            _ => None,
        }
    }

    /// The opposite.
    #[allow(clippy::should_implement_trait, reason = "it is no operator of Rust's")]
    pub fn not(self) -> Term {
        match self {
            Term::Constant(Value::Boolean(truth)) => Term::Constant(Value::Boolean(!truth)),
            Term::Not(inner) => *inner,
            Term::And(terms) => Term::or(terms.into_iter().map(Term::not)),
            Term::Or(terms) => Term::and(terms.into_iter().map(Term::not)),
            other => Term::Not(Box::new(other)),
        }
    }

    /// All of them.
    pub fn and(terms: impl IntoIterator<Item = Term>) -> Term {
        Term::joined(terms, true, Term::And)
    }

    /// One of them.
    pub fn or(terms: impl IntoIterator<Item = Term>) -> Term {
        Term::joined(terms, false, Term::Or)
    }

    fn joined(terms: impl IntoIterator<Item = Term>, neutral: bool, join: fn(Vec<Term>) -> Term) -> Term {
        let mut all: Vec<Term> = Vec::new();
        for term in terms {
            match (term.truth(), term) {
                (Some(truth), _) if truth == neutral => {}
                (Some(truth), _) => return Term::Constant(Value::Boolean(truth)),
                (None, Term::And(inner)) if neutral => all.extend(inner),
                (None, Term::Or(inner)) if !neutral => all.extend(inner),
                (None, term) => all.push(term),
            }
        }
        all.dedup();
        match all.len() {
            0 => Term::Constant(Value::Boolean(neutral)),
            1 => all.remove(0),
            _ => join(all),
        }
    }

    /// The first term where the condition holds, else the second.
    pub fn choose(condition: Term, yes: Term, no: Term) -> Term {
        match (condition.truth(), yes.truth(), no.truth()) {
            (Some(true), ..) => yes,
            (Some(false), ..) => no,
            _ if yes == no => yes,
            (_, Some(true), _) => Term::or([condition, no]),
            (_, Some(false), _) => Term::and([condition.not(), no]),
            (_, _, Some(true)) => Term::or([condition.not(), yes]),
            (_, _, Some(false)) => Term::and([condition, yes]),
            _ => Term::If(Box::new(condition), Box::new(yes), Box::new(no)),
        }
    }

    /// Equality.
    pub fn equal(a: Term, b: Term) -> Term {
        match (&a, &b) {
            (Term::Constant(x), Term::Constant(y)) => Term::Constant(Value::Boolean(x == y)),
            _ if a == b => Term::TRUE,
            _ => match (a.truth(), b.truth()) {
                (Some(true), _) => b,
                (Some(false), _) => b.not(),
                (_, Some(true)) => a,
                (_, Some(false)) => a.not(),
                _ => Term::Equal(Box::new(a), Box::new(b)),
            },
        }
    }

    /// A comparison.
    pub fn compare(order: Order, a: Term, b: Term) -> Term {
        Term::Compare(order, Box::new(a), Box::new(b))
    }

    /// An operation on numbers.
    pub fn compute(operation: Arithmetic, a: Term, b: Term) -> Term {
        Term::Compute(operation, Box::new(a), Box::new(b))
    }

    /// The terms directly inside.
    pub fn children(&self) -> Vec<&Term> {
        match self {
            Term::Constant(_) => Vec::new(),
            Term::Apply(_, terms) | Term::And(terms) | Term::Or(terms) => terms.iter().collect(),
            Term::Not(a) | Term::ToReal(a) | Term::Floor(a) => vec![a],
            Term::Equal(a, b) | Term::Compare(_, a, b) | Term::Compute(_, a, b) => vec![a, b],
            Term::If(a, b, c) => vec![a, b, c],
        }
    }

    /// Every term inside, itself first.
    pub fn walk<'t>(&'t self, visit: &mut dyn FnMut(&'t Term)) {
        visit(self);
        self.children().into_iter().for_each(|child| child.walk(visit));
    }
}

impl Formula {
    /// The symbol of that number.
    pub fn symbol(&self, id: SymbolId) -> &Symbol {
        &self.symbols[id.0]
    }

    /// The sort of a term.
    pub fn sort(&self, term: &Term) -> Sort {
        match term {
            Term::Constant(Value::Integer(_)) | Term::Floor(_) => Sort::Integer,
            Term::Constant(Value::Real(_)) | Term::ToReal(_) => Sort::Real,
            Term::Constant(Value::Element(carrier, _)) => Sort::Carrier(*carrier),
            Term::Apply(id, _) => self.symbol(*id).sort,
            Term::If(_, yes, _) => self.sort(yes),
            Term::Compute(Arithmetic::Divide, ..) => Sort::Real,
            Term::Compute(_, a, _) => self.sort(a),
            _ => Sort::Boolean,
        }
    }

    /// A constant as AsmetaL writes it.
    pub fn show(&self, value: Value) -> String {
        match value {
            Value::Boolean(truth) => truth.to_string(),
            Value::Integer(number) => number.to_string(),
            Value::Real(number) => format!("{number:?}"),
            Value::Element(carrier, index) => {
                let carrier = &self.carriers[carrier];
                match carrier.elements.get(index) {
                    Some(name) => name.clone(),
                    None => format!("{}!{}", carrier.name, index - carrier.elements.len() + 1),
                }
            }
        }
    }

    /// A location and its value: `f(a) = v`, `isUndef(f)`.
    pub fn show_location(&self, id: SymbolId, arguments: &[Value], value: Value) -> String {
        let symbol = self.symbol(id);
        let arguments: Vec<String> = arguments.iter().map(|value| self.show(*value)).collect();
        let location = if arguments.is_empty() {
            symbol.name.clone()
        } else {
            format!("{}({})", symbol.name, arguments.join(", "))
        };
        match (symbol.definedness, value) {
            (true, Value::Boolean(true)) => format!("isDef({location})"),
            (true, _) => format!("isUndef({location})"),
            (false, Value::Boolean(true)) => location,
            (false, Value::Boolean(false)) => format!("not {location}"),
            (false, value) => format!("{location} = {}", self.show(value)),
        }
    }
}
