//! What the run does between requests: it stops, says why, and what happened.
//!
//! In: what is heard of the session. Out: events of the protocol.

use std::sync::Arc;
use std::time::Duration;

use groundstate::machine::Show;
use groundstate::session::{Heard, Hit, Moment, Waits};
use groundstate::workspace::Files;
use serde_json::{Value, json};

use crate::adapter::{Adapter, Going};
use crate::breakpoints::Kind;
use crate::say::{TOLD, asks_for, whole};
use crate::variables::shortened;

/// LIMIT: what is heard between two requests. A run that says much waits, so that it can be paused.
const HEARD: usize = 1_000;

impl<F: Files> Adapter<F> {
    /// Looks what the run has done.
    pub fn look(&mut self) {
        for _ in 0..HEARD {
            let is_running = self.is_running();
            let Some(target) = self.target.as_mut().filter(|_| is_running) else { return };
            match target.session.hear(Duration::ZERO) {
                Heard::Nothing => return,
                Heard::Refused(reason) => {
                    let asks = target.session.is_asking();
                    self.output("stderr", &reason, Value::Null);
                    if asks {
                        self.stopped();
                    }
                }
                Heard::Said(id, text) => self.output("console", &shortened(&text), self.breakpoints.place(id)),
                Heard::Waits => self.stopped(),
                Heard::Gone => self.terminated(),
            }
        }
    }

    /// The run waits: says why, or goes on.
    fn stopped(&mut self) {
        let Some(going) = self.going.take() else { return };
        let Some(target) = &self.target else { return };
        let moment = target.session.moment();
        let waits = target.session.waits().clone();
        let (stops_on_entry, unwatched) =
            self.launch.as_ref().map_or((true, false), |launch| (launch.stop_on_entry, launch.no_debug));
        let hit = moment.as_ref().and_then(|moment| moment.hit.clone());
        if going == Going::Entry && waits == Waits::Step && hit.is_none() && !stops_on_entry {
            if self.go(Going::On).is_err() {
                self.terminated();
            }
            return;
        }
        self.tell(moment.as_deref());
        self.told.clone_from(&moment);
        let ended = moment.as_ref().is_some_and(|moment| moment.end.is_some());
        if ended && (hit.is_none() && going == Going::On || unwatched) {
            self.terminated();
            return;
        }
        let mut body = json!({ "threadId": 1, "allThreadsStopped": true });
        let (reason, description) = match (&waits, &hit) {
            (Waits::Input { .. }, _) => ("input", self.target().map(asks_for).unwrap_or_default()),
            (Waits::Choice { .. }, _) => ("choice", self.target().map(asks_for).unwrap_or_default()),
            (_, Some(Hit::Wrong)) => {
                let text = moment.as_ref().and_then(|moment| moment.faults.first()).map(whole).unwrap_or_default();
                body["text"] = json!(text);
                ("exception", text)
            }
            (_, Some(Hit::Breaks(ids))) => {
                body["hitBreakpointIds"] = json!(ids);
                match ids.first().and_then(|id| self.breakpoints.kind(*id)) {
                    Some(Kind::Data) => ("data breakpoint", "a location changed".to_string()),
                    Some(Kind::Rule) => ("function breakpoint", "the rule ran".to_string()),
                    Some(Kind::Line) | None => ("breakpoint", "a breakpoint was reached".to_string()),
                }
            }
            (Waits::End, None) => ("step", "the run has ended".to_string()),
            (_, None) if self.paused => ("pause", "paused".to_string()),
            (_, None) => match going {
                Going::Entry => ("entry", "the initial state".to_string()),
                Going::Rewind => ("entry", "no step is left that could be taken back".to_string()),
                Going::Step | Going::Back | Going::On => ("step", "a step".to_string()),
            },
        };
        (body["reason"], body["description"]) = (json!(reason), json!(description));
        self.event("stopped", body);
    }

    /// Writes out what happened.
    fn tell(&mut self, moment: Option<&Moment>) {
        let Some(moment) = moment else { return };
        let Some(target) = &self.target else { return };
        let program = Arc::clone(&target.scene.program);
        let former = self.told.as_ref();
        let mut lines: Vec<(&str, String, Value)> = Vec::new();
        if former.is_none_or(|told| told.step != moment.step) && !moment.changes.is_empty() {
            let changes: Vec<String> = moment
                .changes
                .iter()
                .take(TOLD)
                .map(|change| {
                    let (location, after) = (change.location.show(&program), change.after.show(&program).briefly());
                    format!("{location} := {after}")
                })
                .collect();
            lines.push(("console", shortened(&format!("step {}: {}", moment.step, changes.join(", "))), Value::Null));
        }
        let known = former.filter(|told| told.step == moment.step).map_or(0, |told| told.faults.len());
        for fault in moment.faults.iter().skip(if moment.end.is_some() { 0 } else { known }) {
            lines.push(("stderr", whole(fault), target.place(fault.primary.span)));
        }
        if let (Some(end), Some(script)) = (moment.end, &target.scene.script) {
            let (held, failed) = moment.checks;
            let word = end.replace('-', " ");
            let steps = moment.step;
            lines.push((
                "console",
                format!("{} {word}: {steps} steps, {held} checks held, {failed} failed", script.name),
                Value::Null,
            ));
        }
        for (category, text, place) in lines {
            self.output(category, &text, place);
        }
    }
}
