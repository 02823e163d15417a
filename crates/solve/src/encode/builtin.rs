//! Encodes the library functions, like `machine/src/builtin`.
//!
//! SYNC(operations): the faults are the machine's; functions missing here are not encoded.

use machine::Value;
use program::{Builtin, TermId};

use super::{Choice, Encoder, FaultClass, InputKind, Result, components, elements};
use crate::shared::Terms;
use crate::symbol::{Open, Shape, Symbol};

impl Encoder {
    pub(super) fn apply(&mut self, builtin: Builtin, operands: &[Symbol], id: TermId) -> Result {
        let span = self.program.term_span(id);
        match (builtin, operands) {
            (Builtin::Eq, [a, b]) => Ok(Symbol::boolean(self.equal(a, b)?)),
            (Builtin::Neq, [a, b]) => {
                let same = self.equal(a, b)?;
                Ok(Symbol::boolean(self.terms.not(same)))
            }
            (Builtin::IsDef, [a]) => Ok(Symbol::boolean(self.defined(a))),
            (Builtin::IsUndef, [a]) => {
                let defined = self.defined(a);
                Ok(Symbol::boolean(self.terms.not(defined)))
            }
            (Builtin::Not, [a]) => {
                let (_, value) = self.truths(a);
                let defined = self.defined(a);
                Ok(self.symbol(Open { shape: Shape::Boolean, value, defined }))
            }
            (Builtin::Xor | Builtin::Iff, [a, b]) => {
                for operand in [a, b] {
                    self.need(operand);
                }
                let ((a, _), (b, _)) = (self.truths(a), self.truths(b));
                let same = self.terms.equal(a, b);
                Ok(Symbol::boolean(if builtin == Builtin::Iff { same } else { self.terms.not(same) }))
            }
            (Builtin::Program, [agent]) => self.program_of(agent, span),
            (Builtin::Component(index), [tuple]) => match components(tuple) {
                Some(mut parts) if parts.len() > index as usize => Ok(parts.swap_remove(index as usize)),
                _ => self.outside("a component of what is no tuple", span),
            },
            (Builtin::ChooseOne, [set]) => match elements(set) {
                Some(elements) => self.choose_one(elements),
                None => self.outside("a choice from such a set", span),
            },
            (Builtin::SetContains | Builtin::SetNotIn, [set, element]) if elements(set).is_some() => {
                let set = elements(set).unwrap_or_default();
                let within = self.contains(&set, element)?;
                Ok(Symbol::boolean(if builtin == Builtin::SetContains { within } else { self.terms.not(within) }))
            }
            (Builtin::SetIncluding | Builtin::SetExcluding, [set, element]) if elements(set).is_some() => {
                let mut set = elements(set).unwrap_or_default();
                if builtin == Builtin::SetExcluding {
                    return self.filtered(&set, &[(Terms::TRUE, element.clone())], false);
                }
                set.push((Terms::TRUE, element.clone()));
                self.set_of(set)
            }
            (Builtin::SetSize | Builtin::SetIsEmpty | Builtin::SetNotEmpty, [set]) if elements(set).is_some() => {
                let set = elements(set).unwrap_or_default();
                let any = self.terms.or(set.iter().map(|(present, _)| *present));
                Ok(match builtin {
                    Builtin::SetSize => self.size(&set),
                    Builtin::SetNotEmpty => Symbol::boolean(any),
                    _ => Symbol::boolean(self.terms.not(any)),
                })
            }
            (Builtin::SetUnion, both) if Self::two_sets(both).is_some() => {
                let [mut a, b] = Self::two_sets(both).unwrap_or_default();
                a.extend(b);
                self.set_of(a)
            }
            (Builtin::SetIntersection | Builtin::SetDifference, both) if Self::two_sets(both).is_some() => {
                let [a, b] = Self::two_sets(both).unwrap_or_default();
                self.filtered(&a, &b, builtin == Builtin::SetIntersection)
            }
            _ => match self.number(builtin, operands, span)? {
                Some(symbol) => Ok(symbol),
                None => self.outside(format!("the function `{}`", builtin.name()), span),
            },
        }
    }

    /// Adds a fault if an operand is undef.
    pub(super) fn need(&mut self, operand: &Symbol) {
        let defined = self.defined(operand);
        let undefined = self.terms.not(defined);
        self.fault(FaultClass::Undefined, undefined);
    }

    /// `chooseone(S)`: undef for an empty set.
    fn choose_one(&mut self, elements: Vec<(crate::shared::Node, Symbol)>) -> Result {
        if elements.is_empty() {
            return Ok(Symbol::UNDEF);
        }
        let candidates: Vec<_> = elements.into_iter().map(|(present, element)| (present, vec![element])).collect();
        let taken = self.pick(&candidates);
        let mut value = Symbol::UNDEF;
        for (taken, (_, candidate)) in taken.iter().zip(&candidates) {
            value = self.merge(*taken, &candidate[0], &value)?;
        }
        let any = self.terms.or(candidates.iter().map(|(present, _)| *present));
        let made = self.terms.and([self.path, any]);
        let candidates = taken.into_iter().zip(candidates.into_iter().map(|(_, values)| values)).collect();
        self.choices.push(Choice { made, candidates, draws: Vec::new() });
        Ok(value)
    }

    /// For each candidate, the condition that it is the one picked from those that exist.
    pub(super) fn pick(&mut self, candidates: &[(crate::shared::Node, Vec<Symbol>)]) -> Vec<crate::shared::Node> {
        if let [(present, _)] = candidates {
            return vec![*present];
        }
        let bounds = (Some(0), Some(candidates.len() as i128 - 1));
        let pick = self.input("pick", crate::shared::Kind::Integer, bounds, InputKind::Pick);
        let mut taken = Vec::with_capacity(candidates.len());
        for (index, (present, _)) in candidates.iter().enumerate() {
            let index = self.terms.integer(index as i128);
            let this = self.terms.equal(pick, index);
            taken.push(self.terms.and([this, *present]));
        }
        let any = self.terms.or(candidates.iter().map(|(present, _)| *present));
        let one = self.terms.or(taken.iter().copied());
        let known = self.terms.implies(any, one);
        self.given.push(known);
        taken
    }

    fn program_of(&mut self, agent: &Symbol, span: syntax::Span) -> Result {
        match agent {
            Symbol::Known(value) => Ok(Symbol::Known(match self.agent_program(value) {
                Some(procedure) => Value::Rule(procedure),
                None => Value::Undef,
            })),
            _ => self.outside("the program of an agent that is not known", span),
        }
    }
}
