//! A request for a verification.
//!
//! In: a program, [`Options`] and further wishes. Out: a [`Request`] that can be carried out, or the [`Conflict`]
//! between two parts. INVARIANT: a request that was built has no conflict, so shells need not check for any.

use explore::checkpoint::Keeper;
use std::fmt;
use std::sync::Arc;

use machine::Interrupt;
use program::Program;
use solve::session::{Session, Silence, Solvers};

use crate::check::verify_request;
use crate::heed::Listener;
use crate::options::{EngineKind, Options};
use crate::progress::Progress;
use crate::report::{NoStart, Report};
use crate::storage::Storage;
use crate::temporal::fairness::AgentFairness;

/// A part of a request that not every engine supports, or that excludes another part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// [`Options::first`].
    First,
    /// [`Options::max_states`].
    MaxStates,
    /// [`Options::max_depth`].
    MaxDepth,
    /// [`Options::partial_order`].
    PartialOrder,
    /// [`Options::symmetry`].
    Symmetry,
    /// A lossy [`Options::storage`].
    Storage,
    /// A [`Keeper`].
    Checkpoint,
    /// [`Options::disk`].
    Disk,
}

/// All parts, in the order in which conflicts are checked.
const PARTS: [Part; 8] = [
    Part::First,
    Part::MaxStates,
    Part::MaxDepth,
    Part::PartialOrder,
    Part::Symmetry,
    Part::Storage,
    Part::Checkpoint,
    Part::Disk,
];

/// Parts that exclude each other.
const APART: [(Part, Part); 5] = [
    (Part::Symmetry, Part::PartialOrder),
    (Part::Checkpoint, Part::Symmetry),
    (Part::Checkpoint, Part::Storage),
    (Part::Disk, Part::Storage),
    (Part::Disk, Part::Checkpoint),
];

/// Why a request cannot be carried out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Conflict {
    /// The chosen engine does not support this part.
    Engine(Part, EngineKind),
    /// These two parts exclude each other.
    Parts(Part, Part),
}

impl fmt::Display for Conflict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Conflict::Engine(part, engine) => write!(f, "{part:?} does not work with the engine {engine:?}"),
            Conflict::Parts(one, other) => write!(f, "{one:?} and {other:?} cannot be combined"),
        }
    }
}

impl std::error::Error for Conflict {}

/// A request under construction.
#[derive(Debug, Clone)]
pub struct RequestBuilder(Request);

/// A request without conflicts.
#[derive(Debug, Clone)]
pub struct Request {
    program: Arc<Program>,
    options: Options,
    agents: Option<AgentFairness>,
    kept: bool,
}

impl RequestBuilder {
    /// Assumes in temporal properties that the main rule's choice of who moves is fair.
    pub fn fair(mut self, agents: Option<AgentFairness>) -> RequestBuilder {
        self.0.agents = agents;
        self
    }

    /// Whether to keep the search when a limit ends it, and to resume it; then [`Request::verify_kept`] carries it out.
    pub fn kept(mut self, kept: bool) -> RequestBuilder {
        self.0.kept = kept;
        self
    }

    /// The request.
    ///
    /// # Errors
    /// Two of its parts exclude each other.
    pub fn build(self) -> Result<Request, Conflict> {
        let RequestBuilder(request) = self;
        let engine = request.options.engine;
        if let Some(part) = PARTS.into_iter().find(|part| request.asks(*part) && !has(engine, *part)) {
            return Err(Conflict::Engine(part, engine));
        }
        match APART.into_iter().find(|(one, other)| request.asks(*one) && request.asks(*other)) {
            Some((one, other)) => Err(Conflict::Parts(one, other)),
            None => Ok(request),
        }
    }
}

/// Whether an engine supports a part.
fn has(engine: EngineKind, part: Part) -> bool {
    match part {
        // Symbolic search does not proceed level by level, and its size has no bound that a user could give.
        Part::First | Part::MaxStates | Part::MaxDepth => engine != EngineKind::Symbolic,
        Part::PartialOrder | Part::Symmetry | Part::Storage | Part::Checkpoint | Part::Disk => {
            matches!(engine, EngineKind::Automatic | EngineKind::Explicit)
        }
    }
}

impl Request {
    /// Begins a request.
    pub fn of(program: &Arc<Program>, options: Options) -> RequestBuilder {
        RequestBuilder(Request { program: Arc::clone(program), options, agents: None, kept: false })
    }

    /// The same request with another interrupt.
    #[must_use]
    pub fn interrupted_by(mut self, interrupt: Interrupt) -> Request {
        self.options.interrupt = interrupt;
        self
    }

    fn asks(&self, part: Part) -> bool {
        let Options { first, max_states, max_depth, partial_order, symmetry, storage, disk, .. } = &self.options;
        match part {
            Part::First => *first,
            Part::MaxStates => *max_states < u64::MAX,
            Part::MaxDepth => *max_depth < u64::MAX,
            Part::PartialOrder => *partial_order,
            Part::Symmetry => *symmetry,
            Part::Storage => *storage != Storage::Exact,
            Part::Checkpoint => self.kept,
            Part::Disk => disk.is_some(),
        }
    }

    /// Carries out the request. The listener receives progress and violations, and may end the search. SMT solvers are
    /// asked if the engine needs one.
    ///
    /// # Errors
    /// There is no initial state, or a solver cannot be asked.
    ///
    /// # Panics
    /// The request is for a search that is kept.
    pub fn verify(&self, solvers: &mut dyn Solvers, listener: &mut dyn Listener) -> Result<Report, NoStart> {
        assert!(!self.kept, "a search that is to be kept needs who keeps it");
        verify_request(&self.program, &self.options, self.agents, solvers, None, listener)
    }

    /// Carries out the request with a search that is resumed if possible and kept if a limit ends it.
    ///
    /// # Errors
    /// There is no initial state, a solver cannot be asked, or the checkpoint does not fit.
    ///
    /// # Panics
    /// The request is not for a search that is kept.
    pub fn verify_kept(
        &self,
        solvers: &mut dyn Solvers,
        keeper: &mut dyn Keeper,
        listener: &mut dyn Listener,
    ) -> Result<Report, NoStart> {
        assert!(self.kept, "the request was built without a keeper");
        verify_request(&self.program, &self.options, self.agents, solvers, Some(keeper), listener)
    }
}

/// Verifies a program by exploring states, without a solver; `watch` receives progress and tells whether to go on.
///
/// # Errors
/// There is no initial state.
pub fn verify(
    program: &Arc<Program>,
    options: &Options,
    mut watch: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Report, NoStart> {
    verify_request(program, options, None, &mut NoSolvers, None, &mut watch)
}

/// No solver at all.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoSolvers;

impl Solvers for NoSolvers {
    fn name(&self) -> Result<String, String> {
        Err("no solver may be asked".to_string())
    }

    fn start(&mut self) -> Result<Box<dyn Session>, Silence> {
        Err(Silence::Broken("no solver may be asked".to_string()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solver::Method;

    fn check(options: Options, kept: bool, expect: Result<(), Conflict>) {
        let program = Arc::new(Program::default());
        assert_eq!(Request::of(&program, options).kept(kept).build().map(|_| ()), expect);
    }

    #[test]
    fn what_does_not_go_together_is_refused() {
        let with = |engine| Options { engine, ..Options::default() };
        check(with(EngineKind::Automatic), true, Ok(()));
        check(Options { first: true, max_states: 7, ..with(EngineKind::Explicit) }, false, Ok(()));
        check(Options { max_depth: 7, ..with(EngineKind::Solver(Method::Bounded)) }, false, Ok(()));
        let sets = EngineKind::Symbolic;
        check(Options { first: true, ..with(sets) }, false, Err(Conflict::Engine(Part::First, sets)));
        check(Options { max_depth: 7, ..with(sets) }, false, Err(Conflict::Engine(Part::MaxDepth, sets)));
        let solver = EngineKind::Solver(Method::Induction);
        check(Options { symmetry: true, ..with(solver) }, false, Err(Conflict::Engine(Part::Symmetry, solver)));
        check(with(solver), true, Err(Conflict::Engine(Part::Checkpoint, solver)));
        let both = Options { symmetry: true, partial_order: true, ..Options::default() };
        check(both, false, Err(Conflict::Parts(Part::Symmetry, Part::PartialOrder)));
        let less = Options { storage: Storage::Compact, ..Options::default() };
        check(less.clone(), false, Ok(()));
        check(less, true, Err(Conflict::Parts(Part::Checkpoint, Part::Storage)));
    }
}
