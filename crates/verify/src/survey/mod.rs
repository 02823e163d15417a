//! Surveys what happens within a model's steps, and where first: over all states, or on random walks.
//!
//! `surveyor` explores all states; `walk` makes walks where there are too many; `guards` evaluates what is known
//! of guards. It must not know goals: review and test generation do.

mod guards;
mod surveyor;
mod walk;

pub use guards::{Guard, guards};
pub use surveyor::{Sighting, Survey, survey};
pub use walk::{Walk, Wanderer};
