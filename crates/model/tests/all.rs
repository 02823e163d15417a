//! The tests of `model` as one program: each file of this folder is a module here, since linking takes longer than most of
//! them run.

mod faults;
mod fragment;
mod golden;
mod imports;
mod library;
mod robust;
mod support;
mod uses;
