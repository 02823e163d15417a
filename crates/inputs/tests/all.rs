//! The tests of `inputs` as one program: each file of this folder is a module here.

mod places;
