//! The tests of `refine` as one program. Each file of this folder is a module here.

mod naive;
mod small;
