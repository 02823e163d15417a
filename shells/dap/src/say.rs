//! Sentences for whoever debugs: what is wrong, and what is asked for.

use groundstate::session::Waits;
use syntax::Diagnostic;

use crate::target::Target;
use crate::variables::candidate;

/// LIMIT: changes and faults that are written out at a stop.
pub const TOLD: usize = 50;

/// A fault with its reason.
pub fn whole(fault: &Diagnostic) -> String {
    match fault.primary.text.as_str() {
        "" => fault.message.clone(),
        reason => format!("{}: {reason}", fault.message),
    }
}

/// What is asked for, and how it is given.
pub fn asks_for(target: &Target) -> String {
    let program = &target.scene.program;
    match target.session.waits() {
        Waits::Input { location, .. } => {
            let name = location.show(program);
            format!("{name} is asked for: set it among the variables, or type `{name} := VALUE`, and go on")
        }
        Waits::Choice { candidates, .. } => {
            let some: Vec<String> = candidates.iter().take(10).map(|values| candidate(target, values)).collect();
            let more = if candidates.len() > 10 { ", …" } else { "" };
            let some = some.join(" | ");
            format!(
                "a choice is asked for ({some}{more}): set `choice` among the variables, or type `choice := …`, and go on"
            )
        }
        Waits::Runs | Waits::Step | Waits::End => String::new(),
    }
}
