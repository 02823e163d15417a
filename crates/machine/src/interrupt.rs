//! A request to stop, from whoever waits for a long piece of work.
//!
//! In: a shell raises it from another thread (a signal, a time that is up, memory that is short). Out: work without an end in
//! sight looks at it now and then, and ends as soon as it can with what it has. INVARIANT: nothing
//! may be called complete that was cut off by it. It knows neither signals nor clocks.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU8, Ordering};

/// Why work is to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cause {
    /// Whoever waits has had enough.
    Asked,
    /// The process takes as much memory as it may.
    Memory,
}

/// See the module. The default is one that nobody can raise.
#[derive(Clone, Default)]
pub struct Interrupt(Option<Arc<AtomicU8>>);

/// The same whether it is raised or not, so that what is told of settings does not depend on it.
impl fmt::Debug for Interrupt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Interrupt")
    }
}

impl Interrupt {
    /// One that can be raised, by way of any of its clones.
    pub fn new() -> Interrupt {
        Interrupt(Some(Arc::default()))
    }

    /// Asks work to stop. Memory may be given back, so that of two causes having been asked is the one that stays.
    pub fn raise(&self, cause: Cause) {
        let Some(flag) = &self.0 else { return };
        match cause {
            Cause::Asked => flag.store(1 + cause as u8, Ordering::Relaxed),
            Cause::Memory => {
                let _ = flag.compare_exchange(0, 1 + cause as u8, Ordering::Relaxed, Ordering::Relaxed);
            }
        }
    }

    /// Memory was given back: work that begins now may go on, unless it was asked to stop.
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
