//! The two ways to compare a recording with a model.

/// How a recording is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// Each tick is a step.
    Timed,
    /// One task steps at a time.
    Untimed,
}

impl Way {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Way::Timed => "tick by tick",
            Way::Untimed => "by the order of events",
        }
    }

    /// What a number of steps is one of, in words.
    pub fn steps(self) -> &'static str {
        match self {
            Way::Timed => "steps of the model",
            Way::Untimed => "steps of single tasks of the model",
        }
    }
}
