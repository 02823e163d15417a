//! A request to stop long work.
//!
//! In: a shell raises it from another thread, because of a signal, a limit of time, or a lack of memory. Out: long work
//! checks it regularly and ends as soon as it can, with the result so far. INVARIANT: work that it ended is never reported
//! as complete. It knows neither signals nor clocks.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

/// Why work is to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cause {
    /// The user asked for it.
    Asked,
    /// The process takes as much memory as it may.
    Memory,
}

/// See the module. Nobody can raise the default.
#[derive(Clone, Default)]
pub struct Interrupt(Option<Arc<AtomicU8>>);

/// Always the same text, so that the text of settings does not depend on whether it is raised.
impl fmt::Debug for Interrupt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Interrupt")
    }
}

impl Interrupt {
    /// A request that each of its clones can raise.
    pub fn new() -> Interrupt {
        Interrupt(Some(Arc::default()))
    }

    /// Asks work to stop. Memory may become free again, so of two causes the user's request stays.
    pub fn raise(&self, cause: Cause) {
        let Some(flag) = &self.0 else { return };
        match cause {
            Cause::Asked => flag.store(1 + cause as u8, Ordering::Relaxed),
            Cause::Memory => {
                let _ = flag.compare_exchange(0, 1 + cause as u8, Ordering::Relaxed, Ordering::Relaxed);
            }
        }
    }

    /// Memory is free again: work that begins now may go on, unless the user asked to stop.
    pub fn relieve(&self) {
        if let Some(flag) = &self.0 {
            let memory = 1 + Cause::Memory as u8;
            let _ = flag.compare_exchange(memory, 0, Ordering::Relaxed, Ordering::Relaxed);
        }
    }

    /// Whether work is to stop.
    #[inline]
    pub fn is_raised(&self) -> bool {
        self.0.as_ref().is_some_and(|flag| flag.load(Ordering::Relaxed) != 0)
    }

    /// Why work is to stop, if it is.
    pub fn cause(&self) -> Option<Cause> {
        match self.0.as_ref()?.load(Ordering::Relaxed) {
            0 => None,
            1 => Some(Cause::Asked),
            _ => Some(Cause::Memory),
        }
    }
}
