//! Is a model accepted? The peer's answer against ours.
//!
//! In: a path and what the peer said. Out: an [`Answer`]; a difference gets its reason from the peer's message and our
//! diagnostics, never from the name of the file.

use syntax::{Diagnostic, Severity, Sources};

use super::job::Answer;
use super::loader::Checkout;
use super::reason;

/// Checks a model and compares.
pub fn compare(checkout: &Checkout, path: &str, accepted: bool, message: &str) -> Answer {
    let source = match checkout.source(path) {
        Ok(source) => source,
        Err(reason) => return Answer::Void { why: reason },
    };
    let checked = model::check(source, &mut checkout.clone());
    let fault = checked.diagnostics.iter().find(|diagnostic| diagnostic.severity == Severity::Error);
    match (accepted, fault) {
        (true, None) | (false, Some(_)) => Answer::same(),
        (true, Some(fault)) => Answer::different(refusal(fault), refused(&checked.sources, fault)),
        (false, None) => Answer::different(superset(message), format!("accepted here; there {message}")),
    }
}

/// Why we refuse what the peer accepts.
pub fn refusal(fault: &Diagnostic) -> Option<&'static str> {
    match fault.id {
        "unknown-variable" => Some(reason::UNBOUND),
        _ => None,
    }
}

/// Why we accept what the peer refuses.
fn superset(message: &str) -> Option<&'static str> {
    let libraries = ["StandardLibrary", "CTLLibrary", "LTLLibrary", "TimeLibrary", "TimeLibrarySimple"];
    let import = message.split("import not found").nth(1).and_then(|rest| rest.split("module name ").nth(1));
    if let Some(path) = import.and_then(|rest| rest.split_whitespace().next()) {
        let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
        return libraries.contains(&name.trim_end_matches(".asm")).then_some(reason::BUILT_IN_LIBRARY);
    }
    let function = message.split("Problems in creating Function Term (").nth(1).and_then(|rest| rest.split(')').next());
    if function.is_some_and(|name| ["itor", "iton", "ntor", "ntoi", "rtoi", "rton"].contains(&name)) {
        return Some(reason::WIDER_NUMBERS);
    }
    if message.contains("must be compatible with") || message.contains("Error reading relationalExpr") {
        return Some(reason::WIDER_NUMBERS);
    }
    if message.contains("Unresolved reference to r_") {
        return Some(reason::RULE_TERM);
    }
    // What the peer found dynamic is nothing but domains.
    let found = message.contains("static function").then(|| message.split("contains (dynamic) [").nth(1)).flatten();
    let mut names = found.map(|found| found.split("asmeta.definitions.").skip(1)).into_iter().flatten().peekable();
    (names.peek().is_some() && names.all(|name| name.starts_with("domains."))).then_some(reason::STATIC_OVER_DYNAMIC)
}

/// One fault as a line: place, kind, sentence.
pub fn refused(sources: &Sources, fault: &Diagnostic) -> String {
    format!("refused here: {} ({}, {})", fault.message, fault.id, sources.position(fault.primary.span))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_static_function_over_dynamic_domains_alone_is_a_superset() {
        let refused = |found: &str| {
            superset(&format!(
                "ParseException: Error: static function f contains (dynamic) [{found}] in its definition"
            ))
        };
        let domain = "asmeta.definitions.domains.impl.AgentDomainImpl@1 (name: Agent)";
        let function = "asmeta.definitions.impl.ControlledFunctionImpl@2 (name: g)";
        assert_eq!(refused(domain), Some(reason::STATIC_OVER_DYNAMIC));
        assert_eq!(refused(function), None);
        assert_eq!(refused(&format!("{domain}, {function}")), None);
    }
}
