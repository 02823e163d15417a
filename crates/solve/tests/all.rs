//! The tests of `solve` as one program, since linking takes longer than most of them run. Each file of this folder is a
//! module here.

mod agreement;
mod decide;
