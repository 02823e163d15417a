//! States of foreign documents that are entered where they were left: composite states with a history.
//!
//! In: the states of a document. Out: [`Remembered`]. Such a state has no paths and no actions of its own in the chart: these stand on the
//! paths of the states within, in the order of SCXML. INVARIANT: all states with states in a remembered one are composite states, too, so
//! that a history says the same as in SCXML, shallow or deep.

use std::collections::{BTreeMap, BTreeSet};

use roxmltree::Node;
use syntax::{Diagnostic, FileId};

use super::super::tree::{States, is, place};
use crate::fault::foreign as fault;

/// The states with a history, and those with states within them.
#[derive(Debug, Default)]
pub(super) struct Remembered {
    /// Each with the state in it where it begins.
    pub first: BTreeMap<usize, usize>,
    /// Those that are entered where they were left.
    pub with_history: BTreeSet<usize>,
}

impl Remembered {
    /// The remembered states of a document; `leaf` is the innermost state that is reached by entering one, `start` where the machine begins.
    ///
    /// # Errors
    /// What a chart would not mean in the same way.
    pub(super) fn of(
        file: FileId,
        states: &States<'_>,
        start: Option<usize>,
        leaf: &dyn Fn(usize) -> Option<usize>,
    ) -> Result<Self, Box<Diagnostic>> {
        let mut found = Remembered::default();
        let refuse = |node, what: &str| Err(Box::new(fault::no_counterpart(place(file, node), what, HELP)));
        let inside = |state: usize, owner: usize| states.around(state)[1..].contains(&owner);
        let child = |owner: usize, leaf: usize| {
            states.around(leaf).into_iter().find(|one| states.all[*one].parent == Some(owner))
        };
        for state in &states.all {
            let element = state.node.children().find(|child| is(*child, "initial"));
            let target = element.and_then(|element| element.children().find(|child| is(*child, "transition")));
            let begins = state.node.attribute("initial").or_else(|| target?.attribute("target"));
            if begins.is_some_and(|id| states.is_history(id)) {
                return refuse(state.node, "a state that begins in a `history`");
            }
        }
        let (mut owners, mut shallow) = (BTreeSet::new(), Vec::new());
        for (node, owner) in &states.histories {
            let Some(owner) = *owner else { return refuse(*node, "a `history` outside of all states") };
            if !owners.insert(owner) {
                return refuse(*node, "a second `history` of one state");
            }
            found.with_history.insert(owner);
            let within: Vec<usize> = (0..states.all.len()).filter(|state| inside(*state, owner)).collect();
            if let Some(state) = within.iter().find(|state| says(states.all[**state].node, "onentry")) {
                return refuse(states.all[*state].node, "an entry action within a state with a `history`");
            }
            let compound = within.iter().copied().filter(|state| states.all[*state].compound);
            if node.attribute("type") == Some("deep") {
                found.with_history.extend(compound.clone());
            } else {
                shallow.push((*node, owner));
            }
            let default = node.children().find(|child| is(*child, "transition"));
            let default = default.and_then(|transition| states.named(transition.attribute("target")?)).unwrap_or(owner);
            for state in compound.chain([owner]) {
                let begins = if state == owner { default } else { state };
                let Some(first) = leaf(begins).and_then(|leaf| child(state, leaf)) else {
                    return refuse(*node, "a `history` that begins outside of its state");
                };
                if state == owner && leaf(first) != leaf(default) {
                    return refuse(*node, "a `history` that begins where none of its states does");
                }
                if found.first.insert(state, first).is_some_and(|other| other != first) {
                    return refuse(*node, "two histories that begin in different states");
                }
            }
        }
        for (node, owner) in shallow {
            if found.with_history.iter().any(|other| inside(*other, owner)) {
                return refuse(node, "a shallow `history` around another one");
            }
        }
        // The machine begins where its composite states do.
        for owner in start.map(|start| states.around(start)).unwrap_or_default() {
            let begins = found.first.get(&owner).copied();
            if begins.is_some() && begins != start.and_then(|start| child(owner, start)) {
                return refuse(states.all[owner].node, "a machine that does not begin where a `history` does");
            }
        }
        Ok(found)
    }
}

/// Whether a state does something on entry or exit.
fn says(state: Node<'_, '_>, handler: &str) -> bool {
    state.children().any(|child| is(child, handler) && child.children().any(|content| content.is_element()))
}

const HELP: &str = "keep the last state in a function of the specification, and test it with guards";
