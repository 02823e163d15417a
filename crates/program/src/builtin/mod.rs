//! Library functions as operations of the machine, and what is known of each.
//!
//! Named after spec/standard-library.md. The function's name and the *kinds* of its parameter domains select a builtin;
//! values then select nothing more. Polymorphic builtins work on any value. [`table`] holds one row for each: its
//! names, its operands, what its value depends on, what it shows, what it costs, its C++ twin. INVARIANT: code that
//! needs such an answer asks the builtin's row, and keeps no list of builtins of its own; a row without an answer does
//! not compile. What a builtin computes is the machine's.

mod table;
mod temporal;

pub use table::Builtin;
pub use temporal::TemporalOperator;

/// The names of a product's components, `first` to `ninth`.
pub(crate) const COMPONENTS: [&str; 9] =
    ["first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth"];

/// What is known of a builtin, whatever its operands' values.
#[derive(Debug)]
pub struct BuiltinInfo {
    /// What messages call it.
    pub name: &'static str,
    /// The names under which the library declares it; none if the name alone does not select the builtin.
    pub declared: &'static [&'static str],
    /// The operands it is declared with.
    pub operands: Operands,
    /// What its value depends on besides its operands.
    pub effect: Effect,
    /// Whether its result shows an order of elements.
    pub shows_order: ShowsOrder,
    /// Which operands it looks through.
    pub looks_through: LooksThrough,
    /// Its function in C++ where all operands are scalars.
    pub cpp: Cpp,
}

/// The kind of a parameter domain, as far as it selects a builtin.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Complex.
    Complex,
    /// Real.
    Real,
    /// Integer or Natural.
    Int,
    /// Char.
    Char,
    /// String.
    Text,
    /// Boolean.
    Boolean,
    /// A product.
    Prod,
    /// Sequences.
    Seq,
    /// Sets.
    Set,
    /// Bags.
    Bag,
    /// Maps.
    Map,
    /// A domain variable, or a domain that selects nothing. In a row: any parameter.
    Any,
}

/// The operands that a builtin is declared with.
#[derive(Debug, Clone, Copy)]
pub enum Operands {
    /// This many, of any kind.
    Values(usize),
    /// One or more, of any kind.
    OneOrMore,
    /// Two of any kind, to compare; numbers are coerced to the wider form.
    Alike,
    /// Two Char, or two numbers of which none is Complex; numbers are coerced to the wider form.
    Ordered,
    /// This many Integer or Natural.
    Integers(usize),
    /// This many numbers, the widest of them Real. All are coerced to Real.
    Reals(usize),
    /// This many numbers, the widest of them Complex. All are coerced to Complex.
    Complexes(usize),
    /// Of these kinds, in this order.
    Of(&'static [Kind]),
    /// Of the kinds of one of these lists, which are equally long.
    OneOf(&'static [&'static [Kind]]),
    /// As its parameter says: a component's is a product, a temporal operator's are formulas.
    Own,
}

/// What a builtin's value depends on besides its operands' values. This decides whether it can be kept, shared or put
/// off.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Effect {
    /// Nothing.
    Pure,
    /// The state: which rule an agent runs.
    ReadsAgents,
    /// The state before the step, in which its operand is evaluated.
    ReadsBefore,
    /// A choice of the environment.
    Chooses,
    /// The environment's clock.
    ReadsClock,
    /// Runs: it has no value in a state.
    SpeaksOfRuns,
}

/// Whether the result of a builtin tells elements of a domain apart by the order in which they are declared, made or kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ShowsOrder {
    /// It means the same for all elements.
    No,
    /// It shows which of its operands' elements is which.
    OfOperands,
    /// It picks a certain element of its own domain.
    OfResult,
}

/// What a builtin goes through without building anything of that size. This work must be counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LooksThrough {
    /// Nothing that may be large.
    Nothing,
    /// Its first operand.
    First,
    /// Both operands, as far as the smaller one goes.
    Both,
}

/// The function of `cpp/include/groundstate/machine/numbers.hpp` that a builtin is on scalars.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cpp {
    /// None: an operator is written, or it works on dynamic values alone.
    Other,
    /// One that gives an Integer.
    Integer(&'static str),
    /// One that gives a Real.
    Real(&'static str),
}

impl Builtin {
    /// How many arguments it takes; none for `print`, which takes any number.
    pub fn arity(self) -> Option<usize> {
        match (self, self.info().operands) {
            (Builtin::Temporal(operator), _) => Some(operator.arity()),
            (_, Operands::OneOrMore) => None,
            (_, Operands::Values(count) | Operands::Integers(count)) => Some(count),
            (_, Operands::Reals(count) | Operands::Complexes(count)) => Some(count),
            (_, Operands::Alike | Operands::Ordered) => Some(2),
            (_, Operands::Of(kinds)) => Some(kinds.len()),
            (_, Operands::OneOf(lists)) => lists.first().map(|kinds| kinds.len()),
            (_, Operands::Own) => Some(1),
        }
    }

    /// What messages call it.
    pub fn name(self) -> &'static str {
        match self {
            Builtin::Component(index) => COMPONENTS.get(usize::from(index)).copied().unwrap_or(self.info().name),
            _ => self.info().name,
        }
    }
}

impl Operands {
    /// Whether a function with parameters of these kinds has these operands.
    pub(crate) fn accept(self, kinds: &[Kind]) -> bool {
        let numbers = |widest: Kind, count: usize| {
            let wide = [Kind::Int, Kind::Real, Kind::Complex];
            let place = |kind: &Kind| wide.iter().position(|number| number == kind);
            let widest_given =
                kinds.iter().map(place).collect::<Option<Vec<_>>>().and_then(|all| all.into_iter().max());
            kinds.len() == count && widest_given == place(&widest)
        };
        let fits = |list: &[Kind]| {
            let each = |(wanted, given): (&Kind, &Kind)| *wanted == Kind::Any || wanted == given;
            list.len() == kinds.len() && list.iter().zip(kinds).all(each)
        };
        match self {
            Operands::Values(count) => kinds.len() == count,
            Operands::OneOrMore => !kinds.is_empty(),
            Operands::Alike => kinds.len() == 2,
            Operands::Ordered => kinds == [Kind::Char; 2] || numbers(Kind::Int, 2) || numbers(Kind::Real, 2),
            Operands::Integers(count) => numbers(Kind::Int, count),
            Operands::Reals(count) => numbers(Kind::Real, count),
            Operands::Complexes(count) => numbers(Kind::Complex, count),
            Operands::Of(list) => fits(list),
            Operands::OneOf(lists) => lists.iter().any(|list| fits(list)),
            Operands::Own => false,
        }
    }
}

impl Effect {
    /// The value depends on the operands' values alone.
    pub fn is_none(self) -> bool {
        match self {
            Effect::Pure => true,
            Effect::ReadsAgents | Effect::ReadsBefore | Effect::Chooses | Effect::ReadsClock | Effect::SpeaksOfRuns => {
                false
            }
        }
    }
}
