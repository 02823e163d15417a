//! The arenas: indices, order, argument counts, depth. One pass over each, without recursion.

use model::{FunctionId, FunctionKind};

use crate::ir::{
    BinderList, DomainKind, MAX_DEPTH, ProcedureId, Program, Rule, RuleId, RuleList, Term, TermId, TermList,
};
use crate::verify::{domain_exists, ensure, function_exists, procedure_exists};

pub(super) fn verify_terms(program: &Program) -> Result<(), String> {
    let count = program.terms.len();
    ensure(program.term_domains.len() == count && program.term_spans.len() == count, || {
        "the tables of terms differ in length".to_string()
    })?;
    let mut depths = vec![1u32; count];
    for index in 0..count {
        let id = TermId(index as u32);
        verify_term(program, id).map_err(|why| format!("term {index}: {why}"))?;
        let mut low = true;
        let mut depth = 0;
        program.each_child_of_term(id, &mut |child| {
            low &= (child.0 as usize) < index;
            depth = depth.max(depths.get(child.0 as usize).copied().unwrap_or(0));
        });
        ensure(low, || format!("term {index} stands before a child"))?;
        depths[index] = depth + 1;
        ensure(depth < MAX_DEPTH, || format!("term {index} nests more than {MAX_DEPTH} deep"))?;
    }
    Ok(())
}

fn verify_term(program: &Program, id: TermId) -> Result<(), String> {
    domain_exists(program, program.term_domain(id))?;
    match program.term(id) {
        Term::Constant(index) => {
            ensure((*index as usize) < program.constants.len(), || format!("there is no constant {index}"))
        }
        Term::Slot(_) | Term::Project { .. } | Term::Range { .. } | Term::Let { .. } | Term::Coerce(_) => Ok(()),
        Term::Read { function, arguments } => {
            application(program, *function, *arguments)?;
            ensure(program.function(*function).definition.is_none(), || "reads a defined function".to_string())
        }
        Term::Define { function, arguments } => {
            application(program, *function, *arguments)?;
            ensure(program.function(*function).definition.is_some(), || "there is no definition".to_string())
        }
        Term::Builtin { builtin, arguments } => {
            terms_exist(program, *arguments)?;
            ensure(builtin.arity().is_none_or(|arity| arity == arguments.len as usize), || {
                format!("{builtin:?} takes {:?} arguments, not {}", builtin.arity(), arguments.len)
            })
        }
        Term::Domain(domain) => domain_exists(program, *domain),
        Term::Tuple(list) | Term::Collection { elements: list, .. } => terms_exist(program, *list),
        Term::Comprehension { binders, .. } | Term::Quantified { binders, .. } => binders_exist(program, *binders),
        Term::If { branches: list, .. } | Term::Switch { cases: list, .. } => {
            terms_exist(program, *list)?;
            ensure(list.len % 2 == 0, || "a branch has no term".to_string())
        }
        Term::Rule(procedure) => procedure_exists(program, *procedure),
        Term::Unbound => Ok(()),
        Term::Missing(function) => {
            ensure((function.0 as usize) < program.functions.len(), || "there is no such function".to_string())?;
            let missing = program.function(*function);
            ensure(missing.definition.is_none() && missing.element.is_none(), || "the function is defined".to_string())
        }
    }
}

pub(super) fn verify_rules(program: &Program) -> Result<(), String> {
    let count = program.rules.len();
    ensure(program.rule_spans.len() == count, || "the tables of rules differ in length".to_string())?;
    let mut depths = vec![1u32; count];
    for index in 0..count {
        let id = RuleId(index as u32);
        verify_rule(program, id).map_err(|why| format!("rule {index}: {why}"))?;
        let mut low = true;
        program.each_term_of_rule(id, &mut |term| low &= (term.0 as usize) < program.terms.len());
        ensure(low, || format!("rule {index} holds a term that does not exist"))?;
        let mut depth = 0;
        program.each_child_of_rule(id, &mut |child| {
            low &= (child.0 as usize) < index;
            depth = depth.max(depths.get(child.0 as usize).copied().unwrap_or(0));
        });
        ensure(low, || format!("rule {index} stands before a child"))?;
        depths[index] = depth + 1;
        ensure(depth < MAX_DEPTH, || format!("rule {index} nests more than {MAX_DEPTH} deep"))?;
    }
    Ok(())
}

fn verify_rule(program: &Program, id: RuleId) -> Result<(), String> {
    match program.rule(id) {
        Rule::Skip
        | Rule::RunAgent { .. }
        | Rule::Let { .. }
        | Rule::Iterate(_)
        | Rule::While { .. }
        | Rule::RecursiveWhile { .. } => Ok(()),
        Rule::Update { function, arguments, .. } => location(program, *function, *arguments),
        Rule::Call { procedure, arguments } => call(program, *procedure, *arguments, false),
        Rule::TurboCall { procedure, arguments } => call(program, *procedure, *arguments, true),
        Rule::Return { function, target, procedure, arguments } => {
            location(program, *function, *target)?;
            call(program, *procedure, *arguments, true)
        }
        Rule::RunValue { arguments, .. } => terms_exist(program, *arguments),
        Rule::Par(rules) | Rule::Seq(rules) => rules_exist(program, *rules),
        Rule::If { guards: terms, rules } | Rule::Switch { values: terms, rules, .. } => {
            terms_exist(program, *terms)?;
            rules_exist(program, *rules)?;
            ensure(rules.len == terms.len || rules.len == terms.len + 1, || {
                format!("{} rules for {} branches", rules.len, terms.len)
            })
        }
        Rule::Choose { binders, .. } | Rule::Forall { binders, .. } => binders_exist(program, *binders),
        Rule::Extend { domain, .. } => {
            domain_exists(program, *domain)?;
            let dynamic = match program.domain(*domain).kind {
                DomainKind::Abstract { dynamic, .. } | DomainKind::Concrete { dynamic, .. } => dynamic,
                _ => false,
            };
            ensure(dynamic, || format!("extends {}, which does not grow", program.domain(*domain).name))
        }
        Rule::Local { start, len, initialisations, .. } => {
            rules_exist(program, *initialisations)?;
            range(*start, *len, program.function_lists.len())?;
            ensure(initialisations.len == *len, || "a local function is not initialised".to_string())?;
            for function in &program.function_lists[*start as usize..][..*len as usize] {
                function_exists(program, *function)?;
                ensure(program.function(*function).kind == FunctionKind::Local, || {
                    format!("{} is not local", program.function(*function).name)
                })?;
            }
            Ok(())
        }
    }
}

fn application(program: &Program, function: FunctionId, arguments: TermList) -> Result<(), String> {
    function_exists(program, function)?;
    terms_exist(program, arguments)?;
    let function = program.function(function);
    ensure(function.parameters.len() == arguments.len as usize, || {
        format!("{} takes {} arguments, not {}", function.name, function.parameters.len(), arguments.len)
    })
}

fn location(program: &Program, function: FunctionId, arguments: TermList) -> Result<(), String> {
    application(program, function, arguments)?;
    let function = program.function(function);
    ensure(!matches!(function.kind, FunctionKind::Static | FunctionKind::Derived), || {
        format!("{} is not dynamic", function.name)
    })
}

fn call(program: &Program, procedure: ProcedureId, arguments: TermList, turbo: bool) -> Result<(), String> {
    procedure_exists(program, procedure)?;
    terms_exist(program, arguments)?;
    let procedure = program.procedure(procedure);
    ensure(procedure.turbo == turbo, || format!("{} is called in the wrong way", procedure.name))?;
    ensure(procedure.parameters.len() == arguments.len as usize, || {
        format!("{} takes {} arguments, not {}", procedure.name, procedure.parameters.len(), arguments.len)
    })
}

fn terms_exist(program: &Program, list: TermList) -> Result<(), String> {
    range(list.start, list.len, program.term_lists.len())
}

fn rules_exist(program: &Program, list: RuleList) -> Result<(), String> {
    range(list.start, list.len, program.rule_lists.len())
}

fn binders_exist(program: &Program, list: BinderList) -> Result<(), String> {
    ensure(list.len > 0, || "nothing is bound".to_string())?;
    range(list.start, list.len, program.binder_lists.len())
}

fn range(start: u32, len: u32, size: usize) -> Result<(), String> {
    ensure(start as usize + len as usize <= size, || format!("the list {start}+{len} ends after {size}"))
}
