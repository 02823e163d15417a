//! Explorers of one search, which pack states alike.
//!
//! In: a program, the settings, what did not fit before. Out: as many explorers as there are workers, all with the initial states
//! that the first has made.

use std::sync::Arc;

use explore::{Explorer, Interner, Orbits, Settings, Starts, Trouble, Widening};
use machine::Interrupt;
use program::Program;

use crate::plan::Plan;

/// Makes explorers that pack states alike.
#[derive(Debug, Clone)]
pub(crate) struct Maker {
    pub program: Arc<Program>,
    settings: Settings,
    widening: Widening,
    pub interner: Arc<Interner>,
    /// The initial states, once some explorer has made them.
    starts: Option<Arc<Starts>>,
}

impl Maker {
    /// Of explorers with room for what did not fit.
    pub fn new(program: &Arc<Program>, plan: &Plan, widening: &Widening) -> Maker {
        let (settings, interner) = (plan.settings.clone(), Arc::default());
        Maker { program: Arc::clone(program), settings, widening: widening.clone(), interner, starts: None }
    }

    /// One of explorers that go through all alternatives however long that takes.
    pub fn tireless(mut self) -> Maker {
        self.settings.interrupt = Interrupt::default();
        self
    }

    /// The first one, whose initial states the others take.
    pub fn first(&mut self) -> Result<Explorer, Trouble> {
        let explorer = self.explorer()?;
        self.starts = Some(explorer.starts());
        Ok(explorer)
    }

    /// One more.
    pub fn explorer(&self) -> Result<Explorer, Trouble> {
        let Maker { program, settings, widening, interner, starts } = self;
        Explorer::like(program, settings.clone(), widening, interner, starts.as_ref())
    }
}

/// The initial states, up to interchangeable elements.
pub(crate) fn representatives(explorer: &mut Explorer, orbits: Option<&Orbits>) -> Vec<u64> {
    let mut starts = Vec::with_capacity(explorer.initial().len() * explorer.words());
    explorer.initial().iter().for_each(|(state, _)| starts.extend_from_slice(state));
    if let Some(orbits) = orbits {
        explorer.normalise(orbits, &mut starts);
    }
    starts
}

/// Attempts a search again and again, each time with room for what did not fit the time before.
pub(crate) fn widened<T>(mut attempt: impl FnMut(&Widening) -> Result<T, Trouble>) -> Result<T, Trouble> {
    let mut widening = Widening::default();
    loop {
        match attempt(&widening) {
            Err(Trouble::TooNarrow(more)) => widening.merge(&more),
            outcome => return outcome,
        }
    }
}
