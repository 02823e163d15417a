//! The steps that were made, remembered: a tree of decisions whose ends say how the next state differs.
//!
//! In: each alternative that the machine has made. Out: the steps of any state of which all alternatives are known.

use hashbrown::HashMap;
use machine::Interrupt;
use rustc_hash::FxBuildHasher;

use crate::alternatives::branches::Branches;
use crate::alternatives::expansion::Expansion;
use crate::alternatives::kind::AlternativeKind;
use crate::alternatives::successors::Successors;
use crate::memory::maker::{StepMaker, Unmade};
use crate::memory::tree::{DEAD, End, Tree};
use crate::packed::words::{Field, Overwrite};

/// The end of an alternative that leaves the state as it is, and no condition on the step fails.
const STAYS: End = 1;

/// What an end of the tree means.
#[derive(Debug, Clone, Copy)]
struct Effect {
    kind: AlternativeKind,
    /// A condition on the step does not hold.
    failed: bool,
    /// Which of the overwrites are its own.
    first: u32,
    len: u32,
}

/// See the module.
#[derive(Debug)]
pub(crate) struct Steps {
    pub tree: Tree,
    effects: Vec<Effect>,
    overwrites: Vec<Overwrite>,
    /// By end, the conditions on the step that do not hold, where there are any.
    failures: HashMap<End, Box<[u32]>, FxBuildHasher>,
}

impl Default for Steps {
    fn default() -> Self {
        // The first end stands for dead alternatives.
        let dead = Effect { kind: AlternativeKind::Excluded, failed: false, first: 0, len: 0 };
        let stays = Effect { kind: AlternativeKind::Next, ..dead };
        Steps {
            tree: Tree::default(),
            effects: vec![dead, stays],
            overwrites: Vec::new(),
            failures: HashMap::default(),
        }
    }
}

impl StepMaker for Steps {
    #[inline]
    fn make(
        &mut self,
        state: &[u64],
        interrupt: &Interrupt,
        expansion: &mut Expansion,
        found: &mut Successors<'_>,
    ) -> Result<(), Unmade> {
        if !self.tree.is_used() {
            return Err(Unmade::Unknown);
        }
        let Steps { tree, effects, overwrites, failures } = self;
        let mut arrivals = Arrivals { effects, overwrites, failures, state, expansion, found };
        let mut stayed = 0;
        // Most alternatives of a state with many of them leave it as it is: these are counted where the tree is walked, without a call.
        let walked = tree.walk(state, interrupt, &mut |end| match end {
            STAYS => stayed += 1,
            end => arrivals.arrive(end),
        });
        expansion.stayed += stayed;
        walked
    }
}

/// What the ends that a walk comes to are added to.
struct Arrivals<'s, 'o> {
    effects: &'s [Effect],
    overwrites: &'s [Overwrite],
    failures: &'s HashMap<End, Box<[u32]>, FxBuildHasher>,
    state: &'s [u64],
    expansion: &'s mut Expansion,
    found: &'s mut Successors<'o>,
}

impl Arrivals<'_, '_> {
    #[inline(never)]
    fn arrive(&mut self, end: End) {
        let effect = self.effects[end as usize];
        let overwrites = &self.overwrites[effect.first as usize..(effect.first + effect.len) as usize];
        self.expansion.count(effect.kind, self.state, overwrites, self.found);
        if effect.failed {
            self.expansion.fail(self.failures.get(&end).map_or(&[], |failed| failed));
        }
    }
}

impl Steps {
    /// Remembers that the alternative that was taken is none.
    pub fn learn_dead(&mut self, fields: &[Field], state: &[u64], branches: &Branches) {
        self.tree.learn(fields, state, &branches.events, branches.answers(), DEAD);
    }

    /// Remembers what the alternative that was taken came to, with the conditions on it that do not hold.
    pub fn learn(
        &mut self,
        fields: &[Field],
        state: &[u64],
        branches: &Branches,
        kind: AlternativeKind,
        overwrites: &[Overwrite],
        failed: Vec<u32>,
    ) {
        if !self.tree.is_used() {
            return;
        }
        if kind == AlternativeKind::Next && overwrites.is_empty() && failed.is_empty() {
            self.tree.learn(fields, state, &branches.events, branches.answers(), STAYS);
            return;
        }
        let (first, len) = (self.overwrites.len() as u32, overwrites.len() as u32);
        self.overwrites.extend(overwrites);
        self.effects.push(Effect { kind, failed: !failed.is_empty(), first, len });
        let end = self.effects.len() as End - 1;
        if !failed.is_empty() {
            self.failures.insert(end, failed.into());
        }
        self.tree.learn(fields, state, &branches.events, branches.answers(), end);
    }

    /// What an end means.
    pub fn kind_of(&self, end: End) -> AlternativeKind {
        self.effects[end as usize].kind
    }

    /// How the next state differs from the state, at an end.
    pub fn overwrites_of(&self, end: End) -> &[Overwrite] {
        let effect = self.effects[end as usize];
        &self.overwrites[effect.first as usize..(effect.first + effect.len) as usize]
    }

    /// The conditions on the step that do not hold at an end.
    pub fn failures_of(&self, end: End) -> &[u32] {
        self.failures.get(&end).map_or(&[], |failed| failed)
    }

    /// How many nodes, links and overwrites are remembered.
    pub fn size(&self) -> usize {
        self.tree.size() + self.overwrites.len()
    }
}
