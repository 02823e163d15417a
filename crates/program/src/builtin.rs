//! Library functions as operations of the machine.
//!
//! Named after spec/standard-library.md. A builtin is chosen by the function's name and the *kinds* of its
//! parameter domains; values then select nothing more, but polymorphic ones work on any value. What each one
//! computes is the machine's.

/// An operation of the library.
#[allow(missing_docs, reason = "each is described in spec/standard-library.md under its AsmetaL name")]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Builtin {
    // Any value
    Eq,
    Neq,
    IsDef,
    IsUndef,
    ToString,
    Print,
    // Boolean; and, or, not are Kleene's, implies(false, undef) is true
    And,
    Or,
    Xor,
    Not,
    Implies,
    Iff,
    // Order on Integer, Natural, Real, Char (the operands have the same form)
    Lt,
    Le,
    Gt,
    Ge,
    // Integer and Natural
    IntNeg,
    IntAdd,
    IntSub,
    IntMul,
    IntDiv,
    IntMod,
    IntMin,
    IntMax,
    IntAbs,
    IntQuotient,
    // IntDiv is the real quotient `div`, IntQuotient is `idiv`; NatSub gives an Integer and needs no operation of its own
    IntPower,
    // Real
    RealNeg,
    RealAdd,
    RealSub,
    RealMul,
    RealDiv,
    RealMin,
    RealMax,
    RealAbs,
    RealPower,
    Floor,
    Round,
    Sqrt,
    // Complex
    Re,
    Im,
    ComplexNeg,
    ComplexAdd,
    ComplexSub,
    ComplexMul,
    ComplexDiv,
    Norm,
    IsZero,
    // Conversions
    RealToInt,
    RealToNat,
    IntToReal,
    IntToNat,
    NatToReal,
    NatToInt,
    // Strings
    StringSize,
    StringConcat,
    ToUpper,
    ToLower,
    SubString,
    StringContains,
    ToInteger,
    ToReal,
    ToChar,
    ToNatural,
    ToComplex,
    Split,
    // Sets
    SetSize,
    SetIsEmpty,
    SetNotEmpty,
    SetSum,
    SetContains,
    SetNotIn,
    AllIn,
    NotAllIn,
    SetUnion,
    SetIntersection,
    SetDifference,
    SymmetricDifference,
    SetIncluding,
    SetExcluding,
    AsSequence,
    AsBag,
    AsSet,
    ChooseOne,
    // Sequences
    SeqCount,
    SeqLength,
    SeqIsEmpty,
    SeqContains,
    SeqConcat,
    Append,
    Prepend,
    InsertAt,
    ReplaceAt,
    SubSequence,
    SeqAt,
    SeqIndexOf,
    First,
    Last,
    Tail,
    SeqExcluding,
    SeqSum,
    // Bags
    BagUnion,
    BagContains,
    BagIntersection,
    BagIncluding,
    BagExcluding,
    BagCount,
    BagSum,
    BagSize,
    // A set and a bag
    SetBagUnion,
    SetBagIntersection,
    BagSetUnion,
    BagSetIntersection,
    // Maps
    MapAt,
    MapAssign,
    MapMerge,
    MapSize,
    MapKeys,
    MapValues,
    // Products: `first` … `ninth`, `at`, `indexOf`
    Component(u8),
    TupleAt,
    TupleIndexOf,
    // Agents
    AgentId,
    GetAgent,
    Program,
    // `range(low, high)` on Natural
    NaturalRange,
    // The value of a location in the state before the step
    Pre,
    // The clock, given by the environment
    TimeNanoseconds,
    TimeMilliseconds,
    TimeSeconds,
    // A temporal operator of the CTL or LTL library: has no value in a state
    Temporal(TemporalOperator),
}

impl Builtin {
    /// How many arguments it takes; none for `print`, which takes any number.
    pub fn arity(self) -> Option<usize> {
        use Builtin::*;
        Some(match self {
            Print => return None,
            TimeNanoseconds | TimeMilliseconds | TimeSeconds => 0,
            IsDef | IsUndef | ToString | Not | IntNeg | IntAbs | RealNeg | RealAbs | Floor | Round | Sqrt | Re | Im
            | ComplexNeg | Norm | IsZero | RealToInt | RealToNat | IntToReal | IntToNat | NatToReal | NatToInt
            | StringSize | ToUpper | ToLower | ToInteger | ToReal | ToChar | ToNatural | ToComplex | SetSize
            | SetIsEmpty | SetNotEmpty | SetSum | AsSequence | AsBag | AsSet | ChooseOne | SeqLength | SeqIsEmpty
            | First | Last | Tail | SeqSum | BagSum | BagSize | MapSize | MapKeys | MapValues | Component(_)
            | AgentId | GetAgent | Program | Pre => 1,
            Eq | Neq | And | Or | Xor | Implies | Iff | Lt | Le | Gt | Ge | IntAdd | IntSub | IntMul | IntDiv
            | IntMod | IntMin | IntMax | IntQuotient | IntPower | RealAdd | RealSub | RealMul | RealDiv | RealMin
            | RealMax | RealPower | ComplexAdd | ComplexSub | ComplexMul | ComplexDiv | StringConcat
            | StringContains | Split | SetContains | SetNotIn | AllIn | NotAllIn | SetUnion | SetIntersection
            | SetDifference | SymmetricDifference | SetIncluding | SetExcluding | SeqCount | SeqContains
            | SeqConcat | Append | Prepend | SeqAt | SeqIndexOf | SeqExcluding | BagUnion | BagContains
            | BagIntersection | BagIncluding | BagExcluding | BagCount | SetBagUnion | SetBagIntersection
            | BagSetUnion | BagSetIntersection | MapAt | MapMerge | TupleAt | TupleIndexOf | NaturalRange => 2,
            SubString | InsertAt | ReplaceAt | SubSequence | MapAssign => 3,
            Temporal(operator) => operator.arity(),
        })
    }
}

/// An operator of the CTL or LTL library.
#[allow(missing_docs, reason = "each is described in spec/standard-library.md under its AsmetaL name")]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TemporalOperator {
    // CTL: E exists a path, A on all paths; G globally, X next, F finally, U until, W weak until, N after n steps
    Eg,
    Ex,
    Ef,
    Ag,
    Ax,
    Af,
    Eu,
    Au,
    Ew,
    Aw,
    ExN,
    AxN,
    // Patterns of CTL: absence of P globally, before R, after Q, between Q and R, after Q until R
    AbsenceGlobally,
    AbsenceBefore,
    AbsenceAfter,
    AbsenceBetween,
    AbsenceAfterUntil,
    // Patterns of CTL: S precedes P globally, before R; arguments (P, S) and (P, S, R)
    Precedence,
    PrecedenceBefore,
    // LTL, future: x g f u v
    Next,
    Globally,
    Finally,
    Until,
    Releases,
    // LTL, past: y z h o s t
    Previous,
    WeakPrevious,
    Historically,
    Once,
    Since,
    Triggered,
}

impl TemporalOperator {
    /// How many arguments it takes.
    pub fn arity(self) -> usize {
        use TemporalOperator::*;
        match self {
            Eg | Ex | Ef | Ag | Ax | Af | AbsenceGlobally | Next | Globally | Finally | Previous | WeakPrevious
            | Historically | Once => 1,
            Eu | Au | Ew | Aw | ExN | AxN | AbsenceBefore | AbsenceAfter | Precedence | Until | Releases | Since
            | Triggered => 2,
            AbsenceBetween | AbsenceAfterUntil | PrecedenceBefore => 3,
        }
    }

    /// An operator of the CTL library; the others are of LTL.
    pub fn is_ctl(self) -> bool {
        use TemporalOperator::*;
        !matches!(
            self,
            Next | Globally
                | Finally
                | Until
                | Releases
                | Previous
                | WeakPrevious
                | Historically
                | Once
                | Since
                | Triggered
        )
    }
}
