//! What steps and conditions came to, remembered by what they looked at.
//!
//! A [`tree`] of decisions leads from the fields of a packed state and the answers of a step to an end. [`steps`] says what
//! the ends of steps mean and makes steps of them, [`condition`] does so for conditions on states. [`record`] decides when a
//! tree should give way. [`maker`] is the seam between these and any other way of making steps without the machine.

pub(crate) mod condition;
mod front;
pub(crate) mod maker;
pub(crate) mod record;
pub(crate) mod steps;
pub(crate) mod tree;
