//! Why there is no verdict: the recording and the model cannot be compared.

use syntax::{Diagnostic, Sources};

/// Why a recording cannot be compared with a model.
#[derive(Debug)]
pub enum Refusal {
    /// In words.
    Words(String),
    /// The model lacks what the replay calls.
    Model(Sources, Vec<Diagnostic>),
}

impl From<String> for Refusal {
    fn from(words: String) -> Refusal {
        Refusal::Words(words)
    }
}
