//! The state at the cursor: what a session on a model or a scenario tells an editor after each request (docs/editors.md).
//!
//! In: events of a run, and the shell's own way to write a place. Out: [`SessionState`]. Values and locations are written as in
//! AsmetaL. It must not know the editor's protocol.

use machine::{Change, Location, Show, Value};
use program::Program;
use serde::Serialize;
use syntax::{Diagnostic, Span};

use crate::trace::Pairs;

/// The version of the requests and of their answers. A change that would mislead an editor raises it.
pub const SESSION_VERSION: u32 = 1;

/// What a session waits for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum Waiting {
    /// For a step to be asked for.
    #[default]
    Step,
    /// For the value of an input.
    Input,
    /// For a choice.
    Choice,
    /// For nothing: the run has ended, and can only be taken back.
    Nothing,
}

/// The answer to every request of a session; `P` is how the shell writes a place.
#[derive(Debug, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct SessionState<P> {
    /// [`SESSION_VERSION`].
    pub version: u32,
    /// Which session.
    pub session: u64,
    /// How many steps have been made.
    pub step: u64,
    /// What it waits for.
    pub waiting: Waiting,
    /// Why the run ended, in one word; or what it asks for: the location, or the values of a choice's variables.
    pub word: Option<String>,
    /// What may be given: values of the input, or the candidates of the choice in their order.
    pub offered: Vec<String>,
    /// The least and the greatest value of the input, if its domain is all integers between them.
    pub bounds: Option<[i64; 2]>,
    /// The choice that is to be made.
    pub at: Option<P>,
    /// The state: location and value.
    pub state: Pairs<String>,
    /// What the last step changed, each with the update that wrote it.
    pub updates: Vec<Written<P>>,
    /// Updates that the last step made and that changed nothing.
    pub unchanged: Vec<P>,
    /// The declared rules that ran in it.
    pub rules: Vec<Named<P>>,
    /// What is wrong: a clash with both updates, a violated invariant, another fault.
    pub faults: Vec<Wrong<P>>,
    /// Of a scenario: the command that comes next.
    pub next: Option<P>,
    /// The request could not be carried out; a sentence.
    pub refused: Option<String>,
    /// A text has changed since the session was opened: places are those of the former text.
    pub stale: bool,
}

/// An update that changed a location.
#[derive(Debug, Clone, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Written<P> {
    location: String,
    before: String,
    after: String,
    at: P,
}

impl<P> Written<P> {
    /// A change, with the place of its update.
    pub fn new(change: &Change, program: &Program, at: P) -> Written<P> {
        Written {
            location: change.location.show(program).to_string(),
            before: change.before.show(program).briefly().to_string(),
            after: change.after.show(program).briefly().to_string(),
            at,
        }
    }
}

/// A rule by its name.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Named<P> {
    /// The name.
    pub name: String,
    /// Where it is declared.
    pub at: P,
}

/// A fault and the other places that matter.
#[derive(Debug, Clone, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Wrong<P> {
    id: &'static str,
    message: String,
    at: P,
    related: Vec<Related<P>>,
}

/// A place that has to do with a fault.
#[derive(Debug, Clone, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Related<P> {
    text: String,
    at: P,
}

impl<P> Wrong<P> {
    /// A fault, if its place can be written.
    pub fn new(fault: &Diagnostic, place: &dyn Fn(Span) -> Option<P>) -> Option<Wrong<P>> {
        let related = fault
            .secondary
            .iter()
            .filter_map(|label| Some(Related { text: label.text.clone(), at: place(label.span)? }));
        let message = match fault.primary.text.as_str() {
            "" => fault.message.clone(),
            reason => format!("{}: {reason}", fault.message),
        };
        Some(Wrong { id: fault.id, message, at: place(fault.primary.span)?, related: related.collect() })
    }
}

/// A state as it is written.
pub fn written_state(state: &[(Location, Value)], program: &Program) -> Pairs<String> {
    let shown = |(location, value): &(Location, Value)| {
        (location.show(program).to_string(), value.show(program).briefly().to_string())
    };
    state.iter().map(shown).collect()
}
