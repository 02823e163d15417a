//! Turns the findings of a verification into diagnostics: unreachable rules, violated properties, domains that cannot
//! be enumerated.
//!
//! In: parts of a report, the program, its texts. Out: one diagnostic for each.

use explore::{Unbounded, UnboundedKind};
use program::{Program, Property, PropertyKind};
use syntax::{Diagnostic, Sources, Span};
use verify::Trace;
use verify::solver::Outside;
use verify::vacuity::Replaced;

/// A part of the model that solvers do not support.
pub fn diagnose_outside(outside: &Outside) -> Diagnostic {
    Diagnostic::error("outside-solver", outside.span, format!("{} cannot be translated for solvers", outside.what))
        .here("not translated")
        .with_help("let the states be explored: `--engine explicit`, or `bdd`")
}

/// A rule that no reachable state runs.
pub fn diagnose_unreachable(rule: Span) -> Diagnostic {
    Diagnostic::warning("unreachable-rule", rule, "no reachable state runs this rule")
        .here("never runs")
        .with_help("if it should run, its guard or what leads to it is wrong; else remove it")
}

/// A part of a property that holds, without which it holds as well.
pub fn diagnose_idle(replaced: &Replaced, program: &Program) -> Diagnostic {
    let name = &program.properties[replaced.property].name;
    let Replaced { part, by, .. } = *replaced;
    Diagnostic::warning("idle-part", part, format!("{name} holds whatever stands here"))
        .here(format!("with {by} in its place, too"))
        .with_help("so it says nothing about this part: the model may never come to where it matters, or the property may be weaker than meant")
}

/// A property that a run violates.
pub fn diagnose_property(property: &Property, trace: &Trace) -> Diagnostic {
    let message = format!("{} does not hold", property.name);
    let (id, seen) = match property.kind {
        PropertyKind::Ctl | PropertyKind::Ltl => ("property-violated", "not true of this run".to_string()),
        _ => {
            let steps = trace.steps.len();
            ("invariant-violated", format!("not true after {steps} step{}", if steps == 1 { "" } else { "s" }))
        }
    };
    Diagnostic::error(id, property.span, message).here(seen)
}

/// A domain that cannot be enumerated. The message contains the place, since it is also shown as a reason, without the
/// text.
pub fn diagnose_unbounded(unbounded: &Unbounded, program: &Program, sources: &Sources) -> Diagnostic {
    let place = short_place(sources, unbounded.span);
    match unbounded.kind {
        UnboundedKind::Input(function) => {
            let declared = program.function(function);
            let domain = &program.domain(declared.codomain).name;
            let message = format!("the values of {} cannot be enumerated ({place})", declared.name);
            no_bound(unbounded.span, message)
                .here(format!("{domain} is infinite or empty, or its elements are not known"))
                .with_help(format!("bound it: `--bound {}=0..10`, or an INVAR in the model", declared.name))
        }
        UnboundedKind::Choice => no_bound(unbounded.span, format!("the candidates of a choice are infinite ({place})"))
            .here("chooses among infinitely many")
            .with_help("choose from a finite domain or set"),
        UnboundedKind::Clock => no_bound(unbounded.span, "the model reads the clock".to_string())
            .here("the clock has infinitely many readings")
            .with_help("let a monitored function tell the time, and bound it"),
        UnboundedKind::Limit => {
            Diagnostic::error("limit-reached", unbounded.span, format!("a step reaches a limit ({place})"))
                .here("reached here")
                .with_help("if the model is right, raise the limit: `groundstate verify --help`")
        }
        UnboundedKind::Assumption => {
            let message = format!("an assumption has no value for some inputs ({place})");
            Diagnostic::error("assumption-without-value", unbounded.span, message)
                .here("cannot be evaluated")
                .with_help("say first where it can be: in `x != 0 and idiv(6, x) > 2` nothing is divided by 0")
        }
    }
}

fn no_bound(span: Span, message: String) -> Diagnostic {
    Diagnostic::error("no-bound", span, message)
}

/// `file:line:column` of the start of a span, the file without its folder.
pub fn short_place(sources: &Sources, span: Span) -> String {
    let file = sources.file(span.file);
    let start = file.line_column(span.start);
    let name = file.name.rsplit(['/', '\\']).next().unwrap_or(&file.name);
    format!("{name}:{}:{}", start.line, start.column)
}
