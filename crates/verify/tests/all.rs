//! The tests of `verify` as one program, since linking takes longer than most of them run. Each file of this folder is
//! a module here.

mod blocked;
mod census;
mod checkpoint;
mod collections;
mod dependence;
mod disk;
mod exploration;
mod first_step;
mod formula;
mod interrupt;
mod listing;
mod models;
mod partial_order;
mod reference;
mod runs;
mod solver;
mod starts;
mod storage;
mod symbolic;
mod symmetry;
mod temporal;
mod unclear;
mod vacuity;
