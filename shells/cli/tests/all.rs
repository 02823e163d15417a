//! The tests of the command line as one program, since linking takes longer than most of them run. Each file of this
//! folder is a module here.

mod bad_input;
mod bench;
mod committed_programs;
mod conformance;
mod dap;
mod dap_disorder;
mod dap_points;
mod documented;
mod first_steps;
mod fmt;
mod followed;
mod hidden;
mod input_pages;
mod interrupts;
mod lsp;
mod lsp_bad_input;
mod lsp_disorder;
mod lsp_recorded;
mod owed;
mod owed_guards;
mod owed_imports;
mod prompt;
mod proofs;
mod refinements;
mod schema;
mod start;
mod transcripts;
mod verdicts;
