//! A request to stop reading or checking a text, from another thread.
//!
//! In: whoever waits asks for it. Out: parsing and checking look at it now and then, and end as soon as they can. INVARIANT: what was
//! stopped gives nothing that may be used: whoever started it looks at the flag afterwards, and throws the result away.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// See the module. The default is one that nobody can ask.
#[derive(Clone, Default)]
pub struct Stop(Option<Arc<Flag>>);

struct Flag {
    /// How often it was looked at since it was cleared.
    looks: AtomicU64,
    /// The look from which on work is to stop.
    at: AtomicU64,
}

/// The same whether it is asked or not: results do not depend on it.
impl fmt::Debug for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Stop")
    }
}

impl Stop {
    /// One that can be asked, by way of any of its clones.
    pub fn new() -> Stop {
        Stop(Some(Arc::new(Flag { looks: AtomicU64::new(0), at: AtomicU64::new(u64::MAX) })))
    }

    /// Asks work to stop.
    pub fn ask(&self) {
        self.ask_after(0);
    }

    /// Asks work to stop after it has looked so often: the same at each run, for tests.
    pub fn ask_after(&self, looks: u64) {
        if let Some(flag) = &self.0 {
            flag.at.store(looks, Ordering::Relaxed);
        }
    }

    /// New work may begin.
    pub fn clear(&self) {
        if let Some(flag) = &self.0 {
            flag.at.store(u64::MAX, Ordering::Relaxed);
            flag.looks.store(0, Ordering::Relaxed);
        }
    }

    /// Whether work is to stop. Work calls this.
    pub fn is_asked(&self) -> bool {
        self.0
            .as_ref()
            .is_some_and(|flag| flag.looks.fetch_add(1, Ordering::Relaxed) >= flag.at.load(Ordering::Relaxed))
    }

    /// How often work has looked since it could begin.
    pub fn looks(&self) -> u64 {
        self.0.as_ref().map_or(0, |flag| flag.looks.load(Ordering::Relaxed))
    }
}
