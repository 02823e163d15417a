//! Checks of macro rules that need all rules to be known.
//!
//! In: the rules of a model. Out: faults where macro rules call each other in a circle, and where an updated parameter
//! gets an argument that is not a location. Both follow from the meaning of a macro call: the body of the rule with
//! the arguments in place of the parameters (Börger & Stärk 2003, section 2.2.4).

use std::collections::BTreeSet;

use syntax::Span;

use crate::check::local_state::UpdatedParameters;
use crate::declaration::FunctionKind;
use crate::fault::{self, Faults};
use crate::id::{RuleId, VariableId};
use crate::model::Model;
use crate::rule::{Call, RuleKind, RuleNode, Target};
use crate::term::{Term, TermKind};

/// Reports recursive macro rules, and arguments that are not locations but must be.
pub(crate) fn check(model: &Model, faults: &mut Faults) {
    report_recursion(model, faults);
    let updated = updated_parameters(model);
    for (index, _) in model.rules.iter().enumerate() {
        let caller = RuleId(index as u32);
        for (call, _) in calls(&model.rule(caller).body) {
            report_arguments(model, Some(caller), call, &updated, faults);
        }
    }
}

/// As [`check`], for a rule that is not one of the model.
pub(crate) fn check_fragment(model: &Model, rule: &RuleNode, faults: &mut Faults) {
    let updated = updated_parameters(model);
    for (call, _) in calls(rule) {
        report_arguments(model, None, call, &updated, faults);
    }
}

/// The parameters that macro rules update, by the rule's name and the parameter's place.
pub(crate) fn updated_by_name(model: &Model) -> UpdatedParameters {
    let updated = updated_parameters(model).into_iter();
    updated.map(|(rule, parameter)| (model.rule(rule).name.clone(), parameter.0 as usize)).collect()
}

/// All macro calls inside a rule, with their places.
fn calls(rule: &RuleNode) -> Vec<(&Call, Span)> {
    let mut calls = Vec::new();
    rule.walk(&mut |node| {
        if let RuleKind::MacroCall(call) = &node.kind {
            calls.push((call, node.span));
        }
    });
    calls
}

fn report_recursion(model: &Model, faults: &mut Faults) {
    let edges: Vec<Vec<(RuleId, Span)>> = model
        .rules
        .iter()
        .map(|rule| calls(&rule.body).iter().map(|(call, span)| (call.rule, *span)).collect())
        .collect();
    let mut done = vec![false; edges.len()];
    for start in 0..edges.len() {
        // Depth first with an explicit path, so that a long chain of rules needs no deep stack.
        let mut path: Vec<(usize, usize)> = vec![(start, 0)];
        while let Some((rule, next)) = path.last_mut() {
            let rule = *rule;
            if done[rule] || *next >= edges[rule].len() {
                done[rule] = true;
                path.pop();
                continue;
            }
            let (callee, span) = edges[rule][*next];
            *next += 1;
            let callee = callee.0 as usize;
            if let Some(at) = path.iter().position(|(open, _)| *open == callee) {
                let name = |index: usize| model.rules[index].name.clone();
                let mut cycle: Vec<String> = path[at..].iter().map(|(open, _)| name(*open)).collect();
                cycle.push(name(callee));
                faults.push(fault::rule::recursive_macro(span, &cycle, model.rules[callee].span));
            } else if !done[callee] {
                path.push((callee, 0));
            }
        }
    }
}

/// The parameters that a macro rule updates, itself or through the macro rules to which it passes them.
fn updated_parameters(model: &Model) -> BTreeSet<(RuleId, VariableId)> {
    let mut updated = BTreeSet::new();
    for (index, rule) in model.rules.iter().enumerate() {
        rule.body.walk(&mut |node| {
            if let RuleKind::Update { target: Target::Parameter(id, _), .. }
            | RuleKind::Return { target: Target::Parameter(id, _), .. } = &node.kind
            {
                updated.insert((RuleId(index as u32), *id));
            }
        });
    }
    loop {
        let before = updated.len();
        for (index, rule) in model.rules.iter().enumerate() {
            let caller = RuleId(index as u32);
            for (call, _) in calls(&rule.body) {
                for (argument, parameter) in call.arguments.iter().zip(&model.rule(call.rule).parameters) {
                    if let TermKind::Variable(id) = argument.kind
                        && is_macro_parameter(model, caller, id)
                        && updated.contains(&(call.rule, *parameter))
                    {
                        updated.insert((caller, id));
                    }
                }
            }
        }
        if updated.len() == before {
            return updated;
        }
    }
}

fn is_macro_parameter(model: &Model, rule: RuleId, variable: VariableId) -> bool {
    let rule = model.rule(rule);
    !rule.turbo && rule.parameters.contains(&variable)
}

fn report_arguments(
    model: &Model,
    caller: Option<RuleId>,
    call: &Call,
    updated: &BTreeSet<(RuleId, VariableId)>,
    faults: &mut Faults,
) {
    let callee = model.rule(call.rule);
    for (argument, parameter) in call.arguments.iter().zip(&callee.parameters) {
        if !updated.contains(&(call.rule, *parameter)) || is_location(model, caller, argument) {
            continue;
        }
        let variable = &callee.variables[parameter.0 as usize];
        let message =
            format!("`{}` updates its parameter `{}`, but this argument is no location", callee.name, variable.name);
        faults.push(fault::rule::not_a_location(argument.span, &message, Some(variable.span)));
    }
}

fn is_location(model: &Model, caller: Option<RuleId>, argument: &Term) -> bool {
    match &argument.kind {
        TermKind::Apply { function, .. } => matches!(
            model.function(*function).kind,
            FunctionKind::Controlled | FunctionKind::Shared | FunctionKind::Out | FunctionKind::Local
        ),
        TermKind::Variable(id) => caller.is_some_and(|caller| is_macro_parameter(model, caller, *id)),
        TermKind::Error => true,
        _ => false,
    }
}
