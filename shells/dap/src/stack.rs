//! The frames of a stop: in a scenario the command that comes next, then what the last step did, each with its place.
//!
//! An abstract state machine has no stack between two steps. The frames are the fault, the updates that changed something, those
//! that changed nothing, and the rules that ran, in this order; those that a breakpoint is on come first.

use groundstate::machine::Show;
use groundstate::session::{Moment, On, Waits};
use program::RuleId;
use serde_json::{Value, json};
use syntax::Span;

use crate::breakpoints::Breakpoints;
use crate::target::Target;

/// LIMIT: frames of a stop.
const FRAMES: usize = 500;

/// The frames.
pub fn frames(target: &Target, moment: Option<&Moment>, breakpoints: &Breakpoints) -> Vec<Value> {
    let mut places: Vec<(String, Span)> = Vec::new();
    let mut add = |name: String, span: Span| {
        if places.len() < FRAMES && !places.iter().any(|(_, known)| *known == span) {
            places.push((name, span));
        }
    };
    let scene = &target.scene;
    if let Waits::Choice { span, .. } = target.session.waits() {
        add("the choice that is asked for".to_string(), *span);
    }
    if let Some(moment) = moment {
        for fault in &moment.faults {
            add(fault.message.clone(), fault.primary.span);
            fault.secondary.iter().for_each(|label| add(label.text.clone(), label.span));
        }
        let of_rule = |span: Span| scene.rule_at(span).map(|(name, _)| format!(" in {name}")).unwrap_or_default();
        let is_hit = |rule: &RuleId| {
            let Some(groundstate::session::Hit::Breaks(ids)) = &moment.hit else { return false };
            let on = |id: &u64| breakpoints.on(*id);
            ids.iter().filter_map(on).any(|on| matches!(on, On::Rules(rules) if rules.contains(rule)))
        };
        let ran = |rule: &RuleId| {
            (
                format!(
                    "{}{}",
                    target.excerpt(scene.program.rule_span(*rule)),
                    of_rule(scene.program.rule_span(*rule))
                ),
                scene.program.rule_span(*rule),
            )
        };
        for rule in moment.ran.iter().filter(|rule| is_hit(rule)) {
            let (name, span) = ran(rule);
            add(name, span);
        }
        if let Some(next) = moment.next {
            add(format!("next: {}", target.excerpt(next)), next);
        }
        for change in &moment.changes {
            let location = change.location.show(&scene.program);
            let after = change.after.show(&scene.program).briefly();
            add(format!("{location} := {after}{}", of_rule(change.span)), change.span);
        }
        for span in &moment.idle {
            add(format!("{}{}, as it was", target.excerpt(*span), of_rule(*span)), *span);
        }
        for rule in &moment.ran {
            if let Some((name, span)) = scene.rule_at(scene.program.rule_span(*rule)) {
                add(format!("rule {name}"), span);
            }
        }
    }
    if let Some(span) = scene.main_place().filter(|_| places.is_empty()) {
        places.push(("the main rule".to_string(), span));
    }
    let frame = |(id, (name, span)): (usize, (String, Span))| {
        let mut frame = target.place(span);
        (frame["id"], frame["name"]) = (json!(id + 1), json!(name));
        frame
    };
    places.into_iter().enumerate().map(frame).collect()
}
