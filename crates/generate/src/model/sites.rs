//! Numbers the places in the model where generated code may fault.

use std::collections::BTreeMap;

use syntax::Span;

/// The numbered places; 0 stands for no place.
#[derive(Debug, Clone, Default)]
pub(crate) struct Sites {
    spans: Vec<Span>,
    numbers: BTreeMap<Span, u32>,
}

impl Sites {
    /// The number of a place.
    pub fn number(&mut self, span: Span) -> u32 {
        *self.numbers.entry(span).or_insert_with(|| {
            self.spans.push(span);
            self.spans.len() as u32
        })
    }

    /// All places; the first has number 1.
    pub fn spans(&self) -> &[Span] {
        &self.spans
    }
}
