//! The engine that asks an SMT solver.

use crate::engine::{Ended, Engine, Task};
use crate::options::EngineKind;
use crate::progress::Progress;
use crate::report::NoStart;
use crate::solver::method::Method;
use crate::solver::{Unsolved, solve};

/// Proves what it can and searches for runs, by this method.
pub(crate) struct BySolver(pub Method);

impl Engine for BySolver {
    fn run(&self, task: Task<'_, '_, '_>) -> Result<Ended, NoStart> {
        let Task { program, plan, solvers, heed, .. } = task;
        let BySolver(method) = *self;
        let solved =
            solve(program, plan, method, solvers, &mut |progress| heed.at(progress)).map_err(
                |unsolved| match unsolved {
                    Unsolved::Outside(outside) => NoStart::Outside(outside),
                    Unsolved::Trouble(trouble) => NoStart::from(trouble),
                    Unsolved::NoSolver(reason) => NoStart::NoSolver(reason),
                },
            )?;
        let progress = Progress { depth: solved.depth, ..Progress::default() };
        let mut ended = Ended { progress, ..Ended::without_states(EngineKind::Solver(method)) };
        ended.take(Some(solved));
        Ok(ended)
    }
}
