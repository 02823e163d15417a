//! The tests of `refine` as one program. Each file of this folder is a module here.

mod bmc;
mod broken;
mod checkpoint;
mod computed;
mod enumerated;
mod growing;
mod homonyms;
mod induction;
mod invariants;
mod naive;
mod preserved;
mod segments;
mod small;
mod spec;
mod stuck;
mod unclear;
mod widened;
mod workers;
