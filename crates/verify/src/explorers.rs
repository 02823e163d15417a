//! Creates the explorers of a search, which all pack states in the same way.
//!
//! In: a program, the settings, and the widening from earlier attempts. Out: an explorer for each worker, all with the
//! initial states that the first one has made.

use std::sync::Arc;

use explore::{Explorer, Interner, Orbits, Settings, Starts, Trouble, Widening};
use machine::Interrupt;
use program::Program;

use crate::plan::Plan;

/// Creates explorers that pack states alike.
#[derive(Debug, Clone)]
pub(crate) struct Maker {
    pub program: Arc<Program>,
    settings: Settings,
    widening: Widening,
    pub interner: Arc<Interner>,
    /// The initial states, once an explorer has made them.
    starts: Option<Arc<Starts>>,
}

impl Maker {
    /// For explorers with room for what did not fit before.
    pub fn new(program: &Arc<Program>, plan: &Plan, widening: &Widening) -> Maker {
        let (settings, interner) = (plan.settings.clone(), Arc::default());
        Maker { program: Arc::clone(program), settings, widening: widening.clone(), interner, starts: None }
    }

    /// The same, where these values have numbers already.
    pub fn knowing(self, interner: Arc<Interner>) -> Maker {
        Maker { interner, ..self }
    }

    /// What did not fit before.
    #[cfg(test)]
    pub fn widening(&self) -> &Widening {
        &self.widening
    }

    /// The same with as much room as this gives; what values have numbers keep them.
    pub fn with_room(&self, widening: &Widening) -> Maker {
        Maker { widening: widening.clone(), starts: None, ..self.clone() }
    }

    /// The same with the initial states of an explorer that it might have made.
    pub fn beginning_with(self, explorer: &Explorer) -> Maker {
        Maker { starts: Some(explorer.starts()), ..self }
    }

    /// Makes explorers enumerate all alternatives, however long that takes.
    pub fn tireless(mut self) -> Maker {
        self.settings.interrupt = Interrupt::default();
        self
    }

    /// The first explorer, whose initial states the others use.
    pub fn first(&mut self) -> Result<Explorer, Trouble> {
        let explorer = self.explorer()?;
        self.starts = Some(explorer.starts());
        Ok(explorer)
    }

    /// An explorer of a program that has more terms and conditions, and otherwise is the same.
    pub fn of(&self, program: &Arc<Program>, settings: Settings) -> Result<Explorer, Trouble> {
        Maker { program: Arc::clone(program), settings, ..self.clone() }.explorer()
    }

    /// A further explorer.
    pub fn explorer(&self) -> Result<Explorer, Trouble> {
        let Maker { program, settings, widening, interner, starts } = self;
        Explorer::like(program, settings.clone(), widening, interner, starts.as_ref())
    }
}

/// The words of initial states, one state after the other. There may be a great many, so those of an explorer are not copied.
#[derive(Debug)]
pub(crate) enum Initial {
    /// All of them.
    All(Arc<Starts>),
    /// Others.
    Only(Vec<u64>),
}

impl Initial {
    /// No states.
    pub(crate) const NONE: Initial = Initial::Only(Vec::new());
}

impl std::ops::Deref for Initial {
    type Target = [u64];

    fn deref(&self) -> &[u64] {
        match self {
            Initial::All(starts) => starts.words(),
            Initial::Only(words) => words,
        }
    }
}

/// The initial states, up to interchangeable elements.
pub(crate) fn representatives(explorer: &mut Explorer, orbits: Option<&Orbits>) -> Initial {
    let Some(orbits) = orbits else { return Initial::All(explorer.starts()) };
    let mut starts = explorer.initial().words().to_vec();
    explorer.normalise(orbits, &mut starts);
    Initial::Only(starts)
}

/// Repeats a search, each time with room for what did not fit before.
pub(crate) fn widened<T>(mut attempt: impl FnMut(&Widening) -> Result<T, Trouble>) -> Result<T, Trouble> {
    let mut widening = Widening::default();
    loop {
        match attempt(&widening) {
            Err(Trouble::TooNarrow(more)) => widening.merge(&more),
            outcome => return outcome,
        }
    }
}
