//! The table of builtins: one row for each, in which every column must be filled in.
//!
//! In: nothing. Out: the enumeration [`Builtin`], the row of each ([`Builtin::info`]), and all of them ([`Builtin::ALL`]).
//! The columns are the fields of [`BuiltinInfo`], in their order. INVARIANT: no two rows accept the same function; a test
//! in `lower/builtin.rs` keeps it.

use super::Cpp::{Integer, Other, Real};
use super::Effect::{Chooses, Pure, ReadsAgents, ReadsBefore, ReadsClock, SpeaksOfRuns};
use super::Kind::{Any, Bag, Map, Prod, Seq, Set, Text};
use super::LooksThrough::{Both, First, Nothing};
use super::Operands::{Alike, Complexes, Integers, Of, OneOf, OneOrMore, Ordered, Own, Reals, Values};
use super::ShowsOrder::{No, OfOperands, OfResult};
use super::{BuiltinInfo, TemporalOperator};

/// `Variant: name, declared, operands, effect, shows_order, looks_through, cpp;`. A variant with a parameter gives its
/// type, and the one value that stands for all of them in the list.
macro_rules! builtins {
    ($($variant:ident $(($parameter:ty = $one:expr))?: $name:literal, [$($declared:literal),*], $operands:expr,
        $effect:expr, $shows_order:expr, $looks_through:expr, $cpp:expr;)*) => {
        /// An operation of the library.
        #[allow(missing_docs, reason = "each is described in spec/standard-library.md under its AsmetaL name")]
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum Builtin {
            $($variant $(($parameter))?,)*
        }

        impl Builtin {
            /// Each of them; of those with a parameter, one.
            pub const ALL: &[Builtin] = &[$(Builtin::$variant $(($one))?),*];

            /// What is known of it.
            #[inline]
            pub const fn info(self) -> &'static BuiltinInfo {
                match self {
                    $(Builtin::$variant { .. } => &BuiltinInfo {
                        name: $name,
                        declared: &[$($declared),*],
                        operands: $operands,
                        effect: $effect,
                        shows_order: $shows_order,
                        looks_through: $looks_through,
                        cpp: $cpp,
                    },)*
                }
            }
        }
    };
}

builtins! {
    // Any value
    Eq:       "=",        ["eq", "equality"], Alike,     Pure, No,         Both,    Other;
    Neq:      "!=",       ["neq"],            Alike,     Pure, No,         Both,    Other;
    IsDef:    "isDef",    ["isDef"],          Values(1), Pure, No,         Nothing, Other;
    IsUndef:  "isUndef",  ["isUndef"],        Values(1), Pure, No,         Nothing, Other;
    ToString: "toString", ["toString"],       Values(1), Pure, OfOperands, Nothing, Other;
    Print:    "print",    ["print"],          OneOrMore, Pure, No,         Nothing, Other;
    // Boolean; and, or, not are Kleene's, implies(false, undef) is true
    And:     "and",     ["and"],     Values(2), Pure, No, Nothing, Other;
    Or:      "or",      ["or"],      Values(2), Pure, No, Nothing, Other;
    Xor:     "xor",     ["xor"],     Values(2), Pure, No, Nothing, Other;
    Not:     "not",     ["not"],     Values(1), Pure, No, Nothing, Other;
    Implies: "implies", ["implies"], Values(2), Pure, No, Nothing, Other;
    Iff:     "iff",     ["iff"],     Values(2), Pure, No, Nothing, Other;
    // Order on Integer, Natural, Real, Char (the operands have the same form)
    Lt: "<",  ["lt"], Ordered, Pure, OfOperands, Nothing, Other;
    Le: "<=", ["le"], Ordered, Pure, OfOperands, Nothing, Other;
    Gt: ">",  ["gt"], Ordered, Pure, OfOperands, Nothing, Other;
    Ge: ">=", ["ge"], Ordered, Pure, OfOperands, Nothing, Other;
    // Integer and Natural
    // IntDiv is the real quotient `div`, IntQuotient is `idiv`; the difference of Naturals is an Integer: IntSub
    IntNeg:      "-",    ["minus"], Integers(1), Pure, No, Nothing, Integer("negate");
    IntAdd:      "+",    ["plus"],  Integers(2), Pure, No, Nothing, Integer("add");
    IntSub:      "-",    ["minus"], Integers(2), Pure, No, Nothing, Integer("subtract");
    IntMul:      "*",    ["mult"],  Integers(2), Pure, No, Nothing, Integer("multiply");
    IntDiv:      "/",    ["div"],   Integers(2), Pure, No, Nothing, Real("divide");
    IntMod:      "mod",  ["mod"],   Integers(2), Pure, No, Nothing, Integer("remainder");
    IntMin:      "min",  ["min"],   Integers(2), Pure, No, Nothing, Integer("minimum");
    IntMax:      "max",  ["max"],   Integers(2), Pure, No, Nothing, Integer("maximum");
    IntAbs:      "abs",  ["abs"],   Integers(1), Pure, No, Nothing, Integer("absolute");
    IntQuotient: "idiv", ["idiv"],  Integers(2), Pure, No, Nothing, Integer("quotient");
    IntPower:    "^",    ["pwr"],   Integers(2), Pure, No, Nothing, Integer("power");
    // Real
    RealNeg:   "-",     ["minus"], Reals(1), Pure, No, Nothing, Real("real_negate");
    RealAdd:   "+",     ["plus"],  Reals(2), Pure, No, Nothing, Real("real_add");
    RealSub:   "-",     ["minus"], Reals(2), Pure, No, Nothing, Real("real_subtract");
    RealMul:   "*",     ["mult"],  Reals(2), Pure, No, Nothing, Real("real_multiply");
    RealDiv:   "/",     ["div"],   Reals(2), Pure, No, Nothing, Real("real_divide");
    RealMin:   "min",   ["min"],   Reals(2), Pure, No, Nothing, Real("real_minimum");
    RealMax:   "max",   ["max"],   Reals(2), Pure, No, Nothing, Real("real_maximum");
    RealAbs:   "abs",   ["abs"],   Reals(1), Pure, No, Nothing, Real("real_absolute");
    RealPower: "^",     ["pwr"],   Reals(2), Pure, No, Nothing, Real("real_power");
    Floor:     "floor", ["floor"], Reals(1), Pure, No, Nothing, Integer("floor");
    Round:     "round", ["round"], Reals(1), Pure, No, Nothing, Integer("round");
    Sqrt:      "sqrt",  ["sqrt"],  Reals(1), Pure, No, Nothing, Real("square_root");
    // Complex
    Re:         "re",     ["re"],     Complexes(1), Pure, No, Nothing, Other;
    Im:         "im",     ["im"],     Complexes(1), Pure, No, Nothing, Other;
    ComplexNeg: "-",      ["minus"],  Complexes(1), Pure, No, Nothing, Other;
    ComplexAdd: "+",      ["plus"],   Complexes(2), Pure, No, Nothing, Other;
    ComplexSub: "-",      ["minus"],  Complexes(2), Pure, No, Nothing, Other;
    ComplexMul: "*",      ["mult"],   Complexes(2), Pure, No, Nothing, Other;
    ComplexDiv: "/",      ["div"],    Complexes(2), Pure, No, Nothing, Other;
    Norm:       "norm",   ["norm"],   Complexes(1), Pure, No, Nothing, Other;
    IsZero:     "iszero", ["iszero"], Complexes(1), Pure, No, Nothing, Other;
    // Conversions
    RealToInt: "rtoi", ["rtoi"], Reals(1),    Pure, No, Nothing, Integer("truncate");
    RealToNat: "rton", ["rton"], Reals(1),    Pure, No, Nothing, Integer("truncate_natural");
    IntToReal: "itor", ["itor"], Integers(1), Pure, No, Nothing, Other;
    IntToNat:  "iton", ["iton"], Integers(1), Pure, No, Nothing, Integer("natural");
    NatToReal: "ntor", ["ntor"], Integers(1), Pure, No, Nothing, Other;
    NatToInt:  "ntoi", ["ntoi"], Integers(1), Pure, No, Nothing, Other;
    // Strings
    StringSize:     "size",      ["size", "length"], Of(&[Text]),           Pure, No, First,   Other;
    StringConcat:   "+",         ["plus", "concat"], Of(&[Text, Any]),      Pure, No, Nothing, Other;
    ToUpper:        "toUpper",   ["toUpper"],        Of(&[Text]),           Pure, No, Nothing, Other;
    ToLower:        "toLower",   ["toLower"],        Of(&[Text]),           Pure, No, Nothing, Other;
    SubString:      "subString", ["subString"],      Of(&[Text, Any, Any]), Pure, No, Nothing, Other;
    StringContains: "contains",  ["contains"],       Of(&[Text, Any]),      Pure, No, First,   Other;
    ToInteger:      "toInteger", ["toInteger"],      Of(&[Text]),           Pure, No, Nothing, Other;
    ToReal:         "toReal",    ["toReal"],         Of(&[Text]),           Pure, No, Nothing, Other;
    ToChar:         "toChar",    ["toChar"],         Of(&[Text]),           Pure, No, Nothing, Other;
    ToNatural:      "toNatural", ["toNatural"],      Of(&[Text]),           Pure, No, Nothing, Other;
    ToComplex:      "toComplex", ["toComplex"],      Of(&[Text]),           Pure, No, Nothing, Other;
    Split:          "split",     ["split"],          Of(&[Text, Any]),      Pure, No, Nothing, Other;
    // Sets
    SetSize:             "size",                ["size"],                Of(&[Set]),      Pure, No, Nothing, Other;
    SetIsEmpty:          "isEmpty",             ["isEmpty"],             Of(&[Set]),      Pure, No, Nothing, Other;
    SetNotEmpty:         "notEmpty",            ["notEmpty"],            Of(&[Set]),      Pure, No, Nothing, Other;
    SetSum:              "sum",                 ["sum"],                 Of(&[Set]),      Pure, No, First,   Other;
    SetContains:         "contains",            ["contains"],            Of(&[Set, Any]), Pure, No, Nothing, Other;
    SetNotIn:            "notin",               ["notin"],               Of(&[Set, Any]), Pure, No, Nothing, Other;
    AllIn:               "allin",               ["allin"],               Of(&[Set, Set]), Pure, No, First,   Other;
    NotAllIn:            "notallin",            ["notallin"],            Of(&[Set, Set]), Pure, No, First,   Other;
    SetUnion:            "union",               ["union"],               Of(&[Set, Set]), Pure, No, Nothing, Other;
    SetIntersection:     "intersection",        ["intersection"],        Of(&[Set, Set]), Pure, No, Nothing, Other;
    SetDifference:       "difference",          ["difference"],          Of(&[Set, Set]), Pure, No, Nothing, Other;
    SymmetricDifference: "symmetricDifference", ["symmetricDifference"], Of(&[Set, Set]), Pure, No, Nothing, Other;
    SetIncluding:        "including",           ["including"],           Of(&[Set, Any]), Pure, No, Nothing, Other;
    SetExcluding:        "excluding",           ["excluding"],           Of(&[Set, Any]), Pure, No, Nothing, Other;
    // An element of a set; collections as others
    ChooseOne:  "chooseone",  ["chooseone"],  Of(&[Set]),               Chooses, No,         Nothing, Other;
    AsSequence: "asSequence", ["asSequence"], OneOf(&[&[Set], &[Bag]]), Pure,    OfOperands, Nothing, Other;
    AsBag:      "asBag",      ["asBag"],      OneOf(&[&[Set], &[Seq]]), Pure,    No,         Nothing, Other;
    AsSet:      "asSet",      ["asSet"],      OneOf(&[&[Seq], &[Bag]]), Pure,    No,         Nothing, Other;
    // Sequences
    SeqCount:     "count",       ["count"],           Of(&[Seq, Any]),      Pure, No, First,   Other;
    SeqLength:    "length",      ["length", "size"],  Of(&[Seq]),           Pure, No, Nothing, Other;
    SeqIsEmpty:   "isEmpty",     ["isEmpty"],         Of(&[Seq]),           Pure, No, Nothing, Other;
    SeqContains:  "contains",    ["contains"],        Of(&[Seq, Any]),      Pure, No, First,   Other;
    SeqConcat:    "union",       ["union", "concat"], Of(&[Seq, Seq]),      Pure, No, Nothing, Other;
    Append:       "append",      ["append"],          Of(&[Seq, Any]),      Pure, No, Nothing, Other;
    Prepend:      "prepend",     ["prepend"],         Of(&[Any, Seq]),      Pure, No, Nothing, Other;
    InsertAt:     "insertAt",    ["insertAt"],        Of(&[Seq, Any, Any]), Pure, No, Nothing, Other;
    ReplaceAt:    "replaceAt",   ["replaceAt"],       Of(&[Seq, Any, Any]), Pure, No, Nothing, Other;
    SubSequence:  "subSequence", ["subSequence"],     Of(&[Seq, Any, Any]), Pure, No, Nothing, Other;
    SeqAt:        "at",          ["at"],              Of(&[Seq, Any]),      Pure, No, Nothing, Other;
    SeqIndexOf:   "indexOf",     ["indexOf"],         Of(&[Seq, Any]),      Pure, No, First,   Other;
    First:        "first",       [],                  Of(&[Seq]),           Pure, No, Nothing, Other;
    Last:         "last",        ["last"],            Of(&[Seq]),           Pure, No, Nothing, Other;
    Tail:         "tail",        ["tail"],            Of(&[Seq]),           Pure, No, Nothing, Other;
    SeqExcluding: "excluding",   ["excluding"],       Of(&[Seq, Any]),      Pure, No, Nothing, Other;
    SeqSum:       "sum",         ["sum"],             Of(&[Seq]),           Pure, No, First,   Other;
    // Bags
    BagUnion:        "union",        ["union"],        Of(&[Bag, Bag]), Pure, No, Nothing, Other;
    BagContains:     "contains",     ["contains"],     Of(&[Bag, Any]), Pure, No, First,   Other;
    BagIntersection: "intersection", ["intersection"], Of(&[Bag, Bag]), Pure, No, Nothing, Other;
    BagIncluding:    "including",    ["including"],    Of(&[Bag, Any]), Pure, No, Nothing, Other;
    BagExcluding:    "excluding",    ["excluding"],    Of(&[Bag, Any]), Pure, No, Nothing, Other;
    BagCount:        "count",        ["count"],        Of(&[Bag, Any]), Pure, No, First,   Other;
    BagSum:          "sum",          ["sum"],          Of(&[Bag]),      Pure, No, First,   Other;
    BagSize:         "size",         ["size"],         Of(&[Bag]),      Pure, No, First,   Other;
    // A set and a bag
    SetBagUnion:        "union",        ["union"],        Of(&[Set, Bag]), Pure, No, Nothing, Other;
    SetBagIntersection: "intersection", ["intersection"], Of(&[Set, Bag]), Pure, No, Nothing, Other;
    BagSetUnion:        "union",        ["union"],        Of(&[Bag, Set]), Pure, No, Nothing, Other;
    BagSetIntersection: "intersection", ["intersection"], Of(&[Bag, Set]), Pure, No, Nothing, Other;
    // Maps
    MapAt:     "at",     ["at"],     Of(&[Map, Any]),      Pure, No, Nothing, Other;
    MapAssign: "assign", ["assign"], Of(&[Map, Any, Any]), Pure, No, Nothing, Other;
    MapMerge:  "merge",  ["merge"],  Of(&[Map, Map]),      Pure, No, Nothing, Other;
    MapSize:   "size",   ["size"],   Of(&[Map]),           Pure, No, Nothing, Other;
    MapKeys:   "keys",   ["keys"],   Of(&[Map]),           Pure, No, Nothing, Other;
    MapValues: "values", ["values"], Of(&[Map]),           Pure, No, Nothing, Other;
    // Products: `first` … `ninth`, `at`, `indexOf`
    Component(u8 = 0): "component", [],          Own,              Pure, No, Nothing, Other;
    TupleAt:           "at",        ["at"],      Of(&[Prod, Any]), Pure, No, Nothing, Other;
    TupleIndexOf:      "indexOf",   ["indexOf"], Of(&[Prod, Any]), Pure, No, First,   Other;
    // Agents
    AgentId:  "id",       ["id"],       Values(1), Pure,        OfOperands, Nothing, Other;
    GetAgent: "getAgent", ["getAgent"], Values(1), Pure,        OfResult,   Nothing, Other;
    Program:  "program",  ["program"],  Values(1), ReadsAgents, No,         Nothing, Other;
    // `range(low, high)` on Natural
    NaturalRange: "range", ["range"], Values(2), Pure, No, Nothing, Other;
    // The value of a location in the state before the step
    Pre: "pre", ["pre"], Values(1), ReadsBefore, No, Nothing, Other;
    // The clock, given by the environment
    TimeNanoseconds:  "currTimeNanosecs",  ["currTimeNanosecs"],  Values(0), ReadsClock, No, Nothing, Other;
    TimeMilliseconds: "currTimeMillisecs", ["currTimeMillisecs"], Values(0), ReadsClock, No, Nothing, Other;
    TimeSeconds:      "currTimeSecs",      ["currTimeSecs"],      Values(0), ReadsClock, No, Nothing, Other;
    // A temporal operator of the CTL or LTL library: has no value in a state
    Temporal(TemporalOperator = TemporalOperator::Eg): "a temporal operator", [], Own, SpeaksOfRuns, No, Nothing, Other;
}
