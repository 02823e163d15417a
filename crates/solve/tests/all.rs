//! The tests of `solve` as one program: each file of this folder is a module here, since linking takes longer than most of
//! them run.

mod agreement;
mod decide;
