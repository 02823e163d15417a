//! What a checkpoint keeps of one machine: its states with their numbers, the steps that were made, what these looked at.
//!
//! In: a side, and the numbers of inputs. Out: words; of words a side that knows the same. INVARIANT: every number names something.

use std::hash::Hash;

use explore::Unbounded;
use explore::checkpoint::{Known, Refusal, Words, layout, write_location, write_text, write_values};
use machine::Value;
use rustc_hash::FxHashMap;

use super::{Goal, Inputs, Label, Move, Side};
use crate::coupling::{Coupling, number_of_fair};

impl Side<'_> {
    /// The states, one after the other.
    pub fn states(&self) -> &[u64] {
        self.states.words()
    }

    /// What was found of the states, as words of a checkpoint: the steps that were made, and what these looked at.
    pub fn keep(&self, words: &mut Vec<u64>) {
        words.extend([self.states.len() as u64, self.steps.0, self.steps.1, layout(&self.stepper.explorer)]);
        words.push(self.faults.0.len() as u64);
        self.faults.0.iter().for_each(|fault| write_text(words, fault));
        words.push(self.opens.0.len() as u64);
        words.extend(self.opens.0.iter().flat_map(Unbounded::words));
        words.push(self.looked_at.len() as u64);
        for (at, locations) in &self.looked_at {
            words.push(at.map_or(u64::MAX, u64::from));
            words.push(locations.len() as u64);
            locations.iter().for_each(|location| write_location(words, location));
        }
        for moves in &self.moves {
            words.push(moves.as_ref().map_or(0, |moves| 1 + moves.len() as u64));
            for made in moves.iter().flat_map(|moves| moves.iter()) {
                let (kind, number) = match made.goal {
                    Goal::State(state) => (0, state),
                    Goal::Fault(fault) => (1, fault),
                    Goal::Open(open) => (2, open),
                };
                words.extend([u64::from(made.label), kind, u64::from(number)]);
            }
        }
    }

    /// Takes over what was kept, before it has met a state: the states, and what was found of them. There are so many labels.
    ///
    /// # Errors
    /// The words are none of this side.
    pub fn take_over(&mut self, (states, found): (&[u64], &[u64]), labels: usize) -> Result<(), Refusal> {
        let mut words = Words::new(found);
        let known = Known(&self.program);
        let count: usize = words.number()?;
        self.steps = (words.word()?, words.word()?);
        let width = self.stepper.explorer.words();
        if words.word()? != layout(&self.stepper.explorer) || count.checked_mul(width) != Some(states.len()) {
            return Err(Refusal::Damaged);
        }
        self.faults.0 = words.many(|words| words.text())?;
        self.opens.0 = words.many(|words| Unbounded::of_words(words.take(5)?).ok_or(Refusal::Damaged))?;
        self.looked_at = words.many(|words| {
            let at = match words.word()? {
                u64::MAX => None,
                state => Some(u32::try_from(state).map_err(|_| Refusal::Damaged)?),
            };
            Ok((at, words.many(|words| known.location(words))?))
        })?;
        let limited = self.looked_at.values().flatten().all(|location| self.limited.contains_key(&location.function));
        let is_new = |state: usize| self.states.number(&states[state * width..][..width]).1;
        if !limited || !(0..count).all(is_new) {
            return Err(Refusal::Damaged);
        }
        for _ in 0..count {
            let moves = match words.word()? {
                0 => None,
                made => Some(
                    (1..made)
                        .map(|_| {
                            let label = words.below(labels)?;
                            let goal = match words.word()? {
                                0 => Goal::State(words.below(count)?),
                                1 => Goal::Fault(words.below(self.faults.0.len())?),
                                2 => Goal::Open(words.below(self.opens.0.len())?),
                                _ => return Err(Refusal::Damaged),
                            };
                            Ok(Move { label, goal })
                        })
                        .collect::<Result<_, _>>()?,
                ),
            };
            self.moves.push(moves);
        }
        words.end()
    }
}

impl Inputs {
    /// All of them, as words of a checkpoint.
    pub fn keep(&self, words: &mut Vec<u64>) {
        words.push(self.told.len() as u64);
        for (input, arguments) in &self.told {
            words.push(u64::from(*input));
            write_values(words, arguments);
        }
        write_values(words, &self.told_values);
        words.push(self.told_labels.len() as u64);
        for label in &self.told_labels {
            words.push(label.len() as u64);
            words.extend(label.iter().flat_map(|(location, value)| [u64::from(*location), u64::from(*value)]));
        }
    }

    /// What was kept, with the same numbers.
    ///
    /// # Errors
    /// The words are none of inputs.
    pub fn again(words: &mut Words<'_>, coupling: &Coupling) -> Result<Inputs, Refusal> {
        let known = Known(&coupling.joint.program);
        let is_named = |input: u32| match number_of_fair(0) <= input {
            true => (input - number_of_fair(0)) < coupling.fair.len() as u32,
            false => (input as usize) < coupling.joint.program.functions.len(),
        };
        let told: Vec<(u32, Vec<Value>)> = words.many(|words| Ok((words.number()?, known.values(words)?)))?;
        if !told.iter().all(|(input, _)| is_named(*input)) {
            return Err(Refusal::Damaged);
        }
        let told_values = known.values(words)?;
        let entry = |words: &mut Words<'_>| Ok((words.below(told.len())?, words.below(told_values.len())?));
        let told_labels: Vec<Label> = words.many(|words| words.many(entry))?;
        fn numbers<T: Clone + Eq + Hash>(all: &[T]) -> FxHashMap<T, u32> {
            all.iter().cloned().zip(0..).collect()
        }
        let (locations, values, labels) = (numbers(&told), numbers(&told_values), numbers(&told_labels));
        Ok(Inputs { locations, values, told, told_values, labels, told_labels })
    }
}
