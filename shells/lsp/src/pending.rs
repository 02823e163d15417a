//! Requests that have no answer yet, and whether an answer would still be for the text that was asked about.
//!
//! In: what the thread that reads messages knows at once: requests, cancellations, changes. Out: for the threads that answer,
//! whether they may. INVARIANT: each request is answered once: whoever takes it out of the table answers it.

use std::collections::BTreeMap;
use std::sync::Mutex;

use lsp_server::RequestId;

/// When something was asked: the number of changes of the text that it is about, and of all texts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Stamp {
    text: u64,
    all: u64,
}

/// See the module.
#[derive(Debug, Default)]
pub struct Pending(Mutex<Table>);

#[derive(Debug, Default)]
struct Table {
    open: BTreeMap<String, ()>,
    changes: BTreeMap<String, u64>,
    all: u64,
}

impl Pending {
    fn with<T>(&self, work: impl FnOnce(&mut Table) -> T) -> T {
        // A thread that panicked while it held the table has not broken it: each change of it is one step.
        work(&mut self.0.lock().unwrap_or_else(std::sync::PoisonError::into_inner))
    }

    /// A request came.
    pub fn open(&self, id: &RequestId) {
        self.with(|table| table.open.insert(id.to_string(), ()));
    }

    /// The request is taken to be answered; it was not before.
    pub fn take(&self, id: &RequestId) -> bool {
        self.with(|table| table.open.remove(&id.to_string()).is_some())
    }

    /// The request still waits.
    pub fn is_open(&self, id: &RequestId) -> bool {
        self.with(|table| table.open.contains_key(&id.to_string()))
    }

    /// The text at a path is another one.
    pub fn changed(&self, path: &str) {
        self.with(|table| {
            table.all += 1;
            *table.changes.entry(path.to_string()).or_default() = table.all;
        });
    }

    /// Now, for a question about a text.
    pub fn stamp(&self, path: &str) -> Stamp {
        self.with(|table| Stamp { text: table.changes.get(path).copied().unwrap_or_default(), all: table.all })
    }

    /// No text that the answer is about has changed since: the one at the path, or any where the answer is about all.
    pub fn is_present(&self, path: &str, stamp: Stamp, about_all: bool) -> bool {
        let now = self.stamp(path);
        if about_all { now.all == stamp.all } else { now.text == stamp.text }
    }
}
