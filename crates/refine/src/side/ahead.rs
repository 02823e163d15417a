//! Steps that are made ahead of the search, by other threads.
//!
//! In: packed states whose steps the search will ask for, in the order in which it will. Out: their steps, if somebody has made them by then.
//! Workers leave the next few states to the search itself, so that neither waits for the other. INVARIANT: the search comes to the same
//! whoever makes the steps; whatever a worker is at ends with the search.

use std::collections::VecDeque;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use machine::{Cause, Interrupt};
use rustc_hash::FxHashMap;

use super::{Recipe, StateId, Stepper, Steps, Stopped};
use crate::joint::Bridge;

/// So many states are left to the search itself.
const NEAR: usize = 16;
/// So many are taken at a time.
const BATCH: usize = 16;
/// LIMIT: the steps of so many states wait for the search before workers wait, too: until half of them are taken.
const AHEAD: usize = 1 << 11;
/// So often the search looks whether a worker is ready before it waits.
const LOOKS: u32 = 64;
/// How often the search looks whether somebody wants it to end while it waits for a worker.
const LOOK: Duration = Duration::from_millis(20);

/// A state of one of the two machines.
type Task = (usize, StateId);

/// How far the steps of a state are.
enum Progress {
    /// Nobody has begun.
    Open(Box<[u64]>),
    Begun,
    Made(Result<Steps, Stopped>),
}

#[derive(Default)]
struct Board {
    tasks: FxHashMap<Task, Progress>,
    queue: VecDeque<Task>,
    /// How many are made and not yet asked for.
    made: usize,
    /// The search, or a worker, has ended.
    over: bool,
}

/// See the module.
#[derive(Default)]
pub(crate) struct Ahead {
    board: Mutex<Board>,
    /// Something was made, or may be.
    changed: Condvar,
    /// Ends what workers are at.
    interrupt: Interrupt,
}

impl Ahead {
    /// Nothing is to be made yet.
    pub fn new() -> Ahead {
        Ahead { interrupt: Interrupt::new(), ..Ahead::default() }
    }

    fn board(&self) -> MutexGuard<'_, Board> {
        self.board.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What ends the steps of workers.
    pub fn interrupt(&self) -> &Interrupt {
        &self.interrupt
    }

    /// The search will ask for the steps of a state.
    pub fn offer(&self, task: Task, state: &[u64]) {
        let mut board = self.board();
        let board = &mut *board;
        board.tasks.entry(task).or_insert_with(|| {
            board.queue.push_back(task);
            Progress::Open(state.into())
        });
        if board.queue.len() == NEAR + BATCH {
            self.changed.notify_one();
        }
    }

    /// The steps of a state, if a worker has made them, or is at it. None if the search has to make them itself.
    pub fn take(&self, task: Task, asked: &Interrupt) -> Option<Result<Steps, Stopped>> {
        let (mut board, mut looks) = (self.board(), 0);
        loop {
            match board.tasks.get(&task)? {
                Progress::Begun if !board.over && looks < LOOKS => {
                    // It will not be long.
                    drop(board);
                    std::thread::yield_now();
                    looks += 1;
                    board = self.board();
                }
                Progress::Begun if !board.over => {
                    let waited = self.changed.wait_timeout(board, LOOK);
                    board = waited.unwrap_or_else(PoisonError::into_inner).0;
                    if asked.is_raised() {
                        return Some(Err(Stopped::Interrupted));
                    }
                }
                Progress::Begun => return None,
                Progress::Open(_) | Progress::Made(_) => break,
            }
        }
        let progress = board.tasks.remove(&task);
        // What the search has made itself is no longer at the front.
        while board.queue.front().is_some_and(|front| !matches!(board.tasks.get(front), Some(Progress::Open(_)))) {
            board.queue.pop_front();
        }
        match progress {
            Some(Progress::Made(steps)) => {
                board.made -= 1;
                if board.made == AHEAD / 2 {
                    self.changed.notify_all();
                }
                Some(steps)
            }
            _ => None,
        }
    }

    /// The search has ended.
    pub fn end(&self) {
        self.board().over = true;
        self.interrupt.raise(Cause::Asked);
        self.changed.notify_all();
    }

    /// Notes the steps of a state.
    fn made(&self, task: Task, steps: Result<Steps, Stopped>) {
        let mut board = self.board();
        // Once it is over, what ended the steps may be that.
        if board.over {
            return;
        }
        if let Some(progress) = board.tasks.get_mut(&task) {
            *progress = Progress::Made(steps);
            board.made += 1;
        }
        drop(board);
        self.changed.notify_all();
    }

    /// Works until the search ends.
    pub fn work(&self, recipes: &[Recipe<'_>; 2]) {
        // The search goes on alone if a worker cannot.
        let _end = Ending(self);
        let Ok(mut steppers) = recipes.each_ref().map(Recipe::stepper).into_iter().collect::<Result<Vec<Stepper>, _>>()
        else {
            return;
        };
        let bridges: [&Bridge; 2] = recipes.each_ref().map(Recipe::bridge);
        while let Some(batch) = self.batch() {
            for (task, state) in batch {
                let steps = steppers[task.0].steps(&state, u64::MAX, bridges[task.0]);
                self.made(task, steps);
            }
        }
    }

    /// Some states that the search does not come to next; none if the search has ended.
    fn batch(&self) -> Option<Vec<(Task, Box<[u64]>)>> {
        let mut board = self.board();
        loop {
            if board.over {
                return None;
            }
            if board.made < AHEAD && board.queue.len() >= NEAR + BATCH {
                let taken: Vec<Task> = board.queue.drain(NEAR..NEAR + BATCH).collect();
                let begin = |task: Task| match board.tasks.get_mut(&task)? {
                    progress @ Progress::Open(_) => match std::mem::replace(progress, Progress::Begun) {
                        Progress::Open(state) => Some((task, state)),
                        Progress::Begun | Progress::Made(_) => None,
                    },
                    Progress::Begun | Progress::Made(_) => None,
                };
                return Some(taken.into_iter().filter_map(begin).collect());
            }
            board = self.changed.wait(board).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

/// Ends what is made ahead, also where a thread panics.
pub(crate) struct Ending<'a>(pub &'a Ahead);

impl Drop for Ending<'_> {
    fn drop(&mut self) {
        self.0.end();
    }
}
