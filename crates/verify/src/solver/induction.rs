//! k-induction: what does not happen for k steps does not happen in the next.
//!
//! M. Sheeran, S. Singh, G. Stålmarck, *Checking safety properties using induction and a SAT-solver*, 2000, with paths
//! on which no state repeats. All targets are proved together, so that one may help to prove another: those that fail
//! are removed and the rest is tried again. [`super::bounded`] provides the base case.

use std::collections::BTreeMap;

use solve::session::{Session, Silence, Verdict};
use solve::shared::Node;

use crate::solver::relation::Relation;
use crate::solver::unrolling::{Patience, Unrolling};
use crate::target::Target;

/// LIMIT: how many states of a path are required to differ.
const SIMPLE: usize = 40;

/// A proof in progress.
pub(crate) struct Induction<'r> {
    relation: &'r Relation,
    unrolling: Unrolling<'r>,
    /// What is still to be proved; `None` stands for the claim that the machine does only what was encoded.
    open: BTreeMap<Option<Target>, Node>,
    /// For each open or proved claim, its names at the times.
    names: BTreeMap<Option<Target>, Vec<String>>,
    /// Proved targets, with the number of steps of the induction.
    pub proved: BTreeMap<Target, usize>,
    /// Whether it is proved that the machine does only what was encoded.
    pub told: bool,
}

impl<'r> Induction<'r> {
    pub fn new(relation: &'r Relation, session: Box<dyn Session>) -> Induction<'r> {
        let mut open: BTreeMap<Option<Target>, Node> =
            relation.targets.iter().map(|(target, node)| (Some(*target), *node)).collect();
        open.insert(None, relation.strays);
        Induction {
            relation,
            unrolling: Unrolling::new(relation, session, false),
            open,
            names: BTreeMap::new(),
            proved: BTreeMap::new(),
            told: false,
        }
    }

    /// Stops trying to prove a claim that is violated.
    pub fn give_up(&mut self, target: Option<Target>) {
        self.open.remove(&target);
    }

    /// Whether all is done.
    pub fn is_done(&self) -> bool {
        self.open.is_empty()
    }

    /// Tries with one more step than before, beginning with none.
    pub fn advance(&mut self, patience: &mut Patience<'_>) -> Result<(), Silence> {
        if !self.names.is_empty() {
            self.unrolling.step();
        }
        let time = self.unrolling.time();
        if time > 0 && time < SIMPLE {
            self.unrolling.be_new();
        }
        let known: Vec<(Option<Target>, Node)> = self.all();
        for (target, node) in known {
            let name = self.unrolling.name(node, time);
            if self.is_proved(target) {
                self.unrolling.assert_text(&format!("(not {name})"));
            }
            self.names.entry(target).or_default().push(name);
        }
        let mut set: Vec<Option<Target>> = self.open.keys().copied().collect();
        while !set.is_empty() {
            let last: Vec<String> = set.iter().map(|target| self.names[target][time].clone()).collect();
            let mut assumed: Vec<String> = set
                .iter()
                .flat_map(|target| self.names[target][..time].iter().map(|name| format!("(not {name})")))
                .collect();
            assumed.push(self.unrolling.any(&last));
            match self.unrolling.possible(&assumed, patience)? {
                Verdict::Impossible => break,
                Verdict::Unknown => return Err(Silence::Late),
                Verdict::Possible => {}
            }
            let hits = self.unrolling.true_among(&last, patience)?;
            let before = set.len();
            let mut hits = hits.into_iter();
            set.retain(|_| hits.next() != Some(true));
            if set.len() == before {
                return Err(Silence::Broken("the solver's values do not fit its answer".to_string()));
            }
        }
        for target in set {
            self.open.remove(&target);
            match target {
                Some(target) => _ = self.proved.insert(target, time),
                None => self.told = true,
            }
            for name in self.names[&target].clone() {
                self.unrolling.assert_text(&format!("(not {name})"));
            }
        }
        Ok(())
    }

    fn is_proved(&self, target: Option<Target>) -> bool {
        match target {
            Some(target) => self.proved.contains_key(&target),
            None => self.told,
        }
    }

    /// All claims that are open or proved.
    fn all(&self) -> Vec<(Option<Target>, Node)> {
        let proved = self.relation.targets.iter().filter(|(target, _)| self.proved.contains_key(target));
        let proved = proved.map(|(target, node)| (Some(*target), *node));
        let open = self.open.iter().map(|(target, node)| (*target, *node));
        open.chain(proved).collect()
    }
}
