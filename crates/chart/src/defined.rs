//! Decides whether a control location always has a value: it starts with a literal, and nothing sets it to undef. Then
//! a chart need not say what happens when it is undef.
//!
//! In: a checked model and a function. Out: yes only if that is certain; whatever is not analysed counts as undef.

use model::{Call, DomainKind, FunctionId, FunctionKind, Literal, Model, RuleId, RuleKind, Target, Term, TermKind};

/// LIMIT: how many calls are followed to find the arguments of a parameter.
const MAX_DEPTH: usize = 8;

/// Whether the locations of a function have a value in every state of the model's runs.
pub(crate) fn always_defined(model: &Model, function: FunctionId) -> bool {
    let declared = model.function(function);
    declared.kind == FunctionKind::Controlled
        && declared.parameters.iter().all(|domain| is_fixed(model, *domain))
        && begins_defined(model, function)
        && (0..model.rules.len()).all(|rule| keeps_defined(model, function, rule))
}

/// Whether the elements that exist at the start are all that ever exist.
fn is_fixed(model: &Model, domain: model::DomainId) -> bool {
    match model.domains.kind(domain) {
        DomainKind::Enum { .. } => true,
        DomainKind::Abstract { dynamic } | DomainKind::Concrete { dynamic, .. } => !dynamic,
        _ => false,
    }
}

fn begins_defined(model: &Model, function: FunctionId) -> bool {
    let Some(init) = model.default_init.map(|index| &model.inits[index]) else { return false };
    let given = init.functions.iter().find(|given| given.function == function);
    given.is_some_and(|given| matches!(given.definition.body.kind, TermKind::Literal(Literal::Enum(..))))
}

/// Whether a rule sets no location of a function to undef.
fn keeps_defined(model: &Model, function: FunctionId, rule: usize) -> bool {
    let mut keeps = true;
    // A parameter may stand for any location.
    let is_meant = |target: &Target| match target {
        Target::Location { function: updated, .. } => *updated == function,
        Target::Parameter(..) => true,
    };
    model.rules[rule].body.walk(&mut |node| match &node.kind {
        RuleKind::Update { target, value } if is_meant(target) => keeps &= is_defined(model, value, rule, 0),
        RuleKind::Return { target, .. } if is_meant(target) => keeps = false,
        _ => {}
    });
    keeps
}

fn is_defined(model: &Model, term: &Term, rule: usize, depth: usize) -> bool {
    let inner = |term: &Term| is_defined(model, term, rule, depth + 1);
    match &term.kind {
        TermKind::Literal(literal) => *literal != Literal::Undef,
        TermKind::Coerce(term) => depth < MAX_DEPTH && inner(term),
        TermKind::If { branches, otherwise: Some(otherwise) } => {
            depth < MAX_DEPTH && branches.iter().all(|(_, term)| inner(term)) && inner(otherwise)
        }
        TermKind::Variable(id) if model.rules[rule].parameters.contains(id) => {
            depth < MAX_DEPTH && is_given_defined(model, rule, id.0 as usize, depth)
        }
        _ => false,
    }
}

/// Whether every call of a rule passes a defined value for a parameter.
fn is_given_defined(model: &Model, called: usize, parameter: usize, depth: usize) -> bool {
    let mut defined = true;
    for caller in 0..model.rules.len() {
        model.rules[caller].body.walk(&mut |node| match &node.kind {
            RuleKind::MacroCall(Call { rule, arguments })
            | RuleKind::TurboCall(Call { rule, arguments })
            | RuleKind::Return { call: Call { rule, arguments }, .. }
                if *rule == RuleId(called as u32) =>
            {
                let argument = arguments.get(parameter);
                defined &= argument.is_some_and(|argument| is_defined(model, argument, caller, depth + 1));
            }
            // It may run any rule.
            RuleKind::RunValue { arguments, .. } => defined &= arguments.is_empty(),
            _ => {}
        });
    }
    defined
}

#[cfg(test)]
mod tests {
    use model::Loader;
    use syntax::SourceFile;

    use super::*;

    struct Nothing;

    impl Loader for Nothing {
        fn load(&mut self, _: &SourceFile, path: &str) -> Result<SourceFile, String> {
            Err(format!("there is no {path}"))
        }
    }

    fn check(signature: &str, rules: &str, init: &str, expected: bool) {
        let text = format!(
            "asm M\nimport StandardLibrary\nsignature:\n enum domain Mode = {{ON | OFF}}\n {signature}\ndefinitions:\n {rules}\n \
             main rule r_Main = skip\ndefault init s0: {init}"
        );
        let model = model::check(SourceFile::new("M.asm", text.clone()), &mut Nothing).model;
        let found = model.functions().find(|(_, function)| function.name == "mode").map(|(id, _)| id);
        assert_eq!(found.map(|id| always_defined(&model, id)), Some(expected), "{text}");
    }

    #[test]
    fn what_is_never_undef() {
        let (mode, on) = ("controlled mode: Mode", "function mode = ON");
        check(mode, "", on, true);
        check(mode, "", "", false);
        check(mode, "", "function mode = undef", false);
        check("monitored mode: Mode", "", "", false);
        check(mode, "rule r_a = mode := OFF", on, true);
        check(mode, "rule r_a = seq mode := OFF mode := undef endseq", on, false);
        check(mode, "rule r_a = mode := if mode = ON then OFF else ON endif", on, true);
        check(mode, "rule r_a = mode := if mode = ON then OFF endif", on, false);
    }

    #[test]
    fn what_calls_give() {
        let (mode, on) = ("controlled mode: Mode controlled other: Mode", "function mode = ON");
        check(mode, "rule r_set($m in Mode) = mode := $m rule r_a = r_set[OFF]", on, true);
        check(mode, "rule r_set($m in Mode) = mode := $m rule r_a = r_set[other]", on, false);
        check(mode, "rule r_set($m in Mode) = mode := $m rule r_a = par r_set[OFF] r_set[undef] endpar", on, false);
        let through = "rule r_set($m in Mode) = mode := $m rule r_on($m in Mode) = r_set[$m]";
        check(mode, &format!("{through} rule r_a = r_on[ON]"), on, true);
        check(mode, &format!("{through} rule r_a = r_on[undef]"), on, false);
        check(mode, "rule r_unset($m in Mode) = $m := undef rule r_a = r_unset[mode]", on, false);
    }

    #[test]
    fn what_arguments_there_are() {
        let given = "function mode($x in Thing) = ON";
        check("abstract domain Thing controlled mode: Thing -> Mode", "", given, true);
        check("dynamic abstract domain Thing controlled mode: Thing -> Mode", "", given, false);
        check("controlled mode: Integer -> Mode", "", "function mode($x in Integer) = ON", false);
    }
}
