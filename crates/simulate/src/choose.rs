//! The policy for choices: which candidate a `choose` rule or a `chooseone` takes.

use std::cell::RefCell;
use std::collections::VecDeque;
use std::hash::Hasher;
use std::rc::Rc;

use machine::{Choice, Draw, Value};
use program::Program;
use syntax::Span;

use crate::draw::{Bounds, draw_basic};
use crate::signal::Signal;
use crate::splitmix::{SplitMix, StableHash};

/// A choice as it was made.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ChoiceMade {
    /// The choose rule or the term.
    pub span: Span,
    /// How many candidates there were.
    pub of: usize,
    /// Which was taken, from 0.
    pub index: usize,
    /// The values of the variables bound.
    pub values: Vec<Value>,
}

/// The choices of one recorded step that still have to be made.
pub(crate) type Played = Rc<RefCell<VecDeque<PlayedChoice>>>;

/// What a recorded choice is made again by.
#[derive(Debug, Clone, PartialEq)]
pub struct PlayedChoice {
    /// How many candidates there were.
    pub of: usize,
    /// Which was taken.
    pub index: usize,
    /// The values of its variables, which hold the numbers drawn for it.
    pub values: Vec<Value>,
}

/// A source that is asked for each choice.
pub trait Chooser {
    /// Which candidate is taken, from 0. An error is a sentence for the user and ends the run.
    ///
    /// # Errors
    /// None is.
    fn choose(&mut self, program: &Program, choice: &Choice<'_>) -> Result<usize, String>;

    /// After an error: what the user wanted instead of choosing.
    fn signal(&mut self) -> Option<Signal> {
        None
    }
}

/// A [`Chooser`] that several hold.
#[derive(Clone)]
pub struct Asked(Rc<RefCell<dyn Chooser>>);

impl std::fmt::Debug for Asked {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Asked")
    }
}

/// How choices are made.
#[derive(Debug, Clone)]
pub enum Choices {
    /// Always the first candidate, in canonical order.
    First,
    /// Each candidate as likely as the others.
    Random {
        /// The seed.
        seed: u64,
        /// The step being made.
        step: u64,
        /// How many choices the step has made so far.
        made: usize,
        /// The keys by which the first, second, … choice of a step is drawn; grows with the step that makes the most
        /// choices.
        keys: Vec<u64>,
    },
    /// As decided beforehand: by step, the values of the variables of each choice, in the order of the step.
    Decided {
        /// By step, from 0, which is the initial state.
        steps: Vec<Vec<Vec<Value>>>,
        /// The step being made.
        step: u64,
        /// How many choices the step has made so far.
        made: usize,
    },
    /// As a source answers that is asked each time.
    Asked(Asked),
    /// As in a trace: how many candidates there were and which was taken, in the order of the step.
    Recorded(Played),
}

impl Choices {
    /// Random choices from a seed.
    pub fn random(seed: u64) -> Self {
        Choices::Random { seed, step: 0, made: 0, keys: Vec::new() }
    }

    /// Choices by the values of their variables, by step from 0.
    pub fn decided(steps: Vec<Vec<Vec<Value>>>) -> Self {
        Choices::Decided { steps, step: 0, made: 0 }
    }

    /// Choices by a source that is asked.
    pub fn asked(chooser: impl Chooser + 'static) -> Self {
        Choices::Asked(Asked(Rc::new(RefCell::new(chooser))))
    }

    /// After an error: what the user wanted instead of choosing.
    pub(crate) fn signal(&self) -> Option<Signal> {
        match self {
            Choices::Asked(Asked(chooser)) => chooser.borrow_mut().signal(),
            Choices::First | Choices::Random { .. } | Choices::Decided { .. } | Choices::Recorded(_) => None,
        }
    }

    pub(crate) fn begin(&mut self, now: u64) {
        if let Choices::Random { step, made, .. } | Choices::Decided { step, made, .. } = self {
            *step = now;
            *made = 0;
        }
    }

    /// Draws a number for the choice that comes next.
    pub(crate) fn number(&mut self, draw: &Draw, bounds: &Bounds) -> Result<Value, String> {
        match self {
            Choices::First => Ok(draw.number(0)),
            Choices::Random { seed, step, made, .. } => {
                let mut key = StableHash::new().text("number");
                key.write(&(*made as u64).to_le_bytes());
                key.write(&draw.variable.to_le_bytes());
                draw_basic(draw.basic, bounds, &mut SplitMix::stream(*seed, *step, key.finish()))
            }
            Choices::Decided { .. } | Choices::Asked(_) => Ok(draw.number(0)),
            Choices::Recorded(recorded) => {
                let recorded = recorded.borrow();
                let value = recorded.front().and_then(|choice| choice.values.get(draw.variable));
                value.cloned().ok_or_else(|| "the trace drew no number here".to_string())
            }
        }
    }

    /// Makes a choice. An error is a sentence for the user.
    pub(crate) fn choose(&mut self, program: &Program, choice: &Choice<'_>) -> Result<usize, String> {
        match self {
            Choices::First => Ok(0),
            Choices::Asked(Asked(chooser)) => {
                let index = chooser.borrow_mut().choose(program, choice)?;
                let of = choice.candidates();
                if index < of {
                    Ok(index)
                } else {
                    Err(format!("there are {of} candidates, no candidate {}", index + 1))
                }
            }
            Choices::Random { seed, step, made, keys } => {
                let key = keys.get(*made).copied().unwrap_or_else(|| one_more(keys));
                let mut stream = SplitMix::stream(*seed, *step, key);
                *made += 1;
                Ok(stream.below(choice.candidates() as u64) as usize)
            }
            Choices::Decided { steps, step, made } => {
                let wanted = steps.get(*step as usize).and_then(|choices| choices.get(*made));
                *made += 1;
                let Some(wanted) = wanted else { return Err("nothing is decided for this choice".to_string()) };
                let mut all = 0..choice.candidates();
                all.find(|index| choice.candidate(*index) == wanted)
                    .ok_or_else(|| "what is decided for this choice is not among its candidates".to_string())
            }
            Choices::Recorded(recorded) => match recorded.borrow_mut().pop_front() {
                Some(PlayedChoice { of, index, .. }) if of == choice.candidates() => Ok(index),
                Some(PlayedChoice { of, .. }) => {
                    Err(format!("the trace chose among {of} candidates here, now there are {}", choice.candidates()))
                }
                None => Err("the trace made no choice here".to_string()),
            },
        }
    }
}

/// Adds the key by which the next choice is drawn: how many the step has made before.
#[cold]
fn one_more(keys: &mut Vec<u64>) -> u64 {
    let mut hash = StableHash::new().text("choose");
    hash.write(&(keys.len() as u64).to_le_bytes());
    keys.push(hash.finish());
    hash.finish()
}
