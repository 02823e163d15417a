//! The verifier: is a program well formed?
//!
//! In: any program. Out: the first breach of an invariant of [`crate::ir`], as a sentence. Lowering asserts in debug
//! builds that its result passes. Programs that tests build by hand should pass, too.

mod arena;
mod scope;

use model::{DomainId, FunctionId, FunctionKind};

use crate::ir::{DomainKind, Expression, ProcedureId, Program};

/// Checks the invariants of the IR.
///
/// # Errors
/// What is wrong, and where.
pub fn verify(program: &Program) -> Result<(), String> {
    arena::verify_terms(program)?;
    arena::verify_rules(program)?;
    verify_functions(program)?;
    verify_domains(program)?;
    for (index, procedure) in program.procedures.iter().enumerate() {
        scope::verify_procedure(program, procedure)
            .map_err(|why| format!("procedure {index} {}: {why}", procedure.name))?;
    }
    verify_initial_state(program)?;
    for property in &program.properties {
        for formula in [Some(&property.formula), property.conclusion.as_ref()].into_iter().flatten() {
            verify_expression(program, formula, 0).map_err(|why| format!("property {}: {why}", property.name))?;
        }
    }
    Ok(())
}

fn verify_expression(program: &Program, expression: &Expression, parameters: usize) -> Result<(), String> {
    ensure(expression.parameters.len() == parameters, || {
        format!("{} parameters instead of {parameters}", expression.parameters.len())
    })?;
    scope::verify_expression(program, expression)
}

fn verify_functions(program: &Program) -> Result<(), String> {
    for (index, function) in program.functions.iter().enumerate() {
        let fail = |why: String| format!("function {index} {}: {why}", function.name);
        for domain in function.parameters.iter().chain([&function.codomain]) {
            domain_exists(program, *domain).map_err(fail)?;
        }
        if let Some(definition) = &function.definition {
            ensure(matches!(function.kind, FunctionKind::Static | FunctionKind::Derived), || {
                fail("a dynamic function is defined".to_string())
            })?;
            verify_expression(program, definition, function.parameters.len()).map_err(fail)?;
        }
        if let Some(element) = function.element {
            let named = match &program.domain(base(program, function.codomain)).kind {
                DomainKind::Abstract { elements, .. } => elements.get(element as usize),
                _ => None,
            };
            ensure(named == Some(&function.name), || fail(format!("is not element {element} of its domain")))?;
        }
    }
    for function in [program.self_function, program.result_function].into_iter().flatten() {
        function_exists(program, function)?;
    }
    Ok(())
}

fn verify_domains(program: &Program) -> Result<(), String> {
    for (index, domain) in program.domains.iter().enumerate() {
        let fail = |why: String| format!("domain {index} {}: {why}", domain.name);
        let parts: Vec<DomainId> = match &domain.kind {
            DomainKind::Prod(parts) | DomainKind::Rule(parts) => parts.clone(),
            DomainKind::Seq(of) | DomainKind::Powerset(of) | DomainKind::Bag(of) => vec![*of],
            DomainKind::Map(key, value) => vec![*key, *value],
            DomainKind::Concrete { base, .. } => vec![*base],
            _ => Vec::new(),
        };
        for part in parts {
            domain_exists(program, part).map_err(fail)?;
        }
        if let DomainKind::Concrete { contents: Some(contents), .. } = &domain.kind {
            verify_expression(program, contents, 0).map_err(fail)?;
        }
    }
    Ok(())
}

fn verify_initial_state(program: &Program) -> Result<(), String> {
    for initial in &program.initials {
        function_exists(program, initial.function)?;
        let function = program.function(initial.function);
        verify_expression(program, &initial.value, function.parameters.len())
            .map_err(|why| format!("initial value of {}: {why}", function.name))?;
    }
    for agent in &program.agents {
        domain_exists(program, agent.domain)?;
        procedure_exists(program, agent.procedure)?;
    }
    let specific = |domain: DomainId| matches!(program.domain(domain).kind, DomainKind::Concrete { .. });
    ensure(program.agents.windows(2).all(|pair| specific(pair[0].domain) || !specific(pair[1].domain)), || {
        "the program of a subset of Agent stands after that of Agent".to_string()
    })?;
    program.main.map_or(Ok(()), |main| procedure_exists(program, main))
}

/// The domain itself, or the base of a concrete one.
fn base(program: &Program, domain: DomainId) -> DomainId {
    match program.domain(domain).kind {
        DomainKind::Concrete { base, .. } => base,
        _ => domain,
    }
}

fn ensure(holds: bool, why: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(why()) }
}

fn domain_exists(program: &Program, domain: DomainId) -> Result<(), String> {
    ensure((domain.0 as usize) < program.domains.len(), || format!("there is no domain {}", domain.0))
}

fn function_exists(program: &Program, function: FunctionId) -> Result<(), String> {
    ensure((function.0 as usize) < program.functions.len(), || format!("there is no function {}", function.0))
}

fn procedure_exists(program: &Program, procedure: ProcedureId) -> Result<(), String> {
    ensure((procedure.0 as usize) < program.procedures.len(), || format!("there is no procedure {}", procedure.0))
}
