//! Requests that have no answer yet, and whether an answer would still be for the text that was asked about.
//!
//! In: what the thread that reads messages knows at once: requests, cancellations, changes. Out: for the threads that answer,
//! whether they may. INVARIANT: each request is answered once: whoever takes it out of the table answers it.

use std::collections::BTreeMap;
use std::sync::Mutex;

use lsp_server::RequestId;
use syntax::Stop;

/// When something was asked: the number of changes of the text that it is about, and of all texts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Stamp {
    text: u64,
    all: u64,
}

/// See the module.
#[derive(Debug, Default)]
pub struct Pending(Mutex<Table>, Stop);

/// What the worker is doing, by what it is no use any more to go on.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Work {
    /// Files that are open are checked: until a text changes.
    Check,
    /// Files that are not open are checked: until there is anything else to do.
    Background,
    /// A request is answered: until it is cancelled, or a text that the answer is about changes.
    Request {
        /// Which.
        id: RequestId,
        /// The file that it is about.
        path: String,
        /// The answer has places of other files.
        about_all: bool,
    },
}

#[derive(Debug, Default)]
struct Table {
    open: BTreeMap<String, ()>,
    changes: BTreeMap<String, u64>,
    all: u64,
    work: Option<Work>,
}

impl Pending {
    fn with<T>(&self, work: impl FnOnce(&mut Table) -> T) -> T {
        // A thread that panicked while it held the table has not broken it: each change of it is one step.
        work(&mut self.0.lock().unwrap_or_else(std::sync::PoisonError::into_inner))
    }

    /// One whose work can be stopped.
    pub fn new() -> Pending {
        Pending(Mutex::default(), Stop::new())
    }

    /// What work looks at.
    pub fn stop(&self) -> Stop {
        self.1.clone()
    }

    /// The worker begins something. `known` is the number of changes that it has taken in: if there are others, the work is of no use.
    pub fn begin(&self, work: Work, known: u64) {
        self.with(|table| {
            self.1.clear();
            if matches!(work, Work::Check | Work::Background) && table.all != known {
                self.1.ask();
            }
            table.work = Some(work);
        });
    }

    /// The worker has ended something; whether it was stopped.
    pub fn end(&self) -> bool {
        self.with(|table| {
            table.work = None;
            let stopped = self.1.is_asked();
            self.1.clear();
            stopped
        })
    }

    /// There is something to do.
    pub fn arrived(&self) {
        self.with(|table| {
            if table.work == Some(Work::Background) {
                self.1.ask();
            }
        });
    }

    /// A request is cancelled.
    pub fn cancelled(&self, cancelled: &RequestId) {
        self.with(|table| {
            if matches!(&table.work, Some(Work::Request { id, .. }) if id == cancelled) {
                self.1.ask();
            }
        });
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
            let of_no_use = match &table.work {
                Some(Work::Check | Work::Background) => true,
                Some(Work::Request { path: about, about_all, .. }) => *about_all || about == path,
                None => false,
            };
            if of_no_use {
                self.1.ask();
            }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_is_stopped_when_it_is_of_no_use() {
        let pending = Pending::new();
        let mut known = 0;
        let mut check = |work: Work, event: &dyn Fn(&Pending), stopped: bool| {
            pending.begin(work.clone(), known);
            event(&pending);
            assert_eq!(pending.end(), stopped, "{work:?}");
            known = pending.stamp("").all;
        };
        let request = |about_all| Work::Request { id: RequestId::from(1), path: "a".to_string(), about_all };
        check(Work::Check, &|_| {}, false);
        check(Work::Check, &|pending| pending.arrived(), false);
        check(Work::Check, &|pending| pending.changed("b"), true);
        check(Work::Background, &|pending| pending.arrived(), true);
        check(request(false), &|pending| pending.changed("b"), false);
        check(request(false), &|pending| pending.changed("a"), true);
        check(request(true), &|pending| pending.changed("b"), true);
        check(request(false), &|pending| pending.cancelled(&RequestId::from(1)), true);
        check(request(false), &|pending| pending.cancelled(&RequestId::from(2)), false);
        // What came before the work began is not taken in yet.
        pending.changed("a");
        check(Work::Check, &|_| {}, true);
        check(Work::Check, &|_| {}, false);
    }
}
