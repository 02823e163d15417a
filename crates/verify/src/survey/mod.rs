//! What happens within the steps of a model, for the first time and where: of all states, or along walks at random.
//!
//! [`surveyor`] meets all states; [`walk`] goes where there are too many; [`guards`] tells what is known of each guard. It must not
//! know what is wanted of a model: review and test generation ask.

mod guards;
mod surveyor;
mod walk;

pub use guards::{Guard, guards};
pub use surveyor::{Sighting, Survey, survey};
pub use walk::{Walk, Wanderer};
