//! The results of `generate-tests`, as JSON objects.

use serde::Serialize;

use crate::Place;

/// `{"type":"goal",…}`: something to reach.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Goal<'a> {
    #[cfg_attr(test, schemars(extend("const" = "goal")))]
    r#type: &'static str,
    kind: &'static str,
    what: String,
    of: &'a str,
    at: Place,
    /// `reached`, `untested`, `unreachable` or `unknown`.
    outcome: &'static str,
}

impl<'a> Goal<'a> {
    /// A goal: its kind, which one of that kind, its rule, its place, and whether it is reached.
    pub fn new(kind: &'static str, what: &str, of: &'a str, at: Place, outcome: &'static str) -> Goal<'a> {
        Goal { r#type: "goal", kind, what: what.to_string(), of, at, outcome }
    }
}

/// `{"type":"generated",…}`: a scenario that was written.
#[derive(Debug, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Generated {
    #[cfg_attr(test, schemars(extend("const" = "generated")))]
    r#type: &'static str,
    path: String,
    steps: usize,
}

impl Generated {
    /// A scenario of this many steps at this path.
    pub fn new(path: String, steps: usize) -> Generated {
        Generated { r#type: "generated", path, steps }
    }
}
