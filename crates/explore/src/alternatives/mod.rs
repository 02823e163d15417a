//! The alternatives of one state's step: an odometer that goes through them, and what they come to.
//!
//! From below: [`kind`] is what one alternative comes to, [`told`] all there is to say of a step; [`branches`] is the odometer,
//! the machine's environment; [`successors`] and [`expansion`] gather what all of a state's alternatives come to.
//! [`unbounded`] is why some cannot be gone through.

pub(crate) mod branches;
pub(crate) mod expansion;
pub(crate) mod kind;
pub(crate) mod successors;
pub(crate) mod told;
pub(crate) mod unbounded;
