//! Who makes the steps of a state: the tree of decisions, machine code, or the machine.
//!
//! In: how often the tree did not know a state's steps. Out: whether they are compiled, and the tree is given up. A walk of the
//! tree costs a tenth of a compiled step, a step that the machine makes for the tree to learn fifty compiled ones; so a tree that has
//! learned much and still misses one state in sixteen loses. INVARIANT: no maker gives other steps than another.

use machine::EngineChoice;

use crate::compiled::Compiled;
use crate::explorer::Explorer;

/// LIMIT: misses of the tree before it is judged for the first time. Compiling takes as long as the machine takes for about so
/// many steps, whatever the size of the program.
const PATIENCE: u64 = 1 << 13;
/// The smallest share of misses by which a tree loses is one in so many.
const RARELY: u64 = 16;

/// Machine code, as far as it has come; and the tree's record since it was last judged.
#[derive(Debug, Default)]
pub(crate) struct Makers {
    pub compiled: Option<Box<Compiled>>,
    tried: bool,
    /// Of how many states it has made the steps.
    pub made: u64,
    misses: u64,
    states: u64,
    /// The misses at which the tree is judged next; 0 before the first time.
    due: u64,
}

impl Makers {
    /// Whether the tree, which has just missed a state, should give way.
    fn loses(&mut self) -> bool {
        self.misses += 1;
        let due = self.due.max(PATIENCE);
        if self.misses < due {
            return false;
        }
        // One in two at first, when there is much to learn, and rarer ones as it goes on.
        let rarely = (2 * due / PATIENCE).min(RARELY);
        let loses = self.misses * rarely > self.states;
        (self.misses, self.states, self.due) = (0, 0, due * 2);
        loses
    }
}

impl Explorer {
    /// Counts a state whose steps are looked for in the tree.
    #[inline]
    pub(super) fn note_state(&mut self) {
        self.makers.states += 1;
    }

    /// Compiles the steps, after the tree has missed a state, where that is the better way; at most once.
    pub(super) fn compile_if_due(&mut self) {
        if self.makers.tried {
            return;
        }
        let due = match self.settings.engine {
            EngineChoice::Interpreted => false,
            EngineChoice::Compiled => true,
            EngineChoice::Automatic => {
                // Where another explorer of the search has compiled them, its tree has lost.
                let pays = !self.steps.tree.is_used() || self.settings.code.is_made() || self.makers.loses();
                !self.settings.forgetful && pays
            }
        };
        if due {
            self.makers.tried = true;
            let Explorer { program, settings, encoding, view, starts, .. } = self;
            let compiled = Compiled::new(program, settings, encoding, view.shared(), starts);
            if compiled.is_some() {
                self.steps.tree.give_up();
            }
            self.makers.compiled = compiled.map(Box::new);
        }
    }

    /// Of how many states the steps were made by machine code.
    pub fn compiled_states(&self) -> u64 {
        self.makers.made
    }

    /// By rule, whether it has run in some step.
    pub fn executed(&self) -> Vec<bool> {
        let interpreted = self.machine.coverage().expect("counted from the beginning");
        let rules = (0..).map(program::RuleId).zip(&interpreted.executed);
        let compiled = self.makers.compiled.as_deref();
        rules.map(|(rule, count)| *count > 0 || compiled.is_some_and(|code| code.has_run(rule))).collect()
    }
}
