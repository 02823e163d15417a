//! Bounds of a search: the values to try for an input, from `--bound` and the file beside a model.
//!
//! In: `NAME=LOW..HIGH` or `NAME=VALUE,VALUE`, and the program. Out: the values of each function of that name. From
//! `--undefined NAME`, the functions of that name.

use std::collections::BTreeSet;
use std::ops::Deref;
use std::sync::Arc;

use machine::{Bounds, Limits, Machine, Show, Value};
use program::{FunctionId, FunctionKind, Program};
use simulate::read_value;

use crate::Refused;

/// What to write instead of a bound that was refused.
pub const HELP: &str = "write it as level=0..10 or colour=RED,GREEN";

/// LIMIT: values of one bound.
const VALUES: i64 = 1 << 20;

/// Reads bounds.
///
/// # Errors
/// The first one that cannot be read, or does not fit the program.
pub fn read(program: &Program, texts: &[String]) -> Result<Bounds, Refused> {
    let mut bounds = Bounds::new();
    let mut machine = None;
    for text in texts {
        let wrong = |reason: String| Refused::new(text, reason);
        let (name, values) = text.split_once('=').ok_or_else(|| wrong("there is no `=`".to_string()))?;
        let inputs = inputs(program, name.trim());
        if inputs.is_empty() {
            return Err(wrong(format!("`{}` is no monitored or shared function", name.trim())));
        }
        for function in inputs {
            let values = values_of(program, function, values).map_err(wrong)?;
            let machine = machine.get_or_insert_with(|| Machine::new(Arc::new(program.clone()), Limits::default()));
            all_inside(machine, function, &values).map_err(wrong)?;
            bounds.insert(function, values);
        }
    }
    Ok(bounds)
}

/// Whether a bound is one of an input of the program, whatever its values are.
pub fn is_of_input(program: &Program, text: &str) -> bool {
    text.split_once('=').is_some_and(|(name, _)| !inputs(program, name.trim()).is_empty())
}

/// Whether the domain of a function contains the values, unless it may grow: the environment gives no others.
fn all_inside(machine: &mut Machine, function: FunctionId, values: &[Value]) -> Result<(), String> {
    let program = Arc::clone(machine.program());
    let domain = program.function(function).codomain;
    if !program.constant_domains()[domain.0 as usize] {
        return Ok(());
    }
    match values.iter().find(|value| !machine.contains(domain, value)) {
        Some(value) => Err(format!("{} is not in {}", value.show(&program), program.domain(domain).name)),
        None => Ok(()),
    }
}

/// Reads the names of inputs that may also be undef.
///
/// # Errors
/// The first name that is no input's, or that of an input whose domain may grow: its values are not the same in all states.
pub fn undefined(program: &Program, names: &[impl Deref<Target = str>]) -> Result<BTreeSet<FunctionId>, Refused> {
    let mut undefined = BTreeSet::new();
    let constant = program.constant_domains();
    for name in names.iter().map(|name| &**name) {
        let found = inputs(program, name.trim());
        if found.is_empty() {
            return Err(Refused::new(name, format!("`{}` is no monitored or shared function", name.trim())));
        }
        for function in found {
            let domain = program.function(function).codomain;
            if !constant[domain.0 as usize] {
                let reason = format!("the domain of `{}` may grow, so it cannot be undef, too", name.trim());
                return Err(Refused::new(name, reason));
            }
            undefined.insert(function);
        }
    }
    Ok(undefined)
}

fn inputs(program: &Program, name: &str) -> Vec<FunctionId> {
    let all = program.functions.iter().enumerate();
    all.filter(|(_, f)| f.name == name && matches!(f.kind, FunctionKind::Monitored | FunctionKind::Shared))
        .map(|(index, _)| FunctionId(index as u32))
        .collect()
}

fn values_of(program: &Program, function: FunctionId, text: &str) -> Result<Vec<Value>, String> {
    let number = |text: &str| text.trim().parse::<i64>().map_err(|_| format!("`{}` is no whole number", text.trim()));
    if let Some((low, high)) = text.split_once("..") {
        let (low, high) = (number(low)?, number(high)?);
        if high < low {
            return Err(format!("there is no number from {low} to {high}"));
        }
        if high.saturating_sub(low) >= VALUES {
            return Err(format!("these are more than {VALUES} values"));
        }
        return Ok((low..=high).map(Value::Integer).collect());
    }
    let domain = program.function(function).codomain;
    let mut values: Vec<Value> =
        text.split(',').map(|text| read_value(program, domain, text)).collect::<Result<_, _>>()?;
    values.sort_unstable();
    values.dedup();
    Ok(values)
}
