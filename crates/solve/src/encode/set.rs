//! Symbolic sets: each element with the condition that it is in the set.

use super::{Encoder, Result, elements};
use crate::shared::{Node, Terms};
use crate::symbol::{Open, Shape, Symbol};

impl Encoder {
    /// The set of some elements, each present under a condition; equal elements are merged.
    pub(super) fn set_of(&mut self, all: Vec<(Node, Symbol)>) -> Result {
        let mut distinct: Vec<(Node, Symbol)> = Vec::new();
        for (mut present, element) in all {
            for (former, other) in &mut distinct {
                let same = self.equal(&element, other)?;
                if same == Terms::TRUE {
                    *former = self.terms.or([*former, present]);
                    present = Terms::FALSE;
                    break;
                }
                let there = self.terms.and([*former, same]);
                let not = self.terms.not(there);
                present = self.terms.and([present, not]);
            }
            if present != Terms::FALSE {
                distinct.push((present, element));
            }
        }
        Ok(Symbol::Set(distinct))
    }

    /// One set if a condition holds, else the other.
    pub(super) fn merge_sets(&mut self, condition: Node, yes: Vec<(Node, Symbol)>, no: Vec<(Node, Symbol)>) -> Result {
        let not = self.terms.not(condition);
        let mut all: Vec<(Node, Symbol)> = Vec::new();
        let guarded = yes.into_iter().map(|one| (condition, one)).chain(no.into_iter().map(|one| (not, one)));
        for (guard, (present, element)) in guarded {
            let here = self.terms.and([guard, present]);
            match all.iter_mut().find(|(_, known)| *known == element) {
                Some((former, _)) => *former = self.terms.or([*former, here]),
                None => all.push((here, element)),
            }
        }
        all.retain(|(present, _)| *present != Terms::FALSE);
        Ok(Symbol::Set(all))
    }

    /// The condition that an element is in a set.
    pub(super) fn contains(&mut self, set: &[(Node, Symbol)], element: &Symbol) -> Result<Node> {
        let mut any = Vec::new();
        for (present, other) in set {
            let same = self.equal(element, other)?;
            any.push(self.terms.and([*present, same]));
        }
        Ok(self.terms.or(any))
    }

    /// How many elements a set has.
    pub(super) fn size(&mut self, set: &[(Node, Symbol)]) -> Symbol {
        let (zero, one) = (self.terms.integer(0), self.terms.integer(1));
        let mut sum = zero;
        for (present, _) in set {
            let here = self.terms.choose(*present, one, zero);
            sum = self.terms.add(sum, here);
        }
        self.symbol(Open { shape: Shape::Integer, value: sum, defined: Terms::TRUE })
    }

    /// The elements of the first set that are (or are not) in the second.
    pub(super) fn filtered(&mut self, set: &[(Node, Symbol)], by: &[(Node, Symbol)], inside: bool) -> Result {
        let mut kept = Vec::new();
        for (present, element) in set {
            let mut within = self.contains(by, element)?;
            if !inside {
                within = self.terms.not(within);
            }
            let here = self.terms.and([*present, within]);
            if here != Terms::FALSE {
                kept.push((here, element.clone()));
            }
        }
        Ok(Symbol::Set(kept))
    }

    /// The elements of two operands, if both are sets.
    pub(super) fn two_sets(operands: &[Symbol]) -> Option<[Vec<(Node, Symbol)>; 2]> {
        match operands {
            [a, b] => Some([elements(a)?, elements(b)?]),
            _ => None,
        }
    }
}
