//! Runs the symbolic engine in a thread of its own.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use explore::{Trouble, Widening};
use program::Program;

use crate::engine::{Ended, Engine, Task};
use crate::explorers::widened;
use crate::options::EngineKind;
use crate::plan::Plan;
use crate::progress::{Progress, Stop};
use crate::report::NoStart;
use crate::symbolic::reach::Reach;

/// The symbolic engine: explores all states at once, as sets.
pub(crate) struct Symbolic;

impl Engine for Symbolic {
    fn run(&self, task: Task<'_, '_, '_>) -> Result<Ended, NoStart> {
        let Task { program, plan, heed, .. } = task;
        let ended = widened(|widening| apart(program, plan, widening, &mut |progress| heed.at(progress)))?;
        Ok(ended.judged(program, plan))
    }
}

/// Runs the symbolic search in its own thread, because an operation on sets cannot be interrupted. LIMIT: if the caller
/// asks to stop, the thread is abandoned after a moment, and its findings are lost.
///
/// INVARIANT: no thread ever has two managers of diagrams, and everything that belongs to a manager is dropped in its
/// thread. For each thread, the library keeps places for new nodes that it has taken from a manager, and identifies the
/// manager only by its address. A thread that moved on to another manager at the same address would overwrite nodes.
fn apart(
    program: &Arc<Program>,
    plan: &Plan,
    widening: &Widening,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Ended, Trouble> {
    let (sender, news) = channel();
    let widening = widening.clone();
    let goes_on = Arc::new(AtomicBool::new(true));
    let (program, thread_plan, asked) = (Arc::clone(program), plan.clone(), Arc::clone(&goes_on));
    let body = move || {
        let mut told = |progress: &Progress| {
            // The caller may be gone.
            let _ = sender.send(News::Progress(*progress));
            asked.load(Ordering::Relaxed)
        };
        let ended = by_sets(&program, &thread_plan, &widening, &mut told);
        let _ = sender.send(News::Ended(Box::new(ended)));
    };
    let thread = std::thread::Builder::new().stack_size(STACK).spawn(body).expect("a thread can be made");
    let (mut progress, mut waited) = (Progress::default(), 0);
    loop {
        match news.recv_timeout(BETWEEN) {
            Ok(News::Progress(further)) => progress = further,
            Ok(News::Ended(ended)) => return *ended,
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => match thread.join() {
                Err(panic) => std::panic::resume_unwind(panic),
                Ok(()) => unreachable!("it sends what it came to before it ends"),
            },
        }
        if !watch(&progress) {
            goes_on.store(false, Ordering::Relaxed);
        }
        let cause = plan.settings.interrupt.cause();
        let stop = cause.map(Stop::from).or((!goes_on.load(Ordering::Relaxed)).then_some(Stop::Asked));
        waited += u32::from(stop.is_some());
        if stop.is_some() && waited > GRACE {
            return Ok(Ended { stop, progress, ..Ended::without_states(EngineKind::Symbolic) });
        }
    }
}

/// A message of the search thread.
enum News {
    Progress(Progress),
    Ended(Box<Result<Ended, Trouble>>),
}

/// How often the caller's wish to stop is checked.
const BETWEEN: Duration = Duration::from_millis(50);
/// LIMIT: after this many checks, the operation on sets is abandoned.
const GRACE: u32 = 20;
/// Operations on sets recurse as deeply as there are variables, along trees of steps.
const STACK: usize = 256 << 20;

fn by_sets(
    program: &Arc<Program>,
    plan: &Plan,
    widening: &Widening,
    watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Ended, Trouble> {
    let mut reach = Reach::attempt(program, plan, widening, watch)?;
    let traces = reach.traces();
    Ok(Ended {
        found: reach.found.iter().map(|found| found.target).zip(traces).collect(),
        stop: reach.stop,
        progress: reach.progress,
        width: reach.width(),
        executed: reach.executed(),
        unbounded: reach.unbounded,
        unknown: reach.unknown,
        ..Ended::without_states(EngineKind::Symbolic)
    })
}
