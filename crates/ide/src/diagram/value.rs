//! Values of a system's properties, as a chart may have them: each is read alone, before it is put in.
//!
//! In: the text that somebody typed. Out: what stands in the chart, or why it cannot stand there. INVARIANT: what is given is one value
//! of its kind and nothing beside it.

use syntax::ast::{AstNode, ChartFile, SystemChart};
use syntax::{FileId, Severity, SyntaxNode, parse_chart};

use super::text::extent;

/// What is between the words of a probe, if the probe has that and nothing else.
fn alone(
    before: &str,
    value: &str,
    after: &str,
    found: impl Fn(&SystemChart) -> Option<SyntaxNode>,
) -> Result<String, ()> {
    let value = value.trim();
    // A comment would take along what stands behind the value.
    if value.is_empty() || value.contains(['\n', '\r', '\u{0}']) || value.contains("//") || value.contains("/*") {
        return Err(());
    }
    let text = format!("chart A system s {before} {value} {after} endsystem");
    let parse = parse_chart(FileId(0), &text);
    let system = ChartFile::cast(parse.syntax()).and_then(|file| file.systems().next());
    let node = system.as_ref().and_then(found).ok_or(())?;
    let is_it = text.get(extent(&node)) == Some(value);
    match is_it && !parse.diagnostics.iter().any(|fault| fault.severity == Severity::Error) {
        true => Ok(value.to_string()),
        false => Err(()),
    }
}

/// A length of time as charts write it; one that `varies` may have two ends.
pub(super) fn length(value: &str, varies: bool) -> Result<String, String> {
    let time = |system: &SystemChart| Some(system.components().next()?.phases().next()?.time()?.syntax().clone());
    let probe = alone("component c asynchronous elaborate e", value, "endcomponent", time);
    let known = |value: &str| {
        let unit = value.trim_start_matches(|c: char| c.is_ascii_digit() || matches!(c, '.' | ' ' | '\t'));
        matches!(unit, "ns" | "us" | "ms" | "s")
    };
    match probe {
        Ok(value) if known(&value) && (varies || !value.contains("..")) => Ok(value),
        _ if varies => Err(format!("`{value}` is no time: a number and ns, us, ms or s, as in `2.5 ms` or `3..9 ms`")),
        _ => Err(format!("`{value}` is no time: a number and ns, us, ms or s, as in `2.5 ms`")),
    }
}

/// How many deadlines may be missed, as in `1 of 20`.
pub(super) fn tolerance(value: &str) -> Result<String, String> {
    let stated = |system: &SystemChart| Some(system.components().next()?.kind()?.tolerance()?.syntax().clone());
    let value = format!("misses {}", value.trim());
    let probe = alone("component c synchronous period 1 ms", &value, "endcomponent", stated);
    probe.map_err(|()| format!("`{}` does not say how many deadlines may be missed, as `1 of 20` does", &value[7..]))
}

/// What is awaited: the name of a channel, or `all` or `any` and several.
pub(super) fn awaited(value: &str) -> Result<String, String> {
    let stated = |system: &SystemChart| Some(system.components().next()?.kind()?.awaits()?.syntax().clone());
    let value = format!("awaits {}", value.trim());
    let probe = alone("component c asynchronous", &value, "endcomponent", stated);
    probe.map_err(|()| format!("`{}` names no channels, as `frames` or `all frames, poses` do", &value[7..]))
}

pub(super) fn domain(value: &str) -> Result<String, String> {
    let of = |system: &SystemChart| Some(system.devices().next()?.message()?.syntax().clone());
    alone("sensor x :", value, "sensor y", of).map_err(|()| format!("`{value}` is no domain"))
}

pub(super) fn number(value: &str) -> Result<String, String> {
    let value = value.trim();
    match !value.is_empty() && value.len() < 10 && value.bytes().all(|byte| byte.is_ascii_digit()) {
        true => Ok(value.to_string()),
        false => Err(format!("`{value}` is no whole number")),
    }
}

/// A name of something that is there, or of a phase. Words of charts may be names where a name is expected; whether one is, shows what
/// the text then says.
pub(super) fn name(value: &str) -> Result<String, String> {
    let value = value.trim();
    let begins = value.starts_with(|c: char| c.is_ascii_alphabetic());
    match begins && value.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_') {
        true => Ok(value.to_string()),
        false => Err(format!("`{value}` is no name: a letter first, then letters, digits and _")),
    }
}

/// What is set anew, as it may be written; none takes it away.
pub(super) fn read(
    value: Option<&str>,
    read: impl Fn(&str) -> Result<String, String>,
) -> Result<Option<String>, String> {
    value.map(str::trim).filter(|value| !value.is_empty()).map(read).transpose()
}
