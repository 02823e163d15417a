//! Bounded model checking: searches for runs of limited length to the targets.
//!
//! A. Biere, A. Cimatti, E. Clarke, Y. Zhu, *Symbolic model checking without BDDs*, 1999. Lengths are tried in
//! increasing order, so the first run found is a shortest one; one solver session is told each step once.

use std::collections::BTreeMap;
use std::sync::Arc;

use program::Program;
use solve::Outside;
use solve::session::{Silence, Verdict};
use solve::shared::Node;

use crate::plan::Plan;
use crate::solver::relation::Relation;
use crate::solver::replay::replay;
use crate::solver::unrolling::{Patience, Unrolling};
use crate::target::Target;
use crate::trace::Trace;

/// The search for runs.
pub(crate) struct Bounded<'r> {
    program: &'r Arc<Program>,
    plan: &'r Plan,
    relation: &'r Relation,
    unrolling: Unrolling<'r>,
    /// The targets not found yet.
    pub open: Vec<(Target, Node)>,
    pub found: BTreeMap<Target, Trace>,
    /// What runs of this length or more may do that was not encoded.
    pub beyond: Option<Outside>,
    /// Targets whose run the machine does not make.
    pub odd: Vec<Target>,
    /// How many lengths were tried.
    pub times: usize,
}

impl<'r> Bounded<'r> {
    pub fn new(
        program: &'r Arc<Program>,
        plan: &'r Plan,
        relation: &'r Relation,
        session: Box<dyn solve::session::Session>,
    ) -> Bounded<'r> {
        Bounded {
            program,
            plan,
            relation,
            unrolling: Unrolling::new(relation, session, true),
            open: relation.targets.clone(),
            found: BTreeMap::new(),
            beyond: None,
            odd: Vec::new(),
            times: 0,
        }
    }

    /// Tries the next length; if the solver does not know, that is reported as late.
    pub fn advance(&mut self, patience: &mut Patience<'_>) -> Result<(), Silence> {
        if self.times > 0 {
            self.unrolling.step();
        }
        let time = self.unrolling.time();
        patience.depth = time as u64;
        let relation = self.relation;
        let mut names: BTreeMap<Target, String> = BTreeMap::new();
        for (target, node) in self.open.clone() {
            names.insert(target, self.unrolling.name(node, time));
        }
        let beyond: Vec<String> = match &self.beyond {
            Some(_) => Vec::new(),
            None => relation.beyond.iter().map(|(node, _)| self.unrolling.name(*node, time)).collect(),
        };
        loop {
            let mut looked: Vec<String> = names.values().cloned().collect();
            if self.beyond.is_none() {
                looked.extend(beyond.iter().cloned());
            }
            let any = self.unrolling.any(&looked);
            match self.unrolling.possible(&[any], patience)? {
                Verdict::Impossible => break,
                Verdict::Unknown => return Err(Silence::Late),
                Verdict::Possible => {}
            }
            let hits = self.unrolling.true_among(&looked, patience)?;
            let run = self.unrolling.run(patience)?;
            let mut progress = false;
            for (hit, name) in hits.into_iter().zip(looked).filter(|(hit, _)| *hit) {
                debug_assert!(hit);
                progress = true;
                if let Some(index) = beyond.iter().position(|other| *other == name) {
                    self.beyond.get_or_insert_with(|| relation.beyond[index].1.clone());
                    continue;
                }
                let Some(target) = names.iter().find(|(_, other)| **other == name).map(|(target, _)| *target) else {
                    continue;
                };
                names.remove(&target);
                self.open.retain(|(open, _)| *open != target);
                match replay(self.program, self.plan, relation, &run, target) {
                    Some(trace) => _ = self.found.insert(target, trace),
                    None => self.odd.push(target),
                }
            }
            if !progress {
                return Err(Silence::Broken("the solver's values do not fit its answer".to_string()));
            }
        }
        self.times += 1;
        Ok(())
    }
}
