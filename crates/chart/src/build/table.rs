//! Initial values of functions over the elements of a system: as one value, or as a `switch`.

use std::fmt::Write;

use crate::system::Component;

/// The name of a component's waiting phase.
pub(super) fn waiting(component: &Component) -> String {
    format!("{}_wait", component.name)
}

/// `switch $x case a: b … otherwise z`, or `z` if there are no cases. The most frequent value becomes the last one.
pub(super) fn by_case(subject: &str, cases: &[(String, String)]) -> String {
    let count = |value: &str| cases.iter().filter(|(_, other)| other == value).count();
    let Some(rest) = cases.iter().map(|(_, value)| value).max_by_key(|value| (count(value), *value == "undef")) else {
        return "undef".to_string();
    };
    let others: Vec<&(String, String)> = cases.iter().filter(|(_, value)| value != rest).collect();
    if others.is_empty() {
        return rest.clone();
    }
    let mut text = format!("\nswitch {subject}\n");
    for (name, value) in others {
        let _ = writeln!(text, "case {name}: {value}");
    }
    let _ = write!(text, "otherwise {rest}\nendswitch");
    text
}
