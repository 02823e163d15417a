//! Measures the time of each judgement, and ends all of them when the command is interrupted.
//!
//! In: the limit. Out: interrupts, raised by one thread that looks at all of them now and then.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError, Weak};
use std::thread::{ThreadId, current};
use std::time::{Duration, Instant};

use groundstate::mutation::Timer;
use machine::{Cause, Interrupt};

use crate::interrupt;

/// How often the thread looks.
const BETWEEN: Duration = Duration::from_millis(10);

/// The judgements that are going on: who judges, what ends it, and when.
#[derive(Debug)]
pub struct Clock {
    limit: Duration,
    running: Mutex<Vec<(ThreadId, Interrupt, Instant)>>,
}

impl Clock {
    /// A clock with its thread, which ends when nobody has the clock any more.
    pub fn start(limit: Duration) -> Arc<Clock> {
        let clock = Arc::new(Clock { limit, running: Mutex::default() });
        let weak: Weak<Clock> = Arc::downgrade(&clock);
        std::thread::spawn(move || {
            while let Some(clock) = weak.upgrade() {
                clock.look();
                drop(clock);
                std::thread::sleep(BETWEEN);
            }
        });
        clock
    }

    fn running(&self) -> MutexGuard<'_, Vec<(ThreadId, Interrupt, Instant)>> {
        self.running.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn look(&self) {
        let (now, request) = (Instant::now(), interrupt::request());
        for (_, interrupt, end) in self.running().iter() {
            match request.cause() {
                Some(cause) => interrupt.raise(cause),
                None if *end <= now => interrupt.raise(Cause::Asked),
                None => {}
            }
        }
    }
}

impl Timer for Clock {
    fn begin(&self) -> Interrupt {
        let interrupt = Interrupt::new();
        self.running().push((current().id(), interrupt.clone(), Instant::now() + self.limit));
        interrupt
    }

    fn end(&self, _interrupt: &Interrupt) {
        // A thread judges one mutant at a time.
        let own = current().id();
        self.running().retain(|(thread, ..)| *thread != own);
    }
}
