//! The tests of `draw` as one program: each file of this folder is a module here, since linking takes longer than most of
//! them run.

mod geometry;
mod notation;
mod pictures;
mod robust;
