//! Temporal properties agree with naive references, on random graphs, formulas and fairness.

mod ctl;
mod equivalence;
mod ltl;
mod naive;
mod partial;
mod random;
mod size;
