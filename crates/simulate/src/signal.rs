//! What a prompt may answer instead of a value.

/// What a user at a prompt may want instead of giving a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Signal {
    /// To take the last step back.
    Back,
    /// To end the run.
    Quit,
}
