//! Spells the parts of a chart in AsmetaL: names of rules and functions, values of states, calls.

use crate::chart::{Chart, Control, History, Machine, Shape, ShapeId, ShapeKind};

/// The name of a machine's rule.
pub(crate) fn rule_name(machine: &Machine) -> String {
    match &machine.rule {
        Some(link) => link.name.clone(),
        None => format!("r_{}", machine.name),
    }
}

/// The value of the control variable in a state or block: the linked one, or one derived from the shape's name.
/// Literals share one name space, so if a machine with another control variable has the same name, the machine's name
/// is put before it.
pub(crate) fn state_value(chart: &Chart, machine: &Machine, id: ShapeId) -> String {
    let shape = machine.shape(id);
    if let (Some(link), ShapeKind::State { .. }) = (&shape.link, &shape.kind) {
        return link.text.clone();
    }
    let value = literal(&shape.name);
    let all = chart.machines.iter().chain(&chart.patterns);
    let others = all.filter(|other| control_name(other) != control_name(machine));
    let taken = others.flat_map(|other| &other.shapes).any(|other| match (&other.kind, &other.link) {
        (ShapeKind::State { .. }, Some(link)) => link.text == value,
        (ShapeKind::State { .. } | ShapeKind::Instance(_), _) => literal(&other.name) == value,
        _ => false,
    });
    if taken { format!("{}_{value}", literal(&machine.name)) } else { value }
}

/// The function that holds the control state.
pub(super) fn control_name(machine: &Machine) -> Option<&str> {
    match machine.control.as_ref()? {
        Control::Linked(link) => Some(&link.name),
        Control::Made { name, .. } => Some(name),
    }
}

/// `waitingTrigger` as `WAITING_TRIGGER`.
pub(super) fn literal(name: &str) -> String {
    let mut text = String::new();
    let mut before = '_';
    for letter in name.chars() {
        if letter.is_uppercase() && before.is_lowercase() {
            text.push('_');
        }
        text.extend(letter.to_uppercase());
        before = letter;
    }
    if text.starts_with(|c: char| c.is_ascii_uppercase()) && text[1..].starts_with(|c: char| c.is_ascii_uppercase()) {
        text
    } else {
        format!("STATE_{text}")
    }
}

/// The control variable as a location.
pub(crate) fn control_location(machine: &Machine) -> Option<String> {
    Some(match machine.control.as_ref()? {
        Control::Linked(link) => link.text.clone(),
        Control::Made { name, .. } => applied(name, machine, '(', ')'),
    })
}

pub(super) fn applied(name: &str, machine: &Machine, open: char, close: char) -> String {
    let variables: Vec<&str> = machine.parameters.iter().map(|parameter| parameter.variable.as_str()).collect();
    match (variables.is_empty(), open) {
        (true, '(') => name.to_string(),
        _ => format!("{name}{open}{}{close}", variables.join(", ")),
    }
}

/// The term of a guard or the rule of an action.
pub(crate) fn call(machine: &Machine, shape: &Shape) -> String {
    match (&shape.link, &shape.kind) {
        (Some(link), _) => link.text.clone(),
        (None, ShapeKind::Guard) => applied(&function_name(&shape.name), machine, '(', ')'),
        (None, _) => applied(&format!("r_{}", shape.name), machine, '[', ']'),
    }
}

/// The control variable of an instance's pattern, with the arguments instead of its parameters.
pub(crate) fn inner_control(chart: &Chart, instance: &Shape) -> Option<String> {
    let pattern = chart.pattern_of(instance)?;
    Some(of_instance(pattern, instance, &control_location(pattern)?))
}

/// A text of a pattern with the arguments of an instance instead of the parameters.
pub(crate) fn of_instance(pattern: &Machine, instance: &Shape, text: &str) -> String {
    let ShapeKind::Instance(of) = &instance.kind else { return text.to_string() };
    let variables: Vec<&str> = pattern.parameters.iter().map(|parameter| parameter.variable.as_str()).collect();
    substituted(text, &variables, &of.arguments)
}

/// The call of the rule of an instance's pattern.
pub(crate) fn instance_call(chart: &Chart, instance: &Shape) -> String {
    match (chart.pattern_of(instance), &instance.kind) {
        (Some(pattern), ShapeKind::Instance(of)) => {
            let name = instance.link.as_ref().map(|link| link.name.clone()).unwrap_or_else(|| rule_name(pattern));
            format!("{name}[{}]", of.arguments.join(", "))
        }
        _ => "skip".to_string(),
    }
}

/// The function that remembers in which of its states a composite state was left.
pub(crate) fn memory_name(composite: &Shape) -> String {
    format!("{}Left", function_name(&composite.name))
}

/// That function as a location.
pub(crate) fn memory_location(machine: &Machine, composite: &Shape) -> String {
    match composite.composite().and_then(|composite| composite.history.as_ref()) {
        Some(History::Linked(link)) => link.text.clone(),
        Some(History::Made) | None => applied(&memory_name(composite), machine, '(', ')'),
    }
}

/// The function that holds what a pattern was left with.
pub(crate) fn answer_name(machine: &Machine) -> String {
    format!("{}Answer", function_name(&machine.name))
}

/// That function as a location.
pub(crate) fn answer_location(machine: &Machine) -> String {
    applied(&answer_name(machine), machine, '(', ')')
}

/// The name of a function, derived from another name.
pub(crate) fn function_name(name: &str) -> String {
    let mut letters = name.chars();
    letters.next().map(|first| first.to_lowercase().chain(letters).collect()).unwrap_or_default()
}

/// A text in which whole variables are replaced by values.
pub(crate) fn substituted(text: &str, variables: &[&str], values: &[String]) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(at) = rest.find('$') {
        let end =
            rest[at + 1..].find(|c: char| !c.is_ascii_alphanumeric() && c != '_').map_or(rest.len(), |n| at + 1 + n);
        let variable = &rest[at..end];
        out.push_str(&rest[..at]);
        match variables.iter().position(|known| *known == variable).and_then(|index| values.get(index)) {
            Some(value) => out.push_str(value),
            None => out.push_str(variable),
        }
        rest = &rest[end..];
    }
    out + rest
}
