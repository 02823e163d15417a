//! The tests of `groundstate` as one program, since linking takes longer than most of them run. Each file of this
//! folder is a module here.

mod aged_systems;
mod asked_run;
mod bounded_systems;
mod composite_states;
mod decision;
mod draw;
mod held_to_model;
mod invariants;
mod jittered_systems;
mod jobs;
mod labels;
mod left_out_machines;
mod machines;
mod operations;
mod pages;
mod picks;
mod preserved;
mod reduced_systems;
mod review;
mod scenarios;
mod seeded;
mod sessions;
mod system_data;
mod system_verification;
mod systems;
mod test_generation;
mod verification;
mod verified_systems;
mod workspace;
