//! How a run of ours and a recorded one part.

use syntax::Span;

use super::trace::End;

/// What is not the same.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum What {
    /// A location listed has another value here.
    Value {
        /// The location.
        location: String,
        /// Recorded.
        theirs: String,
        /// Here.
        ours: String,
    },
    /// The step changed a location here that the record does not list.
    Written {
        /// The location.
        location: String,
        /// Its value here.
        ours: String,
    },
    /// The step is a fault here.
    Fault {
        /// The kind of fault.
        id: String,
        /// Its sentence and place.
        text: String,
        /// Its place in the model.
        span: Span,
        /// How the record goes on: the end, or none where the step was made.
        theirs: Option<End>,
    },
    /// The record ends here with a fault, a clash or a violation; ours goes on.
    GoesOn {
        /// How it ends there.
        theirs: End,
    },
    /// An invariant does not hold here.
    Violation {
        /// Its name.
        name: String,
        /// How the record goes on.
        theirs: Option<End>,
    },
    /// An input was asked for that the record does not have.
    Beyond {
        /// The location.
        location: String,
    },
}

/// A difference and where it shows.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Difference {
    /// The step, 0 for the initial state.
    pub step: usize,
    /// What.
    pub what: What,
}

impl Difference {
    /// The difference in one line.
    pub fn line(&self) -> String {
        let step = self.step;
        match &self.what {
            What::Value { location, theirs, ours } => {
                format!("step {step}: `{location}` is {} there, {} here", short(theirs), short(ours))
            }
            What::Written { location, ours } => format!("step {step}: `{location}` becomes {} here alone", short(ours)),
            What::Fault { text, theirs, .. } => {
                format!("step {step}: here {}; there {}", short(text), end(theirs.as_ref()))
            }
            What::GoesOn { theirs } => format!("step {step}: here it continues; there {}", end(Some(theirs))),
            What::Violation { name, theirs } => {
                format!("step {step}: here `{name}` is violated; there {}", end(theirs.as_ref()))
            }
            What::Beyond { location } => format!("step {step}: the input `{location}` is asked for here alone"),
        }
    }
}

fn end(end: Option<&End>) -> String {
    match end {
        Some(end) => short(&format!("{} {} {}", end.status, end.class, end.message)),
        None => "it continues".to_string(),
    }
}

/// A text cut to the length of a line.
pub fn short(text: &str) -> String {
    const LENGTH: usize = 110;
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    if text.chars().count() <= LENGTH {
        return text;
    }
    text.chars().take(LENGTH).chain(['…']).collect()
}
