//! The tests of `wire` as one program: each file of this folder is a module here.

mod traces;
