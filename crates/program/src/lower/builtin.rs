//! Finds the machine's operation for a library function.
//!
//! In: a library function without definition. Out: its meaning. Its name and the kinds of its parameter domains decide
//! it (spec/standard-library.md). A domain variable of a polymorphic function is of kind `Any`. The checker has already
//! split a declared product into parameters.

use model::{Basic, DomainId, DomainKind, Function, Model};

use crate::builtin::{Builtin, COMPONENTS, Kind, TemporalOperator};
use crate::lower::meaning::Meaning;

/// The meaning of a library function; none if the machine has no such operation.
pub(super) fn resolve(model: &Model, function: &Function) -> Option<Meaning> {
    let kinds: Vec<Kind> = function.parameters.iter().map(|domain| kind(model, *domain)).collect();
    let name = function.name.as_str();
    if let Some(component) = COMPONENTS.iter().position(|known| *known == name) {
        return match kinds[..] {
            [Kind::Seq] => Some(Meaning::Builtin(Builtin::First)),
            [Kind::Prod] => Some(Meaning::Builtin(Builtin::Component(component as u8))),
            _ => (component < kinds.len()).then_some(Meaning::Argument(component)),
        };
    }
    if name == "plus" && matches!(kinds[..], [Kind::Int | Kind::Real | Kind::Complex]) {
        return Some(Meaning::Argument(0));
    }
    builtins(name, &kinds).next().or_else(|| temporal(name, &kinds)).map(Meaning::Builtin)
}

/// The builtins that a function of this name, with parameters of these kinds, may be: at most one (a test keeps it).
fn builtins<'a>(name: &'a str, kinds: &'a [Kind]) -> impl Iterator<Item = Builtin> + 'a {
    Builtin::ALL.iter().copied().filter(move |builtin| {
        let info = builtin.info();
        info.declared.contains(&name) && info.operands.accept(kinds)
    })
}

/// The operators of the CTL and LTL libraries.
fn temporal(name: &str, kinds: &[Kind]) -> Option<Builtin> {
    if kinds.first() != Some(&Kind::Boolean) {
        return None;
    }
    let known = |operator: &&TemporalOperator| operator.declared().contains(&name) && operator.arity() == kinds.len();
    TemporalOperator::ALL.iter().find(known).copied().map(Builtin::Temporal)
}

fn kind(model: &Model, domain: DomainId) -> Kind {
    match model.domains.kind(model.domains.type_domain(domain)) {
        DomainKind::Basic(Basic::Complex) => Kind::Complex,
        DomainKind::Basic(Basic::Real) => Kind::Real,
        DomainKind::Basic(Basic::Integer | Basic::Natural) => Kind::Int,
        DomainKind::Basic(Basic::Char) => Kind::Char,
        DomainKind::Basic(Basic::String) => Kind::Text,
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

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use model::FunctionKind;
    use syntax::SourceFile;
    use testkit::NoFiles;

    use super::*;

    #[test]
    fn a_function_is_one_builtin_at_most() {
        use Kind::*;
        let kinds = [Complex, Real, Int, Char, Text, Boolean, Prod, Seq, Set, Bag, Map, Any];
        let mut lists: Vec<Vec<Kind>> = vec![Vec::new()];
        for length in 1..=3 {
            let shorter: Vec<Vec<Kind>> = lists.iter().filter(|list| list.len() == length - 1).cloned().collect();
            lists.extend(shorter.iter().flat_map(|list| kinds.map(|kind| [&list[..], &[kind]].concat())));
        }
        let names: BTreeSet<&str> = Builtin::ALL.iter().flat_map(|builtin| builtin.info().declared).copied().collect();
        for name in names {
            for kinds in &lists {
                let found: Vec<Builtin> = builtins(name, kinds).collect();
                assert!(found.len() <= 1, "{name}{kinds:?} is {found:?}");
                let formula = temporal(name, kinds);
                assert!(found.is_empty() || formula.is_none(), "{name}{kinds:?} is {found:?} and {formula:?}");
            }
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
