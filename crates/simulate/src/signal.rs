//! What a prompt may answer instead of a value.

/// What a user at a prompt may want instead of giving a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Signal {
    /// To take the last step back.
    Back,
    /// To leave the step that is being made, and to be before it again.
    Abandon,
    /// To end the run.
    Quit,
}
