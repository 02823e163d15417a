//! The tests of `syntax` as one program: each file of this folder is a module here, since linking takes longer than most of
//! them run.

mod faults;
mod format;
mod limits;
mod render;
mod robust;
mod sources;
mod spec;
