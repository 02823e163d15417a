//! The tests of `chart` as one program: each file of this folder is a module here, since linking takes longer than most of
//! them run.

mod agreement;
mod answers;
mod exchange;
mod extracted;
mod machines;
mod pages;
mod regenerate;
mod starts;
mod systems;
