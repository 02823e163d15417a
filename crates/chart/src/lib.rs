//! Control-state charts: their meaning, and translations between charts and AsmetaL.
//!
//! In: the tree of a chart file. Out: a [`Chart`] and its faults; from these, AsmetaL ([`build()`]) and the contents of
//! pictures ([`subjects()`], which the crate `draw` draws). The notation is that of the paper (section IV): control
//! states, guards, actions, pattern machines with an entering arrow and floating exit arrows, pattern instances;
//! `spec/charts.md` defines its meaning. A chart means the AsmetaL that it is built to; this crate must not execute
//! anything.

pub mod build;
pub mod import;

mod answer;
mod begin;
mod chart;
mod check;
mod component;
mod computing;
mod defined;
mod differ;
mod dump;
mod export;
mod extract;
mod fault;
mod flat;
mod flow;
mod lights;
mod link;
mod note;
mod obligation;
mod read;
mod stand;
mod subject;
mod symbolic;
pub mod system;
pub mod times;
pub mod ways;
mod write;
pub mod xml;

pub use build::{
    Built, Known, Lengths, Reduced, Unknown, build, clashes, kept, library, reduced, unbuilt, unverified, verifiable,
    verified,
};
pub use chart::{
    Arrow, Chart, Composite, Control, End, History, Layout, Machine, Parameter, Pattern, Refinement, Shape, ShapeId,
    ShapeKind, WORDS,
};
pub use check::{Probed, built_faults, check, outdated, probed, stateless};
pub use computing::{ComponentMachine, Computing, Content, Feed, Take};
pub use dump::dump;
pub use export::scxml_of;
pub use extract::{Extracted, extract, nest};
pub use fault::IDS as FAULT_IDS;
pub use flow::{Origin, Target, Transition, transitions};
pub use lights::{Light, Lights};
pub use link::Link;
pub use note::{Note, Texts};
pub use obligation::{Answered, Block, Obligation, Observed, Only, obligations};
pub use read::{Loaded, load, load_beside, read};
pub use stand::{Stand, stands};
pub use subject::{NoPictures, NotDrawn, Part, Pictures, Subject, subjects};
pub use write::write;
