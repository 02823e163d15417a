//! The tests of `report` as one program: each file of this folder is a module here, since linking takes longer than most of
//! them run.

mod charts;
mod figures;
mod fixture;
mod geometry;
mod markup;
mod program;
mod script;
mod synthetic;
