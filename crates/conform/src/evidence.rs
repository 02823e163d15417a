//! What a parting shows: the recorded events, what the model has instead, the state, the rule.

use syntax::Span;

use crate::recording::Event;

/// An event that a step of the model has.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claim {
    /// The component.
    pub task: String,
    /// What happens; its time is not looked at.
    pub event: Event,
    /// The rule whose update makes it.
    pub span: Span,
}

/// A recorded event with its task.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Recorded {
    /// The component.
    pub task: String,
    /// The event.
    pub event: Event,
}

/// Where a program and its model part.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Parted {
    /// The tick.
    pub tick: i64,
    /// The component.
    pub task: String,
    /// What was recorded; none if the model has an event that the program has not.
    pub event: Option<Event>,
    /// What the model has for the component at this point.
    pub claims: Vec<Claim>,
    /// Why, where the claims alone do not say it.
    pub reason: Option<String>,
    /// How many events agreed before.
    pub agreed: usize,
    /// The last events of all tasks before, oldest first.
    pub before: Vec<Recorded>,
    /// The model's state around it: locations and values.
    pub state: Vec<(String, String)>,
}

/// What a parting is about: the channels, or whatever else events name.
pub(crate) fn objects<'e>(event: Option<&'e Event>, claims: &'e [Claim]) -> Vec<&'e str> {
    event.into_iter().chain(claims.iter().map(|claim| &claim.event)).map(|event| event.object.as_str()).collect()
}

impl Event {
    /// Whether both say the same, whenever they happen.
    pub fn same(&self, other: &Event) -> bool {
        let key = |event: &Event| (event.number, event.array, event.next, event.fresh);
        self.kind == other.kind && self.object == other.object && key(self) == key(other)
    }

    /// The event in words: `writes camera_to_vs 3, array 1`.
    pub fn words(&self) -> String {
        let mut text = format!("{} {}", self.kind, self.object);
        match self.kind.as_str() {
            "begins" | "ends" | "passes" | "meets" | "misses" | "faults" => text += &format!(", cycle {}", self.number),
            "asks" | "enters" | "gives_up" | "releases" | "refuses" | "invalid" => {}
            _ => text += &format!(", number {}", self.number),
        }
        for (name, value) in [("array", self.array), ("next", self.next)] {
            if let Some(value) = value {
                text += &format!(", {name} {value}");
            }
        }
        match self.fresh {
            Some(true) => text += ", new",
            Some(false) => text += ", not new",
            None => {}
        }
        text
    }
}
