//! Which operation of the machine a library function is.
//!
//! In: a library function without definition. Out: its meaning, by its name and the kinds of its parameter domains
//! (spec/standard-library.md). A domain variable of a polymorphic function is of kind `Any`; a declared product of
//! parameters was taken apart by the checker.

use model::{Basic, DomainId, DomainKind, Function, Model};

use crate::builtin::{Builtin, TemporalOperator as T};
use crate::lower::functions::Meaning;

/// The kind of a parameter domain, as far as it selects an operation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Complex,
    Real,
    /// Integer or Natural.
    Int,
    Char,
    String,
    Boolean,
    Prod,
    Seq,
    Set,
    Bag,
    Map,
    /// A domain variable, or a domain that selects nothing.
    Any,
}

/// The meaning of a library function; none where the machine knows no such operation.
pub(super) fn resolve(model: &Model, function: &Function) -> Option<Meaning> {
    let kinds: Vec<Kind> = function.parameters.iter().map(|domain| kind(model, *domain)).collect();
    let name = function.name.as_str();
    if let Some(component) = component(name) {
        return Some(match kinds[..] {
            [Kind::Seq] => Meaning::Builtin(Builtin::First),
            [Kind::Prod] => Meaning::Builtin(Builtin::Component(component)),
            _ => Meaning::Argument(usize::from(component)),
        })
        .filter(|meaning| !matches!(meaning, Meaning::Argument(index) if *index >= kinds.len()));
    }
    if name == "plus" && matches!(kinds[..], [Kind::Int | Kind::Real | Kind::Complex]) {
        return Some(Meaning::Argument(0));
    }
    let found = any(name, kinds.len())
        .or_else(|| number(name, &kinds))
        .or_else(|| text(name, &kinds))
        .or_else(|| collection(name, &kinds))
        .or_else(|| temporal(name, &kinds).map(Builtin::Temporal))?;
    Some(Meaning::Builtin(found))
}

fn kind(model: &Model, domain: DomainId) -> Kind {
    match model.domains.kind(model.domains.type_domain(domain)) {
        DomainKind::Basic(Basic::Complex) => Kind::Complex,
        DomainKind::Basic(Basic::Real) => Kind::Real,
        DomainKind::Basic(Basic::Integer | Basic::Natural) => Kind::Int,
        DomainKind::Basic(Basic::Char) => Kind::Char,
        DomainKind::Basic(Basic::String) => Kind::String,
        DomainKind::Basic(Basic::Boolean) => Kind::Boolean,
        DomainKind::Prod(_) => Kind::Prod,
        DomainKind::Seq(_) => Kind::Seq,
        DomainKind::Powerset(_) => Kind::Set,
        DomainKind::Bag(_) => Kind::Bag,
        DomainKind::Map(..) => Kind::Map,
        DomainKind::Basic(Basic::Undef)
        | DomainKind::Any
        | DomainKind::Enum { .. }
        | DomainKind::Abstract { .. }
        | DomainKind::Concrete { .. }
        | DomainKind::Rule(_)
        | DomainKind::Error => Kind::Any,
    }
}

/// `first` is component 0.
fn component(name: &str) -> Option<u8> {
    const NAMES: [&str; 9] = ["first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth"];
    NAMES.iter().position(|known| *known == name).map(|index| index as u8)
}

/// Operations on values of any domain, and those whose name says it all.
fn any(name: &str, arity: usize) -> Option<Builtin> {
    Some(match (name, arity) {
        ("print", 1..) => Builtin::Print,
        ("eq" | "equality", 2) => Builtin::Eq,
        ("neq", 2) => Builtin::Neq,
        ("isDef", 1) => Builtin::IsDef,
        ("isUndef", 1) => Builtin::IsUndef,
        ("toString", 1) => Builtin::ToString,
        ("and", 2) => Builtin::And,
        ("or", 2) => Builtin::Or,
        ("xor", 2) => Builtin::Xor,
        ("not", 1) => Builtin::Not,
        ("implies", 2) => Builtin::Implies,
        ("iff", 2) => Builtin::Iff,
        ("id", 1) => Builtin::AgentId,
        ("getAgent", 1) => Builtin::GetAgent,
        ("program", 1) => Builtin::Program,
        ("pre", 1) => Builtin::Pre,
        ("range", 2) => Builtin::NaturalRange,
        ("currTimeNanosecs", 0) => Builtin::TimeNanoseconds,
        ("currTimeMillisecs", 0) => Builtin::TimeMilliseconds,
        ("currTimeSecs", 0) => Builtin::TimeSeconds,
        _ => return None,
    })
}

/// Arithmetic, order, conversions. Mixed parameters take the widest form; the arguments are then coerced.
fn number(name: &str, kinds: &[Kind]) -> Option<Builtin> {
    let operands = |kind: Kind| kinds.iter().all(|operand| *operand == kind);
    let ordered = kinds.len() == 2
        && (operands(Kind::Char) || kinds.iter().all(|operand| matches!(operand, Kind::Int | Kind::Real)));
    match (name, ordered) {
        ("lt", true) => return Some(Builtin::Lt),
        ("le", true) => return Some(Builtin::Le),
        ("gt", true) => return Some(Builtin::Gt),
        ("ge", true) => return Some(Builtin::Ge),
        _ => {}
    }
    if !kinds.iter().all(|operand| matches!(operand, Kind::Int | Kind::Real | Kind::Complex)) {
        return None;
    }
    if operands(Kind::Int) {
        integer(name, kinds.len())
    } else if !kinds.contains(&Kind::Complex) {
        real(name, kinds.len())
    } else {
        complex(name, kinds.len())
    }
}

fn integer(name: &str, arity: usize) -> Option<Builtin> {
    Some(match (name, arity) {
        ("minus", 1) => Builtin::IntNeg,
        ("plus", 2) => Builtin::IntAdd,
        ("minus", 2) => Builtin::IntSub,
        ("mult", 2) => Builtin::IntMul,
        ("div", 2) => Builtin::IntDiv,
        ("idiv", 2) => Builtin::IntQuotient,
        ("mod", 2) => Builtin::IntMod,
        ("pwr", 2) => Builtin::IntPower,
        ("min", 2) => Builtin::IntMin,
        ("max", 2) => Builtin::IntMax,
        ("abs", 1) => Builtin::IntAbs,
        ("itor", 1) => Builtin::IntToReal,
        ("iton", 1) => Builtin::IntToNat,
        ("ntor", 1) => Builtin::NatToReal,
        ("ntoi", 1) => Builtin::NatToInt,
        _ => return None,
    })
}

fn real(name: &str, arity: usize) -> Option<Builtin> {
    Some(match (name, arity) {
        ("minus", 1) => Builtin::RealNeg,
        ("plus", 2) => Builtin::RealAdd,
        ("minus", 2) => Builtin::RealSub,
        ("mult", 2) => Builtin::RealMul,
        ("div", 2) => Builtin::RealDiv,
        ("pwr", 2) => Builtin::RealPower,
        ("min", 2) => Builtin::RealMin,
        ("max", 2) => Builtin::RealMax,
        ("abs", 1) => Builtin::RealAbs,
        ("floor", 1) => Builtin::Floor,
        ("round", 1) => Builtin::Round,
        ("sqrt", 1) => Builtin::Sqrt,
        ("rtoi", 1) => Builtin::RealToInt,
        ("rton", 1) => Builtin::RealToNat,
        _ => return None,
    })
}

fn complex(name: &str, arity: usize) -> Option<Builtin> {
    Some(match (name, arity) {
        ("re", 1) => Builtin::Re,
        ("im", 1) => Builtin::Im,
        ("minus", 1) => Builtin::ComplexNeg,
        ("plus", 2) => Builtin::ComplexAdd,
        ("minus", 2) => Builtin::ComplexSub,
        ("mult", 2) => Builtin::ComplexMul,
        ("div", 2) => Builtin::ComplexDiv,
        ("norm", 1) => Builtin::Norm,
        ("iszero", 1) => Builtin::IsZero,
        _ => return None,
    })
}

fn text(name: &str, kinds: &[Kind]) -> Option<Builtin> {
    if kinds.first() != Some(&Kind::String) {
        return None;
    }
    Some(match (name, kinds.len()) {
        ("size" | "length", 1) => Builtin::StringSize,
        ("plus" | "concat", 2) => Builtin::StringConcat,
        ("toUpper", 1) => Builtin::ToUpper,
        ("toLower", 1) => Builtin::ToLower,
        ("subString", 3) => Builtin::SubString,
        ("contains", 2) => Builtin::StringContains,
        ("toInteger", 1) => Builtin::ToInteger,
        ("toNatural", 1) => Builtin::ToNatural,
        ("toReal", 1) => Builtin::ToReal,
        ("toComplex", 1) => Builtin::ToComplex,
        ("toChar", 1) => Builtin::ToChar,
        ("split", 2) => Builtin::Split,
        _ => return None,
    })
}

/// Sets, sequences, bags, maps and products.
fn collection(name: &str, kinds: &[Kind]) -> Option<Builtin> {
    use Kind::{Bag, Map, Prod, Seq, Set};
    Some(match (name, kinds) {
        ("size", [Set]) => Builtin::SetSize,
        ("isEmpty", [Set]) => Builtin::SetIsEmpty,
        ("notEmpty", [Set]) => Builtin::SetNotEmpty,
        ("sum", [Set]) => Builtin::SetSum,
        ("chooseone", [Set]) => Builtin::ChooseOne,
        ("asSequence", [Set | Bag]) => Builtin::AsSequence,
        ("asBag", [Set | Seq]) => Builtin::AsBag,
        ("asSet", [Seq | Bag]) => Builtin::AsSet,
        ("contains", [Set, _]) => Builtin::SetContains,
        ("notin", [Set, _]) => Builtin::SetNotIn,
        ("allin", [Set, Set]) => Builtin::AllIn,
        ("notallin", [Set, Set]) => Builtin::NotAllIn,
        ("union", [Set, Set]) => Builtin::SetUnion,
        ("union", [Set, Bag]) => Builtin::SetBagUnion,
        ("intersection", [Set, Set]) => Builtin::SetIntersection,
        ("intersection", [Set, Bag]) => Builtin::SetBagIntersection,
        ("difference", [Set, Set]) => Builtin::SetDifference,
        ("symmetricDifference", [Set, Set]) => Builtin::SymmetricDifference,
        ("including", [Set, _]) => Builtin::SetIncluding,
        ("excluding", [Set, _]) => Builtin::SetExcluding,
        ("length" | "size", [Seq]) => Builtin::SeqLength,
        ("isEmpty", [Seq]) => Builtin::SeqIsEmpty,
        ("sum", [Seq]) => Builtin::SeqSum,
        ("last", [Seq]) => Builtin::Last,
        ("tail", [Seq]) => Builtin::Tail,
        ("count", [Seq, _]) => Builtin::SeqCount,
        ("contains", [Seq, _]) => Builtin::SeqContains,
        ("union" | "concat", [Seq, Seq]) => Builtin::SeqConcat,
        ("append", [Seq, _]) => Builtin::Append,
        ("prepend", [_, Seq]) => Builtin::Prepend,
        ("insertAt", [Seq, _, _]) => Builtin::InsertAt,
        ("replaceAt", [Seq, _, _]) => Builtin::ReplaceAt,
        ("subSequence", [Seq, _, _]) => Builtin::SubSequence,
        ("at", [Seq, _]) => Builtin::SeqAt,
        ("indexOf", [Seq, _]) => Builtin::SeqIndexOf,
        ("excluding", [Seq, _]) => Builtin::SeqExcluding,
        ("size", [Bag]) => Builtin::BagSize,
        ("sum", [Bag]) => Builtin::BagSum,
        ("union", [Bag, Bag]) => Builtin::BagUnion,
        ("union", [Bag, Set]) => Builtin::BagSetUnion,
        ("intersection", [Bag, Bag]) => Builtin::BagIntersection,
        ("intersection", [Bag, Set]) => Builtin::BagSetIntersection,
        ("contains", [Bag, _]) => Builtin::BagContains,
        ("including", [Bag, _]) => Builtin::BagIncluding,
        ("excluding", [Bag, _]) => Builtin::BagExcluding,
        ("count", [Bag, _]) => Builtin::BagCount,
        ("size", [Map]) => Builtin::MapSize,
        ("keys", [Map]) => Builtin::MapKeys,
        ("values", [Map]) => Builtin::MapValues,
        ("at", [Map, _]) => Builtin::MapAt,
        ("assign", [Map, _, _]) => Builtin::MapAssign,
        ("merge", [Map, Map]) => Builtin::MapMerge,
        ("at", [Prod, _]) => Builtin::TupleAt,
        ("indexOf", [Prod, _]) => Builtin::TupleIndexOf,
        _ => return None,
    })
}

/// The operators of the CTL and LTL libraries. `e` and `a` are older names of `eu` and `au`.
fn temporal(name: &str, kinds: &[Kind]) -> Option<T> {
    if kinds.first() != Some(&Kind::Boolean) {
        return None;
    }
    Some(match (name, kinds.len()) {
        ("eg", 1) => T::Eg,
        ("ex", 1) => T::Ex,
        ("ef", 1) => T::Ef,
        ("ag", 1) => T::Ag,
        ("ax", 1) => T::Ax,
        ("af", 1) => T::Af,
        ("eu" | "e", 2) => T::Eu,
        ("au" | "a", 2) => T::Au,
        ("ew", 2) => T::Ew,
        ("aw", 2) => T::Aw,
        ("exN", 2) => T::ExN,
        ("axN", 2) => T::AxN,
        ("absenceG", 1) => T::AbsenceGlobally,
        ("absenceBefore", 2) => T::AbsenceBefore,
        ("absenceAfter", 2) => T::AbsenceAfter,
        ("absenceBetween", 3) => T::AbsenceBetween,
        ("absenceAfterUntil", 3) => T::AbsenceAfterUntil,
        ("ap", 2) => T::Precedence,
        ("pb", 3) => T::PrecedenceBefore,
        ("x", 1) => T::Next,
        ("g", 1) => T::Globally,
        ("f", 1) => T::Finally,
        ("u", 2) => T::Until,
        ("v", 2) => T::Releases,
        ("y", 1) => T::Previous,
        ("z", 1) => T::WeakPrevious,
        ("h", 1) => T::Historically,
        ("o", 1) => T::Once,
        ("s", 2) => T::Since,
        ("t", 2) => T::Triggered,
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use model::{FunctionKind, Loader};
    use syntax::SourceFile;

    use super::*;

    struct NoFiles;

    impl Loader for NoFiles {
        fn load(&mut self, _importer: &SourceFile, path: &str) -> Result<SourceFile, String> {
            Err(format!("there is no file {path}"))
        }
    }

    #[test]
    fn every_library_function_has_a_meaning() {
        for library in ["StandardLibrary", "CTLLibrary", "LTLLibrary", "TimeLibrary", "TimeLibrarySimple"] {
            let text = format!("asm x\nimport {library}\nsignature:\ndefinitions:\nmain rule r_Main = skip\n");
            let model = model::check(SourceFile::new("x.asm", text), &mut NoFiles).model;
            let fixed = |function: &&Function| function.kind == FunctionKind::Static && function.definition.is_none();
            let mut count = 0;
            for function in model.functions.iter().filter(fixed) {
                let arity = function.parameters.len();
                match resolve(&model, function) {
                    Some(Meaning::Builtin(builtin)) => {
                        assert!(builtin.arity().is_none_or(|takes| takes == arity), "{} as {builtin:?}", function.name);
                    }
                    Some(Meaning::Argument(index)) => assert!(index < arity, "{}", function.name),
                    other => panic!("{}/{arity} of {library} is {other:?}", function.name),
                }
                count += 1;
            }
            assert!(count > 0, "{library} is empty");
        }
    }
}
