//! The interface of an explorer that wants every alternative of a step, not one.
//!
//! In: an [`Alternatives`], which the environment provides. Out: each question of a step, with the number of its
//! alternatives, and each read of the state. INVARIANT: only the answers and what was read decide how a step goes on.

use std::collections::BTreeMap;

use program::{FunctionId, Program};
use syntax::Span;

use crate::layout::LocationIndex;
use crate::piece::{Edit, Piece};
use crate::value::Value;

/// The values that an input takes, where they are not all those of its domain.
pub type Bounds = BTreeMap<FunctionId, Vec<Value>>;

/// Who goes through the alternatives of steps, one at a time, and notes what of the state each looks at. A step is
/// deterministic but for what it asks here.
pub trait Alternatives {
    /// Which of `of` alternatives is taken, from 0. Where they are `guarded`, `of` itself says that none of them is alive.
    fn ask(&mut self, of: usize, guarded: bool) -> usize;

    /// How many questions have been asked so far.
    fn asked(&self) -> usize;

    /// The questions from this one on are asked again, those before are not.
    fn ask_from(&mut self, question: usize);

    /// The alternative taken is none: its guard does not hold.
    fn be_dead(&mut self);

    /// Whether the alternative taken is none.
    fn is_dead(&self) -> bool;

    /// A choice was made: the choose rule and the values of the variables that it binds.
    fn chose(&mut self, span: Span, values: Vec<Value>);

    /// Whether the values of an input are given, so that its domain is not gone through.
    fn gives(&self, input: FunctionId) -> bool;

    /// The values of an input cannot be gone through. Gives the reason that the step ends with.
    fn endless_input(&mut self, input: FunctionId, span: Span) -> String;

    /// The candidates of a choice cannot be gone through.
    fn endless_choice(&mut self, span: Span);

    /// A location is looked at: the number that it may have, and whether its function's locations are part of the state
    /// between steps ([`is_kept`]).
    fn look(&mut self, function: FunctionId, found: Option<u32>, kept: bool);

    /// A location is written that may have to have its initial value first.
    fn write(&mut self, found: Option<u32>, kept: bool);

    /// Whether the collections in a function's locations are kept in pieces, so that one can be looked at or changed by itself.
    fn keeps_pieces(&self, function: FunctionId) -> bool;

    /// A piece of a collection that is kept in pieces is looked at: as it was before the step.
    fn look_at_piece(&mut self, location: LocationIndex, piece: Piece<'_>);

    /// A location is overwritten, perhaps by an edit of what it held before the step.
    fn overwrite(&mut self, function: FunctionId, location: LocationIndex, edit: Option<Edit>);

    /// The elements of a dynamic domain are looked at.
    fn look_at_carriers(&mut self);

    /// It is looked at in which initial state the run began.
    fn look_at_origin(&mut self);
}

/// Whether a function's locations are part of the state between steps.
pub fn is_kept(program: &Program, function: FunctionId) -> bool {
    use program::FunctionKind::{Controlled, Out, Shared};
    matches!(program.function(function).kind, Controlled | Out | Shared) && Some(function) != program.self_function
}
