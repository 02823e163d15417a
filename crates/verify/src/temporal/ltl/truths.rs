//! Evaluates obligations, as far as the facts of one state determine them.

use super::normal::{Want, Wants};
use crate::temporal::formula::FormulaId;

/// The truth values found in one state; the memory is reused for other states.
#[derive(Debug, Default)]
pub struct Truths {
    /// For each formula, the state in which it was asked last.
    asked: Vec<u32>,
    truth: Vec<Option<bool>>,
    state: u32,
}

impl Truths {
    /// Begins with another state.
    pub fn begin(&mut self, formulas: usize) {
        if self.state == u32::MAX {
            *self = Truths::default();
        }
        self.state += 1;
        self.asked.resize(formulas, 0);
        self.truth.resize(formulas, None);
    }

    /// The truth of a formula, given these facts; `None` if it depends on later states.
    pub fn of(&mut self, wants: &Wants, facts: &[bool], formula: FormulaId) -> Option<bool> {
        let mut open = vec![formula];
        while let Some(next) = open.last().copied() {
            if self.is_known(next) {
                open.pop();
                continue;
            }
            let truth = match wants.node(next) {
                Want::Constant(truth) => Some(truth),
                Want::Fact(fact, truth) => Some(facts[fact.index()] == truth),
                Want::Next(_) => None,
                Want::And(p, q) | Want::Or(p, q) | Want::Until(p, q) | Want::Release(p, q) => {
                    let unknown = [p, q].into_iter().filter(|part| !self.is_known(*part));
                    let before = open.len();
                    open.extend(unknown);
                    if open.len() > before {
                        continue;
                    }
                    decided(wants.node(next), self.truth[p.index()], self.truth[q.index()])
                }
            };
            (self.asked[next.index()], self.truth[next.index()]) = (self.state, truth);
            open.pop();
        }
        self.truth[formula.index()]
    }

    fn is_known(&self, formula: FormulaId) -> bool {
        self.asked[formula.index()] == self.state
    }
}

/// The truth of a formula, given the truth of its operands in the same state.
fn decided(node: Want, left: Option<bool>, right: Option<bool>) -> Option<bool> {
    match (node, left, right) {
        (Want::And(..), Some(false), _) | (Want::And(..), _, Some(false)) => Some(false),
        (Want::And(..), Some(true), other) | (Want::And(..), other, Some(true)) => other,
        (Want::Or(..), Some(true), _) | (Want::Or(..), _, Some(true)) => Some(true),
        (Want::Or(..), Some(false), other) | (Want::Or(..), other, Some(false)) => other,
        (Want::Until(..), _, Some(true)) => Some(true),
        (Want::Until(..), Some(false), Some(false)) => Some(false),
        (Want::Release(..), _, Some(false)) => Some(false),
        (Want::Release(..), Some(true), Some(true)) => Some(true),
        _ => None,
    }
}
