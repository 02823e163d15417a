//! What the tests of this crate share: a file checked with others beside it, and faults as text.

#![allow(dead_code, reason = "each test binary uses its part")]

use model::{Checked, check};
use syntax::{Diagnostic, Severity, SourceFile, Sources};
use testkit::Texts;

/// Checks a file of that name, with others to import.
pub fn check_file(name: &str, text: &str, others: &[(&str, &str)]) -> Checked {
    check(SourceFile::new(name, text), &mut Texts::of(others.iter().copied()))
}

/// Checks the body of an `asm t` that imports the standard library: what stands behind `signature:`.
pub fn check_body(body: &str) -> Checked {
    check_file("t.asm", &format!("asm t\nimport StandardLibrary\nsignature:\n{body}"), &[])
}

/// The dump of a model without faults, without its first line; panics when there are faults.
pub fn dump(checked: &Checked) -> String {
    assert!(checked.diagnostics.iter().all(|fault| fault.severity != Severity::Error), "{}", faults(checked));
    checked.model.dump().split_once('\n').map(|(_, rest)| rest.to_string()).unwrap_or_default()
}

/// All faults as text.
pub fn faults(checked: &Checked) -> String {
    checked.diagnostics.iter().map(|fault| fault_text(&checked.sources, fault)).collect()
}

/// A fault as text: severity, id, place, the text underlined, message, reason, other places, help.
pub fn fault_text(sources: &Sources, fault: &Diagnostic) -> String {
    let severity = match fault.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Note => "note",
    };
    let at = |span| format!("{} `{}`", sources.position(span), sources.text(span));
    let mut text = format!("{severity}[{}] {}: {}\n", fault.id, at(fault.primary.span), fault.message);
    if !fault.primary.text.is_empty() {
        text += &format!("  because {}\n", fault.primary.text);
    }
    for label in &fault.secondary {
        text += &format!("  see {}: {}\n", at(label.span), label.text);
    }
    if let Some(help) = &fault.help {
        text += &format!("  help: {help}\n");
    }
    text
}
