//! Temporal properties against naive references: random graphs, random formulas, random fairness.

mod ctl;
mod equivalence;
mod ltl;
mod naive;
mod partial;
mod random;
mod size;
