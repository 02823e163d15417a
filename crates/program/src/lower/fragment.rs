//! Fragments: terms, rules and locations added to a program that is already lowered.
//!
//! In: the text of a scenario, a command line or a debugger, checked against the same model. The model may have new
//! domains and functions by now. Out: ids and expressions of the same program; its other parts do not change. The
//! errors are those of [`crate::lower()`]; after an error the program is still well formed.

use model::{FunctionId, Model, Term, Variable};
use syntax::Diagnostic;

use crate::ir::{Expression, ProcedureId, Program};
use crate::lower::Lowering;

/// Adds a term; `variables` are those of its binders.
///
/// # Errors
/// `model-too-large`.
pub fn lower_term(
    program: &mut Program,
    model: &Model,
    term: &Term,
    variables: &[Variable],
) -> Result<Expression, Vec<Diagnostic>> {
    let mut lowering = Lowering::for_fragment(model, program);
    let expression = lowering.lower_expression(variables, &[], term);
    lowering.finish()?;
    Ok(expression)
}

/// Adds a rule without parameters as a procedure. The rule need not be one of the model.
///
/// # Errors
/// `model-too-large`, `not-a-location`.
pub fn lower_rule(program: &mut Program, model: &Model, rule: &model::Rule) -> Result<ProcedureId, Vec<Diagnostic>> {
    let mut lowering = Lowering::for_fragment(model, program);
    let procedure = lowering.fragment_procedure(rule);
    lowering.finish()?;
    Ok(procedure)
}

/// Adds the arguments of a location: of `f(1, a)`, returns the function and a term for each argument.
///
/// # Errors
/// `not-a-location` for a term that is not an application of a dynamic function; `model-too-large`.
pub fn lower_location(
    program: &mut Program,
    model: &Model,
    term: &Term,
    variables: &[Variable],
) -> Result<(FunctionId, Vec<Expression>), Vec<Diagnostic>> {
    let mut lowering = Lowering::for_fragment(model, program);
    let Some((function, arguments)) = lowering.location(term) else {
        let fault = Diagnostic::error("not-a-location", term.span, "a value stands here, not a location")
            .here("only a location can be assigned")
            .with_help("write a dynamic function, applied to its arguments");
        return Err(vec![fault]);
    };
    let arguments = arguments.iter().map(|argument| lowering.lower_expression(variables, &[], argument)).collect();
    lowering.finish()?;
    Ok((function, arguments))
}

impl<'m, 'p> Lowering<'m, 'p> {
    /// A lowering into an existing program, brought up to date with the model.
    fn for_fragment(model: &'m Model, program: &'p mut Program) -> Self {
        let (domains, functions) = (program.domains.len(), program.functions.len());
        let mut lowering = Lowering::new(model, program);
        lowering.lower_signature();
        lowering.lower_static_contents(domains);
        lowering.lower_function_definitions(functions);
        lowering
    }
}
